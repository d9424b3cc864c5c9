//! What an integrated ray meets, as crossings and points.

use super::chart::Chart;
use super::method::Method;
use super::segment::{Curve, Segment};
use super::walk::{Bounds, Control, End, Visitor, walk};
use super::{Crossing, Dense, Obstacles, Path, Query, Ray};
use crate::metric::{Inverted, Metric};
use crate::tensor::dot;

/// Where elapsed time and azimuth are counted from.
#[derive(Clone, Copy, Debug)]
pub struct Origin {
    /// Azimuth of n at the start of the walk.
    pub azimuth: f64,
    /// x·p at the camera, 0 for one at infinity (its infinite distance is what is taken off).
    pub radial: f64,
    /// The chart's time less the Boyer–Lindquist time at the camera, less 2 ln(r/2) for r → ∞.
    pub offset: f64,
    /// What the light's p_i/E is times the ray's: −1 where the photon is followed reversed in time, +1 where it is the
    /// photon with p_i and E of the other sign.
    pub way: f64,
}

impl Origin {
    /// Without time there is none to count.
    pub fn of<M: Metric>(metric: &M, ray: &Ray, query: &Query) -> Self {
        let Inverted { w, n, q, .. } = ray.start;
        let massive = metric.horizon() > 0.0;
        if !query.elapsed && query.points == 0 {
            Self { azimuth: ray.azimuth, radial: f64::NAN, offset: f64::NAN, way: -1.0 }
        } else if w > 0.0 {
            let r = 1.0 / metric.inverse_radius(w, &n);
            Self { azimuth: ray.azimuth, radial: q / w, offset: metric.time_offset(r), way: -1.0 }
        } else {
            let offset = if massive { 2.0 * 2f64.ln() } else { 0.0 };
            Self { azimuth: ray.azimuth, radial: 0.0, offset, way: -1.0 }
        }
    }

    /// For a camera inside the horizon, where Boyer–Lindquist time means nothing.
    pub fn within(ray: &Ray) -> Self {
        Self { azimuth: ray.azimuth, radial: ray.start.q / ray.start.w, offset: f64::NAN, way: 1.0 }
    }
}

/// One step of a walk, kept to be sampled.
struct Kept<const D: usize> {
    dense: Dense<f64, D>,
    /// Parameter at its start.
    sigma: f64,
    h: f64,
    /// The share of it that counts.
    until: f64,
}

/// Turns what a walk meets into crossings and points.
pub struct Log<'a, C, M, const D: usize> {
    chart: &'a C,
    metric: M,
    query: &'a Query,
    origin: Origin,
    path: &'a mut Path,
    segments: Vec<Kept<D>>,
    obstacles: Option<&'a dyn Obstacles>,
}

impl<'a, C: Chart<f64, D>, M: Metric, const D: usize> Log<'a, C, M, D> {
    pub fn new(chart: &'a C, metric: M, query: &'a Query, origin: Origin, path: &'a mut Path) -> Self {
        Self { chart, metric, query, origin, path, segments: Vec::new(), obstacles: None }
    }

    /// The same with things in the way.
    pub fn among(self, obstacles: Option<&'a dyn Obstacles>) -> Self {
        Self { obstacles, ..self }
    }

    /// Walks, and samples the points if any are wanted.
    pub fn walk<R: Method<STAGES>, const STAGES: usize>(
        &mut self,
        y: [f64; D],
        bounds: &Bounds,
        control: &Control,
    ) -> End<D> {
        if self.query.points == 0 && self.obstacles.is_none() {
            return walk::<_, R, _, D, STAGES>(self.chart, y, bounds, control, self);
        }
        let end = walk::<_, R, _, D, STAGES>(self.chart, y, bounds, control, &mut Scout(self));
        if self.query.points > 0 {
            self.sample();
        }
        end
    }

    /// Time since the origin in this chart, along the backward ray.
    fn chart_time(&self, y: &[f64; D], state: &Inverted<f64>, energy: f64) -> f64 {
        (state.q / state.w + self.chart.virial(y) - self.origin.radial) / energy
    }

