//! Derivatives of what a ray meets, from dual numbers, against finite differences of single rays.

use crate::common;
#[path = "common/differences.rs"]
mod differences;

use common::{Random, Worst};
use differences::{Point, Verdict, Way, differences, impact_of, scales, single};
#[cfg(not(target_arch = "x86_64"))]
use fearless_simd::dispatch;
use fearless_simd::{Level, Simd};
use kerrscope_spacetime::closed::Tables;
use kerrscope_spacetime::kerr::{Orbits, ergosphere};
use kerrscope_spacetime::{Dual, Lanes, Scalar};
use std::f64::consts::{FRAC_PI_2, PI};

/// A point on the screen of an observer that the hole bends much, but not always.
fn aimed(random: &mut Random, spin: f64, inclination: f64, u: f64) -> Point {
    let reach = random.pick(&[3.0, 8.0, 20.0]);
    [spin, inclination, random.within(-reach, reach), random.within(-reach, reach), u]
}

#[test]
fn any_observer() {
    let (mut random, mut verdict, tables) = (Random::new(71), Verdict::default(), Tables::default());
    for _ in 0..250 {
        let spin = random.within(-0.98, 0.98);
        let inclination = random.within(0.1, PI - 0.1);
        let u = if random.within(0.0, 1.0) < 0.4 { 0.0 } else { 1.0 / random.scale(4.0, 1e4) };
        verdict.see(&tables, aimed(&mut random, spin, inclination, u));
    }
    verdict.judge("any observer", 4000, 1e-12, 1e-9);
}

/// Where √(1 − a²) has no derivative, and next to it; and no spin at all.
#[test]
fn extreme_spins() {
    let (mut random, mut verdict, tables) = (Random::new(72), Verdict::default(), Tables::default());
    for spin in [1.0, -1.0, 1.0 - 1e-9, -1.0 + 1e-5, 0.999, 0.0, 1e-12, -1e-4] {
        for k in 0..25 {
            let inclination = random.within(0.1, PI - 0.1);
            let u = if k % 3 == 0 { 0.0 } else { 1.0 / random.scale(4.0, 1e4) };
            verdict.see(&tables, aimed(&mut random, spin, inclination, u));
        }
    }
    verdict.judge("extreme spins", 3000, 1e-12, 1e-9);
}

/// On the axis the azimuth is that in which the ray leaves; inclinations grow from there.
#[test]
fn on_the_axis_and_next_to_it() {
    let (mut random, mut verdict, tables) = (Random::new(73), Verdict::default(), Tables::default());
    for inclination in [0.0, PI, 1e-9, 1e-5, PI - 1e-6, 1e-3, 0.03] {
        for k in 0..25 {
            let spin = random.within(-0.98, 0.98);
            let u = if k % 3 == 0 { 0.0 } else { 1.0 / random.scale(4.0, 1e3) };
            let mut at = aimed(&mut random, spin, inclination, u);
            at[2] = at[2].abs();
            verdict.see(&tables, at);
        }
    }
    verdict.judge("axis", 2500, 1e-11, 1e-9);
}

/// Cameras in the plane, rays that set out horizontally, and rays over the pole.
#[test]
fn special_directions() {
    let (mut random, mut verdict, tables) = (Random::new(74), Verdict::default(), Tables::default());
    for k in 0..100 {
        let spin = random.within(-0.98, 0.98);
        let inclination = if k % 2 == 0 { FRAC_PI_2 } else { random.within(0.3, PI - 0.3) };
        let u = if k % 3 == 0 { 0.0 } else { 1.0 / random.scale(4.0, 1e3) };
        let mut at = aimed(&mut random, spin, inclination, u);
        match k % 4 {
            1 => at[2] = 0.0,
            3 => at[3] = 0.0,
            _ => {}
        }
        verdict.see(&tables, at);
    }
    verdict.judge("special directions", 1000, 1e-12, 1e-9);
}

/// Cameras between the horizon, or the static limit, and the photon shell.
#[test]
fn within_the_photon_shell() {
    let (mut random, mut verdict, tables) = (Random::new(75), Verdict::default(), Tables::default());
    for _ in 0..200 {
        let spin = random.within(-0.99, 0.99);
        let inclination = random.within(0.1, PI - 0.1);
        let least = 1.05 * ergosphere(spin, inclination);
        let r = random.within(least, Orbits::new(spin).photon_prograde.max(least) + 1.0);
        let reach = random.within(0.5, 6.0);
        let (sin, cos) = random.within(-PI, PI).sin_cos();
        verdict.see(&tables, [spin, inclination, reach * cos, reach * sin, 1.0 / r]);
    }
    verdict.judge("within the photon shell", 300, 1e-14, 1e-11);
}

/// Light that sets out outwards from near the hole: vortical light (η < 0), and light that falls back.
#[test]
fn outwards() {
    let (mut random, mut verdict, tables) = (Random::new(77), Verdict::default(), Tables::default());
    let mut vortical = 0;
    for k in 0..200 {
        let spin = random.within(0.3, 0.99) * random.pick(&[-1.0, 1.0]);
        let inclination = random.pick(&[0.05, 0.4, 1.0, 2.3, 3.0]);
        let r = 1.2 * ergosphere(spin, inclination) + random.within(0.0, 3.0);
        let reach = if k % 2 == 0 { spin.abs() * f64::cos(inclination).abs() } else { 6.0 };
        let (sin, cos) = random.within(-PI, PI).sin_cos();
        let size = reach * random.within(0.1, 0.9);
        vortical += usize::from(k % 2 == 0);
        verdict.see_on(Way::Outwards, &tables, [spin, inclination, size * cos, size * sin, 1.0 / r]);
    }
    assert!(vortical >= 100);
    verdict.judge("outwards", 1500, 1e-12, 1e-9);
}

