//! What a render leaves: linear light, data layers, and how good they are.

use super::layer::Channel;
use super::tally::Tally;
use super::tile::{Area, Tile};
use crate::spacetime::Level;

/// A picture in linear light, with data layers. Pixels go along the rows, the top row first.
///
/// Numbers are kept with 32 bits: 24 significant ones, more than any display or file of ours takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Mean light of each pixel's rays: linear red, green and blue, see
    /// [`Light`](crate::light::Light).
    pub light: Vec<[f32; 3]>,
    /// The data layers that the scene asks for.
    pub planes: Vec<Plane>,
    /// What is known of the rays.
    pub tally: Tally,
    /// The instructions that they were traced with.
    pub level: Level,
}

/// A data layer's numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Plane {
    /// What they are.
    pub channel: Channel,
    /// One a pixel, of the ray through its centre; NaN where there is none.
    pub values: Vec<f32>,
}

/// Where a picture's light lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moments {
    /// Mean place, from the picture's middle, right and up.
    pub centroid: [f64; 2],
    /// Widths along the major and the minor axis: 2√(2 ln 2) standard deviations, which is the
    /// full width at half maximum of a Gaussian.
    pub size: [f64; 2],
}

impl Film {
    /// A film without light.
    pub fn blank([width, height]: [u32; 2], channels: &[Channel], level: Level) -> Self {
        let area = width as usize * height as usize;
        let plane = |&channel| Plane { channel, values: vec![f32::NAN; area] };
        let planes = channels.iter().map(plane).collect();
        Self { width, height, light: vec![[0.0; 3]; area], planes, tally: Tally::default(), level }
    }

    /// The plane of a channel.
    pub fn plane(&self, channel: Channel) -> Option<&Plane> {
        self.planes.iter().find(|plane| plane.channel == channel)
    }

    /// Puts a finished tile in its place. It must be of this film's channels.
    pub(super) fn place(&mut self, tile: &Tile, Area { left, top, width, height }: Area) {
        let (width, height) = (width as usize, height as usize);
        let row = |number: usize| {
            let start = (top as usize + number) * self.width as usize + left as usize;
            start..start + width
        };
        for number in 0..height {
            let from = number * width..(number + 1) * width;
            self.light[row(number)].copy_from_slice(&tile.light[from.clone()]);
            for (plane, values) in self.planes.iter_mut().zip(tile.values.chunks_exact(width * height)) {
                plane.values[row(number)].copy_from_slice(&values[from.clone()]);
            }
        }
        self.tally.add(&tile.tally);
    }

    /// First and second moments of the luminance (Rec. 709), in units in which a pixel has the
    /// size `pixel`. `None` for a dark picture.
    pub fn moments(&self, pixel: f64) -> Option<Moments> {
        let (mut sum, mut first, mut second) = (0.0, [0.0; 2], [0.0; 3]);
        let middle = [0.5 * f64::from(self.width), 0.5 * f64::from(self.height)];
        for (row, line) in self.light.chunks_exact(self.width as usize).enumerate() {
            for (column, light) in line.iter().enumerate() {
                let [r, g, b] = light.map(f64::from);
                let weight = 0.2126 * r + 0.7152 * g + 0.0722 * b;
                let (x, y) = (column as f64 + 0.5 - middle[0], middle[1] - row as f64 - 0.5);
                sum += weight;
                first = [first[0] + weight * x, first[1] + weight * y];
                second = [second[0] + weight * x * x, second[1] + weight * x * y, second[2] + weight * y * y];
            }
        }
        if !(sum > 0.0) {
            return None;
        }
        let [x, y] = first.map(|f| f / sum);
        let [xx, xy, yy] = [second[0] / sum - x * x, second[1] / sum - x * y, second[2] / sum - y * y];
        // Eigenvalues of the covariance.
        let (mean, half) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
        let width = |variance: f64| (8.0 * 2f64.ln() * variance.max(0.0)).sqrt() * pixel;
        Some(Moments { centroid: [x * pixel, y * pixel], size: [width(mean + half), width(mean - half)] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_two_dots() {
        let mut film = Film::blank([8, 4], &[], Level::Baseline);
        assert!(film.moments(1.0).is_none());
        // At (1.5, 0.5) and (6.5, 0.5) from the top left: 5 apart, 1.5 above the middle.
        film.light[1] = [1.0; 3];
        film.light[6] = [1.0; 3];
        let m = film.moments(2.0).unwrap();
        assert!((m.centroid[0]).abs() < 1e-14 && (m.centroid[1] - 3.0).abs() < 1e-14);
        assert!((m.size[0] - (8.0 * 2f64.ln()).sqrt() * 5.0).abs() < 1e-12);
        assert!(m.size[1].abs() < 1e-6);
    }
}
