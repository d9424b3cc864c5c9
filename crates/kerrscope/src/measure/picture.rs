//! Pictures of anybody's, read to be measured: numbers of light, and how large a pixel is where the file says so.
//!
//! Row 0 is at the top. Light is linear:
//!
//! - FITS: the first image with data, in its own unit, times BSCALE plus BZERO; of two axes, or of more of which the rest have
//!   the length 1. The first row of a file is the lowest (FITS standard 4.0, §8). Files of this program that hold no flux
//!   have `red`, `green` and `blue`, whose mean is taken.
//! - OpenEXR: the channel `intensity` if there is one, else the mean of R, G and B, else Y.
//! - PNG, JPEG, TIFF, WebP and Radiance HDR as [`Texture`] reads them: sRGB decoded, the mean of the channels, and what is
//!   transparent is black. Integers are what was made for a screen: a tone curve may have been at
//!   work, so that places of edges hold but ratios of brightness do not ([`Picture::trusted_brightness`]).
//!
//! The mean of the channels and not their luminance, because colours stand for nothing here: a picture in one colour is
//! measured like the same in another.

mod error;
mod exr;
mod fits;

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use serde::Serialize;

pub use error::{PictureError, PictureFault};

use crate::camera::Camera;
use crate::output::{Format, Provenance};
use crate::scene::Scene;
use crate::texture::{Texture, TextureFault};

/// Pixels along an edge.
const MAX_EDGE: usize = 16384;
/// Pixels in all.
const MAX_PIXELS: usize = 1 << 26;
/// Bytes of a file.
const MAX_BYTES: u64 = 1 << 30;

/// How large a pixel is. Pixels are square.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PixelScale {
    /// Its side on the sky in µas, if known.
    pub microarcseconds: Option<f64>,
    /// Its side in M at the distance of the hole, at the middle of the picture, if known.
    pub gravitational_radii: Option<f64>,
}

/// A picture in linear light.
///
/// ```
/// use kerrscope::measure::Picture;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("two.png");
/// image::save_buffer(&path, &[0, 188], 2, 1, image::ColorType::L8)?;
/// let picture = Picture::open(&path)?;
/// assert_eq!((picture.width, picture.height), (2, 1));
/// assert!((picture.values[1] - 0.5).abs() < 0.01); // half the light
/// assert!(!picture.trusted_brightness);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels along the top edge, 1 to 16384.
    pub width: usize,
    /// Pixels along the left edge, 1 to 16384.
    pub height: usize,
    /// Linear light, one finite number a pixel, along the rows, the top row first. Not all are equal.
    pub values: Vec<f64>,
    /// Linear red, green and blue of each pixel, where the file has colours.
    pub colour: Option<Vec<[f64; 3]>>,
    /// How large a pixel is, as far as the file says.
    pub pixel: PixelScale,
    /// Whether the numbers are a physical quantity (FITS with an intensity) and no colours.
    pub physical: bool,
    /// Whether ratios of values are ratios of light: not so where a tone curve or a colour map may have been at work.
    pub trusted_brightness: bool,
    /// How this program made the picture, if it did and says so.
    pub provenance: Option<Provenance>,
}

/// What a decoder finds.
struct Decoded {
    width: usize,
    height: usize,
    values: Vec<f64>,
    colour: Option<Vec<[f64; 3]>>,
    pixel: PixelScale,
    physical: bool,
    trusted: bool,
}

