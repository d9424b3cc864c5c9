//! `kerrscope thesis`: the tables of Kamminga's thesis again, with exact rays.

use crate::report::Failure;
use crate::{Format, parse_finite, print, print_json};
use kerrscope::measure::{Fit, Part, Reading, Repeat, Series, Setting};
use serde::Serialize;

/// Reads the lengths of Kamminga's "Imaging a Kerr Black Hole" (2022), chapter 5, off pictures and from single rays.
///
/// The thesis does not say from where and how large its pictures are: give what you think, and compare the ratios.
#[derive(clap::Args, Debug)]
#[command(
    after_long_help = "Lengths are in pixels. JSON: rows of { parameter (spin, or inclination in degrees), exact and measured { centre, left r-, \
    right r+, below h }, ratio (of exact), thesis [r-, r+] or [h, r+] in its own pixels, thesis_ratio }; fit and thesis_fit { slope, slope_error, \
    intercept, intercept_error, largest_residual } of the ratio by the parameter; sensitivity { edge, distance }, the derivatives of the last \
    row's ratio, per M; inverse [parameter, error] for --ratio.\n\n\
    Examples:\n  kerrscope thesis spins\n  kerrscope thesis inclinations --exact\n  \
    kerrscope thesis spins --exact --ratio 0.505 --ratio-error 0.001\n  \
    kerrscope thesis spins --exact --step 1.5\n  kerrscope thesis spins --exact --as-thesis\n  \
    kerrscope thesis inclinations --exact --as-thesis=step,sheet,start --distance 10"
)]
pub struct Arguments {
    /// Which table
    #[arg(value_enum)]
    table: Table,
    /// Where the disk ends, in M
    #[arg(long, value_name = "M", default_value_t = 6.0, value_parser = parse_finite)]
    edge: f64,
    /// Distance of the observer, in M
    #[arg(long, value_name = "M", default_value_t = 30.0, value_parser = parse_finite)]
    distance: f64,
    /// Height of the picture, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 50.0, value_parser = parse_finite)]
    field: f64,
    /// Width and height of the picture, in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 800, value_parser = clap::value_parser!(u32).range(50..=4096))]
    size: u32,
    /// Rays in each pixel
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=1024))]
    samples: u32,
    /// Only from single rays: draw no pictures
    #[arg(long)]
    exact: bool,
    /// Follow rays by RK4 with this constant step in M, as the thesis does with 1.5; only from single rays
    #[arg(long, value_name = "M", value_parser = parse_finite, requires = "exact")]
    step: Option<f64>,
    /// Beside it, repeat the thesis's way of following rays, part by part, and say how much of the difference each explains
    #[arg(long, value_name = "PARTS", value_enum, value_delimiter = ',', num_args = 0.., require_equals = true)]
    as_thesis: Option<Vec<Way>>,
    /// A ratio, r-/(r- + r+) or h/r+, for which the spin or the inclination is wanted
    #[arg(long, value_name = "RATIO", value_parser = parse_finite)]
    ratio: Option<f64>,
    /// The error of that ratio
    #[arg(long, value_name = "ERROR", default_value_t = 0.0, value_parser = parse_finite, requires = "ratio")]
    ratio_error: f64,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Table {
    /// r- and r+ by spin, edge-on
    Spins,
    /// h and r+ by inclination, without spin
    Inclinations,
}

/// A part of the thesis's manner.
#[derive(clap::ValueEnum, Clone, Copy, Debug)]
enum Way {
    /// RK4 in place and velocity with steps of 1.5 M
    Step,
    /// Chords between the ends of steps
    Chords,
    /// Ingoing coordinates with the real spin
    Sheet,
    /// Velocity 1 at the start, not null
    Start,
    /// Hole and disk by Cartesian radius
    Bodies,
}

impl Way {
    const fn part(self) -> Part {
        match self {
            Self::Step => Part::Step,
            Self::Chords => Part::Chords,
            Self::Sheet => Part::Sheet,
            Self::Start => Part::Start,
            Self::Bodies => Part::Bodies,
        }
    }
}

#[derive(Serialize)]
struct Output {
    rows: Vec<Reading>,
    fit: Option<Fit>,
    thesis_fit: Option<Fit>,
    sensitivity: Sensitivity,
    #[serde(skip_serializing_if = "Option::is_none")]
    inverse: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    as_thesis: Vec<Repeat>,
}

#[derive(Serialize)]
struct Sensitivity {
    edge: f64,
    distance: f64,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let series = match arguments.table {
        Table::Spins => Series::Spins,
        Table::Inclinations => Series::Inclinations,
    };
    let base = Setting {
        edge: arguments.edge,
        distance: arguments.distance,
        field: arguments.field,
        size: [arguments.size; 2],
        samples: arguments.samples,
        step: arguments.step,
        ..Setting::default()
    };
    let output = calculate(arguments, series, base).map_err(Failure::Input)?;
    match arguments.format {
        Format::Json => print_json(&output),
        Format::Text => print(report(series, &output).trim_end()),
    }
}

