//! Things in the scene: their shapes, and where rays meet them.
//!
//! Shapes are given in the Cartesian Kerr–Schild coordinates in which the scene's rays are traced (see
//! [`Side`](crate::spacetime::geodesic::Side)), and are flat or round there. They are surfaces, not bodies: each is seen
//! from both sides, may contain the camera or the hole, and may pass through another. Where they do, the one that is met
//! first is seen. They do not move: the matter's velocity acts on its light alone.

mod bounds;
mod flat;
mod piece;
mod roots;
mod sphere;
mod tree;
mod world;

pub use bounds::Bounds;
pub use flat::Flat;
pub use sphere::Sphere;
pub use world::World;

use crate::spacetime::geodesic::Line;
use crate::spacetime::tensor::{Vec3, dot};
use piece::Piece;

/// The shape and place of a thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A sphere.
    Sphere(Sphere),
    /// A parallelogram or an annulus.
    Flat(Flat),
}

impl Shape {
    /// The box that it is in.
    pub fn bounds(&self) -> Bounds {
        match self {
            Self::Sphere(sphere) => sphere.bounds(),
            Self::Flat(flat) => flat.bounds(),
        }
    }

    /// Where a line meets it first, before d = `until`.
    #[inline]
    fn meets_line(&self, line: &Line, until: f64) -> Option<f64> {
        match self {
            Self::Sphere(sphere) => sphere.meets_line(line, until),
            Self::Flat(flat) => flat.meets_line(line, until),
        }
    }

    /// Where a piece of a bent ray meets it first.
    fn meets_piece(&self, piece: &Piece<'_>) -> Option<f64> {
        match self {
            Self::Sphere(sphere) => sphere.meets_piece(piece),
            Self::Flat(flat) => flat.meets_piece(piece),
        }
    }

    /// The point of the surface next to a point that is on it but for rounding, and the unit normal, outwards if there is
    /// an outside.
    #[inline]
    pub fn settle(&self, x: &Vec3<f64>) -> [Vec3<f64>; 2] {
        match self {
            Self::Sphere(sphere) => sphere.settle(x),
            Self::Flat(flat) => flat.settle(x),
        }
    }

    /// The coordinates of a point on the surface, from 0 to 1, by which patterns lie on it: of a sphere, longitude (½ at
    /// longitude 0, growing to the east) and latitude (0 at the south pole); of a parallelogram, along its edges; of an
    /// annulus, azimuth and radius.
    pub fn coordinates(&self, x: &Vec3<f64>) -> [f64; 2] {
        match self {
            Self::Sphere(sphere) => sphere.coordinates(&sphere.settle(x)[1]),
            Self::Flat(flat) => flat.coordinates(x),
        }
    }

    /// The point of the surface with these coordinates.
    pub fn point(&self, coordinates: [f64; 2]) -> Vec3<f64> {
        match self {
            Self::Sphere(sphere) => sphere.point(coordinates),
            Self::Flat(flat) => flat.point(coordinates),
        }
    }

    /// The point of the surface where a clearance is least, and it: where matter can be least of all. It is sought next to
    /// the hole at the origin; of what turns as one (`turning`), which may be too fast far from it, everywhere. Clearance
    /// that is not a number is the least.
    pub fn tightest(&self, clearance: impl Fn(Vec3<f64>) -> f64, turning: bool) -> (Vec3<f64>, f64) {
        let least = |at| {
            let clearance = clearance(self.point(at));
            if clearance.is_nan() { f64::NEG_INFINITY } else { clearance }
        };
        let square = |at| {
            let x = self.point(at);
            dot(&x, &x)
        };
        // Next to the hole, and for what is too fast far from it, anywhere.
        let (nearest, _) = lowest(&square, [0.5; 2], 0.5, 8);
        let size = self.bounds().edges().into_iter().fold(0.0, f64::max);
        let mut best = lowest(&least, nearest, (NEIGHBOURHOOD / size).min(0.5), 24);
        if turning {
            let other = lowest(&least, [0.5; 2], 0.5, 8);
            best = if other.1 < best.1 { other } else { best };
        }
        (self.point(best.0), best.1)
    }
}

/// How far from the point that is next to the hole the clearance may be least, M.
const NEIGHBOURHOOD: f64 = 6.0;

/// The place in the unit square where a function is least, and its value: on a grid around a place, then on ever finer ones
/// around the best, to 1e-5 of the first one's cells.
fn lowest(f: &impl Fn([f64; 2]) -> f64, middle: [f64; 2], half: f64, cells: u32) -> ([f64; 2], f64) {
    let (mut best, mut half) = ((middle, f(middle)), half);
    for round in 0..18 {
        let (middle, cells) = (best.0, if round == 0 { cells } else { 4 });
        for i in 0..=cells {
            for j in 0..=cells {
                let step = |k: u32| f64::from(k) / f64::from(cells) * 2.0 - 1.0;
                let at = [middle[0] + half * step(i), middle[1] + half * step(j)].map(|c| c.clamp(0.0, 1.0));
                let found = f(at);
                if found < best.1 {
                    best = (at, found);
                }
            }
        }
        half *= if round == 0 { 3.0 / f64::from(cells) } else { 0.5 };
    }
    best
}
