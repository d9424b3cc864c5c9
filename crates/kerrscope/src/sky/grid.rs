//! Lines of latitude and longitude on the sky.

use std::f64::consts::{FRAC_PI_2, PI};

use super::angles;
use crate::light::Light;
use crate::spacetime::tensor::Vec3;

/// Width of an ordinary line, as an angle on the sky: 0.4°.
const WIDTH: f64 = 0.4 * PI / 180.0;

/// How much wider the equator and the meridian `phi` = 0 are.
const EMPHASIS: f64 = 2.5;

/// Share of a line's width over which each of its edges fades.
const SOFTNESS: f64 = 0.35;

/// Brightness of the ordinary lines as a share of the emphasised ones.
const ORDINARY: f64 = 0.4;

/// Linear light between the lines: north with 0 ≤ `phi` < π, north with π ≤ `phi` < 2π,
/// then south likewise: blue and amber, green and magenta. Each has luminance 0.005.
const TINTS: [[f64; 3]; 4] = [
    [0.0025, 0.00425, 0.0200],
    [0.0120, 0.00325, 0.00075],
    [0.0010, 0.00625, 0.0025],
    [0.01125, 0.00225, 0.01375],
];

/// Lines of latitude and longitude. They show how light bends: a round hole in front of
/// them gives the picture known from textbooks.
///
/// Lines have a constant width on the sky and soft edges. The equator and the meridian
/// `phi` = 0 are wider and brighter. The four parts that the equator and the meridians 0
/// and π cut out are tinted, so that a mirrored or a second image can be told from the
/// first.
///
/// ```
/// use kerrscope::light::Light;
/// use kerrscope::sky::{Grid, towards};
/// use std::f64::consts::FRAC_PI_2;
/// let grid = Grid::new(15_f64.to_radians(), Light::new([0.8; 3]), 1.0);
/// // On the equator one sees the line; between the lines only the tint.
/// assert_eq!(grid.radiance(towards(FRAC_PI_2, 1.0)).rgb, [0.8; 3]);
/// assert!(grid.radiance(towards(1.44, 1.44)).rgb[0] < 0.1);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Angle between meridians: divides π.
    step_phi: f64,
    /// Angle between parallels: divides π/2.
    step_theta: f64,
    lines: Light,
    brightness: f64,
}

impl Grid {
    /// Lines every `spacing` radians in the colour `lines`; `brightness` is a factor on
    /// lines and tints.
    ///
    /// The spacing is rounded so that whole numbers of lines go around and from the
    /// equator to the poles. Outside 1° to 90° it is brought to the nearer of the two,
    /// and taken as 15° if it is not a number.
    pub fn new(spacing: f64, lines: Light, brightness: f64) -> Self {
        let spacing = if spacing.is_nan() { 15_f64.to_radians() } else { spacing };
        let spacing = spacing.clamp(1_f64.to_radians(), FRAC_PI_2);
        Self {
            step_phi: PI / (PI / spacing).round(),
            step_theta: FRAC_PI_2 / (FRAC_PI_2 / spacing).round(),
            lines,
            brightness,
        }
    }

    /// The light that comes from a direction.
    pub fn radiance(&self, n: Vec3<f64>) -> Light {
        let [theta, phi] = angles(n);
        let (sin, latitude) = (theta.sin(), FRAC_PI_2 - theta);

        // Angle to the great circle of a meridian: asin(sin theta · |sin(phi − phi₀)|).
        // It is the true angle, so the meridians keep their width up to the poles, where
        // they merge.
        let to_meridian = |offset: f64| (sin * offset.sin().abs()).asin();
        let to_parallel = latitude - self.step_theta * (latitude / self.step_theta).round();
        let to_zero = if phi.cos() > 0.0 { to_meridian(phi) } else { FRAC_PI_2 - latitude.abs() };
        let offset = phi - self.step_phi * (phi / self.step_phi).round();

        let ordinary = cover(to_meridian(offset), WIDTH).max(cover(to_parallel, WIDTH));
        let main = cover(to_zero, EMPHASIS * WIDTH).max(cover(latitude, EMPHASIS * WIDTH));

        let side = usize::from(phi.sin() < 0.0);
        let tint = TINTS[side + if latitude < 0.0 { 2 } else { 0 }];
        let under = over(Light::new(tint), self.lines * ORDINARY, ordinary);
        over(under, self.lines, main) * self.brightness
    }
}

/// How much of a line of a width covers a place at an angle from its middle.
fn cover(angle: f64, width: f64) -> f64 {
    let t = ((0.5 * width - angle.abs()) / (SOFTNESS * width)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn over(below: Light, above: Light, share: f64) -> Light {
    below * (1.0 - share) + above * share
}
