//! Rays in Boyer–Lindquist coordinates against the same rays in Kerr–Schild ones.

use super::SphericalIntegrator;
use crate::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Tracer};
use crate::metric::Kerr;
use crate::observer::impact_ray;

const FINE: Scheme = Scheme::Dop853 { tolerance: 1e-11 };

fn trace(tracer: &impl Tracer, ray: &Ray, query: &Query) -> Path {
    let mut path = Path::default();
    tracer.trace(ray, query, &mut path);
    path
}

/// Numbers from 0 to 1 that look like chance.
fn fraction(k: u32, of: f64) -> f64 {
    (f64::from(k) * of).fract()
}

fn rays() -> impl Iterator<Item = (f64, Ray)> {
    (1..60).filter_map(|k| {
        let spin = 2.0 * fraction(k, 0.618033989) - 1.0;
        let spin = if k % 7 == 0 { 0.0 } else { spin };
        let inclination = 0.2 + 2.6 * fraction(k, 0.754877666);
        let distance = [f64::INFINITY, 1000.0, 30.0, 8.0][k as usize % 4];
        let impact = [24.0 * fraction(k, 0.569840291) - 12.0, 24.0 * fraction(k, 0.819172513) - 12.0];
        Some((spin, impact_ray(Some(spin), inclination, distance, impact).ok()?))
    })
}

#[test]
fn they_meet_the_same() {
    let (mut escaped, mut captured) = (0, 0);
    for (spin, ray) in rays() {
        let query = Query { elapsed: true, ..Query::default() };
        let here = trace(&SphericalIntegrator::new(spin, FINE, 20_000), &ray, &query);
        let there = trace(&Integrator::new(Kerr::new(spin), FINE, 20_000), &ray, &query);
        assert_eq!(here.fate, there.fate, "a = {spin}, {ray:?}");
        // Next to the critical curve any error grows without bound.
        let bound = 1e-8 + 30.0 * (here.error_estimate + there.error_estimate);
        assert!(bound < 1e-3, "{here:?} {there:?}");
        if let (Some(one), Some(other)) = (here.direction, there.direction) {
            escaped += 1;
            assert!((0..2).all(|i| (one[i] - other[i]).abs() < bound), "{one:?} {other:?}");
        } else {
            captured += 1;
        }
        // A captured ray may cross the plane once more in the last hundred-thousandth of a horizon radius.
        let count = here.crossings.len().min(there.crossings.len());
        assert!(there.crossings.len() - count <= usize::from(here.fate == Fate::Captured));
        for (one, other) in here.crossings.iter().zip(&there.crossings) {
            let close = bound / (1.0 - 1.0 / one.r).max(0.1);
            assert!((one.r / other.r - 1.0).abs() < close, "{one:?} {other:?}");
            assert!((one.phi - other.phi).abs() < 10.0 * close, "{one:?} {other:?}");
            let apart = (0..3).map(|i| (one.position[i] - other.position[i]).abs()).fold(0.0, f64::max);
            assert!(apart < 10.0 * close * one.r, "{one:?} {other:?}");
            let late = (one.elapsed - other.elapsed).abs();
            assert!(late < 1e-6 + 100.0 * close * (1.0 + other.elapsed.abs()), "{one:?} {other:?}");
        }
    }
    assert!(escaped > 20 && captured > 5, "{escaped} {captured}");
}

#[test]
fn a_tilted_plane_is_met_too() {
    let query = Query { plane: [0.6, 0.0, 0.8], ..Query::default() };
    for (spin, ray) in rays() {
        let here = trace(&SphericalIntegrator::new(spin, FINE, 20_000), &ray, &query);
        let there = trace(&Integrator::new(Kerr::new(spin), FINE, 20_000), &ray, &query);
        let bound = 1e-7 + 100.0 * (here.error_estimate + there.error_estimate);
        for (one, other) in here.crossings.iter().zip(&there.crossings) {
            assert!(
                (one.r / other.r - 1.0).abs() < bound / (1.0 - 1.0 / one.r).max(0.1),
                "{one:?} {other:?}"
            );
        }
    }
}

/// What the coordinates cost: many steps next to the axis, and with constant steps a direction that is plainly wrong.
#[test]
fn the_axis_costs_steps() {
    let spin = 0.99;
    let near = |alpha: f64| impact_ray(Some(spin), 1.4, 30.0, [alpha, 8.0]).unwrap();
    let query = Query::default();
    let scheme = Scheme::Dop853 { tolerance: 1e-8 };
    let round = SphericalIntegrator::new(spin, scheme, 20_000);
    let straight = Integrator::new(Kerr::new(spin), scheme, 20_000);
    let steps =
        |alpha| [trace(&round, &near(alpha), &query).steps, trace(&straight, &near(alpha), &query).steps];
    let ([far, flat], [close, as_flat]) = (steps(3.0), steps(1e-4));
    assert!(close > 2 * far && as_flat <= flat + 3, "{far} to {close}, {flat} to {as_flat}");
    let coarse = Scheme::Rk4 { step: 0.1 };
    let off = |tracer: &dyn Fn(&Ray) -> Path| {
        let ray = near(1e-2);
        let exact = trace(&straight, &ray, &query).direction.unwrap();
        let found = tracer(&ray).direction.unwrap_or([f64::INFINITY; 2]);
        (found[0] - exact[0]).abs()
    };
    let round = SphericalIntegrator::new(spin, coarse, 20_000);
    let straight = Integrator::new(Kerr::new(spin), coarse, 20_000);
    let errors = [off(&|ray| trace(&round, ray, &query)), off(&|ray| trace(&straight, ray, &query))];
    assert!(errors[0] > 1e-2 && errors[1] < 1e-5, "{errors:?}");
}

#[test]
fn points_lie_on_the_way() {
    let ray = impact_ray(Some(0.5), 1.0, 20.0, [6.0, 3.0]).unwrap();
    let query = Query { points: 50, ..Query::default() };
    let path = trace(&SphericalIntegrator::new(0.5, FINE, 20_000), &ray, &query);
    assert_eq!(path.points.len(), 50);
    let [t, x, y, z] = path.points[0];
    let start = ray.start.n.map(|c| c / ray.start.w);
    assert!(t.abs() < 1e-12 && (x - start[0]).hypot(y - start[1]).hypot(z - start[2]) < 1e-9);
    assert!(path.points.windows(2).all(|w| w[1][0] < w[0][0]), "time runs backwards");
}

#[test]
fn on_the_axis_and_inside_there_is_nothing() {
    let tracer = SphericalIntegrator::new(0.9, FINE, 1000);
    let axis = impact_ray(Some(0.9), 0.0, 30.0, [3.0, 4.0]).unwrap();
    assert_eq!(trace(&tracer, &axis, &Query::default()).fate, Fate::StepLimit);
    let ray = impact_ray(Some(0.9), 1.0, 30.0, [3.0, 4.0]).unwrap();
    let inside = Ray { side: crate::geodesic::Side::Ingoing, ..ray };
    assert_eq!(trace(&tracer, &inside, &Query::default()).fate, Fate::StepLimit);
}
