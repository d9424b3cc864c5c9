//! From spherical-like coordinates to Cartesian-like ones, formula by formula.
//!
//! x = r (sin θ cos φ, sin θ sin φ, cos θ). With n = x/r, ϖ² = x² + y² and a = (−y, x, 0):
//!   dr = n·dx,   dθ = (xz, yz, −ϖ²)·dx/(r³ sin θ),   dφ = a·dx/(r² sin² θ).
//! Angular parts are put together so that what is regular on the axis stays so:
//!   G_θθ dθ² + G_φφ dφ² = (G_θθ/r²)(dx² − (n·dx)²) + [(G_φφ/sin²θ − G_θθ)/(r² ϖ²)](a·dx)².
//! Powers of sin θ are divided out of the formulas themselves, and sin θ = ϖ/r, cos θ = z/r: of a metric with
//! spherical symmetry nothing singular is left. Where G_φφ/sin²θ − G_θθ is a difference of formulas, its quotient by ϖ²
//! loses digits next to the axis: at an angle θ the metric's slope errs by about 10⁻¹⁶/θ of itself.

use crate::formula::{Function, Graph, Node, NodeId};
use std::collections::HashMap;

/// Added to ϖ², so that on the axis itself quotients are finite and their factors zero.
const TINY: f64 = 1e-150;

/// The input that θ is.
const THETA: u8 = 2;

/// A graph in (t, r, θ, φ), and one in (t, x, y, z) that it is rewritten to.
pub(super) struct Rewriter<'g> {
    from: &'g mut Graph,
    to: Graph,
    done: HashMap<NodeId, NodeId>,
    split: HashMap<NodeId, (i32, NodeId)>,
    sin: NodeId,
    x: [NodeId; 3],
    /// ϖ², ϖ and r², r.
    flat2: NodeId,
    flat: NodeId,
    r2: NodeId,
    r: NodeId,
}

impl<'g> Rewriter<'g> {
    pub(super) fn new(from: &'g mut Graph) -> Self {
        let mut to = Graph::default();
        let x: [NodeId; 3] = std::array::from_fn(|i| to.input(i as u8 + 1));
        let squares = x.map(|x| to.mul(x, x));
        let sum = to.add(squares[0], squares[1]);
        let r2 = to.add(sum, squares[2]);
        let flat2 = to.shift(sum, TINY);
        let (flat, r) = (to.call(Function::Sqrt, flat2), to.call(Function::Sqrt, r2));
        let theta = from.input(THETA);
        let sin = from.call(Function::Sin, theta);
        Self { from, to, done: HashMap::new(), split: HashMap::new(), sin, x, flat2, flat, r2, r }
    }

    /// The graph in Cartesian-like coordinates.
    pub(super) fn into_graph(self) -> Graph {
        self.to
    }

    /// A node in Cartesian-like coordinates.
    pub(super) fn rewrite(&mut self, root: NodeId) -> NodeId {
        let needed = self.from.needed(&[root]);
        let ids: Vec<NodeId> = self.from.ids().filter(|id| needed[Graph::index(*id)]).collect();
        for id in ids {
            if !self.done.contains_key(&id) {
                let new = self.rewrite_one(id);
                self.done.insert(id, new);
            }
        }
        self.done[&root]
    }

    /// A node whose parts are rewritten.
    fn rewrite_one(&mut self, id: NodeId) -> NodeId {
        let node = self.from.node(id);
        let part = |id: NodeId| self.done[&id];
        let to = &mut self.to;
        let [x, y, z] = self.x;
        match node {
            Node::Constant(bits) => to.constant(f64::from_bits(bits)),
            Node::Input(0) => to.input(0),
            Node::Input(1) => self.r,
            Node::Input(THETA) => to.atan2(self.flat, z),
            Node::Input(_) => to.atan2(y, x),
            Node::Call(Function::Sin, angle) if self.from.node(angle) == Node::Input(THETA) => {
                to.div(self.flat, self.r)
            }
            Node::Call(Function::Cos, angle) if self.from.node(angle) == Node::Input(THETA) => {
                to.div(z, self.r)
            }
            Node::Call(Function::Sin, angle) if self.from.node(angle) == Node::Input(3) => {
                to.div(y, self.flat)
            }
            Node::Call(Function::Cos, angle) if self.from.node(angle) == Node::Input(3) => {
                to.div(x, self.flat)
            }
            Node::Mul(a, b) if a == self.sin && b == self.sin => to.div(self.flat2, self.r2),
            Node::Add(a, b) => to.add(part(a), part(b)),
            Node::Sub(a, b) => to.sub(part(a), part(b)),
            Node::Mul(a, b) => to.mul(part(a), part(b)),
            Node::Shift(a, by) => to.shift(part(a), f64::from_bits(by)),
            Node::Scale(a, by) => to.scale(part(a), f64::from_bits(by)),
            Node::Call(function, a) => to.call(function, part(a)),
            Node::Atan2(a, b) => to.atan2(part(a), part(b)),
            Node::Min(a, b) => to.min(part(a), part(b)),
            Node::Max(a, b) => to.max(part(a), part(b)),
        }
    }

