//! A place in a chart, and four-velocities of what moves there.

use crate::dual::Dual;
use crate::metric::{Kerr, Metric};
use crate::tensor::{Tensor, Vec3, Vec4, contract, product};

/// A place in Cartesian Kerr–Schild coordinates with spin s, and the coordinate directions there.
pub(super) struct Site {
    spin: f64,
    r: f64,
    /// √(r² + s²).
    width: f64,
    /// Sine of the polar angle.
    sin: f64,
    /// The place, M.
    pub(super) position: Vec3<f64>,
    /// g_{μν}.
    pub(super) metric: Tensor<f64>,
    /// Along ∂φ, of coordinate length 1.
    across: Vec4<f64>,
    /// ∂θ.
    down: Vec4<f64>,
}

impl Site {
    /// That of radius r, the sine and the cosine of θ, and the azimuth of the chart.
    pub(super) fn new<M: Metric>(
        metric: &M,
        spin: f64,
        r: f64,
        (sin, cos): (f64, f64),
        azimuth: f64,
    ) -> Self {
        let width = r.hypot(spin);
        let (sin_azimuth, cos_azimuth) = azimuth.sin_cos();
        let position = [width * sin * cos_azimuth, width * sin * sin_azimuth, r * cos];
        Self::with(metric, spin, r, (sin, cos), [cos_azimuth, sin_azimuth], position)
    }

    /// That of a point of the chart. Whatever the metric calls its radius, r is that of the coordinates (r, θ).
    pub(super) fn at<M: Metric>(metric: &M, spin: f64, position: Vec3<f64>) -> Self {
        let r = Kerr::new(spin).radius(&position);
        let [x, y, z] = position;
        let away = x.hypot(y);
        let azimuth = if away > 0.0 { [x / away, y / away] } else { [1.0, 0.0] };
        Self::with(metric, spin, r, (away / r.hypot(spin), z / r), azimuth, position)
    }

    fn with<M: Metric>(
        metric: &M,
        spin: f64,
        r: f64,
        (sin, cos): (f64, f64),
        [cos_azimuth, sin_azimuth]: [f64; 2],
        position: Vec3<f64>,
    ) -> Self {
        let width = r.hypot(spin);
        Self {
            spin,
            r,
            width,
            sin,
            position,
            metric: metric.components(&position),
            across: [0.0, -sin_azimuth, cos_azimuth, 0.0],
            down: [0.0, width * cos * cos_azimuth, width * cos * sin_azimuth, -r * sin],
        }
    }

    /// u ∝ ∂t + Ω ∂φ; NaN where that is not timelike.
    pub(super) fn turning(&self, rate: f64) -> Vec4<f64> {
        let sweep = rate * self.width * self.sin;
        unit(&self.metric, std::array::from_fn(|i| if i == 0 { 1.0 } else { sweep * self.across[i] }))
    }

    /// Zero angular momentum: g(u, ∂φ) = 0 for u ∝ ∂t + ω ∂φ; on the axis ω does not matter.
    pub(super) fn dragged(&self) -> Vec4<f64> {
        let (g, across) = (&self.metric, &self.across);
        let time = [1.0, 0.0, 0.0, 0.0];
        let reach = self.width * self.sin;
        self.turning(if reach == 0.0 {
            0.0
        } else {
            -product(g, &time, across) / (product(g, across, across) * reach)
        })
    }

    /// Free fall from rest at infinity, E = 1, L = 0, p_θ = 0: u = −dt̃ + u_r dr with, in ingoing
    /// coordinates, u_r = (2r − √X)/Δ = −2r/(2r + √X), X = 2r(r² + a²); reversed in time (`sense` −1) it rises,
    /// u_r = (2r + √X)/Δ. In flat space it stays at rest.
    pub(super) fn falling<M: Metric>(&self, metric: &M, sense: f64) -> Vec4<f64> {
        let (r, s) = (self.r, self.spin);
        let mass = if metric.horizon() > 0.0 { 1.0 } else { 0.0 };
        let speed = (2.0 * mass * r * (r * r + s * s)).sqrt();
        let rate = if mass == 0.0 {
            0.0
        } else if sense > 0.0 {
            -2.0 * r / (2.0 * r + speed)
        } else {
            (2.0 * r + speed) / (r * r - 2.0 * r + s * s)
        };
        let slope = metric.radius(&Dual::variables(self.position)).gradient;
        let covector = [-1.0, rate * slope[0], rate * slope[1], rate * slope[2]];
        contract(&metric.inverse_components(&self.position), &covector)
    }

    /// What moves with velocity v, along (e_r, e_θ, e_φ), past an observer with four-velocity `rest`.
    pub(super) fn boosted<M: Metric>(&self, metric: &M, rest: Vec4<f64>, v: &Vec3<f64>) -> Vec4<f64> {
        let axes = self.axes(metric, &rest);
        unit(
            &self.metric,
            std::array::from_fn(|i| rest[i] + v[0] * axes[0][i] + v[1] * axes[1][i] + v[2] * axes[2][i]),
        )
    }

    /// e_r, e_θ, e_φ for the velocity u: Gram–Schmidt on ∂φ, then ∂θ, then what is left, with the
    /// orientation of (r, θ, φ).
    pub(super) fn axes<M: Metric>(&self, metric: &M, u: &Vec4<f64>) -> [Vec4<f64>; 3] {
        let g = &self.metric;
        let e_phi = normed(g, without(g, &self.across, u, -1.0));
        let e_theta = normed(g, without(g, &without(g, &self.down, u, -1.0), &e_phi, 1.0));
        // The covector that vanishes on u, e_θ and e_φ, by 3×3 determinants; its sign makes
        // (u, e_r, e_θ, e_φ) positively oriented.
        let rows = [u, &e_theta, &e_phi];
        let covector: Vec4<f64> = std::array::from_fn(|i| {
            let c: [usize; 3] = std::array::from_fn(|k| if k < i { k } else { k + 1 });
            let m = |r: usize, k: usize| rows[r][c[k]];
            let determinant = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1))
                - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0))
                + m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
            if i % 2 == 0 { -determinant } else { determinant }
        });
        let e_r = normed(g, contract(&metric.inverse_components(&self.position), &covector));
        [e_r, e_theta, e_phi]
    }
}

/// The timelike unit vector along v.
pub(super) fn unit(g: &Tensor<f64>, v: Vec4<f64>) -> Vec4<f64> {
    let length = (-product(g, &v, &v)).sqrt();
    v.map(|c| c / length)
}

/// The spacelike unit vector along v.
pub(super) fn normed(g: &Tensor<f64>, v: Vec4<f64>) -> Vec4<f64> {
    let length = product(g, &v, &v).sqrt();
    v.map(|c| c / length)
}

/// v without its part along the unit vector e, whose square is `norm`.
pub(super) fn without(g: &Tensor<f64>, v: &Vec4<f64>, e: &Vec4<f64>, norm: f64) -> Vec4<f64> {
    let part = product(g, v, e) * norm;
    std::array::from_fn(|i| v[i] - part * e[i])
}
