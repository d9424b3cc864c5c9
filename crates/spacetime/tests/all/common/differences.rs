//! Differences of single rays, to judge derivatives by.

use super::common::engines::outward;
use super::common::{Worst, follow, impact};
use kerrscope_spacetime::closed::{ClosedForm, Impact, NODES, Tables};
use kerrscope_spacetime::geodesic::{Fate, Path, Query};
use kerrscope_spacetime::metric::{Kerr, Metric};
use kerrscope_spacetime::observer::impact_ray;
use kerrscope_spacetime::{Dual, Scalar};
use std::f64::consts::{FRAC_PI_2, PI};

/// a, i, α, β, u = 1/r.
pub type Point = [f64; 5];

pub const NAMES: [&str; 5] = ["a", "i", "α", "β", "u"];

pub fn impact_of<S: Scalar>([spin, inclination, alpha, beta, u]: [S; 5]) -> Impact<S> {
    Impact { spin, inclination, alpha, beta, u }
}

/// Which way the ray sets out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    Inwards,
    Outwards,
}

/// The path that the tracer of single rays finds, its time regularised as if from infinity if `from_infinity`.
pub fn single(way: Way, at: Point, from_infinity: bool) -> Option<Path> {
    let [spin, inclination, alpha, beta, u] = at;
    let inwards = impact_ray(Some(spin), inclination, 1.0 / u, [alpha, beta]).ok()?;
    let ray = match way {
        Way::Inwards => inwards,
        Way::Outwards => outward(spin, 1.0 / u, inclination, [alpha, beta]).turned(-0.3),
    };
    let query = Query { elapsed: true, ..Query::default() };
    let mut path = follow(&ClosedForm::new(spin, NODES, 10_000), &ray, &query);
    if from_infinity && u > 0.0 {
        for crossing in &mut path.crossings {
            crossing.elapsed -= 1.0 / u - 2.0 * (2.0 * u).ln();
        }
    }
    Some(path)
}

/// All numbers of a path: r, φ, elapsed time of each crossing; θ, φ of the direction.
pub fn numbers(path: &Path) -> Vec<f64> {
    let crossings = path.crossings.iter().flat_map(|c| [c.r, c.phi, c.elapsed]);
    crossings.chain(path.direction.into_iter().flatten()).collect()
}

/// The weights of the derivative at 0 from values at these places (Lagrange's interpolation).
pub fn weights(places: &[f64]) -> Vec<f64> {
    let product = |skip: &[usize], f: &dyn Fn(usize) -> f64| {
        (0..places.len()).filter(|k| !skip.contains(k)).map(f).product::<f64>()
    };
    let of = |i: usize| {
        let scale = product(&[i], &|k| places[i] - places[k]);
        let slopes = (0..places.len()).filter(|&k| k != i).map(|k| product(&[i, k], &|l| -places[l]));
        slopes.sum::<f64>() / scale
    };
    (0..places.len()).map(of).collect()
}

/// How far each coordinate may go.
pub fn bounds([_, inclination, alpha, beta, _]: Point) -> [(f64, f64); 5] {
    let mut bounds = [(-1.0, 1.0), (0.0, PI), (-1e9, 1e9), (-1e9, 1e9), (0.0, 1.0)];
    // A camera in the plane meets it at once if it is moved to the other side.
    if inclination == FRAC_PI_2 {
        if beta > 0.0 { bounds[1].1 = FRAC_PI_2 } else { bounds[1].0 = FRAC_PI_2 }
    }
    // Turns over the pole change their sense with α.
    if alpha >= 0.0 {
        bounds[2].0 = 0.0;
    } else {
        bounds[2].1 = 0.0;
    }
    bounds
}

/// The derivatives of all numbers along one coordinate, by differences of eighth order, and how sure
/// they are; none if the ray's nature changes too near.
pub fn differences(way: Way, at: Point, axis: usize, scale: f64) -> Option<Vec<[f64; 2]>> {
    let (low, high) = bounds(at)[axis];
    let from_infinity = at[4] == 0.0;
    let here = numbers(&single(way, at, from_infinity)?);
    let slopes = |h: f64| {
        // Centred, or as near to it as the coordinate's bounds allow.
        let first = (-4..=0).find(|&k| at[axis] + f64::from(k) * h >= low)?;
        let first = (-8..=first).rev().find(|&k| at[axis] + f64::from(k + 8) * h <= high)?;
        let places: Vec<f64> = (first..=first + 8).map(|k| f64::from(k) * h).collect();
        let mut sums = vec![0.0; here.len()];
        for (place, weight) in places.iter().zip(weights(&places)) {
            let mut moved = at;
            moved[axis] += place;
            let found = numbers(&single(way, moved, from_infinity)?);
            if found.len() != here.len() {
                return None;
            }
            for (sum, value) in sums.iter_mut().zip(found) {
                *sum += weight * value;
            }
        }
        Some(sums)
    };
    // The two successive steps that agree best.
    let mut best: Option<Vec<[f64; 2]>> = None;
    let mut before: Option<Vec<f64>> = None;
    for k in 0..7 {
        let now = slopes(0.1 * scale * 0.4f64.powi(k));
        if let (Some(before), Some(now)) = (&before, &now) {
            let pairs: Vec<[f64; 2]> = before.iter().zip(now).map(|(a, b)| [*b, (a - b).abs()]).collect();
            best = Some(match best {
                None => pairs,
                Some(old) => old.iter().zip(&pairs).map(|(a, b)| if b[1] < a[1] { *b } else { *a }).collect(),
            });
        }
        before = now;
    }
    best
}

