//! A disk in a spacetime given as text as the light of a picture: any number in the text may be free.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use super::picture::{Fineness, Image, Painter, Setting, Stand};
use super::ratio::{Base, Critical, Moved, Sought};
use super::screen::Projection;
use super::sight::Sight;
use super::source::Kind;
use super::spacetime::Spacetime;
use super::tabulated::{Changing, Neighbours, Tabulated, difference};
use super::theory::{SPIN, Theory};
use crate::model::{Cancelled, Freedom, Parameter, Prediction, Source, Unpredictable};
use crate::prior::Prior;

/// An opaque disk on circular geodesics about +z, in the light of all frequencies, I = g⁴F/π.
pub struct TextDisk {
    theory: Arc<Theory>,
    kind: Kind,
    painter: Painter,
    /// Names of the parameters of which derivatives are wanted; all if there are none.
    free: Vec<String>,
    light: Light,
}

/// How light is followed.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Light {
    /// In the metric itself.
    Own,
    /// As around the Kerr hole of the same spin: the disk alone is the metric's. Fast, to look around with.
    Kerr,
}

/// Image orders that are drawn: the next is e^π times thinner again.
const ORDERS: usize = 3;

/// Starts that are tried.
const STARTS: usize = 12;

/// The step of a metric's parameter of size 1, and those in inclination and distance: differences of both sides are in error by their
/// squares.
const STEP: f64 = 2e-3;
const TURN: f64 = 5e-4;
const AWAY: f64 = 1e-2;

/// The radius out to which a disk without an outer edge is known.
const FAR: f64 = 2600.0;

/// Where the metric's own parameters end, those of the picture begin in this order.
const INCLINATION: usize = 0;
const DISTANCE: usize = 5;
const COMMON: usize = 8;

impl TextDisk {
    /// Of a theory; derivatives are wanted of the `free` parameters, or of all.
    pub fn new(
        theory: Arc<Theory>,
        kind: Kind,
        projection: Projection,
        fineness: Fineness,
        (light, free): (Light, Vec<String>),
    ) -> Self {
        let fineness = Fineness { orders: fineness.orders.min(ORDERS), radial: true, ..fineness };
        Self { theory, kind, painter: Painter::new(projection, true, fineness), free, light }
    }

    fn is_free(&self, name: &str) -> bool {
        self.free.is_empty() || self.free.iter().any(|free| free == name)
    }

    /// Numbers of the metric's parameters of which derivatives are wanted.
    fn sought(&self) -> Vec<usize> {
        let names = self.theory.parameters().iter().enumerate();
        names.filter(|(_, (name, _))| self.is_free(name)).map(|(k, _)| k).collect()
    }

    fn setting(&self, spin: f64, common: &[f64], index: f64, size: [usize; 2]) -> Setting {
        let profile = self.kind.profile(index);
        Setting::of(spin, std::array::from_fn(|k| common[k]), profile, size)
    }

    /// The picture and its derivatives with respect to all parameters, in their order.
    fn picture(&self, values: &[f64], size: [usize; 2], derivatives: bool) -> Result<Prediction, String> {
        let own = self.theory.parameters().len();
        let (metric, common) = values.split_at(own);
        let index = common.get(COMMON).copied().unwrap_or_default();
        let outer = if common[7].is_finite() { 1.01 * common[7] } else { FAR };
        let here = self.theory.at(metric, outer)?;
        let setting = self.setting(here.spin, common, index, size);
        let sought = if derivatives { self.sought() } else { Vec::new() };
        let near: Vec<Near> = sought.iter().map(|k| Near::new(&self.theory, metric, *k, outer)).collect();
        let scene = Scene { here: &here, setting: &setting, near: &near };
        let [turning, away] = ["inclination", "distance"].map(|name| derivatives && self.is_free(name));
        let images = match self.light {
            Light::Own => scene.images(&self.painter, turning, away),
            Light::Kerr => scene.sketches(&self.painter),
        };
        let images = images.map_err(|_| "its light".to_owned())?;
        let profile = setting.profile;
        let ends = Stand::new(&setting, (here.isco, 0.0), 0.0).ends();
        let neighbours: Vec<Neighbours<'_>> = near.iter().map(Near::neighbours).collect();
        let matter = Tabulated::new(&here, &neighbours, profile, ends);
        let mut prediction = Prediction::default();
        let mut columns = vec![vec![0.0; size[0] * size[1]]; values.len()];
        // A picture has room for one of the metric's parameters: for each another one is drawn.
        for pass in 0..near.len().max(1) {
            let (isco_rate, turn) = near.get(pass).map_or((0.0, 0.0), |near| near.rates(&here));
            let stand = Stand::new(&setting, (here.isco, isco_rate), turn);
            let light = Changing { matter: &matter, parameter: (pass < near.len()).then_some(pass) };
            let drawn: Vec<Image> = images.iter().map(|image| image.pass(pass, near.len())).collect();
            let canvas = self.painter.paint(&stand, (&light, scene.lambda(&stand)?), &drawn, derivatives);
            let channel = |channel: usize, factor: f64| -> Vec<f64> {
                canvas.pixels().iter().map(|pixel| factor * pixel[channel]).collect()
            };
            if let Some(k) = sought.get(pass) {
                columns[*k] = channel(1, 1.0);
            }
            if pass == 0 {
                prediction.values = channel(0, 1.0);
                if derivatives {
                    let degree = 1f64.to_radians();
                    let factor = -common[DISTANCE].powi(-2);
                    let channels = [
                        (2, degree),
                        (10, degree),
                        (7, 1.0),
                        (8, 1.0),
                        (9, 1.0),
                        (3, factor),
                        (4, 1.0),
                        (5, 1.0),
                        (6, 1.0),
                    ];
                    for (column, (at, factor)) in columns[own..].iter_mut().zip(channels) {
                        *column = channel(at, factor);
                    }
                }
            }
        }
        if derivatives {
            prediction.derivatives = columns;
        }
        Ok(prediction)
    }
}

