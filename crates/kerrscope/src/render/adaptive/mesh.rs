//! The traced rays of a tile, at points of a square grid.

use super::knot::{Kind, Knots};
use super::patch::{KNOTS, Patch};
use crate::render::stage::{Replay, Stage};
use crate::render::tally::Tally;

/// A point of a mesh: spacings to the right and down from its corner.
pub(super) type Point = [u32; 2];

/// Points at which rays may be traced, and those that are.
pub(super) struct Mesh {
    /// The corner in the picture, in pixels.
    corner: [f64; 2],
    /// Pixels between neighbours.
    spacing: f64,
    /// Points along an edge.
    edge: u32,
    /// The number of each point's ray among the knots, along the rows; [`NONE`] if it is not traced.
    traced: Vec<u32>,
    pub(super) knots: Knots,
}

const NONE: u32 = u32::MAX;

impl Mesh {
    /// A mesh from a corner on, with so many points along an edge.
    pub(super) fn new(corner: [u32; 2], spacing: f64, edge: u32) -> Self {
        let traced = vec![NONE; (edge * edge) as usize];
        Self { corner: corner.map(f64::from), spacing, edge, traced, knots: Knots::default() }
    }

    /// Traces the rays at points where none is traced yet.
    pub(super) fn trace(
        &mut self,
        stage: &Stage,
        points: impl Iterator<Item = Point>,
        replay: &mut Replay,
        tally: &mut Tally,
    ) {
        let mut new = Vec::new();
        for [x, y] in points {
            let traced = &mut self.traced[(y * self.edge + x) as usize];
            if *traced == NONE {
                *traced = (self.knots.count() + new.len()) as u32;
                let place = |corner: f64, steps: u32| corner + self.spacing * f64::from(steps);
                new.push([place(self.corner[0], x), place(self.corner[1], y)]);
            }
        }
        let (knots, plane) = (&mut self.knots, stage.plane());
        stage.trace(&new, replay, tally, |path| knots.push(path, &plane));
    }

    /// The ray at a point, which must have been traced.
    pub(super) fn knot(&self, [x, y]: Point) -> u32 {
        self.traced[(y * self.edge + x) as usize]
    }

    /// The kind of all rays at points, if they are of one that can be interpolated.
    pub(super) fn common_kind(&self, points: impl Iterator<Item = Point>) -> Option<Kind> {
        let mut kinds = points.map(|point| self.knots.kind(self.knot(point)));
        let first = kinds.next()?;
        (first != Kind::Unknown && kinds.all(|kind| kind == first)).then_some(first)
    }

    /// Interpolates one of the numbers of rays of a kind over a square, `step` being a quarter of its edge.
    pub(super) fn patch(&self, [left, top]: Point, step: u32, number: usize) -> Patch {
        let mut values = [[0.0; KNOTS]; KNOTS];
        for (i, row) in (0..).zip(&mut values) {
            for (j, value) in (0..).zip(row) {
                *value = self.knots.numbers(self.knot([left + j * step, top + i * step]))[number];
            }
        }
        Patch::through(values)
    }
}
