//! A picture around a sphere, and smaller ones of it for what is seen from afar.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use half::f16;
use rayon::prelude::*;

use super::{Texel, Texels, Texture, finite, half, mix, sheet};
use crate::light::Sheet;

/// A picture that covers a sphere, `u` once around and `v` from pole to pole, as a mip map
/// (Williams 1983): the picture and smaller ones, each with half the pixels of the one before it
/// in both directions, down to a single one.
///
/// Each pixel is the mean over the solid angle that it covers, so that a level shines as much as
/// the picture. The smaller levels keep linear light with 16 bits (see the [module](super)) and
/// have a third of the picture's pixels together.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    levels: Vec<Texture>,
    /// Angle of a pixel of the picture in radians, in the direction in which it is finer.
    pixel: f64,
}

impl Sphere {
    /// The mip map of a picture.
    pub fn new(texture: Texture) -> Self {
        let pixel = (TAU / f64::from(texture.width)).min(PI / f64::from(texture.height));
        let mut levels = vec![texture];
        while let Some(last) = levels.last().filter(|last| last.width > 1 || last.height > 1) {
            let next = halved(last);
            levels.push(next);
        }
        Self { levels, pixel }
    }

    /// Light (scaled by alpha) and alpha at a place, seen by a ray that stands for an angle on the
    /// sphere in radians: between the two levels whose pixels are next to it in size, in proportion
    /// to its logarithm. Of the picture itself, which is taken for all angles below its pixels', it
    /// is interpolated between the four nearest. Finite for any numbers.
    pub fn sample(&self, u: f64, v: f64, angle: f64) -> Sheet {
        let last = self.levels.len() - 1;
        // `max` drops what is no number.
        let level = (angle / self.pixel).log2().max(0.0).min(last as f64);
        let (fine, share) = (level as usize, level.fract());
        let texel = around(&self.levels[fine], u, v);
        if share == 0.0 {
            return sheet(texel);
        }
        sheet(mix(texel, around(&self.levels[fine + 1], u, v), share))
    }

    /// The levels, the picture itself first.
    pub fn levels(&self) -> &[Texture] {
        &self.levels
    }
}

/// What lies beyond a pole is the same row, half a turn on, so that there is no seam across the
/// poles.
fn around(texture: &Texture, u: f64, v: f64) -> Texel {
    let y = finite(v).clamp(0.0, 1.0) * f64::from(texture.height) - 0.5;
    let (upper, f) = (y.floor(), y - y.floor());
    let last = f64::from(texture.height - 1);
    let row = |y: f64| {
        let beyond = y < 0.0 || y > last;
        texture.row(y.clamp(0.0, last) as usize, if beyond { u + 0.5 } else { u }, true)
    };
    mix(row(upper), row(upper + 1.0), f)
}

/// The picture with half its width and half its height, rounded down, but at least 1.
fn halved(texture: &Texture) -> Texture {
    let [width, height] = [texture.width, texture.height].map(|n| (n / 2).max(1));
    let channels: &[usize] = match texture.channels {
        1 => &[0],
        2 => &[0, 3],
        3 => &[0, 1, 2],
        _ => &[0, 1, 2, 3],
    };
    let columns: Vec<_> = (0..width).map(|x| shares(x, texture.width, width, |u| u)).collect();
    let line = width as usize * channels.len();
    let mut texels = vec![f16::ZERO; line * height as usize];
    texels.par_chunks_mut(line).zip(0..height).for_each(|(line, y)| {
        // Of a unit sphere, sin²(πv/2) lies above v.
        let rows = shares(y, texture.height, height, |v| (FRAC_PI_2 * v).sin().powi(2));
        for (texel, columns) in line.chunks_exact_mut(channels.len()).zip(&columns) {
            let mut sum = [0.0; 4];
            for &(y, part) in &rows {
                for &(x, share) in columns {
                    let texel = texture.texel(x, y);
                    sum = std::array::from_fn(|k| sum[k] + share * part * texel[k]);
                }
            }
            for (value, &k) in texel.iter_mut().zip(channels) {
                *value = half(sum[k] as f32);
            }
        }
    });
    Texture { width, height, channels: channels.len(), texels: Texels::Half(texels) }
}

/// The pixels of a line of `from` that the pixel `at` of a line of `to` covers, with their shares
/// in it; `before` is how much of everything lies before a place from 0 to 1.
fn shares(at: u32, from: u32, to: u32, before: impl Fn(f64) -> f64) -> Vec<(usize, f64)> {
    let ratio = f64::from(from) / f64::from(to);
    let (begin, end) = (f64::from(at) * ratio, f64::from(at + 1) * ratio);
    let between = |a: f64, b: f64| before(b / f64::from(from)) - before(a / f64::from(from));
    (begin as u32..(end.ceil() as u32).min(from))
        .map(|x| {
            let covered = between(begin.max(f64::from(x)), end.min(f64::from(x) + 1.0));
            (x as usize, covered / between(begin, end))
        })
        .collect()
}
