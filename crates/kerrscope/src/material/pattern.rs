//! How the colour of a surface changes from place to place.

use std::sync::Arc;

use super::Noise;
use crate::light::Light;
use crate::spacetime::tensor::Vec3;
use crate::texture::Texture;

/// How the colour of a surface changes from place to place. Colours are linear light.
///
/// ```
/// use kerrscope::light::Light;
/// use kerrscope::material::Pattern;
/// let [white, black] = [1.0, 0.0].map(|c| Light::new([c; 3]));
/// let board = Pattern::Checker { first: white, second: black, squares: [8.0, 8.0] };
/// let at = |u, v| board.at(|| [u, v], &[0.0; 3]);
/// // White is at the right hand of who sits at the lower edge.
/// assert_eq!((at(0.05, 0.05), at(0.95, 0.05)), (black, white));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// The same everywhere.
    Solid(Light),
    /// Squares of two colours in turn.
    Checker {
        /// That of the second square of the first row.
        first: Light,
        /// That of the first.
        second: Light,
        /// How many there are along each coordinate.
        squares: [f64; 2],
    },
    /// A picture, its left edge at the first coordinate 0 and its lower edge at the second coordinate 0. It is black where
    /// it is transparent.
    Picture {
        /// The picture.
        texture: Arc<Texture>,
        /// Factor on its colours.
        tint: Light,
        /// Whether its right edge goes on with its left one.
        closed: bool,
    },
    /// Clouds of one colour in another.
    Noise {
        /// Where the noise is 0.
        first: Light,
        /// Where it is 1.
        second: Light,
        /// The noise.
        noise: Noise,
    },
}

impl Pattern {
    /// The colour at a place of a surface: its coordinates from 0 to 1, worked out if they matter, and its position from
    /// the thing's own centre.
    #[inline]
    pub fn at(&self, coordinates: impl FnOnce() -> [f64; 2], position: &Vec3<f64>) -> Light {
        match self {
            Self::Solid(light) => *light,
            Self::Checker { first, second, squares } => {
                let [u, v] = coordinates();
                let cell = [u * squares[0], v * squares[1]].map(|c| c.floor() as i64);
                if (cell[0] ^ cell[1]) & 1 == 0 { *second } else { *first }
            }
            Self::Picture { texture, tint, closed } => {
                let [u, v] = coordinates();
                let seen = texture.sample(u, 1.0 - v, *closed).light.rgb;
                Light::new(std::array::from_fn(|i| seen[i] * tint.rgb[i]))
            }
            Self::Noise { first, second, noise } => {
                let share = noise.at(position);
                *first * (1.0 - share) + *second * share
            }
        }
    }
}
