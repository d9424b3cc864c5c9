//! The Kerr hole in ingoing Kerr–Schild Cartesian coordinates (Visser 2008, arXiv:0706.0622, eq. 43–46).
//!
//! g_{μν} = η_{μν} + f l_μ l_ν,   f = 2 r³/(r⁴ + s² z²) = 2r/Σ,
//! l = (1, (rx + sy)/(r² + s²), (ry − sx)/(r² + s²), z/r),
//! r² = b/2 + √((b/2)² + s²z²),   b = x² + y² + z² − s²;   g^{μν} = η^{μν} − f l^μ l^ν.
//!
//! The spin here is called s: a camera's ray is followed in the spacetime with s = −a.

use super::{Inverted, Metric, Rate};
use crate::kerr::horizons;
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3, cross, dot, each};
use std::ops::{Add, Mul, Sub};

/// A hole of mass 1 and spin s in [−1, 1] about +z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kerr {
    spin: f64,
}

impl Kerr {
    /// A hole of spin s in [−1, 1].
    pub const fn new(spin: f64) -> Self {
        Self { spin }
    }

    /// s.
    pub const fn spin(&self) -> f64 {
        self.spin
    }
}

/// w r around a hole of spin s, which is 1 at infinity.
#[inline(always)]
pub(crate) fn scaled_radius<S: Scalar>(spin: S, state: &Inverted<S>) -> S {
    spheroid(&state.n, state.w * spin)[1].sqrt()
}

/// The spatial part of l around a hole of spin s.
#[inline(always)]
pub(crate) fn principal_null<S: Scalar>(spin: S, state: &Inverted<S>) -> Vec3<S> {
    Field::at(&state.n, state.w * spin).l
}

/// The spin at a place: a constant, or one that scales with the distance.
trait Spin: Copy + Mul<Output = Self> {}
impl<P: Copy + Mul<Output = P>> Spin for P {}

/// What arithmetic there has to be with it.
trait Times<P>: Add<P, Output = Self> + Sub<P, Output = Self> + Mul<P, Output = Self> + Sized {}
impl<P, S: Add<P, Output = S> + Sub<P, Output = S> + Mul<P, Output = S>> Times<P> for S {}

/// Σ/2 and r² at x around a hole of spin s.
#[inline(always)]
fn spheroid<S: Scalar + Times<P>, P: Spin>(x: &Vec3<S>, spin: P) -> [S; 2] {
    let [x, y, z] = *x;
    let (s2, z2) = (spin * spin, z * z);
    let half = (x.mul_add(x, y.mul_add(y, z2)) - s2) * 0.5;
    let half_sigma = half.mul_add(half, z2 * s2).sqrt();
    [half_sigma, half + half_sigma]
}

/// The quantities of the metric at a point.
struct Field<S> {
    /// r.
    r: S,
    /// 1/r.
    inverse_r: S,
    /// 1/Σ, Σ = r² + s² z²/r².
    inverse_sigma: S,
    /// 1/(r² + s²).
    weight: S,
    /// Spatial part of l.
    l: Vec3<S>,
}

impl<S: Scalar> Field<S> {
    #[inline(always)]
    fn at<P: Spin>(x: &Vec3<S>, spin: P) -> Self
    where
        S: Times<P>,
    {
        let [half_sigma, r2] = spheroid(x, spin);
        let [x, y, z] = *x;
        let r = r2.sqrt();
        let wide = r2 + spin * spin;
        // One division for three: they cost more than all else here.
        let both = half_sigma * r;
        let inverse = (both * wide).recip();
        let weight = inverse * both;
        let inverse_r = inverse * (half_sigma * wide);
        Self {
            r,
            inverse_r,
            inverse_sigma: inverse * (r * wide) * 0.5,
            weight,
            l: [r.mul_add(x, y * spin) * weight, r.mul_add(y, -(x * spin)) * weight, z * inverse_r],
        }
    }

