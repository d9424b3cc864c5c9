//! Limits that rounding could decide: rays over the pole, cameras on it, falling cameras at the horizon.

use kerrscope_spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Tracer};
use kerrscope_spacetime::metric::Kerr;
use kerrscope_spacetime::observer::{Motion, Observer, Place, impact_ray};

fn trace(spin: f64, ray: &Ray, tolerance: f64) -> Path {
    let mut path = Path::default();
    let tracer = Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance }, 20_000).boxed();
    tracer.trace(ray, &Query::default(), &mut path);
    path
}

/// A photon without angular momentum passes over the pole; the azimuth then grows by π (the limit of
/// λ → 0 from above for the reversed photon), whatever the steps.
#[test]
fn over_the_pole_the_azimuth_grows() {
    for tolerance in [1e-6, 1e-8, 1e-12] {
        let at = |alpha: f64| {
            let ray = impact_ray(Some(0.9), 60f64.to_radians(), 1000.0, [alpha, -6.0]).unwrap();
            trace(0.9, &ray, tolerance).direction.unwrap()[1]
        };
        let (zero, limit) = (at(0.0), at(1e-10));
        assert!((zero - limit).abs() < 1e-5, "{zero} is not {limit} at tolerance {tolerance}");
    }
}

#[test]
fn on_the_axis_is_the_limit_of_near_it() {
    for (spin, r) in [(0.9, 3.0), (0.9, f64::INFINITY), (-0.6, 20.0)] {
        let path = |inclination: f64| {
            let ray = impact_ray(Some(spin), inclination, r, [3.0, 4.0]).unwrap();
            trace(spin, &ray, 1e-12)
        };
        let (on, near) = (path(0.0), path(1e-9));
        assert_eq!(on.fate, near.fate);
        for (a, b) in on.crossings.iter().zip(&near.crossings) {
            // The azimuth of a ray near the axis is counted from the camera's own.
            let turn = (a.phi - b.phi).rem_euclid(std::f64::consts::TAU);
            let turn = turn.min(std::f64::consts::TAU - turn);
            assert!((a.r - b.r).abs() < 1e-6 && turn < 1e-6, "{a:?} {b:?}");
        }
    }
}

/// The sky of a falling camera varies smoothly through the horizon.
#[test]
fn a_falling_camera_sees_no_horizon() {
    for spin in [0.0, 0.5, 0.9] {
        let horizon = Kerr::new(spin);
        let outer = kerrscope_spacetime::kerr::horizons(horizon.spin()).0;
        let look = |delta: f64| {
            let place = Place { r: outer * (1.0 + delta), theta: 1.1, phi: 0.0 };
            let observer = Observer::new(Some(spin), place, Motion::Fall).unwrap();
            let length = (0.3f64 * 0.3 + 0.5 * 0.5 + 0.6 * 0.6).sqrt();
            let ray = observer.ray([0.6 / length, 0.5 / length, 0.3 / length]);
            let path = trace(spin, &ray, 1e-11);
            assert_eq!(path.fate, Fate::Escaped, "a = {spin}, delta = {delta}");
            assert!(path.error_estimate < 1e-8);
            let [theta, phi] = path.direction.unwrap();
            (ray.energy.abs(), theta, phi)
        };
        let (energy, theta, _) = look(-1e-9);
        for delta in [1e-10, 1e-9, 1e-8, 1e-6] {
            let (e, t, _) = look(delta);
            let allowed = 1e-9 + 10.0 * delta;
            assert!(
                (e - energy).abs() < allowed && (t - theta).abs() < allowed,
                "a = {spin}, delta = {delta}"
            );
        }
        // Farther out the rays start in the reversed spacetime: the same sky, azimuth included.
        let (near, far) = (look(0.1 - 1e-10), look(0.1 + 1e-10));
        let apart = (near.0 - far.0).abs() + (near.1 - far.1).abs() + (near.2 - far.2).abs();
        assert!(apart < 1e-8, "a = {spin}: {near:?} {far:?}");
    }
}
