//! Pictures of black holes that can be trusted.

pub use kerrscope_spacetime as spacetime;

pub mod camera;
pub mod checkpoint;
pub mod disk;
pub mod display;
pub mod light;
pub mod line;
pub mod material;
mod noise;
pub mod objects;
pub mod output;
pub mod random;
pub mod render;
pub mod scene;
pub mod sky;
pub mod texture;
pub mod validate;
