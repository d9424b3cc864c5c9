//! `[spacetime]`

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

const KERR_SPIN: f64 = 0.99;

/// The spacetime that light moves in. The unit of length is its mass M, or that of its formulas.
///
/// A metric as text has the keys from `coordinates` on, here or at the top of a `file` of its own.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spacetime {
    /// Which spacetime.
    pub name: SpacetimeName,
    /// Spin a = J/M² along +z of "kerr": 0.99 if not given. "schwarzschild" does not turn, so that it is 0;
    /// "minkowski" takes no notice of it; a text has `parameters` instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = -1, max = 1), extend("default" = KERR_SPIN))]
    pub spin: Option<f64>,
    /// The coordinates in which light is followed. "kerr-schild" if not given; the others are there to show what
    /// singular coordinates cost: only the integrator follows light in them.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Coordinates", extend("default" = "kerr-schild"))]
    pub chart: Option<Coordinates>,
    /// File of a metric as text, relative to the scene file's folder; for "text".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub file: Option<String>,
    /// Names of the four coordinates, time first; for "text", as all that follows.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[String; 4]")]
    pub coordinates: Option<[String; 4]>,
    /// What the coordinates are like; "cartesian" if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "CoordinateKind")]
    pub kind: Option<CoordinateKind>,
    /// Radius by which disks and the horizon are measured, as a formula; the distance from the origin if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Formula")]
    pub radius: Option<Formula>,
    /// Radius of the horizon, a number or a formula of parameters; none if not given or 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Formula")]
    pub horizon: Option<Formula>,
    /// Instead of a horizon: a formula that is above 1 where light counts as captured.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Formula")]
    pub depth: Option<Formula>,
    /// Distance from the origin where rays end if space does not become flat: the sky is what an observer at rest sees
    /// there. A number or a formula of parameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Formula")]
    pub outer: Option<Formula>,
    /// Distance from the origin of the sphere behind which space goes on as its mirror image, under `[other_sky]`. A number
    /// or a formula of parameters.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Formula")]
    pub throat: Option<Formula>,
    /// How the spacetime reversed in time, in which rays are followed, is made of this; "time" if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Reversal")]
    pub reversal: Option<Reversal>,
    /// Numbers with names. Of a metric that is known by its name, or of a `file`, those given here replace its own.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub parameters: BTreeMap<String, f64>,
    /// Formulas with names, in any order, that others can use.
    #[serde(rename = "let", skip_serializing_if = "BTreeMap::is_empty")]
    pub lets: BTreeMap<String, Formula>,
    /// Components of the metric as formulas, each by the names of its two coordinates, `tt` or `t_t`; it is symmetric,
    /// and what is not given is 0.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub metric: BTreeMap<String, Formula>,
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

/// A formula, or a number.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Formula {
    /// A number.
    Number(f64),
    /// A formula of numbers, names, + - * / ^ and functions.
    Text(String),
}

impl Formula {
    /// As a formula.
    pub fn text(&self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Text(text) => text.clone(),
        }
    }
}

/// What coordinates are like.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum CoordinateKind {
    /// Time and three lengths.
    #[default]
    Cartesian,
    /// Time, a radius, the angle from +z and the azimuth, in radians.
    Spherical,
}

/// How a spacetime is reversed in time.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Reversal {
    /// Time changes its sign: right for all.
    #[default]
    Time,
    /// It is the mirror image, y or φ changing its sign: right around what turns about +z and is the same all around it. Light is
    /// then followed through the horizon if the metric is regular for what falls in.
    Mirror,
}

/// The name of a spacetime. What comes after "text" is known as text by the program; its parameters can be set.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpacetimeName {
    /// A black hole that turns.
    #[default]
    Kerr,
    /// A black hole that does not turn.
    Schwarzschild,
    /// No black hole: flat space.
    Minkowski,
    /// The metric that is written here or in `file`.
    Text,
    /// A black hole that turns: `mass`, `spin`.
    KerrText,
    /// A black hole that does not turn: `mass`.
    SchwarzschildText,
    /// A black hole with a charge: `mass`, `charge`.
    ReissnerNordstrom,
    /// A black hole that turns and has a charge: `mass`, `spin`, `charge`.
    KerrNewman,
    /// Johannsen's deformed Kerr: `mass`, `spin`, `a13`, `a22`, `a52`, `e3`.
    Johannsen,
    /// Ellis's wormhole: `size`.
    Ellis,
    /// A wormhole of Morris and Thorne with a constant shape function: `size`.
    MorrisThorne,
    /// Two extremely charged black holes at rest: `mass1`, `mass2`, `separation` along x.
    MajumdarPapapetrou,
    /// Two superposed Kerr holes, approximately: `mass1`, `mass2`, `spin1`, `spin2`, `separation` along x.
    TwoKerr,
    /// A black hole and a cosmological constant: `mass`, `lambda`.
    SchwarzschildDeSitter,
}

impl SpacetimeName {
    /// All of them.
    pub const ALL: [Self; 14] = [
        Self::Kerr,
        Self::Schwarzschild,
        Self::Minkowski,
        Self::Text,
        Self::KerrText,
        Self::SchwarzschildText,
        Self::ReissnerNordstrom,
        Self::KerrNewman,
        Self::Johannsen,
        Self::Ellis,
        Self::MorrisThorne,
        Self::MajumdarPapapetrou,
        Self::TwoKerr,
        Self::SchwarzschildDeSitter,
    ];

    /// The text of a metric that is known as text by its name.
    pub fn metric(self) -> Option<(&'static str, &'static str)> {
        macro_rules! shipped {
            ($name:literal) => {
                Some(($name, include_str!(concat!("../../../metrics/", $name, ".toml"))))
            };
        }
        match self {
            Self::Kerr | Self::Schwarzschild | Self::Minkowski | Self::Text => None,
            Self::KerrText => shipped!("kerr-text"),
            Self::SchwarzschildText => shipped!("schwarzschild-text"),
            Self::ReissnerNordstrom => shipped!("reissner-nordstrom"),
            Self::KerrNewman => shipped!("kerr-newman"),
            Self::Johannsen => shipped!("johannsen"),
            Self::Ellis => shipped!("ellis"),
            Self::MorrisThorne => shipped!("morris-thorne"),
            Self::MajumdarPapapetrou => shipped!("majumdar-papapetrou"),
            Self::TwoKerr => shipped!("two-kerr"),
            Self::SchwarzschildDeSitter => shipped!("schwarzschild-de-sitter"),
        }
    }
}

impl Spacetime {
    pub(super) fn complete(&self) -> Self {
        let spin = match self.name {
            SpacetimeName::Kerr => Some(KERR_SPIN),
            SpacetimeName::Schwarzschild | SpacetimeName::Minkowski => Some(0.0),
            _ => None,
        };
        let holes = [SpacetimeName::Kerr, SpacetimeName::Schwarzschild];
        let usual = holes.contains(&self.name).then(Coordinates::default);
        Self { spin: self.spin.or(spin), chart: self.chart.or(usual), ..self.clone() }
    }
}
