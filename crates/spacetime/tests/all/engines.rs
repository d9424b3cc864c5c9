//! The closed form and the integrator, ray by ray: two ways that share nothing but the ray's start.

use crate::common;

use common::Random;
use kerrscope_spacetime::Level;
use kerrscope_spacetime::closed::ClosedForm;
use kerrscope_spacetime::geodesic::{Integrator, Path, Query, Ray, Scheme, Tracer};
use kerrscope_spacetime::metric::{Kerr, Metric};
use kerrscope_spacetime::observer::{Motion, Observer, Place, impact_ray};

/// Random rays of one hole: of cameras from 1.2 r₊ to 10⁴ M, half of them looking anywhere, half towards the
/// hole, and some from infinity.
fn shots(random: &mut Random, spin: f64, count: usize) -> Vec<Ray> {
    let horizon = 1.0 + (1.0 - spin * spin).sqrt();
    let mut rays = Vec::with_capacity(count);
    while rays.len() < count {
        let theta = random.within(-1.0, 1.0).acos();
        if rays.len() % 7 == 0 {
            let impact = [random.within(-12.0, 12.0), random.within(-12.0, 12.0)];
            rays.extend(impact_ray(Some(spin), theta, f64::INFINITY, impact));
            continue;
        }
        let r = 1.2 * horizon * (1e4 / (1.2 * horizon)).powf(random.within(0.0, 1.0));
        let place = Place { r, theta, phi: random.within(-3.0, 3.0) };
        let observer = Observer::new(Some(spin), place, Motion::ZeroAngularMomentum).unwrap();
        let reach = 20.0 / r.max(20.0);
        let direction = if rays.len() % 2 == 0 {
            let (up, turn) = (random.within(-1.0, 1.0), random.within(-3.2, 3.2));
            let flat = f64::sqrt(1.0 - up * up);
            [up, flat * turn.cos(), flat * turn.sin()]
        } else {
            [-1.0, reach * random.within(-1.0, 1.0), reach * random.within(-1.0, 1.0)]
        };
        let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
        rays.push(observer.ray(direction.map(|c| c / length)));
    }
    rays
}

/// How two paths differ: angle between directions; radius, azimuth and place of crossings; time.
#[derive(Default)]
struct Differences {
    sky: Vec<f64>,
    crossing: Vec<f64>,
    time: Vec<f64>,
}

