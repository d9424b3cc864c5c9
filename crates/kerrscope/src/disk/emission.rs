//! The light of a disk that shines by physics.

use std::f64::consts::PI;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::light::{Light, Radiance};
use crate::spacetime::emitter::Circular;
use crate::spectrum::{locus, planck};

/// How the flux from each face depends on the radius, in the frame of the matter.
#[derive(Clone, Debug, PartialEq)]
pub enum Profile {
    /// That of a thin disk through which matter drifts inwards (Page & Thorne 1974), in Ṁ/M².
    PageThorne(Arc<Circular>),
    /// r^−q.
    PowerLaw {
        /// q.
        index: f64,
    },
    /// Straight lines between points (r, F), r growing; nothing beyond the first and the last.
    Knots(Vec<[f64; 2]>),
}

impl Profile {
    /// F at r.
    pub fn flux(&self, r: f64) -> f64 {
        match self {
            Self::PageThorne(matter) => matter.flux(r),
            Self::PowerLaw { index } => r.powf(-index),
            Self::Knots(knots) => {
                let above = knots.partition_point(|[radius, _]| *radius < r);
                match (above.checked_sub(1).and_then(|i| knots.get(i)), knots.get(above)) {
                    (_, Some([radius, flux])) if *radius == r => *flux,
                    (Some([from, low]), Some([to, high])) => low + (high - low) * (r - from) / (to - from),
                    _ => 0.0,
                }
            }
        }
    }

    /// The largest flux between two radii.
    pub fn peak(&self, inner: f64, outer: f64) -> f64 {
        match self {
            Self::PowerLaw { index } => inner.powf(-index).max(outer.powf(-index)),
            Self::Knots(knots) => {
                let within = knots.iter().filter(|[r, _]| (inner..=outer).contains(r)).map(|[_, flux]| *flux);
                within.fold(self.flux(inner).max(self.flux(outer)), f64::max)
            }
            Self::PageThorne(_) => {
                // One maximum, within some ten radii of the inner edge: on a grid, then by golden section.
                let at = |s: f64| self.flux(inner * (outer / inner).min(1e3).powf(s));
                let best = (0..=400).map(|i| f64::from(i) / 400.0).max_by(|a, b| at(*a).total_cmp(&at(*b)));
                let best = best.unwrap_or(0.0);
                let (mut low, mut high) = ((best - 0.0025).max(0.0), (best + 0.0025).min(1.0));
                let golden = 0.5 * (5f64.sqrt() - 1.0);
                for _ in 0..40 {
                    let (a, b) = (high - golden * (high - low), low + golden * (high - low));
                    if at(a) < at(b) {
                        low = a;
                    } else {
                        high = b;
                    }
                }
                at(0.5 * (low + high)).max(at(best))
            }
        }
    }
}

/// How bright a face is at an angle.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Limb {
    /// Equally from all sides: I = F/π.
    #[default]
    Isotropic,
    /// As an atmosphere in which electrons scatter the light, I = F/π · (1 + 2.06 μ)/(1 + 2.06 · 2/3), μ the cosine of the
    /// angle from the normal (Chandrasekhar 1960, "Radiative Transfer", §68, approximately).
    ElectronScattering,
}

impl Limb {
    /// π I/F; its mean over a face, weighted by μ, is 1.
    pub fn factor(self, cosine: f64) -> f64 {
        match self {
            Self::Isotropic => 1.0,
            Self::ElectronScattering => (1.0 + 2.06 * cosine) / (1.0 + 2.06 * 2.0 / 3.0),
        }
    }
}

/// Which light of it is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Glow {
    /// That of all frequencies, as grey: 1 where the disk shines the most, seen from next to it.
    Bolometric,
    /// What an eye would see: a black body, of luminance 1 where it is the hottest, seen from next to it.
    Blackbody {
        /// Effective temperature where it is the hottest, K.
        hottest: f64,
        /// How much hotter its colour is than its flux: f in (1/f⁴) `B_ν(fT)`.
        correction: f64,
        /// Frequency in Hz at which the intensity is given; without one it is that of all frequencies.
        frequency: Option<f64>,
    },
}

/// Light of a black body, diluted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thermal {
    /// T, K.
    pub temperature: f64,
    /// f.
    pub correction: f64,
    /// How much of it there is.
    pub factor: f64,
}

impl Thermal {
    /// I_ν in W m⁻² Hz⁻¹ sr⁻¹ at a frequency in Hz.
    pub fn at(&self, frequency: f64) -> f64 {
        self.factor * planck::corrected(frequency, self.temperature, self.correction)
    }
}

/// A disk's own light.
///
/// ```
/// use kerrscope::disk::{Emission, Glow, Limb, Profile};
/// let emission = Emission::new(Profile::PowerLaw { index: 3.0 }, Limb::Isotropic, Glow::Bolometric, [6.0, 20.0]);
/// // All of I goes with g⁴.
/// let seen = emission.at(6.0, 0.5, true, 1.0);
/// assert!((seen.rgb[0] - 0.0625).abs() < 1e-15);
/// assert!((seen.intensity - 0.0625 / 216.0 / std::f64::consts::PI).abs() < 1e-15);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Emission {
    profile: Profile,
    limb: Limb,
    glow: Glow,
    peak: f64,
    /// Luminance of the hottest place.
    luminance: f64,
}

impl Emission {
    /// That of a disk between two radii.
    pub fn new(profile: Profile, limb: Limb, glow: Glow, [inner, outer]: [f64; 2]) -> Self {
        let peak = profile.peak(inner, outer);
        let luminance = match glow {
            Glow::Bolometric => 1.0,
            Glow::Blackbody { hottest, correction, .. } => locus::glow(hottest * correction).luminance,
        };
        Self { profile, limb, glow, peak, luminance }
    }

