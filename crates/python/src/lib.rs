//! The compiled part of the Python package `kerrscope`.
use pyo3::prelude::*;

/// x
#[pyclass(frozen)]
pub struct Foo {
    x: f64,
}

#[pymethods]
impl Foo {
    /// n
    #[new]
    fn new(x: f64) -> Self {
        Self { x }
    }
    /// g
    #[getter]
    fn x(&self) -> f64 {
        self.x
    }
}

/// f
#[pyfunction]
#[pyo3(signature = (x, y=None))]
fn f(x: f64, y: Option<f64>) -> PyResult<f64> {
    Ok(x + y.unwrap_or(0.0))
}

#[pymodule]
mod _core {
    #[pymodule_export]
    use super::{Foo, f};
}
