//! Single rays in the manner of the thesis's program, all of it or some of its parts.
//!
//! Kamminga's "Imaging a Kerr Black Hole" (2022), chapter 4, and its program as published (github.com/thomaskamminga/RayTracingUsingRelativity,
//! commit 76c418c) follow a ray so:
//!
//! - by classical RK4 with a constant step of 1.5 M, in place and velocity: ẍ^μ = −Γ^μ_στ ẋ^σ ẋ^τ with (x, ẋ, ṫ) as the state;
//! - what it meets is looked for on the chords between the ends of steps;
//! - into the past in ingoing Kerr–Schild coordinates with the real spin, in which the horizon is not reached;
//! - from (|ẋ| = 1, ṫ = −1) at the camera, which is light in flat space only: g(ẋ, ẋ) is not 0 but f (l·ẋ)², 0.27 at 30 M. The camera is in
//!   Kerr–Schild Cartesian coordinates, as is the direction;
//! - the hole is a sphere of R = 2 M for any spin, and the disk is as wide as said in R, both Cartesian: r² = R² − a² in the disk's plane.
//!
//! Without these parts a ray is that of [`crate::camera::Camera`], light as an observer at rest sees it, followed in the spacetime reversed in
//! time, met on a curve, and the hole and the disk are measured by Boyer–Lindquist's r.

use serde::Serialize;

use crate::camera::Camera;
use crate::spacetime::Dual;
use crate::spacetime::geodesic::{Flow, Method, Ray, Rk4};
use crate::spacetime::metric::{Kerr, Metric};
use crate::spacetime::tensor::{Vec3, Vec4, contract, dot};

/// The thesis's step, M.
pub const THESIS_STEP: f64 = 1.5;
/// Radius of the sphere that stands for the hole, M.
const SPHERE: f64 = 2.0;
/// Steps of a ray times their length, M: beyond, it is given up as one that the hole keeps.
const LONGEST: f64 = 1200.0;

/// What of the thesis's manner is followed besides RK4 in place and velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "each is a part that may be there or not")]
pub struct Manner {
    /// The step of RK4, M.
    pub step: f64,
    /// Chords between the ends of steps.
    pub chords: bool,
    /// Ingoing coordinates with the real spin.
    pub sheet: bool,
    /// |ẋ| = 1 and |ṫ| = 1 at the start.
    pub start: bool,
    /// Hole and disk in Cartesian coordinates.
    pub bodies: bool,
}

/// A part of it.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Part {
    /// RK4 with a step of 1.5 M.
    Step,
    /// [`Manner::chords`].
    Chords,
    /// [`Manner::sheet`].
    Sheet,
    /// [`Manner::start`].
    Start,
    /// [`Manner::bodies`].
    Bodies,
}

impl Part {
    /// All, each after those without which it means little.
    pub const ALL: [Self; 5] = [Self::Step, Self::Chords, Self::Sheet, Self::Start, Self::Bodies];

    /// What it is.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Step => "RK4 with steps of 1.5 M",
            Self::Chords => "chords between their ends",
            Self::Sheet => "ingoing coordinates",
            Self::Start => "velocity 1 at the start, not null",
            Self::Bodies => "hole and disk by Cartesian radius",
        }
    }
}

impl Manner {
    /// RK4 with this step and none of the other parts.
    pub const fn plain(step: f64) -> Self {
        Self { step, chords: false, sheet: false, start: false, bodies: false }
    }

    /// With these parts, in any order; without [`Part::Step`] the step is a fifteenth of the thesis's.
    pub fn of(parts: &[Part]) -> Self {
        let has = |part| parts.contains(&part);
        Self {
            step: if has(Part::Step) { THESIS_STEP } else { THESIS_STEP / 15.0 },
            chords: has(Part::Chords),
            sheet: has(Part::Sheet),
            start: has(Part::Start),
            bodies: has(Part::Bodies),
        }
    }
}

/// What follows rays in a manner, from one camera.
pub(super) struct Follower {
    manner: Manner,
    /// The chart's metric.
    metric: Kerr,
    /// Sign of ṫ: 1 in the spacetime reversed in time.
    sense: f64,
    /// Distance and inclination (radians) of the camera.
    place: [f64; 2],
}

impl Follower {
    /// A camera at a distance, in M, and an inclination, in radians, from a hole with a spin.
    pub fn new(manner: Manner, spin: f64, place: [f64; 2]) -> Self {
        let (metric, sense) = if manner.sheet { (Kerr::new(spin), -1.0) } else { (Kerr::new(-spin), 1.0) };
        Self { manner, metric, sense, place }
    }

