//! The closed form in every region of a ray's parameters that it treats in a way of its own, against the
//! integrator.

use crate::common;

use common::engines::{TIMED, closed, difference, disagreement, integrated, seen};
use common::{Random, Worst, folded, impact};
use kerrscope_spacetime::geodesic::{Fate, Query, Ray};
use kerrscope_spacetime::kerr::{CriticalCurve, Orbits, horizons};
use kerrscope_spacetime::observer::impact_ray;
use std::f64::consts::{FRAC_PI_2, PI};

/// Carter's η of the ray.
fn eta(spin: f64, ray: &Ray) -> f64 {
    ray.conserved(spin).eta
}

/// η < 0, light that stays on one side of the plane: outwards from near the axis of a spinning hole, where it
/// escapes; some of it over the pole itself, or past it as closely as one likes.
#[test]
fn vortical_rays() {
    let (mut worst, mut escaped) = (Worst::default(), 0);
    let mut random = Random::new(91);
    for k in 0..400 {
        let spin = random.pick(&[0.3, -0.7, 0.95, 1.0, -1.0]);
        let r = random.within(1.1, 4.0) * horizons(spin).0;
        let theta = random.pick(&[0.02, 0.2, 0.5, 0.9, PI - 0.4]);
        let tilt = random.scale(1e-3, 0.5);
        let (sin, cos) = random.within(-PI, PI).sin_cos();
        let across = match k % 4 {
            // Next to no angular momentum, of either sign, and none.
            0 => 0.0,
            1 => random.scale(1e-12, 1e-2),
            2 => -random.scale(1e-12, 1e-2),
            _ => tilt * sin,
        };
        let ray = seen(spin, r, theta, [1.0, tilt * cos, across]);
        if eta(spin, &ray) > -1e-6 {
            continue;
        }
        let label = || format!("a = {spin}, r = {r}, θ = {theta}, {ray:?}");
        let path = closed(spin, &ray, &TIMED);
        assert!(path.crossings.is_empty());
        escaped += u32::from(path.fate == Fate::Escaped);
        worst.see(disagreement(spin, &ray), label);
        // The azimuth too, and not only where it points: 1 − μ² is small where φ turns fast.
        if let (Some([theta, phi]), Some([_, other])) = (path.direction, integrated(spin, &ray).direction) {
            worst.see(folded(phi - other).abs() * theta.sin(), label);
        }
    }
    assert!(escaped > 100, "{escaped}");
    worst.below(5e-11, "vortical rays");
    // A camera on the axis itself.
    let mut axis = Worst::default();
    for spin in [0.5, -0.95, 1.0] {
        for theta in [0.0, PI] {
            for tilt in [0.0, 1e-9, 0.01, 0.05] {
                for azimuth in [0.2, 2.0, 3.9, 5.5_f64] {
                    let ray = seen(spin, 2.5, theta, [1.0, tilt * azimuth.cos(), tilt * azimuth.sin()]);
                    assert!(eta(spin, &ray) < 0.0);
                    // λ and η say little of light straight along the axis: η + a² is the square of its tilt.
                    let allowed = 1e-12 + f64::min(1e-15 / tilt, 3e-8);
                    axis.see(disagreement(spin, &ray) / allowed, || {
                        format!("{spin} {theta} {tilt} {azimuth}")
                    });
                }
            }
        }
    }
    axis.below(1.0, "vortical rays on the axis");
}

/// Light that sets out outwards: with and without a turning point behind it or ahead.
#[test]
fn rays_that_set_out_outwards() {
    let (mut worst, mut turned, mut left) = (Worst::default(), 0, 0);
    let mut random = Random::new(92);
    for _ in 0..400 {
        let spin = random.within(-1.0, 1.0);
        let r = random.scale(1.05, 10.0) * horizons(spin).0;
        let theta = random.within(0.1, 3.0);
        let up = random.within(0.0, 1.0);
        let (sin, cos) = random.within(-PI, PI).sin_cos();
        let flat = (1.0 - up * up).sqrt();
        let ray = seen(spin, r, theta, [up, flat * cos, flat * sin]);
        if !(ray.energy > 0.0) || closed(spin, &ray, &TIMED).error_estimate > 1e-9 {
            continue;
        }
        match closed(spin, &ray, &TIMED).fate {
            Fate::Captured => turned += 1,
            _ => left += 1,
        }
        worst.see(disagreement(spin, &ray), || format!("a = {spin}, r = {r}, θ = {theta}, {ray:?}"));
    }
    assert!(turned > 30 && left > 150, "{turned} fall back, {left} leave");
    worst.below(1e-11, "outwards");
}

