//! A scene made ready to be drawn: pictures loaded, camera and tracer set up.

use super::adaptive::Audit;
use super::legs::{Around, Legs};
use super::probe::Probe;
use super::setting;
use super::tracer::tracer;
use super::{Channel, Sampler, Tally};
use crate::camera::Camera;
use crate::disk::{Disk, DiskHit, Plane, Surface};
use crate::light::{Beam, Light, Radiance};
use crate::random::Stream;
use crate::scene::Scene;
use crate::sky::{Sky, footprint, towards};
use crate::spacetime::Level;
use crate::spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Tracer};
use crate::spacetime::metric::Metric;
use crate::spacetime::observer::{ObserverError, Patch};
use crate::spacetime::tensor::Vec3;
use crate::texture::TextureError;

/// Everything that a render needs.
pub struct Stage {
    size: [u32; 2],
    samples: u32,
    camera: Camera,
    tracer: Box<dyn Tracer>,
    query: Query,
    probe: Probe,
    disk: Option<Disk>,
    legs: Option<Legs>,
    sky: Sky,
    /// That on the other side of a wormhole.
    other_sky: Sky,
    /// Angle that a pixel at the middle of the picture covers on the sky if nothing bends light.
    pixel: f64,
    sampler: Sampler,
    level: Level,
    adaptive: Option<f64>,
    audit: Audit,
}

/// Why a scene cannot be made ready.
#[derive(Debug, thiserror::Error)]
pub enum StageError {
    /// A picture cannot be used.
    #[error(transparent)]
    Texture(#[from] TextureError),
    /// The observer cannot be.
    #[error(transparent)]
    Observer(#[from] ObserverError),
}

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
pub(super) struct Origin {
    pub(super) direction: Vec3<f64>,
    /// On the other side of a wormhole.
    pub(super) other_side: bool,
}

/// What a ray sees: light gathered on its way, and where the sky behind, if it sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    beam: Beam,
    sky: Option<Origin>,
}

impl Stage {
    /// Makes a scene ready, for the best instructions that this processor has.
    ///
    /// # Errors
    /// If a picture cannot be read.
    pub fn new(scene: &Scene) -> Result<Self, StageError> {
        Self::with_level(scene, Level::best())
    }

    /// Makes a scene ready, for the instructions of a level or the best below it that this processor has.
    ///
    /// # Errors
    /// If a picture cannot be read.
    pub fn with_level(scene: &Scene, level: Level) -> Result<Self, StageError> {
        let disk = scene.disk.as_ref().map(setting::disk).transpose()?;
        let query = Query {
            plane: disk.as_ref().map_or(Plane::EQUATOR, |disk| disk.plane).normal(),
            max_crossings: if disk.is_some() { scene.render.max_crossings as usize } else { 0 },
            elapsed: disk.as_ref().is_some_and(|disk| disk.time.is_some()),
            ..Query::default()
        };
        let pixel = setting::pixel_angle(scene);
        Ok(Self {
            size: [scene.render.width, scene.render.height],
            samples: scene.render.samples,
            camera: Camera::new(scene)?,
            tracer: tracer(scene, level),
            level,
            probe: Probe::new(scene, &query),
            query,
            disk,
            legs: setting::legs(scene)?,
            sky: setting::sky(&scene.sky, pixel)?,
            other_sky: scene.other_sky.as_ref().map_or(Ok(Sky::Black), |other| setting::sky(other, pixel))?,
            pixel,
            sampler: Sampler::new(scene.render.samples, scene.render.seed, scene.render.jitter),
            adaptive: scene.render.adaptive,
            audit: Audit::new(
                [scene.render.width, scene.render.height],
                scene.render.samples,
                scene.render.seed,
            ),
        })
    }

