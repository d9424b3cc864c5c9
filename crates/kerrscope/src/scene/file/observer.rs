//! `[observer]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const DISTANCE: f64 = 30.4;
const INCLINATION: f64 = 80.5;
const AZIMUTH: f64 = 0.0;

/// Who looks: a place, either by `distance`, `inclination` and `azimuth` or by `position`, and
/// a motion.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Observer {
    /// Boyer–Lindquist radius r, in M. `inf` with screen.kind = "impact".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(
        with = "f64",
        range(max = 1e15),
        extend("exclusiveMinimum" = 0, "x-infinity" = true, "default" = DISTANCE)
    )]
    pub distance: Option<f64>,
    /// Angle between +z, the axis of spin, and the direction to the observer, in degrees:
    /// 0 is above the north pole, 90 in the equatorial plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 180), extend("default" = INCLINATION))]
    pub inclination: Option<f64>,
    /// Boyer–Lindquist azimuth φ, in degrees; inside the horizon that of ingoing Kerr–Schild
    /// coordinates.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = -1e6, max = 1e6), extend("default" = AZIMUTH))]
    pub azimuth: Option<f64>,
    /// Place [x, y, z] in Kerr–Schild Cartesian coordinates, in M, instead of the three above.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = -1e15, max = 1e15)))]
    pub position: Option<[f64; 3]>,
    /// How the observer moves: a word, a velocity [r, θ, φ] in units of c measured by the
    /// zero-angular-momentum observer there, or `{ velocity = [r, θ, φ], relative_to = "fall" }`.
    pub motion: Motion,
}

/// How an observer moves.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Motion {
    /// By name.
    Named(MotionName),
    /// At this velocity relative to the zero-angular-momentum observer.
    Velocity(#[schemars(inner(range(min = -1, max = 1)))] [f64; 3]),
    /// At a velocity relative to an observer that is named.
    Relative(Velocity),
}

/// A motion that has a name.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum MotionName {
    /// At rest relative to infinity; possible outside the static limit.
    Static,
    /// At constant r and θ, carried around by the spacetime with zero angular momentum; possible
    /// outside the horizon.
    Zamo,
    /// On a circular orbit about +z in the equatorial plane, in free fall.
    Orbit,
    /// In free fall from rest at infinity, with zero angular momentum; possible inside the
    /// horizon too.
    Fall,
}

/// A velocity and who measures it.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Velocity {
    /// Velocity [r, θ, φ], in units of c; its length is below 1.
    #[schemars(inner(range(min = -1, max = 1)))]
    pub velocity: [f64; 3],
    /// Who measures it.
    #[serde(default)]
    pub relative_to: RelativeTo,
}

/// Who measures an observer's velocity.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum RelativeTo {
    /// The observer of zero angular momentum at that place.
    #[default]
    Zamo,
    /// The observer that falls past that place; possible inside the horizon too.
    Fall,
}

impl Default for Motion {
    fn default() -> Self {
        Self::Named(MotionName::Static)
    }
}

impl Observer {
    pub(super) fn complete(&self) -> Self {
        let polar = |value: Option<f64>, default| match self.position {
            Some(_) => value,
            None => value.or(Some(default)),
        };
        Self {
            distance: polar(self.distance, DISTANCE),
            inclination: polar(self.inclination, INCLINATION),
            azimuth: polar(self.azimuth, AZIMUTH),
            ..self.clone()
        }
    }
}
