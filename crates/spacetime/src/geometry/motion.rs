//! Hamilton's equations of free motion, and their integration with error control.
//!
//! H = ½ g^{μν} p_μ p_ν:   ẋ^μ = g^{μν} p_ν,   ṗ_i = −½ ∂_i g^{μν} p_μ p_ν = ½ ∂_i g_{μν} ẋ^μ ẋ^ν.
//! They are the geodesic equations; the momentum of a coordinate that the metric does not depend on is kept to the bit.

use super::{Geometry, Nature, matrix};
use crate::dual::Dual;
use crate::geodesic::{Dense, Dop853, Flow, Method, growth, root};
use crate::scalar::Scalar;

/// Room for place and momentum in four dimensions; those of fewer leave the rest of each half empty.
pub(super) const WIDTH: usize = 8;
const HALF: usize = WIDTH / 2;

/// Place and momentum in one array.
pub(super) fn pack<S: Scalar, const N: usize>(x: &[S; N], p: &[S; N]) -> [S; WIDTH] {
    let mut y = [x[0].constant(0.0); WIDTH];
    y[..N].copy_from_slice(x);
    y[HALF..HALF + N].copy_from_slice(p);
    y
}

/// Place and momentum of an array.
pub(super) fn unpack<S: Scalar, const N: usize>(y: &[S; WIDTH]) -> ([S; N], [S; N]) {
    const { assert!(N <= HALF, "at most four dimensions") };
    (std::array::from_fn(|i| y[i]), std::array::from_fn(|i| y[HALF + i]))
}

/// The equations in a geometry.
pub(super) struct Hamilton<'a, G, const N: usize> {
    geometry: &'a G,
    angles: [bool; N],
}

impl<'a, G: Geometry<N>, const N: usize> Hamilton<'a, G, N> {
    pub(super) fn new(geometry: &'a G) -> Self {
        Self { geometry, angles: geometry.coordinates().map(|c| c.nature == Nature::Angle) }
    }

    /// A parameter over which place and momentum change by about their sizes.
    fn natural<S: Scalar>(&self, y: &[S; WIDTH], slope: &[S; WIDTH]) -> f64 {
        let scale: [S; WIDTH] = self.inverse_scale(y);
        let fastest = (0..WIDTH).map(|i| (slope[i] * scale[i]).lane(0).abs()).fold(0.0, f64::max);
        if fastest > 0.0 { 1.0 / fastest } else { f64::INFINITY }
    }
}

/// Not inlined: a step has a dozen of them, with long formulas and up to two orders of derivatives.
#[inline(never)]
fn hamilton<S: Scalar, G: Geometry<N>, const N: usize>(geometry: &G, y: &[S; WIDTH]) -> [S; WIDTH] {
    let (x, p) = unpack::<S, N>(y);
    let g = geometry.metric(&Dual::variables(x));
    let inverse = matrix::invert(&g.map(|row| row.map(|c| c.value)));
    let velocity = matrix::apply(&inverse, &p);
    let mut force = [x[0].constant(0.0); N];
    for m in 0..N {
        for n in m..N {
            // Each pair of indices comes twice.
            let weight = velocity[m] * velocity[n] * if m == n { 0.5 } else { 1.0 };
            for i in 0..N {
                force[i] += weight * g[m][n].gradient[i];
            }
        }
    }
    pack(&velocity, &force)
}

impl<S: Scalar, G: Geometry<N>, const N: usize> Flow<S, WIDTH> for Hamilton<'_, G, N> {
    fn derivative(&self, y: &[S; WIDTH]) -> [S; WIDTH] {
        hamilton(self.geometry, y)
    }

    /// Angles count by themselves, other coordinates x against 1 + |x|, momenta p_i against themselves and against
    /// P/√|g^{ii}|, P² = Σ |g^{jj}| p_j², which is the size that a local observer would give them.
    fn inverse_scale(&self, y: &[S; WIDTH]) -> [S; WIDTH] {
        let (x, p) = unpack::<S, N>(y);
        let (zero, one) = (x[0].constant(0.0), x[0].constant(1.0));
        let inverse = matrix::invert(&self.geometry.metric(&x));
        // The mean is taken over the whole width.
        let share = (HALF as f64 / N as f64).sqrt();
        let mut scale = [zero; WIDTH];
        let mut size = zero;
        for i in 0..N {
            size += inverse[i][i].abs() * p[i].squared();
        }
        let size = size.sqrt();
        for i in 0..N {
            scale[i] = if self.angles[i] { one } else { (x[i].abs() + 1.0).recip() } * share;
            let root = inverse[i][i].abs().sqrt();
            let whole = p[i].abs() * root + size;
            let some = zero.less(whole);
            scale[HALF + i] = S::select(some, root / S::select(some, whole, one), zero) * share;
        }
        scale
    }
}

