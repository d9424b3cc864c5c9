//! What is to be done for a survey: a task for each picture.

use std::collections::HashMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock};

use serde::{Deserialize, Serialize};

use super::file::{Setting, SurveyFile};
use super::points::{self, Kind, MOST_AXES};
use crate::output::FileError;
use crate::output::file::write_atomically;
use crate::scene::check::check;
use crate::scene::fault::{Collector, Faults, Place, Source};
use crate::scene::tree::{self, Node};
use crate::scene::{Scene, read};
use crate::spacetime::Level;

static SCHEMA: LazyLock<serde_json::Value> = LazyLock::new(SurveyFile::schema);

/// The most pictures of a survey.
pub const MOST_TASKS: usize = 1_000_000;

/// The largest file of a plan, bytes.
const LARGEST_FILE: u64 = 1 << 30;

/// The pictures of a survey.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Plan {
    /// Version of the program.
    pub program: String,
    /// The machine instructions that all is done with.
    pub instruction_level: String,
    /// Where paths in the scene begin.
    pub folder: PathBuf,
    /// The scene that all pictures begin with, as TOML.
    pub scene: String,
    /// The keys that vary.
    pub keys: Vec<String>,
    /// One for each picture.
    pub tasks: Vec<Task>,
}

/// A picture of a survey.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Task {
    /// The hash, in hexadecimal digits, of all that the picture depends on: scene, the contents of its pictures, version and
    /// instruction level.
    pub name: String,
    /// The value of each key.
    pub values: Vec<Setting>,
}

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// What is wrong with the survey, or a scene of it.
    #[error(transparent)]
    Faults(#[from] Faults),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// It is none of this version, or for other machines.
    #[error("{0}")]
    Other(String),
}

