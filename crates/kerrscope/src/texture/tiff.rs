//! What the TIFF decoder takes on without asking whether it is too much.

use std::io::Cursor;

use tiff::decoder::{ChunkType, Decoder};
use tiff::tags::{CompressionMethod, Tag};

use super::{TextureFault, limits};

/// Refuses pictures of which more has to be decoded than is seen: tiles that go far beyond the
/// edges, many samples beside the colours, and strips that are whole JPEG files, each of any size.
///
/// TIFF 6.0, sections 8, 15 and 22. What is wrong otherwise is left to the decoder.
pub(super) fn check(bytes: &[u8]) -> Result<(), TextureFault> {
    let Ok(mut decoder) = Decoder::new(Cursor::new(bytes)) else {
        return Ok(());
    };
    let (Ok((width, height)), Ok(color)) = (decoder.dimensions(), decoder.colortype()) else {
        return Ok(());
    };
    let mut number = |tag| decoder.find_tag(tag).ok()??.into_u16().ok();
    let [compression, samples] = [Tag::Compression, Tag::SamplesPerPixel].map(|tag| number(tag).unwrap_or(1));
    if CompressionMethod::from_u16(compression) == Some(CompressionMethod::ModernJPEG) {
        return Err(TextureFault::Unsupported("JPEG within TIFF".to_owned()));
    }
    let (columns, rows) = match (decoder.get_chunk_type(), decoder.chunk_dimensions()) {
        (ChunkType::Strip, _) => (width, height),
        (ChunkType::Tile, (across, down)) => (
            width.checked_next_multiple_of(across).unwrap_or(u32::MAX),
            height.checked_next_multiple_of(down).unwrap_or(u32::MAX),
        ),
    };
    let bits = u64::from(samples) * u64::from(color.bit_depth());
    let bytes = (u64::from(columns) * bits).div_ceil(8).saturating_mul(u64::from(rows));
    limits::check(columns, rows, bytes).map_err(|fault| {
        if (columns, rows) == (width, height) {
            return fault;
        }
        TextureFault::Unsupported(format!("{width}×{height} pixels in tiles that cover {columns}×{rows}"))
    })
}
