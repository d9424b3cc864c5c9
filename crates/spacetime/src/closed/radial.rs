//! The radial motion of a photon by quadrature: Mino time, azimuth and elapsed time along it.

use std::f64::consts::LN_2;

use super::course::Course;
use super::factors::Factors;
use super::kernel::{Place, Radial, Start};
use super::photon::{Photon, Potential};
use super::quadrature::Nodes;
use super::weierstrass;
use crate::scalar::Scalar;

/// |σ| below which the motion next to a turning point counts as uniform, to |σ|³.
const NEAR_TURN: f64 = 3e-3;

/// Integrals along a stretch of the radial motion.
#[derive(Clone, Copy, Debug)]
struct Integrals<S> {
    /// Mino time.
    tau: S,
    /// Azimuth, but for what [`Horizons::twist`](super::horizons::Horizons::twist) adds.
    azimuth: S,
    /// Coordinate time, but for what [`Horizons::delay`](super::horizons::Horizons::delay) adds; not computed unless asked for.
    time: S,
}

impl<S: Scalar> Integrals<S> {
    #[inline(always)]
    fn zero(like: S) -> Self {
        let zero = like.constant(0.0);
        Self { tau: zero, azimuth: zero, time: zero }
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self {
            tau: self.tau + other.tau,
            azimuth: self.azimuth + other.azimuth,
            time: self.time + other.time,
        }
    }
}

/// A place along the motion, before the coordinates' own turn and delay.
#[derive(Clone, Copy)]
struct Point<S: Scalar> {
    u: S,
    /// Whether it lies behind the middle of the motion: the turning point, if one is passed.
    late: S::Mask,
    found: Integrals<S>,
}

/// The radial motion of photons from their start to the end of their course.
///
/// `PLAIN` integrates over u. Otherwise u = c ± d cosh σ or c ± d sinh σ, in which the integrands are
/// smooth up to the critical curve, in two panels that meet where σ = 0.
pub struct Sweep<'a, S, const PLAIN: bool, const TIMED: bool> {
    nodes: &'a Nodes,
    start: &'a Start<S>,
    potential: Potential<S>,
    factors: Factors<S>,
    /// Parameter (σ, or u for plain motion) at the start and at the middle.
    from: S,
    middle: S,
    to: S,
    first: Integrals<S>,
    whole: Integrals<S>,
    /// Twist and delay at the start, and twice those at the turning point.
    twist: [S; 2],
    delay: [S; 2],
    /// dσ/dτ at the turning point.
    calm: S,
}

impl<'a, S: Scalar, const PLAIN: bool, const TIMED: bool> Sweep<'a, S, PLAIN, TIMED> {
    /// The motion from a start; `SPREAD` is for motions of that kind.
    #[inline(always)]
    pub fn new<const SPREAD: bool>(start: &'a Start<S>, nodes: &'a Nodes) -> Self {
        let (photon, course) = (&start.photon, &start.course);
        let potential = Potential::new(photon);
        let zero = photon.u.constant(0.0);
        let factors = if PLAIN {
            Factors::none(zero)
        } else {
            zero.outline(
                #[inline(always)]
                || Factors::around_least::<SPREAD>(&potential),
            )
        };
        let horizons = &start.horizons;
        let (from, turn) =
            (photon.u, if PLAIN { zero } else { factors.middle + course.side * factors.width });
        let mut sweep = Self {
            nodes,
            start,
            potential,
            factors,
            from,
            middle: from,
            to: from,
            first: Integrals::zero(zero),
            whole: Integrals::zero(zero),
            twist: [horizons.twist(from), if PLAIN { zero } else { horizons.twist(turn) * 2.0 }],
            delay: [zero; 2],
            calm: if PLAIN { zero } else { factors.quotient_at(turn).abs().sqrt() },
        };
        if TIMED {
            sweep.delay = [horizons.delay(from), if PLAIN { zero } else { horizons.delay(turn) * 2.0 }];
        }
        let to;
        if PLAIN {
            to = course.end;
            sweep.middle = ((photon.u + to) * 0.5).still();
        } else {
            sweep.from = sweep.parameter_at(photon.u, photon.u_rate);
            let rate = potential.at(course.end).max(zero).sqrt() * course.side;
            to = sweep.parameter_at(course.end, rate);
            sweep.middle = sweep.from.max(zero).min(to).still();
        }
        sweep.to = to;
        sweep.first = sweep.stretch(sweep.from, sweep.middle);
        sweep.whole = sweep.first.plus(sweep.stretch(sweep.middle, to));
        sweep
    }

