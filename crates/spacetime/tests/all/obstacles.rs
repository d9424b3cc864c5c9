//! Things in the way of rays, and the matter of surfaces.

use crate::common;

use common::{Random, distance};
use kerrscope_spacetime::emitter::{Circular, Sense};
use kerrscope_spacetime::geodesic::{
    Curve, Fate, Integrator, Line, ObstacleTracer, Obstacles, Path, Query, Scheme, Segment, Straight, Tracer,
};
use kerrscope_spacetime::metric::{Kerr, Minkowski};
use kerrscope_spacetime::observer::{Drift, Motion, Observer, Patch, Place, clearance};
use kerrscope_spacetime::tensor::dot;
use std::f64::consts::PI;

/// The plane z = `height`, found on a curve by halving where its ends are on two sides.
struct Floor {
    height: f64,
}

impl Obstacles for Floor {
    fn first(&self, segment: &Segment) -> Option<(f64, usize)> {
        match segment {
            Segment::Line(Line { origin, direction, start }) => {
                let d = (self.height - origin[2]) / direction[2];
                (d > *start).then_some((d, 7))
            }
            Segment::Curve(curve) => self.on(curve),
        }
    }
}

impl Floor {
    fn on(&self, curve: &Curve) -> Option<(f64, usize)> {
        let above = |theta: f64| {
            let [_, _, z, w] = curve.at(theta);
            z - self.height * w
        };
        let cells = 64;
        let share = |k: i32| f64::from(k) / f64::from(cells);
        let k = (0..cells).find(|k| (above(share(*k)) > 0.0) != (above(share(k + 1)) > 0.0))?;
        let (mut low, mut high) = (share(k), share(k + 1));
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (above(middle) > 0.0) == (above(low) > 0.0) { low = middle } else { high = middle }
        }
        Some((low, 7))
    }
}

/// A floor next to the equator is met next to where the equator is crossed, and what comes after is not told; every tracer,
/// method and chart says the same.
#[test]
fn a_floor_is_met_where_the_plane_is_crossed() {
    let spin = 0.9;
    let mut random = Random::new(5);
    let place = Place { r: 20.0, theta: 1.2, phi: 0.4 };
    let observer = Observer::new(Some(spin), place, Motion::Static).unwrap();
    let tolerance = 1e-11;
    let tracers: Vec<Box<dyn ObstacleTracer>> = vec![
        Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance }, 10_000).boxed(),
        Integrator::new(Kerr::new(spin), Scheme::Tsit5 { tolerance }, 10_000).boxed(),
        Integrator::new(Kerr::new(spin), Scheme::Rk4 { step: 0.01 }, 100_000).boxed(),
    ];
    let (mut met, mut path, mut bare) = (0, Path::default(), Path::default());
    for _ in 0..30 {
        let [x, y, z] = random.direction();
        let direction = [-x.abs() - 2.0, y, z].map(|c| c / ((x.abs() + 2.0).powi(2) + y * y + z * z).sqrt());
        let ray = observer.ray(direction);
        let query = Query { elapsed: true, ..Query::default() };
        tracers[0].trace(&ray, &query, &mut bare);
        for (k, tracer) in tracers.iter().enumerate() {
            tracer.trace_among(&ray, &query, &Floor { height: 0.0 }, &mut path);
            let Some(first) = bare.crossings.first() else {
                assert_eq!(path.fate, bare.fate);
                continue;
            };
            let hit = path.hit.expect("the equator is met");
            assert_eq!((path.fate, hit.object, path.direction), (Fate::Hit, 7, None));
            let error = distance(hit.position, first.position) / first.r;
            assert!(error < [1e-10, 1e-9, 1e-5][k], "{k} {error:e}");
            assert!((hit.energy - ray.energy).abs() < 1e-15);
            met += 1;
            // A floor below the equator: the crossing is before it.
            tracer.trace_among(&ray, &query, &Floor { height: -0.5 }, &mut path);
            if let (Some(hit), [crossing]) = (path.hit, &path.crossings[..]) {
                assert!((hit.position[2] + 0.5).abs() < 1e-9);
                assert!((crossing.elapsed - first.elapsed).abs() < [1e-8, 1e-8, 1e-4][k] * first.elapsed);
            }
        }
    }
    assert!(met > 30, "{met}");
}

#[test]
fn straight_rays_meet_what_integrated_ones_do() {
    let mut random = Random::new(6);
    let bent = Integrator::new(Minkowski, Scheme::Dop853 { tolerance: 1e-13 }, 10_000);
    let (mut a, mut b) = (Path::default(), Path::default());
    for _ in 0..200 {
        let place = Place { r: random.scale(1.0, 100.0), theta: random.within(0.1, PI - 0.1), phi: 1.0 };
        let ray = Observer::new(None, place, Motion::Static).unwrap().ray(random.direction());
        let floor = Floor { height: random.within(-3.0, 3.0) };
        let query = Query { points: 5, ..Query::default() };
        Straight.trace_among(&ray, &query, &floor, &mut a);
        bent.trace_among(&ray, &query, &floor, &mut b);
        assert_eq!((a.fate, a.crossings.len()), (b.fate, b.crossings.len()));
        if let (Some(p), Some(q)) = (a.hit, b.hit) {
            let size = dot(&p.position, &p.position).sqrt().max(place.r);
            // Rays that nearly graze the floor magnify rounding.
            let slope = p.momentum[2].abs();
            assert!(
                distance(p.position, q.position) < 1e-12 * size * (size / place.r) / slope,
                "{p:?} {q:?}"
            );
            assert!(distance(p.momentum, q.momentum) < 1e-12);
            assert!((p.position[2] - floor.height).abs() < 1e-12 * size);
            let last = a.points.last().unwrap();
            assert!(dot(&ray.start.momentum(), &[last[1], last[2], last[3]]).is_finite());
        }
    }
}