    /// ℓ = E + l·p and the coefficients of ½∇(fℓ²)/f.
    #[inline(always)]
    fn pull(&self, x: &Vec3<S>, p: &Vec3<S>, energy: S, spin: S) -> Pull<S> {
        let a = x[0].mul_add(p[0], x[1] * p[1]);
        let c = x[1].mul_add(p[0], -(x[0] * p[1]));
        let g = self.weight * self.r.mul_add(a, spin * c);
        let rise = x[2] * (self.inverse_r * p[2]);
        let l = g + rise + energy;
        // −∂(l·p)/∂r at fixed x: w(2rg − A) + z p_z/r².
        let inwards = (self.r * 2.0).mul_add(g, -a);
        let fall = self.weight.mul_add(inwards, rise * self.inverse_r);
        // K/f = ½ℓ²(3/r − 4r/Σ) + ℓ N_r.
        let explicit = (self.r * -2.0).mul_add(self.inverse_sigma, self.inverse_r * 1.5);
        Pull { l, along_r: l * l.mul_add(explicit, -fall) }
    }
}

struct Pull<S> {
    l: S,
    along_r: S,
}

impl Metric for Kerr {
    const PASSES_INFINITY: bool = true;

    #[inline(always)]
    fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        kerr_schild(self.spin, x, 1.0)
    }

    #[inline(always)]
    fn inverse_components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        kerr_schild(self.spin, x, -1.0)
    }

    #[inline(always)]
    fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S {
        spheroid(x, self.spin)[1].sqrt()
    }

    fn horizon(&self) -> f64 {
        horizons(self.spin).0
    }

    /// Hand-derived from H = ½(p² − E² − fℓ²); 119 floating-point operations.
    #[inline(always)]
    fn rate<S: Scalar>(&self, energy: S, x: &Vec3<S>, p: &Vec3<S>) -> Rate<S> {
        let s = energy.constant(self.spin);
        let field = Field::at(x, s);
        let Pull { l, along_r } = field.pull(x, p, energy, s);
        let f = field.r * field.inverse_sigma * 2.0;
        let drift = f * l;
        let turn = drift * field.weight;
        // ∇r = (xr/Σ, yr/Σ, z(r² + s²)/(rΣ)).
        let radial = f * along_r * field.inverse_sigma;
        let (flat, rise) = (radial * field.r, radial * field.inverse_r / field.weight);
        // The explicit z in Σ: −fℓ² s² z/(r² Σ).
        let oblate = drift * l * (s * field.inverse_r).squared() * field.inverse_sigma;
        Rate {
            velocity: each(
                #[inline(always)]
                |i| p[i] - drift * field.l[i],
            ),
            force: [
                flat * x[0] + turn * (field.r * p[0] - s * p[1]),
                flat * x[1] + turn * (field.r * p[1] + s * p[0]),
                rise * x[2] + drift * field.inverse_r * p[2] - oblate * x[2],
            ],
        }
    }

    /// The field is scale-free: at x = n/w with spin s it is that at n with spin ŝ = s w, and
    /// f = w F with F = 2r̂/Σ̂, r̂ = w r. Writing P = dp/dσ and using the Jacobi identity for
    /// the terms of first order in s, every division by w cancels (k = J × n):
    ///   w′ = wc − q,   n′ = k − Fℓ l + c n,   c = Fℓ n·l
    ///   q′ = w n′·k + n·P
    ///   J′ = s w Fℓŵ ẑ×J + s² w {(Fℓŵ/r̂)(p_z n + n_z p) + n_z [K̂/(r̂Σ̂) − Fℓ²/(r̂²Σ̂)] n} × ẑ
    /// with ŵ = 1/(r̂² + ŝ²) and
    ///   n·P = K̂ n·∇r̂ + Fℓ(ℓ − E) − Fℓ² ŝ² n_z²/(r̂²Σ̂),   n·∇r̂ = (r̂/Σ̂)(|n|² + ŝ² n_z²/r̂²).
    /// Any c leaves x = n/w unchanged. With this one an error in |n| would grow around a photon
    /// orbit; multiplied by 3 − 2|n|², which is one, it decays. |n|² in n·∇r̂ keeps the slope of elapsed time, where n·P
    /// is divided by w, from an error in |n| of first order.
    #[inline(always)]
    fn inverted_rate<S: Scalar>(&self, energy: S, state: &Inverted<S>) -> Inverted<S> {
        let Inverted { w, n, q, j } = *state;
        let s = w * self.spin;
        let field = Field::at(&n, s);
        let k = cross(&j, &n);
        let p: Vec3<S> = each(
            #[inline(always)]
            |i| q.mul_add(n[i], w * k[i]),
        );
        let Pull { l, along_r } = field.pull(&n, &p, energy, s);
        let f = field.r * field.inverse_sigma * 2.0;
        let drift = f * l;
        let radial = f * along_r;
        let square = dot(&n, &n);
        let lengthening = drift * dot(&n, &field.l) * square.mul_add(w.constant(-2.0), w.constant(3.0));
        let turn: Vec3<S> = each(
            #[inline(always)]
            |i| n[i].mul_add(lengthening, (-drift).mul_add(field.l[i], k[i])),
        );
        let height = s * n[2] * field.inverse_r;
        let flattening = height.squared();
        let oblate = drift * l * field.inverse_sigma;
        let inwards = radial * field.inverse_sigma;
        let level = (inwards * field.r).mul_add(flattening + square, drift * (l - energy));
        let pull = flattening.mul_add(-oblate, level);
        // Frame dragging turns J about z; oblateness tilts it.
        let whirl = drift * field.weight;
        let precession = whirl * s;
        let tilt = s * self.spin;
        let mixed = tilt * whirl * field.inverse_r;
        let bulge = tilt * n[2] * field.inverse_r * oblate.mul_add(-field.inverse_r, inwards);
        let torque: [S; 2] = each(
            #[inline(always)]
            |i| mixed.mul_add(p[2].mul_add(n[i], n[2] * p[i]), bulge * n[i]),
        );
        Inverted {
            w: w.mul_add(lengthening, -q),
            n: turn,
            q: w.mul_add(dot(&turn, &k), pull),
            j: [precession.mul_add(-j[1], torque[1]), precession.mul_add(j[0], -torque[0]), w.constant(0.0)],
        }
    }

    fn reversed(&self) -> Self {
        Self::new(-self.spin)
    }

    /// atan2(s, r) + s/(r₊ − r₋) ln((r − r₊)/(r − r₋)): the turn of x + iy = (r + is) e^{iφ̃} sin θ
    /// and that of φ̃ against φ.
    fn azimuth_offset(&self, r: f64) -> f64 {
        let (outer, inner) = horizons(self.spin);
        let gap = outer - inner;
        let twist = if gap < 1e-7 {
            // −s/(r − 1)[1 + O(gap²/(r − 1)²)]
            -self.spin / (r - 1.0)
        } else {
            self.spin / gap * (-gap / (r - inner)).ln_1p()
        };
        self.spin.atan2(r) + twist
    }

    /// 2/(r₊ − r₋) [r₊ ln(r − r₊) − r₋ ln(r − r₋)].
    fn time_offset(&self, r: f64) -> f64 {
        let (outer, inner) = horizons(self.spin);
        let gap = outer - inner;
        if gap < 1e-7 {
            2.0 * (r - 1.0).ln() - 2.0 / (r - 1.0)
        } else {
            // r₊ ln(r − r₊) − r₋ ln(r − r₋) = gap·ln(r − r₋) + r₊ ln((r − r₊)/(r − r₋)).
            2.0 * (r - inner).ln() + 2.0 * outer / gap * (-gap / (r - inner)).ln_1p()
        }
    }

    /// E(r₊² + s²) − sL > 0: the photon fell in through the horizon of our exterior. Any other
    /// came from beyond the inner or the past horizon, and followed backwards would pile up at r₊.
    fn rises(&self, energy: f64, angular_momentum: f64) -> bool {
        // The ray is minus the photon's momentum.
        let (energy, angular_momentum) = (-energy, -angular_momentum);
        energy > 0.0 && 2.0 * self.horizon() * energy > self.spin * angular_momentum
    }

    /// Both charts share r, θ and, through Boyer–Lindquist coordinates, p_θ and L; with
    /// p_r^KS = p_r + (2rE − sL)/Δ and ∇φ̃ = ẑ × x/ϖ² + s∇r/(r² + s²), s → −s and E → −E give
    /// p′ = R p + c ∇r, c = −2(2rE − sL)/Δ − 2sL/(r² + s²), R the turn by −2 × azimuth offset.
    fn change_sheet(&self, energy: f64, state: &Inverted<f64>) -> Inverted<f64> {
        let Inverted { w, n, q, j } = *state;
        let s = self.spin;
        let field = Field::at(&n, w * s);
        let r = field.r / w;
        let delta = r * r - 2.0 * r + s * s;
        let kick = -2.0 * (2.0 * r * energy - s * j[2]) / delta - 2.0 * s * j[2] / (r * r + s * s);
        let (sin, cos) = (-2.0 * self.azimuth_offset(r)).sin_cos();
        let turn = |v: Vec3<f64>| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
        let (n, j) = (turn(n), turn(j));
        // ∇r = (r̂/Σ̂)(n + (ŝ²/r̂²) n_z ẑ).
        let tilt = (w * s * field.inverse_r).powi(2) * n[2];
        let slope = [n[0], n[1], n[2] + tilt].map(|c| c * field.r * field.inverse_sigma * kick);
        let torque = cross(&n, &slope);
        Inverted {
            w,
            n,
            q: q + dot(&n, &slope),
            j: each(
                #[inline(always)]
                |i| j[i] + torque[i] / w,
            ),
        }
    }

    /// 1/U at the least value of the radial potential U(u) = 1 + Bu² + 2Cu³ − Qu⁴ outside the
    /// horizon (λ, η of the reversed photon; B = s² − λ² − η, C = (λ − s)² + η, Q = s²η): U is
    /// about the relative distance to the critical curve, U = 1 far from it.
    fn sensitivity(&self, energy: f64, start: &Inverted<f64>) -> f64 {
        let s = self.spin;
        let lambda = start.j[2] / energy;
        let eta = crate::kerr::carter(s, energy, start) / (energy * energy);
        let b = s * s - lambda * lambda - eta;
        let c = (lambda - s).powi(2) + eta;
        let q = s * s * eta;
        let discriminant = 9.0 * c * c + 8.0 * q * b;
        if b >= 0.0 || discriminant < 0.0 {
            return 1.0;
        }
        let least = (-2.0 * b / (3.0 * c + discriminant.sqrt())).min(1.0 / self.horizon());
        let potential = 1.0 + least * least * (b + least * (2.0 * c - q * least));
        1.0 + potential.abs().recip().min(1e15)
    }

    /// q² + w²(J × n)² − E² − wFℓ², regular at infinity.
    fn norm(&self, energy: f64, state: &Inverted<f64>) -> f64 {
        let s = state.w * self.spin;
        let field = Field::at(&state.n, s);
        let p = state.momentum();
        let l = field.pull(&state.n, &p, energy, s).l;
        dot(&p, &p) - energy * energy - 2.0 * state.w * field.r * field.inverse_sigma * l * l
    }

    fn carter(&self, energy: f64, state: &Inverted<f64>) -> Option<f64> {
        Some(crate::kerr::carter(self.spin, energy, state))
    }

    fn windings(&self, energy: f64, start: &Inverted<f64>) -> f64 {
        crate::closed::windings(*self, energy, start)
    }

    #[inline(always)]
    fn inverse_radius<S: Scalar>(&self, w: S, n: &Vec3<S>) -> S {
        w / spheroid(n, w * self.spin)[1].sqrt()
    }
}

/// η ± f l l, all indices down for +1, all up for −1 (then l^t = −l_t).
#[inline(always)]
fn kerr_schild<S: Scalar>(spin: f64, x: &Vec3<S>, sign: f64) -> Tensor<S> {
    let field = Field::at(x, spin);
    let f = field.r * field.inverse_sigma * (2.0 * sign);
    let [a, b, c] = field.l;
    let (fa, fb, fc) = (f * a, f * b, f * c);
    // With l_t = ±1; nothing is multiplied by it, for a dual number would be by its zeros too.
    let [ta, tb, tc] = [fa * sign, fb * sign, fc * sign];
    let (ab, ac, bc) = (fa * b, fa * c, fb * c);
    [
        [f - 1.0, ta, tb, tc],
        [ta, fa * a + 1.0, ab, ac],
        [tb, ab, fb * b + 1.0, bc],
        [tc, ac, bc, fc * c + 1.0],
    ]
}
