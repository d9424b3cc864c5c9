//! Light as it leaves the plane.

use super::Equator;
use crate::geodesic::{Crossing, Ray, Side};
use crate::tensor::{Vec3, dot};

/// The photon that arrives at the camera, as it leaves the equatorial plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Its energy at infinity in units of that at the camera: 1 for a camera at infinity.
    pub energy: f64,
    /// λ = L/E about the plane's normal.
    pub lambda: f64,
    /// Its momentum across the plane per energy, p_z/E, positive upwards; ±√η/r around a Kerr hole.
    pub normal: f64,
    /// Whether it leaves outwards, its radius growing with time.
    pub outward: bool,
}

impl Departure {
    /// That of a ray at a crossing of the plane with this unit normal. A plane other than the equator has a meaning
    /// where the spacetime is the same all around, as without spin.
    pub fn new(ray: &Ray, crossing: &Crossing, plane: &Vec3<f64>) -> Self {
        let along = dot(&ray.start.j, plane);
        let (lambda, energy) = match ray.side {
            Side::Reversed => (-along / ray.energy, ray.energy),
            Side::Ingoing => (along / ray.energy, -ray.energy),
        };
        Self { energy, lambda, normal: crossing.normal, outward: crossing.outward }
    }

    /// What an observer without radial motion and motion across the plane measures, per energy: p_r √g^rr, p_z √g^zz.
    /// The first is what is left by g^{μν} p_μ p_ν = 0.
    pub fn legs(&self, equator: &Equator) -> [f64; 2] {
        let photon = [1.0, self.lambda];
        let across = self.normal / equator.zz.sqrt();
        let radial = (equator.product(photon, photon) - across * across).max(0.0).sqrt();
        [if self.outward { radial } else { -radial }, across]
    }
}
