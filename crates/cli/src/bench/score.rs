//! A line of the table: speed and error of one engine.

use super::contender::Contender;
use super::course::{Answer, Counts, Course, SPIN};
use kerrscope::spacetime::metric::{Kerr, Metric};
use serde::Serialize;
use std::fmt;
use std::time::Instant;

/// Passes, of which there are an odd number, go on until they took so long, CPU seconds, …
const ENOUGH: f64 = 1.5;
/// … and there were so many, …
const FEWEST_PASSES: usize = 3;
/// … or so many.
const MOST_PASSES: usize = 9;

#[derive(Serialize)]
pub struct Row {
    engine: &'static str,
    method: &'static str,
    tolerance: Option<f64>,
    simd: &'static str,
    threads: u32,
    rays: usize,
    captured: usize,
    escaped: usize,
    crossings_total: usize,
    wall_s: f64,
    cpu_s: f64,
    rays_per_cpu_s: f64,
    sky_error_median: f64,
    sky_error_max: f64,
    radius_error_median: f64,
    radius_error_max: f64,
    /// Largest radius error, near the critical curve too, as a share of max(10⁻⁸, 10⁻¹⁴ r/δ).
    radius_error_share_of_bound: f64,
    /// Rays whose crossings are not as many, or of which only one escapes.
    mismatched: usize,
}

impl Row {
    pub const HEADING: &'static str = "engine       method             tolerance simd      rays/s/core  sky error median / max   radius error median / max    mismatched";

    /// Measures a contender; `exact` is what the answers for the whole course are compared with.
    pub fn of(contender: &Contender, whole: &Course, exact: &[Answer], threads: u32) -> Self {
        let tracer = contender.tracer.as_ref();
        let course = &whole.one_in(contender.one_in);
        let mut passes: Vec<(f64, Counts)> = Vec::new();
        let enough = |passes: &[(f64, Counts)]| {
            let cpu_s: f64 = passes.iter().map(|pass| pass.1.cpu_s).sum();
            let count = passes.len();
            count >= MOST_PASSES || count % 2 == 1 && count >= FEWEST_PASSES && cpu_s >= ENOUGH
        };
        while !enough(&passes) {
            let start = Instant::now();
            let counts = course.pass(tracer);
            passes.push((start.elapsed().as_secs_f64(), counts));
        }
        passes.sort_by(|a, b| a.1.cpu_s.total_cmp(&b.1.cpu_s));
        let (wall_s, counts) = passes[passes.len() / 2];
        let cpu_s = counts.cpu_s;
        let errors =
            Errors::new(course, exact.iter().step_by(contender.one_in), &course.answers(tracer, false));
        Self {
            engine: contender.engine,
            method: contender.method,
            tolerance: contender.tolerance,
            simd: contender.level.name(),
            threads,
            rays: course.rays.len(),
            captured: counts.captured,
            escaped: counts.escaped,
            crossings_total: counts.crossings,
            wall_s,
            cpu_s,
            rays_per_cpu_s: course.rays.len() as f64 / cpu_s,
            sky_error_median: middle(&errors.sky),
            sky_error_max: last(&errors.sky),
            radius_error_median: middle(&errors.radius),
            radius_error_max: last(&errors.radius),
            radius_error_share_of_bound: errors.share,
            mismatched: errors.mismatched,
        }
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let tolerance = self.tolerance.map_or_else(|| "-".to_owned(), |t| format!("{t:.0e}"));
        write!(
            f,
            "{:<12} {:<18} {tolerance:>9} {:<9} {:>11.0}",
            self.engine, self.method, self.simd, self.rays_per_cpu_s
        )?;
        write!(f, "{:>14.1e} / {:.1e}", self.sky_error_median, self.sky_error_max)?;
        write!(f, "{:>17.1e} / {:.1e}", self.radius_error_median, self.radius_error_max)?;
        write!(f, "{:>17}", self.mismatched)
    }
}

/// Errors outside 1 % of the critical curve, sorted.
struct Errors {
    sky: Vec<f64>,
    radius: Vec<f64>,
    share: f64,
    mismatched: usize,
}

impl Errors {
    fn new<'a>(course: &Course, exact: impl Iterator<Item = &'a Answer>, found: &[Answer]) -> Self {
        let metric = Kerr::new(-SPIN);
        let mut errors = Self { sky: Vec::new(), radius: Vec::new(), share: 0.0, mismatched: 0 };
        for ((ray, exact), found) in course.rays.iter().zip(exact).zip(found) {
            // This is 1/(2δ) next to the critical curve.
            let sensitivity = metric.sensitivity(ray.energy, &ray.start);
            let alike = exact.radii.len() == found.radii.len()
                && exact.direction.is_some() == found.direction.is_some();
            errors.mismatched += usize::from(!alike);
            for (a, b) in exact.radii.iter().zip(&found.radii) {
                let error = (b / a - 1.0).abs();
                errors.share = errors.share.max(error / f64::max(1e-8, 2e-14 * a * sensitivity));
                if sensitivity < 50.0 {
                    errors.radius.push(error);
                }
            }
            if let (Some(a), Some(b)) = (exact.direction, found.direction)
                && sensitivity < 50.0
            {
                errors.sky.push(angle(a, b));
            }
        }
        errors.sky.sort_by(f64::total_cmp);
        errors.radius.sort_by(f64::total_cmp);
        errors
    }
}

fn middle(sorted: &[f64]) -> f64 {
    sorted.get(sorted.len() / 2).copied().unwrap_or(0.0)
}

fn last(sorted: &[f64]) -> f64 {
    sorted.last().copied().unwrap_or(0.0)
}

/// Angle between two directions (θ, φ).
fn angle([t1, p1]: [f64; 2], [t2, p2]: [f64; 2]) -> f64 {
    let half = |x: f64| (0.5 * x).sin();
    let chord = half(t1 - t2).powi(2) + t1.sin() * t2.sin() * half(p1 - p2).powi(2);
    2.0 * chord.sqrt().min(1.0).asin()
}
