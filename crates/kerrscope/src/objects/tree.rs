//! A bounding volume hierarchy: a binary tree of boxes, so that a ray is compared with few of many objects.
//!
//! Its boxes are in double precision, for scenes from a fraction of M to thousands of M, and it is asked for what comes
//! near a chord with a margin, which is how a bent ray is followed. The crates for this order by straight rays in single
//! precision, or list every box that a shape of one's own touches in no order.

use super::bounds::Bounds;
use crate::spacetime::tensor::Vec3;

/// A tree over numbered boxes.
#[derive(Clone, Debug)]
pub struct Tree {
    nodes: Vec<Node>,
    /// Numbers of the boxes, those of a leaf side by side.
    order: Vec<u32>,
}

/// A branch, whose first child comes next, or a leaf.
#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Bounds,
    /// The second child of a branch, the first place in `order` of a leaf.
    start: u32,
    /// How many a leaf holds; 0 for a branch.
    count: u32,
}

/// A straight line from `origin` along `direction` (of any length) for parameters from 0 to `until`, and all that is
/// nearer to it than `margin` along the axes.
#[derive(Clone, Copy, Debug)]
pub struct Chord {
    /// Where it begins, M.
    pub origin: Vec3<f64>,
    /// Its direction.
    pub direction: Vec3<f64>,
    /// The largest parameter.
    pub until: f64,
    /// How far from it things count, M.
    pub margin: f64,
}

/// Below this depth branches are halved by number, so that the tree ends: 2^(64 − 40) is more than there can be objects.
const HALVED_BELOW: usize = 40;

/// The deepest that a tree can be.
const DEEPEST: usize = 64;

/// What looking into a box costs against comparing with an object.
const BOX_COST: f64 = 0.7;

/// The most objects in a leaf.
const LEAF: usize = 4;

impl Tree {
    /// A tree over boxes, numbered from 0; at most 2³² of them.
    pub fn new(all: &[Bounds]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..all.len() as u32).collect() };
        if !all.is_empty() {
            let mut order = std::mem::take(&mut tree.order);
            tree.grow(all, &mut order, 0, 0);
            tree.order = order;
        }
        tree
    }

    /// The box of everything.
    pub fn bounds(&self) -> Bounds {
        self.nodes.first().map_or(Bounds::EMPTY, |root| root.bounds)
    }

    /// Adds the node over the boxes of a slice, which begins at `start` of all.
    fn grow(&mut self, all: &[Bounds], some: &mut [u32], start: usize, depth: usize) {
        let bounds = some.iter().fold(Bounds::EMPTY, |sum, &k| sum.with(&all[k as usize]));
        let own = self.nodes.len();
        self.nodes.push(Node { bounds, start: start as u32, count: some.len() as u32 });
        let Some(share) = divide(all, some, &bounds, depth) else { return };
        let (left, right) = some.split_at_mut(share);
        self.grow(all, left, start, depth + 1);
        let second = self.nodes.len() as u32;
        self.grow(all, right, start + share, depth + 1);
        self.nodes[own] = Node { bounds, start: second, count: 0 };
    }

    /// Tells of the objects whose boxes come near a chord, about the nearest first. An answer shortens the chord.
    #[inline]
    pub fn visit(&self, chord: &Chord, mut meet: impl FnMut(usize, f64) -> Option<f64>) {
        if self.nodes.is_empty() {
            return;
        }
        let inverse = chord.direction.map(|c| {
            // A direction along the boxes' faces: dividing by zero would make NaN of a point on a face.
            let tiny = 1e-290_f64;
            (if c.abs() < tiny { tiny.copysign(c) } else { c }).recip()
        });
        // A box that is not met is infinitely far away, and farther than anything.
        let mut until = chord.until.min(f64::MAX);
        let mut stack = [(0_u32, 0.0_f64); DEEPEST];
        let mut height = 0;
        let (mut own, mut near) = (0_usize, enter(&self.nodes[0].bounds, chord, &inverse));
        loop {
            if near <= until {
                let node = &self.nodes[own];
                if node.count == 0 {
                    let (a, b) = (own + 1, node.start as usize);
                    let [to_a, to_b] = [a, b].map(|k| enter(&self.nodes[k].bounds, chord, &inverse));
                    let (first, second) =
                        if to_a <= to_b { ((a, to_a), (b, to_b)) } else { ((b, to_b), (a, to_a)) };
                    if second.1 <= until {
                        stack[height] = (second.0 as u32, second.1);
                        height += 1;
                    }
                    (own, near) = first;
                    continue;
                }
                let start = node.start as usize;
                for &k in &self.order[start..start + node.count as usize] {
                    if let Some(nearer) = meet(k as usize, until) {
                        until = nearer;
                    }
                }
            }
            if height == 0 {
                return;
            }
            height -= 1;
            (own, near) = (stack[height].0 as usize, stack[height].1);
        }
    }
}

