//! The tracer by closed forms.

use std::f64::consts::PI;

use super::batch::{Batch, Shared, suits};
use super::course::{Class, Kind};
use super::distant::Distant;
use super::horizons::Horizons;
use super::kernel::{self, Meeting, Radial, Start};
use super::photon::Photon;
use super::planar;
use super::polar::{FEW, FEW_REACH, LARGE, LARGE_REACH, MANY, SOME, SOME_REACH, frequency, size_of_nome};
use super::quadrature::Nodes;
use super::radial::Sweep;
use super::series::Cosines;
use super::vortical::Vortex;
use crate::geodesic::{Crossing, Fate, Integrator, Path, Query, Ray, Scheme, Tracer};
use crate::kerr::horizons;
use crate::lanes::Level;
use crate::metric::{Inverted, Kerr, Metric};

/// Nodes of quadratures that err by less than rounding does.
pub const NODES: usize = 24;

/// Nodes for the motions that are not factored.
pub(super) const PLAIN_NODES: usize = 32;

/// η below which light moves in the plane, or along a radius.
pub(super) const PLANAR: f64 = 1e-28;

/// Error of a ray far from the critical curve, rounding included; found by comparison with 48 nodes.
pub(super) const TYPICAL_ERROR: f64 = 1e-12;

/// Traces rays around a Kerr hole in closed form.
///
/// Rays of cameras inside the horizon or of no positive energy at infinity (within the ergosphere), rays whose
/// points are asked for, and planes other than the equator are left to an integrator.
///
/// ```
/// use kerrscope_spacetime::closed::{ClosedForm, NODES};
/// use kerrscope_spacetime::geodesic::{Path, Query, Tracer};
/// use kerrscope_spacetime::observer::impact_ray;
///
/// // A reversed photon of λ = 4 and η = 30 around a = 0.9, seen from i = 1 rad.
/// let (spin, inclination) = (0.9_f64, 1f64);
/// let alpha = 4.0 / inclination.sin();
/// let beta = -(30.0 - (alpha * alpha - spin * spin) * inclination.cos().powi(2)).sqrt();
/// let ray = impact_ray(Some(spin), inclination, f64::INFINITY, [alpha, beta])?;
/// let mut path = Path::default();
/// ClosedForm::new(spin, NODES, 10_000).trace(&ray, &Query::default(), &mut path);
/// assert!((path.crossings[0].r - 9.966537978).abs() < 1e-9);
/// # Ok::<(), kerrscope_spacetime::observer::ObserverError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ClosedForm {
    level: Level,
    shared: Shared,
    many: Box<Cosines<MANY>>,
    fallback: Integrator<Kerr>,
}

impl ClosedForm {
    /// A tracer around a hole of spin a in [−1, 1], with so many nodes in each quadrature: with [`NODES`] nothing but rounding
    /// is left, with 12 errors of the direction are below 5·10⁻⁸. What is left to an integrator has at most
    /// `max_steps` steps.
    pub fn new(spin: f64, nodes: usize, max_steps: usize) -> Self {
        let shared = Shared {
            metric: Kerr::new(-spin),
            rim: 1.0 / horizons(spin).0,
            nodes: Nodes::new(nodes),
            plain: Nodes::new(nodes.max(PLAIN_NODES)),
            few: Cosines::new(),
            some: Cosines::new(),
            large: Box::new(Cosines::new()),
            distant: Cosines::new(),
            remote: Cosines::new(),
        };
        let fallback = Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-12 }, max_steps);
        Self { level: Level::best(), shared, many: Box::new(Cosines::new()), fallback }
    }

    /// The same with these vector instructions instead of the best that the processor has.
    pub fn with_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// Whether what is asked can be found in closed form.
    fn answers(query: &Query) -> bool {
        let [x, y, z] = query.plane;
        x == 0.0 && y == 0.0 && z != 0.0 && query.points == 0
    }

    /// Follows a photon whose radial motion is known.
    fn follow<R: Radial<f64>, const TIMED: bool>(
        &self,
        start: &Start<f64>,
        radial: &R,
        escapes: bool,
        count: usize,
        path: &mut Path,
    ) {
        let photon = &start.photon;
        path.fate = if escapes { Fate::Escaped } else { Fate::Captured };
        let meet = |meeting: &Meeting<f64>| {
            path.crossings.push(Crossing {
                position: [meeting.position[0], meeting.position[1], 0.0],
                r: meeting.r,
                phi: meeting.phi,
                elapsed: meeting.elapsed,
                normal: meeting.normal,
                outward: meeting.inwards > 0.0,
            });
        };
        let shared = &self.shared;
        let direction = if photon.eta <= PLANAR {
            if !escapes {
                return;
            }
            let tau = radial.total();
            let [theta, turned] = if photon.eta < -PLANAR {
                Vortex::new(photon, start.heading).at(tau, &shared.plain)
            } else {
                planar::after(photon, start.heading, tau)
            };
            [theta, start.azimuth + radial.azimuth_to_infinity() + turned]
        } else {
            match size_of_nome(photon) {
                ..=FEW_REACH => {
                    kernel::follow::<_, R, FEW, TIMED>(start, radial, &shared.few, escapes, count, meet)
                }
                ..=SOME_REACH => {
                    kernel::follow::<_, R, SOME, TIMED>(start, radial, &shared.some, escapes, count, meet)
                }
                ..=LARGE_REACH => {
                    kernel::follow::<_, R, LARGE, TIMED>(start, radial, &shared.large, escapes, count, meet)
                }
                _ => kernel::follow::<_, R, MANY, TIMED>(start, radial, &self.many, escapes, count, meet),
            }
        };
        path.direction = escapes.then_some(direction);
    }
}

