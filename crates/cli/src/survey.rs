//! `kerrscope survey`: pictures of a scene over ranges of its keys.

use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

use kerrscope::survey::{
    Folder, LibraryError, Plan, PlanError, Shard, Status, TaskError, library, run as work,
};
use serde::Serialize;

use crate::report::Failure;
use crate::{Format, print, print_json, progress};

/// A survey file says which scene, which of its keys vary, and over what. Each picture is a file in a folder, named by a hash of all
/// that it depends on; what is there is not made again.
#[derive(clap::Args, Debug)]
#[command(after_help = "A survey file:\n  \
    scene = \"m87.toml\"\n  \
    [set]\n  \
    \"render.width\" = 128\n  \
    [[axis]]\n  \
    key = \"spacetime.spin\"\n  \
    from = 0.0\n  \
    to = 0.99\n  \
    steps = 10\n  \
    [[axis]]\n  \
    key = \"observer.inclination\"\n  \
    values = [17, 60]\n\
    Axes with from and to but no steps are sampled together:\n  \
    [sample]\n  \
    design = \"sobol\"          # or \"latin-hypercube\"\n  \
    count = 64\n\n\
    Examples:\n  \
    kerrscope survey run scenes/survey-spins.toml --folder spins\n  \
    kerrscope survey run scenes/survey-spins.toml --folder spins --shard 2/3   # one of three machines\n  \
    kerrscope survey status scenes/survey-spins.toml --folder spins\n  \
    kerrscope survey merge scenes/survey-spins.toml --folder spins -o spins.h5")]
pub struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(clap::Subcommand, Debug)]
enum Action {
    /// What is to be made: a table, or with -o a file that other machines run as it is
    Plan(Planned),
    /// Make what is missing
    Run(Run),
    /// How far it is
    Status(Asked),
    /// Make one HDF5 file of all pictures, with a table of parameters
    Merge(Merge),
}

#[derive(clap::Args, Debug)]
struct Planned {
    /// Survey file (TOML)
    survey: PathBuf,
    /// Write the plan here (.json)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(clap::Args, Debug)]
struct Run {
    /// Survey file (TOML), or a plan of one (.json)
    survey: PathBuf,
    /// Where results are [default: the survey's name, here]
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// Only a part: every N-th picture from the K-th on, as 2/3
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// Threads to use; without it, one for each processor
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// How to print what was done
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(clap::Args, Debug)]
struct Asked {
    /// Survey file (TOML), or a plan of one (.json)
    survey: PathBuf,
    /// Where results are [default: the survey's name, here]
    #[arg(long, value_name = "FOLDER")]
    folder: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(clap::Args, Debug)]
struct Merge {
    /// Survey file (TOML), or a plan of one (.json)
    survey: PathBuf,
    /// Where results are; may be given several times [default: the survey's name, here]
    #[arg(long, value_name = "FOLDER")]
    folder: Vec<PathBuf>,
    /// The library to write (.h5)
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Leave out what is missing
    #[arg(long)]
    partial: bool,
}

#[derive(Serialize)]
struct Output {
    tasks: usize,
    made: usize,
    failed: Vec<Failing>,
    wall_s: f64,
    folder: String,
}

#[derive(Serialize)]
struct Failing {
    number: usize,
    task: String,
    fault: String,
}

pub fn run(arguments: &Arguments, quiet: bool) -> Result<(), Failure> {
    match &arguments.action {
        Action::Plan(a) => plan(a),
        Action::Run(a) => make(a, quiet),
        Action::Status(a) => status(a),
        Action::Merge(a) => merge(a),
    }
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Faults(faults) => Self::Scene(faults),
            other => Self::Input(other.to_string()),
        }
    }
}

/// The folder of a survey's results.
fn folder_of(survey: &Path, given: Option<&PathBuf>) -> PathBuf {
    given.cloned().unwrap_or_else(|| PathBuf::from(survey.file_stem().unwrap_or_default()))
}

fn opened(folder: &Path) -> Result<Folder, Failure> {
    Folder::open(folder).map_err(|e| Failure::Input(e.to_string()))
}

