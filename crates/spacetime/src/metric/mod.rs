//! Stationary spacetimes in Cartesian-like coordinates (t, x, y, z).
//!
//! A spacetime is a small file that gives its metric components; the equations of motion
//! follow from them by dual numbers. One that can do better overrides them.

mod components;
mod kerr;
mod minkowski;
mod schwarzschild;
mod text;

pub use components::Components;
pub use kerr::Kerr;
pub(crate) use kerr::{principal_null, scaled_radius};
pub use minkowski::Minkowski;
pub use schwarzschild::Schwarzschild;
pub use text::{Definition, DefinitionFault, Kind, LineElement, NotFlat, Part, Reversal, Text};

use crate::dual::Dual;
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3, contract, cross, dot, each, inverse, product};

/// A stationary, asymptotically flat spacetime.
///
/// Photons obey Hamilton's equations for H = ½ g^{μν} p_μ p_ν = 0, with p_t = −energy conserved.
pub trait Metric: Copy + Send + Sync {
    /// Whether [`Metric::inverted_rate`] is smooth through infinity, to w < 0. Otherwise steps end close to w = 0.
    const PASSES_INFINITY: bool = false;

    /// g_{μν} at x. Nothing depends on t.
    fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S>;

    /// g^{μν} at x.
    #[inline(always)]
    fn inverse_components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        inverse(&self.components(x))
    }

    /// The radius by which the horizon and disks are measured, in M.
    fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S;

    /// The radius of the horizon, 0 where there is none.
    fn horizon(&self) -> f64;

    /// dx/dλ and dp/dλ for affine λ.
    #[inline(always)]
    fn rate<S: Scalar>(&self, energy: S, x: &Vec3<S>, p: &Vec3<S>) -> Rate<S> {
        rate_from_components(self, energy, x, p)
    }

    /// The same in the inverted chart of [`Inverted`].
    #[inline(always)]
    fn inverted_rate<S: Scalar>(&self, energy: S, state: &Inverted<S>) -> Inverted<S> {
        inverted_from_rate(self, energy, state)
    }

    /// The spacetime reversed in time, in the chart in which light falling into it is regular at
    /// the horizon. A static spacetime is its own mirror image.
    fn reversed(&self) -> Self {
        *self
    }

    /// Azimuth of n less the Boyer–Lindquist azimuth, at radius r outside the horizon.
    fn azimuth_offset(&self, _r: f64) -> f64 {
        0.0
    }

    /// Time of this chart less the Boyer–Lindquist time, at radius r outside the horizon,
    /// growing as 2 ln r far away if at all.
    fn time_offset(&self, _r: f64) -> f64 {
        0.0
    }

    /// Whether a ray followed backwards from inside the horizon (Side::Ingoing of
    /// [`crate::geodesic::Side`], with its own energy and J_z) rises through it into our sky.
    fn rises(&self, _energy: f64, _angular_momentum: f64) -> bool {
        false
    }

    /// A ray of Side::Ingoing outside the horizon, in the chart of Side::Reversed.
    fn change_sheet(&self, _energy: f64, state: &Inverted<f64>) -> Inverted<f64> {
        *state
    }

    /// How an error in a ray's conserved quantities grows into one of its direction: about one,
    /// and without bound towards the critical curve.
    fn sensitivity(&self, _energy: f64, _start: &Inverted<f64>) -> f64 {
        1.0
    }

    /// 2H = g^{μν} p_μ p_ν, zero for light.
    fn norm(&self, energy: f64, state: &Inverted<f64>) -> f64 {
        let p = state.momentum();
        if state.w.abs() < 1e-12 {
            return dot(&p, &p) - energy * energy;
        }
        let p = [-energy, p[0], p[1], p[2]];
        product(&self.inverse_components(&state.n.map(|c| c / state.w)), &p, &p)
    }

    /// A further constant of the motion beside energy and L_z, where there is one.
    fn carter(&self, _energy: f64, _state: &Inverted<f64>) -> Option<f64> {
        None
    }

    /// How often light goes round from its start on, as
    /// [`Path::windings`](crate::geodesic::Path::windings) has it; NaN where that is not known.
    fn windings(&self, _energy: f64, _start: &Inverted<f64>) -> f64 {
        f64::NAN
    }

    /// 1/radius in the inverted chart; next to infinity w itself.
    #[inline(always)]
    fn inverse_radius<S: Scalar>(&self, w: S, n: &Vec3<S>) -> S {
        let near = w.constant(1e-12).less(w);
        let inverse_w = S::select(near, w, w.constant(1.0)).recip();
        let x = each(
            #[inline(always)]
            |i| n[i] * inverse_w,
        );
        S::select(near, self.radius(&x).recip(), w)
    }

    /// In the inverted chart, what is above 1/horizon where light is captured: 1/radius, unless a horizon is no surface
    /// of equal radius.
    #[inline(always)]
    fn inverse_depth<S: Scalar>(&self, w: S, n: &Vec3<S>) -> S {
        self.inverse_radius(w, n)
    }

    /// 1/distance from the origin where rays end as escaped: 0, unless space does not become flat.
    fn edge(&self) -> f64 {
        0.0
    }

    /// Whether the horizon is a throat, |x| = horizon, on whose other side space goes on as the mirror image of this.
    fn has_throat(&self) -> bool {
        false
    }

    /// Whether nothing depends on the azimuth, so that light keeps its J_z.
    fn is_axisymmetric(&self) -> bool {
        true
    }

    /// The unit vector of where light goes that ends escaped in this state.
    fn way_out(&self, _energy: f64, state: &Inverted<f64>) -> Vec3<f64> {
        state.n
    }
}

