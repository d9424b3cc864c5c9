//! What happens within steps: crossings of the plane, the way out to infinity, turns about the axis.
//!
//! Steps wait here in the order in which they were taken, so that what a ray meets is found in order. A step in which
//! two things happen waits twice.

use super::Task;
use super::inverted_place;
use super::rank::{Rank, gather, scatter};
use super::record::Record;
use crate::geodesic::chart::Chart;
use crate::geodesic::dense::Dense;
use crate::geodesic::inverted::InvertedFlow;
use crate::geodesic::method::Method;
use crate::geodesic::walk::{End, Stop, meetings};
use crate::geodesic::winding;
use crate::metric::Metric;
use crate::tensor::{Vec3, dot};
use fearless_simd::Simd;

/// What a step is looked into for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// The plane lies between its ends.
    Crosses,
    /// It may dip through the plane.
    Grazes,
    /// It reaches infinity.
    Leaves,
    /// Its ends' azimuths do not tell which way around the axis it went.
    Turns,
}

/// Whose step it is.
#[derive(Clone, Copy)]
pub struct Event {
    /// The ray's number.
    pub ray: usize,
    /// The steps it has tried.
    pub steps: usize,
    /// What for.
    pub kind: Kind,
    /// Whether it ends within the horizon.
    pub falls: bool,
}

/// Steps that wait.
pub struct Events<const D: usize, const STAGES: usize, const W: usize> {
    record: Record<D, STAGES, W>,
    waiting: [Event; W],
    count: usize,
}

/// A step that begins in the plane, or dips through it.
struct Dip<const D: usize> {
    lane: usize,
    dense: Dense<f64, D>,
    heading: Vec3<f64>,
}

/// What is found within the steps.
struct Found<const D: usize, const W: usize> {
    /// The state where it happens.
    y: [[f64; W]; D],
    /// The azimuth swept from the start of the step to there.
    swept: [f64; W],
    /// The rate of 1/distance there.
    approach: [f64; W],
    /// Where it happens before infinity, and outside the horizon.
    outside: u64,
    /// Steps, which are rare, to be looked into one by one.
    dips: Vec<Dip<D>>,
}

impl<const D: usize, const STAGES: usize, const W: usize> Events<D, STAGES, W> {
    pub fn new() -> Self {
        let none = Event { ray: 0, steps: 0, kind: Kind::Turns, falls: false };
        Self { record: Record::EMPTY, waiting: [none; W], count: 0 }
    }

    /// Adds a lane of a record; says whether there is no room for more.
    #[inline(always)]
    pub fn push<R: Method<STAGES>>(
        &mut self,
        other: &Record<D, STAGES, W>,
        from: usize,
        event: Event,
    ) -> bool {
        self.record.copy(self.count, other, from, R::SPARED);
        self.waiting[self.count] = event;
        self.count += 1;
        self.count == W
    }

