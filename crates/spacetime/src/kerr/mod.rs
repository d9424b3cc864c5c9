//! The Kerr spacetime's own numbers: orbits, conserved quantities, the critical curve.
//!
//! Boyer–Lindquist coordinates, G = c = M = 1, spin a in [−1, 1].

mod conserved;
mod critical_curve;
mod lensing_bands;
mod orbits;

pub use conserved::Conserved;
pub(crate) use conserved::carter;
pub use critical_curve::{CriticalCurve, Extent};
pub use lensing_bands::{LensingBand, lensing_bands};
pub use orbits::{Orbits, ergosphere, horizons};
