//! Rays in Kerr against other codes, against closed forms, against the separated equations in
//! Boyer–Lindquist coordinates, and against themselves run the other way.

use crate::common;

use common::mino::{Photon, travel};
use common::{DEGREE, Random, Worst, distance, folded, follow, impact, separation};
use kerrscope_spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Tracer};
use kerrscope_spacetime::kerr::horizons;
use kerrscope_spacetime::metric::{Inverted, Kerr, Metric};
use kerrscope_spacetime::observer::{Motion, Observer, Place};
use kerrscope_spacetime::tensor::{cross, dot};
use std::f64::consts::{FRAC_PI_2, PI};

const SPINS: [f64; 9] = [0.0, 0.3, -0.5, 0.9, -0.9, 0.998, -0.998, 1.0, -1.0];

fn integrator(spin: f64) -> Box<dyn Tracer> {
    Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-13 }, 10_000).boxed()
}

fn timed() -> Query {
    Query { elapsed: true, ..Query::default() }
}

/// First crossings of sixty rays by kerrz 0.4.1 (closed form), the observer at r = 1000. The file
/// lies beside the workspace where the project is developed, and is not part of it.
// The test reads a file, not the crate.
#[allow(clippy::disallowed_methods)]
#[test]
fn another_code() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/reference/equatorial_crossings.json");
    let Ok(text) = std::fs::read_to_string(file) else {
        eprintln!("skipped: no reference data");
        return;
    };
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    let mut worst = Worst::default();
    for row in data["rows"].as_array().unwrap() {
        let number = |key: &str| row[key].as_f64().unwrap();
        let (spin, inclination) = (number("spin"), number("inclination") * DEGREE);
        let ray = impact(spin, inclination, 1000.0, number("alpha"), number("beta"));
        let first = follow(&integrator(spin), &ray, &Query::default()).crossings[0];
        let phi = folded(first.phi - number("phi")).abs();
        worst.see((first.r / number("r") - 1.0).abs().max(phi), || row.to_string());
    }
    assert_eq!(worst.count, 60);
    worst.below(1e-6, "kerrz");
}

/// The same with six digits in the papers on kgeo and ipole: (a, i, α, β) → r(cos φ, sin φ).
#[test]
fn published_crossings() {
    let rows: [([f64; 4], [f64; 2]); 4] = [
        ([0.42, 60.0, -17.0, 0.0], [-0.0522336, -16.0342]),
        ([0.42, 60.0, 8.0, 0.0], [0.129720, 6.94829]),
        ([0.9, 10.0, -12.0, 0.0], [-0.164094, -11.0082]),
        ([0.73, 35.0, 1e-4, -10.0], [11.8258, -0.0858775]),
    ];
    for ([spin, degrees, alpha, beta], place) in rows {
        let ray = impact(spin, degrees * DEGREE, 1000.0, alpha, beta);
        let first = follow(&integrator(spin), &ray, &Query::default()).crossings[0];
        let got = [first.r * first.phi.cos(), first.r * first.phi.sin()];
        for i in 0..2 {
            // Six digits of each.
            let last = 10f64.powf(place[i].abs().log10().floor() - 5.0);
            assert!((got[i] - place[i]).abs() < 0.6 * last, "{got:?}, {place:?}");
        }
    }
}

/// λ = 4 (of the reversed photon), η = 30 from infinity, a = 0.9, i = 1, β < 0: by closed form.
#[test]
fn closed_form_from_infinity() {
    let (spin, inclination): (f64, f64) = (0.9, 1.0);
    let alpha = 4.0 / inclination.sin();
    let beta = -(30.0 - (alpha * alpha - spin * spin) * inclination.cos().powi(2)).sqrt();
    let ray = impact(spin, inclination, f64::INFINITY, alpha, beta);
    let conserved = ray.conserved(spin);
    assert!((conserved.lambda + 4.0).abs() < 1e-14 && (conserved.eta - 30.0).abs() < 1e-13);
    let first = follow(&integrator(spin), &ray, &Query::default()).crossings[0];
    assert!((first.r - 9.966537978).abs() < 6e-10, "{}", first.r);
    assert!((first.phi - 0.474082717).abs() < 6e-10, "{}", first.phi);
}

