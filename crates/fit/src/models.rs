//! The models that a picture can be compared with, by their names.

use std::sync::Arc;

use crate::fit::Models;
use crate::model::Source;
use crate::ring::Ring;
use crate::traced::{Disk, Fineness, Kind, Light, Lit, Outline, Projection, TextDisk, Theory};

/// A model by its name.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Name {
    /// A thin disk with the flux of Page & Thorne, opaque.
    #[default]
    PageThorne,
    /// A thin disk whose flux is a power of the radius, opaque.
    PowerLaw,
    /// The same, holding nothing back: all image orders are seen.
    ThinPowerLaw,
    /// A ring on the sky, brighter on one side, blurred.
    Ring,
    /// What is lit of a thin disk, however bright.
    Silhouette,
}

impl Name {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::PageThorne, Self::PowerLaw, Self::ThinPowerLaw, Self::Ring, Self::Silhouette];

    /// As it is written.
    pub const fn name(self) -> &'static str {
        match self {
            Self::PageThorne => "page-thorne",
            Self::PowerLaw => "power-law",
            Self::ThinPowerLaw => "thin-power-law",
            Self::Ring => "ring",
            Self::Silhouette => "silhouette",
        }
    }

    /// The model of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|model| model.name() == name)
    }
}

/// A model, and how its picture is projected.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choice {
    /// Which one.
    pub name: Name,
    /// How directions become places.
    pub projection: Projection,
    /// Image orders that a silhouette shows; all if not said.
    pub orders: Option<usize>,
}

impl Choice {
    /// How finely pictures are drawn, from 0 to 2.
    pub(crate) fn fineness(fineness: usize) -> Fineness {
        match fineness {
            0 => Fineness::SKETCH,
            1 => Fineness::MEDIUM,
            _ => Fineness::default(),
        }
    }
}

impl Models for Choice {
    fn source(&self, fineness: usize) -> Box<dyn Source> {
        let fineness = Self::fineness(fineness);
        let disk = |kind, opaque| Box::new(Disk::new(kind, opaque, self.projection, fineness));
        match self.name {
            Name::PageThorne => disk(Kind::PageThorne, true),
            Name::PowerLaw => disk(Kind::PowerLaw, true),
            Name::ThinPowerLaw => disk(Kind::PowerLaw, false),
            Name::Ring => Box::new(Ring),
            Name::Silhouette => {
                let outline = Outline { orders: self.orders, ..Outline::default() };
                Box::new(Lit::new(outline, self.projection, fineness))
            }
        }
    }
}

/// An opaque disk in a spacetime given as text.
#[derive(Clone, Debug)]
pub struct Tested {
    /// The text.
    pub theory: Arc<Theory>,
    /// Whether the disk has the flux of Page & Thorne or a power of the radius.
    pub kind: Kind,
    /// How directions become places.
    pub projection: Projection,
    /// Names of the parameters that are looked for, of which derivatives are wanted; all if there are none.
    pub free: Vec<String>,
}

impl Tested {
    /// In which of the models' disks a theory can be tested.
    ///
    /// # Errors
    /// If in no such.
    pub fn kind(name: Name) -> Result<Kind, String> {
        match name {
            Name::PageThorne => Ok(Kind::PageThorne),
            Name::PowerLaw => Ok(Kind::PowerLaw),
            other => Err(format!(
                "the model {} knows no other spacetime than Kerr's: give {} or {}",
                other.name(),
                Name::PageThorne.name(),
                Name::PowerLaw.name()
            )),
        }
    }
}

impl Models for Tested {
    fn source(&self, fineness: usize) -> Box<dyn Source> {
        let theory = Arc::clone(&self.theory);
        let light = if fineness == 0 { Light::Kerr } else { Light::Own };
        let wanted = (light, self.free.clone());
        Box::new(TextDisk::new(theory, self.kind, self.projection, Choice::fineness(fineness), wanted))
    }
}
