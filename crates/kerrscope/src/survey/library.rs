//! All pictures of a survey in one file.
//!
//! An HDF5 file. Each image of the results is a dataset of its name, picture × height × width, of 64-bit floating-point numbers, a
//! picture compressed by itself. The group `parameters` has a dataset of each key, a number or a text for each picture, and `task`,
//! their names. The root's attributes are those that all results share, its dataset `kerrscope` the scene that all begin with. The
//! dimensions `task`, `height` and `width` are scales to h5netcdf, with which xarray reads the file.
//!
//! There is no date: the same results are the same bytes, in whichever folders they are.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use hdf5_pure::{AttrValue, Error, File, FileBuilder, GroupBuilder};

use super::file::Setting;
use super::folder::Folder;
use super::plan::{Plan, Task};
use crate::output::FileError;
use crate::output::file::write_atomically;

/// The largest library, bytes of its numbers: all of it is made in memory.
const LARGEST: usize = 8 << 30;

/// Why there is no library.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// Some pictures are not there.
    #[error(
        "{missing} of {tasks} pictures are missing: run the survey, or merge what is there with --partial"
    )]
    Missing {
        /// How many.
        missing: usize,
        /// Of how many.
        tasks: usize,
    },
    /// Pictures differ in size or in what they show.
    #[error("{0}")]
    Unlike(String),
}

/// An image of a result.
struct Shown {
    /// Height and width.
    size: [u64; 2],
    values: Vec<f64>,
    /// Title and unit.
    words: [String; 2],
}

/// One result.
struct Pictured {
    images: BTreeMap<String, Shown>,
    attributes: BTreeMap<String, AttrValue>,
}

/// Writes the library of a plan from results in one folder or several: how many pictures it has. With `partial`, what is missing
/// is left out.
///
/// # Errors
/// If pictures are missing, cannot be read, or differ in size; or the file cannot be written.
pub fn library(plan: &Plan, folders: &[Folder], to: &Path, partial: bool) -> Result<usize, LibraryError> {
    let found = |task: &Task| folders.iter().find(|folder| folder.has(task)).map(|f| f.result(task));
    let all: Vec<(&Task, Option<PathBuf>)> = plan.tasks.iter().map(|task| (task, found(task))).collect();
    let missing = all.iter().filter(|(_, path)| path.is_none()).count();
    let there: Vec<(&Task, PathBuf)> =
        all.into_iter().filter_map(|(task, path)| Some((task, path?))).collect();
    if there.is_empty() || (missing > 0 && !partial) {
        return Err(LibraryError::Missing { missing, tasks: plan.tasks.len() });
    }
    let mut stacks: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut words: BTreeMap<String, [String; 2]> = BTreeMap::new();
    let mut shape = None;
    let mut shared: Option<BTreeMap<String, AttrValue>> = None;
    for (number, (_, path)) in there.iter().enumerate() {
        let Pictured { images, attributes } = read(path)?;
        for (name, Shown { size, values, words: about }) in images {
            if *shape.get_or_insert(size) != size {
                let what = "pictures of several sizes do not make one library: let no size vary";
                return Err(LibraryError::Unlike(format!("{}: {what}", path.display())));
            }
            let all = there.len() * values.len() * 8 * (stacks.len() + 1);
            if all > LARGEST {
                return Err(LibraryError::Unlike(format!(
                    "the library would have {:.1} GiB, more than {} that are made in memory: merge parts of the survey",
                    all as f64 / f64::from(1 << 30),
                    LARGEST >> 30
                )));
            }
            let stack = stacks.entry(name.clone()).or_default();
            // What some have and others do not is unknown there.
            stack.resize(number * values.len(), f64::NAN);
            stack.extend(values);
            words.entry(name).or_insert(about);
        }
        shared = Some(match shared {
            None => attributes,
            Some(mut before) => {
                before.retain(|name, value| attributes.get(name) == Some(value));
                before
            }
        });
    }
    let [height, width] = shape.unwrap_or_default();
    let count = there.len() as u64;
    let mut file = FileBuilder::new();
    for (name, length) in [("task", count), ("height", height), ("width", width)] {
        let numbers: Vec<i64> = (0..length.cast_signed()).collect();
        file.create_dataset(name)
            .with_i64_data(&numbers)
            .with_shape(&[length])
            .set_attr("CLASS", AttrValue::AsciiString("DIMENSION_SCALE".to_owned()))
            .set_attr("NAME", AttrValue::AsciiString(name.to_owned()));
    }
    for (name, mut stack) in stacks {
        stack.resize((count * height * width) as usize, f64::NAN);
        let [title, unit] = words.remove(&name).unwrap_or_default();
        file.create_dataset(&name)
            .with_f64_data(&stack)
            .with_shape(&[count, height, width])
            .with_chunks(&[1, height, width])
            .with_shuffle()
            .with_deflate(4)
            .set_attr("title", AttrValue::VarLenString(title))
            .set_attr("unit", AttrValue::VarLenString(unit));
    }
    let tasks: Vec<&Task> = there.iter().map(|(task, _)| *task).collect();
    let group = table(&mut file, plan, &tasks);
    file.add_group(group.finish());
    for (name, value) in shared.unwrap_or_default() {
        file.set_attr(&name, value);
    }
    file.create_dataset("kerrscope").with_vlen_strings(&[&plan.scene]);
    write_atomically(to, |out| {
        file.finish_to(out).map_err(|error| match error {
            Error::Io(e) => e,
            other => std::io::Error::other(other.to_string()),
        })
    })?;
    Ok(there.len())
}

/// The values of each key, and the tasks' names.
fn table(file: &mut FileBuilder, plan: &Plan, tasks: &[&Task]) -> GroupBuilder {
    let mut group = file.create_group("parameters");
    let count = tasks.len() as u64;
    for (k, key) in plan.keys.iter().enumerate() {
        let numbers: Option<Vec<f64>> = tasks.iter().map(|task| task.values[k].number()).collect();
        if let Some(numbers) = numbers {
            group.create_dataset(key).with_f64_data(&numbers).with_shape(&[count]);
        } else {
            let words: Vec<String> = tasks
                .iter()
                .map(|task| match &task.values[k] {
                    Setting::Text(text) => text.clone(),
                    other => other.to_string(),
                })
                .collect();
            group
                .create_dataset(key)
                .with_vlen_strings(&words.iter().map(String::as_str).collect::<Vec<_>>());
        }
    }
    let names: Vec<&str> = tasks.iter().map(|task| task.name.as_str()).collect();
    group.create_dataset("task").with_vlen_strings(&names);
    group
}

fn read(path: &Path) -> Result<Pictured, FileError> {
    let wrong = |error: Error| {
        let mend = "delete it, and run the survey again";
        FileError::new("read", path, error.to_string(), mend)
    };
    let file = File::open(path).map_err(wrong)?;
    let root = file.root();
    let mut images = BTreeMap::new();
    for name in root.datasets().map_err(wrong)? {
        let dataset = file.dataset(&name).map_err(wrong)?;
        let Ok([height, width]) = <[u64; 2]>::try_from(dataset.shape().map_err(wrong)?) else { continue };
        let about = dataset.attrs().map_err(wrong)?;
        let text = |key: &str| match about.get(key) {
            Some(AttrValue::VarLenString(text)) => text.clone(),
            _ => String::new(),
        };
        let values = dataset.read_f64().map_err(wrong)?;
        let words = [text("title"), text("unit")];
        images.insert(name, Shown { size: [height, width], values, words });
    }
    let attributes = root.attrs().map_err(wrong)?.into_iter().collect();
    Ok(Pictured { images, attributes })
}
