//! Numbers as numpy's arrays.

use numpy::ndarray::IxDyn;
use numpy::{Element, PyArray1, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::prelude::*;

use crate::faults::wrong;

/// An array of a shape, row by row. The numbers are not copied.
///
/// # Errors
/// If there are not so many.
pub fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyArrayDyn<T>>> {
    PyArray1::from_vec(py, values).reshape(IxDyn(shape))
}

/// The numbers of an array, row by row.
///
/// # Errors
/// If they do not lie so in memory.
pub fn slice<'a>(name: &str, array: &'a PyReadonlyArrayDyn<'_, f64>) -> PyResult<&'a [f64]> {
    array.as_slice().map_err(|_| wrong(format!("{name} has to be contiguous in memory")))
}