/// The parameter at which a chord comes near a box, infinite if it does not.
#[inline]
fn enter(bounds: &Bounds, chord: &Chord, inverse: &Vec3<f64>) -> f64 {
    let (mut near, mut far) = (0.0, chord.until);
    for i in 0..3 {
        let a = (bounds.low[i] - chord.margin - chord.origin[i]) * inverse[i];
        let b = (bounds.high[i] + chord.margin - chord.origin[i]) * inverse[i];
        let (first, last) = if a < b { (a, b) } else { (b, a) };
        near = if first > near { first } else { near };
        far = if last < far { last } else { far };
    }
    if near <= far { near } else { f64::INFINITY }
}

/// Sorts boxes for two children and tells how many are the first's; none for a leaf. Along the axis in which their
/// middles are the farthest apart, where the surface area heuristic (MacDonald & Booth 1990) is least.
fn divide(all: &[Bounds], some: &mut [u32], whole: &Bounds, depth: usize) -> Option<usize> {
    let count = some.len();
    if count <= 1 {
        return None;
    }
    let middles = Bounds::of(some.iter().map(|&k| all[k as usize].middle()));
    let edges = middles.edges();
    let axis = (0..3).max_by(|&i, &j| edges[i].total_cmp(&edges[j])).unwrap_or(0);
    let at = |k: u32| all[k as usize].middle()[axis];
    // Numbers settle ties, so that the tree is the same everywhere.
    some.sort_unstable_by(|&a, &b| at(a).total_cmp(&at(b)).then(a.cmp(&b)));
    if depth >= HALVED_BELOW {
        return (count > LEAF).then_some(count / 2);
    }
    let mut above = vec![0.0; count];
    let mut sum = Bounds::EMPTY;
    for i in (1..count).rev() {
        sum = sum.with(&all[some[i] as usize]);
        above[i] = sum.half_area();
    }
    let mut sum = Bounds::EMPTY;
    let (mut best, mut least) = (count / 2, f64::INFINITY);
    for i in 1..count {
        sum = sum.with(&all[some[i - 1] as usize]);
        let cost = sum.half_area() * i as f64 + above[i] * (count - i) as f64;
        if cost < least {
            (best, least) = (i, cost);
        }
    }
    let area = whole.half_area();
    let worthwhile = 2.0 * BOX_COST * area + least < count as f64 * area;
    (count > LEAF || worthwhile).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::mix;

    fn number(k: u64) -> f64 {
        (mix(k) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn boxes(count: u64) -> Vec<Bounds> {
        let at = |k: u64| -> Vec3<f64> { std::array::from_fn(|i| 10.0 * number(7 * k + i as u64)) };
        (0..count)
            .map(|k| {
                let (low, size) = (at(k), 0.2 * number(7 * k + 5));
                Bounds { low, high: low.map(|c| c + size) }
            })
            .collect()
    }

    #[test]
    fn nothing_near_a_chord_is_left_out() {
        let all = boxes(2000);
        let tree = Tree::new(&all);
        for k in 0..200 {
            let [origin, end]: [Vec3<f64>; 2] = std::array::from_fn(|j| {
                std::array::from_fn(|i| 14.0 * number(99_991 * (k + 1) + (3 * j + i) as u64) - 2.0)
            });
            let direction: Vec3<f64> = std::array::from_fn(|i| end[i] - origin[i]);
            let chord = Chord { origin, direction, until: 1.0, margin: if k % 2 == 0 { 0.0 } else { 0.1 } };
            let inverse = direction.map(f64::recip);
            let mut expected: Vec<usize> =
                (0..all.len()).filter(|&b| enter(&all[b], &chord, &inverse).is_finite()).collect();
            let mut found = Vec::new();
            tree.visit(&chord, |b, _| {
                if enter(&all[b], &chord, &inverse).is_finite() {
                    found.push(b);
                }
                None
            });
            found.sort_unstable();
            expected.sort_unstable();
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn boxes_far_from_a_line_without_end_are_not_looked_at() {
        let all = boxes(2000);
        let tree = Tree::new(&all);
        let mut seen = 0;
        for k in 0..100 {
            let origin = [number(k) * 10.0, number(k + 100) * 10.0, -1.0];
            let chord = Chord { origin, direction: [0.0, 0.0, 1.0], until: f64::INFINITY, margin: 0.0 };
            tree.visit(&chord, |_, _| {
                seen += 1;
                None
            });
        }
        // A line meets about 2000 · (0.1 + 0.1)²/10² of boxes 0.1 large, and looks at some more.
        assert!(seen < 100 * 20, "{seen}");
    }

    #[test]
    fn many_boxes_at_one_place_make_a_tree_too() {
        let all = vec![Bounds { low: [0.0; 3], high: [1.0; 3] }; 5000];
        let mut seen = 0;
        let chord = Chord { origin: [0.5, 0.5, -1.0], direction: [0.0, 0.0, 1.0], until: 9.0, margin: 0.0 };
        Tree::new(&all).visit(&chord, |_, _| {
            seen += 1;
            None
        });
        assert_eq!(seen, 5000);
        Tree::new(&[]).visit(&chord, |_, _| panic!("there is nothing"));
    }
}
