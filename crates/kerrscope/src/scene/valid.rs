//! A scene that can be drawn: numbers and choices, nothing left to interpret.

use std::path::PathBuf;
use std::sync::Arc;

use super::file::Coordinates;
use crate::disk::{Glow, Limb, Mapping, Profile, Shifts};
use crate::display::{self, Depth, FalseColor, Picture};
use crate::material::Finish;
use crate::objects::Shape;
use crate::render::Film;
use crate::render::Layer;
use crate::sky::Orientation;
use kerrscope_spacetime::emitter::Circular;
use kerrscope_spacetime::metric::{LineElement, Text};
use kerrscope_spacetime::observer::{
    Drift, Motion, Observer as Eye, ObserverError, Patch, Place, clearance, clearance_in_metric,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The spacetime that light moves in; lengths are in its mass M.
#[derive(Clone, Debug, PartialEq)]
pub enum Spacetime {
    /// Flat space.
    Minkowski,
    /// A black hole that does not turn.
    Schwarzschild,
    /// A black hole that turns.
    Kerr {
        /// Spin a in [−1, 1], along +z.
        spin: f64,
    },
    /// A metric as text: stationary, and flat far away unless rays end before.
    Text(Arc<LineElement>),
}

impl Spacetime {
    /// The spin of the hole; `None` where there is no hole, or one whose formulas only are known.
    pub fn spin(&self) -> Option<f64> {
        match self {
            Self::Minkowski | Self::Text(_) => None,
            Self::Schwarzschild => Some(0.0),
            Self::Kerr { spin } => Some(*spin),
        }
    }

    /// The metric, if it is a text.
    pub fn text(&self) -> Option<&Arc<LineElement>> {
        if let Self::Text(element) = self { Some(element) } else { None }
    }

    /// Whether space goes on behind a throat, under another sky.
    pub fn has_throat(&self) -> bool {
        self.text().is_some_and(|element| element.has_throat())
    }

    /// An observer in it.
    ///
    /// # Errors
    /// If no observer can move so there, or the place is at infinity.
    pub fn observer(&self, place: Place, motion: Motion) -> Result<Eye, ObserverError> {
        match self {
            Self::Text(element) => Eye::in_metric(&Text::new(element), place, motion),
            _ => Eye::new(self.spin(), place, motion),
        }
    }

    /// A piece of a surface in it, as [`Patch`] has it.
    pub fn patch(&self, position: [f64; 3], gradient: [f64; 3], drift: Drift) -> Option<Patch> {
        match self {
            Self::Text(element) => Patch::in_metric(&Text::new(element), position, gradient, drift),
            _ => Patch::new(self.spin(), position, gradient, drift),
        }
    }

    /// Positive where matter can move so, as [`clearance`] has it; NaN where a text has no value.
    pub fn clearance(&self, position: [f64; 3], drift: Drift) -> f64 {
        match self {
            Self::Text(element) => clearance_in_metric(&Text::new(element), position, drift),
            _ => clearance(self.spin(), position, drift),
        }
    }

    /// Whether it is flat.
    pub fn is_flat(&self) -> bool {
        *self == Self::Minkowski
    }
}

/// Who looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer {
    /// Where they are.
    pub place: Place,
    /// How they move; possible at that place.
    pub motion: Motion,
}

/// What the observer's screen shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// How a point of the screen chooses a direction.
    pub kind: ScreenKind,
    /// Angle in radians by which the camera is turned anticlockwise, so the picture clockwise.
    pub roll: f64,
    /// Kerr–Schild Cartesian point that the camera is turned to along a straight line, not the
    /// observer's own place; without it the camera looks along −`e_r` of Boyer–Lindquist. `None` for [`ScreenKind::Impact`].
    pub look_at: Option<[f64; 3]>,
}

/// How a point of the screen chooses a direction. The height is from outer edge to outer edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ScreenKind {
    /// A flat picture.
    Pinhole {
        /// Angle in radians, below π.
        height: f64,
    },
    /// Equal angles take equal lengths.
    Angular {
        /// Angle in radians, at most π.
        height: f64,
    },
    /// The plane of the impact parameters α and β.
    Impact {
        /// Length in M.
        height: f64,
    },
}

