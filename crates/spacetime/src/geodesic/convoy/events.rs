//! What happens within steps: crossings of the plane, the way out to infinity, turns about the axis.
//!
//! Steps wait here in the order in which they were taken, so that what a ray meets is found in order.

use super::Task;
use super::rank::{Rank, gather, scatter};
use super::record::Record;
use crate::geodesic::chart::Chart;
use crate::geodesic::dense::Dense;
use crate::geodesic::inverted::InvertedFlow;
use crate::geodesic::method::{Method, Step};
use crate::geodesic::walk::{End, Stop, meetings};
use crate::geodesic::winding;
use crate::metric::Metric;
use crate::scalar::Scalar;
use crate::tensor::{Vec3, dot};
use fearless_simd::Simd;

/// What happens in the steps of many lanes, a bit for each.
#[derive(Clone, Copy, Default)]
pub struct Kinds {
    /// The plane lies between the step's ends.
    pub crosses: u64,
    /// The plane may be dipped through.
    pub grazes: u64,
    /// The ray reaches infinity.
    pub leaves: u64,
    /// The ray falls through the horizon.
    pub falls: u64,
    /// The ends' azimuths do not tell which way around the axis the ray went.
    pub turns: u64,
}

impl Kinds {
    fn add(&mut self, to: usize, other: &Self, from: usize) {
        let moved = |bits: u64| (bits >> from & 1) << to;
        self.crosses |= moved(other.crosses);
        self.grazes |= moved(other.grazes);
        self.leaves |= moved(other.leaves);
        self.falls |= moved(other.falls);
        self.turns |= moved(other.turns);
    }
}

/// Steps that wait.
pub struct Events<const D: usize, const STAGES: usize, const W: usize> {
    record: Record<D, STAGES, W>,
    kinds: Kinds,
    /// The rays' numbers and how many steps they had.
    rays: [(usize, usize); W],
    count: usize,
}

/// What is found within the steps.
struct Found<const D: usize, const W: usize> {
    met: u64,
    crossing: [[f64; W]; D],
    /// Azimuth swept from the start of the step to the crossing.
    to_crossing: [f64; W],
    end: [[f64; W]; D],
    /// Azimuth swept over the step, or to infinity.
    to_end: [f64; W],
}

impl<const D: usize, const STAGES: usize, const W: usize> Events<D, STAGES, W> {
    pub fn new() -> Self {
        Self { record: Record::EMPTY, kinds: Kinds::default(), rays: [(0, 0); W], count: 0 }
    }

    /// Adds a lane of a record; says whether there is no room for more.
    #[inline(always)]
    pub fn push<R: Method<STAGES>>(
        &mut self,
        other: &Record<D, STAGES, W>,
        from: usize,
        kinds: &Kinds,
        ray: usize,
        steps: usize,
    ) -> bool {
        self.record.copy(self.count, other, from, R::SPARED);
        self.kinds.add(self.count, kinds, from);
        self.rays[self.count] = (ray, steps);
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
        let mut found = Found {
            met: 0,
            crossing: [[0.0; W]; D],
            to_crossing: [0.0; W],
            end: [[0.0; W]; D],
            to_end: [0.0; W],
        };
        let this = &*self;
        let found_ref = &mut found;
        simd.vectorize(
            #[inline(always)]
            || this.look::<L, S, M, R>(simd, task, found_ref),
        );
        for lane in 0..self.count {
            let is = |bits: u64| bits >> lane & 1 != 0;
            let (ray, steps) = self.rays[lane];
            let swept = self.record.swept[lane] + task.corrections[ray];
            let state = |columns: &[[f64; W]; D]| columns.each_ref().map(|column| column[lane]);
            if is(found.met) {
                task.meet(ray, &state(&found.crossing), swept + found.to_crossing[lane]);
            }
            if is(self.kinds.leaves) {
                let end =
                    End { stop: Stop::Left, y: state(&found.end), swept: swept + found.to_end[lane], steps };
                task.conclude(ray, &end);
            } else if is(self.kinds.turns) {
                task.corrections[ray] += found.to_end[lane] - self.record.turn[lane];
            }
        }
        self.kinds = Kinds::default();
        self.count = 0;
    }

