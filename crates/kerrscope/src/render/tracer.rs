//! What traces the rays of a scene.

use crate::scene::{Coordinates, Engine, Method, Scene, Spacetime};
use crate::spacetime::Level;
use crate::spacetime::closed::{ClosedForm, NODES};
use crate::spacetime::geodesic::{
    Integrator, ObstacleTracer, Scheme, SphericalIntegrator, Straight, TextTracer, Tracer,
};
use crate::spacetime::metric::{Kerr, LineElement};
use std::sync::Arc;

/// The tracer that a scene asks for, with the instructions of a level.
pub fn tracer(scene: &Scene, level: Level) -> Box<dyn Tracer> {
    if let Spacetime::Text(element) = &scene.spacetime {
        return Box::new(text(scene, element).with_level(level));
    }
    match (scene.spacetime.spin(), scene.render.engine) {
        (None, _) => Box::new(Straight),
        (Some(spin), Engine::ClosedForm) => {
            Box::new(ClosedForm::new(spin, NODES, scene.render.max_steps as usize).with_level(level))
        }
        (Some(spin), _) if scene.render.coordinates != Coordinates::KerrSchild => {
            Box::new(SphericalIntegrator::new(spin, scheme(scene), scene.render.max_steps as usize))
        }
        (Some(spin), _) => integrator(scene, spin).with_level(level).boxed(),
    }
}

/// Steps after which a ray around a hole without a scene is given up.
const MAX_STEPS: usize = 100_000;

/// Tolerance of its integrator.
const TOLERANCE: f64 = 1e-12;

/// The tracer of an engine's name around a hole of spin a in [−1, 1], without a scene: "auto" and "closed-form", or "integrator".
///
/// # Errors
/// If no engine is called so.
pub fn hole_tracer(engine: &str, spin: f64) -> Result<Box<dyn Tracer>, String> {
    match engine {
        "auto" | "closed-form" => Ok(Box::new(ClosedForm::new(spin, NODES, MAX_STEPS))),
        "integrator" => {
            let scheme = Scheme::Dop853 { tolerance: TOLERANCE };
            Ok(Integrator::new(Kerr::new(spin), scheme, MAX_STEPS).boxed())
        }
        engine => Err(format!("no engine is called {engine:?}: give auto, closed-form or integrator")),
    }
}

/// The tracer of a scene whose rays meet things. It follows them one by one.
pub fn obstacle_tracer(scene: &Scene) -> Box<dyn ObstacleTracer> {
    match (&scene.spacetime, scene.spacetime.spin()) {
        (Spacetime::Text(element), _) => Box::new(text(scene, element)),
        (_, None) => Box::new(Straight),
        (_, Some(spin)) => integrator(scene, spin).boxed(),
    }
}

fn text(scene: &Scene, element: &Arc<LineElement>) -> TextTracer {
    TextTracer::new(Arc::clone(element), scheme(scene), scene.render.max_steps as usize)
}

fn integrator(scene: &Scene, spin: f64) -> Integrator<Kerr> {
    // A hole without spin has the same coordinates.
    Integrator::new(Kerr::new(spin), scheme(scene), scene.render.max_steps as usize)
}

fn scheme(scene: &Scene) -> Scheme {
    let tolerance = scene.render.tolerance;
    match scene.render.method {
        Method::Rk4 => Scheme::Rk4 { step: scene.render.step },
        Method::Tsit5 => Scheme::Tsit5 { tolerance },
        Method::Dop853 => Scheme::Dop853 { tolerance },
    }
}