/// Cameras between the horizon and the photon shell, from 1.0005 r₊, that look anywhere; light of no positive
/// energy at infinity, within the ergosphere, is handed on to the integrator and falls in.
#[test]
fn between_the_horizon_and_the_photon_shell() {
    let (mut worst, mut handed_on, mut compared) = (Worst::default(), 0, 0);
    let mut random = Random::new(93);
    for _ in 0..600 {
        let spin = random.pick(&[0.0, 0.5, -0.9, 0.998, 1.0, -1.0]);
        let horizon = horizons(spin).0;
        let shell = Orbits::new(spin.abs()).photon_prograde.max(1.2 * horizon);
        let r = random.within(if spin.abs() == 1.0 { 1.05 } else { 1.0005 } * horizon, shell);
        let ray = seen(spin, r, random.within(0.05, 3.1), random.direction());
        let path = closed(spin, &ray, &TIMED);
        if !(ray.energy > 0.0) {
            handed_on += 1;
            assert_eq!(path.fate, Fate::Captured, "{ray:?}");
            assert!(path.steps > 0, "by the integrator");
            continue;
        }
        // Next to a degenerate horizon azimuths turn without end.
        let wild = spin.abs() == 1.0 && path.crossings.iter().any(|c| c.r < 1.1);
        if path.error_estimate > 1e-9 || wild {
            continue;
        }
        compared += 1;
        worst.see(disagreement(spin, &ray), || format!("a = {spin}, r = {r}, {ray:?}"));
    }
    assert!(handed_on > 10 && compared > 400, "{handed_on} handed on, {compared} compared");
    worst.below(1e-10, "within the shell");
}

/// From infinity everything is the limit of what is seen from far away: from r the difference falls as 1/r, and
/// the time is less r + 2 ln(r/2).
#[test]
fn from_infinity() {
    let mut worst = Worst::default();
    let mut random = Random::new(94);
    for _ in 0..50 {
        let (spin, inclination) = (random.within(-1.0, 1.0), random.within(0.1, 3.0));
        let (alpha, beta) = (random.within(-15.0, 15.0), random.within(-15.0, 15.0));
        let from = |r| closed(spin, &impact(spin, inclination, r, alpha, beta), &TIMED);
        let limit = from(f64::INFINITY);
        if limit.error_estimate > 2e-11 || limit.crossings.iter().any(|c| c.r > 500.0) {
            continue;
        }
        for r in [1e8, 1e10, 1e12, 1e15] {
            let mut far = from(r);
            for crossing in &mut far.crossings {
                crossing.elapsed -= r + 2.0 * (r / 2.0).ln();
            }
            let b = alpha.hypot(beta);
            // The sum r + t cannot hold more digits than r.
            let allowed = 3.0 * (1.0 + b * b) / r + 1e-15 * r;
            let error = difference(&far, &limit);
            worst.see(error / (1e-12 + allowed), || format!("{spin} {inclination} {alpha} {beta} from {r}"));
        }
    }
    worst.below(50.0, "from far away");
}

/// Plunging light of small b, whose motion in θ is far from circular: nomes up to 1, B > 0, where m = (D − B)/2
/// would cancel.
#[test]
fn large_nomes() {
    let mut worst = Worst::default();
    let mut random = Random::new(95);
    for _ in 0..1000 {
        let spin = random.pick(&[1e-3, 0.3, -0.9, 0.998, 1.0]);
        let inclination = random.within(0.1, 3.0);
        let b = random.scale(1e-8, 2.5);
        let (sin, cos) = random.within(-PI, PI).sin_cos();
        let ray = impact(spin, inclination, random.pick(&[10.0, f64::INFINITY]), b * cos, b * sin);
        if eta(spin, &ray) <= 0.0 {
            continue;
        }
        // Next to an extreme horizon azimuths turn without end.
        if spin == 1.0 && closed(spin, &ray, &TIMED).crossings.iter().any(|c| c.r < 1.1) {
            continue;
        }
        worst.see(disagreement(spin, &ray), || format!("a = {spin}, i = {inclination}, {ray:?}"));
    }
    // Next to the axis of the plane's far side, η ≈ 0 < η: barely not vortical.
    for (spin, tiny) in [(0.9_f64, 1e-3), (-0.5, 1e-6), (1.0, 1e-9)] {
        let inclination = 1.0_f64;
        let alpha = 0.1;
        let beta = f64::sqrt((spin * spin - alpha * alpha) * inclination.cos().powi(2) + tiny);
        for beta in [beta, -beta] {
            let ray = impact(spin, inclination, 30.0, alpha, beta);
            worst.see(disagreement(spin, &ray), || format!("a = {spin}, η = {tiny}"));
        }
    }
    worst.below(1e-10, "large nomes");
}

