//! The edge of the shadow: rays from infinity beside the critical curve, which is known in closed
//! form, escape just outside it and are captured just inside.

use crate::common;

use common::{DEGREE, follow, impact};
use kerrscope_spacetime::geodesic::{Fate, Integrator, Path, Query, Scheme};
use kerrscope_spacetime::kerr::CriticalCurve;
use kerrscope_spacetime::metric::Kerr;
use kerrscope_spacetime::observer::impact_ray;

fn trace(spin: f64, inclination: f64, r: f64, [alpha, beta]: [f64; 2], scheme: Scheme, most: usize) -> Path {
    let tracer = Integrator::new(Kerr::new(spin), scheme, most).boxed();
    let ray = if r.is_infinite() {
        impact(spin, inclination, r, alpha, beta)
    } else {
        impact_ray(Some(spin), inclination, r, [alpha, beta]).unwrap()
    };
    follow(&tracer, &ray, &Query::default())
}

/// A point of the curve, nearer the middle of the shadow or further by a relative offset.
fn beside(curve: &CriticalCurve, point: [f64; 2], offset: f64) -> [f64; 2] {
    let extent = curve.extent();
    let middle = 0.5 * (extent.alpha_min + extent.alpha_max);
    [middle + (point[0] - middle) * (1.0 + offset), point[1] * (1.0 + offset)]
}

/// A relative offset of `offset` on either side, all around.
fn check(spin: f64, degrees: f64, offset: f64, scheme: Scheme, points: usize) {
    let inclination = degrees * DEGREE;
    let curve = CriticalCurve::new(spin, inclination);
    let mut steps = 0;
    for (k, point) in curve.points(points).into_iter().enumerate() {
        for (sign, fate) in [(1.0, Fate::Escaped), (-1.0, Fate::Captured)] {
            let path = trace(
                spin,
                inclination,
                f64::INFINITY,
                beside(&curve, point, sign * offset),
                scheme,
                100_000,
            );
            assert_eq!(
                path.fate, fate,
                "a = {spin}, i = {degrees}°, point {k}, {point:?}: {sign} × {offset}"
            );
            steps = steps.max(path.steps);
        }
    }
    println!("a = {spin}, i = {degrees}°: at most {steps} steps");
}

const DOP853: Scheme = Scheme::Dop853 { tolerance: 1e-10 };

#[test]
fn fates_beside_the_critical_curve() {
    for spin in [0.0, 0.5, 0.9, 0.998, -0.7] {
        for degrees in [0.0, 17.0, 60.0, 90.0, 143.0, 180.0] {
            check(spin, degrees, 1e-6, DOP853, 48);
        }
    }
}

/// The straight side of an extremal hole's shadow is of rays that wind thousands of times.
#[test]
fn fates_beside_an_extremal_shadow() {
    for spin in [1.0, -1.0] {
        for degrees in [0.0, 17.0] {
            check(spin, degrees, 1e-6, DOP853, 48);
        }
        for degrees in [60.0, 90.0] {
            check(spin, degrees, 1e-3, DOP853, 24);
        }
    }
}

/// A looser integrator still knows the edge to within its tolerance.
#[test]
fn fates_by_other_methods() {
    for spin in [0.0, 0.9, -0.7] {
        check(spin, 60.0, 1e-5, Scheme::Tsit5 { tolerance: 1e-6 }, 24);
        check(spin, 60.0, 1e-4, Scheme::Dop853 { tolerance: 1e-5 }, 24);
    }
}

/// Far from it the middle is captured and the outside escapes, at any finite distance of the
/// camera too: the curve in (α, β) is one of λ and η.
#[test]
fn fates_from_cameras() {
    for spin in [0.0, 0.9, -0.998] {
        for degrees in [5.0, 60.0, 90.0] {
            let inclination = degrees * DEGREE;
            let curve = CriticalCurve::new(spin, inclination);
            for r in [20.0, 1000.0] {
                for point in curve.points(24) {
                    for (sign, fate) in [(1.0, Fate::Escaped), (-1.0, Fate::Captured)] {
                        let path =
                            trace(spin, inclination, r, beside(&curve, point, sign * 1e-6), DOP853, 10_000);
                        assert_eq!(path.fate, fate, "a = {spin}, i = {degrees}°, r = {r}, {point:?}");
                    }
                }
            }
        }
    }
}
