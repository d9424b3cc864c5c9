//! Data layers: what a picture can say of each pixel besides its light.

use std::borrow::Cow;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Image orders that [`Layer::R`], [`Layer::Phi`], [`Layer::T`], [`Layer::G`] and [`Layer::Intensity`] are given for.
pub const ORDERS: u8 = 3;

/// A data layer: a property of the ray through the centre of each pixel. It is not a mean over the
/// pixel's samples: a mean of fates or of angles says nothing. What a ray does not have is NaN.
///
/// Lengths and times are in M, angles in radians, coordinates those of Boyer and Lindquist.
///
/// A ray's crossings of the disk's plane (the equatorial plane if there is no disk) are numbered
/// from n = 0, the first met going back from the camera: the image order. They count whether or
/// not there is something of the disk there.
#[derive(Clone, Copy, Debug, Deserialize, Eq, Hash, JsonSchema, Ord, PartialEq, PartialOrd, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Layer {
    /// How the ray ends: 0 it comes from infinity, 1 from the horizon (no light), 2 it was given up, 3 from a thing. What is
    /// behind a thing is not in the other layers: they have crossings before it only, and no direction.
    Fate,
    /// How often the ray crosses the disk's plane, `render.max_crossings` at most.
    Crossings,
    /// How often light went round the hole: periods of its motion in θ, which without spin is the
    /// angle swept over 2π.
    Windings,
    /// Steps of the integrator.
    Steps,
    /// Estimated error: of the direction where the ray comes from infinity, otherwise of the radius, relative.
    Error,
    /// Radius of crossing n.
    R,
    /// Azimuth of crossing n, unwrapped along the ray.
    Phi,
    /// Coordinate time from crossing n to the camera; for a camera at infinity less
    /// r + 2 ln(r/2) of it.
    T,
    /// Redshift factor ν_camera/ν_emitter of matter at crossing n on a circular geodesic in the
    /// disk's sense; none within the ISCO, nor where the disk's plane holds no such geodesic.
    G,
    /// Physical radiance that a disk which shines by physics sends at crossing n, whatever is in front of it; none beside
    /// it.
    Intensity,
    /// Polar angle of the direction that light comes from.
    SkyTheta,
    /// Azimuth of the direction that light comes from, unwrapped along the ray.
    SkyPhi,
    /// Distance of what is seen of disk or things from the camera, along a straight line in Cartesian
    /// Kerr–Schild coordinates; infinite where the ray meets nothing.
    Depth,
}

/// A layer at one image order: what a plane of numbers holds.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct Channel {
    /// The layer.
    pub layer: Layer,
    /// The image order, for layers that have one.
    pub order: Option<u8>,
}

impl Layer {
    /// Every layer.
    pub const ALL: [Self; 13] = [
        Self::Fate,
        Self::Crossings,
        Self::Windings,
        Self::Steps,
        Self::Error,
        Self::R,
        Self::Phi,
        Self::T,
        Self::G,
        Self::Intensity,
        Self::SkyTheta,
        Self::SkyPhi,
        Self::Depth,
    ];

    /// The word for it in scenes.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Fate => "fate",
            Self::Crossings => "crossings",
            Self::Windings => "windings",
            Self::Steps => "steps",
            Self::Error => "error",
            Self::R => "r",
            Self::Phi => "phi",
            Self::T => "t",
            Self::G => "g",
            Self::Intensity => "intensity",
            Self::SkyTheta => "sky_theta",
            Self::SkyPhi => "sky_phi",
            Self::Depth => "depth",
        }
    }

    /// Whether there is one for each image order.
    pub const fn has_orders(self) -> bool {
        matches!(self, Self::R | Self::Phi | Self::T | Self::G | Self::Intensity)
    }

    /// Its channels.
    pub fn channels(self) -> impl Iterator<Item = Channel> {
        let orders = if self.has_orders() { ORDERS } else { 1 };
        (0..orders).map(move |n| Channel { layer: self, order: self.has_orders().then_some(n) })
    }

    /// The unit of its numbers; empty for pure numbers.
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Fate | Self::Crossings | Self::Windings | Self::Steps | Self::G => "",
            Self::Intensity => "Mdot/M^2 sr-1, or W m-2 Hz-1 sr-1",
            Self::Error => "rad, or relative radius",
            Self::R | Self::T | Self::Depth => "M",
            Self::Phi | Self::SkyTheta | Self::SkyPhi => "rad",
        }
    }

    /// What it is, in a few words.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Fate => "fate",
            Self::Crossings => "crossings of the disk's plane",
            Self::Windings => "windings around the hole",
            Self::Steps => "integration steps",
            Self::Error => "estimated error",
            Self::R => "radius r",
            Self::Phi => "azimuth φ",
            Self::T => "elapsed time t",
            Self::G => "redshift factor g",
            Self::Intensity => "intensity",
            Self::SkyTheta => "polar angle θ of the source",
            Self::SkyPhi => "azimuth φ of the source",
            Self::Depth => "depth",
        }
    }
}

impl Channel {
    /// The name in files: `n0.g` for g at order 0; depth is `Z`, as compositors want it.
    pub fn name(self) -> Cow<'static, str> {
        match (self.layer, self.order) {
            (layer, Some(n)) => format!("n{n}.{}", layer.word()).into(),
            (Layer::Depth, None) => "Z".into(),
            (layer, None) => layer.word().into(),
        }
    }

    /// What it is, in a few words.
    pub fn title(self) -> String {
        let title = self.layer.title();
        self.order.map_or_else(|| title.to_owned(), |n| format!("{title}, image order {n}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_scenes() {
        for layer in Layer::ALL {
            assert_eq!(serde_json::to_value(layer).unwrap(), layer.word());
        }
    }

    #[test]
    fn channels_have_names_of_their_own() {
        let all: Vec<_> = Layer::ALL.into_iter().flat_map(Layer::channels).collect();
        assert_eq!(all.len(), 23);
        let mut names: Vec<_> = all.iter().map(|channel| channel.name()).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all.len());
    }
}
