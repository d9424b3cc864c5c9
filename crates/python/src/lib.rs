//! The compiled part of the Python package `kerrscope`: what the library does, with numpy's arrays and Python's exceptions.
//!
//! The package's own modules (`python/kerrscope`) are what people import; this one takes and gives plain numbers, texts and
//! arrays. Long work runs without the interpreter's lock, in a pool of threads of its own, and stops at Ctrl-C (`work`).

#![allow(
    clippy::needless_pass_by_value,
    reason = "arguments are taken out of Python's values: no one else has them"
)]

mod arrays;
mod faults;
mod film;
mod fit;
mod model;
mod numbers;
mod picture;
mod rays;
mod scene;
mod survey;
mod work;

use pyo3::prelude::pymodule;

#[pymodule]
mod _core {
    #[pymodule_export]
    use super::film::Film;
    #[pymodule_export]
    use super::fit::{Fit, fit};
    #[pymodule_export]
    use super::model::Model;
    #[pymodule_export]
    use super::numbers::{critical_points, level, measure, orbits, shadow, version};
    #[pymodule_export]
    use super::picture::Picture;
    #[pymodule_export]
    use super::rays::trace;
    #[pymodule_export]
    use super::scene::Scene;
    #[pymodule_export]
    use super::survey::{Plan, worker};
}
