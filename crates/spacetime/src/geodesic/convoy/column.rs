//! The rays that are under way.

use super::Task;
use super::events::{Event, Events, Kind};
use super::inverted_place as place;
use super::rank::{Rank, gather, scatter};
use super::record::Record;
use crate::geodesic::chart::Chart;
use crate::geodesic::flow::Flow;
use crate::geodesic::inverted::{InvertedFlow, pack};
use crate::geodesic::method::Method;
use crate::geodesic::walk::{Control, End, Stop, growth};
use crate::geodesic::winding;
use crate::metric::Metric;
use crate::scalar::Scalar;
use crate::tensor::{Vec3, dot};
use fearless_simd::Simd;

/// `W` rays in their charts, lane by lane.
struct Rays<const D: usize, const W: usize> {
    y: [[f64; W]; D],
    slope: [[f64; W]; D],
    /// The step to try next.
    h: [f64; W],
    /// The factor by which it may grow: 1 after a refusal.
    bold: [f64; W],
    energy: [f64; W],
    /// The last height above the plane that was not zero.
    above: [f64; W],
    /// Azimuth swept, as steps' ends tell.
    swept: [f64; W],
}

impl<const D: usize, const W: usize> Rays<D, W> {
    const EMPTY: Self = Self {
        y: [[1.0; W]; D],
        slope: [[0.0; W]; D],
        h: [0.0; W],
        bold: [1.0; W],
        energy: [1.0; W],
        above: [1.0; W],
        swept: [0.0; W],
    };

    #[inline(always)]
    fn copy(&mut self, to: usize, other: &Self, from: usize) {
        for i in 0..D {
            self.y[i][to] = other.y[i][from];
            self.slope[i][to] = other.slope[i][from];
        }
        self.h[to] = other.h[from];
        self.bold[to] = other.bold[from];
        self.energy[to] = other.energy[from];
        self.above[to] = other.above[from];
        self.swept[to] = other.swept[from];
    }
}

/// What happens in a step, a bit for each lane.
#[derive(Clone, Copy, Default)]
struct Kinds {
    crosses: u64,
    grazes: u64,
    leaves: u64,
    falls: u64,
    turns: u64,
}

/// What came of trying a step, a bit for each lane.
#[derive(Clone, Copy, Default)]
struct Outcome {
    kinds: Kinds,
    accepted: u64,
    /// The step cannot be made small enough.
    stuck: u64,
}

/// A column of rays on their way.
pub struct Column<const D: usize, const STAGES: usize, const W: usize> {
    rays: Rays<D, W>,
    /// The rays' numbers and how many steps they have tried.
    numbers: [usize; W],
    steps: [usize; W],
    /// How many crossings may yet be kept.
    wanted: [usize; W],
    busy: u64,
    /// Rays ready to start, and how many of them have.
    waiting: Rays<D, W>,
    started: usize,
    /// The first ray that is not among those waiting.
    next: usize,
    record: Record<D, STAGES, W>,
    events: Events<D, STAGES, W>,
}

impl<const D: usize, const STAGES: usize, const W: usize> Column<D, STAGES, W> {
    pub fn new() -> Self {
        Self {
            rays: Rays::EMPTY,
            numbers: [0; W],
            steps: [0; W],
            wanted: [0; W],
            busy: 0,
            waiting: Rays::EMPTY,
            started: W,
            next: 0,
            record: Record::EMPTY,
            events: Events::new(),
        }
    }

