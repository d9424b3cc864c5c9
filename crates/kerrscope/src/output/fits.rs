//! Images as FITS files (FITS standard 4.0), in the way of interferometry tools.
//!
//! Each image of an [`ImageSet`] is an HDU of 64-bit floating-point numbers (BITPIX −64): the first the primary one if it is the
//! physical intensity, whose BUNIT is JY/PIXEL where the scene's units allow; otherwise the primary one is
//! empty, because the light of a drawn disk is no flux. The others are extensions named in EXTNAME.
//!
//! North is up and East to the left, as the sky is seen: the picture's lowest row is the first, and with `units.mass` and
//! `units.distance` the axes are RA---SIN and DEC--SIN with CDELT1 < 0 in degrees. Without these they are X to the
//! right and Y up in M. The words OBJECT, OBSRA, OBSDEC (degrees) and MJD are those of the scene's `[target]`.
//!
//! How the file was made stands in the extension KERRSCOPE, the bytes (BITPIX 8) of the text of [`Provenance`]; FITS
//! headers hold no UTF-8. There is no date: the same images are the same bytes. DATASUM and CHECKSUM are there.

use std::fs::File;
use std::io::{self, BufReader, Read, Seek, Write};
use std::path::Path;

use fits_well::header::{CommentaryName, Header, Value};
use fits_well::image::{Borrowed, Scaling, View};
use fits_well::{FitsError, FitsReader, FitsWriter};

use super::file::write_atomically;
use super::images::{Image, ImageSet, JANSKYS};
use super::saved::Sheet;
use super::{FileError, Provenance};

/// The extension that says how a file was made.
const RECORD: &str = "KERRSCOPE";
/// The longest record that is read; the largest scene is shorter.
const LONGEST_RECORD: usize = 1 << 28;

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
pub fn encode(to: impl Write, images: &ImageSet<'_>) -> io::Result<()> {
    encode_plainly(to, images).map_err(plain)
}

fn encode_plainly(to: impl Write, set: &ImageSet<'_>) -> Result<(), FitsError> {
    let mut writer = FitsWriter::new(to).with_checksums();
    let provenance = set.provenance();
    let mut primary = Header::new();
    about(&mut primary, set)?;
    let by = format!("Rendered by kerrscope {}. The scene and more: extension {RECORD}.", provenance.version);
    for line in lines(&by) {
        primary.push_commentary(CommentaryName::HISTORY, &line)?;
    }
    let [width, height] = set.size().map(|size| size as usize);
    // FITS counts from the lower left corner.
    let from_below = |image: &Image<'_>| -> Vec<f64> {
        let pixels = (0..height).rev().flat_map(|row| (0..width).map(move |column| row * width + column));
        pixels.map(|pixel| image.value(pixel)).collect()
    };
    if let Some(image) = set.intensity() {
        let values = from_below(&image);
        describe(&mut primary, &image)?;
        writer.write_image(
            Borrowed::new(&[width, height], View::F64(&values), Scaling::IDENTITY)?,
            Some(&primary),
        )?;
    } else {
        writer.write_empty_primary(Some(&primary))?;
    }
    for image in set.images().skip(usize::from(set.intensity().is_some())) {
        let values = from_below(&image);
        let mut header = Header::new();
        header.set("EXTNAME", &*image.name)?;
        describe(&mut header, &image)?;
        about(&mut header, set)?;
        writer.write_image(
            Borrowed::new(&[width, height], View::F64(&values), Scaling::IDENTITY)?,
            Some(&header),
        )?;
    }
    let record = provenance.to_string();
    let mut header = Header::new();
    header.set("EXTNAME", RECORD)?;
    header.push_commentary(
        CommentaryName::COMMENT,
        "UTF-8 text: how this file was made, and the scene (TOML).",
    )?;
    writer.write_image(
        Borrowed::new(&[record.len()], View::U8(record.as_bytes()), Scaling::IDENTITY)?,
        Some(&header),
    )?;
    Ok(())
}

/// What an image holds.
fn describe(header: &mut Header, image: &Image<'_>) -> Result<(), FitsError> {
    if image.unit == JANSKYS {
        header.set("STOKES", "I")?;
    }
    // What is no unit of FITS, or several, is said in words.
    if [JANSKYS, "rad", "W m-2 Hz-1 sr-1"].contains(&image.unit) {
        header.set("BUNIT", image.unit)?;
    }
    let unit = if image.unit.is_empty() { "1" } else { image.unit };
    for line in lines(&format!("{} [{unit}]", image.title)) {
        header.push_commentary(CommentaryName::COMMENT, &line)?;
    }
    Ok(())
}