impl Plan {
    /// From the file of a survey (TOML), or of a plan (JSON).
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn read(path: &Path) -> Result<Self, PlanError> {
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json")) {
            return Self::written(path);
        }
        let source = read::file(path).map_err(Faults::from)?;
        Self::of(&source, path.parent().unwrap_or(Path::new("")))
    }

    /// From the text of a survey file; paths begin at `folder`.
    ///
    /// ```
    /// use std::path::Path;
    /// use kerrscope::survey::Plan;
    /// let survey = r#"
    ///     [set]
    ///     "render.width" = 32
    ///     [[axis]]
    ///     key = "spacetime.spin"
    ///     from = 0.0
    ///     to = 0.9
    ///     steps = 4
    ///     [[axis]]
    ///     key = "observer.inclination"
    ///     values = [17, 60]
    /// "#;
    /// let plan = Plan::from_toml(survey, Path::new(""))?;
    /// assert_eq!(plan.tasks.len(), 8);
    /// assert_eq!(plan.tasks[1].values[1].to_string(), "60");
    /// # Ok::<(), kerrscope::survey::PlanError>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn from_toml(text: &str, folder: &Path) -> Result<Self, PlanError> {
        Self::of(&Source::new("survey", text), folder)
    }

    /// A plan that was written.
    fn written(path: &Path) -> Result<Self, PlanError> {
        let file = File::open(path).map_err(|e| FileError::read(path, &e))?;
        let wrong =
            |fault: String, mend: &'static str| PlanError::File(FileError::new("read", path, fault, mend));
        if file.metadata().is_ok_and(|about| about.len() > LARGEST_FILE) {
            return Err(wrong(format!("it is larger than {} GiB", LARGEST_FILE >> 30), "give a plan"));
        }
        let text = fs::read(path).map_err(|e| FileError::read(path, &e))?;
        let plan: Self = serde_json::from_slice(&text).map_err(|e| {
            wrong(e.to_string(), "give a plan as `kerrscope survey plan` writes it, or a survey")
        })?;
        if plan.program != env!("CARGO_PKG_VERSION") {
            let what = format!(
                "it was made by version {} of kerrscope, this is {}",
                plan.program,
                env!("CARGO_PKG_VERSION")
            );
            return Err(wrong(what, "plan the survey anew"));
        }
        if plan.tasks.iter().any(|task| task.values.len() != plan.keys.len()) {
            return Err(wrong("a task has not a value for each key".to_owned(), "plan the survey anew"));
        }
        Ok(plan)
    }

    /// Writes the plan, whole or not at all. The same plan is the same bytes.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        write_atomically(path, |to| Ok(serde_json::to_writer_pretty(to, self)?))
    }

    /// The level of instructions.
    ///
    /// # Errors
    /// If this machine does not have it.
    pub fn level(&self) -> Result<Level, PlanError> {
        match Level::named(&self.instruction_level) {
            Some(level) if level.is_available() => Ok(level),
            _ => Err(PlanError::Other(format!(
                "the survey is planned for {} instructions, which this processor does not have: plan it with simd = \"{}\" for all \
                 machines alike",
                self.instruction_level,
                Level::best().name()
            ))),
        }
    }

    /// The scene of a task.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn scene(&self, task: &Task) -> Result<Scene, Faults> {
        let settings: Vec<String> =
            self.keys.iter().zip(&task.values).map(|(key, value)| format!("{key}={value}")).collect();
        let source = Source::new("the survey's scene", self.scene.as_str());
        read::varied(Ok(source), ("value", &settings), &self.folder)
    }

    fn of(source: &Arc<Source>, folder: &Path) -> Result<Self, PlanError> {
        let mut faults = Collector::default();
        faults.add_source(source);
        let (mut root, complete) = tree::parse(source, &mut faults);
        check(&mut root, &SCHEMA, &mut faults);
        let file: SurveyFile = root.to_toml().try_into().unwrap_or_else(|error: toml::de::Error| {
            let text = || (error.message().to_owned(), "compare with `kerrscope survey --help`".to_owned());
            faults.push(&root.place, text);
            SurveyFile::default()
        });
        let (keys, points) = if complete && faults.is_empty() {
            points_of(&file, &root, &mut faults)
        } else {
            Default::default()
        };
        faults.finish(())?;
        let level = file.simd.map_or_else(Level::best, super::file::Simd::level);
        let scene = base(&file, &root, folder)?;
        let folder = match &file.scene {
            Some(path) => folder.join(path).parent().map_or_else(PathBuf::new, Path::to_path_buf),
            None => folder.to_path_buf(),
        };
        let folder = std::path::absolute(&folder).unwrap_or(folder);
        let tasks = points.into_iter().map(|values| Task { name: String::new(), values }).collect();
        let mut plan = Self {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            instruction_level: level.name().to_owned(),
            folder,
            scene,
            keys,
            tasks,
        };
        plan.name_tasks()?;
        Ok(plan)
    }

    /// Gives each task its name, by the scene that it is.
    fn name_tasks(&mut self) -> Result<(), PlanError> {
        let mut pictures = Pictures::default();
        let mut faults: Option<Faults> = None;
        let mut names = Vec::with_capacity(self.tasks.len());
        for task in &self.tasks {
            match self.scene(task) {
                Ok(scene) => names.push(name(&scene, &self.instruction_level, &mut pictures)?),
                Err(wrong) => {
                    let all = match faults.take() {
                        None => wrong,
                        Some(before) => before.and(wrong),
                    };
                    let enough = all.len() >= Faults::MAX;
                    faults = Some(all);
                    if enough {
                        break;
                    }
                }
            }
        }
        if let Some(faults) = faults {
            return Err(faults.into());
        }
        for (task, name) in self.tasks.iter_mut().zip(names) {
            task.name = name;
        }
        Ok(())
    }
}

/// Hashes of pictures, each read once.
#[derive(Default)]
pub(super) struct Pictures(HashMap<PathBuf, [u8; 32]>);

impl Pictures {
    fn hash(&mut self, path: &Path) -> Result<[u8; 32], FileError> {
        if let Some(known) = self.0.get(path) {
            return Ok(*known);
        }
        let mut hasher = blake3::Hasher::new();
        let read = File::open(path).and_then(|file| hasher.update_reader(file).map(|_| ()));
        read.map_err(|e| FileError::read(path, &e))?;
        let hash = *hasher.finalize().as_bytes();
        self.0.insert(path.to_path_buf(), hash);
        Ok(hash)
    }
}

/// What a task is called whose picture is that of a scene.
pub(super) fn name(scene: &Scene, level: &str, pictures: &mut Pictures) -> Result<String, FileError> {
    let mut hasher = blake3::Hasher::new();
    for part in ["survey", env!("CARGO_PKG_VERSION"), level, &scene.to_toml()] {
        hasher.update(&(part.len() as u64).to_le_bytes()).update(part.as_bytes());
    }
    for path in scene.pictures() {
        hasher.update(&pictures.hash(path)?);
    }
    Ok(hasher.finalize().to_hex()[..32].to_owned())
}

