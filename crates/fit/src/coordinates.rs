//! Coordinates in which parameters are looked for: without bounds, and smooth where parameters are not.
//!
//! A number between two bounds goes through the logistic function, a positive one through its logarithm, another one is divided by its
//! size. A blur counts by its square: at 0, where it is bounded, its coordinate goes on to the mirror image. Inclination i and
//! position angle χ are those of an axis in space: v = 2 tan(i/2) (cos χ, sin χ), the stereographic projection from the direction away
//! from the observer, so that a disk seen face-on is a place like any other.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::model::{Freedom, Parameter};
use crate::place::{Place, turned};
use crate::prior::Prior;

/// A coordinate, or two.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Between bounds.
    Between(f64, f64),
    /// From 0 to a bound, the size of a number between both signs of it.
    Even(f64),
    /// Between positive bounds, in the logarithm.
    BetweenLogs(f64, f64),
    /// Above a bound.
    Above(f64),
    /// Anywhere, of about this size.
    Anywhere(f64),
    /// An angle in degrees.
    Turn,
    /// The first of both of an axis: the inclination. The second follows.
    Axis,
}

/// A parameter that is looked for.
#[derive(Clone, Copy, Debug)]
struct Sought {
    parameter: usize,
    prior: Prior,
    kind: Kind,
    /// What is assumed of the second of an axis.
    other: Prior,
    /// Whether it is the observer's distance.
    distance: bool,
}

/// 1/r as a function of the coordinate of r.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reciprocal {
    /// Which coordinate.
    pub index: usize,
    low: f64,
    high: f64,
}

/// The coordinates of a fit.
#[derive(Clone, Debug)]
pub struct Coordinates {
    start: Vec<f64>,
    sought: Vec<Sought>,
}

impl Reciprocal {
    /// 1/r and its derivative.
    pub fn at(&self, q: f64) -> [f64; 2] {
        let [value, slope] = between_logs(q, self.low, self.high);
        [value.recip(), -slope * value.powi(-2)]
    }

    /// The coordinate of a value of it; none at the bounds and beyond.
    pub fn of(&self, u: f64) -> Option<f64> {
        let share = -(u * self.low).ln() / (self.high / self.low).ln();
        (share > 1e-6 && share < 1.0 - 1e-6).then(|| (share / (1.0 - share)).ln())
    }
}

/// A value between positive bounds, and its derivative.
fn between_logs(q: f64, low: f64, high: f64) -> [f64; 2] {
    let (share, width) = ((1.0 + (-q).exp()).recip(), (high / low).ln());
    let value = low * (width * share).exp();
    [value, value * width * share * (1.0 - share)]
}

impl Coordinates {
    /// For parameters and what is known of each. `sizes` are about how far off a parameter without bounds may be.
    pub fn new(parameters: &[Parameter], freedoms: &[Freedom], sizes: &[f64]) -> Self {
        let is_free = |name: &str| {
            parameters
                .iter()
                .position(|p| p.name == name)
                .is_some_and(|k| matches!(freedoms[k], Freedom::Free(_)))
        };
        let axis = is_free("inclination") && is_free("position_angle");
        let mut start = Vec::new();
        let mut sought = Vec::new();
        for (k, (parameter, freedom)) in parameters.iter().zip(freedoms).enumerate() {
            let prior = match freedom {
                Freedom::Fixed(value) => {
                    start.push(*value);
                    continue;
                }
                Freedom::Free(prior) => *prior,
            };
            start.push(f64::NAN);
            let [low, high] = prior.range(parameter.bounds);
            let kind = match parameter.name {
                "inclination" if axis => Kind::Axis,
                "position_angle" if axis => continue,
                "position_angle" => Kind::Turn,
                _ if matches!(prior, Prior::LogUniform(..)) => Kind::BetweenLogs(low, high),
                "blur" if low == 0.0 && high.is_finite() => Kind::Even(high),
                _ if low.is_finite() && high.is_finite() => Kind::Between(low, high),
                _ if low.is_finite() => Kind::Above(low),
                _ => Kind::Anywhere(match prior {
                    Prior::Normal(_, deviation) => deviation,
                    _ => sizes[k].abs().max(f64::MIN_POSITIVE),
                }),
            };
            let other = match (kind, freedoms.get(k + 1)) {
                (Kind::Axis, Some(Freedom::Free(prior))) => *prior,
                _ => Prior::Uniform(0.0, 360.0),
            };
            let distance = parameter.name == "distance";
            sought.push(Sought { parameter: k, prior, kind, other, distance });
        }
        Self { start, sought }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.sought.iter().map(|s| if s.kind == Kind::Axis { 2 } else { 1 }).sum()
    }

