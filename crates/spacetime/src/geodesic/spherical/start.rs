//! From a ray in Kerr–Schild coordinates to Boyer–Lindquist ones, and back to a place.
//!
//! x + iy = (r + is) sin θ e^{iφ̃}, z = r cos θ; φ̃ = φ + s/(r₊ − r₋) ln((r − r₊)/(r − r₋)); and
//! p_r^KS = p_r + (2rE − sL)/Δ (see [`crate::metric::Kerr`], whose spin is called s).

use super::super::ray::Ray;
use super::flow::WIDTH;
use crate::metric::{Inverted, Kerr, Metric, scaled_radius};
use crate::tensor::Vec3;

/// (u, θ, φ, p_r, p_θ, 0) of a ray around a hole, outside its horizon.
pub fn state(hole: Kerr, ray: &Ray) -> [f64; WIDTH] {
    let s = hole.spin();
    let mut ray = *ray;
    ray.aim_azimuth();
    let Inverted { w, n, q, j } = ray.start;
    let k = [j[1] * n[2] - j[2] * n[1], j[2] * n[0] - j[0] * n[2], j[0] * n[1] - j[1] * n[0]];
    // w r and w √(r² + s²), which are finite at infinity.
    let height = scaled_radius(s, &ray.start);
    let breadth = height.hypot(w * s);
    let u = w / height;
    let cos = (n[2] / height).clamp(-1.0, 1.0);
    let sin = n[0].hypot(n[1]) / breadth;
    let (across_sin, across_cos) = ray.azimuth.sin_cos();
    let flat = |v: Vec3<f64>| v[0] * across_cos + v[1] * across_sin;
    // p_θ = ∂x^i/∂θ p_i with p = q n + w k; the terms in q leave q w s² sin θ cos θ.
    let p_theta = q * w * s * s * sin * cos + breadth * cos * flat(k) - height * sin * k[2];
    // ∂x^i/∂r = (sin θ cos φ′, sin θ sin φ′, cos θ), φ′ = φ̃ being the azimuth of n less atan2(s, r).
    let turn = (w * s).atan2(height);
    let (out_sin, out_cos) = (ray.azimuth - turn).sin_cos();
    let p: Vec3<f64> = std::array::from_fn(|i| q * n[i] + w * k[i]);
    let p_kerr_schild = sin * (out_cos * p[0] + out_sin * p[1]) + cos * p[2];
    // (2rE − sL)/Δ = (2uE − s u² L)/(1 − 2u + s²u²)
    let pull = (2.0 * u * ray.energy - s * u * u * j[2]) / (1.0 - 2.0 * u + s * s * u * u);
    let offset = if u > 0.0 { hole.azimuth_offset(u.recip()) } else { 0.0 };
    [u, sin.atan2(cos), ray.azimuth - offset, p_kerr_schild - pull, p_theta, 0.0]
}

/// u times the Kerr–Schild place of u, θ, φ.
pub fn direction(hole: Kerr, u: f64, theta: f64, phi: f64) -> Vec3<f64> {
    let s = hole.spin() * u;
    let (sin, cos) = theta.sin_cos();
    let offset = if u > 0.0 { hole.azimuth_offset(u.recip()) } else { 0.0 };
    let (turn_sin, turn_cos) = (phi + offset).sin_cos();
    let breadth = s.hypot(1.0) * sin;
    [breadth * turn_cos, breadth * turn_sin, cos]
}