/// The scene that all pictures begin with.
fn base(file: &SurveyFile, root: &Node, folder: &Path) -> Result<String, Faults> {
    let settings: Vec<String> = file.set.iter().map(|(key, value)| format!("{key}={value}")).collect();
    let (source, folder) = match &file.scene {
        Some(path) => {
            let path = folder.join(path);
            let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
            let source = read::file(&path).map_err(|mut fault| {
                // It is the survey that names it.
                if let Some(node) = root.at("scene") {
                    fault.message = format!("{}: {}", path.display(), fault.message);
                    (fault.source, fault.span) = (Arc::clone(&node.place.source), node.place.span.clone());
                }
                fault
            });
            (source, folder)
        }
        None => (Ok(Source::new("built-in scene", "")), folder.to_path_buf()),
    };
    read::varied(source, ("set", &settings), &folder).map(|scene| scene.to_toml())
}

/// The keys that vary, and the values of each picture.
fn points_of(file: &SurveyFile, root: &Node, faults: &mut Collector) -> (Vec<String>, Vec<Vec<Setting>>) {
    let place = |path: &str| root.at(path).map_or_else(|| root.place.clone(), |node| node.place.clone());
    let mut say = |place: &Place, what: String, mend: &str| faults.push(place, || (what, mend.to_owned()));
    let mut keys: Vec<String> = Vec::new();
    // Values of one axis after another, or of all sampled axes together: which keys, and the values of each point.
    let mut sets: Vec<(Vec<usize>, Vec<Vec<Setting>>)> = Vec::new();
    let (mut ranges, mut sampled) = (Vec::new(), Vec::new());
    for (i, axis) in file.axis.iter().enumerate() {
        let whole = place(&format!("axis[{i}].key"));
        if keys.contains(&axis.key) || file.set.contains_key(&axis.key) {
            say(
                &whole,
                format!("`{}` is set twice", axis.key),
                "let each key vary on one axis, or set it for all pictures",
            );
        }
        if axis.key.is_empty() || axis.key.contains(['=', '\n']) {
            say(
                &whole,
                format!("{:?} is no key", axis.key),
                "give a key of the scene, as \"spacetime.spin\"",
            );
        }
        keys.push(axis.key.clone());
        match points::kind(axis) {
            Ok(Kind::List(values)) => sets.push((vec![i], values.iter().map(|v| vec![v.clone()]).collect())),
            Ok(Kind::Grid(from, to, steps)) => {
                let values = points::grid(from, to, steps, axis.spacing);
                sets.push((vec![i], values.into_iter().map(|v| vec![v]).collect()));
            }
            Ok(Kind::Range(from, to)) => {
                ranges.push((from, to, axis.spacing));
                sampled.push(i);
            }
            Err((what, mend)) => say(&whole, what, &mend),
        }
    }
    match (&file.sample, sampled.first()) {
        (None, Some(first)) => say(
            &place(&format!("axis[{first}].key")),
            "this axis is a range, and nothing says how it is sampled".to_owned(),
            "give steps for a grid, or a section [sample] with design = \"sobol\" and count = 64",
        ),
        (Some(_), None) => {
            let mend = "give an axis with from and to, without steps; or leave out [sample]";
            say(&place("sample"), "there is no axis to sample".to_owned(), mend);
        }
        (Some(sample), Some(_)) if ranges.len() <= MOST_AXES => {
            sets.push((sampled, points::sampled(sample, &ranges)));
        }
        (Some(_), Some(_)) => {
            let what = format!("{} axes are sampled together", ranges.len());
            say(&place("sample"), what, &format!("sample {MOST_AXES} at most"));
        }
        (None, None) => {}
    }
    let count = sets.iter().try_fold(1_usize, |count, (_, values)| {
        count.checked_mul(values.len()).filter(|count| *count <= MOST_TASKS)
    });
    let Some(count) = count else {
        let mend = format!("give fewer values: {MOST_TASKS} pictures are the most");
        say(&root.place, "the axes have too many combinations".to_owned(), &mend);
        return (keys, Vec::new());
    };
    let point = |number: usize| {
        let (mut rest, mut point) = (number, vec![Setting::Truth(false); keys.len()]);
        for (axes, values) in sets.iter().rev() {
            for (axis, value) in axes.iter().zip(&values[rest % values.len()]) {
                point[*axis] = value.clone();
            }
            rest /= values.len();
        }
        point
    };
    let points = (0..count).map(point).collect();
    (keys, points)
}
