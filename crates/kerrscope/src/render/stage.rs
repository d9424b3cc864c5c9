//! A scene made ready to be drawn: pictures loaded, camera and tracer set up.

use super::probe::Probe;
use super::{Channel, Sampler, Tally};
use crate::camera::Camera;
use crate::disk::{Disk, DiskHit, Picture, Plane, Ring, Surface};
use crate::display::srgb;
use crate::light::{Beam, Light};
use crate::scene::{self, Method, Scene, ScreenKind, SkyPicture, Spacetime};
use crate::sky::{Grid, Panorama, Sky, Stars};
use crate::spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, Straight, Tracer};
use crate::spacetime::metric::{Kerr, Schwarzschild};
use crate::spacetime::observer::ObserverError;
use crate::texture::{Texture, TextureError};

/// Everything that a render needs.
pub struct Stage {
    size: [u32; 2],
    samples: u32,
    camera: Camera,
    tracer: Box<dyn Tracer>,
    query: Query,
    probe: Probe,
    disk: Option<Disk>,
    sky: Sky,
    sampler: Sampler,
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

/// What following one ray found; kept to save memory from ray to ray.
#[derive(Clone, Debug, Default)]
pub struct Replay {
    /// The ray's path.
    pub path: Path,
}

impl Stage {
    /// Makes a scene ready.
    ///
    /// # Errors
    /// If a picture cannot be read.
    pub fn new(scene: &Scene) -> Result<Self, StageError> {
        let disk = scene.disk.as_ref().map(surface).transpose()?;
        let query = Query {
            plane: disk.as_ref().map_or([0.0, 0.0, 1.0], Disk::normal),
            max_crossings: if disk.is_some() { scene.render.max_crossings as usize } else { 0 },
            ..Query::default()
        };
        Ok(Self {
            size: [scene.render.width, scene.render.height],
            samples: scene.render.samples,
            camera: Camera::new(scene)?,
            tracer: tracer(scene),
            probe: Probe::new(scene, &query),
            query,
            disk,
            sky: sky(scene)?,
            sampler: Sampler::new(scene.render.samples, scene.render.seed, scene.render.jitter),
        })
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Rays in the whole picture.
    pub fn rays(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1]) * u64::from(self.rays_per_pixel())
    }

    /// Rays of a pixel: its samples, and one more if there are data layers.
    pub fn rays_per_pixel(&self) -> u32 {
        self.samples + u32::from(!self.channels().is_empty())
    }

    /// The data layers that the scene asks for.
    pub fn channels(&self) -> &[Channel] {
        self.probe.channels()
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The mean light of a pixel's rays.
    pub fn pixel(&self, [x, y]: [u32; 2], replay: &mut Replay, tally: &mut Tally) -> Light {
        let number = u64::from(y) * u64::from(self.size[0]) + u64::from(x);
        let mut sum = Light::DARK;
        for sample in 0..self.samples {
            let [right, down] = self.sampler.place(number, sample);
            sum += self.ray([f64::from(x) + right, f64::from(y) + down], replay, tally);
        }
        sum * (1.0 / f64::from(self.samples))
    }

    /// What the data layers say of a pixel: of the ray through its centre, in the order of
    /// [`channels`](Self::channels).
    pub fn probe<'a>(
        &'a self,
        [x, y]: [u32; 2],
        replay: &'a mut Replay,
        tally: &mut Tally,
    ) -> impl Iterator<Item = f32> + use<'a> {
        let centre = [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let ray = self.follow(centre, self.probe.query(), replay, tally);
        self.probe.values(ray, &replay.path, self.disk.as_ref())
    }

