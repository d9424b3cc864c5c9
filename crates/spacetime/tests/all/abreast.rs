//! Rays on lanes find what rays alone find, whichever are beside them.

use crate::common;

use common::{Random, distance, unit};
use kerrscope_spacetime::Level;
use kerrscope_spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Side, Tracer};
use kerrscope_spacetime::metric::{Components, Kerr, Metric};
use kerrscope_spacetime::observer::{Motion, Observer, Place, impact_ray};
use std::f64::consts::PI;

/// Rays of cameras from 1.3 horizon radii to 10³ M, some next to the axis or in the plane, and of screens at
/// infinity.
fn shots(random: &mut Random, spin: f64, count: usize) -> Vec<Ray> {
    let horizon = 1.0 + (1.0 - spin * spin).sqrt();
    let mut rays = Vec::with_capacity(count);
    while rays.len() < count {
        let theta = match rays.len() % 11 {
            0 => 0.0,
            1 => 0.5 * PI,
            2 => 1e-3,
            _ => random.within(-1.0, 1.0).acos(),
        };
        if rays.len() % 3 == 0 {
            let impact = [random.within(-12.0, 12.0), random.within(-12.0, 12.0)];
            rays.extend(impact_ray(Some(spin), theta, f64::INFINITY, impact));
            continue;
        }
        let place = Place { r: horizon * random.scale(1.3, 1e3), theta, phi: random.within(-3.0, 3.0) };
        rays.push(
            Observer::new(Some(spin), place, Motion::ZeroAngularMomentum).unwrap().ray(random.direction()),
        );
    }
    rays
}

fn kerr_tracer(spin: f64, scheme: Scheme) -> Integrator<Kerr> {
    Integrator::new(Kerr::new(spin), scheme, 10_000)
}

fn all(tracer: &dyn Tracer, rays: &[Ray], query: &Query) -> Vec<Path> {
    let mut paths = vec![Path::default(); rays.len()];
    tracer.trace_all(rays, query, &mut paths);
    paths
}

/// Every bit, NaN included.
fn bits(path: &Path) -> String {
    format!("{path:?}")
}

/// The largest difference of directions, radii, azimuths and, relative to the largest, times.
fn difference(one: &Path, other: &Path) -> f64 {
    let mut worst: f64 = 0.0;
    if let (Some(a), Some(b)) = (one.direction, other.direction) {
        worst = worst.max(distance(unit(a), unit(b)));
        // Turns count too, but next to the axis one way around is as good as the other.
        let turn = if a[0].sin() < 1e-3 { 0.0 } else { (a[1] - b[1]).abs() * a[0].sin() };
        worst = worst.max(turn);
    }
    for (a, b) in one.crossings.iter().zip(&other.crossings) {
        worst = worst.max((a.r / b.r - 1.0).abs()).max(distance(a.position, b.position) / b.r);
        // φ is steep at the horizon, as is the time.
        worst = worst.max((a.phi - b.phi).abs());
        let late = (a.elapsed - b.elapsed).abs() / b.elapsed.abs().max(b.r);
        worst = worst.max(if late.is_nan() { 0.0 } else { late });
    }
    worst
}

/// Both ways, every level, with time and without; for what sensitivity `of` a ray the differences are judged.
fn agree(
    make: impl Fn(Scheme, Level) -> Box<dyn Tracer>,
    rays: &[Ray],
    of: impl Fn(&Ray) -> f64,
    noise: f64,
) {
    let schemes = [Scheme::Dop853 { tolerance: 1e-9 }, Scheme::Tsit5 { tolerance: 1e-7 }];
    for scheme in schemes {
        for query in [
            Query { max_crossings: 3, ..Query::default() },
            Query { plane: [0.6, 0.0, 0.8], ..Query::default() },
            // Nearly edge on for a camera in the plane: rays dip through it.
            Query { plane: [0.999, 0.0, 0.0447], max_crossings: 2, ..Query::default() },
            Query { elapsed: true, plane: [0.6, 0.0, 0.8], ..Query::default() },
        ] {
            for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
                let tracer = make(scheme, level);
                let found = all(tracer.as_ref(), rays, &query);
                // Backwards and in small parts: the same bytes.
                let mut turned: Vec<Ray> = rays.to_vec();
                turned.reverse();
                let mut again: Vec<Path> =
                    turned.chunks(13).flat_map(|some| all(tracer.as_ref(), some, &query)).collect();
                again.reverse();
                let (mut judged, mut single) = (0, Path::default());
                for ((ray, path), again) in rays.iter().zip(&found).zip(&again) {
                    assert_eq!(bits(path), bits(again), "the same bits beside other rays");
                    tracer.trace(ray, &query, &mut single);
                    let sensitivity = of(ray);
                    if sensitivity > 1e3 {
                        continue;
                    }
                    judged += 1;
                    let told = || format!("{level:?} {scheme:?} {ray:?}\n{path:?}\n{single:?}");
                    assert_eq!(path.fate, single.fate, "{}", told());
                    assert_eq!(path.crossings.len(), single.crossings.len(), "{}", told());
                    // A step on the edge of being refused may be taken by one of the two.
                    let steps = path.steps.abs_diff(single.steps);
                    assert!(steps <= 2 + single.steps / 10, "{}", told());
                    let farthest = path.crossings.iter().map(|c| c.r).fold(1.0, f64::max);
                    let rounding = noise * sensitivity * farthest;
                    let bound = rounding + if steps == 0 { 0.0 } else { 100.0 * single.error_estimate };
                    let apart = difference(path, &single);
                    assert!(apart <= bound, "{apart:e} > {bound:e}: {}", told());
                }
                assert!(judged * 10 > rays.len() * 9);
            }
        }
    }
}

