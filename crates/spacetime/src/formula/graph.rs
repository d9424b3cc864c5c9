//! Expressions as a graph in which what is equal is one node.

use super::MAX_NODES;
use super::function::Function;
use std::collections::HashMap;

/// The number of a node. Those of what it is made of are less.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct NodeId(u32);

/// An operation and what it acts on. Numbers are their bits, so that nodes can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number.
    Constant(u64),
    /// An input by its place.
    Input(u8),
    /// a + b.
    Add(NodeId, NodeId),
    /// a − b.
    Sub(NodeId, NodeId),
    /// a b.
    Mul(NodeId, NodeId),
    /// a + number.
    Shift(NodeId, u64),
    /// a × number.
    Scale(NodeId, u64),
    /// A function of one number.
    Call(Function, NodeId),
    /// The angle of (x, y) = (second, first).
    Atan2(NodeId, NodeId),
    /// The smaller.
    Min(NodeId, NodeId),
    /// The larger.
    Max(NodeId, NodeId),
}

/// Expressions that share their parts.
///
/// ```
/// use kerrscope_spacetime::formula::Graph;
/// let mut graph = Graph::default();
/// let x = graph.input(0);
/// let (a, b) = (graph.mul(x, x), graph.power(x, 2.0));
/// assert_eq!(a, b);
/// let zero = graph.sub(a, b);
/// assert_eq!(graph.value(zero), Some(0.0));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    numbers: HashMap<Node, NodeId>,
    full: bool,
}

