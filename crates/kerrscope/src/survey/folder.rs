//! Where the results of a survey are.
//!
//! ```text
//! FOLDER/plan.json       the plan, of the last run
//! FOLDER/journal.jsonl   a line for each picture made: which, where, how long it took
//! FOLDER/HASH.h5         the results, as `kerrscope render -o x.h5` writes them
//! ```

use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::plan::{Plan, Task};
use crate::output::FileError;
use crate::output::file::write_atomically;

/// A folder of results.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
}

/// What is noted of a picture that was made.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct Done {
    /// The task's name.
    pub task: String,
    /// The machine and the process.
    pub worker: String,
    /// How long it took, seconds.
    pub seconds: f64,
}

/// How far a survey is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Status {
    /// Pictures of the plan.
    pub tasks: usize,
    /// Those that are there.
    pub done: usize,
    /// Results that are none of the plan's.
    pub others: usize,
    /// Seconds of work that the journal knows of, for those of the plan.
    pub seconds: f64,
    /// Pictures that were made more than once.
    pub repeated: usize,
    /// Machines and processes that worked.
    pub workers: usize,
}

impl Folder {
    /// A folder, created if there is none.
    ///
    /// # Errors
    /// If it cannot be created.
    pub fn create(path: &Path) -> Result<Self, FileError> {
        fs::create_dir_all(path).map_err(|e| FileError::write(path, &e))?;
        Ok(Self { path: path.to_path_buf() })
    }

    /// One that is there.
    ///
    /// # Errors
    /// If there is none.
    pub fn open(path: &Path) -> Result<Self, FileError> {
        if path.is_dir() {
            return Ok(Self { path: path.to_path_buf() });
        }
        let what = if path.exists() { "it is no folder" } else { "there is no such folder" };
        Err(FileError::new("read", path, what, "give the folder of a survey's results"))
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file of a task's result.
    pub fn result(&self, task: &Task) -> PathBuf {
        self.path.join(format!("{}.h5", task.name))
    }

    /// Whether a task is done.
    pub fn has(&self, task: &Task) -> bool {
        self.result(task).is_file()
    }

    /// Writes down which plan is at work.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep_plan(&self, plan: &Plan) -> Result<(), FileError> {
        plan.write(&self.path.join("plan.json"))
    }

    /// Puts a result in its place, and into the journal.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn keep(&self, task: &Task, contents: &[u8], done: &Done) -> Result<(), FileError> {
        write_atomically(&self.result(task), |to| to.write_all(contents))?;
        let path = self.journal_path();
        let noted = serde_json::to_string(done).map_err(std::io::Error::from).and_then(|line| {
            // One write, at the end: lines of several processes do not mix.
            let mut file = OpenOptions::new().create(true).append(true).open(&path)?;
            file.write_all(format!("{line}\n").as_bytes())
        });
        noted.map_err(|e| FileError::write(&path, &e))
    }

    fn journal_path(&self) -> PathBuf {
        self.path.join("journal.jsonl")
    }

    /// What was made, in the order in which it was done. A line that was cut off is left out.
    pub fn journal(&self) -> Vec<Done> {
        let text = fs::read_to_string(self.journal_path()).unwrap_or_default();
        text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
    }

    /// How far a plan is.
    ///
    /// # Errors
    /// If the folder cannot be read.
    pub fn status(&self, plan: &Plan) -> Result<Status, FileError> {
        use std::collections::{HashMap, HashSet};
        let read = fs::read_dir(&self.path).map_err(|e| FileError::read(&self.path, &e))?;
        let there: HashSet<String> = read
            .filter_map(|entry| Some(entry.ok()?.file_name().to_str()?.strip_suffix(".h5")?.to_owned()))
            .collect();
        let names: HashSet<&str> = plan.tasks.iter().map(|task| task.name.as_str()).collect();
        let done = names.iter().filter(|name| there.contains(**name)).count();
        let mut made: HashMap<String, usize> = HashMap::new();
        let (mut seconds, mut workers) = (0.0, HashSet::new());
        for entry in self.journal().into_iter().filter(|entry| names.contains(entry.task.as_str())) {
            seconds += entry.seconds;
            workers.insert(entry.worker);
            *made.entry(entry.task).or_default() += 1;
        }
        Ok(Status {
            tasks: names.len(),
            done,
            others: there.len() - done,
            seconds,
            repeated: made.values().filter(|count| **count > 1).count(),
            workers: workers.len(),
        })
    }
}
