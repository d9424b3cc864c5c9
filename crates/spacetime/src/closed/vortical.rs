//! The motion of a photon in θ that never meets the equatorial plane (η < 0).
//!
//! w± are the bounds of μ² (Kapec & Lupsasca 2020, arXiv:1905.11406):
//!   w₊ = (B + √(B² + 4s²η))/(2s²),   w₋ = −η/(s²w₊),   μ = ±√w₊ dn(x₀ + |s|√w₊ τ | 1 − w₋/w₊).
//! The same oscillation about the mean of μ² is a pendulum's: with
//!   μ² = w₊ − (w₊ − w₋) sin²χ,   χ′ = |s| |μ|,
//! so that χ grows for ever; its azimuth is a quadrature over χ of a smooth periodic function.

use std::f64::consts::PI;

use super::photon::{Photon, Potential};
use super::quadrature::Nodes;

/// The motion of a vortical photon.
#[derive(Clone, Copy, Debug)]
pub struct Vortex {
    spin: f64,
    lambda: f64,
    upper: f64,
    lower: f64,
    hemisphere: f64,
    start: f64,
}

impl Vortex {
    /// The motion of a photon with η < 0.
    pub fn new(photon: &Photon<f64>) -> Self {
        let Photon { spin, lambda, eta, mu, mu_rate, .. } = *photon;
        let b = Potential::new(photon).b;
        let s2 = spin * spin;
        let upper = (b + (b * b + 4.0 * s2 * eta).max(0.0).sqrt()) / (2.0 * s2);
        let lower = (-eta / (s2 * upper)).min(upper);
        // d(μ²)/dτ = −(w₊ − w₋) sin 2χ χ′: |μ| falls while χ runs from 0 to π/2.
        let square = (mu * mu).clamp(lower, upper);
        let (sin, cos) = ((upper - square).sqrt(), (square - lower).sqrt());
        let start = sin.atan2(cos).copysign(-mu * mu_rate);
        Self { spin: spin.abs(), lambda, upper, lower, hemisphere: 1f64.copysign(mu), start }
    }

    fn square(&self, chi: f64) -> f64 {
        let sin = chi.sin();
        self.upper - (self.upper - self.lower) * sin * sin
    }

    /// ∫dχ/(|s||μ|) and λ∫dχ/(|s||μ|(1 − μ²)) from the start.
    fn integrals(&self, to: f64, nodes: &Nodes) -> [f64; 2] {
        // Panels of a quarter of a period.
        let panels = ((to - self.start).abs() / (0.25 * PI)).ceil().max(1.0);
        let half = 0.5 * (to - self.start) / panels;
        let mut sums = [0.0; 2];
        for panel in 0..panels as usize {
            let middle = self.start + half * (2 * panel + 1) as f64;
            for &(x, w) in nodes.half() {
                for x in [x, -x] {
                    let square = self.square(middle + half * x);
                    let share = w * half / (self.spin * square.sqrt());
                    sums[0] += share;
                    sums[1] += share * self.lambda / (1.0 - square);
                }
            }
        }
        sums
    }

    /// θ and azimuth after Mino time τ.
    pub fn at(&self, tau: f64, nodes: &Nodes) -> [f64; 2] {
        let mut chi = self.start + tau * self.spin * self.upper.sqrt();
        for _ in 0..40 {
            let step = (self.integrals(chi, nodes)[0] - tau) * self.spin * self.square(chi).sqrt();
            chi -= step;
            if step.abs() < 1e-15 * chi.abs().max(1.0) {
                break;
            }
        }
        let mu = self.hemisphere * self.square(chi).sqrt();
        let theta = (1.0 - mu * mu).max(0.0).sqrt().atan2(mu);
        [theta, self.integrals(chi, nodes)[1]]
    }
}
