//! Portable Network Graphics.

use super::{TURNED, zeros};

fn chunk(file: &mut Vec<u8>, kind: &[u8], data: &[u8]) {
    let mut crc = flate2::Crc::new();
    crc.update(kind);
    crc.update(data);
    file.extend(u32::try_from(data.len()).unwrap().to_be_bytes());
    file.extend_from_slice(kind);
    file.extend_from_slice(data);
    file.extend(crc.sum().to_be_bytes());
}

/// Black pixels of RGB in 16 bits, to be turned, after a chunk.
fn black(width: u32, height: u32, kind: &[u8], data: &[u8]) -> Vec<u8> {
    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    let size = [width, height].map(u32::to_be_bytes).concat();
    chunk(&mut file, b"IHDR", &[&size[..], &[16, 2, 0, 0, 0]].concat());
    chunk(&mut file, kind, data);
    chunk(&mut file, b"IDAT", &zeros(u64::from(height) * (1 + 6 * u64::from(width))));
    chunk(&mut file, b"IEND", &[]);
    file
}

/// Black pixels of RGB in 16 bits, to be turned.
pub fn png(width: u32, height: u32) -> Vec<u8> {
    black(width, height, b"eXIf", TURNED)
}

/// One pixel, and a record of so many zeros.
pub fn png_text(zeros_in_record: u64) -> Vec<u8> {
    let record = [b"kerrscope\0\x01\0\0\0", &zeros(zeros_in_record)[..]].concat();
    black(1, 1, b"iTXt", &record)
}
