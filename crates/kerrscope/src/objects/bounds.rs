//! Boxes along the axes.

use crate::spacetime::tensor::Vec3;

/// A box along the axes of the coordinates, in M.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub low: Vec3<f64>,
    /// Largest coordinates.
    pub high: Vec3<f64>,
}

impl Bounds {
    /// A box around nothing.
    pub const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// The box of some points.
    pub fn of(points: impl IntoIterator<Item = Vec3<f64>>) -> Self {
        points.into_iter().fold(Self::EMPTY, |bounds, x| bounds.with(&Self { low: x, high: x }))
    }

    /// The box of two.
    pub fn with(&self, other: &Self) -> Self {
        Self {
            low: std::array::from_fn(|i| self.low[i].min(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].max(other.high[i])),
        }
    }

    /// Half the area of its surface; 0 of an empty one.
    pub fn half_area(&self) -> f64 {
        let [x, y, z] = self.edges();
        x * y + y * z + z * x
    }

    /// Lengths of its edges; 0 of an empty one.
    pub fn edges(&self) -> Vec3<f64> {
        std::array::from_fn(|i| (self.high[i] - self.low[i]).max(0.0))
    }

    /// Its middle.
    pub fn middle(&self) -> Vec3<f64> {
        std::array::from_fn(|i| 0.5 * (self.low[i] + self.high[i]))
    }

    /// The largest distance of its points from the origin.
    pub fn reach(&self) -> f64 {
        (0..3).map(|i| self.low[i].abs().max(self.high[i].abs()).powi(2)).sum::<f64>().sqrt()
    }

    /// The least distance of its points from the origin.
    pub fn nearest(&self) -> f64 {
        (0..3).map(|i| self.low[i].max(-self.high[i]).max(0.0).powi(2)).sum::<f64>().sqrt()
    }
}
