//! `kerrscope bench`: rays per second, and how exact they are.
//!
//! 640,000 rays around a = 0.99: a camera of zero angular momentum at r = 30, θ = 80°, tangents
//! within ±0.62, 400 × 400 pixels of 2 × 2 samples; each ray is followed to its end, with up to
//! three equatorial crossings and its direction. Errors are against the integrator at a
//! tolerance of 1e-13 on the same rays, outside 1 % of the critical curve.

use crate::report::Failure;
use crate::{Format, print, print_json};
use cpu_time::ProcessTime;

use kerrscope::spacetime::Level;
use kerrscope::spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Tracer};
use kerrscope::spacetime::metric::{Kerr, Metric};
use kerrscope::spacetime::observer::{Motion, Observer, Place};
use rayon::prelude::*;
use serde::Serialize;
use std::time::Instant;

const SPIN: f64 = 0.99;
const EDGE: u32 = 800;
const BATCH: usize = 4000;

/// Errors are sky angle in radians and relative crossing radius.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// Threads to use
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=1024))]
    threads: u32,
    /// Use only every N-th ray in each direction
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100))]
    thin: u32,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Serialize)]
struct Row {
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
}

#[derive(Clone, Copy)]
struct Time {
    wall_s: f64,
    cpu_s: f64,
}

/// What is kept of a path.
struct Answer {
    fate: Fate,
    radii: Vec<f64>,
    direction: Option<[f64; 2]>,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(arguments.threads as usize)
        .build()
        .map_err(|e| Failure::Failed(format!("no threads: {e}")))?;
    let rays = rays(arguments.thin)?;
    let schemes = [
        ("dop853", Scheme::Dop853 { tolerance: 1e-6 }, Some(1e-6)),
        ("dop853", Scheme::Dop853 { tolerance: 1e-8 }, Some(1e-8)),
        ("dop853", Scheme::Dop853 { tolerance: 1e-10 }, Some(1e-10)),
        ("tsit5", Scheme::Tsit5 { tolerance: 1e-6 }, Some(1e-6)),
        ("rk4", Scheme::Rk4 { step: 0.1 }, None),
    ];
    let exact = pool.install(|| trace(&rays, Scheme::Dop853 { tolerance: 1e-13 }));
    let mut rows = Vec::new();
    for (method, scheme, tolerance) in schemes {
        let (start, cpu) = (Instant::now(), ProcessTime::now());
        let found = pool.install(|| trace(&rays, scheme));
        let time = Time { wall_s: start.elapsed().as_secs_f64(), cpu_s: cpu.elapsed().as_secs_f64() };
        rows.push(row(method, tolerance, arguments.threads, [&exact, &found], &rays, time));
    }
    if arguments.format == Format::Json {
        return print_json(&rows);
    }
    print(
        "engine      method  tolerance  rays/s/core   sky error median / max    radius error median / max",
    )?;
    for row in rows {
        let tolerance = row.tolerance.map_or_else(|| "-".to_owned(), |t| format!("{t:.0e}"));
        print(&format!(
            "{:<11} {:<7} {:>9} {:>12.0} {:>12.1e} / {:.1e} {:>15.1e} / {:.1e}",
            row.engine,
            row.method,
            tolerance,
            row.rays_per_cpu_s,
            row.sky_error_median,
            row.sky_error_max,
            row.radius_error_median,
            row.radius_error_max
        ))?;
    }
    Ok(())
}

fn rays(thin: u32) -> Result<Vec<Ray>, Failure> {
    let place = Place { r: 30.0, theta: 80f64.to_radians(), phi: 0.0 };
    let observer = Observer::new(Some(SPIN), place, Motion::ZeroAngularMomentum)
        .map_err(|e| Failure::Failed(e.to_string()))?;
    let tangent = |k: u32| 0.62 * ((f64::from(k) + 0.5) / f64::from(EDGE) * 2.0 - 1.0 + 1e-5);
    let step = thin as usize;
    let rays = (0..EDGE).step_by(step).flat_map(|j| (0..EDGE).step_by(step).map(move |i| (i, j)));
    Ok(rays
        .map(|(i, j)| {
            let (x, y) = (tangent(i), tangent(j));
            let length = (1.0 + x * x + y * y).sqrt();
            observer.ray([-1.0 / length, -y / length, x / length])
        })
        .collect())
}

fn trace(rays: &[Ray], scheme: Scheme) -> Vec<Answer> {
    let tracer = Integrator::new(Kerr::new(SPIN), scheme, 100_000);
    let query = Query { max_crossings: 3, ..Query::default() };
    rays.par_chunks(BATCH)
        .flat_map_iter(|batch| {
            let mut path = Path::default();
            batch.iter().map(move |ray| {
                tracer.trace(ray, &query, &mut path);
                Answer {
                    fate: path.fate,
                    radii: path.crossings.iter().map(|c| c.r).collect(),
                    direction: path.direction,
                }
            })
        })
        .collect()
}

fn row(
    method: &'static str,
    tolerance: Option<f64>,
    threads: u32,
    [exact, found]: [&[Answer]; 2],
    rays: &[Ray],
    time: Time,
) -> Row {
    let metric = Kerr::new(-SPIN);
    let (mut sky, mut radius) = (Vec::new(), Vec::new());
    for ((ray, exact), found) in rays.iter().zip(exact).zip(found) {
        // 1/sensitivity is about the relative distance to the critical curve, doubled.
        if metric.sensitivity(ray.energy, &ray.start) > 50.0 {
            continue;
        }
        if let (Some(a), Some(b)) = (exact.direction, found.direction) {
            sky.push(angle(a, b));
        }
        radius.extend(exact.radii.iter().zip(&found.radii).map(|(a, b)| (b / a - 1.0).abs()));
    }
    sky.sort_by(f64::total_cmp);
    radius.sort_by(f64::total_cmp);
    let middle = |v: &[f64]| v.get(v.len() / 2).copied().unwrap_or(0.0);
    let last = |v: &[f64]| v.last().copied().unwrap_or(0.0);
    let count = |fate| found.iter().filter(|a| a.fate == fate).count();
    Row {
        engine: "integrator",
        method,
        tolerance,
        simd: Level::best().name(),
        threads,
        rays: rays.len(),
        captured: count(Fate::Captured),
        escaped: count(Fate::Escaped),
        crossings_total: found.iter().map(|a| a.radii.len()).sum(),
        wall_s: time.wall_s,
        cpu_s: time.cpu_s,
        rays_per_cpu_s: rays.len() as f64 / time.cpu_s,
        sky_error_median: middle(&sky),
        sky_error_max: last(&sky),
        radius_error_median: middle(&radius),
        radius_error_max: last(&radius),
    }
}

/// Angle between two directions (θ, φ).
fn angle([t1, p1]: [f64; 2], [t2, p2]: [f64; 2]) -> f64 {
    let half = |x: f64| (0.5 * x).sin();
    let chord = half(t1 - t2).powi(2) + t1.sin() * t2.sin() * half(p1 - p2).powi(2);
    2.0 * chord.sqrt().min(1.0).asin()
}
