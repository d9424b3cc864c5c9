//! A map of the Earth: coasts and lakes as they are, colours by rule.
//!
//! [`Texture::earth`] draws it. Coasts and lakes are outlines ([`Outlines`], after Natural Earth). **The
//! colours are a drawing, not a measurement**: no photograph and no data of vegetation, height or ice
//! stands behind them. They follow from latitude, from how far the prevailing winds have carried air over
//! land, from a few corrections by hand, and from noise. Mountains, rivers, clouds and seasons are not in it.
//!
//! The map is equirectangular with north up and longitude 0 in the middle, as the Earth is seen from
//! outside. With longitude ℓ, positive to the east, and latitude b:
//!
//! ```text
//! u = ½ + ℓ / 2π   mod 1    middle column: longitude 0
//! v = ½ − b / π             top row: the north pole
//! ```
//!
//! A sky seen from inside has the other sign in u ([`Panorama`](crate::sky::Panorama)).

mod climate;
mod coverage;
mod outline;
mod tint;

use rayon::prelude::*;

pub use outline::{Outlines, Ring, UNITS};

use self::climate::Climate;
use self::coverage::Coverage;
use self::tint::Tint;
use super::{Texels, Texture};
use crate::display::srgb;

/// Rows of the map: a pixel is 0.088° wide, 10 km. Where the Earth fills 1300 pixels, one at its centre
/// is as large.
const HEIGHT: usize = 2048;

impl Texture {
    /// A map of the Earth of 4096 × 2048 pixels, RGB, equirectangular: north up, longitude 0 in the
    /// middle, east to the right. Its light is the share of white light that the ground returns. See
    /// the [module](self) for what is known and what is drawn. The same at every call, which takes
    /// about a second of one core.
    ///
    /// ```
    /// use kerrscope::texture::Texture;
    /// let earth = Texture::earth();
    /// // 30° south, 75° east: the Indian Ocean is blue.
    /// let sea = earth.sample(0.5 + 75.0 / 360.0, 0.5 + 30.0 / 180.0, true).light.rgb;
    /// assert!(sea[2] > 2.0 * sea[0]);
    /// // 23° north, 10° east: the Sahara is not.
    /// let sand = earth.sample(0.5 + 10.0 / 360.0, 0.5 - 23.0 / 180.0, true).light.rgb;
    /// assert!(sand[0] > sand[2]);
    /// ```
    pub fn earth() -> Self {
        map(&Outlines::built_in(), HEIGHT)
    }
}

/// A map of that many rows and twice as many columns.
fn map(outlines: &Outlines, height: usize) -> Texture {
    let width = 2 * height;
    let land = Coverage::land(outlines, height);
    let climate = Climate::new(outlines);
    let tint = Tint::new(&climate);
    let mut codes = vec![0; 3 * width * height];
    codes.par_chunks_mut(3 * width).enumerate().for_each(|(y, row)| {
        for (x, texel) in row.as_chunks_mut().0.iter_mut().enumerate() {
            let [longitude, latitude] = [
                360.0 * (x as f64 + 0.5) / width as f64 - 180.0,
                90.0 - 180.0 * (y as f64 + 0.5) / height as f64,
            ];
            let share = land.share(x, y);
            let ground =
                |on: bool| if on { tint.land(longitude, latitude) } else { tint.sea(longitude, latitude) };
            let color = if share == 0.0 || share == 1.0 {
                ground(share == 1.0)
            } else {
                // A coast: the means of light, not of codes.
                let [land, sea] = [true, false].map(|on| ground(on).map(srgb::decode));
                [0, 1, 2].map(|k| srgb::encode(sea[k] + share * (land[k] - sea[k])))
            };
            *texel = color.map(|c| (255.0 * c).round() as u8);
        }
    });
    Texture { width: width as u32, height: height as u32, channels: 3, texels: Texels::Eight(codes) }
}
