//! What the JPEG decoder does not notice.

use super::{TextureFault, limits};

/// Passes over a pixel, in all: 32 at the largest picture there may be.
const MAX_VISITS: u64 = 32 * limits::MAX_PIXELS;

/// Whether a JPEG file goes on to its end-of-image marker.
///
/// ITU-T T.81, B.1.1: a marker is FF and a code. Markers D0 to D8 and 01 stand alone, all
/// others up to the scan open a segment whose length, itself included, follows in two
/// bytes. Within a scan FF 00 is a data byte, and FF FF is fill.
pub(super) fn is_whole(bytes: &[u8]) -> bool {
    let mut at = 0;
    while let Some(found) = bytes[at..].windows(2).position(|w| w[0] == 0xFF && w[1] != 0xFF) {
        let marker = bytes[at + found + 1];
        at += found + 2;
        match marker {
            0xD9 => return true,
            0x00 | 0x01 | 0xD0..=0xD8 => {}
            _ => {
                let Some(length) = bytes.get(at..at + 2) else {
                    return false;
                };
                at += usize::from(u16::from_be_bytes([length[0], length[1]]));
                if at > bytes.len() {
                    return false;
                }
            }
        }
    }
    false
}

/// Refuses progressive pictures with more scans than their size allows.
///
/// A scan passes over every pixel, and takes as few as 12 bytes of the file. Encoders write about
/// ten. Counted are the markers of a start of scan, FF DA, wherever they stand: within the data of
/// a scan they cannot.
pub(super) fn check(bytes: &[u8], width: u32, height: u32) -> Result<(), TextureFault> {
    let scans = bytes.windows(2).filter(|pair| *pair == [0xFF, 0xDA]).count();
    if scans as u64 * u64::from(width) * u64::from(height) > MAX_VISITS {
        return Err(TextureFault::Unsupported(format!("{width}×{height} pixels in {scans} scans")));
    }
    Ok(())
}
