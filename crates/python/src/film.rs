//! Pictures that were drawn, or read from a file for science.

use std::path::PathBuf;

use kerrscope::light::Radiance;
use kerrscope::output::{Format, ImageSet, Provenance, Saved, png};
use kerrscope::render;
use kerrscope::scene::{self, Draft};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

use crate::arrays::shaped;
use crate::faults;
use crate::scene::Scene;
use crate::work::{self, Told};

/// Linear light, data layers, and the scene that they are of.
#[pyclass(frozen, module = "kerrscope._core")]
pub struct Film {
    draft: Draft,
    scene: scene::Scene,
    drawn: render::Film,
    made: Provenance,
}

impl Film {
    /// What was drawn of a scene.
    pub fn new(draft: Draft, scene: scene::Scene, film: render::Film) -> Self {
        let made = Provenance::of(&scene, &film);
        Self { draft, scene, drawn: film, made }
    }

    /// What files hold of it.
    pub fn images(&self) -> ImageSet<'_> {
        ImageSet::of(&self.scene, &self.drawn)
    }

    /// The film itself.
    pub fn film(&self) -> &render::Film {
        &self.drawn
    }

    /// The angle of M on the sky, µas.
    pub fn microarcseconds(&self) -> Option<f64> {
        self.scene.units.microarcseconds()
    }

    fn shape(&self) -> [usize; 2] {
        [self.drawn.height, self.drawn.width].map(|edge| edge as usize)
    }
}

/// An image's name, title, unit and numbers.
type Named<'py, T> = (String, String, &'static str, Bound<'py, PyArrayDyn<T>>);

#[pymethods]
impl Film {
    /// Reads a FITS or HDF5 file of this program.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let saved = work::run(py, None, &Told::Nothing, |_| Saved::open(&path))?;
        let Saved { draft, scene, film, provenance } = saved.map_err(|error| faults::saved(&error))?;
        Ok(Self { draft, scene, drawn: film, made: provenance })
    }

    /// The scene.
    #[getter]
    fn scene(&self) -> Scene {
        Scene::known(self.draft.clone(), self.scene.clone())
    }

    /// Height and width in pixels.
    #[getter]
    fn size(&self) -> [usize; 2] {
        self.shape()
    }

    /// Linear light, height × width × 3.
    fn light<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f32>>> {
        let [height, width] = self.shape();
        shaped(py, self.drawn.light.as_flattened().to_vec(), &[height, width, 3])
    }

    /// The physical intensity, if there is one.
    fn intensity<'py>(&self, py: Python<'py>) -> PyResult<Option<Named<'py, f64>>> {
        let Some(image) = self.images().intensity() else { return Ok(None) };
        let values = (0..self.drawn.light.len()).map(|pixel| image.value(pixel)).collect();
        let array = shaped(py, values, &self.shape())?;
        Ok(Some((image.name.into_owned(), image.title, image.unit, array)))
    }

    /// The data layers.
    fn layers<'py>(&self, py: Python<'py>) -> PyResult<Vec<Named<'py, f32>>> {
        let layer = |plane: &render::Plane| {
            let channel = plane.channel;
            let array = shaped(py, plane.values.clone(), &self.shape())?;
            Ok((channel.name().into_owned(), channel.title(), channel.layer.unit(), array))
        };
        self.drawn.planes.iter().map(layer).collect()
    }

    /// The record of how it was made.
    #[getter]
    fn record(&self) -> String {
        self.made.to_string()
    }

    /// What is known of it, by names as in `kerrscope render --format json`.
    fn about<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (images, tally, units) = (self.images(), &self.drawn.tally, self.scene.units);
        let theta = units.microarcseconds();
        let pixel = images.pixel();
        let moments = pixel.and_then(|pixel| images.moments(pixel * theta.unwrap_or(1.0)));
        let dict = PyDict::new(py);
        dict.set_item("version", &self.made.version)?;
        dict.set_item("seed", self.made.seed)?;
        dict.set_item("instruction_level", &self.made.instruction_level)?;
        dict.set_item("rays_traced", tally.rays)?;
        dict.set_item("rays_given_up", tally.given_up)?;
        dict.set_item("error_estimate", tally.quantile(0.5))?;
        dict.set_item("error_estimate_99", tally.quantile(0.99))?;
        dict.set_item("error_estimate_max", tally.quantile(1.0).map(|_| tally.worst))?;
        dict.set_item("pixel_m", pixel)?;
        dict.set_item("pixel_uas", pixel.zip(theta).map(|(pixel, theta)| pixel * theta))?;
        dict.set_item("theta_g_uas", theta)?;
        dict.set_item("mass_solar", units.mass)?;
        dict.set_item("distance_pc", units.distance)?;
        dict.set_item("frequency_hz", units.frequency)?;
        dict.set_item("object", &self.scene.target.name)?;
        dict.set_item("total_flux_jy", images.total_flux())?;
        dict.set_item("centroid", moments.map(|m| m.centroid))?;
        dict.set_item("size", moments.map(|m| m.size))?;
        dict.set_item("length_unit", if theta.is_some() { "uas" } else { "M" })?;
        dict.set_item(
            "radiance",
            self.drawn.radiance.map(|radiance| match radiance {
                Radiance::Specific => "specific",
                Radiance::Bolometric => "bolometric",
            }),
        )?;
        let interpolation = tally.interpolation;
        dict.set_item("interpolated_samples", interpolation.samples)?;
        dict.set_item("interpolation_compared", interpolation.compared)?;
        dict.set_item("interpolation_missed", interpolation.missed)?;
        dict.set_item("interpolation_error_max", interpolation.worst)?;
        Ok(dict)
    }

    /// The bytes of a PNG.
    fn png<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let encode = || {
            let mut bytes = Vec::new();
            let display = &self.scene.display;
            png::encode(&mut bytes, &display.picture(&self.drawn), display.depth, &self.made).map(|()| bytes)
        };
        let bytes = work::run(py, None, &Told::Nothing, |_| encode())?.map_err(PyErr::from)?;
        Ok(PyBytes::new(py, &bytes))
    }

    /// Writes a file of the format that its name ends with.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let Some(format) = Format::of(&path) else {
            let path = path.display();
            return Err(faults::wrong(format!(
                "{path}: pictures can be written as .png, .exr, .fits or .h5"
            )));
        };
        work::run(py, None, &Told::Nothing, |_| format.write(&path, &self.scene, &self.drawn))?
            .map_err(|error| faults::file(&error))
    }
}