/// The right-hand side of Hamilton's equations.
#[derive(Clone, Copy, Debug)]
pub struct Rate<S> {
    /// dx/dλ.
    pub velocity: Vec3<S>,
    /// dp/dλ.
    pub force: Vec3<S>,
}

/// A photon in the inverted chart, or the rate at which its variables change.
///
/// Position x = n/w; momentum p = q n + w J × n, so q = n·p and J = x × p. With the
/// parameter σ, dσ = w² dλ, infinity (w = 0) is an ordinary point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inverted<S> {
    /// Inverse Euclidean distance from the origin, 1/M.
    pub w: S,
    /// Unit vector to the photon.
    pub n: Vec3<S>,
    /// Radial momentum.
    pub q: S,
    /// Angular momentum.
    pub j: Vec3<S>,
}

impl<S: Scalar> Inverted<S> {
    /// p = q n + w J × n.
    #[inline(always)]
    pub fn momentum(&self) -> Vec3<S> {
        let k = cross(&self.j, &self.n);
        [
            self.q.mul_add(self.n[0], self.w * k[0]),
            self.q.mul_add(self.n[1], self.w * k[1]),
            self.q.mul_add(self.n[2], self.w * k[2]),
        ]
    }
}

/// Hamilton's equations from the components of the metric alone:
///   dxᵘ/dλ = g^{μν} p_ν,   dp_i/dλ = −½ ∂_i g^{μν} p_μ p_ν = ½ ∂_i g_{μν} ẋᵘ ẋᵛ,
/// the derivatives exact by dual numbers.
#[inline(always)]
pub fn rate_from_components<M: Metric, S: Scalar>(
    metric: &M,
    energy: S,
    x: &Vec3<S>,
    p: &Vec3<S>,
) -> Rate<S> {
    let lowered = metric.components(&Dual::variables(*x));
    let mut g = [[energy; 4]; 4];
    for m in 0..4 {
        for n in m..4 {
            g[m][n] = lowered[m][n].value;
            g[n][m] = g[m][n];
        }
    }
    let rate = contract(&inverse(&g), &[-energy, p[0], p[1], p[2]]);
    let mut force = [energy.constant(0.0); 3];
    for m in 0..4 {
        for n in m..4 {
            // Each pair of indices comes twice.
            let weight = rate[m] * rate[n] * if m == n { 0.5 } else { 1.0 };
            for i in 0..3 {
                force[i] = weight.mul_add(lowered[m][n].gradient[i], force[i]);
            }
        }
    }
    Rate { velocity: [rate[1], rate[2], rate[3]], force }
}

/// The 1/distance below which [`inverted_from_rate`] extrapolates.
const NEAR_INFINITY: f64 = 1e-4;

/// The inverted chart's equations from Hamilton's:
///   w′ = −n·ẋ,   n′ = (ẋ − n n·ẋ)/w,   q′ = (n′·p + n·ṗ/w²),   J′ = (ẋ × p + x × ṗ)/w².
///
/// Divisions by w amplify rounding, to 1e-16/w in n′ and 1e-16/w² in J′. Below w = ε = 1e-4 the right-hand side F,
/// which is regular at w = 0, is 2F(ε) − F(2ε) + (F(2ε) − F(ε)) w/ε, the error being about F″ε². A metric with a
/// closed form overrides this.
#[inline(always)]
pub fn inverted_from_rate<M: Metric, S: Scalar>(metric: &M, energy: S, state: &Inverted<S>) -> Inverted<S> {
    let edge = state.w.constant(NEAR_INFINITY);
    let beyond = state.w.less(edge);
    let at = Inverted { w: S::select(beyond, edge, state.w), ..*state };
    let rate = state.w.outline(
        #[inline(always)]
        || inverted_rate_at(metric, energy, &at),
    );
    if !S::any(beyond) {
        return rate;
    }
    let at = Inverted { w: edge * 2.0, ..*state };
    let double = state.w.outline(
        #[inline(always)]
        || inverted_rate_at(metric, energy, &at),
    );
    let share = S::select(beyond, state.w * (1.0 / NEAR_INFINITY) - 1.0, state.w.constant(0.0));
    Inverted {
        w: share.mul_add(double.w - rate.w, rate.w),
        n: each(
            #[inline(always)]
            |i| share.mul_add(double.n[i] - rate.n[i], rate.n[i]),
        ),
        q: share.mul_add(double.q - rate.q, rate.q),
        j: each(
            #[inline(always)]
            |i| share.mul_add(double.j[i] - rate.j[i], rate.j[i]),
        ),
    }
}

#[inline(always)]
fn inverted_rate_at<M: Metric, S: Scalar>(metric: &M, energy: S, state: &Inverted<S>) -> Inverted<S> {
    let Inverted { w, n, .. } = *state;
    let p = state.momentum();
    let inverse_w = w.recip();
    let x: Vec3<S> = each(
        #[inline(always)]
        |i| n[i] * inverse_w,
    );
    let Rate { velocity, force } = metric.rate(energy, &x, &p);
    let along = dot(&n, &velocity);
    // 1 to the letter. Any factor leaves x = n/w as it is; with this one an error in |n| does not grow.
    let lengthening = along * (-dot(&n, &n) + 2.0);
    let turn: Vec3<S> = each(
        #[inline(always)]
        |i| (velocity[i] - n[i] * lengthening) * inverse_w,
    );
    let push: Vec3<S> = each(
        #[inline(always)]
        |i| force[i] * inverse_w * inverse_w,
    );
    let (swept, torque) = (cross(&velocity, &p), cross(&x, &push));
    Inverted {
        w: -lengthening,
        n: turn,
        q: dot(&turn, &p) + dot(&n, &push),
        j: each(
            #[inline(always)]
            |i| (swept[i] * inverse_w).mul_add(inverse_w, torque[i]),
        ),
    }
}
