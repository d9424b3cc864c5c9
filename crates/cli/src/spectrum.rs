//! `kerrscope spectrum`: the continuum of a disk of black bodies.

use std::fmt::Write;
use std::path::PathBuf;

use kerrscope::camera::Camera;
use kerrscope::display::chart::Scale;
use kerrscope::render::{Stage, continuum};
use kerrscope::scene::Disk;
use serde::Serialize;

use crate::plot::{self, Plot, Shape, save, shapes};
use crate::report::Failure;
use crate::source::Source;
use crate::{print, print_json};

/// Flux density against frequency of a disk with `disk.light = "blackbody"`, as the scene's picture shows it: what is
/// outside of the picture does not count.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  \
    kerrscope spectrum scenes/gallery/disk.toml --from 1e13 --to 3e15 > spectrum.csv\n  \
    kerrscope spectrum scenes/gallery/disk.toml --set units.mass=10 --set units.distance=1000 -o spectrum.svg")]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// Lowest frequency in Hz; 1/30 of that of the hottest place if not given
    #[arg(long, value_name = "HZ", value_parser = crate::parse_finite)]
    from: Option<f64>,
    /// Highest frequency in Hz; 30 times that of the hottest place if not given
    #[arg(long, value_name = "HZ", value_parser = crate::parse_finite)]
    to: Option<f64>,
    /// Frequencies, equal ratios apart
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    bins: u32,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Shape,
    /// Files to write instead; their endings say how: .svg, .csv or .json
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

#[derive(Serialize)]
struct Output {
    /// Hz.
    frequency: Vec<f64>,
    /// In `unit`.
    flux_density: Vec<f64>,
    /// "Jy" where the scene has a mass and a distance, otherwise W m⁻² Hz⁻¹ times (D/M)².
    unit: &'static str,
}

/// A black body of 1 K is the brightest, in νF_ν, at this frequency in Hz: hν = 3.92 kT.
const PEAK: f64 = 8.17e10;

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let shapes = shapes(&arguments.output)?;
    let scene = arguments.source.load([])?;
    let hottest = scene.disk.as_ref().and_then(Disk::hottest).ok_or_else(|| {
        Failure::Input(
            "the scene has no disk of black bodies: set disk.model to \"page-thorne\", \"power-law\" or \"profile\", \
             and disk.light to \"blackbody\""
                .to_owned(),
        )
    })?;
    let range =
        [arguments.from.unwrap_or(PEAK * hottest / 30.0), arguments.to.unwrap_or(PEAK * hottest * 30.0)];
    if !(range[0] > 0.0 && range[0] < range[1]) {
        return Err(Failure::Input(format!(
            "--from {:e} --to {:e}: give a frequency above 0, and a higher one",
            range[0], range[1]
        )));
    }
    let step = (range[1] / range[0]).powf(f64::from(arguments.bins).recip());
    let frequency: Vec<f64> =
        (0..arguments.bins).map(|bin| range[0] * step.powf(f64::from(bin) + 0.5)).collect();
    let stage = Stage::new(&scene).map_err(|e| Failure::Failed(e.to_string()))?;
    let (mean, _) = continuum(&stage, &frequency).ok_or_else(|| {
        Failure::Input("the light of things has no spectrum: leave out the [[object]] sections".to_owned())
    })?;
    let pixel = Camera::new(&scene).map_err(|e| Failure::Failed(e.to_string()))?.pixel_size();
    let pixels = f64::from(scene.render.width) * f64::from(scene.render.height);
    let (factor, unit) = match scene.units.janskys(pixel) {
        Some(jansky) => (jansky, "Jy"),
        None => (pixel * pixel, "W m-2 Hz-1 (D/M)2"),
    };
    let flux_density = mean.iter().map(|light| light * pixels * factor).collect();
    let output = Output { frequency, flux_density, unit };
    if arguments.output.is_empty() {
        return match arguments.format {
            Shape::Json => print_json(&output),
            shape => print(&written(shape, &output, range)?),
        };
    }
    save(&arguments.output, &shapes, |shape| written(shape, &output, range))
}

fn written(shape: Shape, output: &Output, range: [f64; 2]) -> Result<String, Failure> {
    Ok(match shape {
        Shape::Json => serde_json::to_string_pretty(output).map_err(|e| Failure::Failed(e.to_string()))?,
        Shape::Csv => {
            let mut text = format!("frequency_hz,flux_density ({})", output.unit);
            for (frequency, flux) in output.frequency.iter().zip(&output.flux_density) {
                let _ = write!(text, "\n{frequency:e},{flux:e}");
            }
            text
        }
        Shape::Svg => {
            let bins: Vec<f64> =
                output.frequency.iter().zip(&output.flux_density).map(|(a, b)| a * b).collect();
            plot::draw(&Plot {
                title: "continuum of the disk",
                labels: ["frequency ν (Hz)", "νF / peak"],
                range,
                scale: Scale::Logarithmic,
                bins: &bins,
            })
        }
    })
}
