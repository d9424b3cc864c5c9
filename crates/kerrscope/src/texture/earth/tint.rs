//! The colours of land and sea: sRGB from 0 to 1, mixed by eye in these numbers.

use super::climate::{Climate, unit};
use crate::noise::{Noise, lerp, smooth};

type Color = [f64; 3];

const SAND: Color = code([206, 177, 131]);
const RED_SAND: Color = code([183, 142, 95]);
const STEPPE: Color = code([160, 143, 92]);
const SAVANNA: Color = code([112, 116, 58]);
const RAINFOREST: Color = code([42, 78, 36]);
const WOODS: Color = code([74, 98, 52]);
const TAIGA: Color = code([58, 80, 54]);
const TUNDRA: Color = code([128, 123, 104]);
const SNOW: Color = code([236, 241, 246]);

const WARM_DEEP: Color = code([12, 42, 88]);
const COLD_DEEP: Color = code([16, 40, 70]);
const WARM_SHALLOW: Color = code([24, 74, 118]);
const COLD_SHALLOW: Color = code([25, 58, 88]);
const SEA_ICE: Color = code([206, 219, 230]);

/// The parts of the noise: cells in a radius of the Earth, and weights.
const PATCHES: [(f64, f64); 4] = [(7.0, 0.4), (15.0, 0.3), (31.0, 0.2), (67.0, 0.1)];
const GRAIN: [(f64, f64); 3] = [(90.0, 0.45), (190.0, 0.35), (400.0, 0.2)];

/// Wetness from which no sand is seen.
const STEPPE_FROM: f64 = 0.34;

/// Seed of the noise.
const SEED: u64 = 1;

/// What the ground looks like.
pub(super) struct Tint<'a> {
    climate: &'a Climate,
}

impl<'a> Tint<'a> {
    pub(super) const fn new(climate: &'a Climate) -> Self {
        Self { climate }
    }

    /// The colour of land at a place in degrees.
    pub(super) fn land(&self, longitude: f64, latitude: f64) -> Color {
        let at = unit(longitude, latitude);
        let patch = noise(&PATCHES, 0, at);
        let ice = smooth((self.climate.ice_sheet(longitude, latitude) + 0.12 * patch - 0.62) / 0.2);
        let snow = SNOW.map(|c| c * (1.0 + 0.04 * patch));
        if ice == 1.0 {
            return snow.map(|c| c.min(1.0));
        }
        let grain = noise(&GRAIN, 1, at);
        let wet = self.climate.wetness(longitude, latitude) + 0.25 * patch + 0.06 * grain;
        let warm = self.climate.temperature(longitude, latitude) + 3.0 * patch + grain;
        // Where no sand is seen, its colour is left out.
        let redness = if wet < STEPPE_FROM { smooth(0.5 + 1.2 * noise(&PATCHES[..3], 3, at)) } else { 0.0 };
        let sand = mix(SAND, RED_SAND, redness);
        let hot = mixed(&[(0.12, sand), (STEPPE_FROM, STEPPE), (0.52, SAVANNA), (0.85, RAINFOREST)], wet);
        let mild = mixed(&[(0.12, sand), (STEPPE_FROM, STEPPE), (0.62, WOODS)], wet);
        let green = mixed(&[(-4.0, TAIGA), (6.0, mild), (12.0, mild), (22.0, hot)], warm);
        let ground = mixed(&[(-17.0, snow), (-15.0, TUNDRA), (-13.5, TUNDRA), (-9.5, green)], warm);
        mix(ground, snow, ice).map(|c| (c * (1.0 + 0.12 * grain)).min(1.0))
    }

    /// The colour of the sea, or of a lake, at a place in degrees.
    pub(super) fn sea(&self, longitude: f64, latitude: f64) -> Color {
        let cold = smooth((latitude.abs() - 20.0) / 40.0);
        let shallow = smooth((self.climate.near_land(longitude, latitude) - 0.03) / 0.6);
        let [deep, shelf] =
            [[WARM_DEEP, COLD_DEEP], [WARM_SHALLOW, COLD_SHALLOW]].map(|[a, b]| mix(a, b, cold));
        let water = mix(deep, shelf, shallow);
        // The ice of the sea at the end of its summer, and ice shelves.
        let edge = if latitude > 0.0 { 80.0 } else { 71.0 };
        if latitude.abs() < edge - 7.0 {
            return water;
        }
        if latitude.abs() > edge + 7.0 {
            return SEA_ICE;
        }
        let patch = noise(&PATCHES, 2, unit(longitude, latitude));
        mix(water, SEA_ICE, smooth((latitude.abs() - edge + 5.0 * patch) / 2.5 + 0.5))
    }
}

const fn code([r, g, b]: [u8; 3]) -> Color {
    [r as f64 / 255.0, g as f64 / 255.0, b as f64 / 255.0]
}

fn mix(a: Color, b: Color, share: f64) -> Color {
    [0, 1, 2].map(|k| lerp(a[k], b[k], share))
}

/// The colour at a number, from colours at some numbers in their order.
fn mixed(stops: &[(f64, Color)], at: f64) -> Color {
    let mut color = stops[0].1;
    for pair in stops.windows(2) {
        let [(from, _), (to, next)] = [pair[0], pair[1]];
        color = mix(color, next, smooth((at - from) / (to - from)));
    }
    color
}

/// The sum of noises of several sizes at a unit vector, from −1 to 1: in space, so that the sphere has no
/// seam and no poles.
fn noise(parts: &[(f64, f64)], kind: u64, at: [f64; 3]) -> f64 {
    (0..).zip(parts).fold(0.0, |sum, (layer, (cells, weight))| {
        let value = Noise::new(SEED, 16 * kind + layer).space(at.map(|x| x * cells));
        sum + weight * (2.0 * value - 1.0)
    })
}