/// What the integrator and the separated equations differ by, weighted by how much the ray
/// magnifies errors.
fn compare(
    spin: f64,
    ray: &Ray,
    path: &Path,
    photon: Photon,
    from: [f64; 2],
    signs: [bool; 2],
    worst: &mut Worst,
) {
    let trip = travel(photon, from[0], from[1], signs[0], if signs[1] { 1.0 } else { -1.0 });
    let share = 1.0 / Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
    // sin θ of the closest approach to the axis, where φ is steep, is about this.
    let aside = photon.lambda.abs() / photon.lambda.hypot(photon.eta.max(0.0).sqrt());
    let place = || format!("{photon:?} from {from:?} {signs:?}");
    assert_ne!(path.fate, Fate::StepLimit);
    assert_eq!(path.fate == Fate::Escaped, trip.direction.is_some(), "{}", place());
    if let (Some([theta, phi]), Some([theta_other, phi_other])) = (path.direction, trip.direction) {
        let sin = theta.sin();
        worst.see((theta - theta_other).abs() * share * sin.max(1e-3), || format!("θ, {}", place()));
        worst.see((phi - phi_other).abs() * share * sin * aside, || format!("φ, {}", place()));
    }
    // Light that winds up at the horizon does so without end in Boyer–Lindquist coordinates.
    let horizon = horizons(spin).0 + 1e-2;
    let (ours, theirs) = (path.crossings.iter(), trip.crossings.iter());
    let (ours, theirs): (Vec<_>, Vec<_>) =
        (ours.filter(|c| c.r > horizon).collect(), theirs.filter(|c| c[0] > horizon).take(8).collect());
    assert_eq!(ours.len(), theirs.len(), "{}: {ours:?} {theirs:?}", place());
    for (our, their) in ours.iter().zip(theirs) {
        // Far crossings are found as 1/r.
        let near = share / (1.0 + our.r * from[0].max(1e-2));
        worst.see((our.r / their[0] - 1.0).abs() * near, || format!("r, {}", place()));
        worst.see((our.phi - their[1]).abs() * near * aside, || format!("azimuth, {}", place()));
        if photon.timed && our.r < 900.0 {
            let size = 1.0 / from[0] + our.r;
            worst.see((our.elapsed - their[2]).abs() / size * near, || format!("time, {}", place()));
        }
    }
}

/// Screens at infinity: fate, crossings and direction, with windings counted.
#[test]
fn separated_equations_from_infinity() {
    let mut random = Random::new(51);
    let mut worst = Worst::default();
    for _ in 0..1500 {
        let spin = random.pick(&SPINS);
        let inclination = random.within(0.02, PI - 0.02);
        let (b, turn) = (random.scale(0.3, 60.0), random.within(-PI, PI));
        let (alpha, beta) = (b * turn.cos(), b * turn.sin());
        let (sin, cos) = inclination.sin_cos();
        let lambda = alpha * sin;
        if lambda.abs() < 0.05 {
            continue;
        }
        let eta = (alpha * alpha - spin * spin) * cos * cos + beta * beta;
        let ray = impact(spin, inclination, f64::INFINITY, alpha, beta);
        let path = follow(&integrator(spin), &ray, &Query::default());
        let photon = Photon { spin: -spin, lambda, eta, timed: false, falling: false };
        compare(spin, &ray, &path, photon, [0.0, cos], [true, beta > 0.0], &mut worst);
    }
    worst.below(5e-12, "from infinity");
}

/// Static cameras and their whole sky, close to the hole too, with elapsed times.
#[test]
fn separated_equations_from_cameras() {
    let mut random = Random::new(52);
    let mut worst = Worst::default();
    for _ in 0..1500 {
        let spin = random.pick(&SPINS);
        let place = Place { r: random.scale(2.1, 300.0), theta: random.within(0.02, PI - 0.02), phi: 0.0 };
        let observer = Observer::new(Some(spin), place, Motion::Static).unwrap();
        let [out, down, along] = random.direction();
        let ray = observer.ray([out, down, along]);
        let conserved = ray.conserved(spin);
        let photon = Photon {
            spin: -spin,
            lambda: -conserved.lambda,
            eta: conserved.eta,
            timed: true,
            falling: false,
        };
        // The separated equations know neither poles nor a start at a turning point.
        if photon.lambda.abs() < 0.05 || out.abs() < 1e-3 || down.abs() < 1e-3 {
            continue;
        }
        let path = follow(&integrator(spin), &ray, &timed());
        compare(
            spin,
            &ray,
            &path,
            photon,
            [1.0 / place.r, place.theta.cos()],
            [out < 0.0, down < 0.0],
            &mut worst,
        );
    }
    worst.below(5e-12, "from cameras");
}

