//! An image, strip by strip between lines.

use super::canvas::{Canvas, Corner};
use super::lines::{Basis, Lines};
use super::order::ORDERS;
use super::pieces::{Bound, Rates, edges, left};
use super::sketch::Sketch;

/// Straight pieces of an edge between two lines: its bend between lines is that of a cubic through four of them.
const PIECES: usize = 4;

/// Of how many such pieces the cells of an image are made, by its order. What is straight between 320 lines lies some 1e-3 pixels beside
/// the curve, which counts where all of an image is thinner than a pixel.
const COARSE: [usize; ORDERS] = [4, 2, 1, 1];

/// Bisections between two lines between which other edges begin to bound an image, or one ends: there edges have corners.
const SEARCH: usize = 20;

/// Changes of edges within a piece, at most.
const CHANGES: usize = 4;

/// A line with its corners.
#[derive(Clone)]
pub struct Strip {
    /// Where it begins and ends.
    pub bounds: [Bound; 2],
    /// Cosine and sine of its direction.
    pub ray: [f64; 2],
    /// Corners from the one to the other, both ends at least.
    pub corners: Vec<Corner>,
}

impl Strip {
    /// Corners at both ends.
    pub fn ends(&self) -> [&Corner; 2] {
        [&self.corners[0], &self.corners[self.corners.len() - 1]]
    }

    /// Some of four; both ends alone, or all corners.
    fn between(four: [&Self; 4], shares: [f64; 4], ends: bool) -> Self {
        let corner = |k: usize| Corner::mixed(four.map(|strip| &strip.corners[k]), shares);
        let count = four[1].corners.len();
        let corners =
            if ends { vec![corner(0), corner(count - 1)] } else { (0..count).map(corner).collect() };
        let ray = mixed(four.map(|strip| strip.ray), shares);
        let bounds = [0, 1].map(|k| Bound::mixed(four.map(|strip| &strip.bounds[k]), shares));
        Self { bounds, ray, corners }
    }
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

    /// Some of four.
    fn mixed(four: [&Self; 4], shares: [f64; 4]) -> Self {
        let mix = |pick: &dyn Fn(&Self) -> [Bound; 2]| {
            let pairs = four.map(pick);
            [0, 1].map(|side| Bound::mixed(std::array::from_fn(|k| &pairs[k][side]), shares))
        };
        let others = (0..four[0].others.len()).map(|k| mix(&|cut| cut.others[k]));
        Self::new(mix(&|cut| cut.own), others.collect())
    }

    /// Which edges bound a stretch, its own before those of others, or none, where nothing is left.
    fn kind(&self, rank: usize) -> Option<[usize; 2]> {
        let [from, to] = self.left[rank];
        let which = |bound: Bound| {
            let all = std::iter::once(&self.own).chain(&self.others).flatten();
            all.enumerate().find(|(_, edge)| edge.rho == bound.rho).map_or(0, |(k, _)| k)
        };
        (to.rho > from.rho).then(|| [from, to].map(which))
    }
}