    /// The same in a spacetime that no scene can name: light is followed in `metric`, and the matter of things moves in it.
    /// The camera and its motion stay those of the scene, as do the places of things and the disk.
    pub fn in_metric<M: Metric + 'static>(self, metric: M, scheme: Scheme, max_steps: usize) -> Self {
        let tracer = Integrator::new(metric, scheme, max_steps);
        let legs = self.legs.map(|legs| Legs {
            tracer: Box::new(tracer),
            patch: Box::new(move |place, normal, drift| Patch::in_metric(&metric, place, normal, drift)),
            flat: false,
            ..legs
        });
        Self { tracer: Box::new(tracer.with_level(self.level)), legs, ..self }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Rays in the whole picture, of which an adaptive one traces only some.
    pub fn rays(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1]) * u64::from(self.rays_per_pixel())
    }

    /// Rays of a pixel: its samples, and one more if there are data layers.
    pub fn rays_per_pixel(&self) -> u32 {
        self.samples + u32::from(!self.channels().is_empty())
    }

    /// What the physical radiance of the picture is, if it has one: that of a disk that shines by physics. With things in the
    /// scene it has none, for their colours are drawn.
    pub fn radiance(&self) -> Option<Radiance> {
        match self.disk.as_ref().filter(|_| self.legs.is_none())?.surface {
            Surface::Shining(ref emission) => Some(emission.radiance()),
            _ => None,
        }
    }

    /// The disk, if there is one.
    pub(super) fn disk(&self) -> Option<&Disk> {
        self.disk.as_ref()
    }

    /// The data layers that the scene asks for.
    pub fn channels(&self) -> &[Channel] {
        self.probe.channels()
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The instructions that rays are traced with.
    pub fn level(&self) -> Level {
        self.level
    }

    /// What traces the rays: "closed-form", "integrator" or "straight".
    pub fn engine(&self) -> &'static str {
        self.tracer.name()
    }

    /// The error that interpolation between rays shall not exceed, if there is any.
    pub fn adaptive(&self) -> Option<f64> {
        self.adaptive
    }

    /// Samples of a pixel.
    pub(super) fn samples(&self) -> u32 {
        self.samples
    }

    /// Which samples an adaptive picture is judged by.
    pub(super) fn audit(&self) -> Audit {
        self.audit
    }

    /// The plane whose crossings rays report.
    pub(super) fn plane(&self) -> Plane {
        self.disk.as_ref().map_or(Plane::EQUATOR, |disk| disk.plane)
    }

    /// A pixel's running number along the rows.
    pub(super) fn number(&self, [x, y]: [u32; 2]) -> u64 {
        u64::from(y) * u64::from(self.size[0]) + u64::from(x)
    }

    /// Where in the picture a sample of a pixel lies.
    pub(super) fn sample(&self, pixel: [u32; 2], sample: u32) -> [f64; 2] {
        let [right, down] = self.sampler.place(self.number(pixel), sample);
        [f64::from(pixel[0]) + right, f64::from(pixel[1]) + down]
    }

    /// Whether a crossing of the plane with 1/r in a range can be on the disk.
    pub(super) fn meets_disk(&self, [low, high]: [f64; 2]) -> bool {
        self.disk.as_ref().is_some_and(|disk| high * disk.outer >= 1.0 && low * disk.inner <= 1.0)
    }

    /// Whether the sky looks different in different directions.
    pub(super) fn sky_varies(&self) -> bool {
        [&self.sky, &self.other_sky].iter().any(|sky| !matches!(sky, Sky::Black | Sky::Uniform(_)))
    }

    /// The mean light of a pixel's rays.
    pub fn pixel(&self, pixel: [u32; 2], replay: &mut Replay, tally: &mut Tally) -> Light {
        let mut light = Light::DARK;
        self.pixels(std::iter::once(pixel), replay, tally, |seen| light = seen);
        light
    }

    /// The mean light of each pixel's rays.
    pub(super) fn pixels(
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
    pub(super) fn mean(&self, views: &[View]) -> Light {
        let unbent = self.pixel / (views.len() as f64).sqrt();
        let angles = [(&self.sky, false), (&self.other_sky, true)].map(|(sky, other_side)| {
            let seen = views.iter().filter_map(|view| view.sky);
            match sky {
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
    pub(super) fn probe(
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
    pub(super) fn seen(&self, hits: impl Iterator<Item = DiskHit>, origin: Option<Origin>) -> View {
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
    pub(super) fn trace(
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
    pub(super) fn trace_rays(
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
