//! Pictures in FITS files.

use std::f64::consts::PI;

use fits_well::header::Header;
use fits_well::io::SliceReader;
use fits_well::{FitsError, FitsReader};

use super::{Decoded, PictureFault, PixelScale, check_size, means};

/// Degrees in a µas.
const MICROARCSECOND: f64 = 1.0 / 3.6e9;

/// The first image with data. Its rows are turned to the top row first, and its columns so that East is left.
pub(super) fn decode(bytes: &[u8]) -> Result<Decoded, PictureFault> {
    let mut reader = FitsReader::from_bytes(bytes).map_err(|e| damaged(&e))?;
    let images: Vec<usize> = (0..reader.hdus().len()).filter(|&k| holds(&reader.hdus()[k])).collect();
    let first = *images.first().ok_or_else(|| match reader.scan_defect() {
        Some(defect) => PictureFault::Damaged(defect.to_string()),
        None => PictureFault::NoImage,
    })?;
    let named = |reader: &SliceReader<'_>, name: &str| {
        let is = |k: &usize| matches!(reader.hdus()[*k].extname(), Ok(Some(own)) if own.eq_ignore_ascii_case(name));
        images.iter().copied().find(is)
    };
    let colours = ["red", "green", "blue"].map(|name| named(&reader, name));
    let sheet = read(&mut reader, first)?;
    let Sheet { width, height, values, pixel } = sheet;
    if let [Some(red), Some(green), Some(blue)] = colours
        && red == first
    {
        let [green, blue] = [read(&mut reader, green)?, read(&mut reader, blue)?];
        if [green.width, green.height, blue.width, blue.height] == [width, height, width, height] {
            let rest = green.values.iter().zip(&blue.values);
            let colour: Vec<[f64; 3]> = values.iter().zip(rest).map(|(&r, (&g, &b))| [r, g, b]).collect();
            let values = means(&colour);
            let colour = Some(colour);
            return Ok(Decoded { width, height, values, colour, pixel, physical: false, trusted: true });
        }
    }
    Ok(Decoded { width, height, values, colour: None, pixel, physical: true, trusted: true })
}

/// An image as it is in the file's sense, turned to ours.
struct Sheet {
    width: usize,
    height: usize,
    values: Vec<f64>,
    pixel: PixelScale,
}

fn holds(hdu: &fits_well::io::Hdu) -> bool {
    let record = matches!(hdu.extname(), Ok(Some(name)) if name.eq_ignore_ascii_case("KERRSCOPE"));
    hdu.is_image() && hdu.data_bytes > 0 && !record
}

fn read(reader: &mut SliceReader<'_>, number: usize) -> Result<Sheet, PictureFault> {
    let hdu = &reader.hdus()[number];
    let shape = hdu.image_metadata().map_err(|e| damaged(&e))?.shape.to_vec();
    if shape.len() < 2 || shape[2..].iter().any(|&n| n != 1) {
        let text: Vec<String> = shape.iter().map(ToString::to_string).collect();
        return Err(PictureFault::Axes(text.join("×")));
    }
    let (width, height) = (shape[0], shape[1]);
    check_size(width, height)?;
    let axes = Axes::of(&hdu.header)?;
    let mut stored = Vec::new();
    reader
        .image(number)
        .and_then(|mut image| image.physical_into(.., &mut stored))
        .map_err(|e| damaged(&e))?;
    if stored.len() != width * height {
        return Err(PictureFault::Damaged("it ends before the picture does".to_owned()));
    }
    let mut rows: Vec<&[f64]> = stored.chunks_exact(width).collect();
    if !axes.top_first {
        rows.reverse();
    }
    let values = if axes.mirrored {
        rows.into_iter().flat_map(|row| row.iter().rev().copied()).collect()
    } else {
        rows.concat()
    };
    Ok(Sheet { width, height, values, pixel: axes.pixel })
}

/// What a header says of the axes.
struct Axes {
    pixel: PixelScale,
    /// The first row is the top one: the second coordinate falls.
    top_first: bool,
    /// East is right in the file.
    mirrored: bool,
}

impl Axes {
    /// CDELTi or CDi_i, CUNITi and CTYPEi (FITS standard 4.0, §8.2), without rotation; THETAG, and axes X in M, as this program writes.
    fn of(header: &Header) -> Result<Self, PictureFault> {
        let real = |name: &str| header.get_real(name).ok().flatten().filter(|x| x.is_finite() && *x != 0.0);
        let text = |name: &str| header.get_text(name).ok().flatten().unwrap_or_default().trim().to_owned();
        let step = |cdelt: &str, cd: &str| real(cd).or_else(|| real(cdelt));
        let (Some(x), Some(y)) = (step("CDELT1", "CD1_1"), step("CDELT2", "CD2_2")) else {
            return Ok(Self { pixel: PixelScale::default(), top_first: false, mirrored: false });
        };
        let kind = text("CTYPE1").to_uppercase();
        let on_sky = kind.starts_with("RA") || kind.starts_with("GLON");
        let degrees = match (text("CUNIT1").to_lowercase().as_str(), on_sky) {
            ("deg" | "degree" | "degrees", _) | ("", true) => Some(1.0),
            ("rad", _) => Some(180.0 / PI),
            ("arcmin", _) => Some(1.0 / 60.0),
            ("arcsec", _) => Some(1.0 / 3600.0),
            ("mas", _) => Some(1.0 / 3.6e6),
            ("uas", _) => Some(MICROARCSECOND),
            _ => None,
        };
        if (x.abs() / y.abs() - 1.0).abs() > 1e-6 && (degrees.is_some() || kind == "X") {
            return Err(PictureFault::NotSquare(x.abs(), y.abs()));
        }
        let microarcseconds = degrees.map(|unit| x.abs() * unit / MICROARCSECOND);
        let ours = text("TELESCOP") == "kerrscope";
        let gravitational_radii = if ours && kind == "X" {
            Some(x.abs())
        } else {
            microarcseconds.zip(real("THETAG").filter(|angle| ours && *angle > 0.0)).map(|(a, m)| a / m)
        };
        let pixel = PixelScale { microarcseconds, gravitational_radii };
        Ok(Self { pixel, top_first: y < 0.0, mirrored: on_sky && x > 0.0 })
    }
}

fn damaged(error: &FitsError) -> PictureFault {
    PictureFault::Damaged(error.to_string())
}
