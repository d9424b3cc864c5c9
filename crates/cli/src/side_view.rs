//! A ray seen from the side, as SVG: in the manner of the thesis's figure 4.4.
//!
//! The view is along the horizontal direction at right angles to the camera's: distance from the
//! axis in the camera's direction to the right, z up. In these coordinates (Kerr–Schild) the
//! horizon is an ellipsoid with half-axes √(2r₊) across and r₊ along z (M = 1).

use kerrscope::spacetime::geodesic::Path;
use std::fmt::Write;

const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 560.0;
const MARGIN: f64 = 24.0;

/// The picture of a path's points around a hole of outer horizon `horizon` (0 for none).
pub fn draw(path: &Path, horizon: f64, title: &str) -> String {
    // The camera's azimuth.
    let (cos, sin) = path.points.first().map_or((1.0, 0.0), |[_, x, y, _]| {
        let width = x.hypot(*y);
        if width > 0.0 { (x / width, y / width) } else { (1.0, 0.0) }
    });
    let across = |x: f64, y: f64| x * cos + y * sin;
    let points: Vec<[f64; 2]> = path.points.iter().map(|[_, x, y, z]| [across(*x, *y), *z]).collect();
    let reach = horizon.max(1.0) * 1.5;
    let span = |k: usize| {
        let ends = points.iter().map(|p| p[k]);
        (ends.clone().fold(-reach, f64::min), ends.fold(reach, f64::max))
    };
    let ((left, right), (low, high)) = (span(0), span(1));
    let scale = ((WIDTH - 2.0 * MARGIN) / (right - left)).min((HEIGHT - 3.0 * MARGIN) / (high - low));
    let place = |x: f64, z: f64| {
        (0.5 * WIDTH + (x - 0.5 * (left + right)) * scale, 0.5 * HEIGHT - (z - 0.5 * (low + high)) * scale)
    };
    let mut svg = String::new();
    let (x0, y0) = place(0.0, 0.0);
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <path d=\"M{MARGIN} {y0:.2}H{:.2}\" stroke=\"#d08030\" stroke-width=\"2\"/>\n\
         <ellipse cx=\"{x0:.2}\" cy=\"{y0:.2}\" rx=\"{:.2}\" ry=\"{:.2}\" fill=\"#000\"/>\n",
        WIDTH - MARGIN,
        // r₊² + a² = 2r₊.
        (2.0 * horizon).sqrt() * scale,
        horizon * scale
    );
    let line: Vec<String> = points
        .iter()
        .map(|[x, z]| {
            let (x, y) = place(*x, *z);
            format!("{x:.2},{y:.2}")
        })
        .collect();
    let _ = writeln!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#205090\" stroke-width=\"1.5\" stroke-linejoin=\"round\"/>",
        line.join(" ")
    );
    for crossing in &path.crossings {
        let (x, y) = place(across(crossing.position[0], crossing.position[1]), crossing.position[2]);
        if (0.0..=WIDTH).contains(&x) && (0.0..=HEIGHT).contains(&y) {
            let _ = writeln!(svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"4\" fill=\"#c02020\"/>");
        }
    }
    if let Some([x, z]) = points.first() {
        let (x, y) = place(*x, *z);
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"5\" fill=\"#fff\" stroke=\"#205090\" stroke-width=\"2\"/>"
        );
    }
    let unit = 10f64.powf(((right - left) / 4.0).log10().floor());
    let _ = write!(
        svg,
        "<path d=\"M{MARGIN} {0:.2}h{1:.2}\" stroke=\"#000\" stroke-width=\"2\"/>\n\
         <text x=\"{MARGIN}\" y=\"{2:.2}\" font-size=\"14\">{unit} M</text>\n\
         <text x=\"{MARGIN}\" y=\"{MARGIN}\" font-size=\"15\">{title}</text>\n</svg>",
        HEIGHT - MARGIN,
        unit * scale,
        HEIGHT - MARGIN - 8.0
    );
    svg
}
