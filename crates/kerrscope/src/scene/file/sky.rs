//! `[sky]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::sky::Frame;

const COLOR: [f64; 3] = [0.2, 0.34, 0.55];
const HORIZON: [f64; 3] = [1.0; 3];
const ZENITH: [f64; 3] = [0.5, 0.7, 1.0];
const SPACING: f64 = 15.0;
const BRIGHTNESS: f64 = 1.0;
const LONGITUDE: f64 = 180.0;
const ROTATION: [f64; 3] = [0.0; 3];

/// What is seen where light comes from infinity. A key that the kind takes no notice of is a fault,
/// but for "black", which puts a sky away.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sky {
    /// What the sky looks like.
    pub kind: SkyKind,
    /// Colour [red, green, blue] in sRGB: of a "uniform" sky, or of the lines of a "grid"
    /// ([0.2, 0.34, 0.55] if not given), or of a "gradient" at the horizon and below ([1, 1, 1]).
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = 0, max = 1)))]
    pub color: Option<[f64; 3]>,
    /// Colour [red, green, blue] in sRGB of a "gradient" towards +z; [0.5, 0.7, 1] if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = 0, max = 1)))]
    pub zenith: Option<[f64; 3]>,
    /// Factor on the sky's light.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 1e12), extend("default" = BRIGHTNESS))]
    pub brightness: Option<f64>,
    /// Angle between the lines of a "grid" in degrees; divides 90 into equal parts; 15 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1, max = 90))]
    pub spacing: Option<f64>,
    /// Picture file of the whole sky, twice as wide as high, relative to the scene file's
    /// folder; for "panorama", and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub image: Option<String>,
    /// Coordinates of the real sky that stand upright: their north is along +z, and their
    /// longitude 0 (the centre of the Galaxy, or right ascension 0 of J2000) at the azimuth
    /// `longitude`. For "stars", and for a "panorama" that is not drawn in those of the "scene".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Frame", extend("default" = Frame::default()))]
    pub frame: Option<Frame>,
    /// Coordinates that a "panorama" is drawn in, with north at the top, longitude 0 in the middle
    /// and growing to the left; "scene" if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "ImageFrame")]
    pub image_frame: Option<ImageFrame>,
    /// Azimuth in degrees of longitude 0 of `frame`, or of the middle of a "panorama" that is drawn
    /// in the coordinates of the "scene". For "stars" and "panorama".
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = -1e6, max = 1e6), extend("default" = LONGITUDE))]
    pub longitude: Option<f64>,
    /// Angles in degrees by which "stars" or a "panorama" are then turned about the axes x, y and z
    /// of the scene, in this order.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = -1e6, max = 1e6)), extend("default" = ROTATION))]
    pub rotation: Option<[f64; 3]>,
}

/// What a sky looks like.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SkyKind {
    /// Dark.
    Black,
    /// The same everywhere.
    Uniform,
    /// A blue sky: from one colour at the horizon to another at the zenith.
    Gradient,
    /// Lines of equal θ and of equal φ.
    Grid,
    /// The stars of our sky down to magnitude 8, and the Milky Way.
    #[default]
    Stars,
    /// The picture `image`.
    Panorama,
}

/// What coordinates a picture of the sky is drawn in.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ImageFrame {
    /// θ and φ of the scene, but for `longitude` and `rotation`.
    #[default]
    Scene,
    /// Galactic longitude and latitude.
    Galactic,
    /// Right ascension and declination of J2000.
    Equatorial,
}

/// The kinds that take notice of each key, but for `kind` and `brightness`; of `frame` a panorama
/// takes none if it is drawn in the coordinates of the scene.
pub(in crate::scene) const USES: [(&str, &[SkyKind]); 8] = [
    ("color", &[SkyKind::Uniform, SkyKind::Gradient, SkyKind::Grid]),
    ("zenith", &[SkyKind::Gradient]),
    ("spacing", &[SkyKind::Grid]),
    ("image", &[SkyKind::Panorama]),
    ("frame", &[SkyKind::Stars, SkyKind::Panorama]),
    ("image_frame", &[SkyKind::Panorama]),
    ("longitude", &[SkyKind::Stars, SkyKind::Panorama]),
    ("rotation", &[SkyKind::Stars, SkyKind::Panorama]),
];

impl Sky {
    pub(super) fn complete(&self) -> Self {
        let kind = self.kind;
        if kind == SkyKind::Black {
            // A sky that is put away.
            return Self { kind, ..Self::default() };
        }
        let uses = |key| USES.iter().any(|(k, kinds)| *k == key && kinds.contains(&kind));
        let color = if kind == SkyKind::Gradient { HORIZON } else { COLOR };
        let image_frame = self.image_frame.or(uses("image_frame").then(ImageFrame::default));
        let framed = uses("frame") && image_frame != Some(ImageFrame::Scene);
        Self {
            kind,
            color: self.color.or(uses("color").then_some(color)),
            zenith: self.zenith.or(uses("zenith").then_some(ZENITH)),
            brightness: self.brightness.or(Some(BRIGHTNESS)),
            spacing: self.spacing.or(uses("spacing").then_some(SPACING)),
            image: self.image.clone(),
            frame: self.frame.or(framed.then(Frame::default)),
            image_frame,
            longitude: self.longitude.or(uses("longitude").then_some(LONGITUDE)),
            rotation: self.rotation.or(uses("rotation").then_some(ROTATION)),
        }
    }
}