    /// Follows all rays of a task.
    #[inline(always)]
    pub fn follow<L, S, M, R>(&mut self, simd: L, task: &mut Task<'_, M>)
    where
        L: Simd,
        S: Rank<L, W>,
        M: Metric,
        R: Method<STAGES>,
    {
        let control = task.integrator.control();
        let mut stages = [gather(simd, &self.rays.slope); STAGES];
        loop {
            self.fill::<L, S, M>(simd, task);
            if self.busy == 0 {
                break;
            }
            let mut outcome = Outcome::default();
            let result = &mut outcome;
            simd.vectorize(
                #[inline(always)]
                || *result = self.attempt::<L, S, M, R>(simd, task, &control, &mut stages),
            );
            self.see::<L, S, M, R>(simd, task, &control, outcome);
        }
        self.events.flush::<L, S, M, R>(simd, task);
    }

    /// Gives a ray that waits to every empty lane, while there are any.
    #[inline(always)]
    fn fill<L: Simd, S: Rank<L, W>, M: Metric>(&mut self, simd: L, task: &Task<'_, M>) {
        for lane in 0..W {
            if self.busy >> lane & 1 != 0 {
                continue;
            }
            let ready = self.next.min(task.rays.len());
            if self.started == W || self.next - W + self.started >= ready {
                if self.next >= task.rays.len() {
                    return;
                }
                simd.vectorize(
                    #[inline(always)]
                    || self.prepare::<L, S, M>(simd, task),
                );
                self.next += W;
                self.started = 0;
            }
            self.rays.copy(lane, &self.waiting, self.started);
            self.numbers[lane] = self.next - W + self.started;
            self.steps[lane] = 0;
            self.wanted[lane] = task.query.max_crossings;
            self.busy |= 1 << lane;
            self.started += 1;
        }
    }

    /// Makes the next `W` rays ready; what is missing repeats the last.
    #[inline(always)]
    fn prepare<L: Simd, S: Rank<L, W>, M: Metric>(&mut self, simd: L, task: &Task<'_, M>) {
        let waiting = &mut self.waiting;
        for lane in 0..W {
            let ray = &task.rays[(self.next + lane).min(task.rays.len() - 1)];
            let y: [f64; D] = pack(&ray.start);
            for i in 0..D {
                waiting.y[i][lane] = y[i];
            }
            waiting.energy[lane] = ray.energy;
        }
        let flow =
            InvertedFlow { metric: task.integrator.reversed, energy: S::gather(simd, &waiting.energy) };
        let mut y: [S; D] = gather(simd, &waiting.y);
        let mut slope = flow.derivative(&y);
        flow.settle(&mut y, &mut slope);
        // A photon that starts in the plane has not crossed it.
        let height = height(&place(&y), &task.query.plane);
        let nowhere = S::select(
            height.constant(0.0).less(height.abs()),
            height,
            self::height(&place(&slope), &task.query.plane),
        );
        waiting.above = nowhere.scatter();
        waiting.h = flow.step_for(&y, 0.3).scatter();
        waiting.bold = [2.0; W];
        waiting.swept = [0.0; W];
        waiting.y = scatter(&y);
        waiting.slope = scatter(&slope);
    }

    /// Tries a step in every lane. `stages` is a place for the method's slopes.
    #[inline(always)]
    fn attempt<L, S, M, R>(
        &mut self,
        simd: L,
        task: &Task<'_, M>,
        control: &Control,
        stages: &mut [[S; D]; STAGES],
    ) -> Outcome
    where
        L: Simd,
        S: Rank<L, W>,
        M: Metric,
        R: Method<STAGES>,
    {
        let rays = &mut self.rays;
        let metric = task.integrator.reversed;
        let flow = InvertedFlow { metric, energy: S::gather(simd, &rays.energy) };
        let y: [S; D] = gather(simd, &rays.y);
        let slope: [S; D] = gather(simd, &rays.slope);
        let h =
            S::gather(simd, &rays.h).min(flow.step_for(&y, control.max_turn)).min(flow.way_out(&y, &slope));
        let (zero, one) = (h.constant(0.0), h.constant(1.0));
        stages[0] = slope;
        let step = R::step(&flow, &y, stages, h);
        let end_slope = match step.end_slope {
            Some(slope) => slope,
            None => flow.derivative(&step.end),
        };

        // Any number that is not finite makes their sum so.
        let mut size = step.error;
        for i in 0..D {
            size += step.end[i].abs();
        }
        let finite = size.less(size.constant(f64::INFINITY));
        let ratio = step.error * (1.0 / control.tolerance);
        let ratio = S::select(finite, ratio, one);
        let small = ratio.less(one.constant(1.0f64.next_up()));
        let accepted_bits = S::bits(small) & S::bits(finite) & self.busy;
        let accepted = S::mask(simd, accepted_bits);
        let bold = S::gather(simd, &rays.bold);
        let growth = growth(ratio, R::ERROR_ORDER);
        let shrunk = S::select(finite, growth.max(one * 0.1).min(one * 0.9), one * 0.1);
        let next = h * S::select(accepted, growth.max(one * 0.2).min(bold), shrunk);
        let least = flow.step_for(&y, 1e-14);
        let mut outcome = Outcome { accepted: accepted_bits, ..Outcome::default() };
        outcome.stuck = S::bits(next.less(least)) & !accepted_bits & self.busy;

        // What happens within this step?
        let plane = &task.query.plane;
        let end = place(&step.end);
        let above = S::gather(simd, &rays.above);
        let below = height(&end, plane);
        let depth = flow.inverse_radius(&step.end);
        let heading = winding::heading(place(&y), place(&slope));
        let turn = winding::turn(&heading, &end);
        let yes = |mask: S::Mask| S::bits(mask) & accepted_bits;
        let crosses = yes((above * below).less(zero));
        let kinds = &mut outcome.kinds;
        kinds.crosses = crosses;
        kinds.grazes = yes((above * height(&place(&slope), plane)).less(zero))
            & yes(zero.less(below * height(&place(&end_slope), plane)))
            & !crosses;
        kinds.leaves = yes(flow.reach(&step.end).less(zero));
        kinds.falls = yes(depth.constant(1.0 / metric.horizon()).less(depth));
        kinds.turns = yes(turn.constant(winding::DOUBTFUL).less(turn.abs()));
        if kinds.crosses | kinds.grazes | kinds.leaves | kinds.turns != 0 {
            let record = &mut self.record;
            record.y = scatter(&y);
            record.end = scatter(&step.end);
            record.end_slope = scatter(&end_slope);
            for stage in 0..STAGES {
                if stage == 0 || stage > R::SPARED {
                    record.stages[stage] = scatter(&stages[stage]);
                }
            }
            record.h = h.scatter();
            record.energy = flow.energy.scatter();
            record.above = rays.above;
            record.swept = rays.swept;
            record.turn = turn.scatter();
        }

        let (mut next_y, mut next_slope) = (y, slope);
        for i in 0..D {
            next_y[i] = S::select(accepted, step.end[i], y[i]);
            next_slope[i] = S::select(accepted, end_slope[i], slope[i]);
        }
        flow.settle(&mut next_y, &mut next_slope);
        rays.y = scatter(&next_y);
        rays.slope = scatter(&next_slope);
        rays.h = next.scatter();
        // After a refusal the step does not grow at once.
        rays.bold = S::select(accepted, one * 2.0, one).scatter();
        let swept = S::gather(simd, &rays.swept);
        rays.swept = S::select(accepted, swept + turn, swept).scatter();
        let counts = S::mask(simd, accepted_bits & S::bits(zero.less(below.abs())));
        rays.above = S::select(counts, below, above).scatter();
        outcome
    }

    /// Puts steps aside in which something happens, and ends rays.
    #[inline(always)]
    fn see<L, S, M, R>(&mut self, simd: L, task: &mut Task<'_, M>, control: &Control, outcome: Outcome)
    where
        L: Simd,
        S: Rank<L, W>,
        M: Metric,
        R: Method<STAGES>,
    {
        let Outcome { mut kinds, accepted, stuck } = outcome;
        let mut exhausted = 0;
        for lane in 0..W {
            self.steps[lane] += 1;
            exhausted |= u64::from(self.steps[lane] >= control.max_steps) << lane;
            // Crossings that nobody wants to know need no look.
            let bit = 1 << lane;
            if (kinds.crosses | kinds.grazes) & bit != 0 {
                if self.wanted[lane] == 0 {
                    kinds.crosses &= !bit;
                    kinds.grazes &= !bit;
                } else if kinds.crosses & bit != 0 {
                    self.wanted[lane] -= 1;
                }
            }
        }
        for lane in Ones(kinds.crosses | kinds.grazes | kinds.leaves | kinds.turns) {
            let is = |bits: u64| bits >> lane & 1 != 0;
            let why = [
                (is(kinds.crosses), Kind::Crosses),
                (is(kinds.grazes), Kind::Grazes),
                (is(kinds.leaves), Kind::Leaves),
                (is(kinds.turns & !kinds.leaves), Kind::Turns),
            ];
            for (_, kind) in why.into_iter().filter(|(so, _)| *so) {
                let (ray, steps) = (self.numbers[lane], self.steps[lane]);
                let event = Event { ray, steps, kind, falls: is(kinds.falls) };
                if self.events.push::<R>(&self.record, lane, event) {
                    self.events.flush::<L, S, M, R>(simd, task);
                }
            }
        }
        let ended = accepted & (kinds.leaves | kinds.falls);
        let given_up = (stuck | exhausted & self.busy) & !ended;
        for lane in Ones((ended | given_up) & !kinds.leaves) {
            let stop = if ended >> lane & 1 != 0 { Stop::Fell } else { Stop::GaveUp };
            let y = self.rays.y.each_ref().map(|column| column[lane]);
            let end = End { stop, y, swept: f64::NAN, steps: self.steps[lane] };
            task.conclude(self.numbers[lane], &end);
        }
        for lane in Ones(ended | given_up) {
            // An empty lane stays where it is.
            self.rays.h[lane] = 0.0;
            self.busy &= !(1 << lane);
        }
    }
}

/// The numbers of the bits that are set.
struct Ones(u64);

impl Iterator for Ones {
    type Item = usize;

    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        let lane = self.0.trailing_zeros() as usize;
        let some = self.0 != 0;
        self.0 &= self.0.wrapping_sub(1);
        some.then_some(lane)
    }
}

/// A place's height above a plane.
#[inline(always)]
fn height<S: Scalar>(place: &Vec3<S>, plane: &Vec3<f64>) -> S {
    let normal = [place[0].constant(plane[0]), place[0].constant(plane[1]), place[0].constant(plane[2])];
    dot(place, &normal)
}
