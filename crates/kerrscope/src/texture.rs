//! Pictures that are laid over something: read from a file, sampled in linear light.
//!
//! - `u` runs from 0 at the left edge to 1 at the right, `v` from 0 at the top edge to
//!   1 at the bottom. The centre of pixel (i, j) is at ((i + ½)/width, (j + ½)/height).
//! - Files are PNG, JPEG, TIFF, WebP, Radiance HDR or OpenEXR, grey or RGB, with or
//!   without alpha. Integers of 8 or 16 bits are taken as sRGB, floating-point numbers as
//!   linear light of the same primaries; gamma chunks, colour profiles and chromaticities
//!   are not read. The orientation that a camera noted (EXIF) is applied.
//! - Light from floating-point numbers is kept with 16 bits (11 significant ones, from
//!   6e-8 to 65504, what is outside brought to these, what is no number dark). An EXR is
//!   read block by block into at most 256 MiB: one of 8192×4096 RGB is kept whole, a larger
//!   one is halved, by the mean of 2×2 pixels, until it fits. Pictures of other formats
//!   are decoded whole.
//! - A picture may have 16384×8192 pixels, in any shape with edges up to 65536, that are
//!   768 MiB when decoded. What is larger is refused before it takes memory or time.
//! - Integers are kept as the file has them, 1 to 8 bytes a pixel, and decoded through
//!   a table when sampled. That loses nothing, and a panorama of 8192×4096 takes 100 MB
//!   instead of the 400 MB of linear 32-bit numbers; linear 16-bit integers would merge
//!   the darkest steps of a 16-bit file.
//! - One picture is drawn, not read: the map of the Earth ([`earth`]).
//! - Colours are multiplied by alpha before they are interpolated: what colour a fully
//!   transparent pixel happens to have must not bleed into its neighbours.

pub mod earth;
mod error;
mod exr;
mod jpeg;
mod limits;
mod sphere;
mod tiff;
mod webp;

use std::fs::File;
use std::io::{Cursor, Read};
use std::path::Path;
use std::sync::LazyLock;

use half::f16;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

pub use error::{TextureError, TextureFault};
pub use sphere::Sphere;

use crate::display::srgb;
use crate::light::{Light, Sheet};

/// Bytes that a file may have.
const MAX_FILE_BYTES: u64 = 1 << 30;

static LINEAR_8: LazyLock<Vec<f32>> = LazyLock::new(|| linear_table(255));
static LINEAR_16: LazyLock<Vec<f32>> = LazyLock::new(|| linear_table(65535));

fn linear_table(top: u32) -> Vec<f32> {
    (0..=top).map(|code| srgb::decode(f64::from(code) / f64::from(top)) as f32).collect()
}

/// A picture in memory, sampled in linear light.
///
/// ```
/// use kerrscope::texture::Texture;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("two.png");
/// // A picture of two pixels, black and white.
/// image::save_buffer(&path, &[0, 255], 2, 1, image::ColorType::L8)?;
/// let texture = Texture::load(&path)?;
/// let middle = texture.sample(0.5, 0.5, false);
/// assert_eq!(middle.light.rgb, [0.5; 3]); // half the light, not half the code
/// assert_eq!(middle.opacity, 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq)]
pub struct Texture {
    width: u32,
    height: u32,
    /// 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha.
    channels: usize,
    texels: Texels,
}

#[derive(Clone, PartialEq)]
enum Texels {
    Eight(Vec<u8>),
    Sixteen(Vec<u16>),
    /// Linear light multiplied by alpha.
    Half(Vec<f16>),
}

/// Light multiplied by alpha, and alpha.
type Texel = [f64; 4];

