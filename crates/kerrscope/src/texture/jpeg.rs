//! What the JPEG decoder does not notice.

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
