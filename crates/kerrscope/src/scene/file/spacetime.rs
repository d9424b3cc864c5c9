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
    /// The coordinates in which light is followed. "kerr-schild" if not given; the others are there to show what
    /// singular coordinates cost: only the integrator follows light in them.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Coordinates", extend("default" = "kerr-schild"))]
    pub chart: Option<Coordinates>,
}

/// Coordinates of a black hole's spacetime.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coordinates {
    /// Cartesian; regular at the horizon and on the axis.
    #[default]
    KerrSchild,
    /// Spherical; singular at the horizon and on the axis. Without spin they are Schwarzschild's.
    BoyerLindquist,
    /// Spherical, of a hole that does not turn; singular at the horizon and on the axis.
    Schwarzschild,
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
        let usual = (self.name != SpacetimeName::Minkowski).then(Coordinates::default);
        Self { name: self.name, spin: Some(self.spin.unwrap_or(spin)), chart: self.chart.or(usual) }
    }
}