impl Texture {
    /// Reads a picture file.
    ///
    /// # Errors
    /// When the file cannot be read, is empty, cut short, damaged or of another format,
    /// or when the picture is too large.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, TextureError> {
        let path = path.as_ref();
        read(path)
            .and_then(|bytes| Self::decode(&bytes))
            .map_err(|fault| TextureError { path: path.to_path_buf(), fault })
    }

    /// Decodes the contents of a picture file.
    ///
    /// # Errors
    /// As [`Texture::load`], without a path.
    pub fn decode(bytes: &[u8]) -> Result<Self, TextureFault> {
        if bytes.is_empty() {
            return Err(TextureFault::Empty);
        }
        let format = image::guess_format(bytes).map_err(|_| TextureFault::Foreign(None))?;
        let mut bytes = bytes;
        match format {
            ImageFormat::OpenExr => return exr::decode(bytes),
            ImageFormat::Png | ImageFormat::Hdr => {}
            ImageFormat::Tiff => tiff::check(bytes)?,
            ImageFormat::WebP => bytes = webp::whole(bytes).ok_or(TextureFault::Truncated)?,
            // The JPEG decoder fills what is missing with grey.
            ImageFormat::Jpeg if jpeg::is_whole(bytes) => {}
            ImageFormat::Jpeg => return Err(TextureFault::Truncated),
            other => {
                let name = other.extensions_str().first().map(|name| name.to_uppercase());
                return Err(TextureFault::Foreign(name));
            }
        }
        let memory = |bytes| {
            let mut limits = Limits::no_limits();
            limits.max_alloc = Some(bytes);
            limits
        };
        let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
        reader.limits(memory(limits::MAX_ANCILLARY_BYTES));
        let mut decoder = reader.into_decoder().map_err(TextureFault::from_image)?;
        let (width, height) = decoder.dimensions();
        limits::check(width, height, decoder.total_bytes())?;
        if format == ImageFormat::Jpeg {
            jpeg::check(bytes, width, height)?;
        }
        // The buffer of the picture itself and the decoder's own.
        decoder.set_limits(memory(2 * limits::MAX_BYTES)).map_err(TextureFault::from_image)?;
        let orientation = decoder.orientation().map_err(TextureFault::from_image)?;
        let mut image = DynamicImage::from_decoder(decoder).map_err(TextureFault::from_image)?;
        image.apply_orientation(orientation);
        Ok(Self::from_image(image))
    }

    fn from_image(image: DynamicImage) -> Self {
        let (width, height) = (image.width(), image.height());
        let (channels, texels) = match image {
            DynamicImage::ImageLuma8(i) => (1, Texels::Eight(i.into_raw())),
            DynamicImage::ImageLumaA8(i) => (2, Texels::Eight(i.into_raw())),
            DynamicImage::ImageRgb8(i) => (3, Texels::Eight(i.into_raw())),
            DynamicImage::ImageRgba8(i) => (4, Texels::Eight(i.into_raw())),
            DynamicImage::ImageLuma16(i) => (1, Texels::Sixteen(i.into_raw())),
            DynamicImage::ImageLumaA16(i) => (2, Texels::Sixteen(i.into_raw())),
            DynamicImage::ImageRgb16(i) => (3, Texels::Sixteen(i.into_raw())),
            DynamicImage::ImageRgb32F(i) => (3, Texels::Half(i.into_raw().into_iter().map(half).collect())),
            DynamicImage::ImageRgba32F(i) => {
                let times_alpha = |p: &[f32]| [p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]].map(half);
                (4, Texels::Half(i.as_raw().chunks_exact(4).flat_map(times_alpha).collect()))
            }
            other => (4, Texels::Sixteen(other.into_rgba16().into_raw())),
        };
        Self { width, height, channels, texels }
    }

    /// Width in pixels.
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Height in pixels.
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// Light (scaled by alpha) and alpha at a place, interpolated between the four
    /// nearest pixels. Beyond the edges the outermost pixels go on; with `wrap_u` the
    /// left edge continues the right one. Finite for any `u` and `v`.
    pub fn sample(&self, u: f64, v: f64, wrap_u: bool) -> Sheet {
        let (upper, lower, f) = clamped(v, self.height);
        sheet(mix(self.row(upper, u, wrap_u), self.row(lower, u, wrap_u), f))
    }

    /// Light of a pixel over black.
    pub(crate) fn light(&self, x: usize, y: usize) -> [f64; 3] {
        let [r, g, b, _] = self.texel(x, y);
        [r, g, b]
    }

    /// Whether the file holds light itself, and not codes for a screen.
    pub(crate) const fn is_linear(&self) -> bool {
        matches!(self.texels, Texels::Half(_))
    }

    fn row(&self, y: usize, u: f64, wrap: bool) -> Texel {
        let (left, right, f) = if wrap { wrapped(u, self.width) } else { clamped(u, self.width) };
        mix(self.texel(left, y), self.texel(right, y), f)
    }

    fn texel(&self, x: usize, y: usize) -> Texel {
        let at = (y * self.width as usize + x) * self.channels;
        let codes = at..at + self.channels;
        match &self.texels {
            Texels::Eight(all) => decoded(&all[codes], &LINEAR_8),
            Texels::Sixteen(all) => decoded(&all[codes], &LINEAR_16),
            Texels::Half(all) => arranged(&all[codes], f16::to_f64, f16::to_f64),
        }
    }
}