/// A thin disk around the hole that turns about +z.
#[derive(Clone, Debug, PartialEq)]
pub struct Disk {
    /// Boyer–Lindquist radius of the inner edge, in M: not below the horizon, less than `outer`.
    pub inner: f64,
    /// Boyer–Lindquist radius of the outer edge, in M.
    pub outer: f64,
    /// Angle in radians between its plane and the equatorial plane.
    pub tilt: f64,
    /// Azimuth in radians at which it rises through the equatorial plane.
    pub node: f64,
    /// What it looks like.
    pub surface: Surface,
    /// Colour of its light, or of the light that a picture's white sends: red, green and blue in
    /// sRGB, 0 to 1.
    pub color: [f64; 3],
    /// Factor on its light.
    pub brightness: f64,
    /// Factor on its opacity, 0 to 1; its light goes down with it.
    pub opacity: f64,
    /// Whether it holds nothing back and sends all of its light.
    pub thin: bool,
    /// The orbits of its matter, where they are needed and there are some.
    pub orbits: Option<Arc<Circular>>,
    /// What of the shift of its light is shown.
    pub shifts: Shifts,
    /// The image orders that are seen, if not all.
    pub orders: Option<Vec<u32>>,
    /// Time of the camera's clock at which a pattern that turns is seen, M.
    pub time: Option<f64>,
}

impl Disk {
    /// Colour temperature of its hottest place in K, if it shines as black bodies do.
    pub fn hottest(&self) -> Option<f64> {
        match &self.surface {
            Surface::Shining { glow: Glow::Blackbody { hottest, correction, .. }, .. } => {
                Some(hottest * correction)
            }
            _ => None,
        }
    }

    /// Whether what is seen of it depends on more of a ray than where it crosses the plane, so that nothing can be
    /// interpolated between rays.
    pub fn needs_rays(&self) -> bool {
        let shines = matches!(self.surface, Surface::Shining { .. });
        shines || !self.shifts.is_none() || self.orders.is_some() || self.time.is_some()
    }
}

/// What a disk looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// A ring of streaks.
    Ring {
        /// Chooses the pattern.
        seed: u64,
    },
    /// A picture.
    Picture {
        /// The file, as seen from the current folder. It existed when the scene was built.
        path: PathBuf,
        /// How it is laid on the disk.
        mapping: Mapping,
    },
    /// Light by physics.
    Shining {
        /// How the flux depends on the radius.
        profile: Profile,
        /// How bright it is at an angle.
        limb: Limb,
        /// Which light is shown.
        glow: Glow,
    },
}

/// A thing in the scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its shape and place, in M, in the Kerr–Schild coordinates in which rays are traced.
    pub shape: Shape,
    /// What its surface does with light.
    pub finish: Finish,
    /// Red, green and blue in sRGB, 0 to 1: its colour, or the filter that its picture is seen through.
    pub color: [f64; 3],
    /// Factor on what a light sends.
    pub brightness: f64,
    /// How the colour changes from place to place.
    pub pattern: ObjectPattern,
    /// How its matter moves; possible at all of its places.
    pub drift: Drift,
}

/// How the colour of a thing changes from place to place. Colours are in sRGB, 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub enum ObjectPattern {
    /// It does not.
    Solid,
    /// Squares in turn.
    Checker {
        /// The other colour.
        second: [f64; 3],
        /// How many there are along each coordinate.
        squares: [u32; 2],
    },
    /// A picture.
    Picture {
        /// The file, as seen from the current folder. It existed when the scene was built.
        path: PathBuf,
    },
    /// The Earth.
    Earth,
    /// Clouds.
    Noise {
        /// The other colour.
        second: [f64; 3],
        /// Size of the largest clouds, M.
        size: f64,
        /// Chooses the pattern.
        seed: u64,
    },
}

/// What is seen where light comes from infinity.
#[derive(Clone, Debug, PartialEq)]
pub struct Sky {
    /// What it looks like.
    pub picture: SkyPicture,
    /// Factor on its light.
    pub brightness: f64,
}

