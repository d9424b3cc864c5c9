//! How large a picture may be.
//!
//! So that no file takes more than 2 GB of memory, nor a file below 1 MB more than some seconds:
//! compressed, a picture can have a thousandth of its size, and less. While it is read, a picture
//! exists twice at most (decoded by TIFF or WebP into a buffer of their own, turned as a camera
//! noted, narrowed to 16 bits), or has beside it the coefficients of a progressive JPEG, 8 bytes
//! a pixel.

use super::TextureFault;

/// Pixels along an edge.
pub(super) const MAX_EDGE: u32 = 65536;

/// Pixels in all.
pub(super) const MAX_PIXELS: u64 = 16384 * 8192;

/// Bytes of the pixels as they come out of the decoder.
pub(super) const MAX_BYTES: u64 = 768 << 20;

/// Bytes of what the pixels are not: texts, colour profiles.
pub(super) const MAX_ANCILLARY_BYTES: u64 = 64 << 20;

/// Refuses pictures without pixels, and with too many.
pub(super) fn check(width: u32, height: u32, bytes: u64) -> Result<(), TextureFault> {
    if width == 0 || height == 0 {
        return Err(TextureFault::Damaged("the picture has no pixels".to_owned()));
    }
    let pixels = u64::from(width) * u64::from(height);
    if width.max(height) > MAX_EDGE || pixels > MAX_PIXELS || bytes > MAX_BYTES {
        return Err(TextureFault::TooLarge { width, height, mebibytes: bytes >> 20 });
    }
    Ok(())
}
