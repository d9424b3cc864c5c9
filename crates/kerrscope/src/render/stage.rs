//! A scene made ready to be drawn: pictures loaded, camera and tracer set up.

use super::probe::Probe;
use super::{Channel, Sampler, Tally};
use crate::camera::Camera;
use crate::disk::{Disk, DiskHit, Picture, Plane, Ring, Surface};
use crate::display::srgb;
use crate::light::{Beam, Light};
use crate::scene::{self, Method, Scene, ScreenKind, SkyPicture, Spacetime};
use crate::sky::{Grid, Panorama, Sky, Stars, footprint};
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
    /// Angle that a pixel at the middle of the picture covers on the sky if nothing bends light.
    pixel: f64,
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
    /// What the rays of a pixel see.
    views: Vec<View>,
}

/// What a ray sees: light gathered on its way, and the direction of the sky behind, if it sees it.
#[derive(Clone, Debug)]
struct View {
    beam: Beam,
    sky: Option<[f64; 2]>,
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
        let pixel = pixel_angle(scene);
        Ok(Self {
            size: [scene.render.width, scene.render.height],
            samples: scene.render.samples,
            camera: Camera::new(scene)?,
            tracer: tracer(scene),
            probe: Probe::new(scene, &query),
            query,
            disk,
            sky: sky(scene, pixel)?,
            pixel,
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
        replay.views.clear();
        for sample in 0..self.samples {
            let [right, down] = self.sampler.place(number, sample);
            let view = self.view([f64::from(x) + right, f64::from(y) + down], &mut replay.path, tally);
            replay.views.push(view);
        }
        let mut angle = self.pixel / f64::from(self.samples).sqrt();
        if let Sky::Panorama(_) = self.sky {
            angle = footprint(replay.views.iter().filter_map(|view| view.sky), angle);
        }
        let mut sum = Light::DARK;
        for view in &replay.views {
            sum += self.light(view, angle);
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
        let ray = self.follow(centre, self.probe.query(), &mut replay.path, tally);
        self.probe.values(ray, &replay.path, self.disk.as_ref())
    }

    /// The light that arrives at a point of the picture, from a pixel's angle of the sky.
    pub fn ray(&self, point: [f64; 2], replay: &mut Replay, tally: &mut Tally) -> Light {
        self.light(&self.view(point, &mut replay.path, tally), self.pixel)
    }

    /// A view's light, if the ray stands for an angle on the sky.
    fn light(&self, view: &View, angle: f64) -> Light {
        let sky = view.sky.map_or(Light::DARK, |[theta, phi]| self.sky.radiance(theta, phi, angle));
        view.beam.end(sky)
    }

    /// What is seen at a point of the picture.
    fn view(&self, point: [f64; 2], path: &mut Path, tally: &mut Tally) -> View {
        self.follow(point, &self.query, path, tally);
        let mut beam = Beam::new();
        if let Some(disk) = &self.disk {
            for crossing in &path.crossings {
                let hit = DiskHit { radius: crossing.r, position: crossing.position };
                if let Some(sheet) = disk.sheet(&hit) {
                    beam.pass(sheet);
                }
            }
        }
        View { beam, sky: path.direction.filter(|_| !beam.is_blocked()) }
    }

    /// Follows the ray that arrives at a point of the picture.
    fn follow(&self, [x, y]: [f64; 2], query: &Query, path: &mut Path, tally: &mut Tally) -> Option<Ray> {
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

/// The angle that a pixel at the middle of the picture covers on the sky if nothing bends light.
fn pixel_angle(scene: &Scene) -> f64 {
    let pixels = f64::from(scene.render.height);
    match scene.screen.kind {
        ScreenKind::Pinhole { height } => 2.0 * (0.5 * height).tan() / pixels,
        ScreenKind::Angular { height } => height / pixels,
        // For a distant observer this is nothing; then what deflection by 4/b makes of it at the
        // picture's edge.
        ScreenKind::Impact { height } => {
            let deflection = 4.0 / (0.5 * height).powi(2);
            height / pixels * deflection.min(1.0).max(scene.observer.place.r.recip())
        }
    }
}

/// The sky of a picture whose pixels cover an angle on it if nothing bends light.
fn sky(scene: &Scene, pixel: f64) -> Result<Sky, TextureError> {
    let sky = &scene.sky;
    Ok(match &sky.picture {
        SkyPicture::Black => Sky::Black,
        SkyPicture::Uniform { color } => Sky::Uniform(linear(*color) * sky.brightness),
        SkyPicture::Grid { color, spacing } => Sky::Grid(Grid::new(*spacing, linear(*color), sky.brightness)),
        SkyPicture::Stars { orientation } => Sky::Stars(Stars::new(pixel, *orientation, sky.brightness)),
        SkyPicture::Panorama { path, orientation } => {
            Sky::Panorama(Panorama::new(Texture::load(path)?, *orientation, sky.brightness))
        }
    })
}
