//! Circular orbits: photon orbits by tracing, the others from the components of the metric.

use super::{Check, edge, trace};
use crate::spacetime::metric::{Kerr, Metric};
use crate::spacetime::{Dual, Scalar};

const SOURCE: &str = "Circular orbits: Bardeen, Press & Teukolsky 1972, ApJ 178, 347";

/// a, photon orbits, their impact parameters, ISCO (about +z, about −z), efficiency.
const TABLE: [[f64; 8]; 5] = [
    [0.0, 3.0, 3.0, 5.19615242271, 5.19615242271, 6.0, 6.0, 0.05719096],
    [
        0.5,
        2.34729635533,
        3.53208888624,
        4.09626665871,
        6.13815572472,
        4.23300252953,
        7.55458471451,
        0.08211799,
    ],
    [
        0.9,
        1.55785462742,
        3.9102679391,
        2.84442140348,
        6.83231923045,
        2.32088304176,
        8.71735227961,
        0.15575299,
    ],
    [
        0.99,
        1.16764185186,
        3.99110286109,
        2.2517243354,
        6.9833234311,
        1.45449793806,
        8.97186134255,
        0.26403010,
    ],
    [
        0.998,
        1.07390925768,
        3.99822189285,
        2.11088779455,
        6.9966662714,
        1.23697065518,
        8.9943744548,
        0.32099417,
    ],
];

pub fn checks() -> Vec<Check> {
    let mut checks = Vec::new();
    for [a, photon_p, photon_r, impact_p, impact_r, isco_p, isco_r, efficiency] in TABLE {
        let mut add = |what: &str, expected, computed| {
            checks.push(Check {
                name: format!("a = {a}: {what}"),
                source: SOURCE,
                expected,
                computed,
                tolerance: 1e-6,
            });
        };
        // Edge-on in the plane, light about +z arrives from the left (α < 0).
        let left = edge(a, 90.0, [0.0, 0.0], [-1.0, 0.0]);
        let right = edge(a, 90.0, [0.0, 0.0], [1.0, 0.0]);
        add("impact parameter of the photon orbit about +z", impact_p, left);
        add("impact parameter of the photon orbit about -z", impact_r, right);
        add("photon orbit about +z", photon_p, closest(a, -left));
        add("photon orbit about -z", photon_r, closest(a, right));
        let (radius, energy) = last_stable(a, 1.0);
        add("last stable orbit about +z", isco_p, radius);
        add("last stable orbit about -z", isco_r, last_stable(a, -1.0).0);
        add("efficiency", efficiency, 1.0 - energy);
    }
    checks
}

/// Closest approach of the ray that just escapes: the photon orbit, to the square root of the
/// relative offset from the edge.
fn closest(spin: f64, alpha: f64) -> f64 {
    let path = trace(spin, 90.0, f64::INFINITY, [alpha * (1.0 + 4e-15), 0.0], 20_001);
    let metric = Kerr::new(-spin);
    path.points.iter().map(|[_, x, y, z]| metric.radius(&[*x, *y, *z])).fold(f64::INFINITY, f64::min)
}

/// Radius and energy where the energy of circular orbits is least, from g_tt, g_tφ, g_φφ alone:
/// Ω = [−g_tφ′ ± √(g_tφ′² − g_tt′ g_φφ′)]/g_φφ′, E = −(g_tt + g_tφ Ω)/√(−g_tt − 2g_tφΩ − g_φφΩ²).
fn last_stable(spin: f64, sense: f64) -> (f64, f64) {
    let metric = Kerr::new(spin);
    let slope = |r: f64| energy(metric, Dual::variable([r], 0), sense).gradient[0];
    // Stable orbits have dE/dr > 0; inwards of the last one no circular orbit need exist (NaN).
    let (mut inside, mut outside) = (1.0 + (1.0 - spin * spin).sqrt(), 20.0);
    for _ in 0..100 {
        let middle = 0.5 * (inside + outside);
        if slope(middle) > 0.0 { outside = middle } else { inside = middle }
    }
    (outside, energy(metric, Dual::variable([outside], 0), sense).value)
}

fn energy(metric: Kerr, r: Dual<f64, 1>, sense: f64) -> Dual<f64, 1> {
    // g_tt, g_tφ, g_φφ in the plane, with two derivatives by nesting duals.
    let parts = |r: Dual<Dual<f64, 1>, 1>| {
        let s = metric.spin();
        // x + iy = (r + is): φ̃ = 0.
        let g = metric.components(&[r, r.constant(s), r.constant(0.0)]);
        // ∂φ = (−y, x, 0).
        let around = [r.constant(0.0), r.constant(-s), r];
        let mixed = g[0][1] * around[1] + g[0][2] * around[2];
        let turning = g[1][1] * around[1] * around[1]
            + g[1][2] * around[1] * around[2] * 2.0
            + g[2][2] * around[2] * around[2];
        (g[0][0], mixed, turning)
    };
    let (tt, tp, pp) = parts(Dual { value: r, gradient: [r.constant(1.0)] });
    let (d_tt, d_tp, d_pp) = (tt.gradient[0], tp.gradient[0], pp.gradient[0]);
    let root = (d_tp * d_tp - d_tt * d_pp).sqrt() * sense;
    let rate = (root - d_tp) / d_pp;
    let (tt, tp, pp) = (tt.value, tp.value, pp.value);
    let norm = -(tt + tp * rate * 2.0 + pp * rate * rate);
    -(tt + tp * rate) / norm.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spacetime::kerr::Orbits;

    #[test]
    fn the_closed_forms_give_the_published_table() {
        for [a, photon_p, photon_r, impact_p, impact_r, isco_p, isco_r, efficiency] in TABLE {
            let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-10, "a = {a}: {x} is not {y}");
            let o = Orbits::new(a);
            near(o.photon_prograde, photon_p);
            near(o.photon_retrograde, photon_r);
            near(o.impact_prograde, impact_p);
            near(o.impact_retrograde, impact_r);
            near(o.isco, isco_p);
            near(o.isco_retrograde, isco_r);
            assert!((o.efficiency - efficiency).abs() < 1e-8, "efficiency at a = {a}");
            // About +z and about −z change places with the sign of the spin.
            let mirrored = Orbits::new(-a);
            near(mirrored.isco, o.isco_retrograde);
            near(mirrored.photon_prograde, o.photon_retrograde);
            near(mirrored.impact_retrograde, o.impact_prograde);
        }
    }
}
