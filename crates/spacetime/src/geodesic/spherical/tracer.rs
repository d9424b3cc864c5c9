//! The tracer.

use super::super::integrator::{CAUTION, DOP853_SHARE, MAX_TURN, TSIT5_SHARE};
use super::super::method::{Dop853, Method, Rk4, Tsit5};
use super::super::walk::{Control, Stop};
use super::super::{Crossing, Fate, Path, Query, Ray, Scheme, Side, Tracer};
use super::flow::{SphericalFlow, WIDTH};
use super::start;
use super::walk::{End, Limits, Segment, walk};
use crate::geometry::BoyerLindquist;
use crate::metric::{Kerr, Metric};
use crate::tensor::{Vec3, dot};
use std::f64::consts::PI;

/// A tracer of light around a Kerr hole in Boyer–Lindquist coordinates, which without spin are Schwarzschild's.
///
/// Observers have to be outside the horizon and off the axis: other rays end as [`Fate::StepLimit`]. Rays that fall end
/// as [`Fate::Captured`] at (1 + 10⁻⁵) r₊.
///
/// ```
/// use kerrscope_spacetime::geodesic::{Path, Query, Scheme, SphericalIntegrator, Tracer};
/// use kerrscope_spacetime::observer::impact_ray;
///
/// let ray = impact_ray(Some(0.9), 1.0, 1000.0, [-8.0, 2.0])?;
/// let tracer = SphericalIntegrator::new(0.9, Scheme::Dop853 { tolerance: 1e-10 }, 10_000);
/// let mut path = Path::default();
/// tracer.trace(&ray, &Query::default(), &mut path);
/// assert_eq!(path.crossings.len(), 1);
/// # Ok::<(), kerrscope_spacetime::observer::ObserverError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct SphericalIntegrator {
    /// The hole in which reversed photons are followed.
    hole: Kerr,
    scheme: Scheme,
    max_steps: usize,
}

/// Where falling rays end, in horizon radii.
const BRINK: f64 = 1.0 + 1e-5;

impl SphericalIntegrator {
    /// A tracer around a hole of spin a in [−1, 1], giving up on a ray after `max_steps` steps.
    pub fn new(spin: f64, scheme: Scheme, max_steps: usize) -> Self {
        Self { hole: Kerr::new(spin).reversed(), scheme, max_steps }
    }

    fn control(&self) -> Control {
        let (tolerance, step) = match self.scheme {
            Scheme::Rk4 { step } => (f64::NAN, step),
            Scheme::Tsit5 { tolerance } => (TSIT5_SHARE * tolerance, f64::NAN),
            Scheme::Dop853 { tolerance } => (DOP853_SHARE * tolerance, f64::NAN),
        };
        Control { tolerance, step, max_steps: self.max_steps, max_turn: MAX_TURN }
    }

    fn follow(&self, ray: &Ray, query: &Query, path: &mut Path) {
        let mut first = start::state(self.hole, ray);
        let brink = self.hole.horizon() * BRINK;
        if first[0] * brink >= 1.0 {
            path.fate = Fate::Captured;
            path.error_estimate = f64::EPSILON;
            return;
        }
        let flow = SphericalFlow {
            geometry: BoyerLindquist::new(self.hole.spin()),
            energy: ray.energy,
            momentum: ray.start.j[2],
            inverted: true,
            timed: query.elapsed || query.points > 0,
        };
        first[5] = flow.start_time(&first);
        if first[1].sin() < 1e-12 {
            // On the axis itself φ and p_φ say nothing.
            return;
        }
        let limits = Limits { inner: brink, outer: f64::INFINITY };
        let control = self.control();
        let Scheme::Rk4 { .. } = self.scheme else {
            let end = match self.scheme {
                Scheme::Tsit5 { .. } => self.go::<Tsit5, 6>(&flow, first, &limits, &control, query, path),
                _ => self.go::<Dop853, 12>(&flow, first, &limits, &control, query, path),
            };
            self.conclude(ray, &flow, &first, &end, path);
            return;
        };
        if first[0] <= 0.0 {
            // A constant step cannot come in from infinity.
            return;
        }
        let near = SphericalFlow { inverted: false, ..flow };
        let mut y = first;
        y[0] = first[0].recip();
        let outer = 2.0 * y[0].max(50.0);
        let end = self.go::<Rk4, 4>(&near, y, &Limits { outer, ..limits }, &control, query, path);
        if end.stop != Stop::Left {
            self.conclude(ray, &near, &y, &end, path);
            return;
        }
        path.steps += end.steps;
        let mut y = end.y;
        y[0] = y[0].recip();
        let control = Control { tolerance: 1e-13, ..control };
        let rest = Query { points: 0, ..*query };
        let end = self.go::<Dop853, 12>(&flow, y, &limits, &control, &rest, path);
        self.conclude(ray, &flow, &first, &end, path);
    }

