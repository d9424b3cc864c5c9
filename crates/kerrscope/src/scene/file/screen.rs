//! `[screen]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const ANGLE: f64 = 50.0;
const IMPACT: f64 = 20.0;

/// What the observer's screen shows.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Screen {
    /// How a point of the screen chooses a direction.
    pub kind: ScreenKind,
    /// Height of the picture, outer edge to outer edge: in degrees below 180 for "pinhole", in
    /// degrees up to 180 for "angular" (50 for both if not given), in M for "impact" (20).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(
        with = "f64",
        range(max = 1e15),
        extend("exclusiveMinimum" = 0, "default" = ANGLE)
    )]
    pub field_of_view: Option<f64>,
    /// Angle in degrees by which the camera is turned anticlockwise, so the picture clockwise.
    #[schemars(range(min = -1e6, max = 1e6))]
    pub roll: f64,
    /// Point [x, y, z] that the camera is turned to, in Kerr–Schild Cartesian coordinates, in M; for
    /// "pinhole" and "angular". It is the straight line there that counts: bent light, and the
    /// aberration of a moving camera, show something else at the picture's middle. Without it
    /// the camera looks inwards along r.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = -1e15, max = 1e15)))]
    pub look_at: Option<[f64; 3]>,
}

/// How a point of the screen chooses a direction.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ScreenKind {
    /// A flat picture, as a camera takes it.
    #[default]
    Pinhole,
    /// Equal angles take equal lengths.
    Angular,
    /// The plane of the impact parameters α and β, in M.
    Impact,
}

impl Screen {
    pub(super) fn complete(&self) -> Self {
        let height = if self.kind == ScreenKind::Impact { IMPACT } else { ANGLE };
        Self { field_of_view: self.field_of_view.or(Some(height)), ..self.clone() }
    }
}
