//! Light that things scatter: a path from the camera backwards, leg by leg.
//!
//! The radiance that arrives at the camera along a ray is estimated by one path (Kajiya 1986, the rendering equation). A
//! leg is a geodesic from a receiver to what it meets: a thing, the sky, or the horizon. The light of a leg's far end
//! arrives as L·(ν_received/ν_sent)⁴ (I_ν/ν³ is the same all along a ray, and the colours are those of whole bands: Misner,
//! Thorne & Wheeler 1973, §22.6), with ν_received = 1 by the normalisation of rays. At a matt surface with albedo ρ
//!
//! ```text
//! L = ρ/π ∫ L_in cos θ dω = ρ ⟨L_in⟩,
//! ```
//!
//! the mean over directions distributed as cos θ/π in the rest frame of its matter, of which one is followed. From the
//! fourth bounce on a path survives with the probability that is its largest factor so far, and counts as much more (Russian
//! roulette; Arvo & Kirk 1990), which leaves the mean as it is. A path that is longer than the most bounces allowed loses
//! what would have come.
//!
//! Things do not move, but their light is as if they did. Where that contradicts itself, a ray that leaves the moving matter
//! on its outer side heads into the thing that stays: it is taken as dark.

use super::tally::Tally;
use crate::disk::Disk;
use crate::light::Light;
use crate::material::{Finish, Material, lambert};
use crate::objects::World;
use crate::random::Stream;
use crate::sky::{Sky, towards};
use crate::spacetime::geodesic::{Fate, Hit, Line, ObstacleTracer, Path, Query, Ray, Side};
use crate::spacetime::observer::{Drift, Patch};
use crate::spacetime::tensor::{Vec3, dot};

/// What makes pieces of surfaces.
pub(super) type Patches = dyn Fn(Vec3<f64>, Vec3<f64>, Drift) -> Option<Patch> + Send + Sync;

/// Things, and how their light is followed.
pub(super) struct Legs {
    pub(super) world: World,
    pub(super) surfaces: Vec<Surface>,
    pub(super) tracer: Box<dyn ObstacleTracer>,
    /// A piece of a surface with a place, a normal and a motion; `None` where matter cannot move so.
    pub(super) patch: Box<Patches>,
    /// Whether light goes straight.
    pub(super) flat: bool,
    pub(super) bounces: u32,
    pub(super) shifts: bool,
    pub(super) seed: u64,
}

/// What a thing's surface is, but for its shape.
pub(super) struct Surface {
    pub(super) material: Material,
    pub(super) drift: Drift,
    /// The thing's own centre, from which the places of its pattern are counted.
    pub(super) center: Vec3<f64>,
}

/// What else there is to see, and how.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub(super) disk: Option<&'a Disk>,
    pub(super) sky: &'a Sky,
    /// That on the other side of a wormhole.
    pub(super) other_sky: &'a Sky,
    /// What to ask along each leg.
    pub(super) query: &'a Query,
    /// Angle on the sky that the camera's own ray stands for.
    pub(super) angle: f64,
}

/// Bounces from which on paths are left to chance.
const CERTAIN: u32 = 3;

/// Angle on the sky that a scattered ray stands for: one of about a hundred that would cover what a matt surface sees.
const WIDE: f64 = 0.1;

/// The share of the light from farther on that reaches the camera, and the light so far.
struct Gathered {
    light: Light,
    share: [f64; 3],
}

impl Gathered {
    fn new() -> Self {
        Self { light: Light::DARK, share: [1.0; 3] }
    }

    /// Adds light from the far end of the leg.
    #[inline]
    fn add(&mut self, light: Light) {
        for i in 0..3 {
            self.light.rgb[i] += self.share[i] * light.rgb[i];
        }
    }

    #[inline]
    fn dim(&mut self, factor: [f64; 3]) {
        for i in 0..3 {
            self.share[i] *= factor[i];
        }
    }

    /// Whether the path goes on after bounce number `bounce` (from 0).
    #[inline]
    fn survives(&mut self, bounce: u32, chance: f64) -> bool {
        let [r, g, b] = self.share;
        let most = r.max(g).max(b);
        if bounce >= CERTAIN && most < 1.0 {
            if chance >= most {
                return false;
            }
            self.dim([most.recip(); 3]);
        }
        most > 0.0
    }
}

impl Legs {
    /// The light that arrives along a ray of the camera.
    pub(super) fn light(
        &self,
        ray: &Ray,
        around: &Around<'_>,
        random: Stream,
        path: &mut Path,
        tally: &mut Tally,
    ) -> Light {
        if self.flat && around.disk.is_none() && ray.start.w > 0.0 {
            return self.straight(ray, around, random, tally);
        }
        let (mut ray, mut angle) = (*ray, around.angle);
        let mut gathered = Gathered::new();
        for bounce in 0..=self.bounces {
            self.tracer.trace_among(&ray, around.query, &self.world, path);
            tally.count(path.steps, path.error_estimate, path.fate == Fate::StepLimit);
            if let Some(disk) = around.disk {
                for hit in disk.hits(&ray, path) {
                    if let Some(sheet) = disk.sheet(&hit) {
                        gathered.add(sheet.light);
                        gathered.dim([1.0 - sheet.opacity; 3]);
                    }
                }
            }
            if let Some([theta, phi]) = path.direction {
                // The sky's light has there the frequency 1/g.
                let energy = if ray.side == Side::Reversed { ray.energy } else { -ray.energy };
                let sky = if path.other_side { around.other_sky } else { around.sky };
                let light = sky.radiance(towards(theta, phi), angle);
                gathered.add(light * self.dimming(energy));
            }
            let Some(hit) = &path.hit else { break };
            let Some(next) = self.bounce(hit, bounce, random, &mut gathered) else { break };
            ray = next.ray;
            angle = if next.wide { WIDE } else { angle };
        }
        gathered.light
    }

