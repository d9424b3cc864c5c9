//! A metric as text as a geometry.

use std::borrow::Cow;
use std::sync::Arc;

use super::{Coordinate, Geometry, Named, from_spherical};
use crate::metric::{Kind, LineElement};
use crate::scalar::Scalar;

/// A [`LineElement`] as a geometry, in the coordinates that it was written in. It need not be stationary.
///
/// Geodesics end at the horizon of spherical coordinates, where these may be singular; Cartesian-like ones go on.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The metric.
    pub element: Arc<LineElement>,
    /// What it is called.
    pub name: String,
}

impl Geometry<4> for Written {
    fn name(&self) -> &str {
        &self.name
    }
    fn coordinates(&self) -> [Coordinate; 4] {
        let usual = match self.element.kind() {
            Kind::Cartesian => ["t", "x", "y", "z"]
                .map(|name| if name == "t" { Coordinate::time } else { Coordinate::length }(name)),
            Kind::Spherical => [
                Coordinate::time("t"),
                Coordinate::radius("r", self.element.horizon()),
                Coordinate::polar("theta"),
                Coordinate::azimuth("phi"),
            ],
        };
        let names = self.element.coordinates();
        std::array::from_fn(|i| Coordinate { name: Cow::Owned(names[i].clone()), ..usual[i].clone() })
    }
    fn parameters(&self) -> Vec<Named> {
        self.element.parameters().to_vec()
    }
    fn metric<S: Scalar>(&self, x: &[S; 4]) -> [[S; 4]; 4] {
        self.element.components(x)
    }
    fn margin(&self, x: &[f64; 4]) -> f64 {
        match self.element.kind() {
            Kind::Cartesian => f64::INFINITY,
            Kind::Spherical => x[1] - self.element.horizon(),
        }
    }
    /// L_z = x p_y − y p_x in Cartesian-like coordinates, if nothing depends on the azimuth.
    fn invariants(&self, x: &[f64; 4], p: &[f64; 4]) -> Vec<Named> {
        let turns = self.element.kind() == Kind::Cartesian && self.element.is_axisymmetric();
        if turns { vec![("L_z".to_owned(), x[1] * p[2] - x[2] * p[1])] } else { Vec::new() }
    }
    fn picture(&self, x: &[f64; 4]) -> [f64; 3] {
        match self.element.kind() {
            Kind::Cartesian => [x[1], x[2], x[3]],
            Kind::Spherical => from_spherical(x[1], x[2], x[3]),
        }
    }
}
