//! A metric for pictures as a geometry.

use super::{Coordinate, Geometry, Named};
use crate::metric::Metric;
use crate::scalar::Scalar;

/// A [`Metric`] as a geometry with the coordinates (t, x, y, z).
#[derive(Clone, Debug, PartialEq)]
pub struct Cartesian<M> {
    /// The metric.
    pub metric: M,
    /// What it is called.
    pub name: String,
    /// Its parameters.
    pub parameters: Vec<Named>,
}

impl<M: Metric> Cartesian<M> {
    /// A metric without parameters that matter.
    pub fn new(metric: M, name: &str) -> Self {
        Self { metric, name: name.to_owned(), parameters: Vec::new() }
    }
}

impl<M: Metric> Geometry<4> for Cartesian<M> {
    fn name(&self) -> &str {
        &self.name
    }
    fn coordinates(&self) -> [Coordinate; 4] {
        [Coordinate::time("t"), Coordinate::length("x"), Coordinate::length("y"), Coordinate::length("z")]
    }
    fn parameters(&self) -> Vec<Named> {
        self.parameters.clone()
    }
    fn metric<S: Scalar>(&self, x: &[S; 4]) -> [[S; 4]; 4] {
        self.metric.components(&[x[1], x[2], x[3]])
    }
    /// L_z = x p_y − y p_x, if turning about z changes nothing.
    fn invariants(&self, x: &[f64; 4], p: &[f64; 4]) -> Vec<Named> {
        let round = |x: &[f64; 3]| {
            // g_{tt} and g_{zz} are the same after a turn by one radian.
            let (sin, cos) = 1f64.sin_cos();
            let turned = [cos * x[0] - sin * x[1], sin * x[0] + cos * x[1], x[2]];
            let (here, there) = (self.metric.components(x), self.metric.components(&turned));
            (here[0][0] - there[0][0]).abs() + (here[3][3] - there[3][3]).abs() < 1e-12
        };
        if round(&[x[1], x[2], x[3]]) && round(&[x[1] + 0.7, x[2] - 0.2, x[3] + 0.3]) {
            vec![("L_z".to_owned(), x[1] * p[2] - x[2] * p[1])]
        } else {
            Vec::new()
        }
    }
}
