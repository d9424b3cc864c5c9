//! TIFF 6.0, with the least significant byte first.

use std::collections::BTreeMap;

/// Tags and their values.
type Tags = BTreeMap<u16, Vec<u32>>;

const HEADER: [u8; 8] = *b"II*\0\x08\0\0\0";

/// A picture whose strips, or tiles if there are tags for them, are all the same bytes. RGB in 8
/// bits and compressed by deflate, unless the tags say otherwise.
pub fn tiff(width: u32, height: u32, chunks: usize, tags: &[(u16, &[u32])], data: &[u8]) -> Vec<u8> {
    let mut all = Tags::from([
        (256, vec![width]),
        (257, vec![height]),
        (258, vec![8]),
        (259, vec![8]),
        (262, vec![2]),
        (277, vec![3]),
    ]);
    all.extend(tags.iter().map(|(tag, values)| (*tag, values.to_vec())));
    let tiled = all.contains_key(&322);
    let [offsets, counts] = if tiled { [324, 325] } else { [273, 279] };
    all.insert(counts, vec![data.len() as u32; chunks]);
    all.insert(offsets, vec![0; chunks]);
    // The data stand behind the table of tags.
    let start = (HEADER.len() + 2 + 12 * all.len() + 4) as u32;
    all.insert(offsets, vec![start; chunks]);

    let mut table = u16::try_from(all.len()).unwrap().to_le_bytes().to_vec();
    let mut behind = data.to_vec();
    for (tag, values) in &all {
        // 3: of two bytes, 4: of four.
        let long = matches!(tag, 256 | 257 | 273 | 278 | 279 | 322..=325);
        let bytes: Vec<u8> = values
            .iter()
            .flat_map(|value| value.to_le_bytes().into_iter().take(if long { 4 } else { 2 }))
            .collect();
        table.extend(tag.to_le_bytes());
        table.extend(if long { 4_u16 } else { 3 }.to_le_bytes());
        table.extend((values.len() as u32).to_le_bytes());
        if bytes.len() <= 4 {
            table.extend(bytes.iter().chain(&[0; 4]).take(4));
        } else {
            table.extend((start + behind.len() as u32).to_le_bytes());
            behind.extend(bytes);
        }
    }
    table.extend([0; 4]);
    [&HEADER[..], &table, &behind].concat()
}
