//! All tests from outside in one program: built and linked once, and run side by side.

mod fits;
mod silhouette;
mod theory;
mod traced;
