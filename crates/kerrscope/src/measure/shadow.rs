//! The dark region within the light.
//!
//! Levels are counted from that of the sky, the median of the picture's outermost pixels, to that of the light, which 99.5 % of
//! the pixels do not exceed. Dark is what is below a fraction of this range. The fraction begins at one half and goes down until a
//! dark region is enclosed whose outline each direction from its centroid meets once: so it is half of the light
//! wherever the light is about even, and less where one side is dim.
//!
//! Where light begins abruptly, its edge is found from the levels on both its sides ([`super::profile`]), whatever the fraction.
//! Where it rises gradually there is no edge: the outline is that of the fraction, and depends on it.

use std::f64::consts::{PI, TAU};

use serde::Serialize;

use super::profile::Field;
use super::{Measured, Outline, Picture};

/// Directions of an outline.
pub(super) const DIRECTIONS: usize = 360;
/// The error of the place of a sharp edge in one direction, pixels: what remains for oblique edges.
pub(super) const EDGE_ERROR: f64 = 0.03;
/// Fewest pixels of a region.
const SMALLEST: usize = 30;

/// Levels of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Levels {
    /// Of the sky.
    pub sky: f64,
    /// Of the light.
    pub light: f64,
}

/// The shadow. Lengths are in pixels; errors are of one standard deviation.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Shadow {
    /// Centre of its area, right and up of the picture's middle.
    pub centre: [Measured; 2],
    /// Twice the mean over directions of its radius from that centre.
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
    pub outline: Outline,
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
        let (_, sky, _) = border.select_nth_unstable_by(middle, f64::total_cmp);
        let mut all = values.clone();
        let place = (all.len() * 995 / 1000).min(all.len() - 1);
        let (_, light, _) = all.select_nth_unstable_by(place, f64::total_cmp);
        Self { sky: *sky, light: *light }
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
        let field = Field::new(picture);
        let mut reason = "no dark region is enclosed by light".to_owned();
        let mut fraction: f64 = 0.5;
        while fraction > 0.02 {
            if let Some(start) = enclosed(picture, levels.at(fraction)) {
                match Self::around(picture, &field, start, fraction, levels) {
                    Ok(shadow) => return Ok(shadow),
                    Err(why) => reason = why,
                }
            }
            fraction *= 0.8;
        }
        Err(reason)
    }

    fn around(
        picture: &Picture,
        field: &Field<'_>,
        start: [f64; 2],
        fraction: f64,
        levels: Levels,
    ) -> Result<Self, String> {
        let level = levels.at(fraction);
        let mut outline = trace(field, start, level)?;
        for _ in 0..3 {
            outline = trace(field, outline.0.centroid(), level)?;
        }
        let (outline, sharp, brightness) = outline;
        let (mean, spread) = outline.mean_radius();
        let jump = outline.largest_jump();
        if jump > (0.15 * mean).max(2.0) {
            return Err("the dark region that is enclosed has no smooth outline".to_owned());
        }
        if mean < 3.0 {
            return Err(format!("the dark region that is enclosed is only {:.1} pixels wide", 2.0 * mean));
        }
        if spread > 0.4 * mean {
            return Err("the dark region that is enclosed is too far from round to be a shadow".to_owned());
        }
        // One direction's error; neighbours within a pixel of each other share it.
        let apart = (TAU * mean / DIRECTIONS as f64).min(1.0);
        let single = if sharp {
            outline.scatter().max(EDGE_ERROR)
        } else {
            // How far the outline moves when the level does by a tenth.
            let moved = [0.9, 1.1].map(|f| trace(field, outline.centre, levels.at(f * fraction)));
            let [Ok(low), Ok(high)] = moved else {
                return Err("the outline of the dark region depends on what is called dark".to_owned());
            };
            (high.0.mean_radius().0 - low.0.mean_radius().0).abs().max(outline.scatter())
        };
        let independent = (DIRECTIONS as f64 * apart).max(1.0);
        let of_mean = if sharp { single / independent.sqrt() + 0.1 * EDGE_ERROR } else { single };
        let of_place = single / (0.5 * independent).sqrt() + 0.1 * EDGE_ERROR;
        let centre = outline.centroid();
        let area = outline.area();
        let area_diameter = 2.0 * (missing(picture, field, &outline, &brightness) / PI).sqrt();
        Ok(Self {
            centre: centre.map(|c| Measured::new(c, of_place)),
            diameter: Measured::new(2.0 * mean, 2.0 * of_mean),
            area: Measured::new(area, TAU * mean * of_mean),
            area_diameter,
            circularity: Measured::new(spread / mean, of_place / mean),
            sharp,
            level: fraction,
            outline,
        })
    }
}

