//! Sum, place and widths of a picture's light.

/// The moments of order 0, 1 and 2 of a picture.
///
/// ```
/// use kerrscope::measure::Moments;
/// // Two equal dots in a picture of 4 × 2 pixels, each half an M wide.
/// let values = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
/// let moments = Moments::of([4, 2], 0.5, |pixel| values[pixel]).unwrap();
/// assert_eq!((moments.sum, moments.centroid), (2.0, [0.0, 0.25]));
/// // Standard deviations of 0.75 M and 0.
/// assert!((moments.size[0] - 0.75 * 2.3548200450309493).abs() < 1e-12 && moments.size[1] == 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Sum of the values of all pixels.
    pub sum: f64,
    /// Mean place, from the picture's middle, right and up.
    pub centroid: [f64; 2],
    /// Widths along the major and the minor axis: 2√(2 ln 2) standard deviations, which is the
    /// full width at half maximum of a Gaussian.
    pub size: [f64; 2],
}

impl Moments {
    /// The moments of a picture of a width and a height in pixels, whose pixels have the size `pixel` in the unit of the result.
    /// `value` is asked for every pixel along the rows, the top row first; it counts at the pixel's centre, and
    /// none may be negative. `None` for a dark picture, and where values are not finite.
    pub fn of([width, height]: [u32; 2], pixel: f64, value: impl Fn(usize) -> f64) -> Option<Self> {
        let (mut sum, mut first, mut second) = (0.0, [0.0; 2], [0.0; 3]);
        let middle = [0.5 * f64::from(width), 0.5 * f64::from(height)];
        for row in 0..height {
            let y = middle[1] - f64::from(row) - 0.5;
            for column in 0..width {
                let x = f64::from(column) + 0.5 - middle[0];
                let weight = value(row as usize * width as usize + column as usize);
                sum += weight;
                first = [first[0] + weight * x, first[1] + weight * y];
                second = [second[0] + weight * x * x, second[1] + weight * x * y, second[2] + weight * y * y];
            }
        }
        if !(sum > 0.0 && sum.is_finite()) {
            return None;
        }
        let [x, y] = first.map(|f| f / sum);
        let [xx, xy, yy] = [second[0] / sum - x * x, second[1] / sum - x * y, second[2] / sum - y * y];
        // Eigenvalues of the covariance.
        let (mean, half) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
        let width = |variance: f64| (8.0 * 2f64.ln() * variance.max(0.0)).sqrt() * pixel;
        Some(Self { sum, centroid: [x * pixel, y * pixel], size: [width(mean + half), width(mean - half)] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Gaussian, 30 pixels by 12 wide and turned by 25°, has its own widths.
    #[test]
    fn a_gaussian() {
        let (size, [major, minor]) = ([200_u32, 160], [30.0_f64, 12.0]);
        let (sin, cos) = 25_f64.to_radians().sin_cos();
        let value = |pixel: usize| {
            let (column, row) = (pixel % 200, pixel / 200);
            let (x, y) = (column as f64 + 0.5 - 100.0 - 7.0, 80.0 - row as f64 - 0.5 + 4.0);
            let (along, across) = (cos * x + sin * y, cos * y - sin * x);
            (-4.0 * 2f64.ln() * ((along / major).powi(2) + (across / minor).powi(2))).exp()
        };
        let moments = Moments::of(size, 0.1, value).unwrap();
        assert!((moments.centroid[0] - 0.7).abs() < 1e-9 && (moments.centroid[1] + 0.4).abs() < 1e-9);
        assert!((moments.size[0] - 3.0).abs() < 1e-8 && (moments.size[1] - 1.2).abs() < 1e-8, "{moments:?}");
        let area = std::f64::consts::PI / (4.0 * 2f64.ln()) * major * minor;
        assert!((moments.sum / area - 1.0).abs() < 1e-10);
    }

    #[test]
    fn nothing() {
        assert_eq!(Moments::of([3, 2], 1.0, |_| 0.0), None);
        assert_eq!(Moments::of([3, 2], 1.0, |_| f64::NAN), None);
        assert_eq!(Moments::of([3, 2], 1.0, |_| f64::INFINITY), None);
    }
}
