//! Geodesics between points.

use super::super::{
    Minkowski, PolarPlane, Pole, Schwarzschild, Search, Sphere, SphericalSpace, Stereographic, between,
};
use super::{assert_near, points};
use std::f64::consts::{FRAC_PI_2, PI};

/// cos d = cos θ₁ cos θ₂ + sin θ₁ sin θ₂ cos Δφ, and the long way round.
#[test]
fn on_a_sphere() {
    let globe = Sphere { radius: 2.0 };
    let mut long_ways = 0;
    for [theta, phi, up, along] in points(20, [[0.4, 2.7], [0.0, 6.0], [0.4, 2.7], [0.0, 6.0]]) {
        let found = between(&globe, &[theta, phi], &[up, along], &Search::default()).unwrap();
        let cos = theta.cos() * up.cos() + theta.sin() * up.sin() * (along - phi).cos();
        assert_near(found[0].length(), 2.0 * cos.acos(), 1e-9);
        assert!(found[0].miss < 1e-10 && !found[0].conjugate);
        let other = found.iter().find(|c| (c.length() - 2.0 * (2.0 * PI - cos.acos())).abs() < 1e-9);
        long_ways += usize::from(other.is_some());
    }
    // It passes a conjugate point, and a search may lose it there.
    assert!(long_ways >= 14, "{long_ways} of 20");
}

#[test]
fn between_opposite_points_there_is_a_family() {
    let globe = Sphere { radius: 1.0 };
    let found = between(&globe, &[FRAC_PI_2, 0.0], &[FRAC_PI_2, PI], &Search::default()).unwrap();
    assert!(found[0].conjugate);
    assert_near(found[0].length(), PI, 1e-12);
}

#[test]
fn in_flat_space() {
    for [r, phi, s, psi] in points(20, [[1.0, 9.0], [0.0, 6.0], [1.0, 9.0], [0.0, 6.0]]) {
        let (from, to) = ([r * phi.cos(), r * phi.sin()], [s * psi.cos(), s * psi.sin()]);
        let straight = (from[0] - to[0]).hypot(from[1] - to[1]);
        let found = between(&PolarPlane, &[r, phi], &[s, psi], &Search::default()).unwrap();
        assert_near(found[0].length(), straight, 1e-9);
        // There is one straight line only: further turns find none.
        assert_eq!(found.len(), 1);
        let space = between(&SphericalSpace, &[r, 1.0, phi], &[s, 1.0, psi], &Search::default()).unwrap();
        let cos = 1f64.cos().powi(2) + 1f64.sin().powi(2) * (phi - psi).cos();
        assert_near(space[0].length(), (r * r + s * s - 2.0 * r * s * cos).sqrt(), 1e-9);
    }
    let flat = between(&Minkowski, &[0.0; 4], &[5.0, 3.0, 0.0, 0.0], &Search::default()).unwrap();
    assert_near(flat[0].norm, -16.0, 1e-12);
}

#[test]
fn in_a_stereographic_chart() {
    let chart = Stereographic { radius: 1.0, pole: Pole::South };
    let (a, b) = (chart.from_angles([0.3, 0.2]), chart.from_angles([2.2, 1.9]));
    let found = between(&chart, &a, &b, &Search::default()).unwrap();
    let cos = 0.3f64.cos() * 2.2f64.cos() + 0.3f64.sin() * 2.2f64.sin() * 1.7f64.cos();
    assert_near(found[0].length(), cos.acos(), 1e-9);
}

/// A body thrown up at r = 10 that is there again: by symmetry it is at rest at the middle of the time.
#[test]
fn between_events() {
    let hole = Schwarzschild { mass: 1.0 };
    let found = between(
        &hole,
        &[0.0, 10.0, 1.0, 0.0],
        &[20.0, 10.0, 1.0, 0.0],
        &Search { turns: 0, ..Search::default() },
    )
    .unwrap();
    let thrown = found[0];
    assert!(thrown.norm < 0.0 && thrown.velocity[1] > 0.0);
    // It ages more than a clock at rest, and less than one far away.
    assert!(thrown.length() > 20.0 * 0.8f64.sqrt() && thrown.length() < 20.0);
}

#[test]
fn none_is_said_to_be_none() {
    // The second point is inside the horizon, which these coordinates do not cross.
    let hole = Schwarzschild { mass: 1.0 };
    let failure =
        between(&hole, &[0.0, 10.0, 1.0, 0.0], &[20.0, 1.0, 1.0, 0.0], &Search::default()).unwrap_err();
    assert!(failure.starts > 3 && failure.to_string().contains("no geodesic"));
}
