//! Constants of the SI and of astronomy.
//!
//! Those of physics are exact by definition (BIPM, The International System of Units, 9th edition, 2019); those of
//! astronomy are exact by resolutions of the IAU (2012 B2, 2015 B2 and B3).

use std::f64::consts::PI;

/// Speed of light c, m s⁻¹.
pub const SPEED_OF_LIGHT: f64 = 299_792_458.0;
/// Planck's constant h, J s.
pub const PLANCK: f64 = 6.626_070_15e-34;
/// Boltzmann's constant k, J K⁻¹.
pub const BOLTZMANN: f64 = 1.380_649e-23;
/// The constant of Stefan and Boltzmann, σ = 2π⁵k⁴/(15h³c²), W m⁻² K⁻⁴.
pub const STEFAN_BOLTZMANN: f64 = {
    let (k2, hc, pi2) = (BOLTZMANN * BOLTZMANN, PLANCK * SPEED_OF_LIGHT, PI * PI);
    2.0 * pi2 * pi2 * PI * (k2 / hc) * (k2 / hc) / (15.0 * PLANCK)
};
/// Luminous efficacy of monochromatic light of 540 THz, lm W⁻¹.
pub const LUMINOUS_EFFICACY: f64 = 683.0;
/// The Sun's mass parameter GM☉, nominal, m³ s⁻² (IAU 2015 B3).
pub const SUN: f64 = 1.327_124_4e20;
/// Constant of gravitation G, m³ kg⁻¹ s⁻² (CODATA 2018); needed where a mass is counted in kilograms only.
pub const GRAVITATION: f64 = 6.674_30e-11;
/// Julian year, s.
pub const YEAR: f64 = 31_557_600.0;
/// Astronomical unit, m (IAU 2012 B2).
pub const ASTRONOMICAL_UNIT: f64 = 149_597_870_700.0;
/// Parsec, m: the distance at which an astronomical unit is a second of arc wide, 648,000/π of them (IAU 2015 B2).
pub const PARSEC: f64 = 648_000.0 / PI * ASTRONOMICAL_UNIT;
/// Jansky, W m⁻² Hz⁻¹.
pub const JANSKY: f64 = 1e-26;
/// Microarcsecond, rad.
pub const MICROARCSECOND: f64 = PI / 648_000e6;