impl Tracer for ClosedForm {
    fn name(&self) -> &'static str {
        "closed-form"
    }

    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        if !Self::answers(query) || !suits(ray) {
            self.fallback.trace(ray, query, path);
            return;
        }
        path.clear();
        let metric = self.shared.metric;
        let photon = Photon::new(metric.spin(), ray.energy, &ray.start);
        // What is not a number goes nowhere.
        if !(photon.eta + photon.u_rate + photon.mu_rate + photon.lambda).is_finite() {
            return;
        }
        let class = Class::of(&photon, self.shared.rim);
        let offset = if photon.u > 0.0 { metric.azimuth_offset(1.0 / photon.u) } else { 0.0 };
        let start = Start {
            photon,
            course: class.course,
            azimuth: ray.azimuth - offset,
            heading: heading(&photon, ray),
            horizons: Horizons::new(metric.spin()),
        };
        let (escapes, count) = (class.escapes > 0.0, query.max_crossings);
        let Shared { nodes, plain, distant, remote, .. } = &self.shared;
        macro_rules! follow {
            ($timed:literal, $radial:expr) => {
                self.follow::<_, $timed>(&start, &$radial, escapes, count, path)
            };
        }
        match (class.kind(query.elapsed), query.elapsed) {
            (Kind::Plain, false) => follow!(false, Sweep::<_, true, false>::new::<false>(&start, plain)),
            (Kind::Plain, true) => follow!(true, Sweep::<_, true, true>::new::<false>(&start, plain)),
            (Kind::Factored, false) => follow!(false, Sweep::<_, false, false>::new::<false>(&start, nodes)),
            (Kind::Factored, true) => follow!(true, Sweep::<_, false, true>::new::<false>(&start, nodes)),
            (Kind::Spread, false) => follow!(false, Sweep::<_, false, false>::new::<true>(&start, nodes)),
            (Kind::Spread, true) => follow!(true, Sweep::<_, false, true>::new::<true>(&start, nodes)),
            (Kind::Distant, _) => follow!(false, Distant::new(&start, distant)),
            (Kind::Remote, _) => follow!(false, Distant::new(&start, remote)),
        }
        if query.windings {
            path.windings = windings(metric, ray.energy, &ray.start);
        }
        path.error_estimate = TYPICAL_ERROR * class.sensitivity;
    }

    fn trace_all(&self, rays: &[Ray], query: &Query, paths: &mut [Path]) {
        assert_eq!(rays.len(), paths.len(), "a path for each ray");
        if !Self::answers(query) || query.windings {
            for (ray, path) in rays.iter().zip(paths) {
                self.trace(ray, query, path);
            }
            return;
        }
        let mut rest = Vec::new();
        self.level.run(Batch { shared: &self.shared, rays, query, paths, rest: &mut rest });
        for ray in rest {
            self.trace(&rays[ray], query, &mut paths[ray]);
        }
    }
}

/// How often light goes round a hole from a place and momentum on to its end, in the spacetime in which it
/// is followed: the periods of its motion in θ, ωτ/2π. Without spin it is the angle swept over 2π. NaN
/// where the motion in θ does not cross the plane (η < 0, and light within the plane with |λ| < |s|), and where the
/// energy is not positive.
pub(crate) fn windings(metric: Kerr, energy: f64, start: &Inverted<f64>) -> f64 {
    if !(energy > 0.0) {
        return f64::NAN;
    }
    let photon = Photon::new(metric.spin(), energy, start);
    let class = Class::of(&photon, 1.0 / metric.horizon());
    let (course, horizons) = (class.course, Horizons::new(metric.spin()));
    let start = Start { photon, course, azimuth: 0.0, heading: [photon.lambda, photon.mu_rate], horizons };
    let nodes = Nodes::new(PLAIN_NODES);
    let tau = match class.kind(true) {
        Kind::Plain => Sweep::<_, true, false>::new::<false>(&start, &nodes).total(),
        Kind::Factored => Sweep::<_, false, false>::new::<false>(&start, &nodes).total(),
        Kind::Spread | Kind::Distant | Kind::Remote => {
            Sweep::<_, false, false>::new::<true>(&start, &nodes).total()
        }
    };
    // Light that moves along a radius has no motion in θ.
    let radial = photon.lambda == 0.0 && photon.eta == 0.0;
    if radial { 0.0 } else { frequency(&photon) * tau / (2.0 * PI) }
}

/// Which way light leaves the camera: on the axis [`Ray::azimuth`] is that in which it leaves, as if it had
/// just come over the pole.
fn heading(photon: &Photon<f64>, ray: &Ray) -> [f64; 2] {
    let [x, y, z] = ray.start.n;
    if x == 0.0 && y == 0.0 { [0.0, -z] } else { [photon.lambda, photon.mu_rate] }
}
