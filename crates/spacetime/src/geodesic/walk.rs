//! One ray's walk through one chart: steps, their control, and what is met on the way.

use super::chart::Chart;
use super::dense::{Dense, root};
use super::method::Method;
use super::winding;
use crate::scalar::Scalar;
use crate::tensor::{Vec3, dot};

/// How steps are chosen.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// Bound on the error estimate of a step; of no meaning to a method without one.
    pub tolerance: f64,
    /// Size of every step of a method without an error estimate.
    pub step: f64,
    /// Steps, accepted or not, after which a ray is given up.
    pub max_steps: usize,
    /// Largest angle, in radians, that a step may turn through.
    pub max_turn: f64,
}

/// Where the walk stops, unless steps run out.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Unit normal of the plane whose crossings are wanted.
    pub plane: Vec3<f64>,
    /// 1/r of the horizon; infinite where there is none.
    pub inverse_horizon: f64,
    /// Whether the place where it falls through is wanted: at a throat it goes on.
    pub exact_fall: bool,
    /// For a photon that rises through the horizon: the 1/r at which it is well outside.
    pub inverse_exit: Option<f64>,
}

/// Who is told what the photon meets.
pub trait Visitor<const D: usize> {
    /// Whether [`Visitor::segment`] wants to be called.
    const WANTS_SEGMENTS: bool;
    /// The plane was crossed at state `y`, `swept` radians of azimuth after the start, 1/distance growing there if
    /// `approach` is positive.
    fn crossing(&mut self, y: &[f64; D], swept: f64, approach: f64);
    /// A step from parameter `sigma`, of size `h`, counts up to θ = `until`, unless something stands in the way: then
    /// the answer is θ there, and its number.
    fn segment(&mut self, dense: &Dense<f64, D>, sigma: f64, h: f64, until: f64) -> Option<(f64, usize)>;
}

/// Why the walk ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// The photon left the chart's reach.
    Left,
    /// It fell through the horizon.
    Fell,
    /// It rose through the horizon and is outside.
    Rose,
    /// It is outside the horizon and on its way in.
    Sank,
    /// It met what stands in its way, the one of this number.
    Met(usize),
    /// Steps ran out or could not be made small enough.
    GaveUp,
}

/// The end of a walk.
#[derive(Clone, Copy, Debug)]
pub struct End<const D: usize> {
    /// Why it ended.
    pub stop: Stop,
    /// The state at the end.
    pub y: [f64; D],
    /// Azimuth swept, radians.
    pub swept: f64,
    /// Steps tried.
    pub steps: usize,
}

