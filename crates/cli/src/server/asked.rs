//! What a client asks for.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

/// Pixels of a live picture along an edge at most.
pub const LONGEST: u32 = 4096;

/// Rays in each pixel of a live picture at most.
const MOST_SAMPLES: u32 = 64;

/// A message.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Asked {
    /// To see this from now on, instead of what was asked for before.
    Show(View),
}

/// What is to be seen, whole: nothing of it is remembered.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// A number that comes back with everything that is an answer.
    pub generation: u32,
    /// The scene that keys are set in, by its name; "" for that of the command line.
    #[serde(default)]
    pub base: String,
    /// Keys of the scene and their values.
    #[serde(default)]
    pub set: BTreeMap<String, Value>,
    /// Width and height of the picture in pixels.
    pub size: [u32; 2],
    /// Rays in each pixel once all is still.
    pub samples: u32,
    /// Whether the next will follow at once.
    #[serde(default)]
    pub moving: bool,
}

impl Asked {
    /// Reads a message.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(text: &str) -> Result<Self, String> {
        let asked: Self = serde_json::from_str(text).map_err(|e| format!("the message cannot be read: {e}"))?;
        let Self::Show(view) = &asked;
        view.check()?;
        Ok(asked)
    }
}

impl View {
    fn check(&self) -> Result<(), String> {
        let [width, height] = self.size;
        if !self.size.iter().all(|edge| (1..=LONGEST).contains(edge)) {
            return Err(format!("{width} × {height} pixels: give 1 to {LONGEST} along each edge"));
        }
        if !(1..=MOST_SAMPLES).contains(&self.samples) {
            return Err(format!("{} rays in each pixel: give 1 to {MOST_SAMPLES}", self.samples));
        }
        Ok(())
    }
}
