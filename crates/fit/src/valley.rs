//! The valley of a posterior along the observer's distance, where it is long.
//!
//! Of a disk that is seen from above, for one, pictures hardly tell the distance: it may be anything from some hundred M on, while the
//! others are known to 1e-5 for each distance. So narrow a valley, so long, is no straight line in 1/r either.

use crate::likelihood::Posterior;
use crate::mode::{Mode, climb_holding};
use crate::model::{Cancelled, Source};
use crate::shear::Shear;

/// Standard deviation of the distance's coordinate from which a valley is long: a tenth of the distance.
const LONG: f64 = 0.1;

/// How much less probable the ends of a valley are than its middle; what is less probable still is lost.
const END: f64 = 10.0;
const LOST: f64 = 30.0;

/// Steps to each end at most: half as long after one that was lost, else longer by this.
const STEPS: usize = 24;
const LONGER: f64 = 1.5;

/// The first step, as a share of 1/r at the mode.
const FIRST: f64 = 0.2;

/// Evaluations at a step at most.
const MOST: usize = 12;

/// The shear of a mode led along its valley, if that is long, and evaluations that this took.
pub fn follow<S: Source>(
    posterior: &Posterior<'_, S>,
    mode: &Mode,
    cancelled: Cancelled<'_>,
) -> (Option<Shear>, usize) {
    let Some(mut shear) = mode.shear.clone() else { return (None, 0) };
    let d = shear.index();
    if mode.factor.inverse()[(d, d)].sqrt() < LONG {
        return (Some(shear), 0);
    }
    let mut evaluations = 0;
    for way in [-1.0, 1.0] {
        let (mut u, mut step) = (shear.u(), way * FIRST * shear.u());
        for _ in 0..STEPS {
            let Some(start) = shear.valley(u + step) else { break };
            let found = climb_holding(posterior, &start, Some(d), MOST, cancelled);
            let deep = found.as_ref().map_or(f64::INFINITY, |f| mode.evaluation.log - f.evaluation.log);
            evaluations += found.as_ref().map_or(1, |found| found.evaluations);
            let Some(next) = found.and_then(|found| found.shear).filter(|_| deep < LOST) else {
                step *= 0.5;
                continue;
            };
            shear.lead_through(&next);
            u += step;
            step *= LONGER;
            if deep > END {
                break;
            }
        }
    }
    (Some(shear), evaluations)
}
