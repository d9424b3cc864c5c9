//! How a file was made.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use super::FileError;
use crate::scene::Scene;
use crate::spacetime::Level;

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
///     instruction_level: "AVX2".into(),
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
///         "# instruction_level = \"AVX2\"",
///         "#",
///         "[spacetime]",
///         "spin = 0.5",
///     ]
/// );
/// assert_eq!(text.parse::<Provenance>()?, made);
/// # Ok::<(), kerrscope::output::ProvenanceFault>(())
/// ```
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// The whole scene, as TOML.
    pub scene_toml: String,
    /// Seed of the pseudo-random numbers.
    pub seed: u64,
    /// The machine instructions that the rays were traced with.
    pub instruction_level: String,
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
    /// That of files made of a scene by this program with a level of instructions.
    pub fn of(scene: &Scene, level: Level) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_toml: scene.to_toml(),
            seed: scene.render.seed,
            instruction_level: level.name().to_owned(),
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
        let value = |key: &'static str| {
            comment
                .lines()
                .filter_map(|line| line.strip_prefix("# ")?.split_once(" = "))
                .find_map(|(k, value)| (k == key).then_some(value))
                .and_then(|value| serde_json::from_str::<serde_json::Value>(value).ok())
                .ok_or(ProvenanceFault::Line(key))
        };
        let string = |key| match value(key)? {
            serde_json::Value::String(s) => Ok(s),
            _ => Err(ProvenanceFault::Line(key)),
        };
        Ok(Self {
            version: string("version")?,
            seed: value("seed")?.as_u64().ok_or(ProvenanceFault::Line("seed"))?,
            instruction_level: string("instruction_level")?,
            scene_toml: scene.to_owned(),
        })
    }
}
