//! Numbers that are read off a finished picture.

mod moments;
mod picture;

pub use moments::Moments;
pub use picture::{Picture, PictureError, PictureFault, PixelScale};