    /// Numbers of the parameters that are looked for.
    pub fn free(&self) -> Vec<usize> {
        let both = |s: &Sought| {
            if s.kind == Kind::Axis { vec![s.parameter, s.parameter + 1] } else { vec![s.parameter] }
        };
        self.sought.iter().flat_map(both).collect()
    }

    /// The observer's distance, if it is looked for between two others.
    pub fn distance(&self) -> Option<Reciprocal> {
        self.numbered().find_map(|(index, sought)| match sought.kind {
            Kind::BetweenLogs(low, high) if sought.distance => Some(Reciprocal { index, low, high }),
            _ => None,
        })
    }

    /// Which go with the logistic function of a share of the way between two bounds, but for the observer's distance.
    pub fn bounded(&self) -> Vec<usize> {
        let bounded = |sought: &Sought| match sought.kind {
            Kind::Between(..) | Kind::Even(_) => true,
            Kind::BetweenLogs(..) => !sought.distance,
            _ => false,
        };
        self.numbered().filter(|(_, sought)| bounded(sought)).map(|(k, _)| k).collect()
    }

    /// The coordinate that goes on to its mirror image at 0, if one does.
    pub fn even(&self) -> Option<usize> {
        self.numbered().find(|(_, sought)| matches!(sought.kind, Kind::Even(_))).map(|(k, _)| k)
    }

    /// Coordinates of what is looked for, the first of both of an axis.
    fn numbered(&self) -> impl Iterator<Item = (usize, &Sought)> {
        self.sought.iter().scan(0, |next, sought| {
            let k = *next;
            *next += if sought.kind == Kind::Axis { 2 } else { 1 };
            Some((k, sought))
        })
    }

    /// Coordinates of parameters, those at or beyond their bounds a little within.
    pub fn of(&self, values: &[f64]) -> Vec<f64> {
        let mut coordinates = Vec::new();
        for sought in &self.sought {
            let value = values[sought.parameter];
            match sought.kind {
                Kind::Between(low, high) => {
                    let share = ((value - low) / (high - low)).clamp(1e-6, 1.0 - 1e-6);
                    coordinates.push((share / (1.0 - share)).ln());
                }
                Kind::Even(high) => {
                    let share = (0.5 * (1.0 + value / high)).clamp(0.5, 1.0 - 1e-6);
                    coordinates.push((share / (1.0 - share)).ln());
                }
                Kind::BetweenLogs(low, high) => {
                    let share = ((value / low).ln() / (high / low).ln()).clamp(1e-6, 1.0 - 1e-6);
                    coordinates.push((share / (1.0 - share)).ln());
                }
                Kind::Above(low) => coordinates.push((value - low).max(1e-300).ln()),
                Kind::Anywhere(size) => coordinates.push(value / size),
                Kind::Turn => coordinates.push(value.to_radians()),
                Kind::Axis => {
                    let (sin, cos) = values[sought.parameter + 1].to_radians().sin_cos();
                    let reach = 2.0 * (0.5 * value.clamp(0.0, 179.9).to_radians()).tan();
                    coordinates.extend([reach * cos, reach * sin]);
                }
            }
        }
        coordinates
    }

    /// Takes whole turns off a place, so that its angles lie within half a turn of another's.
    pub fn near(&self, place: &mut [f64], other: &[f64]) {
        for (k, _) in self.numbered().filter(|(_, sought)| sought.kind == Kind::Turn) {
            place[k] -= TAU * ((place[k] - other[k]) / TAU).round();
        }
    }

    /// A place with what has two signs on the side of another's.
    pub fn beside(&self, place: &[f64], other: &[f64]) -> Vec<f64> {
        let mut place = place.to_vec();
        if let Some(k) = self.even().filter(|k| place[*k] * other[*k] < 0.0) {
            place[k] = -place[k];
        }
        place
    }

