//! Rays by numerical integration of Hamilton's equations, in any metric.

use super::chart::{BoundedAffine, Chart};
use super::convoy::Task;
use super::inverted::{InvertedFlow, PLAIN, TIMED, pack};
use super::log::{Log, Origin};
use super::method::{Dop853, Method, Rk4, Tsit5};
use super::throat::pass_throats;
use super::walk::{Bounds, Control, End, Stop, walk};
use super::winding::turn;
use super::{AffineFlow, Fate, Hit, ObstacleTracer, Obstacles, Path, Query, Ray, Side, Tracer};
use crate::lanes::Level;
use crate::metric::{Inverted, Metric};
use crate::tensor::dot;

/// A Runge–Kutta method and its accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scheme {
    /// Order 4 with constant steps of affine parameter, in M: the thesis's.
    Rk4 {
        /// The step.
        step: f64,
    },
    /// Order 5 with error control.
    Tsit5 {
        /// About the error of a ray's direction, in radians, away from the critical curve.
        tolerance: f64,
    },
    /// Order 8 with error control.
    Dop853 {
        /// About the error of a ray's direction, in radians, away from the critical curve.
        tolerance: f64,
    },
}

/// Steps with error control turn by at most this angle: far less than π, within which a plane
/// through the origin is crossed once, and short enough that few steps are refused.
pub(super) const MAX_TURN: f64 = 0.8;

/// A step's error is held to a share of the tolerance, because strong bending multiplies it
/// later on. With these the direction of a typical ray errs by a tenth of the tolerance.
pub(super) const DOP853_SHARE: f64 = 1.0 / 30.0;
/// As [`DOP853_SHARE`]: its estimate of a step's error is the more cautious.
pub(super) const TSIT5_SHARE: f64 = 1.0 / 6.0;

/// Estimates are this multiple of the drift of conserved quantities, plus a tenth of the
/// tolerance for what that cannot show: at most one ray in twenty errs by more.
pub(super) const CAUTION: f64 = 3.0;

/// A photon that rises through the horizon changes sheets at this multiple of its radius, and
/// falling cameras within it start on the ingoing sheet.
pub const EXIT: f64 = 1.1;

/// What stands in a ray's way, if anything.
type Way<'a> = Option<&'a dyn Obstacles>;

/// A tracer that integrates.
///
/// ```
/// use kerrscope_spacetime::geodesic::{Fate, Integrator, Path, Query, Scheme, Tracer};
/// use kerrscope_spacetime::metric::Kerr;
/// use kerrscope_spacetime::observer::impact_ray;
///
/// let spin = 0.9;
/// let ray = impact_ray(Some(spin), 60f64.to_radians(), f64::INFINITY, [-8.0, 2.0])?;
/// let tracer = Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-10 }, 10_000);
/// let mut path = Path::default();
/// tracer.trace(&ray, &Query::default(), &mut path);
/// assert_eq!(path.fate, Fate::Escaped);
/// # Ok::<(), kerrscope_spacetime::observer::ObserverError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Integrator<M> {
    /// The spacetime as it is, for cameras inside the horizon.
    ingoing: M,
    /// The spacetime reversed in time, for all others.
    pub(super) reversed: M,
    pub(super) scheme: Scheme,
    max_steps: usize,
    level: Level,
}

impl<M: Metric> Integrator<M> {
    /// A tracer in `metric`, giving up on a ray after `max_steps` steps.
    pub fn new(metric: M, scheme: Scheme, max_steps: usize) -> Self {
        Self { ingoing: metric, reversed: metric.reversed(), scheme, max_steps, level: Level::best() }
    }

    /// The same with these vector instructions, of which `trace_all` makes use, instead of the best that the
    /// processor has.
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    pub(super) fn control(&self) -> Control {
        let (tolerance, step) = match self.scheme {
            Scheme::Rk4 { step } => (f64::NAN, step),
            Scheme::Tsit5 { tolerance } => (TSIT5_SHARE * tolerance, f64::NAN),
            Scheme::Dop853 { tolerance } => (DOP853_SHARE * tolerance, f64::NAN),
        };
        Control { tolerance, step, max_steps: self.max_steps, max_turn: MAX_TURN }
    }

