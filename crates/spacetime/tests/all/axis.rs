//! The spin axis, where Boyer–Lindquist coordinates are singular and nothing else is.

use crate::common;

use common::{Worst, distance, folded, follow, impact};
use kerrscope_spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme};
use kerrscope_spacetime::metric::Kerr;
use kerrscope_spacetime::observer::{Motion, Observer, Place};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const SPINS: [f64; 5] = [0.0, 0.5, 0.9, -0.998, 1.0];

fn trace(spin: f64, ray: &Ray) -> Path {
    let query = Query { elapsed: true, ..Query::default() };
    follow(
        &Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-13 }, 10_000).boxed(),
        ray,
        &query,
    )
}

/// What two paths differ by, the second having been turned by `angle` about the axis.
fn difference(a: &Path, b: &Path, angle: f64, label: &str) -> f64 {
    assert_eq!(a.fate, b.fate, "{label}");
    assert_eq!(a.crossings.len(), b.crossings.len(), "{label}");
    let mut worst: f64 = 0.0;
    let mut see = |error: f64| worst = if error > worst || error.is_nan() { error } else { worst };
    if let (Some(p), Some(q)) = (a.direction, b.direction) {
        see((p[0] - q[0]).abs());
        see(folded(q[1] - p[1] - angle).abs() * p[0].sin());
    }
    for (p, q) in a.crossings.iter().zip(&b.crossings) {
        let (sin, cos) = angle.sin_cos();
        let [x, y, z] = p.position;
        see(distance([cos * x - sin * y, sin * x + cos * y, z], q.position) / p.r);
        see((q.r / p.r - 1.0).abs());
        see((q.elapsed - p.elapsed).abs() / p.r);
        see(folded(q.phi - p.phi - angle).abs());
    }
    worst
}

/// A direction at angle χ from straight down, at the given azimuth about the camera's vertical.
fn looking(chi: f64, azimuth: f64) -> [f64; 3] {
    let (sin, cos) = chi.sin_cos();
    [-cos, sin * azimuth.cos(), sin * azimuth.sin()]
}

/// On the axis a quarter of a turn of the picture is a quarter of a turn of everything seen, and
/// azimuths and directions are those that the picture shows.
#[test]
fn camera_on_the_axis() {
    let mut worst = Worst::default();
    for spin in SPINS {
        for theta in [0.0, PI] {
            // Seen from below, the picture's turn is about −z.
            let sense = if theta == 0.0 { 1.0 } else { -1.0 };
            for chi in [0.05, 0.4, 0.9, 1.3, 2.0, 3.0] {
                for (r, motion) in [
                    (3.0, Motion::Static),
                    (3.0, Motion::Fall),
                    (30.0, Motion::ZeroAngularMomentum),
                    (30.0, Motion::Velocity([0.1, 0.0, 0.0])),
                ] {
                    let observer = Observer::new(Some(spin), Place { r, theta, phi: 0.7 }, motion).unwrap();
                    for azimuth in [0.0, 0.3, 2.0, 3.5] {
                        let first = trace(spin, &observer.ray(looking(chi, azimuth)));
                        for quarter in [FRAC_PI_2, PI, -FRAC_PI_2] {
                            let second = trace(spin, &observer.ray(looking(chi, azimuth + quarter)));
                            let label = format!(
                                "a = {spin}, θ = {theta}, {motion:?}, r = {r}, χ = {chi}, {azimuth}, {quarter}"
                            );
                            worst.see(difference(&first, &second, sense * quarter, &label), || label.clone());
                        }
                    }
                }
            }
            // From infinity: (α, β) lies at azimuth atan2(α, −β) as seen from above.
            for b in [1.0, 3.0, 8.0, 20.0] {
                let at = |angle: f64| impact(spin, theta, f64::INFINITY, b * angle.sin(), -b * angle.cos());
                for azimuth in [0.0, 0.3, 2.0, 3.5] {
                    let first = trace(spin, &at(azimuth));
                    for quarter in [FRAC_PI_2, PI, -FRAC_PI_2] {
                        let label = format!("a = {spin}, θ = {theta}, b = {b}, {azimuth}, {quarter}");
                        let second = trace(spin, &at(azimuth + quarter));
                        worst.see(difference(&first, &second, sense * quarter, &label), || label.clone());
                    }
                }
            }
        }
    }
    worst.below(1e-12, "quarter turns");
}

/// The azimuth of what a camera on the axis sees, at a = 0 where nothing drags it.
#[test]
fn azimuths_seen_from_the_axis() {
    let mut worst = Worst::default();
    for theta in [0.0, PI] {
        for k in 0..24 {
            let azimuth = TAU * f64::from(k) / 24.0 - 3.0;
            let observer =
                Observer::new(Some(0.0), Place { r: 20.0, theta, phi: 0.7 }, Motion::Static).unwrap();
            // e_θ points away from the axis above the hole and towards it below.
            let place = if theta == 0.0 { 0.7 + azimuth } else { 0.7 + PI - azimuth };
            for (ray, expected) in [
                (observer.ray(looking(0.5, azimuth)), place),
                (
                    impact(0.0, theta, f64::INFINITY, 9.0 * azimuth.sin(), -9.0 * azimuth.cos()),
                    if theta == 0.0 { azimuth } else { PI - azimuth },
                ),
            ] {
                let crossing = trace(0.0, &ray).crossings[0];
                worst.see(folded(crossing.phi - expected).abs(), || {
                    format!("θ = {theta}, {azimuth}, {ray:?}")
                });
                // Counted from the azimuth in which the ray leaves.
                worst
                    .see((crossing.phi - ray.azimuth).abs(), || format!("unwrapped, θ = {theta}, {azimuth}"));
            }
        }
    }
    worst.below(5e-15, "azimuths");
}

