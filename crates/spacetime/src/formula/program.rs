//! A machine with registers that works formulas out.

use super::function::Function;
use super::graph::{Graph, Node, NodeId};
use crate::scalar::Scalar;

/// Registers of the small machine, which most metrics do with.
const FEW: usize = 32;
/// Registers of the large one.
const MANY: usize = 256;

/// One instruction; the first register is where the result goes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Instruction {
    Constant(u8, f64),
    Add(u8, u8, u8),
    Sub(u8, u8, u8),
    Mul(u8, u8, u8),
    /// a b + c.
    MulAdd(u8, u8, u8, u8),
    Shift(u8, u8, f64),
    Scale(u8, u8, f64),
    Call(Function, u8, u8),
    Atan2(u8, u8, u8),
    Min(u8, u8, u8),
    Max(u8, u8, u8),
    /// A result by its place.
    Output(u8, u8),
}

/// Formulas compiled: their results are functions of the inputs.
///
/// ```
/// use kerrscope_spacetime::formula::{Graph, Program};
/// let mut graph = Graph::default();
/// let (x, y) = (graph.input(0), graph.input(1));
/// let (sum, product) = (graph.add(x, y), graph.mul(x, y));
/// let program = Program::compile(&graph, 2, &[sum, product]).unwrap();
/// let mut results = [0.0; 2];
/// program.evaluate(&[3.0, 4.0], &mut results);
/// assert_eq!(results, [7.0, 12.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    instructions: Box<[Instruction]>,
    inputs: usize,
    registers: usize,
    outputs: usize,
}

impl Program {
    /// The program that works some nodes out, as a function of so many inputs; none if more than 256 values would have
    /// to be kept at a time.
    pub fn compile(graph: &Graph, inputs: u8, outputs: &[NodeId]) -> Option<Self> {
        let needed = graph.needed(outputs);
        let ids: Vec<NodeId> = graph.ids().filter(|id| needed[Graph::index(*id)]).collect();
        // How often each node is yet to be used.
        let mut uses = vec![0_usize; graph.len()];
        for part in ids.iter().flat_map(|id| graph.parts(*id)).flatten() {
            uses[Graph::index(part)] += 1;
        }
        for output in outputs {
            uses[Graph::index(*output)] += 1;
        }
        // A product that is only added to something is worked out with the sum.
        let mut fused = vec![false; graph.len()];
        for id in &ids {
            if let Node::Add(a, b) = graph.node(*id) {
                let alone =
                    |id: NodeId| matches!(graph.node(id), Node::Mul(..)) && uses[Graph::index(id)] == 1;
                if let Some(product) = [b, a].into_iter().find(|id| alone(*id)) {
                    fused[Graph::index(product)] = true;
                }
            }
        }
        let mut compiler = Compiler {
            graph,
            fused,
            uses,
            place: vec![None; graph.len()],
            // The last is given out first: the least number comes out of it first.
            free: (inputs..=u8::MAX).rev().collect(),
            registers: usize::from(inputs),
            instructions: Vec::new(),
        };
        for id in &ids {
            if let Node::Input(input) = graph.node(*id) {
                compiler.place[Graph::index(*id)] = Some(input);
            }
        }
        for (slot, output) in (0_u8..).zip(outputs) {
            let register = compiler.work_out(*output)?;
            compiler.instructions.push(Instruction::Output(slot, register));
            compiler.release(*output);
        }
        Some(Self {
            instructions: compiler.instructions.into(),
            inputs: usize::from(inputs),
            registers: compiler.registers,
            outputs: outputs.len(),
        })
    }

    /// How many instructions there are.
    pub fn len(&self) -> usize {
        self.instructions.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.instructions.is_empty()
    }

    /// Works the results out.
    ///
    /// # Panics
    /// If there are not as many inputs and outputs as the program was compiled for.
    #[inline(always)]
    pub fn evaluate<S: Scalar, const N: usize, const O: usize>(&self, inputs: &[S; N], outputs: &mut [S; O]) {
        assert!(self.inputs == N && self.outputs == O, "inputs and outputs as compiled for");
        // A function of its own: the machine has an arm for each instruction, and is wanted in many places.
        inputs[0].outline(
            #[inline(always)]
            || {
                if self.registers <= FEW {
                    self.run::<S, N, O, FEW>(inputs, outputs);
                } else {
                    self.run::<S, N, O, MANY>(inputs, outputs);
                }
            },
        );
    }

