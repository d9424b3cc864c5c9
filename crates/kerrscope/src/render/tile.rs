//! Rectangles of a picture: what a thread draws at a time, and what a checkpoint keeps.

use serde::{Deserialize, Serialize};

use super::adaptive;
use super::stage::{Replay, Stage};
use super::tally::Tally;
use crate::light::Light;

/// The longest edge of a tile, in pixels.
const LONGEST: u32 = 16;

/// About the most rays that a tile has, so that it takes a fraction of a second and little work
/// is lost with it.
const MOST_RAYS: u32 = 8192;

/// How a picture is cut into tiles. What a pixel shows does not depend on it unless the picture is adaptive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tiling {
    size: [u32; 2],
    edge: u32,
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) width: u32,
    pub(super) height: u32,
}

/// A finished tile.
#[derive(Debug, Deserialize, PartialEq, Serialize)]
pub(super) struct Tile {
    /// Light of its pixels, along the rows.
    pub(super) light: Vec<[f32; 3]>,
    /// Physical radiance of its pixels, or nothing.
    pub(super) intensity: Vec<f64>,
    /// Values of its pixels, channel after channel.
    pub(super) values: Vec<f32>,
    pub(super) tally: Tally,
}

impl Tiling {
    /// The tiles of a stage's picture.
    pub(super) fn of(stage: &Stage) -> Self {
        match stage.adaptive() {
            Some(_) => Self { size: stage.size(), edge: adaptive::tile_edge(stage.samples()) },
            None => Self::new(stage.size(), stage.rays_per_pixel()),
        }
    }

    /// Tiles for a picture of a size, with a number of rays in each pixel.
    fn new(size: [u32; 2], samples: u32) -> Self {
        let edge = (MOST_RAYS / samples.max(1)).isqrt().clamp(1, LONGEST);
        Self { size, edge }
    }

    /// How many tiles there are.
    pub(super) fn count(&self) -> u64 {
        let [columns, rows] = self.size.map(|edge| u64::from(edge.div_ceil(self.edge)));
        columns * rows
    }

    /// Tile number `number`, counted along the rows.
    pub(super) fn area(&self, number: u64) -> Area {
        let columns = u64::from(self.size[0].div_ceil(self.edge));
        let [left, top] = [number % columns, number / columns].map(|n| n as u32 * self.edge);
        let [width, height] = [self.size[0] - left, self.size[1] - top].map(|rest| rest.min(self.edge));
        Area { left, top, width, height }
    }
}

impl Area {
    /// Rays that the picture has there, traced or not.
    pub(super) fn rays(self, stage: &Stage) -> u64 {
        u64::from(self.width) * u64::from(self.height) * u64::from(stage.rays_per_pixel())
    }
}

impl Tile {
    /// Draws a tile.
    pub(super) fn draw(stage: &Stage, area: Area, replay: &mut Replay) -> Self {
        let Area { left, top, width, height } = area;
        let pixels = (width * height) as usize;
        let channels = stage.channels().len();
        let all = || (top..top + height).flat_map(|y| (left..left + width).map(move |x| [x, y]));
        let mut tally = Tally::default();
        let mut light = Vec::with_capacity(pixels);
        let mut intensity = Vec::new();
        let shines = stage.radiance().is_some();
        let mut keep = |seen: Light| {
            light.push(seen.rgb.map(|c| c as f32));
            if shines {
                intensity.push(seen.intensity);
            }
        };
        let mut values = vec![f32::NAN; channels * pixels];
        if channels > 0 {
            let mut pixel = 0;
            stage.probe(all(), replay, &mut tally, |channel, value| {
                values[channel * pixels + pixel] = value;
                pixel += usize::from(channel + 1 == channels);
            });
        }
        match stage.adaptive() {
            Some(target) => {
                adaptive::draw(stage, target, area, replay, &mut tally).into_iter().for_each(&mut keep);
            }
            None => stage.pixels(all(), replay, &mut tally, &mut keep),
        }
        Self { light, intensity, values, tally }
    }

    /// As a checkpoint keeps it.
    pub(super) fn encode(&self) -> Vec<u8> {
        postcard::to_stdvec(self).unwrap_or_default()
    }

    /// From what a checkpoint kept; none if that is not a tile of so many pixels and channels, with a physical radiance or
    /// without.
    pub(super) fn decode(bytes: &[u8], area: Area, channels: usize, shines: bool) -> Option<Self> {
        let pixels = (area.width * area.height) as usize;
        let tile: Self = postcard::from_bytes(bytes).ok()?;
        let whole = tile.light.len() == pixels
            && tile.intensity.len() == if shines { pixels } else { 0 }
            && tile.values.len() == pixels * channels;
        whole.then_some(tile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_a_picture_once() {
        for (size, samples) in [([1, 1], 1), ([33, 17], 4), ([16, 16], 300), ([5, 4], 65536)] {
            let tiling = Tiling::new(size, samples);
            let mut covered = vec![0; (size[0] * size[1]) as usize];
            for number in 0..tiling.count() {
                let Area { left, top, width, height } = tiling.area(number);
                for y in top..top + height {
                    for x in left..left + width {
                        covered[(y * size[0] + x) as usize] += 1;
                    }
                }
            }
            assert!(covered.iter().all(|&times| times == 1), "{size:?}, {samples} samples");
        }
    }

    #[test]
    fn a_kept_tile_is_the_same_tile() {
        let mut tally = Tally::default();
        tally.count(12, 3e-9, false);
        let light = vec![[0.1, f32::MIN_POSITIVE, 3e38]; 6];
        let tile = Tile { light, intensity: Vec::new(), values: vec![1.5; 12], tally };
        let area = Area { left: 0, top: 0, width: 3, height: 2 };
        assert_eq!(Tile::decode(&tile.encode(), area, 2, true), None);
        assert_eq!(Tile::decode(&tile.encode(), area, 2, false), Some(tile));
        assert_eq!(Tile::decode(b"nonsense", area, 2, false), None);
    }
}
