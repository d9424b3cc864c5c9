//! `kerrscope render`: a scene becomes a picture.

use crate::progress;
use crate::report::Failure;
use crate::source::Source;
use crate::{Format, print, print_json};
use indicatif::ProgressBar;
use kerrscope::checkpoint::{Checkpoint, CheckpointError, Identity};
use kerrscope::output::{Format as FileFormat, ImageSet};
use kerrscope::render::{Film, Interpolation as Interpolated, Stage, Stopped, Watch, draw};
use kerrscope::scene::Scene;
use kerrscope::spacetime::Level;
use serde::Serialize;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;
use tracing::info;

/// Draws a scene file, or the built-in scene.
#[derive(clap::Args, Debug, Default)]
#[command(after_help = "Examples:\n  \
    kerrscope render scenes/thesis-4.8.toml -o hole.png\n  \
    kerrscope render --set spacetime.spin=0.5 --set render.width=1920 --set render.height=1080\n  \
    kerrscope render -o hole.png -o hole.exr --set 'render.layers=[\"g\", \"r\"]'\n  \
    kerrscope render scenes/thesis-4.8.toml -o hole.fits --set units.mass=6.5e9 --set units.distance=16.8e6\n  \
    kerrscope render --layer g --order 1 --colormap inferno -o shift.png\n  \
    kerrscope render --set render.samples=1024 --resume   # again after an interruption")]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// File to write, .png, .exr, .fits or .h5; may be given several times. Without it, the scene's name
    /// with .png here
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
    /// Show a data layer in false colours instead of the light (as --set camera.display.layer=…): fate,
    /// crossings, windings, steps, error, r, phi, t, g, sky_theta, sky_phi or depth
    #[arg(long, value_name = "LAYER")]
    layer: Option<String>,
    /// Image order of the layer: 0, 1 or 2 (as --set camera.display.order=…)
    #[arg(long, value_name = "N")]
    order: Option<String>,
    /// Colours of the layer (as --set camera.display.colormap=…): viridis, magma, inferno, plasma,
    /// cividis, grey or hue
    #[arg(long, value_name = "NAME")]
    colormap: Option<String>,
    /// Threads to use; without it, one for each processor
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
    /// Go on from where an interrupted render of the same scene to the same file was; start afresh if
    /// there is none
    #[arg(long)]
    resume: bool,
    /// What traces the rays (as --set render.engine=…): auto, closed-form or integrator
    #[arg(long, value_name = "ENGINE")]
    engine: Option<String>,
    /// Vector instructions: baseline, avx2 or avx512; without it, the best that there are
    #[arg(long, value_name = "LEVEL", value_parser = crate::parse_level)]
    simd: Option<Level>,
    /// How to print what was done
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Serialize)]
struct Output {
    outputs: Vec<String>,
    wall_s: f64,
    rays: u64,
    rays_traced: u64,
    rays_given_up: u64,
    total_flux_jy: Option<f64>,
    centroid: Option<[f64; 2]>,
    size: Option<[f64; 2]>,
    length_unit: &'static str,
    error_estimate: Option<f64>,
    error_estimate_99: Option<f64>,
    error_estimate_max: Option<f64>,
    interpolation: Option<Interpolation>,
    engine: &'static str,
    instruction_level: &'static str,
}

/// How well an adaptive picture is interpolated; see [`kerrscope::render::Interpolation`].
#[derive(Serialize)]
struct Interpolation {
    samples: u64,
    compared: u64,
    missed: u64,
    error_max: f64,
    error_target: f64,
}

pub fn run(arguments: &Arguments, quiet: bool) -> Result<(), Failure> {
    let start = Instant::now();
    let overrides = [
        ("render.engine", &arguments.engine),
        ("camera.display.layer", &arguments.layer),
        ("camera.display.order", &arguments.order),
        ("camera.display.colormap", &arguments.colormap),
    ];
    let overrides =
        overrides.into_iter().filter_map(|(key, value)| Some(format!("{key}={}", value.as_ref()?)));
    let scene = arguments.source.load(overrides)?;
    let outputs = outputs(arguments)?;
    let level = arguments.simd.unwrap_or_else(Level::best);
    let stage = Stage::with_level(&scene, level).map_err(|e| Failure::Input(e.to_string()))?;
    info!(rays = stage.rays(), "scene ready");
    let checkpoint = checkpoint(&scene, level, &outputs[0], arguments.resume)?;
    let film = draw_in_pool(&stage, checkpoint.as_ref(), arguments.threads, quiet)?;
    info!(given_up = film.tally.given_up, steps = film.tally.steps, "rays traced");
    for path in &outputs {
        let format = FileFormat::of(path).unwrap_or(FileFormat::Png);
        format.write(path, &scene, &film).map_err(|e| Failure::Failed(e.to_string()))?;
        info!(path = %path.display(), "written");
    }
    // Only now is the work safe.
    checkpoint.map_or(Ok(()), Checkpoint::remove).map_err(|e| Failure::Failed(e.to_string()))?;
    if quiet && arguments.format == Format::Text {
        return Ok(());
    }
    report(arguments, &scene, &stage, &film, &outputs, start.elapsed().as_secs_f64())
}

