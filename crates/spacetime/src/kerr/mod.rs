//! The Kerr spacetime's own numbers: orbits, conserved quantities, the critical curve.
//!
//! Boyer–Lindquist coordinates, G = c = M = 1, spin a in [−1, 1].

mod conserved;
mod critical_curve;
mod orbits;

pub use conserved::Conserved;
pub(crate) use conserved::carter;
pub use critical_curve::{CriticalCurve, Extent};
pub use orbits::{Orbits, ergosphere, horizons};
