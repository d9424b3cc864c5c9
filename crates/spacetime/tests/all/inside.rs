//! Cameras inside the horizon: light that fell in after them, followed backwards in ingoing
//! coordinates, out through the horizon, and on in the reversed spacetime.

use crate::common;

use common::mino::{Photon, travel};
use common::orbit::Orbit;
use common::{Random, Worst, distance, follow, impact, separation, unit};
use kerrscope_spacetime::geodesic::{EXIT, Fate, Integrator, Path, Query, Ray, Scheme, Side};
use kerrscope_spacetime::kerr::horizons;
use kerrscope_spacetime::metric::{Inverted, Kerr, Metric, Schwarzschild};
use kerrscope_spacetime::observer::{Motion, Observer, Place};
use kerrscope_spacetime::tensor::{cross, dot};
use std::f64::consts::FRAC_PI_2;

const DOP853: Scheme = Scheme::Dop853 { tolerance: 1e-13 };

fn trace(spin: f64, ray: &Ray) -> Path {
    follow(&Integrator::new(Kerr::new(spin), DOP853, 10_000).boxed(), ray, &Query::default())
}

/// At a = 0 a photon seen at an angle whose cosine from e_r is d by a camera that fell from rest
/// at infinity has b = r sin χ/(1 + d√(2/r)); if b < √27 it came from infinity, by the exact orbit.
#[test]
fn schwarzschild_by_the_exact_orbit() {
    let mut random = Random::new(91);
    let (mut worst, mut angles) = (Worst::default(), Worst::default());
    let mut captured = 0;
    for _ in 0..600 {
        let place = Place { r: random.within(0.2, 1.999), theta: random.within(0.1, 3.0), phi: 0.7 };
        let observer = Observer::new(Some(0.0), place, Motion::Fall).unwrap();
        let n = random.direction();
        let ray = observer.ray(n);
        assert_eq!(ray.side, Side::Ingoing);
        // The photon's energy at infinity, where it is one at the camera.
        let energy = 1.0 + n[0] * (2.0 / place.r).sqrt();
        let b = place.r * (1.0 - n[0] * n[0]).sqrt() / energy;
        worst.see((ray.energy + energy).abs() / (1.0 + energy.abs()), || format!("E, {place:?}, {n:?}"));
        let path = trace(0.0, &ray);
        if (b.abs() / 27f64.sqrt() - 1.0).abs() < 1e-3 {
            continue;
        }
        if energy <= 0.0 || b > 27f64.sqrt() {
            assert_eq!(path.fate, Fate::Captured, "{place:?}, {n:?}, b = {b}, E = {energy}");
            captured += 1;
            continue;
        }
        assert_eq!(path.fate, Fate::Escaped, "{place:?}, {n:?}, b = {b}");
        // The source lies at this angle from the camera's place, on the side that is looked at.
        let orbit = Orbit::new(b);
        let psi = orbit.angle(1.0 / place.r) - orbit.angle(0.0);
        let up = observer.position().map(|c| c / place.r);
        let j = ray.start.j;
        let length = dot(&j, &j).sqrt();
        let ahead = cross(&j, &up).map(|c| c / length);
        let source: [f64; 3] = std::array::from_fn(|i| psi.cos() * up[i] + psi.sin() * ahead[i]);
        let share = (1.0 - b / 27f64.sqrt()).min(1.0);
        angles.see(distance(unit(path.direction.unwrap()), source) * share, || {
            format!("{place:?}, {n:?}, b = {b}")
        });
        // The same by the metric without spin.
        let same = follow(&Integrator::new(Schwarzschild, DOP853, 10_000), &ray, &Query::default());
        // It does not know the way out: its rays end inside.
        assert_eq!(same.fate, Fate::Captured);
    }
    assert!(captured > 100 && angles.count > 200);
    worst.below(3e-14, "energies");
    angles.below(2e-12, "directions");
}

