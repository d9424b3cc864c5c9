//! Straight lines of least squares.

use serde::Serialize;

/// A straight line through points: y = intercept + slope x.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// Its slope.
    pub slope: f64,
    /// Standard error of the slope, from the residuals.
    pub slope_error: f64,
    /// Its value at x = 0.
    pub intercept: f64,
    /// Standard error of that.
    pub intercept_error: f64,
    /// The largest distance of a point from it.
    pub largest_residual: f64,
}

impl Fit {
    /// The line of least squares through points; none for fewer than three, or if all x are equal.
    pub fn of(points: &[[f64; 2]]) -> Option<Self> {
        let n = points.len() as f64;
        let [x, y] = points.iter().fold([0.0; 2], |[sx, sy], [x, y]| [sx + x, sy + y]).map(|sum| sum / n);
        let xx: f64 = points.iter().map(|p| (p[0] - x).powi(2)).sum();
        let xy: f64 = points.iter().map(|p| (p[0] - x) * (p[1] - y)).sum();
        if points.len() < 3 || !(xx > 0.0) {
            return None;
        }
        let slope = xy / xx;
        let intercept = y - slope * x;
        let residual = |p: &[f64; 2]| p[1] - intercept - slope * p[0];
        let variance = points.iter().map(|p| residual(p).powi(2)).sum::<f64>() / (n - 2.0);
        Some(Self {
            slope,
            slope_error: (variance / xx).sqrt(),
            intercept,
            intercept_error: (variance * (1.0 / n + x * x / xx)).sqrt(),
            largest_residual: points.iter().map(|p| residual(p).abs()).fold(0.0, f64::max),
        })
    }
}
