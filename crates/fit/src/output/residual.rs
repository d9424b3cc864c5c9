//! What a fit leaves of a picture, as pictures to look at and as numbers.

use std::io::{self, Write};
use std::path::Path;

use fits_well::header::{CommentaryName, Header};
use fits_well::image::{Borrowed, Scaling, View};
use fits_well::{FitsError, FitsWriter};
use kerrscope::display::{Colormap, NO_VALUE};
use kerrscope::output::FileError;
use kerrscope::output::file::write_atomically;

use super::Record;
use crate::diagnostics::quantile;
use crate::fit::{Fit, Image};

/// The longer side of a panel is at least so many pixels long.
const PANEL: usize = 256;
/// Pixels between panels, and their colour.
const GAP: usize = 8;
const GROUND: [u8; 3] = [255; 3];

/// Residuals at the ends of the colours are at least so many standard deviations.
const LEAST: f64 = 3.0;
/// The share of the pixels whose residuals lie between the ends of the colours.
const SHOWN: f64 = 0.995;

/// Colours of residuals, each channel from 0 to 255: from dark blue for too little light, over white, to dark red for too much.
/// They are those of ColorBrewer's RdBu of nine classes, turned around, with white in the middle
/// (<https://colorbrewer2.org>); straight lines lie between them.
const DIVERGING: [[f64; 3]; 9] = [
    [33.0, 102.0, 172.0],
    [67.0, 147.0, 195.0],
    [146.0, 197.0, 222.0],
    [209.0, 229.0, 240.0],
    [255.0, 255.0, 255.0],
    [253.0, 219.0, 199.0],
    [244.0, 165.0, 130.0],
    [214.0, 96.0, 77.0],
    [178.0, 24.0, 43.0],
];

/// A picture, the best fit to it, and what is left. All have one number a pixel, along the rows, the top row first.
#[derive(Clone, Debug, PartialEq)]
pub struct Residual {
    /// Width and height.
    pub size: [usize; 2],
    /// Angle of a pixel on the sky, µas, if it is known.
    pub pixel: Option<f64>,
    /// The picture.
    pub data: Vec<f64>,
    /// The model where the posterior is highest.
    pub best: Vec<f64>,
    /// Standard deviation σ of each pixel's error, in the picture's unit.
    pub error: Vec<f64>,
    /// (data − best)/σ, above 0 where there is more light than the model has. Not a number where σ is 0.
    pub residual: Vec<f64>,
}

impl Residual {
    /// What a fit leaves of the picture that it was made of.
    ///
    /// # Panics
    /// When the fit is one of a picture of another number of pixels.
    pub fn of(image: &Image, fit: &Fit) -> Self {
        let pixels = image.size[0] * image.size[1];
        let counts = [image.values.len(), fit.best.values.len(), fit.errors.len()];
        assert_eq!(counts, [pixels; 3], "one value a pixel");
        let pairs = image.values.iter().zip(&fit.best.values).zip(&fit.errors);
        let left = |((data, best), error): ((&f64, &f64), &f64)| {
            if *error > 0.0 { (data - best) / error } else { f64::NAN }
        };
        Self {
            size: image.size,
            pixel: image.pixel,
            data: image.values.clone(),
            best: fit.best.values.clone(),
            error: fit.errors.clone(),
            residual: pairs.map(left).collect(),
        }
    }

    /// The residual at the upper end of the colours, in standard deviations: 3, or more where more than 0.5 % of the pixels are farther
    /// off. The lower end is its opposite.
    pub fn reach(&self) -> f64 {
        let mut amounts: Vec<f64> = self.residual.iter().map(|r| r.abs()).filter(|r| r.is_finite()).collect();
        amounts.sort_by(f64::total_cmp);
        if amounts.is_empty() { LEAST } else { quantile(&amounts, SHOWN).max(LEAST) }
    }

