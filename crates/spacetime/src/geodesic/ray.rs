//! A ray as it leaves the camera.

use crate::kerr::{Conserved, carter};
use crate::metric::Inverted;
use crate::tensor::{Vec3, cross, dot};

/// In which spacetime a ray is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The photon reversed: it leaves the camera for the future of the time-reversed spacetime,
    /// a hole of spin s = −a in ingoing coordinates. A captured ray then stays regular at the
    /// horizon, where in the camera's own ingoing coordinates it would pile up.
    Reversed,
    /// The photon itself followed backwards in ingoing coordinates with the real spin: for a
    /// camera inside the horizon, whose rays cross it on the way out.
    Ingoing,
}

/// The start of a ray: a photon at the camera, its energy measured there being 1.
///
/// Place and momentum are those of the inverted chart ([`crate::metric::Inverted`]); for
/// [`Side::Ingoing`] the momentum is minus the photon's, so that the ray runs into the past.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Place and momentum.
    pub start: Inverted<f64>,
    /// −p_t: the photon's energy at infinity for [`Side::Reversed`], minus it for [`Side::Ingoing`].
    pub energy: f64,
    /// The spacetime it is followed in.
    pub side: Side,
    /// Azimuth of n in radians, which fixes the turn from which windings are counted; where n is
    /// on the axis, that of the direction in which the ray leaves it.
    pub azimuth: f64,
}

impl Ray {
    /// The ray of a photon with momentum p at Cartesian x.
    pub fn from_cartesian(x: &Vec3<f64>, p: &Vec3<f64>, energy: f64, side: Side, azimuth: f64) -> Self {
        let w = 1.0 / dot(x, x).sqrt();
        let n = x.map(|c| c * w);
        let start = Inverted { w, n, q: dot(&n, p), j: cross(x, p) };
        Self { start, energy, side, azimuth }
    }

    /// The same ray turned about the z axis by an angle in radians.
    pub fn turned(&self, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turn = |v: Vec3<f64>| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
        let start = Inverted { n: turn(self.start.n), j: turn(self.start.j), ..self.start };
        Self { start, azimuth: self.azimuth + angle, ..*self }
    }

    /// On the axis, takes the azimuth from the direction in which the ray leaves it.
    pub(crate) fn aim_azimuth(&mut self) {
        let [x, y, _] = self.start.n;
        if x == 0.0 && y == 0.0 {
            let leaving = cross(&self.start.j, &self.start.n);
            self.azimuth = leaving[1].atan2(leaving[0]);
        }
    }

    /// λ and η of the physical photon around a hole of spin a; infinite where E = 0.
    pub fn conserved(&self, spin: f64) -> Conserved {
        let spin = match self.side {
            Side::Reversed => -spin,
            Side::Ingoing => spin,
        };
        // Followed into the past, L changes sign; for Ingoing E does too.
        Conserved {
            lambda: match self.side {
                Side::Reversed => -self.start.j[2] / self.energy,
                Side::Ingoing => self.start.j[2] / self.energy,
            },
            eta: carter(spin, self.energy, &self.start) / (self.energy * self.energy),
        }
    }
}
