//! Where to begin: a picture is compared with those of some disks, turned, moved and mirrored.

use rayon::prelude::*;

use super::matter::Profile;
use super::picture::{Fineness, Painter, Setting};
use super::screen::{Frame, Projection};
use crate::model::Cancelled;
use crate::reduce::reduced;

/// A disk that a picture may be of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// a.
    pub spin: f64,
    /// Degrees.
    pub inclination: f64,
    /// Degrees.
    pub position_angle: f64,
    /// M in a pixel.
    pub scale: f64,
    /// Pixels from the middle, right and up.
    pub center: [f64; 2],
    /// How much of the picture's variance it leaves unexplained.
    pub left: f64,
    /// Number of the template that it is.
    pub template: usize,
}

/// A disk to compare a picture with.
#[derive(Clone, Copy, Debug)]
pub struct Template {
    /// The disk; its frame does not count.
    pub setting: Setting,
    /// Width of the picture, M.
    pub width: f64,
}

const SPINS: [f64; 4] = [-0.6, 0.3, 0.75, 0.95];
const INCLINATIONS: [f64; 5] = [12.0, 38.0, 58.0, 73.0, 83.0];
const TURNS: usize = 24;
/// Widths of the picture, M: the first, and by what factor the others grow.
const WIDTHS: (f64, f64, i32) = (12.0, 1.35, 9);
/// Places of the hole to each side, as shares of half the picture's width.
const MOVES: i32 = 3;
const MOVE: f64 = 0.14;
/// Pixels across the picture, and across a template, which is larger.
const COARSE: usize = 20;
const TEMPLATE: usize = 60;
const LARGER: f64 = 1.6;
/// Starts that are given.
const KEPT: usize = 32;

/// A picture less its mean, and its size.
struct Coarse {
    values: Vec<f64>,
    size: [usize; 2],
    square: f64,
}

/// Disks that a picture may be of, the most alike first.
pub fn find(values: &[f64], size: [usize; 2], cancelled: Cancelled<'_>) -> Vec<Start> {
    let painter = Painter::new(Projection::Angular, true, Fineness::SKETCH);
    let mut templates = Vec::new();
    for spin in SPINS {
        for inclination in INCLINATIONS {
            for k in 0..WIDTHS.2 {
                let setting = Setting {
                    spin,
                    inclination: inclination.to_radians(),
                    u: 1e-3,
                    inner: 1.0,
                    outer: f64::INFINITY,
                    profile: Profile::PageThorne,
                    frame: Frame { size, scale: 1.0, center: [0.0; 2], position_angle: 0.0 },
                };
                templates.push(Template { setting, width: WIDTHS.0 * WIDTHS.1.powi(k) });
            }
        }
    }
    among(values, size, &painter, &templates, cancelled)
}

/// Disks among some that a picture may be of, the most alike first.
pub fn among(
    values: &[f64],
    size: [usize; 2],
    painter: &Painter,
    templates: &[Template],
    cancelled: Cancelled<'_>,
) -> Vec<Start> {
    let factor = size[0].max(size[1]).div_ceil(COARSE).max(1);
    let (mut means, small) = reduced(values, size, factor);
    let mean = means.iter().sum::<f64>() / means.len().max(1) as f64;
    for value in &mut means {
        *value -= mean;
    }
    let square = means.iter().map(|value| value * value).sum::<f64>();
    if !(square > 0.0) {
        return Vec::new();
    }
    let coarse = Coarse { values: means, size: small, square };
    let mut found: Vec<Start> = templates
        .par_iter()
        .enumerate()
        .filter(|_| !cancelled())
        .flat_map_iter(|(number, Template { setting, width })| {
            let frame = Frame {
                size: [TEMPLATE; 2],
                scale: LARGER * width / TEMPLATE as f64,
                center: [0.0; 2],
                position_angle: 0.0,
            };
            let setting = Setting { frame, ..*setting };
            let template: Vec<f64> = painter
                .draw(&setting, false)
                .map(|canvas| canvas.pixels().iter().map(|pixel| pixel[0]).collect())
                .unwrap_or_default();
            let mut found = if template.is_empty() {
                Vec::new()
            } else {
                alike(&coarse, &template, &setting, *width, size)
            };
            for start in &mut found {
                start.template = number;
            }
            found
        })
        .collect();
    found.sort_by(|a, b| a.left.total_cmp(&b.left));
    // Of those that are nearly the same, one.
    let mut kept: Vec<Start> = Vec::new();
    for start in found {
        let same = |other: &Start| {
            let turn = (start.position_angle - other.position_angle + 540.0).rem_euclid(360.0) - 180.0;
            start.spin == other.spin
                && start.inclination == other.inclination
                && templates[start.template].setting.outer == templates[other.template].setting.outer
                && (start.scale / other.scale).ln().abs() < 0.35
                && turn.abs() < 20.0
        };
        if !kept.iter().any(same) {
            kept.push(start);
        }
        if kept.len() == KEPT {
            break;
        }
    }
    kept
}

