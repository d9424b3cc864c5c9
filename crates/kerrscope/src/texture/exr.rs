//! OpenEXR files, read block by block.

use std::io::Cursor;

use exr::error::Error;
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::{ReadChannels, ReadLayers, Text, Vec2, read};
use half::f16;

use super::{Texels, Texture, TextureFault, bounded, half, limits};

/// Bytes that the pixels may take; what has more is made smaller as it is read.
const MAX_BYTES: usize = 256 << 20;

/// Bytes of all blocks: two of a sample in red, green, blue and alpha of the largest picture.
const MAX_UNPACKED_BYTES: u64 = 8 * limits::MAX_PIXELS;

/// Bytes of a block, in all its channels, as it is written and read: it takes four times as many.
const MAX_BLOCK_BYTES: u64 = 256 << 20;

/// Bytes of the blocks that are unpacked at the same time.
const MAX_PARALLEL_BYTES: u64 = 128 << 20;

/// Reads the first layer with red, green and blue, at its full resolution.
///
/// Light in an EXR file is multiplied by alpha already. The picture is the display window; what
/// the data do not cover is dark and transparent.
pub(super) fn decode(bytes: &[u8]) -> Result<Texture, TextureFault> {
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(fault)?;
    let has = |channels: &exr::meta::attribute::ChannelList, name: &str| {
        channels.find_index_of_channel(&Text::from(name)).is_some()
    };
    let header = meta
        .headers
        .iter()
        .find(|header| !header.deep && ["R", "G", "B"].iter().all(|name| has(&header.channels, name)))
        .ok_or_else(|| TextureFault::Unsupported("no layer has the channels R, G and B".to_owned()))?;
    let window = header.shared_attributes.display_window;
    let corner = header.own_attributes.layer_position;
    let full = [window.size.width(), window.size.height()];
    let data = [header.layer_size.width(), header.layer_size.height()];
    let parallel = check(&meta, header)?;

    let channels = if has(&header.channels, "A") || full != data { 4 } else { 3 };
    let mut small = full;
    while small[0] * small[1] * channels * size_of::<f16>() > MAX_BYTES {
        small = small.map(|edge| edge.div_ceil(2));
    }
    // The column or row that one of the data falls into, and its share in it.
    let places = |axis: usize, data_begin: i32, begin: i32| -> Vec<Option<(usize, f32)>> {
        let first = |at: usize| (at * full[axis]).div_ceil(small[axis]);
        let place = |at: usize| {
            let offset = data_begin as isize - begin as isize;
            let at = at.checked_add_signed(offset).filter(|&at| at < full[axis])?;
            let at = at * small[axis] / full[axis];
            Some((at, 1.0 / (first(at + 1) - first(at)) as f32))
        };
        (0..data[axis]).map(place).collect()
    };
    let columns = places(0, corner.x(), window.position.x());
    let rows = places(1, corner.y(), window.position.y());

    let [width, height] = small;
    let canvas = Canvas { width, height, channels, columns, rows };
    let texels = if small == full {
        canvas.read(bytes, parallel, f16::ZERO, |texel, value, _| *texel = half(value))?
    } else {
        // Sums in 32 bits lose nothing, and take no time to narrow and widen again.
        let sums = canvas.read(bytes, parallel, 0.0, |sum: &mut f32, value, share| *sum += value * share)?;
        sums.into_iter().map(half).collect()
    };
    Ok(Texture { width: width as u32, height: height as u32, channels, texels: Texels::Half(texels) })
}

/// What the pixels of a file are gathered on.
struct Canvas {
    width: usize,
    height: usize,
    channels: usize,
    /// Where each column of the data belongs, and its share there; none outside the picture.
    columns: Vec<Option<(usize, f32)>>,
    rows: Vec<Option<(usize, f32)>>,
}

impl Canvas {
    /// Reads the pixels of a file; `gather` is told a texel, a value for it, and its share in it.
    fn read<T: Clone + 'static>(
        self,
        bytes: &[u8],
        parallel: bool,
        blank: T,
        gather: impl Fn(&mut T, f32, f32) + 'static,
    ) -> Result<Vec<T>, TextureFault> {
        let Self { width, height, channels, columns, rows } = self;
        let reader = read()
            .no_deep_data()
            .largest_resolution_level()
            .rgba_channels(
                move |_, _| vec![blank.clone(); width * height * channels],
                move |texels: &mut Vec<T>, at: Vec2<usize>, (r, g, b, a): (f32, f32, f32, f32)| {
                    let (Some((x, across)), Some((y, down))) = (columns[at.x()], rows[at.y()]) else {
                        return;
                    };
                    let first = (y * width + x) * channels;
                    for (texel, value) in texels[first..first + channels].iter_mut().zip([r, g, b, a]) {
                        gather(texel, bounded(value), across * down);
                    }
                },
            )
            .first_valid_layer()
            .all_attributes();
        let reader = if parallel { reader } else { reader.non_parallel() };
        let image = reader.from_buffered(Cursor::new(bytes)).map_err(fault)?;
        Ok(image.layer_data.channel_data.pixels)
    }
}

/// Refuses pictures that take too much memory or time, and tells whether there is memory to unpack
/// several blocks at once.
///
/// All channels are unpacked, beside the colours too. The table of blocks may name one block any
/// number of times, and one of another layer.
fn check(meta: &MetaData, header: &Header) -> Result<bool, TextureFault> {
    let size = header.layer_size;
    for size in [header.shared_attributes.display_window.size, size] {
        let [width, height] =
            [size.width(), size.height()].map(|edge| u32::try_from(edge).unwrap_or(u32::MAX));
        // Three samples of 16 bits.
        limits::check(width, height, (u64::from(width) * u64::from(height)).saturating_mul(6))?;
    }

    let block = |header: &Header| {
        let size = match header.blocks {
            BlockDescription::Tiles(tiles) => tiles.tile_size,
            BlockDescription::ScanLines => {
                Vec2(header.layer_size.width(), header.compression.scan_lines_per_block())
            }
        };
        let samples = (size.width() as u64).saturating_mul(size.height() as u64);
        samples.saturating_mul(header.channels.bytes_per_pixel as u64)
    };
    let block = meta.headers.iter().map(block).max().unwrap_or(0);
    let all = block.saturating_mul(header.chunk_count as u64);
    if block > MAX_BLOCK_BYTES || all > MAX_UNPACKED_BYTES {
        let [block, all] = [block, all].map(|bytes| bytes >> 20);
        let [width, height] = [size.width(), size.height()];
        let what = format!("{width}×{height} pixels in blocks of {block} MiB, {all} MiB in all");
        return Err(TextureFault::Unsupported(what));
    }
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    Ok((threads + 2) * block <= MAX_PARALLEL_BYTES)
}

fn fault(error: Error) -> TextureFault {
    match error {
        Error::Io(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => TextureFault::Truncated,
        Error::Io(e) => TextureFault::Damaged(e.to_string()),
        Error::NotSupported(what) => TextureFault::Unsupported(what.into_owned()),
        Error::Invalid(what) => TextureFault::Damaged(what.into_owned()),
        Error::Aborted => TextureFault::Damaged("reading was broken off".to_owned()),
    }
}
