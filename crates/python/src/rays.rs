//! Rays around a hole, many at a time.

use kerrscope::render::hole_tracer;
use kerrscope::spacetime::emitter::{Circular, Sense};
use kerrscope::spacetime::geodesic::{Path, Query, Ray, Side, Tracer};
use kerrscope::spacetime::observer::{ImpactScreen, ObserverError};
use numpy::PyReadonlyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;

use crate::arrays::{shaped, slice};
use crate::faults::wrong;
use crate::numbers::{known_inclination, known_spin};
use crate::work::{self, Signals, Told};

/// Rays followed together: as many as the closed form sorts at a time.
const BATCH: usize = 1000;

/// What is wanted, a number for each ray, or for each order of each ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    Fate,
    Steps,
    ErrorEstimate,
    Lambda,
    Eta,
    Theta,
    DirectionPhi,
    R,
    Phi,
    T,
    G,
}

impl Quantity {
    const ALL: [Self; 11] = [
        Self::Fate,
        Self::Steps,
        Self::ErrorEstimate,
        Self::Lambda,
        Self::Eta,
        Self::Theta,
        Self::DirectionPhi,
        Self::R,
        Self::Phi,
        Self::T,
        Self::G,
    ];

    /// Its name among what is wanted: a direction is two numbers.
    const fn wanted(self) -> &'static str {
        match self {
            Self::Fate => "fate",
            Self::Steps => "steps",
            Self::ErrorEstimate => "error_estimate",
            Self::Lambda => "lambda",
            Self::Eta => "eta",
            Self::Theta | Self::DirectionPhi => "direction",
            Self::R => "r",
            Self::Phi => "phi",
            Self::T => "t",
            Self::G => "g",
        }
    }

    /// Its name in what is given.
    const fn given(self) -> &'static str {
        match self {
            Self::Theta => "theta",
            Self::DirectionPhi => "phi",
            other => other.wanted(),
        }
    }

    const fn of_crossings(self) -> bool {
        matches!(self, Self::R | Self::Phi | Self::T | Self::G)
    }
}

/// The part of the answers that a batch fills: a slice for each quantity.
struct Part<'a> {
    first: usize,
    slices: Vec<&'a mut [f64]>,
}

/// What all rays share.
struct Course<'a> {
    screen: ImpactScreen,
    spin: f64,
    matter: Option<Circular>,
    tracer: &'a dyn Tracer,
    query: Query,
    wanted: &'a [Quantity],
    impacts: [&'a [f64]; 2],
}

/// The first ray that there is not, and why.
type Refused = (usize, ObserverError);

impl Course<'_> {
    /// Follows a batch, and puts the answers in their places.
    fn follow(
        &self,
        part: &mut Part<'_>,
        rays: &mut Vec<Ray>,
        paths: &mut Vec<Path>,
        count: usize,
    ) -> Result<(), Refused> {
        let [alpha, beta] = self.impacts.map(|values| &values[part.first..part.first + count]);
        rays.clear();
        for (k, (alpha, beta)) in alpha.iter().zip(beta).enumerate() {
            rays.push(self.screen.ray([*alpha, *beta]).map_err(|error| (part.first + k, error))?);
        }
        paths.resize_with(count, Path::default);
        self.tracer.trace_all(rays, &self.query, paths);
        let orders = self.query.max_crossings;
        for (quantity, slice) in self.wanted.iter().zip(&mut part.slices) {
            match quantity {
                Quantity::R => each_crossing(slice, paths, orders, |c| c.r),
                Quantity::Phi => each_crossing(slice, paths, orders, |c| c.phi),
                Quantity::T => each_crossing(slice, paths, orders, |c| c.elapsed),
                Quantity::G => self.redshifts(slice, rays, paths),
                Quantity::Theta => each(slice, paths, |p| p.direction.map_or(f64::NAN, |d| d[0])),
                Quantity::DirectionPhi => each(slice, paths, |p| p.direction.map_or(f64::NAN, |d| d[1])),
                Quantity::Fate => each(slice, paths, |p| f64::from(p.fate as u8)),
                Quantity::Steps => each(slice, paths, |p| p.steps as f64),
                Quantity::ErrorEstimate => each(slice, paths, |p| p.error_estimate),
                Quantity::Lambda => each(slice, rays, |ray| ray.conserved(self.spin).lambda),
                Quantity::Eta => each(slice, rays, |ray| ray.conserved(self.spin).eta),
            }
        }
        Ok(())
    }

    /// g of matter on circular orbits at each crossing.
    fn redshifts(&self, slice: &mut [f64], rays: &[Ray], paths: &[Path]) {
        let orders = self.query.max_crossings;
        for ((to, path), ray) in slice.chunks_exact_mut(orders).zip(paths).zip(rays) {
            let lambda = ray.conserved(self.spin).lambda;
            let energy = if ray.side == Side::Reversed { ray.energy } else { -ray.energy };
            to.fill(f64::NAN);
            for (to, crossing) in to.iter_mut().zip(&path.crossings) {
                let orbit = self.matter.as_ref().and_then(|matter| matter.orbit(crossing.r));
                *to = orbit.and_then(|orbit| orbit.redshift_factor(lambda, energy)).unwrap_or(f64::NAN);
            }
        }
    }
}

fn each<T>(slice: &mut [f64], of: &[T], value: impl Fn(&T) -> f64) {
    for (to, from) in slice.iter_mut().zip(of) {
        *to = value(from);
    }
}

