//! What a picture is a function of.

use thiserror::Error;

use crate::prior::Prior;

/// A parameter of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name in files and reports.
    pub name: &'static str,
    /// Its unit, empty for a number.
    pub unit: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// The least and the largest value that it may have; infinite where there is none.
    pub bounds: [f64; 2],
    /// The power with which it goes with the number of pixels in a length: 1 for a length in pixels, −1 for one per pixel.
    pub pixels: i32,
    /// What is assumed of it unless something else is asked for.
    pub usual: Freedom,
}

/// Whether a parameter is looked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Freedom {
    /// Its value is known.
    Fixed(f64),
    /// It is not.
    Free(Prior),
}

/// A picture and its derivatives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prediction {
    /// Mean over each pixel, along the rows, the top one first.
    pub values: Vec<f64>,
    /// The same of the derivative with respect to each parameter, in their order; empty if not asked for.
    pub derivatives: Vec<Vec<f64>>,
}

/// Parameters of which there is no picture.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("no picture can be made of {0}")]
pub struct Unpredictable(pub String);

/// Whether to stop: what is found from then on counts nothing.
pub type Cancelled<'a> = &'a (dyn Fn() -> bool + Sync);

/// Light, as a function of parameters among which are those of where the picture is.
pub trait Source: Send + Sync {
    /// Its parameters. Those called `center_x` and `center_y` are in pixels from the middle of the picture, to the right and up.
    fn parameters(&self) -> Vec<Parameter>;

    /// The picture of a width and a height in pixels.
    ///
    /// # Errors
    /// If there is none.
    fn draw(&self, values: &[f64], size: [usize; 2], derivatives: bool) -> Result<Prediction, Unpredictable>;

    /// Parameters of which one may be near those of a picture, the likeliest first.
    fn starts(&self, values: &[f64], size: [usize; 2], cancelled: Cancelled<'_>) -> Vec<Vec<f64>>;

    /// Whether its picture is compared as it is, without blur, flux and background.
    fn finished(&self) -> bool {
        false
    }
}

impl<S: Source + ?Sized> Source for Box<S> {
    fn parameters(&self) -> Vec<Parameter> {
        (**self).parameters()
    }

    fn draw(&self, values: &[f64], size: [usize; 2], derivatives: bool) -> Result<Prediction, Unpredictable> {
        (**self).draw(values, size, derivatives)
    }

    fn starts(&self, values: &[f64], size: [usize; 2], cancelled: Cancelled<'_>) -> Vec<Vec<f64>> {
        (**self).starts(values, size, cancelled)
    }

    fn finished(&self) -> bool {
        (**self).finished()
    }
}