/// What a sky looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyPicture {
    /// Dark.
    Black,
    /// The same everywhere.
    Uniform {
        /// Red, green and blue in sRGB, 0 to 1.
        color: [f64; 3],
    },
    /// From one colour at the horizon to another towards +z.
    Gradient {
        /// Red, green and blue in sRGB, 0 to 1, at the horizon and below.
        horizon: [f64; 3],
        /// Those towards +z.
        zenith: [f64; 3],
    },
    /// Lines of equal θ and of equal φ.
    Grid {
        /// Red, green and blue of the lines in sRGB, 0 to 1.
        color: [f64; 3],
        /// Angle in radians between lines; divides a right angle.
        spacing: f64,
    },
    /// The stars of the catalogue and the Milky Way.
    Stars {
        /// How equatorial coordinates of J2000 stand.
        orientation: Orientation,
    },
    /// A picture of the whole sky.
    Panorama {
        /// The file, as seen from the current folder. It existed when the scene was built.
        path: PathBuf,
        /// How it stands.
        orientation: Orientation,
    },
}

/// How finely and how exactly a picture is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Render {
    /// Width in pixels, 1 to 16384.
    pub width: u32,
    /// Height in pixels, 1 to 16384.
    pub height: u32,
    /// Rays in each pixel, 1 to 65536; width × height × samples is at most 2³⁶.
    pub samples: u32,
    /// Chooses where in the pixels the rays lie.
    pub seed: u64,
    /// Whether rays are spread by chance.
    pub jitter: bool,
    /// What traces the rays; never [`Engine::Auto`].
    pub engine: Engine,
    /// The coordinates in which they are traced.
    pub coordinates: Coordinates,
    /// Which method integrates them.
    pub method: Method,
    /// About the error of a ray's direction in radians, away from the critical curve.
    pub tolerance: f64,
    /// Step in M of the method with fixed steps.
    pub step: f64,
    /// Steps after which a ray is given up.
    pub max_steps: u32,
    /// Crossings of the disk's plane that count, the first met going back from the camera; what lies
    /// behind is seen through the rest.
    pub max_crossings: u32,
    /// How often light is scattered or reflected by things at most.
    pub bounces: u32,
    /// Whether light carries its shift between things, sky and camera, in a scene with things.
    pub shifts: bool,
    /// If pictures are interpolated between rays, the largest error that this shall make: relative for
    /// radii, radians for azimuths and directions.
    pub adaptive: Option<f64>,
    /// Data layers to compute beside the light, each once, in the order of their definition.
    pub layers: Vec<Layer>,
}

/// What traces rays.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Engine {
    /// The closed form where it can draw the scene and no other `method` than "dop853" is asked for; else
    /// the integrator.
    #[default]
    Auto,
    /// The closed form: Kerr and Schwarzschild holes with a disk in the equatorial plane or none, and no things.
    ClosedForm,
    /// Numerical integration.
    Integrator,
}

/// A method of numerical integration.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Method {
    /// Dormand and Prince, order 8, adaptive.
    #[default]
    Dop853,
    /// Tsitouras, order 5, adaptive.
    Tsit5,
    /// The classical Runge–Kutta method, order 4, with steps of a fixed length.
    Rk4,
}

/// What is seen, as headers of FITS and HDF5 files have it.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Its name: 1 to 60 printable characters of ASCII.
    pub name: String,
    /// Right ascension of the picture's middle in degrees, as headers have it.
    pub right_ascension: f64,
    /// Declination of the picture's middle in degrees.
    pub declination: f64,
    /// The time as a modified Julian date.
    pub mjd: f64,
}

/// What picture files show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// How light is shown on a screen.
    pub view: display::Display,
    /// The data layer that is shown instead, if any.
    pub layer: Option<FalseColor>,
    /// Bits of a colour channel.
    pub depth: Depth,
}

impl Display {
    /// What a screen shows of a film.
    pub fn picture(&self, film: &Film) -> Picture {
        self.layer.map_or_else(|| self.view.develop(film), |layer| layer.develop(film))
    }
}
