//! The radial motion of a photon: Mino time, azimuth and elapsed time along it.

use super::photon::{Photon, Potential};
use super::quadrature::Nodes;
use super::weierstrass;
use crate::scalar::Scalar;

/// Which way the radial motion goes. Numbers instead of cases, so that lanes can differ.
#[derive(Clone, Copy, Debug)]
pub struct Course<S> {
    /// +1 if the ray sets out inwards, −1 if outwards.
    pub inwards: S,
    /// κ of u = c + κ d cosh σ or u = c + κ d sinh σ, in which σ grows along the ray: ±1.
    pub side: S,
    /// −1 for cosh, a motion that has a turning point; +1 for sinh, one that has none.
    pub shape: S,
    /// For cosh: −1 if the turning point lies ahead, +1 if behind.
    pub lead: S,
    /// u where it ends: 0 at infinity, 1/r₊ at the horizon.
    pub end: S,
}

/// How a radial motion is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// U stays far from zero, or has no zeros near the path.
    Plain,
    /// The nearest zeros of U are a pair outside the horizon, or all but one: U is factored.
    Factored,
    /// The same, far from the critical curve, where the zeros lie far apart.
    Spread,
}

/// The radial motion of photons, classified. Yes is 1, no is 0.
#[derive(Clone, Copy, Debug)]
pub struct Class<S> {
    /// Which way it goes.
    pub course: Course<S>,
    /// Whether it is [`Kind::Plain`].
    pub plain: S,
    /// Whether it is, if not plain, [`Kind::Spread`].
    pub spread: S,
    /// Whether it ends at infinity.
    pub escapes: S,
    /// How an error grows towards the critical curve: 1/U there, at least 1.
    pub sensitivity: S,
}

impl<S: Scalar> Class<S> {
    /// Classifies a photon outside a horizon at 1/r = `rim`.
    ///
    /// Between its zeros u₁ < u_m < u₂ U is negative: light from far away turns at u₁, light from within at
    /// u₂. If U has no such zeros outside the horizon, light goes on as it began.
    #[inline(always)]
    pub fn of(photon: &Photon<S>, rim: S) -> Self {
        let potential = Potential::new(photon);
        let least = potential.least();
        let value = potential.at(least);
        let (zero, one) = (rim.constant(0.0), rim.constant(1.0));
        let is = |mask: S::Mask| S::select(mask, one, zero);
        let not = |flag: S| one - flag;
        let below = |x: S, bound: f64| is(x.less(x.constant(bound)));
        let above = |x: S, bound: f64| is(x.constant(bound).less(x));
        let valley = below(potential.b, 0.0) * not(below(potential.discriminant(), 0.0));
        let beyond = is(rim.less(least)) * valley;
        let monotone = not(valley).max(beyond).max(above(value, 0.0));
        let inwards = above(photon.u_rate, 0.0);
        let outer = is(photon.u.less(least));
        let escapes = monotone * not(inwards) + not(monotone) * outer;
        let sign = |flag: S| flag * 2.0 - 1.0;
        let course = Course {
            inwards: sign(inwards),
            side: -sign(escapes),
            shape: sign(monotone),
            lead: S::select(zero.less(monotone), one, -sign(escapes) * sign(inwards)),
            end: not(escapes) * rim,
        };
        let deep = above(value, 0.6).max(beyond * below(value, 0.0)).max(beyond * above(value, 0.05));
        // Where U has no valley outside the horizon nothing is near the critical curve.
        let lowest = potential.at(S::select(rim.less(least), rim, least)).abs();
        let sensitivity = lowest.max(rim.constant(1e-15)).recip() * valley + 1.0;
        Self { course, plain: not(valley).max(deep), spread: not(above(value, -0.5)), escapes, sensitivity }
    }
}

impl Class<f64> {
    /// How the motion is computed.
    pub fn kind(&self) -> Kind {
        if self.plain > 0.0 {
            Kind::Plain
        } else if self.spread > 0.0 {
            Kind::Spread
        } else {
            Kind::Factored
        }
    }
}

/// U = ((u − c)² − e)(q₀ + q₁u + q₂u²).
#[derive(Clone, Copy, Debug)]
pub struct Factors<S> {
    c: S,
    /// √|e|.
    d: S,
    quotient: [S; 3],
}