    /// k and f with node = f sinᵏθ, as far as the formula shows it.
    fn split(&mut self, root: NodeId) -> (i32, NodeId) {
        let needed = self.from.needed(&[root]);
        let ids: Vec<NodeId> = self.from.ids().filter(|id| needed[Graph::index(*id)]).collect();
        for id in ids {
            if !self.split.contains_key(&id) {
                let parted = self.split_one(id);
                self.split.insert(id, parted);
            }
        }
        self.split[&root]
    }

    fn split_one(&mut self, id: NodeId) -> (i32, NodeId) {
        if id == self.sin {
            let one = self.from.constant(1.0);
            return (1, one);
        }
        let part = |id: NodeId| self.split[&id];
        match self.from.node(id) {
            Node::Mul(a, b) => {
                let ((k, a), (l, b)) = (part(a), part(b));
                (k + l, self.from.mul(a, b))
            }
            Node::Scale(a, by) => {
                let (k, a) = part(a);
                (k, self.from.scale(a, f64::from_bits(by)))
            }
            Node::Call(Function::Recip, a) => {
                let (k, a) = part(a);
                (-k, self.from.call(Function::Recip, a))
            }
            Node::Add(a, b) | Node::Sub(a, b) => {
                let ((k, f), (l, g)) = (part(a), part(b));
                let least = k.min(l);
                if least == 0 {
                    return (0, id);
                }
                let (f, g) = (self.times_sin(f, k - least), self.times_sin(g, l - least));
                let whole = match self.from.node(id) {
                    Node::Add(..) => self.from.add(f, g),
                    _ => self.from.sub(f, g),
                };
                (least, whole)
            }
            _ => (0, id),
        }
    }

    fn times_sin(&mut self, node: NodeId, power: i32) -> NodeId {
        let factor = self.from.power(self.sin, f64::from(power));
        self.from.mul(node, factor)
    }

    /// node/sinᵏθ.
    fn over_sin(&mut self, node: NodeId, power: i32) -> NodeId {
        if self.from.value(node) == Some(0.0) {
            return node;
        }
        let (k, rest) = self.split(node);
        self.times_sin(rest, k - power)
    }

    /// The ten components in the order tt, tx, ty, tz, xx, xy, xz, yy, yz, zz from those in the order
    /// tt, tr, tθ, tφ, rr, rθ, rφ, θθ, θφ, φφ.
    pub(super) fn components(&mut self, old: [NodeId; 10]) -> [NodeId; 10] {
        let [tt, tr, t_theta, t_phi, rr, r_theta, r_phi, theta2, theta_phi, phi2] = old;
        // With dθ = d/(sin θ) and dφ = a/(r² sin² θ), d = (xz, yz, −ϖ²)/r³.
        let reduced = [
            tt,
            tr,
            self.over_sin(t_theta, 1),
            self.over_sin(t_phi, 2),
            rr,
            self.over_sin(r_theta, 1),
            self.over_sin(r_phi, 2),
            theta2,
            self.over_sin(theta_phi, 3),
        ];
        let whirl = self.over_sin(phi2, 2);
        let bulge = self.from.sub(whirl, theta2);
        let [tt, tr, t_theta, t_phi, rr, r_theta, r_phi, theta2, theta_phi] =
            reduced.map(|node| self.rewrite(node));
        let bulge = self.rewrite(bulge);
        let [x, y, z] = self.x;
        let (r, r2, flat2) = (self.r, self.r2, self.flat2);
        let g = &mut self.to;
        let zero = g.constant(0.0);
        let n = [x, y, z].map(|x| g.div(x, r));
        let r3 = g.mul(r2, r);
        let d = [g.mul(x, z), g.mul(y, z), g.neg(flat2)].map(|c| g.div(c, r3));
        // Over r² already.
        let a = [g.neg(y), x].map(|c| g.div(c, r2));
        let a = [a[0], a[1], zero];
        let round = g.div(theta2, r2);
        let along = g.sub(rr, round);
        // a has a factor 1/r² that (a·dx)² is not to have twice: bulge r⁴/(r² ϖ²).
        let scaled = g.mul(bulge, r2);
        let across = g.div(scaled, flat2);
        let mut new = [tt; 10];
        for i in 0..3 {
            let parts = [g.mul(tr, n[i]), g.mul(t_theta, d[i]), g.mul(t_phi, a[i])];
            new[1 + i] = sum(g, parts);
        }
        let mut place = 4;
        for i in 0..3 {
            for j in i..3 {
                let (nn, aa) = (g.mul(n[i], n[j]), g.mul(a[i], a[j]));
                let mut all = vec![g.mul(along, nn), g.mul(across, aa)];
                if i == j {
                    all.push(round);
                }
                for (factor, u, v) in [(r_theta, &n, &d), (r_phi, &n, &a), (theta_phi, &d, &a)] {
                    let (uv, vu) = (g.mul(u[i], v[j]), g.mul(u[j], v[i]));
                    let both = g.add(uv, vu);
                    all.push(g.mul(factor, both));
                }
                new[place] = sum(g, all);
                place += 1;
            }
        }
        new
    }
}

fn sum(graph: &mut Graph, parts: impl IntoIterator<Item = NodeId>) -> NodeId {
    let mut sum = graph.constant(0.0);
    for part in parts {
        sum = graph.add(sum, part);
    }
    sum
}