/// The best places of a template for each turn, as it is and mirrored.
fn alike(coarse: &Coarse, template: &[f64], setting: &Setting, width: f64, size: [usize; 2]) -> Vec<Start> {
    let [columns, rows] = coarse.size;
    // Template pixels in a coarse pixel.
    let step = width / columns.max(rows) as f64 / setting.frame.scale;
    let mut found = Vec::new();
    for mirrored in [false, true] {
        for turn in 0..TURNS {
            let angle = std::f64::consts::TAU * turn as f64 / TURNS as f64;
            let (sin, cos) = angle.sin_cos();
            let mut best: Option<(f64, [f64; 2])> = None;
            for x in -MOVES..=MOVES {
                for y in -MOVES..=MOVES {
                    let half = 0.5 * columns.max(rows) as f64;
                    let center = [f64::from(x) * MOVE * half, f64::from(y) * MOVE * half];
                    let (mut sum, mut square, mut product) = (0.0, 0.0, 0.0);
                    for (pixel, datum) in coarse.values.iter().enumerate() {
                        let right = (pixel % columns) as f64 + 0.5 - 0.5 * columns as f64 - center[0];
                        let up = 0.5 * rows as f64 - (pixel / columns) as f64 - 0.5 - center[1];
                        // Back by the position angle, which turns anticlockwise.
                        let (along, across) = (cos * right + sin * up, cos * up - sin * right);
                        let across = if mirrored { -across } else { across };
                        let value = sample(template, along * step, across * step);
                        sum += value;
                        square += value * value;
                        product += value * datum;
                    }
                    let n = coarse.values.len() as f64;
                    let variance = square - sum * sum / n;
                    // The light is not negative.
                    let explained = if variance > 0.0 && product > 0.0 {
                        product * product / variance / coarse.square
                    } else {
                        0.0
                    };
                    if best.is_none_or(|(most, _)| explained > most) {
                        best = Some((explained, center));
                    }
                }
            }
            if let Some((explained, center)) = best {
                let pixels = size[0].max(size[1]) as f64 / columns.max(rows) as f64;
                let inclination = setting.inclination.to_degrees();
                found.push(Start {
                    spin: setting.spin,
                    inclination: if mirrored { 180.0 - inclination } else { inclination },
                    position_angle: angle.to_degrees(),
                    scale: width / size[0].max(size[1]) as f64,
                    center: [center[0] * pixels, center[1] * pixels],
                    left: 1.0 - explained,
                    template: 0,
                });
            }
        }
    }
    found
}

/// A template at a place in its pixels from the middle, right and up, between its pixels' centres by straight lines.
fn sample(template: &[f64], right: f64, up: f64) -> f64 {
    let half = 0.5 * TEMPLATE as f64 - 0.5;
    let (x, y) = (half + right, half - up);
    if !(x >= 0.0 && y >= 0.0 && x < (TEMPLATE - 1) as f64 && y < (TEMPLATE - 1) as f64) {
        return 0.0;
    }
    let (column, row) = (x as usize, y as usize);
    let (s, t) = (x - column as f64, y - row as f64);
    let at = row * TEMPLATE + column;
    let top = template[at] + s * (template[at + 1] - template[at]);
    let bottom = template[at + TEMPLATE] + s * (template[at + TEMPLATE + 1] - template[at + TEMPLATE]);
    top + t * (bottom - top)
}
