//! Coordinates in which a posterior is nearly a Gaussian of variance 1.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::mode::Mode;

/// Coordinates in which chains are run: q = origin + matrix · y.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Metric {
    origin: Vec<f64>,
    /// Its columns are the steps of y.
    pub matrix: DMatrix<f64>,
    inverse: DMatrix<f64>,
}

impl Metric {
    fn of(origin: Vec<f64>, matrix: DMatrix<f64>) -> Self {
        let n = matrix.nrows();
        let inverse = matrix.clone().try_inverse().unwrap_or_else(|| DMatrix::identity(n, n));
        Self { origin, matrix, inverse }
    }

    /// That of the Gaussian around a mode.
    pub fn around(mode: &Mode) -> Self {
        let n = mode.place.len();
        let mut matrix = DMatrix::zeros(n, n);
        for k in 0..n {
            let mut unit = vec![0.0; n];
            unit[k] = 1.0;
            let moved = mode.at(&unit);
            for row in 0..n {
                matrix[(row, k)] = moved[row] - mode.place[row];
            }
        }
        Self::of(mode.place.clone(), matrix)
    }

    /// That of draws, with the present one counting as some of them.
    pub fn shaped_by(&self, places: &[Vec<f64>]) -> Self {
        let n = self.origin.len();
        let count = places.len() as f64;
        let inner: Vec<DVector<f64>> = places.iter().map(|q| self.inside(q)).collect();
        let mean: DVector<f64> = inner.iter().fold(DVector::zeros(n), |sum, y| sum + y) / count;
        let mut covariance = DMatrix::identity(n, n) * (10.0 / (count + 10.0));
        for y in &inner {
            let offset = y - &mean;
            covariance += &offset * offset.transpose() / (count + 10.0);
        }
        let lower = crate::mode::factor(covariance).l();
        let origin = self.outside(mean.as_slice());
        Self::of(origin, &self.matrix * lower)
    }

    /// Coordinates at y.
    pub fn outside(&self, y: &[f64]) -> Vec<f64> {
        let moved = &self.matrix * DVector::from_column_slice(y);
        self.origin.iter().zip(moved.iter()).map(|(a, b)| a + b).collect()
    }

    /// y at coordinates.
    pub fn inside(&self, q: &[f64]) -> DVector<f64> {
        let offset = DVector::from_iterator(q.len(), q.iter().zip(&self.origin).map(|(a, b)| a - b));
        &self.inverse * offset
    }
}
