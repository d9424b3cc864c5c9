//! Rays in Boyer–Lindquist coordinates: what they cost at the axis and at the horizon.
//!
//! The coordinates (t, r, θ, φ) are singular at both. Next to the axis φ and p_θ of a ray with little angular momentum L
//! change by a whole turn within sin θ ≈ L, so that steps of constant size jump over it and adaptive ones become many;
//! at the horizon p_r and t grow without bound, and rays end just outside. All else is as in Kerr–Schild
//! coordinates, and what is found is said in the same terms: the two can be laid side by side.

mod flow;
mod start;
mod tracer;
mod walk;

pub use tracer::SphericalIntegrator;

#[cfg(test)]
mod tests;
