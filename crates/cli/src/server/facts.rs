//! What is said of a scene beside its picture.

use kerrscope::camera::Camera;
use kerrscope::display::chart;
use kerrscope::scene::{Faults, Scene};
use kerrscope::spacetime::kerr::{CriticalCurve, Orbits};
use serde::Serialize;

use super::overlay::Lines;
use super::stock::Refusal;

/// Something that is told as JSON.
#[derive(Debug, Serialize)]
#[serde(tag = "kind", content = "content", rename_all = "kebab-case")]
pub enum Notice {
    /// What is known of a scene.
    Facts(Box<Facts>),
    /// What is wrong with a scene.
    Faults(FaultList),
    /// What is wrong with a message.
    Fault(String),
    /// How far a file is.
    Progress(Progress),
    /// How far a picture is that takes its time.
    Drawing(Progress),
    /// Why there is no file.
    Unsaved(FaultList),
    /// Lines over a picture.
    Overlay {
        /// The wish that it answers.
        generation: u32,
        /// The lines.
        lines: Vec<Lines>,
    },
    /// What the colours of a data layer mean; none for light.
    Key {
        /// The wish that it answers.
        generation: u32,
        /// What they mean.
        key: Option<Key>,
    },
    /// A ray.
    Ray {
        /// The wish that it answers.
        generation: u32,
        /// Place in the picture.
        at: [f64; 2],
        /// Radius of the horizon, 0 for none.
        horizon: f64,
        /// As `trace` tells it.
        ray: serde_json::Value,
    },
}

/// What colours mean: heading, colours along a bar with marks, and boxes of one colour each.
#[derive(Debug, Serialize)]
pub struct Key {
    heading: String,
    bar: Vec<String>,
    marks: Vec<(f64, String)>,
    boxes: Vec<(String, String)>,
}

impl From<chart::Key> for Key {
    fn from(key: chart::Key) -> Self {
        let css = |color: [f64; 3]| {
            let [red, green, blue] = color.map(|c| (255.0 * c.clamp(0.0, 1.0)).round());
            format!("rgb({red} {green} {blue})")
        };
        Self {
            heading: key.heading,
            bar: key.bar.into_iter().map(css).collect(),
            marks: key.marks,
            boxes: key.boxes.into_iter().map(|(color, name)| (css(color), name)).collect(),
        }
    }
}

/// How far a file or a picture is, in rays.
#[derive(Debug, Serialize)]
pub struct Progress {
    pub generation: u32,
    pub done: u64,
    pub total: u64,
}

impl Notice {
    /// As JSON.
    pub fn json(&self) -> String {
        // Plain values have no way to fail.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Why a wish was not met.
    pub fn refusal(generation: u32, refusal: &Refusal) -> Self {
        Self::Faults(list(generation, refusal))
    }

    /// Why a file was not made.
    pub fn unsaved(generation: u32, refusal: &Refusal) -> Self {
        Self::Unsaved(list(generation, refusal))
    }
}

fn list(generation: u32, refusal: &Refusal) -> FaultList {
    let faults = match refusal {
        Refusal::Scene(faults) => faults.iter().map(told).collect(),
        Refusal::Wish(message) => {
            vec![Told { place: String::new(), message: message.clone(), help: String::new() }]
        }
    };
    FaultList { generation, faults }
}

#[derive(Debug, Serialize)]
pub struct FaultList {
    generation: u32,
    faults: Vec<Told>,
}

/// A fault: where, what, and how to mend it.
#[derive(Debug, Serialize)]
struct Told {
    place: String,
    message: String,
    help: String,
}

fn told(fault: &<Faults as IntoIterator>::Item) -> Told {
    let place = match fault.line_column() {
        // An override has one line: its own text says more than its number.
        Some(_) if fault.source.name.starts_with("--set") => {
            fault.source.text.split('=').next().unwrap_or_default().trim().to_owned()
        }
        Some((line, column)) => format!("{}:{line}:{column}", fault.source.name),
        None => fault.source.name.clone(),
    };
    Told { place, message: fault.message.clone(), help: fault.help.clone() }
}

/// What is known of a scene. Lengths in M.
#[derive(Debug, PartialEq, Serialize)]
pub struct Facts {
    pub generation: u32,
    engine: &'static str,
    /// The scene whole, as JSON.
    scene: serde_json::Value,
    place: Place,
    hole: Option<Hole>,
    /// M in µas, if mass and distance are given.
    theta_g_uas: Option<f64>,
    /// Length in M, at the distance of the hole, of a pixel at the middle of the picture.
    pixel: Option<f64>,
}

/// Where the observer is, however the scene says it: r in M, none if infinite, and angles in degrees.
#[derive(Debug, PartialEq, Serialize)]
struct Place {
    distance: Option<f64>,
    inclination: f64,
    azimuth: f64,
}

#[derive(Debug, PartialEq, Serialize)]
struct Hole {
    spin: f64,
    horizon: f64,
    isco: f64,
    photon_prograde: f64,
    photon_retrograde: f64,
    /// Of the critical curve on a distant observer's sky at this inclination: across, along the projected axis, and
    /// diameter of a circle of the same area.
    shadow_width: f64,
    shadow_height: f64,
    shadow_diameter: f64,
}

impl Facts {
    /// What is known of a scene that `engine` draws.
    pub fn of(generation: u32, scene: &Scene, engine: &'static str) -> Self {
        let hole = scene.spacetime.spin().map(|spin| {
            let orbits = Orbits::new(spin);
            let shadow = CriticalCurve::new(spin, scene.observer.place.theta).extent();
            Hole {
                spin,
                horizon: orbits.horizon,
                isco: orbits.isco,
                photon_prograde: orbits.photon_prograde,
                photon_retrograde: orbits.photon_retrograde,
                shadow_width: shadow.alpha_max - shadow.alpha_min,
                shadow_height: 2.0 * shadow.beta_max,
                shadow_diameter: 2.0 * (shadow.area / std::f64::consts::PI).sqrt(),
            }
        });
        let pixel =
            Camera::new(scene).ok().map(|camera| camera.pixel_size()).filter(|pixel| pixel.is_finite());
        Self {
            generation,
            engine,
            scene: scene.file().to_json(),
            place: Place {
                distance: Some(scene.observer.place.r).filter(|r| r.is_finite()),
                inclination: scene.observer.place.theta.to_degrees(),
                azimuth: scene.observer.place.phi.to_degrees(),
            },
            hole,
            theta_g_uas: scene.units.microarcseconds(),
            pixel,
        }
    }
}
