//! A scene as it is typed: every key, its default, its range and what it means, defined once.
//!
//! The types are read by serde, checked against the schema that schemars makes of them, and
//! written back as the record of what a picture shows. Ranges are in the schema attributes; what
//! depends on several keys at once is checked when a [`Scene`](super::Scene) is built.

mod disk;
mod object;
mod observer;
mod render;
mod screen;
mod sky;
mod spacetime;
mod units;

pub(super) use disk::USES as DISK_USES;
pub use disk::{Disk, DiskModel, Inner, Isco, Shown, Turns};
pub use object::{Object, ObjectMotion, ObjectMotionName, ShapeName, Texture, TextureKind};
pub(super) use object::{SHAPE_USES as OBJECT_SHAPE_USES, TEXTURE_USES as OBJECT_TEXTURE_USES};
pub use observer::{Motion, MotionName, Observer, RelativeTo, Velocity};
pub(super) use render::RK4_STEP;
pub use render::{Camera, Display, Render};
pub use screen::{Screen, ScreenKind};
pub(super) use sky::USES as SKY_USES;
pub use sky::{ImageFrame, Sky, SkyKind};
pub use spacetime::{CoordinateKind, Coordinates, Formula, Reversal, Spacetime, SpacetimeName};
pub use units::{Target, Units};

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::{Deserialize, Serialize};

/// A scene. Lengths are in M, angles in degrees, colours in sRGB from 0 to 1.
///
/// A key that is not given has its default; nothing at all is the built-in scene.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SceneFile {
    /// The spacetime that light moves in.
    pub spacetime: Spacetime,
    /// Who looks, from where, and how they move.
    pub observer: Observer,
    /// What the observer's screen shows.
    pub screen: Screen,
    /// What shines around the hole.
    pub disk: Disk,
    /// Things that scatter light or shine, each a section of its own; at most 100,000.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub object: Vec<Object>,
    /// What is seen where light comes from infinity.
    pub sky: Sky,
    /// What is seen where light comes from infinity on the other side of a wormhole; as `sky` if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Sky")]
    pub other_sky: Option<Sky>,
    /// How finely and how exactly the picture is computed.
    pub render: Render,
    /// How light becomes a picture.
    pub camera: Camera,
    /// What M is, and at which frequency the picture is taken.
    #[serde(skip_serializing_if = "Units::is_empty")]
    pub units: Units,
    /// What the headers of FITS and HDF5 files call the picture, and where on the sky they put it.
    #[serde(skip_serializing_if = "Target::is_default")]
    pub target: Target,
}

impl SceneFile {
    /// Every key that has a meaning in this scene, with its default where none was given.
    ///
    /// Completing twice is completing once.
    pub fn complete(&self) -> Self {
        Self {
            spacetime: self.spacetime.complete(),
            observer: self.observer.complete(),
            screen: self.screen.complete(),
            disk: self.disk.complete(),
            object: self.object.iter().map(Object::complete).collect(),
            sky: self.sky.complete(),
            other_sky: self.other_sky.as_ref().map(Sky::complete),
            render: self.render.complete(),
            camera: self.camera.clone(),
            units: self.units.clone(),
            target: self.target.clone(),
        }
    }

    /// The scene as TOML text.
    ///
    /// # Panics
    ///
    /// Never: all that the types can hold, TOML can say.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("a scene is tables, numbers and text")
    }

    /// The scene as JSON; infinite numbers, which JSON cannot say, are the text "inf".
    ///
    /// # Panics
    ///
    /// Never, as [`to_toml`](Self::to_toml).
    pub fn to_json(&self) -> serde_json::Value {
        json(toml::Value::try_from(self).expect("a scene is tables, numbers and text"))
    }

    /// The JSON schema (2020-12) of a scene: every key with its type, range, default and meaning.
    ///
    /// `x-infinity` marks the numbers that may be `inf`, which JSON cannot say.
    pub fn schema() -> serde_json::Value {
        let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
        settings.into_generator().into_root_schema_for::<Self>().to_value()
    }
}

fn json(value: toml::Value) -> serde_json::Value {
    use toml::Value;
    match value {
        Value::String(text) => text.into(),
        Value::Integer(whole) => whole.into(),
        Value::Float(real) if real.is_finite() => real.into(),
        Value::Float(real) => real.to_string().into(),
        Value::Boolean(truth) => truth.into(),
        Value::Datetime(date) => date.to_string().into(),
        Value::Array(list) => list.into_iter().map(json).collect(),
        Value::Table(table) => table.into_iter().map(|(key, value)| (key, json(value))).collect(),
    }
}
