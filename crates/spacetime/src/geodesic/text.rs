//! Rays in a metric that somebody wrote.

use super::{Integrator, ObstacleTracer, Obstacles, Path, Query, Ray, Scheme, Tracer};
use crate::lanes::Level;
use crate::metric::{LineElement, Text};
use std::sync::Arc;

/// The integrator's tracer in a stationary [`LineElement`]. With constant steps ([`Scheme::Rk4`]) light is not followed
/// through a throat or to an edge: it ends captured at the one, and in flat space behind the other.
#[derive(Clone, Debug)]
pub struct TextTracer {
    element: Arc<LineElement>,
    scheme: Scheme,
    max_steps: usize,
    level: Level,
}

impl TextTracer {
    /// A tracer that gives up on a ray after `max_steps` steps.
    pub fn new(element: Arc<LineElement>, scheme: Scheme, max_steps: usize) -> Self {
        Self { element, scheme, max_steps, level: Level::best() }
    }

    /// The same with these vector instructions instead of the best that the processor has.
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    fn integrator(&self) -> Integrator<Text<'_>> {
        Integrator::new(Text::new(&self.element), self.scheme, self.max_steps).with_level(self.level)
    }
}

impl Tracer for TextTracer {
    fn name(&self) -> &'static str {
        "text"
    }

    #[inline(never)]
    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        self.integrator().trace(ray, query, path);
    }

    #[inline(never)]
    fn trace_all(&self, rays: &[Ray], query: &Query, paths: &mut [Path]) {
        self.integrator().trace_all(rays, query, paths);
    }
}

impl ObstacleTracer for TextTracer {
    /// Behind a throat nothing is met: things stand on this side.
    #[inline(never)]
    fn trace_among(&self, ray: &Ray, query: &Query, obstacles: &dyn Obstacles, path: &mut Path) {
        self.integrator().trace_among(ray, query, obstacles, path);
    }
}