/// A step of a geodesic, and the state anywhere in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Segment<S> {
    pub dense: Dense<S, WIDTH>,
    /// Parameter at its start.
    pub start: f64,
    /// Its size, and the share of it that counts.
    pub h: f64,
    pub until: f64,
}

/// Why a drive ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    Complete,
    Margin,
    Singular,
    StepLimit,
}

/// The end of a drive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival<S> {
    pub y: [S; WIDTH],
    /// Parameter there.
    pub parameter: f64,
    pub stop: Stop,
    /// Steps tried.
    pub steps: usize,
}

/// A smaller tolerance would be about rounding.
const LEAST_TOLERANCE: f64 = 4e-14;

/// A step below this share of the natural one is not made: rounding is all that it would add.
const LEAST_STEP: f64 = 1e-13;

/// Follows a geodesic from `y` over an affine parameter of `length`, which may be negative, or to the end of the
/// coordinates; tells of each step if there is somebody to tell. Errors of a step are held to `tolerance`.
pub(super) fn drive<S: Scalar, G: Geometry<N>, const N: usize>(
    geometry: &G,
    mut y: [S; WIDTH],
    length: f64,
    tolerance: f64,
    max_steps: usize,
    mut visit: Option<&mut dyn FnMut(Segment<S>)>,
) -> Arrival<S> {
    let flow = Hamilton::<G, N>::new(geometry);
    let sense = if length < 0.0 { -1.0 } else { 1.0 };
    let tolerance = tolerance.max(LEAST_TOLERANCE);
    // Errors of derivatives are not estimated: their steps are as short as the method needs for them to be small.
    let longest = if S::ORDER > 0 { 0.25 } else { 1.0 };
    let margin = |y: &[S; WIDTH]| geometry.margin(&std::array::from_fn(|i| y[i].lane(0)));
    let mut slope: [S; WIDTH] = flow.derivative(&y);
    let mut natural = flow.natural(&y, &slope);
    let (mut h, mut done, mut steps, mut refused) = (0.05 * natural, 0.0, 0, false);
    let end = |y, done: f64, stop, steps| Arrival { y, parameter: sense * done, stop, steps };
    let whole = |y: &[S; WIDTH]| y.iter().all(|c| c.lane(0).is_finite());
    if !whole(&slope) || !whole(&y) {
        return end(y, 0.0, Stop::Singular, 0);
    }
    while done < length.abs() {
        if steps >= max_steps {
            return end(y, done, Stop::StepLimit, steps);
        }
        steps += 1;
        let rest = length.abs() - done;
        h = h.min(longest * natural).min(rest);
        let signed = y[0].constant(sense * h);
        let mut stages = [slope; 12];
        let step = Dop853::step(&flow, &y, &mut stages, signed);
        let ratio = step.error.lane(0) / tolerance;
        if !whole(&step.end) || !(ratio <= 1.0) {
            refused = true;
            h *= if ratio.is_finite() { growth(ratio, Dop853::ERROR_ORDER).clamp(0.1, 0.9) } else { 0.1 };
            if h < LEAST_STEP * natural {
                return end(y, done, Stop::Singular, steps);
            }
            continue;
        }
        let end_slope: [S; WIDTH] = flow.derivative(&step.end);
        let outside = margin(&step.end);
        let leaves = !(outside > 0.0);
        if leaves || visit.is_some() {
            let dense = Dop853::dense(&flow, &y, &stages, &step.end, &end_slope, signed);
            let within = |t: f64| margin(&dense.at(y[0].constant(t)));
            let until = if leaves { root(within, within(0.0).max(f64::MIN_POSITIVE), outside) } else { 1.0 };
            if let Some(visit) = &mut visit {
                visit(Segment { dense, start: sense * done, h: sense * h, until });
            }
            if leaves {
                return end(dense.at(y[0].constant(until)), done + until * h, Stop::Margin, steps);
            }
        }
        if !whole(&end_slope) {
            return end(step.end, done + h, Stop::Singular, steps);
        }
        done = if h == rest { length.abs() } else { done + h };
        (y, slope) = (step.end, end_slope);
        natural = flow.natural(&y, &slope);
        h *= growth(ratio, Dop853::ERROR_ORDER).clamp(0.2, if refused { 1.0 } else { 4.0 });
        refused = false;
    }
    end(y, done, Stop::Complete, steps)
}
