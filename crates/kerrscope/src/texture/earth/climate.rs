//! A drawn climate: warmth, moisture and ice by latitude, prevailing winds and distance from the sea.
//!
//! Over the sea, air takes up moisture; over land it loses it. With s the way along a parallel in
//! degrees of arc, from 0 (dry) to 1 (moist):
//!
//! ```text
//! dm/ds = (1 − m) / 9°   over the sea        dm/ds = −m / 18°   over land
//! ```
//!
//! Near the equator forests give it back, so that it reaches three times as far. Trade winds bring it from
//! the east, the westerlies of the middle latitudes from the west. Where air rises (near the equator) it
//! rains more than where it sinks (at 25°). All numbers are chosen by eye so that deserts and forests come
//! to lie about where they are; [`EXCEPTIONS`] names places where mountains and monsoons, which are not in
//! this, make it otherwise.

use super::coverage::Coverage;
use super::outline::Outlines;
use crate::noise::{lerp, smooth};

/// Rows of the maps of the climate: half a degree each.
const HEIGHT: usize = 360;
const WIDTH: usize = 2 * HEIGHT;

/// Degrees of arc after which air over the sea lacks 1/e of the moisture that it lacked, and after which
/// air over land has 1/e of what it had, away from the equator.
const UPTAKE: f64 = 9.0;
const RAINOUT: f64 = 18.0;

/// Where the ground is wetter or drier than rules make it: longitude and latitude of the middle, radius in
/// degrees of arc, and how much.
const EXCEPTIONS: [([f64; 2], f64, f64); 11] = [
    ([46.0, 6.0], 7.0, -0.75),    // Horn of Africa: winds along the coast
    ([-40.0, -9.5], 4.5, -0.35),  // Caatinga
    ([-68.5, -45.0], 5.0, -0.55), // Patagonia: behind the Andes
    ([71.0, 27.0], 4.5, -0.35),   // Thar
    ([87.0, 33.5], 6.0, -0.3),    // Tibet: behind the Himalaya
    ([-112.0, 37.0], 6.0, -0.25), // Great Basin: behind the Sierra Nevada
    ([84.0, 24.0], 9.0, 0.75),    // the monsoon of India
    ([112.0, 29.0], 9.0, 0.4),    // and of China
    ([-62.0, -5.0], 11.0, 0.3),   // Amazonia
    ([-56.0, -25.0], 8.0, 0.3),   // what turns south before the Andes
    ([-86.0, 36.0], 9.0, 0.3),    // what the Gulf of Mexico sends north
];

/// A place in Greenland.
const GREENLAND: [f64; 2] = [-40.0, 72.0];

/// South of it, land is Antarctica, and all of it ice.
const ANTARCTIC: f64 = -60.0;

/// Numbers on an equirectangular map, longitude −180° at the left edge, north up.
#[derive(Clone)]
struct Field(Vec<f64>);

/// The drawn climate of the Earth.
pub(super) struct Climate {
    /// Share of land near by.
    near_land: Field,
    /// Wetness of the ground, 0 desert, 1 forest; beyond these too.
    wetness: Field,
    /// The mean temperature of the year in °C, about.
    temperature: Field,
    /// Share of Greenland near by.
    ice_sheet: Field,
}

impl Climate {
    pub(super) fn new(outlines: &Outlines) -> Self {
        let land = Field::of(&Coverage::land(outlines, HEIGHT));
        let greenland = outlines.land.iter().find(|ring| ring.contains(GREENLAND[0], GREENLAND[1]));
        let ice = greenland.map_or_else(
            || Field(vec![0.0; WIDTH * HEIGHT]),
            |ring| Field::of(&Coverage::of(ring.clone(), HEIGHT)),
        );
        let [easterly, westerly] = [true, false].map(|from_east| carried(&land, from_east).smoothed(2.5));
        let (mut wetness, mut temperature) = (westerly.clone(), westerly.clone());
        for at in 0..WIDTH * HEIGHT {
            let latitude = latitude(at / WIDTH);
            let (sin, degrees) = (latitude.to_radians().sin(), latitude.abs());
            // The trade winds end at 22° to 38°. Cyclones bring moisture from the east beyond.
            let share = lerp(1.0, 0.4, smooth((degrees - 22.0) / 16.0));
            let moisture = lerp(westerly.0[at], easterly.0[at], share);
            let rain = (-(latitude / 14.0).powi(2)).exp() + 0.95 * smooth((degrees - 27.0) / 22.0);
            wetness.0[at] = 0.5 * rain + 1.1 * moisture - 0.35 + exception(longitude(at % WIDTH), latitude);
            // West winds from the sea are mild, in middle latitudes.
            let mild = (-((degrees - 57.0) / 13.0).powi(2)).exp() * (westerly.0[at] - 0.4);
            temperature.0[at] = 28.0 - 46.0 * sin * sin + 12.0 * mild;
        }
        Self { near_land: land.smoothed(0.9), wetness, temperature, ice_sheet: ice.smoothed(0.6) }
    }

    /// The share of land within a degree or so of a place in degrees, 0 to 1.
    pub(super) fn near_land(&self, longitude: f64, latitude: f64) -> f64 {
        self.near_land.at(longitude, latitude)
    }

    /// How wet the ground is: 0 desert, 1 forest; beyond these too.
    pub(super) fn wetness(&self, longitude: f64, latitude: f64) -> f64 {
        self.wetness.at(longitude, latitude)
    }

