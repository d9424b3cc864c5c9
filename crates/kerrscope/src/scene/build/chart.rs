//! The coordinates in which light is followed.

use kerrscope_spacetime::geodesic::EXIT;
use kerrscope_spacetime::kerr::horizons;
use kerrscope_spacetime::observer::Place;

use super::{Builder, readable};
use crate::scene::file::{Coordinates, SceneFile, SpacetimeName};
use crate::scene::valid::Spacetime;

/// The chosen coordinates come first: they are what is unusual.
const KEYS: [&str; 5] =
    ["spacetime.chart", "observer.distance", "observer.inclination", "observer.position", "observer.motion"];

/// Sine of the angle from the axis below which azimuths lose their digits.
const NEAR_AXIS: f64 = 1e-9;

impl Builder<'_> {
    /// Coordinates that belong to the spacetime and cover the observer.
    pub(super) fn light_coordinates(
        &mut self,
        scene: &SceneFile,
        spacetime: &Spacetime,
        place: Place,
    ) -> Coordinates {
        let Some(coordinates) = scene.spacetime.chart else { return Coordinates::KerrSchild };
        let Some(spin) = spacetime.spin() else {
            let holes = [SpacetimeName::Kerr, SpacetimeName::Schwarzschild];
            self.unused("spacetime.chart", "spacetime.name", &holes);
            return Coordinates::KerrSchild;
        };
        if coordinates == Coordinates::KerrSchild {
            return coordinates;
        }
        let name =
            if coordinates == Coordinates::Schwarzschild { "Schwarzschild" } else { "Boyer–Lindquist" };
        if coordinates == Coordinates::Schwarzschild && scene.spacetime.name == SpacetimeName::Kerr {
            self.fault(
                &["spacetime.chart", "spacetime.name"],
                "Schwarzschild coordinates are those of a hole that does not turn",
                "choose \"boyer-lindquist\", or `spacetime.name = \"schwarzschild\"`",
            );
        }
        if !scene.object.is_empty() {
            self.fault(
                &["spacetime.chart", "object"],
                format!("{name} coordinates know no things in the way of light"),
                "leave out the `[[object]]` sections, or choose `spacetime.chart = \"kerr-schild\"`",
            );
        }
        if place.theta.sin().abs() < NEAR_AXIS {
            self.fault(
                &KEYS,
                format!("{name} coordinates are singular on the axis, and the observer is there"),
                "move the observer off the axis, or choose `spacetime.chart = \"kerr-schild\"`",
            );
        }
        // Closer in, a falling observer sees in ingoing coordinates.
        let least = EXIT * horizons(spin).0;
        if place.r < least {
            let least = readable(least);
            self.fault(
                &KEYS,
                format!(
                    "{name} coordinates are singular at the horizon, and r = {} M is too close to it",
                    readable(place.r)
                ),
                format!(
                    "move the observer beyond r = {least}, or choose `spacetime.chart = \"kerr-schild\"`"
                ),
            );
        }
        coordinates
    }
}
