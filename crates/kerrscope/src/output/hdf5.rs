//! Images as HDF5 files.
//!
//! Each image of an [`ImageSet`] is a dataset of the root group by its name, of 64-bit floating-point numbers, `height` × `width`,
//! the picture's top row first, compressed without loss; its attributes `title` and `unit` say what it is.
//! What is known of all of them is in the root group's attributes: the pixel's side `pixel_m` in M and
//! `pixel_rad` on the sky; `mass_solar`, `distance_pc`, `frequency_hz`, `theta_g_uas`; `object`,
//! `right_ascension_deg`, `declination_deg`, `mjd`; and of how it was made `version`, `seed`, `instruction_level`. What a scene does not give is not there.
//!
//! The whole record is the dataset `kerrscope`, the UTF-8 text of [`Provenance`] as one string: attributes end at 64 KiB.
//! There is no date: the same images are the same bytes. The whole file is made in memory.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use hdf5_pure::{AttrValue, Error, File, FileBuilder, VlenStringReadOptions};

use super::file::write_atomically;
use super::images::ImageSet;
use super::saved::Sheet;
use super::{FileError, Provenance};
use crate::render::Layer;

/// The dataset that says how a file was made.
const RECORD: &str = "kerrscope";
/// The longest record that is read; the largest scene is shorter.
const LONGEST_RECORD: usize = 1 << 28;
/// Numbers along the side of a square that is compressed by itself.
const CHUNK: u64 = 256;

/// Writes images, whole or not at all.
///
/// # Errors
/// When the file cannot be written.
pub fn write(path: &Path, images: &ImageSet<'_>) -> Result<(), FileError> {
    write_atomically(path, |to| encode(to, images))
}

/// Writes images to any place that takes bytes.
///
/// # Errors
/// When that place fails.
pub fn encode(to: impl Write, set: &ImageSet<'_>) -> io::Result<()> {
    let mut file = FileBuilder::new();
    let [width, height] = set.size().map(u64::from);
    for image in set.images() {
        let values: Vec<f64> = (0..(width * height) as usize).map(|pixel| image.value(pixel)).collect();
        file.create_dataset(&image.name)
            .with_f64_data(&values)
            .with_shape(&[height, width])
            .with_chunks(&[height.min(CHUNK), width.min(CHUNK)])
            .with_shuffle()
            .with_deflate(4)
            .set_attr("title", AttrValue::VarLenString(image.title))
            .set_attr("unit", AttrValue::VarLenString(image.unit.to_owned()));
    }
    for (name, value) in attributes(set) {
        file.set_attr(name, value);
    }
    file.create_dataset(RECORD).with_vlen_strings(&[&set.provenance().to_string()]);
    file.finish_to(to).map_err(|error| match error {
        Error::Io(e) => e,
        other => io::Error::other(other.to_string()),
    })
}

/// What is known of all images.
fn attributes(set: &ImageSet<'_>) -> Vec<(&'static str, AttrValue)> {
    let (target, units, made) = (set.target(), set.units(), set.provenance());
    let numbers = [
        ("pixel_m", set.pixel()),
        ("pixel_rad", set.pixel_angle()),
        ("mass_solar", units.mass),
        ("distance_pc", units.distance),
        ("frequency_hz", units.frequency),
        ("theta_g_uas", units.microarcseconds()),
        ("right_ascension_deg", Some(target.right_ascension)),
        ("declination_deg", Some(target.declination)),
        ("mjd", Some(target.mjd)),
    ];
    let words = [
        ("object", target.name.clone()),
        ("version", made.version),
        ("instruction_level", made.instruction_level),
    ];
    let numbers = numbers.into_iter().filter_map(|(name, value)| Some((name, AttrValue::F64(value?))));
    let words = words.into_iter().map(|(name, text)| (name, AttrValue::VarLenString(text)));
    numbers.chain(words).chain([("seed", AttrValue::U64(made.seed))]).collect()
}

/// Reads from an HDF5 file how it was made.
///
/// # Errors
/// When the file cannot be read, is no HDF5 file, or holds no record of this program.
pub fn read_provenance(path: &Path) -> Result<Provenance, FileError> {
    // What the system says of a file is better than what the format does.
    fs::File::open(path).map_err(|e| FileError::read(path, &e))?;
    Provenance::from_file(path, find_record(File::open_streaming(path)).map_err(|e| wrong(path, e))?)
}

/// Reads from the contents of an HDF5 file how it was made. `path` is what errors call it.
///
/// # Errors
/// As [`read_provenance`].
pub fn decode_provenance(contents: Vec<u8>, path: &Path) -> Result<Provenance, FileError> {
    Provenance::from_file(path, find_record(File::from_bytes(contents)).map_err(|e| wrong(path, e))?)
}

fn wrong(path: &Path, error: Error) -> FileError {
    match error {
        Error::Io(e) if e.kind() != io::ErrorKind::UnexpectedEof => FileError::read(path, &e),
        other => FileError::new("read", path, other.to_string(), "give an HDF5 file that is whole"),
    }
}

/// The images of a file of this program.
///
/// # Errors
/// When they cannot be read.
pub(super) fn sheets(bytes: Vec<u8>, path: &Path) -> Result<Vec<Sheet>, FileError> {
    find_sheets(bytes).map_err(|e| wrong(path, e))
}

fn find_sheets(bytes: Vec<u8>) -> Result<Vec<Sheet>, Error> {
    let file = File::from_bytes(bytes)?;
    let light = ["intensity", "red", "green", "blue"].map(str::to_owned);
    let layers = Layer::ALL.into_iter().flat_map(Layer::channels).map(|channel| channel.name().into_owned());
    let mut sheets = Vec::new();
    for name in light.into_iter().chain(layers) {
        let Ok(image) = file.dataset(&name) else { continue };
        let [height, width] = image.shape()?[..] else { continue };
        let unit = match image.attrs()?.get("unit") {
            Some(AttrValue::VarLenString(unit) | AttrValue::AsciiString(unit)) => unit.clone(),
            _ => String::new(),
        };
        let size = [width, height].map(|edge| edge as usize);
        sheets.push(Sheet { unit, size, values: image.read_f64()?, name });
    }
    Ok(sheets)
}

fn find_record(file: Result<File, Error>) -> Result<Option<String>, Error> {
    let Ok(record) = file?.dataset(RECORD) else { return Ok(None) };
    if record.shape()? != [1] {
        return Ok(None);
    }
    let longest = VlenStringReadOptions::new().with_max_payload_bytes(LONGEST_RECORD);
    Ok(record.read_vlen_strings(longest)?.into_iter().next())
}
