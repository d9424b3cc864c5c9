//! What traces the rays of a scene.

use crate::scene::{Coordinates, Engine, Method, Scene};
use crate::spacetime::Level;
use crate::spacetime::closed::{ClosedForm, NODES};
use crate::spacetime::geodesic::{Integrator, Scheme, SphericalIntegrator, Straight, Tracer};
use crate::spacetime::metric::Kerr;

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
        (None, _) => Box::new(Straight),
        (Some(spin), Engine::ClosedForm) => Box::new(ClosedForm::new(spin, NODES, steps).with_level(level)),
        (Some(spin), _) if render.coordinates != Coordinates::KerrSchild => {
            Box::new(SphericalIntegrator::new(spin, scheme, steps))
        }
        // A hole without spin has the same coordinates.
        (Some(spin), _) => Integrator::new(Kerr::new(spin), scheme, steps).with_level(level).boxed(),
    }
}