/// The tetrad of a patch is orthonormal: a photon leaves in the direction that is measured, with the frequency 1; its normal
/// is that which the matter sees.
#[test]
fn a_patch_measures_what_it_sends() {
    let mut random = Random::new(7);
    for spin in [None, Some(0.0), Some(0.9), Some(-0.6), Some(1.0)] {
        for drift in
            [Drift::Static, Drift::Turning(0.02), Drift::Turning(-0.05), Drift::Velocity([0.1, -0.5, 0.6])]
        {
            for _ in 0..50 {
                let position = random.direction().map(|c| c * 6.0);
                let gradient = random.direction().map(|c| c * 3.0);
                let patch = Patch::new(spin, position, gradient, drift).unwrap();
                let direction = random.direction();
                let ray = patch.ray(direction);
                let (frequency, found) = patch.measure(ray.energy, &ray.start.momentum());
                assert!((frequency - 1.0).abs() < 1e-13, "{frequency}");
                assert!(distance(found, direction) < 1e-12, "{found:?} {direction:?}");
                let path = match spin {
                    None => true,
                    Some(a) => {
                        // It is light: followed on, it keeps a norm of zero.
                        let tracer =
                            Integrator::new(Kerr::new(a), Scheme::Dop853 { tolerance: 1e-10 }, 10_000);
                        let mut path = Path::default();
                        tracer.trace(&ray, &Query::default(), &mut path);
                        path.error_estimate < 1e-6
                    }
                };
                assert!(path, "{spin:?} {drift:?}");
                if drift == Drift::Static {
                    assert_eq!(patch.climb(&direction) > 0.0, direction[2] > 0.0);
                }
            }
        }
    }
}

/// Matter in orbit sees photons with the redshift factor of its orbit, and an observer's own tetrad agrees.
#[test]
fn a_patch_in_orbit_is_matter_in_orbit() {
    let mut random = Random::new(8);
    for spin in [0.0, 0.9, -0.5] {
        for _ in 0..50 {
            let r: f64 = random.within(9.0, 20.0);
            let place = Place { r, theta: 0.5 * PI, phi: random.within(0.0, 6.0) };
            let observer = Observer::new(Some(spin), place, Motion::Orbit).unwrap();
            let ray = observer.ray(random.direction());
            let rate = 1.0 / (r * r.sqrt() + spin);
            let patch =
                Patch::new(Some(spin), observer.position(), [0.0, 0.0, 1.0], Drift::Turning(rate)).unwrap();
            let (frequency, _) = patch.measure(ray.energy, &ray.start.momentum());
            assert!((frequency - 1.0).abs() < 1e-12, "{frequency}");
            let orbit = Circular::kerr(spin, Sense::Prograde).orbit(r).unwrap();
            let g = orbit.redshift_factor(ray.conserved(spin).lambda, ray.energy).unwrap();
            assert!((g - 1.0).abs() < 1e-12, "{g}");
            let velocity = random.direction().map(|c| 0.7 * c);
            let observer = Observer::new(Some(spin), place, Motion::Velocity(velocity)).unwrap();
            let ray = observer.ray(random.direction());
            let patch =
                Patch::new(Some(spin), observer.position(), [1.0, 0.0, 1.0], Drift::Velocity(velocity))
                    .unwrap();
            let (frequency, _) = patch.measure(ray.energy, &ray.start.momentum());
            assert!((frequency - 1.0).abs() < 1e-12, "{frequency}");
        }
    }
}

#[test]
fn matter_is_where_it_can_be() {
    let at = |x: f64, z: f64| [x, 0.0, z];
    // The static limit is at r = 2 on the equator: x² = r² + a².
    let edge = f64::sqrt(4.0 + 0.81);
    assert!(clearance(Some(0.9), at(edge + 1e-9, 0.0), Drift::Static) > 0.0);
    assert!(clearance(Some(0.9), at(edge - 1e-9, 0.0), Drift::Static) < 0.0);
    assert!(Patch::new(Some(0.9), at(2.0, 0.0), [1.0, 0.0, 0.0], Drift::Static).is_none());
    // What turns too fast, where the hole does not matter: Ω ϖ = 1.
    assert!(Patch::new(None, at(9.9, 1.0), [1.0, 0.0, 0.0], Drift::Turning(0.1)).is_some());
    assert!(Patch::new(None, at(10.1, 1.0), [1.0, 0.0, 0.0], Drift::Turning(0.1)).is_none());
    // Within the horizon nothing stays.
    let horizon = 1.0 + f64::sqrt(1.0 - 0.81);
    assert!(
        Patch::new(Some(0.9), at(0.0, horizon - 0.1), [0.0, 0.0, 1.0], Drift::Velocity([0.0; 3])).is_none()
    );
    assert!(
        Patch::new(Some(0.9), at(0.0, horizon + 0.1), [0.0, 0.0, 1.0], Drift::Velocity([0.0; 3])).is_some()
    );
}
