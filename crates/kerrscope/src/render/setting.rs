//! What stands in a stage, made from what a scene says of it: pictures loaded, colours in linear light.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::legs::{Legs, Surface as ThingSurface};
use super::props::Props;
use super::tracer::obstacle_tracer;
use crate::disk::{Disk, Emission, Matter, Picture, Plane, Surface};
use crate::display::srgb;
use crate::light::Light;
use crate::material::{Finish, Material, Noise, Pattern};
use crate::objects::{Shape, World};
use crate::scene::{self, ObjectPattern, Scene, ScreenKind, SkyPicture};
use crate::sky::{Gradient, Grid, Panorama, Sky, Stars};
use crate::texture::{Texture, TextureError};

fn linear(color: [f64; 3]) -> Light {
    Light::new(color.map(srgb::decode))
}

pub(super) fn disk(disk: &scene::Disk, props: &Props) -> Result<Disk, TextureError> {
    let surface = match &disk.surface {
        scene::Surface::Ring { seed } => Surface::Ring(props.ring(*seed)),
        scene::Surface::Picture { path, mapping } => {
            Surface::Picture(Picture { texture: Texture::load(path)?, mapping: *mapping })
        }
        scene::Surface::Shining { profile, limb, glow } => {
            let edges = [disk.inner, disk.outer];
            Surface::Shining(Box::new(Emission::new(profile.clone(), *limb, *glow, edges)))
        }
    };
    Ok(Disk {
        inner: disk.inner,
        outer: disk.outer,
        plane: Plane::new(disk.tilt, disk.node),
        surface,
        matter: Matter { orbits: disk.orbits.clone(), shifts: disk.shifts },
        thin: disk.thin,
        orders: disk.orders.clone(),
        time: disk.time,
        tint: disk.color.map(|c| srgb::decode(c) * disk.brightness),
        opacity: disk.opacity,
    })
}

/// The things of a scene as what stands in the way of rays, numbered in the order of the scene.
pub fn world(scene: &Scene) -> World {
    World::new(scene.objects.iter().map(|object| object.shape).collect())
}

/// The things of a scene and how their light is followed; none if there are no things.
pub(super) fn legs(scene: &Scene) -> Result<Option<Legs>, TextureError> {
    if scene.objects.is_empty() {
        return Ok(None);
    }
    let mut pictures = Pictures::default();
    let surfaces =
        scene.objects.iter().map(|object| thing(object, &mut pictures)).collect::<Result<_, _>>()?;
    let spacetime = scene.spacetime.clone();
    Ok(Some(Legs {
        world: world(scene),
        surfaces,
        tracer: obstacle_tracer(scene),
        patch: Box::new(move |place, normal, drift| spacetime.patch(place, normal, drift)),
        flat: scene.spacetime.is_flat(),
        bounces: scene.render.bounces,
        shifts: scene.render.shifts,
        seed: scene.render.seed,
    }))
}

/// The pictures on things, each loaded or drawn once.
#[derive(Default)]
struct Pictures<'a> {
    files: BTreeMap<&'a Path, Arc<Texture>>,
    earth: Option<Arc<Texture>>,
}

impl<'a> Pictures<'a> {
    fn file(&mut self, path: &'a Path) -> Result<Arc<Texture>, TextureError> {
        if let Some(texture) = self.files.get(path) {
            return Ok(Arc::clone(texture));
        }
        let texture = Arc::new(Texture::load(path)?);
        self.files.insert(path, Arc::clone(&texture));
        Ok(texture)
    }

    fn earth(&mut self) -> Arc<Texture> {
        Arc::clone(self.earth.get_or_insert_with(|| Arc::new(Texture::earth())))
    }
}

/// A thing's surface.
fn thing<'a>(object: &'a scene::Object, pictures: &mut Pictures<'a>) -> Result<ThingSurface, TextureError> {
    let strength = if object.finish == Finish::Light { object.brightness } else { 1.0 };
    let light = |color: [f64; 3]| linear(color) * strength;
    let own = light(object.color);
    let closed = matches!(object.shape, Shape::Sphere(_));
    let pattern = match &object.pattern {
        ObjectPattern::Solid => Pattern::Solid(own),
        ObjectPattern::Checker { second, squares } => {
            Pattern::Checker { first: own, second: light(*second), squares: squares.map(f64::from) }
        }
        ObjectPattern::Picture { path } => {
            Pattern::Picture { texture: pictures.file(path)?, tint: own, closed }
        }
        ObjectPattern::Earth => Pattern::Picture { texture: pictures.earth(), tint: own, closed },
        ObjectPattern::Noise { second, size, seed } => {
            Pattern::Noise { first: own, second: light(*second), noise: Noise::new(*seed, *size) }
        }
    };
    let center = object.shape.bounds().middle();
    Ok(ThingSurface { material: Material { finish: object.finish, pattern }, drift: object.drift, center })
}

/// The angle that a pixel at the middle of the picture covers on the sky if nothing bends light.
pub(super) fn pixel_angle(scene: &Scene) -> f64 {
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
pub(super) fn sky(sky: &scene::Sky, pixel: f64) -> Result<Sky, TextureError> {
    Ok(match &sky.picture {
        SkyPicture::Black => Sky::Black,
        SkyPicture::Uniform { color } => Sky::Uniform(linear(*color) * sky.brightness),
        SkyPicture::Gradient { horizon, zenith } => {
            let [horizon, zenith] = [horizon, zenith].map(|color| linear(*color) * sky.brightness);
            Sky::Gradient(Gradient { horizon, zenith })
        }
        SkyPicture::Grid { color, spacing } => Sky::Grid(Grid::new(*spacing, linear(*color), sky.brightness)),
        SkyPicture::Stars { orientation } => Sky::Stars(Stars::new(pixel, *orientation, sky.brightness)),
        SkyPicture::Panorama { path, orientation } => {
            Sky::Panorama(Panorama::new(Texture::load(path)?, *orientation, sky.brightness))
        }
    })
}
