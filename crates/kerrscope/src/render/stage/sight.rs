//! What rays see of a stage.

use super::Stage;
use crate::disk::DiskHit;
use crate::light::{Beam, Light};
use crate::random::Stream;
use crate::render::Tally;
use crate::render::legs::{Around, Legs};
use crate::sky::{Sky, footprint, towards};
use crate::spacetime::geodesic::{Fate, Path, Query, Ray};
use crate::spacetime::tensor::Vec3;

/// Rays followed together: enough to fill vectors of a kind, few enough to stay in the cache.
const BATCH: usize = 1024;

/// Memory for rays and what is found along them, kept from batch to batch.
#[derive(Clone, Debug, Default)]
pub struct Replay {
    /// Points of the picture; and rays for those at which a photon can arrive.
    points: Vec<[f64; 2]>,
    rays: Vec<Ray>,
    /// Whether there is a ray for a point.
    arrives: Vec<bool>,
    paths: Vec<Path>,
    /// What the rays of some pixels see.
    views: Vec<View>,
}

/// Where light comes from at infinity.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct Origin {
    pub(in crate::render) direction: Vec3<f64>,
    /// On the other side of a wormhole.
    pub(in crate::render) other_side: bool,
}

/// What a ray sees: light gathered on its way, and where the sky behind, if it sees it.
#[derive(Clone, Copy, Debug)]
pub(in crate::render) struct View {
    beam: Beam,
    sky: Option<Origin>,
}

impl Stage {
    /// The mean light of a pixel's rays.
    pub fn pixel(&self, pixel: [u32; 2], replay: &mut Replay, tally: &mut Tally) -> Light {
        let mut light = Light::DARK;
        self.pixels(std::iter::once(pixel), replay, tally, |seen| light = seen);
        light
    }

    /// The mean light of each pixel's rays.
    pub(in crate::render) fn pixels(
        &self,
        pixels: impl Iterator<Item = [u32; 2]>,
        replay: &mut Replay,
        tally: &mut Tally,
        mut each: impl FnMut(Light),
    ) {
        if let Some(legs) = &self.legs {
            for pixel in pixels {
                each(self.scattered(legs, pixel, replay, tally));
            }
            return;
        }
        replay.views.clear();
        replay.points.clear();
        for pixel in pixels {
            for sample in 0..self.samples {
                replay.points.push(self.sample(pixel, sample));
                if replay.points.len() == BATCH {
                    self.view(replay, tally);
                }
            }
        }
        self.view(replay, tally);
        for views in replay.views.chunks(self.samples as usize) {
            each(self.mean(views));
        }
    }

    /// The mean light of a pixel's rays in a scene with things.
    fn scattered(&self, legs: &Legs, pixel: [u32; 2], replay: &mut Replay, tally: &mut Tally) -> Light {
        let angle = self.pixel / f64::from(self.samples).sqrt();
        let mut sum = Light::DARK;
        for sample in 0..self.samples {
            let random = Stream::new(legs.seed, self.number(pixel), u64::from(sample));
            sum += self.path(legs, self.sample(pixel, sample), angle, random, replay, tally);
        }
        sum * f64::from(self.samples).recip()
    }

    /// The light that arrives at a point of the picture in a scene with things, by one path.
    fn path(
        &self,
        legs: &Legs,
        [x, y]: [f64; 2],
        angle: f64,
        random: Stream,
        replay: &mut Replay,
        tally: &mut Tally,
    ) -> Light {
        let Ok(ray) = self.camera.ray(x, y) else {
            tally.count(0, 0.0, false);
            return Light::DARK;
        };
        if replay.paths.is_empty() {
            replay.paths.push(Path::default());
        }
        let around = Around {
            disk: self.disk.as_ref(),
            sky: &self.sky,
            other_sky: &self.other_sky,
            query: &self.query,
            angle,
        };
        legs.light(&ray, &around, random, &mut replay.paths[0], tally)
    }

    /// The mean light of a pixel whose rays see this.
    pub(in crate::render) fn mean(&self, views: &[View]) -> Light {
        let unbent = self.pixel / (views.len() as f64).sqrt();
        let angles = [(&self.sky, false), (&self.other_sky, true)].map(|(sky, other_side)| {
            let seen = views.iter().filter_map(|view| view.sky);
            match **sky {
                Sky::Panorama(_) => {
                    let seen = seen.filter(|origin| origin.other_side == other_side);
                    footprint(seen.map(|origin| origin.direction), unbent)
                }
                _ => unbent,
            }
        });
        let mut sum = Light::DARK;
        for view in views {
            sum += self.light(view, angles);
        }
        sum * (1.0 / views.len() as f64)
    }

    /// What the data layers say of pixels: of the ray through the centre of each, in the order of
    /// [`channels`](Self::channels).
    pub(in crate::render) fn probe(
        &self,
        pixels: impl Iterator<Item = [u32; 2]>,
        replay: &mut Replay,
        tally: &mut Tally,
        mut each: impl FnMut(usize, f32),
    ) {
        replay.points.clear();
        replay.points.extend(pixels.map(|pixel| pixel.map(|edge| f64::from(edge) + 0.5)));
        self.follow(self.probe.query(), replay, tally);
        let mut followed = replay.rays.iter().zip(&replay.paths);
        let nowhere = nowhere();
        for arrives in &replay.arrives {
            let found = if *arrives { followed.next() } else { None };
            let (ray, path) = found.map_or((None, &nowhere), |(ray, path)| (Some(*ray), path));
            for (channel, value) in self.probe.values(ray, path, self.disk.as_ref()).enumerate() {
                each(channel, value);
            }
        }
    }

