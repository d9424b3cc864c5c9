//! Reference numbers, computed anew by the integrator and compared with their sources.
//!
//! Each check takes another route than its source: published closed forms against traced rays and metrics' components.

mod crossings;
mod deflection;
mod disk;
mod light;
mod orbits;
mod shadow;

use crate::spacetime::geodesic::{Fate, Integrator, Path, Query, Scheme, Tracer};
use crate::spacetime::metric::Kerr;
use crate::spacetime::observer::impact_ray;

/// A number, its source, and what comes out here.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What it is.
    pub name: String,
    /// Where the expected value comes from.
    pub source: &'static str,
    /// The source's value.
    pub expected: f64,
    /// Ours.
    pub computed: f64,
    /// The largest difference that counts as agreement: that of the numerical route, or half a
    /// unit of the source's last digit where that is more.
    pub tolerance: f64,
}

impl Check {
    /// |computed − expected|.
    pub fn error(&self) -> f64 {
        (self.computed - self.expected).abs()
    }

    /// Whether the two agree. A number that is not one does not.
    pub fn passed(&self) -> bool {
        self.error() <= self.tolerance
    }
}

/// Every check, in a fixed order. Takes a few seconds.
pub fn all() -> Vec<Check> {
    let mut checks = orbits::checks();
    checks.extend(shadow::checks());
    checks.extend(deflection::checks());
    checks.extend(crossings::checks());
    checks.extend(disk::checks());
    checks.extend(light::checks());
    checks
}

/// The ray with impact parameters (α, β), inclination in degrees, observer at r (may be infinite),
/// traced at a tolerance of 1e-13.
fn trace(spin: f64, degrees: f64, r: f64, impact: [f64; 2], points: usize) -> Path {
    let mut path = Path::default();
    if let Ok(ray) = impact_ray(Some(spin), degrees.to_radians(), r, impact) {
        let tracer = Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-13 }, 10_000);
        tracer.trace(&ray, &Query { points, ..Query::default() }, &mut path);
    }
    path
}

/// How far from `centre`, along the unit vector `along` of the screen, captured rays give way to
/// escaping ones, for an observer at infinity: by bisection on the fates of traced rays.
fn edge(spin: f64, degrees: f64, centre: [f64; 2], along: [f64; 2]) -> f64 {
    let (mut inside, mut outside) = (0.0, 20.0);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if middle <= inside || middle >= outside {
            break;
        }
        let impact = [centre[0] + middle * along[0], centre[1] + middle * along[1]];
        match trace(spin, degrees, f64::INFINITY, impact, 0).fate {
            Fate::Escaped => outside = middle,
            // A ray so close to the edge that it is given up is on it.
            Fate::Captured | Fate::StepLimit | Fate::Hit => inside = middle,
        }
    }
    0.5 * (inside + outside)
}
