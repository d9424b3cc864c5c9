//! The engines that are measured.

use super::course::SPIN;
use kerrscope::scene::Scene;
use kerrscope::spacetime::Level;
use kerrscope::spacetime::closed::ClosedForm;
use kerrscope::spacetime::geodesic::{Integrator, Scheme, TextTracer, Tracer};
use kerrscope::spacetime::metric::{Components, Kerr, LineElement};
use std::path::Path;
use std::sync::Arc;

/// The names of engines.
pub const ENGINES: [&str; 4] = ["closed-form", "integrator", "components", "text"];

/// Steps after which a ray is given up.
const MOST_STEPS: usize = 100_000;

/// An engine with its settings.
pub struct Contender {
    pub engine: &'static str,
    pub method: &'static str,
    pub tolerance: Option<f64>,
    pub level: Level,
    /// Of the whole course only one ray in so many is followed, for it takes long.
    pub one_in: usize,
    pub tracer: Box<dyn Tracer>,
}

impl Contender {
    /// Every engine and method, at every level that this processor has.
    pub fn all() -> Vec<Self> {
        let levels = || Level::ALL.into_iter().rev().filter(|level| level.is_available());
        let closed = |(method, nodes), level| Self {
            engine: ENGINES[0],
            method,
            tolerance: None,
            level,
            one_in: 1,
            tracer: Box::new(ClosedForm::new(SPIN, nodes, MOST_STEPS).with_level(level)),
        };
        let mut all = Vec::new();
        for quadrature in [("gauss-legendre-24", 24), ("gauss-legendre-12", 12)] {
            all.extend(levels().map(|level| closed(quadrature, level)));
        }
        let schemes = [
            ("dop853", Scheme::Dop853 { tolerance: 1e-8 }),
            ("dop853", Scheme::Dop853 { tolerance: 1e-10 }),
            ("tsit5", Scheme::Tsit5 { tolerance: 1e-6 }),
            ("rk4", Scheme::Rk4 { step: 0.1 }),
        ];
        for (method, scheme) in schemes {
            let tolerance = match scheme {
                Scheme::Rk4 { .. } => None,
                Scheme::Tsit5 { tolerance } | Scheme::Dop853 { tolerance } => Some(tolerance),
            };
            // Constant steps are not taken on lanes. They are two hundred times slower; a prime number skips
            // through all columns of the picture.
            let slow = tolerance.is_none();
            let one_in = if slow { 61 } else { 1 };
            for level in levels().filter(|level| !slow || *level == Level::Baseline) {
                let tracer = Integrator::new(Kerr::new(SPIN), scheme, MOST_STEPS).with_level(level);
                let tracer = tracer.boxed();
                all.push(Self { engine: ENGINES[1], method, tolerance, level, one_in, tracer });
            }
        }
        let scheme = Scheme::Tsit5 { tolerance: 1e-6 };
        for level in levels() {
            let tracer = Integrator::new(Components(Kerr::new(SPIN)), scheme, MOST_STEPS).with_level(level);
            all.push(Self {
                engine: ENGINES[2],
                method: "tsit5",
                tolerance: Some(1e-6),
                level,
                one_in: 1,
                tracer: tracer.boxed(),
            });
        }
        for level in levels() {
            all.extend(text().map(|element| Self {
                engine: ENGINES[3],
                method: "tsit5",
                tolerance: Some(1e-6),
                level,
                one_in: 1,
                tracer: Box::new(TextTracer::new(element, scheme, MOST_STEPS).with_level(level)),
            }));
        }
        all
    }
}

/// The same hole as text; its formulas are the program's own, and compile.
fn text() -> Option<Arc<LineElement>> {
    let keys = format!(
        "spacetime = {{ name = \"kerr-text\", parameters = {{ spin = {SPIN} }} }}\ndisk.model = \"none\""
    );
    let scene = Scene::from_toml(&keys, Path::new("")).ok()?;
    scene.spacetime.text().cloned()
}

/// What the others are compared with: 48 nodes leave nothing but rounding.
pub fn exact() -> Box<dyn Tracer> {
    Box::new(ClosedForm::new(SPIN, 48, MOST_STEPS))
}
