//! Initial velocities of a given kind.

use super::{Geometry, Nature, matrix};

/// What moves along a geodesic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Light: g(v, v) = 0.
    Null,
    /// A body, its parameter being proper time: g(v, v) = −1.
    Timelike,
    /// A line in space, its parameter being proper length: g(v, v) = 1. All there is where there is no time.
    Spacelike,
}

/// Why there is no such velocity.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum VelocityError {
    /// The coordinates are singular there, or it is outside them.
    #[error("the metric is singular there, or the point is outside its coordinates")]
    Singular,
    /// Light and bodies need time.
    #[error("this space has no time: geodesics are neither timelike nor null")]
    NoTime,
    /// No future-directed velocity has these components.
    #[error("nothing timelike or null moves so there: the spatial velocity has g_ij v^i v^j = {0}")]
    Impossible(f64),
    /// A velocity of length zero.
    #[error("the velocity has no direction")]
    NoDirection,
    /// The velocity is not spacelike.
    #[error("the velocity is not spacelike: g(v, v) = {0}")]
    NotSpacelike(f64),
}

/// The velocity of a kind at x: in spacetime of light and bodies with the spatial components of `v`, the time component
/// being the future-directed solution of g(v, v) = 0 or −1; for a spacelike one `v`, its time component too, divided by
/// its length.
///
/// # Errors
/// If there is none.
pub fn velocity<G: Geometry<N>, const N: usize>(
    geometry: &G,
    x: &[f64; N],
    v: &[f64; N],
    kind: Kind,
) -> Result<[f64; N], VelocityError> {
    let g = geometry.metric(x);
    if !(geometry.margin(x) > 0.0)
        || !g.as_flattened().iter().all(|c| c.is_finite())
        || !matrix::invert(&g).as_flattened().iter().all(|c| c.is_finite())
    {
        return Err(VelocityError::Singular);
    }
    if v.iter().all(|c| *c == 0.0) && kind != Kind::Timelike {
        return Err(VelocityError::NoDirection);
    }
    let target = match kind {
        Kind::Spacelike => {
            let norm = matrix::product(&g, v, v);
            let length = norm.sqrt();
            return if norm > 0.0 {
                Ok(v.map(|c| c / length))
            } else {
                Err(VelocityError::NotSpacelike(norm))
            };
        }
        Kind::Null => 0.0,
        Kind::Timelike => -1.0,
    };
    if geometry.coordinates()[0].nature != Nature::Time {
        return Err(VelocityError::NoTime);
    }
    let mut result = *v;
    result[0] = 0.0;
    if kind == Kind::Null && result.iter().all(|c| *c == 0.0) {
        return Err(VelocityError::NoDirection);
    }
    // a (v^t)² + 2b v^t + c = 0, of which the larger root belongs to the future where a = g_tt < 0; its branch goes on
    // smoothly where a ≥ 0.
    let a = g[0][0];
    let b: f64 = (1..N).map(|i| g[0][i] * v[i]).sum();
    let space = matrix::product(&g, &result, &result);
    let c = space - target;
    let root = (b * b - a * c).sqrt();
    result[0] = if b >= 0.0 { -(b + root) / a } else { c / (root - b) };
    if result[0].is_finite() { Ok(result) } else { Err(VelocityError::Impossible(space)) }
}
