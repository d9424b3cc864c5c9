//! Holes read off pictures.

use std::path::PathBuf;
use std::sync::PoisonError;
use std::sync::atomic::Ordering;
use std::time::Instant;

use kerrscope_fit::fit::{FitError, Image};
use kerrscope_fit::models::Choice;
use kerrscope_fit::output::residual::Residual;
use kerrscope_fit::output::{Record, chain, corner};
use kerrscope_fit::question::Question;
use kerrscope_fit::request::Request;
use kerrscope_fit::task::{Found, Ready, Report, Task, TaskError, Watch};
use numpy::PyArrayDyn;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::arrays::shaped;
use crate::faults::{self, wrong};
use crate::model::{known_model, known_projection};
use crate::picture::Picture;
use crate::work::{self, Told};

/// What was found, and what it was found in.
#[pyclass(frozen, module = "kerrscope._core")]
pub struct Fit {
    found: Found,
    residual: Residual,
    report: String,
    seed: u64,
    words: Vec<(String, String)>,
    title: String,
}

#[pymethods]
impl Fit {
    /// As `kerrscope fit --format json`, as text.
    #[getter]
    fn report(&self) -> &str {
        &self.report
    }

    /// Names and units of the free parameters.
    #[getter]
    fn free(&self) -> Vec<(String, String)> {
        self.found.fit.free.clone()
    }

    /// Draws, chains × draws × free parameters.
    fn draws<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let draws = &self.found.fit.draws;
        let shape = [draws.len(), draws.first().map_or(0, Vec::len), self.found.fit.free.len()];
        shaped(py, draws.iter().flatten().flatten().copied().collect(), &shape)
    }

    /// Logarithms of the posterior's density of draws, chains × draws.
    fn logs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let logs = &self.found.fit.logs;
        shaped(py, logs.concat(), &[logs.len(), logs.first().map_or(0, Vec::len)])
    }

    /// Trajectories that went astray.
    #[getter]
    fn diverged(&self) -> usize {
        self.found.fit.diverged
    }

    /// The picture, the best fit, the errors, and the residuals in units of them: each height × width.
    fn images<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArrayDyn<f64>>>> {
        let Residual { size: [width, height], data, best, error, residual, .. } = &self.residual;
        let shape = [*height, *width];
        [data, best, error, residual].into_iter().map(|values| shaped(py, values.clone(), &shape)).collect()
    }

    /// The corner plot as SVG.
    fn corner(&self) -> PyResult<String> {
        work::shortly(|| corner::corner(&self.found.fit, &self.title))
    }

    /// Writes the chains as HDF5, laid out as ArviZ lays them out.
    fn write_chains(&self, path: PathBuf) -> PyResult<()> {
        let record = Record { seed: self.seed, model: &self.words };
        work::shortly(|| chain::write(&path, &self.found.fit, &record))?.map_err(|error| faults::file(&error))
    }
}

/// Fits a model to a picture. `settings` are names and words, as those of a request; later ones count.
#[pyfunction]
#[pyo3(signature = (picture, model, projection, orders, settings, spacetime, nulls, noise, seed, rounds, threads, progress))]
#[expect(clippy::too_many_arguments, reason = "Python's own function names them")]
pub fn fit(
    py: Python<'_>,
    picture: &Picture,
    model: &str,
    projection: &str,
    orders: Option<usize>,
    settings: Vec<(String, String)>,
    spacetime: Option<&str>,
    nulls: Vec<String>,
    noise: Option<f64>,
    seed: u64,
    rounds: u64,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Fit> {
    let start = Instant::now();
    let choice = Choice { name: known_model(model)?, projection: known_projection(projection)?, orders };
    let request = Request { parameters: settings };
    let mut task = Task { choice, request, question: None, noise, seed, rounds };
    let mut wrongs = task.faults(str::to_owned);
    if !(3..=1000).contains(&rounds) {
        wrongs.push(format!("rounds is {rounds}, and has to be from 3 to 1000"));
    }
    if orders.is_some_and(|orders| !(1..=4).contains(&orders)) {
        wrongs.push("orders has to be from 1 to 4".to_owned());
    }
    if !wrongs.is_empty() {
        return Err(wrong(wrongs.join("\n")));
    }
    if let Some(word) = spacetime {
        let question = work::shortly(|| Question::new(word, choice.name, choice.projection, &nulls))?;
        task.question = Some(question.map_err(|faults| wrong(faults.join("\n")))?);
    }
    let image = Image {
        size: [picture.inner.width, picture.inner.height],
        pixel: picture.inner.pixel.microarcseconds,
        values: picture.inner.values.clone(),
    };
    let ready =
        work::run(py, threads, &Told::Nothing, |_| task.with(image))?.map_err(|error| match error {
            TaskError::Asked(faults) => wrong(faults.join("\n")),
            TaskError::Picture(error) => wrong(error),
        })?;
    let told = progress.as_ref().map_or(Told::Nothing, Told::Words);
    let found = work::run(py, threads, &told, |signals| {
        let progress = |text: &str| {
            *signals.message.lock().unwrap_or_else(PoisonError::into_inner) = Some(text.to_owned());
        };
        let cancelled = || signals.cancelled.load(Ordering::Relaxed);
        ready.run(&Watch { progress: &progress, interim: None, cancelled: &cancelled, keeper: None })
    })?;
    let found = found.map_err(|error| match error {
        FitError::Keeper(fault) => PyRuntimeError::new_err(fault),
        fault => wrong(fault),
    })?;
    answer(&ready, found, spacetime, start.elapsed().as_secs_f64())
}

fn answer(ready: &Ready, found: Found, spacetime: Option<&str>, wall_s: f64) -> PyResult<Fit> {
    let report = Report::of(ready.task(), &found, spacetime, wall_s);
    let words = report.words();
    let title = format!("{} fitted", report.model);
    let report = serde_json::to_string(&report).map_err(wrong)?;
    let residual = work::shortly(|| Residual::of(ready.image(), &found.fit))?;
    Ok(Fit { residual, report, seed: ready.task().seed, words, title, found })
}
