//! Rays sorted out for lanes: classified eight at a time, and gathered again with others of their kind.

use fearless_simd::Simd;

use super::batch::{Shared, WIDTH};
use super::course::{Class, Course};
use super::horizons::Horizons;
use super::kernel::Start;
use super::photon::Photon;
use super::polar::{FEW_REACH, LARGE_REACH, SOME_REACH, size_of_nome};
use super::tracer::PLANAR;
use crate::geodesic::Ray;
use crate::lanes::Lanes;
use crate::metric::Inverted;
use crate::scalar::Scalar;

/// A ray ready to be followed among others of its kind.
#[derive(Clone, Copy)]
pub struct Ready {
    /// Its number.
    pub ray: u32,
    /// λ, η, u, u′, μ, μ′; inwards, side, shape, lead, end; azimuth.
    pub numbers: [f64; NUMBERS],
}

/// λ to azimuth.
pub const NUMBERS: usize = 12;

impl Ready {
    /// The start of up to eight rays around a hole of spin s; what is missing repeats the last.
    #[inline(always)]
    pub fn start<L: Simd>(simd: L, some: &[Self], spin: f64) -> Start<Lanes<L>> {
        let ray = |lane: usize| &some[lane.min(some.len() - 1)].numbers;
        let [a, b, c, d, e, f, g, h] = [ray(0), ray(1), ray(2), ray(3), ray(4), ray(5), ray(6), ray(7)];
        // Written out, numbers go from ray to lane without a detour through memory.
        macro_rules! column {
            ($k:literal) => {
                Lanes::new(simd, [a[$k], b[$k], c[$k], d[$k], e[$k], f[$k], g[$k], h[$k]])
            };
        }
        let (lambda, mu_rate) = (column!(0), column!(5));
        let spin = lambda.constant(spin);
        Start {
            photon: Photon {
                spin,
                lambda,
                eta: column!(1),
                u: column!(2),
                u_rate: column!(3),
                mu: column!(4),
                mu_rate,
            },
            course: Course {
                inwards: column!(6),
                side: column!(7),
                shape: column!(8),
                lead: column!(9),
                end: column!(10),
            },
            azimuth: column!(11),
            heading: [lambda, mu_rate],
            horizons: Horizons::new(spin),
        }
    }
}

/// Eight rays, classified; yes is 1, no is 0.
pub struct Prepared {
    pub numbers: [[f64; WIDTH]; NUMBERS],
    pub plain: [f64; WIDTH],
    pub spread: [f64; WIDTH],
    pub distant: [f64; WIDTH],
    pub escapes: [f64; WIDTH],
    pub sensitivity: [f64; WIDTH],
    /// Captured without meeting the plane.
    pub planar: [f64; WIDTH],
    /// The [`Group::width`] of their motion in θ.
    pub width: [f64; WIDTH],
    /// Not for lanes.
    pub careful: [f64; WIDTH],
}

impl Prepared {
    /// Classifies up to eight rays; what is missing repeats the last.
    #[inline(always)]
    pub fn new<L: Simd>(simd: L, shared: &Shared, rays: &[Ray]) -> Self {
        let ray = |lane: usize| &rays[lane.min(rays.len() - 1)];
        let [a, b, c, d, e, f, g, h] = [ray(0), ray(1), ray(2), ray(3), ray(4), ray(5), ray(6), ray(7)];
        // Written out, numbers go from ray to lane without a detour through memory.
        macro_rules! column {
        ($($field:tt)+) => {
            Lanes::new(simd, [a.$($field)+, b.$($field)+, c.$($field)+, d.$($field)+, e.$($field)+, f.$($field)+, g.$($field)+, h.$($field)+])
        };
    }
        let state = Inverted {
            w: column!(start.w),
            n: [column!(start.n[0]), column!(start.n[1]), column!(start.n[2])],
            q: column!(start.q),
            j: [column!(start.j[0]), column!(start.j[1]), column!(start.j[2])],
        };
        let energy = column!(energy);
        let spin = energy.constant(shared.metric.spin());
        let photon = Photon::new(spin, energy, &state);
        let class = Class::of(&photon, energy.constant(shared.rim));
        let (zero, one) = (energy.constant(0.0), energy.constant(1.0));
        // Everything must hold; NaN holds nothing.
        let mut fine = Lanes::select(zero.less(energy), one, zero);
        let above = Lanes::select(zero.constant(PLANAR).less(photon.eta), one, zero);
        let below = Lanes::select(photon.eta.less(zero.constant(-PLANAR)), one, zero);
        let planar = below * (one - class.escapes);
        fine *= above.max(planar);
        let nome = size_of_nome(&photon);
        let beyond = |reach: f64| Lanes::select(nome.less(zero.constant(reach)), zero, one - planar);
        fine *= one - beyond(LARGE_REACH);
        let width = beyond(FEW_REACH) + beyond(SOME_REACH);
        // The axis, and rays that graze the critical curve by less than any digit.
        fine *= Lanes::select((photon.mu * photon.mu).less(one), one, zero);
        fine *= Lanes::select(class.sensitivity.less(zero.constant(1e12)), one, zero);
        let Course { inwards, side, shape, lead, end } = class.course;
        let Photon { lambda, eta, u, u_rate, mu, mu_rate, .. } = photon;
        // From the Kerr–Schild azimuth of n to that of Boyer and Lindquist, atan2(s, r) + tw before.
        let azimuth = column!(azimuth) - (spin * u).atan2(one) - Horizons::new(spin).twist(u);
        Self {
            numbers: [
                lambda.to_array(),
                eta.to_array(),
                u.to_array(),
                u_rate.to_array(),
                mu.to_array(),
                mu_rate.to_array(),
                inwards.to_array(),
                side.to_array(),
                shape.to_array(),
                lead.to_array(),
                end.to_array(),
                azimuth.to_array(),
            ],
            plain: class.plain.to_array(),
            spread: class.spread.to_array(),
            distant: class.distant.to_array(),
            escapes: class.escapes.to_array(),
            sensitivity: class.sensitivity.to_array(),
            planar: planar.to_array(),
            width: width.to_array(),
            careful: (one - fine).to_array(),
        }
    }
}
