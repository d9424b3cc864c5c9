//! What holds for every ray: any spin, place, motion and direction.

use crate::common;

use common::{Random, distance, folded, follow, largest, separation};
use kerrscope_spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Side};
use kerrscope_spacetime::kerr::{Orbits, ergosphere, horizons};
use kerrscope_spacetime::metric::{Kerr, Metric};
use kerrscope_spacetime::observer::{Motion, Observer, Place, impact_ray};
use kerrscope_spacetime::tensor::dot;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::f64::consts::{FRAC_PI_2, PI};

/// A camera outside the horizon, or at infinity, and a ray.
#[derive(Clone, Debug)]
struct Shot {
    spin: f64,
    place: Place,
    /// Printed when a test fails.
    #[allow(dead_code)]
    motion: Motion,
    ray: Ray,
    plane: [f64; 3],
}

fn spins() -> impl Strategy<Value = f64> {
    prop_oneof![
        1 => Just(0.0),
        1 => prop_oneof![Just(1.0), Just(-1.0)],
        1 => prop_oneof![Just(0.998), Just(-0.998), Just(1.0 - 1e-9), Just(1.0 - 1e-15), Just(1e-12)],
        4 => -1.0..1.0,
    ]
}

fn angles() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 1 => Just(FRAC_PI_2), 1 => Just(PI), 1 => Just(1e-9), 6 => 0.0..PI]
}

/// Unit vectors, the axes among them.
fn directions() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        1 => (0_usize..3, any::<bool>()).prop_map(|(axis, back)| {
            let mut n = [0.0; 3];
            n[axis] = if back { -1.0 } else { 1.0 };
            n
        }),
        6 => (-1.0..1.0, -PI..PI).prop_map(|(z, phi): (f64, f64)| {
            let ring = (1.0 - z * z).sqrt();
            [ring * phi.cos(), ring * phi.sin(), z]
        }),
    ]
}

fn planes() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![3 => Just([0.0, 0.0, 1.0]), 1 => directions()]
}

/// `kind` picks among the motions that are possible there.
fn motion(spin: f64, place: &Place, kind: u8, v: [f64; 3]) -> Motion {
    let outside = place.r > ergosphere(spin, place.theta) * 1.001;
    let orbits = place.theta == FRAC_PI_2 && place.r > Orbits::new(spin).photon_prograde * 1.01;
    match kind {
        0 | 1 if outside => Motion::Static,
        2 | 3 if orbits => Motion::Orbit,
        0 | 4 => Motion::ZeroAngularMomentum,
        1 | 5 => Motion::Fall,
        2 | 6 => Motion::Velocity(v),
        _ => Motion::VelocityFromFall(v),
    }
}

fn cameras() -> impl Strategy<Value = Shot> {
    let place = (spins(), 0.0..1.0, angles(), -4.0..4.0);
    (place, 0_u8..8, directions(), 0.0..0.9, directions(), planes()).prop_map(
        |((spin, height, theta, phi), kind, velocity, speed, direction, plane)| {
            // From 1.05 r₊ to 10⁴ M.
            let r = 1.05 * horizons(spin).0 * (1e4_f64 / 1.05).powf(height);
            let place = Place { r, theta, phi };
            let motion = motion(spin, &place, kind, velocity.map(|c| speed * c));
            let ray = Observer::new(Some(spin), place, motion).unwrap().ray(direction);
            Shot { spin, place, motion, ray, plane }
        },
    )
}

fn screens() -> impl Strategy<Value = Shot> {
    let impact = prop_oneof![
        1 => (-12.0..12.0).prop_map(|x| [x, 0.0]),
        1 => (-12.0..12.0).prop_map(|x| [0.0, x]),
        4 => (-12.0..12.0, -12.0..12.0).prop_map(|(x, y)| [x, y]),
        1 => (-1e3..1e3, -1e3..1e3).prop_map(|(x, y)| [x, y]),
    ];
    (spins(), angles(), impact, planes()).prop_map(|(spin, theta, impact, plane)| {
        let place = Place { r: f64::INFINITY, theta, phi: 0.0 };
        let ray = impact_ray(Some(spin), theta, f64::INFINITY, impact).unwrap();
        Shot { spin, place, motion: Motion::Static, ray, plane }
    })
}

/// About the inverse of the relative distance from the critical curve.
fn sensitivity(shot: &Shot) -> f64 {
    Kerr::new(-shot.spin).sensitivity(shot.ray.energy, &shot.ray.start)
}

