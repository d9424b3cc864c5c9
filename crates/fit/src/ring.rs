//! A blurred ring on the sky, brighter on one side: the m-ring of first order.
//!
//! A ring without width, of radius R and brightness 1 + A cos(φ − φ₀), convolved with a Gaussian of standard deviation s (Johnson et al.
//! 2020, Sci. Adv. 6, eaaz1310; EHT 2022, ApJL 930, L15, §4.2), at the distance ρ from its centre:
//!
//! ```text
//! I ∝ exp(−(ρ − R)²/2s²) [Î₀(x) + A cos(φ − φ₀) Î₁(x)]/s²,   x = ρR/s²,   Î(x) = e^{−x} I(x).
//! ```
//!
//! I₀ and I₁ are modified Bessel functions.

use crate::blur::FWHM;
use crate::model::{Cancelled, Freedom, Parameter, Prediction, Source, Unpredictable};
use crate::prior::Prior;

/// The model; it has no settings.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ring;

/// Places and weights in a pixel of Gauss's quadrature with three nodes.
const NODES: [(f64, f64); 3] =
    [(-0.387_298_334_620_741_7, 5.0 / 18.0), (0.0, 8.0 / 18.0), (0.387_298_334_620_741_7, 5.0 / 18.0)];

/// e^{−x} I₀(x) and e^{−x} I₁(x), x ≥ 0: power series up to x = 30 (Abramowitz & Stegun 1964, 9.6.10), asymptotic beyond (9.7.1).
pub fn bessel(x: f64) -> [f64; 2] {
    if x <= 30.0 {
        let quarter = 0.25 * x * x;
        let (mut term, mut zero, mut one) = (1.0, 1.0, 1.0);
        let mut k = 0.0;
        while term > 1e-17 * zero {
            k += 1.0;
            term *= quarter / (k * k);
            zero += term;
            one += term / (k + 1.0);
        }
        let fade = (-x).exp();
        return [zero * fade, 0.5 * x * one * fade];
    }
    let root = (std::f64::consts::TAU * x).sqrt().recip();
    let series = |order: f64| {
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..14 {
            let odd = f64::from(2 * k - 1);
            term *= -(4.0 * order * order - odd * odd) / (8.0 * x * f64::from(k));
            sum += term;
        }
        sum * root
    };
    [series(0.0), series(1.0)]
}

