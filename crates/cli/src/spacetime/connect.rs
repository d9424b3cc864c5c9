//! Geodesics between points, and lengths of curves.

use super::Context;
use super::numbers::{Numbers, parse_numbers, show};
use crate::report::Failure;
use crate::{Format, print, print_json};
use kerrscope::spacetime::geometry::{self, Connected, Geometry, Search, polyline};
use serde_json::json;
use std::fmt::Write;
use std::path::PathBuf;

#[derive(clap::Args, Debug)]
pub struct Between {
    /// The first point
    #[arg(long, value_name = "X,Y,…", value_parser = parse_numbers, allow_hyphen_values = true)]
    from: Numbers,
    /// The second point
    #[arg(long, value_name = "X,Y,…", value_parser = parse_numbers, allow_hyphen_values = true)]
    to: Numbers,
    /// Turns around an axis to try in either sense
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=20), default_value_t = 1)]
    turns: u32,
}

#[derive(clap::Args, Debug)]
pub struct Through {
    /// A point of the curve; give two or more, in their order
    #[arg(long, value_name = "X,Y,…", value_parser = parse_numbers, allow_hyphen_values = true)]
    through: Vec<Numbers>,
    /// A file with the points of the curve, one a line, numbers with commas between them; a first line
    /// that begins with a letter is left out
    #[arg(long, value_name = "FILE", conflicts_with = "through")]
    curve: Option<PathBuf>,
}

pub fn between<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    arguments: &Between,
    format: Format,
) -> Result<(), Failure> {
    let from = context.regular_point("--from", &arguments.from)?;
    let to = context.regular_point("--to", &arguments.to)?;
    let search = Search { turns: arguments.turns, ..Search::default() };
    let found = geometry::between(context.geometry, &from, &to, &search)
        .map_err(|e| Failure::Failed(e.to_string()))?;
    if format == Format::Json {
        let list: Vec<_> = found
            .iter()
            .map(|c| {
                json!({
                    "character": character(c), "length": c.length(), "velocity": c.velocity.to_vec(),
                    "end": c.end.to_vec(), "miss": c.miss, "conjugate": c.conjugate,
                })
            })
            .collect();
        let mut about = context.about();
        about.insert("geodesics".to_owned(), list.into());
        return print_json(&about);
    }
    let lines: Vec<String> = found
        .iter()
        .map(|c| {
            let mut line = match character(c) {
                "null" => "null".to_owned(),
                character => format!("{character}, length {}", show(c.length())),
            };
            let velocity: Vec<String> = c.velocity.iter().map(|v| show(*v)).collect();
            let end: Vec<String> = c.end.iter().map(|v| show(*v)).collect();
            let _ = write!(
                line,
                "\n  leaves with velocity {} (parameter 0 to 1)\n  ends at {}, off by {:.1e}",
                velocity.join(","),
                end.join(","),
                c.miss
            );
            if c.conjugate {
                line.push_str(
                    "\n  the points are conjugate: it is one of a family of geodesics between them",
                );
            }
            line
        })
        .collect();
    print(&lines.join("\n"))
}

/// Null as far as the digits go.
fn character<const N: usize>(c: &Connected<N>) -> &'static str {
    let size: f64 = c.velocity.iter().map(|v| v * v).sum();
    match c.norm {
        n if n.abs() <= 1e-10 * size => "null",
        n if n < 0.0 => "timelike",
        _ => "spacelike",
    }
}

pub fn length<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    arguments: &Through,
    format: Format,
) -> Result<(), Failure> {
    let points = match &arguments.curve {
        Some(file) => read(context, file)?,
        None => {
            arguments.through.iter().map(|p| context.point("--through", p)).collect::<Result<Vec<_>, _>>()?
        }
    };
    if points.len() < 2 {
        return Err(Failure::Input(
            "a curve goes through two points or more: give --through for each, or --curve FILE".to_owned(),
        ));
    }
    let found = polyline(context.geometry, &points);
    if !(found.spacelike.is_finite() && found.timelike.is_finite()) {
        return Err(Failure::Input(
            "the curve goes through a singularity of the metric, and has no length".to_owned(),
        ));
    }
    if format == Format::Json {
        let mut about = context.about();
        about.insert("length".to_owned(), found.spacelike.into());
        about.insert("proper_time".to_owned(), found.timelike.into());
        about.insert("error_estimate".to_owned(), found.error.into());
        return print_json(&about);
    }
    let time =
        if context.has_time() { format!("\nproper time    {}", show(found.timelike)) } else { String::new() };
    print(&format!("proper length  {}{time}\nerror about    {:.1e}", show(found.spacelike), found.error))
}

/// Largest file and most points that are read.
const MOST_BYTES: u64 = 64 << 20;
const MOST_POINTS: usize = 1_000_000;

fn read<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    file: &std::path::Path,
) -> Result<Vec<[f64; N]>, Failure> {
    let name = file.display();
    let wrong = |what: String| Failure::Input(format!("{name}: {what}"));
    let about = std::fs::metadata(file).map_err(|e| wrong(e.to_string()))?;
    if !about.is_file() || about.len() > MOST_BYTES {
        return Err(wrong(format!("give a regular file of at most {} MiB", MOST_BYTES >> 20)));
    }
    let text = std::fs::read_to_string(file).map_err(|e| wrong(e.to_string()))?;
    let mut points = Vec::new();
    let mut faults = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let heading = number == 0 && line.trim_start().starts_with(|c: char| c.is_alphabetic());
        if line.trim().is_empty() || (heading && !line.trim_start().starts_with("pi")) {
            continue;
        }
        let at = format!("line {}", number + 1);
        match parse_numbers(line).map_err(Failure::Input).and_then(|p| context.point(&at, &p)) {
            Ok(point) => points.push(point),
            Err(Failure::Input(what)) if what.starts_with("line") => faults.push(what),
            Err(Failure::Input(what)) => faults.push(format!("{at}: {what}")),
            Err(other) => return Err(other),
        }
        if points.len() > MOST_POINTS || faults.len() == 20 {
            break;
        }
    }
    if points.len() > MOST_POINTS {
        faults.push(format!("more than {MOST_POINTS} points"));
    }
    if faults.is_empty() { Ok(points) } else { Err(wrong(faults.join(&format!("\nerror: {name}: ")))) }
}
