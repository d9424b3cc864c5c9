//! What files for science hold: images of numbers, their units, and where they are on the sky.
//!
//! The first image is the intensity, where a scene has a physical one; then the linear light `red`, `green`,
//! `blue`, of which 1 is the display's white and which is no flux; then the data layers by the names of
//! [`Channel::name`](crate::render::Channel::name). All are of 64-bit floating-point numbers, and NaN is what a ray does not have.

use std::borrow::Cow;

use super::Provenance;
use crate::camera::Camera;
use crate::light::Radiance;
use crate::measure::Moments;
use crate::render::Film;
use crate::scene::{Scene, Target};
use crate::units::Units;

/// A physical radiance for each pixel of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Intensity<'a> {
    /// One number a pixel, along the rows, the top row first.
    pub values: &'a [f64],
    /// What they are.
    pub radiance: Radiance,
}

/// An image of numbers.
pub struct Image<'a> {
    /// Its name in files.
    pub name: Cow<'static, str>,
    /// What it is, in a few words.
    pub title: String,
    /// The unit of its numbers; empty for pure numbers.
    pub unit: &'static str,
    value: Box<dyn Fn(usize) -> f64 + 'a>,
}

impl Image<'_> {
    /// The number of a pixel; they are counted along the rows, the top row first.
    pub fn value(&self, pixel: usize) -> f64 {
        (self.value)(pixel)
    }
}

/// The images of a render.
///
/// ```
/// use kerrscope::light::Radiance;
/// use kerrscope::output::{ImageSet, Intensity};
/// use kerrscope::render::{Stage, Watch, draw};
/// use kerrscope::scene::Scene;
/// # use std::path::Path;
/// let text = "units = { mass = 6.5e9, distance = 16.8e6, frequency = 230e9 }\n\
///             render = { width = 16, height = 9, samples = 1, layers = ['fate'] }";
/// let scene = Scene::from_toml(text, Path::new(""))?;
/// let film = draw(&Stage::new(&scene)?, &Watch::default())?;
///
/// let drawn = ImageSet::of(&scene, &film);
/// let names: Vec<_> = drawn.images().map(|image| image.name.into_owned()).collect();
/// assert_eq!(names, ["red", "green", "blue", "fate"]);
/// assert_eq!(drawn.total_flux(), None, "a drawn disk has no flux");
///
/// // A radiance of 1 everywhere: the flux is the picture's solid angle.
/// let ones = vec![1.0; 144];
/// let shining = drawn.with_intensity(Intensity { values: &ones, radiance: Radiance::Specific });
/// let angle = scene.units.radians().unwrap() * 2.0 * 30.4 * 25_f64.to_radians().tan();
/// let flux = angle * angle * 16.0 / 9.0 * 1e26;
/// assert!((shining.total_flux().unwrap() / flux - 1.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct ImageSet<'a> {
    scene: &'a Scene,
    film: &'a Film,
    intensity: Option<Intensity<'a>>,
    /// Side of a pixel in M.
    pixel: Option<f64>,
}

impl<'a> ImageSet<'a> {
    /// What a scene's film holds.
    pub fn of(scene: &'a Scene, film: &'a Film) -> Self {
        let pixel = Camera::new(scene).ok().map(|camera| camera.pixel_size());
        let intensity = film.radiance.map(|radiance| Intensity { values: &film.intensity, radiance });
        Self { scene, film, intensity, pixel: pixel.filter(|pixel| pixel.is_finite()) }
    }

    /// The same with a physical intensity.
    ///
    /// # Panics
    /// When it has not one value a pixel.
    pub fn with_intensity(self, intensity: Intensity<'a>) -> Self {
        assert_eq!(intensity.values.len(), self.film.light.len(), "one value a pixel");
        Self { intensity: Some(intensity), ..self }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        [self.film.width, self.film.height]
    }

    /// Side of a pixel in M at the distance of the hole, if the picture has one.
    pub fn pixel(&self) -> Option<f64> {
        self.pixel
    }

    /// Side of a pixel in radians as we see it, where the scene's units give a mass and a distance.
    pub fn pixel_angle(&self) -> Option<f64> {
        Some(self.pixel? * self.units().radians()?)
    }

    /// The units of the scene.
    pub fn units(&self) -> Units {
        self.scene.units
    }

    /// What is seen.
    pub fn target(&self) -> &'a Target {
        &self.scene.target
    }

    /// How the images were made.
    pub fn provenance(&self) -> Provenance {
        Provenance::of(self.scene, self.film)
    }

    /// The physical intensity, if there is one: in Jy a pixel where it is one of a frequency and the units say how far away
    /// the hole is.
    pub fn intensity(&self) -> Option<Image<'a>> {
        let Intensity { values, radiance } = self.intensity?;
        let flux = self.pixel.and_then(|pixel| self.units().janskys(pixel));
        let (title, unit, factor) = match (radiance, flux) {
            (Radiance::Specific, Some(flux)) => ("flux density", JANSKYS, flux),
            (Radiance::Specific, None) => ("specific intensity", "W m-2 Hz-1 sr-1", 1.0),
            (Radiance::Bolometric, _) => ("bolometric intensity in units of Mdot/M^2 per sr", "", 1.0),
        };
        let value = Box::new(move |pixel: usize| factor * values[pixel]);
        Some(Image { name: "intensity".into(), title: title.to_owned(), unit, value })
    }

    /// All images, in their order.
    pub fn images(&self) -> impl Iterator<Item = Image<'a>> + use<'a> {
        let film = self.film;
        let light = ["red", "green", "blue"].into_iter().enumerate().map(move |(k, name)| Image {
            name: name.into(),
            title: format!("linear {name} of Rec. 709, white D65 = 1"),
            unit: "",
            value: Box::new(move |pixel| f64::from(film.light[pixel][k])),
        });
        let layers = film.planes.iter().map(|plane| Image {
            name: plane.channel.name(),
            title: plane.channel.title(),
            unit: plane.channel.layer.unit(),
            value: Box::new(|pixel| f64::from(plane.values[pixel])),
        });
        self.intensity().into_iter().chain(light).chain(layers)
    }

    /// Flux density of the whole picture in Jy, if it has a physical one.
    pub fn total_flux(&self) -> Option<f64> {
        let intensity = self.intensity().filter(|image| image.unit == JANSKYS)?;
        Some((0..self.film.light.len()).map(|pixel| intensity.value(pixel)).sum())
    }

    /// Moments of the physical intensity, or of the luminance where there is none; lengths are in the unit
    /// in which a pixel has the side `pixel`. `None` for a dark picture.
    pub fn moments(&self, pixel: f64) -> Option<Moments> {
        match self.intensity {
            Some(Intensity { values, .. }) => Moments::of(self.size(), pixel, |pixel| values[pixel]),
            None => self.film.moments(pixel),
        }
    }
}

/// The unit of fluxes, as interferometry tools want it written.
pub(super) const JANSKYS: &str = "JY/PIXEL";