/// Differences less sure than this, relative to the natural size of a slope, prove nothing.
pub const SURE: f64 = 1e-9;

/// What a comparison found.
#[derive(Default)]
pub struct Verdict {
    /// Values against the single ray's, over what nearness to the critical curve allows.
    values: Worst,
    /// Slopes against differences, relative to their natural size.
    slopes: Worst,
    compared: usize,
    unsure: usize,
}

/// The distance over which things change: relative to that from the critical curve.
pub fn scales(at: Point) -> ([f64; 5], f64) {
    let [spin, inclination, alpha, beta, u] = at;
    let ray = impact(spin, inclination, 1.0 / u, alpha, beta);
    let sensitivity = Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
    let near = 1.0 / sensitivity;
    let b = alpha.hypot(beta).max(0.3);
    ([near, near, near * b, near * b, near / b.max(1.0)], sensitivity)
}

impl Verdict {
    pub fn see(&mut self, tables: &Tables, at: Point) {
        self.see_on(Way::Inwards, tables, at);
    }

    pub fn see_on(&mut self, way: Way, tables: &Tables, at: Point) {
        let Some(path) = single(way, at, false) else { return };
        let (scale, sensitivity) = scales(at);
        // Outside 1 % of the critical curve.
        if sensitivity > 50.0 {
            return;
        }
        let ray = impact_of(Dual::variables(at));
        let dual = match way {
            Way::Inwards => ray.trace(tables, 8),
            Way::Outwards => ray.trace_outwards(tables, 8),
        };
        let label = |what: &str| format!("{what} {at:?} {path:?}");
        assert_eq!(dual.escaped, path.fate == Fate::Escaped, "{}", label("escaped"));
        assert_eq!(dual.captured, path.fate == Fate::Captured, "{}", label("captured"));
        assert_eq!(dual.crossings.len(), path.crossings.len(), "{}", label("crossings"));
        let mut found: Vec<Dual<f64, 5>> = Vec::new();
        let mut sizes = Vec::new();
        for crossing in &dual.crossings {
            found.extend([crossing.r, crossing.phi, crossing.elapsed]);
            let r = crossing.r.value;
            sizes.extend([r, 1.0 + r * r * at[4].max(1e-3), r + 1.0 / at[4].max(1e-2)]);
        }
        if dual.escaped {
            found.extend(dual.direction);
            sizes.extend([1.0, 1.0]);
        }
        for ((dual, single), size) in found.iter().zip(numbers(&path)).zip(&sizes) {
            // 1/r is as exact as anything: far away r is less so.
            let size = size * (1.0 + 0.01 * size);
            let error = (dual.value - single).abs() / (size * sensitivity);
            self.values.see(error, || label(&format!("{dual:?} {single}")));
        }
        for axis in 0..5 {
            let Some(differences) = differences(way, at, axis, scale[axis]) else {
                self.unsure += found.len();
                continue;
            };
            for (k, (dual, [slope, doubt])) in found.iter().zip(differences).enumerate() {
                let size = slope.abs() + sizes[k] / scale[axis];
                self.compared += 1;
                if !(doubt < SURE * size) {
                    self.unsure += 1;
                    continue;
                }
                let error = (dual.gradient[axis] - slope).abs() / size;
                self.slopes.see(error, || {
                    label(&format!(
                        "number {k} by {}: {} {slope} ± {doubt:e}, natural {size}",
                        NAMES[axis], dual.gradient[axis]
                    ))
                });
            }
        }
    }

    #[track_caller]
    pub fn judge(&self, what: &str, at_least: usize, values: f64, slopes: f64) {
        println!("{what}: {} slopes, {} unsure", self.compared, self.unsure);
        assert!(self.compared >= at_least, "{what}: {} compared", self.compared);
        assert!(self.unsure * 20 < self.compared, "{what}: {} unsure of {}", self.unsure, self.compared);
        self.values.below(values, what);
        self.slopes.below(slopes, what);
    }
}
