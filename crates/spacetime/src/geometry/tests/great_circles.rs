//! Geodesics of a sphere in three charts.

use super::super::{Kind, Options, Pole, Sphere, Stereographic, Trajectory, velocity};
use super::{assert_near, points};
use std::f64::consts::TAU;

const RADIUS: f64 = 1.5;
const GLOBE: Sphere = Sphere { radius: RADIUS };

fn unit([theta, phi]: [f64; 2]) -> [f64; 3] {
    [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()]
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn they_close() {
    let options = Options { tolerance: 1e-13, ..Options::default() };
    for [theta, phi, turn] in points(20, [[0.3, 2.8], [0.0, 6.0], [0.3, 2.8]]) {
        let v = velocity(&GLOBE, &[theta, phi], &[turn.cos(), turn.sin()], Kind::Spacelike).unwrap();
        let way = Trajectory::follow(&GLOBE, &[theta, phi], &v, TAU * RADIUS, &options);
        let end = way.at(TAU * RADIUS);
        assert!((end.x[0] - theta).abs() < 1e-10 && ((end.x[1] - phi).abs() - TAU).abs() < 1e-10, "{end:?}");
        let start = way.at(0.0).momentum;
        assert!((0..2).all(|i| (end.momentum[i] - start[i]).abs() < 1e-9));
        // A quarter on is at a right angle.
        let quarter = unit(way.at(0.25 * TAU * RADIUS).x);
        assert_near((0..3).map(|i| quarter[i] * unit([theta, phi])[i]).sum(), 0.0, 1e-10);
    }
}

#[test]
fn all_charts_give_the_same() {
    let options = Options { tolerance: 1e-13, ..Options::default() };
    for [theta, phi, turn] in points(20, [[0.5, 2.6], [-3.0, 3.0], [0.5, 2.6]]) {
        let v = velocity(&GLOBE, &[theta, phi], &[turn.cos(), turn.sin()], Kind::Spacelike).unwrap();
        let reference = Trajectory::follow(&GLOBE, &[theta, phi], &v, 3.0, &options);
        for pole in [Pole::North, Pole::South] {
            let chart = Stereographic { radius: RADIUS, pole };
            let at = chart.from_angles([theta, phi]);
            // ∂(distance)/∂θ = ∓½R/sin²(θ/2) from the north pole, ½R/cos²(θ/2) from the south pole.
            let slope = match pole {
                Pole::North => -0.5 * RADIUS / (0.5 * theta).sin().powi(2),
                Pole::South => 0.5 * RADIUS / (0.5 * theta).cos().powi(2),
            };
            let far = at[0].hypot(at[1]);
            let (sin, cos) = phi.sin_cos();
            let (out, round) = (slope * v[0], far * v[1]);
            let w = [out * cos - round * sin, out * sin + round * cos];
            let way = Trajectory::follow(&chart, &at, &w, 3.0, &options);
            for i in 0..=10 {
                let s = 0.3 * f64::from(i);
                let (one, other) = (unit(reference.at(s).x), unit(chart.to_angles(way.at(s).x)));
                assert!(apart(one, other) < 1e-10, "{pole:?} at {s}: {:.1e}", apart(one, other));
            }
        }
    }
}
