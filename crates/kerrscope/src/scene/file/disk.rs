//! `[disk]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::disk::Mapping;

/// A thin disk around the hole that turns about +z.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Disk {
    /// What the disk looks like.
    pub model: DiskModel,
    /// Inner edge: Boyer–Lindquist r in M, or "isco" for the innermost stable circular orbit
    /// about +z.
    pub inner: Inner,
    /// Outer edge: Boyer–Lindquist r, in M.
    #[schemars(range(max = 1e15), extend("exclusiveMinimum" = 0))]
    pub outer: f64,
    /// Angle in degrees between the disk's plane and the equatorial plane.
    #[schemars(range(min = 0, max = 180))]
    pub tilt: f64,
    /// Azimuth in degrees at which the disk rises through the equatorial plane.
    #[schemars(range(min = -1e6, max = 1e6))]
    pub node: f64,
    /// Filter [red, green, blue] in sRGB that the disk's own colours are seen through.
    #[schemars(inner(range(min = 0, max = 1)))]
    pub color: [f64; 3],
    /// Factor on the disk's light.
    #[schemars(range(min = 0, max = 1e12))]
    pub brightness: f64,
    /// Factor on the disk's opacity. It thins the disk out, so that its light goes down with it.
    #[schemars(range(min = 0, max = 1))]
    pub opacity: f64,
    /// Chooses the pattern of a "ring".
    #[schemars(range(min = 0, max = 9223372036854775807_i64))]
    pub seed: u64,
    /// Picture file, relative to the scene file's folder; for "image", and needed there.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub image: Option<String>,
    /// How the picture is laid on the disk; for "image", "around" if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Mapping")]
    pub mapping: Option<Mapping>,
}

/// What a disk looks like.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum DiskModel {
    /// A ring of orange bands, drawn from `seed`.
    #[default]
    Ring,
    /// The picture `image`.
    Image,
    /// There is no disk.
    None,
}

/// Where a disk begins.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Inner {
    /// At the innermost stable circular orbit about +z.
    Isco(Isco),
    /// At this Boyer–Lindquist radius, in M.
    Radius(#[schemars(range(max = 1e15), extend("exclusiveMinimum" = 0))] f64),
}

/// The word for the innermost stable circular orbit.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Isco {
    /// The innermost stable circular orbit about +z.
    Isco,
}

impl Default for Disk {
    fn default() -> Self {
        Self {
            model: DiskModel::default(),
            inner: Inner::Isco(Isco::Isco),
            outer: 16.0,
            tilt: 0.0,
            node: 0.0,
            color: [1.0; 3],
            brightness: 1.0,
            opacity: 1.0,
            seed: 1,
            image: None,
            mapping: None,
        }
    }
}

impl Disk {
    pub(super) fn complete(&self) -> Self {
        let mapping = (self.model == DiskModel::Image).then(Mapping::default);
        Self { mapping: self.mapping.or(mapping), ..self.clone() }
    }
}
