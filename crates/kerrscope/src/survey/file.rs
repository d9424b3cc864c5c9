//! A survey as it is typed.

use std::collections::BTreeMap;
use std::fmt;

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::{Deserialize, Serialize};

use crate::spacetime::Level;

/// What a survey file says.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields, default)]
pub struct SurveyFile {
    /// The scene that all pictures begin with; its path begins at the survey's folder. Without it, the built-in scene.
    #[schemars(with = "String")]
    pub scene: Option<String>,
    /// Keys of the scene that are the same in all pictures, as `"render.width" = 128`.
    pub set: BTreeMap<String, Setting>,
    /// What varies. Pictures are made of all combinations, the last axis varying fastest.
    pub axis: Vec<Axis>,
    /// How axes that are neither lists nor grids are sampled, all of them together.
    #[schemars(with = "Sample")]
    pub sample: Option<Sample>,
    /// Vector instructions, the same on every machine: baseline, avx2 or avx512. Without it, the best of the machine that plans.
    #[schemars(with = "Simd")]
    pub simd: Option<Simd>,
}

/// A key of the scene, and the values that it takes: a list (`values`), a grid (`from`, `to`, `steps`) or a range that is sampled
/// (`from`, `to`).
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// The key, as `spacetime.spin`.
    pub key: String,
    /// All values, one after another.
    #[serde(default)]
    #[schemars(with = "Vec<Setting>", length(min = 1, max = 1_000_000))]
    pub values: Option<Vec<Setting>>,
    /// Where a range begins.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub from: Option<f64>,
    /// Where it ends; a grid has a value there.
    #[serde(default)]
    #[schemars(with = "f64")]
    pub to: Option<f64>,
    /// Values of a grid, both ends among them.
    #[serde(default)]
    #[schemars(with = "u32", range(min = 1, max = 1_000_000))]
    pub steps: Option<u32>,
    /// Whether steps are equal, or ratios of neighbours.
    #[serde(default)]
    pub spacing: Spacing,
}

/// How numbers of a range are spread.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Spacing {
    /// By equal steps.
    #[default]
    Linear,
    /// By equal ratios; both ends are above 0.
    Log,
}

/// Points spread over all sampled axes together.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sample {
    /// How points are spread.
    pub design: Design,
    /// How many there are.
    #[schemars(range(min = 1, max = 65536))]
    pub count: u32,
    /// Seed of the random numbers.
    #[serde(default)]
    pub seed: u32,
}

/// A way to spread points.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Design {
    /// Each axis is cut into as many parts as there are points, each of which has one of them (`McKay`, Beckman & Conover 1979).
    LatinHypercube,
    /// The sequence of Sobol (1967), scrambled as by Owen (1995): even in all axes together, most so for powers of 2.
    Sobol,
}

/// Vector instructions.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Simd {
    /// Those of every machine of a kind.
    Baseline,
    /// AVX2 and FMA.
    Avx2,
    /// AVX-512.
    Avx512,
}

/// A value of a key.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Setting {
    /// Yes or no.
    Truth(bool),
    /// A whole number.
    Whole(i64),
    /// A number.
    Real(f64),
    /// A word, a path.
    Text(String),
    /// Numbers.
    List(Vec<f64>),
}

impl SurveyFile {
    /// The JSON schema of survey files.
    pub fn schema() -> serde_json::Value {
        let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
        settings.into_generator().into_root_schema_for::<Self>().to_value()
    }
}

impl Simd {
    /// The level of instructions.
    pub fn level(self) -> Level {
        match self {
            Self::Baseline => Level::Baseline,
            Self::Avx2 => Level::Avx2,
            Self::Avx512 => Level::Avx512,
        }
    }
}

impl fmt::Display for Setting {
    /// As TOML has it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Truth(truth) => write!(f, "{truth}"),
            Self::Whole(whole) => write!(f, "{whole}"),
            Self::Real(real) => f.write_str(&number(*real)),
            // A string of JSON reads like one of TOML.
            Self::Text(text) => write!(f, "{}", serde_json::Value::from(text.as_str())),
            Self::List(list) => {
                write!(f, "[{}]", list.iter().map(|x| number(*x)).collect::<Vec<_>>().join(", "))
            }
        }
    }
}

/// A number that is read back as the same.
fn number(x: f64) -> String {
    if x.is_infinite() { (if x > 0.0 { "inf" } else { "-inf" }).to_owned() } else { format!("{x:?}") }
}

impl Setting {
    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Whole(whole) => Some(*whole as f64),
            Self::Real(real) => Some(*real),
            _ => None,
        }
    }
}
