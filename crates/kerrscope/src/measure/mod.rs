//! Numbers that are read off a finished picture.

mod contour;
mod curve;
mod disk_edge;
mod feature;
mod features;
mod fit;
mod manner;
mod moments;
mod noise;
mod outline;
mod overlay;
mod picture;
mod profile;
mod rim;
mod ring;
mod series;
mod shadow;
mod sight;

pub use curve::Curve;
pub use disk_edge::DiskEdge;
pub use feature::{Feature, Measured};
pub use features::Features;
pub use fit::Fit;
pub use manner::{Manner, Part};
pub use moments::Moments;
pub use noise::noise;
pub use outline::Outline;
pub use overlay::Overlay;
pub use picture::{Picture, PictureError, PictureFault, PixelScale};
pub use ring::Ring;
pub use series::{Lengths, Reading, Repeat, Series, Setting};
pub use shadow::Shadow;