    /// Parameters at coordinates.
    pub fn at(&self, coordinates: &[f64]) -> Place {
        let mut place = Place {
            values: self.start.clone(),
            slopes: Vec::new(),
            prior: 0.0,
            gradient: Vec::new(),
            curvature: Vec::new(),
        };
        let mut next = coordinates.iter().copied();
        let mut take = || next.next().unwrap_or(0.0);
        for sought in &self.sought {
            let k = sought.parameter;
            match sought.kind {
                Kind::Between(low, high) => {
                    let share = (1.0 + (-take()).exp()).recip();
                    let slope = (high - low) * share * (1.0 - share);
                    let value = low + (high - low) * share;
                    let both = (share * (1.0 - share)).max(1e-300);
                    let jacobian = [both.ln(), 1.0 - 2.0 * share, 2.0 * both];
                    place.one(k, value, slope, sought.prior, jacobian);
                }
                Kind::Even(high) => {
                    let share = (1.0 + (-take()).exp()).recip();
                    let signed = high * (2.0 * share - 1.0);
                    let both = (share * (1.0 - share)).max(1e-300);
                    let slope = 2.0 * high * both * signed.signum();
                    let jacobian = [both.ln(), 1.0 - 2.0 * share, 2.0 * both];
                    place.one(k, signed.abs(), slope, sought.prior, jacobian);
                }
                Kind::BetweenLogs(low, high) => {
                    let q = take();
                    let [value, slope] = between_logs(q, low, high);
                    let share = (1.0 + (-q).exp()).recip();
                    let both = (share * (1.0 - share)).max(1e-300);
                    let jacobian = [(value * both).ln(), slope / value + 1.0 - 2.0 * share, 2.0 * both];
                    place.one(k, value, slope, sought.prior, jacobian);
                }
                Kind::Above(low) => {
                    let q = take();
                    let rise = q.clamp(-600.0, 600.0).exp();
                    place.one(k, low + rise, rise, sought.prior, [q, 1.0, 0.0]);
                }
                Kind::Anywhere(size) => place.one(k, take() * size, size, sought.prior, [0.0; 3]),
                Kind::Turn => {
                    let value = take().to_degrees().rem_euclid(360.0);
                    let degree = 1f64.to_degrees();
                    place.one(k, value, degree, Prior::Uniform(0.0, 360.0), [0.0; 3]);
                    let [log, rate, bend] = turned(&sought.prior, value);
                    place.prior += log;
                    if let (Some(slope), Some(curve)) =
                        (place.gradient.last_mut(), place.curvature.last_mut())
                    {
                        *slope += rate * degree;
                        // An angle of which nothing is known has the variance π²/3.
                        *curve = (*curve + bend * degree * degree).max(3.0 / PI.powi(2));
                    }
                }
                Kind::Axis => place.axis(k, [take(), take()], [sought.prior, sought.other]),
            }
        }
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Slopes and gradients against differences, and there and back.
    #[test]
    fn slopes_are_differences() {
        let parameter = |name, bounds| Parameter {
            name,
            unit: "",
            meaning: "",
            bounds,
            pixels: 0,
            usual: Freedom::Fixed(0.0),
        };
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
        let parameters = [
            parameter("spin", [-0.998, 0.998]),
            parameter("inclination", [0.0, 180.0]),
            parameter("position_angle", [0.0, 360.0]),
            parameter("scale", [0.0, f64::INFINITY]),
            parameter("flux", everywhere),
            parameter("blur", [0.0, 8.0]),
        ];
        for inclination in [Prior::Isotropic(0.0, 180.0), Prior::Normal(50.0, 10.0)] {
            let freedoms = [
                Freedom::Free(Prior::Normal(0.3, 0.2)),
                Freedom::Free(inclination),
                Freedom::Free(Prior::Normal(230.0, 15.0)),
                Freedom::Free(Prior::LogUniform(0.2, 0.9)),
                Freedom::Free(Prior::Uniform(f64::NEG_INFINITY, f64::INFINITY)),
                Freedom::Free(Prior::Uniform(0.0, 3.0)),
            ];
            let coordinates = Coordinates::new(&parameters, &freedoms, &[1.0, 1.0, 1.0, 1.0, 40.0, 1.0]);
            let values = [0.4, 70.0, 250.0, 0.3, 100.0, 0.7];
            let q = coordinates.of(&values);
            // The other side of a blur of 0 is its mirror image.
            let mut mirrored = q.clone();
            mirrored[5] = -q[5];
            let [there, here] = [&mirrored, &q].map(|q| coordinates.at(q));
            assert!((there.values[5] - 0.7).abs() < 1e-12 && (there.prior - here.prior).abs() < 1e-12);
            assert_eq!(coordinates.beside(&mirrored, &q), q);
            // Nothing lies beyond a prior's ends, however far one goes.
            for far in [-30.0, 30.0] {
                let mut q = q.clone();
                q[3] = far;
                let scale = coordinates.at(&q).values[3];
                assert!((0.2 - 1e-9..=0.9 + 1e-9).contains(&scale), "{scale}");
            }
            let here = coordinates.at(&q);
            for (value, back) in values.iter().zip(&here.values) {
                assert!((value - back).abs() < 1e-9 * value.abs());
            }
            for c in 0..coordinates.count() {
                let moved = |h: f64| {
                    let mut q = q.clone();
                    q[c] += h;
                    coordinates.at(&q)
                };
                let (high, low) = (moved(1e-5), moved(-1e-5));
                assert!(((high.prior - low.prior) / 2e-5 - here.gradient[c]).abs() < 1e-7, "{c}");
                for (k, slope) in &here.slopes[c] {
                    assert!(
                        ((high.values[*k] - low.values[*k]) / 2e-5 - slope).abs()
                            < 1e-6 * slope.abs().max(1.0)
                    );
                }
            }
        }
    }
}