    /// The ends of the colours of the picture and of the best fit: the least and the largest number in both.
    pub fn range(&self) -> [f64; 2] {
        let both = || self.data.iter().chain(&self.best).copied().filter(|value| value.is_finite());
        [both().fold(f64::INFINITY, f64::min), both().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// How often each pixel is repeated to either side in pictures to look at.
    fn factor(&self) -> usize {
        PANEL.div_ceil(self.size[0].max(self.size[1]).max(1))
    }

    /// Width and height of the three panels, and their pixels, along the rows, the top row first: the picture, the best fit and the
    /// residual, from left to right.
    ///
    /// The picture and the best fit are in the colours of inferno over [`range`](Self::range), so that equal colours are equal numbers;
    /// the residual is blue below 0, white at 0 and red above, over ±[`reach`](Self::reach), beyond which colours stay the same. Numbers
    /// that are not finite are grey. Each pixel is a square of whole pixels, with which the longer side is at least 256 long.
    pub fn panels(&self) -> ([usize; 2], Vec<[u8; 3]>) {
        let factor = self.factor();
        let [low, high] = self.range();
        let light = |value: f64| {
            let place = if high > low { (value - low) / (high - low) } else { 0.0 };
            bytes(if value.is_finite() { Colormap::Inferno.color(place) } else { NO_VALUE })
        };
        let reach = self.reach();
        let panels: [Vec<[u8; 3]>; 3] = [
            self.data.iter().map(|value| light(*value)).collect(),
            self.best.iter().map(|value| light(*value)).collect(),
            self.residual.iter().map(|value| bytes(diverging(value / reach))).collect(),
        ];
        let [columns, rows] = self.size;
        let size = [3 * columns * factor + 2 * GAP, rows * factor];
        let mut pixels = Vec::with_capacity(size[0] * size[1]);
        for row in 0..rows {
            let from = pixels.len();
            for (k, panel) in panels.iter().enumerate() {
                if k > 0 {
                    pixels.extend([GROUND; GAP]);
                }
                let row = &panel[row * columns..(row + 1) * columns];
                pixels.extend(row.iter().flat_map(|color| std::iter::repeat_n(*color, factor)));
            }
            for _ in 1..factor {
                pixels.extend_from_within(from..from + size[0]);
            }
        }
        (size, pixels)
    }

    /// Writes the [`panels`](Self::panels) as a PNG, whole or not at all. Its text says how the fit was made and what the ends of the
    /// colours are.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_png(&self, path: &Path, record: &Record<'_>) -> Result<(), FileError> {
        write_atomically(path, |to| self.encode_png(to, record))
    }

    /// Writes the same to any place that takes bytes.
    ///
    /// # Errors
    /// When that place fails.
    pub fn encode_png(&self, to: impl Write, record: &Record<'_>) -> io::Result<()> {
        let ([width, height], pixels) = self.panels();
        let sides = [width, height].map(u32::try_from);
        let [Ok(width), Ok(height)] = sides else {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "the picture is too large for a PNG"));
        };
        let mut encoder = png::Encoder::new(to, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::Fast);
        let ([low, high], reach) = (self.range(), self.reach());
        let colors =
            format!("data and best = {low:e} to {high:e}\nresidual = -{reach:.3} to {reach:.3} sigma");
        let software = format!("{} {}", Record::PROGRAM, Record::VERSION);
        for (keyword, text) in [("Software", software), ("Fit", record.to_string()), ("Colors", colors)] {
            // PNG forbids U+0000 in text.
            encoder.add_itxt_chunk(keyword.to_owned(), text.replace('\0', "\u{FFFD}")).map_err(plain_png)?;
        }
        let mut writer = encoder.write_header().map_err(plain_png)?;
        writer.write_image_data(pixels.as_flattened()).map_err(plain_png)?;
        writer.finish().map_err(plain_png)
    }

    /// Writes the numbers as a FITS file, whole or not at all: the images `data` (the primary one), `best`, `residual` and `error`, named
    /// in EXTNAME, of 64-bit floating-point numbers. The picture's lowest row is the first. The axes are offsets from the picture's
    /// middle, to the right and up, in µas where the angle of a pixel is known, otherwise in pixels.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_fits(&self, path: &Path, record: &Record<'_>) -> Result<(), FileError> {
        write_atomically(path, |to| self.encode_fits(to, record))
    }

    /// Writes the same to any place that takes bytes.
    ///
    /// # Errors
    /// When that place fails.
    pub fn encode_fits(&self, to: impl Write, record: &Record<'_>) -> io::Result<()> {
        self.encode_fits_plainly(to, record).map_err(|error| match error {
            FitsError::Io(e) => e,
            other => io::Error::other(other.to_string()),
        })
    }

    fn encode_fits_plainly(&self, to: impl Write, record: &Record<'_>) -> Result<(), FitsError> {
        let mut writer = FitsWriter::new(to).with_checksums();
        let [width, _] = self.size;
        let images = [
            ("data", "the picture", &self.data),
            ("best", "the model where the posterior is highest", &self.best),
            ("residual", "(data - best)/error", &self.residual),
            ("error", "standard deviation of each pixel's error", &self.error),
        ];
        for (k, (name, title, values)) in images.into_iter().enumerate() {
            let mut header = Header::new();
            header.set("EXTNAME", name)?;
            header.push_commentary(CommentaryName::COMMENT, title)?;
            self.axes(&mut header)?;
            if k == 0 {
                for line in record.to_string().lines().flat_map(cards) {
                    header.push_commentary(CommentaryName::HISTORY, &line)?;
                }
            }
            // FITS counts from the lower left corner.
            let from_below: Vec<f64> = values.chunks(width).rev().flatten().copied().collect();
            let image = Borrowed::new(&self.size, View::F64(&from_below), Scaling::IDENTITY)?;
            writer.write_image(image, Some(&header))?;
        }
        Ok(())
    }

    fn axes(&self, header: &mut Header) -> Result<(), FitsError> {
        let names = [
            ["CTYPE1", "CRPIX1", "CRVAL1", "CDELT1", "CUNIT1"],
            ["CTYPE2", "CRPIX2", "CRVAL2", "CDELT2", "CUNIT2"],
        ];
        let unit = if self.pixel.is_some() { "uarcsec" } else { "pixel" };
        for ((names, axis), side) in names.into_iter().zip(["X", "Y"]).zip(self.size) {
            header.set(names[0], axis)?;
            header.set(names[1], 0.5 * side as f64 + 0.5)?;
            header.set(names[2], 0.0)?;
            header.set(names[3], self.pixel.unwrap_or(1.0))?;
            header.set(names[4], unit)?;
        }
        Ok(())
    }
}

