//! Rays around a Kerr hole in closed form.
//!
//! The equations of motion separate in Mino time τ. Motion in θ is a pendulum's, known by the Fourier series of
//! Jacobi's functions (`polar`); the radius at a given τ is a rational function of Weierstrass's ℘
//! (`weierstrass`); azimuth and time along the radial motion are regularised integrals, done by
//! Gauss–Legendre quadrature in a variable that is smooth up to the critical curve (`radial`).
//!
//! All of it is generic over its [`Scalar`](crate::Scalar): [`Impact`] gives derivatives of what a ray meets.
//!
//! This is independent of the integrator but for the constants of a ray, and each tests the other.
//!
//! Literature: Dexter & Agol 2009, ApJ 696, 1616; Gralla & Lupsasca 2020, PRD 101, 044032; Cieślik & Mach
//! 2022, CQG 39, 225003 (radius by ℘).

mod batch;
mod course;
mod distant;
mod factors;
mod horizons;
mod impact;
mod kernel;
mod landing;
mod photon;
mod planar;
mod polar;
mod quadrature;
mod radial;
mod ready;
mod series;
mod tracer;
mod vortical;
mod weierstrass;

pub use impact::{Impact, ImpactCrossing, ImpactPath, Tables};
pub use landing::{Landing, Landings};
pub use quadrature::Nodes;
pub(crate) use tracer::windings;
pub use tracer::{ClosedForm, NODES};
