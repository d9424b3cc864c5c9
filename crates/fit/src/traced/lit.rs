//! What is lit of a picture: the share of each pixel that light of a disk comes from, of any image order.

use super::matter::Profile;
use super::picture::{Fineness, Painter, Setting};
use super::screen::Projection;
use super::source::{Disk, Kind};
use crate::model::{Cancelled, Freedom, Parameter, Prediction, Source, Unpredictable};
use crate::prior::Prior;
use crate::silhouette::{Bins, bent};

/// How what is lit is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outline {
    /// What a pixel is: places and scale are those of the picture, shares are of squares of its pixels.
    pub bins: Bins,
    /// Whether the disk reaches beyond the picture, unless something else is said.
    pub open: bool,
    /// Image orders that are bright enough to be seen; all if not said.
    pub orders: Option<usize>,
}

impl Outline {
    /// So fine, with no more image orders.
    pub fn fineness(&self, fineness: Fineness) -> Fineness {
        Fineness {
            orders: self.orders.map_or(fineness.orders, |orders| fineness.orders.min(orders)),
            ..fineness
        }
    }
}

/// A disk that is lit evenly.
#[derive(Debug)]
pub struct Lit {
    outline: Outline,
    projection: Projection,
    painter: Painter,
}

/// What a tone curve has left is small where the curve itself is known about: standard deviation of ln K.
const LEFT: f64 = 0.5;

/// Its largest size.
const MOST: f64 = 3.0;

/// Parameters from the first to the outer radius; then `tone`.
const TONE: usize = 9;

impl Lit {
    /// On such pixels.
    pub fn new(outline: Outline, projection: Projection, fineness: Fineness) -> Self {
        Self { outline, projection, painter: Painter::new(projection, true, outline.fineness(fineness)) }
    }
}

impl Source for Lit {
    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters =
            Disk::new(Kind::PageThorne, true, self.projection, Fineness::SKETCH).parameters();
        for parameter in &mut parameters {
            match parameter.name {
                "inner" => {
                    *parameter = Parameter {
                        unit: "",
                        meaning: "inner radius: 0 at the horizon, 1 at the last stable orbit, straight between and beyond",
                        bounds: [0.0, 50.0],
                        ..parameter.clone()
                    }
                }
                "outer" if !self.outline.open => {
                    parameter.usual = Freedom::Free(Prior::LogUniform(1.5, 1000.0));
                }
                _ => {}
            }
        }
        parameters.push(Parameter {
            name: "tone",
            unit: "",
            meaning: "ln K of a tone curve by which shares c seem to be K c/(1 + (K − 1) c), besides what was found from the edges alone",
            bounds: [-MOST, MOST],
            pixels: 0,
            usual: Freedom::Free(Prior::Normal(0.0, LEFT)),
        });
        parameters
    }

    fn draw(&self, values: &[f64], size: [usize; 2], derivatives: bool) -> Result<Prediction, Unpredictable> {
        let [spin, inclination, position_angle, scale, x, y, distance, inner, outer, tone] = values[..]
        else {
            return Err(Unpredictable("as many parameters".to_owned()));
        };
        let Bins { factor, shift } = self.outline.bins;
        let [x, y] = [(x - shift[0]) / factor, (y - shift[1]) / factor];
        let binned = [inclination, position_angle, scale * factor, x, y, distance, inner, outer];
        let setting = Setting::of(spin, binned, Profile::Even, size);
        let unseen = |_| {
            Unpredictable(format!(
                "a disk around a hole of spin {spin:.4}, seen from {inclination:.3}°, {distance} M away, {scale:.4} M a pixel"
            ))
        };
        let canvas = self.painter.draw(&setting, derivatives).map_err(unseen)?;
        let shares: Vec<f64> = canvas.pixels().iter().map(|pixel| pixel[0].clamp(0.0, 1.0)).collect();
        if canvas.pixels().iter().any(|pixel| !pixel[0].is_finite()) {
            return Err(unseen(super::Unseen));
        }
        if shares.iter().all(|share| *share == 0.0) {
            return Err(Unpredictable("light that is all outside of the picture".to_owned()));
        }
        let bend = tone.exp();
        let mut prediction = Prediction {
            values: shares.iter().map(|share| bent(*share, bend)).collect(),
            derivatives: vec![],
        };
        if derivatives {
            let degree = 1f64.to_radians();
            // Channels and factors in the order of the parameters.
            let channels = [
                (1, 1.0),
                (2, degree),
                (10, degree),
                (7, factor),
                (8, factor.recip()),
                (9, factor.recip()),
                (3, -distance.powi(-2)),
                (4, 1.0),
                (5, 1.0),
            ];
            // dy/dc = K/(1 + (K − 1) c)².
            let slope = |share: f64| bend / (1.0 + (bend - 1.0) * share).powi(2);
            for (channel, factor) in channels {
                let both = canvas.pixels().iter().zip(&shares);
                prediction
                    .derivatives
                    .push(both.map(|(pixel, share)| factor * slope(*share) * pixel[channel]).collect());
            }
            debug_assert_eq!(prediction.derivatives.len(), TONE);
            prediction.derivatives.push(prediction.values.iter().map(|y| y * (1.0 - y)).collect());
        }
        Ok(prediction)
    }

    /// None: a silhouette's are found with what is known of its parameters.
    fn starts(&self, _: &[f64], _: [usize; 2], _: Cancelled<'_>) -> Vec<Vec<f64>> {
        Vec::new()
    }

    fn finished(&self) -> bool {
        true
    }
}
