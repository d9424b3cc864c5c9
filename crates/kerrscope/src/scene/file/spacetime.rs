//! `[spacetime]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const KERR_SPIN: f64 = 0.99;

/// The spacetime that light moves in. Its mass M is the unit of length.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spacetime {
    /// Which spacetime.
    pub name: SpacetimeName,
    /// Spin a = J/M² along +z. 0.99 in "kerr"; "schwarzschild" does not turn, so that it is 0; "minkowski"
    /// takes no notice of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = -1, max = 1), extend("default" = KERR_SPIN))]
    pub spin: Option<f64>,
}

/// The name of a spacetime.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SpacetimeName {
    /// A black hole that turns.
    #[default]
    Kerr,
    /// A black hole that does not turn.
    Schwarzschild,
    /// No black hole: flat space.
    Minkowski,
}

impl Spacetime {
    pub(super) fn complete(&self) -> Self {
        let spin = if self.name == SpacetimeName::Kerr { KERR_SPIN } else { 0.0 };
        Self { name: self.name, spin: Some(self.spin.unwrap_or(spin)) }
    }
}
