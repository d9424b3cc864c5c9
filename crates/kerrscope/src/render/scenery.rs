//! What is seen in a scene: its disk and its skies, made ready.

use crate::disk::{Disk, Picture, Plane, Ring, Surface};
use crate::display::srgb;
use crate::light::Light;
use crate::scene::{self, Scene, ScreenKind, SkyPicture};
use crate::sky::{Grid, Panorama, Sky, Stars};
use crate::texture::{Texture, TextureError};

fn linear(color: [f64; 3]) -> Light {
    Light::new(color.map(srgb::decode))
}

/// A disk with its surface.
pub(super) fn disk(disk: &scene::Disk) -> Result<Disk, TextureError> {
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
        SkyPicture::Grid { color, spacing } => Sky::Grid(Grid::new(*spacing, linear(*color), sky.brightness)),
        SkyPicture::Stars { orientation } => Sky::Stars(Stars::new(pixel, *orientation, sky.brightness)),
        SkyPicture::Panorama { path, orientation } => {
            Sky::Panorama(Panorama::new(Texture::load(path)?, *orientation, sky.brightness))
        }
    })
}
