//! An observer in a spacetime given as text, and where the rays that arrive there cross the disk's plane.
//!
//! Directions are named by the impact parameters (α, β) that photons from there would have at the same r and i around the Kerr hole
//! of the same spin ([`Screen`]): a name only, for the direction in the observer's own tetrad is what a picture shows. The photon's
//! λ = L/E is a linear function of α, since L is one of the component along e_φ.

use std::sync::Arc;

use kerrscope::spacetime::geodesic::{Fate, Path, Query, Ray, Scheme, TextTracer, Tracer};
use kerrscope::spacetime::metric::Text;
use kerrscope::spacetime::observer::{Motion, Observer, Place};

use super::order::{NotFound, View};
use super::screen::{Frame, Projection, Screen};
use super::spacetime::Spacetime;

/// The error of a step of the integrator.
const TOLERANCE: f64 = 1e-8;

/// Steps of a ray at most.
const STEPS: usize = 4000;

/// Where a ray crosses the plane for the time that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Landing {
    /// At x = 1/√r.
    At(f64),
    /// It falls in before.
    Captured,
    /// It comes from the sky.
    Sky,
    /// It was given up.
    Lost,
}

/// An observer at rest, above the plane or in it.
pub struct Sight {
    observer: Observer,
    tracer: TextTracer,
    screen: Screen,
    u: f64,
    /// α of the centre of polar coordinates.
    center: f64,
    /// λ at α = 0, and what it changes by with α.
    pub lambda: [f64; 2],
}

impl Sight {
    /// At inclination i and 1/r = u > 0, the distance from the origin of the metric's coordinates.
    pub fn new(spacetime: &Spacetime, inclination: f64, u: f64) -> Result<Self, NotFound> {
        let place = Place { r: u.recip(), theta: inclination, phi: 0.0 };
        let observer = Observer::in_metric(&Text::new(&spacetime.element), place, Motion::Static)
            .map_err(|_| NotFound)?;
        let view = View { spin: spacetime.spin, inclination, u, turn: 1.0 };
        let nowhere = Frame { size: [1, 1], scale: 1.0, center: [0.0; 2], position_angle: 0.0 };
        let scheme = Scheme::Dop853 { tolerance: TOLERANCE };
        let mut sight = Self {
            observer,
            tracer: TextTracer::new(Arc::clone(&spacetime.element), scheme, STEPS),
            screen: Screen::new(spacetime.spin, inclination, u, nowhere, Projection::Angular),
            u,
            center: view.center().0,
            lambda: [0.0; 2],
        };
        let lambda = |ray: Ray| -ray.start.j[2] / ray.energy;
        let [at_zero, at_one] = [0.0, 1.0].map(|alpha| lambda(sight.ray([alpha, 0.0])));
        sight.lambda = [at_zero, at_one - at_zero];
        if sight.lambda.iter().all(|l| l.is_finite()) { Ok(sight) } else { Err(NotFound) }
    }

    /// The ray that arrives from the direction of a name.
    fn ray(&self, impact: [f64; 2]) -> Ray {
        let [right, up] = self.screen.towards(impact).map(|part| part * self.u);
        let forward = (1.0 - right * right - up * up).max(0.0).sqrt();
        self.observer.ray([-forward, -up, right])
    }

    /// Crossings number `order` of rays from directions at distances ρ and angles (cos ψ, sin ψ) from the centre.
    pub fn land(&self, order: usize, places: impl Iterator<Item = (f64, [f64; 2])>) -> Vec<Landing> {
        let rays: Vec<Ray> =
            places.map(|(rho, [cos, sin])| self.ray([self.center + rho * cos, rho * sin])).collect();
        let mut paths = vec![Path::default(); rays.len()];
        let query = Query { max_crossings: order + 1, ..Query::default() };
        self.tracer.trace_all(&rays, &query, &mut paths);
        let landing = |path: &Path| match (path.crossings.get(order), path.fate) {
            (Some(crossing), _) if crossing.r > 0.0 => Landing::At(crossing.r.sqrt().recip()),
            (_, Fate::Captured) => Landing::Captured,
            (_, Fate::Escaped) => Landing::Sky,
            _ => Landing::Lost,
        };
        paths.iter().map(landing).collect()
    }
}