    /// One walk, and what it meets.
    fn go<M: Method<STAGES>, const STAGES: usize>(
        &self,
        flow: &SphericalFlow<BoyerLindquist>,
        first: [f64; WIDTH],
        limits: &Limits,
        control: &Control,
        query: &Query,
        path: &mut Path,
    ) -> End {
        let level = query.plane[0] == 0.0 && query.plane[1] == 0.0;
        let inverse = |y: &[f64; WIDTH]| flow.radius(y).recip();
        let height = |y: &[f64; WIDTH]| {
            if level {
                query.plane[2] * y[1].cos()
            } else {
                dot(&start::direction(self.hole, inverse(y), y[1], y[2]), &query.plane)
            }
        };
        let crossings = &mut path.crossings;
        let crossing = |y: &[f64; WIDTH]| {
            if crossings.len() >= query.max_crossings {
                return;
            }
            let u = inverse(y);
            let place = start::direction(self.hole, u, y[1], y[2]);
            crossings.push(Crossing {
                position: place.map(|c| c / u),
                r: u.recip(),
                phi: y[2] + if y[1].sin() < 0.0 { PI } else { 0.0 },
                elapsed: if query.elapsed { flow.elapsed(y) } else { f64::NAN },
                normal: -across(y, u, flow.momentum, &query.plane) / flow.energy,
                outward: y[3] < 0.0,
            });
        };
        let mut segments = Vec::new();
        let mut keep = |segment| segments.push(segment);
        let keep: Option<&mut dyn FnMut(Segment)> = if query.points > 0 { Some(&mut keep) } else { None };
        let end = walk::<_, M, STAGES>(flow, first, limits, control, &height, crossing, keep);
        if query.points > 0 {
            self.sample(flow, &segments, query.points, &mut path.points);
        }
        end
    }

    /// Points evenly spaced in the parameter, over the part of the ray that is near.
    fn sample(
        &self,
        flow: &SphericalFlow<BoyerLindquist>,
        segments: &[Segment],
        count: usize,
        points: &mut Vec<[f64; 4]>,
    ) {
        let inverse = |s: &Segment, t: f64| flow.radius(&s.dense.at(t)).recip();
        let samples =
            || segments.iter().flat_map(|s| (0..=32).map(move |k| (s, f64::from(k) / 32.0 * s.until)));
        let first = segments.first().map_or(0.0, |s| inverse(s, 0.0));
        let nearest = samples().map(|(s, t)| inverse(s, t)).fold(0.0, f64::max);
        let far = if first > 0.0 { first / 1.5 } else { f64::INFINITY }.min(1.0 / 30.0).min(nearest / 1.5);
        let near = samples().filter(|(s, t)| inverse(s, *t) >= far).map(|(s, t)| s.start + t * s.h);
        let (from, to) = near.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let mut rest = segments.iter().peekable();
        for i in 0..count {
            let parameter = from + (to - from) * i as f64 / (count.max(2) - 1) as f64;
            while rest.len() > 1 && rest.peek().is_some_and(|s| s.start + s.h * s.until < parameter) {
                rest.next();
            }
            let Some(s) = rest.peek() else { break };
            let y = s.dense.at(((parameter - s.start) / s.h).clamp(0.0, s.until));
            let u = flow.radius(&y).recip();
            let [px, py, pz] = start::direction(self.hole, u, y[1], y[2]).map(|c| c / u);
            points.push([-flow.elapsed(&y), px, py, pz]);
        }
    }