    /// From inside the horizon, or next to it, to outside it in ingoing coordinates, then on. Obstacles are outside of
    /// [`EXIT`].
    fn rise(&self, ray: &Ray, query: &Query, way: Way<'_>, path: &mut Path) {
        let metric = self.ingoing;
        let inverse_horizon = 1.0 / metric.horizon();
        let inside = metric.inverse_radius(ray.start.w, &ray.start.n) >= inverse_horizon;
        if inside && !metric.rises(ray.energy, ray.start.j[2]) {
            path.fate = Fate::Captured;
            path.error_estimate = f64::EPSILON;
            return;
        }
        let bounds = Bounds {
            plane: query.plane,
            inverse_horizon,
            exact_fall: false,
            inverse_exit: Some(1.0 / (EXIT * metric.horizon())),
        };
        let flow = InvertedFlow { metric, energy: ray.energy };
        let mut log = Log::new(&flow, metric, query, Origin::within(ray), path);
        let end =
            walk::<_, Dop853, _, PLAIN, 12>(&flow, pack(&ray.start), &bounds, &self.fine_control(), &mut log);
        path.steps += end.steps;
        let state = flow.state(&end.y);
        match end.stop {
            // Outside for good, or on the way back in, which the reversed spacetime is made for.
            Stop::Rose | Stop::Sank => {
                let r = 1.0 / metric.inverse_radius(state.w, &state.n);
                let (before, after) = (metric.azimuth_offset(r), self.reversed.azimuth_offset(r));
                let outside = Ray {
                    start: metric.change_sheet(ray.energy, &state),
                    energy: -ray.energy,
                    side: Side::Reversed,
                    azimuth: ray.azimuth + end.swept - before + after,
                };
                // Boyer–Lindquist time diverges at the horizon, so none has elapsed from there.
                self.follow(&outside, &Query { elapsed: false, points: 0, ..*query }, way, path);
            }
            _ => path.fate = Fate::StepLimit,
        }
    }

    /// A tenth of the tolerance, zero for a scheme without one.
    fn typical_error(&self) -> f64 {
        match self.scheme {
            Scheme::Rk4 { .. } => 0.0,
            Scheme::Tsit5 { tolerance } | Scheme::Dop853 { tolerance } => 0.1 * tolerance,
        }
    }

    /// Steps for a part of a ray that the scheme has no chart for.
    fn fine_control(&self) -> Control {
        let control = self.control();
        Control { tolerance: if control.tolerance.is_nan() { 1e-13 } else { control.tolerance }, ..control }
    }

    /// Outside the horizon, in the reversed spacetime.
    fn follow(&self, ray: &Ray, query: &Query, way: Way<'_>, path: &mut Path) {
        let timed = query.elapsed || query.points > 0;
        match (self.scheme, timed) {
            (Scheme::Rk4 { .. }, false) => self.follow_affine::<6, PLAIN>(ray, query, way, path),
            (Scheme::Rk4 { .. }, true) => self.follow_affine::<7, TIMED>(ray, query, way, path),
            (Scheme::Tsit5 { .. }, false) => self.follow_inverted::<Tsit5, PLAIN, 6>(ray, query, way, path),
            (Scheme::Tsit5 { .. }, true) => self.follow_inverted::<Tsit5, TIMED, 6>(ray, query, way, path),
            (Scheme::Dop853 { .. }, false) => {
                self.follow_inverted::<Dop853, PLAIN, 12>(ray, query, way, path);
            }
            (Scheme::Dop853 { .. }, true) => self.follow_inverted::<Dop853, TIMED, 12>(ray, query, way, path),
        }
    }

    fn bounds(&self, query: &Query) -> Bounds {
        Bounds {
            plane: query.plane,
            inverse_horizon: 1.0 / self.reversed.horizon(),
            exact_fall: self.reversed.has_throat(),
            inverse_exit: None,
        }
    }

