//! A scene made ready to be drawn: pictures loaded, camera and tracer set up.

mod sight;

pub use sight::Replay;
pub(super) use sight::{Origin, View};

use super::adaptive::Audit;
use super::legs::Legs;
use super::probe::Probe;
use super::setting;
use super::tracer::tracer;
use super::{Channel, Props, Sampler};
use crate::camera::Camera;
use crate::disk::{Disk, Plane, Surface};
use crate::light::Radiance;
use crate::scene::Scene;
use crate::sky::Sky;
use crate::spacetime::Level;
use crate::spacetime::geodesic::{Integrator, Query, Scheme, Tracer};
use crate::spacetime::metric::Metric;
use crate::spacetime::observer::{ObserverError, Patch};
use crate::texture::TextureError;
use std::sync::Arc;

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
    sky: Arc<Sky>,
    /// That on the other side of a wormhole.
    other_sky: Arc<Sky>,
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
        Self::with_props(scene, level, &Props::default())
    }

    /// The same with what was made for other stages, if it is meant to look the same.
    ///
    /// # Errors
    /// If a picture cannot be read.
    pub fn with_props(scene: &Scene, level: Level, props: &Props) -> Result<Self, StageError> {
        let disk = scene.disk.as_ref().map(|disk| setting::disk(disk, props)).transpose()?;
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
            sky: props.sky(&scene.sky, pixel)?,
            other_sky: match &scene.other_sky {
                Some(other) => props.sky(other, pixel)?,
                None => Arc::new(Sky::Black),
            },
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
        [&self.sky, &self.other_sky].iter().any(|sky| !matches!(***sky, Sky::Black | Sky::Uniform(_)))
    }
}
