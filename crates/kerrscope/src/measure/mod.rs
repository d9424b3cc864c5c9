//! Numbers that are read off a finished picture.

mod disk_edge;
mod feature;
mod features;
mod fit;
mod moments;
mod outline;
mod overlay;
mod picture;
mod profile;
mod ring;
mod series;
mod shadow;

pub use disk_edge::DiskEdge;
pub use feature::{Feature, Measured};
pub use features::Features;
pub use fit::Fit;
pub use moments::Moments;
pub use outline::Outline;
pub use overlay::Overlay;
pub use picture::{Picture, PictureError, PictureFault, PixelScale};
pub use ring::Ring;
pub use series::{Lengths, Reading, Series, Setting};
pub use shadow::Shadow;
