//! Tone curves: what becomes of light brighter than the screen.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A tone curve: from exposed linear light, 0 and up, to linear light that a screen
/// can show.
///
/// ```
/// use kerrscope::display::Tone;
/// // Below the knee nothing changes.
/// assert_eq!(Tone::Neutral.apply([0.7, 0.3, 0.1]), [0.7, 0.3, 0.1]);
/// // Above it light is compressed, and the brightest of it turns white.
/// let [red, green, _] = Tone::Neutral.apply([8.0, 2.0, 0.0]);
/// assert!(red < 1.0 && green < red);
/// ```
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tone {
    /// The highlight compression of Khronos PBR Neutral: nothing changes below a
    /// knee at 0.76; above it the largest component approaches 1 and the colour
    /// approaches white, its hue kept.
    ///
    /// That curve's first step, which takes away 4 % of reflected white light, is
    /// left out: it undoes the sheen of a dielectric surface in a lit room, and would
    /// darken everything here.
    #[default]
    Neutral,
    /// The response of film, fitted by Narkowicz to that of ACES: each component on its own goes
    /// through an S-shaped curve, so that a bright orange turns yellow and then white.
    ///
    /// Contrast is higher than without a curve: linear light of 0.18 becomes 0.27 and that of 1
    /// becomes 0.80, but faint light is taken down, at most to 3/14 (2.2 stops) next to black.
    /// White is reached at 7.25. An exposure of 1 or 2 stops brings a faint sky back.
    Filmic,
    /// No curve: components above 1 are cut, each on its own. Bright colours shift in
    /// hue; values below 1 are shown as they are.
    None,
}

/// Where the compression begins. Khronos: `K_s` = 0.8 − `F` with `F` = 0.04.
const KNEE: f64 = 0.76;

/// How fast colours turn white above the knee. Khronos: `K_d`.
const DESATURATION: f64 = 0.15;

impl Tone {
    /// Applies the curve to components that are finite and not negative.
    pub fn apply(self, rgb: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Neutral => neutral(rgb),
            Self::Filmic => rgb.map(filmic),
            Self::None => rgb.map(|c| c.min(1.0)),
        }
    }
}

// Khronos PBR Neutral Tone Mapper, 2024, without its F90 term
// (https://github.com/KhronosGroup/ToneMapping, PBR_Neutral/README.md):
//
//   p  = max(r, g, b);                      identity for p ≤ K_s
//   p' = 1 − (1 − K_s)² / (p + 1 − 2 K_s)
//   w  = 1 − 1 / (K_d (p − p') + 1)
//   c' = (1 − w) c p'/p + w p'
//
// The slope of p' at the knee is 1 and w vanishes there to second order, so the
// curve has a continuous first derivative. Only mixtures of the colour and white
// occur, so the hue stays.
fn neutral(rgb: [f64; 3]) -> [f64; 3] {
    let peak = rgb[0].max(rgb[1]).max(rgb[2]);
    if peak <= KNEE {
        return rgb;
    }
    let range = 1.0 - KNEE;
    let shown = 1.0 - range * range / (peak + range - KNEE);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - shown) + 1.0);
    rgb.map(|c| (1.0 - white) * (c / peak) * shown + white * shown)
}

// Narkowicz 2016, "ACES Filmic Tone Mapping Curve" (https://knarkowicz.wordpress.com/2016/01/06,
// its code under CC0 or MIT): a rational fit, within 0.014, to ACES' reference and output transforms
// for a screen of Rec. 709,
//
//   f(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), at most 1.
//
// f(x) = 1 where 0.08 x² − 0.56 x − 0.14 = 0, x = 7.2418. Above that f would go on to 2.51/2.43.
fn filmic(x: f64) -> f64 {
    // Cut a little above that place, so that no square overflows.
    let x = x.min(8.0);
    (x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)).min(1.0)
}