#[test]
fn kerr() {
    let mut random = Random::new(11);
    for spin in [0.0, 0.3, -0.99] {
        let rays = shots(&mut random, spin, 330);
        let of = |ray: &Ray| Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
        let make = |scheme, level| -> Box<dyn Tracer> { kerr_tracer(spin, scheme).with_level(level).boxed() };
        agree(make, &rays, of, 1e-9);
    }
}

/// By components alone: on lanes as alone, and as by the metric's own equations, infinity included.
#[test]
fn components() {
    let mut random = Random::new(14);
    let spin = 0.9;
    let mut rays = shots(&mut random, spin, 330);
    // Over the axis rounding decides which way around it is.
    rays.retain(|ray| ray.start.j[2].abs() > 1e-6);
    let query = Query { elapsed: true, ..Query::default() };
    let scheme = Scheme::Dop853 { tolerance: 1e-9 };
    let exact = kerr_tracer(spin, scheme).boxed();
    let of = |ray: &Ray| Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
    let make = |scheme, level| -> Box<dyn Tracer> {
        Integrator::new(Components(Kerr::new(spin)), scheme, 10_000).with_level(level).boxed()
    };
    agree(make, &rays, of, 1e-8);
    let tracer = make(scheme, Level::best());
    let (mut known, mut found) = (Path::default(), Path::default());
    let mut apart = Vec::new();
    for ray in &rays {
        let sensitivity = of(ray);
        if sensitivity < 1e3 {
            exact.trace(ray, &query, &mut known);
            tracer.trace(ray, &query, &mut found);
            let told = || format!("{ray:?}\n{known:?}\n{found:?}");
            assert_eq!(known.fate, found.fate, "{}", told());
            assert_eq!(known.crossings.len(), found.crossings.len(), "{}", told());
            let farthest = known.crossings.iter().map(|c| c.r).fold(1.0, f64::max);
            apart.push(difference(&known, &found) / (sensitivity * farthest));
        }
    }
    apart.sort_by(f64::total_cmp);
    let (median, worst) = (apart[apart.len() / 2], apart[apart.len() - 1]);
    println!("components alone: median {median:.1e}, worst {worst:.1e}");
    assert!(median < 1e-10 && worst < 1e-8, "{median:e} {worst:e}");
}

/// Rays that are given up, cannot be followed or go another way leave those beside them alone.
#[test]
fn company() {
    let (spin, query) = (0.9, Query::default());
    let mut rays = shots(&mut Random::new(15), spin, 40);
    let tracer = kerr_tracer(spin, Scheme::Dop853 { tolerance: 1e-9 }).boxed();
    let good = all(tracer.as_ref(), &rays, &query);
    let mut broken = rays[0];
    broken.start.q = f64::NAN;
    rays.insert(3, broken);
    let falling = Place { r: 1.2, theta: 1.0, phi: 0.0 };
    let inside = Observer::new(Some(spin), falling, Motion::Fall).unwrap().ray([1.0, 0.0, 0.0]);
    assert_eq!(inside.side, Side::Ingoing);
    rays.insert(20, inside);
    let mut mixed = all(tracer.as_ref(), &rays, &query);
    let mut single = Path::default();
    tracer.trace(&inside, &query, &mut single);
    assert_eq!(bits(&mixed.remove(20)), bits(&single));
    assert_eq!(mixed.remove(3).fate, Fate::StepLimit);
    for (mixed, good) in mixed.iter().zip(&good) {
        assert_eq!(bits(mixed), bits(good));
    }
    // The limit of steps holds for each ray by itself.
    let limit = good.iter().map(|path| path.steps).sum::<usize>() / good.len();
    let short = Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-9 }, limit).boxed();
    rays.remove(20);
    rays.remove(3);
    for (short, good) in all(short.as_ref(), &rays, &query).iter().zip(&good) {
        if good.steps <= limit {
            assert_eq!(bits(short), bits(good));
        } else {
            assert_eq!((short.fate, short.steps), (Fate::StepLimit, limit));
        }
    }
    assert!(all(tracer.as_ref(), &[], &query).is_empty());
}