    /// The radius at which the ray of a place on the picture first crosses the disk's plane; none if the hole is met before.
    pub fn radius(&self, camera: &Camera, pixel: [f64; 2], slopes: [f64; 2]) -> Option<f64> {
        let (x, velocity) = if self.manner.start {
            self.unit_start(slopes)
        } else {
            self.light(&camera.ray(pixel[0], pixel[1]).ok()?)
        };
        // A camera in the disk's plane is not above it by a rounding error.
        let height = if x[2].abs() < 1e-9 { 0.0 } else { x[2] };
        let mut y = [x[0], x[1], height, velocity[1], velocity[2], velocity[3], velocity[0]];
        let flow = Accelerated { metric: self.metric };
        let mut slope = flow.derivative(&y);
        let far = 2.0 * dot(&x, &x).sqrt();
        let steps = (LONGEST / self.manner.step) as usize;
        for _ in 0..steps {
            let mut stages = [slope; 4];
            let h = self.manner.step;
            let step = Rk4::step(&flow, &y, &mut stages, h);
            let end = step.end;
            if end.iter().any(|c| !c.is_finite()) {
                return None;
            }
            let end_slope = flow.derivative(&end);
            let crosses = y[2] != 0.0 && (y[2] > 0.0) != (end[2] > 0.0);
            let (from, to) = ([y[0], y[1], y[2]], [end[0], end[1], end[2]]);
            let sphere = if self.manner.bodies { enters(&from, &to) } else { None };
            if crosses {
                let straight = y[2] / (y[2] - end[2]);
                if sphere.is_some_and(|part| part < straight) {
                    return None;
                }
                let at: Vec3<f64> = if self.manner.chords {
                    std::array::from_fn(|k| from[k] + straight * (to[k] - from[k]))
                } else {
                    let dense = Rk4::dense(&flow, &y, &stages, &end, &end_slope, h);
                    let (mut low, mut high) = (0.0, 1.0);
                    for _ in 0..60 {
                        let middle = 0.5 * (low + high);
                        if (dense.component(2, middle) > 0.0) == (y[2] > 0.0) {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    let at = dense.at(0.5 * (low + high));
                    [at[0], at[1], at[2]]
                };
                return if self.manner.bodies {
                    Some(at[0].hypot(at[1])).filter(|r| *r > SPHERE)
                } else {
                    Some(self.metric.radius(&at)).filter(|r| *r > self.metric.horizon())
                };
            }
            let distance = dot(&to, &to).sqrt();
            let inside = !self.manner.bodies && self.metric.radius(&to) <= self.metric.horizon();
            let away = dot(&to, &[end[3], end[4], end[5]]) > 0.0;
            if sphere.is_some() || inside || (distance > far && away) {
                return None;
            }
            (y, slope) = (end, end_slope);
        }
        None
    }

    /// Place and velocity (t first) of the thesis's ray at a place on the picture, whose tangents to the right and up are given.
    fn unit_start(&self, [right, up]: [f64; 2]) -> (Vec3<f64>, Vec4<f64>) {
        let [distance, inclination] = self.place;
        let (sin, cos) = inclination.sin_cos();
        let x = [distance * sin, 0.0, distance * cos];
        // Forwards (−sin i, 0, −cos i), right (0, 1, 0), up (−cos i, 0, sin i).
        let n = [-sin - up * cos, right, -cos + up * sin];
        let size = dot(&n, &n).sqrt();
        (x, [self.sense, n[0] / size, n[1] / size, n[2] / size])
    }

    /// Place and velocity of light as the camera sees it, scaled to |ẋ| = 1.
    fn light(&self, ray: &Ray) -> (Vec3<f64>, Vec4<f64>) {
        // From the spacetime reversed in time to ingoing coordinates with the real spin, minus the photon's momentum.
        let (start, energy) = if self.manner.sheet {
            (self.metric.reversed().change_sheet(ray.energy, &ray.start), -ray.energy)
        } else {
            (ray.start, ray.energy)
        };
        let x = start.n.map(|c| c / start.w);
        let p = start.momentum();
        let velocity = contract(&self.metric.inverse_components(&x), &[-energy, p[0], p[1], p[2]]);
        let size = velocity[1].hypot(velocity[2]).hypot(velocity[3]);
        (x, velocity.map(|c| c / size))
    }
}

/// ẍ^μ = g^{μα}(½ ∂_α g_στ ẋ^σ ẋ^τ − ∂_k g_ατ ẋ^k ẋ^τ), the state being (x, y, z, ẋ, ẏ, ż, ṫ).
struct Accelerated {
    metric: Kerr,
}

impl Flow<f64, 7> for Accelerated {
    fn derivative(&self, y: &[f64; 7]) -> [f64; 7] {
        let x = [y[0], y[1], y[2]];
        let v = [y[6], y[3], y[4], y[5]];
        let lowered = self.metric.components(&Dual::variables(x));
        let mut force = [0.0; 4];
        for a in 0..4 {
            for b in 0..4 {
                let gradient = lowered[a][b].gradient;
                for k in 0..3 {
                    force[k + 1] += 0.5 * gradient[k] * v[a] * v[b];
                    force[a] -= gradient[k] * v[k + 1] * v[b];
                }
            }
        }
        let rate = contract(&self.metric.inverse_components(&x), &force);
        [v[1], v[2], v[3], rate[1], rate[2], rate[3], rate[0]]
    }

    fn inverse_scale(&self, _y: &[f64; 7]) -> [f64; 7] {
        [1.0; 7]
    }
}

/// Where on a chord the sphere that stands for the hole is met.
fn enters(from: &Vec3<f64>, to: &Vec3<f64>) -> Option<f64> {
    let along: Vec3<f64> = std::array::from_fn(|k| to[k] - from[k]);
    let (a, half, c) = (dot(&along, &along), dot(from, &along), dot(from, from) - SPHERE * SPHERE);
    if c <= 0.0 {
        return Some(0.0);
    }
    let root = half * half - a * c;
    let part = (-half - root.sqrt()) / a;
    (root >= 0.0 && (0.0..=1.0).contains(&part)).then_some(part)
}