/// A principal null ray, λ = a sin²θ, keeps θ and φ̃ and has t̃ + r constant: everything about it
/// is elementary, a = 0 among it (t = r + 2 ln(r/2 − 1)).
#[test]
fn principal_null_rays() {
    let mut worst = Worst::default();
    for spin in [0.01, 0.5, -0.5, 0.9, -0.998, 1.0, -1.0] {
        let (outer, inner) = horizons(spin);
        let gap = outer - inner;
        // t̃ − t and φ̃ − φ, the signs those of the reversed hole.
        let delay = |r: f64| {
            if gap == 0.0 {
                2.0 * (r - 1.0).ln() - 2.0 / (r - 1.0)
            } else {
                2.0 / gap * (outer * (r - outer).ln() - inner * (r - inner).ln())
            }
        };
        let twist = |r: f64| {
            if gap == 0.0 { spin / (r - 1.0) } else { -spin / gap * ((r - outer) / (r - inner)).ln() }
        };
        for inclination in [0.1, 0.7, FRAC_PI_2, 2.5] {
            for camera in [f64::INFINITY, 1e4, 30.0, 5.0] {
                let ray = impact(spin, inclination, camera, -spin * inclination.sin(), 0.0);
                let whole = if camera.is_infinite() { 0.0 } else { twist(camera) };
                // In the chart the place turns by atan(−a/r) as it falls.
                let span =
                    (-spin / outer).atan() - if camera.is_infinite() { 0.0 } else { (-spin / camera).atan() };
                let first = if camera.is_infinite() { 0.0 } else { (-spin).atan2(camera) };
                for share in [0.05, 0.3, 0.8, 0.999] {
                    let psi = first + whole + share * span;
                    let query = Query { plane: [-psi.sin(), psi.cos(), 0.0], ..timed() };
                    let path = follow(&integrator(spin), &ray, &query);
                    let place = || format!("a = {spin}, i = {inclination}, r₀ = {camera}, {share}");
                    assert_eq!((path.fate, path.crossings.len()), (Fate::Captured, 1), "{}", place());
                    let c = path.crossings[0];
                    let r = -spin / (first + share * span).tan();
                    worst.see((c.r / r - 1.0).abs(), || format!("r, {}", place()));
                    worst
                        .see((c.position[2] - r * inclination.cos()).abs() / r, || format!("θ, {}", place()));
                    // Judged where the crossing was found: near the horizon φ and t are steep.
                    worst.see((c.phi - (whole - twist(c.r))).abs(), || format!("φ, {}", place()));
                    let elapsed = if camera.is_infinite() {
                        -c.r - delay(c.r) + 2.0 * 2f64.ln()
                    } else {
                        camera - c.r + delay(camera) - delay(c.r)
                    };
                    let size = if camera.is_infinite() { c.r } else { camera };
                    worst.see((c.elapsed - elapsed).abs() / size.max(1.0), || format!("t, {}", place()));
                }
            }
        }
    }
    worst.below(2e-13, "principal null rays");
}

/// Radial rays at a = 0 meet no plane, but their points have t̃ = r − r₀ on the way in and
/// t̃ = r₀ − r − 4 ln((r − 2)/(r₀ − 2)) on the way out.
#[test]
fn radial_rays() {
    let mut worst = Worst::default();
    for r0 in [2.2, 6.0, 100.0] {
        let place = Place { r: r0, theta: 1.2, phi: 0.5 };
        let observer = Observer::new(Some(0.0), place, Motion::Static).unwrap();
        for sign in [-1.0, 1.0] {
            let path =
                follow(&integrator(0.0), &observer.ray([sign, 0.0, 0.0]), &Query { points: 60, ..timed() });
            assert_eq!(path.fate, if sign < 0.0 { Fate::Captured } else { Fate::Escaped });
            assert!(path.crossings.is_empty());
            for [t, x, y, z] in path.points {
                let r = dot(&[x, y, z], &[x, y, z]).sqrt();
                let exact = if sign < 0.0 { r - r0 } else { r0 - r - 4.0 * ((r - 2.0) / (r0 - 2.0)).ln() };
                worst.see((t - exact).abs() / (r + r0), || format!("r₀ = {r0}, r = {r}"));
                assert!(distance([x / r, y / r, z / r], observer.position().map(|c| c / r0)) < 1e-13);
            }
        }
    }
    worst.below(2e-13, "radial rays");
}

