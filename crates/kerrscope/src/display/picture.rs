//! A picture as a screen shows it.

/// A picture in display values: red, green and blue from 0 to 1 in the encoding of sRGB, along the
/// rows, the top row first.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// The values.
    pub pixels: Vec<[f32; 3]>,
}

/// Bits of each component in a picture file.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Depth {
    /// 256 steps.
    #[default]
    Eight,
    /// 65536 steps.
    Sixteen,
}
