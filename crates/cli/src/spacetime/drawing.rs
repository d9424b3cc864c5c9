//! A geodesic as SVG: seen along the axis across which it extends least.

use super::Context;
use kerrscope::spacetime::geometry::{Geometry, Nature, Point};
use std::fmt::Write;

const SIZE: f64 = 720.0;
const MARGIN: f64 = 36.0;

/// The picture of points; a sphere is drawn where a radius begins above zero, as at a horizon.
pub fn draw<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    points: &[Point<N>],
    title: &str,
) -> String {
    let places: Vec<[f64; 3]> = points.iter().map(|p| context.geometry.picture(&p.x)).collect();
    let core = context
        .coordinates
        .iter()
        .find(|c| c.nature == Nature::Length && c.range[0] > 0.0 && c.range[0].is_finite())
        .map_or(0.0, |c| c.range[0]);
    let span = |k: usize| {
        let along = places.iter().map(|p| p[k]).filter(|c| c.is_finite());
        let low = along.clone().fold(f64::INFINITY, f64::min);
        let high = along.fold(f64::NEG_INFINITY, f64::max);
        if low <= high { [low, high] } else { [0.0, 0.0] }
    };
    let spans = [span(0), span(1), span(2)];
    let least = (0..3).rev().min_by(|a, b| {
        let width = |k: usize| spans[k][1] - spans[k][0];
        width(*a).total_cmp(&width(*b))
    });
    let [across, up] = match least {
        Some(0) => [1, 2],
        Some(1) => [0, 2],
        _ => [0, 1],
    };
    let with_core = |k: usize| [spans[k][0].min(-1.2 * core), spans[k][1].max(1.2 * core)];
    let ([left, right], [low, high]) = (with_core(across), with_core(up));
    let extent = (right - left).max(high - low);
    let scale = if extent > 0.0 { (SIZE - 2.0 * MARGIN) / extent } else { 1.0 };
    let place = |x: f64, y: f64| {
        (0.5 * SIZE + (x - 0.5 * (left + right)) * scale, 0.5 * SIZE - (y - 0.5 * (low + high)) * scale)
    };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\" font-family=\"sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    if core > 0.0 {
        let (x, y) = place(0.0, 0.0);
        let _ =
            writeln!(svg, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\" fill=\"#000\"/>", core * scale);
    }
    let line: Vec<String> = places
        .iter()
        .filter(|p| p.iter().all(|c| c.is_finite()))
        .map(|p| {
            let (x, y) = place(p[across], p[up]);
            format!("{x:.2},{y:.2}")
        })
        .collect();
    let _ = writeln!(
        svg,
        "<polyline points=\"{}\" fill=\"none\" stroke=\"#205090\" stroke-width=\"1.5\" stroke-linejoin=\"round\"/>",
        line.join(" ")
    );
    if let Some(p) = places.first() {
        let (x, y) = place(p[across], p[up]);
        let _ = writeln!(
            svg,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"5\" fill=\"#fff\" stroke=\"#205090\" stroke-width=\"2\"/>"
        );
    }
    let axes = ["x", "y", "z"];
    let unit = if extent > 0.0 { 10f64.powf((extent / 4.0).log10().floor()) } else { 1.0 };
    let _ = write!(
        svg,
        "<path d=\"M{MARGIN} {0:.2}h{1:.2}\" stroke=\"#000\" stroke-width=\"2\"/>\n\
         <text x=\"{MARGIN}\" y=\"{2:.2}\" font-size=\"13\">{unit}; {3} to the right, {4} up</text>\n\
         <text x=\"{MARGIN}\" y=\"22\" font-size=\"14\">{title}</text>\n</svg>",
        SIZE - 14.0,
        unit * scale,
        SIZE - 20.0,
        axes[across],
        axes[up],
    );
    svg
}
