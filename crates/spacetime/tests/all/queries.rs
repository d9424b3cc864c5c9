//! What a tracer is asked for and what it keeps to itself.

use crate::common;

use common::{Random, Worst, distance, follow, impact};
use kerrscope_spacetime::geodesic::{Crossing, Fate, Integrator, Path, Query, Ray, Scheme, Straight, Tracer};
use kerrscope_spacetime::kerr::{CriticalCurve, horizons};
use kerrscope_spacetime::metric::{Kerr, Metric, Minkowski};
use kerrscope_spacetime::observer::{Motion, Observer, Place};
use kerrscope_spacetime::tensor::{cross, dot};
use std::f64::consts::{FRAC_PI_2, PI};

fn tracer(scheme: Scheme) -> Box<dyn Tracer> {
    Integrator::new(Kerr::new(0.9), scheme, 10_000).boxed()
}

const DOP853: Scheme = Scheme::Dop853 { tolerance: 1e-10 };

/// A ray that winds around the hole before it leaves, and so crosses the equator often.
fn winding() -> Ray {
    let [alpha, beta] = CriticalCurve::new(0.9, 1.0).point(1.0).map(|c| c * (1.0 + 1e-5));
    impact(0.9, 1.0, f64::INFINITY, alpha, beta)
}

#[test]
fn as_many_crossings_as_asked_for() {
    let all = follow(&tracer(DOP853), &winding(), &Query::default());
    assert!(all.crossings.len() >= 4, "{}", all.crossings.len());
    for most in 0..=all.crossings.len() {
        let some = follow(&tracer(DOP853), &winding(), &Query { max_crossings: most, ..Query::default() });
        assert_eq!(some.fate, all.fate);
        assert_eq!(some.direction, all.direction);
        assert_eq!(some.crossings.len(), most);
        for (a, b) in some.crossings.iter().zip(&all.crossings) {
            assert_eq!((a.position, a.r, a.phi), (b.position, b.r, b.phi));
        }
    }
    let flat = Observer::new(None, Place { r: 9.0, theta: 1.0, phi: 0.0 }, Motion::Static).unwrap();
    let down = flat.ray([0.0, 1.0, 0.0]);
    assert_eq!(follow(&Straight, &down, &Query::default()).crossings.len(), 1);
    assert!(follow(&Straight, &down, &Query { max_crossings: 0, ..Query::default() }).crossings.is_empty());
}

/// Times are kept only if asked for, and asking for them or for points moves nothing.
#[test]
fn asking_for_more_changes_nothing() {
    let plain = follow(&tracer(DOP853), &winding(), &Query::default());
    assert!(plain.crossings.iter().all(|c| c.elapsed.is_nan()));
    assert!(plain.points.is_empty());
    let more = follow(&tracer(DOP853), &winding(), &Query { elapsed: true, points: 7, ..Query::default() });
    assert!(more.crossings.iter().all(|c| c.elapsed.is_finite()));
    assert_eq!((more.points.len(), more.crossings.len(), more.fate), (7, plain.crossings.len(), plain.fate));
    for (a, b) in plain.crossings.iter().zip(&more.crossings) {
        assert!((a.r - b.r).abs() < 3e-5 * a.r && (a.phi - b.phi).abs() < 3e-5, "{a:?} {b:?}");
    }
}

/// A path that is used again is as good as a new one.
#[test]
fn paths_are_forgotten() {
    let mut path = Path::default();
    let mut random = Random::new(101);
    for _ in 0..100 {
        let place = Place { r: random.scale(1.7, 50.0), theta: random.within(0.0, PI), phi: 0.0 };
        let ray =
            Observer::new(Some(0.9), place, Motion::ZeroAngularMomentum).unwrap().ray(random.direction());
        let query = Query { points: random.pick(&[0, 3]), elapsed: true, ..Query::default() };
        tracer(DOP853).trace(&ray, &query, &mut path);
        // As text, in which NaN is like NaN.
        assert_eq!(format!("{path:?}"), format!("{:?}", follow(&tracer(DOP853), &ray, &query)));
    }
    path.clear();
    assert_eq!(
        (path.fate, path.crossings.len(), path.points.len(), path.direction),
        (Fate::StepLimit, 0, 0, None)
    );
    assert!(path.error_estimate.is_nan());
}

