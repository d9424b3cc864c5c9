//! The azimuth of a ray, unwrapped.

use super::dense::Dense;
use crate::tensor::Vec3;

/// The angle in (−π, π] by which the horizontal part of a turns into that of b; 0 if one of
/// them vanishes.
#[inline(always)]
pub fn turn(a: &Vec3<f64>, b: &Vec3<f64>) -> f64 {
    // + 0.0 makes −0.0 positive, whose angle would be π.
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1] + 0.0)
}

/// A turn beyond which a chord may have passed the axis on the wrong side.
pub const DOUBTFUL: f64 = 1.0;

/// The azimuth swept by the direction in components `first..first + 3` of a dense output, from
/// that of `start` at its beginning up to θ = `to`.
///
/// Intervals are halved until each turns little; one that passes so close to the axis
/// that 40 halvings do not resolve it turns by what its end points say.
pub fn sweep<const D: usize>(dense: &Dense<f64, D>, first: usize, start: &Vec3<f64>, to: f64) -> f64 {
    let place = |theta| std::array::from_fn(|i| dense.component(first + i, theta));
    refine(&place, (0.0, *start), (to, place(to)), 40)
}

/// The direction whose azimuth a ray has at `place`: on the axis, that in which it leaves.
#[inline(always)]
pub fn heading(place: Vec3<f64>, slope: Vec3<f64>) -> Vec3<f64> {
    if place[0] == 0.0 && place[1] == 0.0 { slope } else { place }
}

fn refine(place: &impl Fn(f64) -> Vec3<f64>, a: (f64, Vec3<f64>), b: (f64, Vec3<f64>), depth: u32) -> f64 {
    let whole = turn(&a.1, &b.1);
    if depth == 0 || whole.abs() < 0.25 {
        return whole;
    }
    let theta = 0.5 * (a.0 + b.0);
    let middle = (theta, place(theta));
    let (left, right) = (turn(&a.1, &middle.1), turn(&middle.1, &b.1));
    if left.abs() < DOUBTFUL && right.abs() < DOUBTFUL && (left + right - whole).abs() < 1e-6 {
        return whole;
    }
    refine(place, a, middle, depth - 1) + refine(place, middle, b, depth - 1)
}
