//! The delay of light that grazes a hole without spin, against its exact integral.

use crate::common;

use common::engines::{TIMED, closed, integrated};
use kerrscope_spacetime::closed::Nodes;
use kerrscope_spacetime::observer::impact_ray;

/// The radius of closest approach of light with impact parameter b > √27: the largest zero of r³ − b²r + 2b².
fn closest(b: f64) -> f64 {
    2.0 * b / 3f64.sqrt() * ((-(27f64.sqrt()) / b).acos() / 3.0).cos()
}

/// Coordinate time from closest approach to r: ∫ dr/[(1 − 2u)√(1 − ε)], u = 1/r, ε = b²u²(1 − 2u), less r + 2 ln(r/2) (Weinberg
/// 1972, eq. 8.7.2). With r = r₀(1 + y²) and r³ − b²r + 2b² = (r − r₀)(r² + r₀r + r₀² − b²) nothing in it is singular. What is
/// subtracted is taken into the integral, which then converges for r → ∞, and so that no digits are lost:
///   1/[(1 − 2u)√(1 − ε)] − 1 − 2u = {4u² + ε/[√(1 − ε)(1 + √(1 − ε))]}/(1 − 2u).
fn delay(b: f64, r: f64) -> f64 {
    let least = closest(b);
    let nodes = Nodes::new(40);
    let integrand = |y: f64| {
        let r = least * (1.0 + y * y);
        let u = 1.0 / r;
        // √(1 − ε)/y.
        let slope = (least * (r * r + least * r + least * least - b * b)).sqrt() / (r * r.sqrt());
        let bent = b * b * u * u * (1.0 - 2.0 * u) / (slope * (1.0 + slope * y));
        2.0 * least * (4.0 * u * u * y + bent) / (1.0 - 2.0 * u)
    };
    // Over s = y/(1 + y), in panels.
    let last = if r.is_finite() {
        let y = (r / least - 1.0).sqrt();
        y / (1.0 + y)
    } else {
        1.0
    };
    let panels = 16;
    let mut sum = 0.0;
    for panel in 0..panels {
        let (middle, half) =
            (last * (f64::from(panel) + 0.5) / f64::from(panels), 0.5 * last / f64::from(panels));
        for &(x, weight) in nodes.half() {
            for s in [middle - half * x, middle + half * x] {
                let y = s / (1.0 - s);
                sum += half * weight * integrand(y) / (1.0 - s).powi(2);
            }
        }
    }
    sum - least - 2.0 * (0.5 * least).ln()
}

#[test]
fn grazing_light_is_late_by_the_exact_integral() {
    let inclination = 85f64.to_radians();
    for beta in [5.4, 6.0, 10.0, 20.0, 60.0] {
        for distance in [1e4, f64::INFINITY] {
            let ray = impact_ray(Some(0.0), inclination, distance, [0.0, beta]).unwrap();
            for path in [closed(0.0, &ray, &TIMED), integrated(0.0, &ray)] {
                let crossing = path.crossings[0];
                let whole = |r: f64| delay(beta, r) + r + 2.0 * (0.5 * r).ln();
                // The camera at infinity has its r + 2 ln(r/2) taken off.
                let camera = if distance.is_finite() { whole(distance) } else { delay(beta, distance) };
                // What crosses before its closest approach has not come so far.
                let sign = if crossing.outward { -1.0 } else { 1.0 };
                let exact = camera + sign * whole(crossing.r);
                let off = (crossing.elapsed - exact).abs() / exact.abs().max(crossing.r);
                assert!(off < 1e-11, "b = {beta}, from {distance}: {} is not {exact}", crossing.elapsed);
                if beta >= 20.0 && distance.is_finite() {
                    // Behind the hole, later than in flat space by about 2 ln(4rr′/b²) + … (Shapiro 1964).
                    assert!(!crossing.outward);
                    let flat = |r: f64| (r * r - beta * beta).sqrt();
                    let late = exact - flat(distance) - flat(crossing.r);
                    let shapiro = 2.0 * (4.0 * distance * crossing.r / (beta * beta)).ln() + 2.0;
                    assert!((late / shapiro - 1.0).abs() < 0.2, "{late} {shapiro}");
                }
            }
        }
    }
}
