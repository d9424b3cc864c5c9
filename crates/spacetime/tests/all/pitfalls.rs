//! The closed form where its formulas are 0/0, lose digits or change: special values of its parameters.
//! The integrator, exact limits and neighbouring rays judge.

use crate::common;

use common::engines::{TIMED, closed, difference, disagreement, outward, seen};
use common::orbit::Orbit;
use common::{Random, Worst, folded, impact};
use kerrscope_spacetime::closed::{ClosedForm, NODES};
use kerrscope_spacetime::geodesic::{Fate, Path, Query, Ray, Tracer};
use kerrscope_spacetime::kerr::{CriticalCurve, Orbits};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const INFINITY: f64 = f64::INFINITY;

/// λ = η = 0 without spin: straight in, nothing met.
#[test]
fn straight_in_without_spin() {
    for r in [3.0, 100.0, INFINITY] {
        for inclination in [0.0, 1.0, FRAC_PI_2, PI] {
            let query = Query { windings: true, ..TIMED };
            let path = closed(0.0, &impact(0.0, inclination, r, 0.0, 0.0), &query);
            assert_eq!((path.fate, path.crossings.len(), path.windings), (Fate::Captured, 0, 0.0));
        }
    }
    // Straight out, too: the direction is that of the camera.
    let path = closed(0.0, &seen(0.0, 2.5, 1.0, [1.0, 0.0, 0.0]), &TIMED);
    let [theta, phi] = path.direction.unwrap();
    assert!((theta - 1.0).abs() < 4e-15 && (phi - 0.3).abs() < 4e-15, "{theta} {phi}");
}

/// η = 0: a ray in the plane stays there and meets it nowhere; its azimuth is the integrator's.
#[test]
fn rays_in_the_plane() {
    let mut worst = Worst::default();
    for spin in [0.0, 0.5, -0.9, 1.0] {
        for alpha in [-30.0, -9.0, 9.0, 7.5, 1.0, 0.3] {
            for r in [50.0, INFINITY] {
                let ray = impact(spin, FRAC_PI_2, r, alpha, 0.0);
                let path = closed(spin, &ray, &TIMED);
                assert!(path.crossings.is_empty());
                if let Some([theta, _]) = path.direction {
                    assert!((theta - FRAC_PI_2).abs() < 1e-15, "{theta}");
                }
                worst.see(disagreement(spin, &ray), || format!("{spin} {alpha} {r}"));
            }
        }
    }
    worst.below(1e-12, "in the plane");
}

/// η = 0 off the plane: light that nears the plane for ever, or leaves it.
#[test]
fn rays_asymptotic_to_the_plane() {
    let mut worst = Worst::default();
    for spin in [0.5, -0.9, 1.0] {
        for r in [2.2, 3.0, 6.0] {
            for theta in [0.4_f64, 1.2, 2.0] {
                // β = 0 and |α| = |s|: light that turns in θ at the camera.
                let ray = outward(spin, r, theta, [-f64::abs(spin), 0.0]);
                worst.see(disagreement(spin, &ray), || format!("{spin} {r} {theta} {ray:?}"));
            }
        }
    }
    worst.below(1e-11, "asymptotic to the plane");
}

/// Azimuths next to ±π, where a half-angle arctangent fails: what is met at x < 0, y → 0.
#[test]
fn azimuths_of_half_a_turn() {
    for spin in [0.0, 0.7] {
        for r in [20.0, INFINITY] {
            for offset in [0.0, 1e-18, -1e-18, 1e-12, -1e-12, 1e-6, -1e-6] {
                // On the axis with β > 0 the ray leaves towards azimuth π.
                let path = closed(spin, &impact(spin, 0.0, r, offset, 9.0), &TIMED);
                let turn = closed(spin, &impact(spin, 0.0, r, 9.0, 0.0), &TIMED);
                let (met, reference) = (&path.crossings[0], &turn.crossings[0]);
                let expected = reference.phi + FRAC_PI_2 - offset / 9.0;
                assert!(folded(met.phi - expected).abs() < 1e-14, "{spin} {r} {offset}");
                assert!((met.r / reference.r - 1.0).abs() < 1e-13);
                let [x, y, _] = met.position;
                let [p, q, _] = reference.position;
                // A quarter of a turn: (p, q) → (−q, p).
                assert!(
                    (x + q).abs() + (y - p).abs() < 1e-12 * met.r + 2.0 * offset.abs(),
                    "{spin} {r} {offset}"
                );
            }
        }
    }
}

