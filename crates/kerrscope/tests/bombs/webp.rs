//! Lossless WebP: RFC 9649.

/// Bits, the least significant first.
#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    count: usize,
}

impl Bits {
    fn put(&mut self, value: u32, bits: usize) {
        for bit in 0..bits {
            if self.count.is_multiple_of(8) {
                self.bytes.push(0);
            }
            self.bytes[self.count / 8] |= ((value >> bit & 1) as u8) << (self.count % 8);
            self.count += 1;
        }
    }

    /// Five codes of one symbol each, which take no bits: every pixel has this green.
    fn codes(&mut self, green: u32) {
        for symbol in [green, 0, 0, 255, 0] {
            self.put(0b101, 3);
            self.put(symbol, 8);
        }
    }
}

/// Pixels that take no bits, after all transforms: of prediction, of colours, of green.
fn pixels(width: u32, height: u32) -> Vec<u8> {
    let mut bits = Bits::default();
    bits.put(0x2F, 8);
    bits.put(width - 1, 14);
    bits.put(height - 1, 14);
    bits.put(0, 4);
    for (transform, green) in [(0, 13), (1, 5)] {
        bits.put(1, 1);
        bits.put(transform, 2);
        bits.put(0, 4);
        bits.codes(green);
    }
    bits.put(0b101, 3);
    bits.put(0, 3);
    bits.codes(1);
    bits.bytes.extend([0; 8]);
    bits.bytes
}

fn chunk(kind: &[u8], data: &[u8]) -> Vec<u8> {
    let length = u32::try_from(data.len()).unwrap().to_le_bytes();
    let fill = &[0][..data.len() % 2];
    [kind, &length, data, fill].concat()
}

fn file(chunks: &[Vec<u8>]) -> Vec<u8> {
    chunk(b"RIFF", &[b"WEBP", &chunks.concat()[..]].concat())
}

/// Flags of an extended file, and the size of its picture.
fn extended(flags: u8, width: u32, height: u32) -> Vec<u8> {
    chunk(b"VP8X", &[&[flags, 0, 0, 0][..], &size(width, height)].concat())
}

fn size(width: u32, height: u32) -> Vec<u8> {
    [width, height].iter().flat_map(|edge| (edge - 1).to_le_bytes().into_iter().take(3)).collect()
}

/// A picture of one colour.
pub fn webp(width: u32, height: u32) -> Vec<u8> {
    file(&[chunk(b"VP8L", &pixels(width, height))])
}

/// An animation of one picture of one colour.
pub fn webp_animated(width: u32, height: u32) -> Vec<u8> {
    let frame = [&[0; 6], &size(width, height)[..], &[0; 4], &chunk(b"VP8L", &pixels(width, height))];
    file(&[extended(0x12, width, height), chunk(b"ANIM", &[0; 6]), chunk(b"ANMF", &frame.concat())])
}

/// A picture with Exif data that are said to be longer than the file.
pub fn webp_exif(length: u32) -> Vec<u8> {
    let mut file = file(&[extended(8, 8, 8), chunk(b"VP8L", &pixels(8, 8)), chunk(b"EXIF", &[])]);
    let at = file.len() - 4;
    file[at..].copy_from_slice(&length.to_le_bytes());
    file
}
