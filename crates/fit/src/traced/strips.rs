//! An image, strip by strip between lines.

use super::canvas::{Canvas, Corner};
use super::lines::{Basis, Lines};
use super::pieces::{Bound, Rates, edges, left};
use super::sketch::Sketch;

/// Parts of a strip in which other edges begin to bound an image, or one ends: there edges have corners.
const PARTS: usize = 16;

/// A line with its corners.
#[derive(Clone)]
pub struct Strip {
    /// Where it begins and ends.
    pub bounds: [Bound; 2],
    /// Cosine and sine of its direction.
    pub ray: [f64; 2],
    /// Corners from the one to the other.
    pub corners: Vec<Corner>,
}

/// An image that is seen past those before it.
pub struct Painting<'a> {
    /// What corners are computed from.
    pub sketch: &'a Sketch<'a>,
    /// The image.
    pub image: &'a Lines,
    /// Those that hide it.
    pub before: &'a [Lines],
    /// How its edges move.
    pub rates: &'a Rates,
    /// Where rows lie, as shares of the way from one edge to the other.
    pub rows: &'a [f64],
}

/// All edges on a line, and what they leave.
#[derive(Clone)]
struct Cut {
    own: [Bound; 2],
    others: Vec<[Bound; 2]>,
    left: Vec<[Bound; 2]>,
}

impl Cut {
    fn new(own: [Bound; 2], others: Vec<[Bound; 2]>) -> Self {
        let left = left(own, others.clone());
        Self { own, others, left }
    }

    /// Between two lines.
    fn between(&self, other: &Self, share: f64) -> Self {
        let pair = |a: &[Bound; 2], b: &[Bound; 2]| [a[0].between(&b[0], share), a[1].between(&b[1], share)];
        let others = self.others.iter().zip(&other.others).map(|(a, b)| pair(a, b)).collect();
        Self::new(pair(&self.own, &other.own), others)
    }

    /// Which edges bound a stretch: its own, others, or none, where nothing is left.
    fn kind(&self, rank: usize) -> Option<[bool; 2]> {
        let [from, to] = self.left[rank];
        (to.rho > from.rho).then(|| [from.rho == self.own[0].rho, to.rho == self.own[1].rho])
    }
}

impl Painting<'_> {
    /// Draws it along so many lines.
    pub fn draw(&self, lines: usize, canvas: &mut Canvas) {
        let cut = |line: usize| {
            let others = self.before.iter().map(|other| edges(other, line, self.rates)).collect();
            Cut::new(edges(self.image, line, self.rates), others)
        };
        let cuts: Vec<Cut> = (0..lines).map(cut).collect();
        let bases: Vec<Basis> = self.rows.iter().map(|t| Basis::at(*t)).collect();
        for rank in 0..=self.before.len() {
            let mut last: Option<(usize, Strip)> = None;
            for line in 0..lines {
                let next = (line + 1) % lines;
                let kinds = [cuts[line].kind(rank), cuts[next].kind(rank)];
                if kinds == [None; 2] {
                    continue;
                }
                let from = match last.take() {
                    Some((at, strip)) if at == line => strip,
                    _ => self.strip(line, &cuts[line], rank, &bases),
                };
                let to = self.strip(next, &cuts[next], rank, &bases);
                if kinds[0] == kinds[1] {
                    self.fill(&from, &to, canvas);
                } else {
                    let mut before = from;
                    for part in 1..PARTS {
                        let share = part as f64 / PARTS as f64;
                        let cut = cuts[line].between(&cuts[next], share);
                        let strip = self.part([line, next], share, &cut, rank);
                        self.fill(&before, &strip, canvas);
                        before = strip;
                    }
                    self.fill(&before, &to, canvas);
                }
                last = Some((next, to));
            }
        }
    }

    fn fill(&self, from: &Strip, to: &Strip, canvas: &mut Canvas) {
        for (low, high) in from.corners.windows(2).zip(to.corners.windows(2)) {
            canvas.cell([&low[0], &low[1], &high[1], &high[0]]);
        }
        if self.sketch.derivatives {
            self.sketch.sweep(from, to, canvas);
        }
    }

    /// What is left of a line.
    fn strip(&self, line: usize, cut: &Cut, rank: usize, bases: &[Basis]) -> Strip {
        let (image, bounds) = (self.image, cut.left[rank]);
        let corners = if self.before.is_empty() {
            let both = bases.iter().zip(self.rows);
            both.map(|(basis, t)| self.sketch.corner(image, line, &image.along(line, *t, basis))).collect()
        } else {
            let [from, to] = bounds.map(|bound| image.find(line, bound.rho));
            let t = self.rows.iter().map(|row| from + (to - from) * row);
            t.map(|t| self.sketch.corner(image, line, &image.at(line, t))).collect()
        };
        let [cos, sin, ..] = image.rays[line];
        Strip { bounds, ray: [cos, sin], corners }
    }

    /// The same between two lines, all along straight ways from the one to the other.
    fn part(&self, lines: [usize; 2], share: f64, cut: &Cut, rank: usize) -> Strip {
        let (image, bounds) = (self.image, cut.left[rank]);
        let mix = |a: f64, b: f64| a + share * (b - a);
        let rho = |t: f64| mix(image.at(lines[0], t).rho, image.at(lines[1], t).rho);
        let [from, to] = bounds.map(|bound| {
            let (mut low, mut high) = (0.0, 1.0);
            if bound.rho <= cut.own[0].rho {
                return low;
            }
            if bound.rho >= cut.own[1].rho {
                return high;
            }
            for _ in 0..40 {
                let middle = 0.5 * (low + high);
                if rho(middle) < bound.rho { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        });
        let corners = self.rows.iter().map(|row| {
            let t = from + (to - from) * row;
            let [a, b] = lines.map(|line| self.sketch.corner(image, line, &image.at(line, t)));
            a.between(&b, share)
        });
        let rays = lines.map(|line| image.rays[line]);
        let [x, y] = [0, 1].map(|k| mix(rays[0][k], rays[1][k]));
        let length = x.hypot(y);
        Strip { bounds, ray: [x / length, y / length], corners: corners.collect() }
    }
}
