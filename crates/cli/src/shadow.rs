//! `kerrscope shadow`: the critical curve on a distant observer's sky.

use crate::report::Failure;
use crate::{Format, parse_inclination, parse_spin, print, print_json};
use kerrscope::spacetime::kerr::CriticalCurve;
use serde::Serialize;

/// Lengths in M on Bardeen's screen: alpha to the right, beta along the projected spin axis.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:\n  kerrscope shadow --spin 0.9 --inclination 60 --points 8")]
pub struct Arguments {
    /// Spin a, from -1 to 1
    #[arg(long, value_name = "A", value_parser = parse_spin, allow_hyphen_values = true)]
    spin: f64,
    /// Inclination in degrees, 0 for face-on
    #[arg(long, value_name = "DEG", value_parser = parse_inclination)]
    inclination: f64,
    /// Points of the curve to print
    #[arg(long, value_name = "N", default_value_t = 360, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    points: u32,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Serialize)]
struct Output {
    spin: f64,
    inclination: f64,
    alpha_min: f64,
    alpha_max: f64,
    beta_max: f64,
    area: f64,
    curve: Vec<[f64; 2]>,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let curve = CriticalCurve::new(arguments.spin, arguments.inclination.to_radians());
    let extent = curve.extent();
    let points = curve.points(arguments.points as usize);
    if arguments.format == Format::Json {
        return print_json(&Output {
            spin: arguments.spin,
            inclination: arguments.inclination,
            alpha_min: extent.alpha_min,
            alpha_max: extent.alpha_max,
            beta_max: extent.beta_max,
            area: extent.area,
            curve: points,
        });
    }
    print(&format!(
        "alpha from {:.9} to {:.9} M\nbeta up to {:.9} M\narea {:.9} M^2",
        extent.alpha_min, extent.alpha_max, extent.beta_max, extent.area
    ))?;
    for [alpha, beta] in points {
        print(&format!("{alpha:>14.9} {beta:>14.9}"))?;
    }
    Ok(())
}
