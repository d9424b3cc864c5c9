//! What a render leaves: linear light, data layers, and how good they are.

use super::layer::Channel;
use super::tally::Tally;
use super::tile::{Area, Tile};
use crate::light::Radiance;
use crate::measure::Moments;
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
    /// Mean physical radiance of each pixel's rays, if it has one; otherwise nothing.
    pub intensity: Vec<f64>,
    /// What it is.
    pub radiance: Option<Radiance>,
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

impl Film {
    /// A film without light.
    pub fn blank(
        [width, height]: [u32; 2],
        radiance: Option<Radiance>,
        channels: &[Channel],
        level: Level,
    ) -> Self {
        let area = width as usize * height as usize;
        let plane = |&channel| Plane { channel, values: vec![f32::NAN; area] };
        let planes = channels.iter().map(plane).collect();
        let intensity = vec![0.0; if radiance.is_some() { area } else { 0 }];
        let light = vec![[0.0; 3]; area];
        Self { width, height, light, intensity, radiance, planes, tally: Tally::default(), level }
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
            if self.radiance.is_some() {
                self.intensity[row(number)].copy_from_slice(&tile.intensity[from.clone()]);
            }
            for (plane, values) in self.planes.iter_mut().zip(tile.values.chunks_exact(width * height)) {
                plane.values[row(number)].copy_from_slice(&values[from.clone()]);
            }
        }
        self.tally.add(&tile.tally);
    }

    /// Moments of the luminance (Rec. 709), in units in which a pixel has the size `pixel`. `None` for a dark picture.
    pub fn moments(&self, pixel: f64) -> Option<Moments> {
        Moments::of([self.width, self.height], pixel, |place| {
            let [r, g, b] = self.light[place].map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_two_dots() {
        let mut film = Film::blank([8, 4], None, &[], Level::Baseline);
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
