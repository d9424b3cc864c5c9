//! Pictures as functions of parameters, with their derivatives.

use kerrscope_fit::Observed;
use kerrscope_fit::fit::Models;
use kerrscope_fit::model::{Freedom, Source};
use kerrscope_fit::models::{Choice, Name};
use kerrscope_fit::question::Question;
use kerrscope_fit::request::unknown_model;
use kerrscope_fit::traced::Projection;
use numpy::PyArrayDyn;
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::faults::wrong;
use crate::work::{self, Told};

/// The model of a name.
///
/// # Errors
/// If there is none.
pub fn known_model(name: &str) -> PyResult<Name> {
    Name::named(name).ok_or_else(|| wrong(unknown_model(name)))
}

/// The projection of a name.
///
/// # Errors
/// If there is none.
pub fn known_projection(name: &str) -> PyResult<Projection> {
    match name {
        "angular" => Ok(Projection::Angular),
        "pinhole" => Ok(Projection::Pinhole),
        _ => Err(wrong(format!("no projection is called {name:?}: give angular or pinhole"))),
    }
}

/// A forward model.
#[pyclass(frozen, module = "kerrscope._core")]
pub struct Model {
    model: Observed<Box<dyn Source>>,
}

/// A parameter: name, unit, meaning, bounds, the value that is usually assumed, if one is.
type Parameter = (&'static str, &'static str, &'static str, [f64; 2], Option<f64>);

/// An array.
type Numbers<'py> = Bound<'py, PyArrayDyn<f64>>;

/// The most pixels of a picture that is predicted.
const MOST: usize = 1 << 24;

#[pymethods]
impl Model {
    /// Of a name, for pictures of a width and a height.
    #[new]
    #[pyo3(signature = (name, width, height, projection = "angular", orders = None, spacetime = None))]
    fn new(
        name: &str,
        width: usize,
        height: usize,
        projection: &str,
        orders: Option<usize>,
        spacetime: Option<&str>,
    ) -> PyResult<Self> {
        let choice = Choice { name: known_model(name)?, projection: known_projection(projection)?, orders };
        if width == 0 || height == 0 || width.saturating_mul(height) > MOST {
            return Err(wrong(format!("a picture of {width} × {height} pixels: give 1 to {MOST} in all")));
        }
        let source = work::shortly(|| match spacetime {
            Some(word) => Question::new(word, choice.name, choice.projection, &[])
                .map(|question| question.tested.source(2))
                .map_err(|faults| wrong(faults.join("\n"))),
            None => Ok(choice.source(2)),
        })??;
        Ok(Self { model: Observed::new(source, [width, height]) })
    }

    /// Its parameters, in their order.
    fn parameters(&self) -> Vec<Parameter> {
        let told = |p: &kerrscope_fit::model::Parameter| {
            let usual = match p.usual {
                Freedom::Fixed(value) => Some(value),
                Freedom::Free(_) => None,
            };
            (p.name, p.unit, p.meaning, p.bounds, usual)
        };
        self.model.parameters().iter().map(told).collect()
    }

    /// The picture of values of all parameters, height × width, and its derivatives by each, parameters × height × width.
    fn predict<'py>(
        &self,
        py: Python<'py>,
        values: Vec<f64>,
        derivatives: bool,
        threads: Option<usize>,
    ) -> PyResult<(Numbers<'py>, Option<Numbers<'py>>)> {
        let parameters = self.model.parameters();
        if values.len() != parameters.len() {
            return Err(wrong(format!("{} values are not {}", values.len(), parameters.len())));
        }
        let outside: Vec<String> = parameters
            .iter()
            .zip(&values)
            .filter(|(p, value)| !(**value >= p.bounds[0] && **value <= p.bounds[1]))
            .map(|(p, value)| {
                format!("{} is {value}, and has to be from {} to {}", p.name, p.bounds[0], p.bounds[1])
            })
            .collect();
        if !outside.is_empty() {
            return Err(wrong(outside.join("\n")));
        }
        let found = work::run(py, threads, &Told::Nothing, |_| self.model.predict(&values, derivatives))?;
        let found = found.map_err(wrong)?;
        let [width, height] = self.model.size();
        let slopes = derivatives
            .then(|| shaped(py, found.derivatives.concat(), &[parameters.len(), height, width]))
            .transpose()?;
        Ok((shaped(py, found.values, &[height, width])?, slopes))
    }
}
