//! What traces the rays of a scene.

use crate::scene::{Engine, Method, Scene, Spacetime};
use crate::spacetime::Level;
use crate::spacetime::closed::{ClosedForm, NODES};
use crate::spacetime::geodesic::{Integrator, Scheme, Straight, TextTracer, Tracer};
use crate::spacetime::metric::Kerr;
use std::sync::Arc;

/// The tracer that a scene asks for, with the instructions of a level.
pub fn tracer(scene: &Scene, level: Level) -> Box<dyn Tracer> {
    let render = &scene.render;
    let tolerance = render.tolerance;
    let scheme = match render.method {
        Method::Rk4 => Scheme::Rk4 { step: render.step },
        Method::Tsit5 => Scheme::Tsit5 { tolerance },
        Method::Dop853 => Scheme::Dop853 { tolerance },
    };
    let steps = render.max_steps as usize;
    if let Spacetime::Text(element) = &scene.spacetime {
        return Box::new(TextTracer::new(Arc::clone(element), scheme, steps).with_level(level));
    }
    match (scene.spacetime.spin(), render.engine) {
        (None, _) => Box::new(Straight),
        (Some(spin), Engine::ClosedForm) => Box::new(ClosedForm::new(spin, NODES, steps).with_level(level)),
        // A hole without spin has the same coordinates.
        (Some(spin), _) => Integrator::new(Kerr::new(spin), scheme, steps).with_level(level).boxed(),
    }
}
