//! How long the pieces of a picture take: `cargo bench -p kerrscope`.
//!
//! Whole rays with their errors are measured by `kerrscope bench`, whole commands by
//! `cargo xtask campaign speed`.

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use kerrscope::camera::Camera;
use kerrscope::disk::{Disk, DiskHit, Matter, Plane, Ring, Shifts, Surface};
use kerrscope::display::{Depth, Display, Picture};
use kerrscope::output::{Provenance, png};
use kerrscope::render::{Film, Replay, Sampler, Stage, Tally};
use kerrscope::scene::Scene;
use kerrscope::sky::{Orientation, Sky, Stars, towards};
use kerrscope::spacetime::Level;
use kerrscope::spacetime::closed::{ClosedForm, NODES};
use kerrscope::spacetime::geodesic::{Integrator, Path as Ray, Query, Scheme, Tracer};
use kerrscope::spacetime::metric::{Kerr, Metric, rate_from_components};
use kerrscope::spacetime::observer::impact_ray;

const SPIN: f64 = 0.99;
/// Rays traced together.
const BATCH: usize = 1024;

/// Closed form and integrator by the kind of ray: far from the hole, bent around it, captured.
fn rays(criterion: &mut Criterion) {
    let kinds = [("distant", [9.0, 14.0]), ("bent", [5.3, 6.5]), ("captured", [0.5, 4.0])];
    let closed = ClosedForm::new(SPIN, NODES, 10_000);
    let integrator = Integrator::new(Kerr::new(SPIN), Scheme::Dop853 { tolerance: 1e-8 }, 10_000).boxed();
    for (engine, tracer) in [("closed form", &closed as &dyn Tracer), ("integrator", integrator.as_ref())] {
        let mut group = criterion.benchmark_group(engine);
        group.throughput(Throughput::Elements(BATCH as u64));
        for (name, [least, most]) in kinds {
            let rays: Vec<_> = (0..BATCH)
                .map(|k| {
                    let share = k as f64 / BATCH as f64;
                    let (b, angle) = (least + (most - least) * share, 2.4 * k as f64);
                    impact_ray(Some(SPIN), 1.0, 1000.0, [b * angle.cos(), b * angle.sin()])
                })
                .collect::<Result<_, _>>()
                .expect("photons of these impact parameters arrive");
            let mut paths = vec![Ray::default(); BATCH];
            for (asked, elapsed) in [("", false), (" with time", true)] {
                let query = Query { max_crossings: 3, elapsed, ..Query::default() };
                group.bench_function(format!("{name}{asked}"), |b| {
                    b.iter(|| tracer.trace_all(black_box(&rays), &query, &mut paths));
                });
            }
            group.bench_function(format!("{name}, one by one"), |b| {
                let query = Query { max_crossings: 3, ..Query::default() };
                b.iter(|| {
                    for (ray, path) in rays.iter().zip(&mut paths) {
                        tracer.trace(black_box(ray), &query, path);
                    }
                });
            });
        }
    }
}

/// The right-hand side of the equations of motion, written by hand and by dual numbers.
fn motion(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("motion");
    let (metric, x, p) = (Kerr::new(SPIN), [6.0, 2.0, -1.0], [-0.7, 0.6, 0.2]);
    group.bench_function("by hand", |b| b.iter(|| metric.rate(1.0, black_box(&x), black_box(&p))));
    group.bench_function("by duals", |b| {
        b.iter(|| rate_from_components(&metric, 1.0, black_box(&x), black_box(&p)));
    });
}

/// What stands around the rays.
fn shading(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("shading");
    let sampler = Sampler::new(16, 1, true);
    group.bench_function("place of a sample", |b| b.iter(|| sampler.place(black_box(77), black_box(5))));
    let scene = Scene::built_in();
    let camera = Camera::new(&scene).expect("the built-in scene is valid");
    group.bench_function("ray of a camera", |b| b.iter(|| camera.ray(black_box(300.2), black_box(100.7))));
    let disk = Disk {
        inner: 6.0,
        outer: 16.0,
        plane: Plane::EQUATOR,
        surface: Surface::Ring(Ring::new(1)),
        tint: [1.0; 3],
        opacity: 1.0,
        matter: Matter { orbits: None, shifts: Shifts::NONE },
        thin: false,
        orders: None,
        time: None,
    };
    group.bench_function("ring", |b| {
        b.iter(|| {
            disk.sheet(black_box(&DiskHit {
                radius: 9.3,
                azimuth: 0.7,
                order: 0,
                light: None,
                elapsed: f64::NAN,
            }))
        });
    });
    let stars = Sky::Stars(Stars::new(1e-3, Orientation::upright(0.0), 1.0));
    group.bench_function("stars", |b| b.iter(|| stars.radiance(black_box(towards(1.2, 0.3)), 1e-3)));
}

/// From light to a file.
fn pictures(criterion: &mut Criterion) {
    let text = "render = { width = 480, height = 270, samples = 1 }";
    let scene = Scene::from_toml(text, Path::new("")).expect("a valid scene");
    let stage = Stage::new(&scene).expect("a scene without pictures");
    let (mut replay, mut tally) = (Replay::default(), Tally::default());
    let mut film = Film::blank(stage.size(), None, &[], Level::best());
    for (k, light) in film.light.iter_mut().enumerate() {
        let pixel = [k as u32 % 480, k as u32 / 480];
        *light = stage.pixel(pixel, &mut replay, &mut tally).rgb.map(|c| c as f32);
    }
    let picture: Picture = Display::default().develop(&film);
    let made = Provenance::of(&scene, &film);
    let mut group = criterion.benchmark_group("picture of 480 × 270");
    group.throughput(Throughput::Elements(480 * 270));
    group.bench_function("developed", |b| b.iter(|| Display::default().develop(black_box(&film))));
    group.bench_function("as PNG", |b| {
        b.iter(|| png::encode(Vec::new(), black_box(&picture), Depth::Eight, &made));
    });
    group.bench_function("traced pixel by pixel", |b| {
        b.iter(|| stage.pixel(black_box([240, 100]), &mut replay, &mut tally));
    });
}

criterion_group!(pieces, rays, motion, shading, pictures);
criterion_main!(pieces);
