//! Curves on the screen on which light leaves the disk at one radius.

use std::f64::consts::TAU;

use rayon::prelude::*;

use crate::spacetime::geodesic::{Crossing, Fate, Path, Query, Ray, Tracer};
use crate::spacetime::observer::impact_ray;

/// Rays asked for at once.
const BATCH: usize = 2048;

/// The observer's plane of impact parameters, at infinity, in polar coordinates about the point (−a sin i, 0): the principal null
/// ray with λ = a sin² i, η = −a² cos⁴ i, which stays at θ = i and meets no disk. All isoradials of all orders enclose it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screen {
    /// Spin a.
    pub spin: f64,
    /// Inclination, radians.
    pub inclination: f64,
}

impl Screen {
    /// (α, β) at a distance from the centre and an angle from +α towards +β.
    pub fn place(&self, distance: f64, angle: f64) -> [f64; 2] {
        let (sin, cos) = angle.sin_cos();
        [distance * cos - self.spin * self.inclination.sin(), distance * sin]
    }

    fn ray(&self, distance: f64, angle: f64) -> Option<Ray> {
        impact_ray(Some(self.spin), self.inclination, f64::INFINITY, self.place(distance, angle)).ok()
    }
}

/// The crossings of one order in directions around the centre.
pub struct Isoradials<'a> {
    /// What follows rays.
    pub tracer: &'a dyn Tracer,
    /// Where they arrive.
    pub screen: Screen,
    /// The image order, 0 for the direct image.
    pub order: usize,
}

/// A place that is looked for along a direction: 1/r as a function of the distance falls through that of `radius`.
#[derive(Clone, Copy)]
struct Search {
    angle: f64,
    target: f64,
    /// Distances, and by how much 1/r is above the target there; infinite where light falls in, −1 where it comes from the sky.
    low: [f64; 2],
    high: [f64; 2],
    /// Which end was moved last, and how often.
    side: [usize; 2],
    crossing: Option<Crossing>,
    done: bool,
}

/// A point of an isoradial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Distance from the centre of the screen, M.
    pub distance: f64,
    /// The crossing next to it.
    pub crossing: Crossing,
}

impl Isoradials<'_> {
    /// The points at these radii, in so many directions from angle 0 on: those of one direction one after the other. A point is
    /// missing where light of this order does not come from that radius.
    pub fn points(&self, radii: &[f64], directions: usize) -> Vec<Option<Point>> {
        let angles: Vec<f64> = (0..directions).map(|k| TAU * k as f64 / directions as f64).collect();
        self.along(radii, &angles)
    }

    /// The same in given directions.
    pub fn along(&self, radii: &[f64], angles: &[f64]) -> Vec<Option<Point>> {
        let places: Vec<[f64; 2]> =
            angles.iter().flat_map(|angle| radii.iter().map(|r| [*r, *angle])).collect();
        self.at(&places)
    }

    /// The same for pairs of a radius and a direction.
    pub fn at(&self, places: &[[f64; 2]]) -> Vec<Option<Point>> {
        let farthest = places.iter().map(|[r, _]| *r).fold(10.0, f64::max);
        let far = 2.0 * farthest / self.screen.inclination.cos().abs().max(0.1) + 30.0;
        let mut searches: Vec<Search> =
            places.iter().map(|[r, angle]| Search::new(*angle, 1.0 / r, far)).collect();
        searches.par_chunks_mut(BATCH).for_each(|some| self.search(some));
        searches.iter().map(Search::found).collect()
    }

    fn search(&self, searches: &mut [Search]) {
        let query = Query { max_crossings: self.order + 1, ..Query::default() };
        let mut paths: Vec<Path> = Vec::new();
        for _ in 0..150 {
            let mut asked = Vec::new();
            let mut rays = Vec::new();
            for (number, search) in searches.iter_mut().enumerate().filter(|(_, search)| !search.done) {
                let next = search.next();
                match self.screen.ray(next, search.angle) {
                    Some(ray) => {
                        asked.push((number, next));
                        rays.push(ray);
                    }
                    None => search.done = true,
                }
            }
            if rays.is_empty() {
                return;
            }
            paths.resize_with(rays.len().max(paths.len()), Path::default);
            let paths = &mut paths[..rays.len()];
            self.tracer.trace_all(&rays, &query, paths);
            for ((number, distance), path) in asked.into_iter().zip(paths) {
                searches[number].learn(distance, path, self.order);
            }
        }
    }
}

impl Search {
    fn new(angle: f64, target: f64, far: f64) -> Self {
        let (low, high) = ([0.0, f64::INFINITY], [far, -1.0]);
        Self { angle, target, low, high, side: [0; 2], crossing: None, done: false }
    }

    /// Where to look next: by the secant where 1/r is known at both ends (Illinois: an end that stays counts half), else
    /// in the middle.
    fn next(&self) -> f64 {
        let ([low, above], [high, below]) = (self.low, self.high);
        let middle = 0.5 * (low + high);
        if !above.is_finite() || below <= -1.0 || self.side[1] > 4 {
            return middle;
        }
        let share = above / (above - below);
        let next = low + share * (high - low);
        if next > low && next < high { next } else { middle }
    }

    fn learn(&mut self, distance: f64, path: &Path, order: usize) {
        let crossing = path.crossings.get(order).copied();
        let off = match (crossing, path.fate) {
            (Some(crossing), _) => 1.0 / crossing.r - self.target,
            (None, Fate::Escaped) => -1.0,
            (None, _) => f64::INFINITY,
        };
        if crossing.is_some() {
            self.crossing = crossing;
        }
        let moved = usize::from(off > 0.0);
        let repeated = if moved == self.side[0] { self.side[1] + 1 } else { 0 };
        self.side = [moved, if repeated > 5 { 0 } else { repeated }];
        if off > 0.0 {
            self.low = [distance, off];
            if repeated > 0 && self.high[1] > -1.0 {
                self.high[1] *= 0.5;
            }
        } else {
            self.high = [distance, off];
            if repeated > 0 {
                self.low[1] *= 0.5;
            }
        }
        let narrow = self.high[0] - self.low[0] <= 4.0 * f64::EPSILON * self.high[0];
        self.done = narrow || off.abs() <= 4.0 * f64::EPSILON * self.target;
        if self.done {
            self.low[0] = distance;
            self.high[0] = distance;
        }
    }

    fn found(&self) -> Option<Point> {
        let crossing = self.crossing.filter(|c| (c.r * self.target - 1.0).abs() < 1e-6)?;
        Some(Point { distance: 0.5 * (self.low[0] + self.high[0]), crossing })
    }
}