fn plan(arguments: &Planned) -> Result<(), Failure> {
    let plan = Plan::read(&arguments.survey)?;
    if let Some(path) = &arguments.output {
        plan.write(path).map_err(|e| Failure::Failed(e.to_string()))?;
    }
    if arguments.format == Format::Json {
        return print_json(&plan);
    }
    if let Some(path) = &arguments.output {
        return print(&format!("Planned {} pictures: {}", plan.tasks.len(), path.display()));
    }
    let mut text = format!("task                              {}", plan.keys.join("  "));
    for task in &plan.tasks {
        let values: Vec<String> = task.values.iter().map(ToString::to_string).collect();
        let _ = write!(text, "\n{}  {}", task.name, values.join("  "));
    }
    print(&text)
}

fn make(arguments: &Run, quiet: bool) -> Result<(), Failure> {
    let start = Instant::now();
    let plan = Plan::read(&arguments.survey)?;
    let path = folder_of(&arguments.survey, arguments.folder.as_ref());
    let folder = Folder::create(&path).map_err(|e| Failure::Failed(e.to_string()))?;
    let shard = arguments.shard.unwrap_or(Shard::WHOLE);
    let missing = plan.missing(&folder, shard).len();
    let bar = progress::count(missing as u64, quiet);
    let processors = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let threads = arguments.threads.unwrap_or_else(processors);
    let outcome = work(&plan, &folder, shard, threads, progress::stop_flag(), &|_| bar.inc(1));
    bar.finish_and_clear();
    let failed = outcome.map_err(|error| match error {
        TaskError::Stopped(_) => {
            Failure::Interrupted("the same command goes on with what is missing".to_owned())
        }
        TaskError::Plan(error) => error.into(),
        other => Failure::Failed(other.to_string()),
    })?;
    let made = missing - failed.len();
    let failed: Vec<Failing> = failed
        .into_iter()
        .map(|failed| Failing {
            number: failed.number,
            task: plan.tasks[failed.number].name.clone(),
            fault: failed.error.to_string(),
        })
        .collect();
    let wall_s = start.elapsed().as_secs_f64();
    let failure = failed.first().map(|first| {
        Failure::Failed(format!(
            "{} pictures could not be made, the first of them number {}: {}",
            failed.len(),
            first.number,
            first.fault
        ))
    });
    if arguments.format == Format::Json {
        let tasks = plan.tasks.len();
        print_json(&Output { tasks, made, failed, wall_s, folder: path.display().to_string() })?;
    } else if !quiet {
        print(&format!("Made {made} of {} pictures in {wall_s:.2} s: {}", plan.tasks.len(), path.display()))?;
    }
    failure.map_or(Ok(()), Err)
}

fn status(arguments: &Asked) -> Result<(), Failure> {
    let plan = Plan::read(&arguments.survey)?;
    let path = folder_of(&arguments.survey, arguments.folder.as_ref());
    let status = opened(&path)?.status(&plan).map_err(|e| Failure::Failed(e.to_string()))?;
    if arguments.format == Format::Json {
        return print_json(&status);
    }
    let Status { tasks, done, others, seconds, repeated, workers } = status;
    let mut text =
        format!("{done} of {tasks} pictures are there; {seconds:.1} s of work by {workers} processes");
    if repeated > 0 {
        let _ = write!(text, "; {repeated} were made more than once");
    }
    if others > 0 {
        let _ = write!(text, "; {others} results are of other surveys, or of other versions");
    }
    print(&text)
}

fn merge(arguments: &Merge) -> Result<(), Failure> {
    let plan = Plan::read(&arguments.survey)?;
    if !arguments.output.extension().is_some_and(|ending| ending == "h5" || ending == "hdf5") {
        return Err(Failure::Input(format!("{}: a library is written as .h5", arguments.output.display())));
    }
    let given = &arguments.folder;
    let paths = if given.is_empty() { vec![folder_of(&arguments.survey, None)] } else { given.clone() };
    let folders = paths.iter().map(|path| opened(path)).collect::<Result<Vec<_>, _>>()?;
    let count =
        library(&plan, &folders, &arguments.output, arguments.partial).map_err(|error| match error {
            LibraryError::File(error) => Failure::Failed(error.to_string()),
            other => Failure::Input(other.to_string()),
        })?;
    print(&format!("Saved {}: {count} of {} pictures", arguments.output.display(), plan.tasks.len()))
}
