//! The shift of light between matter and a camera.

use super::{Departure, Equator};

/// A four-velocity in the equatorial plane: with respect to ∂t and ∂φ, and to unit vectors outwards and along +z that
/// are orthogonal to them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourVelocity {
    /// u^t.
    pub t: f64,
    /// u^φ.
    pub phi: f64,
    /// √g_rr u^r.
    pub radial: f64,
    /// √g_zz u^z.
    pub normal: f64,
}

impl FourVelocity {
    /// That of matter with an energy and an angular momentum per mass that moves within the plane, inwards if it has
    /// radial motion:
    ///   u^t = [g_φφ E + g_tφ L]/D,   u^φ = −[g_tφ E + g_tt L]/D,   g_rr (u^r)² = −1 − g^{ab} u_a u_b.
    /// None where there is no such motion.
    pub fn falling(equator: &Equator, energy: f64, momentum: f64) -> Option<Self> {
        let d = equator.determinant();
        let radial = equator.product([energy, momentum], [energy, momentum]) - 1.0;
        // Next to the last orbit rounding may show a negative square.
        (d > 0.0 && radial > -1e-9).then(|| Self {
            t: (equator.pp * energy + equator.tp * momentum) / d,
            phi: -(equator.tp * energy + equator.tt * momentum) / d,
            radial: -radial.max(0.0).sqrt(),
            normal: 0.0,
        })
    }

    /// −u·p/E, the frequency that the matter sends, for one of 1 at infinity:
    ///   u^t − λu^φ − u^r p_r − u^z p_z.
    pub fn frequency(&self, equator: &Equator, light: &Departure) -> f64 {
        let turning = self.t - light.lambda * self.phi;
        if self.radial == 0.0 && self.normal == 0.0 {
            return turning;
        }
        let [radial, across] = light.legs(equator);
        turning - self.radial * radial - self.normal * across
    }

    /// The cosine of the angle at which light leaves, in the matter's frame, against the plane's normal on its side: the
    /// part e_z + u_z u of e_z that is orthogonal to u, as a unit vector, times the direction of light,
    ///   |p_z − u_z ν|/(ν √(1 + u_z²)),
    /// which around a Kerr hole is g E √η/r for matter that stays within the plane.
    pub fn emission_cosine(&self, equator: &Equator, light: &Departure) -> f64 {
        let [_, across] = light.legs(equator);
        let frequency = self.frequency(equator, light);
        let along = across - self.normal * frequency;
        along.abs() / (frequency.abs() * (1.0 + self.normal * self.normal).sqrt())
    }

    /// The shift, None if it is not a positive number.
    ///
    /// Without the Doppler shift the matter is taken to be that without angular momentum at its place, u = (1, ω)/α, whose
    /// g is α/[(1 − ωλ)E].
    pub fn shift(&self, equator: &Equator, light: &Departure) -> Option<Shift> {
        let still = (1.0 - equator.dragging() * light.lambda) / equator.lapse();
        let frequency = self.frequency(equator, light);
        let shift = Shift { gravitational: (still * light.energy).recip(), doppler: still / frequency };
        let sound = |g: f64| g.is_finite() && g > 0.0;
        (sound(shift.gravitational) && sound(shift.doppler)).then_some(shift)
    }
}

/// g = ν_camera/ν_emitter in two factors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shift {
    /// That of light from matter without angular momentum at the same place, the camera's own motion included.
    pub gravitational: f64,
    /// What the matter's motion adds.
    pub doppler: f64,
}

impl Shift {
    /// g.
    pub fn factor(&self) -> f64 {
        self.gravitational * self.doppler
    }
}