/// A camera in the plane has met it already: that is no crossing, whichever way it looks.
#[test]
fn cameras_in_the_plane() {
    let mut worst = Worst::default();
    for spin in [0.0, 0.6, -1.0] {
        for r in [4.0, 40.0, INFINITY] {
            for (alpha, beta) in
                [(0.0, 8.0), (0.0, -8.0), (7.0, 1e-5), (-7.0, -1e-5), (1.0, 2.0), (9.0, -4.0)]
            {
                let Ok(ray) =
                    kerrscope_spacetime::observer::impact_ray(Some(spin), FRAC_PI_2, r, [alpha, beta])
                else {
                    continue;
                };
                worst.see(disagreement(spin, &ray), || format!("{spin} {r} {alpha} {beta}"));
            }
        }
    }
    worst.below(3e-12, "cameras in the plane");
}

/// Inclination 0 and 180°, and next to them: the same as on the axis, but for the offset.
#[test]
fn on_the_axis_and_next_to_it() {
    let (mut on, mut beside) = (Worst::default(), Worst::default());
    for spin in [0.0, 0.9, -1.0] {
        for (pole, sense) in [(0.0, 1.0), (PI, -1.0)] {
            for r in [4.0, 50.0, INFINITY] {
                for (alpha, beta) in
                    [(3.0, 1.0), (-3.0, 1.0), (-6.0, -6.0), (0.0, 4.0), (0.0, -9.0), (9.0, 0.0)]
                {
                    let ray = |offset: f64| {
                        kerrscope_spacetime::observer::impact_ray(
                            Some(spin),
                            pole + sense * offset,
                            r,
                            [alpha, beta],
                        )
                    };
                    let Ok(centre) = ray(0.0) else { continue };
                    let label = || format!("{spin} {pole} {r} {alpha} {beta}");
                    on.see(disagreement(spin, &centre), label);
                    let centre = closed(spin, &centre, &TIMED);
                    for offset in [1e-15, 1e-12, 1e-9, 1e-6] {
                        let found = closed(spin, &ray(offset).unwrap(), &TIMED);
                        let error = difference(&found, &centre) / (1.0 + 1e12 * offset);
                        beside.see(error, || format!("{} + {offset}", label()));
                    }
                }
            }
        }
    }
    on.below(1e-11, "on the axis");
    beside.below(1e-10, "next to it");
}

/// Light that passes over a pole, closely or through it: λ → 0 of either sign.
#[test]
fn over_the_poles() {
    let mut worst = Worst::default();
    for spin in [0.0, 0.8, -1.0] {
        for inclination in [0.3, 1.4, 2.9] {
            for beta in [-14.0, -7.0, -2.0, -0.2, 0.2, 3.0, 7.0, 14.0] {
                for alpha in [0.0, 1e-300, -1e-17, 1e-10, -1e-10, 1e-5, -1e-3] {
                    let ray = impact(spin, inclination, INFINITY, alpha, beta);
                    worst.see(disagreement(spin, &ray), || format!("{spin} {inclination} {alpha} {beta}"));
                }
            }
        }
    }
    worst.below(1e-11, "over the poles");
}