    /// The light that arrives at a point of the picture.
    pub fn ray(&self, point: [f64; 2], replay: &mut Replay, tally: &mut Tally) -> Light {
        self.follow(point, &self.query, replay, tally);
        let path = &replay.path;
        let mut beam = Beam::new();
        if let Some(disk) = &self.disk {
            for crossing in &path.crossings {
                let hit = DiskHit { radius: crossing.r, position: crossing.position };
                if let Some(sheet) = disk.sheet(&hit) {
                    beam.pass(sheet);
                }
            }
        }
        let background = match path.direction {
            Some([theta, phi]) if !beam.is_blocked() => self.sky.radiance(theta, phi),
            _ => Light::DARK,
        };
        beam.end(background)
    }

    /// Follows the ray that arrives at a point of the picture.
    fn follow(&self, [x, y]: [f64; 2], query: &Query, replay: &mut Replay, tally: &mut Tally) -> Option<Ray> {
        let path = &mut replay.path;
        let ray = self.camera.ray(x, y).ok();
        if let Some(ray) = &ray {
            self.tracer.trace(ray, query, path);
        } else {
            // No photon with such impact parameters gets here: dark.
            path.clear();
            path.fate = Fate::Captured;
            path.error_estimate = 0.0;
        }
        tally.count(path.steps, path.error_estimate, path.fate == Fate::StepLimit);
        ray
    }
}

/// The tracer that a scene asks for.
pub fn tracer(scene: &Scene) -> Box<dyn Tracer> {
    let render = &scene.render;
    let tolerance = render.tolerance;
    let scheme = match render.method {
        Method::Rk4 => Scheme::Rk4 { step: render.step },
        Method::Tsit5 => Scheme::Tsit5 { tolerance },
        Method::Dop853 => Scheme::Dop853 { tolerance },
    };
    let steps = render.max_steps as usize;
    match scene.spacetime {
        Spacetime::Minkowski => Box::new(Straight),
        Spacetime::Schwarzschild => Box::new(Integrator::new(Schwarzschild, scheme, steps)),
        Spacetime::Kerr { spin } => Box::new(Integrator::new(Kerr::new(spin), scheme, steps)),
    }
}

fn linear(color: [f64; 3]) -> Light {
    Light::new(color.map(srgb::decode))
}

fn surface(disk: &scene::Disk) -> Result<Disk, TextureError> {
    let surface = match &disk.surface {
        scene::Surface::Ring { seed } => Surface::Ring(Ring::new(*seed)),
        scene::Surface::Picture { path, mapping } => {
            Surface::Picture(Picture { texture: Texture::load(path)?, mapping: *mapping })
        }
    };
    Ok(Disk {
        inner: disk.inner,
        outer: disk.outer,
        plane: Plane::new(disk.tilt, disk.node),
        surface,
        tint: disk.color.map(|c| srgb::decode(c) * disk.brightness),
        opacity: disk.opacity,
    })
}

/// The sky, as fine as the picture can show it.
fn sky(scene: &Scene) -> Result<Sky, TextureError> {
    let sky = &scene.sky;
    let pixels = f64::from(scene.render.height);
    // Angle that a pixel at the middle of the picture covers on the sky if nothing bends light.
    let pixel = match scene.screen.kind {
        ScreenKind::Pinhole { height } => 2.0 * (0.5 * height).tan() / pixels,
        ScreenKind::Angular { height } => height / pixels,
        // For a distant observer this is nothing; then what deflection by 4/b makes of it at the
        // picture's edge.
        ScreenKind::Impact { height } => {
            let deflection = 4.0 / (0.5 * height).powi(2);
            height / pixels * deflection.min(1.0).max(scene.observer.place.r.recip())
        }
    };
    Ok(match &sky.picture {
        SkyPicture::Black => Sky::Black,
        SkyPicture::Uniform { color } => Sky::Uniform(linear(*color) * sky.brightness),
        SkyPicture::Grid { color, spacing } => Sky::Grid(Grid::new(*spacing, linear(*color), sky.brightness)),
        SkyPicture::Stars { orientation } => Sky::Stars(Stars::new(pixel, *orientation, sky.brightness)),
        SkyPicture::Panorama { path, orientation } => {
            Sky::Panorama(Panorama::new(Texture::load(path)?, pixel, *orientation, sky.brightness))
        }
    })
}
