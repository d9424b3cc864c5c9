//! The circular orbits of any stationary, axisymmetric metric, from its components.

use super::circular::Orbit;
use super::{Equator, Sense};
use crate::dual::Dual;
use crate::metric::Metric;
use crate::scalar::Scalar;
use crate::tensor::Tensor;

/// A number and its derivative along x.
type Slope = Dual<f64, 1>;

/// A number and its two derivatives along x.
type Bend = Dual<Slope, 1>;

/// Circles in the equatorial plane, at x = (ρ, 0, 0), and the matter that moves along them as geodesics.
#[derive(Clone, Copy, Debug)]
pub struct Family<'a, M> {
    pub metric: &'a M,
    pub sense: Sense,
}

/// A circular orbit and what the flux of a disk needs of its neighbours.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    pub orbit: Orbit,
    /// Derivatives along ρ of Ω, E and L.
    pub rate_slope: f64,
    pub energy_slope: f64,
    pub momentum_slope: f64,
    /// √−g of t, ρ and φ.
    pub volume: f64,
}

impl<M: Metric> Family<'_, M> {
    /// g_tt, g_tφ, g_φφ with φ-lines along y at (ρ, 0, 0), where ∂φ = ρ∂y.
    fn parts<S: Scalar>(g: &Tensor<S>, x: S) -> [S; 3] {
        [g[0][0], g[0][2] * x, g[2][2] * x * x]
    }

    /// The metric of a circle.
    pub fn equator(&self, x: f64) -> Equator {
        let g = self.metric.components(&[x, 0.0, 0.0]);
        let [tt, tp, pp] = Self::parts(&g, x);
        Equator { tt, tp, pp, zz: g[3][3] }
    }

    /// The radius by which the metric measures disks.
    pub fn radius(&self, x: f64) -> f64 {
        self.metric.radius(&[x, 0.0, 0.0])
    }

    /// The circular geodesic, if there is one, stable or not.
    ///
    /// A circle is a geodesic where g_tt′ + 2g_tφ′Ω + g_φφ′Ω² = 0:
    ///   Ω = [−g_tφ′ ± √(g_tφ′² − g_tt′ g_φφ′)]/g_φφ′,   u^t = 1/√(−g_tt − 2g_tφΩ − g_φφΩ²),
    ///   E = −u^t (g_tt + g_tφΩ),   L = u^t (g_tφ + g_φφΩ).
    pub fn ring(&self, x: f64) -> Option<Ring> {
        let at = Dual { value: Dual::variable([x], 0), gradient: [Dual::fixed(1.0)] };
        let zero = at.constant(0.0);
        let g = self.metric.components(&[at, zero, zero]);
        let [tt, tp, pp]: [Bend; 3] = Self::parts(&g, at);
        let [d_tt, d_tp, d_pp]: [Slope; 3] = [tt, tp, pp].map(|part| part.gradient[0]);
        let [tt, tp, pp] = [tt, tp, pp].map(|part| part.value);
        let root = (d_tp * d_tp - d_tt * d_pp).sqrt() * self.sense.sign();
        let rate = (root - d_tp) / d_pp;
        let time = (-(tt + tp * rate * 2.0 + pp * rate * rate)).sqrt().recip();
        let energy = -(time * (tt + tp * rate));
        let momentum = time * (tp + pp * rate);
        let orbit =
            Orbit { rate: rate.value, time: time.value, energy: energy.value, momentum: momentum.value };
        let goes_around = orbit.rate * self.sense.sign() > 0.0 && d_pp.value > 0.0;
        let slopes = [rate, energy, momentum].map(|part| part.gradient[0]);
        let sound = [orbit.time, orbit.energy, slopes[0], slopes[1], slopes[2]].iter().all(|s| s.is_finite());
        let g = g.map(|row| row.map(|part| part.value.value));
        (goes_around && sound).then(|| Ring {
            orbit,
            rate_slope: slopes[0],
            energy_slope: slopes[1],
            momentum_slope: slopes[2],
            volume: x * (-block(&g)).max(0.0).sqrt(),
        })
    }

    /// The slope along ρ of the rate of light that moves along the circle, Ω = (−g_tφ ± √D)/g_φφ.
    pub fn light_slope(&self, x: f64) -> f64 {
        let at = Dual::variable([x], 0);
        let g = self.metric.components(&[at, Dual::fixed(0.0), Dual::fixed(0.0)]);
        let [tt, tp, pp]: [Slope; 3] = Self::parts(&g, at);
        let root = (tp * tp - tt * pp).sqrt() * self.sense.sign();
        ((root - tp) / pp).gradient[0]
    }

    /// Whether g_tt, g_tφ, g_φφ do not change across the plane, so that what moves within it stays there.
    pub fn is_level(&self, x: f64) -> bool {
        let at = [Dual::fixed(x), Dual::fixed(0.0), Dual::<f64, 1>::variable([0.0], 0)];
        let g = self.metric.components(&at);
        let [tt, tp, pp] = Self::parts(&g, at[0]).map(|part| part.gradient[0]);
        tt.abs().max(tp.abs() / x).max(pp.abs() / (x * x)) * x < 1e-9
    }
}

/// The determinant over t, x and y.
fn block(g: &Tensor<f64>) -> f64 {
    g[0][0] * (g[1][1] * g[2][2] - g[1][2] * g[1][2]) - g[0][1] * (g[0][1] * g[2][2] - g[1][2] * g[0][2])
        + g[0][2] * (g[0][1] * g[1][2] - g[1][1] * g[0][2])
}
