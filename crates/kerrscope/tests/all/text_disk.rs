//! Disks in metrics as text: those of the holes that they are, and published ones.

use crate::texts;

use kerrscope::spacetime::emitter::{Circular, CircularError, Departure, Sense};
use kerrscope::spacetime::geodesic::{Integrator, Path, Query, Scheme, TextTracer, Tracer};
use kerrscope::spacetime::kerr::horizons;
use kerrscope::spacetime::metric::{Kerr, LineElement, Metric, Text};
use kerrscope::spacetime::observer::impact_ray;
use std::sync::Arc;
use texts::element;

fn disk(element: &LineElement, sense: Sense, outer: f64) -> Result<Circular, CircularError> {
    Circular::of(&Text::new(element), sense, outer)
}

/// Radii as shares of the way from one to another, closer together at first.
fn radii(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..60).map(move |k| from * (to / from).powf(f64::from(k) / 59.0))
}

#[test]
fn texts_of_kerr_have_the_disk_of_kerr() {
    let mut worst = [0.0_f64; 3];
    for spin in [-0.9, -0.5, 0.0, 0.5, 0.9, 0.998] {
        let texts = [
            element("kerr-text", &[("spin", spin)]),
            element("kerr-newman", &[("spin", spin), ("charge", 0.0)]),
            element("johannsen", &[("spin", spin)]),
        ];
        for (text, sense) in texts.iter().flat_map(|t| [(t, Sense::Prograde), (t, Sense::Retrograde)]) {
            let (known, found) = (Circular::kerr(spin, sense), disk(text, sense, 40.0).unwrap());
            let isco = known.isco().unwrap();
            worst[0] = worst[0].max((found.isco().unwrap() / isco - 1.0).abs());
            for r in radii(isco * 1.02, 40.0) {
                worst[1] = worst[1].max((found.flux(r) / known.flux(r) - 1.0).abs());
            }
            // Both orbiting and falling matter.
            for r in radii(horizons(spin).0 * 1.02, 40.0) {
                for outward in [true, false] {
                    let light = Departure { energy: 1.0, lambda: 0.4, normal: 0.5 / r, outward };
                    let [a, b] = [&known, &found].map(|disk| disk.shift(r, &light).unwrap());
                    let off = (a.gravitational / b.gravitational - 1.0).abs();
                    worst[2] = worst[2].max(off).max((a.doppler / b.doppler - 1.0).abs());
                }
            }
        }
    }
    println!("last orbit {:e}, flux {:e}, g {:e}", worst[0], worst[1], worst[2]);
    assert!(worst.iter().all(|off| *off < 1e-8), "{worst:?}");
}

/// A hole with a charge: the last stable orbit is at r³ − 6r² + 9Q²r − 4Q⁴ = 0 (Pugliese, Quevedo & Ruffini 2011), light goes around
/// at r² − 3r + 2Q² = 0, and Ω² = (r − Q²)/r⁴.
#[test]
fn a_charged_hole_has_its_orbits() {
    for charge in [0.3, 0.8, 0.99] {
        let text = element("reissner-nordstrom", &[("charge", charge)]);
        let found = disk(&text, Sense::Prograde, 50.0).unwrap();
        let (q2, isco) = (charge * charge, found.isco().unwrap());
        let cubic = isco.powi(3) - 6.0 * isco * isco + 9.0 * q2 * isco - 4.0 * q2 * q2;
        assert!(cubic.abs() < 1e-10, "Q = {charge}: {isco}, {cubic:e}");
        let photon = 0.5 * (3.0 + (9.0 - 8.0 * q2).sqrt());
        assert!((found.photon_orbit().unwrap() / photon - 1.0).abs() < 1e-12);
        for r in radii(isco, 50.0) {
            let rate = found.orbit(r).unwrap().rate;
            assert!((rate / ((r - q2).sqrt() / (r * r)) - 1.0).abs() < 1e-10, "{r}");
        }
        // ∫ 4πr F E dr = 1 − E_isco, √−g being r, but for what lies beyond r = 50: less than (1 − E) there.
        let n = 20_000;
        let sum: f64 = (0..n)
            .map(|k| {
                let r = isco + (50.0 - isco) * (f64::from(k) + 0.5) / f64::from(n);
                4.0 * std::f64::consts::PI
                    * r
                    * found.flux(r)
                    * found.orbit(r).unwrap().energy
                    * (50.0 - isco)
                    / f64::from(n)
            })
            .sum();
        let all = found.efficiency().unwrap();
        assert!(sum < all && sum > all - 1.5 / 50.0, "{sum} {all}");
    }
}

