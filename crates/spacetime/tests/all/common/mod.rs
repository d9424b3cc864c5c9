//! What several of the integration tests use.

// Each test file compiles this module for itself and uses a part of it.
#![allow(dead_code)]

pub mod engines;
pub mod mino;
pub mod orbit;

use kerrscope_spacetime::geodesic::{Path, Query, Ray, Tracer};
use kerrscope_spacetime::observer::impact_ray;
use std::f64::consts::{PI, TAU};

/// Random numbers that are the same on every run and machine (SplitMix64: Steele, Lea & Flood 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly in [low, high).
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Evenly in the logarithm.
    pub fn scale(&mut self, low: f64, high: f64) -> f64 {
        self.within(low.ln(), high.ln()).exp()
    }

    pub fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[(self.next() % choices.len() as u64) as usize]
    }

    /// Evenly on the sphere.
    pub fn direction(&mut self) -> [f64; 3] {
        let z = self.within(-1.0, 1.0);
        let (sin, cos) = self.within(0.0, TAU).sin_cos();
        let ring = (1.0 - z * z).sqrt();
        [ring * cos, ring * sin, z]
    }
}

/// The path of one ray.
pub fn follow(tracer: &impl Tracer, ray: &Ray, query: &Query) -> Path {
    let mut path = Path::default();
    tracer.trace(ray, query, &mut path);
    path
}

/// The ray of screen coordinates (α, β) in Kerr.
pub fn impact(spin: f64, inclination: f64, r: f64, alpha: f64, beta: f64) -> Ray {
    impact_ray(Some(spin), inclination, r, [alpha, beta]).expect("such a photon")
}

/// The unit vector of (θ, φ).
pub fn unit([theta, phi]: [f64; 2]) -> [f64; 3] {
    let (sin, cos) = theta.sin_cos();
    [sin * phi.cos(), sin * phi.sin(), cos]
}

/// |a − b|.
pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// The angle between two directions (θ, φ).
pub fn separation(a: [f64; 2], b: [f64; 2]) -> f64 {
    2.0 * (0.5 * distance(unit(a), unit(b))).min(1.0).asin()
}

/// An angle folded into [−π, π].
pub fn folded(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// The largest of many numbers, NaN if one of them is: `f64::max` would drop it.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

/// Remembers the largest error and where it was.
#[derive(Default)]
pub struct Worst {
    pub error: f64,
    place: String,
    pub count: usize,
}

impl Worst {
    /// A NaN stays.
    pub fn see(&mut self, error: f64, place: impl FnOnce() -> String) {
        self.count += 1;
        if !self.error.is_nan() && !(error <= self.error) {
            self.error = error;
            self.place = place();
        }
    }

    /// Fails if an error exceeds `tolerance`, or if there was none to judge.
    #[track_caller]
    pub fn below(&self, tolerance: f64, what: &str) {
        println!("{what}: {:.2e} of {tolerance:.0e} ({} cases; {})", self.error, self.count, self.place);
        assert!(self.count > 0, "{what}: nothing was compared");
        assert!(self.error <= tolerance, "{what}: {:e} > {tolerance:e} at {}", self.error, self.place);
    }
}

pub const DEGREE: f64 = PI / 180.0;
