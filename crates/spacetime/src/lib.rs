//! Light in curved spacetime.
//!
//! # Conventions
//!
//! - Signature (−+++); G = c = 1; lengths and times in units of the mass M.
//! - The spin a lies in [−1, 1], along +z. Angles are in radians.
//! - The inclination i is the angle between +z and the direction to the observer; 0 is face-on.
//! - On the observer's screen (Bardeen 1973) α points right, β along the projected spin axis:
//!   λ = −α sin i, η = (α² − a²) cos² i + β², of the photon that arrives.
//! - A camera's ray is that photon followed into the past.
//!
//! This crate does no input or output and knows no clock, no thread and no SI unit.

pub mod closed;
pub mod emitter;
pub mod formula;
pub mod geodesic;
pub mod geometry;
pub mod kerr;
pub mod metric;

pub mod observer;

mod dual;
mod lanes;
mod scalar;
pub mod tensor;

pub use dual::Dual;
pub use lanes::{Lanes, Level, OnLanes};
pub use scalar::Scalar;
