//! The rim of a region: its curve, moved to where light begins or ends abruptly.

use super::contour::{Region, Side, around};
use super::profile::{Edge, Field};
use super::{Curve, Picture};

/// The error of the place of a sharp edge at one point, pixels: what remains for oblique edges.
pub(super) const EDGE_ERROR: f64 = 0.03;
/// Distance between points.
const STEP: f64 = 0.75;
/// Points on either side over which the direction of a curve is found.
const STRETCH: usize = 3;
/// How far inside of the curve profiles across it begin, pixels.
const DEPTH: f64 = 6.0;
/// A sharp rim has an edge at this share of its points at least.
const SHARP: f64 = 0.8;

/// A closed curve, and what is known of the light on both its sides.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rim {
    /// At edges where there are, at the level elsewhere.
    pub curve: Curve,
    /// The share of its points that are at an edge.
    pub edges: f64,
    /// Levels inside and outside at each point; none where there is no edge.
    pub levels: Vec<Option<[f64; 2]>>,
}

impl Rim {
    /// The rim of a region. An edge counts if it is sharp, `accepts` its levels, and is no further than `furthest` from the level's curve.
    pub fn of(
        picture: &Picture,
        (level, side, region): (f64, Side, &Region),
        furthest: f64,
        accepts: impl Fn([f64; 2]) -> bool,
    ) -> Self {
        let field = Field::new(picture);
        let rough = around(picture, level, side, region).spaced(STEP);
        let edge = |point: &[f64; 2], normal: &[f64; 2]| -> Option<Edge> {
            let start = [0, 1].map(|k| point[k] - DEPTH * normal[k]);
            let angle = normal[1].atan2(normal[0]);
            field
                .edge(start, angle, DEPTH)
                .filter(|e| e.sharp && accepts(e.levels) && (e.radius - DEPTH).abs() < furthest)
        };
        let normals = rough.normals(STRETCH);
        let found: Vec<Option<Edge>> = rough.points.iter().zip(&normals).map(|(p, n)| edge(p, n)).collect();
        let count = found.iter().flatten().count();
        let moved = |((point, normal), edge): ((&[f64; 2], &[f64; 2]), &Option<Edge>)| {
            let by = edge.map_or(0.0, |e| e.radius - DEPTH);
            [0, 1].map(|k| point[k] + by * normal[k])
        };
        Self {
            curve: Curve { points: rough.points.iter().zip(&normals).zip(&found).map(moved).collect() },
            edges: count as f64 / found.len() as f64,
            levels: found.iter().map(|edge| edge.map(|e| e.levels)).collect(),
        }
    }

    /// Whether light begins or ends abruptly along it.
    pub fn is_sharp(&self) -> bool {
        self.edges >= SHARP
    }
}
