//! What single rays of a picture show of a disk and of the dark within it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::Outline;
use super::manner::Follower;
use super::series::{Lengths, Setting};
use crate::camera::Camera;
use crate::render::tracer;
use crate::spacetime::Level;
use crate::spacetime::geodesic::{Path, Query, Tracer};

/// Directions in which the edge of the shadow is looked for.
const AROUND: usize = 180;
/// How far off the disk's plane rays to the left and right start, radians of the direction in the picture.
const OFF_PLANE: f64 = 1e-6;

/// A disk's image ends within so many fiftieths of its radius, as a rule.
const WITHIN: i32 = 80;

/// Single rays of a picture.
pub(super) struct Sight {
    camera: Camera,
    rays: Rays,
    middle: [f64; 2],
    /// A pixel's side, as the tangent of an angle.
    pixel: f64,
    /// The disk's radius in pixels if light were straight.
    unit: f64,
    /// Its radius, M.
    edge: f64,
    /// How closely places are found, relatively.
    close: f64,
}

enum Rays {
    Traced(Box<dyn Tracer>),
    Followed(Follower),
}

impl Sight {
    pub fn new(setting: &Setting) -> Result<Self, String> {
        let scene = setting.scene()?;
        let place = [setting.distance, setting.inclination.to_radians()];
        let followed =
            setting.manner.map(|manner| Rays::Followed(Follower::new(manner, setting.spin, place)));
        Ok(Self {
            camera: Camera::new(&scene).map_err(|e| e.to_string())?,
            close: if followed.is_some() { 1e-7 } else { 1e-11 },
            rays: followed.unwrap_or_else(|| Rays::Traced(tracer(&scene, Level::best()))),
            middle: setting.size.map(|n| 0.5 * f64::from(n)),
            pixel: setting.pixel(),
            unit: setting.edge / setting.distance / setting.pixel(),
            edge: setting.edge,
        })
    }

    /// The lengths; h is 0 if it is not asked for.
    pub fn lengths(&self, below: bool) -> Result<Lengths, String> {
        let mut centre = [0.0; 2];
        // The centroid does not depend on where directions begin; from near it, it is exact to the order of the rule.
        for _ in 0..2 {
            let radii = (0..AROUND)
                .map(|k| self.dark_until(centre, TAU * k as f64 / AROUND as f64 + OFF_PLANE))
                .collect::<Option<Vec<f64>>>()
                .ok_or("the shadow is not in view")?;
            centre = Outline { centre, radii }.centroid();
        }
        let lit_until = |angle: f64| self.lit_until(centre, angle).ok_or("the disk's edge is not in view");
        let below = if below { lit_until(-FRAC_PI_2)? } else { 0.0 };
        Ok(Lengths { centre, left: lit_until(PI - OFF_PLANE)?, right: lit_until(OFF_PLANE)?, below })
    }

    /// Radius at which the light of order 0 from a place leaves the disk's plane.
    fn radius(&self, centre: [f64; 2], angle: f64, distance: f64) -> Option<f64> {
        let (sin, cos) = angle.sin_cos();
        let place = [centre[0] + distance * cos, centre[1] + distance * sin];
        let pixel = [self.middle[0] + place[0], self.middle[1] - place[1]];
        match &self.rays {
            Rays::Traced(tracer) => {
                let ray = self.camera.ray(pixel[0], pixel[1]).ok()?;
                let mut path = Path::default();
                tracer.trace(&ray, &Query { max_crossings: 1, ..Query::default() }, &mut path);
                path.crossings.first().map(|crossing| crossing.r)
            }
            Rays::Followed(follower) => follower.radius(&self.camera, pixel, place.map(|c| c * self.pixel)),
        }
    }

    /// How far from a centre no light of order 0 comes from within the disk's radius: what is met first on the way in from the disk's edge, so
    /// that stray light of inexact rays within the dark does not count.
    fn dark_until(&self, centre: [f64; 2], angle: f64) -> Option<f64> {
        let lit = |distance: f64| self.radius(centre, angle, distance).is_some_and(|r| r <= self.edge);
        let step = 0.02 * self.unit;
        let at = |k: &i32| lit(f64::from(*k) * step);
        let edge =
            if at(&WITHIN) { (WITHIN..5 * WITHIN).rev().find(at) } else { (1..WITHIN).rev().find(at) }?;
        let dark = (1..edge).rev().find(|k| !at(k))?;
        Some(self.bisected(f64::from(dark) * step, f64::from(dark + 1) * step, |distance| !lit(distance)))
    }

    /// How far from a centre light of order 0 comes from within the disk's radius.
    fn lit_until(&self, centre: [f64; 2], angle: f64) -> Option<f64> {
        let lit = |distance: f64| self.radius(centre, angle, distance).is_some_and(|r| r <= self.edge);
        let step = 0.01 * self.unit;
        let last = (1..300).rev().find(|k| lit(f64::from(*k) * step))?;
        Some(self.bisected(f64::from(last) * step, f64::from(last + 1) * step, lit))
    }

    /// Where a condition that holds at `low` and not at `high` ends.
    fn bisected(&self, mut low: f64, mut high: f64, holds: impl Fn(f64) -> bool) -> f64 {
        while high - low > self.close * high {
            let middle = 0.5 * (low + high);
            if holds(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}