/// Follows the photon from `y` until something stops it.
pub fn walk<C, M, V, const D: usize, const STAGES: usize>(
    chart: &C,
    mut y: [f64; D],
    bounds: &Bounds,
    control: &Control,
    visitor: &mut V,
) -> End<D>
where
    C: Chart<f64, D>,
    M: Method<STAGES>,
    V: Visitor<D>,
{
    let adaptive = M::ERROR_ORDER > 0.0;
    let height = |y: &[f64; D]| dot(&C::place(y), &bounds.plane);
    let mut slope = chart.derivative(&y);
    chart.settle(&mut y, &mut slope);
    let mut h = if adaptive { chart.step_for(&y, 0.3) } else { control.step };
    let sense = if chart.state(&y).j[2] < 0.0 { -1.0 } else { 1.0 };
    // A photon that starts in the plane has not crossed it.
    let mut above = Some(height(&y)).filter(|g| *g != 0.0).unwrap_or_else(|| height(&slope));
    let (mut swept, mut sigma, mut steps, mut refused) = (0.0, 0.0, 0, false);
    loop {
        if steps >= control.max_steps {
            return End { stop: Stop::GaveUp, y, swept, steps };
        }
        steps += 1;
        if adaptive {
            h = h.min(chart.step_for(&y, control.max_turn)).min(chart.way_out(&y, &slope));
        }
        let mut stages = [slope; STAGES];
        let step = M::step(chart, &y, &mut stages, h);
        let finite = step.error.is_finite() && step.end.iter().take(D & !1).all(|c| c.is_finite());
        let ratio = step.error / control.tolerance;
        if !finite || (adaptive && ratio > 1.0) {
            refused = true;
            h *= if finite { growth(ratio, M::ERROR_ORDER).clamp(0.1, 0.9) } else { 0.1 };
            if !adaptive || h < chart.step_for(&y, 1e-14) {
                return End { stop: Stop::GaveUp, y, swept, steps };
            }
            continue;
        }
        let end_slope = step.end_slope.unwrap_or_else(|| chart.derivative(&step.end));

        // What happens within this step?
        let reach = chart.reach(&step.end);
        let depth = chart.inverse_radius(&step.end);
        let below = height(&step.end);
        // A photon that has run within the plane so far has yet to choose its side.
        let crosses = (above > 0.0) != (below > 0.0) && above != 0.0 && below != 0.0;
        let grazes = !crosses && above * height(&slope) < 0.0 && below * height(&end_slope) > 0.0;
        let leaves = reach < 0.0;
        let falls = bounds.inverse_exit.is_none() && depth > bounds.inverse_horizon;
        let rises = bounds.inverse_exit.filter(|exit| depth < *exit);
        let heading = winding::heading(C::place(&y), C::place(&slope));
        let turn = winding::turn(&heading, &C::place(&step.end));
        let near_axis = turn.abs() > winding::DOUBTFUL;
        let mut next = End { stop: Stop::GaveUp, y: step.end, swept: swept + turn, steps };
        let mut stop = if falls { Some(Stop::Fell) } else { None };
        let cut = falls && bounds.exact_fall;
        if V::WANTS_SEGMENTS || crosses || grazes || leaves || near_axis || rises.is_some() || cut {
            let dense = M::dense(chart, &y, &stages, &step.end, &end_slope, h);
            let mut until = 1.0;
            if let Some(exit) = rises {
                // A step may reach far beyond.
                let within = |t: f64| chart.inverse_radius(&dense.at(t)) - exit;
                until = root(within, within(0.0), depth - exit);
                stop = Some(Stop::Rose);
            } else if leaves {
                until = root(|t| chart.reach(&dense.at(t)), chart.reach(&y), reach);
                stop = Some(Stop::Left);
            } else if falls {
                let above_horizon = |t: f64| bounds.inverse_horizon - chart.inverse_radius(&dense.at(t));
                until = root(above_horizon, above_horizon(0.0), bounds.inverse_horizon - depth);
            }
            if V::WANTS_SEGMENTS
                && let Some((theta, number)) = visitor.segment(&dense, sigma, h, until)
            {
                until = theta;
                stop = Some(Stop::Met(number));
            }
            let level = |t: f64| height(&dense.at(t));
            let meet = |theta: f64| {
                if theta < until {
                    let sweep = winding::sweep(&dense, C::PLACE, &heading, theta, sense);
                    let y = dense.at(theta);
                    visitor.crossing(&y, swept + sweep, C::approach(&y, &dense.slope(theta)));
                }
            };
            if crosses || grazes {
                meetings(level, [height(&y), above, below]).into_iter().flatten().for_each(meet);
            }
            if until < 1.0 {
                next.y = dense.at(until);
            }
            next.swept = swept + winding::sweep(&dense, C::PLACE, &heading, until, sense);
        }
        let outside = bounds.inverse_exit.is_some() && depth < bounds.inverse_horizon;
        if outside && rises.is_none() && depth > chart.inverse_radius(&y) {
            stop = Some(Stop::Sank);
        }
        if let Some(stop) = stop {
            return End { stop, ..next };
        }
        if below != 0.0 {
            above = below;
        }
        sigma += h;
        if adaptive {
            // After a refusal the step does not grow at once.
            h *= growth(ratio, M::ERROR_ORDER).clamp(0.2, if refused { 1.0 } else { 2.0 });
            refused = false;
        }
        (y, slope, swept) = (next.y, end_slope, next.swept);
        chart.settle(&mut y, &mut slope);
    }
}

/// The factor by which a step may change for its error to be 0.9^order of the tolerance.
#[inline(always)]
pub fn growth<S: Scalar>(ratio: S, order: f64) -> S {
    (ratio.max(ratio.constant(1e-10)).ln() * (-1.0 / order)).exp() * 0.9
}

/// The θ at which the plane is crossed in a step: one if it begins and ends on different sides, two or none if it
/// dips through. `start` and `below` are the heights at its ends, `above` that which counts for the start.
pub fn meetings(level: impl Fn(f64) -> f64, [start, above, below]: [f64; 3]) -> [Option<f64>; 2] {
    if (above > 0.0) != (below > 0.0) {
        // The plane where the step began counts as left behind, not as met.
        return [Some(root(level, if start == 0.0 { above * 1e-300 } else { start }, below)), None];
    }
    let Some(middle) = beyond_plane(&level, above) else { return [None; 2] };
    let other = level(middle);
    let first = root(|t| level(t * middle), above, other) * middle;
    let rest = 1.0 - middle;
    [Some(first), Some(middle + root(|t| level(middle + t * rest), other, below) * rest)]
}

/// A θ at which a height that dips towards zero within the step has passed it.
fn beyond_plane(level: &impl Fn(f64) -> f64, above: f64) -> Option<f64> {
    // Ternary search for the least height on the side where the step began.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let (at_left, at_right) = (level(left) * above, level(right) * above);
        if at_left < 0.0 {
            return Some(left);
        }
        if at_right < 0.0 {
            return Some(right);
        }
        if at_left < at_right { high = right } else { low = left }
    }
    None
}
