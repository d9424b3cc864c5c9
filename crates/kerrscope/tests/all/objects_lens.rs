//! Luminous balls behind a hole without spin, against the exact lens equation.
//!
//! Light from a ball at r_s, at an angle β from the point straight behind the hole, sweeps the azimuth π − β on the ball's
//! side and π + β on the other. The azimuth is an elliptic integral of the impact parameter b, and a static observer at r
//! sees the light at the angle α from the hole with sin α = b √(1 − 2/r)/r.

// One of the tests of the tracer; not all of it is used here.
#[allow(dead_code)]
use crate::common;

use std::f64::consts::PI;

use crate::orbit::Orbit;
use common::{ray, stage};
use kerrscope::render::Stage;

const OBSERVER: f64 = 30.0;
const SOURCE: f64 = 20.0;
/// The ball's radius: small, so that its middle is in the middle of its image but for its square.
const RADIUS: f64 = 0.01;

/// The impact parameter of light that sweeps an azimuth from the source, past its turning point, to the observer.
fn impact(swept: f64) -> f64 {
    let critical = 27_f64.sqrt();
    // Up to light that turns at the source's own radius.
    let (mut low, mut high) =
        (critical * (1.0 + 1e-13), SOURCE / (1.0 - 2.0 / SOURCE).sqrt() * (1.0 - 1e-12));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if Orbit::new(middle).swept(1.0 / OBSERVER, true, 1.0 / SOURCE, true) > swept {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Distance in pixels from the middle of the picture of light with an impact parameter.
fn distance(b: f64) -> f64 {
    let angle = (b * (1.0 - 2.0 / OBSERVER).sqrt() / OBSERVER).asin();
    angle.tan() * 540.0 / 25_f64.to_radians().tan()
}

/// A ball at an angle from straight behind the hole, to the right as the camera sees it.
fn behind(beta: f64) -> Stage {
    let (sin, cos) = beta.sin_cos();
    stage(&format!(
        "spacetime.name = \"schwarzschild\"\nobserver = {{ position = [{OBSERVER}, 0, 0] }}\n\
         sky.kind = \"black\"\nscreen.field_of_view = 50\n\
         render = {{ width = 1920, height = 1080, tolerance = 1e-12, method = \"dop853\" }}\n\
         object = [{{ center = [{}, {}, 0], radius = {RADIUS}, material = \"light\", color = [1, 1, 1] }}]",
        -SOURCE * cos,
        SOURCE * sin
    ))
}

/// Where along a line through the middle of the picture light begins and ends around a place that is lit, by bisection.
fn edges(stage: &Stage, towards: f64, lit: f64, apart: f64) -> [f64; 2] {
    let (sin, cos) = towards.sin_cos();
    let shines = |rho: f64| ray(stage, [960.0 + rho * cos, 540.0 - rho * sin])[1] > 0.0;
    assert!(shines(lit), "there is no light at {lit}");
    [-apart, apart].map(|step| {
        let (mut inside, mut outside) = (lit, lit + step);
        assert!(!shines(outside), "there is light at {outside}");
        for _ in 0..50 {
            let middle = 0.5 * (inside + outside);
            if shines(middle) { inside = middle } else { outside = middle }
        }
        inside
    })
}

#[test]
fn both_images_are_where_the_lens_equation_puts_them() {
    for beta in [0.1, 0.3, 0.8] {
        let stage = behind(beta);
        for (towards, swept) in [(0.0, PI - beta), (PI, PI + beta)] {
            let b = impact(swept);
            // The ball is at larger azimuth, which is to the right of a camera on +x that looks at the hole.
            let [a, c] = edges(&stage, towards, distance(b), 10.0);
            let found = 0.5 * (a + c);
            assert!((found / distance(b) - 1.0).abs() < 1e-4, "{beta} {towards} {found} {}", distance(b));
            assert!(c > a);
        }
    }
}

#[test]
fn a_ball_straight_behind_is_a_ring() {
    let stage = behind(0.0);
    let ring = distance(impact(PI));
    for k in 0..60 {
        let [a, c] = edges(&stage, 0.1 * f64::from(k), ring, 10.0);
        assert!((0.5 * (a + c) / ring - 1.0).abs() < 1e-4, "{k} {a} {c} {ring}");
    }
    // Light that went round once more: a thin ring next to the critical curve.
    let second = distance(impact(3.0 * PI));
    for k in 0..8 {
        let [a, c] = edges(&stage, 0.8 * f64::from(k), second, 0.1);
        assert!((0.5 * (a + c) / second - 1.0).abs() < 1e-4 && c - a < 1e-2, "{k} {a} {c} {second}");
    }
}
