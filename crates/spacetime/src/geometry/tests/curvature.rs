//! Curvature against closed forms.

use super::super::{
    BoyerLindquist, Cartesian, Curvature, Ellis, Geometry, Minkowski, PolarPlane, Pole, Schwarzschild,
    Sphere, SphericalSpace, Stereographic, ThreeSphere,
};
use super::{assert_near, points};
use crate::metric;

const EVERYWHERE: [[f64; 2]; 4] = [[-5.0, 5.0], [2.5, 30.0], [0.1, 3.0], [0.0, 6.0]];

#[test]
fn kretschmann_of_schwarzschild() {
    for mass in [1.0, 0.4] {
        for x in points(100, EVERYWHERE) {
            let curvature = Curvature::of(&Schwarzschild { mass }, &x);
            let expected = 48.0 * mass * mass / x[1].powi(6);
            assert!((curvature.kretschmann / expected - 1.0).abs() < 1e-11, "{x:?}");
            assert!(curvature.matter() < 1e-13);
        }
    }
}

/// 48(r² − a²c²)((r² + a²c²)² − 16r²a²c²)/Σ⁶, c = cos θ (Henry 2000, ApJ 535, 350), in both charts.
#[test]
fn kerr_is_a_vacuum() {
    for spin in [0.3, -0.9, 1.0] {
        let (round, straight) =
            (BoyerLindquist::new(spin), Cartesian::new(metric::Kerr::new(spin), "kerr-schild"));
        for x in points(100, EVERYWHERE) {
            let [_, r, theta, phi] = x;
            let height = (spin * theta.cos()).powi(2);
            let sigma = r * r + height;
            let expected = 48.0 * (r * r - height) * (sigma * sigma - 16.0 * r * r * height) / sigma.powi(6);
            let size = 48.0 / r.powi(6);
            let here = Curvature::of(&round, &x);
            assert_near(here.kretschmann, expected, 1e-11 * size);
            assert!(here.ricci.as_flattened().iter().all(|c| c.abs() < 1e-8), "{x:?} {:?}", here.ricci);
            // x + iy = (r + ia) sin θ e^{iφ}
            let ((sin, cos), (up, across)) = (phi.sin_cos(), (theta.cos(), theta.sin()));
            let place = [0.0, (r * cos - spin * sin) * across, (r * sin + spin * cos) * across, r * up];
            let there = Curvature::of(&straight, &place);
            assert_near(there.kretschmann, expected, 1e-11 * size);
            assert!(there.ricci.as_flattened().iter().all(|c| c.abs() < 1e-8), "{place:?}");
        }
    }
}

#[test]
fn a_wormhole_needs_matter() {
    let b: f64 = 1.7;
    for x in points(100, [[0.0, 1.0], [-8.0, 8.0], [0.1, 3.0], [0.0, 6.0]]) {
        let curvature = Curvature::of(&Ellis { throat: b }, &x);
        let square = b * b / (x[1] * x[1] + b * b).powi(2);
        for m in 0..4 {
            for n in 0..4 {
                assert_near(curvature.ricci[m][n], if m == 1 && n == 1 { -2.0 * square } else { 0.0 }, 1e-12);
            }
        }
        assert_near(curvature.scalar, -2.0 * square, 1e-12);
        assert_near(curvature.kretschmann, 12.0 * square * square, 1e-12);
        // The energy density G_{tt}/8π is negative.
        assert_near(curvature.einstein[0][0], -square, 1e-12);
    }
}

fn assert_flat<G: Geometry<N>, const N: usize>(geometry: &G, x: &[f64; N]) {
    let curvature = Curvature::of(geometry, x);
    let size = curvature
        .riemann
        .as_flattened()
        .as_flattened()
        .as_flattened()
        .iter()
        .fold(0.0_f64, |a, b| a.max(b.abs()));
    assert!(size < 1e-12, "{x:?}: {size:.1e}");
}

#[test]
fn flat_is_flat() {
    for [t, r, theta, phi] in points(30, EVERYWHERE) {
        assert_flat(&Minkowski, &[t, r, theta, phi]);
        assert_flat(&PolarPlane, &[r, phi]);
        assert_flat(&SphericalSpace, &[r, theta, phi]);
        assert_flat(&Schwarzschild { mass: 0.0 }, &[t, r, theta, phi]);
    }
}

#[test]
fn spheres_are_round() {
    let radius = 2.5;
    let square = radius * radius;
    for [chi, theta, phi] in points(30, [[0.1, 3.0], [0.1, 3.0], [0.0, 6.0]]) {
        assert_near(Curvature::of(&Sphere { radius }, &[theta, phi]).scalar, 2.0 / square, 1e-12);
        assert_near(Curvature::of(&ThreeSphere { radius }, &[chi, theta, phi]).scalar, 6.0 / square, 1e-12);
        for pole in [Pole::North, Pole::South] {
            let chart = Stereographic { radius, pole };
            let at = chart.from_angles([theta, phi]);
            assert_near(Curvature::of(&chart, &at).scalar, 2.0 / square, 1e-11);
        }
    }
}

/// R_{ρσμν} = −R_{σρμν} = −R_{ρσνμ} = R_{μνρσ}, and the first Bianchi identity.
#[test]
fn riemann_has_its_symmetries() {
    for x in points(20, EVERYWHERE) {
        let c = Curvature::of(&BoyerLindquist::new(0.7), &x);
        let r = &c.riemann;
        let size = x[1].powi(4);
        for i in 0..4 {
            for j in 0..4 {
                for k in 0..4 {
                    for l in 0..4 {
                        let here = r[i][j][k][l];
                        assert_near(r[j][i][k][l], -here, 1e-13 * size);
                        assert_near(r[k][l][i][j], here, 1e-13 * size);
                        assert_near(here + r[i][k][l][j] + r[i][l][j][k], 0.0, 1e-13 * size);
                    }
                }
            }
        }
        assert_near(c.riemann_up()[0][1][0][1], (0..4).map(|a| c.inverse[0][a] * r[a][1][0][1]).sum(), 1e-14);
    }
}
