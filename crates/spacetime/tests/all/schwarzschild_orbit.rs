//! Rays around a hole without spin against the exact orbit, an elliptic integral.

use crate::common;

use common::orbit::Orbit;
use common::{Random, Worst, distance, folded, follow, impact};
use kerrscope_spacetime::geodesic::{Fate, Integrator, Query, Ray, Scheme, Tracer};
use kerrscope_spacetime::metric::{Kerr, Metric, Schwarzschild};
use kerrscope_spacetime::observer::{Motion, Observer, Place};
use kerrscope_spacetime::tensor::{cross, dot};
use std::f64::consts::{FRAC_PI_2, PI};

const DOP853: Scheme = Scheme::Dop853 { tolerance: 1e-13 };

fn integrator() -> Integrator<Schwarzschild> {
    Integrator::new(Schwarzschild, DOP853, 10_000)
}

/// What the angles of one ray are, found through its crossings of planes at many angles ψ, and
/// what they should be. Near the turning point, where ψ(u) is steep, only u can be judged: the
/// error is that of ψ or of u, whichever is less.
fn compare(tracer: &impl Tracer, ray: &Ray, planes: u32, worst: &mut Worst) {
    let start = ray.start;
    let b = dot(&start.j, &start.j).sqrt() / ray.energy;
    let orbit = Orbit::new(b);
    let ahead = cross(&start.j, &start.n).map(|c| c / (b * ray.energy));
    // q is not the radial velocity: the chart falls in.
    let (u0, inward) = (start.w, Schwarzschild.inverted_rate(ray.energy, &start).w > 0.0);
    let turn = orbit.turn(u0, inward);
    let until_turn = turn.map(|u| (orbit.angle(u) - orbit.angle(u0)).abs());
    for k in 0..planes {
        let first = PI * (f64::from(k) + 0.5) / f64::from(planes);
        let plane = std::array::from_fn(|i| first.cos() * ahead[i] - first.sin() * start.n[i]);
        let path = follow(tracer, ray, &Query { plane, ..Query::default() });
        for (n, c) in path.crossings.iter().enumerate() {
            let psi = first + PI * n as f64;
            let place = || format!("b = {b}, r₀ = {}, inward {inward}, ψ = {psi}, r = {}", 1.0 / u0, c.r);
            let (sin, cos) = psi.sin_cos();
            let expected = std::array::from_fn(|i| c.r * (cos * start.n[i] + sin * ahead[i]));
            worst.see(distance(expected, c.position) / c.r, place);
            let (u, turned) = (1.0 / c.r, until_turn.is_some_and(|t| psi > t));
            // Rounding may put u just beyond the turning point.
            let u = match turn {
                Some(t) if inward => u.min(t),
                Some(t) => u.max(t),
                None => u,
            };
            let error = (orbit.swept(u0, inward, u, turned) - psi).abs();
            let slope = orbit.square(u).max(0.0).sqrt();
            if slope > 1e-3 {
                worst.see(error * slope.min(1.0), place);
            }
        }
        let expected = match (turn, inward) {
            (Some(u), true) => u < 1.0 / 3.0,
            (None, inward) => !inward,
            (Some(_), false) => false,
        };
        assert_eq!(path.fate, if expected { Fate::Escaped } else { Fate::Captured }, "b = {b}");
    }
}

/// From infinity, scattered and captured; in the equatorial plane and in any other.
#[test]
fn rays_from_infinity() {
    let mut worst = Worst::default();
    for b in [1e3, 100.0, 20.0, 10.0, 8.0, 6.0, 5.5, 5.3, 5.1, 5.0, 4.0, 2.0, 1.0, 0.1] {
        compare(&integrator(), &impact(0.0, FRAC_PI_2, f64::INFINITY, b, 0.0), 24, &mut worst);
        compare(&integrator(), &impact(0.0, FRAC_PI_2, f64::INFINITY, -b, 0.0), 3, &mut worst);
    }
    let mut random = Random::new(41);
    for _ in 0..40 {
        let (b, turn) = (random.scale(5.3, 50.0), random.within(-PI, PI));
        let inclination = random.within(0.0, PI);
        let ray = impact(0.0, inclination, f64::INFINITY, b * turn.cos(), b * turn.sin());
        compare(&integrator(), &ray, 6, &mut worst);
        let b = random.within(0.1, 5.1);
        let ray = impact(0.0, inclination, f64::INFINITY, b * turn.cos(), b * turn.sin());
        compare(&integrator(), &ray, 6, &mut worst);
    }
    worst.below(1e-13, "from infinity");
}

/// A relative offset of 1e-4 from the critical impact parameter multiplies errors as much.
#[test]
fn rays_near_the_critical_one() {
    let mut worst = Worst::default();
    for offset in [1e-3, 1e-4] {
        for sign in [1.0, -1.0] {
            let b = 27f64.sqrt() * (1.0 + sign * offset);
            compare(&integrator(), &impact(0.0, FRAC_PI_2, f64::INFINITY, b, 0.0), 24, &mut worst);
        }
    }
    worst.below(1e-11, "near the critical curve");
}

