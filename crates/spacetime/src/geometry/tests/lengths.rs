//! Lengths of curves against closed forms.

use super::super::{Minkowski, PolarPlane, Schwarzschild, Sphere, length, polyline};
use super::assert_near;
use crate::Scalar;
use std::f64::consts::{FRAC_PI_2, TAU};

#[test]
fn of_parallels_of_a_sphere() {
    let globe = Sphere { radius: 3.0 };
    for theta in [FRAC_PI_2, 1.0, 0.2] {
        let found = polyline(&globe, &[[theta, 0.0], [theta, TAU]]);
        assert_near(found.spacelike, TAU * 3.0 * theta.sin(), 1e-12);
        assert_eq!(found.timelike, 0.0);
        assert!(found.error < 1e-9);
    }
}

#[test]
fn of_a_circle_that_does_not_go_round_the_origin() {
    let circle = |s: crate::Dual<f64, 1>| {
        let (sin, cos) = (s * TAU).sin_cos();
        let (x, y) = (cos + 3.0, sin);
        [(x.squared() + y.squared()).sqrt(), y.atan2(x)]
    };
    assert_near(length(&PolarPlane, circle, 1e-12).spacelike, TAU, 1e-10);
}

/// Radially from r to s: [√(r(r − 2)) + 2 ln(√r + √(r − 2))].
#[test]
fn towards_a_hole() {
    let hole = Schwarzschild { mass: 1.0 };
    let primitive = |r: f64| (r * (r - 2.0)).sqrt() + 2.0 * (r.sqrt() + (r - 2.0).sqrt()).ln();
    let found = polyline(&hole, &[[0.0, 10.0, 1.0, 0.0], [0.0, 2.5, 1.0, 0.0]]);
    assert_near(found.spacelike, primitive(10.0) - primitive(2.5), 1e-10);
    // To the horizon itself, where the integrand is infinite.
    let found = polyline(&hole, &[[0.0, 10.0, 1.0, 0.0], [0.0, 2.0, 1.0, 0.0]]);
    assert_near(found.spacelike, primitive(10.0) - primitive(2.0), 1e-5);
    assert!(found.error < 1e-5);
}

#[test]
fn of_a_world_line() {
    // Half of it at rest, half at 3/5 of the speed of light, then a piece faster than light.
    let found =
        polyline(&Minkowski, &[[0.0; 4], [5.0, 0.0, 0.0, 0.0], [10.0, 3.0, 0.0, 0.0], [10.0, 7.0, 0.0, 0.0]]);
    assert_near(found.timelike, 9.0, 1e-12);
    assert_near(found.spacelike, 4.0, 1e-12);
}
