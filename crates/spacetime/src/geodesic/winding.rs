//! The azimuth of a ray, unwrapped.

use super::dense::Dense;
use crate::scalar::Scalar;
use crate::tensor::{Vec3, each};
use std::f64::consts::{PI, TAU};

/// The angle in (−π, π] by which the horizontal part of a turns into that of b; 0 if one of
/// them vanishes.
#[inline(always)]
pub fn turn<S: Scalar>(a: &Vec3<S>, b: &Vec3<S>) -> S {
    // + 0.0 makes −0.0 positive, whose angle would be π.
    (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1] + 0.0)
}

/// A turn beyond which a chord may have passed the axis on the wrong side.
pub const DOUBTFUL: f64 = 1.0;

/// The azimuth swept by the direction in components `first..first + 3` of a dense output, from
/// that of `start` at its beginning up to θ = `to`.
///
/// Intervals are halved until each turns little, or lies so close to the axis that an error of
/// the ray could take it past on the wrong side: it turns in the `sense` (±1) of the angular
/// momentum about the axis, which is exact.
pub fn sweep<const D: usize>(
    dense: &Dense<f64, D>,
    first: usize,
    start: &Vec3<f64>,
    to: f64,
    sense: f64,
) -> f64 {
    let place = |theta| {
        each(
            #[inline(always)]
            |i| dense.component(first + i, theta),
        )
    };
    refine(&place, (0.0, *start), (to, place(to)), sense, 40)
}

/// The direction whose azimuth a ray has at `place`: on the axis, that in which it leaves.
#[inline(always)]
pub fn heading<S: Scalar>(place: Vec3<S>, slope: Vec3<S>) -> Vec3<S> {
    let off_axis = place[0].constant(0.0).less(place[0].abs() + place[1].abs());
    let mut heading = slope;
    for i in 0..3 {
        heading[i] = S::select(off_axis, place[i], slope[i]);
    }
    heading
}

/// Within a milliradian of the axis, where only the angular momentum turns a ray.
#[inline(always)]
pub fn hugs_axis<S: Scalar>(place: &Vec3<S>) -> S::Mask {
    place[0].mul_add(place[0], place[1] * place[1]).less(place[2] * place[2] * 1e-6)
}

fn refine(
    place: &impl Fn(f64) -> Vec3<f64>,
    a: (f64, Vec3<f64>),
    b: (f64, Vec3<f64>),
    sense: f64,
    depth: u32,
) -> f64 {
    let whole = turn(&a.1, &b.1);
    if whole.abs() < 0.25 {
        return whole;
    }
    if depth == 0 || (hugs_axis(&a.1) && hugs_axis(&b.1)) {
        let against = whole * sense < 0.0 && whole.abs() > 0.5 * PI;
        return if against { whole + sense * TAU } else { whole };
    }
    let theta = 0.5 * (a.0 + b.0);
    let middle = (theta, place(theta));
    let (left, right) = (turn(&a.1, &middle.1), turn(&middle.1, &b.1));
    if left.abs() < DOUBTFUL && right.abs() < DOUBTFUL && (left + right - whole).abs() < 1e-6 {
        return whole;
    }
    refine(place, a, middle, sense, depth - 1) + refine(place, middle, b, sense, depth - 1)
}