fn trace(shot: &Shot, scheme: Scheme) -> Path {
    let query = Query { plane: shot.plane, elapsed: true, points: 12, max_crossings: 8, windings: false };
    follow(&Integrator::new(Kerr::new(shot.spin), scheme, 10_000).boxed(), &shot.ray, &query)
}

fn everything_is_finite(path: &Path) -> bool {
    path.direction.iter().flatten().all(|c| c.is_finite())
        && path.error_estimate.is_finite()
        && path.points.iter().flatten().all(|c| c.is_finite())
        && path.crossings.iter().all(|c| {
            c.position.iter().all(|x| x.is_finite())
                && c.r.is_finite()
                && c.phi.is_finite()
                && c.elapsed.is_finite()
        })
}

/// The conditions on one ray.
fn examine(shot: &Shot, scheme: Scheme, drift: f64) -> Result<(), TestCaseError> {
    // Around an extremal hole light next to the critical curve winds thousands of times.
    prop_assume!(shot.spin.abs() < 0.9999 || sensitivity(shot) < 1e3);
    // Falling cameras next to the horizon start in ingoing coordinates: see inside.rs.
    prop_assume!(shot.ray.side == Side::Reversed);
    let path = trace(shot, scheme);
    let (spin, ray) = (shot.spin, &shot.ray);
    let outer = horizons(spin).0;
    let mirrored = Kerr::new(-spin);
    prop_assert!(path.fate != Fate::StepLimit, "given up after {} steps", path.steps);
    prop_assert!(everything_is_finite(&path), "{path:?}");
    prop_assert_eq!(path.direction.is_some(), path.fate == Fate::Escaped);
    prop_assert!(path.fate == Fate::Captured || ray.energy > 0.0);

    // H = 0 at the start, and it, λ and η stay what they were: the error estimate is their drift,
    // times the ray's sensitivity if it escapes.
    // An observer near the horizon falls through the reversed chart with u^t ≈ 2r/Δ.
    let r = 1.0 / mirrored.inverse_radius(ray.start.w, &ray.start.n);
    let boost =
        if r.is_infinite() { 1.0 } else { 1.0 + 2.0 * r / ((r - 1.0).powi(2) - (1.0 - spin) * (1.0 + spin)) };
    let size = ray.energy * ray.energy + ray.start.q * ray.start.q;
    let norm = mirrored.norm(ray.energy, &ray.start);
    prop_assert!(norm.abs() < 1e-14 * boost * boost * size.max(1.0), "2H = {norm:e}");
    // Light that climbs away from the horizon loses most of its momentum on the way.
    let redshift = 1.0 + ray.start.q.abs() / ray.energy.abs();
    let magnified = sensitivity(shot) * redshift;
    prop_assert!(path.error_estimate < drift * magnified, "drift {:e}", path.error_estimate / magnified);

    // A photon at the horizon is where every photon is that gets there.
    let infinite = shot.place.r.is_infinite();
    prop_assert_eq!(path.points.len(), 12);
    for point in &path.points {
        let x = [point[1], point[2], point[3]];
        prop_assert!(mirrored.radius(&x) > outer * (1.0 - 1e-6), "{x:?}");
        prop_assert!(infinite || point[0] <= 1e-9 * shot.place.r, "{point:?}");
    }
    if !infinite {
        let [_, x, y, z] = path.points[0];
        prop_assert!(distance([x, y, z], ray.start.n.map(|c| c / ray.start.w)) < 1e-11 * shot.place.r);
    }

    for c in &path.crossings {
        let far = dot(&c.position, &c.position).sqrt();
        prop_assert!(dot(&c.position, &shot.plane).abs() < 1e-12 * far, "not in the plane: {c:?}");
        prop_assert!(c.r > outer * (1.0 - 1e-9), "inside the horizon: {c:?}");
        prop_assert!((mirrored.radius(&c.position) / c.r - 1.0).abs() < 1e-13, "r: {c:?}");
        let across = c.position[0].hypot(c.position[1]) / far;
        // φ is steep at the horizon.
        if c.r > outer + 1e-3 && across > 1e-6 {
            let azimuth = c.position[1].atan2(c.position[0]) - mirrored.azimuth_offset(c.r);
            prop_assert!(folded(c.phi - azimuth).abs() < 1e-12 / across * (1.0 + c.phi.abs()), "φ: {c:?}");
        }
    }
    for pair in path.crossings.windows(2) {
        // Light met later on the way back left earlier.
        prop_assert!(pair[1].elapsed > pair[0].elapsed, "order: {:?}", path.crossings);
        // A photon with the hole's sense of turning never turns back in φ.
        let lambda = ray.start.j[2] / ray.energy;
        if ray.energy > 0.0 && -spin * lambda >= 0.0 && lambda.abs() > 1e-6 {
            prop_assert!((pair[1].phi - pair[0].phi) * lambda > 0.0, "sense: {:?}", path.crossings);
        }
    }
    Ok(())
}

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 300,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1963),
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn rays_of_cameras(shot in cameras()) {
        examine(&shot, Scheme::Dop853 { tolerance: 1e-10 }, 3e-8)?;
    }

    #[test]
    fn rays_of_screens(shot in screens()) {
        examine(&shot, Scheme::Dop853 { tolerance: 1e-10 }, 3e-8)?;
    }

    #[test]
    fn rays_by_tsitouras(shot in prop_oneof![cameras(), screens()]) {
        examine(&shot, Scheme::Tsit5 { tolerance: 1e-8 }, 3e-6)?;
    }
}