fn calculate(arguments: &Arguments, series: Series, base: Setting) -> Result<Output, String> {
    let rows = series.table(base, !arguments.exact)?;
    let points =
        |ratio: fn(&Reading) -> f64| rows.iter().map(|row| [row.parameter, ratio(row)]).collect::<Vec<_>>();
    let last = series.at(rows.last().map_or(0.0, |row| row.parameter), base);
    let sensitivity = Sensitivity {
        edge: series.derivative(last, 0.01, |s, by| Setting { edge: s.edge + by, ..s })?,
        distance: series.derivative(last, 0.05, |s, by| Setting { distance: s.distance + by, ..s })?,
    };
    let inverse =
        arguments.ratio.map(|ratio| series.invert(ratio, arguments.ratio_error.abs(), base)).transpose()?;
    let (fit, thesis_fit) = (Fit::of(&points(|row| row.ratio)), Fit::of(&points(|row| row.thesis_ratio)));
    let parts: Vec<Part> = match arguments.as_thesis.as_deref() {
        None => Vec::new(),
        Some([]) => Part::ALL.to_vec(),
        Some(ways) => ways.iter().map(|way| way.part()).collect(),
    };
    let as_thesis = series.repeats(&rows, base, &parts);
    Ok(Output { rows, fit, thesis_fit, sensitivity, inverse, as_thesis })
}

fn report(series: Series, output: &Output) -> String {
    let (name, first, ratio) = match series {
        Series::Spins => ("spin", "r-", "r-/(r-+r+)"),
        Series::Inclinations => ("degrees", "h", "h/r+"),
    };
    let pair = |lengths: &kerrscope::measure::Lengths| match series {
        Series::Spins => [lengths.left, lengths.right],
        Series::Inclinations => [lengths.below, lengths.right],
    };
    let mut lines = vec![format!(
        "{name:>8} | rays {first:>6} {:>9} {ratio:>10} | picture {first:>4} {:>9} | thesis {first:>3} {:>4} {ratio:>10}",
        "r+", "r+", "r+"
    )];
    for row in &output.rows {
        let [a, b] = pair(&row.exact);
        let drawn = row.measured.as_ref().map_or_else(
            || format!("{:>12} {:>9}", "-", "-"),
            |lengths| {
                let [a, b] = pair(lengths);
                format!("{a:>12.3} {b:>9.3}")
            },
        );
        lines.push(format!(
            "{:>8.3} | {a:>11.3} {b:>9.3} {:>10.5} | {drawn} | {:>10} {:>4} {:>10.4}",
            row.parameter, row.ratio, row.thesis[0], row.thesis[1], row.thesis_ratio
        ));
    }
    for (who, fit) in [("here", output.fit), ("thesis", output.thesis_fit)] {
        if let Some(fit) = fit {
            lines.push(format!(
                "straight line, {who}: ({:.5} +- {:.5}) + ({:.6} +- {:.6}) x {name}, furthest point {:.5} off",
                fit.intercept, fit.intercept_error, fit.slope, fit.slope_error, fit.largest_residual
            ));
        }
    }
    lines.extend(repeated(name, output));
    lines.push(format!(
        "the last ratio changes by {:+.5} for each M of the disk's edge and {:+.6} for each M of distance",
        output.sensitivity.edge, output.sensitivity.distance
    ));
    if let Some([value, error]) = output.inverse {
        lines.push(format!("the ratio given has {name} {value:.5} +- {error:.5}"));
    }
    lines.join("\n")
}

/// The table in the thesis's manner, and what each of its parts explains.
fn repeated(name: &str, output: &Output) -> Vec<String> {
    let (Some(fit), Some(thesis_fit), Some(last)) = (output.fit, output.thesis_fit, output.as_thesis.last())
    else {
        return Vec::new();
    };
    let mut lines =
        vec![String::new(), "in the thesis's manner, its parts added one after another".to_owned()];
    let heads: Vec<String> = output.rows.iter().map(|row| format!("{:>8.3}", row.parameter)).collect();
    lines.push(format!("{:<34} | {} |    slope  explains  rms off", name, heads.join(" ")));
    let row = |words: &str, ratios: Vec<Option<f64>>, rest: String| {
        let cell =
            |ratio: Option<f64>| ratio.map_or_else(|| format!("{:>8}", "-"), |ratio| format!("{ratio:>8.4}"));
        format!("{words:<34} | {} | {rest}", ratios.into_iter().map(cell).collect::<Vec<_>>().join(" "))
    };
    let slope = |fit: Fit| format!("{:>8.5}", fit.slope);
    lines.push(row("exact", output.rows.iter().map(|r| Some(r.ratio)).collect(), slope(fit)));
    for repeat in &output.as_thesis {
        let fit = repeat.fit.map_or_else(|| format!("{:>8}", "-"), slope);
        let share = repeat
            .explains
            .map_or_else(|| format!("{:>8}", "-"), |share| format!("{:>6.1} %", 100.0 * share));
        let off = repeat.off.map_or_else(|| "-".to_owned(), |off| format!("{off:.4}"));
        let words = format!("+ {}", repeat.adds.words());
        lines.push(row(&words, repeat.ratios.clone(), format!("{fit}  {share}  {off:>7}")));
    }
    lines.push(row("thesis", output.rows.iter().map(|r| Some(r.thesis_ratio)).collect(), slope(thesis_fit)));
    if let Some(share) = last.explains {
        lines.push(format!(
            "these parts together explain {:.0} % of the difference between the thesis's slope and that of exact rays",
            100.0 * share
        ));
    }
    lines.push(String::new());
    lines
}
