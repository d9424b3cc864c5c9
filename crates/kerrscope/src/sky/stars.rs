//! The stars of the catalogue and the Milky Way.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use super::catalogue::Star;
use super::color;
use super::cube::{self, Place};
use super::glow::Glow;
use super::orientation::{Orientation, vector};
use crate::light::Light;
use crate::spacetime::tensor::Vec3;
use rayon::prelude::*;

/// Solid angle of white, in steradians, that shines as much as a star of magnitude 0.
const MAGNITUDE_ZERO: f64 = 1e-4;

/// Luminance of the brightest parts of the Milky Way.
///
/// By the scale of [`MAGNITUDE_ZERO`] this is as much as 900 stars of magnitude 10 in a square
/// degree give, about twice what photometry finds, so that it is seen on a screen.
const MILKY_WAY: f64 = 0.03;

/// Share of a bright star's light that is in its halo; magnitudes from which on it is all there,
/// and from which on there is none.
const HALO: f64 = 0.15;
const HALO_MAGNITUDES: [f64; 2] = [2.0, 5.0];

/// How much farther a halo reaches than the spot.
const HALO_REACH: f64 = 5.0;

/// Colour index that the Milky Way is drawn with: bluish white, as the eye sees faint light.
const MILKY_WAY_COLOR: f64 = 0.2;

/// Colour index of stars without a known one: about white.
const WHITE: f64 = 0.45;

/// Angles between which the size of a spot is kept.
const SPOT: [f64; 2] = [1e-6, 0.2];

/// Cells along an edge of the cube at most.
const CELLS: f64 = 128.0;

/// The stars of the catalogue, down to magnitude 8, and the Milky Way's glow behind them.
///
/// A star of magnitude m gives as much light as 10⁻⁴ · 10^(−0.4 m) steradians of white, whatever
/// the size of the spot it is drawn as. Its colour is that of a black body with its colour index.
///
/// A spot is round: at the distance d from its middle it has (1 + cos(π d/h))/2 of its peak, so
/// that it is half as bright at d = h/2 and ends at d = h, where h is the angle that a pixel
/// covers where nothing bends light. Bright stars, which would be white dots on a screen however
/// bright they are, have a faint halo beside: 15 % of the light of stars of magnitude 2 and
/// brighter, less down to none at magnitude 5, falling off as (1 − d²/R²)⁴ up to R = 5h. Lenses
/// magnify spots as they do pictures: stars seen near a hole become arcs, and their total light is
/// right as it is.
#[derive(Clone, PartialEq)]
pub struct Stars {
    orientation: Orientation,
    /// Luminance of the Milky Way where it is brightest.
    glow: Light,
    /// h, and 1/h².
    width: f64,
    inverse: f64,
    /// Cells along an edge of the cube.
    cells: usize,
    /// Where each cell's spots begin, and the end of the last.
    begin: Vec<u32>,
    spots: Vec<Spot>,
}

/// A star as drawn.
#[derive(Clone, Copy, PartialEq)]
struct Spot {
    /// Unit vector in equatorial coordinates.
    towards: [f32; 3],
    /// Light at the peak, without the halo.
    peak: [f32; 3],
    /// Peak of the halo in units of the other, 0 without one.
    halo: f32,
}

