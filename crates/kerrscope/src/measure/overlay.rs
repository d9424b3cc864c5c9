//! What was measured, drawn on the picture.

use std::path::Path;

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};

use super::{Features, Picture};
use crate::display::srgb;
use crate::output::{FileError, file::write_atomically};

/// Colours, in sRGB.
const SHADOW: [u8; 3] = [80, 220, 255];
const RING: [u8; 3] = [255, 210, 60];
const DISK: [u8; 3] = [120, 255, 120];
const CRITICAL: [u8; 3] = [255, 80, 200];

/// A picture with the curves that were measured on it: the shadow's outline light blue, the ring's crest yellow, the disk's edge and
/// the lengths from the shadow's centre to it green; a curve that is given, as the critical curve, pink.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay {
    width: usize,
    height: usize,
    rgb: Vec<[u8; 3]>,
}

impl Overlay {
    /// Draws what was found. `curve` is a closed line in pixels right and up of the picture's middle.
    pub fn new(picture: &Picture, features: &Features, curve: &[[f64; 2]]) -> Self {
        let mut sorted = picture.values.clone();
        let place = (sorted.len() * 998 / 1000).min(sorted.len() - 1);
        let white = *sorted.select_nth_unstable_by(place, f64::total_cmp).1;
        let most = picture.values.iter().copied().fold(f64::MIN, f64::max);
        let white = if white > 0.0 { white } else { most.max(f64::MIN_POSITIVE) };
        let code = |light: f64| (255.0 * srgb::encode((light / white).clamp(0.0, 1.0))).round() as u8;
        let rgb = match &picture.colour {
            Some(colour) if !picture.physical => colour.iter().map(|rgb| rgb.map(code)).collect(),
            _ => picture.values.iter().map(|v| [code(*v); 3]).collect(),
        };
        let mut overlay = Self { width: picture.width, height: picture.height, rgb };
        overlay.closed(curve, CRITICAL);
        if let Some(shadow) = features.shadow.found() {
            overlay.closed(&shadow.outline.points, SHADOW);
            let [x, y] = shadow.centre.map(|c| c.value);
            overlay.line([x - 4.0, y], [x + 4.0, y], SHADOW);
            overlay.line([x, y - 4.0], [x, y + 4.0], SHADOW);
            if let Some(disk) = features.disk.found() {
                overlay.closed(&disk.outline.points, DISK);
                for (dx, dy) in [(disk.right.value, 0.0), (-disk.left.value, 0.0), (0.0, -disk.below.value)] {
                    overlay.line([x, y], [x + dx, y + dy], DISK);
                }
            }
        }
        if let Some(ring) = features.ring.found() {
            let crest = super::Outline { centre: ring.centre, radii: ring.peaks.clone() };
            overlay.closed(&crest.points().collect::<Vec<_>>(), RING);
        }
        overlay
    }

    fn closed(&mut self, points: &[[f64; 2]], colour: [u8; 3]) {
        for (k, point) in points.iter().enumerate() {
            self.line(*point, points[(k + 1) % points.len()], colour);
        }
    }

    /// A line one pixel wide; what is outside of the picture is left out.
    fn line(&mut self, from: [f64; 2], to: [f64; 2], colour: [u8; 3]) {
        let far = 4.0 * (self.width + self.height) as f64;
        if !from.iter().chain(&to).all(|c| c.abs() < far) {
            return;
        }
        let count = (2.0 * (to[0] - from[0]).abs().max((to[1] - from[1]).abs())).ceil().max(1.0) as usize;
        for k in 0..=count {
            let part = k as f64 / count as f64;
            let [x, y] = [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]));
            let column = (x + 0.5 * self.width as f64).floor();
            let row = (0.5 * self.height as f64 - y).floor();
            if (0.0..self.width as f64).contains(&column) && (0.0..self.height as f64).contains(&row) {
                self.rgb[row as usize * self.width + column as usize] = colour;
            }
        }
    }

    /// Writes it as a PNG, whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), FileError> {
        let [width, height] = [self.width, self.height].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        write_atomically(path, |to| {
            let encoder = PngEncoder::new(to);
            encoder
                .write_image(self.rgb.as_flattened(), width, height, ExtendedColorType::Rgb8)
                .map_err(std::io::Error::other)
        })
    }
}
