//! `[units]` and `[target]`

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What M is, and at which frequency the picture is taken. All may be left out: pictures do not need them.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Units {
    /// Mass of the hole in solar masses. It makes kilometres and seconds of M.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1e-20, max = 1e20))]
    pub mass: Option<f64>,
    /// Distance of the hole from us in parsec. With the mass it makes microarcseconds of M, whatever the distance of the
    /// observer in the scene.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1e-10, max = 1e12))]
    pub distance: Option<f64>,
    /// Frequency in Hz at which the picture is taken, as we receive it.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", range(min = 1, max = 1e30))]
    pub frequency: Option<f64>,
}

impl Units {
    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// What the headers of FITS and HDF5 files call the picture, and where on the sky they put it.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Target {
    /// Its name: 1 to 60 printable characters of ASCII.
    pub name: String,
    /// Right ascension in degrees.
    #[schemars(range(min = 0, max = 360))]
    pub right_ascension: f64,
    /// Declination in degrees.
    #[schemars(range(min = -90, max = 90))]
    pub declination: f64,
    /// The time as a modified Julian date.
    #[schemars(range(min = 0, max = 1e6))]
    pub mjd: f64,
}

impl Default for Target {
    fn default() -> Self {
        // No place in particular, at J2000.
        Self { name: "kerrscope".to_owned(), right_ascension: 0.0, declination: 0.0, mjd: 51_544.5 }
    }
}

impl Target {
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }
}