    /// Looks into the steps and forgets them.
    #[inline(always)]
    pub fn flush<L, S, M, R>(&mut self, simd: L, task: &mut Task<'_, M>)
    where
        L: Simd,
        S: Rank<L, W>,
        M: Metric,
        R: Method<STAGES>,
    {
        if self.count == 0 {
            return;
        }
        let mut found =
            Found { y: [[0.0; W]; D], swept: [0.0; W], approach: [0.0; W], outside: 0, dips: Vec::new() };
        let (this, result) = (&*self, &mut found);
        simd.vectorize(
            #[inline(always)]
            || this.look::<L, S, M, R>(simd, task, result),
        );
        for lane in 0..self.count {
            let Event { ray, steps, kind, falls } = self.waiting[lane];
            let step_swept = found.swept[lane];
            let swept = self.record.swept[lane] + task.corrections[ray] + step_swept;
            let y = found.y.each_ref().map(|column| column[lane]);
            let dip = found.dips.iter().find(|dip| dip.lane == lane);
            match (kind, dip) {
                (Kind::Crosses | Kind::Grazes, Some(dip)) => self.dip(dip, task),
                (Kind::Crosses, None) => {
                    // A ray that ends within the horizon has crossed it by then.
                    if y[0] > task.integrator.reversed.edge() && (!falls || found.outside >> lane & 1 != 0) {
                        task.meet(ray, &y, swept, found.approach[lane]);
                    }
                }
                (Kind::Leaves, _) => task.conclude(ray, &End { stop: Stop::Left, y, swept, steps }),
                (Kind::Turns, _) => task.corrections[ray] += step_swept - self.record.turn[lane],
                (Kind::Grazes, None) => {}
            }
        }
        self.count = 0;
    }

    fn lanes(&self, kind: Kind) -> u64 {
        let mut bits = 0;
        for lane in 0..self.count {
            bits |= u64::from(self.waiting[lane].kind == kind) << lane;
        }
        bits
    }

    /// Finds where it happens. Steps that begin in the plane, or dip through it, are kept.
    #[inline(always)]
    fn look<L, S, M, R>(&self, simd: L, task: &Task<'_, M>, found: &mut Found<D, W>)
    where
        L: Simd,
        S: Rank<L, W>,
        M: Metric,
        R: Method<STAGES>,
    {
        let Record { y, end, stages, end_slope, h, energy, .. } = &self.record;
        let flow = InvertedFlow { metric: task.integrator.reversed, energy: S::gather(simd, energy) };
        let y: [S; D] = gather(simd, y);
        let h = S::gather(simd, h);
        let (zero, one) = (h.constant(0.0), h.constant(1.0));
        let mut slopes = [[zero; D]; STAGES];
        for stage in 0..STAGES {
            if stage == 0 || stage > R::SPARED {
                slopes[stage] = gather(simd, &stages[stage]);
            }
        }
        let dense = R::dense(&flow, &y, &slopes, &gather(simd, end), &gather(simd, end_slope), h);
        let heading = winding::heading(inverted_place(&y), inverted_place(&slopes[0]));

        // The sum of w and the place that is zero there: w itself, or the height above the plane.
        let leaves = S::mask(simd, self.lanes(Kind::Leaves));
        let [a, b, c] = task.query.plane;
        let weights = [
            S::select(leaves, one, zero),
            S::select(leaves, zero, one * a),
            S::select(leaves, zero, one * b),
            S::select(leaves, zero, one * c),
        ];
        let whole = S::mask(simd, self.lanes(Kind::Turns));
        let edge = S::select(leaves, one * flow.metric.edge(), zero);
        let theta = S::select(whole, one, dense.weighted(&weights).lowered(edge).zero());
        let there = dense.at(theta);
        let depth = flow.inverse_radius(&there);
        found.outside = !S::bits(depth.constant(1.0 / flow.metric.horizon()).less(depth));
        found.y = scatter(&there);
        found.approach = dense.component_slope(0, theta).scatter();
        found.swept = self.sweep::<L, S>(&dense, heading, theta, &there);
        for lane in 0..self.count {
            let kind = self.waiting[lane].kind;
            if kind == Kind::Grazes || kind == Kind::Crosses && self.starts_in_plane(task, lane) {
                let heading = [heading[0].lane(lane), heading[1].lane(lane), heading[2].lane(lane)];
                found.dips.push(Dip { lane, dense: dense.lane(lane), heading });
            }
        }
    }

    /// The azimuth swept up to θ = `to`, by the rule of [`winding::sweep`], which is asked itself where halving the
    /// step once does not settle it.
    #[inline(always)]
    fn sweep<L: Simd, S: Rank<L, W>>(
        &self,
        dense: &Dense<S, D>,
        heading: Vec3<S>,
        to: S,
        there: &[S; D],
    ) -> [f64; W] {
        let half = to * 0.5;
        let middle = [dense.component(1, half), dense.component(2, half), dense.component(3, half)];
        let last = inverted_place(there);
        let whole = winding::turn(&heading, &last);
        let (left, right) = (winding::turn(&heading, &middle), winding::turn(&middle, &last));
        let (both, gap) = (left.abs().max(right.abs()), (left + right - whole).abs());
        let settled = S::bits(whole.abs().less(whole.constant(0.25)))
            | S::bits(both.less(whole.constant(winding::DOUBTFUL)))
                & S::bits(gap.less(whole.constant(1e-6)))
                & !(S::bits(winding::hugs_axis(&heading)) & S::bits(winding::hugs_axis(&last)));
        let mut swept = whole.scatter();
        for lane in 0..self.count {
            if settled >> lane & 1 == 0 {
                let heading = [heading[0].lane(lane), heading[1].lane(lane), heading[2].lane(lane)];
                swept[lane] = winding::sweep(&dense.lane(lane), 1, &heading, to.lane(lane), self.sense(lane));
            }
        }
        swept
    }

    /// The sense of the angular momentum about the axis.
    fn sense(&self, lane: usize) -> f64 {
        if self.record.y[7][lane] < 0.0 { -1.0 } else { 1.0 }
    }

    fn starts_in_plane<M>(&self, task: &Task<'_, M>, lane: usize) -> bool {
        let y = &self.record.y;
        dot(&[y[1][lane], y[2][lane], y[3][lane]], &task.query.plane) == 0.0
    }

    /// Steps that begin in the plane, or dip through it: one by one.
    fn dip<M: Metric>(&self, dip: &Dip<D>, task: &mut Task<'_, M>) {
        let Dip { lane, dense, heading } = dip;
        let lane = *lane;
        let Event { ray, falls, .. } = self.waiting[lane];
        let plane = task.query.plane;
        let height = |y: &[f64; D]| dot(&inverted_place(y), &plane);
        let heights = [height(&dense.at(0.0)), self.record.above[lane], height(&dense.at(1.0))];
        let flow = task.flow(ray);
        for theta in meetings(|t| height(&dense.at(t)), heights).into_iter().flatten() {
            let y = dense.at(theta);
            let inside = flow.inverse_radius(&y) * flow.metric.horizon() > 1.0;
            if y[0] > flow.metric.edge() && !(falls && inside) {
                let sweep = winding::sweep(dense, 1, heading, theta, self.sense(lane));
                let swept = self.record.swept[lane] + task.corrections[ray] + sweep;
                task.meet(ray, &y, swept, dense.component_slope(0, theta));
            }
        }
    }
}
