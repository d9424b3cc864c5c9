//! The rays that all engines follow.

use crate::report::Failure;
use cpu_time::ThreadTime;
use kerrscope::spacetime::geodesic::{Fate, Path, Query, Ray, Tracer};
use kerrscope::spacetime::observer::{Motion, Observer, Place};
use rayon::prelude::*;

/// Of the hole.
pub const SPIN: f64 = 0.99;
/// Rays along an edge.
const EDGE: u32 = 800;
/// Rays followed together.
const BATCH: usize = 1000;

/// The rays.
pub struct Course {
    pub rays: Vec<Ray>,
}

/// What a pass finds in all.
#[derive(Clone, Copy, Default)]
pub struct Counts {
    pub captured: usize,
    pub escaped: usize,
    pub crossings: usize,
    /// CPU time of the tracing alone, all threads together, in seconds.
    pub cpu_s: f64,
}

/// What is kept of a path.
pub struct Answer {
    pub radii: Vec<f64>,
    pub direction: Option<[f64; 2]>,
}

impl Course {
    /// Every `thin`-th ray in each direction.
    pub fn new(thin: u32) -> Result<Self, Failure> {
        let place = Place { r: 30.0, theta: 80f64.to_radians(), phi: 0.0 };
        let observer = Observer::new(Some(SPIN), place, Motion::ZeroAngularMomentum)
            .map_err(|e| Failure::Failed(e.to_string()))?;
        // Off the symmetry axis by a little, as a picture's random samples are.
        let tangent = |k: u32| 0.62 * ((f64::from(k) + 0.5) / f64::from(EDGE) * 2.0 - 1.0 + 1e-5);
        let step = thin as usize;
        let pixels = (0..EDGE).step_by(step).flat_map(|j| (0..EDGE).step_by(step).map(move |i| (i, j)));
        let ray = |(i, j)| {
            let (x, y) = (tangent(i), tangent(j));
            let length = (1.0 + x * x + y * y).sqrt();
            observer.ray([-1.0 / length, -y / length, x / length])
        };
        Ok(Self { rays: pixels.map(ray).collect() })
    }

    /// One ray in so many.
    pub fn one_in(&self, many: usize) -> Self {
        Self { rays: self.rays.iter().step_by(many).copied().collect() }
    }

    /// Follows every ray, and counts what is found.
    pub fn pass(&self, tracer: &dyn Tracer) -> Counts {
        let query = Query { max_crossings: 3, ..Query::default() };
        let count = |(batch, paths): &mut (Vec<Ray>, Vec<Path>), rays: &[Ray]| {
            // A render makes its rays just before; here they come from far away in memory.
            batch.clear();
            batch.extend_from_slice(rays);
            paths.resize_with(rays.len(), Path::default);
            let cpu = ThreadTime::now();
            tracer.trace_all(batch, &query, paths);
            let mut counts = Counts { cpu_s: cpu.elapsed().as_secs_f64(), ..Counts::default() };
            for path in &*paths {
                counts.captured += usize::from(path.fate == Fate::Captured);
                counts.escaped += usize::from(path.fate == Fate::Escaped);
                counts.crossings += path.crossings.len();
            }
            counts
        };
        let add = |a: Counts, b: Counts| Counts {
            captured: a.captured + b.captured,
            escaped: a.escaped + b.escaped,
            crossings: a.crossings + b.crossings,
            cpu_s: a.cpu_s + b.cpu_s,
        };
        self.rays.par_chunks(BATCH).map_init(Default::default, count).reduce(Counts::default, add)
    }

    /// Follows every ray, and keeps what is found. Elapsed time is asked for when the answers are to
    /// compare others with: distant light is then followed like the rest.
    pub fn answers(&self, tracer: &dyn Tracer, elapsed: bool) -> Vec<Answer> {
        let query = Query { max_crossings: 3, elapsed, ..Query::default() };
        let keep = |rays: &[Ray]| {
            let mut paths = vec![Path::default(); rays.len()];
            tracer.trace_all(rays, &query, &mut paths);
            paths.into_iter().map(|path| Answer {
                radii: path.crossings.iter().map(|c| c.r).collect(),
                direction: path.direction,
            })
        };
        self.rays.par_chunks(BATCH).flat_map_iter(keep).collect()
    }
}