impl Source for Ring {
    fn parameters(&self) -> Vec<Parameter> {
        let lengths = Freedom::Free(Prior::LogUniform(0.1, 1e4));
        let place = Freedom::Free(Prior::Uniform(-1e4, 1e4));
        let parameter = |name, unit: &'static str, meaning, bounds, usual| {
            let pixels = i32::from(unit == "px");
            Parameter { name, unit, meaning, bounds, pixels, usual }
        };
        vec![
            parameter("diameter", "px", "of the ring before it is blurred", [0.1, 1e4], lengths),
            parameter("width", "px", "full width at half maximum of its blur", [0.1, 1e4], lengths),
            parameter(
                "asymmetry",
                "",
                "A: brightness 1 + A cos of the angle from the brightest side",
                [0.0, 1.0],
                Freedom::Free(Prior::Uniform(0.0, 1.0)),
            ),
            parameter(
                "position_angle",
                "deg",
                "of the brightest side, East of North: anticlockwise from up",
                [0.0, 360.0],
                Freedom::Free(Prior::Uniform(0.0, 360.0)),
            ),
            parameter(
                "center_x",
                "px",
                "of the ring, to the right of the picture's middle",
                [-1e4, 1e4],
                place,
            ),
            parameter("center_y", "px", "the same, up", [-1e4, 1e4], place),
        ]
    }

    fn draw(
        &self,
        values: &[f64],
        [width, height]: [usize; 2],
        derivatives: bool,
    ) -> Result<Prediction, Unpredictable> {
        let [diameter, fwhm, asymmetry, angle, center_x, center_y] = values[..] else {
            return Err(Unpredictable("too few parameters".to_owned()));
        };
        let (radius, s) = (0.5 * diameter, fwhm / FWHM);
        let (sin, cos) = angle.to_radians().sin_cos();
        let count = width * height;
        let mut prediction = Prediction { values: Vec::with_capacity(count), derivatives: Vec::new() };
        let mut slopes = vec![vec![0.0; if derivatives { count } else { 0 }]; 6];
        for pixel in 0..count {
            let mut sum = 0.0;
            for (across, weight_x) in NODES {
                for (down, weight_y) in NODES {
                    let weight = weight_x * weight_y;
                    let x = (pixel % width) as f64 + 0.5 + across - 0.5 * width as f64 - center_x;
                    let y = 0.5 * height as f64 - (pixel / width) as f64 - 0.5 - down - center_y;
                    let rho = x.hypot(y).max(1e-12);
                    let t = rho * radius / (s * s);
                    let [zero, one] = bessel(t);
                    // Towards the brightest side: up turned anticlockwise.
                    let along = -x * sin + y * cos;
                    let side = along / rho;
                    let fade = weight * (-0.5 * ((rho - radius) / s).powi(2)).exp() / (s * s);
                    let shape = zero + asymmetry * side * one;
                    sum += fade * shape;
                    if !derivatives {
                        continue;
                    }
                    // Î₀′ = Î₁ − Î₀, Î₁′ = Î₀ − Î₁(1 + 1/x); Î₁/x → ½.
                    let per = if t > 1e-8 { one / t } else { 0.5 };
                    let [zero_t, one_t] = [one - zero, zero - one - per];
                    let by_t = zero_t + asymmetry * side * one_t;
                    let by_rho = fade * (shape * (radius - rho) / (s * s) + by_t * radius / (s * s));
                    let by_radius = fade * (shape * (rho - radius) / (s * s) + by_t * rho / (s * s));
                    let by_s =
                        fade * (shape * ((rho - radius).powi(2) / s.powi(3) - 2.0 / s) - by_t * 2.0 * t / s);
                    let by_side = fade * asymmetry * one;
                    slopes[0][pixel] += 0.5 * by_radius;
                    slopes[1][pixel] += by_s / FWHM;
                    slopes[2][pixel] += fade * side * one;
                    slopes[3][pixel] += by_side * (-x * cos - y * sin) / rho * 1f64.to_radians();
                    // The centre moves: x and y the other way.
                    slopes[4][pixel] -= by_rho * x / rho + by_side * (-sin - side * x / rho) / rho;
                    slopes[5][pixel] -= by_rho * y / rho + by_side * (cos - side * y / rho) / rho;
                }
            }
            prediction.values.push(sum);
        }
        if derivatives {
            prediction.derivatives = slopes;
        }
        Ok(prediction)
    }

    fn starts(&self, values: &[f64], [width, height]: [usize; 2], _: Cancelled<'_>) -> Vec<Vec<f64>> {
        let floor = values.iter().copied().fold(f64::INFINITY, f64::min).max(0.0);
        let (mut sum, mut place) = (0.0, [0.0; 2]);
        let at = |pixel: usize| {
            [
                (pixel % width) as f64 + 0.5 - 0.5 * width as f64,
                0.5 * height as f64 - (pixel / width) as f64 - 0.5,
            ]
        };
        for (pixel, value) in values.iter().enumerate() {
            let weight = (value - floor).max(0.0);
            let [x, y] = at(pixel);
            (sum, place) = (sum + weight, [place[0] + weight * x, place[1] + weight * y]);
        }
        let place = place.map(|p| p / sum);
        let mut square = 0.0;
        for (pixel, value) in values.iter().enumerate() {
            let [x, y] = at(pixel);
            square += (value - floor).max(0.0) * ((x - place[0]).powi(2) + (y - place[1]).powi(2)) / sum;
        }
        // ⟨ρ²⟩ = R² + 2s², in several shares.
        let spread = square.sqrt();
        let mut starts = Vec::new();
        for share in [0.95_f64, 0.8, 0.5] {
            for angle in [0.0, 90.0, 180.0, 270.0] {
                let fwhm = (1.0 - share * share).sqrt() * spread / 2f64.sqrt() * FWHM;
                starts.push(vec![2.0 * share * spread, fwhm, 0.3, angle, place[0], place[1]]);
            }
        }
        starts
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// I₀ and I₁ at known places (Abramowitz & Stegun 1964, table 9.8), and where the ways to compute them meet.
    #[test]
    fn bessel_functions() {
        let [zero, one] = bessel(1.0);
        assert!(
            (zero - 0.465_759_607_593_640_4).abs() < 1e-15 && (one - 0.207_910_415_349_708_45).abs() < 1e-15
        );
        let (low, high) = (bessel(30.0), bessel(30.0 + 1e-9));
        assert!((0..2).all(|k| (low[k] - high[k]).abs() < 1e-11));
    }

    /// Derivatives are differences.
    #[test]
    fn derivatives_are_differences() {
        let values = [14.0, 6.0, 0.4, 130.0, 1.2, -0.7];
        let size = [32, 30];
        let found = Ring.draw(&values, size, true).unwrap();
        for k in 0..6 {
            let moved = |sign: f64| {
                let mut values = values;
                values[k] += sign * 1e-4;
                Ring.draw(&values, size, false).unwrap().values
            };
            let (high, low) = (moved(1.0), moved(-1.0));
            let most = found.derivatives[k].iter().fold(0.0_f64, |most, d| most.max(d.abs()));
            for pixel in 0..high.len() {
                let difference = (high[pixel] - low[pixel]) / 2e-4;
                assert!((found.derivatives[k][pixel] - difference).abs() < 1e-6 * most, "{k} {pixel}");
            }
        }
    }
}
