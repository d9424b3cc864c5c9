//! Metrics as text against the curvature that they are known to have.

use crate::texts;

use kerrscope::spacetime::metric::{Kerr, LineElement, Metric};
use kerrscope::spacetime::tensor::{Tensor, inverse};
use kerrscope::spacetime::{Dual, Scalar};
use std::f64::consts::FRAC_PI_2;
use texts::element;

type Slope = Dual<f64, 4>;

/// g_{μν} and R_{μν} = ∂_α Γ^α_{μν} − ∂_ν Γ^α_{μα} + Γ^α_{αβ} Γ^β_{μν} − Γ^α_{νβ} Γ^β_{μα}, second derivatives by dual
/// numbers of dual numbers.
fn ricci(element: &LineElement, place: [f64; 4]) -> (Tensor<f64>, Tensor<f64>) {
    let g = element.components(&Dual::<Slope, 4>::variables(Dual::variables(place)));
    let value = g.map(|row| row.map(|c| c.value));
    let raised = inverse(&value);
    let mut gamma = [[[Slope::fixed(0.0); 4]; 4]; 4];
    for (a, table) in gamma.iter_mut().enumerate() {
        for b in 0..4 {
            for c in 0..4 {
                for d in 0..4 {
                    let slope = g[d][c].gradient[b] + g[d][b].gradient[c] - g[b][c].gradient[d];
                    table[b][c] += raised[a][d] * slope * 0.5;
                }
            }
        }
    }
    let mut curved = [[0.0; 4]; 4];
    for m in 0..4 {
        for n in 0..4 {
            for a in 0..4 {
                curved[m][n] += gamma[a][m][n].gradient[a] - gamma[a][m][a].gradient[n];
                for b in 0..4 {
                    let product = gamma[a][a][b] * gamma[b][m][n] - gamma[a][n][b] * gamma[b][m][a];
                    curved[m][n] += product.value;
                }
            }
        }
    }
    (value.map(|row| row.map(|c| c.value)), curved)
}

fn largest(tensor: &Tensor<f64>) -> f64 {
    tensor.iter().flatten().map(|c| c.abs()).fold(0.0, f64::max)
}

/// g^{μν} R_{μν}.
fn scalar(g: &Tensor<f64>, curved: &Tensor<f64>) -> f64 {
    let raised = inverse(g);
    (0..4).flat_map(|m| (0..4).map(move |n| raised[m][n] * curved[m][n])).sum()
}

const PLACES: [[f64; 4]; 4] =
    [[0.0, 3.1, -0.7, 1.9], [0.0, -2.0, 4.0, 0.3], [0.0, 0.4, 2.6, -1.8], [0.0, 7.0, 5.0, -9.0]];

#[test]
fn holes_without_charge_are_vacuum() {
    for element in [
        element("schwarzschild-text", &[("mass", 1.2)]),
        element("kerr-text", &[("spin", 0.9)]),
        element("kerr-newman", &[("spin", 0.7), ("charge", 0.0)]),
        element("two-kerr", &[("mass1", 1.0), ("spin1", 0.8), ("mass2", 0.0), ("spin2", 0.0)]),
    ] {
        for place in PLACES {
            let (_, curved) = ricci(&element, place);
            assert!(largest(&curved) < 1e-13, "{curved:?}");
        }
    }
    // In spherical coordinates.
    let kerr = element("johannsen", &[("spin", 0.8)]);
    for place in [[0.0, 3.0, 0.7, 1.0], [0.0, 8.0, 2.0, 0.0]] {
        assert!(largest(&ricci(&kerr, place).1) < 1e-12);
    }
}

/// Electric fields have no trace: R = 0, though R_{μν} is not.
#[test]
fn charged_holes_have_no_scalar_curvature() {
    for element in [
        element("reissner-nordstrom", &[("charge", 0.9)]),
        element("kerr-newman", &[("spin", 0.6), ("charge", 0.5)]),
        element("majumdar-papapetrou", &[("mass1", 0.8), ("mass2", 0.3), ("separation", 3.0)]),
    ] {
        for place in PLACES {
            let (g, curved) = ricci(&element, place);
            assert!(scalar(&g, &curved).abs() < 1e-12);
            assert!(largest(&curved) > 1e-6);
        }
    }
    // Of Reissner and Nordström R_{μν} R^{μν} = 4 Q⁴/r⁸.
    let (g, curved) = ricci(&element("reissner-nordstrom", &[("charge", 0.9)]), PLACES[0]);
    let raised = inverse(&g);
    let mixed = |m: usize, n: usize| (0..4).map(|a| raised[m][a] * curved[a][n]).sum::<f64>();
    let square: f64 =
        (0..4).flat_map(|m| (0..4).map(move |n| (m, n))).map(|(m, n)| mixed(m, n) * mixed(n, m)).sum();
    let r2: f64 = PLACES[0].iter().map(|c| c * c).sum();
    assert!((square * r2.powi(4) / (4.0 * 0.9_f64.powi(4)) - 1.0).abs() < 1e-11);
}