impl Stars {
    /// The sky for a picture whose pixels cover an angle in radians each; `orientation` is that of
    /// equatorial coordinates, and `brightness` a factor on all light.
    ///
    /// Outside 10⁻⁶ to 0.2 the angle is brought to the nearer of the two.
    pub fn new(pixel: f64, orientation: Orientation, brightness: f64) -> Self {
        let width = if pixel.is_nan() { SPOT[0] } else { pixel.clamp(SPOT[0], SPOT[1]) };
        // ∫ (1 + cos(π d/h))/2 · 2πd dd; with chords for d this is exact on a sphere too.
        let solid_angle = (FRAC_PI_2 - 2.0 / PI) * width * width;
        // ∫ (1 − d²/R²)⁴ · 2πd dd = πR²/5.
        let halo_angle = 0.2 * PI * (HALO_REACH * width).powi(2);
        let scale = brightness * MAGNITUDE_ZERO / solid_angle;
        let cells = (FRAC_PI_4 / width).clamp(1.0, CELLS) as usize;

        let place = |index: f64| (100.0 * index + 100.0).round() as usize % 1024;
        let stars: Vec<Star> = Star::catalogue().collect();
        let mut colors = vec![None; 1024];
        for star in &stars {
            let index = star.color_index.unwrap_or(WHITE);
            colors[place(index)].get_or_insert_with(|| color::of_index(index));
        }
        let drawn: Vec<(Spot, Vec<usize>)> = stars
            .par_iter()
            .map(|star| {
                let index = star.color_index.unwrap_or(WHITE);
                let color = colors[place(index)].unwrap_or([1.0; 3]);
                let towards = vector(star.right_ascension.to_radians(), star.declination.to_radians());
                let [all, none] = HALO_MAGNITUDES;
                let share = HALO * ((none - star.magnitude) / (none - all)).clamp(0.0, 1.0);
                let light = scale * (1.0 - share) * 10_f64.powf(-0.4 * star.magnitude);
                let spot = Spot {
                    towards: towards.map(|c| c as f32),
                    peak: color.map(|c| (c * light) as f32),
                    halo: (share / (1.0 - share) * solid_angle / halo_angle) as f32,
                };
                let reach = if share > 0.0 { HALO_REACH } else { 1.0 };
                (spot, touched(towards, reach * width, cells))
            })
            .collect();

        let mut begin = vec![0_u32; 6 * cells * cells + 1];
        for &cell in drawn.iter().flat_map(|(_, touched)| touched) {
            begin[cell + 1] += 1;
        }
        for cell in 1..begin.len() {
            begin[cell] += begin[cell - 1];
        }
        let mut free = begin.clone();
        let blank = Spot { towards: [0.0; 3], peak: [0.0; 3], halo: 0.0 };
        let mut spots = vec![blank; begin[begin.len() - 1] as usize];
        for (spot, touched) in &drawn {
            for &cell in touched {
                spots[free[cell] as usize] = *spot;
                free[cell] += 1;
            }
        }
        let glow = Light::new(color::of_index(MILKY_WAY_COLOR)) * (MILKY_WAY * brightness);
        Self { orientation, glow, width, inverse: width.powi(-2), cells, begin, spots }
    }

    /// The light that comes from a direction.
    pub fn radiance(&self, n: Vec3<f64>) -> Light {
        let n = self.orientation.inwards(n);
        let mut light = self.glow * Glow::brightness(n);
        let cell = cell(cube::place(n), self.cells);
        for spot in &self.spots[self.begin[cell] as usize..self.begin[cell + 1] as usize] {
            let towards = spot.towards.map(f64::from);
            let chord: f64 = (0..3).map(|k| (n[k] - towards[k]).powi(2)).sum::<f64>() * self.inverse;
            if chord < 1.0 || (spot.halo > 0.0 && chord < HALO_REACH * HALO_REACH) {
                let core = if chord < 1.0 { 0.5 + 0.5 * (PI * chord.sqrt()).cos() } else { 0.0 };
                let halo = f64::from(spot.halo) * (1.0 - chord / (HALO_REACH * HALO_REACH)).powi(4);
                light += Light::new(spot.peak.map(f64::from)) * (core + halo);
            }
        }
        light
    }

    /// Full width at half maximum of the spots, in radians.
    pub fn spot_width(&self) -> f64 {
        self.width
    }
}

impl std::fmt::Debug for Stars {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stars")
            .field("orientation", &self.orientation)
            .field("width", &self.width)
            .field("cells", &self.cells)
            .finish_non_exhaustive()
    }
}

fn cell(Place { face, at }: Place, cells: usize) -> usize {
    let [i, j] = at.map(|a| along(a, cells));
    (face * cells + j) * cells + i
}

fn along(a: f64, cells: usize) -> usize {
    (((a + 1.0) * 0.5 * cells as f64) as usize).min(cells - 1)
}

/// The cells that a spot touches, and perhaps some beside them.
fn touched(towards: [f64; 3], chord: f64, cells: usize) -> Vec<usize> {
    // Twice the sine of half the angle; a little more does no harm.
    let radius = 2.0 * (0.505 * chord).asin();
    let mut all = Vec::new();
    for face in 0..6 {
        let [c, a, b] = cube::components(face, towards);
        // A face's corner is where c = 1/√3, and cosines change by no more than angles do.
        if c < 0.57 - radius {
            continue;
        }
        // The planes through the face's other axis that the spot touches are at these angles from
        // the normal.
        let range = |a: f64| {
            let (middle, length) = (a.atan2(c), a.hypot(c));
            if length <= radius.sin() {
                return Some([0, cells - 1]);
            }
            let half = (radius.sin() / length).asin();
            if middle - half > FRAC_PI_4 || middle + half < -FRAC_PI_4 {
                return None;
            }
            let [low, high] = [middle - half, middle + half].map(|t| t.clamp(-FRAC_PI_4, FRAC_PI_4));
            Some([low, high].map(|t| along(t.tan(), cells)))
        };
        if let (Some(i), Some(j)) = (range(a), range(b)) {
            for j in j[0]..=j[1] {
                all.extend((i[0]..=i[1]).map(|i| (face * cells + j) * cells + i));
            }
        }
    }
    all
}
