//! Geometries of two, three or four dimensions in any coordinates: connection, curvature, geodesics, lengths.
//!
//! A [`Geometry`] is its metric components g_{μν}(x), written once for any [`Scalar`]. All else follows from them
//! with exact derivatives by dual numbers:
//!
//! - [`connection`]: Γ^μ_{στ} = ½ g^{μα}(∂_σ g_{τα} + ∂_τ g_{ασ} − ∂_α g_{στ});
//! - [`Curvature`]: Riemann, Ricci and Einstein tensors, Ricci scalar, Kretschmann scalar;
//! - [`Trajectory`]: geodesics ẍ^μ + Γ^μ_{στ} ẋ^σ ẋ^τ = 0 from initial values, timelike, null or spacelike;
//! - [`between`]: the geodesic from one point to another; [`length`]: the length of any curve;
//! - [`check`]: whether a metric is what it should be, at random points.
//!
//! Signature (−+++) where there is time, which then is coordinate 0; (+++) or (++) where there is none. Angles are in
//! radians, lengths in units of the mass where there is one. Curvature has the signs of Misner, Thorne & Wheeler (1973):
//! R^ρ_{σμν} = ∂_μ Γ^ρ_{νσ} − …, R_{σν} = R^ρ_{σρν}, so that a sphere's Ricci scalar is positive.
//!
//! This is the workshop for one geodesic at a time in any coordinates. Pictures are made of a [`crate::metric::Metric`], which is
//! Cartesian and knows infinity; [`Cartesian`] makes a geometry of one, and [`Written`] of a text.
//!
//! ```
//! use kerrscope_spacetime::geometry::{BoyerLindquist, Curvature, connection};
//!
//! let hole = BoyerLindquist::new(0.0);
//! let at = [0.0, 6.0, 1.2, 0.0];
//! // Γ^t_{tr} = M/(r(r − 2M)), and the Kretschmann scalar 48 M²/r⁶
//! assert!((connection(&hole, &at)[0][0][1] - 1.0 / 24.0).abs() < 1e-15);
//! assert!((Curvature::of(&hole, &at).kretschmann * 6f64.powi(6) / 48.0 - 1.0).abs() < 1e-12);
//! ```

mod between;
mod boyer_lindquist;
mod cartesian;
mod catalogue;
mod check;
mod connection;
mod coordinate;
mod curvature;
mod ellis;
mod flat;
mod length;
mod matrix;
mod motion;
mod schwarzschild;
mod sphere;
mod trajectory;
mod velocity;
mod written;

#[cfg(test)]
mod tests;

pub use between::{Connected, NotConnected, Search, between};
pub use boyer_lindquist::BoyerLindquist;
pub use cartesian::Cartesian;
pub use catalogue::{AnySpace, AnySpacetime, AnySurface, BuiltIn, CatalogueError, Entry, catalogue};
pub use check::{Findings, Signature, check};
pub use connection::{acceleration, connection};
pub use coordinate::{Coordinate, Nature};
pub use curvature::Curvature;
pub use ellis::Ellis;
pub use flat::{Minkowski, PolarPlane, SphericalSpace};
pub use length::{Length, length, polyline};
pub use matrix::{eigenvalues, invert};
pub use schwarzschild::Schwarzschild;
pub use sphere::{Pole, Sphere, Stereographic, ThreeSphere};
pub use trajectory::{End, Options, Place, Point, Trajectory, conserved};
pub use velocity::{Kind, VelocityError, velocity};
pub use written::Written;

use crate::scalar::Scalar;

/// A quantity with a name.
pub type Named = (String, f64);

/// A space or spacetime of `N` dimensions, 2 to 4, in some coordinates.
pub trait Geometry<const N: usize> {
    /// What it is called, in one word.
    fn name(&self) -> &str;

    /// Its coordinates, time first if there is one.
    fn coordinates(&self) -> [Coordinate; N];

    /// Its parameters and their values.
    fn parameters(&self) -> Vec<Named> {
        Vec::new()
    }

    /// g_{μν} at x, symmetric. Where the coordinates are singular some components are infinite or not numbers.
    fn metric<S: Scalar>(&self, x: &[S; N]) -> [[S; N]; N];

    /// How far x is inside the part that the coordinates cover: a geodesic ends where this falls to zero. Any measure
    /// will do; a horizon at which they are singular has r − r₊ less a margin.
    fn margin(&self, _x: &[f64; N]) -> f64 {
        f64::INFINITY
    }

    /// Constants of geodesics beside the momenta of coordinates on which the metric does not depend (these are found
    /// without being told), from place and momentum p_μ.
    fn invariants(&self, _x: &[f64; N], _p: &[f64; N]) -> Vec<Named> {
        Vec::new()
    }

    /// Where to draw x in flat space. Unless given, the coordinates without time are taken as Cartesian.
    fn picture(&self, x: &[f64; N]) -> [f64; 3] {
        let first = usize::from(self.coordinates()[0].nature == Nature::Time);
        let mut place = [0.0; 3];
        for (to, from) in place.iter_mut().zip(&x[first..]) {
            *to = *from;
        }
        place
    }
}

impl<G: Geometry<N>, const N: usize> Geometry<N> for &G {
    fn name(&self) -> &str {
        (**self).name()
    }
    fn coordinates(&self) -> [Coordinate; N] {
        (**self).coordinates()
    }
    fn parameters(&self) -> Vec<Named> {
        (**self).parameters()
    }
    fn metric<S: Scalar>(&self, x: &[S; N]) -> [[S; N]; N] {
        (**self).metric(x)
    }
    fn margin(&self, x: &[f64; N]) -> f64 {
        (**self).margin(x)
    }
    fn invariants(&self, x: &[f64; N], p: &[f64; N]) -> Vec<Named> {
        (**self).invariants(x, p)
    }
    fn picture(&self, x: &[f64; N]) -> [f64; 3] {
        (**self).picture(x)
    }
}

/// A diagonal metric.
fn diagonal<S: Scalar, const N: usize>(entries: [S; N]) -> [[S; N]; N] {
    let mut g = [[entries[0].constant(0.0); N]; N];
    for i in 0..N {
        g[i][i] = entries[i];
    }
    g
}

/// The point of flat space at spherical coordinates.
fn from_spherical(r: f64, theta: f64, phi: f64) -> [f64; 3] {
    let (sin, cos) = theta.sin_cos();
    [r * sin * phi.cos(), r * sin * phi.sin(), r * cos]
}