#[test]
fn a_cosmological_constant_curves_space() {
    let lambda = 1.5e-3;
    let element = element("schwarzschild-de-sitter", &[("lambda", lambda)]);
    for place in PLACES {
        let (g, curved) = ricci(&element, place);
        for m in 0..4 {
            for n in 0..4 {
                assert!((curved[m][n] - lambda * g[m][n]).abs() < 1e-13);
            }
        }
    }
}

/// R_{ll} = −2b²/(l² + b²)², all else zero (Morris & Thorne 1988; James et al. 2015). The other wormhole's R vanishes: its
/// density is that of b′ = 0, and the trace of its tensions is zero.
#[test]
fn wormholes_have_their_curvature() {
    let size = 1.3;
    let ellis = element("ellis", &[("size", size)]);
    for place in PLACES {
        let (_, curved) = ricci(&ellis, place);
        let [_, x @ ..] = place;
        let rho = x.iter().map(|c| c * c).sum::<f64>().sqrt();
        let stretch = 1.0 + size * size / (4.0 * rho * rho);
        let expected = -2.0 * size * size / (rho * stretch).powi(4) * stretch * stretch;
        for m in 0..4 {
            for n in 0..4 {
                let along = if m > 0 && n > 0 { x[m - 1] * x[n - 1] / (rho * rho) } else { 0.0 };
                assert!((curved[m][n] - expected * along).abs() < 1e-13, "{m} {n}");
            }
        }
    }
    let other = element("morris-thorne", &[("size", size)]);
    for place in PLACES {
        let (g, curved) = ricci(&other, place);
        assert!(scalar(&g, &curved).abs() < 1e-13 && largest(&curved) > 1e-6);
    }
}

/// The superposed holes solve the equations the better the farther apart they are.
#[test]
fn superposed_holes_are_an_approximation() {
    let residual = |separation: f64| {
        let element = element("two-kerr", &[("separation", separation)]);
        largest(&ricci(&element, [0.0, 0.5 * separation, 2.5, 1.0]).1)
    };
    let found = [10.0, 20.0, 40.0].map(residual);
    assert!(found[0] < 2e-2 && found[0] > 1e-5, "{found:?}");
    assert!(found[1] < 0.6 * found[0] && found[2] < 0.6 * found[1], "{found:?}");
}

#[test]
fn the_deformed_metric_without_deformation_is_kerr() {
    let spin = 0.8;
    let element = element("johannsen", &[("spin", spin)]);
    let (r, theta): (f64, f64) = (5.0, 1.1);
    let g = element.components(&[0.0, r, theta, 0.3]);
    let (sigma, s2) = (r * r + (spin * theta.cos()).powi(2), theta.sin().powi(2));
    let expected = [
        (0, 0, -(1.0 - 2.0 * r / sigma)),
        (0, 3, -2.0 * spin * r * s2 / sigma),
        (1, 1, 1.0 + 2.0 * r / sigma),
        (2, 2, sigma),
        (3, 3, (r * r + spin * spin + 2.0 * r * spin * spin * s2 / sigma) * s2),
    ];
    for (m, n, value) in expected {
        assert!((g[m][n] / value - 1.0).abs() < 1e-14, "{m}{n}: {} {value}", g[m][n]);
    }
}

/// Energy of the circular orbit about +z in the equatorial plane, from the metric alone.
fn orbit_energy(element: &LineElement, r: f64) -> f64 {
    let half = Dual::fixed(FRAC_PI_2);
    let zero = Dual::fixed(0.0);
    let g = element.components(&[zero, Dual::variable([r], 0), half, zero]);
    let [tt, tp, pp] = [g[0][0], g[0][3], g[3][3]];
    let [dtt, dtp, dpp] = [tt, tp, pp].map(|c| c.gradient[0]);
    let omega = (-dtp + (dtp * dtp - dtt * dpp).sqrt()) / dpp;
    let [tt, tp, pp] = [tt, tp, pp].map(|c| c.value);
    -(tt + tp * omega) / (-tt - 2.0 * tp * omega - pp * omega * omega).sqrt()
}

