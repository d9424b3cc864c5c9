//! The transfer function of sRGB.
//!
//! IEC 61966-2-1:1999, also in <https://www.w3.org/Graphics/Color/sRGB>:
//!
//! ```text
//! encoded = 12.92 linear                       linear ≤ 0.0031308
//!         = 1.055 linear^(1/2.4) − 0.055       otherwise
//! linear  = encoded / 12.92                    encoded ≤ 0.04045
//!         = ((encoded + 0.055) / 1.055)^2.4    otherwise
//! ```
//!
//! The standard's constants are rounded: the two branches differ by 3e-8 where they
//! meet, a ten-thousandth of a step of 16 bits.

/// Encodes a linear component from 0 to 1.
///
/// ```
/// use kerrscope::display::srgb;
/// // Middle grey: a fifth of the light is nearly half of the scale.
/// assert!((srgb::encode(0.2140) - 0.5).abs() < 1e-4);
/// ```
pub fn encode(linear: f64) -> f64 {
    if linear <= 0.0031308 {
        12.92 * linear
    } else {
        // 1.055 x − 0.055, in a form that gives exactly 1 for 1.
        1.0 - 1.055 * (1.0 - linear.powf(1.0 / 2.4))
    }
}

/// Decodes an encoded component from 0 to 1: the inverse of [`encode`].
///
/// ```
/// use kerrscope::display::srgb;
/// assert!((srgb::decode(srgb::encode(0.3)) - 0.3).abs() < 1e-12);
/// ```
pub fn decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}
