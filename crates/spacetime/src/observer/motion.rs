//! Where observers are and how they move.

use crate::kerr::{Orbits, ergosphere, horizons};
use thiserror::Error;

/// A place in Boyer–Lindquist coordinates (spherical ones in flat space).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Radius r in M; infinite for an observer at infinity.
    pub r: f64,
    /// Polar angle θ in radians, 0 on the spin axis.
    pub theta: f64,
    /// Azimuth φ in radians.
    pub phi: f64,
}

/// How an observer moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// At rest relative to infinity: along ∂t. Only outside the static limit.
    Static,
    /// Zero angular momentum: at constant r and θ, dragged around with the spacetime.
    ZeroAngularMomentum,
    /// A circular geodesic about +z in the equatorial plane.
    Orbit,
    /// Free fall from rest at infinity, with zero angular momentum; may be inside the horizon.
    Fall,
    /// Velocity (r, θ, φ) in units of c, measured by the zero-angular-momentum observer there.
    Velocity([f64; 3]),
    /// Velocity (r, θ, φ) in units of c, measured by the freely falling observer there;
    /// may be inside the horizon.
    VelocityFromFall([f64; 3]),
}

/// Why no observer can be as asked.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ObserverError {
    /// Nothing can be at rest here.
    #[error("no observer is static at r = {r} M: the static limit there is r = {limit:.6} M")]
    StaticInErgosphere {
        /// Asked radius.
        r: f64,
        /// Radius of the static limit at that polar angle.
        limit: f64,
    },
    /// Only falling observers are inside the horizon.
    #[error(
        "r = {r} M is not outside the horizon at r = {horizon:.6} M, where only a falling observer can be"
    )]
    InsideHorizon {
        /// Asked radius.
        r: f64,
        /// Outer horizon.
        horizon: f64,
    },
    /// Below the inner horizon the past of an observer is not determined by our sky.
    #[error("r = {r} M is not outside the inner horizon at r = {inner_horizon:.6} M")]
    InsideInnerHorizon {
        /// Asked radius.
        r: f64,
        /// Inner horizon.
        inner_horizon: f64,
    },
    /// Orbits lie in the equatorial plane.
    #[error("a circular orbit lies in the equatorial plane, not at inclination {degrees}°")]
    OrbitOffPlane {
        /// Asked inclination in degrees.
        degrees: f64,
    },
    /// No circular timelike geodesic here.
    #[error(
        "no circular orbit of matter about +z exists at r = {r} M: the photon orbit is at r = {photon:.6} M"
    )]
    NoOrbit {
        /// Asked radius.
        r: f64,
        /// Radius of the circular photon orbit about +z.
        photon: f64,
    },
    /// Faster than light.
    #[error("the speed {speed} is not below that of light (1)")]
    FasterThanLight {
        /// |v|/c.
        speed: f64,
    },
    /// The radial potential is negative there.
    #[error("no photon with α = {alpha} M, β = {beta} M gets to r = {r} M")]
    NoSuchPhoton {
        /// Asked α.
        alpha: f64,
        /// Asked β.
        beta: f64,
        /// Asked radius.
        r: f64,
    },
    /// ∂t is not timelike here.
    #[error(
        "no observer is static at r = {r} M: the metric's g_tt is {time:.3e} there, which is not below 0"
    )]
    NotStatic {
        /// Asked radius.
        r: f64,
        /// g_tt.
        time: f64,
    },
    /// The metric has no value, or not the signature of a spacetime.
    #[error("no observer can be at r = {r} M: the metric has no value there, or is not that of a spacetime")]
    NoTetrad {
        /// Asked radius.
        r: f64,
    },
    /// On the other side.
    #[error("r = {r} M is not outside the throat at r = {throat:.6} M")]
    InsideThroat {
        /// Asked radius.
        r: f64,
        /// The throat's radius.
        throat: f64,
    },
    /// Beyond where rays end.
    #[error("r = {r} M is not within r = {outer:.6} M, where rays end")]
    OutOfReach {
        /// Asked radius.
        r: f64,
        /// Where rays end.
        outer: f64,
    },
    /// What is known of geodesics around Kerr holes alone.
    #[error(
        "orbits and free fall are known around Kerr holes only, and this spacetime is a metric of its own"
    )]
    OnlyAroundKerr,
    /// Flat space has no orbits.
    #[error("nothing orbits in flat space")]
    NothingToOrbit,
    /// Directions at infinity are all alike.
    #[error("an observer at infinity sees by impact parameters, not by directions")]
    AtInfinity,
    /// An observer at infinity is at rest there.
    #[error("an observer at infinity is static")]
    MovingAtInfinity,
}

/// Whether a motion is slower than light.
pub(super) fn check_speed(motion: &Motion) -> Result<(), ObserverError> {
    if let Motion::Velocity(v) | Motion::VelocityFromFall(v) = motion {
        let speed = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        // Also refuses NaN.
        if !(speed < 1.0) {
            return Err(ObserverError::FasterThanLight { speed });
        }
    }
    Ok(())
}

/// Whether an observer can be at `place`, moving so, around a hole of spin a (`None`: in flat space).
///
/// # Errors
/// The reason why not.
pub fn check(spin: Option<f64>, place: &Place, motion: &Motion) -> Result<(), ObserverError> {
    check_speed(motion)?;
    if place.r.is_infinite() {
        return if *motion == Motion::Static { Ok(()) } else { Err(ObserverError::MovingAtInfinity) };
    }
    let Some(spin) = spin else {
        return if *motion == Motion::Orbit { Err(ObserverError::NothingToOrbit) } else { Ok(()) };
    };
    let r = place.r;
    let (horizon, inner_horizon) = horizons(spin);
    if r <= inner_horizon {
        return Err(ObserverError::InsideInnerHorizon { r, inner_horizon });
    }
    if r <= horizon && !matches!(motion, Motion::Fall | Motion::VelocityFromFall(_)) {
        return Err(ObserverError::InsideHorizon { r, horizon });
    }
    match motion {
        Motion::Static => {
            let limit = ergosphere(spin, place.theta);
            if r <= limit { Err(ObserverError::StaticInErgosphere { r, limit }) } else { Ok(()) }
        }
        Motion::Orbit => {
            let photon = Orbits::new(spin).photon_prograde;
            // A millionth of a degree: what a user types as 90.
            if (place.theta - std::f64::consts::FRAC_PI_2).abs() > 2e-8 {
                Err(ObserverError::OrbitOffPlane { degrees: place.theta.to_degrees() })
            } else if r <= photon {
                Err(ObserverError::NoOrbit { r, photon })
            } else {
                Ok(())
            }
        }
        _ => Ok(()),
    }
}
