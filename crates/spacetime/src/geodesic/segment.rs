//! A piece of a ray, as what stands in its way sees it.

use super::dense::Dense;
use crate::tensor::Vec3;

/// A piece of a ray in Cartesian coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Segment {
    /// All of a straight ray.
    Line(Line),
    /// A step of a bent one.
    Curve(Curve),
}

/// A straight ray x = origin + d direction, from d = `start` on without end. Places on it are told by d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point of the line, M.
    pub origin: Vec3<f64>,
    /// Unit vector.
    pub direction: Vec3<f64>,
    /// Where it begins, M: 0, or −∞ for a camera at infinity.
    pub start: f64,
}

/// A rational Bézier curve of degree 7: x = X/W, where (X, W) = Σ Bₖ(θ) (Xₖ, Wₖ), θ = 0 … 1, and Bₖ is Bernstein's
/// polynomial. Places on it are told by θ.
///
/// In the chart of inverted distances it is the dense output of a step, X = n and W = w, to the letter; at infinity W = 0
/// and X is the direction. W ≥ 0 over all of it, though single Wₖ may be negative. As Bₖ ≥ 0 and ΣBₖ = 1, a plane that
/// has all (Xₖ, Wₖ) on one side (a·Xₖ > d Wₖ) has the curve there too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curve {
    /// (Xₖ, Wₖ).
    pub points: [[f64; 4]; 8],
}

impl Curve {
    /// A step up to θ = `until`, with its place in components `place..place + 3`, to be divided by component `divisor`.
    pub(super) fn of_step<const D: usize>(
        dense: &Dense<f64, D>,
        place: usize,
        divisor: Option<usize>,
        until: f64,
    ) -> Self {
        let [x, y, z] = [place, place + 1, place + 2].map(|i| dense.bernstein(i));
        let w = divisor.map_or([1.0; 8], |i| dense.bernstein(i));
        let mut points = [[0.0; 4]; 8];
        for k in 0..8 {
            points[k] = [x[k], y[k], z[k], w[k]];
        }
        let whole = Self { points };
        if until < 1.0 { whole.split(until).0 } else { whole }
    }

    /// The parts before and after θ (de Casteljau).
    pub fn split(&self, theta: f64) -> (Self, Self) {
        let (mut before, mut after) = (*self, *self);
        for level in 1..8 {
            for k in 0..8 - level {
                let [a, b] = [after.points[k], after.points[k + 1]];
                for i in 0..4 {
                    after.points[k][i] = a[i] + theta * (b[i] - a[i]);
                }
            }
            before.points[level] = after.points[0];
        }
        (before, after)
    }

    /// (X, W) at θ.
    pub fn at(&self, theta: f64) -> [f64; 4] {
        self.split(theta).1.points[0]
    }

    /// The Cartesian place at θ; not finite at infinity.
    pub fn position(&self, theta: f64) -> Vec3<f64> {
        let [x, y, z, w] = self.at(theta);
        [x / w, y / w, z / w]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geodesic::{Dop853, Flow, Method};

    /// A circle about the origin in the first two of four components, and the exponential function.
    struct Circle;

    impl Flow<f64, 4> for Circle {
        fn derivative(&self, y: &[f64; 4]) -> [f64; 4] {
            [-0.3 * y[0], -y[2], y[1], 0.5]
        }
        fn inverse_scale(&self, _: &[f64; 4]) -> [f64; 4] {
            [1.0; 4]
        }
    }

    #[test]
    fn a_step_is_its_curve() {
        let y = [2.0, 1.0, 0.0, -1.0];
        let h = 0.7;
        let mut stages = [Circle.derivative(&y); 12];
        let step = Dop853::step(&Circle, &y, &mut stages, h);
        let dense = Dop853::dense(&Circle, &y, &stages, &step.end, &Circle.derivative(&step.end), h);
        let curve = Curve::of_step(&dense, 1, Some(0), 1.0);
        let part = Curve::of_step(&dense, 1, Some(0), 0.6);
        for theta in [0.0, 0.1, 0.35, 0.5, 0.99, 1.0] {
            let [w, x, y, z] = dense.at(theta);
            let found = curve.at(theta);
            let worst = [x, y, z, w].iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-15, "{theta} {worst:e}");
            let [x, y, z] = curve.position(0.6 * theta);
            let found = part.position(theta);
            let worst = [x, y, z].iter().zip(found).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-15, "{theta} {worst:e}");
        }
    }
}