/// The elapsed time from ever further cameras, less r + 2 ln(r/2), tends to that from infinity.
#[test]
fn elapsed_time_from_far_away() {
    let mut random = Random::new(53);
    let mut worst = Worst::default();
    for _ in 0..60 {
        let (spin, inclination) = (random.pick(&SPINS), random.within(0.1, 3.0));
        let (b, turn) = (random.within(7.0, 15.0), random.within(-PI, PI));
        let at = |r: f64| {
            let ray = impact(spin, inclination, r, b * turn.cos(), b * turn.sin());
            let path = follow(&integrator(spin), &ray, &timed());
            let taken = if r.is_infinite() { 0.0 } else { r + 2.0 * (0.5 * r).ln() };
            path.crossings.iter().map(|c| [c.r, c.phi, c.elapsed - taken]).collect::<Vec<_>>()
        };
        let limit = at(f64::INFINITY);
        assert!(!limit.is_empty() || (inclination - FRAC_PI_2).abs() < 0.5);
        let far: Vec<_> = [4e3, 8e3, 1.6e4, 3.2e4].map(at).into();
        for (k, exact) in limit.iter().enumerate() {
            if exact[0] > 100.0 {
                continue;
            }
            for i in 0..3 {
                // Richardson's extrapolation in powers of 1/r.
                let mut row: Vec<f64> = far.iter().map(|crossings| crossings[k][i]).collect();
                for power in 1..4 {
                    let factor = 2f64.powi(power);
                    row = row.windows(2).map(|pair| (factor * pair[1] - pair[0]) / (factor - 1.0)).collect();
                }
                let size = if i == 1 { 1.0 } else { exact[0] };
                worst.see((row[0] - exact[i]).abs() / size, || {
                    format!("a = {spin}, i = {inclination}, {b}, {turn}, {i}")
                });
            }
        }
    }
    worst.below(3e-9, "elapsed time from infinity");
}

/// A ray traced out to infinity, and light sent in from there with the direction and the
/// constants that it was found to have: it must come to the camera. The sender looks at the hole
/// in the spacetime reversed once more, so its ray is that of a hole of the opposite spin.
#[test]
fn there_and_back() {
    let mut random = Random::new(54);
    let mut worst = Worst::default();
    for _ in 0..500 {
        let spin = random.pick(&SPINS);
        let place = Place { r: random.scale(2.5, 100.0), theta: random.within(0.1, 3.0), phi: 0.0 };
        let ray = Observer::new(Some(spin), place, Motion::Static).unwrap().ray(random.direction());
        let path = follow(&integrator(spin), &ray, &Query::default());
        let Some([theta, phi]) = path.direction else { continue };
        let conserved = ray.conserved(spin);
        let (sin, cos) = theta.sin_cos();
        let alpha = conserved.lambda / sin;
        let square = conserved.eta - (alpha * alpha - spin * spin) * cos * cos;
        if sin < 0.05 || square < 1e-4 {
            // On the axis or turning in θ at infinity, (α, β) is no good function of (λ, η).
            continue;
        }
        // The camera in the chart of the returning ray, its azimuth counted from the sender's.
        let camera =
            Observer::new(Some(-spin), Place { phi: -phi, ..place }, Motion::Static).unwrap().position();
        // The photon comes back as it went: of the two β one is right.
        let errors = [1.0, -1.0].map(|sign| {
            let back = impact(-spin, theta, f64::INFINITY, alpha, sign * square.sqrt());
            // A plane through the camera and the axis of a vector across the ray there.
            let ahead = cross(&camera, &[0.3, -0.5, 0.8]);
            let length = dot(&ahead, &ahead).sqrt();
            let query = Query { plane: ahead.map(|c| c / length), ..Query::default() };
            let crossings = follow(&integrator(-spin), &back, &query).crossings;
            crossings.iter().map(|c| distance(c.position, camera) / place.r).fold(f64::INFINITY, f64::min)
        });
        let share = 1.0 / Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
        worst.see(errors[0].min(errors[1]) * share, || format!("a = {spin}, {place:?}, {ray:?}"));
    }
    assert!(worst.count > 200);
    worst.below(5e-12, "there and back");
}