/// Shares of four values at equal steps between the second and the third: Lagrange's cubic.
fn cubic(s: f64) -> [f64; 4] {
    [
        -s * (s - 1.0) * (s - 2.0) / 6.0,
        (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
        -(s + 1.0) * s * (s - 2.0) / 2.0,
        (s + 1.0) * s * (s - 1.0) / 6.0,
    ]
}

/// Places between 0 and 1 at which the pieces of an edge meet, and both sides of those at which another edge takes its place.
fn places<K: PartialEq>(kind: impl Fn(f64) -> K) -> Vec<f64> {
    let mut places = vec![0.0];
    for piece in 1..=PIECES {
        let end = piece as f64 / PIECES as f64;
        let last = kind(end);
        let mut from = places[places.len() - 1];
        // A thin image may lose one of its edges and vanish within a piece.
        for _ in 0..CHANGES {
            let first = kind(from);
            if first == last {
                break;
            }
            let [mut low, mut high] = [from, end];
            for _ in 0..SEARCH {
                let middle = 0.5 * (low + high);
                *(if kind(middle) == first { &mut low } else { &mut high }) = middle;
            }
            places.extend([low, high]);
            from = high;
        }
        places.push(end);
    }
    places[1..places.len() - 1].to_vec()
}

/// Where a function that rises from one value at 0 to another at 1 is 0, by false positions with the end that stays at half its value
/// (the Illinois method).
fn root([mut below, mut above]: [f64; 2], at: impl Fn(f64) -> f64) -> f64 {
    let [mut low, mut high] = [0.0, 1.0];
    let close = 1e-13 * (above - below);
    let mut stayed = 0;
    for _ in 0..60 {
        let t = (low * above - high * below) / (above - below);
        let value = at(t);
        if value.abs() < close {
            return t;
        }
        if value < 0.0 {
            (low, below) = (t, value);
            above *= if stayed == 1 { 0.5 } else { 1.0 };
            stayed = 1;
        } else {
            (high, above) = (t, value);
            below *= if stayed == -1 { 0.5 } else { 1.0 };
            stayed = -1;
        }
    }
    0.5 * (low + high)
}

/// Some of four directions.
fn mixed(rays: [[f64; 2]; 4], shares: [f64; 4]) -> [f64; 2] {
    [0, 1].map(|k| rays.iter().zip(shares).map(|(ray, share)| share * ray[k]).sum())
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
            let kinds: Vec<_> = cuts.iter().map(|cut| cut.kind(rank)).collect();
            let mut strips: Vec<Option<Strip>> = vec![None; lines];
            for line in 0..lines {
                let four = [lines - 1, 0, 1, 2].map(|k| (line + k) % lines);
                let [_, from, to, _] = four;
                if [kinds[from], kinds[to]] == [None; 2] {
                    continue;
                }
                let smooth = four.iter().all(|line| kinds[*line] == kinds[from]);
                for at in if smooth { &four[..] } else { &four[1..3] } {
                    if strips[*at].is_none() {
                        strips[*at] = Some(self.strip(*at, &cuts[*at], rank, &bases));
                    }
                }
                let strip = |line: usize| strips[line].as_ref().expect("made above");
                if smooth {
                    self.bend(four.map(strip), canvas);
                } else {
                    let cut = |s: f64| Cut::mixed(four.map(|line| &cuts[line]), cubic(s));
                    let places = places(|s| cut(s).kind(rank));
                    let between = |s: f64| self.part(four, cubic(s), &cut(s), rank);
                    let parts: Vec<Strip> = places.into_iter().map(between).collect();
                    let all: Vec<&Strip> =
                        std::iter::once(strip(from)).chain(&parts).chain([strip(to)]).collect();
                    for pair in all.windows(2) {
                        self.fill(pair, canvas);
                    }
                }
                strips[four[0]] = None;
            }
        }
    }

    /// Fills what lies between the second and the third of four strips that are bounded alike.
    fn bend(&self, four: [&Strip; 4], canvas: &mut Canvas) {
        let coarse = COARSE[self.image.order];
        let parts: Vec<Strip> = (1..PIECES)
            .map(|k| Strip::between(four, cubic(k as f64 / PIECES as f64), k % coarse > 0))
            .collect();
        let all: Vec<&Strip> = std::iter::once(four[1]).chain(&parts).chain([four[2]]).collect();
        for first in (0..PIECES).step_by(coarse) {
            self.fill(&all[first..=first + coarse], canvas);
        }
    }

    /// Fills what lies between the first and the last of some strips; of those between them only the ends count.
    fn fill(&self, strips: &[&Strip], canvas: &mut Canvas) {
        let (from, to) = (strips[0], strips[strips.len() - 1]);
        let between = &strips[1..strips.len() - 1];
        let side = |k: usize| between.iter().map(move |strip| strip.ends()[k].place);
        let last = from.corners.len() - 2;
        for (k, (low, high)) in from.corners.windows(2).zip(to.corners.windows(2)).enumerate() {
            let corners = [&low[0], &low[1], &high[1], &high[0]];
            let (inner, outer) = (k == 0, k == last);
            if between.is_empty() || !(inner || outer) {
                canvas.cell(corners, std::iter::empty(), std::iter::empty());
            } else {
                let count = between.len();
                canvas.cell(
                    corners,
                    side(1).take(if outer { count } else { 0 }),
                    side(0).rev().take(if inner { count } else { 0 }),
                );
            }
        }
        if self.sketch.derivatives {
            for pair in strips.windows(2) {
                self.sketch.sweep(pair[0], pair[1], canvas);
            }
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

    /// The same between the second and the third of four lines.
    fn part(&self, lines: [usize; 4], shares: [f64; 4], cut: &Cut, rank: usize) -> Strip {
        let (image, bounds) = (self.image, cut.left[rank]);
        let points = |t: f64| lines.map(|line| image.at(line, t));
        let rho = |t: f64| points(t).iter().zip(shares).map(|(point, share)| share * point.rho).sum::<f64>();
        let [from, to] = bounds.map(|bound| {
            let ends = [cut.own[0].rho - bound.rho, cut.own[1].rho - bound.rho];
            if ends[0] >= 0.0 {
                return 0.0;
            }
            if ends[1] <= 0.0 {
                return 1.0;
            }
            root(ends, |t| rho(t) - bound.rho)
        });
        let corners = self.rows.iter().map(|row| {
            let points = points(from + (to - from) * row);
            let corners: [Corner; 4] =
                std::array::from_fn(|k| self.sketch.corner(image, lines[k], &points[k]));
            Corner::mixed(corners.each_ref(), shares)
        });
        let ray = mixed(lines.map(|line| [image.rays[line][0], image.rays[line][1]]), shares);
        Strip { bounds, ray, corners: corners.collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots() {
        for power in [0.3, 1.0, 7.0] {
            let at = |t: f64| t.powf(power) - 0.2;
            assert!((root([-0.2, 0.8], at) - 0.2_f64.powf(1.0 / power)).abs() < 1e-12);
        }
    }

    /// Where one edge takes another's place twice within a piece, and pieces.
    #[test]
    fn edges_change() {
        let kind = |s: f64| {
            if s < 0.3 {
                0
            } else if s < 0.4 {
                1
            } else {
                2
            }
        };
        let found = places(kind);
        let expected = [0.25, 0.3, 0.3, 0.4, 0.4, 0.5, 0.75];
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(expected).all(|(s, other)| (s - other).abs() < 1e-6), "{found:?}");
        assert_eq!(places(|_| 0), [0.25, 0.5, 0.75]);
    }

    /// A cubic is followed exactly.
    #[test]
    fn cubics() {
        let at = |s: f64| 1.0 + s * (2.0 - s * (0.5 - 0.3 * s));
        for s in [0.0, 0.1, 0.7, 1.0] {
            let found: f64 = cubic(s).iter().zip([-1.0, 0.0, 1.0, 2.0]).map(|(share, s)| share * at(s)).sum();
            assert!((found - at(s)).abs() < 1e-14);
        }
    }
}
