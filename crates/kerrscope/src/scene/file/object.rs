//! `[[object]]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::material::Finish;

const COLOR: [f64; 3] = [0.8, 0.8, 0.8];
const WHITE: [f64; 3] = [1.0; 3];
const SECOND: [f64; 3] = [0.1, 0.1, 0.1];
const NORMAL: [f64; 3] = [0.0, 0.0, 1.0];
const ROTATION: [f64; 3] = [0.0; 3];
const SQUARES: [u32; 2] = [8, 4];
const SIZE: f64 = 1.0;

/// A thing in the scene, as a surface that is seen from both sides; its place is given in Kerr–Schild Cartesian
/// coordinates, in M, and all of it is outside of 1.1 horizon radii. A key that its shape or its material takes no notice
/// of is a fault.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Object {
    /// Its shape.
    pub shape: ShapeName,
    /// Place [x, y, z] of the middle of a "sphere" or an "annulus", and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = -1e9, max = 1e9)))]
    pub center: Option<[f64; 3]>,
    /// Radius of a "sphere", and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(max = 1e9), extend("exclusiveMinimum" = 0))]
    pub radius: Option<f64>,
    /// Place [x, y, z] of a corner of a "parallelogram", and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = -1e9, max = 1e9)))]
    pub corner: Option<[f64; 3]>,
    /// The two edges of a "parallelogram" that leave the corner, each [x, y, z], and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[[f64; 3]; 2]", inner(inner(range(min = -1e9, max = 1e9))))]
    pub edges: Option<[[f64; 3]; 2]>,
    /// Direction [x, y, z] at right angles to an "annulus"; [0, 0, 1] if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = -1e9, max = 1e9)))]
    pub normal: Option<[f64; 3]>,
    /// Radius of the hole of an "annulus", 0 for a full circle; 0 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 1e9))]
    pub inner: Option<f64>,
    /// Radius of an "annulus", and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(max = 1e9), extend("exclusiveMinimum" = 0))]
    pub outer: Option<f64>,
    /// What the surface does with light.
    pub material: Finish,
    /// Colour [red, green, blue] in sRGB: the share of light that a "matt" surface scatters or a "mirror" reflects, or
    /// what a "light" sends; of a picture, the filter that it is seen through. [0.8, 0.8, 0.8] if not given, [1, 1, 1] for
    /// a picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = 0, max = 1)))]
    pub color: Option<[f64; 3]>,
    /// Factor on what a "light" sends; 1 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 0, max = 1e12))]
    pub brightness: Option<f64>,
    /// How the colour changes from place to place.
    pub texture: Texture,
    /// Angles in degrees by which the texture of a "sphere", which has its north along +z and its middle towards +x, is
    /// turned about x, y and z, in this order; [0, 0, 0] if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = -1e6, max = 1e6)))]
    pub rotation: Option<[f64; 3]>,
    /// How the matter of the surface moves, by its light, for it stays where it is: "static"; "orbit", as the circular orbit
    /// about +z through its middle, which has to be in the equatorial plane; or a velocity [r, θ, φ] in units of c,
    /// measured by the zero-angular-momentum observer at each of its places.
    pub motion: ObjectMotion,
}

/// The shape of a thing.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ShapeName {
    /// All points at the distance `radius` from `center`.
    #[default]
    Sphere,
    /// The points between two `edges` that leave a `corner`.
    Parallelogram,
    /// The points of a plane between two distances from `center`.
    Annulus,
}

