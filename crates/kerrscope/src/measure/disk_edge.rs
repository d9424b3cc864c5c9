//! The outer edge of a disk, and the lengths that Kamminga's thesis reads off it.
//!
//! "Imaging a Kerr Black Hole" (2022), chapter 5 and figure 5.1: r− and r+ run from the centre of the shadow to the disk's edge on the left and
//! on the right, h to its lower edge. Left, right and below are the picture's: the projected axis of spin is up.
//!
//! The edge is the outer curve around the light in which the shadow is, of any shape: a disk seen nearly from its side has wings, and a
//! direction from the shadow's centre may leave it, meet it again and leave it. Lengths are to where it is left for the last time.

use std::f64::consts::{FRAC_PI_2, PI};

use serde::Serialize;

use super::contour::{Region, Side, around, regions};
use super::profile::Field;
use super::rim::{EDGE_ERROR, Rim};
use super::shadow::Levels;
use super::{Curve, Measured, Picture, Shadow};

/// What part of the light's level is at the disk.
const FAINT: f64 = 0.02;
/// The faintest level above the sky, in standard deviations of the noise.
const ABOVE_SKY: f64 = 5.0;

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
    /// How far it reaches to the right of the centre, at any height.
    pub far_right: Measured,
    /// To the left.
    pub far_left: Measured,
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
    /// Whether light ends abruptly along it; if not, the edge is where the light is down to a fiftieth, and depends on that.
    pub sharp: bool,
    /// The edge.
    #[serde(skip)]
    pub outline: Curve,
}

impl DiskEdge {
    pub(super) fn of(picture: &Picture, levels: Levels, shadow: &Shadow) -> Result<Self, String> {
        let centre = shadow.centre.map(|c| c.value);
        let level = levels.at(FAINT.max(ABOVE_SKY * levels.noise / (levels.light - levels.sky)));
        let region = lit_around(picture, level, shadow)
            .ok_or_else(|| "the light around the shadow is no single region".to_owned())?;
        if region.open {
            return Err("the light around the shadow reaches the picture's border".to_owned());
        }
        let rim = Rim::of(picture, (level, Side::Light, &region), 2.5, |[disk, sky]| sky < 0.5 * disk);
        let sharp = rim.is_sharp();
        let outline =
            if sharp { rim.curve } else { around(picture, level, Side::Light, &region).spaced(0.75) };
        // A gradual edge is known as well as its outline stays when the level is doubled.
        let vague = if sharp { 0.0 } else { moved(picture, levels, level, shadow, &outline)? };
        if narrowest(&outline, &shadow.outline) < 2.0 {
            return Err("the light around the shadow is narrower than two pixels".to_owned());
        }
        let error = EDGE_ERROR.max(outline.scatter()).max(vague);
        let field = Field::new(picture);
        let at = |angle: f64, k: usize| {
            let reach = outline.reach(centre, angle).ok_or("an edge on an axis is missing")?;
            // Where an axis meets the edge at an angle, along it the place is the better one.
            let edge = field
                .edge(centre, angle, reach)
                .filter(|e| sharp && e.sharp && (e.radius - reach).abs() < 0.5);
            let radius = edge.map_or(reach, |e| e.radius);
            Ok::<_, String>(Measured::new(radius, error.hypot(shadow.centre[k].error)))
        };
        let (right, left) = (at(0.0, 0)?, at(PI, 0)?);
        let (above, below) = (at(FRAC_PI_2, 1)?, at(-FRAC_PI_2, 1)?);
        let far = |sign: f64| {
            let reach = outline.points.iter().map(|p| sign * (p[0] - centre[0])).fold(0.0, f64::max);
            Measured::new(reach, error.hypot(shadow.centre[0].error))
        };
        let (far_right, far_left) = (far(1.0), far(-1.0));
        let sum = left.plus(right);
        // The centre's error moves both.
        let left_share =
            Measured::new(left.value / sum.value, left.error.hypot(shadow.centre[0].error) / sum.value);
        let centroid = outline.centroid();
        let (axes, major_axis) = ellipse(&outline);
        let place =
            [0, 1].map(|k| Measured::new(centre[k] - centroid[k], shadow.centre[k].error.hypot(0.1 * error)));
        Ok(Self {
            right,
            left,
            below,
            above,
            far_right,
            far_left,
            left_share,
            below_over_right: below.over(right),
            major_axis,
            axes,
            displacement: place,
            sharp,
            outline,
        })
    }
}

/// The region of light in which a shadow is.
fn lit_around(picture: &Picture, level: f64, shadow: &Shadow) -> Option<Region> {
    let mut lit = regions(picture, level, Side::Light);
    lit.sort_by_key(|region| std::cmp::Reverse(region.pixels));
    let centre = shadow.centre.map(|c| c.value);
    let about = |region: &&Region| around(picture, level, Side::Light, region).encloses(centre);
    lit.iter().take(8).find(about).copied()
}

/// How far the outline moves in the mean when the level is doubled; refused if it moves by more than a twentieth of its mean radius.
fn moved(
    picture: &Picture,
    levels: Levels,
    level: f64,
    shadow: &Shadow,
    outline: &Curve,
) -> Result<f64, String> {
    let centre = outline.centroid();
    let radius = outline.mean_radius(centre).0;
    let doubled = 2.0 * level - levels.sky;
    let by = lit_around(picture, doubled, shadow)
        .map(|region| (radius - around(picture, doubled, Side::Light, &region).mean_radius(centre).0).abs())
        .ok_or("the light around the shadow is no single region")?;
    if by > 0.05 * radius {
        return Err(format!(
            "the light has no outer edge: where it is down to a fiftieth and to a twenty-fifth are {by:.1} pixels apart"
        ));
    }
    Ok(by)
}

/// The least distance between the points of two curves.
fn narrowest(one: &Curve, other: &Curve) -> f64 {
    let distance = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let least = |a| other.points.iter().map(|b| distance(a, b)).fold(f64::INFINITY, f64::min);
    one.points.iter().map(least).fold(f64::INFINITY, f64::min)
}

/// Axes and angle in degrees of the ellipse with the second moments of the area within an outline.
fn ellipse(outline: &Curve) -> ([f64; 2], f64) {
    let [xx, yy, xy] = outline.second_moments();
    let (mean, half) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
    // A full ellipse with half axis A has the variance A²/4 along it.
    let axes = [mean + half, mean - half].map(|variance| 4.0 * variance.max(0.0).sqrt());
    (axes, (0.5 * (2.0 * xy).atan2(xx - yy)).to_degrees())
}
