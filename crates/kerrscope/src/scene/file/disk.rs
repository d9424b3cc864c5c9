//! `[disk]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::disk::{Limb, Mapping};

/// A thin disk around the hole that turns about +z.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Disk {
    /// What the disk looks like.
    pub model: DiskModel,
    /// Inner edge: Boyer–Lindquist r in M, or "isco" for the innermost stable circular orbit of its matter.
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
    /// Which way the matter goes round: "prograde" is about +z, or the disk's own normal, whatever the spin.
    pub turns: Turns,
    /// Whether the disk holds no light back and yet sends all of its own.
    pub optically_thin: bool,
    /// The image orders that are seen, 0 for what is met first going back from the camera; all if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Vec<u32>", inner(range(min = 0, max = 1000)), length(min = 1, max = 100))]
    pub orders: Option<Vec<u32>>,
    /// Whether its light is shifted by the motion of the matter. If not given, that of a model that shines by physics is, and
    /// what is drawn is not; so too for the next two.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "bool", extend("default" = false))]
    pub doppler: Option<bool>,
    /// Whether its light is shifted by gravity.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "bool", extend("default" = false))]
    pub gravitational: Option<bool>,
    /// Whether its brightness goes with the shift, as g⁴; otherwise its colours alone do.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "bool", extend("default" = false))]
    pub beaming: Option<bool>,
    /// Emissivity r^−index of a "power-law"; 3 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = -20, max = 20))]
    pub index: Option<f64>,
    /// Radii in M and fluxes [[r, F], …] of a "profile", joined by straight lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(
        with = "Vec<[f64; 2]>",
        length(min = 2, max = 10000),
        inner(inner(range(min = 0, max = 1e15)))
    )]
    pub profile: Option<Vec<[f64; 2]>>,
    /// Which light of a model that shines by physics is shown; "bolometric" if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Shown")]
    pub light: Option<Shown>,
    /// How bright it is at an angle; "isotropic" if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Limb")]
    pub limb: Option<Limb>,
    /// Effective temperature in K where a "blackbody" is the hottest; 10,000 if neither it nor `accretion_rate` is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1, max = 1e12))]
    pub temperature: Option<f64>,
    /// Instead of a temperature: rate of accretion in solar masses a year, for "page-thorne" and with `units.mass`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(max = 1e12), extend("exclusiveMinimum" = 0))]
    pub accretion_rate: Option<f64>,
    /// How much hotter the colour of a "blackbody" is than its flux; 1 if not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1, max = 10))]
    pub color_correction: Option<f64>,
    /// Time of the camera's clock in M at which the pattern of a "ring" or an "image" is seen, which turns with the matter; without
    /// it the pattern stands still.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = -1e9, max = 1e9))]
    pub time: Option<f64>,
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
#[serde(rename_all = "kebab-case")]
pub enum DiskModel {
    /// A ring of orange bands, drawn from `seed`.
    #[default]
    Ring,
    /// The picture `image`.
    Image,
    /// The light of matter that drifts inwards and loses its energy (Page & Thorne 1974).
    PageThorne,
    /// A flux that goes as a power of the radius.
    PowerLaw,
    /// A flux given by points.
    Profile,
    /// There is no disk.
    None,
}

impl DiskModel {
    /// Those that shine by physics.
    pub const SHINING: [Self; 3] = [Self::PageThorne, Self::PowerLaw, Self::Profile];

    /// Whether it shines by physics.
    pub fn shines(self) -> bool {
        Self::SHINING.contains(&self)
    }
}

/// Which way matter goes around.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Turns {
    /// About +z.
    #[default]
    Prograde,
    /// About −z.
    Retrograde,
}

/// Which light is shown.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Shown {
    /// That of all frequencies, as grey.
    #[default]
    Bolometric,
    /// What an eye would see of a black body.
    Blackbody,
}

const INDEX: f64 = 3.0;
const HOTTEST: f64 = 1e4;

/// Keys that have a meaning for some models only, and these.
pub(in crate::scene) const USES: [(&str, &[DiskModel]); 10] = [
    ("image", &[DiskModel::Image]),
    ("mapping", &[DiskModel::Image]),
    ("time", &[DiskModel::Ring, DiskModel::Image]),
    ("index", &[DiskModel::PowerLaw]),
    ("profile", &[DiskModel::Profile]),
    ("light", &DiskModel::SHINING),
    ("limb", &DiskModel::SHINING),
    ("temperature", &DiskModel::SHINING),
    ("accretion_rate", &[DiskModel::PageThorne]),
    ("color_correction", &DiskModel::SHINING),
];

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
            turns: Turns::default(),
            optically_thin: false,
            orders: None,
            doppler: None,
            gravitational: None,
            beaming: None,
            index: None,
            profile: None,
            light: None,
            limb: None,
            temperature: None,
            accretion_rate: None,
            color_correction: None,
            time: None,
            seed: 1,
            image: None,
            mapping: None,
        }
    }
}

impl Disk {
    pub(super) fn complete(&self) -> Self {
        let mapping = (self.model == DiskModel::Image).then(Mapping::default);
        let shines = self.model.shines();
        let light = self.light.or(shines.then(Shown::default));
        let index = (self.model == DiskModel::PowerLaw).then_some(INDEX);
        let black = light == Some(Shown::Blackbody);
        let hottest = (black && self.accretion_rate.is_none()).then_some(HOTTEST);
        let shown = self.model != DiskModel::None;
        Self {
            mapping: self.mapping.or(mapping),
            doppler: self.doppler.or(shown.then_some(shines)),
            gravitational: self.gravitational.or(shown.then_some(shines)),
            beaming: self.beaming.or(shown.then_some(shines)),
            index: self.index.or(index),
            light,
            limb: self.limb.or(shines.then(Limb::default)),
            temperature: self.temperature.or(hottest),
            color_correction: self.color_correction.or(black.then_some(1.0)),
            ..self.clone()
        }
    }
}
