//! What a ray of Bardeen's screen meets, as a function of spin, inclination, impact parameters and distance
//! that has derivatives.

use super::course::Class;
use super::horizons::Horizons;
use super::kernel::{self, Meeting, Radial, Start};
use super::photon::{Photon, Potential};
use super::planar;
use super::polar::{FEW, FEW_REACH, MANY, Oscillation, SOME, SOME_REACH, size_of_nome};
use super::quadrature::Nodes;
use super::radial::Sweep;
use super::series::Cosines;
use super::tracer::{PLAIN_NODES, PLANAR};
use super::vortical::Vortex;
use super::weierstrass::inverse_radius;
use crate::scalar::Scalar;

/// A ray given by impact parameters, as [`impact_ray`](crate::observer::impact_ray) takes them: its photon has
/// λ = −α sin i and η = (α² − a²) cos² i + β² and arrives, moving outwards, at Boyer–Lindquist r = 1/u, θ = i,
/// azimuth 0; on the axis in the direction of (α, β) on the sky.
///
/// With [`Dual`](crate::Dual) numbers what it meets comes with exact derivatives. They are those of the
/// function on either side where the way to compute it changes, and do not exist where the function has none:
///
/// - on the critical curve, next to which they grow as 1/δ, and for a camera at a turning point of the
///   motion in r (NaN or infinite);
/// - for a camera in the equatorial plane with i = 90° and β = 0: the ray meets no plane, a ray next to it
///   does; its direction has derivatives;
/// - where a ray passes the pole exactly (α = 0 or a camera on the axis): azimuths jump by 2π there, and
///   derivatives are those on the side α > 0; for a camera on the axis that in i is the one of i growing from 0
///   or falling from π;
/// - θ of a ray that ends on the axis.
/// - for light with η = 0 off the plane, which outwards from a camera near the hole nears the plane for ever: the
///   part that comes from a change of η is missing.
///
/// Everything else is differentiable, |a| = 1, a = 0, the axis, β = 0 and a camera at infinity (in u) included.
///
/// ```
/// use kerrscope_spacetime::Dual;
/// use kerrscope_spacetime::closed::{Impact, Tables};
///
/// let at = [0.9, 1.0, 4.0 / 1f64.sin(), -6.0, 0.0];
/// let [spin, inclination, alpha, beta, u] = Dual::<f64, 5>::variables(at);
/// let tables = Tables::default();
/// let path = Impact { spin, inclination, alpha, beta, u }.trace(&tables, 8);
/// assert!(path.escaped);
/// let r = path.crossings[0].r;
/// // How the radius at which the disk is seen changes with α, compared with two rays.
/// let moved = |alpha| {
///     Impact { spin: at[0], inclination: at[1], alpha, beta: at[3], u: at[4] }.trace(&tables, 8).crossings[0].r
/// };
/// let difference = (moved(at[2] + 1e-4) - moved(at[2] - 1e-4)) / 2e-4;
/// assert!((r.gradient[2] - difference).abs() < 1e-7);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Impact<S> {
    /// a, in [−1, 1].
    pub spin: S,
    /// i, in [0, π].
    pub inclination: S,
    /// α, M.
    pub alpha: S,
    /// β, M.
    pub beta: S,
    /// 1/r of the observer, outside the horizon; 0 at infinity.
    pub u: S,
}

/// A crossing of the equatorial plane.
#[derive(Clone, Copy, Debug)]
pub struct ImpactCrossing<S: Scalar> {
    /// Which lanes have it.
    pub met: S::Mask,
    /// Boyer–Lindquist radius, M.
    pub r: S,
    /// Boyer–Lindquist azimuth, unwrapped along the ray from the camera.
    pub phi: S,
    /// Coordinate time from there to the camera, M; for a camera at infinity less r + 2 ln(r/2) of the camera,
    /// r → ∞, the derivative in u being that of the difference.
    pub elapsed: S,
}

/// What a ray meets: see [`Path`](crate::geodesic::Path).
#[derive(Clone, Debug)]
pub struct ImpactPath<S: Scalar> {
    /// Which lanes come from infinity.
    pub escaped: S::Mask,
    /// Which lanes come out of the past horizon; those that are neither have no such photon.
    pub captured: S::Mask,
    /// Crossings in the order met going back from the camera.
    pub crossings: Vec<ImpactCrossing<S>>,
    /// Asymptotic direction (θ, φ) that the light comes from, φ unwrapped; NaN where it does not escape.
    pub direction: [S; 2],
}