/// The outline about a centre, whether it is sharp, and the levels inside and outside.
fn trace(field: &Field<'_>, centre: [f64; 2], level: f64) -> Result<(Outline, bool, Vec<[f64; 2]>), String> {
    let mut rough = Vec::with_capacity(DIRECTIONS);
    let mut edges = Vec::with_capacity(DIRECTIONS);
    for k in 0..DIRECTIONS {
        let angle = TAU * k as f64 / DIRECTIONS as f64;
        let near = first_above(field, centre, angle, level)
            .ok_or_else(|| "the dark region that is enclosed has no smooth outline".to_owned())?;
        rough.push(near);
        edges.push(field.edge(centre, angle, near).filter(|e| e.sharp && (e.radius - near).abs() < 1.5));
    }
    let sharp = edges.iter().flatten().count() * 10 >= DIRECTIONS * 8;
    let radius = |(near, edge): (&f64, &Option<super::profile::Edge>)| {
        edge.filter(|_| sharp).map_or(*near, |e| e.radius)
    };
    let radii: Vec<f64> = rough.iter().zip(&edges).map(radius).collect();
    let brightness =
        edges.iter().map(|edge| edge.filter(|_| sharp).map_or([0.0, level], |e| e.levels)).collect();
    Ok((Outline { centre, radii }, sharp, brightness))
}

/// Where a ray first rises above a level.
fn first_above(field: &Field<'_>, centre: [f64; 2], angle: f64, level: f64) -> Option<f64> {
    let step = 0.25;
    let count = (field.reach(centre, angle) / step) as usize;
    let mut before = field.at(centre);
    for k in 1..=count {
        let value = field.on_ray(centre, angle, k as f64 * step);
        if value > level {
            if before >= level {
                return None;
            }
            return Some((k as f64 - (value - level) / (value - before)) * step);
        }
        before = value;
    }
    None
}

/// Sum over pixels of the light that is missing within an outline and at its edge, in units of the light around it.
fn missing(picture: &Picture, field: &Field<'_>, outline: &Outline, levels: &[[f64; 2]]) -> f64 {
    let n = outline.radii.len();
    let mut sum = 0.0;
    for row in 0..picture.height {
        for column in 0..picture.width {
            let [x, y] = field.place(column, row);
            let (x, y) = (x - outline.centre[0], y - outline.centre[1]);
            let k = ((y.atan2(x) / TAU).rem_euclid(1.0) * n as f64).round() as usize % n;
            let distance = x.hypot(y) - outline.radii[k];
            if distance < -2.0 {
                sum += 1.0;
            } else if distance < 2.0 {
                let [dark, light] = levels[k];
                let value = picture.values[row * picture.width + column];
                sum += ((light - value) / (light - dark)).clamp(0.0, 1.0);
            }
        }
    }
    sum
}

/// The centroid of the largest region below a level that does not reach the border and has its centroid in itself.
fn enclosed(picture: &Picture, level: f64) -> Option<[f64; 2]> {
    let Picture { width, height, values, .. } = picture;
    let (width, height) = (*width, *height);
    let mut seen: Vec<bool> = values.iter().map(|value| *value > level).collect();
    let mut best: Option<(usize, [f64; 2])> = None;
    let mut region = Vec::new();
    for first in 0..values.len() {
        if seen[first] {
            continue;
        }
        region.clear();
        region.push(first);
        seen[first] = true;
        let (mut done, mut open) = (0, false);
        while let Some(&at) = region.get(done) {
            done += 1;
            let (column, row) = (at % width, at / width);
            let inside = column > 0 && row > 0 && column + 1 < width && row + 1 < height;
            open |= !inside;
            let mut visit = |next: usize| {
                if !seen[next] {
                    seen[next] = true;
                    region.push(next);
                }
            };
            if column > 0 {
                visit(at - 1);
            }
            if column + 1 < width {
                visit(at + 1);
            }
            if row > 0 {
                visit(at - width);
            }
            if row + 1 < height {
                visit(at + width);
            }
        }
        if open || region.len() < SMALLEST || best.is_some_and(|(size, _)| size >= region.len()) {
            continue;
        }
        let n = region.len() as f64;
        let [x, y] = region
            .iter()
            .fold([0.0; 2], |[x, y], at| [x + (at % width) as f64, y + (at / width) as f64])
            .map(|sum| sum / n);
        // Between two rows or columns either may be in it.
        let corners = [[x.floor(), y.floor()], [x.ceil(), y.ceil()]];
        if corners.iter().any(|[x, y]| values[*y as usize * width + *x as usize] <= level) {
            let field = Field::new(picture);
            let [left, top] = field.place(0, 0);
            best = Some((region.len(), [left + x, top - y]));
        }
    }
    best.map(|(_, centroid)| centroid)
}