    fn follow_inverted<R: Method<STAGES>, const D: usize, const STAGES: usize>(
        &self,
        ray: &Ray,
        query: &Query,
        way: Way<'_>,
        path: &mut Path,
    ) {
        let flow = InvertedFlow { metric: self.reversed, energy: ray.energy };
        let y = pack::<f64, D>(&ray.start);
        let origin = Origin::of(&self.reversed, ray, query);
        let mut log = Log::new(&flow, self.reversed, query, origin, path).among(way);
        let (bounds, control) = (self.bounds(query), self.control());
        let end = log.walk::<R, STAGES>(y, &bounds, &control);
        let end = if bounds.exact_fall && end.stop == Stop::Fell {
            pass_throats::<_, R, D, STAGES>(&flow, end, &bounds, &control, path)
        } else {
            end
        };
        self.conclude(ray, &flow, &end, ray.azimuth + end.swept, path);
    }

    /// `A` components in the affine chart, then `D` in the inverted one.
    fn follow_affine<const A: usize, const D: usize>(
        &self,
        ray: &Ray,
        query: &Query,
        way: Way<'_>,
        path: &mut Path,
    ) {
        if ray.start.w <= 0.0 {
            // A constant step cannot come in from infinity.
            path.fate = Fate::StepLimit;
            return;
        }
        let (metric, energy) = (self.reversed, ray.energy);
        let limit = 2.0 * ray.start.w.recip().max(50.0);
        let near = BoundedAffine { flow: AffineFlow { metric, energy }, limit };
        let origin = Origin::of(&metric, ray, query);
        let mut log = Log::new(&near, metric, query, origin, path).among(way);
        let y: [f64; A] = near.start(&ray.start);
        let end = log.walk::<Rk4, 4>(y, &self.bounds(query), &self.control());
        if end.stop != Stop::Left {
            self.conclude(ray, &near, &end, ray.azimuth + end.swept, path);
            return;
        }
        path.steps += end.steps;
        let far = InvertedFlow { metric, energy };
        let mut y = pack::<f64, D>(&near.state(&end.y));
        if D == TIMED {
            y[8] = near.virial(&end.y);
        }
        let azimuth = ray.azimuth + end.swept;
        let rest = Query { points: 0, ..*query };
        let mut log = Log::new(&far, metric, &rest, Origin { azimuth, ..origin }, path).among(way);
        let end = log.walk::<Dop853, 12>(y, &self.bounds(query), &self.fine_control());
        self.conclude(ray, &far, &end, azimuth + end.swept, path);
    }

    /// Fate, direction and error from the end of the last walk.
    pub(super) fn conclude<C: Chart<f64, D>, const D: usize>(
        &self,
        ray: &Ray,
        chart: &C,
        end: &End<D>,
        azimuth: f64,
        path: &mut Path,
    ) {
        path.steps += end.steps;
        let state = chart.state(&end.y);
        let drift = drift(&self.reversed, ray.energy, &ray.start, &state);
        path.error_estimate = match end.stop {
            Stop::Left => drift * self.reversed.sensitivity(ray.energy, &ray.start),
            _ => drift,
        } + self.typical_error();
        path.fate = match end.stop {
            Stop::Left => {
                let n = self.reversed.way_out(ray.energy, &state);
                let azimuth = azimuth + if self.reversed.edge() > 0.0 { turn(&state.n, &n) } else { 0.0 };
                path.direction = Some([n[0].hypot(n[1]).atan2(n[2]), azimuth]);
                Fate::Escaped
            }
            Stop::Fell | Stop::Rose | Stop::Sank => Fate::Captured,
            Stop::Met(object) => {
                let position = state.n.map(|c| c / state.w);
                let momentum = state.momentum();
                path.hit = Some(Hit { object, position, momentum, energy: chart.energy() });
                Fate::Hit
            }
            Stop::GaveUp => Fate::StepLimit,
        };
    }
}

