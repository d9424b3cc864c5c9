//! Pictures that this program wrote, read again: what a file for science holds is a film and its scene.

use std::fs;
use std::path::Path;

use super::images::JANSKYS;
use super::{FileError, Format, Provenance, fits, hdf5};
use crate::camera::Camera;
use crate::light::Radiance;
use crate::render::{Channel, Film, Layer};
use crate::scene::{Draft, Faults, Scene};
use crate::spacetime::Level;

/// Why a file gives no scene, or no film.
#[derive(Debug, thiserror::Error)]
pub enum SavedError {
    /// The file cannot be used.
    #[error(transparent)]
    File(#[from] FileError),
    /// The scene is wrong.
    #[error("{0}")]
    Scene(Faults),
}

impl From<Faults> for SavedError {
    fn from(faults: Faults) -> Self {
        Self::Scene(faults)
    }
}

/// The scene in a file as it stands there: a scene file, or a picture that was made of one.
///
/// # Errors
/// If the file cannot be read, or says nothing of its making.
pub fn draft(path: &Path) -> Result<Draft, SavedError> {
    let Some(format) = Format::of(path) else { return Ok(Draft::open(path)?) };
    Ok(recorded(path, format.read_provenance(path)?))
}

fn recorded(path: &Path, made: Provenance) -> Draft {
    let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
    Draft { name: path.display().to_string(), text: made.scene_toml, overrides: Vec::new(), folder }
}

/// A picture as a file holds it.
#[derive(Clone, Debug)]
pub struct Saved {
    /// Its scene, as it stands in the file.
    pub draft: Draft,
    /// The same, read.
    pub scene: Scene,
    /// Its light and data layers. Of the tally only what the record says of interpolation is known.
    pub film: Film,
    /// How the file was made.
    pub provenance: Provenance,
}

/// An image of a file: its name and unit, and its numbers along the rows, the top row first.
pub(super) struct Sheet {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) size: [usize; 2],
    pub(super) values: Vec<f64>,
}

impl Saved {
    /// Reads a FITS or HDF5 file as [`Format::write`] wrote it. Fluxes in Jy become the radiance again, to rounding; all else is as it was.
    ///
    /// # Errors
    /// If the file cannot be read, is of another format, or another program's.
    pub fn open(path: &Path) -> Result<Self, SavedError> {
        let wrong = |fault: &str, mend| FileError::new("read", path, fault, mend);
        let format = Format::of(path);
        let bytes = match format {
            Some(Format::Fits | Format::Hdf5) => fs::read(path).map_err(|e| FileError::read(path, &e))?,
            _ => {
                return Err(wrong(
                    "its numbers are known in FITS and HDF5 files alone",
                    "give a .fits or .h5 file; `measure` and `fit` read other pictures",
                )
                .into());
            }
        };
        let provenance = format.map_or_else(
            || Err(wrong("it has no known ending", "give a .fits or .h5 file")),
            |format| format.read_provenance(path),
        )?;
        let sheets = match format {
            Some(Format::Fits) => fits::sheets(&bytes, path)?,
            _ => hdf5::sheets(bytes, path)?,
        };
        let draft = recorded(path, provenance.clone());
        let scene = draft.scene()?;
        let film = film(&scene, &provenance, &sheets)
            .ok_or_else(|| wrong("its images are not those of its record", "fetch or render it again"))?;
        Ok(Self { draft, scene, film, provenance })
    }
}

/// The film of the images in a file; none if they are not as this program writes them.
fn film(scene: &Scene, provenance: &Provenance, sheets: &[Sheet]) -> Option<Film> {
    let named = |name: &str| sheets.iter().find(|sheet| sheet.name.eq_ignore_ascii_case(name));
    let [red, green, blue] = [named("red")?, named("green")?, named("blue")?];
    let [width, height] = red.size;
    if sheets.iter().any(|sheet| sheet.size != red.size || sheet.values.len() != width * height) {
        return None;
    }
    let size = [u32::try_from(width).ok()?, u32::try_from(height).ok()?];
    let channels: Vec<Channel> = Layer::ALL
        .into_iter()
        .flat_map(Layer::channels)
        .filter(|channel| named(&channel.name()).is_some())
        .collect();
    let intensity = named("intensity");
    let radiance = intensity.map(|sheet| match sheet.unit.as_str() {
        "" => Radiance::Bolometric,
        _ => Radiance::Specific,
    });
    let level = Level::named(&provenance.instruction_level)?;
    let mut film = Film::blank(size, radiance, &channels, level);
    for (pixel, light) in film.light.iter_mut().enumerate() {
        *light = [red, green, blue].map(|sheet| sheet.values[pixel] as f32);
    }
    if let Some(sheet) = intensity {
        let flux = if sheet.unit == JANSKYS {
            scene.units.janskys(Camera::new(scene).ok()?.pixel_size())?
        } else {
            1.0
        };
        film.intensity = sheet.values.iter().map(|value| value / flux).collect();
    }
    for plane in &mut film.planes {
        let sheet = named(&plane.channel.name())?;
        plane.values = sheet.values.iter().map(|value| *value as f32).collect();
    }
    film.tally.interpolation = provenance.interpolation.unwrap_or_default();
    Some(film)
}
