//! All tests from outside in one program: built and linked once, and run side by side.

mod common;
mod fit;
mod line;
mod manual;
mod measure;
mod numbers;
mod render;
mod resume;
mod spacetime;
mod survey;
mod view;
mod view_abuse;
mod view_page;
