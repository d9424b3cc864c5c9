//! The dark region within the light.
//!
//! Levels are counted from that of the sky, the median of the picture's outermost pixels, to that of the light, which 99.5 % of
//! the pixels do not exceed. Dark is what is below a fraction of this range. The fraction begins at one half and goes down until a
//! dark region is enclosed that is no mere pocket, but a quarter of the largest at any fraction: so it is half of the light wherever the
//! light is about even, and less where one side is dim. Its outline is followed as a closed curve of any shape.
//!
//! Where light begins abruptly, its edge is found from the levels on both its sides ([`super::profile`]), whatever the fraction.
//! Where it rises gradually there is no edge: the outline is that of the fraction, and depends on it.
//!
//! Any picture may enclose something dark. It is called no shadow
//!
//! - if there is another dark region at least half as large, as of two eyes or of the two halves that a disk seen nearly from its edge leaves
//!   of a shadow; or one within other light, as of a second hole;
//! - if its outline has dents: shadows and the inner edges of disks, seen from any side, have none to speak of (their area is 97 % of
//!   their hull's and more);
//! - if it is no darker than the sky, where the sky is not black;
//! - if the outline moves too far with a tenth of the level: hollows between blobs of light do, and are not round; blurred rings do, and are.

use std::f64::consts::PI;

use serde::Serialize;

use super::contour::{Region, Side, around, regions};
use super::noise::noise;
use super::profile::Field;
use super::rim::{EDGE_ERROR, Rim};
use super::{Curve, Measured, Picture};

/// Directions around a centre.
pub(super) const DIRECTIONS: usize = 360;
/// Fewest pixels of a region.
const SMALLEST: usize = 30;
/// The share of what a dark region's outline encloses that is dark itself, at least.
const DARK: f64 = 0.75;
/// Another dark region of this share of the largest is one too many.
const RIVAL: f64 = 0.5;
/// A dark region within other light counts from this share on.
const STRANGER: f64 = 0.05;
/// Regions smaller than this share of the largest at any fraction are pockets.
const POCKET: f64 = 0.25;
/// The share of its hull that a shadow fills, at least.
const SOLID: f64 = 0.93;
/// The sky is not black if it is so many times the noise, and this part of the light, above the darkest hundredth of the pixels.
const SKY_NOISE: f64 = 4.0;
const SKY_SHARE: f64 = 0.02;
/// The share of its radius by which an outline may move with a tenth of the level: one that is round, and any other.
const VAGUE: [f64; 2] = [0.15, 0.04];
/// Round is what has no larger circularity.
const ROUND: f64 = 0.1;

/// Levels of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Levels {
    /// Of the sky.
    pub sky: f64,
    /// Of the light.
    pub light: f64,
    /// Which one of a hundred pixels does not exceed.
    pub floor: f64,
    /// Standard deviation of the pixels' noise.
    pub noise: f64,
}

/// The shadow. Lengths are in pixels; errors are of one standard deviation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shadow {
    /// Centre of its area, right and up of the picture's middle.
    pub centre: [Measured; 2],
    /// Twice the mean over directions of its radius from that centre, ∮ r dθ/π.
    pub diameter: Measured,
    /// Area within the outline, pixels².
    pub area: Measured,
    /// Diameter 2√(S/π) of the circle that has the area S in which light is missing, counted by pixels: a second method.
    pub area_diameter: f64,
    /// Standard deviation of its radius over directions, in parts of their mean: 0 for a circle (as the circularity deviation of
    /// EHT Collaboration 2019 VI, §9.5, after Johannsen & Psaltis 2010, without their factors).
    pub circularity: Measured,
    /// Whether light begins abruptly around it; if not, the outline is that of `level` and depends on it.
    pub sharp: bool,
    /// What part of the light's level counts as dark.
    pub level: f64,
    /// The outline.
    #[serde(skip)]
    pub outline: Curve,
}

impl Levels {
    pub fn of(picture: &Picture) -> Self {
        let Picture { width, height, values, .. } = picture;
        let (width, height) = (*width, *height);
        let is_border = |k: &usize| {
            let (column, row) = (k % width, k / width);
            column == 0 || row == 0 || column + 1 == width || row + 1 == height
        };
        let mut border: Vec<f64> = (0..values.len()).filter(is_border).map(|k| values[k]).collect();
        let middle = border.len() / 2;
        let sky = *border.select_nth_unstable_by(middle, f64::total_cmp).1;
        let mut all = values.clone();
        let place = (all.len() * 995 / 1000).min(all.len() - 1);
        let light = *all.select_nth_unstable_by(place, f64::total_cmp).1;
        let place = all.len() / 100;
        let floor = *all.select_nth_unstable_by(place, f64::total_cmp).1;
        let noise = noise(values, [width, height]);
        Self { sky, light, floor, noise }
    }

    pub fn at(&self, fraction: f64) -> f64 {
        self.sky + fraction * (self.light - self.sky)
    }

