//! Colour maps: what colour stands for a number from 0 to 1.

use colorous::Gradient;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

use super::srgb;

/// The colour of "no value": a dark neutral grey of lightness L* = 17.
///
/// No map comes nearer to it than 12 units of CIELAB.
pub const NO_VALUE: [f64; 3] = [42.0 / 255.0; 3];

/// A colour map.
///
/// All but [`Hue`](Self::Hue) grow from dark to light, so that their order is seen without colour too.
///
/// ```
/// use kerrscope::display::Colormap;
/// let [r, g, b] = Colormap::Viridis.color(0.0).map(|c| (255.0 * c).round());
/// assert_eq!([r, g, b], [68.0, 1.0, 84.0]);
/// assert_eq!(Colormap::Hue.color(0.25), Colormap::Hue.color(-0.75));
/// ```
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Colormap {
    /// From dark violet over green to yellow; perceptually uniform.
    #[default]
    Viridis,
    /// From black over magenta to cream; perceptually uniform.
    Magma,
    /// From black over red to pale yellow; perceptually uniform.
    Inferno,
    /// From blue over red to yellow; perceptually uniform.
    Plasma,
    /// From blue over grey to yellow: nearly the same with and without red-green colour blindness. A
    /// polynomial fit to the published map, up to 19 of 255 steps off.
    Cividis,
    /// From dark grey to white, uniform in lightness.
    Grey,
    /// All hues in a circle, of the same lightness and chroma: for angles, whose ends are one.
    Hue,
}

impl Colormap {
    /// The colour at `t`, in the encoding of sRGB, each component from 0 to 1.
    ///
    /// Below 0 it is that of 0 and above 1 that of 1; [`Hue`](Self::Hue) repeats itself with period 1.
    /// What is not a number, and for `Hue` an infinity, has no place: it gets [`NO_VALUE`].
    pub fn color(self, t: f64) -> [f64; 3] {
        if t.is_nan() {
            return NO_VALUE;
        }
        match self {
            Self::Viridis => listed(colorous::VIRIDIS, t),
            Self::Magma => listed(colorous::MAGMA, t),
            Self::Inferno => listed(colorous::INFERNO, t),
            Self::Plasma => listed(colorous::PLASMA, t),
            Self::Cividis => listed(colorous::CIVIDIS, t),
            Self::Grey => grey(t.clamp(0.0, 1.0)),
            Self::Hue if t.is_infinite() => NO_VALUE,
            Self::Hue => hue(t.rem_euclid(1.0)),
        }
    }
}

// The maps of Smith & van der Walt 2015 (https://bids.github.io/colormap) as the 256 colours of 8 bits
// that were published, and that of Nuñez, Anderton & Renslow 2018 (PLoS ONE 13, e0199239) as the
// polynomials that d3-scale-chromatic fits to it. Straight lines lie between neighbours.
fn listed(gradient: Gradient, t: f64) -> [f64; 3] {
    const LAST: usize = 255;
    let place = t.clamp(0.0, 1.0) * LAST as f64;
    let below = (place as usize).min(LAST - 1);
    let share = place - below as f64;
    let at = |k: usize| gradient.eval_rational(k, LAST + 1).into_array().map(|c| f64::from(c) / 255.0);
    let (low, high) = (at(below), at(below + 1));
    std::array::from_fn(|i| low[i] * (1.0 - share) + high[i] * share)
}

// CIE 15:2004, eq. 8.3, where it is a cube: L* = 116 (Y/Y_n)^(1/3) − 16. The map begins at L* = 30, not at
// black, to stay away from `NO_VALUE`.
fn grey(t: f64) -> [f64; 3] {
    let lightness = 30.0 + 70.0 * t;
    [srgb::encode(((lightness + 16.0) / 116.0).powi(3)); 3]
}

// Oklab (Ottosson 2020, https://bottosson.github.io/posts/oklab) in polar coordinates. At L = 0.75 a circle
// of the hues lies inside sRGB up to C = 0.1275, which is the largest of all L.
fn hue(t: f64) -> [f64; 3] {
    const LIGHTNESS: f64 = 0.75;
    const CHROMA: f64 = 0.127;
    let (sin, cos) = (TAU * t).sin_cos();
    let (a, b) = (CHROMA * cos, CHROMA * sin);
    let l = (LIGHTNESS + 0.3963377774 * a + 0.2158037573 * b).powi(3);
    let m = (LIGHTNESS - 0.1055613458 * a - 0.0638541728 * b).powi(3);
    let s = (LIGHTNESS - 0.0894841775 * a - 1.2914855480 * b).powi(3);
    [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s,
    ]
    .map(srgb::encode)
}
