//! How a file was made.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use super::FileError;
use crate::render::{Film, Interpolation};
use crate::scene::Scene;

/// What is needed to make a file again.
///
/// As text it is the scene, after a few lines of TOML comment with everything else. So
/// the text is itself a scene file that can be rendered:
///
/// ```
/// use kerrscope::output::Provenance;
/// let made = Provenance {
///     version: "0.1.0".into(),
///     seed: 7,
///     instruction_level: "avx2".into(),
///     interpolation: None,
///     scene_toml: "[spacetime]\nspin = 0.5\n".into(),
/// };
/// let text = made.to_string();
/// let lines: Vec<&str> = text.lines().collect();
/// assert_eq!(
///     lines,
///     [
///         "# Rendered by kerrscope.",
///         "# version = \"0.1.0\"",
///         "# seed = 7",
///         "# instruction_level = \"avx2\"",
///         "#",
///         "[spacetime]",
///         "spin = 0.5",
///     ]
/// );
/// assert_eq!(text.parse::<Provenance>()?, made);
/// # Ok::<(), kerrscope::output::ProvenanceFault>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// The whole scene, as TOML.
    pub scene_toml: String,
    /// Seed of the pseudo-random numbers.
    pub seed: u64,
    /// The machine instructions that the rays were traced with.
    pub instruction_level: String,
    /// How much of the picture was interpolated between rays and how well, if any.
    pub interpolation: Option<Interpolation>,
}

/// A text that is no record of provenance.
#[derive(Clone, Debug, Eq, PartialEq, thiserror::Error)]
pub enum ProvenanceFault {
    /// The first line is not the one that opens a record.
    #[error("it does not begin with {TITLE:?}")]
    Foreign,
    /// The line `#` that closes the comment is missing.
    #[error("it ends within its first lines")]
    Truncated,
    /// A line is missing or its value is not of the right kind.
    #[error("its line {0:?} is missing or wrong")]
    Line(&'static str),
}

impl Provenance {
    /// That of files made of a scene's film by this program.
    pub fn of(scene: &Scene, film: &Film) -> Self {
        let interpolation = film.tally.interpolation;
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_toml: scene.to_toml(),
            seed: scene.render.seed,
            instruction_level: film.level.name().to_owned(),
            interpolation: (interpolation.samples > 0).then_some(interpolation),
        }
    }

    /// The record in the text that was found in a file, if any.
    pub(super) fn from_file(path: &Path, text: Option<String>) -> Result<Self, FileError> {
        let wrong =
            |fault: String| FileError::new("read", path, fault, "give a picture as kerrscope wrote it");
        let text = text.ok_or_else(|| wrong("it does not say how kerrscope made it".to_owned()))?;
        text.parse().map_err(|fault| {
            wrong(format!("its text \"kerrscope\" is no record of how it was made: {fault}"))
        })
    }
}

const TITLE: &str = "# Rendered by kerrscope.";

impl fmt::Display for Provenance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A string of JSON has no line ends, and reads like one of TOML.
        let quoted = |s: &str| serde_json::Value::from(s).to_string();
        writeln!(f, "{TITLE}")?;
        writeln!(f, "# version = {}", quoted(&self.version))?;
        writeln!(f, "# seed = {}", self.seed)?;
        writeln!(f, "# instruction_level = {}", quoted(&self.instruction_level))?;
        if let Some(Interpolation { samples, compared, missed, worst }) = &self.interpolation {
            writeln!(f, "# interpolated_samples = {samples}")?;
            writeln!(f, "# interpolation_compared = {compared}")?;
            writeln!(f, "# interpolation_missed = {missed}")?;
            writeln!(f, "# interpolation_error_max = {worst:e}")?;
        }
        writeln!(f, "#")?;
        f.write_str(&self.scene_toml)
    }
}

impl FromStr for Provenance {
    type Err = ProvenanceFault;

    fn from_str(text: &str) -> Result<Self, ProvenanceFault> {
        let rest = text
            .strip_prefix(TITLE)
            .and_then(|rest| rest.strip_prefix('\n'))
            .ok_or(ProvenanceFault::Foreign)?;
        // The last line of the comment, wherever it is: later versions may add lines.
        let (comment, scene) = match rest.strip_prefix("#\n") {
            Some(scene) => ("", scene),
            None => rest.split_once("\n#\n").ok_or(ProvenanceFault::Truncated)?,
        };
        let typed = |key: &str| {
            let mut lines = comment.lines().filter_map(|line| line.strip_prefix("# ")?.split_once(" = "));
            lines.find_map(|(k, value)| (k == key).then_some(value))
        };
        let value = |key: &'static str| {
            typed(key)
                .and_then(|value| serde_json::from_str::<serde_json::Value>(value).ok())
                .ok_or(ProvenanceFault::Line(key))
        };
        let string = |key| match value(key)? {
            serde_json::Value::String(s) => Ok(s),
            _ => Err(ProvenanceFault::Line(key)),
        };
        let count = |key| value(key)?.as_u64().ok_or(ProvenanceFault::Line(key));
        // Only where there is something to say.
        let interpolation = match typed("interpolated_samples") {
            None => None,
            Some(_) => Some(Interpolation {
                samples: count("interpolated_samples")?,
                compared: count("interpolation_compared")?,
                missed: count("interpolation_missed")?,
                worst: value("interpolation_error_max")?
                    .as_f64()
                    .ok_or(ProvenanceFault::Line("interpolation_error_max"))?,
            }),
        };
        Ok(Self {
            version: string("version")?,
            seed: count("seed")?,
            instruction_level: string("instruction_level")?,
            interpolation,
            scene_toml: scene.to_owned(),
        })
    }
}
