//! Matter in the plane and its light: published numbers, other formulas, and tables against closed forms.

use crate::common;

use common::Random;
use kerrscope_spacetime::emitter::{Circular, CircularError, Departure, Equator, PageThorne, Sense};
use kerrscope_spacetime::kerr::{Orbits, horizons};
use kerrscope_spacetime::metric::{Components, Kerr, Metric, Minkowski, Schwarzschild};
use std::f64::consts::PI;

/// Published values of 4πF/Ṁ: a (below 0 where matter goes against the hole), r, value, by closed form and direct integration.
const FLUX: [[f64; 3]; 10] = [
    [0.0, 7.0, 7.684348541e-5],
    [0.0, 10.0, 1.705099996e-4],
    [0.0, 20.0, 5.937791154e-5],
    [0.9, 6.0, 1.967924140e-3],
    [0.9, 10.0, 6.037096399e-4],
    [0.998, 2.0, 0.04494064],
    [-0.5, 10.0, 6.6520036934776e-5],
    [-0.9, 12.0, 4.5882402760014e-5],
    [0.5, 7.0, 5.2918518420872e-4],
    [0.9999, 3.0, 1.9400624410855e-2],
];

#[test]
fn page_thorne_flux_is_the_published_one() {
    for [spin, r, expected] in FLUX {
        let flux = 4.0 * PI * PageThorne::new(spin).flux(r);
        let digits = if spin == 0.998 { 2e-7 } else { 1e-9 };
        assert!((flux / expected - 1.0).abs() < digits, "a = {spin}, r = {r}: {flux:e}");
        // About −z around the mirrored hole it is the same.
        assert_eq!(Circular::kerr(-spin, Sense::Retrograde).flux(r), PageThorne::new(spin).flux(r));
    }
}

#[test]
fn the_flux_is_largest_where_it_is_said_to_be() {
    for (spin, expected) in [(0.0, 9.550928), (0.5, 6.615088), (0.9, 3.441843), (0.998, 1.581185)] {
        let disk = PageThorne::new(spin);
        // Where two fluxes a little apart are equal: a parabola's middle.
        let (mut low, mut high) = (disk.isco(), 20.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let step = 1e-4 * (middle - disk.isco()).min(1.0);
            if disk.flux(middle + step) > disk.flux(middle - step) { low = middle } else { high = middle }
        }
        assert!((low - expected).abs() < 6e-7, "a = {spin}: {low}");
    }
}

/// At a = 0 the brace is x − √6 + (√3/2) ln[(x + √3)(√6 − √3)/((x − √3)(√6 + √3))], and next to it all is continuous; so it is at
/// a = ±1.
#[test]
fn special_spins_are_limits() {
    for r in [6.5, 9.0, 30.0, 1e4] {
        let (x, b) = (f64::sqrt(r), 3f64.sqrt());
        let (six, three) = (6f64.sqrt(), b);
        let brace = x - six + 0.5 * b * ((x + three) * (six - three) / ((x - three) * (six + three))).ln();
        let expected = 3.0 / (2.0 * r * r * x * (r - 3.0)) * brace / (4.0 * PI);
        assert!((PageThorne::new(0.0).flux(r) / expected - 1.0).abs() < 1e-11, "{r}");
        let near = PageThorne::new(1e-9).flux(r) / PageThorne::new(0.0).flux(r);
        assert!((near - 1.0).abs() < 1e-7, "{r}: {near}");
    }
    for (spin, least) in [(1.0, 1.5), (-1.0, 9.5)] {
        for r in [least, 12.0, 100.0] {
            let limit = PageThorne::new(spin).flux(r);
            assert!(limit.is_finite() && limit > 0.0);
            for (off, tolerance) in [(1e-6, 3e-2), (1e-9, 3e-3), (1e-12, 3e-4)] {
                let near = PageThorne::new(spin * (1.0 - off)).flux(r);
                assert!((near / limit - 1.0).abs() < tolerance, "{spin} {r} {off}: {}", near / limit - 1.0);
            }
        }
    }
}

/// What a disk radiates from both faces is what its matter has lost on its way: ∫ 4πr F E_∞ dr = 1 − E, each face's light carrying
/// the share −u_t ≈ of its energy (Page & Thorne 1974: ∫ 4π√−g F (−u_t) dr = Ṁ(1 − E_ISCO)).
#[test]
fn the_disk_radiates_what_matter_loses() {
    for spin in [-0.9, 0.0, 0.5, 0.9, 0.998] {
        let disk = Circular::kerr(spin, Sense::Prograde);
        let isco = disk.isco().unwrap();
        // r = r₀/s², s from 0 to 1; √−g = r.
        let n = 200_000;
        let sum: f64 = (0..n)
            .map(|k| {
                let s = (f64::from(k) + 0.5) / f64::from(n);
                let r = isco / (s * s);
                let energy = disk.orbit(r).unwrap().energy;
                4.0 * PI * r * disk.flux(r) * energy * 2.0 * isco / (s * s * s) / f64::from(n)
            })
            .sum();
        let efficiency = disk.efficiency().unwrap();
        assert!((sum / efficiency - 1.0).abs() < 1e-6, "a = {spin}: {sum} is not {efficiency}");
    }
}

