//! What lies behind everything: light from infinitely far away.
//!
//! A direction on the sky is where light comes from: `theta`, the polar angle from +z,
//! and `phi`, the azimuth from +x towards +y, both in radians. `phi` may have any value.
//!
//! The sky is seen from inside. To a viewer at the centre with +z up, azimuth grows to
//! the left, so what is to the right in a panorama lies at smaller azimuth; see
//! [`Panorama`]. Longitudes of the real sky (galactic longitude, right ascension) grow to
//! the left as well when north is up, so that they increase with azimuth; see
//! [`Orientation`].

mod catalogue;
mod color;
mod cube;
mod footprint;
mod glow;
mod grid;
mod orientation;
mod panorama;
mod stars;

pub use catalogue::Star;
pub use footprint::footprint;
pub use glow::Glow;
pub use grid::Grid;
pub use orientation::{Frame, Orientation};
pub use panorama::Panorama;
pub use stars::Stars;

use crate::light::Light;

/// The celestial sphere.
///
/// ```
/// use kerrscope::light::Light;
/// use kerrscope::sky::Sky;
/// let dusk = Light::new([0.02, 0.03, 0.1]);
/// assert_eq!(Sky::Uniform(dusk).radiance(1.0, 2.0, 0.001), dusk);
/// assert_eq!(Sky::Black.radiance(1.0, 2.0, 0.001), Light::DARK);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Sky {
    /// No light from anywhere.
    #[default]
    Black,
    /// The same light from everywhere.
    Uniform(Light),
    /// Lines of latitude and longitude.
    Grid(Grid),
    /// The stars and the Milky Way.
    Stars(Stars),
    /// A picture of the whole sky.
    Panorama(Panorama),
}

impl Sky {
    /// The light that comes from a direction, for a ray that stands for an angle on the sky in
    /// radians; see [`footprint`]. Panoramas alone take notice of the angle. Finite for any numbers.
    pub fn radiance(&self, theta: f64, phi: f64, angle: f64) -> Light {
        match self {
            Self::Black => Light::DARK,
            Self::Uniform(light) => *light,
            Self::Grid(grid) => grid.radiance(theta, phi),
            Self::Stars(stars) => stars.radiance(theta, phi),
            Self::Panorama(panorama) => panorama.radiance(theta, phi, angle),
        }
    }
}
