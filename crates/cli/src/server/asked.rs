//! What a client asks for.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::overlay::Kind;

/// How large a picture may be.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    /// Pixels along an edge.
    edge: u32,
    /// Pixels.
    pixels: u64,
    /// Rays in each.
    samples: u32,
}

/// A live one.
const LIVE: Bounds = Bounds { edge: 4096, pixels: 4096 * 4096, samples: 64 };

/// One that is saved: 8K, which takes about a gigabyte while it is made.
const SAVED: Bounds = Bounds { edge: 16384, pixels: 7680 * 4320, samples: 1024 };

/// A message.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Asked {
    /// To see this from now on, instead of what was asked for before.
    Show(View),
    /// The ray at a place of the picture, given as shares of its width and height.
    Inspect {
        /// The picture.
        view: View,
        /// The place.
        at: [f64; 2],
    },
    /// A file of this.
    Save {
        /// The picture, of any size.
        view: View,
        /// The format.
        format: Kept,
    },
    /// To save no more.
    Stop,
}

/// What can be saved.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "lowercase")]
pub enum Kept {
    /// What a screen shows.
    Png,
    /// Linear light and data layers.
    Exr,
    /// The scene with every default.
    Toml,
}

/// What is to be seen, whole: nothing of it is remembered.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
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
    /// Lines over the picture.
    #[serde(default)]
    pub overlays: Vec<Kind>,
}

impl Asked {
    /// Reads a message.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(text: &str) -> Result<Self, String> {
        let asked: Self =
            serde_json::from_str(text).map_err(|e| format!("the message cannot be read: {e}"))?;
        match &asked {
            Self::Show(view) => view.check(LIVE)?,
            Self::Inspect { view, at } => {
                view.check(LIVE)?;
                if !at.iter().all(|share| (0.0..=1.0).contains(share)) {
                    return Err(format!("{at:?} is outside of the picture: give shares from 0 to 1"));
                }
            }
            Self::Save { view, .. } => view.check(SAVED)?,
            Self::Stop => {}
        }
        Ok(asked)
    }
}

impl View {
    fn check(&self, most: Bounds) -> Result<(), String> {
        let [width, height] = self.size;
        let Bounds { edge, pixels, samples } = most;
        if !self.size.iter().all(|length| (1..=edge).contains(length)) {
            return Err(format!("{width} × {height} pixels: give 1 to {edge} along each edge"));
        }
        if u64::from(width) * u64::from(height) > pixels {
            return Err(format!(
                "{width} × {height} pixels are more than {pixels}: give fewer, or use `kerrscope render`"
            ));
        }
        if !(1..=samples).contains(&self.samples) {
            return Err(format!("{} rays in each pixel: give 1 to {samples}", self.samples));
        }
        if self.overlays.len() > 8 {
            return Err(format!("{} kinds of lines: there are fewer", self.overlays.len()));
        }
        Ok(())
    }
}