    /// Points evenly spaced in the walk's parameter, over the part of the ray that is near.
    fn sample(&mut self) {
        let w = |s: &Kept<D>, share: f64| self.chart.state(&s.dense.at(share)).w;
        let samples = || {
            let share = |k: i32| f64::from(k) / 32.0;
            self.segments.iter().flat_map(move |s| (0..=32).map(move |k| (s, share(k) * s.until)))
        };
        let start = self.segments.first().map_or(0.0, |s| w(s, 0.0));
        let nearest = samples().map(|(s, t)| w(s, t)).fold(0.0, f64::max);
        let far = if start > 0.0 { start / 1.5 } else { f64::INFINITY }.min(1.0 / 30.0).min(nearest / 1.5);
        let parameters = samples().filter(|(s, t)| w(s, *t) >= far).map(|(s, t)| s.sigma + t * s.h);
        let (first, last) =
            parameters.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let count = self.query.points;
        let mut points = Vec::with_capacity(count);
        let mut segments = self.segments.iter().peekable();
        for i in 0..count {
            let sigma = first + (last - first) * i as f64 / (count.max(2) - 1) as f64;
            while segments.peek().is_some_and(|s| s.sigma + s.h * s.until < sigma) && segments.len() > 1 {
                segments.next();
            }
            let Some(s) = segments.peek() else { break };
            let y = s.dense.at(((sigma - s.sigma) / s.h).clamp(0.0, s.until));
            let state = self.chart.state(&y);
            let [px, py, pz] = state.n.map(|c| c / state.w);
            points.push([-self.chart_time(&y, &state, self.chart.energy()), px, py, pz]);
        }
        self.path.points.extend(points);
    }
}

impl<C: Chart<f64, D>, M: Metric, const D: usize> Visitor<D> for Log<'_, C, M, D> {
    const WANTS_SEGMENTS: bool = false;

    fn crossing(&mut self, y: &[f64; D], swept: f64, approach: f64) {
        if self.path.crossings.len() >= self.query.max_crossings {
            return;
        }
        let state = self.chart.state(y);
        let r = 1.0 / self.metric.inverse_radius(state.w, &state.n);
        let elapsed = if self.query.elapsed {
            self.chart_time(y, &state, self.chart.energy()) - self.metric.time_offset(r) + self.origin.offset
        } else {
            f64::NAN
        };
        self.path.crossings.push(Crossing {
            position: state.n.map(|c| c / state.w),
            r,
            phi: self.origin.azimuth + swept - self.metric.azimuth_offset(r),
            elapsed,
            normal: self.origin.way * dot(&state.momentum(), &self.query.plane) / self.chart.energy(),
            // The ray comes nearer where the light goes away.
            outward: approach > 0.0,
        });
    }

    fn segment(&mut self, _: &Dense<f64, D>, _: f64, _: f64, _: f64) -> Option<(f64, usize)> {
        None
    }
}

/// A log that looks at every step too: for what is in the way, and to keep it if points are wanted.
struct Scout<'a, 'b, C, M, const D: usize>(&'a mut Log<'b, C, M, D>);

impl<C: Chart<f64, D>, M: Metric, const D: usize> Visitor<D> for Scout<'_, '_, C, M, D> {
    const WANTS_SEGMENTS: bool = true;

    fn crossing(&mut self, y: &[f64; D], swept: f64, approach: f64) {
        self.0.crossing(y, swept, approach);
    }

    fn segment(&mut self, dense: &Dense<f64, D>, sigma: f64, h: f64, until: f64) -> Option<(f64, usize)> {
        let met = self.0.obstacles.and_then(|obstacles| {
            let curve = Curve::of_step(dense, C::PLACE, C::DIVISOR, until);
            obstacles.first(&Segment::Curve(curve)).map(|(share, number)| (share * until, number))
        });
        if self.0.query.points > 0 {
            let until = met.map_or(until, |(theta, _)| theta);
            self.0.segments.push(Kept { dense: *dense, sigma, h, until });
        }
        met
    }
}
