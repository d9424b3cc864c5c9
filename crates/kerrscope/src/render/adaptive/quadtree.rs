//! Where rays are traced: a square is cut in four until rays vary smoothly over it.

use super::knot::{Kind, difference};
use super::mesh::{Mesh, Point};
use super::patch::{Evaluate, Patch};
use crate::render::stage::{Replay, Stage};
use crate::render::tally::{Tally, worse};

/// A square of a mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    /// Its corner.
    pub(super) corner: Point,
    /// Spacings along its edge.
    pub(super) edge: u32,
}

/// A square in whose quarters rays of one kind can be interpolated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Smooth {
    pub(super) cell: Cell,
    pub(super) kind: Kind,
}

/// Squares over which rays vary smoothly, and the others, which are as small as can be.
#[derive(Debug, Default)]
pub(super) struct Quadtree {
    pub(super) smooth: Vec<Smooth>,
    pub(super) rough: Vec<Cell>,
}

/// Knots along the edge of a square whose quarters have [`KNOTS`](super::patch::KNOTS).
const FINE: u32 = 9;
/// Spacings along the edge of the smallest squares, so that [`FINE`] knots stand on points of the mesh.
pub(super) const LEAST: u32 = FINE - 1;

/// An interpolant of order 4 over a quarter of a square errs by about 1/32 of one over the whole of it,
/// whose error is measured. With this share of that gain spent, the worst of 10,000 samples stays below
/// the error asked for from 10⁻³ to 10⁻⁸.
const GAIN: f64 = 4.0;

impl Cell {
    /// So many points by so many, evenly spaced from edge to edge.
    pub(super) fn points(self, count: u32) -> impl Iterator<Item = Point> {
        let step = self.edge / (count - 1);
        let [left, top] = self.corner;
        (0..count).flat_map(move |i| (0..count).map(move |j| [left + j * step, top + i * step]))
    }

    pub(super) fn quarters(self) -> [Self; 4] {
        let edge = self.edge / 2;
        let [left, top] = self.corner;
        [[0, 0], [1, 0], [0, 1], [1, 1]]
            .map(|[i, j]| Self { corner: [left + i * edge, top + j * edge], edge })
    }
}

impl Quadtree {
    /// Cuts up a square. Only what lies within `limits` (spacings to the right and down) counts. `target` is the error that interpolation
    /// shall not exceed.
    pub(super) fn grow(
        mesh: &mut Mesh,
        root: Cell,
        limits: [u32; 2],
        target: f64,
        stage: &Stage,
        replay: &mut Replay,
        tally: &mut Tally,
    ) -> Self {
        let mut tree = Self::default();
        let mut judge = Judge::new(stage);
        let mut cells = vec![root];
        while !cells.is_empty() {
            let coarse = cells.iter().flat_map(|cell| cell.points(FINE / 2 + 1));
            mesh.trace(stage, coarse, replay, tally);
            let (alike, mixed): (Vec<_>, Vec<_>) =
                cells.into_iter().partition(|cell| mesh.common_kind(cell.points(FINE / 2 + 1)).is_some());
            mesh.trace(stage, alike.iter().flat_map(|cell| cell.points(FINE)), replay, tally);
            let mut next = Vec::new();
            let mut cut = |cell: Cell| {
                if cell.edge == LEAST {
                    tree.rough.push(cell);
                } else {
                    let within = |quarter: &Cell| quarter.corner.iter().zip(limits).all(|(c, l)| *c < l);
                    next.extend(cell.quarters().into_iter().filter(within));
                }
            };
            for cell in mixed {
                cut(cell);
            }
            for cell in alike {
                match mesh.common_kind(cell.points(FINE)) {
                    Some(kind) if judge.error(mesh, cell, kind) <= GAIN * target => {
                        tree.smooth.push(Smooth { cell, kind });
                    }
                    _ => cut(cell),
                }
            }
            cells = next;
        }
        tree
    }
}

/// Measures what an interpolant errs by at the knots that it does not use.
struct Judge<'a> {
    stage: &'a Stage,
    /// The points of [`FINE`] × [`FINE`] that are not among half as many, in steps from the corner, and on −1 … 1.
    points: Vec<Point>,
    x: Vec<f64>,
    y: Vec<f64>,
    patches: Vec<Patch>,
    values: Vec<f64>,
    found: Vec<f64>,
}

impl<'a> Judge<'a> {
    fn new(stage: &'a Stage) -> Self {
        let all = (0..FINE).flat_map(|i| (0..FINE).map(move |j| [j, i]));
        let points: Vec<Point> = all.filter(|[j, i]| (i | j) % 2 == 1).collect();
        let along = |axis: usize| points.iter().map(|p| f64::from(p[axis]) / 4.0 - 1.0).collect();
        let (x, y) = (along(0), along(1));
        Self { stage, points, x, y, patches: Vec::new(), values: Vec::new(), found: Vec::new() }
    }

    /// The largest error.
    fn error(&mut self, mesh: &Mesh, cell: Cell, kind: Kind) -> f64 {
        let (numbers, [left, top]) = (kind.numbers(), cell.corner);
        self.patches.clear();
        self.patches.extend((0..numbers).map(|n| mesh.patch(cell.corner, cell.edge / 4, n)));
        let Self { patches, x, y, values, .. } = self;
        Evaluate { patches, x, y, values }.at_level(self.stage.level());
        let (count, step) = (self.points.len(), cell.edge / (FINE - 1));
        let mut worst = 0.0;
        for (point, [j, i]) in self.points.iter().enumerate() {
            self.found.clear();
            self.found.extend((0..numbers).map(|n| self.values[n * count + point]));
            let knot = mesh.knot([left + j * step, top + i * step]);
            let error = difference(kind, mesh.knots.numbers(knot), &self.found);
            worst = worse(worst, error);
        }
        worst
    }
}