/// Orbits of any metric from its components: those of Kerr.
#[test]
fn tables_agree_with_closed_forms() {
    let mut worst = [0.0_f64; 4];
    for spin in [-0.9, -0.3, 0.0, 0.5, 0.9, 0.998] {
        for sense in [Sense::Prograde, Sense::Retrograde] {
            let known = Circular::kerr(spin, sense);
            let found = Circular::of(&Components(Kerr::new(spin)), sense, 50.0).unwrap();
            let isco = known.isco().unwrap();
            worst[0] = worst[0].max((found.isco().unwrap() / isco - 1.0).abs());
            let photon = known.photon_orbit().unwrap();
            assert!((found.photon_orbit().unwrap() / photon - 1.0).abs() < 1e-12, "{spin} {sense:?}");
            assert!((found.efficiency().unwrap() - known.efficiency().unwrap()).abs() < 1e-12);
            assert!(found.table_error() < 1e-10, "{spin} {sense:?}: {:e}", found.table_error());
            let mut random = Random::new(1);
            for _ in 0..500 {
                let r = isco + random.scale(1e-3, 50.0 - isco);
                let (a, b) = (known.orbit(r).unwrap(), found.orbit(r).unwrap());
                let orbit = [a.rate / b.rate, a.time / b.time, a.energy / b.energy, a.momentum / b.momentum];
                worst[1] = orbit.iter().map(|q| (q - 1.0).abs()).fold(worst[1], f64::max);
                let relative = (found.flux(r) / known.flux(r) - 1.0).abs();
                if r > isco * 1.02 {
                    worst[2] = worst[2].max(relative);
                } else {
                    assert!(relative < 1e-6, "{spin} {sense:?} {r}: {relative:e}");
                }
            }
            // Falling matter, and light from it.
            let horizon = horizons(spin).0;
            for k in 1..100 {
                let r = horizon + (isco - horizon) * (0.01 + 0.99 * f64::from(k) / 100.0);
                let light = Departure { energy: 0.9, lambda: 0.3, normal: 0.4 / r, outward: k % 2 == 0 };
                let (a, b) = (known.shift(r, &light).unwrap(), found.shift(r, &light).unwrap());
                worst[3] = worst[3].max((a.factor() / b.factor() - 1.0).abs());
                let cosines = [&known, &found].map(|c| c.emission_cosine(r, &light).unwrap());
                worst[3] = worst[3].max((cosines[0] - cosines[1]).abs());
            }
        }
    }
    println!("last orbit {:e}, orbits {:e}, flux {:e}, falling {:e}", worst[0], worst[1], worst[2], worst[3]);
    assert!(worst[0] < 1e-12 && worst[1] < 1e-10 && worst[2] < 1e-8 && worst[3] < 1e-8, "{worst:?}");
}

/// Coordinates that know nothing of those of Kerr and Schild, and a mass other than 1.
#[test]
fn other_coordinates_have_the_same_disk() {
    let known = Circular::kerr(0.0, Sense::Prograde);
    let found = Circular::of(&Schwarzschild, Sense::Prograde, 100.0).unwrap();
    assert!((found.isco().unwrap() - 6.0).abs() < 1e-11, "{:?}", found.isco());
    assert!((found.photon_orbit().unwrap() - 3.0).abs() < 1e-9);
    for r in [6.5, 7.0, 10.0, 20.0, 99.0] {
        assert!((found.flux(r) / known.flux(r) - 1.0).abs() < 1e-9, "{r}");
    }
    assert_eq!(
        Circular::of(&Minkowski, Sense::Prograde, 10.0),
        Err(CircularError::NoOrbits { outer: 10.0 }),
        "nothing orbits in flat space"
    );
}

