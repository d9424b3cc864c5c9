//! `kerrscope line`: the profile of a spectral line from a disk around a Kerr hole.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use kerrscope::display::chart::Scale;
use kerrscope::line::{Emissivity, Line, Profile, tracer};
use serde::Serialize;

use crate::plot::{self, Plot, Shape, save, shapes};
use crate::report::Failure;
use crate::{parse_inclination, parse_spin, print, print_json};

/// Flux against g = ν observed/ν sent, for an observer at infinity: photons per frequency, ∫ g³ ε(r) δ(g − g(α, β)) dα dβ.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "The disk lies in the equatorial plane, its matter turns about +z (a negative spin goes against it), and within\n\
    the last stable orbit it falls. It is transparent to its own light: image orders add up.\n\n\
    Examples:\n  \
    kerrscope line --spin 0.998 --inclination 40 --outer 400 > line.csv\n  \
    kerrscope line --spin 0.5 --inclination 30 --inner 4.5 --outer 15 --emissivity 2 -o line.svg\n  \
    kerrscope line --spin 0.9 --inclination 75 --emissivity table.csv --orders 0,1 --format json"
)]
pub struct Arguments {
    /// Spin a, from -1 to 1
    #[arg(long, value_name = "A", value_parser = parse_spin, allow_hyphen_values = true)]
    spin: f64,
    /// Inclination in degrees, 0 for face-on; not 90
    #[arg(long, value_name = "DEG", value_parser = parse_inclination)]
    inclination: f64,
    /// Inner radius in M, or isco
    #[arg(long, value_name = "R", default_value = "isco", value_parser = parse_inner)]
    inner: Inner,
    /// Outer radius in M
    #[arg(long, value_name = "R", default_value_t = 400.0, value_parser = crate::parse_finite)]
    outer: f64,
    /// q of an emissivity r^-q, or a file of lines "radius, emissivity"
    #[arg(long, value_name = "Q|FILE", default_value = "3", allow_hyphen_values = true)]
    emissivity: String,
    /// Bins of g
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    bins: u32,
    /// Range of g; that of the line if not given
    #[arg(long, value_name = "FROM,TO", value_delimiter = ',', num_args = 1)]
    range: Vec<f64>,
    /// Image orders to add up: 0 is the direct image
    #[arg(long, value_name = "N,N,…", value_delimiter = ',', default_value = "0")]
    orders: Vec<usize>,
    /// What traces the rays
    #[arg(long, value_enum, default_value_t)]
    engine: Engine,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Shape,
    /// Files to write instead; their endings say how: .svg, .csv or .json
    #[arg(short, long, value_name = "FILE")]
    output: Vec<PathBuf>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Engine {
    /// Elliptic integrals
    #[default]
    ClosedForm,
    /// The equations of motion, step by step
    Integrator,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Inner {
    Isco,
    Radius(f64),
}

fn parse_inner(text: &str) -> Result<Inner, String> {
    match text.parse::<f64>() {
        _ if text == "isco" => Ok(Inner::Isco),
        Ok(r) if r.is_finite() && r > 0.0 => Ok(Inner::Radius(r)),
        _ => Err("give a radius in M, or isco".to_owned()),
    }
}

/// Larger files are no tables of emissivity.
const LARGEST_TABLE: u64 = 16 << 20;

#[derive(Serialize)]
struct Output<'a> {
    spin: f64,
    inclination: f64,
    inner: f64,
    outer: f64,
    emissivity: &'a str,
    orders: &'a [usize],
    engine: &'static str,
    /// Least and largest g of the line.
    edges: [f64; 2],
    /// Ends of the first and the last bin.
    range: [f64; 2],
    /// Middles of the bins.
    g: Vec<f64>,
    /// Mean of F(g) in each, M² per unit of emissivity.
    flux: &'a [f64],
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let shapes = shapes(&arguments.output)?;
    let range = match arguments.range[..] {
        [] => None,
        [from, to] => Some([from, to]),
        _ => return Err(Failure::Input("--range takes two numbers: --range 0.2,1.2".to_owned())),
    };
    let line = Line {
        spin: arguments.spin,
        inclination: arguments.inclination.to_radians(),
        inner: match arguments.inner {
            Inner::Isco => Line::isco(arguments.spin),
            Inner::Radius(r) => r,
        },
        outer: arguments.outer,
        emissivity: emissivity(&arguments.emissivity)?,
        orders: arguments.orders.clone(),
    };
    let tracer = tracer(line.spin, arguments.engine == Engine::Integrator);
    let profile =
        line.profile(&*tracer, arguments.bins as usize, range).map_err(|e| Failure::Input(e.to_string()))?;
    let output = Output {
        spin: line.spin,
        inclination: arguments.inclination,
        inner: line.inner,
        outer: line.outer,
        emissivity: &arguments.emissivity,
        orders: &line.orders,
        engine: tracer.name(),
        edges: profile.edges,
        range: profile.range,
        g: (0..profile.flux.len()).map(|bin| profile.middle(bin)).collect(),
        flux: &profile.flux,
    };
    if arguments.output.is_empty() {
        return match arguments.format {
            Shape::Json => print_json(&output),
            shape => print(&written(shape, &output, &profile)?),
        };
    }
    save(&arguments.output, &shapes, |shape| written(shape, &output, &profile))
}

/// A power, or the table in a file.
fn emissivity(text: &str) -> Result<Emissivity, Failure> {
    if let Ok(q) = text.parse::<f64>() {
        return if q.is_finite() && q.abs() <= 100.0 {
            Ok(Emissivity::Power(q))
        } else {
            Err(Failure::Input(format!("--emissivity {text}: give an exponent from -100 to 100")))
        };
    }
    let path = Path::new(text);
    let failed = |what: String| Failure::Input(format!("--emissivity {text}: {what}"));
    let size = std::fs::metadata(path).map_err(|e| {
        failed(format!("neither a number nor a file that can be read ({e}); give q of r^-q, or a file"))
    })?;
    if size.len() > LARGEST_TABLE {
        return Err(failed("the file is too large for a table; give at most 16 MB".to_owned()));
    }
    let text = std::fs::read_to_string(path).map_err(|e| failed(e.to_string()))?;
    Emissivity::read(&text)
        .map_err(|faults| failed(faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n  ")))
}

fn written(shape: Shape, output: &Output<'_>, profile: &Profile) -> Result<String, Failure> {
    Ok(match shape {
        Shape::Json => serde_json::to_string_pretty(output).map_err(|e| Failure::Failed(e.to_string()))?,
        Shape::Csv => csv(output),
        Shape::Svg => plot::draw(&Plot {
            title: &title(output),
            labels: ["g = ν observed / ν sent", "flux / peak"],
            range: profile.range,
            scale: Scale::Linear,
            bins: &profile.flux,
        }),
    })
}

fn csv(output: &Output<'_>) -> String {
    let mut text = "g,flux".to_owned();
    for (g, flux) in output.g.iter().zip(output.flux) {
        let _ = write!(text, "\n{g},{flux:e}");
    }
    text
}

fn title(output: &Output<'_>) -> String {
    let orders: Vec<String> = output.orders.iter().map(usize::to_string).collect();
    let orders =
        if output.orders == [0] { String::new() } else { format!(", orders {}", orders.join(" + ")) };
    let emissivity = if output.emissivity.parse::<f64>().is_ok() {
        format!("ε ∝ r^−{}", output.emissivity)
    } else {
        "ε of a table".to_owned()
    };
    format!(
        "a = {}, i = {}°, r from {:.4} to {} M, {emissivity}{orders}",
        output.spin, output.inclination, output.inner, output.outer
    )
}