    /// Why the light does not stand before a dark sky, if so. A hole's light does; that of most other pictures reaches their border.
    pub fn objection(&self, picture: &Picture) -> Option<String> {
        let Picture { width, height, values, .. } = picture;
        if !(self.light > self.sky) {
            return Some("the picture is no brighter inside than at its border".to_owned());
        }
        let half = self.at(0.25);
        let edges = (0..*width).flat_map(|x| [x, (height - 1) * width + x]);
        let sides = (0..*height).flat_map(|y| [y * width, y * width + width - 1]);
        let border: Vec<usize> = edges.chain(sides).collect();
        let bright = border.iter().filter(|&&k| values[k] > half).count();
        let share = bright as f64 / border.len() as f64;
        let floor = values.iter().copied().fold(f64::INFINITY, f64::min);
        if share > 0.1 {
            return Some(format!(
                "light reaches {:.0} % of the border: nothing stands before a dark sky",
                100.0 * share
            ));
        }
        ((self.sky - floor) > 0.3 * (self.light - floor)).then(|| {
            "the border is nearly as bright as what is within: nothing stands before a dark sky".to_owned()
        })
    }
}

impl Shadow {
    /// Looks for the shadow of a picture.
    pub(super) fn of(picture: &Picture, levels: Levels) -> Result<Self, String> {
        let fractions = std::iter::successors(Some(0.5), |f| Some(0.8 * f)).take_while(|f| *f > 0.02);
        let found: Vec<(f64, Vec<Region>)> = fractions
            .map(|f| (f, enclosed(picture, levels.at(f))))
            .filter(|(_, dark)| !dark.is_empty())
            .collect();
        let largest = found.iter().map(|(_, dark)| dark[0].pixels).max().unwrap_or(0);
        let mut reason = None;
        for (fraction, dark) in
            found.iter().filter(|(_, dark)| dark[0].pixels as f64 > POCKET * largest as f64)
        {
            rivals(picture, levels.at(*fraction), dark)?;
            match Self::within(picture, &dark[0], *fraction, levels) {
                Ok(shadow) => return Ok(shadow),
                Err(why) => reason = reason.or(Some(why)),
            }
        }
        Err(reason.unwrap_or_else(|| "no dark region is enclosed by light".to_owned()))
    }

    fn within(picture: &Picture, region: &Region, fraction: f64, levels: Levels) -> Result<Self, String> {
        let level = levels.at(fraction);
        let rim = Rim::of(picture, (level, Side::Dark, region), 1.5, |[dark, light]| dark < light);
        let sharp = rim.is_sharp();
        let outline = if sharp { rim.curve.clone() } else { around(picture, level, Side::Dark, region) };
        let centre = outline.centroid();
        let (mean, spread) = outline.mean_radius(centre);
        if mean < 3.0 {
            return Err(format!("the dark region that is enclosed is only {:.1} pixels wide", 2.0 * mean));
        }
        let solidity = outline.solidity();
        if solidity < SOLID {
            return Err(format!(
                "the dark region that is enclosed is no shadow: its outline has dents, and its area is {:.0} % of its hull's",
                100.0 * solidity
            ));
        }
        if spread > 0.4 * mean {
            return Err("the dark region that is enclosed is too far from round to be a shadow".to_owned());
        }
        let depth = levels.sky - levels.floor;
        let black = depth < (SKY_NOISE * levels.noise).max(SKY_SHARE * (levels.light - levels.floor));
        if !black && median_within(picture, &outline) > levels.sky - 0.5 * depth {
            return Err("the dark region that is enclosed is no darker than the sky outside".to_owned());
        }
        // One point's error; neighbours within a pixel of each other share it.
        let single = if sharp {
            outline.scatter().max(EDGE_ERROR)
        } else {
            // How far the outline moves when the level does by a tenth.
            let radius = |factor: f64| {
                let level = levels.at(factor * fraction);
                let all = enclosed(picture, level);
                let curves = all.iter().map(|region| around(picture, level, Side::Dark, region));
                curves.filter(|curve| curve.encloses(centre)).map(|curve| curve.mean_radius(centre).0).next()
            };
            let (Some(low), Some(high)) = (radius(0.9), radius(1.1)) else {
                return Err("the outline of the dark region depends on what is called dark".to_owned());
            };
            (high - low).abs().max(outline.scatter())
        };
        if single > VAGUE[usize::from(spread > ROUND * mean)] * mean {
            return Err(format!(
                "the dark region that is enclosed has no certain outline: it moves by {single:.1} pixels with a tenth of what is called dark, for \
                 a radius of {mean:.1}"
            ));
        }
        let independent = outline.length().max(1.0);
        let of_mean = if sharp { single / independent.sqrt() + 0.1 * EDGE_ERROR } else { single };
        let of_place = single / (0.5 * independent).sqrt() + 0.1 * EDGE_ERROR;
        let area = outline.area();
        let brightness: Vec<[f64; 2]> = if sharp {
            rim.levels.iter().map(|levels| levels.unwrap_or([0.0, level])).collect()
        } else {
            vec![[0.0, level]; outline.points.len()]
        };
        let area_diameter = 2.0 * (missing(picture, &outline, &brightness) / PI).sqrt();
        Ok(Self {
            centre: centre.map(|c| Measured::new(c, of_place)),
            diameter: Measured::new(2.0 * mean, 2.0 * of_mean),
            area: Measured::new(area, 2.0 * PI * mean * of_mean),
            area_diameter,
            circularity: Measured::new(spread / mean, of_place / mean),
            sharp,
            level: fraction,
            outline,
        })
    }
}

