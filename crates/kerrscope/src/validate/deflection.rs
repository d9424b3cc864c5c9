//! The bending of light by a hole without spin.

use super::{Check, trace};
use std::f64::consts::PI;

const SOURCE: &str = "Schwarzschild deflection: closed form (Darwin 1959)";

/// Impact parameter b in M, deflection in radians.
const TABLE: [[f64; 2]; 7] = [
    [100.0, 0.041222539749],
    [20.0, 0.236135995],
    [10.0, 0.590395788],
    [8.0, 0.858730018],
    [6.0, 1.719388310],
    [5.3, 3.557938042],
    [5.2, 6.810371957],
];

pub fn checks() -> Vec<Check> {
    TABLE
        .into_iter()
        .map(|[b, expected]| {
            let path = trace(0.0, 90.0, f64::INFINITY, [b, 0.0], 0);
            // Undeflected, the ray leaves half a turn from where it came in.
            let computed = path.direction.map_or(f64::NAN, |[_, phi]| phi - PI);
            Check { name: format!("b = {b}"), source: SOURCE, expected, computed, tolerance: 1e-6 }
        })
        .collect()
}