/// The colour of a residual as a share of the largest shown, in the encoding of sRGB, each component from 0 to 1.
fn diverging(share: f64) -> [f64; 3] {
    if share.is_nan() {
        return NO_VALUE;
    }
    let place = (share.clamp(-1.0, 1.0) + 1.0) * 0.5 * (DIVERGING.len() - 1) as f64;
    let below = (place as usize).min(DIVERGING.len() - 2);
    let along = place - below as f64;
    let [from, to] = [DIVERGING[below], DIVERGING[below + 1]];
    std::array::from_fn(|k| (from[k] + along * (to[k] - from[k])) / 255.0)
}

fn bytes(color: [f64; 3]) -> [u8; 3] {
    color.map(|part| (255.0 * part).round() as u8)
}

/// A line in pieces that a header takes: 70 characters at most, and ? for what is no ASCII.
fn cards(line: &str) -> Vec<String> {
    let ascii = |c: char| if (' '..='~').contains(&c) { c } else { '?' };
    let line: Vec<char> = line.chars().map(ascii).collect();
    line.chunks(70).map(|piece| piece.iter().collect()).collect()
}

fn plain_png(error: png::EncodingError) -> io::Error {
    match error {
        png::EncodingError::IoError(e) => e,
        other => io::Error::other(other),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use fits_well::FitsReader;

    use super::*;
    use crate::output::synthetic;

    const RECORD: Record<'_> = Record { seed: 7, model: &[] };

    /// The best fit is half the picture, errors are a quarter of its brightest pixel: residuals go from 0 to 2.
    fn residual(size: [usize; 2]) -> Residual {
        let image = synthetic::image(size);
        Residual::of(&image, &synthetic::fit(&image))
    }

    #[test]
    fn residuals_are_in_errors() {
        let found = residual([10, 8]);
        assert_eq!((found.residual[0], found.residual[79]), (0.0, 2.0));
        assert_eq!((found.reach(), found.range()), (3.0, [0.0, 1.0]));
        let mut wild = found.clone();
        wild.residual = (0..1001).map(|k| f64::from(k) * -0.1).collect();
        assert!((wild.reach() - 99.5).abs() < 1e-9, "{}", wild.reach());
        // Where there is no error there is no residual.
        let image = synthetic::image([10, 8]);
        let mut fit = synthetic::fit(&image);
        fit.errors[3] = 0.0;
        let found = Residual::of(&image, &fit);
        assert!(found.residual[3].is_nan() && found.residual[4].is_finite());
    }

    #[test]
    fn colors_diverge() {
        assert_eq!(bytes(diverging(0.0)), [255; 3]);
        assert_eq!(bytes(diverging(1.0)), [178, 24, 43]);
        assert_eq!(bytes(diverging(-7.0)), [33, 102, 172]);
        assert_eq!(bytes(diverging(0.125)), [254, 237, 227]);
        assert_eq!(diverging(f64::NAN), NO_VALUE);
    }

    #[test]
    fn png_has_three_panels() -> Result<(), Box<dyn std::error::Error>> {
        let found = residual([10, 8]);
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("residual.png");
        found.write_png(&path, &RECORD)?;
        let mut reader = png::Decoder::new(Cursor::new(std::fs::read(&path)?)).read_info()?;
        // 26 is the least whole number with which 10 pixels become 256 or more.
        let [side, height] = [260, 208];
        assert_eq!((reader.info().width as usize, reader.info().height as usize), (3 * side + 16, height));
        let texts = &reader.info().utf8_text;
        let text = texts.iter().find(|text| text.keyword == "Fit").ok_or("no text")?.get_text()?;
        assert!(text.contains("seed = 7"), "{text}");
        let mut values = vec![0; reader.output_buffer_size().ok_or("too large")?];
        reader.next_frame(&mut values)?;
        let at = |x: usize, y: usize| -> [u8; 3] {
            let from = 3 * (y * (3 * side + 16) + x);
            [values[from], values[from + 1], values[from + 2]]
        };
        let inferno = |t| bytes(Colormap::Inferno.color(t));
        let last = side - 1;
        assert_eq!((at(0, 0), at(last, height - 1)), (inferno(0.0), inferno(1.0)));
        // A pixel is 26 × 26.
        assert_eq!(
            (at(25, 25), at(26, 0), at(0, 26)),
            (inferno(0.0), inferno(1.0 / 79.0), inferno(10.0 / 79.0))
        );
        assert_eq!(at(side + 8 + last, height - 1), inferno(0.5));
        assert_eq!((at(side, 0), at(side + 7, 0), at(2 * side + 15, 5)), (GROUND, GROUND, GROUND));
        assert_eq!(at(2 * side + 16, 0), [255; 3]);
        assert_eq!(at(3 * side + 15, height - 1), bytes(diverging(2.0 / 3.0)));
        Ok(())
    }

    #[test]
    fn fits_is_read_back() -> Result<(), Box<dyn std::error::Error>> {
        let found = residual([10, 8]);
        let mut file = Vec::new();
        let model = [("blur".to_owned(), "2 µas".to_owned())];
        found.encode_fits(&mut file, &Record { seed: 7, model: &model })?;
        let mut reader = FitsReader::open(Cursor::new(file))?;
        let all = [("data", &found.data), ("best", &found.best), ("residual", &found.residual)];
        for (k, (name, values)) in all.into_iter().chain([("error", &found.error)]).enumerate() {
            assert_eq!(reader.hdus()[k].extname()?, Some(name));
            let bytes = reader.read_data_unit(k)?;
            let read: Vec<f64> = bytes.chunks_exact(8).take(80).map(big_endian).collect();
            let upright: Vec<f64> = read.chunks(10).rev().flatten().copied().collect();
            assert_eq!(&upright, values, "{name}");
        }
        assert_eq!(reader.hdus().len(), 4);
        Ok(())
    }

    fn big_endian(bytes: &[u8]) -> f64 {
        f64::from_be_bytes(std::array::from_fn(|k| bytes[k]))
    }
}
