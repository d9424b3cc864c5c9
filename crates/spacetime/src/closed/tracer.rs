//! The tracer by closed forms.

use std::f64::consts::{LN_2, PI};

use super::photon::Photon;
use super::polar::{Cosines, FEW, FEW_REACH, MANY, Oscillation, frequency, size_of_nome};
use super::quadrature::Nodes;
use super::radial::{Class, Horizons, Kind, Motion, Point};
use super::vortical::Vortex;
use crate::geodesic::{Crossing, Fate, Integrator, Path, Query, Ray, Scheme, Side, Tracer};
use crate::kerr::horizons;
use crate::metric::{Inverted, Kerr, Metric};
use crate::tensor::dot;

/// Nodes for the motions that are not factored.
const PLAIN_NODES: usize = 32;

/// Traces rays around a Kerr hole in closed form.
///
/// Rays of cameras inside the horizon or of no positive energy at infinity (within the ergosphere), rays whose
/// points are asked for, and planes other than the equator are left to an integrator.
///
/// ```
/// use kerrscope_spacetime::closed::ClosedForm;
/// use kerrscope_spacetime::geodesic::{Path, Query, Tracer};
/// use kerrscope_spacetime::observer::impact_ray;
///
/// // λ = 4, η = 30 around a = 0.9, seen from i = 1 rad.
/// let (spin, inclination) = (0.9_f64, 1f64);
/// let alpha = -4.0 / inclination.sin();
/// let beta = -(30.0 - (alpha * alpha - spin * spin) * inclination.cos().powi(2)).sqrt();
/// let ray = impact_ray(Some(spin), inclination, f64::INFINITY, [alpha, beta])?;
/// let mut path = Path::default();
/// ClosedForm::new(spin, 16, 10_000).trace(&ray, &Query::default(), &mut path);
/// assert!((path.crossings[0].r - 9.966537978).abs() < 1e-9);
/// # Ok::<(), kerrscope_spacetime::observer::ObserverError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ClosedForm {
    /// s = −a: rays are followed in the spacetime reversed in time.
    metric: Kerr,
    horizon: f64,
    nodes: Nodes,
    plain: Nodes,
    few: Cosines<FEW>,
    many: Box<Cosines<MANY>>,
    fallback: Integrator<Kerr>,
}

impl ClosedForm {
    /// A tracer around a hole of spin a, with so many nodes in each quadrature (12 to 48 make sense);
    /// what is left to an integrator has at most `max_steps` steps.
    pub fn new(spin: f64, nodes: usize, max_steps: usize) -> Self {
        Self {
            metric: Kerr::new(-spin),
            horizon: horizons(spin).0,
            nodes: Nodes::new(nodes),
            plain: Nodes::new(nodes.max(PLAIN_NODES)),
            few: Cosines::new(),
            many: Box::new(Cosines::new()),
            fallback: Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-12 }, max_steps),
        }
    }

    fn follow<const PLAIN: bool, const TIMED: bool, const SPREAD: bool>(
        &self,
        start: &Start<'_>,
        path: &mut Path,
    ) {
        let nodes = if PLAIN { &self.plain } else { &self.nodes };
        let motion = Motion::<f64, PLAIN, TIMED>::new::<SPREAD>(&start.photon, &start.class.course, nodes);
        let whole = motion.whole();
        let horizons = Horizons::new(start.photon.spin);
        let radial = Radial { motion: &motion, horizons, start };
        let photon = &start.photon;
        let polar = if photon.eta < 0.0 {
            let vortex = Vortex::new(photon);
            start.class.escapes.then(|| vortex.at(whole.tau, &self.plain))
        } else if photon.eta <= 1e-28 {
            // Within the plane, or motion without angular momentum.
            Some([photon.mu.acos(), photon.lambda * whole.tau / (1.0 - photon.mu * photon.mu).max(1e-300)])
        } else if size_of_nome(photon) <= FEW_REACH {
            radial.oscillate(&Oscillation::new(photon, &self.few), whole.tau, path)
        } else {
            radial.oscillate(&Oscillation::new(photon, &self.many), whole.tau, path)
        };
        if start.class.escapes {
            path.fate = Fate::Escaped;
            let azimuth = whole.azimuth + radial.variation(0.0, true, Horizons::twist);
            path.direction = polar.map(|[theta, turned]| [theta, start.azimuth + azimuth + turned]);
        } else {
            path.fate = Fate::Captured;
        }
        if start.query.windings {
            path.windings = windings(&self.metric, start.ray.energy, &start.ray.start);
        }
        path.error_estimate = 1e-12 * self.metric.sensitivity(start.ray.energy, &start.ray.start);
    }
}

