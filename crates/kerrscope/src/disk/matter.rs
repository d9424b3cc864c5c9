//! How the matter of a disk moves, and what that does to its light.

use std::sync::Arc;

use crate::spacetime::emitter::{Circular, Departure};

/// What of the shift a disk shows. Both factors are explained at [`Shift`](crate::spacetime::emitter::Shift).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shifts {
    /// What matter's motion around the hole does.
    pub doppler: bool,
    /// What the hole does: light that climbs out of its field, from matter without angular momentum.
    pub gravitational: bool,
    /// Whether brightness goes with the shift too, as g⁴.
    pub beaming: bool,
}

impl Shifts {
    /// All of them, as it is.
    pub const ALL: Self = Self { doppler: true, gravitational: true, beaming: true };
    /// None, as it is drawn.
    pub const NONE: Self = Self { doppler: false, gravitational: false, beaming: false };

    /// Whether nothing is shifted.
    pub fn is_none(self) -> bool {
        !self.doppler && !self.gravitational
    }
}

/// The matter of a disk.
#[derive(Clone, Debug, PartialEq)]
pub struct Matter {
    /// How it goes around; at rest if there is nothing to go around.
    pub orbits: Option<Arc<Circular>>,
    /// What is shown of its shift.
    pub shifts: Shifts,
}

/// What is asked of light that leaves a disk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leaving {
    /// g, of the factors that are shown.
    pub g: f64,
    /// Cosine of the angle from the normal, in the frame of the matter.
    pub cosine: f64,
}

impl Matter {
    /// Light that leaves at radius r. None where no matter can be.
    pub(super) fn leaving(&self, r: f64, light: &Departure, angle: bool) -> Option<Leaving> {
        let Some(orbits) = &self.orbits else {
            // Flat space, in which p_z/E is that cosine.
            let g = if self.shifts.gravitational { light.energy.recip() } else { 1.0 };
            return Some(Leaving { g, cosine: light.normal.abs() });
        };
        let (velocity, equator) = (orbits.velocity(r)?, orbits.equator(r)?);
        let shift = velocity.shift(&equator, light)?;
        let mut g = 1.0;
        if self.shifts.gravitational {
            g *= shift.gravitational;
        }
        if self.shifts.doppler {
            g *= shift.doppler;
        }
        let cosine = if angle { velocity.emission_cosine(&equator, light) } else { 1.0 };
        Some(Leaving { g, cosine })
    }

    /// How far the matter at r goes round in a time, in radians and M.
    pub(super) fn turn(&self, r: f64, time: f64) -> f64 {
        let velocity = self.orbits.as_ref().and_then(|orbits| orbits.velocity(r));
        velocity.map_or(0.0, |u| u.phi / u.t * time)
    }
}
