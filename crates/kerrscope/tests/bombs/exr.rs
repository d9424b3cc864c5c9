//! OpenEXR files, changed after they were written.

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, ImageAttributes, Layer,
    LayerAttributes, LineOrder, SpecificChannels, Vec2, WritableImage, f16,
};

fn encoding(compression: Compression, blocks: Blocks) -> Encoding {
    Encoding { compression, blocks, line_order: LineOrder::Increasing }
}

/// Pixels of red, green, blue and alpha in 16 bits.
fn written(width: usize, height: usize, encoding: Encoding) -> Vec<u8> {
    let half = f16::from_f32(0.5);
    let channels = SpecificChannels::rgba(|_: Vec2<usize>| (half, half, half, half));
    let layer = Layer::new((width, height), LayerAttributes::default(), encoding, channels);
    let mut file = Cursor::new(Vec::new());
    Image::from_layer(layer).write().to_buffered(&mut file).unwrap();
    file.into_inner()
}

/// Puts bytes in place of those at a distance from the beginning of an attribute's value.
fn change(file: &mut [u8], attribute: &str, at: usize, bytes: &[u8]) {
    let name = file.windows(attribute.len()).position(|part| part == attribute.as_bytes()).unwrap();
    // After the name and type, and the length in four bytes.
    let start = name + attribute.len() + 4 + at;
    file[start..start + bytes.len()].copy_from_slice(bytes);
}

/// Gives a file another size than it has.
fn resize(file: &mut [u8], width: usize, height: usize) {
    let last = [width, height].map(|edge| (edge as u32 - 1).to_le_bytes()).concat();
    change(file, "dataWindow\0box2i\0", 8, &last);
    change(file, "displayWindow\0box2i\0", 8, &last);
}

/// A picture of one block that stands in the table of blocks so many times.
pub fn exr(width: usize, lines: usize, times: usize, compression: Compression) -> Vec<u8> {
    let mut file = written(width, lines, encoding(compression, Blocks::ScanLines));
    resize(&mut file, width, lines * times);
    change(&mut file, "chunkCount\0int\0", 0, &(times as u32).to_le_bytes());
    // The table of blocks stands before them, here a number that is its own place and 8 more.
    let block = (0..file.len() - 8)
        .find(|&at| file[at..at + 8] == (at as u64 + 8).to_le_bytes())
        .expect("the table of one block");
    let offset = (block + 8 * times) as u64;
    file.splice(block..block + 8, offset.to_le_bytes().repeat(times));
    file
}

/// A picture with a header that says that it has another size, in tiles of another size.
pub fn exr_header(size: [usize; 2], tile: [u32; 2]) -> Vec<u8> {
    let mut file = written(4, 4, encoding(Compression::ZIP16, Blocks::Tiles(Vec2(4, 4))));
    resize(&mut file, size[0], size[1]);
    change(&mut file, "tiles\0tiledesc\0", 0, &tile.map(u32::to_le_bytes).concat());
    file
}

/// A layer of many small tiles that could all name the one large tile of another layer.
pub fn exr_layers() -> Vec<u8> {
    let layer = |name: &str, channels: &[&str], edge: usize, tile: usize| {
        let channel = |name: &&str| AnyChannel::new(*name, FlatSamples::F16(vec![f16::ONE; edge * edge]));
        let channels = AnyChannels::sort(channels.iter().map(channel).collect());
        let blocks = Blocks::Tiles(Vec2(tile, tile));
        Layer::new((edge, edge), LayerAttributes::named(name), encoding(Compression::ZIP16, blocks), channels)
    };
    let mut file = Cursor::new(Vec::new());
    Image::empty(ImageAttributes::with_size((256, 256)))
        .with_layer(layer("light", &["R", "G", "B"], 256, 4))
        .with_layer(layer("depth", &["Z"], 2048, 2048))
        .write()
        .to_buffered(&mut file)
        .unwrap();
    file.into_inner()
}
