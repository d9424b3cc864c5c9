//! Data layers in false colours.

use std::f64::consts::TAU;

use super::chart::{Chart, ChartFault, Key, Scale};
use super::{Colormap, Picture};
use crate::render::{Channel, Film, Layer};

/// How a data layer is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FalseColor {
    /// What is shown.
    pub channel: Channel,
    /// The colours; none for those that suit it.
    pub colormap: Option<Colormap>,
    /// The values at the ends of the colours; none for nearly all that there are.
    pub range: Option<[f64; 2]>,
    /// Whether there is a legend below the picture.
    pub legend: bool,
}

impl FalseColor {
    /// How numbers of a layer are laid along colours.
    pub fn scale(layer: Layer) -> Scale {
        match layer {
            Layer::Fate => {
                let fates = [
                    (0.0, "from infinity"),
                    (1.0, "from the horizon"),
                    (2.0, "given up"),
                    (3.0, "from a thing"),
                ];
                Scale::Categories(fates.map(|(value, name)| (value, name.to_owned())).to_vec())
            }
            Layer::Error | Layer::R | Layer::Depth => Scale::Logarithmic,
            Layer::Phi | Layer::SkyPhi => Scale::Cyclic { period: TAU },
            Layer::Crossings
            | Layer::Windings
            | Layer::Steps
            | Layer::T
            | Layer::G
            | Layer::Intensity
            | Layer::SkyTheta => Scale::Linear,
        }
    }

    /// Whether the range can be shown.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check(&self) -> Result<(), ChartFault> {
        self.range.map_or(Ok(()), |range| Self::scale(self.channel.layer).check_range(range))
    }

    fn chart(&self) -> Chart {
        let Channel { layer, .. } = self.channel;
        let plain = Chart::new(self.channel.title(), layer.unit(), Self::scale(layer));
        let colormap = self.colormap.unwrap_or(plain.colormap);
        Chart { range: self.range, colormap, legend: self.legend, ..plain }
    }

    /// What the colours of the layer of a film mean.
    pub fn key(&self, film: &Film) -> Key {
        self.chart().key(film.plane(self.channel).map_or(&[][..], |plane| &plane.values))
    }

    /// The layer of a film that has it, as a picture; dark if it has not.
    pub fn develop(&self, film: &Film) -> Picture {
        let values = film.plane(self.channel).map_or(&[][..], |plane| &plane.values);
        self.chart().draw(values, film.width, film.height).unwrap_or_else(|_| Picture {
            width: film.width,
            height: film.height,
            pixels: vec![[0.0; 3]; film.light.len()],
        })
    }
}
