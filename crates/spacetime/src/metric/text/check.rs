//! What a line element is like, as places in it tell.

use super::element::LineElement;
use crate::tensor::{Tensor, Vec3};
use thiserror::Error;

/// Directions that no symmetry of a metric is likely to single out, not of unit length.
const DIRECTIONS: [Vec3<f64>; 6] = [
    [0.8, 0.5, 0.33],
    [-0.6, 0.7, 0.4],
    [0.3, -0.9, 0.2],
    [-0.5, -0.6, -0.7],
    [0.2, 0.1, -0.95],
    [0.9, -0.1, -0.3],
];

/// Why a metric does not become flat far away.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum NotFlat {
    /// It is not a number there.
    #[error("the metric has no value at a distance of {distance:e}")]
    NoValue {
        /// Where.
        distance: f64,
    },
    /// It does not come to that of flat space as 1/distance.
    #[error(
        "a component of the metric differs from flat space's by {near:.3e} at a distance of {distance:e} and by \
         {far:.3e} at ten times that: it does not fall as 1/distance"
    )]
    TooSlow {
        /// The less of the two distances.
        distance: f64,
        /// The largest difference there.
        near: f64,
        /// And ten times as far away.
        far: f64,
    },
}

/// Distances of the check, each compared with ten times itself.
const FAR: [f64; 3] = [1e3, 1e4, 1e5];

impl LineElement {
    /// The largest |g_{μν} − η_{μν}| at a distance from the origin, over six directions; NaN if one is.
    pub fn departure(&self, distance: f64) -> f64 {
        let mut largest: f64 = 0.0;
        for direction in DIRECTIONS {
            let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
            let g = self.cartesian(&direction.map(|c| c * distance / length));
            for m in 0..4 {
                for n in 0..4 {
                    let flat = if m != n {
                        0.0
                    } else if m == 0 {
                        -1.0
                    } else {
                        1.0
                    };
                    let difference = (g[m][n] - flat).abs();
                    if difference.is_nan() {
                        return f64::NAN;
                    }
                    largest = largest.max(difference);
                }
            }
        }
        largest
    }

    /// Whether the metric comes to that of flat space far away, its components as 1/distance or faster.
    ///
    /// # Errors
    /// Where it does not, and by how much.
    pub fn check_flat(&self) -> Result<(), NotFlat> {
        for distance in FAR {
            let (near, far) = (self.departure(distance), self.departure(10.0 * distance));
            if near.is_nan() || far.is_nan() {
                return Err(NotFlat::NoValue { distance });
            }
            // Terms of higher order may still count at the nearer place; rounding leaves 1e-13.
            if far > near / 7.0 + 1e-13 {
                return Err(NotFlat::TooSlow { distance, near, far });
            }
        }
        Ok(())
    }
}

/// Whether components turn with the place about the z axis, at twelve places. Where one has no value nothing is said.
pub(super) fn is_axisymmetric(element: &LineElement) -> bool {
    let (cos, sin) = (0.6, 0.8);
    let turn = |v: Vec3<f64>| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
    [3.1, 17.0].into_iter().all(|scale| {
        DIRECTIONS.into_iter().all(|direction| {
            let x = direction.map(|c| c * scale);
            let (here, there) = (element.cartesian(&x), element.cartesian(&turn(x)));
            let size = here.iter().flatten().map(|c| c.abs()).sum::<f64>();
            let apart = difference(&turned(&here, cos, sin), &there);
            apart.is_nan() || apart <= 1e-9 * size
        })
    })
}

/// R g Rᵀ, R the turn about z.
fn turned(g: &Tensor<f64>, cos: f64, sin: f64) -> Tensor<f64> {
    let turn = [[1.0, 0.0, 0.0, 0.0], [0.0, cos, -sin, 0.0], [0.0, sin, cos, 0.0], [0.0, 0.0, 0.0, 1.0]];
    let mut new = [[0.0; 4]; 4];
    for (m, row) in new.iter_mut().enumerate() {
        for (n, component) in row.iter_mut().enumerate() {
            for a in 0..4 {
                for b in 0..4 {
                    *component += turn[m][a] * g[a][b] * turn[n][b];
                }
            }
        }
    }
    new
}

fn difference(a: &Tensor<f64>, b: &Tensor<f64>) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, |sum, d| sum + d)
}
