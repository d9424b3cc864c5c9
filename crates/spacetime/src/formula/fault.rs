//! What is wrong with a formula.

use std::ops::Range;

/// One thing that is wrong with a formula: where, what, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The bytes of the formula that it is about; empty at its end where something is missing.
    pub span: Range<usize>,
    /// What is wrong, in a phrase without a full stop.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

impl Fault {
    pub(super) fn new(span: Range<usize>, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { span, message: message.into(), help: help.into() }
    }

    /// At most 40 characters of what was typed, without control characters, for a message.
    pub(crate) fn shorten(typed: &str) -> String {
        typed.chars().take(40).map(|c| if c.is_control() { ' ' } else { c }).collect()
    }
}

impl std::fmt::Display for Fault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "byte {}: {}\n  help: {}", self.span.start, self.message, self.help)
    }
}

impl std::error::Error for Fault {}