/// Any spin: the separated equations, regular across the horizon, give the crossings of the
/// equator on the way out and the direction.
#[test]
fn separated_equations_from_inside() {
    let mut random = Random::new(92);
    let mut worst = Worst::default();
    let (mut escaped, mut captured) = (0, 0);
    for _ in 0..1500 {
        let spin = random.pick(&[0.3, -0.5, 0.9, -0.9, 0.99]);
        let (outer, inner) = horizons(spin);
        let r = inner + (outer - inner) * random.within(0.1, 0.999);
        let place = Place { r, theta: random.within(0.1, 3.0), phi: random.within(-3.0, 3.0) };
        let speed = random.within(0.0, 0.7);
        let motion = if random.within(0.0, 1.0) < 0.5 {
            Motion::Fall
        } else {
            Motion::VelocityFromFall(random.direction().map(|c| speed * c))
        };
        let n = random.direction();
        let ray = Observer::new(Some(spin), place, motion).unwrap().ray(n);
        let path = trace(spin, &ray);
        assert_ne!(path.fate, Fate::StepLimit);
        let conserved = ray.conserved(spin);
        let from_our_sky = ray.energy < 0.0 && 2.0 * outer * -ray.energy > spin * -ray.start.j[2];
        if !from_our_sky {
            // Out of the past horizon or from beyond the inner one.
            assert_eq!((path.fate, path.crossings.len()), (Fate::Captured, 0));
            continue;
        }
        let photon =
            Photon { spin, lambda: conserved.lambda, eta: conserved.eta, timed: false, falling: true };
        // The sign of the polar momentum: e_θ is along ∂θ but for the boost.
        let x = ray.start.n.map(|c| c / ray.start.w);
        let p = ray.start.momentum();
        let (sin, cos) = place.theta.sin_cos();
        let p_theta = (x[0] * p[0] + x[1] * p[1]) * cos / sin - r * sin * p[2];
        if photon.lambda.abs() < 0.05 || p_theta.abs() < 1e-3 {
            continue;
        }
        let trip = travel(photon, 1.0 / r, cos, false, -p_theta);
        let label = || format!("{photon:?}, {place:?}, {motion:?}, {n:?}");
        assert_eq!(path.fate == Fate::Escaped, trip.direction.is_some(), "{}", label());
        let share = 1.0 / Kerr::new(spin).sensitivity(ray.energy, &ray.start);
        let aside = photon.lambda.abs() / photon.lambda.hypot(photon.eta.max(0.0).sqrt());
        if let (Some(ours), Some([theta, phi])) = (path.direction, trip.direction) {
            escaped += 1;
            // The camera's φ is that of ingoing coordinates.
            let azimuth = place.phi + phi;
            worst.see((ours[0] - theta).abs() * share * theta.sin().max(1e-3), || format!("θ, {}", label()));
            worst.see((ours[1] - azimuth).abs() * share * aside * theta.sin(), || format!("φ, {}", label()));
            assert_eq!(path.crossings.len(), trip.crossings.len(), "{}", label());
        } else {
            captured += 1;
        }
        for (our, their) in path.crossings.iter().zip(&trip.crossings) {
            let near = share / (1.0 + our.r / 10.0);
            worst.see((our.r / their[0] - 1.0).abs() * near, || format!("r, {}", label()));
            if our.r > outer + 0.01 {
                // Ingoing coordinates less the twist.
                let kerr = Kerr::new(spin);
                let twist = kerr.azimuth_offset(our.r) - spin.atan2(our.r);
                let phi = place.phi + their[1] - twist;
                worst.see((our.phi - phi).abs() * near * aside, || format!("azimuth, {}", label()));
            }
        }
    }
    assert!(escaped > 300 && captured > 100, "{escaped} {captured}");
    worst.below(1e-10, "from inside");
}

