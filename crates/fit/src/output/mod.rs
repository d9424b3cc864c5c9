//! Files of fits. One file of code a kind.
//!
//! A file appears whole or not at all, and says how it was made (see [`Record`]).

pub mod chain;
pub mod corner;
mod density;
mod record;
pub mod residual;
#[cfg(test)]
mod synthetic;

pub use record::Record;
