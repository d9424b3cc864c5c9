//! Coordinates in which parameters are looked for: without bounds, and smooth where parameters are not.
//!
//! A number between two bounds goes through the logistic function, a positive one through its logarithm, another one is divided by its
//! size. Inclination i and position angle χ are those of an axis in space: v = 2 tan(i/2) (cos χ, sin χ), the stereographic projection
//! from the direction away from the observer, so that a disk seen face-on is a place like any other.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::model::{Freedom, Parameter};
use crate::prior::Prior;

/// A coordinate, or two.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Between bounds.
    Between(f64, f64),
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

/// ∂parameter/∂coordinate, for each coordinate the parameters that it changes.
type Slopes = Vec<Vec<(usize, f64)>>;

/// Parameters as functions of coordinates.
#[derive(Clone, Debug)]
pub struct Place {
    /// All parameters, fixed ones too.
    pub values: Vec<f64>,
    /// For each coordinate, the parameters that it changes and by how much.
    pub slopes: Slopes,
    /// The logarithm of the prior's density over the coordinates, but for a constant; with its gradient, and numbers near its
    /// negative curvature along each.
    pub prior: f64,
    /// Its gradient.
    pub gradient: Vec<f64>,
    /// About its negative curvature along each coordinate, at least a little above 0.
    pub curvature: Vec<f64>,
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
        let mut index = 0;
        for sought in &self.sought {
            if let (true, Kind::BetweenLogs(low, high)) = (sought.distance, sought.kind) {
                return Some(Reciprocal { index, low, high });
            }
            index += if sought.kind == Kind::Axis { 2 } else { 1 };
        }
        None
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
        let mut at = 0;
        for sought in &self.sought {
            if sought.kind == Kind::Turn {
                place[at] -= TAU * ((place[at] - other[at]) / TAU).round();
            }
            at += if sought.kind == Kind::Axis { 2 } else { 1 };
        }
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

/// ln of an angle's prior, its derivative and negative curvature per degree: a Gaussian goes around, all else is alike.
fn turned(prior: &Prior, value: f64) -> [f64; 3] {
    match prior {
        Prior::Normal(mean, _) => prior.log(mean + (value - mean + 180.0).rem_euclid(360.0) - 180.0),
        _ => [0.0; 3],
    }
}

impl Place {
    fn one(&mut self, k: usize, value: f64, slope: f64, prior: Prior, jacobian: [f64; 3]) {
        self.values[k] = value;
        let [log, rate, bend] = prior.log(value);
        self.slopes.push(vec![(k, slope)]);
        self.prior += log + jacobian[0];
        self.gradient.push(rate * slope + jacobian[1]);
        self.curvature.push((bend * slope * slope + jacobian[2]).max(1e-6));
    }

    /// With ρ = |v|: i = 2 atan(ρ/2), sin i di dχ = d²v/(1 + ρ²/4)², so that what is not isotropic of the prior remains.
    fn axis(&mut self, k: usize, [x, y]: [f64; 2], [prior, other]: [Prior; 2]) {
        let square = x * x + y * y;
        let reach = square.sqrt();
        let inclination = 2.0 * (0.5 * reach).atan();
        self.values[k] = inclination.to_degrees();
        self.values[k + 1] = y.atan2(x).to_degrees().rem_euclid(360.0);
        let per = (1.0 + 0.25 * square).recip();
        let [cos, sin] = if reach > 0.0 { [x / reach, y / reach] } else { [1.0, 0.0] };
        let (along, around) = (per.to_degrees(), reach.max(1e-9).recip().to_degrees());
        self.slopes.push(vec![(k, along * cos), (k + 1, -around * sin)]);
        self.slopes.push(vec![(k, along * sin), (k + 1, around * cos)]);
        let (mut log, mut rate) = (2.0 * per.ln(), -per * reach);
        let [low, high] = prior.range([0.0, 180.0]);
        // Outside of its range it falls steeply instead of ending.
        let beyond = (low - self.values[k]).max(self.values[k] - high).max(0.0);
        let side = if self.values[k] < low { 1.0 } else { -1.0 };
        log -= 50.0 * beyond * beyond;
        rate += 100.0 * beyond * side * along;
        if !matches!(prior, Prior::Isotropic(..)) {
            let [own, slope, _] = prior.log(self.values[k]);
            // Per solid angle: divided by sin i.
            let (sin_i, cos_i) = inclination.sin_cos();
            let sin_i = sin_i.max(1e-9);
            log += own - sin_i.ln();
            rate += slope * along - cos_i / sin_i * per;
        }
        let [own, slope, bend] = turned(&other, self.values[k + 1]);
        log += own;
        let turn = slope * around;
        self.prior += log;
        self.gradient.extend([rate * cos - turn * sin, rate * sin + turn * cos]);
        let stiff = bend * around * around;
        self.curvature.extend([per + stiff * sin * sin, per + stiff * cos * cos]);
    }

    /// Derivatives with respect to coordinates from those with respect to parameters.
    pub fn chain(&self, derivatives: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let column = |slopes: &Vec<(usize, f64)>| {
            let mut sum = vec![0.0; derivatives.first().map_or(0, Vec::len)];
            for (parameter, slope) in slopes {
                sum.iter_mut().zip(&derivatives[*parameter]).for_each(|(s, d)| *s += slope * d);
            }
            sum
        };
        self.slopes.iter().map(column).collect()
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
        ];
        for inclination in [Prior::Isotropic(0.0, 180.0), Prior::Normal(50.0, 10.0)] {
            let freedoms = [
                Freedom::Free(Prior::Normal(0.3, 0.2)),
                Freedom::Free(inclination),
                Freedom::Free(Prior::Normal(230.0, 15.0)),
                Freedom::Free(Prior::LogUniform(0.2, 0.9)),
                Freedom::Free(Prior::Uniform(f64::NEG_INFINITY, f64::INFINITY)),
            ];
            let coordinates = Coordinates::new(&parameters, &freedoms, &[1.0, 1.0, 1.0, 1.0, 40.0]);
            let values = [0.4, 70.0, 250.0, 0.3, 100.0];
            let q = coordinates.of(&values);
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
