//! Rays in metrics as text, against rays of the same holes and against what is published.

use crate::texts;

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use ellip::ellipk;
use kerrscope::sky::towards;
use kerrscope::spacetime::Level;
use kerrscope::spacetime::geodesic::{Fate, Integrator, Path, Query, Ray, Scheme, TextTracer, Tracer};
use kerrscope::spacetime::metric::{Kerr, LineElement, Metric, Text};
use kerrscope::spacetime::observer::{Motion, Observer, Place, impact_ray};
use texts::{element, written};

const FINE: Scheme = Scheme::Dop853 { tolerance: 1e-12 };

fn tracer(element: &Arc<LineElement>) -> TextTracer {
    TextTracer::new(Arc::clone(element), FINE, 20_000)
}

fn follow(tracer: &dyn Tracer, ray: &Ray) -> Path {
    let mut path = Path::default();
    tracer.trace(ray, &Query::default(), &mut path);
    path
}

/// Directions all around.
fn directions(count: usize) -> impl Iterator<Item = [f64; 3]> {
    (0..count).map(move |k| {
        let z = 1.0 - (2.0 * k as f64 + 1.0) / count as f64;
        let (sin, cos) = (2.4 * k as f64).sin_cos();
        let flat = (1.0 - z * z).sqrt();
        // Most towards the hole.
        let v = [-0.6 + 0.5 * z, flat * cos, flat * sin];
        let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
        v.map(|c| c / length)
    })
}

#[test]
fn texts_of_holes_give_the_rays_of_the_holes() {
    for (spin, text) in
        [(0.0, element("schwarzschild-text", &[])), (0.9, element("kerr-text", &[("spin", 0.9)]))]
    {
        let place = Place { r: 20.0, theta: 1.2, phi: 0.3 };
        let observer = Observer::new(Some(spin), place, Motion::ZeroAngularMomentum).unwrap();
        let rays: Vec<Ray> = directions(300).map(|direction| observer.ray(direction)).collect();
        let query = Query { max_crossings: 3, ..Query::default() };
        let mut exact = vec![Path::default(); rays.len()];
        let mut found = exact.clone();
        Integrator::new(Kerr::new(spin), FINE, 20_000).boxed().trace_all(&rays, &query, &mut exact);
        tracer(&text).trace_all(&rays, &query, &mut found);
        let mut compared = 0;
        for ((ray, a), b) in rays.iter().zip(&exact).zip(&found) {
            // Next to the critical curve errors grow.
            let growth = Kerr::new(-spin).sensitivity(ray.energy, &ray.start).max(1.0);
            if growth > 100.0 {
                continue;
            }
            compared += 1;
            assert_eq!((a.fate, a.crossings.len()), (b.fate, b.crossings.len()));
            for (a, b) in a.crossings.iter().zip(&b.crossings) {
                assert!((a.r / b.r - 1.0).abs() < 1e-9, "{a:?} {b:?}");
                // A text knows no azimuth but that of its own coordinates.
                let apart = a.phi + Kerr::new(-spin).azimuth_offset(a.r) - b.phi;
                // Through the axis itself light turns by half a circle one way or the other.
                let turn = if ray.start.j[2].abs() > 1e-9 { apart } else { 0.0 };
                assert!(turn.abs() < 1e-9, "{a:?} {b:?}");
            }
            if let (Some(a), Some(b)) = (a.direction, b.direction) {
                let (a, b) = (towards(a[0], a[1]), towards(b[0], b[1]));
                let apart = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
                assert!(apart < 1e-9, "{apart:e} at {growth}");
            }
        }
        assert!(compared > 250);
    }
}

#[test]
fn rays_are_the_same_abreast_and_one_by_one() {
    let text = element("kerr-newman", &[]);
    let observer =
        Observer::in_metric(&Text::new(&text), Place { r: 15.0, theta: 1.0, phi: 0.0 }, Motion::Static)
            .unwrap();
    let rays: Vec<Ray> = directions(60).map(|direction| observer.ray(direction)).collect();
    let tracer = tracer(&text);
    for level in Level::ALL {
        let mut paths = vec![Path::default(); rays.len()];
        tracer.clone().with_level(level).trace_all(&rays, &Query::default(), &mut paths);
        for (ray, path) in rays.iter().zip(&paths) {
            let alone = follow(&tracer, ray);
            assert_eq!(alone.fate, path.fate);
            if let (Some(a), Some(b)) = (alone.direction, path.direction) {
                assert!((a[0] - b[0]).abs() < 1e-7, "{a:?} {b:?}");
            }
        }
    }
}

