//! What is wrong with a definition.

use super::definition::Part;
use crate::formula::Fault;

/// One thing that is wrong with a definition, and in which part of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DefinitionFault {
    /// The part.
    pub part: Part,
    /// The fault; its span is in the part's formula, and empty at 0 if it is about all of it.
    pub fault: Fault,
}

impl DefinitionFault {
    pub(super) fn whole(part: Part, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { part, fault: Fault { span: 0..0, message: message.into(), help: help.into() } }
    }
}

impl std::fmt::Display for DefinitionFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}, {}", self.part, self.fault)
    }
}

impl std::error::Error for DefinitionFault {}
