//! `kerrscope shadow`: the critical curve on a distant observer's sky.

use crate::report::Failure;
use crate::{Format, parse_inclination, parse_spin, print, print_json};
use kerrscope::spacetime::kerr::{CriticalCurve, lensing_bands};
use serde::Serialize;

/// Lengths in M on Bardeen's screen: alpha to the right, beta along the projected spin axis.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Example:\n  kerrscope shadow --spin 0.9 --inclination 60 --points 8\n  kerrscope shadow --spin 0.9 --inclination 17 --orders 3 --points 0"
)]
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
    /// Also the lensing bands: where the equatorial plane is seen at the image orders 0 to N
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=6))]
    orders: Option<u32>,
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
    #[serde(skip_serializing_if = "Option::is_none")]
    orders: Option<Vec<Band>>,
}

/// A lensing band. Its curves begin at the smallest alpha and go around over beta > 0.
#[derive(Serialize)]
struct Band {
    order: usize,
    inner: Vec<[f64; 2]>,
    outer: Vec<[f64; 2]>,
    width_mean: Option<f64>,
    width_min: Option<f64>,
    width_max: Option<f64>,
    /// Mean width of the order before over that of this one.
    demagnification: Option<f64>,
}

/// Angles at which the bands are found, unless more points are asked for.
const AROUND: usize = 90;

fn bands(arguments: &Arguments, most: u32) -> Vec<Band> {
    let points = match arguments.points as usize {
        0 => AROUND,
        // Each takes about a hundred rays a point.
        points => points.min(3600),
    };
    let found = lensing_bands(arguments.spin, arguments.inclination.to_radians(), most as usize, points);
    let mut before = None;
    found
        .into_iter()
        .map(|band| {
            let widths = band.widths();
            let known = || widths.iter().copied().filter(|width| width.is_finite());
            let mean = (known().count() > 0).then(|| known().sum::<f64>() / known().count() as f64);
            let demagnification = before.zip(mean).map(|(before, mean): (f64, f64)| before / mean);
            before = mean;
            Band {
                order: band.order,
                inner: band.inner,
                outer: band.outer,
                width_mean: mean,
                width_min: known().reduce(f64::min),
                width_max: known().reduce(f64::max),
                demagnification,
            }
        })
        .collect()
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let curve = CriticalCurve::new(arguments.spin, arguments.inclination.to_radians());
    let extent = curve.extent();
    let points = curve.points(arguments.points as usize);
    let orders = arguments.orders.map(|most| bands(arguments, most));
    if arguments.format == Format::Json {
        return print_json(&Output {
            spin: arguments.spin,
            inclination: arguments.inclination,
            alpha_min: extent.alpha_min,
            alpha_max: extent.alpha_max,
            beta_max: extent.beta_max,
            area: extent.area,
            curve: points,
            orders,
        });
    }
    print(&format!(
        "alpha from {:.9} to {:.9} M\nbeta up to {:.9} M\narea {:.9} M^2",
        extent.alpha_min, extent.alpha_max, extent.beta_max, extent.area
    ))?;
    for band in orders.iter().flatten() {
        let Band { order, width_mean, width_min, width_max, demagnification, .. } = band;
        let (Some(mean), Some(least), Some(most)) = (width_mean, width_min, width_max) else {
            print(&format!("order {order}: from the image of the horizon outwards"))?;
            continue;
        };
        let shrunk = demagnification
            .map_or_else(String::new, |factor| format!(", {factor:.4} times less than before"));
        print(&format!("order {order}: width {mean:.6e} M ({least:.6e} to {most:.6e}){shrunk}"))?;
    }
    for [alpha, beta] in points {
        print(&format!("{alpha:>14.9} {beta:>14.9}"))?;
    }
    Ok(())
}
