//! Thin disks: the flux, where rings are seen and how their light is shifted, and the edges of lines.
//!
//! The flux is the integral over the orbits that follow from the metric's components; rings are found by tracing rays until one
//! meets the radius; the shift is that of momentum and four-velocity at the end of the ray.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Check;
use crate::line::{Emissivity, Isoradials, Line, Screen, tracer};
use crate::spacetime::emitter::{Circular, Sense};
use crate::spacetime::geodesic::Tracer;
use crate::spacetime::metric::{Components, Kerr, Metric};
use crate::spacetime::tensor::product;

const FLUX: &str = "Page-Thorne flux: closed form (Page & Thorne 1974)";
const RINGS: &str = "Isoradials of a = 0: closed form (Luminet 1979)";
const EDGES: &str = "Line profile edges, direct image: closed form";

/// a (below 0 where the matter goes against the hole), r, 4πF/Ṁ.
const FLUXES: [[f64; 3]; 10] = [
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

/// a, radius of the largest flux.
const PEAKS: [[f64; 2]; 4] = [[0.0, 9.550928], [0.5, 6.615088], [0.9, 3.441843], [0.998, 1.581185]];

/// Image order; b at the near side, at 90° and at the far side of r = 6, a = 0, i = 60°.
const ISORADIALS: [(usize, [f64; 3]); 2] =
    [(0, [3.03571437, 6.93214848, 7.03908299]), (1, [5.29373481, 5.47891372, 6.00012754])];

/// a, i in degrees, outer radius, least and largest g from the last stable orbit outwards.
const LINES: [[f64; 5]; 2] =
    [[0.5, 30.0, 15.0, 0.467346, 1.037756], [0.998, 40.0, 400.0, 0.052336, 1.086857]];

pub fn checks() -> Vec<Check> {
    let mut checks = Vec::new();
    for [a, r, expected] in FLUXES {
        let flux = disk(a, 2.0 * r).map_or(f64::NAN, |disk| 4.0 * PI * disk.flux(r));
        let digits = if a == 0.998 { 1e-7 } else { 0.0 };
        checks.push(Check {
            name: format!("a = {a}: flux of a disk at r = {r}, 4πF/Ṁ"),
            source: FLUX,
            expected,
            computed: flux,
            tolerance: expected * 1e-6_f64.max(digits),
        });
    }
    for [a, expected] in PEAKS {
        let computed = disk(a, 30.0).map_or(f64::NAN, |disk| peak(&disk));
        let name = format!("a = {a}: radius of the largest flux of a disk");
        checks.push(Check { name, source: FLUX, expected, computed, tolerance: 1e-6 });
    }
    let engine = tracer(0.0, true);
    for (order, distances) in ISORADIALS {
        // Below the hole is the near side of the direct image, and the far side of the next.
        for (side, (name, expected)) in
            ["the near side", "90°", "the far side"].into_iter().zip(distances).enumerate()
        {
            let below = if order == 0 { -FRAC_PI_2 } else { FRAC_PI_2 };
            let angle = [below, 0.0, -below][side];
            let (computed, _) = ring(&*engine, order, angle);
            let name = format!("r = 6 seen from i = 60°, order {order}, b at {name}");
            checks.push(Check { name, source: RINGS, expected, computed, tolerance: 1e-6 });
        }
    }
    for (side, angle, expected) in [("approaching", PI, 1.1954079), ("receding", 0.0, 0.5020351)] {
        let (_, computed) = ring(&*engine, 0, angle);
        let name = format!("r = 6 seen from i = 60°: g at 90°, {side}");
        checks.push(Check { name, source: RINGS, expected, computed, tolerance: 1e-6 });
    }
    for [spin, degrees, outer, low, high] in LINES {
        let line = Line {
            spin,
            inclination: degrees.to_radians(),
            inner: Line::isco(spin),
            outer,
            emissivity: Emissivity::Power(3.0),
            orders: vec![0],
        };
        let edges =
            line.profile(&*tracer(spin, true), 1, None).map_or([f64::NAN; 2], |profile| profile.edges);
        for (name, expected, computed) in [("least", low, edges[0]), ("largest", high, edges[1])] {
            let name = format!("a = {spin}, i = {degrees}°, disk out to {outer}: {name} g");
            checks.push(Check { name, source: EDGES, expected, computed, tolerance: 1e-3 });
        }
    }
    checks
}

/// The disk of a hole of which nothing but the metric's components is used.
fn disk(spin: f64, outer: f64) -> Option<Circular> {
    let (spin, sense) = if spin < 0.0 { (-spin, Sense::Retrograde) } else { (spin, Sense::Prograde) };
    Circular::of(&Components(Kerr::new(spin)), sense, outer).ok()
}

/// Where the flux is largest: where it is as large a little within as a little without.
fn peak(disk: &Circular) -> f64 {
    let isco = disk.isco().unwrap_or(f64::NAN);
    let (mut low, mut high) = (isco, 20.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let step = 1e-4 * (middle - isco).min(1.0);
        if disk.flux(middle + step) > disk.flux(middle - step) { low = middle } else { high = middle }
    }
    low
}

/// b of the ray without spin that meets r = 6 in a direction on the screen, and g of matter in orbit there: −1/(u·p) from the
/// components, in the coordinates of Kerr and Schild, of the photon's λ alone, u = u^t(∂t + Ω∂φ), r³Ω² = 1.
fn ring(tracer: &dyn Tracer, order: usize, angle: f64) -> (f64, f64) {
    let inclination = 60f64.to_radians();
    let screen = Screen { spin: 0.0, inclination };
    let found = Isoradials { tracer, screen, order }.along(&[6.0], &[angle]);
    let Some(point) = found[0] else { return (f64::NAN, f64::NAN) };
    let [alpha, _] = screen.place(point.distance, angle);
    let [x, y, z] = point.crossing.position;
    let rate = 6f64.powf(-1.5);
    let along = [1.0, -rate * y, rate * x, 0.0];
    let time = (-product(&Kerr::new(0.0).components(&[x, y, z]), &along, &along)).sqrt().recip();
    (point.distance, (time * (1.0 + rate * alpha * inclination.sin())).recip())
}