/// An objection if there are dark regions besides the first, which is the largest, that make it one of several.
fn rivals(picture: &Picture, level: f64, dark: &[Region]) -> Result<(), String> {
    let (first, others) = (&dark[0], &dark[1..]);
    if let Some(other) = others.iter().find(|r| r.pixels as f64 > RIVAL * first.pixels as f64) {
        return Err(format!(
            "light encloses dark regions of {} and {} pixels: which of them is a shadow, or part of one, cannot be told",
            first.pixels, other.pixels
        ));
    }
    let lit = regions(picture, level, Side::Light);
    let field = Field::new(picture);
    let place = |region: &Region| field.place(region.first % picture.width, region.first / picture.width);
    for other in others.iter().filter(|r| r.pixels as f64 > STRANGER * first.pixels as f64) {
        let shared = lit.iter().filter(|light| light.pixels >= SMALLEST / 2).any(|light| {
            let curve = around(picture, level, Side::Light, light);
            curve.encloses(place(first)) && curve.encloses(place(other))
        });
        if !shared {
            return Err(format!(
                "there are two rings of light, around dark regions of {} and {} pixels: more than one hole, or something else",
                first.pixels, other.pixels
            ));
        }
    }
    Ok(())
}

/// The median of the values within a curve.
fn median_within(picture: &Picture, curve: &Curve) -> f64 {
    let field = Field::new(picture);
    let mut values = Vec::new();
    for row in 0..picture.height {
        let cuts = within_row(curve, field.place(0, row)[1]);
        if !cuts.is_empty() {
            let inside = |column: &usize| {
                let x = field.place(*column, row)[0];
                cuts.iter().filter(|cut| **cut < x).count() % 2 == 1
            };
            values.extend(
                (0..picture.width).filter(inside).map(|column| picture.values[row * picture.width + column]),
            );
        }
    }
    let middle = values.len() / 2;
    if values.is_empty() { f64::NAN } else { *values.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// Sum over pixels of the light that is missing within an outline and at its edge, in units of the light around it.
#[expect(clippy::cast_possible_wrap, reason = "a picture has 16384 pixels along an edge at most")]
fn missing(picture: &Picture, outline: &Curve, levels: &[[f64; 2]]) -> f64 {
    let field = Field::new(picture);
    let Picture { width, height, values, .. } = picture;
    // For pixels up to two from the outline, the point of it that is nearest.
    let mut nearest: Vec<Option<(f64, usize)>> = vec![None; values.len()];
    for (k, point) in outline.points.iter().enumerate() {
        let [left, top] = field.place(0, 0);
        let (column, row) = ((point[0] - left).round() as isize, (top - point[1]).round() as isize);
        for (x, y) in (-3..=3).flat_map(|dy| (-3..=3).map(move |dx| (column + dx, row + dy))) {
            if (0..*width as isize).contains(&x) && (0..*height as isize).contains(&y) {
                let place = field.place(x as usize, y as usize);
                let distance = (place[0] - point[0]).hypot(place[1] - point[1]);
                let entry = &mut nearest[y as usize * width + x as usize];
                if distance < 2.0 && entry.is_none_or(|(before, _)| distance < before) {
                    *entry = Some((distance, k));
                }
            }
        }
    }
    let mut sum = 0.0;
    for row in 0..*height {
        let inside = within_row(outline, field.place(0, row)[1]);
        for column in 0..*width {
            let at = row * width + column;
            if let Some((_, k)) = nearest[at] {
                let [dark, light] = levels[k];
                sum += ((light - values[at]) / (light - dark)).clamp(0.0, 1.0);
            } else {
                let x = field.place(column, row)[0];
                sum += f64::from(u8::from(inside.iter().filter(|cut| **cut < x).count() % 2 == 1));
            }
        }
    }
    sum
}

/// Where a row crosses a curve.
fn within_row(curve: &Curve, y: f64) -> Vec<f64> {
    let next = curve.points.iter().skip(1).chain(curve.points.first());
    let crosses = curve.points.iter().zip(next).filter(|(a, b)| (a[1] > y) != (b[1] > y));
    crosses.map(|(a, b)| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])).collect()
}

/// Dark regions that do not reach the border and have little light within, the largest first.
fn enclosed(picture: &Picture, level: f64) -> Vec<Region> {
    let mut found = regions(picture, level, Side::Dark);
    found.retain(|region| !region.open && region.pixels >= SMALLEST);
    found.sort_by_key(|region| std::cmp::Reverse(region.pixels));
    found.truncate(8);
    found.retain(|region| {
        region.pixels as f64 > DARK * around(picture, level, Side::Dark, region).polygon_area()
    });
    found
}