    #[inline(always)]
    fn run<S: Scalar, const N: usize, const O: usize, const R: usize>(
        &self,
        inputs: &[S; N],
        outputs: &mut [S; O],
    ) {
        let zero = inputs[0].constant(0.0);
        let mut registers = [zero; R];
        registers[..N].copy_from_slice(inputs);
        let r = &mut registers;
        // The number of registers is a power of two, so that the machine needs no check of bounds.
        let at = at::<R>;
        for instruction in &self.instructions {
            match *instruction {
                Instruction::Constant(to, value) => r[at(to)] = zero.constant(value),
                Instruction::Add(to, a, b) => r[at(to)] = r[at(a)] + r[at(b)],
                Instruction::Sub(to, a, b) => r[at(to)] = r[at(a)] - r[at(b)],
                Instruction::Mul(to, a, b) => r[at(to)] = r[at(a)] * r[at(b)],
                Instruction::MulAdd(to, a, b, c) => r[at(to)] = r[at(a)].mul_add(r[at(b)], r[at(c)]),
                Instruction::Shift(to, a, by) => r[at(to)] = r[at(a)] + by,
                Instruction::Scale(to, a, by) => r[at(to)] = r[at(a)] * by,
                Instruction::Call(function, to, a) => r[at(to)] = function.of(r[at(a)]),
                Instruction::Atan2(to, a, b) => r[at(to)] = r[at(a)].atan2(r[at(b)]),
                Instruction::Min(to, a, b) => r[at(to)] = r[at(a)].min(r[at(b)]),
                Instruction::Max(to, a, b) => r[at(to)] = r[at(a)].max(r[at(b)]),
                Instruction::Output(slot, a) => outputs[usize::from(slot) % O] = r[at(a)],
            }
        }
    }
}

/// The place of a register.
#[inline(always)]
fn at<const R: usize>(register: u8) -> usize {
    usize::from(register) % R
}

struct Compiler<'g> {
    graph: &'g Graph,
    /// Products that are worked out with the sum that they are in.
    fused: Vec<bool>,
    uses: Vec<usize>,
    /// Where the value of a node is.
    place: Vec<Option<u8>>,
    free: Vec<u8>,
    registers: usize,
    instructions: Vec<Instruction>,
}

impl Compiler<'_> {
    /// Works a node out, and what it needs first, deepest first, so that little is kept; its register.
    fn work_out(&mut self, root: NodeId) -> Option<u8> {
        // Not by recursion: a graph may be deep.
        let mut waiting = vec![root];
        while let Some(&id) = waiting.last() {
            if self.place[Graph::index(id)].is_some() {
                waiting.pop();
                continue;
            }
            let parts = self.operands(id);
            let before = waiting.len();
            waiting.extend(parts.iter().flatten().filter(|part| self.place[Graph::index(**part)].is_none()));
            if waiting.len() == before {
                waiting.pop();
                self.emit(id, &parts)?;
            }
        }
        self.place[Graph::index(root)]
    }

    /// What has to be there for a node: its parts, but of a fused product that product's.
    fn operands(&self, id: NodeId) -> [Option<NodeId>; 3] {
        if let Node::Add(a, b) = self.graph.node(id) {
            for (product, other) in [(b, a), (a, b)] {
                if let (true, Node::Mul(x, y)) = (self.fused[Graph::index(product)], self.graph.node(product))
                {
                    return [Some(x), Some(y), Some(other)];
                }
            }
        }
        let [a, b] = self.graph.parts(id);
        [a, b, None]
    }

    fn emit(&mut self, id: NodeId, parts: &[Option<NodeId>; 3]) -> Option<()> {
        let of =
            |part: Option<NodeId>| part.and_then(|part| self.place[Graph::index(part)]).unwrap_or_default();
        let [a, b, c] = parts.map(of);
        // An operand's register may take the result.
        for part in parts.iter().flatten() {
            self.release(*part);
        }
        let to = self.free.pop()?;
        self.registers = self.registers.max(usize::from(to) + 1);
        self.place[Graph::index(id)] = Some(to);
        let number = f64::from_bits;
        self.instructions.push(match self.graph.node(id) {
            Node::Constant(bits) => Instruction::Constant(to, number(bits)),
            // An input has a register from the start.
            Node::Input(_) => return None,
            Node::Add(..) if parts[2].is_some() => Instruction::MulAdd(to, a, b, c),
            Node::Add(..) => Instruction::Add(to, a, b),
            Node::Sub(..) => Instruction::Sub(to, a, b),
            Node::Mul(..) => Instruction::Mul(to, a, b),
            Node::Shift(_, bits) => Instruction::Shift(to, a, number(bits)),
            Node::Scale(_, bits) => Instruction::Scale(to, a, number(bits)),
            Node::Call(function, _) => Instruction::Call(function, to, a),
            Node::Atan2(..) => Instruction::Atan2(to, a, b),
            Node::Min(..) => Instruction::Min(to, a, b),
            Node::Max(..) => Instruction::Max(to, a, b),
        });
        Some(())
    }

    /// One use of a node less; after the last its register is free. Inputs keep theirs.
    fn release(&mut self, id: NodeId) {
        let index = Graph::index(id);
        self.uses[index] -= 1;
        if self.uses[index] == 0
            && !matches!(self.graph.node(id), Node::Input(_))
            && let Some(register) = self.place[index]
        {
            self.free.push(register);
        }
    }
}
