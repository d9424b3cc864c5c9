//! A picture on its way to a client: a head of 40 bytes, little-endian, and red, green, blue and 255 for each pixel.
//!
//! Raw, because over the loopback a megabyte takes less time than to pack it.

use kerrscope::display::Picture;
use rayon::prelude::*;

/// How a frame begins.
const MAGIC: [u8; 4] = *b"KSF1";

/// Bytes before the pixels.
const HEAD: usize = 40;

/// What is said of a picture beside its pixels.
#[derive(Clone, Copy, Debug)]
pub struct Label {
    /// The wish that it answers.
    pub generation: u32,
    /// Size of the picture that was asked for.
    pub wanted: [u32; 2],
    /// Rays in each pixel.
    pub samples: u32,
    /// Whether no finer one follows.
    pub last: bool,
    /// Milliseconds that it took.
    pub milliseconds: f64,
    /// Rays in a second, interpolated ones too.
    pub rate: f64,
    /// Median of the error estimates of the rays' directions; NaN if not known.
    pub error: f64,
    /// Rays given up.
    pub given_up: u64,
}

/// The bytes of a frame.
pub fn encode(picture: &Picture, label: &Label) -> Vec<u8> {
    let short = |edge: u32| (edge.min(u32::from(u16::MAX)) as u16).to_le_bytes();
    let mut bytes = Vec::with_capacity(HEAD + 4 * picture.pixels.len());
    bytes.extend(MAGIC);
    bytes.extend(label.generation.to_le_bytes());
    for edge in [picture.width, picture.height, label.wanted[0], label.wanted[1]] {
        bytes.extend(short(edge));
    }
    bytes.extend(label.samples.to_le_bytes());
    bytes.extend(u32::from(label.last).to_le_bytes());
    for number in [label.milliseconds, label.rate, label.error] {
        bytes.extend((number as f32).to_le_bytes());
    }
    bytes.extend((label.given_up.min(u64::from(u32::MAX)) as u32).to_le_bytes());
    debug_assert_eq!(bytes.len(), HEAD);
    bytes.resize(HEAD + 4 * picture.pixels.len(), 255);
    bytes[HEAD..].par_chunks_mut(4 * 4096).zip(picture.pixels.par_chunks(4096)).for_each(
        |(bytes, pixels)| {
            for (bytes, values) in bytes.chunks_exact_mut(4).zip(pixels) {
                // The nearest step, as in a PNG of 8 bits.
                bytes[..3].copy_from_slice(&values.map(|v| (v * 255.0).round() as u8));
            }
        },
    );
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dot() {
        let picture = Picture { width: 1, height: 1, pixels: vec![[0.0, 0.5, 1.0]] };
        let label = Label {
            generation: 7,
            wanted: [640, 360],
            samples: 4,
            last: true,
            milliseconds: 1.5,
            rate: 1e6,
            error: f64::NAN,
            given_up: 3,
        };
        let bytes = encode(&picture, &label);
        assert_eq!(bytes.len(), 44);
        assert_eq!(bytes[..4], *b"KSF1");
        assert_eq!(bytes[4..8], [7, 0, 0, 0]);
        assert_eq!(bytes[8..16], [1, 0, 1, 0, 128, 2, 104, 1]);
        assert_eq!(bytes[16..24], [4, 0, 0, 0, 1, 0, 0, 0]);
        assert_eq!(bytes[24..28], 1.5f32.to_le_bytes());
        assert_eq!(bytes[36..40], [3, 0, 0, 0]);
        assert_eq!(bytes[40..], [0, 128, 255, 255]);
    }
}
