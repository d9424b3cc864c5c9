//! Through the throat of a wormhole.
//!
//! Space goes on behind the sphere |x| = R as its own mirror image. In the mirror's coordinates, which are those of
//! this side, a photon that arrives at the sphere leaves it again where it arrived, the radial part of its momentum
//! reversed: q → −q, J as it was. How often it did so tells on which side it is.

use super::chart::Chart;
use super::inverted::InvertedFlow;
use super::method::Method;
use super::walk::{Bounds, Control, End, Stop, Visitor, walk};
use super::{Dense, Path};
use crate::metric::Metric;

/// What a photon meets on the other side: nothing is asked for there.
struct Unseen;

impl<const D: usize> Visitor<D> for Unseen {
    const WANTS_SEGMENTS: bool = false;
    fn crossing(&mut self, _y: &[f64; D], _swept: f64, _approach: f64) {}
    fn segment(&mut self, _: &Dense<f64, D>, _: f64, _: f64, _: f64) -> Option<(f64, usize)> {
        None
    }
}

/// From a throat on, through it as often as it is met. What lies in this side's plane is not met any more, after a
/// return from the other side either.
pub(super) fn pass_throats<M: Metric, R: Method<STAGES>, const D: usize, const STAGES: usize>(
    flow: &InvertedFlow<M, f64>,
    mut end: End<D>,
    bounds: &Bounds,
    control: &Control,
    path: &mut Path,
) -> End<D>
where
    InvertedFlow<M, f64>: Chart<f64, D>,
{
    while end.stop == Stop::Fell {
        path.other_side = !path.other_side;
        let mut y = end.y;
        y[4] = -y[4];
        let rest = Control { max_steps: control.max_steps.saturating_sub(end.steps), ..*control };
        let next = walk::<_, R, _, D, STAGES>(flow, y, bounds, &rest, &mut Unseen);
        end = End { swept: end.swept + next.swept, steps: end.steps + next.steps, ..next };
    }
    end
}