impl std::fmt::Debug for Texture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Texture")
            .field("width", &self.width)
            .field("height", &self.height)
            .field("channels", &self.channels)
            .finish_non_exhaustive()
    }
}

/// Decodes one pixel. `linear` has one entry a code, so its length tells the range.
fn decoded<C: Copy + Into<u32>>(codes: &[C], linear: &[f32]) -> Texel {
    let light = |code: C| f64::from(linear[code.into() as usize]);
    let alpha = |code: C| f64::from(code.into()) / (linear.len() - 1) as f64;
    let [r, g, b, a] = arranged(codes, light, alpha);
    [r * a, g * a, b * a, a]
}

/// The channels of one pixel as red, green, blue and alpha.
fn arranged<C: Copy>(channels: &[C], light: impl Fn(C) -> f64, alpha: impl Fn(C) -> f64) -> Texel {
    match *channels {
        [y] => [light(y), light(y), light(y), 1.0],
        [y, a] => [light(y), light(y), light(y), alpha(a)],
        [r, g, b] => [light(r), light(g), light(b), 1.0],
        [r, g, b, a] => [light(r), light(g), light(b), alpha(a)],
        _ => [0.0; 4],
    }
}

/// Light or alpha as it is kept.
fn half(x: f32) -> f16 {
    f16::from_f32(bounded(x))
}

/// Light or alpha within what can be kept.
fn bounded(x: f32) -> f32 {
    if x.is_nan() { 0.0 } else { x.clamp(0.0, f16::MAX.to_f32_const()) }
}

fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { 0.0 }
}

/// The pixels on both sides of a place, and how far it is from the first to the second.
fn clamped(u: f64, n: u32) -> (usize, usize, f64) {
    let last = f64::from(n - 1);
    let x = (finite(u) * f64::from(n) - 0.5).clamp(0.0, last);
    let i = x.floor();
    (i as usize, (i + 1.0).min(last) as usize, x - i)
}

fn wrapped(u: f64, n: u32) -> (usize, usize, f64) {
    let u = finite(u);
    let x = (u - u.floor()) * f64::from(n) - 0.5;
    let i = x.floor();
    let pixel = |i: f64| (i as i64).rem_euclid(i64::from(n)) as usize;
    (pixel(i), pixel(i + 1.0), x - i)
}

fn mix(a: Texel, b: Texel, f: f64) -> Texel {
    std::array::from_fn(|k| a[k] * (1.0 - f) + b[k] * f)
}

fn sheet([r, g, b, alpha]: Texel) -> Sheet {
    Sheet { light: Light::new([r, g, b]), opacity: alpha.min(1.0) }
}

fn read(path: &Path) -> Result<Vec<u8>, TextureFault> {
    let mut file = File::open(path)?;
    let mut bytes = Vec::new();
    file.by_ref().take(32).read_to_end(&mut bytes)?;
    // A foreign file may be a device without end; its beginning is enough to refuse it.
    if image::guess_format(&bytes).is_ok() {
        file.take(MAX_FILE_BYTES).read_to_end(&mut bytes)?;
    }
    if bytes.len() as u64 > MAX_FILE_BYTES {
        return Err(TextureFault::FileTooLarge);
    }
    Ok(bytes)
}