    /// Fate, direction and error from the end of the last walk.
    fn conclude(
        &self,
        ray: &Ray,
        flow: &SphericalFlow<BoyerLindquist>,
        first: &[f64; WIDTH],
        end: &End,
        path: &mut Path,
    ) {
        path.steps += end.steps;
        path.fate = match end.stop {
            Stop::Left => {
                // A ray without angular momentum goes on through the axis to θ < 0 or θ > π.
                let [theta, phi] = [end.y[1], end.y[2]];
                let (sin, cos) = theta.sin_cos();
                let phi = phi + if sin < 0.0 { PI } else { 0.0 };
                path.direction = Some([sin.abs().atan2(cos), phi]);
                Fate::Escaped
            }
            Stop::Fell => Fate::Captured,
            _ => Fate::StepLimit,
        };
        let typical = match self.scheme {
            Scheme::Rk4 { .. } => 0.0,
            Scheme::Tsit5 { tolerance } | Scheme::Dop853 { tolerance } => 0.1 * tolerance,
        };
        let sensitivity =
            if end.stop == Stop::Left { self.hole.sensitivity(ray.energy, &ray.start) } else { 1.0 };
        path.error_estimate = self.drift(flow, first, &end.y) * sensitivity + typical;
    }

    /// How far Carter's constant and the norm have drifted, relative to their natural sizes.
    fn drift(&self, flow: &SphericalFlow<BoyerLindquist>, first: &[f64; WIDTH], end: &[f64; WIDTH]) -> f64 {
        let (energy, l, s) = (flow.energy, flow.momentum, self.hole.spin());
        let carter = |y: &[f64; WIDTH]| {
            let (sin, cos) = y[1].sin_cos();
            let round = if l == 0.0 { 0.0 } else { (l / sin).powi(2) };
            y[4] * y[4] + cos * cos * (round - s * s * energy * energy)
        };
        let size = energy * energy + flow.turning(first).powi(2);
        let mut drift = (carter(end) - carter(first)).abs() / size;
        if flow.radius(end).is_finite() && flow.radius(end) < 1e4 {
            // At the horizon the terms of the norm are as large as p_r² Δ.
            drift += flow.norm(end).abs() / (energy * energy + end[3] * end[3]);
        } else {
            drift += (end[3].abs() / energy.abs() - 1.0).abs();
        }
        CAUTION * drift + f64::EPSILON
    }
}

impl Tracer for SphericalIntegrator {
    fn name(&self) -> &'static str {
        "integrator"
    }

    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        path.clear();
        if ray.side == Side::Ingoing {
            return;
        }
        self.follow(ray, query, path);
        if query.windings {
            path.windings = self.hole.windings(ray.energy, &ray.start);
        }
    }
}

/// The momentum of a state along a unit vector orthogonal to its place: −sin θ p_θ/r along +z.
fn across(y: &[f64; WIDTH], u: f64, momentum: f64, along: &Vec3<f64>) -> f64 {
    let ((sin, cos), (sin_phi, cos_phi)) = (y[1].sin_cos(), y[2].sin_cos());
    let south = dot(&[cos * cos_phi, cos * sin_phi, -sin], along);
    let east = dot(&[-sin_phi, cos_phi, 0.0], along);
    u * (y[4] * south + if momentum == 0.0 { 0.0 } else { momentum / sin * east })
}
