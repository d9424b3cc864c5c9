//! What all pictures have, whatever the light: blur, flux and background.
//!
//! ```text
//! picture = flux · (blurred light)/(its sum over the picture) + background
//! ```

use crate::blur::Kernel;
use crate::model::{Freedom, Parameter, Prediction, Source, Unpredictable};
use crate::prior::Prior;

/// How many parameters every picture has besides those of its light: `blur`, `flux` and `background`, in this order.
pub const COMMON: usize = 3;

/// A picture of light.
pub struct Observed<S> {
    source: S,
    size: [usize; 2],
    parameters: Vec<Parameter>,
}

impl<S: Source> Observed<S> {
    /// Of a width and a height in pixels.
    pub fn new(source: S, size: [usize; 2]) -> Self {
        let mut parameters = source.parameters();
        if !source.finished() {
            parameters.extend(common(size));
        }
        Self { source, size, parameters }
    }

    /// The light.
    pub fn source(&self) -> &S {
        &self.source
    }

    /// Those of the light, then `blur`, `flux` and `background`, unless the source is finished.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The picture.
    ///
    /// # Errors
    /// If there is none.
    pub fn predict(&self, values: &[f64], derivatives: bool) -> Result<Prediction, Unpredictable> {
        if self.source.finished() {
            return self.source.draw(values, self.size, derivatives);
        }
        let (own, common) = values.split_at(values.len() - COMMON);
        let [width, flux, background] = [common[0], common[1], common[2]];
        let margin = Kernel::margin(width);
        let large = [self.size[0] + 2 * margin, self.size[1] + 2 * margin];
        let light = self.source.draw(own, large, derivatives)?;
        let kernel = Kernel::new(width);
        let shape = kernel.apply(&light.values, self.size, margin);
        let sum: f64 = shape.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return Err(Unpredictable("light that is all outside of the picture".to_owned()));
        }
        let share = flux / sum;
        let mut prediction = Prediction {
            values: shape.iter().map(|value| share * value + background).collect(),
            derivatives: Vec::new(),
        };
        if derivatives {
            // d(flux · s/Σs) = share · (ds − s Σds/Σs).
            let normal = |mut changed: Vec<f64>| {
                let change = changed.iter().sum::<f64>() / sum;
                changed.iter_mut().zip(&shape).for_each(|(c, s)| *c = share * (*c - s * change));
                changed
            };
            for derivative in &light.derivatives {
                prediction.derivatives.push(normal(kernel.apply(derivative, self.size, margin)));
            }
            prediction.derivatives.push(normal(kernel.apply_slope(&light.values, self.size, margin)));
            prediction.derivatives.push(shape.iter().map(|value| value / sum).collect());
            prediction.derivatives.push(vec![1.0; shape.len()]);
        }
        Ok(prediction)
    }
}

fn common([width, height]: [usize; 2]) -> [Parameter; COMMON] {
    let most = 0.5 * width.max(height) as f64;
    [
        Parameter {
            name: "blur",
            unit: "px",
            meaning: "full width at half maximum of a round Gaussian",
            bounds: [0.0, most],
            pixels: 1,
            usual: Freedom::Fixed(0.0),
        },
        Parameter {
            name: "flux",
            unit: "",
            meaning: "sum of the light over the picture's pixels, the background left out",
            bounds: [f64::NEG_INFINITY, f64::INFINITY],
            pixels: 2,
            usual: Freedom::Free(Prior::Uniform(f64::NEG_INFINITY, f64::INFINITY)),
        },
        Parameter {
            name: "background",
            unit: "",
            meaning: "what every pixel has besides",
            bounds: [f64::NEG_INFINITY, f64::INFINITY],
            pixels: 0,
            usual: Freedom::Fixed(0.0),
        },
    ]
}