impl Picture {
    /// Reads a picture file.
    ///
    /// # Errors
    /// When the file cannot be read, is no picture or damaged; when the picture is larger than 16384 pixels along an edge or 2²⁶
    /// in all; when a pixel is no finite number, or all are equal.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, PictureError> {
        let path = path.as_ref();
        let wrong = |fault| PictureError { path: path.to_path_buf(), fault };
        let bytes = read(path).map_err(wrong)?;
        let mut picture = Self::decode(&bytes).map_err(wrong)?;
        picture.provenance = Format::of(path).and_then(|format| format.read_provenance(path).ok());
        picture.learn_scale(path);
        Ok(picture)
    }

    /// Decodes the contents of a picture file; what the file says of its making is not looked for.
    ///
    /// # Errors
    /// As [`Picture::open`], without a path.
    pub fn decode(bytes: &[u8]) -> Result<Self, PictureFault> {
        let found = if bytes.starts_with(b"SIMPLE  =") {
            fits::decode(bytes)?
        } else if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
            exr::decode(bytes)?
        } else {
            screen(bytes)?
        };
        let Decoded { width, height, values, colour, pixel, physical, trusted } = found;
        check_values(width, &values)?;
        Ok(Self {
            width,
            height,
            values,
            colour,
            pixel,
            physical,
            trusted_brightness: trusted,
            provenance: None,
        })
    }

    /// A picture of given values, along the rows, the top row first.
    ///
    /// # Errors
    /// When there is not one value a pixel, one is not finite, or all are equal.
    pub fn of_values(width: usize, height: usize, values: Vec<f64>) -> Result<Self, PictureFault> {
        check_size(width, height)?;
        if values.len() != width * height {
            return Err(PictureFault::Count { values: values.len(), width, height });
        }
        check_values(width, &values)?;
        let pixel = PixelScale::default();
        Ok(Self {
            width,
            height,
            values,
            colour: None,
            pixel,
            physical: false,
            trusted_brightness: true,
            provenance: None,
        })
    }

    /// The scene that the picture was made of, if it is this program's and the scene's files are not needed.
    pub fn scene(&self, folder: &Path) -> Option<Scene> {
        let made = self.provenance.as_ref()?;
        let scene = Scene::from_record("the picture's scene", &made.scene_toml, &[], folder).ok()?;
        // A legend makes a picture higher than its scene.
        let size = [scene.render.width, scene.render.height].map(|n| n as usize);
        (size == [self.width, self.height]).then_some(scene)
    }

    /// What the picture's own scene says of a pixel's size.
    fn learn_scale(&mut self, path: &Path) {
        let Some(scene) = self.scene(path.parent().unwrap_or(Path::new(""))) else { return };
        if scene.display.layer.is_some() && Format::of(path) == Some(Format::Png) {
            self.trusted_brightness = false;
        }
        let size = Camera::new(&scene).ok().map(|camera| camera.pixel_size()).filter(|size| size.is_finite());
        self.pixel.gravitational_radii = self.pixel.gravitational_radii.or(size);
        let angle = size.zip(scene.units.microarcseconds()).map(|(size, angle)| size * angle);
        self.pixel.microarcseconds = self.pixel.microarcseconds.or(angle);
    }
}

fn read(path: &Path) -> Result<Vec<u8>, PictureFault> {
    let file = File::open(path).map_err(TextureFault::from)?;
    let mut bytes = Vec::new();
    let mut file = file.take(MAX_BYTES + 1);
    // A foreign file may be a device without end; its beginning is enough to refuse it.
    file.by_ref().take(32).read_to_end(&mut bytes).map_err(|error| match error.kind() {
        ErrorKind::UnexpectedEof => TextureFault::Truncated,
        _ => TextureFault::from(error),
    })?;
    if bytes.starts_with(b"SIMPLE  =") || image::guess_format(&bytes).is_ok() {
        file.read_to_end(&mut bytes).map_err(TextureFault::from)?;
    }
    if bytes.len() as u64 > MAX_BYTES {
        return Err(TextureFault::FileTooLarge.into());
    }
    Ok(bytes)
}

/// Pictures for screens.
fn screen(bytes: &[u8]) -> Result<Decoded, PictureFault> {
    let texture = Texture::decode(bytes)?;
    let [width, height] = [texture.width(), texture.height()].map(|n| n as usize);
    check_size(width, height)?;
    let colour: Vec<[f64; 3]> =
        (0..height).flat_map(|y| (0..width).map(move |x| [x, y])).map(|[x, y]| texture.light(x, y)).collect();
    let trusted = texture.is_linear();
    Ok(Decoded {
        width,
        height,
        values: means(&colour),
        colour: Some(colour),
        pixel: PixelScale::default(),
        physical: false,
        trusted,
    })
}

fn means(colour: &[[f64; 3]]) -> Vec<f64> {
    colour.iter().map(|[r, g, b]| (r + g + b) / 3.0).collect()
}

fn check_size(width: usize, height: usize) -> Result<(), PictureFault> {
    if width == 0 || height == 0 {
        return Err(PictureFault::NoPixels);
    }
    if width.max(height) > MAX_EDGE || width * height > MAX_PIXELS {
        return Err(PictureFault::TooLarge { width, height });
    }
    Ok(())
}

fn check_values(width: usize, values: &[f64]) -> Result<(), PictureFault> {
    let wrong = |value: &f64| !value.is_finite();
    if let Some(first) = values.iter().position(wrong) {
        let count = values.iter().filter(|value| wrong(value)).count();
        return Err(PictureFault::NotFinite {
            count,
            of: values.len(),
            column: first % width,
            row: first / width,
        });
    }
    let first = values[0];
    if values.iter().all(|value| value.to_bits() == first.to_bits()) {
        return Err(PictureFault::Constant { value: first });
    }
    Ok(())
}
