//! Files that are small and say that they are large.

mod exr;
mod jpeg;
mod png;
mod tiff;
mod webp;

use std::io::{self, Read, Write};

pub use exr::{exr, exr_header, exr_layers};
pub use jpeg::jpeg;
pub use png::{png, png_text};
pub use tiff::tiff;
pub use webp::{webp, webp_animated, webp_exif};

/// Exif data: turn by 90° clockwise.
pub const TURNED: &[u8] = b"MM\0\x2A\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";

/// So many zeros, compressed: RFC 1950 and 1951. Blocks of zeros may follow one another.
pub fn zeros(count: u64) -> Vec<u8> {
    const PIECE: u64 = 1 << 22;
    let piece = |count: u64| {
        let mut encoder = flate2::write::DeflateEncoder::new(Vec::new(), flate2::Compression::best());
        io::copy(&mut io::repeat(0).take(count), &mut encoder).unwrap();
        encoder.flush().unwrap();
        encoder.get_ref().clone()
    };
    let blocks = piece(PIECE).repeat((count / PIECE) as usize);
    let checksum = ((count % 65521) << 16 | 1) as u32;
    [&[0x78, 0xDA], &blocks[..], &piece(count % PIECE), b"\x01\0\0\xFF\xFF", &checksum.to_be_bytes()].concat()
}

/// A Radiance HDR file of one colour: a run goes on as long as its line.
pub fn hdr(width: u32, height: u32) -> Vec<u8> {
    let mut file = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    let [low, high, ..] = (width - 1).to_le_bytes();
    let line = [200, 100, 50, 129, 1, 1, 1, low, 1, 1, 1, high];
    file.extend(line.repeat(height.min(8192) as usize));
    file
}