/// Where there is no last orbit, or none at all, that is said.
#[test]
fn what_has_no_disk_says_so() {
    for name in ["ellis", "morris-thorne"] {
        let refused = disk(&element(name, &[]), Sense::Prograde, 20.0);
        assert_eq!(
            refused,
            Err(CircularError::NoOrbits { outer: 20.0 }),
            "{name}: nothing is attracted there"
        );
    }
    let two = disk(&element("two-kerr", &[]), Sense::Prograde, 20.0);
    assert_eq!(two, Err(CircularError::NotAxisymmetric));
}

/// With a cosmological constant stable orbits end outwards too; the last one inwards is at r⁴(8Λ) − 15Λr³M + … (Stuchlík & Hledík
/// 1999: 4Λr⁴/3·… ), here by dE/dr = 0 of f = 1 − 2/r − Λr²/3: r f f″ − 2r f′² + 3 f f′ = 0.
#[test]
fn a_cosmological_constant_leaves_a_range() {
    let lambda = 1e-4;
    let text = element("schwarzschild-de-sitter", &[("lambda", lambda)]);
    let found = disk(&text, Sense::Prograde, 10.0).unwrap();
    let r = found.isco().unwrap();
    let f = 1.0 - 2.0 / r - lambda * r * r / 3.0;
    let slope = 2.0 / (r * r) - 2.0 * lambda * r / 3.0;
    let bend = -4.0 / r.powi(3) - 2.0 * lambda / 3.0;
    let condition = r * f * bend - 2.0 * r * slope * slope + 3.0 * f * slope;
    assert!(condition.abs() < 1e-12, "{r}: {condition:e}");
    assert!(r > 6.0 && r < 6.5 && found.flux(8.0) > 0.0, "{r}");
}

/// The light of a ray in a metric as text is that of the ray around the hole.
#[test]
fn crossings_in_a_text_know_the_light() {
    let (spin, scheme) = (0.7, Scheme::Dop853 { tolerance: 1e-12 });
    let text = element("kerr-text", &[("spin", spin)]);
    let tracer = TextTracer::new(Arc::clone(&text), scheme, 20_000);
    let known = Integrator::new(Kerr::new(spin), scheme, 20_000).boxed();
    let (here, there) = (Circular::kerr(spin, Sense::Prograde), disk(&text, Sense::Prograde, 60.0).unwrap());
    let query = Query::default();
    let mut compared = 0;
    for k in 0..200 {
        let impact = [f64::from(k % 20) - 9.7, f64::from(k / 20) * 2.0 - 8.9];
        let ray = impact_ray(Some(spin), 1.1, f64::INFINITY, impact).unwrap();
        if Kerr::new(-spin).sensitivity(ray.energy, &ray.start) > 100.0 {
            continue;
        }
        let (mut a, mut b) = (Path::default(), Path::default());
        known.trace(&ray, &query, &mut a);
        tracer.trace(&ray, &query, &mut b);
        for (a, b) in a.crossings.iter().zip(&b.crossings).filter(|(a, _)| a.r < 60.0 && a.r > 2.0) {
            let [light, other] = [a, b].map(|crossing| Departure::new(&ray, crossing, &query.plane));
            assert!(
                (light.normal - other.normal).abs() < 1e-9 && light.outward == other.outward,
                "{a:?} {b:?}"
            );
            let g = here.shift(a.r, &light).unwrap().factor();
            let text = there.shift(b.r, &other).unwrap().factor();
            assert!((g / text - 1.0).abs() < 1e-7, "{a:?}: {g} {text}");
            let cosines =
                [here.emission_cosine(a.r, &light).unwrap(), there.emission_cosine(b.r, &other).unwrap()];
            assert!((cosines[0] - cosines[1]).abs() < 1e-7 && cosines[0] > 0.0 && cosines[0] <= 1.0 + 1e-9);
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared}");
}