/// Three methods in two charts with three sets of coefficients find the same.
#[test]
fn methods_agree() {
    let mut random = Random::new(55);
    let (mut tsit5, mut rk4) = (Worst::default(), Worst::default());
    for _ in 0..60 {
        let spin = random.pick(&SPINS);
        let place = Place { r: random.within(5.0, 30.0), theta: random.within(0.1, 3.0), phi: 1.0 };
        let ray = Observer::new(Some(spin), place, Motion::Static).unwrap().ray(random.direction());
        let run = |scheme| follow(&Integrator::new(Kerr::new(spin), scheme, 200_000).boxed(), &ray, &timed());
        let best = run(Scheme::Dop853 { tolerance: 1e-13 });
        let share = 1.0 / Kerr::new(-spin).sensitivity(ray.energy, &ray.start);
        for (scheme, worst) in
            [(Scheme::Tsit5 { tolerance: 1e-11 }, &mut tsit5), (Scheme::Rk4 { step: 0.01 }, &mut rk4)]
        {
            let path = run(scheme);
            let label = || format!("{scheme:?}, a = {spin}, {place:?}, {ray:?}");
            assert_eq!(path.fate, best.fate, "{}", label());
            assert_eq!(path.crossings.len(), best.crossings.len(), "{}", label());
            if let (Some(a), Some(b)) = (path.direction, best.direction) {
                worst.see(separation(a, b) * share, label);
                worst.see((a[1] - b[1]).abs() * b[0].sin() * share, label);
            }
            for (a, b) in path.crossings.iter().zip(&best.crossings) {
                if b.r < horizons(spin).0 + 0.01 {
                    continue;
                }
                let size = b.r.max(place.r);
                let near = share / b.r.max(1.0);
                worst.see((a.r - b.r).abs() / size * near, || format!("r, {}", label()));
                worst.see((a.phi - b.phi).abs() * near, || format!("φ, {}", label()));
                worst.see((a.elapsed - b.elapsed).abs() / size * near, || {
                    format!("t {} at r = {}, {}", b.elapsed, b.r, label())
                });
                worst.see(distance(a.position, b.position) * share / size / b.r, label);
            }
        }
    }
    tsit5.below(3e-12, "Tsitouras's method");
    rk4.below(5e-10, "Runge and Kutta's method");
}

/// The points of a ray are events on a null geodesic: by differences their tangent is null and
/// has the ray's L/E and Q/E². That tests t as well.
#[test]
fn points_are_on_a_null_geodesic() {
    let mut random = Random::new(56);
    let mut both = [Worst::default(), Worst::default()];
    for i in 0..60 {
        let worst = &mut both[usize::from(i % 3 == 0)];
        let spin = random.pick(&SPINS);
        let place = Place { r: random.scale(3.0, 50.0), theta: random.within(0.3, 2.8), phi: 1.0 };
        let ray = Observer::new(Some(spin), place, Motion::Static).unwrap().ray(random.direction());
        let scheme =
            if i % 3 == 0 { Scheme::Rk4 { step: 0.02 } } else { Scheme::Dop853 { tolerance: 1e-14 } };
        let path = follow(
            &Integrator::new(Kerr::new(spin), scheme, 100_000).boxed(),
            &ray,
            &Query { points: 600, ..timed() },
        );
        assert_eq!(path.points.len(), 600);
        let kerr = Kerr::new(-spin);
        assert!(
            distance(
                [path.points[0][1], path.points[0][2], path.points[0][3]],
                ray.start.n.map(|c| c / ray.start.w)
            ) < 1e-12 * place.r
        );
        assert!(path.points[0][0].abs() < 1e-11);
        for k in (3..597).step_by(11) {
            let at = path.points[k];
            let tangent: [f64; 4] = std::array::from_fn(|m| {
                let pair = |d: usize| path.points[k + d][m] - path.points[k - d][m];
                (45.0 * pair(1) - 9.0 * pair(2) + pair(3)) / 60.0
            });
            // The reversed photon's time runs on as the points' goes back.
            let velocity = [-tangent[0], tangent[1], tangent[2], tangent[3]];
            let x = [at[1], at[2], at[3]];
            let g = kerr.components(&x);
            let p: [f64; 4] = std::array::from_fn(|m| (0..4).map(|n| g[m][n] * velocity[n]).sum());
            let energy = -p[0];
            let p = [p[1] / energy, p[2] / energy, p[3] / energy];
            let w = 1.0 / dot(&x, &x).sqrt();
            let n = x.map(|c| c * w);
            let state = Inverted { w, n, q: dot(&n, &p), j: cross(&x, &p) };
            let label = || format!("{scheme:?}, a = {spin}, {place:?}, point {k}");
            let conserved = ray.conserved(spin);
            let size = 1.0 + conserved.lambda * conserved.lambda + conserved.eta.abs();
            worst.see(kerr.norm(1.0, &state).abs() / (1.0 + dot(&p, &p)), || format!("null, {}", label()));
            worst.see((state.j[2] + conserved.lambda).abs() / size.sqrt(), || format!("λ, {}", label()));
            worst.see((kerr.carter(1.0, &state).unwrap() - conserved.eta).abs() / size, || {
                format!("η, {}", label())
            });
        }
    }
    both[0].below(3e-8, "tangents");
    both[1].below(5e-6, "tangents of Runge and Kutta's");
}