    /// Finds what there is. Dips through the plane, which are rare, are reported at once.
    #[inline(always)]
    fn look<L, S, M, R>(&self, simd: L, task: &mut Task<'_, M>, found: &mut Found<D, W>)
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
        let zero = h.constant(0.0);
        let mut step =
            Step { end: gather(simd, end), error: zero, stages: [[zero; D]; STAGES], end_slope: None };
        for stage in 0..STAGES {
            if stage == 0 || stage > R::SPARED {
                step.stages[stage] = gather(simd, &stages[stage]);
            }
        }
        let dense = R::dense(&flow, &y, &step, &gather(simd, end_slope), h);
        let one = h.constant(1.0);
        let first = <InvertedFlow<M, S> as Chart<S, D>>::PLACE;
        let heading = winding::heading(
            <InvertedFlow<M, S> as Chart<S, D>>::place(&y),
            <InvertedFlow<M, S> as Chart<S, D>>::place(&step.stages[0]),
        );

        let kinds = &self.kinds;
        let mut until = one;
        if kinds.leaves != 0 {
            let reached = dense.weighted(0, &[1.0]).zero();
            until = S::select(S::mask(simd, kinds.leaves), reached, one);
        }
        if kinds.crosses | kinds.grazes != 0 {
            let height = dense.weighted(first, &task.query.plane);
            let theta = height.zero();
            let crossing = dense.at(theta);
            let depth = flow.inverse_radius(&crossing);
            let limit = depth.constant(1.0 / task.integrator.reversed.horizon());
            let beyond = S::bits(limit.less(depth)) & kinds.falls;
            found.met = kinds.crosses & S::bits(theta.less(until)) & !beyond;
            found.crossing = scatter(&crossing);
            found.to_crossing = self.sweep::<L, S>(&dense, first, heading, theta, found.met);
            // In the plane at its start a ray has not met it.
            let start = height.component(0, zero).abs();
            let odd = kinds.crosses & !S::bits(zero.less(start)) | kinds.grazes;
            if odd != 0 {
                found.met &= !odd;
                self.dip::<L, S, M>(&dense, first, heading, until, odd, task);
            }
        }
        if kinds.leaves | kinds.turns != 0 {
            found.end = scatter(&dense.at(until));
            found.to_end = self.sweep::<L, S>(&dense, first, heading, until, kinds.leaves | kinds.turns);
        }
    }

    /// The azimuth swept up to θ = `to`, by the rule of [`winding::sweep`], which is asked itself where halving the
    /// step once does not settle it.
    #[inline(always)]
    fn sweep<L: Simd, S: Rank<L, W>>(
        &self,
        dense: &Dense<S, D>,
        first: usize,
        heading: Vec3<S>,
        to: S,
        wanted: u64,
    ) -> [f64; W] {
        let (middle, last) = (place(dense, first, to * 0.5), place(dense, first, to));
        let whole = winding::turn(&heading, &last);
        let (left, right) = (winding::turn(&heading, &middle), winding::turn(&middle, &last));
        let (both, gap) = (left.abs().max(right.abs()), (left + right - whole).abs());
        let settled = S::bits(whole.abs().less(whole.constant(0.25)))
            | S::bits(both.less(whole.constant(winding::DOUBTFUL)))
                & S::bits(gap.less(whole.constant(1e-6)))
                & !(S::bits(winding::hugs_axis(&heading)) & S::bits(winding::hugs_axis(&last)));
        let mut swept = whole.scatter();
        let mut open = wanted & !settled;
        while open != 0 {
            let lane = open.trailing_zeros() as usize;
            open &= open - 1;
            let sense = self.sense(lane);
            let heading = heading.map(|c| c.lane(lane));
            swept[lane] = winding::sweep(&dense.lane(lane), first, &heading, to.lane(lane), sense);
        }
        swept
    }

    /// The sense of the angular momentum about the axis.
    fn sense(&self, lane: usize) -> f64 {
        if self.record.y[7][lane] < 0.0 { -1.0 } else { 1.0 }
    }

    /// Steps that begin in the plane, or dip through it: one by one.
    #[inline(always)]
    fn dip<L: Simd, S: Rank<L, W>, M: Metric>(
        &self,
        dense: &Dense<S, D>,
        first: usize,
        heading: Vec3<S>,
        until: S,
        lanes: u64,
        task: &mut Task<'_, M>,
    ) {
        let mut lanes = lanes;
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            let (dense, heading) = (dense.lane(lane), heading.map(|c| c.lane(lane)));
            let (ray, _) = self.rays[lane];
            let metric = task.integrator.reversed;
            let height = |y: &[f64; D]| dot(&[y[first], y[first + 1], y[first + 2]], &task.query.plane);
            let at = |columns: &[[f64; W]; D]| height(&columns.each_ref().map(|column| column[lane]));
            let heights = [at(&self.record.y), self.record.above[lane], at(&self.record.end)];
            let falls = self.kinds.falls >> lane & 1 != 0;
            for theta in meetings(|t| height(&dense.at(t)), heights).into_iter().flatten() {
                let y = dense.at(theta);
                let inside = metric.inverse_radius(y[0], &[y[1], y[2], y[3]]) * metric.horizon() > 1.0;
                if theta < until.lane(lane) && !(falls && inside) {
                    let sweep = winding::sweep(&dense, first, &heading, theta, self.sense(lane));
                    task.meet(ray, &y, self.record.swept[lane] + task.corrections[ray] + sweep);
                }
            }
        }
    }
}

#[inline(always)]
fn place<S: Scalar, const D: usize>(dense: &Dense<S, D>, first: usize, theta: S) -> Vec3<S> {
    [dense.component(first, theta), dense.component(first + 1, theta), dense.component(first + 2, theta)]
}
