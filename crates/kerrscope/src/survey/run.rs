//! Making the pictures of a survey.

use std::collections::{HashSet, VecDeque};
use std::num::NonZeroUsize;
use std::str::FromStr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

use super::folder::{Done, Folder};
use super::plan::{self, Pictures, Plan, PlanError, Task};
use crate::output::{FileError, ImageSet, hdf5};
use crate::render::{Stage, StageError, Stopped, Watch, draw};
use crate::scene::Faults;

/// A part of a survey's tasks: every one of so many, from the k-th on.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Shard {
    number: usize,
    count: NonZeroUsize,
}

impl Shard {
    /// All tasks.
    pub const WHOLE: Self = Self { number: 0, count: NonZeroUsize::MIN };

    /// Whether the task of a number, from 0, belongs to it.
    pub fn has(&self, task: usize) -> bool {
        task % self.count == self.number
    }
}

impl FromStr for Shard {
    type Err = String;

    /// From `k/N`, k from 1 to N.
    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((k @ 1.., count)) if k <= NonZeroUsize::get(count) => Ok(Self { number: k - 1, count }),
            _ => Err(format!("{text:?} is no part: give K/N, K from 1 to N, as 2/3")),
        }
    }
}

impl Plan {
    /// Numbers of the tasks of a part whose results are not in a folder; of tasks that are the same picture, the first.
    pub fn missing(&self, folder: &Folder, shard: Shard) -> Vec<usize> {
        let mut seen = HashSet::new();
        let tasks = self.tasks.iter().enumerate();
        let missing = tasks.filter(|(number, task)| {
            shard.has(*number) && !folder.has(task) && seen.insert(task.name.as_str())
        });
        missing.map(|(number, _)| number).collect()
    }
}

/// Why a task has no picture.
#[derive(Debug, thiserror::Error)]
pub enum TaskError {
    /// Its scene is wrong.
    #[error(transparent)]
    Faults(#[from] Faults),
    /// Its scene cannot be drawn.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// It was stopped.
    #[error(transparent)]
    Stopped(#[from] Stopped),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// It is not for this machine.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A picture in its scene is another than the one that was planned with.
    #[error("a picture in its scene has changed since the survey was planned: plan it anew")]
    Changed,
}

/// A task that failed.
#[derive(Debug)]
pub struct Failed {
    /// Its number in the plan, from 0.
    pub number: usize,
    /// Why.
    pub error: TaskError,
}

/// Makes the picture of a task with the threads of the current pool: the bytes of its file.
///
/// # Errors
/// If it cannot be made, or is stopped.
pub fn make(plan: &Plan, task: &Task, cancelled: &AtomicBool) -> Result<Vec<u8>, TaskError> {
    made(plan, task, cancelled, &Mutex::default())
}

fn made(
    plan: &Plan,
    task: &Task,
    cancelled: &AtomicBool,
    pictures: &Mutex<Pictures>,
) -> Result<Vec<u8>, TaskError> {
    let level = plan.level()?;
    let scene = plan.scene(task)?;
    if plan::name(&scene, level.name(), &mut lock(pictures))? != task.name {
        return Err(TaskError::Changed);
    }
    let stage = Stage::with_level(&scene, level)?;
    let film = draw(&stage, &Watch { cancelled, ..Watch::default() })?;
    let mut bytes = Vec::new();
    // A vector takes all bytes; what else may fail has the file's name.
    hdf5::encode(&mut bytes, &ImageSet::of(&scene, &film))
        .map_err(|e| FileError::write(std::path::Path::new(&task.name), &e))?;
    Ok(bytes)
}

/// Makes what is missing of a part of a plan, with so many threads, and tells of each task that is done.
/// A task that fails does not keep others from being done.
///
/// # Errors
/// If it is stopped, or the folder cannot be written.
pub fn run(
    plan: &Plan,
    folder: &Folder,
    shard: Shard,
    threads: NonZeroUsize,
    cancelled: &AtomicBool,
    progress: &(dyn Fn(&Task) + Sync),
) -> Result<Vec<Failed>, TaskError> {
    plan.level()?;
    folder.keep_plan(plan)?;
    let missing: VecDeque<(usize, &Task)> =
        plan.missing(folder, shard).into_iter().map(|number| (number, &plan.tasks[number])).collect();
    // Small pictures are made best side by side, each on a thread; a few large ones share all threads.
    let workers = threads.get().min(missing.len()).max(1);
    let each = |worker: usize| (threads.get() + worker) / workers;
    let (missing, failed) = (Mutex::new(missing), Mutex::new(Vec::new()));
    let pictures = Mutex::default();
    let fault: Mutex<Option<TaskError>> = Mutex::default();
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let work = || {
                while let Some((number, task)) = next(&missing, cancelled, &fault) {
                    let start = Instant::now();
                    let outcome = made(plan, task, cancelled, &pictures);
                    let done = Done {
                        task: task.name.clone(),
                        worker: worker_name(),
                        seconds: start.elapsed().as_secs_f64(),
                    };
                    match outcome {
                        Ok(contents) => match folder.keep(task, &contents, &done) {
                            Ok(()) => progress(task),
                            Err(error) => *lock(&fault) = Some(error.into()),
                        },
                        Err(error @ TaskError::Stopped(_)) => *lock(&fault) = Some(error),
                        Err(error) => lock(&failed).push(Failed { number, error }),
                    }
                }
            };
            let (each, fault) = (each(worker), &fault);
            scope.spawn(move || match rayon::ThreadPoolBuilder::new().num_threads(each).build() {
                Ok(pool) => pool.install(work),
                Err(error) => *lock(fault) = Some(PlanError::Other(format!("no threads: {error}")).into()),
            });
        }
    });
    if cancelled.load(Ordering::Relaxed) {
        return Err(Stopped::Cancelled.into());
    }
    if let Some(error) = fault.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(error);
    }
    let mut failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
    failed.sort_by_key(|failed: &Failed| failed.number);
    Ok(failed)
}

/// The next task, unless the work is over.
fn next<'a>(
    missing: &Mutex<VecDeque<(usize, &'a Task)>>,
    cancelled: &AtomicBool,
    fault: &Mutex<Option<TaskError>>,
) -> Option<(usize, &'a Task)> {
    if cancelled.load(Ordering::Relaxed) || lock(fault).is_some() {
        return None;
    }
    lock(missing).pop_front()
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// This process, on this machine.
pub fn worker_name() -> String {
    let host = std::env::var("HOSTNAME").ok().or_else(|| {
        std::fs::read_to_string("/proc/sys/kernel/hostname").ok().map(|name| name.trim().to_owned())
    });
    format!("{}:{}", host.unwrap_or_else(|| "localhost".to_owned()), std::process::id())
}