/// The change of sheet undoes itself and keeps what is conserved.
#[test]
fn change_of_sheet() {
    let mut random = Random::new(93);
    let (mut back, mut kept) = (Worst::default(), Worst::default());
    for _ in 0..3000 {
        let spin = random.pick(&[0.0, 0.3, -0.5, 0.9, -0.99, 1.0, -1.0]);
        let kerr = Kerr::new(spin);
        let (there, again) = (kerr.reversed(), kerr);
        let r = kerr.horizon() * random.scale(1.1, 100.0);
        let n = random.direction();
        let width = r.hypot(spin);
        let x = [width * n[0], width * n[1], r * n[2]];
        let p = random.direction().map(|c| 2.0 * c);
        let energy = random.within(-2.0, 2.0);
        let ray = Ray::from_cartesian(&x, &p, energy, Side::Ingoing, 0.0);
        let state = ray.start;
        let other = kerr.change_sheet(energy, &state);
        let label = || format!("a = {spin}, r = {r}, E = {energy}, {p:?}");
        let apart = |a: &Inverted<f64>, b: &Inverted<f64>| {
            ((a.w - b.w).abs() / b.w)
                .max(distance(a.n, b.n))
                .max((a.q - b.q).abs())
                .max(distance(a.j, b.j) * b.w)
        };
        let delta = (r - 1.0).powi(2) - (1.0 - spin) * (1.0 + spin);
        let kick = 1.0 + 4.0 * r / delta;
        back.see(apart(&there.reversed().reversed().change_sheet(-energy, &other), &state) / kick, label);
        assert_eq!(there.reversed(), again);
        kept.see((there.norm(-energy, &other) - kerr.norm(energy, &state)).abs() / (kick * kick), label);
        let (before, after) = (kerr.carter(energy, &state).unwrap(), there.carter(-energy, &other).unwrap());
        kept.see((after - before).abs() / (r * r * kick), label);
        kept.see((other.j[2] - state.j[2]).abs() / r, label);
        kept.see((other.w - state.w).abs() + (other.n[2] - state.n[2]).abs(), label);
        kept.see((dot(&other.n, &other.n) - 1.0).abs() + dot(&other.n, &other.j).abs() / r / kick, label);
    }
    back.below(6e-14, "there and back");
    kept.below(2e-13, "conserved");
}

/// The sky of a falling camera does not notice the horizon: just inside and just outside, every
/// direction shows the same, and the difference is proportional to the distance between.
#[test]
fn through_the_horizon() {
    for spin in [0.0, 0.5, -0.5, 0.99] {
        let kerr = Kerr::new(spin);
        let outer = kerr.horizon();
        for motion in [Motion::Fall, Motion::VelocityFromFall([0.2, -0.3, 0.4])] {
            for theta in [0.0, 0.9, FRAC_PI_2] {
                let at = |offset: f64, n: [f64; 3]| {
                    let r = outer * (1.0 + offset);
                    // The same place in ingoing coordinates, where φ̃ = 0.2.
                    let twist = if offset > 0.0 { kerr.azimuth_offset(r) - spin.atan2(r) } else { 0.0 };
                    let place = Place { r, theta, phi: 0.2 - twist };
                    let ray = Observer::new(Some(spin), place, motion).unwrap().ray(n);
                    assert_eq!(ray.side, if r < EXIT * outer { Side::Ingoing } else { Side::Reversed });
                    (ray.conserved(spin), trace(spin, &ray))
                };
                let mut compared = 0;
                for k in 0..40 {
                    let z = 1.0 - (f64::from(k) + 0.5) / 20.0;
                    let (sin, cos) = (2.4 * f64::from(k)).sin_cos();
                    let ring = (1.0 - z * z).sqrt();
                    let n = [z, ring * cos, ring * sin];
                    // Closer outside, the tetrad loses digits as the square of the offset.
                    let gaps = [1e-2, 4e-3, 1.6e-3].map(|offset| {
                        let ((before, outside), (after, inside)) = (at(offset, n), at(-offset, n));
                        let smooth = (before.lambda - after.lambda).abs() + (before.eta - after.eta).abs();
                        let (Some(a), Some(b)) = (outside.direction, inside.direction) else {
                            return (outside.fate == inside.fate, f64::NAN, smooth / offset);
                        };
                        (true, separation(a, b) / offset, smooth / offset)
                    });
                    let label = format!("a = {spin}, {motion:?}, θ = {theta}, {n:?}: {gaps:?}");
                    // Next to the critical curve a small step changes much.
                    if gaps[0].1.is_nan() || gaps[0].1 > 100.0 {
                        continue;
                    }
                    compared += 1;
                    assert!(gaps.iter().all(|(same, ..)| *same), "{label}");
                    assert!((gaps[2].1 - gaps[1].1).abs() < 0.02 * (1.0 + gaps[1].1), "{label}");
                    assert!((gaps[2].2 - gaps[1].2).abs() < 0.02 * (1.0 + gaps[1].2), "{label}");
                }
                assert!(compared > 15, "{compared}");
            }
        }
    }
}

