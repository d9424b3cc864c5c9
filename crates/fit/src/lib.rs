//! Black holes read off pictures.

pub mod traced;
