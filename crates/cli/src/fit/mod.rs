//! `kerrscope fit`: what a picture says of the hole and its disk.

mod kept;
mod output;

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::Instant;

use kerrscope::measure::Picture;
use kerrscope_fit::fit::{FitError, Image, Keeper};
use kerrscope_fit::models::{Choice, Name};
use kerrscope_fit::question::Question;
use kerrscope_fit::request::{Request, unknown_model};
use kerrscope_fit::task::{Report, Task, TaskError, Watch};
use kerrscope_fit::traced::Projection;
use tracing::info;

use self::kept::kept;
use self::output::{files, table};
use crate::report::Failure;
use crate::{Format, parse_distance, parse_finite, print, print_json, progress};

/// Find what a picture says of a hole and its disk: spin, inclination and all else at once, with errors.
///
/// The posterior of a model's parameters, given a picture in FITS, OpenEXR or any format for screens, in linear light.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Without flags: an opaque disk with the flux of Page & Thorne in the light of all frequencies,\n\
    from the last stable orbit to beyond the picture, seen by a static observer; its spin, axis,\n\
    scale, centre, flux and the observer's distance are looked for, and the noise is found from the\n\
    picture. Where it has none, what the model may be wrong by takes its place. Give --distance where it\n\
    is known (inf for the sky): not knowing it costs errors, assuming a wrong one a bias. Of a disk\n\
    seen from r = 100 M (a = 0.9, 60°) a fit that assumes 1000 M finds the spin 0.035 and the\n\
    inclination 1.7° too small, the scale 5 % too large, and says that it is poor. A disk seen from nearby needs its outer edge,\n\
    within 0.8 of the distance: --fix outer=R or --free outer; a camera's picture --projection pinhole.\n\n\
    Parameters: spin, inclination, position_angle, scale (M a pixel), center_x, center_y (pixels), distance (M), inner (in last\n\
    stable orbits), outer (M), blur (pixels), flux, background; index of power laws; diameter, width and more of a ring.\n\
    A parameter is fixed by --fix NAME=VALUE, or has another prior by --prior 'NAME=uniform(0, 1)' (or log-uniform, normal,\n\
    isotropic); --free NAME frees what is usually fixed. A file of --parameters says the same:\n  \
    model = \"page-thorne\"\n  [parameters]\n  spin = 0.9\n  blur = \"free\"\n  inclination = \"isotropic(0, 90)\"\n\n\
    With --silhouette only what is lit counts, not how brightly: for screenshots and other pictures that a tone curve was applied to.\n\
    `inner` is then 0 at the horizon and 1 at the last stable orbit, `outer` is free if the disk ends within the picture, and `tone` is\n\
    what the curve does to pixels at edges. Edges where light begins gradually are left out. Pictures of one image order, as the\n\
    thesis's, need --orders 1. Disks seen from within half a degree of their own plane have no picture.\n\n\
    With --spacetime NAME|FILE the disk is in a metric as text, one that is known by its name (kerr-newman, johannsen …) or one's\n\
    own, whose numbers are parameters too: spin is looked for, the others keep the values of the text unless --prior frees them.\n\
    For each that was free the report says what speaks for its value in Kerr's spacetime, 0 or that of --null NAME=VALUE: the\n\
    Bayes factor K of that value against all that the prior allows (Savage & Dickey), which depends on how wide the prior is.\n\
    A mass in the text stays as it is, as the unit; the observer is at rest, 1000 from the origin of its coordinates or at --distance.\n\n\
    With --output NAME it writes NAME.json, NAME.chain.h5 (chains for h5py and arviz), NAME.corner.svg, NAME.residual.png and\n\
    NAME.residual.fits; interrupted, it goes on with --resume.\n\n\
    --format json prints one object: model, parameters (a list of name, unit, mode, mean, sd, q025, q16, q50, q84, q975, free, r_hat,\n\
    effective), converged, good, warnings, chi2, degrees, explained, evidence, evaluations, wall_s, seed, version; and with\n\
    --spacetime its name, and tests (a list of name, null, deviations, tail, ln_bayes, error, gaussian; error is\n\
    null where ln_bayes is a bound from above, and gaussian is ln_bayes for a posterior that is a Gaussian).\n\n\
    Examples:\n  \
    kerrscope fit disk.fits --distance 100\n  \
    kerrscope fit disk.fits --free blur --prior 'inclination=isotropic(0, 90)' -o disk\n  \
    kerrscope fit ring.fits --model ring\n  \
    kerrscope fit screenshot.png --silhouette --distance 30 --projection pinhole --fix outer=6\n  \
    kerrscope fit disk.fits --spacetime johannsen --prior 'a13=uniform(-3, 3)'"
)]
pub struct Arguments {
    /// The picture
    image: PathBuf,
    /// page-thorne, power-law, thin-power-law, ring or silhouette
    #[arg(long, value_name = "NAME")]
    model: Option<String>,
    /// Use edges of the light alone, however bright it is: the same as --model silhouette
    #[arg(long)]
    silhouette: bool,
    /// Image orders that a silhouette shows, from the first; all if not given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=4))]
    orders: Option<u8>,
    /// A metric as text that the disk is in: one that is known by its name, or a file
    #[arg(long, value_name = "NAME|FILE")]
    spacetime: Option<String>,
    /// The value of a parameter of the metric with which it is Kerr's; 0 if not given
    #[arg(long, value_name = "NAME=VALUE", requires = "spacetime")]
    null: Vec<String>,
    /// r of the observer in M, or inf: the same as --fix distance=R
    #[arg(long, value_name = "R", value_parser = parse_distance)]
    distance: Option<f64>,
    /// How directions became places in the picture
    #[arg(long, value_enum, default_value_t)]
    projection: Shape,
    /// A parameter that is known
    #[arg(long, value_name = "NAME=VALUE")]
    fix: Vec<String>,
    /// A parameter that is not known, though it is usually taken to be
    #[arg(long, value_name = "NAME")]
    free: Vec<String>,
    /// What is assumed of a parameter
    #[arg(long, value_name = "NAME=PRIOR")]
    prior: Vec<String>,
    /// A file of parameters; flags count before it
    #[arg(long, value_name = "FILE")]
    parameters: Option<PathBuf>,
    /// Standard deviation of each pixel's noise, in the picture's unit; found if not given
    #[arg(long, value_name = "SIGMA", value_parser = parse_finite, allow_hyphen_values = true)]
    noise: Option<f64>,
    /// Seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Rounds of 50 draws of each of four chains at most; fewer do when chains have converged
    #[arg(long, default_value_t = 30, value_parser = clap::value_parser!(u64).range(3..=1000))]
    rounds: u64,
    /// Beginning of the names of files to write
    #[arg(short, long, value_name = "NAME")]
    output: Option<PathBuf>,
    /// Go on where an interrupted fit with the same --output stopped
    #[arg(long, requires = "output")]
    resume: bool,
    /// Threads; all of the machine's if not given
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// How directions become places.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
enum Shape {
    /// Equal angles, as of pictures of the sky
    #[default]
    Angular,
    /// Tangents, as in a camera
    Pinhole,
}

pub fn run(arguments: &Arguments, quiet: bool) -> Result<(), Failure> {
    let start = Instant::now();
    let task = asked(arguments)?;
    let picture = Picture::open(&arguments.image).map_err(|error| Failure::Input(error.to_string()))?;
    let image = Image {
        size: [picture.width, picture.height],
        pixel: picture.pixel.microarcseconds,
        values: picture.values,
    };
    let wrong = |error: FitError| Failure::Input(format!("{}: {error}", arguments.image.display()));
    let ready = task.with(image).map_err(|error| match error {
        TaskError::Asked(faults) => Failure::Input(faults.join("\nerror: ")),
        TaskError::Picture(error) => wrong(error),
    })?;
    let kept = arguments.output.as_deref().map(|name| kept(arguments, name, &ready)).transpose()?;
    let bar = progress::message(quiet);
    let flag = progress::stop_flag();
    let watch = Watch {
        progress: &|text| {
            info!("{text}");
            bar.set_message(text.to_owned());
        },
        interim: None,
        cancelled: &|| flag.load(Ordering::Relaxed),
        keeper: kept.as_ref().map(|kept| kept as &dyn Keeper),
    };
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(arguments.threads.map_or(0, NonZeroUsize::get))
        .build()
        .map_err(|e| Failure::Failed(format!("no threads: {e}; give fewer with --threads")))?;
    let found = pool.install(|| ready.run(&watch));
    bar.finish_and_clear();
    let found = found.map_err(|error| match error {
        FitError::Cancelled => Failure::Interrupted(match &arguments.output {
            Some(_) => "the same command with --resume goes on".to_owned(),
            None => "nothing was kept: with --output NAME it can be gone on with".to_owned(),
        }),
        FitError::Keeper(fault) => Failure::Failed(fault),
        fault => wrong(fault),
    })?;
    let wall_s = start.elapsed().as_secs_f64();
    let report = Report::of(ready.task(), &found, arguments.spacetime.as_deref(), wall_s);
    if let Some(name) = &arguments.output {
        files(name, ready.image(), &found.fit, &report)?;
    }
    if let Some(kept) = kept {
        kept.checkpoint.remove().map_err(|e| Failure::Failed(e.to_string()))?;
    }
    if arguments.format == Format::Json { print_json(&report) } else { print(&table(&report)) }
}

/// The model, what is said of its parameters, and the rest; all faults at once.
fn asked(arguments: &Arguments) -> Result<Task, Failure> {
    let mut faults = Vec::new();
    let (mut name, mut request) = (None, Request::default());
    if let Some(path) = &arguments.parameters {
        match std::fs::read_to_string(path)
            .map_err(|e| e.to_string())
            .and_then(|text| Request::from_toml(&text))
        {
            Ok((model, said)) => (name, request) = (model, said),
            Err(fault) => faults.push(format!("{}: {fault}", path.display())),
        }
    }
    if let Some(text) = &arguments.model {
        match Name::named(text) {
            Some(model) => name = Some(model),
            None => faults.push(unknown_model(text)),
        }
    }
    let said = &mut request.parameters;
    said.extend(arguments.distance.map(|distance| ("distance".to_owned(), distance.to_string())));
    said.extend(arguments.free.iter().map(|name| (name.clone(), "free".to_owned())));
    for (flag, texts, form) in [
        ("--fix", &arguments.fix, "NAME=VALUE, as spin=0.9"),
        ("--prior", &arguments.prior, "NAME=PRIOR, as 'spin=uniform(0, 1)'"),
    ] {
        for text in texts {
            match text.split_once('=') {
                Some((name, words)) if flag == "--prior" || words.trim().parse::<f64>().is_ok() => {
                    said.push((name.trim().to_owned(), words.to_owned()));
                }
                _ => faults.push(format!("{flag} {text:?}: give {form}")),
            }
        }
    }
    if arguments.silhouette {
        match name.filter(|name| *name != Name::Silhouette) {
            Some(other) if arguments.model.is_some() => {
                faults.push(format!("--silhouette is a model, and so is --model {}: give one", other.name()));
            }
            _ => name = Some(Name::Silhouette),
        }
    }
    let projection = match arguments.projection {
        Shape::Angular => Projection::Angular,
        Shape::Pinhole => Projection::Pinhole,
    };
    let orders = arguments.orders.map(usize::from);
    let choice = Choice { name: name.unwrap_or_default(), projection, orders };
    let (noise, seed, rounds) = (arguments.noise, arguments.seed, arguments.rounds);
    let mut task = Task { choice, request, question: None, noise, seed, rounds };
    faults.extend(task.faults(|name| format!("--{name}")));
    if faults.is_empty()
        && let Some(word) = &arguments.spacetime
    {
        match Question::new(word, choice.name, projection, &arguments.null) {
            Ok(question) => task.question = Some(question),
            Err(wrong) => faults = wrong,
        }
    }
    if faults.is_empty() { Ok(task) } else { Err(Failure::Input(faults.join("\nerror: "))) }
}
