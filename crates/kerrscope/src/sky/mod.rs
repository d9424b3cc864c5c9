//! What lies behind everything: light from infinitely far away.
//!
//! A direction on the sky is where light comes from: the unit vector of the polar angle θ from +z and the
//! azimuth φ from +x towards +y, as [`towards`] makes it of them.
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
mod gradient;
mod grid;
mod orientation;
mod panorama;
mod stars;

pub use catalogue::Star;
pub use footprint::footprint;
pub use glow::Glow;
pub use gradient::Gradient;
pub use grid::Grid;
pub use orientation::{Frame, Orientation};
pub use panorama::Panorama;
pub use stars::Stars;

use crate::light::Light;
use crate::spacetime::tensor::Vec3;

/// The celestial sphere.
///
/// ```
/// use kerrscope::light::Light;
/// use kerrscope::sky::{Sky, towards};
/// let dusk = Light::new([0.02, 0.03, 0.1]);
/// assert_eq!(Sky::Uniform(dusk).radiance(towards(1.0, 2.0), 0.001), dusk);
/// assert_eq!(Sky::Black.radiance(towards(1.0, 2.0), 0.001), Light::DARK);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Sky {
    /// No light from anywhere.
    #[default]
    Black,
    /// The same light from everywhere.
    Uniform(Light),
    /// A blue sky.
    Gradient(Gradient),
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
    pub fn radiance(&self, n: Vec3<f64>, angle: f64) -> Light {
        match self {
            Self::Black => Light::DARK,
            Self::Uniform(light) => *light,
            Self::Gradient(gradient) => gradient.radiance(n),
            Self::Grid(grid) => grid.radiance(n),
            Self::Stars(stars) => stars.radiance(n),
            Self::Panorama(panorama) => panorama.radiance(n, angle),
        }
    }
}

/// The unit vector of a polar angle and an azimuth in radians; a number that is not finite counts as 0.
pub fn towards(theta: f64, phi: f64) -> Vec3<f64> {
    let [theta, phi] = [theta, phi].map(|x| if x.is_finite() { x } else { 0.0 });
    let ((sin, cos), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
    [sin * cos_phi, sin * sin_phi, cos]
}

/// Polar angle and azimuth of a vector, the latter from −π to π; 0 where there is none.
fn angles([x, y, z]: Vec3<f64>) -> [f64; 2] {
    [x.hypot(y).atan2(z), y.atan2(x)].map(|angle| if angle.is_nan() { 0.0 } else { angle })
}