/// Tables that all rays share, whatever the hole.
#[derive(Clone, Debug)]
pub struct Tables {
    nodes: Nodes,
    plain: Nodes,
    few: Cosines<FEW>,
    some: Cosines<SOME>,
    many: Box<Cosines<MANY>>,
}

impl Tables {
    /// Those for so many nodes in each quadrature: see [`ClosedForm::new`](super::ClosedForm::new).
    pub fn new(nodes: usize) -> Self {
        Self {
            nodes: Nodes::new(nodes),
            plain: Nodes::new(nodes.max(PLAIN_NODES)),
            few: Cosines::new(),
            some: Cosines::new(),
            many: Box::new(Cosines::new()),
        }
    }
}

impl Default for Tables {
    /// With [`NODES`](super::NODES).
    fn default() -> Self {
        Self::new(super::NODES)
    }
}

/// x, but exactly 0 where its value is a rounding error.
#[inline(always)]
fn rounded<S: Scalar>(x: S) -> S {
    S::select(x.abs().less(x.constant(2e-16)), x - x.still(), x)
}

/// 1 where the mask is true, else 0.
#[inline(always)]
fn flag<S: Scalar>(mask: S::Mask, like: S) -> S {
    S::select(mask, like.constant(1.0), like.constant(0.0))
}

/// Codes of the motion in θ beside 0, 1 and 2 of an oscillation with few, some and many terms.
const PLANAR_CODE: f64 = 3.0;
const VORTICAL_CODE: f64 = 4.0;

impl<S: Scalar> Impact<S> {
    /// The reversed photon: λ = α sin i, μ′ = β sin i, u′ = ±√U.
    fn photon(&self, inwards: bool) -> Photon<S> {
        let Self { spin, inclination, alpha, beta, u } = *self;
        let (sin, cos) = inclination.sin_cos();
        let (sin, cos) = (rounded(sin), rounded(cos));
        let eta = (alpha * alpha - spin * spin) * cos * cos + beta * beta;
        let photon =
            Photon { spin: -spin, lambda: alpha * sin, eta, u, u_rate: u, mu: cos, mu_rate: beta * sin };
        let speed = Potential::new(&photon).at(u).sqrt();
        Photon { u_rate: if inwards { speed } else { -speed }, ..photon }
    }

    /// 1/r where the ray crosses the equatorial plane for the time number `order`, counted from 0, by one rational function of
    /// Weierstrass's ℘ that is smooth across turning points: far less work than [`trace`](Self::trace), with which it
    /// agrees to 1e-14, and to 1e-9 where r is above 10⁵ M (relative to 1/r).
    ///
    /// It is the continuation of 1/r along the motion, and does not tell whether the ray gets there: where it is below 0 or
    /// above 1/r₊, and where its τ is longer than the ray, there is no such crossing. For η > 0, light that moves outwards
    /// at the camera, and a nome up to 0.15 (b ≳ 1 M).
    #[inline(always)]
    pub fn inverse_radius(&self, tables: &Tables, order: usize) -> S {
        let photon = self.photon(true);
        let heading = [self.alpha, self.beta];
        let oscillation = Oscillation::<S, SOME>::new::<false>(&photon, heading, &tables.some);
        let [tau, ..] = oscillation.crossing(oscillation.first() + order as f64);
        inverse_radius::<_, true>(&Potential::new(&photon), self.u, self.u.constant(1.0), tau)
    }

    /// Follows the ray and finds at most `count` crossings of the equatorial plane.
    ///
    /// Lanes whose motions are computed in different ways are followed one way after the other.
    pub fn trace(&self, tables: &Tables, count: usize) -> ImpactPath<S> {
        self.follow(tables, count, true)
    }

    /// The same for light that arrives moving inwards, at a camera near the hole that looks away from it: the
    /// ray sets out outwards.
    pub fn trace_outwards(&self, tables: &Tables, count: usize) -> ImpactPath<S> {
        self.follow(tables, count, false)
    }

