//! The program `kerrscope`: pictures of black holes, and the numbers behind them.
//!
//! One file a command. Exit codes: 0 done, 1 a check failed or a file could not be written,
//! 2 the input was wrong, 130 interrupted.

mod bench;
mod fit;
mod line;
mod manual;
mod measure;
mod orbits;
mod plot;
mod progress;
mod render;
mod report;
mod scene;
mod server;
mod shadow;
mod side_view;
mod source;
mod spacetime;
mod spectrum;
mod survey;
mod thesis;
mod trace;
mod validate;
mod view;

use clap::{Parser, Subcommand, ValueEnum};
use kerrscope::spacetime::Level;
use report::Failure;
use std::io::IsTerminal;
use std::process::ExitCode;

/// Pictures of black holes, every pixel along null geodesics of the actual metric.
///
/// Without a command it renders the built-in scene to kerrscope.png.
#[derive(Parser, Debug)]
#[command(name = "kerrscope", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    talk: Talk,
}

/// How much the program says of its work.
#[derive(clap::Args, Clone, Copy, Debug)]
struct Talk {
    /// Say nothing of what is done, only of what goes wrong
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    quiet: bool,
    /// Say on standard error what is done, and how long it takes
    #[arg(short, long, global = true)]
    verbose: bool,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Draw a scene
    Render(render::Arguments),
    /// Open a page in which one flies around a scene
    View(view::Arguments),
    /// Follow one ray
    Trace(trace::Arguments),
    /// Horizon, circular orbits and efficiency of a hole
    Orbits(orbits::Arguments),
    /// The critical curve: the edge of a hole's shadow
    Shadow(shadow::Arguments),
    /// The profile of a spectral line from a disk
    Line(line::Arguments),
    /// The continuum spectrum of a disk of black bodies
    Spectrum(spectrum::Arguments),
    /// What a picture says of a hole and its disk
    Fit(fit::Arguments),
    /// Shadow, ring and disk in a picture, in numbers
    Measure(measure::Arguments),
    /// The tables of the thesis, read off pictures and from exact rays
    Thesis(thesis::Arguments),
    /// Metric, connection, curvature and geodesics of a geometry, in any coordinates
    Spacetime(spacetime::Arguments),
    /// Compute every reference number and compare it with its source
    Validate(validate::Arguments),
    /// Rays per second, and how exact they are
    Bench(bench::Arguments),
    /// Pictures of a scene over ranges of its keys, on one machine or many
    Survey(survey::Arguments),
    /// Check a scene, or print it with every default
    Scene(scene::Arguments),
    /// Print the JSON Schema of scene files
    Schema,
    /// Print a completion script for a shell
    Completions(manual::Completions),
    /// Print the manual page
    Man(manual::Man),
}

/// How results are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For reading
    #[default]
    Text,
    /// For programs
    Json,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if arguments.talk.verbose {
        let colour =
            std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
        tracing_subscriber::fmt().with_writer(std::io::stderr).with_target(false).with_ansi(colour).init();
    }
    let outcome = match arguments.command.unwrap_or(Command::Render(render::Arguments::default())) {
        Command::Render(a) => render::run(&a, arguments.talk.quiet),
        Command::View(a) => view::run(&a),
        Command::Trace(a) => trace::run(&a),
        Command::Orbits(a) => orbits::run(&a),
        Command::Shadow(a) => shadow::run(&a),
        Command::Line(a) => line::run(&a),
        Command::Spectrum(a) => spectrum::run(&a),
        Command::Fit(a) => fit::run(&a, arguments.talk.quiet),
        Command::Measure(a) => measure::run(&a),
        Command::Thesis(a) => thesis::run(&a),
        Command::Spacetime(a) => spacetime::run(&a),
        Command::Survey(a) => survey::run(&a, arguments.talk.quiet),
        Command::Validate(a) => validate::run(&a),
        Command::Bench(a) => bench::run(&a),
        Command::Scene(a) => scene::run(&a),
        Command::Schema => manual::schema(),
        Command::Completions(a) => manual::completions(&a),
        Command::Man(a) => manual::man(&a),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}

/// Prints to standard output; a reader that has gone away is no fault.
fn print(text: &str) -> Result<(), Failure> {
    use std::io::{ErrorKind, Write};
    match writeln!(std::io::stdout().lock(), "{text}") {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::Failed(format!("standard output: {e}"))),
        _ => Ok(()),
    }
}

/// Prints a value as JSON.
fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|e| Failure::Failed(e.to_string()))?;
    print(&text)
}

/// A spin in [−1, 1], from the command line.
fn parse_spin(text: &str) -> Result<f64, String> {
    let spin: f64 = text.parse().map_err(|_| "give a number from -1 to 1".to_owned())?;
    if (-1.0..=1.0).contains(&spin) { Ok(spin) } else { Err("a spin lies between -1 and 1".to_owned()) }
}

/// A level of vector instructions that this processor has, from the command line.
fn parse_level(text: &str) -> Result<Level, String> {
    let names: Vec<&str> = Level::ALL.into_iter().filter(|l| l.is_available()).map(Level::name).collect();
    match Level::named(text) {
        Some(level) if level.is_available() => Ok(level),
        Some(_) => Err(format!("this processor does not have it: give {}", names.join(" or "))),
        None => Err(format!("no instructions are called so: give {}", names.join(" or "))),
    }
}

/// An inclination in degrees, from the command line.
fn parse_inclination(text: &str) -> Result<f64, String> {
    let degrees: f64 = text.parse().map_err(|_| "give degrees from 0 to 180".to_owned())?;
    if (0.0..=180.0).contains(&degrees) {
        Ok(degrees)
    } else {
        Err("an inclination lies between 0 and 180 degrees".to_owned())
    }
}

/// A finite number, from the command line.
fn parse_finite(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err("give a finite number".to_owned()),
    }
}

/// A distance in M, from the command line; may be infinite.
fn parse_distance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 => Ok(x),
        _ => Err("give a positive number of M, or inf".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}
