//! All tests from outside in one program: built and linked once, and run side by side.

mod abreast;
mod axis;
mod common;
mod conservation;
mod departures;
mod derivatives;
mod dual;
mod emitter;
mod engines;
mod formulas;
mod inside;
mod kerr_rays;
mod landings;
mod lanes;
mod methods;
mod metrics;
mod observers;
mod obstacles;
mod pitfalls;
mod poles;
mod queries;
mod regions;
mod schwarzschild_orbit;
mod shadow;
mod shapiro;
mod straight;
