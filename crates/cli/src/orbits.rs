//! `kerrscope orbits`: the radii at which circular orbits change their nature.

use crate::report::Failure;
use crate::{Format, parse_spin, print, print_json};
use kerrscope::spacetime::kerr::Orbits;
use serde::Serialize;

/// Orbits about +z; for a negative spin these are retrograde.
#[derive(clap::Args, Debug)]
#[command(after_help = "Example:\n  kerrscope orbits --spin 0.9")]
pub struct Arguments {
    /// Spin a, from -1 to 1
    #[arg(long, value_name = "A", value_parser = parse_spin, allow_hyphen_values = true)]
    spin: f64,
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Serialize)]
struct Output {
    spin: f64,
    horizon: f64,
    isco: f64,
    isco_retrograde: f64,
    photon_prograde: f64,
    photon_retrograde: f64,
    impact_prograde: f64,
    impact_retrograde: f64,
    efficiency: f64,
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let o = Orbits::new(arguments.spin);
    if arguments.format == Format::Json {
        return print_json(&Output {
            spin: arguments.spin,
            horizon: o.horizon,
            isco: o.isco,
            isco_retrograde: o.isco_retrograde,
            photon_prograde: o.photon_prograde,
            photon_retrograde: o.photon_retrograde,
            impact_prograde: o.impact_prograde,
            impact_retrograde: o.impact_retrograde,
            efficiency: o.efficiency,
        });
    }
    print(&format!(
        "Spin {}; lengths in M; orbits in the equatorial plane\n\
         \x20                         about +z       about -z\n\
         outer horizon         {:>12.9}\n\
         last stable orbit     {:>12.9}   {:>12.9}\n\
         photon orbit          {:>12.9}   {:>12.9}\n\
         its impact parameter  {:>12.9}   {:>12.9}\n\
         efficiency 1 - E      {:>12.9}",
        arguments.spin,
        o.horizon,
        o.isco,
        o.isco_retrograde,
        o.photon_prograde,
        o.photon_retrograde,
        o.impact_prograde,
        o.impact_retrograde,
        o.efficiency
    ))
}