/// What escapes backwards from inside is what falls in from infinity.
#[test]
fn rays_of_captured_photons() {
    let mut random = Random::new(94);
    let mut count = 0;
    for _ in 0..300 {
        let spin = random.pick(&[0.3, -0.6, 0.95]);
        let (outer, inner) = horizons(spin);
        let place =
            Place { r: random.within(inner + 0.1, outer - 0.02), theta: random.within(0.2, 2.9), phi: 0.0 };
        let ray = Observer::new(Some(spin), place, Motion::Fall).unwrap().ray(random.direction());
        let path = trace(spin, &ray);
        let Some([theta, _]) = path.direction else { continue };
        // Sent in from there, reversed once more, with the same λ and η: it falls in.
        let conserved = ray.conserved(spin);
        let (sin, cos) = theta.sin_cos();
        let alpha = -conserved.lambda / sin;
        let square = conserved.eta - (alpha * alpha - spin * spin) * cos * cos;
        let share = 1.0 / Kerr::new(spin).sensitivity(ray.energy, &ray.start);
        if sin < 0.05 || square < 1e-3 || share < 1e-2 {
            continue;
        }
        for sign in [1.0, -1.0] {
            let back = trace(-spin, &impact(-spin, theta, f64::INFINITY, -alpha, sign * square.sqrt()));
            assert_eq!(back.fate, Fate::Captured);
        }
        count += 1;
    }
    assert!(count > 50, "{count}");
}

/// Just outside the horizon a falling camera's rays start in ingoing coordinates, a moving one's
/// in the reversed spacetime; one that moves inwards at √(1 − lapse²) against zero angular
/// momentum is the falling one. They see the same, photons that turn back among it.
#[test]
fn falling_is_moving_inwards() {
    let mut random = Random::new(95);
    let (mut worst, mut turned) = (Worst::default(), 0);
    for _ in 0..3000 {
        let spin = random.pick(&[0.0, 0.5, -0.9, 0.99, 0.998, -0.998]);
        let outer = horizons(spin).0;
        let place = Place { r: outer * random.within(1.02, 1.2), theta: random.within(0.3, 2.8), phi: 0.4 };
        let (sin, cos) = place.theta.sin_cos();
        let (r, square) = (place.r, spin * spin);
        let (sigma, delta) = (r * r + square * cos * cos, (r - 1.0).powi(2) - (1.0 - spin) * (1.0 + spin));
        let area = (r * r + square).powi(2) - square * delta * sin * sin;
        let speed = (1.0 - sigma * delta / area).sqrt();
        // Half of them around the direction of light that turns with the hole.
        let n = if random.within(0.0, 1.0) < 0.5 {
            random.direction()
        } else {
            let out = random.scale(1e-3, 0.5) - 1.0;
            let down = random.within(-0.02, 0.02);
            [out, down, (1.0 - out * out - down * down).sqrt().copysign(-spin)]
        };
        let falling = Observer::new(Some(spin), place, Motion::Fall).unwrap().ray(n);
        let moving = Observer::new(Some(spin), place, Motion::Velocity([-speed, 0.0, 0.0])).unwrap().ray(n);
        let (a, b) = (trace(spin, &falling), trace(spin, &moving));
        let boost = 1.0 + 2.0 * r / delta;
        let share = 1.0 / Kerr::new(-spin).sensitivity(moving.energy, &moving.start);
        let label = || format!("a = {spin}, {place:?}, {n:?}: {:?}", moving.conserved(spin));
        if share < 1e-3 {
            continue;
        }
        // A photon that comes out towards the camera from a turning point further in.
        turned += i32::from(b.fate == Fate::Escaped && turns(&moving, spin));
        assert_eq!(a.fate, b.fate, "{}", label());
        if let (Some(p), Some(q)) = (a.direction, b.direction) {
            // Rounding of the boosted frames, and of a photon that is weak at infinity.
            let weak = moving.energy.abs().min(1.0).powi(2);
            worst.see(separation(p, q) * share * weak / boost.powi(2), label);
        }
    }
    assert!(turned > 30, "{turned}");
    worst.below(1e-11, "falling and moving");
}

/// Whether the ray goes inwards from the camera.
fn turns(ray: &Ray, spin: f64) -> bool {
    let x = ray.start.n.map(|c| c / ray.start.w);
    let metric = Kerr::new(-spin);
    let velocity = metric.rate(ray.energy, &x, &ray.start.momentum()).velocity;
    let step = 1e-6;
    metric.radius(&std::array::from_fn(|i| x[i] + step * velocity[i])) < metric.radius(&x)
}
