//! `[render]` and `[camera.display]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::display::{Colormap, Tone};
use crate::render::Layer;
use crate::scene::{Engine, Method};

/// The step of "rk4" if none is given.
pub(in crate::scene) const RK4_STEP: f64 = 0.1;

/// How finely and how exactly the picture is computed.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Render {
    /// Width of the picture in pixels.
    #[schemars(range(min = 1, max = 16384))]
    pub width: u32,
    /// Height of the picture in pixels.
    #[schemars(range(min = 1, max = 16384))]
    pub height: u32,
    /// Rays in each pixel. width × height × samples is at most 2³⁶.
    #[schemars(range(min = 1, max = 65536))]
    pub samples: u32,
    /// Chooses where in the pixels the rays lie.
    #[schemars(range(min = 0, max = 9223372036854775807_i64))]
    pub seed: u64,
    /// Whether rays are spread over the pixel by chance; if not, they lie on a regular grid.
    pub jitter: bool,
    /// What traces the rays.
    pub engine: Engine,
    /// Which method integrates the rays.
    pub method: Method,
    /// About the error of a ray's direction in radians that "dop853" and "tsit5" allow, away from the
    /// critical curve.
    #[schemars(range(min = 1e-14, max = 1e-2))]
    pub tolerance: f64,
    /// Step of affine parameter, which far from the hole is a length in M; for "rk4", 0.1 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(max = 1e3), extend("exclusiveMinimum" = 0))]
    pub step: Option<f64>,
    /// Steps after which a ray is given up.
    #[schemars(range(min = 1, max = 1_000_000))]
    pub max_steps: u32,
    /// Crossings of the disk's plane that count, the first met going back from the camera; what lies
    /// behind is seen through the rest.
    #[schemars(range(min = 1, max = 64))]
    pub max_crossings: u32,
    /// How often light is scattered or reflected by things at most; what has been on a longer way is missing.
    #[schemars(range(min = 0, max = 1000))]
    pub bounces: u32,
    /// In a scene with things, whether light carries its shift: from leg to leg of its way, its radiance changes by
    /// (ν received/ν sent)⁴. Without it, as in the thesis, surfaces look alike wherever they are and however they move. The
    /// disk's light is as it is drawn either way.
    pub shifts: bool,
    /// Whether rays are traced where they are needed and what lies between is interpolated; without it,
    /// where that pays. Data layers are always traced.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "bool")]
    pub adaptive: Option<bool>,
    /// Largest error that interpolation shall make: of the radius of a crossing, relative; of its azimuth
    /// and of the direction on the sky, in radians.
    #[schemars(range(min = 1e-10, max = 1e-2))]
    pub adaptive_error: f64,
    /// Data layers to compute beside the light, of the rays through the pixels' centres; EXR files
    /// hold them.
    #[schemars(length(max = 13))]
    pub layers: Vec<Layer>,
}

impl Default for Render {
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            samples: 4,
            seed: 1,
            jitter: true,
            engine: Engine::default(),
            method: Method::default(),
            tolerance: 1e-8,
            step: None,
            max_steps: 10_000,
            max_crossings: 8,
            bounces: 50,
            shifts: true,
            adaptive: None,
            adaptive_error: 1e-4,
            layers: Vec::new(),
        }
    }
}

impl Render {
    pub(super) fn complete(&self) -> Self {
        let default = (self.method == Method::Rk4).then_some(RK4_STEP);
        Self { step: self.step.or(default), ..self.clone() }
    }
}

/// How light becomes a picture.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Camera {
    /// How linear light is shown on a screen.
    pub display: Display,
}

/// How linear light is shown on a screen.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Display {
    /// Stops by which the picture is brightened; each doubles the light.
    #[schemars(range(min = -30, max = 30))]
    pub exposure: f64,
    /// How light brighter than the screen is brought down to it.
    pub tone: Tone,
    /// Bits of a colour channel in the picture file, 8 or 16.
    #[schemars(extend("enum" = [8, 16]))]
    pub bits: u8,
    /// Data layer to show in false colours instead of the light.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Layer")]
    pub layer: Option<Layer>,
    /// Image order of the layer, for "r", "phi", "t" and "g"; 0 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u8", range(max = 2))]
    pub order: Option<u8>,
    /// Colours of the layer; without it, those that suit it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Colormap")]
    pub colormap: Option<Colormap>,
    /// Values [low, high] at the ends of the colours; without it, nearly all that there are.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 2]")]
    pub range: Option<[f64; 2]>,
    /// Whether there is a legend below the picture of a layer; true if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "bool")]
    pub legend: Option<bool>,
}

impl Default for Display {
    fn default() -> Self {
        Self {
            exposure: 0.0,
            tone: Tone::default(),
            bits: 8,
            layer: None,
            order: None,
            colormap: None,
            range: None,
            legend: None,
        }
    }
}