/// Where the images are, when, and what of.
fn about(header: &mut Header, set: &ImageSet<'_>) -> Result<(), FitsError> {
    header.set("OBJECT", set.target().name.as_str())?;
    let mut put = |name: &'static str, value: Value, comment: &str| -> Result<(), FitsError> {
        header.set(name, value)?;
        header.set_comment(name, comment)?;
        Ok(())
    };
    let (target, units) = (set.target(), set.units());
    let [ra, dec] = [target.right_ascension, target.declination];
    put("TELESCOP", "kerrscope".into(), "a simulation")?;
    if let (Some(angle), [width, height]) = (set.pixel_angle(), set.size().map(f64::from)) {
        let degrees = angle.to_degrees();
        put("CTYPE1", "RA---SIN".into(), "East is left")?;
        put("CRPIX1", (0.5 * width + 0.5).into(), "the picture's middle")?;
        put("CRVAL1", ra.into(), "[deg]")?;
        put("CDELT1", (-degrees).into(), "[deg]")?;
        put("CUNIT1", "deg".into(), "")?;
        put("CTYPE2", "DEC--SIN".into(), "North is up")?;
        put("CRPIX2", (0.5 * height + 0.5).into(), "the picture's middle")?;
        put("CRVAL2", dec.into(), "[deg]")?;
        put("CDELT2", degrees.into(), "[deg]")?;
        put("CUNIT2", "deg".into(), "")?;
        put("RADESYS", "ICRS".into(), "")?;
    } else if let (Some(pixel), [width, height]) = (set.pixel(), set.size().map(f64::from)) {
        put("CTYPE1", "X".into(), "to the right, in M")?;
        put("CRPIX1", (0.5 * width + 0.5).into(), "the picture's middle")?;
        put("CRVAL1", 0.0.into(), "[M]")?;
        put("CDELT1", pixel.into(), "[M]")?;
        put("CTYPE2", "Y".into(), "up, in M")?;
        put("CRPIX2", (0.5 * height + 0.5).into(), "the picture's middle")?;
        put("CRVAL2", 0.0.into(), "[M]")?;
        put("CDELT2", pixel.into(), "[M]")?;
    }
    put("OBSRA", ra.into(), "[deg]")?;
    put("OBSDEC", dec.into(), "[deg]")?;
    put("RA", ra.into(), "[deg]")?;
    put("DEC", dec.into(), "[deg]")?;
    put("MJD", target.mjd.into(), "[d]")?;
    put("MJD-OBS", target.mjd.into(), "[d]")?;
    if let Some(frequency) = units.frequency {
        put("FREQ", frequency.into(), "[Hz] as received")?;
    }
    if let Some(mass) = units.mass {
        put("BHMASS", mass.into(), "[solMass] mass M of the hole")?;
    }
    if let Some(distance) = units.distance {
        put("BHDIST", distance.into(), "[pc] its distance")?;
    }
    if let Some(angle) = units.microarcseconds() {
        put("THETAG", angle.into(), "[uas] angle of M")?;
    }
    Ok(())
}

/// Text in lines that a header takes.
fn lines(text: &str) -> Vec<String> {
    let text = ascii(text);
    text.as_bytes().chunks(70).map(|line| String::from_utf8_lossy(line).into_owned()).collect()
}

/// What FITS can say of a text: Greek letters by their names, and ? for what is no ASCII.
fn ascii(text: &str) -> String {
    let text = text.replace('φ', "phi").replace('θ', "theta").replace('ν', "nu");
    text.chars().map(|c| if (' '..='~').contains(&c) { c } else { '?' }).collect()
}

fn plain(error: FitsError) -> io::Error {
    match error {
        FitsError::Io(e) => e,
        other => io::Error::other(other.to_string()),
    }
}

/// Reads from a FITS file how it was made.
///
/// # Errors
/// When the file cannot be read, is no FITS file, or holds no record of this program.
pub fn read_provenance(path: &Path) -> Result<Provenance, FileError> {
    let file = File::open(path).map_err(|e| FileError::read(path, &e))?;
    decode_provenance(BufReader::new(file), path)
}

/// Reads from the contents of a FITS file how it was made. `path` is what errors call it.
///
/// # Errors
/// As [`read_provenance`].
pub fn decode_provenance(file: impl Read + Seek, path: &Path) -> Result<Provenance, FileError> {
    let text = find_record(file).map_err(|error| match error {
        FitsError::Io(e) if e.kind() != io::ErrorKind::UnexpectedEof => FileError::read(path, &e),
        other => FileError::new("read", path, other.to_string(), "give a FITS file that is whole"),
    })?;
    Provenance::from_file(path, text)
}

/// The images of a file of this program.
///
/// # Errors
/// When they cannot be read.
pub(super) fn sheets(bytes: &[u8], path: &Path) -> Result<Vec<Sheet>, FileError> {
    find_sheets(bytes)
        .map_err(|e| FileError::new("read", path, e.to_string(), "give a FITS file that is whole"))
}

fn find_sheets(bytes: &[u8]) -> Result<Vec<Sheet>, FitsError> {
    let mut reader = FitsReader::from_bytes(bytes)?;
    let mut sheets = Vec::new();
    for number in 0..reader.hdus().len() {
        let hdu = &reader.hdus()[number];
        let name = hdu.extname()?.map_or_else(|| "intensity".to_owned(), |name| name.trim().to_owned());
        if !hdu.is_image() || hdu.data_bytes == 0 || name.eq_ignore_ascii_case(RECORD) {
            continue;
        }
        let unit = hdu.header.get_text("BUNIT").ok().flatten().unwrap_or_default().trim().to_owned();
        let [width, height] = hdu.image_metadata()?.shape[..] else { continue };
        let mut stored = Vec::new();
        reader.image(number).and_then(|mut image| image.physical_into(.., &mut stored))?;
        let values = stored.chunks_exact(width.max(1)).rev().flatten().copied().collect();
        sheets.push(Sheet { name, unit, size: [width, height], values });
    }
    Ok(sheets)
}

fn find_record(file: impl Read + Seek) -> Result<Option<String>, FitsError> {
    let mut reader = FitsReader::open(file)?;
    let is_record = |hdu: &fits_well::io::Hdu| {
        hdu.is_image()
            && matches!(hdu.extname(), Ok(Some(name)) if name.eq_ignore_ascii_case(RECORD))
            && hdu.data_bytes <= LONGEST_RECORD as u64
    };
    let Some(place) = reader.hdus().iter().position(is_record) else { return Ok(None) };
    let bytes = reader.read_data_unit(place)?;
    Ok(Some(String::from_utf8_lossy(&bytes).into_owned()))
}
