//! Orbits around holes against closed forms.

use super::super::{
    BoyerLindquist, End, Geometry, Kind, Options, Schwarzschild, Trajectory, VelocityError, conserved,
    velocity,
};
use super::assert_near;
use crate::geodesic::root;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const EXACT: Options = Options { tolerance: 4e-14, max_steps: 50_000 };

/// Ω = 1/(r^{3/2} + a) of the circular orbit about +z.
#[test]
fn circular_orbits_stay_circular() {
    for (spin, r) in [(0.0, 10.0), (0.0, 6.5), (0.9, 4.0), (-0.9, 12.0)] {
        let hole = BoyerLindquist::new(spin);
        let at = [0.0, r, FRAC_PI_2, 0.0];
        let turning = 1.0 / (r * r.sqrt() + spin);
        // u^φ = Ω u^t and g(u, u) = −1.
        let g = hole.metric(&at);
        let rate = 1.0 / (-(g[0][0] + turning * (2.0 * g[0][3] + turning * g[3][3]))).sqrt();
        let v = velocity(&hole, &at, &[0.0, 0.0, 0.0, turning * rate], Kind::Timelike).unwrap();
        assert_near(v[0], rate, 1e-12);
        let hundred = 100.0 * TAU / v[3];
        let way = Trajectory::follow(&hole, &at, &v, hundred, &EXACT);
        assert_eq!(way.end, End::Complete);
        for i in 0..=400 {
            let point = way.at(hundred * f64::from(i) / 400.0);
            assert!((point.x[1] / r - 1.0).abs() < 1e-9, "a = {spin}, r = {r}: {:.1e}", point.x[1] / r - 1.0);
        }
        assert_near(way.at(hundred).x[3], 100.0 * TAU, 1e-8);
    }
}

/// r = p/(1 + e cos χ): (dχ/dφ)² = 1 − (2/p)(3 + e cos χ) (Chandrasekhar 1983, §19), so that from one perihelion to the
/// next φ grows by 2∫₀^π dχ/√(1 − (6 + 2e cos χ)/p). The trapezoidal rule is exact for a smooth periodic function.
#[test]
fn perihelion_advances() {
    let hole = Schwarzschild { mass: 1.0 };
    for (p, e) in [(12.0, 0.3), (20.0, 0.6), (8.0, 0.1), (300.0, 0.2)] {
        let nodes = 400;
        let exact: f64 = (0..nodes)
            .map(|k| {
                let chi = TAU * f64::from(k) / f64::from(nodes);
                TAU / f64::from(nodes) / (1.0 - (6.0 + 2.0 * e * chi.cos()) / p).sqrt()
            })
            .sum();
        let r: f64 = p / (1.0 + e);
        // L² = p²/(p − 3 − e²)
        let l = (p * p / (p - 3.0 - e * e)).sqrt();
        let at = [0.0, r, FRAC_PI_2, 0.0];
        let v = velocity(&hole, &at, &[0.0, 0.0, 0.0, l / (r * r)], Kind::Timelike).unwrap();
        let span = 5.0 * TAU * (p / (1.0 - e * e)).powf(1.5);
        let way = Trajectory::follow(&hole, &at, &v, span, &EXACT);
        // p_r passes zero upwards at a perihelion.
        let count = 4000;
        let samples: Vec<f64> = (1..=count).map(|i| span * f64::from(i) / f64::from(count)).collect();
        let moved = |s: f64| way.at(s).momentum[1];
        let mut seen = 0;
        for ends in samples.windows(2) {
            let (low, high) = (moved(ends[0]), moved(ends[1]));
            if low < 0.0 && high >= 0.0 {
                seen += 1;
                let share = root(|t| moved(ends[0] + t * (ends[1] - ends[0])), low, high);
                let found = way.at(ends[0] + share * (ends[1] - ends[0])).x[3];
                assert_near(found, f64::from(seen) * exact, 1e-8);
            }
        }
        assert!(seen >= 2, "{seen} perihelia");
    }
}