impl<S: Scalar> Factors<S> {
    /// Newton's method on the coefficients: with q₂ = −Q, q₁ = 2C − 2cQ, q₀ = B + 2cq₁ + gQ and
    /// g = c² − e, the other two coefficients of U demand
    ///   F₁ = g q₀ − 1 = 0,   F₂ = g q₁ − 2c q₀ = 0.
    /// `SPREAD` starts from the two roots, else from the parabola at the least value.
    #[inline(always)]
    pub fn new<const SPREAD: bool>(potential: &Potential<S>) -> Self {
        let Potential { b, c: cc, q } = *potential;
        let least = potential.least();
        let (mut c, mut g);
        if SPREAD {
            let [u1, u2] = roots(potential, least);
            c = (u1 + u2) * 0.5;
            g = u1 * u2;
        } else {
            let second = least.mul_add(cc * 12.0 - q * least * 12.0, b * 2.0);
            c = least;
            g = c * c + potential.at(least) * 2.0 / second;
        }
        let mut quotient = Self::quotient(potential, c, g);
        for _ in 0..if SPREAD { 5 } else { 6 } {
            let [q0, q1, _] = quotient;
            let f1 = g * q0 - 1.0;
            let f2 = g * q1 - c * q0 * 2.0;
            let q0_c = q1 * 2.0 - c * q * 4.0;
            let f1_c = g * q0_c;
            let f1_g = q0 + g * q;
            let f2_c = g * q * -2.0 - (q0 + c * q0_c) * 2.0;
            let f2_g = q1 - c * q * 2.0;
            let inverse = (f1_c * f2_g - f1_g * f2_c).recip();
            c -= (f1 * f2_g - f1_g * f2) * inverse;
            g -= (f1_c * f2 - f1 * f2_c) * inverse;
            quotient = Self::quotient(potential, c, g);
        }
        let e = c * c - g;
        // Exactly on the critical curve light would never arrive.
        let d = e.abs().max(c.constant(1e-300)).sqrt();
        Self { c, d, quotient }
    }

    #[inline(always)]
    fn quotient(potential: &Potential<S>, c: S, g: S) -> [S; 3] {
        let Potential { b, c: cc, q } = *potential;
        let q1 = (cc - c * q) * 2.0;
        [b + c * q1 * 2.0 + g * q, q1, -q]
    }
}

/// The zeros of U on both sides of where it is least, well apart: Newton's method from 1/√(−B), then on
/// the deflated cubic.
#[inline(always)]
fn roots<S: Scalar>(potential: &Potential<S>, least: S) -> [S; 2] {
    let Potential { b, c, q } = *potential;
    let mut u1 = (-b).sqrt().recip();
    for _ in 0..5 {
        u1 -= potential.at(u1) / (potential.half_slope(u1) * 2.0);
    }
    let k2 = c * 2.0 - q * u1;
    let k1 = b + k2 * u1;
    let k0 = k1 * u1;
    let mut u2 = least * 1.5;
    for _ in 0..6 {
        let value = u2.mul_add(u2.mul_add(k2 - q * u2, k1), k0);
        let slope = u2.mul_add(k2 * 2.0 - q * u2 * 3.0, k1);
        u2 -= value / slope;
    }
    [u1, u2]
}

/// Integrals along a stretch of the radial motion.
#[derive(Clone, Copy, Debug)]
pub struct Integrals<S> {
    /// Mino time.
    pub tau: S,
    /// Azimuth, but for what [`twist`] adds.
    pub azimuth: S,
    /// Coordinate time, but for what [`delay`] adds; not computed unless asked for.
    pub time: S,
}

impl<S: Scalar> Integrals<S> {
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

/// The radial motion of photons, ready to be asked for places on it.
pub struct Motion<'a, S, const PLAIN: bool, const TIMED: bool> {
    nodes: &'a Nodes,
    potential: Potential<S>,
    spin: S,
    lambda: S,
    course: Course<S>,
    factors: Factors<S>,
    /// Parameter (σ, or u for plain motion) at the start, at the middle, at the end.
    from: S,
    middle: S,
    first: Integrals<S>,
    whole: Integrals<S>,
}

