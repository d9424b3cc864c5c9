//! Pictures of anybody's, to be measured and fitted.

use std::path::PathBuf;

use kerrscope::measure;
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::faults;
use crate::film::Film;
use crate::work::{self, Told};

/// A picture in linear light, one number a pixel.
#[pyclass(frozen, module = "kerrscope._core")]
pub struct Picture {
    /// As the library has it.
    pub inner: measure::Picture,
}

#[pymethods]
impl Picture {
    /// Reads a file: FITS, EXR, PNG, JPEG, TIFF, WebP or HDR.
    #[staticmethod]
    fn open(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let found = work::run(py, None, &Told::Nothing, |_| measure::Picture::open(&path))?;
        Ok(Self { inner: found.map_err(|error| faults::picture(&error))? })
    }

    /// Numbers of an array, the top row first, and the side of a pixel, if it is known.
    #[staticmethod]
    #[pyo3(signature = (values, pixel_uas = None, pixel_m = None))]
    fn of_array(
        values: PyReadonlyArray2<'_, f64>,
        pixel_uas: Option<f64>,
        pixel_m: Option<f64>,
    ) -> PyResult<Self> {
        let [height, width] = [values.shape()[0], values.shape()[1]];
        for (name, size) in [("pixel_uas", pixel_uas), ("pixel_m", pixel_m)] {
            if let Some(size) = size.filter(|size| !(*size > 0.0 && size.is_finite())) {
                return Err(faults::wrong(format!("{name} is {size}: give a positive number")));
            }
        }
        let values = values.as_array().iter().copied().collect();
        let mut inner = work::shortly(|| measure::Picture::of_values(width, height, values))?
            .map_err(|fault| faults::wrong(format!("{fault}; {}", fault.mend())))?;
        inner.pixel.microarcseconds = pixel_uas;
        inner.pixel.gravitational_radii = pixel_m;
        Ok(Self { inner })
    }

    /// What was drawn: its physical intensity, or the mean of its colours where there is none.
    #[staticmethod]
    fn of_film(film: &Film) -> PyResult<Self> {
        let images = film.images();
        let [width, height] = images.size().map(|edge| edge as usize);
        let light = &film.film().light;
        let values = match images.intensity() {
            Some(image) => (0..light.len()).map(|pixel| image.value(pixel)).collect(),
            None => light.iter().map(|rgb| rgb.iter().copied().map(f64::from).sum::<f64>() / 3.0).collect(),
        };
        let mut inner = work::shortly(|| measure::Picture::of_values(width, height, values))?
            .map_err(|fault| faults::wrong(format!("{fault}; {}", fault.mend())))?;
        inner.pixel.gravitational_radii = images.pixel();
        inner.pixel.microarcseconds =
            images.pixel().zip(film.microarcseconds()).map(|(pixel, theta)| pixel * theta);
        inner.physical = images.intensity().is_some();
        Ok(Self { inner })
    }
}