/// Spacetimes next to one in a parameter.
struct Near {
    sides: [Option<Spacetime>; 2],
    step: f64,
}

impl Near {
    fn new(theory: &Theory, metric: &[f64], parameter: usize, outer: f64) -> Self {
        let written = theory.parameters()[parameter].1.abs();
        let step = STEP * if written > 0.0 { written } else { 1.0 };
        let sides = [-step, step].map(|step| {
            let mut moved = metric.to_vec();
            moved[parameter] += step;
            theory.at(&moved, outer).ok()
        });
        Self { sides, step }
    }

    fn neighbours(&self) -> Neighbours<'_> {
        Neighbours { sides: self.sides.each_ref().map(Option::as_ref), step: self.step }
    }

    /// What the radius of the last stable orbit and the spin change by.
    fn rates(&self, here: &Spacetime) -> (f64, f64) {
        let pair = |spacetime: &Spacetime| [spacetime.isco, spacetime.spin];
        let sides = self.sides.each_ref().map(|side| side.as_ref().map(pair));
        difference(sides, || Some(pair(here)), self.step)
            .map_or((0.0, 0.0), |(from, to, width)| ((to[0] - from[0]) / width, (to[1] - from[1]) / width))
    }
}

/// A disk, and the spacetimes next to its own.
struct Scene<'a> {
    here: &'a Spacetime,
    setting: &'a Setting,
    near: &'a [Near],
}

/// The image of an order, and what it changes by with each of the metric's parameters.
struct Changed {
    image: Image,
    drifts: Vec<Vec<f64>>,
}

impl Changed {
    /// The image with the derivatives in one of the parameters as those in the first of the hole's.
    fn pass(&self, pass: usize, count: usize) -> Image {
        let mut nodes = self.image.nodes.clone();
        if pass < count {
            for (value, drift) in nodes.values.iter_mut().zip(&self.drifts[pass]) {
                value[1] = *drift;
            }
        }
        self.image.replaced(nodes, self.image.ends.clone())
    }
}

