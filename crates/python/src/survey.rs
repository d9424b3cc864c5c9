//! Surveys.

use std::path::PathBuf;
use std::sync::atomic::Ordering;

use kerrscope::survey::{
    self, Done, Folder, LibraryError, PlanError, Shard, TaskError, library, make, worker_name,
};
use pyo3::exceptions::{PyIndexError, PyKeyboardInterrupt};
use pyo3::prelude::*;

use crate::faults;
use crate::work::{self, Told};

/// The pictures of a survey.
#[pyclass(frozen, module = "kerrscope._core")]
pub struct Plan {
    plan: survey::Plan,
}

#[pymethods]
impl Plan {
    /// A plan from its JSON.
    #[new]
    fn new(json: &str) -> PyResult<Self> {
        let plan = serde_json::from_str(json).map_err(|e| faults::wrong(format!("this is no plan: {e}")))?;
        Ok(Self { plan })
    }

    /// From a survey file, or the file of a plan.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        std::fs::File::open(&path).map_err(|error| faults::unreadable(&path, &error))?;
        let plan = work::shortly(|| survey::Plan::read(&path))?.map_err(|error| unplanned(&error))?;
        Ok(Self { plan })
    }

    /// From the text of a survey file.
    #[staticmethod]
    fn from_toml(text: &str, folder: PathBuf) -> PyResult<Self> {
        let plan = work::shortly(|| survey::Plan::from_toml(text, &folder))?;
        Ok(Self { plan: plan.map_err(|error| unplanned(&error))? })
    }

    /// The whole plan.
    fn to_json(&self) -> PyResult<String> {
        serde_json::to_string(&self.plan).map_err(faults::wrong)
    }

    /// The plan of one task.
    fn only(&self, number: usize) -> PyResult<Self> {
        let tasks = vec![self.task(number)?.clone()];
        // Not a copy of the whole plan, which may have a million tasks.
        let survey::Plan { program, instruction_level, folder, scene, keys, tasks: _ } = &self.plan;
        Ok(Self {
            plan: survey::Plan {
                program: program.clone(),
                instruction_level: instruction_level.clone(),
                folder: folder.clone(),
                scene: scene.clone(),
                keys: keys.clone(),
                tasks,
            },
        })
    }

    /// The keys that vary.
    #[getter]
    fn keys(&self) -> Vec<String> {
        self.plan.keys.clone()
    }

    /// The tasks' names, in their order.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.plan.tasks.iter().map(|task| task.name.clone()).collect()
    }

    /// Each task's values, as JSON.
    fn values(&self) -> PyResult<String> {
        let values: Vec<_> = self.plan.tasks.iter().map(|task| &task.values).collect();
        serde_json::to_string(&values).map_err(faults::wrong)
    }

    /// The scene of a task, as TOML, and where its paths begin.
    fn scene(&self, number: usize) -> PyResult<(String, PathBuf)> {
        let scene = self.plan.scene(self.task(number)?).map_err(|wrong| faults::scene(&wrong))?;
        Ok((scene.to_toml(), self.plan.folder.clone()))
    }

    /// Numbers of the tasks of a part whose results are not in a folder.
    #[pyo3(signature = (folder, shard = None))]
    fn missing(&self, folder: PathBuf, shard: Option<&str>) -> PyResult<Vec<usize>> {
        let folder = Folder::create(&folder).map_err(|error| faults::file(&error))?;
        Ok(self.plan.missing(&folder, part(shard)?))
    }

    /// The bytes of a task's result.
    fn make(&self, py: Python<'_>, number: usize, threads: usize) -> PyResult<Vec<u8>> {
        let task = self.task(number)?;
        let made = work::run(py, Some(threads), &Told::Nothing, |signals| {
            make(&self.plan, task, &signals.cancelled)
        })?;
        made.map_err(|error| unmade(&error))
    }

    /// Puts a result in its place, with a note of who made it.
    fn keep(
        &self,
        folder: PathBuf,
        number: usize,
        contents: &[u8],
        worker: String,
        seconds: f64,
    ) -> PyResult<()> {
        let task = self.task(number)?;
        let folder = Folder::create(&folder).map_err(|error| faults::file(&error))?;
        let done = Done { task: task.name.clone(), worker, seconds };
        folder.keep(task, contents, &done).map_err(|error| faults::file(&error))
    }

    /// Writes down in a folder which plan is at work there.
    fn keep_plan(&self, folder: PathBuf) -> PyResult<()> {
        let folder = Folder::create(&folder).map_err(|error| faults::file(&error))?;
        folder.keep_plan(&self.plan).map_err(|error| faults::file(&error))
    }

    /// Makes what is missing of a part; the numbers and faults of what failed.
    #[pyo3(signature = (folder, shard = None, threads = None, progress = None))]
    fn run(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        shard: Option<&str>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Vec<(usize, String)>> {
        let shard = part(shard)?;
        let folder = Folder::create(&folder).map_err(|error| faults::file(&error))?;
        let total = self.plan.missing(&folder, shard).len();
        let told = progress.as_ref().map_or(Told::Nothing, |call| Told::Count(call, total as u64));
        let count = work::pool(threads)?.current_num_threads();
        let threads = count.try_into().map_err(|_| faults::wrong("there are no threads"))?;
        // The survey has threads of its own; one waits for them.
        let outcome = work::run(py, Some(1), &told, |signals| {
            let done = |_: &survey::Task| {
                signals.done.fetch_add(1, Ordering::Relaxed);
            };
            survey::run(&self.plan, &folder, shard, threads, &signals.cancelled, &done)
        })?;
        let failed = outcome.map_err(|error| unmade(&error))?;
        Ok(failed.into_iter().map(|failed| (failed.number, failed.error.to_string())).collect())
    }

    /// How far it is, as JSON.
    fn status(&self, folder: PathBuf) -> PyResult<String> {
        let folder = Folder::open(&folder).map_err(|error| faults::file(&error))?;
        let status = folder.status(&self.plan).map_err(|error| faults::file(&error))?;
        serde_json::to_string(&status).map_err(faults::wrong)
    }

    /// Writes one HDF5 file of all results: how many pictures it has.
    fn merge(&self, py: Python<'_>, folders: Vec<PathBuf>, to: PathBuf, partial: bool) -> PyResult<usize> {
        let folders = folders.iter().map(|folder| Folder::open(folder)).collect::<Result<Vec<_>, _>>();
        let folders = folders.map_err(|error| faults::file(&error))?;
        let merged = work::run(py, Some(1), &Told::Nothing, |_| library(&self.plan, &folders, &to, partial))?;
        merged.map_err(|error| match error {
            LibraryError::File(error) => faults::file(&error),
            other => faults::wrong(other),
        })
    }
}