impl<M: Metric> Tracer for Integrator<M> {
    fn name(&self) -> &'static str {
        "integrator"
    }

    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        self.trace_along(ray, query, None, path);
    }

    /// On lanes, but for rays of constant steps, those whose time or points are wanted, and those of cameras inside
    /// the horizon.
    fn trace_all(&self, rays: &[Ray], query: &Query, paths: &mut [Path]) {
        assert_eq!(rays.len(), paths.len(), "a path for each ray");
        let constant = matches!(self.scheme, Scheme::Rk4 { .. });
        let mut rest = paths;
        for some in rays.chunk_by(|a, b| a.side == b.side) {
            let (now, later) = rest.split_at_mut(some.len());
            rest = later;
            if constant
                || query.elapsed
                || query.points > 0
                || self.max_steps == 0
                || some[0].side == Side::Ingoing
            {
                for (ray, path) in some.iter().zip(now) {
                    self.trace(ray, query, path);
                }
            } else {
                self.trace_abreast(some, query, now);
            }
        }
    }
}

impl<M: Metric> ObstacleTracer for Integrator<M> {
    fn trace_among(&self, ray: &Ray, query: &Query, obstacles: &dyn Obstacles, path: &mut Path) {
        self.trace_along(ray, query, Some(obstacles), path);
    }
}

impl<M: Metric> Integrator<M> {
    fn trace_along(&self, ray: &Ray, query: &Query, way: Way<'_>, path: &mut Path) {
        path.clear();
        match ray.side {
            Side::Reversed => {
                self.follow(ray, query, way, path);
                if query.windings {
                    path.windings = self.reversed.windings(ray.energy, &ray.start);
                }
            }
            Side::Ingoing => self.rise(ray, query, way, path),
        }
    }

    /// Rays of [`Side::Reversed`], on lanes where they are wide enough to pay.
    fn trace_abreast(&self, rays: &[Ray], query: &Query, paths: &mut [Path]) {
        for path in &mut *paths {
            path.clear();
        }
        if self.reversed.has_throat() {
            // What goes on behind a throat is followed ray by ray.
            for (ray, path) in rays.iter().zip(paths) {
                self.trace(ray, query, path);
            }
            return;
        }
        let corrections = vec![0.0; rays.len()];
        let task = Task { integrator: self, rays, query, paths: &mut *paths, corrections };
        if self.level.run_wide(task).is_err() {
            for (ray, path) in rays.iter().zip(&mut *paths) {
                self.follow(ray, query, None, path);
            }
        }
        if query.windings {
            for (ray, path) in rays.iter().zip(paths) {
                path.windings = self.reversed.windings(ray.energy, &ray.start);
            }
        }
    }
}

/// Made here, an integrator's kernels are compiled once, and not again in each crate that uses one.
#[cfg(not(test))]
macro_rules! compiled {
    ($($metric:ty),+) => {$(
        impl Integrator<$metric> {
            /// As one of many kinds of tracers; of this metric its code is compiled already.
            #[inline(never)]
            pub fn boxed(self) -> Box<dyn ObstacleTracer> {
                Box::new(self)
            }
        }
    )+};
}

// Unit tests need none of them.
#[cfg(not(test))]
compiled!(crate::metric::Kerr, crate::metric::Components<crate::metric::Kerr>);

/// How far the conserved quantities, and the chart's own identities |n| = 1 and n·J = 0, have
/// drifted, relative to their natural sizes.
fn drift<M: Metric>(metric: &M, energy: f64, start: &Inverted<f64>, end: &Inverted<f64>) -> f64 {
    let size = energy * energy + dot(&start.j, &start.j);
    let norm =
        (metric.norm(energy, end) - metric.norm(energy, start)).abs() / (energy * energy + end.q * end.q);
    let momentum = if metric.is_axisymmetric() { (end.j[2] - start.j[2]).abs() / size.sqrt() } else { 0.0 };
    let carter = match (metric.carter(energy, start), metric.carter(energy, end)) {
        (Some(before), Some(after)) => (after - before).abs() / size,
        _ => 0.0,
    };
    let unit = (dot(&end.n, &end.n) - dot(&start.n, &start.n)).abs();
    let square = dot(&end.n, &end.j).abs() / size.sqrt();
    CAUTION * (norm + momentum + carter + unit + square) + f64::EPSILON
}
