//! Pixels that shapes and text are drawn on.

use crate::display::srgb;

/// Rows of pixels in the encoding of sRGB. What is drawn outside of them is cut off.
pub(super) struct Canvas {
    pub width: i32,
    pub height: i32,
    pub pixels: Vec<[f32; 3]>,
}

impl Canvas {
    /// A canvas of no rows yet.
    pub const fn new(width: i32) -> Self {
        Self { width, height: 0, pixels: Vec::new() }
    }

    /// Adds rows of one colour at the bottom.
    pub fn grow(&mut self, rows: i32, color: [f64; 3]) {
        self.height += rows;
        self.pixels.resize(self.width as usize * self.height as usize, color.map(|c| c as f32));
    }

    /// Covers a share of a pixel, from 0 to 1, with a colour; the mixture is one of light.
    pub fn cover(&mut self, x: i32, y: i32, share: f32, color: [f64; 3]) {
        if !(0..self.width).contains(&x) || !(0..self.height).contains(&y) || !(share > 0.0) {
            return;
        }
        let pixel = &mut self.pixels[y as usize * self.width as usize + x as usize];
        if share >= 1.0 {
            *pixel = color.map(|c| c as f32);
            return;
        }
        let share = f64::from(share);
        *pixel = std::array::from_fn(|i| {
            let (below, above) = (srgb::decode(f64::from(pixel[i])), srgb::decode(color[i]));
            srgb::encode(below * (1.0 - share) + above * share) as f32
        });
    }

    /// Fills a rectangle, given by its left, top, width and height.
    pub fn fill(&mut self, [left, top, width, height]: [i32; 4], color: [f64; 3]) {
        for y in top..top + height {
            for x in left..left + width {
                self.cover(x, y, 1.0, color);
            }
        }
    }

    /// Fills a column from one height to another, its ends partly.
    pub fn column(&mut self, x: i32, [top, bottom]: [f32; 2], color: [f64; 3]) {
        for y in top.floor() as i32..bottom.ceil() as i32 {
            self.cover(x, y, bottom.min(y as f32 + 1.0) - top.max(y as f32), color);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_are_cut_at_the_edges() {
        let mut canvas = Canvas::new(3);
        canvas.grow(2, [0.0; 3]);
        canvas.fill([-5, 1, 6, 9], [1.0; 3]);
        canvas.fill([2, -1, 9, 2], [0.5; 3]);
        let first: Vec<f32> = canvas.pixels.iter().map(|p| p[0]).collect();
        assert_eq!(first, [0.0, 0.0, 0.5, 1.0, 0.0, 0.0]);
        assert_eq!(canvas.height, 2);
    }

    #[test]
    fn columns_end_within_pixels() {
        let mut canvas = Canvas::new(1);
        canvas.grow(4, [0.0; 3]);
        canvas.column(0, [0.75, 2.5], [0.5; 3]);
        let light = canvas.pixels.iter().map(|p| srgb::decode(f64::from(p[0])) / srgb::decode(0.5));
        for (light, expected) in light.zip([0.25, 1.0, 0.5, 0.0]) {
            assert!((light - expected).abs() < 1e-6, "{light} {expected}");
        }
    }
}
