//! The computed surface of a disk: bands of orange.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::Place;
use crate::light::{Light, Sheet};
use crate::noise::{Noise, lerp, smooth};

/// Bands of pseudo-random opacity, in orange: a disk that shows how light bends. It is a
/// drawing, not a model of gas.
///
/// Concentric bands at several scales stand for brighter and darker parts. Their opacity
/// varies weakly along the azimuth, so that a disk seen through a turning spacetime looks
/// different from one that is not. Both edges fade out. The colour goes from a pale
/// yellow inside to a deep orange outside, and the light falls with it.
///
/// The bands depend on the seed alone, and scale with the disk.
#[derive(Clone)]
pub struct Ring {
    seed: u64,
    /// The tables are 300 KB and the same for a seed: copies share them.
    tables: Arc<Tables>,
}

impl PartialEq for Ring {
    fn eq(&self, other: &Self) -> bool {
        self.seed == other.seed
    }
}

impl std::fmt::Debug for Ring {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Ring").field("seed", &self.seed).finish_non_exhaustive()
    }
}

/// The noise in full costs microseconds a point, these tables tens of nanoseconds. They
/// resolve the finest noise with 20 entries a lattice cell.
struct Tables {
    /// From the inner edge to the outer: opacity, then red, green and blue.
    bands: Vec<[f32; 4]>,
    /// Factor on the opacity: rows from the inner edge to the outer, columns once around.
    arcs: Vec<f32>,
}

const BANDS: usize = 2048;
const ARC_ROWS: usize = 256;
const ARC_COLUMNS: usize = 256;

/// Bands across the disk and the weight of each scale.
const SCALES: [(f64, f64); 5] = [(4.0, 0.8), (9.0, 0.9), (21.0, 0.8), (45.0, 0.5), (93.0, 0.3)];

/// Arcs across the disk, arcs around it, and the weight of each scale.
const ARC_SCALES: [(f64, i64, f64); 3] = [(5.0, 4, 1.0), (12.0, 7, 0.9), (12.0, 13, 0.5)];

impl Ring {
    /// The ring of a seed.
    pub fn new(seed: u64) -> Self {
        Self { seed, tables: Arc::new(Tables::new(seed)) }
    }

    /// The seed.
    pub const fn seed(&self) -> u64 {
        self.seed
    }

    pub(super) fn at(&self, place: Place) -> Sheet {
        let [opacity, r, g, b] = self.tables.band(place.across);
        let turns = place.azimuth / TAU;
        let opacity = opacity * self.tables.arc(place.across, turns - turns.floor());
        Sheet { light: Light::new([r, g, b]) * opacity, opacity }
    }
}

impl Tables {
    fn new(seed: u64) -> Self {
        let bands = (0..BANDS).map(|i| band(seed, i as f64 / (BANDS - 1) as f64)).collect();
        let arcs = (0..ARC_ROWS * ARC_COLUMNS)
            .map(|i| {
                let s = (i / ARC_COLUMNS) as f64 / (ARC_ROWS - 1) as f64;
                arc(seed, s, (i % ARC_COLUMNS) as f64 / ARC_COLUMNS as f64) as f32
            })
            .collect();
        Self { bands, arcs }
    }

    fn band(&self, s: f64) -> [f64; 4] {
        let x = s * (BANDS - 1) as f64;
        let i = (x as usize).min(BANDS - 2);
        let f = x - i as f64;
        let (a, b) = (&self.bands[i], &self.bands[i + 1]);
        std::array::from_fn(|k| lerp(f64::from(a[k]), f64::from(b[k]), f))
    }

    fn arc(&self, s: f64, turns: f64) -> f64 {
        let (x, y) = (s * (ARC_ROWS - 1) as f64, turns * ARC_COLUMNS as f64);
        let (i, j) = ((x as usize).min(ARC_ROWS - 2), y as usize);
        let (fx, fy) = (x - i as f64, y - j as f64);
        let at = |i, j| f64::from(self.arcs[i * ARC_COLUMNS + j % ARC_COLUMNS]);
        lerp(lerp(at(i, j), at(i + 1, j), fx), lerp(at(i, j + 1), at(i + 1, j + 1), fx), fy)
    }
}

/// Opacity and colour at `s`, 0 at the inner edge to 1 at the outer.
fn band(seed: u64, s: f64) -> [f32; 4] {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (layer, (bands, weight)) in (0..).zip(SCALES) {
        sum += weight * Noise::new(seed, layer).line(s * bands);
        weights += weight;
    }
    // The mean of several scales rarely leaves 0.25 to 0.75: spread it.
    let noise = smooth((sum / weights - 0.25) / 0.5);
    let edges = smooth(s / 0.05) * smooth((1.0 - s) / 0.08);
    let opacity = lerp(0.08, 0.98, noise) * edges;

    // Thin parts are deeper in colour: pale ones would look like mud.
    let [r, g, b] = colour((s + 0.55 * (1.0 - noise * edges)).min(1.0)).map(|c| c * strength(s));
    [opacity, r, g, b].map(|c| c as f32)
}

/// Linear light at full opacity: pale yellow, orange, deep orange.
fn colour(s: f64) -> [f64; 3] {
    const STOPS: [[f64; 3]; 3] = [[1.0, 0.66, 0.26], [1.0, 0.33, 0.035], [1.0, 0.18, 0.008]];
    let x = 2.0 * s;
    let i = usize::from(x >= 1.0);
    std::array::from_fn(|k| lerp(STOPS[i][k], STOPS[i + 1][k], x - i as f64))
}

/// Brightness: falls outwards.
fn strength(s: f64) -> f64 {
    let t = 1.0 - s;
    0.5 + 1.6 * t * t
}

/// Factor on the opacity, 0.5 to 1; `turns` goes once around from 0 to 1.
fn arc(seed: u64, s: f64, turns: f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (layer, (across, around, weight)) in (100..).zip(ARC_SCALES) {
        let noise = Noise::new(seed, layer).sheet(s * across, turns * around as f64, around);
        sum += weight * noise;
        weights += weight;
    }
    lerp(0.5, 1.0, smooth((sum / weights - 0.25) / 0.5))
}
