//! Formulas: from text to a program that runs on any [`Scalar`](crate::Scalar), lanes and dual numbers too.
//!
//! ```text
//! sum      = product { ("+" | "-") product }
//! product  = signed { ("*" | "/") signed }
//! signed   = { "+" | "-" } power
//! power    = atom [ "^" signed ]              from the right: 2^3^2 = 2^9; -x^2 = -(x^2)
//! atom     = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//!
//! Functions are `sqrt sin cos tan exp ln abs sinh cosh tanh atan2(y, x) min(a, b) max(a, b)`; `pi` and `e` are
//! known. Angles are in radians. A text is at most [`MAX_LENGTH`] bytes long and [`MAX_DEPTH`] brackets deep.
//!
//! A text is read straight into a [`Graph`], in which equal expressions are one node and numbers are worked out. A
//! [`Program`] is the nodes that its results need, in an order in which few values are alive at a time: a machine with
//! registers, each of whose instructions acts on whole scalars.

mod fault;
mod function;
mod graph;
mod parser;
mod program;
mod token;

pub use fault::Fault;
pub use function::Function;
pub use graph::{Graph, Node, NodeId};
pub use parser::{Names, parse};
pub use program::Program;

/// The most bytes of a formula.
pub const MAX_LENGTH: usize = 4096;
/// The most brackets, signs and exponents within one another.
pub const MAX_DEPTH: usize = 64;
/// The most nodes of a graph.
pub const MAX_NODES: usize = 8192;

/// Whether a text is a name: letters of any alphabet, digits and `_`, the first no digit.
pub fn is_name(text: &str) -> bool {
    text.starts_with(token::is_letter) && text.chars().all(|c| token::is_letter(c) || c.is_ascii_digit())
}

/// Whether a name is that of a function or of a number that every formula knows.
pub fn reserved(name: &str) -> bool {
    name == "pi" || name == "e" || function::CALLED.iter().any(|(known, _)| *known == name)
}

/// The names in a formula, each as often as it stands there.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    let tokens = if text.len() > MAX_LENGTH { Vec::new() } else { token::tokens(text, &mut Vec::new()) };
    tokens.into_iter().filter_map(|(token, _)| match token {
        token::Token::Name(name) => Some(name),
        _ => None,
    })
}