/// Spin → 0: Q → 0 degenerates the quartic and the motion in θ; nothing jumps.
#[test]
fn no_spin_and_next_to_none() {
    let mut worst = Worst::default();
    let mut random = Random::new(81);
    for _ in 0..60 {
        let (inclination, alpha) = (random.within(0.1, 3.0), random.within(-10.0, 10.0));
        let beta = random.within(-10.0, 10.0);
        let at = |spin| closed(spin, &impact(spin, inclination, INFINITY, alpha, beta), &TIMED);
        let still = at(0.0);
        if still.error_estimate > 1e-11 {
            continue;
        }
        for spin in [1e-4, -1e-6, 1e-8, -1e-12, 1e-16, 1e-100, 1e-300] {
            let error = difference(&at(spin), &still) / (1.0 + 1e12 * f64::abs(spin));
            worst.see(error, || format!("{spin} {inclination} {alpha} {beta}"));
        }
    }
    worst.below(1e-10, "next to no spin");
    // And none at all is Darwin's orbit.
    let mut exact = Worst::default();
    for b in [5.3, 6.0, 9.0, 30.0] {
        let path = closed(0.0, &impact(0.0, FRAC_PI_2, INFINITY, 0.0, b), &TIMED);
        let orbit = Orbit::new(b);
        // φ turns by π over each pole; the colatitude swept is what remains.
        let swept = 2.0 * orbit.angle(orbit.turn(0.0, true).unwrap()) - 2.0 * orbit.angle(0.0);
        let [theta, phi] = path.direction.unwrap();
        let place = theta.sin() * phi.cos();
        exact.see((place - swept.cos()).abs(), || format!("b = {b}"));
    }
    exact.below(1e-13, "Darwin's orbits");
}

/// |a| = 1, where r₊ = r₋ and the logarithms of the azimuth and the time become poles.
#[test]
fn extreme_spin() {
    let (mut worst, mut limit) = (Worst::default(), Worst::default());
    let mut random = Random::new(82);
    for k in 0..80 {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let r = if k % 4 < 2 { INFINITY } else { random.within(2.1, 30.0) };
        let (inclination, reach) = (random.within(0.1, 3.0), if r < 5.0 { 3.0 } else { 9.0 });
        let (alpha, beta) = (random.within(-reach, reach), random.within(-reach, reach));
        let ray = |spin| kerrscope_spacetime::observer::impact_ray(Some(spin), inclination, r, [alpha, beta]);
        let Ok(extreme) = ray(sign) else { continue };
        let path = closed(sign, &extreme, &TIMED);
        // What is met next to a degenerate horizon turns with it without end.
        if path.error_estimate > 3e-11 || path.crossings.iter().any(|c| c.r < 1.2) {
            continue;
        }
        let label = || format!("{sign} {inclination} {r} {alpha} {beta}");
        worst.see(disagreement(sign, &extreme), label);
        for gap in [1e-4, 1e-8, 1e-12, 1e-15] {
            let spin = sign * (1.0 - gap);
            let error = difference(&closed(spin, &ray(spin).unwrap(), &TIMED), &path) / (1.0 + 1e13 * gap);
            limit.see(error, || format!("{} − {gap}", label()));
        }
    }
    worst.below(1e-11, "extreme spin");
    limit.below(1e-11, "towards extreme spin");
}

/// The test vector at infinity, from an independent code: λ = 4 of the reversed photon, η = 30, a = 0.9, i = 1 rad,
/// β < 0.
#[test]
fn test_vector_at_infinity() {
    let (spin, i) = (0.9_f64, 1f64);
    let alpha = 4.0 / i.sin();
    let beta = -(30.0 - (alpha * alpha - spin * spin) * i.cos().powi(2)).sqrt();
    let met = closed(spin, &impact(spin, i, INFINITY, alpha, beta), &TIMED).crossings[0];
    assert!((met.r - 9.966537978).abs() < 1e-9 && (met.phi - 0.474082717).abs() < 1e-9, "{met:?}");
}

/// Closer and closer to the critical curve of a = 0, b = √27(1 + δ): Darwin 1959, the angle swept is
/// ln(216(7 − 4√3)/δ); errors grow as 1/δ and not faster.
#[test]
fn angle_next_to_the_critical_curve() {
    for k in 1..=12 {
        let offset = 10f64.powi(-k);
        let ray = impact(0.0, FRAC_PI_2, INFINITY, 0.0, 27f64.sqrt() * (1.0 + offset));
        let path = closed(0.0, &ray, &Query { windings: true, ..TIMED });
        assert_eq!(path.fate, Fate::Escaped, "offset 1e-{k}");
        let swept = (216.0 * (7.0 - 48f64.sqrt()) / offset).ln();
        let error = (path.windings * TAU - swept).abs();
        assert!(error < 4.0 * offset * f64::from(k) + 1e-15 / offset, "{k}: {error:e}");
    }
}