/// Rays of cameras and screens of all kinds, away from |a| = 1.
fn any_ray(random: &mut Random) -> (f64, Ray) {
    let spin = random.within(-0.998, 0.998);
    if random.within(0.0, 1.0) < 0.4 {
        let theta = random.within(0.0, PI);
        let impact = [random.within(-12.0, 12.0), random.within(-12.0, 12.0)];
        return (spin, impact_ray(Some(spin), theta, f64::INFINITY, impact).unwrap());
    }
    let r = horizons(spin).0 * random.scale(1.5, 1e3);
    let place = Place { r, theta: random.within(0.0, PI), phi: 0.0 };
    let motion =
        random.pick(&[Motion::ZeroAngularMomentum, Motion::Fall, Motion::Velocity([0.2, -0.3, 0.4])]);
    (spin, Observer::new(Some(spin), place, motion).unwrap().ray(random.direction()))
}

/// The error by comparison with a run a hundred times as accurate: of the direction of a ray that
/// escapes, of the radius where a captured one crosses the equator.
fn actual_error(path: &Path, better: &Path) -> Option<f64> {
    if path.fate != better.fate || path.crossings.len() != better.crossings.len() {
        return Some(f64::INFINITY);
    }
    if let (Some(a), Some(b)) = (path.direction, better.direction) {
        return Some(separation(a, b));
    }
    let pairs = path.crossings.iter().zip(&better.crossings);
    (!path.crossings.is_empty()).then(|| largest(pairs.map(|(a, b)| (a.r / b.r - 1.0).abs())))
}

/// The estimate bounds the error of nearly every ray, and is not so large as to say nothing.
#[test]
fn error_estimates() {
    type Build = fn(f64) -> Scheme;
    let schemes: [(Build, f64); 2] =
        [(|tolerance| Scheme::Dop853 { tolerance }, 1e-8), (|tolerance| Scheme::Tsit5 { tolerance }, 1e-7)];
    for (scheme, tolerance) in schemes {
        let mut random = Random::new(61);
        for fate in [Fate::Escaped, Fate::Captured] {
            let (mut ratios, mut errors) = (Vec::new(), Vec::new());
            while ratios.len() < 700 {
                let (spin, ray) = any_ray(&mut random);
                let run = |tolerance| {
                    follow(
                        &Integrator::new(Kerr::new(spin), scheme(tolerance), 10_000).boxed(),
                        &ray,
                        &Query::default(),
                    )
                };
                let path = run(tolerance);
                if path.fate != fate {
                    continue;
                }
                if let Some(actual) = actual_error(&path, &run(0.01 * tolerance)) {
                    ratios.push(actual / path.error_estimate);
                    errors.push(actual);
                }
            }
            ratios.sort_by(f64::total_cmp);
            errors.sort_by(f64::total_cmp);
            let bounded = ratios.iter().filter(|r| **r <= 1.0).count() as f64 / ratios.len() as f64;
            let median = ratios[ratios.len() / 2];
            let typical = errors[errors.len() / 2] / tolerance;
            println!(
                "{:?}, {fate:?}: {bounded} bounded, median ratio {median:.1e}, median error {typical:.1e} of the tolerance",
                scheme(tolerance)
            );
            assert!(bounded >= 0.97, "{fate:?}: only {bounded} are bounded");
            assert!(median > 1e-2, "{fate:?}: the estimate is {:e} of the error", 1.0 / median);
            assert!(typical < 1.0, "{fate:?}: {typical} of the tolerance");
        }
    }
}
