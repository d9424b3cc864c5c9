//! `kerrscope thesis`: the tables of Kamminga's thesis again, with exact rays.

use crate::report::Failure;
use crate::{Format, parse_finite, print, print_json};
use kerrscope::measure::{Fit, Reading, Series, Setting};
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
    kerrscope thesis spins --exact --step 1.5"
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

#[derive(Serialize)]
struct Output {
    rows: Vec<Reading>,
    fit: Option<Fit>,
    thesis_fit: Option<Fit>,
    sensitivity: Sensitivity,
    #[serde(skip_serializing_if = "Option::is_none")]
    inverse: Option<[f64; 2]>,
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
    Ok(Output { rows, fit, thesis_fit, sensitivity, inverse })
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
    lines.push(format!(
        "the last ratio changes by {:+.5} for each M of the disk's edge and {:+.6} for each M of distance",
        output.sensitivity.edge, output.sensitivity.distance
    ));
    if let Some([value, error]) = output.inverse {
        lines.push(format!("the ratio given has {name} {value:.5} +- {error:.5}"));
    }
    lines.join("\n")
}