/// Too few steps: given up, with what was met so far, and without a direction.
#[test]
fn giving_up() {
    let ray = winding();
    let whole = follow(&tracer(DOP853), &ray, &Query::default());
    for most in [0, 1, 5, whole.steps - 1] {
        let path = follow(&Integrator::new(Kerr::new(0.9), DOP853, most).boxed(), &ray, &Query::default());
        assert_eq!((path.fate, path.direction, path.steps), (Fate::StepLimit, None, most));
        for (a, b) in path.crossings.iter().zip(&whole.crossings) {
            assert_eq!(a.r, b.r);
        }
    }
    let path = follow(&Integrator::new(Kerr::new(0.9), DOP853, whole.steps).boxed(), &ray, &Query::default());
    assert_eq!((path.fate, path.direction), (Fate::Escaped, whole.direction));
    // Constant steps of affine parameter cannot come in from infinity.
    let path = follow(&tracer(Scheme::Rk4 { step: 0.1 }), &ray, &Query::default());
    assert_eq!((path.fate, path.steps), (Fate::StepLimit, 0));
}

/// The number of crossings does not depend on the size of the steps, however the plane lies.
#[test]
fn planes_are_crossed_the_same_by_any_steps() {
    let mut random = Random::new(102);
    let (mut worst, mut several) = (Worst::default(), 0);
    let rough = tracer(Scheme::Dop853 { tolerance: 1e-5 });
    let fine = tracer(Scheme::Tsit5 { tolerance: 1e-11 });
    for _ in 0..600 {
        let place = Place { r: random.scale(4.0, 100.0), theta: random.within(0.1, 3.0), phi: 0.0 };
        let observer = Observer::new(Some(0.9), place, Motion::Static).unwrap();
        // Towards the hole or past it.
        let [_, side, up] = random.direction();
        let (side, up) = (9.0 * side / place.r.max(10.0), 9.0 * up / place.r.max(10.0));
        let ray = observer.ray([-(1.0 - side * side - up * up).sqrt(), side, up]);
        let share = 1.0 / Kerr::new(-0.9).sensitivity(ray.energy, &ray.start);
        if share < 1e-2 {
            continue;
        }
        let plane = random.direction();
        let query = Query { plane, ..Query::default() };
        let (a, b) = (follow(&rough, &ray, &query), follow(&fine, &ray, &query));
        several += i32::from(b.crossings.len() > 1);
        let label = || format!("{place:?}, {ray:?}, {plane:?}");
        assert_eq!(a.crossings.len(), b.crossings.len(), "{}", label());
        for (a, b) in a.crossings.iter().zip(&b.crossings) {
            if b.r < horizons(0.9).0 + 0.1 {
                continue;
            }
            // A plane met at a small angle magnifies errors.
            let along = cross(&ray.start.j, &a.position);
            let slant = dot(&along, &plane).abs() / dot(&along, &along).sqrt();
            worst.see(distance(a.position, b.position) / b.r / (1.0 + b.r / place.r) * share * slant, label);
        }
    }
    assert!(several > 20, "{several}");
    worst.below(1e-5, "crossings by large steps");
}

/// The angle between two crossings as seen from the centre.
fn apart(a: &Crossing, b: &Crossing) -> f64 {
    let length = |v: [f64; 3]| dot(&v, &v).sqrt();
    (dot(&a.position, &b.position) / length(a.position) / length(b.position)).clamp(-1.0, 1.0).acos()
}

/// A plane that osculates a ray, tilted by so little that the ray dips through it and back within
/// one large step: dragged along, a ray does not stay in a plane through the centre.
#[test]
fn planes_that_are_grazed() {
    let spin = 0.998;
    let rough = Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-5 }, 1000).boxed();
    let fine = Integrator::new(Kerr::new(spin), Scheme::Tsit5 { tolerance: 1e-12 }, 10_000).boxed();
    let (mut dips, mut crowded) = (0, 0);
    for (alpha, beta) in [(-6.0, 5.0), (2.0, 7.0), (5.0, -6.5), (-4.0, -6.0), (7.5, 2.0)] {
        let ray = impact(spin, 1.0, 60.0, alpha, beta);
        let points = follow(&fine, &ray, &Query { points: 400, ..Query::default() }).points;
        let place = |k: usize| [points[k][1], points[k][2], points[k][3]];
        for k in (20..380).step_by(20) {
            let across = cross(&place(k - 1), &place(k + 1));
            let (length, r) = (dot(&across, &across).sqrt(), dot(&place(k), &place(k)).sqrt());
            for tilt in [1e-3, 1e-4, -1e-4, -1e-3] {
                let plane: [f64; 3] = std::array::from_fn(|i| across[i] / length + tilt * place(k)[i] / r);
                let size = dot(&plane, &plane).sqrt();
                let query = Query { plane: plane.map(|c| c / size), ..Query::default() };
                let (a, b) = (follow(&rough, &ray, &query), follow(&fine, &ray, &query));
                // A dip next to another crossing, three in one step, may count as one.
                if b.crossings.windows(3).any(|c| apart(&c[0], &c[2]) < 1.5) {
                    crowded += 1;
                    continue;
                }
                assert_eq!(a.crossings.len(), b.crossings.len(), "({alpha}, {beta}), point {k}, tilt {tilt}");
                // Two crossings less than half a radian apart.
                dips += b.crossings.windows(2).filter(|c| apart(&c[0], &c[1]) < 0.8).count();
            }
        }
    }
    assert!(dips > 50 && crowded < 60, "{dips} {crowded}");
}

