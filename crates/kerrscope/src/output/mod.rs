//! Files that leave the program. One file of code a format.
//!
//! A file appears whole or not at all (see [`mod@file`]), and says how it was made
//! (see [`Provenance`]).

mod error;
pub mod exr;
pub mod file;
pub mod fits;
mod format;
pub mod hdf5;
mod images;
pub mod png;
mod provenance;
mod saved;

pub use error::FileError;
pub use format::Format;
pub use images::{Image, ImageSet, Intensity};
pub use provenance::{Provenance, ProvenanceFault};
pub use saved::{Saved, SavedError, draft};
