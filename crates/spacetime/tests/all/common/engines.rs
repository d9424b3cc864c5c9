//! The closed form beside the integrator, which shares nothing with it but a ray's start.

use super::{folded, follow, separation};
use kerrscope_spacetime::closed::{ClosedForm, NODES};
use kerrscope_spacetime::geodesic::{Integrator, Path, Query, Ray, Scheme};
use kerrscope_spacetime::metric::{Kerr, Metric};
use kerrscope_spacetime::observer::{Motion, Observer, Place};

pub const TIMED: Query =
    Query { plane: [0.0, 0.0, 1.0], max_crossings: 8, elapsed: true, windings: false, points: 0 };

/// What the closed form finds.
pub fn closed(spin: f64, ray: &Ray, query: &Query) -> Path {
    follow(&ClosedForm::new(spin, NODES, 10_000), ray, query)
}

/// What the integrator finds at its tightest.
pub fn integrated(spin: f64, ray: &Ray) -> Path {
    let scheme = Scheme::Dop853 { tolerance: 1e-14 };
    follow(&Integrator::new(Kerr::new(spin), scheme, 100_000).boxed(), ray, &TIMED)
}

/// The ray of an observer of no angular momentum that looks along a direction (outwards, along θ, along φ).
pub fn seen(spin: f64, r: f64, theta: f64, direction: [f64; 3]) -> Ray {
    let length = direction.iter().map(|c| c * c).sum::<f64>().sqrt();
    let place = Place { r, theta, phi: 0.3 };
    let observer = Observer::new(Some(spin), place, Motion::ZeroAngularMomentum).unwrap();
    observer.ray(direction.map(|c| c / length))
}

/// The ray of the impact parameters (α, β) that sets out outwards from azimuth 0.3: seen by the observer of no
/// angular momentum along n_φ = λE√(Σ/A)/sin θ, n_θ = p_θE/√Σ, E = α/(1 − ωλ) with its lapse α = √(ΣΔ/A) and
/// ω = 2sr/A, A = (r² + s²)² − s²Δ sin²θ.
pub fn outward(spin: f64, r: f64, theta: f64, [alpha, beta]: [f64; 2]) -> Ray {
    let (s, (sin, cos)) = (-spin, theta.sin_cos());
    let (sigma, delta) = (r * r + s * s * cos * cos, r * r - 2.0 * r + s * s);
    let area = (r * r + s * s).powi(2) - s * s * delta * sin * sin;
    let lambda = alpha * sin;
    let energy = (sigma * delta / area).sqrt() / (1.0 - 2.0 * s * r / area * lambda);
    let n_phi = alpha * energy * (sigma / area).sqrt();
    let n_theta = -beta * energy / sigma.sqrt();
    seen(spin, r, theta, [(1.0 - n_phi * n_phi - n_theta * n_theta).sqrt(), n_theta, n_phi])
}

/// The largest difference of two paths with the same fate and as many crossings: in direction and azimuth (but for
/// whole turns), 1/r and time relative to where it is.
#[track_caller]
pub fn difference(one: &Path, other: &Path) -> f64 {
    assert_eq!(one.fate, other.fate, "{one:?}\n{other:?}");
    assert_eq!(one.crossings.len(), other.crossings.len(), "{one:?}\n{other:?}");
    let sky = match (one.direction, other.direction) {
        (Some(a), Some(b)) => separation(a, b),
        (None, None) => 0.0,
        _ => f64::NAN,
    };
    let crossings = one.crossings.iter().zip(&other.crossings).flat_map(|(a, b)| {
        let place = (0..2).map(|i| (a.position[i] - b.position[i]).abs()).fold(0.0, f64::max);
        let size = b.r.max(0.01 * b.r * b.r);
        [(a.r - b.r).abs() / size, folded(a.phi - b.phi).abs(), place / size, {
            (a.elapsed - b.elapsed).abs() / b.elapsed.abs().max(size)
        }]
    });
    super::largest(crossings.chain([sky]))
}

/// The difference between both engines, over what nearness to the critical curve multiplies errors by.
#[track_caller]
pub fn disagreement(spin: f64, ray: &Ray) -> f64 {
    let (closed, integrated) = (closed(spin, ray, &TIMED), integrated(spin, ray));
    difference(&closed, &integrated) / Kerr::new(-spin).sensitivity(ray.energy, &ray.start)
}
