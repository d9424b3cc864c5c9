//! Spectra, and the colours that they have for an eye.
//!
//! Here light is in SI units: Planck's law ([`planck`]), the standard observer of the CIE ([`observer`]), the linear
//! light of a display ([`rgb`]), and a table of the colours of black bodies ([`locus`]).
//!
//! ```
//! use kerrscope::spectrum::{observer, planck};
//! let radiance = |wavelength| planck::per_wavelength(wavelength, 6500.0);
//! let [x, y] = observer::chromaticity(observer::tristimulus(radiance));
//! assert!((x - 0.31352).abs() < 1e-5 && (y - 0.32363).abs() < 1e-5);
//! ```

pub mod locus;
pub mod observer;
pub mod planck;
pub mod rgb;

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of the Planckian locus from the CIE's data every nanometre (c₂ = 0.01438776877 m K), as the Python package
    /// colour-science 0.4 sums them, and the CIE's own point: illuminant A, which is Planck's law with
    /// c₂/T = 1.435e7/2848 nm (CIE 15:2018, table 1 and annex), at (0.44758, 0.40745).
    #[test]
    fn chromaticities_of_black_bodies() {
        let illuminant_a = 2848.0 * 0.01438776877 / 0.01435;
        for (temperature, published) in [
            (1500.0, [0.58572, 0.39312]),
            (2000.0, [0.52668, 0.41330]),
            (illuminant_a, [0.44758, 0.40745]),
            (3000.0, [0.43693, 0.40407]),
            (4000.0, [0.38044, 0.37675]),
            (6500.0, [0.31352, 0.32363]),
            (10_000.0, [0.28063, 0.28829]),
        ] {
            let radiance = |wavelength| planck::per_wavelength(wavelength, temperature);
            let found = observer::chromaticity(observer::tristimulus(radiance));
            let error = (0..2).map(|k| (found[k] - published[k]).abs()).fold(0.0, f64::max);
            // Half a unit of the last digit, and what the 5 nm make.
            assert!(error < 1.2e-5, "{temperature}: {found:?} {published:?}");
        }
        // In the limit of high temperatures: (0.2399, 0.2340).
        let found = observer::chromaticity(observer::tristimulus(|wavelength| (wavelength * 1e9).powi(-4)));
        assert!((found[0] - 0.23988).abs() < 1e-5 && (found[1] - 0.23404).abs() < 1e-5, "{found:?}");
    }
}
