//! The light of a disk around a Kerr hole, and what it changes by.

use kerrscope::spacetime::emitter::PageThorne;

use super::shine::Shine;

/// How the flux from the disk depends on the radius, in the frame of the matter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// That of a thin, steady disk (Page & Thorne 1974).
    PageThorne,
    /// r^−q.
    PowerLaw {
        /// q.
        index: f64,
    },
    /// The brightness that is seen is 1 everywhere, whatever moves how.
    Even,
}

/// I = g⁴ F and its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Glow {
    /// I.
    pub value: f64,
    /// ∂I/∂r, at a fixed λ.
    pub radius: f64,
    /// ∂I/∂λ.
    pub lambda: f64,
    /// ∂I/∂a, at fixed r and λ.
    pub spin: f64,
    /// ∂I/∂q of a power law.
    pub index: f64,
}

/// The step in a of the flux's derivative: its error is of the order of the square.
const STEP: f64 = 1e-5;

/// Intervals of the table of the flux in x = 1/√r.
const INTERVALS: usize = 1024;

/// Matter on circular geodesics about +z. Intensities are those of all frequencies, but for a constant factor.
#[derive(Clone, Debug)]
pub struct Matter {
    spin: f64,
    profile: Profile,
    /// F, dF/dx and dF/da at equal steps of x, from `first` on.
    table: Vec<[f64; 3]>,
    first: f64,
    per_step: f64,
}

impl Matter {
    /// Around a hole of spin a, for radii whose x lies between the two.
    pub fn new(spin: f64, profile: Profile, [low, high]: [f64; 2]) -> Self {
        let step = (high - low) / INTERVALS as f64;
        let mut matter = Self { spin, profile, table: Vec::new(), first: low, per_step: step.recip() };
        if profile == Profile::PageThorne {
            // |a| ≤ 1: at the end the step goes to one side.
            let ends = [(spin - STEP).max(-1.0), (spin + STEP).min(1.0)];
            let [here, below, above] = [spin, ends[0], ends[1]].map(PageThorne::new);
            for k in 0..=INTERVALS {
                let at = |x: f64| here.flux(x.powi(-2));
                let x = low + step * k as f64;
                let h = 1e-5 * x;
                let slope = (at(x + h) - at(x - h)) / (2.0 * h);
                let r = x.powi(-2);
                matter.table.push([at(x), slope, (above.flux(r) - below.flux(r)) / (ends[1] - ends[0])]);
            }
        }
        matter
    }
}

impl Shine for Matter {
    fn flux(&self, x: f64) -> [f64; 4] {
        let r = x.powi(-2);
        match self.profile {
            Profile::Even => [1.0, 0.0, 0.0, 0.0],
            Profile::PowerLaw { index } => {
                let flux = r.powf(-index);
                [flux, -index * flux / r, 0.0, -r.ln() * flux]
            }
            Profile::PageThorne => {
                let place = ((x - self.first) * self.per_step).clamp(0.0, INTERVALS as f64);
                let k = (place as usize).min(INTERVALS - 1);
                let s = place - k as f64;
                let ([from, to], h) = ([&self.table[k], &self.table[k + 1]], self.per_step.recip());
                // Hermite's cubic.
                let rise = to[0] - from[0];
                let (c, d) = (3.0 * rise - h * (2.0 * from[1] + to[1]), h * (from[1] + to[1]) - 2.0 * rise);
                let flux = from[0] + s * (h * from[1] + s * (c + s * d));
                let slope = (h * from[1] + s * (2.0 * c + 3.0 * s * d)) * self.per_step;
                [flux, -0.5 * x.powi(3) * slope, from[2] + s * (to[2] - from[2]), 0.0]
            }
        }
    }

    /// The light of the place r = x⁻² whose photons have λ (Bardeen, Press & Teukolsky 1972; turning about +z):
    ///
    /// ```text
    /// g = N/[(1 + a r^{−3/2})(1 − Ωλ)],   N² = 1 − 3/r + 2a r^{−3/2},   Ω = 1/(r^{3/2} + a).
    /// ```
    fn glow(&self, x: f64, lambda: f64) -> Glow {
        if self.profile == Profile::Even {
            return Glow { value: 1.0, ..Glow::default() };
        }
        let (x3, a) = (x * x * x, self.spin);
        let square = 1.0 - 3.0 * x * x + 2.0 * a * x3;
        let drag = 1.0 + a * x3;
        let rate = x3 / drag;
        let behind = 1.0 - rate * lambda;
        if !(square > 0.0 && behind > 0.0) {
            return Glow::default();
        }
        let g = square.sqrt() / (drag * behind);
        let [flux, slope, by_spin, by_index] = self.flux(x);
        // d ln g, Ω' = −(3/2)√r Ω², ∂Ω/∂a = −Ω².
        let per_rate = lambda / behind;
        let turn = rate * rate;
        let by_radius = (1.5 * x.powi(4) - 1.5 * a * x3 * x * x) / square + 1.5 * a * x3 * x * x / drag
            - per_rate * turn * 1.5 / x;
        let beamed = g.powi(4);
        let value = beamed * flux;
        Glow {
            value,
            radius: 4.0 * value * by_radius + beamed * slope,
            lambda: 4.0 * value * rate / behind,
            spin: 4.0 * value * (x3 / square - x3 / drag - per_rate * turn) + beamed * by_spin,
            index: beamed * by_index,
        }
    }

    fn even(&self) -> bool {
        self.profile == Profile::Even
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kerrscope::spacetime::emitter::{Circular, Sense};

    /// I against the renderer's matter, and its derivatives against differences.
    #[test]
    fn derivatives_are_differences() {
        for profile in [Profile::PageThorne, Profile::PowerLaw { index: 3.0 }] {
            for (a, x, lambda) in [(0.9, 0.5, 2.0), (-0.4, 0.3, -5.0), (0.2, 0.38, 0.1)] {
                let ends = [0.1, 0.64];
                let at = |a: f64, x: f64, lambda: f64| Matter::new(a, profile, ends).glow(x, lambda).value;
                let glow = Matter::new(a, profile, ends).glow(x, lambda);
                let matter = Circular::kerr(a, Sense::Prograde);
                let r: f64 = x.powi(-2);
                let g = matter.orbit(r).unwrap().redshift_factor(lambda, 1.0).unwrap();
                let flux = match profile {
                    Profile::PageThorne => matter.flux(r),
                    Profile::PowerLaw { index } => r.powf(-index),
                    Profile::Even => 1.0,
                };
                assert!((glow.value / (g.powi(4) * flux) - 1.0).abs() < 1e-8);
                let h = 1e-4;
                let differences = [
                    (at(a, (r + h).powf(-0.5), lambda) - at(a, (r - h).powf(-0.5), lambda)) / (2.0 * h),
                    (at(a, x, lambda + h) - at(a, x, lambda - h)) / (2.0 * h),
                    (at(a + h, x, lambda) - at(a - h, x, lambda)) / (2.0 * h),
                ];
                for (found, difference) in [glow.radius, glow.lambda, glow.spin].iter().zip(differences) {
                    assert!(
                        (found - difference).abs() < 1e-5 * glow.value.abs().max(difference.abs()),
                        "{profile:?} {a} {x}: {found} {difference}"
                    );
                }
            }
        }
    }
}
