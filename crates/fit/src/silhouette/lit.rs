//! Where a picture is lit.

use crate::fit::Image;
use crate::noise;

/// What part of the light's level counts as lit: next to nothing, as one side of a disk is dim.
const FAINT: f64 = 1e-3;

/// Standard deviations of the noise above the sky.
const ABOVE: f64 = 6.0;

/// Light that is plain to see, in units of what lit begins with for want of brightness, and for whatever reason.
const CLEAR: (f64, f64) = (14.0, 4.0);

/// What part of the light's level is dark for sure.
const DARK: f64 = 0.05;

/// A region smaller than this share of the largest is a speck, and so is one of fewer pixels.
const SPECK: (f64, usize) = (5e-3, 6);

/// Levels of brightness.
#[derive(Clone, Copy, Debug)]
pub struct Levels {
    /// Of the sky.
    pub sky: f64,
    /// How much above it lit begins.
    pub faint: f64,
    /// How much above it light is that is plain to see.
    pub clear: f64,
}

impl Levels {
    /// Of a picture: the sky's is that of the darkest two hundredth, less what noise makes darker.
    pub fn of(image: &Image) -> Result<Self, String> {
        let mut sorted = image.values.clone();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| sorted[((sorted.len() - 1) as f64 * share) as usize];
        let (darkest, light) = (at(0.005), at(0.995));
        let noise = dark_noise(image, darkest + DARK * (light - darkest));
        let sky = darkest + 2.6 * noise;
        let faint = (FAINT * (light - sky)).max(ABOVE * noise);
        let clear = (CLEAR.0 * FAINT * (light - sky)).max(CLEAR.1 * faint);
        if !(light - sky > 4.0 * faint) {
            return Err("no light stands out of the picture's noise: it has no silhouette".to_owned());
        }
        Ok(Self { sky, faint, clear })
    }

    /// Whether a brightness is lit.
    pub fn lit(&self, value: f64) -> bool {
        value - self.sky > self.faint
    }
}

/// The standard deviation of the noise where a picture is darker than a level, as `noise::estimate` finds that of all of it: the steps of
/// eight bits are small there, and edges are not there.
fn dark_noise(image: &Image, level: f64) -> f64 {
    let [width, height] = image.size;
    let mut differences = Vec::new();
    for row in 1..height - 1 {
        for column in 1..width - 1 {
            let at = |x: usize, y: usize| image.values[(row + y - 1) * width + column + x - 1];
            if (0..9).all(|k| at(k % 3, k / 3) < level) {
                let corners = at(0, 0) + at(2, 0) + at(0, 2) + at(2, 2);
                let sides = at(1, 0) + at(0, 1) + at(2, 1) + at(1, 2);
                differences.push((corners - 2.0 * sides + 4.0 * at(1, 1)).abs() / 6.0);
            }
        }
    }
    if differences.len() < 50 {
        return noise::estimate(&image.values, image.size);
    }
    differences.sort_by(f64::total_cmp);
    differences[differences.len() / 2] / 0.674_489_75
}

/// What is lit.
pub struct Region {
    /// Of each pixel, specks filled or left out.
    pub lit: Vec<bool>,
    /// Whether it belongs to a speck.
    pub speck: Vec<bool>,
    /// Whether what is lit reaches over the border.
    pub open: bool,
}

impl Region {
    pub fn of(image: &Image, levels: &Levels) -> Result<Self, String> {
        let [width, height] = image.size;
        let mut lit: Vec<bool> = image.values.iter().map(|value| levels.lit(*value)).collect();
        let mut speck = vec![false; lit.len()];
        for state in [true, false] {
            let parts = parts(&lit, image.size, state);
            let largest = parts.iter().map(Vec::len).max().unwrap_or(0);
            for part in parts {
                if part.len() < SPECK.1 || (part.len() as f64) < SPECK.0 * largest as f64 {
                    for pixel in part {
                        lit[pixel] = !state;
                        speck[pixel] = true;
                    }
                }
            }
        }
        let border: Vec<usize> = (0..lit.len())
            .filter(|k| {
                let (column, row) = (k % width, k / width);
                column == 0 || row == 0 || column + 1 == width || row + 1 == height
            })
            .collect();
        let count = lit.iter().filter(|lit| **lit).count();
        if count == lit.len() {
            return Err("all of the picture is lit: it has no silhouette".to_owned());
        }
        let reached = border.iter().filter(|pixel| lit[**pixel]).count();
        Ok(Self { open: reached as f64 > 0.1 * border.len() as f64, lit, speck })
    }
}

/// Connected parts of what is lit, by sides and corners, or of what is dark, by sides.
fn parts(lit: &[bool], [width, height]: [usize; 2], state: bool) -> Vec<Vec<usize>> {
    let mut seen = vec![false; lit.len()];
    let mut parts = Vec::new();
    for first in 0..lit.len() {
        if seen[first] || lit[first] != state {
            continue;
        }
        seen[first] = true;
        let mut part = vec![first];
        let mut next = 0;
        while next < part.len() {
            let (column, row) = (part[next] % width, part[next] / width);
            for y in row.saturating_sub(1)..(row + 2).min(height) {
                for x in column.saturating_sub(1)..(column + 2).min(width) {
                    let pixel = y * width + x;
                    if !seen[pixel] && lit[pixel] == state && (state || x == column || y == row) {
                        seen[pixel] = true;
                        part.push(pixel);
                    }
                }
            }
            next += 1;
        }
        parts.push(part);
    }
    parts
}