    /// Total variation, with the sign of the first leg, of a function that is `here` at a place, beyond the
    /// turning point if `late` and there is one.
    #[inline(always)]
    fn variation(&self, [first, turn]: [S; 2], here: S, late: S::Mask) -> S {
        let Course { inwards, shape, lead, .. } = self.start.course;
        let straight = first - here;
        if PLAIN {
            return straight * inwards;
        }
        let zero = here.constant(0.0);
        let turned = S::select(late, first + here - turn, straight);
        let turned = S::select(lead.less(zero), turned, straight);
        S::select(shape.less(zero), turned, straight) * inwards
    }

    /// σ where u′ is `rate`, from u = c + κ d sinh σ or u′ = κ d sinh σ √q(u): so that no digits are lost
    /// next to the turning point. arsinh x = sgn x ln(|x| + √(x² + 1)).
    #[inline(always)]
    fn parameter_at(&self, u: S, rate: S) -> S {
        let Course { side, shape, .. } = self.start.course;
        let zero = u.constant(0.0);
        let turning = shape.less(zero);
        let speed = S::select(turning, self.factors.quotient_at(u).sqrt(), u.constant(1.0));
        let distance = S::select(turning, rate, u - self.factors.middle);
        let x = side * distance / (self.factors.width * speed);
        let size = x.abs();
        let value = (size + size.mul_add(size, u.constant(1.0)).sqrt()).ln();
        S::select(x.less(zero), -value, value)
    }

    /// σ ≥ 0 for cosh, σ for sinh, at u: arcosh x or arsinh x = sgn x ln(|x| + √(x² ∓ 1)),
    /// x = κ(u − c)/d.
    #[inline(always)]
    fn parameter(&self, u: S) -> S {
        let Course { side, shape, .. } = self.start.course;
        let x = side * (u - self.factors.middle) / self.factors.width;
        let size = x.abs();
        let under = size.mul_add(size, shape).max(x.constant(0.0));
        let value = (size.max(x.constant(1e-300)) + under.sqrt()).ln();
        let zero = x.constant(0.0);
        let value = S::select(shape.less(zero), value.max(zero), value);
        let odd = S::select(x.less(zero), -value, value);
        S::select(shape.less(zero), value, odd)
    }

