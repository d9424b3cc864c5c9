//! One ray's way through spherical coordinates, step by step.

use super::super::dense::{Dense, root};
use super::super::flow::Flow;
use super::super::method::Method;
use super::super::walk::{Control, Stop, growth, meetings};
use super::flow::{SphericalFlow, WIDTH};
use crate::geometry::Geometry;

/// Where the walk stops.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Just outside the horizon, M.
    pub inner: f64,
    /// Where constant steps end, M; infinite for a state that holds 1/r, which goes on to infinity itself.
    pub outer: f64,
}

/// A step from parameter `start`, of size `h`, that counts up to θ = `until`.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    pub dense: Dense<f64, WIDTH>,
    pub start: f64,
    pub h: f64,
    pub until: f64,
}

/// The end of a walk.
#[derive(Clone, Copy, Debug)]
pub struct End {
    pub stop: Stop,
    pub y: [f64; WIDTH],
    pub steps: usize,
}

/// How a step's ends count: distances left inwards and outwards, both positive while the walk goes on.
fn room<G: Geometry<4>>(flow: &SphericalFlow<G>, limits: &Limits, y: &[f64; WIDTH]) -> [f64; 2] {
    if flow.inverted {
        [limits.inner.recip() - y[0], y[0]]
    } else {
        [y[0] - limits.inner, limits.outer - y[0]]
    }
}

/// Follows a photon from `y`; tells of crossings of the plane above which `height` is positive, and of steps.
pub fn walk<G, M, const STAGES: usize>(
    flow: &SphericalFlow<G>,
    mut y: [f64; WIDTH],
    limits: &Limits,
    control: &Control,
    height: &impl Fn(&[f64; WIDTH]) -> f64,
    mut crossing: impl FnMut(&[f64; WIDTH]),
    mut segment: Option<&mut dyn FnMut(Segment)>,
) -> End
where
    G: Geometry<4>,
    M: Method<STAGES>,
{
    let adaptive = M::ERROR_ORDER > 0.0;
    // A step in which a free photon turns by an angle, next to infinity and far from it.
    let step_for =
        |y: &[f64; WIDTH], angle: f64| angle / (flow.turning(y) + flow.energy.abs() + y[3].abs() * y[0]);
    let mut slope = flow.derivative(&y);
    let mut h = if adaptive { step_for(&y, 0.3) } else { control.step };
    let (mut done, mut steps, mut refused) = (0.0, 0, false);
    // A photon that starts in the plane has not crossed it.
    let mut above = height(&y);
    loop {
        if steps >= control.max_steps {
            return End { stop: Stop::GaveUp, y, steps };
        }
        steps += 1;
        if adaptive {
            h = h.min(step_for(&y, control.max_turn));
        }
        let mut stages = [slope; STAGES];
        let step = M::step(flow, &y, &mut stages, h);
        let finite = step.error.is_finite() && step.end.iter().take(5).all(|c| c.is_finite());
        let ratio = step.error / control.tolerance;
        if !finite || (adaptive && ratio > 1.0) {
            refused = true;
            h *= if finite { growth(ratio, M::ERROR_ORDER).clamp(0.1, 0.9) } else { 0.1 };
            if !adaptive || h < step_for(&y, 1e-14) {
                return End { stop: Stop::GaveUp, y, steps };
            }
            continue;
        }
        let end_slope = step.end_slope.unwrap_or_else(|| flow.derivative(&step.end));
        let [inwards, outwards] = room(flow, limits, &step.end);
        let below = height(&step.end);
        let dense = M::dense(flow, &y, &stages, &step.end, &end_slope, h);
        let level = |t: f64| height(&dense.at(t));
        let (mut until, mut stop) = (1.0, None);
        for (left, why) in [(inwards, Stop::Fell), (outwards, Stop::Left)] {
            if left < 0.0 && stop.is_none() {
                let which = usize::from(why == Stop::Left);
                let within = |t: f64| room(flow, limits, &dense.at(t))[which];
                until = root(within, within(0.0).max(f64::MIN_POSITIVE), left);
                stop = Some(why);
            }
        }
        let crosses = above != 0.0 && below != 0.0 && (above > 0.0) != (below > 0.0);
        let grazes = !crosses && above != 0.0 && {
            let (first, last) = (level(1e-3), level(1.0 - 1e-3));
            above * (first - height(&y)) < 0.0 && below * (below - last) > 0.0
        };
        if crosses || grazes {
            for theta in meetings(level, [height(&y), above, below]).into_iter().flatten() {
                if theta < until {
                    crossing(&dense.at(theta));
                }
            }
        }
        if let Some(segment) = &mut segment {
            segment(Segment { dense, start: done, h, until });
        }
        if let Some(stop) = stop {
            return End { stop, y: if until < 1.0 { dense.at(until) } else { step.end }, steps };
        }
        if below != 0.0 {
            above = below;
        }
        done += h;
        (y, slope) = (step.end, end_slope);
        if adaptive {
            // After a refusal the step does not grow at once.
            h *= growth(ratio, M::ERROR_ORDER).clamp(0.2, if refused { 1.0 } else { 2.0 });
            refused = false;
        }
    }
}
