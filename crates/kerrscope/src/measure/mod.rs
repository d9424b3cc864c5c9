//! Numbers that are read off a finished picture.

mod moments;

pub use moments::Moments;
