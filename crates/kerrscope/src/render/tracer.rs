//! What traces the rays of a scene.

use crate::scene::{Engine, Method, Scene, Spacetime};
use crate::spacetime::Level;
use crate::spacetime::closed::{ClosedForm, NODES};
use crate::spacetime::geodesic::{Integrator, Scheme, Straight, Tracer};
use crate::spacetime::metric::{Kerr, Schwarzschild};

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
    match (scene.spacetime.spin(), render.engine) {
        (Some(spin), Engine::ClosedForm) => Box::new(ClosedForm::new(spin, NODES, steps).with_level(level)),
        _ => match scene.spacetime {
            Spacetime::Minkowski => Box::new(Straight),
            Spacetime::Schwarzschild => {
                Box::new(Integrator::new(Schwarzschild, scheme, steps).with_level(level))
            }
            Spacetime::Kerr { spin } => {
                Box::new(Integrator::new(Kerr::new(spin), scheme, steps).with_level(level))
            }
        },
    }
}