fn each_crossing(
    slice: &mut [f64],
    paths: &[Path],
    orders: usize,
    value: impl Fn(&kerrscope::spacetime::geodesic::Crossing) -> f64,
) {
    for (to, path) in slice.chunks_exact_mut(orders).zip(paths) {
        for (n, to) in to.iter_mut().enumerate() {
            *to = path.crossings.get(n).map_or(f64::NAN, &value);
        }
    }
}

/// Cuts arrays into the parts of batches.
fn parts<'a>(arrays: &'a mut [Vec<f64>], wanted: &[Quantity], count: usize, orders: usize) -> Vec<Part<'a>> {
    let mut parts: Vec<Part<'a>> =
        (0..count).step_by(BATCH).map(|first| Part { first, slices: Vec::new() }).collect();
    for (array, quantity) in arrays.iter_mut().zip(wanted) {
        let width = if quantity.of_crossings() { orders } else { 1 };
        let mut rest = array.as_mut_slice();
        for part in &mut parts {
            let (slice, after) = rest.split_at_mut((BATCH * width).min(rest.len()));
            part.slices.push(slice);
            rest = after;
        }
    }
    parts
}

/// Follows rays of one hole and one observer.
///
/// Fates are 0 escaped, 1 captured, 2 hit, 3 step-limit. Crossings are rays × orders, NaN where there is none.
#[pyfunction]
#[pyo3(signature = (spin, inclination, distance, alpha, beta, engine, orders, quantities, threads = None))]
#[expect(clippy::too_many_arguments, reason = "Python's own function names them")]
pub fn trace<'py>(
    py: Python<'py>,
    spin: f64,
    inclination: f64,
    distance: f64,
    alpha: PyReadonlyArrayDyn<'py, f64>,
    beta: PyReadonlyArrayDyn<'py, f64>,
    engine: &str,
    orders: usize,
    quantities: Vec<String>,
    threads: Option<usize>,
) -> PyResult<Bound<'py, PyDict>> {
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
    if let Some(unknown) = quantities.iter().find(|name| Quantity::ALL.iter().all(|q| q.wanted() != **name)) {
        return Err(wrong(format!(
            "no quantity is called {unknown:?}: there are fate, steps, error_estimate, lambda, eta, direction, r, phi, t, g"
        )));
    }
    let wanted: Vec<Quantity> =
        Quantity::ALL.into_iter().filter(|q| quantities.iter().any(|name| name == q.wanted())).collect();
    if count.saturating_mul(orders) > MOST {
        return Err(wrong(format!(
            "{count} rays of {orders} orders are more than {MOST}: trace some at a time"
        )));
    }
    let tracer = work::shortly(|| hole_tracer(engine, spin))?.map_err(wrong)?;
    let crossings = wanted.iter().any(|quantity| quantity.of_crossings());
    let query = Query {
        max_crossings: if crossings { orders } else { 0 },
        elapsed: wanted.contains(&Quantity::T),
        ..Query::default()
    };
    let course = Course {
        screen: ImpactScreen::new(Some(spin), inclination, distance).map_err(wrong)?,
        spin,
        matter: wanted.contains(&Quantity::G).then(|| Circular::kerr(spin, Sense::Prograde)),
        tracer: tracer.as_ref(),
        query,
        wanted: &wanted,
        impacts,
    };
    // Zeros that nobody has touched cost nothing; every one is written over.
    let size = |quantity: &Quantity| if quantity.of_crossings() { count * orders } else { count };
    let mut arrays: Vec<Vec<f64>> = wanted.iter().map(|quantity| vec![0.0; size(quantity)]).collect();
    let refused = if orders == 0 && crossings || count == 0 {
        None
    } else {
        let parts = parts(&mut arrays, &wanted, count, orders);
        follow(py, &course, parts, count, threads)?
    };
    if let Some((ray, error)) = refused {
        return Err(wrong(format!("ray {ray}: {error}")));
    }
    let dict = PyDict::new(py);
    let of_crossings = PyDict::new(py);
    for (quantity, array) in wanted.iter().zip(arrays) {
        if quantity.of_crossings() {
            of_crossings.set_item(quantity.given(), shaped(py, array, &[count, orders])?)?;
        } else {
            dict.set_item(quantity.given(), shaped(py, array, &[count])?)?;
        }
    }
    dict.set_item("crossings", of_crossings)?;
    Ok(dict)
}

/// The most numbers of one quantity.
const MOST: usize = 1 << 31;

/// Rays that are followed without threads, for it takes no time.
const FEW: usize = 4 * BATCH;

/// Follows all parts; gives the first ray that there is not.
fn follow(
    py: Python<'_>,
    course: &Course<'_>,
    mut parts: Vec<Part<'_>>,
    count: usize,
    threads: Option<usize>,
) -> PyResult<Option<Refused>> {
    let one = |(rays, paths): &mut (Vec<Ray>, Vec<Path>), part: &mut Part<'_>| {
        let many = BATCH.min(count - part.first);
        course.follow(part, rays, paths, many)
    };
    if count <= FEW && course.tracer.name() == "closed-form" {
        let mut memory = Default::default();
        let outcome = work::shortly(|| parts.iter_mut().try_for_each(|part| one(&mut memory, part)))?;
        return Ok(outcome.err());
    }
    let outcome = work::run(py, threads, &Told::Nothing, |signals: &Signals| {
        parts.par_iter_mut().try_for_each_init(Default::default, |memory, part| {
            if signals.cancelled.load(std::sync::atomic::Ordering::Relaxed) {
                return Err(None);
            }
            one(memory, part).map_err(Some)
        })
    })?;
    Ok(outcome.err().flatten())
}
