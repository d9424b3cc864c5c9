//! The outer edge of a disk, and the lengths that Kamminga's thesis reads off it.
//!
//! "Imaging a Kerr Black Hole" (2022), chapter 5 and figure 5.1: r− and r+ run from the centre of the shadow to the disk's edge on the left and
//! on the right, h to its lower edge. Left, right and below are the picture's: the projected axis of spin is up.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use serde::Serialize;

use super::profile::{Edge, Field};
use super::shadow::{DIRECTIONS, EDGE_ERROR, Levels};
use super::{Measured, Outline, Picture, Shadow};

/// What part of the light's level a ray from outside must meet to be at the disk.
const FAINT: f64 = 0.02;

/// The outer edge of a disk, from the shadow's centre. Lengths are in pixels.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DiskEdge {
    /// r+: from the shadow's centre to the edge on the right.
    pub right: Measured,
    /// r−: to the edge on the left.
    pub left: Measured,
    /// h: to the lower edge.
    pub below: Measured,
    /// To the upper edge.
    pub above: Measured,
    /// r−/(r− + r+), 0.5 for a hole without spin.
    pub left_share: Measured,
    /// h/r+.
    pub below_over_right: Measured,
    /// Angle of the major axis of the area within, degrees anticlockwise from the right, in (−90, 90].
    pub major_axis: f64,
    /// Lengths of the axes of the ellipse with the same second moments: major, minor.
    pub axes: [f64; 2],
    /// The shadow's centre less that of the area within the edge, right and up.
    pub displacement: [Measured; 2],
    /// The edge.
    #[serde(skip)]
    pub outline: Outline,
}

impl DiskEdge {
    pub(super) fn of(picture: &Picture, levels: Levels, shadow: &Shadow) -> Result<Self, String> {
        let field = Field::new(picture);
        let centre = shadow.centre.map(|c| c.value);
        let edges: Vec<Option<Edge>> = (0..DIRECTIONS)
            .map(|k| outermost(&field, centre, TAU * k as f64 / DIRECTIONS as f64, levels))
            .collect();
        let missing = edges.iter().filter(|edge| edge.is_none()).count();
        if missing > 0 {
            return Err(format!(
                "the light has no abrupt outer edge within the picture in {missing} of {DIRECTIONS} directions from the shadow's centre"
            ));
        }
        let radii: Vec<f64> = edges.iter().flatten().map(|edge| edge.radius).collect();
        let outline = Outline { centre, radii };
        let mean = outline.mean_radius().0;
        if outline.largest_jump() > (0.2 * mean).max(3.0) {
            return Err("the outer edge of the light is no smooth curve".to_owned());
        }
        if !edges.iter().flatten().zip(&shadow.outline.radii).all(|(edge, inner)| edge.radius > inner + 2.0) {
            return Err("the light around the shadow is narrower than two pixels".to_owned());
        }
        let error = EDGE_ERROR.max(outline.scatter());
        let at = |angle: f64, k: usize| {
            let place = shadow.centre[k].error;
            outermost(&field, centre, angle, levels)
                .map_or(Err("an edge on an axis is missing".to_owned()), |edge| {
                    Ok(Measured::new(edge.radius, error.hypot(place)))
                })
        };
        let (right, left) = (at(0.0, 0)?, at(PI, 0)?);
        let (above, below) = (at(FRAC_PI_2, 1)?, at(-FRAC_PI_2, 1)?);
        let sum = left.plus(right);
        // The centre's error moves both.
        let left_share =
            Measured::new(left.value / sum.value, left.error.hypot(shadow.centre[0].error) / sum.value);
        let centroid = outline.centroid();
        let (axes, major_axis) = ellipse(&outline, centroid);
        let place =
            [0, 1].map(|k| Measured::new(centre[k] - centroid[k], shadow.centre[k].error.hypot(0.1 * error)));
        Ok(Self {
            right,
            left,
            below,
            above,
            left_share,
            below_over_right: below.over(right),
            major_axis,
            axes,
            displacement: place,
            outline,
        })
    }
}

/// The edge that a ray meets first from outside.
fn outermost(field: &Field<'_>, centre: [f64; 2], angle: f64, levels: Levels) -> Option<Edge> {
    let level = levels.at(FAINT);
    let mut radius = field.reach(centre, angle) - 1.0;
    while radius > 0.0 && field.on_ray(centre, angle, radius) <= level {
        radius -= 0.25;
    }
    // The faint level is met before the middle of the edge.
    let edge = field.edge(centre, angle, radius - 0.5)?;
    let edge = field.edge(centre, angle, edge.radius)?;
    (edge.sharp && edge.levels[1] < 0.5 * edge.levels[0] && (edge.radius - radius).abs() < 2.5)
        .then_some(edge)
}

/// Axes and angle in degrees of the ellipse with the second moments of the area within an outline: ∫ r⁴ cos² θ dθ/4 and so on.
fn ellipse(outline: &Outline, centroid: [f64; 2]) -> ([f64; 2], f64) {
    let step = TAU / outline.radii.len() as f64;
    let mut moments = [0.0; 3];
    for (k, r) in outline.radii.iter().enumerate() {
        let (sin, cos) = (k as f64 * step).sin_cos();
        for (moment, part) in moments.iter_mut().zip([cos * cos, sin * sin, sin * cos]) {
            *moment += 0.25 * r.powi(4) * part * step;
        }
    }
    let area = outline.area();
    let [x, y] = [0, 1].map(|k| centroid[k] - outline.centre[k]);
    let [xx, yy, xy] = [moments[0] / area - x * x, moments[1] / area - y * y, moments[2] / area - x * y];
    let (mean, half) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
    // A full ellipse with half axis A has the variance A²/4 along it.
    let axes = [mean + half, mean - half].map(|variance| 4.0 * variance.max(0.0).sqrt());
    (axes, (0.5 * (2.0 * xy).atan2(xx - yy)).to_degrees())
}
