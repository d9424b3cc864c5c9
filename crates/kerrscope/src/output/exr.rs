//! Pictures and data layers as OpenEXR files.
//!
//! One part, its channels 32-bit floating-point numbers compressed without loss (ZIP):
//!
//! - `R`, `G`, `B`: linear light of the primaries of Rec. 709 and the white of D65, in which 1 is the white of
//!   the display before exposure;
//! - the data layers of the scene by the names of [`Channel::name`](crate::render::Channel::name): `n0.g`, `sky_theta`, `Z`.
//!   What a ray does not have is NaN.
//!
//! The header says in `comments` what each channel is, and its unit; in `kerrscope` how the file
//! was made (see [`Provenance`]). Both are UTF-8. The same picture is the same bytes.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufReader, Cursor, Read, Write};
use std::path::Path;

use exr::error::Error;
use exr::meta::MetaData;
use exr::meta::attribute::{AttributeValue, Chromaticities};
use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, Text, Vec2, WritableImage,
};

use super::file::write_atomically;
use super::{FileError, Provenance};
use crate::render::Film;

/// Name of the attribute that says how a file was made.
const ATTRIBUTE: &str = "kerrscope";

/// Writes a picture with its data layers, whole or not at all.
///
/// # Errors
/// When the file cannot be written.
pub fn write(path: &Path, film: &Film, provenance: &Provenance) -> Result<(), FileError> {
    write_atomically(path, |to| encode(to, film, provenance))
}

/// Writes a picture with its data layers to any place that takes bytes.
///
/// # Errors
/// When that place fails.
pub fn encode(mut to: impl Write, film: &Film, provenance: &Provenance) -> io::Result<()> {
    let light = ["R", "G", "B"].into_iter().enumerate();
    let light = light.map(|(k, name)| (name.into(), film.light.iter().map(|rgb| rgb[k]).collect()));
    let planes = film.planes.iter().map(|plane| (plane.channel.name(), plane.values.clone()));
    let channels = light.chain(planes).map(|(name, values)| AnyChannel {
        name: text(&name),
        sample_data: FlatSamples::F32(values),
        quantize_linearly: false,
        sampling: Vec2(1, 1),
    });
    let attributes = LayerAttributes {
        comments: Some(text(&comments(film))),
        // More than one here would be written in an order that changes from run to run.
        other: HashMap::from([(text(ATTRIBUTE), AttributeValue::Text(text(&provenance.to_string())))]),
        ..LayerAttributes::default()
    };
    let size = (film.width as usize, film.height as usize);
    let layer = Layer::new(size, attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(channels.collect()));
    let mut image = Image::from_layer(layer);
    // IEC 61966-2-1.
    image.attributes.chromaticities = Some(Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.30, 0.60),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.3290),
    });
    let mut file = Cursor::new(Vec::new());
    image.write().to_buffered(&mut file).map_err(plain)?;
    to.write_all(file.get_ref())
}

/// What the channels are.
fn comments(film: &Film) -> String {
    let light = "R, G, B: linear light, Rec. 709 primaries, white D65 = 1 [1]".to_owned();
    let planes = film.planes.iter().map(|plane| {
        let (name, title, unit) = (plane.channel.name(), plane.channel.title(), plane.channel.layer.unit());
        format!("{name}: {title} [{}]", if unit.is_empty() { "1" } else { unit })
    });
    let note = (!film.planes.is_empty()).then(|| {
        "Layers are of the ray through the pixel's centre, in Boyer-Lindquist coordinates. \
         NaN: there is none. Fates: 0 from infinity, 1 from the horizon, 2 given up."
            .to_owned()
    });
    std::iter::once(light).chain(planes).chain(note).collect::<Vec<_>>().join("\n")
}

/// OpenEXR's text is bytes, and UTF-8 by its specification.
fn text(utf8: &str) -> Text {
    Text::from_slice_unchecked(utf8.as_bytes())
}

fn plain(error: Error) -> io::Error {
    match error {
        Error::Io(e) => e,
        other => io::Error::other(other.to_string()),
    }
}

/// Reads from an OpenEXR file how it was made.
///
/// # Errors
/// When the file cannot be read, is no OpenEXR file, or holds no record of this program.
pub fn read_provenance(path: &Path) -> Result<Provenance, FileError> {
    let file = File::open(path).map_err(|e| FileError::read(path, &e))?;
    decode_provenance(BufReader::new(file), path)
}

/// Reads from the contents of an OpenEXR file how it was made. `path` is what errors call it.
///
/// # Errors
/// As [`read_provenance`].
pub fn decode_provenance(file: impl Read, path: &Path) -> Result<Provenance, FileError> {
    let meta = MetaData::read_from_buffered(file, false).map_err(|error| match error {
        Error::Io(e) if e.kind() != io::ErrorKind::UnexpectedEof => FileError::read(path, &e),
        other => FileError::new("read", path, other.to_string(), "give an OpenEXR file that is whole"),
    })?;
    let found = meta.headers.iter().find_map(|header| {
        let [own, shared] = [&header.own_attributes.other, &header.shared_attributes.other];
        match own.get(&text(ATTRIBUTE)).or_else(|| shared.get(&text(ATTRIBUTE))) {
            Some(AttributeValue::Text(text)) => Some(String::from_utf8_lossy(text.as_slice()).into_owned()),
            _ => None,
        }
    });
    Provenance::from_file(path, found)
}
