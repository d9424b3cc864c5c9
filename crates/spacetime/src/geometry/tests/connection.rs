//! Connection coefficients against the textbook's.

use super::super::{
    BoyerLindquist, Cartesian, Geometry, PolarPlane, Schwarzschild, Sphere, SphericalSpace, acceleration,
    connection,
};
use super::points;
use crate::metric;

/// All coefficients, those not listed being zero; each listed one stands for Γ^μ_{στ} = Γ^μ_{τσ}.
fn assert_connection<G: Geometry<N>, const N: usize>(
    geometry: &G,
    x: &[f64; N],
    listed: &[([usize; 3], f64)],
) {
    let gamma = connection(geometry, x);
    for m in 0..N {
        for s in 0..N {
            for t in 0..N {
                let same = |i: &[usize; 3]| *i == [m, s, t] || *i == [m, t, s];
                let expected = listed.iter().find(|(i, _)| same(i)).map_or(0.0, |(_, value)| *value);
                let off = (gamma[m][s][t] - expected).abs();
                assert!(off < 1e-12 * (1.0 + expected.abs()), "Γ^{m}_{s}{t} at {x:?}: off by {off:.1e}");
            }
        }
    }
}

#[test]
fn of_the_plane_and_the_sphere() {
    for x in points(50, [[0.1, 20.0], [0.0, 6.0]]) {
        assert_connection(&PolarPlane, &x, &[([0, 1, 1], -x[0]), ([1, 0, 1], 1.0 / x[0])]);
    }
    for x in points(50, [[0.1, 3.0], [0.0, 6.0]]) {
        let (sin, cos) = x[0].sin_cos();
        let listed = [([0, 1, 1], -sin * cos), ([1, 0, 1], cos / sin)];
        assert_connection(&Sphere { radius: 3.0 }, &x, &listed);
    }
}

#[test]
fn of_flat_space() {
    for x in points(50, [[0.1, 20.0], [0.1, 3.0], [0.0, 6.0]]) {
        let (sin, cos) = x[1].sin_cos();
        let listed = [
            ([0, 1, 1], -x[0]),
            ([0, 2, 2], -x[0] * sin * sin),
            ([1, 0, 1], 1.0 / x[0]),
            ([1, 2, 2], -sin * cos),
            ([2, 0, 2], 1.0 / x[0]),
            ([2, 1, 2], cos / sin),
        ];
        assert_connection(&SphericalSpace, &x, &listed);
    }
}

#[test]
fn of_schwarzschild() {
    for mass in [1.0, 2.5] {
        let hole = Schwarzschild { mass };
        for x in points(50, [[0.0, 9.0], [2.2 * mass, 30.0], [0.1, 3.0], [0.0, 6.0]]) {
            let r = x[1];
            let (sin, cos) = x[2].sin_cos();
            let out = r - 2.0 * mass;
            let listed = [
                ([0, 0, 1], mass / (r * out)),
                ([1, 0, 0], mass * out / r.powi(3)),
                ([1, 1, 1], -mass / (r * out)),
                ([1, 2, 2], -out),
                ([1, 3, 3], -out * sin * sin),
                ([2, 1, 2], 1.0 / r),
                ([3, 1, 3], 1.0 / r),
                ([2, 3, 3], -sin * cos),
                ([3, 2, 3], cos / sin),
            ];
            assert_connection(&hole, &x, &listed);
        }
    }
}

/// Without spin Boyer and Lindquist's coordinates are Schwarzschild's.
#[test]
fn of_kerr_without_spin() {
    for x in points(20, [[0.0, 9.0], [2.2, 30.0], [0.1, 3.0], [0.0, 6.0]]) {
        let (one, other) =
            (connection(&Schwarzschild { mass: 1.0 }, &x), connection(&BoyerLindquist::new(0.0), &x));
        for (a, b) in one.as_flattened().as_flattened().iter().zip(other.as_flattened().as_flattened()) {
            assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()));
        }
    }
}

/// Hamilton's equations, written by hand for Kerr–Schild coordinates, have these coefficients.
#[test]
fn agree_with_the_equations_of_rays() {
    use crate::metric::Metric;
    let metric = metric::Kerr::new(0.8);
    let geometry = Cartesian::new(metric, "kerr-schild");
    for x in points(20, [[0.0, 1.0], [2.0, 9.0], [-9.0, 9.0], [-9.0, 9.0]]) {
        let p = [-1.0, 0.3, -0.7, 0.4];
        let place = [x[1], x[2], x[3]];
        let step = 1e-4;
        let velocity = |place: &[f64; 3], p: &[f64; 3]| metric.rate(1.0, place, p).velocity;
        let rate = metric.rate(1.0, &place, &[p[1], p[2], p[3]]);
        // d/dλ of the velocity along the ray, by differences of fourth order.
        let along = |h: f64| {
            let move_on = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|i| a[i] + h * b[i]);
            velocity(&move_on(place, rate.velocity), &move_on([p[1], p[2], p[3]], rate.force))
        };
        let (a, b, c, d) = (along(-2.0 * step), along(-step), along(step), along(2.0 * step));
        let inverse = metric.inverse_components(&place);
        let v: [f64; 4] = std::array::from_fn(|m| (0..4).map(|n| inverse[m][n] * p[n]).sum());
        let expected = acceleration(&geometry, &x, &v);
        for i in 0..3 {
            let found = (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * step);
            assert!((found - expected[i + 1]).abs() < 1e-10, "{x:?}");
        }
    }
}
