//! From linear light to the values that a screen takes.
//!
//! This module alone knows a screen. Everything before it works in linear light
//! ([`Light`]: the primaries and the white of sRGB); everything after it works in
//! display values from 0 to 1, encoded with the transfer function of sRGB.
//!
//! The order is: exposure, tone curve, transfer function.

pub mod chart;
mod colormap;
mod false_color;
mod picture;
pub mod srgb;
mod tone;

pub use colormap::{Colormap, NO_VALUE};
pub use false_color::FalseColor;
pub use picture::{Depth, Picture};
pub use tone::Tone;

use rayon::prelude::*;

use crate::light::Light;
use crate::render::Film;

/// Light brighter than this is shown as this: it is white on any screen, and sums
/// and ratios of such values stay finite.
const BRIGHTEST: f64 = 1e30;

/// How linear light becomes display values.
///
/// ```
/// use kerrscope::display::{Display, Tone};
/// use kerrscope::light::Light;
///
/// let plain = Display { exposure: 0.0, tone: Tone::None };
/// assert_eq!(plain.encode(Light::new([1.0, 0.0, 7.0])), [1.0, 0.0, 1.0]);
///
/// // A stop is a factor of two.
/// let brighter = Display { exposure: 1.0, ..plain };
/// assert_eq!(brighter.encode(Light::new([0.1; 3])), plain.encode(Light::new([0.2; 3])));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Display {
    /// Exposure in stops: light is multiplied by 2 to this power.
    pub exposure: f64,
    /// What happens to light brighter than the screen.
    pub tone: Tone,
}

impl Display {
    /// Display values, each from 0 to 1, in the encoding of sRGB.
    ///
    /// Finite for any input. A negative component is shown as 0 (a screen cannot
    /// take light away), and so is one that is not a number.
    pub fn encode(&self, light: Light) -> [f64; 3] {
        let scale = self.exposure.exp2();
        let exposed = light.rgb.map(|c| c * scale);
        // What is not a number is not above 0 either.
        let exposed = exposed.map(|c| if c > 0.0 { c.min(BRIGHTEST) } else { 0.0 });
        self.tone.apply(exposed).map(|c| srgb::encode(c.clamp(0.0, 1.0)))
    }

    /// The light of a film as a screen shows it.
    pub fn develop(&self, film: &Film) -> Picture {
        let encode = |light: &[f32; 3]| self.encode(Light::new(light.map(f64::from))).map(|c| c as f32);
        let pixels = film.light.par_iter().map(encode).collect();
        Picture { width: film.width, height: film.height, pixels }
    }
}
