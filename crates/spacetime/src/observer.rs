//! Observers: where they are and how they move.

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
    #[error("r = {r} M is not outside the horizon at r = {horizon:.6} M, where only a falling observer can be")]
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
    #[error("no circular orbit of matter about +z exists at r = {r} M: the photon orbit is at r = {photon:.6} M")]
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
    /// An observer at infinity is at rest there.
    #[error("an observer at infinity is static")]
    MovingAtInfinity,
}
