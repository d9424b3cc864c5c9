//! The critical curve, found as the edge between captured and escaping rays.

use super::{Check, edge};
use std::f64::consts::TAU;

const SOURCE: &str = "Critical curve: closed form, observer at infinity (Bardeen 1973; Teo 2003)";

/// a, i in degrees, α range, β_max, area.
const TABLE: [[f64; 6]; 4] = [
    [0.5, 60.0, -4.230999, 6.003824, 5.17791, 83.2602],
    [0.9, 17.0, -4.303168, 5.503622, 4.94500, 76.1857],
    [0.9, 60.0, -3.095908, 6.589409, 5.13547, 78.5589],
    [0.99, 60.0, -2.543825, 6.715793, 5.12211, 75.9166],
];

pub fn checks() -> Vec<Check> {
    let mut checks = Vec::new();
    let mut add = |name: String, expected, computed, tolerance| {
        checks.push(Check { name, source: SOURCE, expected, computed, tolerance });
    };
    for [a, i, alpha_min, alpha_max, beta_max, area] in TABLE {
        let name = |what| format!("a = {a}, i = {i}°: {what}");
        add(name("least alpha"), alpha_min, -edge(a, i, [0.0, 0.0], [-1.0, 0.0]), 1e-6);
        add(name("greatest alpha"), alpha_max, edge(a, i, [0.0, 0.0], [1.0, 0.0]), 1e-6);
        // Half a unit of the last digit given.
        add(name("greatest beta"), beta_max, highest(a, i), 5e-6);
        add(name("area"), area, enclosed(a, i, [0.5 * (alpha_min + alpha_max), 0.0]), 5e-5);
    }
    for a in [0.3, 0.9, 0.998] {
        // The top of the edge-on curve, at α = 2a for every spin.
        let top = edge(a, 90.0, [2.0 * a, 0.0], [0.0, 1.0]);
        add(format!("a = {a}, i = 90°: half-height at alpha = 2a"), 27f64.sqrt(), top, 1e-6);
    }
    add("a = 0.9, i = 0°: radius".to_owned(), 4.91606, edge(0.9, 0.0, [0.0, 0.0], [0.6, 0.8]), 5e-6);
    add("a = 1, i = 0°: radius".to_owned(), 2.0 + 8f64.sqrt(), edge(1.0, 0.0, [0.0, 0.0], [0.6, 0.8]), 1e-6);
    checks
}

/// The greatest height of the edge, by golden section.
fn highest(a: f64, i: f64) -> f64 {
    let height = |alpha: f64| edge(a, i, [alpha, 0.0], [0.0, 1.0]);
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (0.0, 4.0 * a);
    // The maximum is flat: a thousandth in α is a millionth in height.
    while high - low > 1e-3 {
        let (left, right) = (high - ratio * (high - low), low + ratio * (high - low));
        if height(left) < height(right) { low = left } else { high = right }
    }
    height(0.5 * (low + high))
}

/// ½∮ρ² dθ about a point inside; the trapezoidal rule converges geometrically.
fn enclosed(a: f64, i: f64, centre: [f64; 2]) -> f64 {
    let count = 96;
    let sum: f64 = (0..count)
        .map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
            edge(a, i, centre, [cos, sin]).powi(2)
        })
        .sum();
    0.5 * sum * TAU / f64::from(count)
}
