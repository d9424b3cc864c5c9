//! The formats of pictures, and which file has which.

use std::path::Path;

use super::{FileError, ImageSet, Provenance, exr, fits, hdf5, png};
use crate::render::Film;
use crate::scene::Scene;

/// A format of picture files, told by the ending of the name.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Format {
    /// What a screen shows: light after exposure and tone curve, or a data layer in false colours.
    Png,
    /// Linear light and the data layers.
    Exr,
    /// Intensity in physical units, linear light and the data layers, with a header for astronomers.
    Fits,
    /// The same for programs.
    Hdf5,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 4] = [Self::Png, Self::Exr, Self::Fits, Self::Hdf5];

    /// The endings of names, without the dot.
    pub const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Png => &["png"],
            Self::Exr => &["exr"],
            Self::Fits => &["fits", "fit", "fts"],
            Self::Hdf5 => &["h5", "hdf5"],
        }
    }

    /// The format of a file by its name, capitals or not.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?;
        let named = |format: &Self| format.endings().iter().any(|known| ending.eq_ignore_ascii_case(known));
        Self::ALL.into_iter().find(named)
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
            Self::Fits => fits::write(path, &ImageSet::of(scene, film)),
            Self::Hdf5 => hdf5::write(path, &ImageSet::of(scene, film)),
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
            Self::Fits => fits::read_provenance(path),
            Self::Hdf5 => hdf5::read_provenance(path),
        }
    }
}
