//! The formats of pictures, and which file has which.

use std::path::Path;

use super::{FileError, Provenance, exr, png};
use crate::render::Film;
use crate::scene::Scene;

/// A format of picture files, told by the ending of the name.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Format {
    /// What a screen shows: light after exposure and tone curve, or a data layer in false colours.
    Png,
    /// Linear light and the data layers.
    Exr,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 2] = [Self::Png, Self::Exr];

    /// The ending of names, without the dot.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }

    /// The format of a file by its name, capitals or not.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?;
        Self::ALL.into_iter().find(|format| ending.eq_ignore_ascii_case(format.ending()))
    }

    /// Writes a scene's picture, whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(self, path: &Path, scene: &Scene, film: &Film) -> Result<(), FileError> {
        let made = Provenance::of(scene, film);
        match self {
            Self::Png => png::write(path, &scene.display.picture(film), scene.display.depth, &made),
            Self::Exr => exr::write(path, film, &made),
        }
    }

    /// Reads from a file how it was made.
    ///
    /// # Errors
    /// When it cannot be read, is not of this format, or holds no record of this program.
    pub fn read_provenance(self, path: &Path) -> Result<Provenance, FileError> {
        match self {
            Self::Png => png::read_provenance(path),
            Self::Exr => exr::read_provenance(path),
        }
    }
}