impl<'a, S: Scalar, const PLAIN: bool, const TIMED: bool> Motion<'a, S, PLAIN, TIMED> {
    /// The motion of a photon from its start to the end of its course.
    #[inline(always)]
    pub fn new<const SPREAD: bool>(photon: &Photon<S>, course: &Course<S>, nodes: &'a Nodes) -> Self {
        let potential = Potential::new(photon);
        let zero = photon.u.constant(0.0);
        let factors = if PLAIN {
            Factors { c: zero, d: zero, quotient: [zero; 3] }
        } else {
            photon.u.outline(
                #[inline(always)]
                || Factors::new::<SPREAD>(&potential),
            )
        };
        let mut motion = Self {
            nodes,
            potential,
            spin: photon.spin,
            lambda: photon.lambda,
            course: *course,
            factors,
            from: photon.u,
            middle: photon.u,
            first: Integrals::zero(zero),
            whole: Integrals::zero(zero),
        };
        let to;
        if PLAIN {
            to = course.end;
            motion.middle = (photon.u + to) * 0.5;
        } else {
            let start = motion.parameter(photon.u);
            // For cosh, before the turning point σ < 0.
            motion.from = S::select(course.shape.less(zero), start * course.lead, start);
            to = motion.parameter(course.end);
            motion.middle = motion.from.max(zero).min(to);
        }
        motion.first = motion.stretch(motion.from, motion.middle);
        motion.whole = motion.first.plus(motion.stretch(motion.middle, to));
        motion
    }

    /// Integrals from the start to the end.
    pub fn whole(&self) -> Integrals<S> {
        self.whole
    }

    /// σ ≥ 0 for cosh, σ for sinh, at u: arcosh x or arsinh x = sgn x ln(|x| + √(x² ∓ 1)),
    /// x = κ(u − c)/d.
    #[inline(always)]
    fn parameter(&self, u: S) -> S {
        let Course { side, shape, .. } = self.course;
        let x = side * (u - self.factors.c) / self.factors.d;
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
    pub fn at(&self, u0: S, tau: S) -> Point<S> {
        let zero = tau.constant(0.0);
        let guess = tau.outline(
            #[inline(always)]
            || weierstrass::inverse_radius(&self.potential, u0, self.course.inwards, tau),
        );
        let late = self.first.tau.less(tau);
        let start = S::select(late, self.middle, self.from);
        let base = |done: S| S::select(late, done, zero);
        let begun = Integrals {
            tau: base(self.first.tau),
            azimuth: base(self.first.azimuth),
            time: base(self.first.time),
        };
        let (sigma, found);
        if PLAIN {
            sigma = guess;
        } else {
            let arc = self.parameter(guess);
            // Before the turning point cosh has its other branch.
            let before = S::select(self.course.lead.less(zero), -arc, arc);
            let before = S::select(late, arc, before);
            sigma = S::select(self.course.shape.less(zero), before, arc);
        }
        found = begun.plus(self.stretch(start, sigma));
        // One Newton step with the quadrature's own τ, so that the place is that of the integrals.
        let rest = tau - found.tau;
        let (u, rate_at);
        if PLAIN {
            let speed = self.potential.at(sigma).max(zero).sqrt() * self.course.inwards;
            u = sigma + rest * (speed + rest * self.potential.half_slope(sigma) * 0.5);
            rate_at = (sigma + u) * 0.5;
        } else {
            let here = self.place(sigma).0;
            let polished = rest.mul_add(self.quotient(here).sqrt(), sigma);
            u = self.place(polished).0;
            rate_at = (here + u) * 0.5;
        }
        let [azimuth, time] = self.rates(rate_at, self.potential.at(rate_at).max(zero).sqrt());
        Point {
            u,
            late,
            azimuth: azimuth.mul_add(rest, found.azimuth),
            time: if TIMED { time.mul_add(rest, found.time) } else { found.time },
        }
    }

    /// u and |du/dσ| at σ.
    #[inline(always)]
    fn place(&self, sigma: S) -> (S, S) {
        let Course { side, shape, .. } = self.course;
        let grow = sigma.exp();
        let shrink = grow.recip();
        let scale = side * self.factors.d * 0.5;
        let u = scale.mul_add(grow - shape * shrink, self.factors.c);
        (u, (scale * (grow + shape * shrink)).abs())
    }

    #[inline(always)]
    fn quotient(&self, u: S) -> S {
        let [q0, q1, q2] = self.factors.quotient;
        u.mul_add(u.mul_add(q2, q1), q0)
    }

    /// dφ/dτ and dt/dτ without what [`twist`] and [`delay`] add, given S = √U:
    ///   −s + sCu²/(P̂ + S),   −(B + 2Cu − Qu²)/(1 + S) + 2Cu/(P̂ + S),   P̂ = 1 + (s² − sλ)u².
    /// No pole at the horizon is left.
    #[inline(always)]
    fn rates(&self, u: S, root: S) -> [S; 2] {
        let Potential { b, c, q } = self.potential;
        let width = (u * u).mul_add(self.spin * (self.spin - self.lambda), root + 1.0);
        let pull = c * u / width;
        let azimuth = (self.spin * u).mul_add(pull, -self.spin);
        let zero = u.constant(0.0);
        let time = if TIMED { pull * 2.0 - u.mul_add(c * 2.0 - q * u, b) / (root + 1.0) } else { zero };
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
        let mut add = |weight: f64, slowness: S, u: S, root: S| {
            let share = slowness * weight;
            let [azimuth, time] = self.rates(u, root);
            sum.tau += share;
            sum.azimuth = share.mul_add(azimuth, sum.azimuth);
            if TIMED {
                sum.time = share.mul_add(time, sum.time);
            }
        };
        if PLAIN {
            for &(x, weight) in self.nodes.half() {
                for x in [x, -x] {
                    let u = half.mul_add(half.constant(x), middle);
                    let root = self.potential.at(u).sqrt();
                    add(weight, root.recip() * self.course.inwards, u, root);
                }
            }
        } else {
            let Course { side, shape, .. } = self.course;
            let scale = side * self.factors.d * 0.5;
            let grow = scale * middle.exp();
            let shrink = shape * scale * (-middle).exp();
            for &(x, weight) in self.nodes.half() {
                let up = (half * x).exp();
                let down = up.recip();
                for (up, down) in [(up, down), (down, up)] {
                    let (rise, fall) = (grow * up, shrink * down);
                    let u = self.factors.c + (rise - fall);
                    let speed = self.quotient(u).sqrt();
                    add(weight, speed.recip(), u, (rise + fall).abs() * speed);
                }
            }
        }
        Integrals { tau: sum.tau * half, azimuth: sum.azimuth * half, time: sum.time * half }
    }

    /// u at the turning point.
    #[inline(always)]
    pub fn turning(&self) -> S {
        self.factors.c + self.course.side * self.factors.d
    }
}

/// A place on the radial motion.
#[derive(Clone, Copy, Debug)]
pub struct Point<S: Scalar> {
    /// 1/r.
    pub u: S,
    /// Whether it lies behind the middle of the motion: the turning point, if one is passed.
    pub late: S::Mask,
    /// Azimuth from the start, but for what [`twist`] adds.
    pub azimuth: S,
    /// Time from the start, but for what [`delay`] adds.
    pub time: S,
}

/// The horizons of a hole, as numbers that may have derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Horizons<S> {
    outer: S,
    inner: S,
    /// r₊ − r₋, not zero.
    gap: S,
    spin: S,
}

