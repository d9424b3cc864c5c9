//! Where rays first cross the equatorial plane.

use super::{Check, trace};
use std::f64::consts::TAU;

const KERRZ: &str = "Equatorial crossings: kerrz 0.4.1 (closed form), observer at r = 1000";
const KGEO: &str = "Equatorial crossings: kgeo and ipole (published), observer at r = 1000";
const VECTOR: &str = "Equatorial crossing, observer at infinity: closed form";

/// a, i in degrees, α, β, x, y with x + iy = r e^{iφ}.
const PUBLISHED: [[f64; 6]; 4] = [
    [0.42, 60.0, -17.0, 0.0, -0.0522336, -16.0342],
    [0.42, 60.0, 8.0, 0.0, 0.129720, 6.94829],
    [0.9, 10.0, -12.0, 0.0, -0.164094, -11.0082],
    [0.73, 35.0, 1e-4, -10.0, 11.8258, -0.0858775],
];

pub fn checks() -> Vec<Check> {
    let mut checks = Vec::new();
    for [a, i, alpha, beta, r, phi] in reference() {
        let name = |what| format!("a = {a}, i = {i}°, ({alpha:.3}, {beta:.3}): {what}");
        let (found_r, found_phi) = first(a, i, 1000.0, [alpha, beta]);
        let mut add = |what, expected, computed, tolerance| {
            checks.push(Check { name: name(what), source: KERRZ, expected, computed, tolerance });
        };
        add("r", r, found_r, 1e-5 * r);
        add("phi", phi, found_phi.rem_euclid(TAU), 1e-5);
    }
    for [a, i, alpha, beta, x, y] in PUBLISHED {
        let (r, phi) = first(a, i, 1000.0, [alpha, beta]);
        for (what, expected, computed) in [("x", x, r * phi.cos()), ("y", y, r * phi.sin())] {
            // Six digits are given.
            let tolerance = (0.5 * 10f64.powf(expected.abs().log10().floor() - 5.0)).max(1e-7);
            let name = format!("a = {a}, i = {i}°, ({alpha}, {beta}): {what}");
            checks.push(Check { name, source: KGEO, expected, computed, tolerance });
        }
    }
    // λ = 4 of the reversed photon is −4 of the physical one, so α = 4/sin i; η = 30, β < 0.
    let (a, i) = (0.9, 1f64);
    let alpha = 4.0 / i.sin();
    let beta = -(30.0 - (alpha * alpha - a * a) * i.cos().powi(2)).sqrt();
    let (r, phi) = first(a, i.to_degrees(), f64::INFINITY, [alpha, beta]);
    for (what, expected, computed) in [("r", 9.966537978, r), ("phi", 0.474082717, phi)] {
        let name = format!("a = 0.9, i = 1 rad, λ = -4, η = 30: {what}");
        checks.push(Check { name, source: VECTOR, expected, computed, tolerance: 1e-9 });
    }
    checks
}

fn first(a: f64, i: f64, r: f64, impact: [f64; 2]) -> (f64, f64) {
    trace(a, i, r, impact, 0).crossings.first().map_or((f64::NAN, f64::NAN), |c| (c.r, c.phi))
}

/// Rows of spin, inclination, α, β, r, φ.
fn reference() -> Vec<[f64; 6]> {
    let text = include_str!("equatorial_crossings.json");
    let table: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
    let rows = table["rows"].as_array().map_or(&[][..], Vec::as_slice);
    let number = |row: &serde_json::Value, key: &str| row[key].as_f64().unwrap_or(f64::NAN);
    rows.iter()
        .map(|row| ["spin", "inclination", "alpha", "beta", "r", "phi"].map(|key| number(row, key)))
        .collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_whole_table_is_read() {
        let rows = super::reference();
        assert_eq!(rows.len(), 60);
        assert!(rows.iter().flatten().all(|x| x.is_finite()));
    }
}