/// How the colour of a surface changes from place to place.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Texture {
    /// What it looks like.
    pub kind: TextureKind,
    /// The second colour [red, green, blue] in sRGB, of a "checker" or "noise"; [0.1, 0.1, 0.1] if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 3]", inner(range(min = 0, max = 1)))]
    pub color: Option<[f64; 3]>,
    /// How many squares of a "checker" go around a sphere and from pole to pole, or along the edges of a parallelogram,
    /// or around an annulus and across it; [8, 4] if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[u32; 2]", inner(range(min = 1, max = 10000)))]
    pub squares: Option<[u32; 2]>,
    /// Picture file, relative to the scene file's folder; for "image", and needed there. On a sphere it goes once around,
    /// north up; on a parallelogram its left lower corner is the `corner`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub path: Option<String>,
    /// Size in M of the largest clouds of "noise"; 1 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1e-9, max = 1e9))]
    pub size: Option<f64>,
    /// Chooses the pattern of "noise"; 1 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u64", range(min = 0, max = 9223372036854775807_i64))]
    pub seed: Option<u64>,
}

/// What a texture looks like.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum TextureKind {
    /// One colour.
    #[default]
    Solid,
    /// Squares of two colours in turn.
    Checker,
    /// The picture `path`.
    Image,
    /// Clouds of one colour in another.
    Noise,
    /// The Earth, on a sphere; on other shapes its map.
    Earth,
}

/// How the matter of a surface moves.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ObjectMotion {
    /// By name.
    Named(ObjectMotionName),
    /// At this velocity relative to the zero-angular-momentum observer.
    Velocity(#[schemars(inner(range(min = -1, max = 1)))] [f64; 3]),
}

/// A motion that has a name.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ObjectMotionName {
    /// At rest relative to infinity; possible outside the static limit.
    Static,
    /// With the circular orbit about +z, in free fall, through its middle.
    Orbit,
}

impl Default for ObjectMotion {
    fn default() -> Self {
        Self::Named(ObjectMotionName::Static)
    }
}

/// The shapes that take notice of each key.
pub(in crate::scene) const SHAPE_USES: [(&str, &[ShapeName]); 8] = [
    ("center", &[ShapeName::Sphere, ShapeName::Annulus]),
    ("radius", &[ShapeName::Sphere]),
    ("corner", &[ShapeName::Parallelogram]),
    ("edges", &[ShapeName::Parallelogram]),
    ("normal", &[ShapeName::Annulus]),
    ("inner", &[ShapeName::Annulus]),
    ("outer", &[ShapeName::Annulus]),
    ("rotation", &[ShapeName::Sphere]),
];

/// The kinds of texture that take notice of each key.
pub(in crate::scene) const TEXTURE_USES: [(&str, &[TextureKind]); 5] = [
    ("color", &[TextureKind::Checker, TextureKind::Noise]),
    ("squares", &[TextureKind::Checker]),
    ("path", &[TextureKind::Image]),
    ("size", &[TextureKind::Noise]),
    ("seed", &[TextureKind::Noise]),
];

impl Object {
    pub(super) fn complete(&self) -> Self {
        let is = |shape| self.shape == shape;
        let pictured = matches!(self.texture.kind, TextureKind::Image | TextureKind::Earth);
        let color = if pictured { WHITE } else { COLOR };
        Self {
            normal: self.normal.or(is(ShapeName::Annulus).then_some(NORMAL)),
            inner: self.inner.or(is(ShapeName::Annulus).then_some(0.0)),
            color: self.color.or(Some(color)),
            brightness: self.brightness.or((self.material == Finish::Light).then_some(1.0)),
            texture: self.texture.complete(),
            rotation: self.rotation.or(is(ShapeName::Sphere).then_some(ROTATION)),
            ..self.clone()
        }
    }
}

impl Texture {
    fn complete(&self) -> Self {
        let uses = |key| TEXTURE_USES.iter().any(|(k, kinds)| *k == key && kinds.contains(&self.kind));
        Self {
            kind: self.kind,
            color: self.color.or(uses("color").then_some(SECOND)),
            squares: self.squares.or(uses("squares").then_some(SQUARES)),
            path: self.path.clone(),
            size: self.size.or(uses("size").then_some(SIZE)),
            seed: self.seed.or(uses("seed").then_some(1)),
        }
    }
}
