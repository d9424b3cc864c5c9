//! The light's momentum where it leaves the plane, and its time, by both engines.

use crate::common;

use common::engines::{TIMED, closed, integrated, seen};
use common::{Random, follow};
use kerrscope_spacetime::closed::{ClosedForm, NODES};
use kerrscope_spacetime::emitter::{Departure, Equator};
use kerrscope_spacetime::geodesic::{
    Fate, Integrator, Path, Query, Ray, Scheme, SphericalIntegrator, Tracer,
};
use kerrscope_spacetime::metric::{Components, Kerr, Metric};
use kerrscope_spacetime::observer::impact_ray;

/// A ray at random, of a camera at infinity, far away or near.
fn random_ray(random: &mut Random, spin: f64) -> Option<Ray> {
    let inclination = random.within(0.05, 3.09);
    if random.within(0.0, 1.0) < 0.3 {
        let (r, direction) = (random.scale(3.0, 50.0), random.direction());
        return Some(seen(spin, r, inclination, direction));
    }
    let distance = random.pick(&[f64::INFINITY, 1000.0, 40.0]);
    let impact = [random.within(-12.0, 12.0), random.within(-12.0, 12.0)];
    impact_ray(Some(spin), inclination, distance, impact).ok()
}

/// p_r√g^rr per energy: next to a turning point the sign of the radial motion is within its error.
fn radial(spin: f64, light: &Departure, r: f64) -> f64 {
    let equator = Equator::kerr(spin, r);
    let photon = [1.0, light.lambda];
    equator.product(photon, photon) - light.normal * light.normal
}

/// 1,000 rays: the time of each crossing, by both engines, as a share of itself or of the radius where that is more; over
/// what nearness to the critical curve multiplies errors by.
#[test]
fn both_engines_know_when_and_which_way_light_leaves() {
    let mut random = Random::new(77);
    let (mut rays, mut crossings) = (0, 0);
    let mut errors = Vec::new();
    let mut worst_normal = 0.0_f64;
    while rays < 1000 {
        let spin = random.within(-0.998, 0.998);
        let Some(ray) = random_ray(&mut random, spin) else { continue };
        let (one, other) = (closed(spin, &ray, &TIMED), integrated(spin, &ray));
        let sensitivity = Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
        if one.fate == Fate::StepLimit || sensitivity > 1e4 {
            continue;
        }
        rays += 1;
        assert_eq!((one.fate, one.crossings.len()), (other.fate, other.crossings.len()));
        let eta = ray.conserved(spin).eta;
        for (a, b) in one.crossings.iter().zip(&other.crossings) {
            crossings += 1;
            let off = (a.elapsed - b.elapsed).abs() / b.elapsed.abs().max(b.r).max(1.0);
            errors.push(off / sensitivity);
            worst_normal = worst_normal.max((a.normal - b.normal).abs() / sensitivity);
            assert!((a.normal.abs() - eta.sqrt() / a.r).abs() < 1e-12 * (1.0 + a.normal.abs()));
            let light = Departure::new(&ray, a, &TIMED.plane);
            if radial(spin, &light, a.r) > 1e-9 * sensitivity {
                assert_eq!(a.outward, b.outward, "{ray:?} {a:?} {b:?}");
            }
        }
    }
    errors.sort_by(f64::total_cmp);
    let (median, largest) = (errors[errors.len() / 2], errors[errors.len() - 1]);
    println!("{crossings} crossings: time {median:e}, largest {largest:e}; p_z largest {worst_normal:e}");
    assert!(largest < 1e-9 && worst_normal < 1e-10, "{largest:e} {worst_normal:e}");
}

/// Rays one by one and abreast, by all that follow them.
#[test]
fn all_tracers_agree_on_the_way_light_leaves() {
    let mut random = Random::new(78);
    let spin = 0.8;
    let mut rays = Vec::new();
    while rays.len() < 300 {
        rays.extend(random_ray(&mut random, spin));
    }
    let scheme = Scheme::Dop853 { tolerance: 1e-11 };
    let tracers: [Box<dyn Tracer>; 5] = [
        Box::new(ClosedForm::new(spin, NODES, 10_000)),
        Integrator::new(Kerr::new(spin), scheme, 10_000).boxed(),
        Integrator::new(Components(Kerr::new(spin)), Scheme::Tsit5 { tolerance: 1e-10 }, 10_000).boxed(),
        Integrator::new(Kerr::new(spin), Scheme::Rk4 { step: 0.01 }, 200_000).boxed(),
        Box::new(SphericalIntegrator::new(spin, scheme, 10_000)),
    ];
    let query = Query::default();
    let mut compared = 0;
    for tracer in &tracers {
        let mut paths = vec![Path::default(); rays.len()];
        tracer.trace_all(&rays, &query, &mut paths);
        for (ray, path) in rays.iter().zip(&paths) {
            let known = closed(spin, ray, &query);
            let sensitivity = Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
            if path.fate == Fate::StepLimit || sensitivity > 1e3 {
                continue;
            }
            for (a, b) in known.crossings.iter().zip(&path.crossings) {
                let light = Departure::new(ray, a, &query.plane);
                assert!((a.normal - b.normal).abs() < 1e-5, "{}: {a:?} {b:?}", tracer.name());
                if radial(spin, &light, a.r) > 1e-4 {
                    assert_eq!(a.outward, b.outward, "{}: {a:?} {b:?}", tracer.name());
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// A camera in free fall within the horizon: light from outside of the photon orbits came inwards.
#[test]
fn light_that_has_fallen_in_left_inwards() {
    use kerrscope_spacetime::observer::{Motion, Observer, Place};
    let spin = 0.6;
    let observer = Observer::new(Some(spin), Place { r: 1.5, theta: 1.2, phi: 0.0 }, Motion::Fall).unwrap();
    let mut random = Random::new(4);
    let mut seen = 0;
    for _ in 0..400 {
        let ray = observer.ray(random.direction());
        let path = follow(
            &Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-12 }, 10_000),
            &ray,
            &Query::default(),
        );
        for crossing in path.crossings.iter().filter(|c| c.r > 2.0) {
            let light = Departure::new(&ray, crossing, &[0.0, 0.0, 1.0]);
            let eta = ray.conserved(spin).eta;
            assert!(
                (light.normal.abs() - eta.sqrt() / crossing.r).abs() < 1e-9 * eta.max(1.0),
                "{crossing:?}"
            );
            // Light turns back inwards only from within the photon orbits.
            assert!(!crossing.outward || crossing.r < 4.0, "{crossing:?}");
            seen += 1;
        }
        if let [first, second, ..] = path.crossings[..] {
            assert!(first.normal * second.normal < 0.0, "{path:?}");
        }
        if let [first, ..] = path.crossings[..] {
            assert!(first.normal > 0.0, "the camera is above the plane: {first:?}");
        }
    }
    assert!(seen > 20, "{seen}");
}
