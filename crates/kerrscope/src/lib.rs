//! Pictures of black holes that can be trusted.

pub use kerrscope_spacetime as spacetime;

pub mod camera;
pub mod checkpoint;
pub mod disk;
pub mod display;
pub mod light;
pub mod line;
pub mod material;
pub mod measure;
mod noise;
pub mod objects;
pub mod output;
pub mod random;
pub mod render;
pub mod scene;
pub mod si;
pub mod sky;
pub mod spectrum;
pub mod survey;
pub mod texture;
pub mod units;
pub mod validate;
