//! Where a scene comes from: a scene file, or a picture that was made of one.

use crate::report::Failure;
use kerrscope::output::{Format, SavedError, draft};
use kerrscope::scene::{Draft, Scene};
use std::path::PathBuf;

/// A scene named on the command line, and what is to be changed in it.
#[derive(clap::Args, Debug, Default)]
pub struct Source {
    /// Scene file (TOML), or a picture that kerrscope made (PNG, EXR, FITS, HDF5), for the scene in it; without
    /// one, the built-in scene
    pub scene: Option<PathBuf>,
    /// Override a key of the scene; may be given several times
    #[arg(long, value_name = "PATH=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
}

impl Source {
    /// The scene, with further overrides after those of `--set`.
    pub fn load(&self, overrides: impl IntoIterator<Item = String>) -> Result<Scene, Failure> {
        let overrides: Vec<String> = self.set.iter().cloned().chain(overrides).collect();
        let Some(path) = &self.scene else { return Ok(Scene::load(None, &overrides)?) };
        if Format::of(path).is_none() {
            // What is wrong with overrides is told even if the file cannot be read.
            return Ok(Scene::load(Some(path), &overrides)?);
        }
        Ok(Draft { overrides, ..self.draft()? }.scene()?)
    }

    /// The scene as it was typed, without what `--set` changes in it.
    pub fn draft(&self) -> Result<Draft, Failure> {
        let Some(path) = &self.scene else {
            return Ok(Draft { name: "built-in scene".to_owned(), ..Draft::new("", "") });
        };
        draft(path).map_err(|error| match error {
            SavedError::Scene(faults) => Failure::Scene(faults),
            SavedError::File(error) => Failure::Input(error.to_string()),
        })
    }
}
