//! Pictures of black holes that can be trusted.

pub use kerrscope_spacetime as spacetime;

pub mod light;
