//! Matter on circular orbits, and what falls from the last of them.

use thiserror::Error;

use super::kerr::KerrMatter;
use super::table::Table;
use super::{Departure, Equator, FourVelocity, Sense, Shift};
use crate::metric::Metric;

/// A circular geodesic of matter in the equatorial plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Orbit {
    /// Ω = dφ/dt, 1/M.
    pub rate: f64,
    /// u^t.
    pub time: f64,
    /// E = −u_t, per mass.
    pub energy: f64,
    /// L = u_φ, M per mass, below 0 about −z.
    pub momentum: f64,
}

impl Orbit {
    /// u.
    pub fn velocity(&self) -> FourVelocity {
        FourVelocity { t: self.time, phi: self.time * self.rate, radial: 0.0, normal: 0.0 }
    }

    /// g = ν_camera/ν_emitter = 1/[E u^t (1 − Ωλ)] for a photon of λ, at infinity of energy E per that at the camera (1 for
    /// a camera at infinity). None if that is not a positive number.
    pub fn redshift_factor(&self, lambda: f64, energy: f64) -> Option<f64> {
        let g = (energy * self.time * (1.0 - self.rate * lambda)).recip();
        (g.is_finite() && g > 0.0).then_some(g)
    }
}

/// Why a metric has no disk of matter on circular orbits.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CircularError {
    /// Orbits in the plane z = 0 would not be circles.
    #[error("the metric is not the same all around the z axis, so that no orbits are circles")]
    NotAxisymmetric,
    /// They would not stay in the plane.
    #[error("the metric is not the same above and below the plane z = 0, so that no orbits stay there")]
    NotLevel,
    /// There are none.
    #[error("no circular orbit of matter within r = {outer} M is stable")]
    NoOrbits {
        /// The outer radius asked for.
        outer: f64,
    },
}

/// The matter of a disk in the equatorial plane of a stationary, axisymmetric spacetime: on circular geodesics down to the
/// last stable one, and falling from there with its energy and angular momentum.
///
/// Made once for a scene; around a Kerr hole by closed forms, otherwise from tables that agree with the metric to 1e-10.
/// Radii are those of [`Metric::radius`], Boyer–Lindquist's around a Kerr hole.
///
/// ```
/// use kerrscope_spacetime::emitter::{Circular, Sense};
/// use kerrscope_spacetime::metric::Kerr;
///
/// let known = Circular::kerr(0.9, Sense::Prograde);
/// let found = Circular::of(&Kerr::new(0.9), Sense::Prograde, 30.0)?;
/// assert!((found.isco().unwrap() - known.isco().unwrap()).abs() < 1e-12);
/// assert!((found.flux(6.0) / known.flux(6.0) - 1.0).abs() < 1e-9);
/// # Ok::<(), kerrscope_spacetime::emitter::CircularError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Circular(Field);

#[derive(Clone, Debug, PartialEq)]
enum Field {
    Kerr(KerrMatter),
    Table(Box<Table>),
}

impl Circular {
    /// Around a hole of spin a in [−1, 1].
    pub fn kerr(spin: f64, sense: Sense) -> Self {
        Self(Field::Kerr(KerrMatter::new(spin, sense)))
    }

    /// In a metric as it is, not reversed in time, out to a radius `outer`, in M: what is farther is not known.
    ///
    /// # Errors
    /// If there are no circular orbits, or none that are stable.
    pub fn of<M: Metric>(metric: &M, sense: Sense, outer: f64) -> Result<Self, CircularError> {
        Table::new(metric, sense, outer).map(|table| Self(Field::Table(Box::new(table))))
    }

    /// Which way the matter goes around.
    pub fn sense(&self) -> Sense {
        match &self.0 {
            Field::Kerr(matter) => matter.sense(),
            Field::Table(table) => table.sense(),
        }
    }

    /// The radius of the last stable orbit, M: that which is met first from outside. None where all are stable that there
    /// are, as around what has no horizon.
    pub fn isco(&self) -> Option<f64> {
        match &self.0 {
            Field::Kerr(matter) => Some(matter.flux().isco()),
            Field::Table(table) => table.isco.map(|(r, _)| r),
        }
    }

    /// The radius of the circular photon orbit next within the stable orbits, M, if there is one.
    pub fn photon_orbit(&self) -> Option<f64> {
        match &self.0 {
            Field::Kerr(matter) => Some(matter.photon_orbit()),
            Field::Table(table) => table.photon,
        }
    }

    /// 1 − E at the last stable orbit: the share of its rest mass that matter has radiated by then.
    pub fn efficiency(&self) -> Option<f64> {
        self.last().map(|(_, orbit)| 1.0 - orbit.energy)
    }

    /// The metric of the circle at r, None within the horizon and where it is not known.
    pub fn equator(&self, r: f64) -> Option<Equator> {
        match &self.0 {
            Field::Kerr(matter) => Some(matter.equator(r)).filter(|equator| equator.determinant() > 0.0),
            Field::Table(table) => table.equator(r).filter(|equator| equator.determinant() > 0.0),
        }
    }

    /// The circular geodesic at r, None where there is none that is stable.
    pub fn orbit(&self, r: f64) -> Option<Orbit> {
        match &self.0 {
            // The last stable orbit is one, whatever rounding says.
            Field::Kerr(matter) => (r >= matter.flux().isco() * (1.0 - 1e-12)).then(|| matter.circular(r)),
            Field::Table(table) => table.orbit(r),
        }
        .filter(|orbit| orbit.time.is_finite())
    }

    /// The four-velocity of the matter at r: on its orbit, or, within the last stable one, falling from there. None within the
    /// horizon.
    pub fn velocity(&self, r: f64) -> Option<FourVelocity> {
        if let Some(orbit) = self.orbit(r) {
            return Some(orbit.velocity());
        }
        let (isco, last) = self.last()?;
        let equator = self.equator(r).filter(|_| r < isco)?;
        match &self.0 {
            Field::Kerr(matter) => matter.plunging(r),
            Field::Table(_) => FourVelocity::falling(&equator, last.energy, last.momentum),
        }
    }

    /// The shift of light that leaves the matter at r.
    pub fn shift(&self, r: f64, light: &Departure) -> Option<Shift> {
        self.velocity(r)?.shift(&self.equator(r)?, light)
    }

    /// The cosine of the angle at which light leaves against the normal, in the matter's frame.
    pub fn emission_cosine(&self, r: f64, light: &Departure) -> Option<f64> {
        Some(self.velocity(r)?.emission_cosine(&self.equator(r)?, light))
    }

    /// The flux from each face of a thin disk, in the matter's frame and Ṁ/M² (Page & Thorne 1974): 0 within the last stable
    /// orbit, where there is none, and where the metric is not known.
    pub fn flux(&self, r: f64) -> f64 {
        match &self.0 {
            Field::Kerr(matter) => matter.flux().flux(r),
            Field::Table(table) => table.flux(r),
        }
    }

    /// The largest difference of tables from the metric, as a share of what they hold; 0 for closed forms.
    pub fn table_error(&self) -> f64 {
        match &self.0 {
            Field::Kerr(_) => 0.0,
            Field::Table(table) => table.error(),
        }
    }

    fn last(&self) -> Option<(f64, Orbit)> {
        match &self.0 {
            Field::Kerr(matter) => Some((matter.flux().isco(), matter.last())),
            Field::Table(table) => table.isco,
        }
    }
}
