//! Black holes read off pictures: a picture as a function of parameters, and what is known of these once it is seen.

mod blur;
pub mod chains;
mod coordinates;
pub mod diagnostics;
pub mod evidence;
pub mod fit;
pub mod likelihood;
mod metric;
pub mod mode;
pub mod model;
pub mod models;
pub mod noise;
pub mod nuts;
mod observed;
pub mod output;
mod place;
mod prior;
pub mod question;
mod reduce;
pub mod request;
mod ring;
mod search;
mod shear;
pub mod silhouette;
pub mod summary;
pub mod task;
pub mod traced;
mod valley;
mod verdict;

pub use blur::{FWHM, Kernel};
pub use coordinates::Coordinates;
pub use observed::{COMMON, Observed};
pub use place::Place;
pub use prior::Prior;
pub use ring::Ring;