impl Graph {
    /// What a node is.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id.0 as usize]
    }

    /// The place of a node among all, below [`Graph::len`].
    pub fn index(id: NodeId) -> usize {
        id.0 as usize
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Whether more nodes were wanted than [`MAX_NODES`]; the graph is of no use then.
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// Its value if it is a number.
    pub fn value(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }

    fn make(&mut self, node: Node) -> NodeId {
        if let Some(id) = self.numbers.get(&node) {
            return *id;
        }
        if self.nodes.len() >= MAX_NODES {
            self.full = true;
            return NodeId(0);
        }
        let id = NodeId(self.nodes.len() as u32);
        self.nodes.push(node);
        self.numbers.insert(node, id);
        id
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> NodeId {
        // −0 and 0 are one node.
        self.make(Node::Constant((value + 0.0).to_bits()))
    }

    /// An input.
    pub fn input(&mut self, place: u8) -> NodeId {
        self.make(Node::Input(place))
    }

    /// a + b.
    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => self.constant(x + y),
            (Some(x), None) => self.shift(b, x),
            (None, Some(y)) => self.shift(a, y),
            (None, None) => match (self.node(a), self.node(b)) {
                (Node::Scale(a, bits), _) if f64::from_bits(bits) == -1.0 => self.sub(b, a),
                (_, Node::Scale(b, bits)) if f64::from_bits(bits) == -1.0 => self.sub(a, b),
                _ if a == b => self.scale(a, 2.0),
                _ => self.make(Node::Add(a.min(b), a.max(b))),
            },
        }
    }

    /// a − b.
    pub fn sub(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            _ if a == b => self.constant(0.0),
            (Some(x), Some(y)) => self.constant(x - y),
            (Some(x), None) => {
                let negative = self.neg(b);
                self.shift(negative, x)
            }
            (None, Some(y)) => self.shift(a, -y),
            (None, None) => match self.node(b) {
                Node::Scale(b, bits) if f64::from_bits(bits) == -1.0 => self.add(a, b),
                _ => self.make(Node::Sub(a, b)),
            },
        }
    }

    /// −a.
    pub fn neg(&mut self, a: NodeId) -> NodeId {
        self.scale(a, -1.0)
    }

    /// a + number.
    pub fn shift(&mut self, a: NodeId, by: f64) -> NodeId {
        match self.node(a) {
            Node::Constant(bits) => self.constant(f64::from_bits(bits) + by),
            _ if by == 0.0 => a,
            _ => self.make(Node::Shift(a, by.to_bits())),
        }
    }

    /// a × number.
    pub fn scale(&mut self, a: NodeId, by: f64) -> NodeId {
        match self.node(a) {
            Node::Constant(bits) => self.constant(f64::from_bits(bits) * by),
            _ if by == 0.0 => self.constant(0.0),
            _ if by == 1.0 => a,
            Node::Scale(inner, bits) => self.scale(inner, f64::from_bits(bits) * by),
            Node::Sub(x, y) if by == -1.0 => self.sub(y, x),
            _ => self.make(Node::Scale(a, by.to_bits())),
        }
    }

    /// a b. Zero times anything is zero: a quotient that has no value where its numerator vanishes is taken as zero.
    pub fn mul(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => return self.constant(x * y),
            (Some(x), None) => return self.scale(b, x),
            (None, Some(y)) => return self.scale(a, y),
            (None, None) => {}
        }
        match (self.node(a), self.node(b)) {
            (Node::Scale(a, bits), _) => {
                let product = self.mul(a, b);
                self.scale(product, f64::from_bits(bits))
            }
            (_, Node::Scale(b, bits)) => {
                let product = self.mul(a, b);
                self.scale(product, f64::from_bits(bits))
            }
            (Node::Call(Function::Sqrt, x), Node::Call(Function::Sqrt, y)) if x == y => x,
            (Node::Call(Function::Recip, x), _) if x == b => self.constant(1.0),
            (_, Node::Call(Function::Recip, y)) if y == a => self.constant(1.0),
            _ => self.make(Node::Mul(a.min(b), a.max(b))),
        }
    }

    /// a/b.
    pub fn div(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let (Some(x), Some(y)) = (self.value(a), self.value(b)) {
            return self.constant(x / y);
        }
        let inverse = self.call(Function::Recip, b);
        self.mul(a, inverse)
    }

    /// A function of one number.
    pub fn call(&mut self, function: Function, a: NodeId) -> NodeId {
        match self.node(a) {
            Node::Constant(bits) => self.constant(function.of(f64::from_bits(bits))),
            Node::Call(Function::Recip, inner) if function == Function::Recip => inner,
            Node::Scale(inner, bits) if function == Function::Recip => {
                let inverse = self.call(Function::Recip, inner);
                self.scale(inverse, 1.0 / f64::from_bits(bits))
            }
            _ => self.make(Node::Call(function, a)),
        }
    }

    /// atan2(y, x).
    pub fn atan2(&mut self, y: NodeId, x: NodeId) -> NodeId {
        self.both(y, x, f64::atan2, Node::Atan2)
    }

    /// The smaller.
    pub fn min(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.both(a, b, f64::min, Node::Min)
    }

    /// The larger.
    pub fn max(&mut self, a: NodeId, b: NodeId) -> NodeId {
        self.both(a, b, f64::max, Node::Max)
    }

    fn both(
        &mut self,
        a: NodeId,
        b: NodeId,
        value: fn(f64, f64) -> f64,
        node: fn(NodeId, NodeId) -> Node,
    ) -> NodeId {
        match (self.value(a), self.value(b)) {
            (Some(x), Some(y)) => self.constant(value(x, y)),
            _ => self.make(node(a, b)),
        }
    }

    /// aᵇ for a number b: products for whole numbers up to 64, roots for halves, else e^(b ln a), which has no value
    /// for a < 0.
    pub fn power(&mut self, a: NodeId, exponent: f64) -> NodeId {
        if let Some(x) = self.value(a) {
            return self.constant(x.powf(exponent));
        }
        let size = exponent.abs();
        if size > 64.0 || (2.0 * size).fract() != 0.0 {
            let log = self.call(Function::Ln, a);
            let product = self.scale(log, exponent);
            return self.call(Function::Exp, product);
        }
        let mut result = self.constant(1.0);
        if size.fract() != 0.0 {
            result = self.call(Function::Sqrt, a);
        }
        let (mut whole, mut square) = (size.trunc() as u32, a);
        while whole > 0 {
            if whole & 1 == 1 {
                result = self.mul(result, square);
            }
            whole >>= 1;
            if whole > 0 {
                square = self.mul(square, square);
            }
        }
        if exponent < 0.0 { self.call(Function::Recip, result) } else { result }
    }

    /// aᵇ.
    pub fn power_of(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some(exponent) = self.value(b) {
            return self.power(a, exponent);
        }
        let log = self.call(Function::Ln, a);
        let product = self.mul(log, b);
        self.call(Function::Exp, product)
    }

    /// The nodes that a node is made of.
    pub fn parts(&self, id: NodeId) -> [Option<NodeId>; 2] {
        match self.node(id) {
            Node::Constant(_) | Node::Input(_) => [None, None],
            Node::Add(a, b)
            | Node::Sub(a, b)
            | Node::Mul(a, b)
            | Node::Atan2(a, b)
            | Node::Min(a, b)
            | Node::Max(a, b) => [Some(a), Some(b)],
            Node::Shift(a, _) | Node::Scale(a, _) | Node::Call(_, a) => [Some(a), None],
        }
    }

    /// Which nodes some nodes need, themselves too.
    pub fn needed(&self, roots: &[NodeId]) -> Vec<bool> {
        let mut needed = vec![false; self.nodes.len()];
        for root in roots {
            needed[Self::index(*root)] = true;
        }
        for index in (0..self.nodes.len()).rev() {
            if needed[index] {
                for part in self.parts(NodeId(index as u32)).into_iter().flatten() {
                    needed[Self::index(part)] = true;
                }
            }
        }
        needed
    }

    /// Whether any of some nodes depends on an input.
    pub fn depends(&self, roots: &[NodeId], input: u8) -> bool {
        let at = self.numbers.get(&Node::Input(input));
        at.is_some_and(|id| self.needed(roots)[Self::index(*id)])
    }

    /// The nodes in their order, in which parts come first.
    pub(crate) fn ids(&self) -> impl DoubleEndedIterator<Item = NodeId> + use<> {
        (0..self.nodes.len() as u32).map(NodeId)
    }
}
