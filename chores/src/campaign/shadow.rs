//! The shadow on pixels against the critical curve.

use kerrscope::spacetime::geodesic::{Fate, Integrator, Path as Ray, Query, Scheme, Tracer};
use kerrscope::spacetime::kerr::CriticalCurve;
use kerrscope::spacetime::metric::Kerr;
use kerrscope::spacetime::observer::impact_ray;
use rayon::prelude::*;
use std::fmt::Write;

/// Pixels along an edge of the screen, and M from its middle to an edge.
const EDGE: u32 = 1024;
const HALF_FIELD: f64 = 9.0;

/// Each of 1024² pixels of the α–β screen is traced from infinity; neighbours of which one is
/// captured and the other is not enclose the boundary. Its distance from the critical curve
/// must nowhere exceed 0.6 pixels, and the curve must nowhere be farther than 1 pixel from such a pair.
pub fn run() -> Result<(bool, String), String> {
    let mut body = String::from(
        "Boundary of the captured pixels on the α–β screen (1024², 18 M across) against the critical curve.\n\n\
         | a | i | captured | width (px) | farthest boundary (px) | farthest curve point (px) |\n|---|---|---|---|---|---|\n",
    );
    let mut passed = true;
    for spin in [0.0, 0.9, 0.998] {
        for degrees in [17.0, 60.0, 90.0] {
            let row = compare(spin, degrees)?;
            passed &= row.boundary <= 0.6 && row.curve <= 1.0 && row.width >= 400.0;
            let _ = writeln!(
                body,
                "| {spin} | {degrees}° | {} | {:.0} | {:.3} | {:.3} |",
                row.captured, row.width, row.boundary, row.curve
            );
        }
    }
    Ok((passed, body))
}

struct Row {
    captured: usize,
    width: f64,
    boundary: f64,
    curve: f64,
}

fn compare(spin: f64, degrees: f64) -> Result<Row, String> {
    let pixel = 2.0 * HALF_FIELD / f64::from(EDGE);
    let place = |k: u32| (f64::from(k) + 0.5) * pixel - HALF_FIELD;
    let tracer = Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-8 }, 10_000);
    let query = Query { max_crossings: 0, ..Query::default() };
    let rows: Result<Vec<Vec<bool>>, String> = (0..EDGE)
        .into_par_iter()
        .map(|j| {
            let mut path = Ray::default();
            let captured = |i: u32, path: &mut Ray| {
                let ray =
                    impact_ray(Some(spin), f64::to_radians(degrees), f64::INFINITY, [place(i), place(j)])
                        .map_err(|e| e.to_string())?;
                tracer.trace(&ray, &query, path);
                Ok(path.fate == Fate::Captured)
            };
            (0..EDGE).map(|i| captured(i, &mut path)).collect()
        })
        .collect();
    let rows = rows?;
    let curve = CriticalCurve::new(spin, degrees.to_radians());
    let points = curve.points(20_000);
    // Midpoints of neighbouring pixels with different fates.
    let mut boundary = Vec::new();
    let different = |i: u32, j: u32, k: u32, l: u32| {
        k < EDGE && l < EDGE && rows[j as usize][i as usize] != rows[l as usize][k as usize]
    };
    for j in 0..EDGE {
        for i in 0..EDGE {
            if different(i, j, i + 1, j) {
                boundary.push([place(i) + 0.5 * pixel, place(j)]);
            }
            if different(i, j, i, j + 1) {
                boundary.push([place(i), place(j) + 0.5 * pixel]);
            }
        }
    }
    let farthest = |from: &[[f64; 2]], to: &[[f64; 2]]| {
        let distance =
            |p: &[f64; 2]| to.iter().map(|q| (p[0] - q[0]).hypot(p[1] - q[1])).fold(f64::INFINITY, f64::min);
        from.par_iter().map(distance).reduce(|| 0.0, f64::max) / pixel
    };
    let extent = curve.extent();
    Ok(Row {
        captured: rows.iter().flatten().filter(|c| **c).count(),
        width: (extent.alpha_max - extent.alpha_min) / pixel,
        boundary: farthest(&boundary, &points),
        curve: farthest(&points, &boundary),
    })
}
