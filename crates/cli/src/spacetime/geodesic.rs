//! A geodesic from initial values.

use super::numbers::{Numbers, parse_numbers, show};
use super::{Context, Shape, drawing};
use crate::report::Failure;
use crate::{print, print_json};
use clap::ValueEnum;
use kerrscope::spacetime::geometry::{self, End, Geometry, Kind, Options, Point, Trajectory, conserved};
use serde_json::json;
use std::fmt::Write;

#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// Where it starts: its coordinates
    #[arg(long, value_name = "X,Y,…", value_parser = parse_numbers, allow_hyphen_values = true)]
    from: Numbers,
    /// Its velocity: derivatives of the coordinates with respect to proper time, proper length or the affine
    /// parameter; that of time may be left out, and is computed for light and bodies
    #[arg(long, value_name = "U,V,…", value_parser = parse_numbers, allow_hyphen_values = true)]
    velocity: Numbers,
    /// What moves along it [default: timelike in spacetime, spacelike in space]
    #[arg(long, value_enum)]
    kind: Option<KindName>,
    /// How far: proper time or length, or affine parameter of light; backwards if negative
    #[arg(long, value_name = "S", value_parser = super::numbers::parse_number, allow_hyphen_values = true)]
    length: f64,
    /// Points to print [default: 11 as text, 1000 else]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    points: Option<u32>,
    /// Bound on the error of an integration step
    #[arg(long, value_name = "E", value_parser = parse_tolerance, default_value = "1e-12")]
    tolerance: f64,
    /// Steps after which it is given up
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=200_000), default_value_t = 100_000)]
    max_steps: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum KindName {
    /// Light
    Null,
    /// A body
    Timelike,
    /// A line in space
    Spacelike,
}

fn parse_tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (4e-14..=1e-3).contains(&x) => Ok(x),
        _ => Err("give a number from 4e-14 to 1e-3".to_owned()),
    }
}

pub fn run<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    arguments: &Arguments,
    format: Shape,
) -> Result<(), Failure> {
    let x = context.regular_point("--from", &arguments.from)?;
    let usual = if context.has_time() { KindName::Timelike } else { KindName::Spacelike };
    let kind = match arguments.kind.unwrap_or(usual) {
        KindName::Null => Kind::Null,
        KindName::Timelike => Kind::Timelike,
        KindName::Spacelike => Kind::Spacelike,
    };
    let mut typed = arguments.velocity.clone();
    if context.has_time() && typed.0.len() + 1 == N {
        typed.0.insert(0, 0.0);
    }
    let v = context.point("--velocity", &typed)?;
    let v = geometry::velocity(context.geometry, &x, &v, kind)
        .map_err(|e| Failure::Input(format!("--from and --velocity: {e}")))?;
    let options = Options { tolerance: arguments.tolerance, max_steps: arguments.max_steps as usize };
    let way = Trajectory::follow(context.geometry, &x, &v, arguments.length, &options);
    let usual = if format == Shape::Text { 11 } else { 1000 };
    let points = way.points(context.geometry, arguments.points.unwrap_or(usual) as usize);
    match format {
        Shape::Csv => print(&csv(context, &points)),
        Shape::Svg => print(&drawing::draw(context, &points, &title(context, kind, &way))),
        Shape::Text => print(&text(context, kind, &way, &points)),
        Shape::Json => {
            let mut about = context.about();
            let list: Vec<_> = points
                .iter()
                .map(|p| json!({ "parameter": p.parameter, "x": p.x.to_vec(), "velocity": p.velocity.to_vec() }))
                .collect();
            let constants: Vec<_> = constants(context, &way)
                .into_iter()
                .map(|(name, start, drift)| json!({ "name": name, "value": start, "drift": drift }))
                .collect();
            about.insert("kind".to_owned(), name(kind).into());
            about.insert("end".to_owned(), way.end.name().into());
            about.insert("length".to_owned(), way.parameter().into());
            about.insert("steps".to_owned(), way.steps.into());
            about.insert("conserved".to_owned(), constants.into());
            about.insert("points".to_owned(), list.into());
            print_json(&about)
        }
    }
}

fn name(kind: Kind) -> &'static str {
    match kind {
        Kind::Null => "null",
        Kind::Timelike => "timelike",
        Kind::Spacelike => "spacelike",
    }
}

/// Name, value at the start, and largest difference from it over a hundred points.
fn constants<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    way: &Trajectory<N>,
) -> Vec<(String, f64, f64)> {
    let at = |share: f64| {
        let (x, p) = way.state(way.parameter() * share);
        conserved(context.geometry, &x, &p)
    };
    let mut all: Vec<(String, f64, f64)> =
        at(0.0).into_iter().map(|(name, value)| (name, value, 0.0)).collect();
    for i in 1..=100 {
        let now = at(f64::from(i) / 100.0);
        for (name, value, drift) in &mut all {
            if let Some((_, later)) = now.iter().find(|(n, _)| n == name) {
                *drift = drift.max((later - *value).abs());
            }
        }
    }
    all
}

fn csv<G: Geometry<N>, const N: usize>(context: &Context<'_, G, N>, points: &[Point<N>]) -> String {
    let names = context.names();
    let mut text = format!("parameter,{},d_{}", names.join(","), names.join(",d_"));
    for p in points {
        let _ = write!(text, "\n{}", p.parameter);
        for c in p.x.iter().chain(&p.velocity) {
            let _ = write!(text, ",{c}");
        }
    }
    text
}

fn title<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    kind: Kind,
    way: &Trajectory<N>,
) -> String {
    let parameters: Vec<String> = context
        .geometry
        .parameters()
        .into_iter()
        .map(|(name, value)| format!(", {name} {}", show(value)))
        .collect();
    format!(
        "{}{}: {} geodesic, length {}, {}",
        context.geometry.name(),
        parameters.concat(),
        name(kind),
        show(way.parameter()),
        ending(way.end)
    )
}

fn ending(end: End) -> &'static str {
    match end {
        End::Complete => "complete",
        End::Edge => "ended where the coordinates end",
        End::Singular => "ended at a singularity",
        End::StepLimit => "given up: too many steps",
    }
}

fn text<G: Geometry<N>, const N: usize>(
    context: &Context<'_, G, N>,
    kind: Kind,
    way: &Trajectory<N>,
    points: &[Point<N>],
) -> String {
    let mut text = format!("{} ({} steps)\n", title(context, kind, way), way.steps);
    for (name, value, drift) in constants(context, way) {
        let _ = writeln!(text, "{name:<8} {:>20}   kept to {drift:.1e}", show(value));
    }
    let _ = write!(text, "{:>18}", "parameter");
    for name in context.names() {
        let _ = write!(text, "{name:>18}");
    }
    for p in points {
        let _ = write!(text, "\n{:>18}", show(p.parameter));
        for c in p.x {
            let _ = write!(text, "{:>18}", show(c));
        }
    }
    text
}
