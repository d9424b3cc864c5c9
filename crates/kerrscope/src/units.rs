//! What a mass and a distance make of M, and a frequency of light.
//!
//! Lengths are GM/c², times GM/c³, angles on the sky θ_g = GM/(c²D).
//!
//! A picture is the perspective view of the plane through the hole that is square to the line of sight. Seen from the
//! true distance D instead of the scene's observer, a length of b M in this plane has the angle b θ_g. So a pixel of
//! p M, [`Camera::pixel_size`](crate::camera::Camera::pixel_size), has the angle p θ_g and the solid angle (p θ_g)² wherever it
//! lies: on an "impact" screen, where b is the impact parameter, exactly; on a "pinhole" screen, where b is the
//! distance of the observer times the tangent, as exactly as perspective is (a disk that is seen face-on in flat space
//! has its true flux); on an "angular" screen, where b is the distance times the angle, for small angles: at an
//! angle θ off the middle it is wrong by θ²/3. What an observer near the hole sees is blueshifted and aberrated as
//! they see it; data are better drawn from afar, or from infinity.

use crate::si::{GRAVITATION, JANSKY, MICROARCSECOND, PARSEC, SPEED_OF_LIGHT, STEFAN_BOLTZMANN, SUN, YEAR};

/// The units that a scene gives, each of them only where it does.
///
/// ```
/// use kerrscope::units::Units;
/// // M87*: 6.5e9 suns at 16.8 Mpc.
/// let units = Units { mass: Some(6.5e9), distance: Some(16.8e6), frequency: Some(230e9) };
/// assert!((units.kilometres().unwrap() / (6.5e9 * 1.476625038) - 1.0).abs() < 1e-9);
/// assert!((units.microarcseconds().unwrap() - 3.818993).abs() < 1e-6);
/// assert_eq!(Units::default().seconds(), None);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Units {
    /// Mass of the hole in solar masses, positive.
    pub mass: Option<f64>,
    /// Its distance from us in pc, positive.
    pub distance: Option<f64>,
    /// Frequency in Hz at which the picture is taken, positive.
    pub frequency: Option<f64>,
}

impl Units {
    /// M in metres.
    pub fn metres(&self) -> Option<f64> {
        self.mass.map(|mass| mass * SUN / SPEED_OF_LIGHT.powi(2))
    }

    /// M in kilometres.
    pub fn kilometres(&self) -> Option<f64> {
        self.metres().map(|metres| 1e-3 * metres)
    }

    /// M in seconds.
    pub fn seconds(&self) -> Option<f64> {
        self.metres().map(|metres| metres / SPEED_OF_LIGHT)
    }

    /// The angle θ_g of M on the sky in radians.
    pub fn radians(&self) -> Option<f64> {
        Some(self.metres()? / (self.distance? * PARSEC))
    }

    /// The angle θ_g of M on the sky in microarcseconds.
    pub fn microarcseconds(&self) -> Option<f64> {
        self.radians().map(|angle| angle / MICROARCSECOND)
    }

    /// Effective temperature in K, (F/σ)^¼, of a face whose flux is `flux` Ṁ/M² where `rate` solar masses accrete a year:
    /// F = flux · Ṁc²/(GM/c²)².
    ///
    /// ```
    /// use kerrscope::units::Units;
    /// // A stellar hole near its Eddington rate is hot in X-rays.
    /// let hole = Units { mass: Some(10.0), ..Units::default() };
    /// let hottest = hole.temperature(1.37e-5, 2e-7).unwrap();
    /// assert!((5e6..1e7).contains(&hottest), "{hottest}");
    /// ```
    pub fn temperature(&self, flux: f64, rate: f64) -> Option<f64> {
        let power = rate * SUN / GRAVITATION / YEAR * SPEED_OF_LIGHT.powi(2);
        self.metres().map(|metres| (flux * power / (metres * metres * STEFAN_BOLTZMANN)).powf(0.25))
    }

    /// Solid angle in sr of a square pixel whose side is `pixel` M.
    pub fn solid_angle(&self, pixel: f64) -> Option<f64> {
        self.radians().map(|angle| (angle * pixel).powi(2))
    }

    /// Flux density in Jy of a pixel of `pixel` M for each W m⁻² Hz⁻¹ sr⁻¹ of its radiance.
    ///
    /// ```
    /// use kerrscope::{spectrum::planck, units::Units};
    /// // A star of 6000 K and 1 M, 1 kpc away, as one pixel: I Ω.
    /// let units = Units { mass: Some(1e6), distance: Some(1000.0), ..Units::default() };
    /// let jansky = planck::per_frequency(5e14, 6000.0) * units.janskys(1.0).unwrap();
    /// let theta: f64 = 1e6 * 1476.625038 / 3.0856775814914e19;
    /// assert!((jansky / (planck::per_frequency(5e14, 6000.0) * theta.powi(2) / 1e-26) - 1.0).abs() < 1e-9);
    /// ```
    pub fn janskys(&self, pixel: f64) -> Option<f64> {
        self.solid_angle(pixel).map(|angle| angle / JANSKY)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_holes() {
        let of = |mass, distance| Units { mass: Some(mass), distance: Some(distance), frequency: None };
        // θ_g and 2√27 θ_g of M87* and Sgr A*.
        for (units, angle, shadow) in
            [(of(6.5e9, 16.8e6), 3.818993, 39.68814), (of(4.297e6, 8277.0), 5.124331, 53.25361)]
        {
            let found = units.microarcseconds().unwrap();
            assert!((found - angle).abs() < 1e-6, "{found}");
            assert!((2.0 * 27_f64.sqrt() * found - shadow).abs() < 1e-5);
        }
        let sun = of(1.0, 1.0);
        assert!((sun.kilometres().unwrap() - 1.476625038).abs() < 1e-9);
        assert!((sun.seconds().unwrap() - 4.925490947e-6).abs() < 1e-15);
        // A parsec is where an astronomical unit is a second of arc.
        assert!((PARSEC - 3.0856775814913673e16).abs() < 10.0);
        assert!((sun.solid_angle(3.0).unwrap() / (9.0 * sun.radians().unwrap().powi(2)) - 1.0).abs() < 1e-14);
        // What is not given is not known.
        let half = Units { mass: Some(1.0), ..Units::default() };
        assert!(half.seconds().is_some() && half.radians().is_none() && half.janskys(1.0).is_none());
    }
}
