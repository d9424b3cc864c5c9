//! Matter in the equatorial plane that sends light: how it moves, how its light is shifted, how brightly a disk shines.
//!
//! In a stationary spacetime that is the same all around the axis and the mirror image of itself in the plane,
//! everything follows from g_tt, g_tφ and g_φφ as functions of the radius ([`Equator`]). They are the same in any
//! coordinates that differ by t → t + f(r), φ → φ + h(r), as those of Kerr and Schild do from those of Boyer and
//! Lindquist. Light is the physical photon here, that which arrives at the camera: λ = L/E and its momentum as it
//! leaves the matter ([`Departure`]).
//!
//! The shift is g = ν_camera/ν_emitter. Along a ray I_ν/ν³ does not change, so that the camera sees I_ν = g³ I_ν,emitter,
//! and g⁴ times the whole of it.
//!
//! Lengths and times are in M, fluxes in Ṁ/M² for a rate of accretion Ṁ.

mod circular;
mod departure;
mod equator;
mod family;
mod flux;
mod kerr;
mod panels;
mod search;
mod shift;
mod table;

pub use circular::{Circular, CircularError, Orbit};
pub use departure::Departure;
pub use equator::Equator;
pub use flux::PageThorne;
pub use shift::{FourVelocity, Shift};

/// Which way matter goes around.
///
/// As in [`Orbits`](crate::kerr::Orbits), prograde is about +z whatever the spin; for a spin below 0 that is against the
/// hole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sense {
    /// About +z, φ growing.
    #[default]
    Prograde,
    /// About −z.
    Retrograde,
}

impl Sense {
    /// +1 about +z, −1 about −z.
    pub fn sign(self) -> f64 {
        match self {
            Self::Prograde => 1.0,
            Self::Retrograde => -1.0,
        }
    }

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::Prograde => Self::Retrograde,
            Self::Retrograde => Self::Prograde,
        }
    }
}
