//! Circular and plunging matter around a Kerr hole, in closed form.

use super::circular::Orbit;
use super::{Equator, FourVelocity, PageThorne, Sense};
use crate::kerr::Orbits;

/// Matter that goes around a hole of spin a.
///
/// About −z all is as about +z around the hole of spin −a, angles and angular momenta with the other sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KerrMatter {
    spin: f64,
    sense: Sense,
    flux: PageThorne,
}

impl KerrMatter {
    pub fn new(spin: f64, sense: Sense) -> Self {
        Self { spin, sense, flux: PageThorne::new(spin * sense.sign()) }
    }

    pub fn flux(&self) -> &PageThorne {
        &self.flux
    }

    pub fn sense(&self) -> Sense {
        self.sense
    }

    /// Radius of the circular photon orbit in this sense.
    pub fn photon_orbit(&self) -> f64 {
        Orbits::new(self.spin * self.sense.sign()).photon_prograde
    }

    pub fn equator(&self, r: f64) -> Equator {
        Equator::kerr(self.spin, r)
    }

    /// A circular geodesic, stable or not (Bardeen, Press & Teukolsky 1972, eq. 2.12, 2.13, 2.16), σ the sense:
    ///   Ω = σ/(r^{3/2} + σa),   u^t = (1 + σa r^{−3/2})/N,   E = (1 − 2/r + σa r^{−3/2})/N,
    ///   L = σ√r (1 − 2σa r^{−3/2} + a²/r²)/N,   N = √(1 − 3/r + 2σa r^{−3/2}).
    pub fn circular(&self, r: f64) -> Orbit {
        let (sign, root) = (self.sense.sign(), r.sqrt());
        let spin = self.spin * sign;
        let drag = spin / (r * root);
        let norm = (1.0 - 3.0 / r + 2.0 * drag).max(0.0).sqrt();
        Orbit {
            rate: sign / (r * root + spin),
            time: (1.0 + drag) / norm,
            energy: (1.0 - 2.0 / r + drag) / norm,
            momentum: sign * root * (1.0 - 2.0 * drag + (spin / r).powi(2)) / norm,
        }
    }

    /// The last stable orbit, for which E and L are finite where u^t is not (a = 1):
    ///   E = √(1 − 2/(3r)),   L = σ(2/√27)(1 + 2√(3r − 2)).
    pub fn last(&self) -> Orbit {
        let isco = self.flux.isco();
        let momentum = 2.0 / 27f64.sqrt() * (1.0 + 2.0 * (3.0 * isco - 2.0).sqrt());
        Orbit {
            energy: (1.0 - 2.0 / (3.0 * isco)).sqrt(),
            momentum: self.sense.sign() * momentum,
            ..self.circular(isco)
        }
    }

    /// Matter that has left the last stable orbit at r_i with its energy and angular momentum (Cunningham 1975; Mummery &
    /// Balbus 2022): u^r = −√(2/(3r_i)) (r_i/r − 1)^{3/2}; g_rr = r²/Δ.
    pub fn plunging(&self, r: f64) -> Option<FourVelocity> {
        let isco = self.flux.isco();
        let last = self.last();
        let equator = self.equator(r);
        let delta = equator.determinant();
        let fall = FourVelocity::falling(&equator, last.energy, last.momentum)?;
        let inwards = (2.0 / (3.0 * isco)).sqrt() * (isco / r - 1.0).max(0.0).powf(1.5);
        Some(FourVelocity { radial: -inwards * r / delta.sqrt(), ..fall })
    }
}
