//! Disks seen along the light's own paths: pictures with exact derivatives.

mod canvas;
mod lines;
mod lit;
mod matter;
mod order;
mod picture;
mod pieces;
mod ratio;
mod rows;
mod screen;
mod secant;
mod shine;
mod sight;
mod sketch;
mod source;
mod spacetime;
mod start;
mod strips;
mod tabulated;
mod text_disk;
mod theory;

pub use canvas::Canvas;
pub use lit::{Lit, Outline};
pub use matter::Profile;
pub use picture::{DRAWN, Fineness, Painter, Setting, Unseen};
pub use screen::{Frame, Projection};
pub use source::{Disk, Kind};
pub(crate) use start::{Template, among};
pub use text_disk::{Light, TextDisk};
pub use theory::{SPIN, Theory};