/// How often light goes round a hole from a place and momentum on to its end, in the spacetime in which it is followed: the
/// periods of its motion in θ between the camera and its end, ωτ/2π. Without spin it is the angle swept
/// over 2π. NaN where the motion in θ does not cross the plane (η < 0), and for rays that
/// [`ClosedForm`] leaves to an integrator.
pub(crate) fn windings(metric: &Kerr, energy: f64, start: &Inverted<f64>) -> f64 {
    let Some(photon) = Photon::new(metric.spin(), energy, start) else { return f64::NAN };
    let class = Class::of(&photon, metric.horizon());
    let nodes = Nodes::new(PLAIN_NODES);
    let tau = match class.kind {
        Kind::Plain => Motion::<f64, true, false>::new::<false>(&photon, &class.course, &nodes).whole().tau,
        Kind::Factored => {
            Motion::<f64, false, false>::new::<false>(&photon, &class.course, &nodes).whole().tau
        }
        Kind::Spread => Motion::<f64, false, false>::new::<true>(&photon, &class.course, &nodes).whole().tau,
    };
    // Light that moves along a radius has no motion in θ.
    let radial = photon.lambda == 0.0 && photon.eta == 0.0;
    if radial { 0.0 } else { frequency(&photon) * tau / (2.0 * PI) }
}

/// A ray whose constants are known.
struct Start<'a> {
    ray: &'a Ray,
    query: &'a Query,
    metric: Kerr,
    photon: Photon<f64>,
    class: Class,
    /// Boyer–Lindquist azimuth.
    azimuth: f64,
}

/// Radial motion with what is known of its start.
struct Radial<'a, const PLAIN: bool, const TIMED: bool> {
    motion: &'a Motion<'a, f64, PLAIN, TIMED>,
    horizons: Horizons<f64>,
    start: &'a Start<'a>,
}

impl<const PLAIN: bool, const TIMED: bool> Radial<'_, PLAIN, TIMED> {
    /// Total variation, with the sign of the first leg, of a function of u from the start to u,
    /// beyond the turning point if `late` and there is one.
    fn variation(&self, u: f64, late: bool, f: impl Fn(&Horizons<f64>, f64) -> f64) -> f64 {
        let Class { course, .. } = self.start.class;
        let turned = !PLAIN && late && course.shape < 0.0 && course.lead < 0.0;
        let (first, last) = (f(&self.horizons, self.start.photon.u), f(&self.horizons, u));
        let change =
            if turned { first + last - 2.0 * f(&self.horizons, self.motion.turning()) } else { first - last };
        course.inwards * change
    }

    /// Crossings, and the direction at the end.
    fn oscillate<const N: usize>(
        &self,
        oscillation: &Oscillation<f64, N>,
        total: f64,
        path: &mut Path,
    ) -> Option<[f64; 2]> {
        let Start { query, photon, metric, azimuth, .. } = self.start;
        let mut n = oscillation.first();
        while path.crossings.len() < query.max_crossings {
            let [tau, turned, height] = oscillation.crossing(n);
            n += 1.0;
            if !(tau < total) {
                break;
            }
            if tau <= 0.0 {
                continue;
            }
            let Point { u, late, azimuth: swept, time } = self.motion.at(photon.u, tau);
            let r = 1.0 / u;
            let phi = azimuth + turned + swept + self.variation(u, late, Horizons::twist);
            let elapsed = if TIMED {
                let infinite = if photon.u == 0.0 { 2.0 * LN_2 } else { 0.0 };
                time + height + self.variation(u, late, Horizons::delay) + infinite
            } else {
                f64::NAN
            };
            let around = phi + metric.azimuth_offset(r);
            let s = metric.spin();
            let width = (r * r + s * s).sqrt();
            path.crossings.push(Crossing {
                position: [width * around.cos(), width * around.sin(), 0.0],
                r,
                phi,
                elapsed,
            });
        }
        self.start.class.escapes.then(|| oscillation.at(total))
    }
}

impl Tracer for ClosedForm {
    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        let equatorial = query.plane[2].abs() == dot(&query.plane, &query.plane).sqrt();
        let ours = equatorial && query.points == 0 && ray.side == Side::Reversed;
        let photon = Photon::new(self.metric.spin(), ray.energy, &ray.start).filter(|_| ours);
        let Some(photon) = photon else {
            self.fallback.trace(ray, query, path);
            return;
        };
        path.clear();
        let class = Class::of(&photon, self.horizon);
        let r = 1.0 / photon.u;
        let offset = if photon.u > 0.0 { self.metric.azimuth_offset(r) } else { 0.0 };
        let azimuth = ray.azimuth - offset;
        let start = Start { ray, query, metric: self.metric, photon, class, azimuth };
        match (class.kind, query.elapsed) {
            (Kind::Plain, false) => self.follow::<true, false, false>(&start, path),
            (Kind::Plain, true) => self.follow::<true, true, false>(&start, path),
            (Kind::Factored, false) => self.follow::<false, false, false>(&start, path),
            (Kind::Factored, true) => self.follow::<false, true, false>(&start, path),
            (Kind::Spread, false) => self.follow::<false, false, true>(&start, path),
            (Kind::Spread, true) => self.follow::<false, true, true>(&start, path),
        }
    }
}
