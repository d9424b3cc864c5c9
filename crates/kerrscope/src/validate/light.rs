//! Colours of black bodies, and what M is on the sky.

use super::Check;
use crate::spectrum::{observer, planck};
use crate::units::Units;

const LOCUS: &str =
    "Planckian locus, CIE 1931 2° observer: its data every nanometre (doi 10.25039/CIE.DS.xvudnb9b)";
const SCALES: &str = "GM/(c²D) with the nominal solar mass parameter (IAU 2015 B3)";

/// Temperature in K, and the chromaticity (x, y).
const CHROMATICITIES: [(f64, [f64; 2]); 3] =
    [(3000.0, [0.43693, 0.40407]), (6500.0, [0.31352, 0.32363]), (10_000.0, [0.28063, 0.28829])];

/// Mass in solar masses, distance in pc, θ_g in µas.
const HOLES: [(&str, f64, f64, f64); 2] =
    [("M87*", 6.5e9, 16.8e6, 3.818993), ("Sgr A*", 4.297e6, 8277.0, 5.124331)];

pub fn checks() -> Vec<Check> {
    let colours = CHROMATICITIES.into_iter().flat_map(|(temperature, expected)| {
        let radiance = |wavelength| planck::per_wavelength(wavelength, temperature);
        let computed = observer::chromaticity(observer::tristimulus(radiance));
        ["x", "y"].into_iter().enumerate().map(move |(k, axis)| Check {
            name: format!("{axis} at {temperature} K"),
            source: LOCUS,
            expected: expected[k],
            computed: computed[k],
            // Half a unit, and as much from steps of 5 nm.
            tolerance: 1.2e-5,
        })
    });
    let holes = HOLES.into_iter().map(|(name, mass, distance, expected)| {
        let units = Units { mass: Some(mass), distance: Some(distance), frequency: None };
        Check {
            name: format!("θ_g of {name} in µas"),
            source: SCALES,
            expected,
            computed: units.microarcseconds().unwrap_or(f64::NAN),
            tolerance: 5e-7,
        }
    });
    let sun = Units { mass: Some(1.0), ..Units::default() };
    let sun = Check {
        name: "GM☉/c² in km".to_owned(),
        source: SCALES,
        expected: 1.476625038,
        computed: sun.kilometres().unwrap_or(f64::NAN),
        tolerance: 6e-10,
    };
    colours.chain(holes).chain([sun]).collect()
}