impl Scene<'_> {
    fn view(&self) -> (f64, f64) {
        let i = self.setting.inclination;
        (if i > FRAC_PI_2 { PI - i } else { i }, self.setting.u)
    }

    /// λ₀ and λ₁.
    fn lambda(&self, stand: &Stand<'_>) -> Result<[f64; 2], String> {
        Sight::new(self.here, stand.view.inclination, stand.view.u)
            .map(|sight| sight.lambda)
            .map_err(|_| "its observer".to_owned())
    }

    /// The images of all orders as if light went around the Kerr hole of the same spin.
    fn sketches(&self, painter: &Painter) -> Result<Vec<Changed>, super::Unseen> {
        let stand = Stand::new(self.setting, (self.here.isco, 0.0), 1.0);
        let sketch = |order: usize| {
            let image = painter.image(&stand, order, true)?;
            let drift = |near: &Near| {
                let turn = near.rates(self.here).1;
                image.nodes.values.iter().map(|value| turn * value[1]).collect()
            };
            let drifts = self.near.iter().map(drift).collect();
            Ok(Changed { image, drifts })
        };
        painter.orders().map(sketch).collect()
    }

    /// The images of all orders, with derivatives in inclination and distance if these are asked for; else Kerr's stand for them.
    fn images(&self, painter: &Painter, turning: bool, away: bool) -> Result<Vec<Changed>, super::Unseen> {
        let (inclination, u) = self.view();
        let sight = Sight::new(self.here, inclination, u)?;
        let hole = Stand::new(self.setting, super::picture::last_stable_orbit(self.here.spin), 1.0);
        let stand = Stand::new(self.setting, (self.here.isco, 0.0), 0.0);
        // Neighbours in each of the metric's parameters, in inclination and in 1/r.
        let mut moved: Vec<Moved> = Vec::new();
        for near in self.near {
            let sides = near.sides.each_ref();
            let sides = sides.map(|side| Sight::new(side.as_ref()?, inclination, u).ok());
            moved.push(Moved { sides, step: near.step, kerr: (0, near.rates(self.here).1) });
        }
        if turning {
            let above = |i: f64| (i < FRAC_PI_2).then(|| Sight::new(self.here, i, u).ok())?;
            let sides = [above(inclination - TURN), above(inclination + TURN)];
            moved.push(Moved { sides, step: TURN, kerr: (1, 1.0) });
        }
        if away {
            let step = AWAY * u;
            let sides = [u - step, u + step].map(|u| Sight::new(self.here, inclination, u).ok());
            moved.push(Moved { sides, step, kerr: (2, 1.0) });
        }
        let mut before: Option<Critical> = None;
        let mut images = Vec::new();
        for order in painter.orders() {
            let base = painter.image(&hole, order, true)?;
            let ends = stand.outers(order, base.nodes.directions);
            let found = Sought {
                order,
                base: Base { view: &hole.view, nodes: &base.nodes, ends: (hole.inner, &base.ends) },
                sight: &sight,
                ends: (stand.inner, &ends),
                moved: &moved,
                before: before.as_ref(),
            }
            .find()?;
            before = Some(found.critical);
            let (mut nodes, mut drifts) = (found.nodes, found.drifts);
            let rest = drifts.split_off(self.near.len());
            for (drift, moved) in rest.iter().zip(&moved[self.near.len()..]) {
                for (value, drift) in nodes.values.iter_mut().zip(drift) {
                    value[1 + moved.kerr.0] = *drift;
                }
            }
            images.push(Changed { image: base.replaced(nodes, ends), drifts });
        }
        Ok(images)
    }
}

impl Source for TextDisk {
    fn parameters(&self) -> Vec<Parameter> {
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
        let own = self.theory.parameters().iter().map(|(name, value)| {
            let spin = *name == SPIN;
            Parameter {
                name,
                unit: "",
                meaning: if spin { "a, the disk turning about +z" } else { "a number of the metric" },
                bounds: if spin { [-0.998, 0.998] } else { everywhere },
                pixels: 0,
                usual: if spin {
                    Freedom::Free(Prior::Uniform(-0.998, 0.998))
                } else {
                    Freedom::Fixed(*value)
                },
            }
        });
        let parameters = own.collect::<Vec<_>>();
        // What the picture has besides is as around a Kerr hole, but that the observer is not at infinity.
        let disk = super::Disk::new(self.kind, true, Projection::Angular, Fineness::SKETCH);
        let common = disk.parameters().into_iter().filter(|p| p.name != SPIN).map(|mut parameter| {
            if parameter.name == "distance" {
                parameter.bounds[1] = parameter.bounds[1].min(1e5);
                // Its derivative costs two more pictures.
                parameter.usual = Freedom::Fixed(1000.0);
            }
            parameter
        });
        parameters.into_iter().chain(common).collect()
    }

    fn draw(&self, values: &[f64], size: [usize; 2], derivatives: bool) -> Result<Prediction, Unpredictable> {
        let own = self.theory.parameters();
        let unseen = |reason: &str| {
            let numbers: Vec<String> =
                own.iter().zip(values).map(|((name, _), value)| format!("{name} {value:.4}")).collect();
            let rest = &values[own.len()..];
            Unpredictable(format!(
                "a disk of {}, seen from {:.3}°, {} M away: {reason}",
                numbers.join(", "),
                rest[INCLINATION],
                rest[DISTANCE]
            ))
        };
        let prediction = self.picture(values, size, derivatives).map_err(|reason| unseen(&reason))?;
        if prediction.values.iter().all(|value| value.is_finite()) {
            Ok(prediction)
        } else {
            Err(unseen("some of it is no number"))
        }
    }

    fn starts(&self, values: &[f64], size: [usize; 2], cancelled: Cancelled<'_>) -> Vec<Vec<f64>> {
        let disk = super::Disk::new(self.kind, true, Projection::Angular, Fineness::SKETCH);
        let names = disk.parameters();
        disk.starts(values, size, cancelled)
            .into_iter()
            .take(STARTS)
            .map(|start| {
                let at = |name: &str| names.iter().position(|p| p.name == name).map(|k| start[k]);
                let own = self.theory.parameters().iter();
                let mut begin: Vec<f64> = own.map(|(name, value)| at(name).unwrap_or(*value)).collect();
                begin.extend(
                    names.iter().zip(&start).filter(|(p, _)| p.name != SPIN).map(|(_, value)| *value),
                );
                begin
            })
            .collect()
    }
}
