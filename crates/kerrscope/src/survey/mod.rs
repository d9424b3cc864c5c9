//! Surveys: pictures of a scene over ranges of its keys, made on one machine or many.
//!
//! A [`SurveyFile`] becomes a [`Plan`] of tasks, each named by a hash of all that its picture depends on. The result of a task is a
//! file of that name in a folder, written whole or not at all: what is there is done, on whichever machine, and is not done again.
//! The same plan on the same level of instructions gives the same bytes anywhere. [`library()`] makes one file of all of them.

mod file;
mod folder;
mod library;
mod plan;
mod points;
mod run;

pub use file::{Axis, Design, Sample, Setting, Simd, Spacing, SurveyFile};
pub use folder::{Done, Folder, Status};
pub use library::{LibraryError, library};
pub use plan::{MOST_TASKS, Plan, PlanError, Task};
pub use run::{Failed, Shard, TaskError, make, run, worker_name};