impl Differences {
    fn see(&mut self, one: &Path, other: &Path) -> [f64; 3] {
        let unit = |[theta, phi]: [f64; 2]| [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
        let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        let sky = match (one.direction, other.direction) {
            (Some(a), Some(b)) => {
                // Turns count too, but next to the axis one way around is as good as the other.
                let near_axis = a[0].sin() < 1e-3;
                assert!(near_axis || (a[1] - b[1]).abs() < 1.0, "{a:?} {b:?}");
                apart(unit(a), unit(b))
            }
            _ => 0.0,
        };
        let (mut crossing, mut time) = (0f64, 0f64);
        for (a, b) in one.crossings.iter().zip(&other.crossings) {
            let place = apart(a.position, b.position) / b.r;
            crossing = crossing.max((a.r / b.r - 1.0).abs()).max((a.phi - b.phi).abs()).max(place);
            time = time.max((a.elapsed - b.elapsed).abs() / b.elapsed.abs().max(b.r));
        }
        self.sky.extend((sky > 0.0).then_some(sky));
        self.crossing.extend((crossing > 0.0).then_some(crossing));
        self.time.extend((time > 0.0).then_some(time));
        [sky, crossing, time]
    }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// How far a ray that reaches r may be off, by its sensitivity, which is 1/(2δ) at a relative distance δ from
/// the critical curve: 10⁻¹⁴ r/δ, but at least `least`; and 10⁻¹⁴/Δ, Δ = r² − 2r + a², next to the horizon, where
/// azimuth and time grow without end.
fn bound(least: f64, spin: f64, path: &Path, sensitivity: f64) -> f64 {
    let farthest = path.crossings.iter().map(|c| c.r).fold(1.0, f64::max);
    let nearest = path.crossings.iter().map(|c| c.r * (c.r - 2.0) + spin * spin).fold(1.0, f64::min);
    least.max(2e-14 * farthest * sensitivity).max(1e-14 / nearest)
}

/// 100,000 rays around 100 holes, each of which must agree: directions, radii, azimuths and places of crossings
/// and times to 10⁻⁹, places without times to 10⁻⁸, or as nearness to the critical curve allows.
#[test]
fn closed_form_and_integrator_agree() {
    let mut random = Random::new(404);
    let mut differences = Differences::default();
    let query = Query { elapsed: true, ..Query::default() };
    let untimed = Query { elapsed: false, ..query };
    let (mut closed, mut integrated) = (Path::default(), Path::default());
    for k in 0..100 {
        let spin = [0.0, 1.0, -1.0, 0.998].get(k).copied().unwrap_or_else(|| random.within(-1.0, 1.0));
        let tracer = ClosedForm::new(spin, 24, 10_000);
        let reference =
            Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-14 }, 100_000).boxed();
        for ray in shots(&mut random, spin, 1000) {
            reference.trace(&ray, &query, &mut integrated);
            let sensitivity = Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
            let tight = bound(1e-9, spin, &integrated, sensitivity);
            // Without time, distant light takes another way.
            let loose = bound(1e-9, spin, &integrated, sensitivity);
            for (query, place, time) in [(&query, tight, tight), (&untimed, loose, f64::INFINITY)] {
                tracer.trace(&ray, query, &mut closed);
                let told = || format!("a = {spin}: {ray:?}\n{closed:?}\n{integrated:?}");
                assert_eq!(closed.fate, integrated.fate, "{}", told());
                assert_eq!(closed.crossings.len(), integrated.crossings.len(), "{}", told());
                let found = differences.see(&closed, &integrated);
                let [sky, crossing, late] = found;
                assert!(sky < place && crossing < place && !(late > time), "{found:?} {place:e} {}", told());
            }
        }
    }
    for (what, values) in [
        ("sky", &mut differences.sky),
        ("crossing", &mut differences.crossing),
        ("time", &mut differences.time),
    ] {
        assert!(values.len() > 50_000, "{what}");
        let median = median(values);
        assert!(median < 1e-14, "median difference of {what}: {median:e}");
    }
}

/// What a batch finds does not depend on what else is in it, and is what single rays find but for the
/// roundings of vector functions.
#[test]
fn batches_are_single_rays() {
    let mut random = Random::new(405);
    for spin in [0.0, 0.3, -0.9, 0.99, 0.9999, 1.0, -1.0] {
        let rays = shots(&mut random, spin, 700);
        for elapsed in [false, true] {
            let query = Query { elapsed, max_crossings: 3, ..Query::default() };
            for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
                let tracer = ClosedForm::new(spin, 24, 10_000).with_level(level);
                let mut all = vec![Path::default(); rays.len()];
                tracer.trace_all(&rays, &query, &mut all);
                let mut again = vec![Path::default(); rays.len()];
                for (rays, paths) in rays.chunks(13).zip(again.chunks_mut(13)) {
                    tracer.trace_all(rays, &query, paths);
                }
                let mut single = Path::default();
                for ((ray, all), again) in rays.iter().zip(&all).zip(&again) {
                    assert_eq!(format!("{all:?}"), format!("{again:?}"), "the same bits beside other rays");
                    tracer.trace(ray, &query, &mut single);
                    assert_eq!((all.fate, all.crossings.len()), (single.fate, single.crossings.len()));
                    let found = Differences::default().see(all, &single);
                    let bound = 1e-10_f64.max(100.0 * single.error_estimate);
                    let [sky, crossing, time] = found;
                    let close = sky < bound && crossing < bound && (!elapsed || time < 10.0 * bound);
                    assert!(close, "{level:?} {found:?} {bound:e} {ray:?}");
                }
            }
        }
    }
}