/// u·u = −1 and u·p, from the components themselves: the four-velocity and the momentum in Kerr–Schild coordinates.
#[test]
fn the_shift_is_that_of_momentum_and_velocity() {
    let mut random = Random::new(5);
    for _ in 0..2000 {
        let spin = random.within(-0.99, 0.99);
        let sense = random.pick(&[Sense::Prograde, Sense::Retrograde]);
        let disk = Circular::kerr(spin, sense);
        let r = random.scale(horizons(spin).0 * 1.01, 30.0);
        let Some(velocity) = disk.velocity(r) else { continue };
        let equator = disk.equator(r).unwrap();
        let delta = equator.determinant();
        // Boyer–Lindquist components of u; p_r from R = (r² + a² − aλ)² − Δ[(λ − a)² + η].
        let ut = velocity.t;
        let uphi = velocity.phi;
        let ur = velocity.radial * delta.sqrt() / r;
        let norm = equator.tt * ut * ut
            + 2.0 * equator.tp * ut * uphi
            + equator.pp * uphi * uphi
            + ur * ur * r * r / delta;
        assert!((norm + 1.0).abs() < 1e-7 * ut * ut * r, "a = {spin}, r = {r}: {norm}");
        let (lambda, eta): (f64, f64) = (random.within(-4.0, 4.0), random.within(0.0, 10.0));
        let squared = (r * r + spin * spin - spin * lambda).powi(2) - delta * ((lambda - spin).powi(2) + eta);
        if squared < 0.0 {
            continue;
        }
        let outward = random.within(0.0, 1.0) > 0.3;
        let pr = squared.sqrt() / delta * if outward { 1.0 } else { -1.0 };
        let energy = random.within(0.5, 1.0);
        let light = Departure { energy, lambda, normal: eta.sqrt() / r, outward };
        let g = 1.0 / (energy * (ut - lambda * uphi - pr * ur));
        let Some(shift) = velocity.shift(&equator, &light) else {
            assert!(!(g > 0.0), "{g}");
            continue;
        };
        assert!((shift.factor() / g - 1.0).abs() < 1e-7, "a = {spin}, r = {r}: {} {g}", shift.factor());
        // Without rotation of its own, matter has Ω = ω.
        let drag = 2.0 * spin / (r.powi(3) + spin * spin * (r + 2.0));
        let area = r.powi(4) + spin * spin * (r * r + 2.0 * r);
        let lapse = r * (delta / area).sqrt();
        let still = lapse / ((1.0 - drag * lambda) * energy);
        assert!((shift.gravitational / still - 1.0).abs() < 1e-12);
        let cosine = velocity.emission_cosine(&equator, &light);
        assert!((cosine / (g * energy * eta.sqrt() / r) - 1.0).abs() < 1e-7 && cosine <= 1.0 + 1e-7);
    }
}

/// The published isoradials' shift: a = 0, r = 6, i = 60°, seen at 90° from the node at b = 6.93214848, λ = ±b sin i.
#[test]
fn approaching_and_receding_sides() {
    let orbit = Circular::kerr(0.0, Sense::Prograde).orbit(6.0).unwrap();
    let lambda = 6.93214848 * 60f64.to_radians().sin();
    for (lambda, g) in [(lambda, 1.1954079), (-lambda, 0.5020351)] {
        assert!((orbit.redshift_factor(lambda, 1.0).unwrap() - g).abs() < 6e-8);
    }
    // Face-on g = √(1 − 3/r).
    assert!((orbit.redshift_factor(0.0, 1.0).unwrap() - 0.5f64.sqrt()).abs() < 1e-15);
}

#[test]
fn there_is_no_orbit_within_the_last_and_no_matter_within_the_horizon() {
    let disk = Circular::kerr(0.9, Sense::Prograde);
    assert!(disk.orbit(2.3).is_none() && disk.orbit(2.33).is_some() && disk.orbit(f64::NAN).is_none());
    assert!(
        disk.velocity(2.3).is_some() && disk.velocity(1.4).is_none() && disk.velocity(f64::NAN).is_none()
    );
    let table = Circular::of(&Kerr::new(0.9), Sense::Prograde, 30.0).unwrap();
    assert!(table.orbit(2.3).is_none() && table.orbit(2.33).is_some() && table.orbit(f64::NAN).is_none());
    assert!(table.velocity(2.3).is_some() && table.velocity(1.4).is_none());
    assert!(table.velocity(31.0).is_none() && table.flux(31.0) == 0.0, "not known there");
    // At a = 1 nothing is left within the last orbit.
    let extreme = Circular::kerr(1.0, Sense::Prograde);
    assert!(extreme.velocity(1.0).is_none() && extreme.velocity(1.0 + 1e-5).is_some());
    // Energies and momenta of the ISCO are those of 1 − 2/(3r).
    let o = Orbits::new(0.9);
    assert!((disk.efficiency().unwrap() - o.efficiency).abs() < 1e-14);
    assert!((extreme.efficiency().unwrap() - (1.0 - 1.0 / 3f64.sqrt())).abs() < 1e-14);
}

/// At rest far away all is flat.
#[test]
fn the_equator_of_kerr_is_that_of_the_components() {
    for spin in [0.0, 0.7, -0.99] {
        let metric = Kerr::new(spin);
        let x: f64 = 4.2;
        let r = metric.radius(&[x, 0.0, 0.0]);
        let g = metric.components(&[x, 0.0, 0.0]);
        let Equator { tt, tp, pp, zz } = Equator::kerr(spin, r);
        for (a, b) in [(tt, g[0][0]), (tp, g[0][2] * x), (pp, g[2][2] * x * x), (zz, g[3][3])] {
            assert!((a - b).abs() < 1e-13, "{a} {b}");
        }
    }
}