    /// The place at Mino time τ, and the integrals up to it.
    #[inline(always)]
    fn point(&self, tau: S) -> Point<S> {
        let Course { inwards, shape, lead, .. } = self.start.course;
        let zero = tau.constant(0.0);
        // What the last step corrects needs no derivatives.
        let photon_u = self.start.photon.u.still();
        let guess = tau.outline(
            #[inline(always)]
            || {
                weierstrass::inverse_radius::<_, false>(
                    &self.potential.still(),
                    photon_u,
                    inwards,
                    tau.still(),
                )
            },
        );
        let late = self.first.tau.less(tau);
        let from = S::select(late, self.middle, self.from);
        let begun = Integrals {
            tau: S::select(late, self.first.tau, zero),
            azimuth: S::select(late, self.first.azimuth, zero),
            time: S::select(late, self.first.time, zero),
        };
        let sigma = if PLAIN {
            guess
        } else {
            let arc = self.parameter(guess);
            // Before the turning point cosh has its other branch.
            let before = S::select(lead.less(zero), -arc, arc);
            let before = S::select(late, arc, before);
            // Next to it arcosh has lost half of the digits, but σ grows uniformly there.
            let uniform = (tau - self.first.tau).mul_add(self.calm, self.middle);
            let cosh = S::select(arc.less(arc.constant(NEAR_TURN)), uniform, before);
            S::select(shape.less(zero), cosh, arc)
        };
        let mut sigma = sigma.still();
        let mut found = begun.plus(self.stretch(from, sigma));
        if S::LANES == 1 && !PLAIN {
            // Next to the critical curve, where rays of lanes are not, the guess has no digits left.
            for _ in 0..60 {
                let step = (tau - found.tau) * self.factors.quotient_at(self.place(sigma).0).sqrt();
                if S::any(step.abs().less(zero.constant(1e-3))) {
                    break;
                }
                let bounded = step.max(zero.constant(-1.0)).min(zero.constant(1.0));
                sigma = (sigma + bounded).max(self.from).min(self.to).still();
                found = begun.plus(self.stretch(from, sigma));
            }
        }
        // One step of second order with the quadrature's own τ, so that the place is that of the integrals.
        let rest = tau - found.tau;
        let (u, between, root);
        if PLAIN {
            let speed = self.potential.at(sigma).max(zero).sqrt() * inwards;
            u = sigma + rest * (speed + rest * self.potential.half_slope(sigma) * 0.5);
            between = (sigma + u) * 0.5;
            root = self.potential.at(between).max(zero).sqrt();
        } else {
            let (here, slope) = self.place(sigma);
            // σ′ = √q, σ″ = q′(u) (du/dσ)/2.
            let bend = self.factors.quotient_slope(here) * slope * 0.25;
            let speed = self.factors.quotient_at(here).sqrt();
            let (there, other) = self.place(rest.mul_add(rest.mul_add(bend, speed), sigma));
            u = there;
            between = (here + u) * 0.5;
            // √U = |du/dσ| √q; derivatives have one order less than values.
            let speed = if S::ORDER > 0 { self.factors.quotient_at(between).sqrt() } else { speed };
            root = (slope.abs() + other.abs()) * 0.5 * speed;
        }
        let [width, one] = [self.width(between, root), root + 1.0];
        let inverse = if TIMED { (width * one).recip() } else { width.recip() };
        let [per_width, per_one] = if TIMED { [inverse * one, inverse * width] } else { [inverse, zero] };
        let [azimuth, time] = self.rates(between, per_width, per_one);
        found.azimuth = azimuth.mul_add(rest, found.azimuth);
        if TIMED {
            found.time = time.mul_add(rest, found.time);
        }
        Point { u, late, found }
    }

    /// u and du/dσ at σ.
    #[inline(always)]
    fn place(&self, sigma: S) -> (S, S) {
        let Course { side, shape, .. } = self.start.course;
        let grow = sigma.exp();
        let shrink = shape * grow.recip();
        let scale = side * self.factors.width * 0.5;
        (scale.mul_add(grow - shrink, self.factors.middle), scale * (grow + shrink))
    }

    /// P̂ + S, P̂ = 1 + (s² − sλ)u².
    #[inline(always)]
    fn width(&self, u: S, root: S) -> S {
        let Photon { spin, lambda, .. } = self.start.photon;
        (u * u).mul_add(spin * (spin - lambda), root + 1.0)
    }

    /// dφ/dτ and dt/dτ without what twist and delay add, given 1/(P̂ + S) and 1/(1 + S), S = √U:
    ///   −s + sCu²/(P̂ + S),   −(B + 2Cu − Qu²)/(1 + S) + 2Cu/(P̂ + S).
    /// No pole at the horizon is left.
    #[inline(always)]
    fn rates(&self, u: S, per_width: S, per_one: S) -> [S; 2] {
        let Potential { b, c, q } = self.potential;
        let spin = self.start.photon.spin;
        let pull = c * u * per_width;
        let azimuth = (spin * u).mul_add(pull, -spin);
        let time = if TIMED { pull * 2.0 - u.mul_add(c * 2.0 - q * u, b) * per_one } else { pull };
        [azimuth, time]
    }