#[test]
fn a_bound_orbit_around_kerr_keeps_its_constants() {
    let hole = BoyerLindquist::new(0.9);
    let at = [0.0, 8.0, 1.1, 0.0];
    let v = velocity(&hole, &at, &[0.0, 0.02, 0.031, 0.042], Kind::Timelike).unwrap();
    let way = Trajectory::follow(&hole, &at, &v, 5_000.0, &EXACT);
    assert_eq!(way.end, End::Complete);
    let (x, p) = way.state(0.0);
    let first = conserved(&hole, &x, &p);
    let names: Vec<&str> = first.iter().map(|(name, _)| &name[..]).collect();
    assert_eq!(names, ["norm", "E", "p_phi", "Q"]);
    assert!(first[1].1 < 1.0 && first[3].1 > 1.0, "bound, and out of the plane: {first:?}");
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for i in 0..=1000 {
        let (x, p) = way.state(5.0 * f64::from(i));
        (low, high) = (low.min(x[1]), high.max(x[1]));
        for ((name, before), (_, now)) in first.iter().zip(conserved(&hole, &x, &p)) {
            assert!((before - now).abs() < 1e-10, "{name} at step {i}: {:.1e}", before - now);
        }
    }
    assert!(low > 4.0 && high < 20.0 && high - low > 1.0, "{low} to {high}");
}

/// From rest at infinity dr/dτ = −√(2/r): τ = (√2/3)(r₀^{3/2} − r^{3/2}).
#[test]
fn falling_ends_at_the_horizon() {
    let hole = Schwarzschild { mass: 1.0 };
    let at = [0.0, 10.0, 1.0, 0.0];
    let v = velocity(&hole, &at, &[0.0, -0.2f64.sqrt(), 0.0, 0.0], Kind::Timelike).unwrap();
    assert_near(v[0], 1.25, 1e-14);
    let way = Trajectory::follow(&hole, &at, &v, 100.0, &EXACT);
    assert_eq!(way.end, End::Edge);
    let end = way.at(way.parameter());
    assert!((end.x[1] - 2.0).abs() < 1e-6 && end.x[0] > 30.0, "{end:?}");
    assert_near(way.parameter(), 2f64.sqrt() / 3.0 * (1000f64.sqrt() - 8f64.sqrt()), 1e-6);
    let half = way.at(10.0);
    assert_near(10.0, 2f64.sqrt() / 3.0 * (1000f64.sqrt() - half.x[1].powf(1.5)), 1e-10);
}

/// Light at r = 3 with L = √27 E circles for a while: it is the unstable photon orbit.
#[test]
fn light_circles_at_three() {
    let hole = Schwarzschild { mass: 1.0 };
    let at = [0.0, 3.0, FRAC_PI_2, 0.0];
    let v = velocity(&hole, &at, &[0.0, 0.0, 0.0, 1.0], Kind::Null).unwrap();
    assert_near(9.0 * v[3] / (v[0] / 3.0), 27f64.sqrt(), 1e-12);
    let way = Trajectory::follow(&hole, &at, &v, TAU, &EXACT);
    assert_near(way.at(TAU).x[1], 3.0, 1e-8);
    let back = Trajectory::follow(&hole, &at, &v, -PI, &EXACT);
    assert_near(back.at(-PI).x[3], -PI, 1e-9);
}

#[test]
fn impossible_velocities_are_refused() {
    let hole = Schwarzschild { mass: 1.0 };
    let at = [0.0, 6.0, 1.0, 0.0];
    let ask = |x: [f64; 4], v: [f64; 4], kind| velocity(&hole, &x, &v, kind).unwrap_err();
    assert_eq!(ask(at, [1.0, 0.0, 0.0, 0.0], Kind::Null), VelocityError::NoDirection);
    assert_eq!(ask([0.0, 1.5, 1.0, 0.0], [0.0, 1.0, 0.0, 0.0], Kind::Null), VelocityError::Singular);
    assert_eq!(ask([0.0, 6.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], Kind::Null), VelocityError::Singular);
    assert!(matches!(ask(at, [1.0, 0.1, 0.0, 0.0], Kind::Spacelike), VelocityError::NotSpacelike(_)));
}