/// The files to write, every one of a format that is known.
fn outputs(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    if arguments.output.is_empty() {
        let stem = arguments.source.scene.as_deref().and_then(Path::file_stem);
        let name = stem.map_or_else(|| PathBuf::from("kerrscope"), PathBuf::from);
        // Not `with_extension`: a name such as thesis-4.8 has a dot of its own.
        let mut name = name.into_os_string();
        name.push(".png");
        return Ok(vec![name.into()]);
    }
    let wrong: Vec<String> = arguments
        .output
        .iter()
        .filter(|path| FileFormat::of(path).is_none())
        .map(|path| format!("{}: pictures can be written as .png, .exr, .fits or .h5", path.display()))
        .collect();
    if wrong.is_empty() { Ok(arguments.output.clone()) } else { Err(Failure::Input(wrong.join("\nerror: "))) }
}

/// The checkpoint beside the first output; none if that is no ordinary file.
fn checkpoint(
    scene: &Scene,
    level: Level,
    output: &Path,
    resume: bool,
) -> Result<Option<Checkpoint>, Failure> {
    if output.metadata().is_ok_and(|about| !about.is_file()) {
        return Ok(None);
    }
    let mut path = output.as_os_str().to_owned();
    path.push(".checkpoint");
    let path = Path::new(&path);
    let identity = Identity::of_render(scene, level).map_err(|e| Failure::Input(e.to_string()))?;
    let opened =
        if resume { Checkpoint::resume(path, &identity) } else { Checkpoint::start(path, &identity) };
    opened.map(Some).map_err(|error| match error {
        CheckpointError::File(e) => Failure::Failed(e.to_string()),
        wrong => Failure::Input(wrong.to_string()),
    })
}

fn draw_in_pool(
    stage: &Stage,
    checkpoint: Option<&Checkpoint>,
    threads: Option<NonZeroUsize>,
    quiet: bool,
) -> Result<Film, Failure> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads.map_or(0, NonZeroUsize::get))
        .build()
        .map_err(|e| Failure::Failed(format!("no threads: {e}; give fewer with --threads")))?;
    let cancelled = progress::stop_flag();
    let bar = if quiet { ProgressBar::hidden() } else { progress::bar(stage.rays()) };
    let watch = Watch { cancelled, progress: &|rays| bar.inc(rays), checkpoint };
    let film = pool.install(|| draw(stage, &watch));
    bar.finish_and_clear();
    film.map_err(|stopped| match stopped {
        Stopped::Cancelled => Failure::Interrupted(match checkpoint.map(Checkpoint::path) {
            Some(path) if path.exists() => {
                format!("the same command with --resume goes on from {}", path.display())
            }
            _ => "nothing was written".to_owned(),
        }),
        Stopped::Checkpoint(error) => {
            Failure::Failed(format!("{error}. What was done before is in it: go on with --resume"))
        }
    })
}

fn report(
    arguments: &Arguments,
    scene: &Scene,
    stage: &Stage,
    film: &Film,
    outputs: &[PathBuf],
    wall_s: f64,
) -> Result<(), Failure> {
    let tally = &film.tally;
    let images = ImageSet::of(scene, film);
    let theta = scene.units.microarcseconds();
    let names: Vec<String> = outputs.iter().map(|path| path.display().to_string()).collect();
    if arguments.format == Format::Json {
        let pixel = images.pixel().map(|pixel| pixel * theta.unwrap_or(1.0));
        let moments = pixel.and_then(|pixel| images.moments(pixel));
        return print_json(&Output {
            outputs: names,
            wall_s,
            rays: stage.rays(),
            rays_traced: tally.rays,
            rays_given_up: tally.given_up,
            total_flux_jy: images.total_flux(),
            centroid: moments.map(|m| m.centroid),
            size: moments.map(|m| m.size),
            length_unit: if theta.is_some() { "uas" } else { "M" },
            error_estimate: tally.quantile(0.5),
            error_estimate_99: tally.quantile(0.99),
            error_estimate_max: tally.quantile(1.0).map(|_| tally.worst),
            interpolation: stage.adaptive().map(|error_target| Interpolation {
                samples: tally.interpolation.samples,
                compared: tally.interpolation.compared,
                missed: tally.interpolation.missed,
                error_max: tally.interpolation.worst,
                error_target,
            }),
            engine: stage.engine(),
            instruction_level: film.level.name(),
        });
    }
    print(&format!(
        "Saved {}: {} × {} pixels, {} rays in {wall_s:.2} s",
        names.join(", "),
        film.width,
        film.height,
        stage.rays()
    ))?;
    if let (Some(theta), Some(pixel)) = (theta, images.pixel()) {
        let [width, height] = images.size().map(|pixels| f64::from(pixels) * pixel * theta);
        let flux = images.total_flux().map_or_else(String::new, |flux| format!(", {flux:.4} Jy"));
        print(&format!("On the sky {width:.4} × {height:.4} µas; M is {theta:.4} µas{flux}"))?;
    }
    let Interpolated { samples, compared, missed, worst } = tally.interpolation;
    if samples > 0 {
        let missed = if missed > 0 { format!(", but {missed} that end otherwise") } else { String::new() };
        print(&format!(
            "{} rays traced, {samples} interpolated; largest error {worst:.1e} in {compared} compared{missed}",
            tally.rays
        ))?;
    }
    if tally.given_up > 0 {
        print(&format!(
            "{} rays were given up; what lies at their ends is missing. A larger render.max_steps follows most of them.",
            tally.given_up
        ))?;
    }
    Ok(())
}