    /// The light that arrives at a point of the picture, from a pixel's angle of the sky; in a scene with things, by one
    /// path, which the point's coordinates choose.
    pub fn ray(&self, point: [f64; 2], replay: &mut Replay, tally: &mut Tally) -> Light {
        if let Some(legs) = &self.legs {
            let random = Stream::new(legs.seed, point[0].to_bits(), point[1].to_bits());
            return self.path(legs, point, self.pixel, random, replay, tally);
        }
        replay.views.clear();
        replay.points.clear();
        replay.points.push(point);
        self.view(replay, tally);
        replay.views.iter().map(|view| self.light(view, [self.pixel; 2])).sum()
    }

    /// A view's light, if the ray stands for an angle on the sky, or for another on that of the other side.
    fn light(&self, view: &View, [here, there]: [f64; 2]) -> Light {
        let sky = view.sky.map_or(Light::DARK, |Origin { direction, other_side }| {
            if other_side {
                self.other_sky.radiance(direction, there)
            } else {
                self.sky.radiance(direction, here)
            }
        });
        view.beam.end(sky)
    }

    /// Adds what is seen at the points of a replay to its views, and forgets the points.
    fn view(&self, replay: &mut Replay, tally: &mut Tally) {
        self.follow(&self.query, replay, tally);
        let mut paths = replay.rays.iter().zip(&replay.paths);
        for arrives in &replay.arrives {
            let (ray, path) = if *arrives { paths.next() } else { None }.unzip();
            let hits = self
                .disk
                .iter()
                .flat_map(|disk| ray.into_iter().zip(path).flat_map(move |(ray, path)| disk.hits(ray, path)));
            let origin = path.and_then(|path| {
                let [theta, phi] = path.direction?;
                Some(Origin { direction: towards(theta, phi), other_side: path.other_side })
            });
            replay.views.push(self.seen(hits, origin));
        }
        replay.points.clear();
    }

    /// What a ray sees that crosses the disk's plane in these places, in this order, and comes from a
    /// direction of the sky or from nowhere.
    pub(in crate::render) fn seen(
        &self,
        hits: impl Iterator<Item = DiskHit>,
        origin: Option<Origin>,
    ) -> View {
        let mut beam = Beam::new();
        if let Some(disk) = &self.disk {
            for hit in hits {
                if let Some(sheet) = disk.sheet(&hit) {
                    beam.pass(sheet);
                }
            }
        }
        View { beam, sky: origin.filter(|_| !beam.is_blocked()) }
    }

    /// Traces the rays at points of the picture; tells of a path for each, or of none where no photon
    /// arrives.
    pub(in crate::render) fn trace(
        &self,
        points: &[[f64; 2]],
        replay: &mut Replay,
        tally: &mut Tally,
        mut each: impl FnMut(Option<&Path>),
    ) {
        for some in points.chunks(BATCH) {
            replay.points.clear();
            replay.points.extend(some);
            self.follow(&self.query, replay, tally);
            let mut paths = replay.paths.iter();
            for arrives in &replay.arrives {
                each(if *arrives { paths.next() } else { None });
            }
        }
    }

    /// Traces the rays at points of the picture; tells of each photon that arrives.
    pub(in crate::render) fn trace_rays(
        &self,
        points: &[[f64; 2]],
        replay: &mut Replay,
        tally: &mut Tally,
        mut each: impl FnMut(&Ray, &Path),
    ) {
        for some in points.chunks(BATCH) {
            replay.points.clear();
            replay.points.extend(some);
            self.follow(&self.query, replay, tally);
            for (ray, path) in replay.rays.iter().zip(&replay.paths) {
                each(ray, path);
            }
        }
    }

    /// Follows the rays that arrive at the points of a replay.
    fn follow(&self, query: &Query, replay: &mut Replay, tally: &mut Tally) {
        let Replay { points, rays, arrives, paths, .. } = replay;
        rays.clear();
        arrives.clear();
        for &[x, y] in &*points {
            // No photon with such impact parameters gets here: dark.
            let ray = self.camera.ray(x, y).ok();
            arrives.push(ray.is_some());
            rays.extend(ray);
        }
        if paths.len() < rays.len() {
            paths.resize_with(rays.len(), Path::default);
        }
        match &self.legs {
            None => self.tracer.trace_all(rays, query, &mut paths[..rays.len()]),
            Some(Legs { tracer, world, .. }) => {
                for (ray, path) in rays.iter().zip(&mut *paths) {
                    tracer.trace_among(ray, query, world, path);
                }
            }
        }
        for path in &paths[..rays.len()] {
            tally.count(path.steps, path.error_estimate, path.fate == Fate::StepLimit);
        }
        for _ in rays.len()..points.len() {
            tally.count(0, 0.0, false);
        }
    }
}

/// The path of a photon that does not exist: no light.
fn nowhere() -> Path {
    Path { fate: Fate::Captured, error_estimate: 0.0, windings: f64::NAN, ..Path::default() }
}
