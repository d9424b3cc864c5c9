//! Rays around a hole, many at a time.

use kerrscope::render::hole_tracer;
use kerrscope::spacetime::emitter::{Circular, Sense};
use kerrscope::spacetime::geodesic::{Path, Query, Ray, Side, Tracer};
use kerrscope::spacetime::observer::{ImpactScreen, ObserverError};
use numpy::{PyReadonlyArrayDyn, PyReadwriteArrayDyn};
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::atomic::Ordering;

use crate::arrays::slice;
use crate::faults::wrong;
use crate::numbers::{known_inclination, known_spin};
use crate::work::{self, Signals, Told};

/// Rays followed together: as many as the closed form sorts at a time.
const BATCH: usize = 1000;

/// Numbers of a ray, and of each of its crossings, by their names.
const NAMES: [&str; 11] =
    ["fate", "steps", "error_estimate", "lambda", "eta", "theta", "sky_phi", "r", "phi", "t", "g"];

/// Where those of crossings begin among the names.
const CROSSINGS: usize = 7;

/// A place for each name; nothing where it is not wanted.
type Places<'a> = [&'a mut [f64]; NAMES.len()];

/// The part of the answers that a batch fills.
struct Part<'a> {
    first: usize,
    count: usize,
    places: Places<'a>,
}

/// What all rays share.
struct Course<'a> {
    screen: ImpactScreen,
    spin: f64,
    matter: Circular,
    tracer: &'a dyn Tracer,
    query: Query,
    orders: usize,
    impacts: [&'a [f64]; 2],
}

/// The first ray that there is not, and why.
type Refused = (usize, ObserverError);

impl Course<'_> {
    /// Follows a batch, and puts the answers in their places.
    fn follow(&self, part: &mut Part<'_>, (rays, paths): &mut (Vec<Ray>, Vec<Path>)) -> Result<(), Refused> {
        let Part { first, count, places } = part;
        let [alpha, beta] = self.impacts.map(|values| &values[*first..*first + *count]);
        rays.clear();
        for (k, (alpha, beta)) in alpha.iter().zip(beta).enumerate() {
            rays.push(self.screen.ray([*alpha, *beta]).map_err(|error| (*first + k, error))?);
        }
        paths.resize_with(*count, Path::default);
        self.tracer.trace_all(rays, &self.query, paths);
        self.ends(places, rays, paths);
        self.crossings(places, rays, paths);
        Ok(())
    }

    /// What is known of whole rays.
    fn ends(&self, places: &mut Places<'_>, rays: &[Ray], paths: &[Path]) {
        let [fate, steps, error, lambda, eta, theta, phi, ..] = places;
        for (k, (ray, path)) in rays.iter().zip(paths).enumerate() {
            if !theta.is_empty() || !phi.is_empty() {
                let direction = path.direction.unwrap_or([f64::NAN; 2]);
                put(theta, k, direction[0]);
                put(phi, k, direction[1]);
            }
            put(fate, k, f64::from(path.fate as u8));
            put(steps, k, path.steps as f64);
            put(error, k, path.error_estimate);
            if !lambda.is_empty() || !eta.is_empty() {
                let conserved = ray.conserved(self.spin);
                put(lambda, k, conserved.lambda);
                put(eta, k, conserved.eta);
            }
        }
    }

    /// What is known of crossings; g is that of matter on circular orbits.
    fn crossings(&self, places: &mut Places<'_>, rays: &[Ray], paths: &[Path]) {
        let [.., r, phi, t, g] = places;
        if [&r, &phi, &t, &g].iter().all(|place| place.is_empty()) {
            return;
        }
        for (k, (ray, path)) in rays.iter().zip(paths).enumerate() {
            let at = k * self.orders;
            for (n, crossing) in path.crossings.iter().take(self.orders).enumerate() {
                put(r, at + n, crossing.r);
                put(phi, at + n, crossing.phi);
                put(t, at + n, crossing.elapsed);
            }
            for place in [&mut *r, &mut *phi, &mut *t, &mut *g] {
                for n in path.crossings.len()..self.orders {
                    put(place, at + n, f64::NAN);
                }
            }
            if !g.is_empty() {
                let lambda = ray.conserved(self.spin).lambda;
                let energy = if ray.side == Side::Reversed { ray.energy } else { -ray.energy };
                for (n, crossing) in path.crossings.iter().take(self.orders).enumerate() {
                    let orbit = self.matter.orbit(crossing.r);
                    let factor = orbit.and_then(|orbit| orbit.redshift_factor(lambda, energy));
                    put(g, at + n, factor.unwrap_or(f64::NAN));
                }
            }
        }
    }
}

/// Puts a number where it is wanted.
#[inline]
fn put(place: &mut [f64], at: usize, number: f64) {
    if let Some(place) = place.get_mut(at) {
        *place = number;
    }
}