/// The parameter at which rays cease to be captured (or to go through a throat), between one that is and one that is not.
fn limit(tracer: &dyn Tracer, ray: impl Fn(f64) -> Ray, mut inside: f64, mut outside: f64) -> f64 {
    let ends = |x| {
        let path = follow(tracer, &ray(x));
        path.fate == Fate::Escaped && !path.other_side
    };
    assert!(!ends(inside) && ends(outside));
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        if ends(middle) { outside = middle } else { inside = middle }
    }
    inside
}

/// A ray from infinity in the plane z = 0.
fn equatorial(alpha: f64) -> Ray {
    impact_ray(None, FRAC_PI_2, f64::INFINITY, [alpha, 0.0]).unwrap()
}

/// The shadow of a charged hole: the photon sphere is at r = (3 + √(9 − 8Q²))/2, b = r²/√Δ (Reissner–Nordström; Eiroa,
/// Romero & Torres 2002).
#[test]
fn a_charged_hole_has_its_shadow() {
    for charge in [0.3_f64, 0.8, 1.0] {
        let text = element("reissner-nordstrom", &[("charge", charge)]);
        let r = 0.5 * (3.0 + (9.0 - 8.0 * charge * charge).sqrt());
        let expected = r * r / (r * r - 2.0 * r + charge * charge).sqrt();
        let found = limit(&tracer(&text), equatorial, 2.0, 7.0);
        assert!((found / expected - 1.0).abs() < 1e-8, "{charge}: {found} {expected}");
    }
}

/// Edges of the shadow seen edge-on: the impact parameters of the photon orbits in the equatorial plane, where
/// rΔ′ − 4Δ = ± 4a√Δ and λ = [(r² + a²)Δ′ − 4rΔ]/(aΔ′), Δ = r² − 2r + a² + Q² (de Vries 2000).
#[test]
fn a_charged_hole_that_turns_has_its_shadow() {
    let (a, q) = (0.6_f64, 0.5_f64);
    let text = element("kerr-newman", &[("spin", a), ("charge", q)]);
    let tracer = tracer(&text);
    let delta = |r: f64| r * r - 2.0 * r + a * a + q * q;
    let horizon = 1.0 + (1.0 - a * a - q * q).sqrt();
    for (sign, inside, outside) in [(1.0, 0.0, -8.0), (-1.0, 0.0, 9.0)] {
        let condition = |r: f64| r * (2.0 * r - 2.0) - 4.0 * delta(r) - sign * 4.0 * a * delta(r).sqrt();
        let (mut low, mut high) = (horizon, 6.0);
        for _ in 0..80 {
            let middle: f64 = 0.5 * (low + high);
            if condition(middle) > 0.0 { low = middle } else { high = middle }
        }
        let slope = 2.0 * low - 2.0;
        let lambda = ((low * low + a * a) * slope - 4.0 * low * delta(low)) / (a * slope);
        let found = limit(&tracer, equatorial, inside, outside);
        assert!((found / -lambda - 1.0).abs() < 1e-8, "{found} {lambda}");
    }
    // Without charge it is Kerr's: b₊ and b₋ of a = 0.9.
    let text = element("kerr-newman", &[("spin", 0.9), ("charge", 0.0)]);
    let tracer = TextTracer::new(text, FINE, 20_000);
    assert!((limit(&tracer, equatorial, 0.0, -8.0) + 2.84442140348).abs() < 1e-7);
    assert!((limit(&tracer, equatorial, 0.0, 9.0) - 6.83231923045).abs() < 1e-7);
}

/// sin²ψ = (27/r²)(1 − 2/r − Λr²/3)/(1 − 9Λ) for the observer at rest (Stuchlík & Hledík 1999).
#[test]
fn a_cosmological_constant_changes_the_shadow() {
    let lambda = 2e-3;
    let text = element("schwarzschild-de-sitter", &[("lambda", lambda)]);
    let r = 12.0;
    let place = Place { r, theta: FRAC_PI_2, phi: 0.0 };
    let observer = Observer::in_metric(&Text::new(&text), place, Motion::Static).unwrap();
    let ray = |angle: f64| observer.ray([-angle.cos(), 0.0, angle.sin()]);
    let found = limit(&tracer(&text), ray, 0.0, 1.0);
    let square: f64 = 27.0 / (r * r) * (1.0 - 2.0 / r - lambda * r * r / 3.0) / (1.0 - 9.0 * lambda);
    assert!((found / square.sqrt().asin() - 1.0).abs() < 1e-8, "{found}");
}

