//! What light carries along a ray.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Mul};

/// Radiance in linear light: the primaries and white point of sRGB (Rec. 709, D65),
/// 1 = the white of the display before exposure. Components may exceed 1. Beside it the physical radiance, of what has one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Light {
    /// Red, green, blue.
    pub rgb: [f64; 3],
    /// Physical radiance: I_ν in W m⁻² Hz⁻¹ sr⁻¹ where the scene has a frequency, otherwise that of all frequencies in units of
    /// Ṁ/M² per sr. 0 for what is drawn, as skies are.
    pub intensity: f64,
}

/// The kinds of radiance.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Radiance {
    /// I_ν at the frequency of the scene's units, W m⁻² Hz⁻¹ sr⁻¹.
    Specific,
    /// Of all frequencies, sr⁻¹ in units of Ṁ/M² (G = c = 1).
    Bolometric,
}

impl Light {
    /// No light.
    pub const DARK: Self = Self::new([0.0; 3]);

    /// Light of the given components, without a physical radiance.
    pub const fn new(rgb: [f64; 3]) -> Self {
        Self { rgb, intensity: 0.0 }
    }
}

impl Add for Light {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let rgb = std::array::from_fn(|i| self.rgb[i] + other.rgb[i]);
        Self { rgb, intensity: self.intensity + other.intensity }
    }
}

impl AddAssign for Light {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sum for Light {
    fn sum<I: Iterator<Item = Self>>(lights: I) -> Self {
        lights.fold(Self::DARK, Add::add)
    }
}

impl Mul<f64> for Light {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { rgb: self.rgb.map(|c| c * factor), intensity: self.intensity * factor }
    }
}

/// A translucent sheet that a ray passes: what it shines and what it holds back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet {
    /// Light sent towards the camera (already scaled by the sheet's own opacity).
    pub light: Light,
    /// Share of the light from behind that is held back, 0 to 1.
    pub opacity: f64,
}

/// Light gathered along a ray from the camera backwards, sheet by sheet.
///
/// ```
/// use kerrscope::light::{Beam, Light, Sheet};
/// let mut beam = Beam::new();
/// beam.pass(Sheet { light: Light::new([0.5, 0.0, 0.0]), opacity: 0.5 });
/// let seen = beam.end(Light::new([0.0, 1.0, 0.0]));
/// assert_eq!(seen, Light::new([0.5, 0.5, 0.0]));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    light: Light,
    transmittance: f64,
}

impl Default for Beam {
    fn default() -> Self {
        Self::new()
    }
}

impl Beam {
    /// A beam that has met nothing.
    pub const fn new() -> Self {
        Self { light: Light::DARK, transmittance: 1.0 }
    }

    /// Passes through a sheet behind all those met so far.
    pub fn pass(&mut self, sheet: Sheet) {
        self.light += sheet.light * self.transmittance;
        self.transmittance *= 1.0 - sheet.opacity;
    }

    /// Whether nothing farther away can be seen.
    pub fn is_blocked(&self) -> bool {
        self.transmittance <= 0.0
    }

    /// Ends at a background.
    pub fn end(self, background: Light) -> Light {
        self.light + background * self.transmittance
    }
}
