//! Progressive JPEG: ITU-T T.81, annexes B and G.

use super::TURNED;

fn segment(file: &mut Vec<u8>, marker: u8, data: &[&[u8]]) {
    let data = data.concat();
    file.extend([0xFF, marker]);
    file.extend(u16::try_from(data.len() + 2).unwrap().to_be_bytes());
    file.extend(data);
}

/// A grey picture of four components, to be turned, in so many scans. Where the data of a scan
/// are missing they are read as zeros.
pub fn jpeg(width: u16, height: u16, scans: usize) -> Vec<u8> {
    let mut file = b"\xFF\xD8".to_vec();
    segment(&mut file, 0xE1, &[b"Exif\0\0", TURNED]);
    segment(&mut file, 0xDB, &[&[0], &[1; 64]]);
    let components = [1, 2, 3, 4].map(|i| [i, 0x11, 0]);
    segment(
        &mut file,
        0xC2,
        &[&[8], &height.to_be_bytes(), &width.to_be_bytes(), &[4], components.as_flattened()],
    );
    // A zero is the one code: "no difference", and "16384 blocks in which nothing is left".
    for (table, symbol) in [(0x00, 0x00), (0x10, 0xE0)] {
        segment(&mut file, 0xC4, &[&[table, 1], &[0; 15], &[symbol]]);
    }
    for scan in 0..scans {
        let component = 1 + (scan % 4) as u8;
        match scan {
            0 => segment(&mut file, 0xDA, &[&[4, 1, 0, 2, 0, 3, 0, 4, 0, 0, 0, 0]]),
            1..=4 => segment(&mut file, 0xDA, &[&[1, component, 0, 1, 63, 0x01]]),
            _ => segment(&mut file, 0xDA, &[&[1, component, 0, 1, 63, 0x10]]),
        }
        file.extend([0; 4]);
    }
    file.extend(b"\xFF\xD9");
    file
}