/// A crossing right at the turning point in r, where arcosh has lost half of the digits: β is varied until r of the
/// crossing is least.
#[test]
fn crossings_at_the_turning_point() {
    let mut worst = Worst::default();
    for spin in [0.0, 0.9, -1.0] {
        for alpha in [3.0, 9.0, -11.0] {
            let ray = |beta: f64| impact(spin, 1.2, f64::INFINITY, alpha, beta);
            // The first crossing of rays seen below the hole comes before, of those above after the turn.
            let turning = |beta: f64| {
                let conserved = ray(beta).conserved(spin);
                let (lambda, s) = (-conserved.lambda, -spin);
                let c = (lambda - s).powi(2) + conserved.eta;
                let b = s * s - lambda * lambda - conserved.eta;
                let mut u = 1.0 / f64::sqrt(-b);
                for _ in 0..60 {
                    let (u2, q) = (u * u, s * s * conserved.eta);
                    let value = 1.0 + u2 * (b + u * (2.0 * c - q * u));
                    u -= value / (u * (2.0 * b + u * (6.0 * c - 4.0 * q * u)));
                }
                1.0 / u
            };
            let above = |beta: f64| {
                let path = closed(spin, &ray(beta), &TIMED);
                let first = path.crossings.first().filter(|_| path.fate == Fate::Escaped);
                first.map_or(f64::INFINITY, |crossing| crossing.r / turning(beta))
            };
            // r/r_turn is least (1) somewhere between: golden section.
            let (mut low, mut high) = (-14.0, 14.0);
            for _ in 0..80 {
                let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
                if above(a) < above(b) { high = b } else { low = a }
            }
            let least = 0.5 * (low + high);
            if !(above(least) < 1.0 + 1e-9) {
                continue;
            }
            for offset in [0.0, 1e-12, -1e-9, 1e-7, -1e-5, 1e-4, -1e-3, 1e-2] {
                worst.see(disagreement(spin, &ray(least + offset)), || {
                    format!("{spin} {alpha} {least} {offset}")
                });
            }
        }
    }
    assert!(worst.count >= 40, "{}", worst.count);
    worst.below(1e-11, "at the turning point");
}

/// Just outside and inside the critical curve, all around, at finite and infinite distance: both engines say the
/// same as far as its nearness allows, and so does the fate.
#[test]
fn beside_the_critical_curve() {
    let mut worst = Worst::default();
    for spin in [0.0, 0.6, -0.95, 1.0] {
        for inclination in [0.0, 0.9, FRAC_PI_2] {
            let curve = CriticalCurve::new(spin, inclination);
            let middle = 0.5 * (curve.extent().alpha_min + curve.extent().alpha_max);
            for [alpha, beta] in curve.points(12) {
                for (offset, fate) in [
                    (1e-3, Fate::Escaped),
                    (-1e-3, Fate::Captured),
                    (1e-6, Fate::Escaped),
                    (-1e-6, Fate::Captured),
                ] {
                    let moved = [middle + (alpha - middle) * (1.0 + offset), beta * (1.0 + offset)];
                    let ray = impact_ray(Some(spin), inclination, f64::INFINITY, moved).unwrap();
                    let path = closed(spin, &ray, &Query::default());
                    assert_eq!(path.fate, fate, "{spin} {inclination} {moved:?}");
                    let near = path.crossings.iter().any(|c| c.r < 1.3 * horizons(spin).0);
                    if spin == 1.0 && near {
                        continue;
                    }
                    worst.see(disagreement(spin, &ray), || format!("{spin} {inclination} {moved:?}"));
                }
            }
        }
    }
    worst.below(1e-11, "beside the critical curve");
}
