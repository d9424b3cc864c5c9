//! Planck's law.
//!
//! Spectral radiance of a black body, in SI units; x = hν/(kT) = hc/(λkT):
//!
//! - B_ν = 2hν³/c² · 1/(eˣ − 1),
//! - B_λ = 2hc²/λ⁵ · 1/(eˣ − 1) = B_ν ν/λ,
//! - ∫B_ν dν = ∫B_λ dλ = σT⁴/π.
//!
//! Seen with a redshift factor g = ν/ν_emitted, a black body of the temperature T is one of gT, because B_ν/ν³
//! depends on ν/T alone.
//!
//! Source: Rybicki & Lightman 1979, Radiative Processes in Astrophysics, §1.5.

use crate::si::{BOLTZMANN, PLANCK, SPEED_OF_LIGHT, STEFAN_BOLTZMANN};
use std::f64::consts::PI;

/// B_ν in W m⁻² Hz⁻¹ sr⁻¹ of a black body of a temperature in K at a frequency in Hz, both positive.
///
/// ```
/// use kerrscope::spectrum::planck;
/// // The radio sky: 2ν²kT/c² at low frequencies.
/// let (nu, t) = (1e9_f64, 1e9);
/// let rayleigh_jeans = 2.0 * nu.powi(2) * 1.380649e-23 * t / 299792458_f64.powi(2);
/// assert!((planck::per_frequency(nu, t) / rayleigh_jeans - 1.0).abs() < 1e-7);
/// ```
pub fn per_frequency(frequency: f64, temperature: f64) -> f64 {
    let x = PLANCK * frequency / (BOLTZMANN * temperature);
    2.0 * PLANCK * frequency * (frequency / SPEED_OF_LIGHT).powi(2) / x.exp_m1()
}

/// B_λ in W m⁻³ sr⁻¹ of a black body of a temperature in K at a wavelength in m, both positive.
pub fn per_wavelength(wavelength: f64, temperature: f64) -> f64 {
    let x = PLANCK * SPEED_OF_LIGHT / (BOLTZMANN * wavelength * temperature);
    2.0 * PLANCK * SPEED_OF_LIGHT.powi(2) / wavelength.powi(5) / x.exp_m1()
}

/// d ln B/d ln T = x/(1 − e⁻ˣ), the same for B_ν and B_λ, at a wavelength in m and a temperature in K.
pub(super) fn slope(wavelength: f64, temperature: f64) -> f64 {
    let x = PLANCK * SPEED_OF_LIGHT / (BOLTZMANN * wavelength * temperature);
    x / -(-x).exp_m1()
}

/// The radiance of all frequencies, σT⁴/π, in W m⁻² sr⁻¹.
pub fn bolometric(temperature: f64) -> f64 {
    STEFAN_BOLTZMANN * temperature.powi(4) / PI
}

/// B_ν of a black body with colour correction f: (1/f⁴) B_ν(fT). It has the radiance of all frequencies of a black body
/// of the temperature T and the shape of one that is f times hotter, as the scattering atmosphere of a
/// disk makes it (Shimura & Takahara 1995, ApJ 445, 780).
pub fn corrected(frequency: f64, temperature: f64, correction: f64) -> f64 {
    per_frequency(frequency, correction * temperature) / correction.powi(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ f(x) dx over the whole line by the trapezoidal rule, which converges exponentially for what is smooth and
    /// falls off at both ends.
    fn integral(f: impl Fn(f64) -> f64) -> f64 {
        let step = 1.0 / 32.0;
        (-40 * 32..=8 * 32).map(|k| f(f64::from(k) * step)).sum::<f64>() * step
    }

    #[test]
    fn stefan_and_boltzmann() {
        // CODATA 2018.
        assert!((STEFAN_BOLTZMANN / 5.670_374_419e-8 - 1.0).abs() < 1e-9);
        for t in [2.725, 5772.0, 1e7] {
            let total = bolometric(t);
            let thermal = BOLTZMANN * t / PLANCK;
            // Over the logarithm of x.
            let by_frequency = integral(|u| {
                let nu = thermal * u.exp();
                nu * per_frequency(nu, t)
            });
            let by_wavelength = integral(|u| {
                let length = SPEED_OF_LIGHT / (thermal * u.exp());
                length * per_wavelength(length, t)
            });
            let corrected = integral(|u| {
                let nu = thermal * u.exp();
                nu * corrected(nu, t, 1.7)
            });
            for sum in [by_frequency, by_wavelength, corrected] {
                assert!((sum / total - 1.0).abs() < 1e-10, "{t}: {sum} {total}");
            }
        }
    }

    #[test]
    fn wien() {
        // The peak of B_λ is at λT = 2.897771955e-3 m K (CODATA 2018): the slope is 5 there.
        assert!((slope(2.897771955e-3, 1.0) - 5.0).abs() < 1e-9);
        // B_ν/ν³ of ν/T alone: a shifted black body is a black body.
        let (nu, t, g) = (3e14, 6000.0, 0.4);
        let shifted = g * g * g * per_frequency(nu / g, t);
        assert!((per_frequency(nu, g * t) / shifted - 1.0).abs() < 1e-14);
    }
}