/// In the static frame at the edge a radial ray is radial, and the sky is that of a static universe turned by no angle.
#[test]
fn rays_end_at_the_edge_of_space() {
    let text = element("schwarzschild-de-sitter", &[("mass", 1e-6), ("lambda", 1e-3)]);
    let place = Place { r: 10.0, theta: FRAC_PI_2, phi: 0.0 };
    let observer = Observer::in_metric(&Text::new(&text), place, Motion::Static).unwrap();
    let tracer = tracer(&text);
    // Light bends by nothing in de Sitter space: a null line r = b/cos φ in these coordinates; where it ends at R its angle
    // to the radius is that of the local frame, tan ψ = r φ′ √(1 − Λr²/3)…
    for angle in [0.0_f64, 0.4, 1.2, 2.0] {
        let path = follow(&tracer, &observer.ray([angle.cos(), 0.0, angle.sin()]));
        assert_eq!(path.fate, Fate::Escaped);
        let [theta, phi] = path.direction.unwrap();
        assert!((theta - FRAC_PI_2).abs() < 1e-9);
        // b² = r² sin²ψ/(1 − Λr²/3) is kept; the straight line's azimuth is acos(b′/R) − acos(b′/r), 1/b′² = 1/b² + Λ/3.
        let shrink = |r: f64| 1.0 - 1e-3 * r * r / 3.0;
        let b = 10.0 * angle.sin() / shrink(10.0).sqrt();
        let line = (1.0 / (b * b) + 1e-3 / 3.0).sqrt().recip();
        let edge = text.outer();
        let sign = if angle < FRAC_PI_2 { 1.0 } else { -1.0 };
        let place = (line / edge).acos() - sign * (line / 10.0).acos();
        let expected = place + (b * shrink(edge).sqrt() / edge).asin();
        assert!((phi - expected).abs() < 1e-5, "{angle}: {phi} {expected}");
    }
}

/// Light that passes at b > size turns by 2K(size/b) − π (Ellis 1973; Nakajima & Asada 2012), and goes through the throat
/// otherwise: then by 2 (size/b)⁻¹… K(b/size), from one infinity to the other.
#[test]
fn an_ellis_wormhole_bends_light() {
    let size = 1.0;
    let text = element("ellis", &[("size", size)]);
    let tracer = tracer(&text);
    let modulus = |k: f64| ellipk(k * k).unwrap();
    for b in [1.01, 1.2, 2.0, 5.0, 50.0] {
        let path = follow(&tracer, &equatorial(b));
        assert_eq!((path.fate, path.other_side), (Fate::Escaped, false));
        let [_, phi] = path.direction.unwrap();
        // In all it turns by π and the deflection.
        assert!((phi - 2.0 * modulus(size / b)).abs() < 1e-9, "{b}: {phi}");
    }
    for b in [0.1, 0.5, 0.99] {
        let path = follow(&tracer, &equatorial(b));
        assert_eq!((path.fate, path.other_side), (Fate::Escaped, true));
        let [_, phi] = path.direction.unwrap();
        // ∫ b dl/(r²√(1 − b²/r²)) over all l.
        assert!((phi - 2.0 * b / size * modulus(b / size)).abs() < 1e-9, "{b}: {phi}");
    }
}

/// What has to come within its size goes through: the photon sphere of both wormholes is the throat, b = size.
#[test]
fn light_within_the_throat_goes_through() {
    for name in ["ellis", "morris-thorne"] {
        let text = element(name, &[("size", 1.7)]);
        let found = limit(&tracer(&text), equatorial, 0.5, 3.0);
        assert!((found / 1.7 - 1.0).abs() < 1e-9, "{name}: {found}");
        // Straight through, with the direction kept.
        let path = follow(&tracer(&text), &equatorial(1e-9));
        let [theta, phi] = path.direction.unwrap();
        assert!(path.other_side && (theta - FRAC_PI_2).abs() < 1e-9 && phi.abs() < 1e-7, "{theta} {phi}");
    }
}

