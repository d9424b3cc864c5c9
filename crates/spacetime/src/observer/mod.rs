//! Observers and surfaces: orthonormal tetrads, and the rays that arrive at them.

mod impact;
mod motion;
mod patch;
mod site;
mod tetrad;

pub use impact::{ImpactScreen, impact_ray};
pub use motion::{Motion, ObserverError, Place, check};
pub use patch::{Drift, Patch, clearance, clearance_in_metric};
pub use tetrad::Observer;

use std::f64::consts::{FRAC_PI_2, PI};

/// Sine and cosine of a polar angle, exact on the axis and the equator.
fn polar_sin_cos(theta: f64) -> (f64, f64) {
    if theta == FRAC_PI_2 {
        (1.0, 0.0)
    } else if theta == PI {
        (0.0, -1.0)
    } else {
        theta.sin_cos()
    }
}