/// Per decade nearer to the critical curve φ grows by 2.30 rad at a = 0, 5.95 and 1.81 at a = 0.9: for light in the
/// plane by ln 10 φ′/√(U″/2) of the circular orbit, whose u doubles as a zero of U.
#[test]
fn azimuth_per_decade() {
    for (spin, prograde, growth) in [(0.0, true, 2.30), (0.9, true, 5.95), (0.9, false, 1.81)] {
        let orbits = Orbits::new(spin);
        let (r, b) = if prograde {
            (orbits.photon_prograde, orbits.impact_prograde)
        } else {
            (orbits.photon_retrograde, orbits.impact_retrograde)
        };
        // α < 0 sees light that goes round with the hole; reversed, λ = α and s = −a.
        let alpha = if prograde { -b } else { b };
        let (s, u) = (-spin, 1.0 / r);
        let turn = alpha + s * (2.0 * u - s * alpha * u * u) / (1.0 - 2.0 * u + s * s * u * u);
        let bend = s * s - alpha * alpha + 6.0 * (alpha - s).powi(2) * u;
        let exact = 10f64.ln() * (turn / bend.sqrt()).abs();
        assert!((exact - growth).abs() < 5e-3, "{exact}");
        let at = |offset: f64| {
            let ray = impact(spin, FRAC_PI_2, INFINITY, alpha * (1.0 + offset), 0.0);
            closed(spin, &ray, &TIMED).direction.unwrap()[1].abs()
        };
        for k in 4..8 {
            let found = at(10f64.powi(-k - 1)) - at(10f64.powi(-k));
            assert!((found - exact).abs() < 40.0 * 10f64.powi(-k), "{spin} {k}: {found} {exact}");
        }
    }
}

/// On the critical curve itself, where light would never arrive, everything ends and says how good it is.
#[test]
fn on_the_critical_curve() {
    for spin in [0.0, 0.5, -0.99, 1.0] {
        for inclination in [0.0, 0.5, FRAC_PI_2] {
            let curve = CriticalCurve::new(spin, inclination);
            for [alpha, beta] in curve.points(16) {
                let path = closed(spin, &impact(spin, inclination, INFINITY, alpha, beta), &TIMED);
                // At |a| = 1 a part of the curve belongs to the horizon, outside which nothing is critical.
                assert!(path.error_estimate > 1e-6 || f64::abs(spin) == 1.0, "{path:?}");
                let met = path.crossings.iter().flat_map(|c| [c.r, c.phi, c.elapsed]);
                let all: Vec<f64> = met.chain(path.direction.into_iter().flatten()).collect();
                assert!(all.iter().all(|x| x.is_finite()), "{spin} {inclination} {alpha} {beta} {all:?}");
            }
        }
    }
}

/// A ray that is not a number is given up on, alone or among others, to which it does nothing.
#[test]
fn not_a_number_among_lanes() {
    let mut random = Random::new(83);
    let mut rays: Vec<Ray> = (0..40)
        .map(|_| impact(0.7, 1.1, INFINITY, random.within(-9.0, 9.0), random.within(-9.0, 9.0)))
        .collect();
    let tracer = ClosedForm::new(0.7, NODES, 10_000);
    let trace = |rays: &[Ray]| {
        let mut paths = vec![Path::default(); rays.len()];
        tracer.trace_all(rays, &TIMED, &mut paths);
        paths
    };
    let clean = trace(&rays);
    for (k, bad) in [(3, f64::NAN), (9, f64::INFINITY), (30, f64::NAN)] {
        if k == 30 { rays[k].start.j[1] = bad } else { rays[k].start.q = bad }
    }
    let spoilt = trace(&rays);
    for (k, (a, b)) in clean.iter().zip(&spoilt).enumerate() {
        if [3, 9, 30].contains(&k) {
            assert_eq!((b.fate, b.crossings.len(), b.direction), (Fate::StepLimit, 0, None), "ray {k}");
        } else {
            assert_eq!(format!("{a:?}"), format!("{b:?}"), "ray {k}");
        }
    }
}