    /// What light with frequency ν at its source and 1 at its receiver is dimmed by.
    fn dimming(&self, frequency: f64) -> f64 {
        if self.shifts { frequency.powi(4).recip() } else { 1.0 }
    }

    /// Adds what a surface sends, and tells where the path goes on, if it does.
    fn bounce(&self, hit: &Hit, bounce: u32, random: Stream, gathered: &mut Gathered) -> Option<Bounce> {
        let surface = &self.surfaces[hit.object];
        let shape = self.world.shape(hit.object);
        let [place, normal] = shape.settle(&hit.position);
        let patch = (self.patch)(place, normal, surface.drift)?;
        let (frequency, direction) = patch.measure(hit.energy, &hit.momentum);
        let color = surface.color(shape, &place);
        gathered.dim([self.dimming(frequency); 3]);
        if surface.material.finish == Finish::Light {
            gathered.add(color);
            return None;
        }
        gathered.dim(color.rgb);
        let [a, b, chance] = random.bounce(bounce);
        if !gathered.survives(bounce, chance) {
            return None;
        }
        let side = if direction[2] > 0.0 { -1.0 } else { 1.0 };
        let wide = surface.material.finish == Finish::Matt;
        let onwards = if wide {
            let [x, y, z] = lambert([a, b]);
            [x, y, side * z]
        } else {
            [direction[0], direction[1], -direction[2]]
        };
        if surface.drift != Drift::Static && patch.climb(&onwards) * side <= 0.0 {
            return None;
        }
        let start = self.world.lift(hit.object, &place, &normal.map(|c| side * c));
        Some(Bounce { ray: patch.ray_from(start, onwards), wide })
    }

    /// Paths of straight legs, for flat space without a disk: places and directions are all that there is to know, and a
    /// picture may have a hundred million of them.
    fn straight(&self, ray: &Ray, around: &Around<'_>, random: Stream, tally: &mut Tally) -> Light {
        let p = ray.start.momentum();
        let inverse = dot(&p, &p).sqrt().recip();
        let mut line = Line {
            origin: ray.start.n.map(|c| c / ray.start.w),
            direction: p.map(|c| c * inverse),
            start: 0.0,
        };
        let mut angle = around.angle;
        let mut gathered = Gathered::new();
        for bounce in 0..=self.bounces {
            tally.count(0, f64::EPSILON, false);
            let Some((d, object)) = self.world.along(&line) else {
                gathered.add(around.sky.radiance(line.direction, angle));
                break;
            };
            let at = std::array::from_fn(|i| line.origin[i] + d * line.direction[i]);
            let surface = &self.surfaces[object];
            if surface.drift != Drift::Static {
                let momentum = line.direction;
                let hit = Hit { object, position: at, momentum, energy: 1.0 };
                let Some(next) = self.bounce(&hit, bounce, random, &mut gathered) else { break };
                let p = next.ray.start.momentum();
                let inverse = next.ray.energy.recip();
                line.origin = next.ray.start.n.map(|c| c / next.ray.start.w);
                line.direction = p.map(|c| c * inverse);
                // The next leg's frequency at its receiver is 1 again.
                gathered.dim([if self.shifts { inverse.powi(4) } else { 1.0 }; 3]);
                angle = if next.wide { WIDE } else { angle };
                continue;
            }
            let shape = self.world.shape(object);
            let [place, mut normal] = shape.settle(&at);
            let color = surface.color(shape, &place);
            if surface.material.finish == Finish::Light {
                gathered.add(color);
                break;
            }
            gathered.dim(color.rgb);
            let [a, b, chance] = random.bounce(bounce);
            if !gathered.survives(bounce, chance) {
                break;
            }
            let along = dot(&normal, &line.direction);
            if along > 0.0 {
                normal = normal.map(|c| -c);
            }
            line.origin = self.world.lift(object, &place, &normal);
            if surface.material.finish == Finish::Matt {
                let [x, y, z] = lambert([a, b]);
                let [e1, e2] = across(&normal);
                line.direction = std::array::from_fn(|i| x * e1[i] + y * e2[i] + z * normal[i]);
                angle = WIDE;
            } else {
                let twice = 2.0 * along.abs();
                line.direction = std::array::from_fn(|i| line.direction[i] + twice * normal[i]);
            }
        }
        gathered.light
    }
}

/// Where a path goes on.
struct Bounce {
    ray: Ray,
    /// Whether the ray stands for many directions.
    wide: bool,
}

impl Surface {
    #[inline]
    fn color(&self, shape: &crate::objects::Shape, place: &Vec3<f64>) -> Light {
        let own = std::array::from_fn(|i| place[i] - self.center[i]);
        self.material.pattern.at(|| shape.coordinates(place), &own)
    }
}

/// Two unit vectors at right angles to a unit vector and each other (Duff et al. 2017, JCGT 6, 1).
#[inline]
fn across([x, y, z]: &Vec3<f64>) -> [Vec3<f64>; 2] {
    let sign = 1_f64.copysign(*z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}