    /// What its intensity is.
    pub fn radiance(&self) -> Radiance {
        match self.glow {
            Glow::Blackbody { frequency: Some(_), .. } => Radiance::Specific,
            _ => Radiance::Bolometric,
        }
    }

    /// Whether it is that of black bodies.
    pub fn is_thermal(&self) -> bool {
        matches!(self.glow, Glow::Blackbody { .. })
    }

    /// Whether it depends on the angle at which it leaves.
    pub fn needs_angle(&self) -> bool {
        self.limb != Limb::Isotropic
    }

    /// The black body that is seen of the place at radius r with the shift g: I_ν = factor · (1/f⁴) `B_ν(fT)`. None if it is
    /// none, and where it is dark.
    pub fn thermal(&self, r: f64, g: f64, beaming: bool, cosine: f64) -> Option<Thermal> {
        let Glow::Blackbody { hottest, correction, .. } = self.glow else { return None };
        let flux = self.profile.flux(r);
        // Also where there is no number.
        if !(flux > 0.0 && g > 0.0) {
            return None;
        }
        // g³ B_ν/g(T) = B_ν(gT), of which the whole goes with g⁴.
        let all = if beaming { 1.0 } else { g.powi(-4) };
        let temperature = g * hottest * (flux / self.peak).powf(0.25);
        Some(Thermal { temperature, correction, factor: self.limb.factor(cosine) * all })
    }

    /// What is seen of the place at radius r with the shift g, by light that leaves at an angle of this cosine. I_ν/ν³ is the
    /// same along a ray: a black body of temperature T looks like one of gT. Without `beaming` only the colour goes
    /// with g, and all of the intensity is that of g = 1.
    pub fn at(&self, r: f64, g: f64, beaming: bool, cosine: f64) -> Light {
        let flux = self.profile.flux(r);
        // Also where there is no number.
        if !(flux > 0.0 && g > 0.0) {
            return Light::DARK;
        }
        let limb = self.limb.factor(cosine);
        let all = if beaming { g.powi(4) } else { 1.0 };
        let share = flux / self.peak;
        match self.glow {
            Glow::Bolometric => Light { rgb: [limb * all * share; 3], intensity: limb * all * flux / PI },
            Glow::Blackbody { hottest, correction, frequency } => {
                let temperature = hottest * share.powf(0.25);
                let seen = locus::glow(g * correction * temperature);
                let bright = limb * all / g.powi(4) * seen.luminance / self.luminance;
                let intensity = match (frequency, self.thermal(r, g, beaming, cosine)) {
                    (Some(frequency), Some(thermal)) => thermal.at(frequency),
                    _ => limb * all * flux / PI,
                };
                Light { rgb: seen.rgb.map(|c| c * bright), intensity }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limb_darkening_keeps_the_flux() {
        for limb in [Limb::Isotropic, Limb::ElectronScattering] {
            // ∫ I μ dω = F by the midpoint rule, exact to 1/n².
            let n = 10_000;
            let mean: f64 = (0..n)
                .map(|i| (f64::from(i) + 0.5) / f64::from(n))
                .map(|cosine| 2.0 * cosine * limb.factor(cosine) / f64::from(n))
                .sum();
            assert!((mean - 1.0).abs() < 1e-8, "{mean}");
        }
    }

    #[test]
    fn knots_are_joined_by_lines() {
        let profile = Profile::Knots(vec![[2.0, 1.0], [4.0, 3.0], [5.0, 0.0]]);
        for (r, flux) in [(1.9, 0.0), (2.0, 1.0), (3.0, 2.0), (4.5, 1.5), (5.0, 0.0), (5.1, 0.0)] {
            assert_eq!(profile.flux(r), flux, "{r}");
        }
        assert_eq!(profile.peak(2.0, 5.0), 3.0);
        assert_eq!(profile.peak(4.5, 9.0), 1.5);
    }

    /// physics: the peak of a = 0 is at 9.550928.
    #[test]
    fn the_brightest_ring() {
        use crate::spacetime::emitter::Sense;
        let matter = Arc::new(Circular::kerr(0.0, Sense::Prograde));
        let profile = Profile::PageThorne(Arc::clone(&matter));
        let peak = profile.peak(6.0, 1e15);
        assert!((peak / matter.flux(9.550928) - 1.0).abs() < 1e-12);
    }

    /// Without a frequency the intensity is that of all of them, σT⁴/π in these units.
    #[test]
    fn a_black_body_is_one_shifted() {
        let profile = || Profile::PowerLaw { index: 0.0 };
        let glow = |frequency| Glow::Blackbody { hottest: 5000.0, correction: 1.6, frequency };
        let emission = |frequency| Emission::new(profile(), Limb::Isotropic, glow(frequency), [1.0, 2.0]);
        let (g, nu) = (0.7_f64, 3e14);
        let seen = emission(Some(nu)).at(1.5, g, true, 1.0).intensity;
        let sent = g.powi(3) * planck::corrected(nu / g, 5000.0, 1.6);
        assert!((seen / sent - 1.0).abs() < 1e-12);
        let [dim, shifted] = [true, false].map(|beaming| emission(None).at(1.5, g, beaming, 1.0));
        for i in 0..3 {
            assert!((dim.rgb[i] / shifted.rgb[i] - g.powi(4)).abs() < 1e-12);
        }
    }
}