/// Both holes at one place are one hole with Q = M, whose shadow has the radius 4M; and at any separation a ray in
/// the plane between them turns by 2∫ dρ/(ρ√(ρ²U⁴/b² − 1)) less π.
#[test]
fn two_charged_holes_bend_light() {
    let one = element("majumdar-papapetrou", &[("separation", 0.0)]);
    let found = limit(&tracer(&one), equatorial, 2.0, 6.0);
    assert!((found / 4.0 - 1.0).abs() < 1e-8, "{found}");
    let (half, b) = (2.0, 6.0);
    let two = element("majumdar-papapetrou", &[("separation", 2.0 * half)]);
    // Over the holes, in the plane x = 0, from +y.
    let ray = impact_ray(None, FRAC_PI_2, f64::INFINITY, [0.0, b]).unwrap().turned(FRAC_PI_2);
    let path = follow(&tracer(&two), &ray);
    let [theta, phi] = path.direction.unwrap();
    let index = |rho: f64| (1.0 + 1.0 / rho.hypot(half)).powi(2);
    let (mut low, mut high) = (1.0, b);
    for _ in 0..80 {
        let middle: f64 = 0.5 * (low + high);
        if middle * index(middle) < b { low = middle } else { high = middle }
    }
    // ρ = ρ₀/(1 − s²): the root at s = 0 is regular.
    let steps = 200_000;
    let swept: f64 = (0..steps)
        .map(|k| {
            let s = (f64::from(k) + 0.5) / f64::from(steps);
            let rho = high / (1.0 - s * s);
            let root = ((rho * index(rho) / b).powi(2) - 1.0).sqrt();
            2.0 * 2.0 * s / (1.0 - s * s) / root / f64::from(steps)
        })
        .sum();
    // From azimuth π/2 over the axis.
    assert!((phi.rem_euclid(2.0 * PI) - 1.5 * PI).abs() < 1e-9);
    let turned = FRAC_PI_2 + theta;
    assert!((turned - swept).abs() < 1e-6, "{turned} {swept}");
}

#[test]
fn the_deformed_metric_without_deformation_gives_the_rays_of_kerr() {
    let text = element("johannsen", &[("spin", 0.7)]);
    let (tracer, kerr) = (tracer(&text), Integrator::new(Kerr::new(0.7), FINE, 20_000).boxed());
    for impact in [[7.0, 1.0], [-6.0, 3.0], [1.0, 8.0], [12.0, -5.0]] {
        let ray = impact_ray(Some(0.7), 1.1, f64::INFINITY, impact).unwrap();
        let (a, b) =
            (follow(&kerr, &ray), follow(&tracer, &impact_ray(None, 1.1, f64::INFINITY, impact).unwrap()));
        // Impact parameters off the equatorial plane are those of Cartesian coordinates: the same at infinity.
        assert_eq!(a.fate, b.fate);
        if let (Some(a), Some(b)) = (a.direction, b.direction) {
            let apart = (a[0] - b[0]).hypot((a[1] - b[1]) * a[0].sin());
            assert!(apart < 1e-8, "{impact:?}: {apart:e}");
        }
    }
}

/// Where a metric has no value a ray ends, and nothing that is not a number is told as one.
#[test]
fn singular_places_end_rays() {
    let singular = written(
        "name = \"text\"\nkind = \"spherical\"\ncoordinates = [\"t\", \"r\", \"h\", \"p\"]\n\
         metric = { tt = \"-(1 - 2/r)\", rr = \"1/(1 - 2/r)\", hh = \"r^2\", pp = \"r^2*sin(h)^2\" }",
    );
    let rooted = written(
        "name = \"text\"\ncoordinates = [\"t\", \"x\", \"y\", \"z\"]\nlet = { r = \"sqrt(x^2+y^2+z^2)\", g = \"1 + ln(1 - 3/r)/r\" }\n\
         metric = { tt = \"-g\", xx = \"1\", yy = \"1\", zz = \"sqrt(1 - 2/r)\" }",
    );
    for text in [singular, rooted] {
        let place = Place { r: 12.0, theta: 1.3, phi: 0.0 };
        let observer = Observer::in_metric(&Text::new(&text), place, Motion::Static).unwrap();
        let rays: Vec<Ray> = directions(64).map(|direction| observer.ray(direction)).collect();
        let tracer = TextTracer::new(text, Scheme::Dop853 { tolerance: 1e-8 }, 2_000);
        let mut paths = vec![Path::default(); rays.len()];
        tracer.trace_all(&rays, &Query::default(), &mut paths);
        assert!(paths.iter().any(|path| path.fate != Fate::Escaped));
        assert!(paths.iter().any(|path| path.fate == Fate::Escaped));
        for path in &paths {
            assert!(path.direction.is_none_or(|d| d.iter().all(|c| c.is_finite())), "{path:?}");
            assert_eq!(path.direction.is_some(), path.fate == Fate::Escaped);
            assert!(path.crossings.iter().all(|c| c.r.is_finite()), "{path:?}");
        }
    }
}