    /// Integrals from one parameter to another.
    #[inline(always)]
    fn stretch(&self, from: S, to: S) -> Integrals<S> {
        from.outline(
            #[inline(always)]
            || self.integrate(from, to),
        )
    }

    #[inline(always)]
    fn integrate(&self, from: S, to: S) -> Integrals<S> {
        let half = (to - from) * 0.5;
        let middle = (to + from) * 0.5;
        let mut sum = Integrals::zero(half);
        if PLAIN {
            for &(x, weight) in self.nodes.half() {
                let offset = half * x;
                for mirrored in [false, true] {
                    let u = if mirrored { middle - offset } else { middle + offset };
                    let root = self.potential.at(u).sqrt();
                    self.add(&mut sum, weight, u, root, root);
                }
            }
            sum.tau *= self.start.course.inwards;
            sum.azimuth *= self.start.course.inwards;
            sum.time *= self.start.course.inwards;
        } else {
            let Course { side, shape, .. } = self.start.course;
            let scale = side * self.factors.width * 0.5;
            let center = middle.exp();
            let grow = scale * center;
            let shrink = shape * scale * center.recip();
            for &(x, weight) in self.nodes.half() {
                let up = (half * x).exp();
                let down = up.recip();
                for mirrored in [false, true] {
                    let (up, down) = if mirrored { (down, up) } else { (up, down) };
                    let (rise, fall) = (grow * up, shrink * down);
                    let u = self.factors.middle + (rise - fall);
                    let speed = self.factors.quotient_at(u).sqrt();
                    self.add(&mut sum, weight, u, speed, (rise + fall).abs() * speed);
                }
            }
        }
        Integrals { tau: sum.tau * half, azimuth: sum.azimuth * half, time: sum.time * half }
    }

    /// Adds what a node contributes, at which the parameter goes by at `speed` and √U is `root`.
    #[inline(always)]
    fn add(&self, sum: &mut Integrals<S>, weight: f64, u: S, speed: S, root: S) {
        // One division serves all: it takes as long as ten products.
        let width = self.width(u, root);
        let both = speed * width;
        let (slowness, per_width, per_one);
        if TIMED {
            let one = root + 1.0;
            let inverse = (both * one).recip();
            slowness = width * one * inverse;
            per_width = speed * one * inverse;
            per_one = both * inverse;
        } else {
            let inverse = both.recip();
            slowness = width * inverse;
            per_width = speed * inverse;
            per_one = inverse;
        }
        let share = slowness * weight;
        let [azimuth, time] = self.rates(u, per_width, per_one);
        sum.tau += share;
        sum.azimuth = share.mul_add(azimuth, sum.azimuth);
        if TIMED {
            sum.time = share.mul_add(time, sum.time);
        }
    }
}

impl<S: Scalar, const PLAIN: bool, const TIMED: bool> Radial<S> for Sweep<'_, S, PLAIN, TIMED> {
    fn total(&self) -> S {
        self.whole.tau
    }

    #[inline(always)]
    fn azimuth_to_infinity(&self) -> S {
        let zero = self.from.constant(0.0);
        let late = zero.less(zero.constant(1.0));
        self.whole.azimuth + self.variation(self.twist, zero, late)
    }

    #[inline(always)]
    fn at(&self, tau: S) -> Place<S> {
        let Point { u, late, found } = self.point(tau);
        let azimuth = found.azimuth + self.variation(self.twist, self.start.horizons.twist(u), late);
        let time = if TIMED {
            let zero = u.constant(0.0);
            let infinite = S::select(zero.less(self.start.photon.u), zero, u.constant(2.0 * LN_2));
            found.time + self.variation(self.delay, self.start.horizons.delay(u), late) + infinite
        } else {
            u.constant(f64::NAN)
        };
        let Course { inwards, shape, lead, .. } = self.start.course;
        let zero = u.constant(0.0);
        // Light that has a turning point ahead turns there, where the motion is late.
        let turned = S::select(lead.max(shape).less(zero), -inwards, inwards);
        let inwards = if PLAIN { inwards } else { S::select(late, turned, inwards) };
        Place { u, azimuth, time, inwards }
    }
}