    fn follow(&self, tables: &Tables, count: usize, inwards: bool) -> ImpactPath<S> {
        let photon = self.photon(inwards);
        let (zero, one) = (self.u.constant(0.0), self.u.constant(1.0));
        let still = photon.spin.still();
        let square = ((one - still) * (one + still)).max(zero);
        let rim = (square.sqrt() + 1.0).recip().still();
        let class = Class::of(&photon, rim);
        let start = Start {
            photon,
            course: class.course,
            azimuth: zero,
            heading: [self.alpha, self.beta],
            horizons: Horizons::new(photon.spin),
        };
        // Ways to compute the motions, as numbers: lanes may differ.
        let size = size_of_nome(&photon.still());
        let terms = flag(size.constant(FEW_REACH).less(size), size)
            + flag(size.constant(SOME_REACH).less(size), size);
        let terms = S::select(zero.constant(PLANAR).less(photon.eta), terms, one * PLANAR_CODE);
        let terms = S::select(photon.eta.less(zero.constant(-PLANAR)), one * VORTICAL_CODE, terms);
        let kind = class.plain * 2.0 + (one - class.plain) * class.spread;
        let code = (terms * 2.0 + class.escapes) * 3.0 + kind;
        let sound = flag(zero.less(photon.u_rate.abs()), zero) * flag(photon.u.less(rim), zero);
        let mut found = Found { crossings: Vec::new(), direction: [zero * f64::NAN; 2] };
        let mut rest = sound;
        while let Some(lane) = (0..S::LANES).find(|&lane| rest.lane(lane) > 0.0) {
            let way = code.lane(lane);
            let chosen = flag((code - way).abs().less(zero.constant(0.5)), zero) * rest;
            rest -= chosen;
            found.follow(&start, tables, count, chosen, way as usize);
        }
        let crossings = found.crossings.iter().map(|&[met, r, phi, elapsed]| ImpactCrossing {
            met: zero.less(met),
            r,
            phi,
            elapsed,
        });
        ImpactPath {
            escaped: zero.less(class.escapes * sound),
            captured: class.escapes.less(sound),
            crossings: crossings.collect(),
            direction: found.direction,
        }
    }
}

/// What lanes have met so far.
struct Found<S> {
    /// Whether met (1 or 0), r, φ, elapsed time.
    crossings: Vec<[S; 4]>,
    direction: [S; 2],
}

impl<S: Scalar> Found<S> {
    /// Follows the chosen lanes, whose motions are computed in one way.
    fn follow(&mut self, start: &Start<S>, tables: &Tables, count: usize, chosen: S, way: usize) {
        match way % 3 {
            0 => {
                let radial = Sweep::<_, false, true>::new::<false>(start, &tables.nodes);
                self.along(start, &radial, tables, count, chosen, way / 3);
            }
            1 => {
                let radial = Sweep::<_, false, true>::new::<true>(start, &tables.nodes);
                self.along(start, &radial, tables, count, chosen, way / 3);
            }
            _ => {
                let radial = Sweep::<_, true, true>::new::<false>(start, &tables.plain);
                self.along(start, &radial, tables, count, chosen, way / 3);
            }
        }
    }

    fn along<R: Radial<S>>(
        &mut self,
        start: &Start<S>,
        radial: &R,
        tables: &Tables,
        count: usize,
        chosen: S,
        way: usize,
    ) {
        let Self { crossings, direction } = self;
        let (zero, escapes) = (chosen.constant(0.0), way % 2 == 1);
        let here = zero.less(chosen);
        let mut number = 0;
        let meet = |meeting: &Meeting<S>| {
            if crossings.len() == number {
                crossings.push([zero, zero * f64::NAN, zero * f64::NAN, zero * f64::NAN]);
            }
            let met = flag(meeting.met, zero) * chosen;
            let known = &mut crossings[number];
            for (old, new) in known.iter_mut().zip([met, meeting.r, meeting.phi, meeting.elapsed]) {
                *old = S::select(zero.less(met), new, *old);
            }
            number += 1;
        };
        let [theta, phi] = match way / 2 {
            0 => kernel::follow::<_, R, FEW, true>(start, radial, &tables.few, escapes, count, meet),
            1 => kernel::follow::<_, R, SOME, true>(start, radial, &tables.some, escapes, count, meet),
            2 => kernel::follow::<_, R, MANY, true>(start, radial, &tables.many, escapes, count, meet),
            _ if !escapes => return,
            motion => {
                let tau = radial.total();
                let [theta, turned] = if motion as f64 == VORTICAL_CODE {
                    Vortex::new(&start.photon, start.heading).at(tau, &tables.plain)
                } else {
                    planar::after(&start.photon, start.heading, tau)
                };
                [theta, start.azimuth + radial.azimuth_to_infinity() + turned]
            }
        };
        if escapes {
            for (old, new) in direction.iter_mut().zip([theta, phi]) {
                *old = S::select(here, new, *old);
            }
        }
    }
}