/// A camera in the plane has not crossed it, and a ray within the plane never does.
#[test]
fn starting_in_the_plane() {
    for scheme in [DOP853, Scheme::Tsit5 { tolerance: 1e-8 }, Scheme::Rk4 { step: 0.1 }] {
        let place = Place { r: 20.0, theta: FRAC_PI_2, phi: 0.4 };
        let observer = Observer::new(Some(0.9), place, Motion::Static).unwrap();
        for along in [-0.99, -0.8, 0.3] {
            let side = f64::sqrt(1.0 - along * along);
            for flat in [observer.ray([along, 0.0, side]), observer.ray([along, 0.0, -side])] {
                let path = follow(&tracer(scheme), &flat, &Query::default());
                assert!(path.crossings.is_empty(), "{:?}", path.crossings);
                if let Some([theta, _]) = path.direction {
                    assert_eq!(theta, FRAC_PI_2);
                }
            }
        }
        // Upwards over the hole: the first crossing lies behind it.
        let path = follow(&tracer(scheme), &observer.ray([-0.8, -0.6, 0.0]), &Query::default());
        assert!(
            path.crossings.iter().all(|c| c.r < 500.0 && c.position[0] * 0.9 < 19.0),
            "{:?}",
            path.crossings
        );
        let near = observer.position();
        assert!(path.crossings.iter().all(|c| distance(c.position, near) > 1.0));
    }
    // From infinity edge-on: β > 0 starts in the equator too.
    let path = follow(&tracer(DOP853), &impact(0.9, FRAC_PI_2, f64::INFINITY, 3.0, 7.0), &Query::default());
    assert_eq!(path.crossings.len(), 1);
    let flat = follow(&tracer(DOP853), &impact(0.9, FRAC_PI_2, f64::INFINITY, 7.5, 0.0), &Query::default());
    assert_eq!((flat.fate, flat.crossings.len()), (Fate::Escaped, 0));
}

/// Points begin at the camera, end at the horizon or far away, and come in order.
#[test]
fn points_along_rays() {
    let outer = horizons(0.9).0;
    for scheme in [DOP853, Scheme::Tsit5 { tolerance: 1e-8 }, Scheme::Rk4 { step: 0.1 }] {
        for (along, fate) in [(-0.999, Fate::Captured), (-0.9, Fate::Escaped), (0.5, Fate::Escaped)] {
            let place = Place { r: 20.0, theta: 1.2, phi: 0.4 };
            let observer = Observer::new(Some(0.9), place, Motion::Static).unwrap();
            let ray = observer.ray([along, f64::sqrt(1.0 - along * along), 0.0]);
            for count in [1, 2, 50] {
                let path = follow(&tracer(scheme), &ray, &Query { points: count, ..Query::default() });
                assert_eq!((path.fate, path.points.len()), (fate, count));
                let radius = |p: &[f64; 4]| Kerr::new(-0.9).radius(&[p[1], p[2], p[3]]);
                assert!((radius(&path.points[0]) - 20.0).abs() < 1e-9);
                assert!(path.points[0][0].abs() < 1e-9);
                assert!(path.points.windows(2).all(|p| p[1][0] < p[0][0]));
                if count > 1 {
                    let last = radius(&path.points[count - 1]);
                    if fate == Fate::Captured {
                        assert!((last - outer).abs() < 1e-6, "{scheme:?} ends at r = {last}");
                    } else {
                        assert!(last > 19.0, "{scheme:?} ends at r = {last}");
                    }
                }
            }
        }
    }
    // From infinity, and passing at a distance.
    for alpha in [3.0, 10.0, 1e3, 1e6] {
        let ray = impact(0.9, 1.0, f64::INFINITY, alpha, 0.0);
        let path = follow(&tracer(DOP853), &ray, &Query { points: 20, ..Query::default() });
        assert_eq!(path.points.len(), 20);
        let nearest = path.points.iter().map(|p| p[1].hypot(p[2]).hypot(p[3])).fold(f64::INFINITY, f64::min);
        assert!(path.points.iter().flatten().all(|c| c.is_finite()), "{:?}", path.points);
        assert!(nearest < 1.05 * alpha, "{nearest}");
    }
    let ray = Observer::new(None, Place { r: 9.0, theta: 1.0, phi: 0.0 }, Motion::Static)
        .unwrap()
        .ray([0.0, 1.0, 0.0]);
    let flat = Integrator::new(Minkowski, DOP853, 1000);
    assert_eq!(follow(&flat, &ray, &Query { points: 5, ..Query::default() }).points.len(), 5);
}
