//! Thin disks: flat, translucent rings around the hole.
//!
//! A disk is geometry (a plane, two radii) and a surface (what it looks like). Lengths
//! are in M, angles in radians.

mod picture;
mod plane;
mod ring;

pub use picture::{Mapping, Picture};
pub use plane::Plane;
pub use ring::Ring;

use crate::light::{Light, Sheet};

/// A thin disk.
///
/// ```
/// use kerrscope::disk::{Disk, DiskHit, Plane, Ring, Surface};
/// let disk = Disk {
///     inner: 6.0,
///     outer: 16.0,
///     plane: Plane::new(0.0, 0.0),
///     surface: Surface::Ring(Ring::new(1)),
///     tint: [1.0; 3],
///     opacity: 1.0,
/// };
/// assert_eq!(disk.normal(), [0.0, 0.0, 1.0]);
/// let seen = disk.sheet(&disk.hit(9.0, [0.0, 9.0, 0.0])).unwrap();
/// assert!(seen.opacity > 0.0 && seen.light.rgb[0] > seen.light.rgb[2]);
/// assert!(disk.sheet(&DiskHit { radius: 5.0, azimuth: 1.0 }).is_none());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Disk {
    /// Inner radius.
    pub inner: f64,
    /// Outer radius.
    pub outer: f64,
    /// The plane that the disk lies in.
    pub plane: Plane,
    /// What it looks like.
    pub surface: Surface,
    /// Factor on the red, green and blue light that it sends.
    pub tint: [f64; 3],
    /// Factor on its opacity, 0 to 1. It thins the disk out, so its light goes down with
    /// it.
    pub opacity: f64,
}

/// What a disk looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// Computed bands of orange.
    Ring(Ring),
    /// A picture.
    Picture(Picture),
}

/// Where a ray meets the plane of a disk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiskHit {
    /// The radius that is compared with the disk's own: that of Boyer–Lindquist.
    pub radius: f64,
    /// The azimuth from the plane's ascending node; any number of turns.
    pub azimuth: f64,
}

/// A point of a surface: what surfaces are functions of.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    /// Radius as a share of the outer one.
    radius: f64,
    /// 0 at the inner edge to 1 at the outer edge.
    across: f64,
    /// Azimuth from the ascending node.
    azimuth: f64,
}

impl Disk {
    /// The unit normal of the disk's plane.
    pub fn normal(&self) -> [f64; 3] {
        self.plane.normal()
    }

    /// The hit at a point in Cartesian coordinates with a radius of Boyer–Lindquist, which in Kerr–Schild
    /// coordinates is not its distance from the origin.
    pub fn hit(&self, radius: f64, position: [f64; 3]) -> DiskHit {
        DiskHit { radius, azimuth: self.plane.azimuth(position) }
    }

    /// What a ray that meets the disk's plane there sees of it: nothing inside the inner
    /// radius or outside the outer one. Finite for any hit.
    pub fn sheet(&self, hit: &DiskHit) -> Option<Sheet> {
        // A radius that is not a number is outside.
        if !(self.inner..=self.outer).contains(&hit.radius) {
            return None;
        }
        let across = (hit.radius - self.inner) / (self.outer - self.inner);
        let place = Place {
            radius: hit.radius / self.outer,
            // A disk without width has no across.
            across: if across.is_finite() { across.clamp(0.0, 1.0) } else { 0.5 },
            azimuth: if hit.azimuth.is_finite() { hit.azimuth } else { 0.0 },
        };
        let sheet = match &self.surface {
            Surface::Ring(ring) => ring.at(place),
            Surface::Picture(picture) => picture.at(place),
        };
        Some(Sheet {
            light: Light::new(std::array::from_fn(|i| sheet.light.rgb[i] * self.tint[i] * self.opacity)),
            opacity: (sheet.opacity * self.opacity).clamp(0.0, 1.0),
        })
    }
}
