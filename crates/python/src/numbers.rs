//! Numbers of holes and pictures, as the program's commands print them.

use kerrscope::measure::Features;
use kerrscope::spacetime::Level;
use kerrscope::spacetime::kerr::{CriticalCurve, Orbits};
use numpy::PyArrayDyn;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::shaped;
use crate::faults::wrong;
use crate::picture::Picture;
use crate::work::{self, Told};

/// The version of the program.
#[pyfunction]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// The best vector instructions of this processor.
#[pyfunction]
pub fn level() -> &'static str {
    Level::best().name()
}

/// A spin in [−1, 1].
///
/// # Errors
/// If it is none.
pub fn known_spin(spin: f64) -> PyResult<f64> {
    if (-1.0..=1.0).contains(&spin) {
        Ok(spin)
    } else {
        Err(wrong(format!("spin is {spin}: a spin lies between -1 and 1")))
    }
}

/// Degrees in [0, 180], in radians.
///
/// # Errors
/// If they are not.
pub fn known_inclination(degrees: f64) -> PyResult<f64> {
    if (0.0..=180.0).contains(&degrees) {
        Ok(degrees.to_radians())
    } else {
        Err(wrong(format!("inclination is {degrees}: an inclination lies between 0 and 180 degrees")))
    }
}

/// As `kerrscope orbits --format json`.
#[pyfunction]
pub fn orbits(py: Python<'_>, spin: f64) -> PyResult<Bound<'_, PyDict>> {
    let o = Orbits::new(known_spin(spin)?);
    let dict = PyDict::new(py);
    for (name, value) in [
        ("spin", spin),
        ("horizon", o.horizon),
        ("isco", o.isco),
        ("isco_retrograde", o.isco_retrograde),
        ("photon_prograde", o.photon_prograde),
        ("photon_retrograde", o.photon_retrograde),
        ("impact_prograde", o.impact_prograde),
        ("impact_retrograde", o.impact_retrograde),
        ("efficiency", o.efficiency),
    ] {
        dict.set_item(name, value)?;
    }
    Ok(dict)
}

/// Points of the critical curve, points × 2.
#[pyfunction]
pub fn critical_points(
    py: Python<'_>,
    spin: f64,
    inclination: f64,
    points: usize,
) -> PyResult<Bound<'_, PyArrayDyn<f64>>> {
    let (spin, inclination) = (known_spin(spin)?, known_inclination(inclination)?);
    let found = work::shortly(|| CriticalCurve::new(spin, inclination).points(points))?;
    shaped(py, found.as_flattened().to_vec(), &[points, 2])
}

/// As `kerrscope shadow --format json`, the curve as an array.
#[pyfunction]
pub fn shadow(py: Python<'_>, spin: f64, inclination: f64, points: usize) -> PyResult<Bound<'_, PyDict>> {
    let curve = critical_points(py, spin, inclination, points)?;
    let extent = CriticalCurve::new(spin, known_inclination(inclination)?).extent();
    let dict = PyDict::new(py);
    dict.set_item("spin", spin)?;
    dict.set_item("inclination", inclination)?;
    dict.set_item("alpha_min", extent.alpha_min)?;
    dict.set_item("alpha_max", extent.alpha_max)?;
    dict.set_item("beta_max", extent.beta_max)?;
    dict.set_item("area", extent.area)?;
    dict.set_item("curve", curve)?;
    Ok(dict)
}

/// As `kerrscope measure --format json`, as text.
#[pyfunction]
pub fn measure(py: Python<'_>, picture: &Picture) -> PyResult<String> {
    let features = work::run(py, None, &Told::Nothing, |_| Features::of(&picture.inner))?;
    serde_json::to_string(&features).map_err(wrong)
}
