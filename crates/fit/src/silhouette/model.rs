//! The disks that a silhouette is compared with.

use super::misfit::grouped;
use super::{Silhouette, start};
use crate::fit::{Image, Models};
use crate::likelihood::Noise;
use crate::model::{Cancelled, Freedom, Source};
use crate::models::Choice;
use crate::traced::{Lit, Outline};

/// A silhouette whose edges are off by no more than this, pixels, is that of a disk as well as such pictures tell.
const TOLERATED: f64 = 0.25;

/// Disks that are lit evenly, on the squares of pixels of a silhouette.
#[derive(Clone, Debug)]
pub struct Silhouettes<'a> {
    seen: &'a Silhouette,
    choice: Choice,
}

impl<'a> Silhouettes<'a> {
    /// For a silhouette: of the choice, the projection and the image orders count.
    pub fn new(seen: &'a Silhouette, choice: Choice) -> Self {
        Self { seen, choice }
    }

    fn outline(&self) -> Outline {
        Outline { bins: self.seen.bins, open: self.seen.open, orders: self.choice.orders }
    }

    /// Where to begin, with what is known of each parameter.
    pub fn starts(&self, freedoms: &[Freedom], cancelled: Cancelled<'_>) -> Vec<Vec<f64>> {
        let outline = self.outline();
        start::find(&self.seen.image, &outline, self.choice.projection, freedoms, cancelled)
    }
}

impl Models for Silhouettes<'_> {
    fn source(&self, fineness: usize) -> Box<dyn Source> {
        Box::new(Lit::new(self.outline(), self.choice.projection, Choice::fineness(fineness)))
    }

    fn noise(&self, _: &Image, _: Option<f64>) -> Noise {
        self.seen.noise.clone()
    }

    fn revised(&self, image: &Image, best: &[f64]) -> Option<Noise> {
        Some(grouped(&self.seen.noise, image.size, &image.values, best))
    }

    fn level(&self, image: &Image) -> f64 {
        let pattern = self.seen.noise.unknown.as_ref().map_or(&[][..], |unknown| &unknown.pattern);
        let square: f64 = pattern.iter().map(|p| p * p).sum();
        TOLERATED * (square / image.values.len() as f64).sqrt()
    }
}