    /// The mean temperature of the year in °C, about.
    pub(super) fn temperature(&self, longitude: f64, latitude: f64) -> f64 {
        self.temperature.at(longitude, latitude)
    }

    /// The share of ice sheets within a degree or so, 0 to 1.
    pub(super) fn ice_sheet(&self, longitude: f64, latitude: f64) -> f64 {
        if latitude < ANTARCTIC { 1.0 } else { self.ice_sheet.at(longitude, latitude) }
    }
}

/// Moisture that the wind carries along parallels.
fn carried(land: &Field, from_east: bool) -> Field {
    let mut field = Field(vec![0.0; WIDTH * HEIGHT]);
    for y in 0..HEIGHT {
        let step = latitude(y).to_radians().cos() * 180.0 / HEIGHT as f64;
        let rainout = RAINOUT * (1.0 + 2.0 * (-(latitude(y) / 11.0).powi(2)).exp());
        let mut moisture = 0.5;
        // Twice around, so that it does not matter where it starts.
        for k in 0..2 * WIDTH {
            let at = y * WIDTH + if from_east { WIDTH - 1 - k % WIDTH } else { k % WIDTH };
            let share = land.0[at];
            moisture += step * ((1.0 - share) * (1.0 - moisture) / UPTAKE - share * moisture / rainout);
            field.0[at] = moisture;
        }
    }
    field
}

/// Latitude of a row's middle in degrees.
fn latitude(y: usize) -> f64 {
    90.0 - 180.0 * (y as f64 + 0.5) / HEIGHT as f64
}

/// Longitude of a column's middle in degrees.
fn longitude(x: usize) -> f64 {
    360.0 * (x as f64 + 0.5) / WIDTH as f64 - 180.0
}

/// How much wetter than by rule a place in degrees is.
fn exception(longitude: f64, latitude: f64) -> f64 {
    let place = unit(longitude, latitude);
    let from = |&([east, north], radius, change): &([f64; 2], f64, f64)| {
        let middle = unit(east, north);
        let chord = (0..3).map(|k| (place[k] - middle[k]).powi(2)).sum::<f64>();
        change * (-chord / radius.to_radians().powi(2)).exp()
    };
    EXCEPTIONS.iter().map(from).sum()
}

/// The unit vector to a place in degrees.
pub(super) fn unit(longitude: f64, latitude: f64) -> [f64; 3] {
    let ((east, ahead), (up, out)) = (longitude.to_radians().sin_cos(), latitude.to_radians().sin_cos());
    [out * ahead, out * east, up]
}

impl Field {
    fn of(coverage: &Coverage) -> Self {
        Self((0..WIDTH * HEIGHT).map(|at| coverage.share(at % WIDTH, at / WIDTH)).collect())
    }

    /// Interpolated between the four nearest samples.
    fn at(&self, longitude: f64, latitude: f64) -> f64 {
        let per_degree = HEIGHT as f64 / 180.0;
        // Once around more, so that it is not below 0.
        let x = (longitude + 180.0) * per_degree - 0.5 + WIDTH as f64;
        let y = ((90.0 - latitude) * per_degree - 0.5).clamp(0.0, (HEIGHT - 1) as f64);
        let (i, j) = (x as usize, y as usize);
        let (left, right) = (i % WIDTH, (i + 1) % WIDTH);
        let row = |j: usize| lerp(self.0[j * WIDTH + left], self.0[j * WIDTH + right], x - i as f64);
        lerp(row(j), row((j + 1).min(HEIGHT - 1)), y - j as f64)
    }

    /// Smoothed with a Gaussian of a standard deviation in degrees, along meridians, then along
    /// parallels, there as far as they are apart; near the poles at most a quarter of the way around.
    fn smoothed(&self, degrees: f64) -> Self {
        let cells = degrees * HEIGHT as f64 / 180.0;
        let mut along = self.clone();
        let weights = gaussian(cells);
        for at in 0..WIDTH * HEIGHT {
            let (x, y) = (at % WIDTH, at / WIDTH);
            let row = |y: usize| self.0[y * WIDTH + x];
            along.0[at] =
                weighted(&weights, row(y), |k| row(y.saturating_sub(k)) + row((y + k).min(HEIGHT - 1)));
        }
        let mut around = along.clone();
        for y in 0..HEIGHT {
            let line = &along.0[y * WIDTH..(y + 1) * WIDTH];
            let weights = gaussian((cells / latitude(y).to_radians().cos()).min(WIDTH as f64 / 12.0));
            for x in 0..WIDTH {
                around.0[y * WIDTH + x] =
                    weighted(&weights, line[x], |k| line[(x + WIDTH - k) % WIDTH] + line[(x + k) % WIDTH]);
            }
        }
        around
    }
}

/// Weights of what is 0, 1, 2, … cells away, to both sides 1 together.
fn gaussian(cells: f64) -> Vec<f64> {
    let bell = |k: f64| (-0.5 * (k / cells).powi(2)).exp();
    let weights: Vec<f64> = (0..=(3.0 * cells).ceil() as usize).map(|k| bell(k as f64)).collect();
    let sum = 2.0 * weights.iter().sum::<f64>() - 1.0;
    weights.into_iter().map(|w| w / sum).collect()
}

/// The weighted sum of a number and of the two that are 1, 2, … cells away from it.
fn weighted(weights: &[f64], middle: f64, two: impl Fn(usize) -> f64) -> f64 {
    (1..).zip(&weights[1..]).fold(weights[0] * middle, |sum, (k, weight)| sum + weight * two(k))
}