/// Next to the axis everything is next to what it is on it.
#[test]
fn camera_next_to_the_axis() {
    let mut worst = Worst::default();
    for spin in SPINS {
        for theta in [0.0, PI] {
            for (r, chi) in [(5.0, 0.2), (5.0, 1.1), (30.0, 0.1), (30.0, 0.35), (30.0, 1.0), (30.0, 2.5)] {
                for azimuth in [0.4, 1.9, 3.3, 5.5] {
                    let at = |offset: f64| {
                        let place = Place { r, theta: (theta - offset).abs(), phi: 0.7 };
                        let observer = Observer::new(Some(spin), place, Motion::ZeroAngularMomentum).unwrap();
                        trace(spin, &observer.ray(looking(chi, azimuth)))
                    };
                    let on = at(0.0);
                    for offset in [1e-3, 1e-5, 1e-7, 1e-9] {
                        let label =
                            format!("a = {spin}, θ = {theta} − {offset}, r = {r}, χ = {chi}, {azimuth}");
                        let error = difference(&on, &at(offset), 0.0, &label);
                        worst.see(error / (offset + 1e-12), || label);
                    }
                }
            }
            for b in [1.0, 3.0, 8.0, 20.0] {
                for azimuth in [0.4, 1.9, 3.3, 5.5_f64] {
                    let (alpha, beta) = (b * azimuth.sin(), -b * azimuth.cos());
                    let on = trace(spin, &impact(spin, theta, f64::INFINITY, alpha, beta));
                    for offset in [1e-3, 1e-5, 1e-7, 1e-9] {
                        let label = format!("a = {spin}, θ = {theta} − {offset}, b = {b}, {azimuth}");
                        let ray = impact(spin, (theta - offset).abs(), f64::INFINITY, alpha, beta);
                        worst
                            .see(difference(&on, &trace(spin, &ray), 0.0, &label) / (offset + 1e-12), || {
                                label
                            });
                    }
                }
            }
        }
    }
    // The error is that of the picture's shift by the offset, times what the lens makes of it.
    worst.below(30.0, "difference over offset");
}

/// Rays that pass the axis on either side, ever closer: where they end is continuous, and the
/// unwrapped azimuth jumps by 2π for each time that the axis is passed, having no other jumps.
#[test]
fn rays_past_the_axis() {
    let mut worst = Worst::default();
    let mut passed = 0;
    for spin in SPINS {
        for inclination in [0.4_f64, 1.2, FRAC_PI_2, 2.5] {
            for beta in [-12.0, -7.0, -3.0, 2.0, 4.0, 6.5, 9.0] {
                let at = |alpha: f64| trace(spin, &impact(spin, inclination, f64::INFINITY, alpha, beta));
                let through = at(0.0);
                for side in [1.0, -1.0] {
                    for offset in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
                        let label =
                            format!("a = {spin}, i = {inclination}, α = {}, β = {beta}", side * offset);
                        let path = at(side * offset);
                        worst.see(difference(&through, &path, 0.0, &label) / (offset + 1e-12), || label);
                    }
                }
                let azimuths = |path: &Path| {
                    let last = path.direction.map(|d| d[1]);
                    path.crossings.iter().map(|c| c.phi).chain(last).collect::<Vec<_>>()
                };
                let (right, left) = (azimuths(&at(1e-9)), azimuths(&at(-1e-9)));
                let (far_right, far_left) = (azimuths(&at(1e-7)), azimuths(&at(-1e-7)));
                let mut turns = 0.0;
                for k in 0..right.len() {
                    assert!((right[k] - far_right[k]).abs() < 1e-5, "{right:?} {far_right:?}");
                    assert!((left[k] - far_left[k]).abs() < 1e-5, "{left:?} {far_left:?}");
                    let between = (right[k] - left[k]) / TAU;
                    assert!((between - between.round()).abs() < 1e-6, "{between}");
                    // From one crossing to the next the axis is passed once at most, and so from
                    // the camera to the first; always with λ > 0 on the right.
                    let step = between.round() - turns;
                    assert!(
                        step == 0.0 || step == 1.0,
                        "a = {spin}, i = {inclination}, β = {beta}: {right:?} {left:?}"
                    );
                    passed += i32::from(step == 1.0);
                    turns = between.round();
                }
            }
        }
    }
    assert!(passed > 100);
    worst.below(400.0, "difference over offset");
}

/// Straight along the axis: through the hole's centre, and away from it.
#[test]
fn rays_along_the_axis() {
    for spin in SPINS {
        for theta in [0.0, PI] {
            let observer =
                Observer::new(Some(spin), Place { r: 10.0, theta, phi: 0.0 }, Motion::Static).unwrap();
            let inwards = trace(spin, &observer.ray([-1.0, 0.0, 0.0]));
            assert_eq!((inwards.fate, inwards.crossings.len()), (Fate::Captured, 0));
            let outwards = trace(spin, &observer.ray([1.0, 0.0, 0.0]));
            assert_eq!(outwards.fate, Fate::Escaped);
            let [got, phi] = outwards.direction.unwrap();
            assert!((got - theta).abs() < 1e-15 && phi.is_finite());
            let centre = trace(spin, &impact(spin, theta, f64::INFINITY, 0.0, 0.0));
            assert_eq!(centre.fate, Fate::Captured);
        }
    }
}