/// Cuts places into the parts of batches.
fn parts(places: Places<'_>, count: usize, orders: usize) -> Vec<Part<'_>> {
    let mut rest = places;
    let mut parts = Vec::with_capacity(count.div_ceil(BATCH));
    for first in (0..count).step_by(BATCH) {
        let many = BATCH.min(count - first);
        let mut places = NAMES.map(|_| &mut [][..]);
        for (k, (rest, place)) in rest.iter_mut().zip(&mut places).enumerate() {
            let width = if k < CROSSINGS { many } else { many * orders };
            let (own, after) = std::mem::take(rest).split_at_mut_checked(width).unwrap_or_default();
            (*place, *rest) = (own, after);
        }
        parts.push(Part { first, count: many, places });
    }
    parts
}

/// Follows rays of one hole and one observer, and puts what is asked for into arrays of one number a ray, or one for each order of each
/// ray. Python made these, whose memory is in large pages.
///
/// Fates are 0 escaped, 1 captured, 2 hit, 3 step-limit. NaN is what there is not.
#[pyfunction]
#[pyo3(signature = (spin, inclination, distance, alpha, beta, engine, orders, names, arrays, threads = None))]
#[expect(clippy::too_many_arguments, reason = "Python's own function names them")]
pub fn trace(
    py: Python<'_>,
    spin: f64,
    inclination: f64,
    distance: f64,
    alpha: PyReadonlyArrayDyn<'_, f64>,
    beta: PyReadonlyArrayDyn<'_, f64>,
    engine: &str,
    orders: usize,
    names: Vec<String>,
    mut arrays: Vec<PyReadwriteArrayDyn<'_, f64>>,
    threads: Option<usize>,
) -> PyResult<()> {
    let (spin, inclination) = (known_spin(spin)?, known_inclination(inclination)?);
    if !(distance > 0.0) {
        return Err(wrong(format!("distance is {distance}: give a positive number of M, or inf")));
    }
    let impacts = [slice("alpha", &alpha)?, slice("beta", &beta)?];
    let count = impacts[0].len();
    if impacts[1].len() != count {
        return Err(wrong(format!("{count} alpha are not {} beta", impacts[1].len())));
    }
    for (name, values) in ["alpha", "beta"].into_iter().zip(impacts) {
        if let Some(first) = values.iter().position(|value| !value.is_finite()) {
            return Err(wrong(format!("{name} of ray {first} is {}: give finite numbers", values[first])));
        }
    }
    let mut places: Places<'_> = NAMES.map(|_| &mut [][..]);
    for (name, array) in names.iter().zip(&mut arrays) {
        let at = NAMES.iter().position(|known| known == name);
        let at = at.ok_or_else(|| wrong(format!("no number is called {name:?}")))?;
        let place = array.as_slice_mut().map_err(|_| wrong(format!("{name} has to be contiguous")))?;
        if place.len() != if at < CROSSINGS { count } else { count * orders } {
            return Err(wrong(format!("{name} has {} places", place.len())));
        }
        places[at] = place;
    }
    let wanted = |name: &str| names.iter().any(|wanted| wanted == name);
    let tracer = work::shortly(|| hole_tracer(engine, spin))?.map_err(wrong)?;
    let crossings = NAMES[CROSSINGS..].iter().any(|name| wanted(name));
    let query =
        Query { max_crossings: if crossings { orders } else { 0 }, elapsed: wanted("t"), ..Query::default() };
    let course = Course {
        screen: ImpactScreen::new(Some(spin), inclination, distance).map_err(wrong)?,
        spin,
        matter: work::shortly(|| Circular::kerr(spin, Sense::Prograde))?,
        tracer: tracer.as_ref(),
        query,
        orders,
        impacts,
    };
    match follow(py, &course, parts(places, count, orders), threads)? {
        None => Ok(()),
        Some((ray, error)) => Err(wrong(format!("ray {ray}: {error}"))),
    }
}

/// Rays that are followed without threads, for it takes no time.
const FEW: usize = 4 * BATCH;

/// Follows all parts; gives the first ray that there is not.
fn follow(
    py: Python<'_>,
    course: &Course<'_>,
    mut parts: Vec<Part<'_>>,
    threads: Option<usize>,
) -> PyResult<Option<Refused>> {
    let count: usize = parts.iter().map(|part| part.count).sum();
    if count <= FEW && course.tracer.name() == "closed-form" {
        let mut memory = Default::default();
        let outcome =
            work::shortly(|| parts.iter_mut().try_for_each(|part| course.follow(part, &mut memory)))?;
        return Ok(outcome.err());
    }
    let outcome = work::run(py, threads, &Told::Nothing, |signals: &Signals| {
        parts.par_iter_mut().try_for_each_init(Default::default, |memory, part| {
            if signals.cancelled.load(Ordering::Relaxed) {
                return Err(None);
            }
            course.follow(part, memory).map_err(Some)
        })
    })?;
    Ok(outcome.err().flatten())
}
