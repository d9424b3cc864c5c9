//! The light of matter in the plane, as pictures need it.

use super::matter::Glow;

/// Matter that shines.
pub trait Shine: Sync {
    /// F, dF/dr, dF/da and dF/dq at r = x⁻², a being the first of the hole's parameters.
    fn flux(&self, x: f64) -> [f64; 4];

    /// The light of the place r = x⁻² whose photons have λ.
    fn glow(&self, x: f64, lambda: f64) -> Glow;

    /// Whether all of it is equally bright.
    fn even(&self) -> bool {
        false
    }

    /// A length over which the flux bends, M: √(F_max/|F″|) for the largest flux between both ends of the table.
    fn smoothness(&self, x: f64, largest: f64) -> f64 {
        let r = x.powi(-2);
        let h = 0.01 * r;
        let at = |r: f64| self.flux(r.powf(-0.5))[0];
        let bend = (at(r + h) - 2.0 * at(r) + at(r - h)) / (h * h);
        (largest / bend.abs().max(1e-300)).sqrt()
    }
}
