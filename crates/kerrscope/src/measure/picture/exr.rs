//! Pictures in OpenEXR files, with all the digits that they have.

use std::io::Cursor;

use exr::error::Error;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{AnyChannels, FlatSamples, ReadChannels, ReadLayers, read};

use super::{Decoded, MAX_BYTES, PictureFault, PixelScale, check_size, means};

/// The first flat layer with numbers of light: its channel `intensity`, or R, G and B, or Y.
pub(super) fn decode(bytes: &[u8]) -> Result<Decoded, PictureFault> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|e| damaged(&e))?;
    for header in &meta.headers {
        let size = header.layer_size;
        check_size(size.width(), size.height())?;
        let bytes = unpacked(header);
        if bytes > MAX_BYTES {
            return Err(PictureFault::Damaged(format!("its blocks would take {} MiB", bytes >> 20)));
        }
    }
    let reader =
        read().no_deep_data().largest_resolution_level().all_channels().all_layers().all_attributes();
    let image = reader.from_buffered(Cursor::new(bytes)).map_err(|e| damaged(&e))?;
    for layer in &image.layer_data {
        let [width, height] = [layer.size.width(), layer.size.height()];
        let found = |name: &str| values(&layer.channel_data, name, width * height);
        let plain = |values, colour, physical| {
            let pixel = PixelScale::default();
            Decoded { width, height, values, colour, pixel, physical, trusted: true }
        };
        if let Some(values) = found("intensity") {
            return Ok(plain(values, None, true));
        }
        if let (Some(red), Some(green), Some(blue)) = (found("R"), found("G"), found("B")) {
            let rest = green.iter().zip(&blue);
            let colour: Vec<[f64; 3]> = red.iter().zip(rest).map(|(&r, (&g, &b))| [r, g, b]).collect();
            return Ok(plain(means(&colour), Some(colour), false));
        }
        if let Some(values) = found("Y") {
            return Ok(plain(values, None, false));
        }
    }
    Err(PictureFault::NoChannels)
}

/// A channel's numbers; the name may have the layer's before it.
fn values(channels: &AnyChannels<FlatSamples>, name: &str, count: usize) -> Option<Vec<f64>> {
    let is = |own: &str| own.eq_ignore_ascii_case(name);
    let channel = channels.list.iter().find(|channel| is(&channel.name.to_string()))?;
    let values: Vec<f64> = match &channel.sample_data {
        FlatSamples::F16(all) => all.iter().map(|x| x.to_f64()).collect(),
        FlatSamples::F32(all) => all.iter().map(|&x| f64::from(x)).collect(),
        FlatSamples::U32(all) => all.iter().map(|&x| f64::from(x)).collect(),
    };
    // A channel may be sampled more coarsely than the layer.
    (values.len() == count).then_some(values)
}

/// Bytes that all blocks of a layer unpack to.
fn unpacked(header: &Header) -> u64 {
    let size = match header.blocks {
        BlockDescription::Tiles(tiles) => [tiles.tile_size.width(), tiles.tile_size.height()],
        BlockDescription::ScanLines => [header.layer_size.width(), header.compression.scan_lines_per_block()],
    };
    let samples = (size[0] as u64).saturating_mul(size[1] as u64);
    let block = samples.saturating_mul(header.channels.bytes_per_pixel as u64);
    block.saturating_mul(header.chunk_count as u64)
}

fn damaged(error: &Error) -> PictureFault {
    PictureFault::Damaged(error.to_string())
}
