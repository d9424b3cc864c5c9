//! OpenEXR files, read block by block.

use std::io::Cursor;

use exr::error::Error;
use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, Text, Vec2, read};
use half::f16;

use super::{MAX_EDGE, Texels, Texture, TextureFault, half};

/// Bytes that the pixels may take; what has more is made smaller as it is read.
const MAX_BYTES: usize = 256 << 20;

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
    let offset = header.own_attributes.layer_position - window.position;
    let full = [window.size.width(), window.size.height()];
    let data = [header.layer_size.width(), header.layer_size.height()];
    let [width, height] = full.map(|edge| u32::try_from(edge).unwrap_or(u32::MAX));
    if full.iter().chain(&data).any(|&edge| edge > MAX_EDGE as usize) {
        return Err(TextureFault::TooLarge { width, height });
    }
    if full.contains(&0) {
        return Err(TextureFault::Damaged("the picture has no pixels".to_owned()));
    }

    let channels = if has(&header.channels, "A") || full != data { 4 } else { 3 };
    let mut small = full;
    while small[0] * small[1] * channels * size_of::<f16>() > MAX_BYTES {
        small = small.map(|edge| edge.div_ceil(2));
    }
    // Pixels of the file that fall into the same column or row.
    let shared = move |at: usize, axis: usize| {
        let first = |at: usize| (at * full[axis]).div_ceil(small[axis]);
        first(at + 1) - first(at)
    };

    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            move |_, _| vec![f16::ZERO; small[0] * small[1] * channels],
            move |texels: &mut Vec<f16>, at: Vec2<usize>, (r, g, b, a): (f32, f32, f32, f32)| {
                let place = |at: usize, axis: usize, offset: i32| {
                    let at = at.checked_add_signed(offset as isize).filter(|&at| at < full[axis])?;
                    Some(at * small[axis] / full[axis])
                };
                let (Some(x), Some(y)) = (place(at.x(), 0, offset.x()), place(at.y(), 1, offset.y())) else {
                    return;
                };
                let share = 1.0 / (shared(x, 0) * shared(y, 1)) as f32;
                let first = (y * small[0] + x) * channels;
                for (texel, value) in texels[first..first + channels].iter_mut().zip([r, g, b, a]) {
                    *texel = half(texel.to_f32() + half(value).to_f32() * share);
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(fault)?;
    let texels = Texels::Half(image.layer_data.channel_data.pixels);
    Ok(Texture { width: small[0] as u32, height: small[1] as u32, channels, texels })
}

fn fault(error: Error) -> TextureFault {
    match error {
        Error::Io(e) if e.kind() == std::io::ErrorKind::UnexpectedEof => TextureFault::Truncated,
        Error::Io(e) => TextureFault::Io(e),
        Error::NotSupported(what) => TextureFault::Unsupported(what.into_owned()),
        Error::Invalid(what) => TextureFault::Damaged(what.into_owned()),
        Error::Aborted => TextureFault::Damaged("reading was broken off".to_owned()),
    }
}
