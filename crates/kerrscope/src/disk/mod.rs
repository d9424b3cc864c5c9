//! Thin disks: flat rings around the hole, drawn or shining by physics.
//!
//! A disk is geometry (a plane, two radii), a surface (what it looks like) and matter (how it moves, which shifts its
//! light). Lengths are in M, angles in radians.

mod emission;
mod matter;
mod picture;
mod plane;
mod ring;

pub use emission::{Emission, Glow, Limb, Profile, Thermal};
pub use matter::{Matter, Shifts};
pub use picture::{Mapping, Picture};
pub use plane::Plane;
pub use ring::Ring;

use crate::light::{Light, Sheet};
use crate::spacetime::emitter::Departure;
use crate::spacetime::geodesic::{Path, Ray};

/// A thin disk.
///
/// ```
/// use kerrscope::disk::{Disk, DiskHit, Matter, Plane, Ring, Shifts, Surface};
/// let disk = Disk {
///     inner: 6.0,
///     outer: 16.0,
///     plane: Plane::new(0.0, 0.0),
///     surface: Surface::Ring(Ring::new(1)),
///     matter: Matter { orbits: None, shifts: Shifts::NONE },
///     tint: [1.0; 3],
///     opacity: 1.0,
///     thin: false,
///     orders: None,
///     time: None,
/// };
/// assert_eq!(disk.normal(), [0.0, 0.0, 1.0]);
/// let seen = disk.sheet(&disk.hit(9.0, [0.0, 9.0, 0.0])).unwrap();
/// assert!(seen.opacity > 0.0 && seen.light.rgb[0] > seen.light.rgb[2]);
/// assert!(disk.sheet(&DiskHit { radius: 5.0, ..disk.hit(9.0, [0.0, 9.0, 0.0]) }).is_none());
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
    /// How its matter moves.
    pub matter: Matter,
    /// Factor on the red, green and blue light that it sends.
    pub tint: [f64; 3],
    /// Factor on its opacity, 0 to 1. It thins the disk out, so its light goes down with
    /// it.
    pub opacity: f64,
    /// Whether it holds nothing back and yet sends all of its light: optically thin.
    pub thin: bool,
    /// The image orders that are seen, all if not given. The others are as if there were no disk.
    pub orders: Option<Vec<u32>>,
    /// When the camera's clock shows this time, M, a pattern is seen that turns with the matter and stood at its place at
    /// 0; none: it stands still.
    pub time: Option<f64>,
}

/// What a disk looks like.
#[derive(Clone, Debug, PartialEq)]
pub enum Surface {
    /// Computed bands of orange.
    Ring(Ring),
    /// A picture.
    Picture(Picture),
    /// Light by physics. It is opaque, but for [`Disk::opacity`].
    Shining(Box<Emission>),
}

/// Where a ray meets the plane of a disk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiskHit {
    /// The radius that is compared with the disk's own: that of Boyer–Lindquist.
    pub radius: f64,
    /// The azimuth from the plane's ascending node; any number of turns.
    pub azimuth: f64,
    /// The image order: how often the ray has met the plane before.
    pub order: usize,
    /// How the light leaves, as far as that is known; what is shifted needs it.
    pub light: Option<Departure>,
    /// Time from there to the camera, M; NaN where it is not known.
    pub elapsed: f64,
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

    /// The first hit at a point in Cartesian coordinates with a radius of Boyer–Lindquist, which in Kerr–Schild
    /// coordinates is not its distance from the origin. Of its light nothing more is known.
    pub fn hit(&self, radius: f64, position: [f64; 3]) -> DiskHit {
        DiskHit { radius, azimuth: self.plane.azimuth(position), order: 0, light: None, elapsed: f64::NAN }
    }

    /// Where a ray that was followed meets the plane.
    pub fn hits<'a>(&'a self, ray: &'a Ray, path: &'a Path) -> impl Iterator<Item = DiskHit> + 'a {
        let normal = self.needs_light().then(|| self.normal());
        path.crossings.iter().enumerate().map(move |(order, crossing)| DiskHit {
            order,
            light: normal.map(|normal| Departure::new(ray, crossing, &normal)),
            elapsed: crossing.elapsed,
            ..self.hit(crossing.r, crossing.position)
        })
    }

    /// Whether a hit has to say how its light leaves.
    pub fn needs_light(&self) -> bool {
        !self.matter.shifts.is_none() || matches!(self.surface, Surface::Shining(_))
    }

    /// What a ray that meets the disk's plane there sees of it: nothing inside the inner
    /// radius or outside the outer one. Finite for any hit.
    pub fn sheet(&self, hit: &DiskHit) -> Option<Sheet> {
        // A radius that is not a number is outside.
        if !(self.inner..=self.outer).contains(&hit.radius) {
            return None;
        }
        if self.orders.as_ref().is_some_and(|orders| !orders.contains(&(hit.order as u32))) {
            return None;
        }
        let mut sheet = match &self.surface {
            Surface::Ring(ring) => self.shifted(ring.at(self.place(hit)), hit),
            Surface::Picture(picture) => self.shifted(picture.at(self.place(hit)), hit),
            Surface::Shining(emission) => Sheet { light: self.shining(emission, hit), opacity: 1.0 },
        };
        let rgb = std::array::from_fn(|i| sheet.light.rgb[i] * self.tint[i] * self.opacity);
        sheet.light = Light { rgb, intensity: sheet.light.intensity * self.opacity };
        sheet.opacity = if self.thin { 0.0 } else { (sheet.opacity * self.opacity).clamp(0.0, 1.0) };
        Some(sheet)
    }

    /// The black body that is seen there, if it is one; as much of it as [`sheet`](Self::sheet) shows.
    pub fn thermal(&self, hit: &DiskHit) -> Option<Thermal> {
        let Surface::Shining(emission) = &self.surface else { return None };
        let light = hit.light.as_ref()?;
        let leaving = self.matter.leaving(hit.radius, light, emission.needs_angle())?;
        let thermal = emission.thermal(hit.radius, leaving.g, self.matter.shifts.beaming, leaving.cosine)?;
        Some(Thermal { factor: thermal.factor * self.opacity, ..thermal })
    }

    fn place(&self, hit: &DiskHit) -> Place {
        let across = (hit.radius - self.inner) / (self.outer - self.inner);
        let since = self.time.map_or(0.0, |time| time - hit.elapsed);
        let azimuth = hit.azimuth - if since == 0.0 { 0.0 } else { self.matter.turn(hit.radius, since) };
        Place {
            radius: hit.radius / self.outer,
            // A disk without width has no across.
            across: if across.is_finite() { across.clamp(0.0, 1.0) } else { 0.5 },
            azimuth: if azimuth.is_finite() { azimuth } else { 0.0 },
        }
    }

    /// A drawn surface has no spectrum: its colours stay, and its brightness goes with g⁴.
    fn shifted(&self, sheet: Sheet, hit: &DiskHit) -> Sheet {
        let Shifts { beaming, .. } = self.matter.shifts;
        if self.matter.shifts.is_none() || !beaming {
            return sheet;
        }
        let g =
            hit.light.and_then(|light| self.matter.leaving(hit.radius, &light, false)).map_or(0.0, |l| l.g);
        Sheet { light: sheet.light * g.powi(4), ..sheet }
    }

    fn shining(&self, emission: &Emission, hit: &DiskHit) -> Light {
        let leaving =
            hit.light.and_then(|light| self.matter.leaving(hit.radius, &light, emission.needs_angle()));
        leaving.map_or(Light::DARK, |l| emission.at(hit.radius, l.g, self.matter.shifts.beaming, l.cosine))
    }
}
