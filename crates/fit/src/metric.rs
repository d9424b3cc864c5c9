//! Coordinates in which a posterior is nearly a Gaussian of variance 1.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::bounds::Bounds;
use crate::coordinates::Coordinates;
use crate::mode::Mode;
use crate::shear::Shear;

/// Coordinates in which chains are run: q = origin + matrix · y, sheared, and between bounds.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Metric {
    origin: Vec<f64>,
    /// Its columns are the steps of y.
    matrix: DMatrix<f64>,
    inverse: DMatrix<f64>,
    /// ln |det matrix|.
    volume: f64,
    shear: Option<Shear>,
    bounds: Bounds,
}

impl Metric {
    fn of(origin: Vec<f64>, matrix: DMatrix<f64>, shear: Option<Shear>, bounds: Bounds) -> Self {
        let n = matrix.nrows();
        let inverse = matrix.clone().try_inverse().unwrap_or_else(|| DMatrix::identity(n, n));
        let volume = matrix.determinant().abs().max(f64::MIN_POSITIVE).ln();
        Self { origin, matrix, inverse, volume, shear, bounds }
    }

    /// That of the Gaussian around a mode, everywhere smooth.
    pub fn around(mode: &Mode) -> Self {
        Self::with(mode, mode.shear.clone(), Bounds::default())
    }

    /// The same in coordinates that end where parameters do.
    pub fn between_bounds(mode: &Mode, coordinates: &Coordinates) -> Self {
        let bounds = Bounds::about(coordinates, &mode.place);
        Self::with(mode, mode.shear.as_ref().map(|shear| shear.between(&bounds)), bounds)
    }

    fn with(mode: &Mode, shear: Option<Shear>, bounds: Bounds) -> Self {
        let lower = mode.factor.l();
        let n = mode.place.len();
        let matrix = lower.transpose().try_inverse().unwrap_or_else(|| DMatrix::identity(n, n));
        Self::of(mode.place.clone(), matrix, shear, bounds)
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
        let origin = self.straight(mean.as_slice());
        Self::of(origin, &self.matrix * lower, self.shear.clone(), self.bounds.clone())
    }

    fn straight(&self, y: &[f64]) -> Vec<f64> {
        let moved = &self.matrix * DVector::from_column_slice(y);
        self.origin.iter().zip(moved.iter()).map(|(a, b)| a + b).collect()
    }

    /// Coordinates at y; none beyond bounds.
    pub fn outside(&self, y: &[f64]) -> Option<Vec<f64>> {
        let mut q = self.straight(y);
        if let Some(shear) = &self.shear {
            shear.bend(&mut q);
        }
        self.bounds.bend(&mut q).then_some(q)
    }

    /// y at coordinates.
    pub fn inside(&self, q: &[f64]) -> DVector<f64> {
        let mut q = q.to_vec();
        self.bounds.straighten(&mut q);
        if let Some(shear) = &self.shear {
            shear.straighten(&mut q);
        }
        let offset = DVector::from_iterator(q.len(), q.iter().zip(&self.origin).map(|(a, b)| a - b));
        &self.inverse * offset
    }

    /// ln |dq/dy| at q: a shear's determinant is 1.
    pub fn volume(&self, q: &[f64]) -> f64 {
        self.volume + self.bounds.slopes(q).iter().map(|slope| slope.ln()).sum::<f64>()
    }

    /// The gradient in y of a density over q, from that in the coordinates at q, where there are no bounds.
    pub fn pull(&self, q: &[f64], gradient: &[f64]) -> Vec<f64> {
        let mut gradient = gradient.to_vec();
        if let Some(shear) = &self.shear {
            shear.pull(q, &mut gradient);
        }
        self.matrix.tr_mul(&DVector::from_vec(gradient)).as_slice().to_vec()
    }
}