impl Plan {
    fn task(&self, number: usize) -> PyResult<&survey::Task> {
        let count = self.plan.tasks.len();
        let none = || PyIndexError::new_err(format!("task {number}: the survey has {count}, counted from 0"));
        self.plan.tasks.get(number).ok_or_else(none)
    }
}

/// This process, as journals call it.
#[pyfunction]
pub fn worker() -> String {
    worker_name()
}

/// A part as it is written, `K/N`; all if none is given.
fn part(shard: Option<&str>) -> PyResult<Shard> {
    shard.map_or(Ok(Shard::WHOLE), str::parse).map_err(faults::wrong)
}

fn unplanned(error: &PlanError) -> PyErr {
    match error {
        PlanError::Faults(wrong) => faults::scene(wrong),
        PlanError::File(error) => faults::file(error),
        PlanError::Other(what) => faults::wrong(what),
    }
}

fn unmade(error: &TaskError) -> PyErr {
    match error {
        TaskError::Faults(wrong) => faults::scene(wrong),
        TaskError::Stage(error) => faults::stage(error),
        TaskError::File(error) => faults::file(error),
        TaskError::Plan(error) => unplanned(error),
        TaskError::Stopped(_) => PyKeyboardInterrupt::new_err("stopped"),
        TaskError::Changed => faults::wrong(error),
    }
}
