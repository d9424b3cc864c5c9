//! Charts: a plane of numbers as a picture, with a legend.
//!
//! A [`Chart`] says what the numbers are; [`Chart::draw`] lays them along a [`Colormap`] by their
//! [`Scale`]. A legend is a strip below the picture, of the same width, so that the picture's own pixels
//! stay where they are: the title, a bar of the colours with its [ticks](Scale::ticks), or a box for each
//! category. A bar's end is pointed where values lie beyond it; these have the colour of the end. "No
//! value" is dark grey, [`NO_VALUE`], and has a box of its own where it occurs. Words that are longer than
//! a line are cut short, and what does not fit is left out: below some forty pixels the words, below ten
//! the whole legend.
//!
//! ```
//! use kerrscope::display::chart::{Chart, Scale};
//! use kerrscope::display::{Colormap, NO_VALUE};
//!
//! // How far light from each pixel of a row is shifted; the last one sees the hole.
//! let values = [0.25, 0.5, 0.75, 1.0, 1.25, f32::NAN];
//! let chart = Chart { range: Some([0.25, 1.25]), ..Chart::new("redshift factor g", "", Scale::Linear) };
//! let picture = chart.draw(&values, 6, 1)?;
//! assert_eq!(picture.pixels[0], Colormap::Viridis.color(0.0).map(|c| c as f32));
//! assert_eq!(picture.pixels[5], NO_VALUE.map(|c| c as f32));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bar;
mod canvas;
mod error;
mod key;
mod legend;
mod round;
mod scale;
mod text;
mod ticks;

pub use error::{ChartError, ChartFault};
pub use key::Key;
pub use scale::Scale;
pub use ticks::Tick;

use super::{Colormap, NO_VALUE, Picture};
use rayon::prelude::*;

/// What a plane of numbers is, and how it is shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What the numbers are, such as "redshift factor g". Lines of a legend break at spaces, but not at
    /// those that Unicode calls no-break.
    pub title: String,
    /// Their unit, such as "M" or "rad"; empty for none. It stands in brackets behind the title.
    pub unit: String,
    /// What kind of numbers they are.
    pub scale: Scale,
    /// The values at the ends of the colour map; none for those of [`Scale::value_range`]. That of a cyclic
    /// scale is one period long.
    pub range: Option<[f64; 2]>,
    /// The colours.
    pub colormap: Colormap,
    /// Whether there is a legend below the picture.
    pub legend: bool,
}

/// What a legend has to tell of, besides the range.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    no_value: bool,
    /// Values below the range, and above it.
    beyond: [bool; 2],
}

impl Chart {
    /// A chart in the colours that suit the scale, over the range of the values, with a legend.
    pub fn new(title: impl Into<String>, unit: impl Into<String>, scale: Scale) -> Self {
        let colormap = scale.colormap();
        Self { title: title.into(), unit: unit.into(), scale, range: None, colormap, legend: true }
    }

    /// Draws the values of the pixels, along the rows, the top row first.
    ///
    /// ```
    /// use kerrscope::display::chart::{Chart, Scale};
    /// let chart = Chart::new("winding", "", Scale::Linear);
    /// let fault = chart.draw(&[1.0, 2.0, 3.0], 2, 2).unwrap_err();
    /// assert_eq!(
    ///     fault.to_string(),
    ///     "cannot draw a chart: 2 × 2 pixels were given 3 values; give one value for each pixel, and at \
    ///      least one pixel"
    /// );
    /// ```
    ///
    /// # Errors
    /// When there are not `width` × `height` values, or none, and when the range or the period cannot be
    /// shown.
    pub fn draw(&self, values: &[f32], width: u32, height: u32) -> Result<Picture, ChartError> {
        self.check(values.len(), width, height).map_err(|fault| ChartError { fault })?;
        let range = self.range.or_else(|| self.scale.value_range(values));
        let mut pixels: Vec<[f32; 3]> =
            values.par_iter().map(|value| self.color(range, *value).map(|c| c as f32)).collect();
        if self.legend
            && let Ok(width) = i32::try_from(width)
        {
            let seen = self.look(range, values);
            pixels.append(&mut legend::draw(self, range, seen, width).pixels);
        }
        let height = (pixels.len() / width as usize) as u32;
        Ok(Picture { width, height, pixels })
    }

    fn check(&self, values: usize, width: u32, height: u32) -> Result<(), ChartFault> {
        let area = u64::from(width) * u64::from(height);
        if area == 0 || area != values as u64 {
            return Err(ChartFault::Size { width, height, values });
        }
        self.scale.check_period()?;
        self.range.map_or(Ok(()), |range| self.scale.check_range(range))
    }

    fn color(&self, range: Option<[f64; 2]>, value: f32) -> [f64; 3] {
        let place = match (&self.scale, range) {
            (Scale::Categories(_), _) => self.scale.position([0.0, 1.0], f64::from(value)),
            (_, Some(range)) => self.scale.position(range, f64::from(value)),
            (_, None) => None,
        };
        place.map_or(NO_VALUE, |t| self.colormap.color(t))
    }

    fn look(&self, range: Option<[f64; 2]>, values: &[f32]) -> Seen {
        let ends = range.unwrap_or([0.0, 1.0]);
        let bounded = matches!(self.scale, Scale::Linear | Scale::Logarithmic);
        // An end that is not a number of 32 bits was not meant to leave out its neighbour.
        let [low, high] = ends.map(|end| end as f32);
        let look = |value: &f32| {
            let place = self.scale.position(ends, f64::from(*value));
            let beyond = [*value < low, *value > high].map(|beyond| beyond && bounded && place.is_some());
            Seen { no_value: place.is_none(), beyond }
        };
        values.par_iter().map(look).reduce(Seen::default, |a, b| Seen {
            no_value: a.no_value || b.no_value,
            beyond: [a.beyond[0] || b.beyond[0], a.beyond[1] || b.beyond[1]],
        })
    }
}
