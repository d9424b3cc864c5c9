//! Spheres.

use super::{Coordinate, Geometry, Named, diagonal, from_spherical};
use crate::scalar::Scalar;

/// The surface of a ball: ds² = R²(dθ² + sin²θ dφ²). Its Ricci scalar is 2/R².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// R.
    pub radius: f64,
}

impl Geometry<2> for Sphere {
    fn name(&self) -> &'static str {
        "sphere"
    }
    fn coordinates(&self) -> [Coordinate; 2] {
        [Coordinate::polar("theta"), Coordinate::azimuth("phi")]
    }
    fn parameters(&self) -> Vec<Named> {
        vec![("radius".to_owned(), self.radius)]
    }
    fn metric<S: Scalar>(&self, x: &[S; 2]) -> [[S; 2]; 2] {
        let square = self.radius * self.radius;
        diagonal([x[0].constant(square), x[0].sin_cos().0.squared() * square])
    }
    fn picture(&self, x: &[f64; 2]) -> [f64; 3] {
        from_spherical(self.radius, x[0], x[1])
    }
}

/// The pole of a sphere from which it is projected, and which the chart leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pole {
    /// θ = 0: the plane's origin is θ = π.
    North,
    /// θ = π: the plane's origin is θ = 0.
    South,
}

/// A sphere projected from one of its poles on the plane of its equator: ds² = 4(dx² + dy²)/(1 + (x² + y²)/R²)².
///
/// From the north pole x + iy = R cot(θ/2) e^{iφ}, from the south pole R tan(θ/2) e^{iφ}; both charts have the same
/// metric, and R² (x + iy)/(x² + y²) leads from one to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stereographic {
    /// R.
    pub radius: f64,
    /// Where it is projected from.
    pub pole: Pole,
}

impl Stereographic {
    /// The coordinates of the point at θ and φ.
    pub fn from_angles(&self, [theta, phi]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = (0.5 * theta).sin_cos();
        let far = self.radius * if self.pole == Pole::North { cos / sin } else { sin / cos };
        [far * phi.cos(), far * phi.sin()]
    }

    /// θ in 0 to π and φ in −π to π of the point at x and y.
    pub fn to_angles(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let far = x.hypot(y);
        let half = if self.pole == Pole::North { self.radius.atan2(far) } else { far.atan2(self.radius) };
        [2.0 * half, y.atan2(x)]
    }
}

impl Geometry<2> for Stereographic {
    fn name(&self) -> &str {
        match self.pole {
            Pole::North => "stereographic-north",
            Pole::South => "stereographic-south",
        }
    }
    fn coordinates(&self) -> [Coordinate; 2] {
        [Coordinate::length("x"), Coordinate::length("y")]
    }
    fn parameters(&self) -> Vec<Named> {
        vec![("radius".to_owned(), self.radius)]
    }
    fn metric<S: Scalar>(&self, x: &[S; 2]) -> [[S; 2]; 2] {
        let square = (x[0].squared() + x[1].squared()) * self.radius.powi(-2) + 1.0;
        let factor = square.squared().recip() * 4.0;
        diagonal([factor, factor])
    }
    fn picture(&self, x: &[f64; 2]) -> [f64; 3] {
        let [theta, phi] = self.to_angles(*x);
        from_spherical(self.radius, theta, phi)
    }
}

/// The three-dimensional sphere: ds² = R²(dχ² + sin²χ(dθ² + sin²θ dφ²)). Its Ricci scalar is 6/R².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThreeSphere {
    /// R.
    pub radius: f64,
}

impl Geometry<3> for ThreeSphere {
    fn name(&self) -> &'static str {
        "three-sphere"
    }
    fn coordinates(&self) -> [Coordinate; 3] {
        [Coordinate::polar("chi"), Coordinate::polar("theta"), Coordinate::azimuth("phi")]
    }
    fn parameters(&self) -> Vec<Named> {
        vec![("radius".to_owned(), self.radius)]
    }
    fn metric<S: Scalar>(&self, x: &[S; 3]) -> [[S; 3]; 3] {
        let square = self.radius * self.radius;
        let wide = x[0].sin_cos().0.squared() * square;
        diagonal([x[0].constant(square), wide, wide * x[1].sin_cos().0.squared()])
    }
    fn picture(&self, x: &[f64; 3]) -> [f64; 3] {
        from_spherical(self.radius * x[0].sin(), x[1], x[2])
    }
}