impl<S: Scalar> Horizons<S> {
    /// Those of a spin in [−1, 1].
    #[inline(always)]
    pub fn new(spin: S) -> Self {
        let one = spin.constant(1.0);
        let square = ((one - spin) * (one + spin)).max(spin.constant(0.0));
        // At |s| = 1 the logarithm below becomes −u/(1 − u), to 1e-14 with this gap.
        let root = square.max(spin.constant(1e-14)).sqrt();
        Self { outer: root + 1.0, inner: spin * spin / (root + 1.0), gap: root * 2.0, spin }
    }

    /// 1/(r₊ − r₋) ln((r − r₊)/(r − r₋)).
    #[inline(always)]
    fn logarithm(&self, u: S) -> S {
        let outside = (-(self.outer * u) + 1.0).max(u.constant(1e-300));
        let inside = -(self.inner * u) + 1.0;
        // ln x loses digits near 1, far from the hole: there ln x = 2 artanh((x − 1)/(x + 1)).
        let x = self.gap * u / (outside + inside);
        let x2 = x * x;
        let mut series = x.constant(1.0 / 15.0);
        for k in (0..7).rev() {
            series = series.mul_add(x2, x.constant(1.0 / f64::from(2 * k + 1)));
        }
        let near = (outside / inside).ln();
        S::select(x.less(x.constant(0.1)), x * series * -2.0, near) / self.gap
    }

    /// tw = s/(r₊ − r₋) ln((r − r₊)/(r − r₋)), 0 at infinity: the azimuth has its variation beside
    /// the integral.
    #[inline(always)]
    pub fn twist(&self, u: S) -> S {
        self.spin * self.logarithm(u)
    }

    /// r + K, K = 2 ln(r − r₋) + 2r₊/(r₊ − r₋) ln((r − r₊)/(r − r₋)): coordinate time has its variation beside
    /// the integral. Taken to be 0 at infinity.
    #[inline(always)]
    pub fn delay(&self, u: S) -> S {
        let far = u.less(u.constant(1e-300));
        let safe = S::select(far, u.constant(1.0), u);
        let inside = (-(self.inner * u) + 1.0) / safe;
        let delay = safe.recip() + inside.ln() * 2.0 + self.outer * self.logarithm(u) * 2.0;
        S::select(far, u.constant(0.0), delay)
    }
}
