//! Where a scene comes from: a scene file, or a picture that was made of one.

use crate::report::Failure;
use kerrscope::output::Format;
use kerrscope::scene::Scene;
use std::path::{Path, PathBuf};

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
        let Some(format) = Format::of(path) else { return Ok(Scene::load(Some(path), &overrides)?) };
        let made = format.read_provenance(path).map_err(|e| Failure::Input(e.to_string()))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Ok(Scene::from_record(&path.display().to_string(), &made.scene_toml, &overrides, folder)?)
    }
}