/// A ray in the plane stays there: its direction has derivatives, of which that of θ in β and i is
/// known where space is all but flat.
#[test]
fn in_the_plane() {
    let tables = Tables::default();
    for spin in [0.0, 0.9, -1.0] {
        for alpha in [9.0, -12.0] {
            let path = impact_of(Dual::variables([spin, FRAC_PI_2, alpha, 0.0, 0.0])).trace(&tables, 8);
            assert!(path.escaped && path.crossings.is_empty());
            // The same ray just off the plane.
            for (axis, sign) in [(1, 1.0), (3, 1.0), (1, -1.0), (3, -1.0)] {
                let h = 1e-6 * sign;
                let mut near = [spin, FRAC_PI_2, alpha, 0.0, 0.0];
                near[axis] += h;
                let moved = single(Way::Inwards, near, true).unwrap().direction.unwrap();
                for k in 0..2 {
                    let slope = (moved[k] - path.direction[k].value) / h;
                    let found = path.direction[k].gradient[axis];
                    assert!((found - slope).abs() < 1e-5, "a = {spin}, α = {alpha}, {axis}: {found} {slope}");
                }
            }
            for axis in [0, 2] {
                let at = [spin, FRAC_PI_2, alpha, 0.0, 0.0];
                let [_, [slope, doubt]] = differences(Way::Inwards, at, axis, 0.3).unwrap()[..] else {
                    panic!()
                };
                let found = path.direction[1].gradient[axis];
                assert!(
                    (found - slope).abs() < 1e-9 + 3.0 * doubt,
                    "a = {spin}, α = {alpha}: {found} {slope}"
                );
            }
        }
    }
}

/// Lanes whose motions differ in kind give what single rays give.
#[test]
fn lanes() {
    // One level is enough: it takes a minute to compile.
    #[cfg(target_arch = "x86_64")]
    lanes_are_single_rays(Level::new().as_sse2().unwrap());
    #[cfg(not(target_arch = "x86_64"))]
    dispatch!(Level::baseline(), simd => lanes_are_single_rays(simd));
}

fn lanes_are_single_rays<L: Simd>(simd: L) {
    let (mut random, mut worst, tables) = (Random::new(76), Worst::default(), Tables::default());
    for _ in 0..40 {
        let rays: [Point; 8] = std::array::from_fn(|k| {
            let spin = random.within(-1.0, 1.0);
            let inclination = [0.0, FRAC_PI_2, random.within(0.1, 3.0)][k % 3];
            let u = if k % 2 == 0 { 0.0 } else { 1.0 / random.scale(4.0, 1e3) };
            aimed(&mut random, spin, inclination, u)
        });
        let columns: [Lanes<L>; 5] =
            std::array::from_fn(|i| Lanes::new(simd, std::array::from_fn(|lane| rays[lane][i])));
        let together = impact_of(Dual::variables(columns)).trace(&tables, 4);
        let zero = columns[0].constant(0.0);
        let is = |mask, lane| Lanes::select(mask, zero + 1.0, zero).lane(lane) > 0.0;
        for (lane, &at) in rays.iter().enumerate() {
            let alone = impact_of(Dual::variables(at)).trace(&tables, 4);
            assert_eq!(is(together.escaped, lane), alone.escaped);
            assert_eq!(is(together.captured, lane), alone.captured);
            let met = together.crossings.iter().filter(|c| is(c.met, lane)).count();
            assert_eq!(met, alone.crossings.len());
            let mut pairs = Vec::new();
            for (a, b) in together.crossings.iter().zip(&alone.crossings) {
                pairs.extend([(a.r, b.r), (a.phi, b.phi), (a.elapsed, b.elapsed)]);
            }
            if alone.escaped {
                pairs.extend([0, 1].map(|k| (together.direction[k], alone.direction[k])));
            }
            if pairs.is_empty() {
                continue;
            }
            let (_, sensitivity) = scales(at);
            for (a, b) in pairs {
                let label = || format!("{at:?} {a:?} {b:?}");
                let error = (a.value.lane(lane) - b.value).abs() / (1.0 + b.value.abs());
                worst.see(error / sensitivity, label);
                for i in 0..5 {
                    let size = 1.0 + b.value.abs() + b.gradient.iter().fold(0.0, |m: f64, g| m.max(g.abs()));
                    let error = (a.gradient[i].lane(lane) - b.gradient[i]).abs() / size;
                    worst.see(error / sensitivity.powi(2), label);
                }
            }
        }
    }
    worst.below(1e-12, "lanes against single rays");
}

/// No photon with these parameters gets to the camera: neither fate.
#[test]
fn no_such_photon() {
    let path = impact_of([0.5, 1.0, 12.0, 0.0, 0.25]).trace(&Tables::default(), 8);
    assert!(!path.escaped && !path.captured && path.crossings.is_empty() && path.direction[0].is_nan());
}
