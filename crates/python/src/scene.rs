//! Scenes.

use std::path::PathBuf;

use kerrscope::output::draft;
use kerrscope::render::Stage;
use kerrscope::scene::{self, Draft, KeyError, key};
use kerrscope::spacetime::Level;
use pyo3::exceptions::{PyKeyError, PyTypeError};
use pyo3::prelude::*;

use crate::faults;
use crate::film::Film;
use crate::work::{self, Told};

/// A scene that can be drawn, and the text that it was made of.
#[pyclass(frozen, module = "kerrscope._core")]
pub struct Scene {
    draft: Draft,
    scene: scene::Scene,
}

impl Scene {
    /// The scene of a draft.
    ///
    /// # Errors
    /// `ValueError` with everything that is wrong.
    pub fn of(mut draft: Draft) -> PyResult<Self> {
        // A scene that is pickled is read in another process, whose current folder may be another one.
        draft.folder = std::env::current_dir()?.join(&draft.folder);
        let scene = work::shortly(|| draft.scene())?.map_err(|faults| faults::scene(&faults))?;
        Ok(Self { draft, scene })
    }

    /// One that was read already.
    pub fn known(draft: Draft, scene: scene::Scene) -> Self {
        Self { draft, scene }
    }
}

#[pymethods]
impl Scene {
    /// A scene of a text, with changes `PATH=VALUE`; paths in it begin at a folder.
    #[new]
    #[pyo3(signature = (text, folder = PathBuf::new(), name = None, overrides = Vec::new()))]
    fn new(text: String, folder: PathBuf, name: Option<String>, overrides: Vec<String>) -> PyResult<Self> {
        let mut draft = Draft::new(text, folder);
        if let Some(name) = name {
            draft.name = name;
        }
        draft.overrides = overrides;
        Self::of(draft)
    }

    /// The scene in a file: a scene file, or a picture that was made of one.
    #[staticmethod]
    fn open(path: PathBuf) -> PyResult<Self> {
        // What the system has against a file is an exception of its own.
        if kerrscope::output::Format::of(&path).is_none() {
            std::fs::File::open(&path)
                .and_then(|file| {
                    let folder = file.metadata()?.is_dir();
                    if folder { Err(std::io::ErrorKind::IsADirectory.into()) } else { Ok(()) }
                })
                .map_err(|error| faults::unreadable(&path, &error))?;
        }
        Self::of(work::shortly(|| draft(&path))?.map_err(|error| faults::saved(&error))?)
    }

    /// The arguments with which `Scene(...)` makes it again.
    fn state(&self) -> (String, PathBuf, String, Vec<String>) {
        let Draft { name, text, overrides, folder } = self.draft.clone();
        (text, folder, name, overrides)
    }

    /// With other values of keys, in TOML; None takes a key away.
    fn changed(&self, changes: Vec<(String, Option<String>)>) -> PyResult<Self> {
        let mut draft = self.draft.clone();
        let mut wrong = Vec::new();
        for (name, value) in changes {
            match (key(&name), value) {
                (Ok(path), Some(value)) => draft.set(&path, &value),
                (Ok(path), None) => draft.unset(&path),
                (Err(error), _) => wrong.push(error),
            }
        }
        if wrong.is_empty() {
            return Self::of(draft);
        }
        let text = wrong.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        let unknown = wrong.iter().all(|error| matches!(error, KeyError::None { .. }));
        Err(if unknown { PyTypeError::new_err(text) } else { faults::wrong(text) })
    }

    /// The full name of a key.
    #[staticmethod]
    fn key(name: &str) -> PyResult<String> {
        key(name).map_err(|error| PyKeyError::new_err(error.to_string()))
    }

    /// The whole scene, with every default.
    fn to_toml(&self) -> String {
        self.scene.to_toml()
    }

    /// The same as JSON.
    fn to_json(&self) -> String {
        self.scene.file().to_json().to_string()
    }

    /// Whether another scene is the same.
    fn same(&self, other: &Self) -> bool {
        self.scene == other.scene
    }

    /// Width and height in pixels.
    #[getter]
    fn size(&self) -> [u32; 2] {
        [self.scene.render.width, self.scene.render.height]
    }

    /// Samples of a pixel.
    #[getter]
    fn samples(&self) -> u32 {
        self.scene.render.samples
    }

    /// Draws it. `progress(done, total)` is told of rays.
    #[pyo3(signature = (threads = None, progress = None, level = None))]
    fn render(
        &self,
        py: Python<'_>,
        threads: Option<usize>,
        progress: Option<Py<PyAny>>,
        level: Option<&str>,
    ) -> PyResult<Film> {
        let level = level.map_or_else(|| Ok(Level::best()), known_level)?;
        let scene = &self.scene;
        let stage = work::run(py, threads, &Told::Nothing, |_| Stage::with_level(scene, level))?
            .map_err(|error| faults::stage(&error))?;
        let told = progress.as_ref().map_or(Told::Nothing, |callable| Told::Count(callable, stage.rays()));
        let film = work::run(py, threads, &told, |signals| {
            let count = |rays| {
                signals.done.fetch_add(rays, std::sync::atomic::Ordering::Relaxed);
            };
            let watch = kerrscope::render::Watch {
                cancelled: &signals.cancelled,
                progress: &count,
                checkpoint: None,
            };
            kerrscope::render::draw(&stage, &watch)
        })?;
        let film = film.map_err(faults::wrong)?;
        Ok(Film::new(self.draft.clone(), self.scene.clone(), film))
    }
}

/// The level of instructions of a name.
fn known_level(name: &str) -> PyResult<Level> {
    let names: Vec<&str> = Level::ALL.into_iter().filter(|l| l.is_available()).map(Level::name).collect();
    Level::named(name)
        .filter(|level| level.is_available())
        .ok_or_else(|| faults::wrong(format!("level {name:?}: this processor has {}", names.join(", "))))
}