/// From a static camera at any distance, all around: inwards and outwards, inside the photon
/// sphere too, where an outward ray may turn back.
#[test]
fn rays_from_cameras() {
    let mut worst = Worst::default();
    let mut turned_back = 0;
    for r in [2.05, 2.5, 2.9, 3.2, 4.0, 10.0, 1e3, 1e6] {
        let place = Place { r, theta: 1.1, phi: 0.4 };
        let observer = Observer::new(Some(0.0), place, Motion::Static).unwrap();
        for k in 0..40 {
            let (sin, cos) = (PI * (f64::from(k) + 0.5) / 40.0).sin_cos();
            let (up, side) = f64::from(k).sin_cos();
            let ray = observer.ray([-cos, sin * up, sin * side]);
            let b = dot(&ray.start.j, &ray.start.j).sqrt() / ray.energy;
            if (b / 27f64.sqrt() - 1.0).abs() < 0.01 {
                continue;
            }
            turned_back += u32::from(k > 20 && r < 3.0 && b > 27f64.sqrt());
            compare(&integrator(), &ray, 4, &mut worst);
        }
    }
    assert!(turned_back > 10);
    worst.below(1e-12, "from cameras");
}

/// Points along a ray lie on the orbit.
#[test]
fn points_lie_on_the_orbit() {
    let mut worst = Worst::default();
    for (b, radius) in [(7.0, 50.0), (5.4, 20.0), (3.0, 12.0)] {
        let ray = impact(0.0, FRAC_PI_2, radius, b, 0.0);
        let path = follow(&integrator(), &ray, &Query { points: 300, ..Query::default() });
        assert_eq!(path.points.len(), 300);
        let orbit = Orbit::new(b);
        let u0 = 1.0 / radius;
        let until_turn = orbit.turn(u0, true).map(|u| orbit.angle(u) - orbit.angle(u0));
        // Unwrapped along the points, which are close to each other.
        let (mut psi, mut before) = (0.0, 0.0);
        for [_, x, y, z] in path.points {
            assert_eq!(z, 0.0);
            let phi = y.atan2(x);
            psi += folded(phi - before);
            before = phi;
            let u = 1.0 / x.hypot(y);
            let turned = until_turn.is_some_and(|t| psi > t);
            let slope = orbit.square(u).max(0.0).sqrt();
            if slope > 1e-3 {
                let error = (orbit.swept(u0, true, u, turned) - psi).abs();
                worst.see(error * slope.min(1.0), || format!("b = {b}, r = {}", 1.0 / u));
            }
        }
    }
    worst.below(5e-14, "points");
}

/// Deflection by closed form with arbitrary precision.
const DEFLECTION: [[f64; 2]; 7] = [
    [100.0, 0.041222539749],
    [20.0, 0.236135995],
    [10.0, 0.590395788],
    [8.0, 0.858730018],
    [6.0, 1.719388310],
    [5.3, 3.557938042],
    [5.2, 6.810371957],
];

/// Deflection against the table, and to more digits against the integral: φ of the direction the
/// light comes from is π plus the deflection, unwrapped.
#[test]
fn deflection() {
    let mut worst = Worst::default();
    for [b, published] in DEFLECTION {
        let orbit = Orbit::new(b);
        let exact = 2.0 * (orbit.angle(orbit.turn(0.0, true).unwrap()) - orbit.angle(0.0)) - PI;
        // The table's last digit.
        assert!((exact - published).abs() < if b == 100.0 { 6e-13 } else { 6e-10 }, "b = {b}: {exact}");
        for sign in [1.0, -1.0] {
            let ray = impact(0.0, FRAC_PI_2, f64::INFINITY, sign * b, 0.0);
            let path = follow(&integrator(), &ray, &Query::default());
            let [theta, phi] = path.direction.unwrap();
            assert!((theta - FRAC_PI_2).abs() < 1e-15);
            // Errors grow as the inverse of the offset from the critical curve.
            let offset = b / 27f64.sqrt() - 1.0;
            worst.see((sign * phi - PI - exact).abs() * offset.min(1.0), || format!("b = {b}"));
            let same =
                follow(&Integrator::new(Kerr::new(0.0), DOP853, 10_000).boxed(), &ray, &Query::default());
            worst
                .see((same.direction.unwrap()[1] - phi).abs() * offset.min(1.0), || format!("Kerr, b = {b}"));
        }
    }
    worst.below(1e-13, "deflection");
}

/// Far away the deflection is 4/b + 15π/(4b²) + 128/(3b³) + …
#[test]
fn weak_deflection() {
    for b in [1e4, 1e6, 1e9] {
        let ray = impact(0.0, FRAC_PI_2, f64::INFINITY, b, 0.0);
        let phi = follow(&integrator(), &ray, &Query::default()).direction.unwrap()[1];
        let series = 4.0 / b + 15.0 * PI / (4.0 * b * b) + 128.0 / (3.0 * b.powi(3));
        assert!((phi - PI - series).abs() < 2e-14, "b = {b}: {:e}", phi - PI - series);
    }
}