fn isco(element: &LineElement) -> f64 {
    // The energy is least there; its slope by differences of fourth order, the root by halving.
    let slope = |r: f64| {
        let (h, e) = (1e-3, |r| orbit_energy(element, r));
        8.0 * (e(r + h) - e(r - h)) - (e(r + 2.0 * h) - e(r - 2.0 * h))
    };
    let (mut low, mut high) = (3.2, 9.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if slope(middle) < 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Without spin g_tt = −F, F = (1 − 2/r)/(1 + α₁₃/r³)², g_φφ = r², and the innermost stable orbit is where
/// r F F″ − 2r F′² + 3F F′ = 0.
#[test]
fn a_deformation_moves_the_innermost_stable_orbit() {
    assert!((isco(&element("johannsen", &[("spin", 0.5)])) - 4.23300252953).abs() < 1e-6);
    let root = |alpha: f64| {
        let condition = |r: f64| {
            let x = Dual::<Dual<f64, 1>, 1>::variable([Dual::variable([r], 0)], 0);
            let shape = (x.recip() * x.recip() * x.recip()) * alpha + 1.0;
            let f = (-(x.recip() * 2.0) + 1.0) / (shape * shape);
            let (value, first, second) = (f.value.value, f.value.gradient[0], f.gradient[0].gradient[0]);
            r * value * second - 2.0 * r * first * first + 3.0 * value * first
        };
        let (mut low, mut high): (f64, f64) = (4.0, 9.0);
        let sign = condition(low) > 0.0;
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if (condition(middle) > 0.0) == sign { low = middle } else { high = middle }
        }
        low
    };
    assert!((root(0.0) - 6.0).abs() < 1e-12);
    for alpha in [-2.0, 0.5, 3.0] {
        let found = isco(&element("johannsen", &[("spin", 0.0), ("a13", alpha)]));
        assert!((found - root(alpha)).abs() < 1e-6, "{alpha}: {found} {}", root(alpha));
        assert!((found - 6.0).abs() > 0.02);
    }
}

/// Written in spherical coordinates a metric is the same, on the axis too.
#[test]
fn spherical_coordinates_become_cartesian() {
    let spherical = texts::written(
        "name = \"text\"\nkind = \"spherical\"\ncoordinates = [\"t\", \"r\", \"th\", \"ph\"]\nparameters = { a = 0.9 }\n\
         [spacetime.let]\ns2 = \"sin(th)^2\"\nf = \"2*r/(r^2 + a^2*cos(th)^2)\"\n\
         [spacetime.metric]\ntt = \"f - 1\"\nt_r = \"f\"\nt_ph = \"-f*a*s2\"\nrr = \"1 + f\"\nr_ph = \"-(1 + f)*a*s2\"\n\
         th_th = \"r^2 + a^2*cos(th)^2\"\nph_ph = \"(r^2 + a^2 + f*a^2*s2)*s2\"",
    );
    // Kerr's own x + iy is (r + ia) e^{iφ} sin θ, and that of the spherical text r e^{iφ} sin θ: what both say of the
    // length of the same step is compared.
    let kerr = Kerr::new(0.9);
    for (r, theta, phi) in [(5.0, 0.9, 0.4), (3.0, 2.2, -2.0), (7.0, 1e-4, 1.0), (4.0, 0.0, 0.0)] {
        let at = |r: f64, theta: f64, phi: f64| -> [f64; 3] {
            let (x, y) = (r * phi.cos() - 0.9 * phi.sin(), r * phi.sin() + 0.9 * phi.cos());
            [x * theta.sin(), y * theta.sin(), r * theta.cos()]
        };
        let flat = |r: f64, theta: f64, phi: f64| -> [f64; 3] {
            [r * theta.sin() * phi.cos(), r * theta.sin() * phi.sin(), r * theta.cos()]
        };
        // Lengths of the same small steps in both charts, by their Jacobian from differences.
        let h = 1e-4;
        let steps = [[h, 0.0, 0.0], [0.0, h, 0.0], [0.0, 0.0, h], [h, 2.0 * h, -h]];
        for [dr, dt, dp] in steps {
            let length = |chart: &dyn Fn(f64, f64, f64) -> [f64; 3], g: Tensor<f64>| {
                let (a, b) = (chart(r + dr, theta + dt, phi + dp), chart(r - dr, theta - dt, phi - dp));
                let step = [0.7 * h, 0.5 * (a[0] - b[0]), 0.5 * (a[1] - b[1]), 0.5 * (a[2] - b[2])];
                let mut sum = 0.0;
                for m in 0..4 {
                    for n in 0..4 {
                        sum += g[m][n] * step[m] * step[n];
                    }
                }
                sum / (h * h)
            };
            let expected = length(&at, kerr.components(&at(r, theta, phi)));
            let found = length(&flat, spherical.cartesian(&flat(r, theta, phi)));
            assert!(
                (found - expected).abs() < 1e-5 * (1.0 + expected.abs()),
                "{r} {theta}: {found} {expected}"
            );
        }
    }
}
