//! Panoramas in scenes: where they are seen, around a hole that turns, in any orientation.

// A test of the tracer: the separated equations in Boyer–Lindquist coordinates.
#[allow(dead_code)]
#[path = "../../../spacetime/tests/all/common/mino.rs"]
mod mino;

use std::path::Path;

use kerrscope::render::{Replay, Stage, Tally};
use kerrscope::scene::Scene;
use mino::{Photon, travel};

const WIDTH: u32 = 360;
const HEIGHT: u32 = 180;

/// One bright pixel, at longitude 30.5° and latitude 20.5° of the picture.
const LONGITUDE: f64 = 30.5;
const LATITUDE: f64 = 20.5;

fn write(path: &Path) {
    let mut image = image::GrayImage::new(WIDTH, HEIGHT);
    image.put_pixel(149, 69, image::Luma([255]));
    image.save(path).unwrap();
}

/// Turns (x, y, z) about an axis by degrees, right-handed: next axis towards the one after it.
fn turn(v: [f64; 3], axis: usize, degrees: f64) -> [f64; 3] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut turned = v;
    turned[next] = cos * v[next] - sin * v[last];
    turned[last] = sin * v[next] + cos * v[last];
    turned
}

#[test]
fn one_bright_pixel_is_at_the_traced_direction_in_six_orientations() {
    let folder = tempfile::tempdir().unwrap();
    write(&folder.path().join("sky.png"));
    let unit = |longitude: f64, latitude: f64| {
        let (l, b) = (longitude.to_radians(), latitude.to_radians());
        [b.cos() * l.cos(), b.cos() * l.sin(), b.sin()]
    };
    // Galactic to equatorial by angles: first turn the node of the galactic equator (at galactic
    // longitude 32.93192°) to +x, then tilt, then turn it to right ascension 282.85948°.
    let equatorial = |v| {
        let node = turn(v, 2, -32.93192);
        turn(turn(node, 0, 90.0 - 27.12825), 2, 192.85948 + 90.0)
    };
    let galactic = |v| {
        let node = turn(turn(v, 2, -(192.85948 + 90.0)), 0, -(90.0 - 27.12825));
        turn(node, 2, 32.93192)
    };
    let pixel = unit(LONGITUDE, LATITUDE);
    let turned = |v: [f64; 3], [x, y, z]: [f64; 3]| turn(turn(turn(v, 0, x), 1, y), 2, z);
    let cases: [(&str, [f64; 3]); 6] = [
        ("longitude = 180", turn(pixel, 2, 180.0)),
        ("longitude = -40, rotation = [90, 0, 0]", turned(turn(pixel, 2, -40.0), [90.0, 0.0, 0.0])),
        (
            "image_frame = \"galactic\", longitude = 10, rotation = [20, -70, 130]",
            turned(turn(pixel, 2, 10.0), [20.0, -70.0, 130.0]),
        ),
        ("image_frame = \"equatorial\", longitude = 75", turn(galactic(pixel), 2, 75.0)),
        (
            "image_frame = \"galactic\", frame = \"equatorial\", longitude = 0, rotation = [0, 45, 0]",
            turned(equatorial(pixel), [0.0, 45.0, 0.0]),
        ),
        (
            "image_frame = \"equatorial\", frame = \"equatorial\", longitude = 200, rotation = [0, 0, -33]",
            turned(turn(pixel, 2, 200.0), [0.0, 0.0, -33.0]),
        ),
    ];
    for (k, (sky, towards)) in cases.into_iter().enumerate() {
        // The camera looks at the hole, and the pixel is 17° beside it, had the hole no mass.
        let axis = turn([1.0, 0.2, 0.1], 2, 60.0 * k as f64);
        let aside = unit_vector(cross(towards, axis));
        let [sin, cos] = [17_f64.to_radians().sin(), 17_f64.to_radians().cos()];
        let position: [f64; 3] = std::array::from_fn(|i| -cos * towards[i] + sin * aside[i]);
        let (inclination, azimuth) = (position[2].acos(), position[1].atan2(position[0]));
        let text = format!(
            "spacetime = {{ name = \"kerr\", spin = {SPIN} }}\n\
             observer = {{ distance = {DISTANCE}, inclination = {}, azimuth = {} }}\n\
             screen = {{ kind = \"pinhole\", field_of_view = {FIELD} }}\ndisk.model = \"none\"\n\
             render = {{ width = {SIZE}, height = {SIZE} }}\n\
             sky = {{ kind = \"panorama\", image = \"sky.png\", {sky} }}\n",
            inclination.to_degrees(),
            azimuth.to_degrees(),
        );
        let scene = Scene::from_toml(&text, folder.path()).unwrap_or_else(|faults| panic!("{faults}"));
        let stage = Stage::new(&scene).unwrap();
        let eye = Eye { stage: &stage, inclination, azimuth };
        let (mut replay, mut tally) = (Replay::default(), Tally::default());
        let mut light = |at| stage.ray(at, &mut replay, &mut tally).rgb[0];

        let mut images: Vec<[f64; 2]> = Vec::new();
        for y in 0..17 {
            for x in 0..17 {
                let at = [x, y].map(|c| f64::from(c) * 7.0 + 3.2);
                // There is light where the pixel is, and nowhere else: interpolation spreads the pixel of
                // 1° × 0.94° to twice that, so that nothing is farther than 1.42° from its middle.
                let Some(n) = eye.trace(at) else {
                    assert!(eye.is_doubtful(at) || light(at) == 0.0, "{sky} {at:?}");
                    continue;
                };
                let away = angle(n, towards).to_degrees();
                assert!(light(at) == 0.0 || away < 1.42, "{sky} {at:?} {away}");
                if away < 40.0
                    && let Some(image) = eye.find(towards, at)
                    && images.iter().all(|other| (other[0] - image[0]).hypot(other[1] - image[1]) > 1e-3)
                {
                    images.push(image);
                }
            }
        }
        // One on its own side of the hole and one on the other.
        assert!(images.len() == 2, "{sky} {images:?}");
        for [x, y] in images {
            // The middle of the pixel is seen, to the accuracy of the ray.
            assert!((light([x, y]) - 1.0).abs() < 1e-5, "{sky} {x} {y} {}", light([x, y]));
            for [right, down] in [[0.1, 0.0], [-0.1, 0.0], [0.0, 0.1], [0.0, -0.1]] {
                assert!(light([x + right, y + down]) < 1.0 - 1e-3, "{sky} {x} {y}");
            }
        }
    }
}

const SPIN: f64 = 0.7;
const DISTANCE: f64 = 20.0;
const SIZE: u32 = 120;
const FIELD: f64 = 80.0;

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit_vector(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}

fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let chord = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    2.0 * (0.5 * chord).min(1.0).asin()
}

/// A static observer, in radians.
struct Eye<'a> {
    stage: &'a Stage,
    inclination: f64,
    azimuth: f64,
}

impl Eye<'_> {
    /// The reversed photon that arrives at a point of the picture, and whether it comes from
    /// below.
    fn photon(&self, at: [f64; 2]) -> (Photon, bool) {
        let conserved = self.stage.camera().ray(at[0], at[1]).unwrap().conserved(SPIN);
        let photon = Photon {
            spin: -SPIN,
            lambda: -conserved.lambda,
            eta: conserved.eta,
            timed: false,
            falling: false,
        };
        (photon, at[1] > 0.5 * f64::from(SIZE))
    }

    /// The separated equations are singular at the poles, and at turning points for a start.
    fn is_doubtful(&self, at: [f64; 2]) -> bool {
        self.photon(at).0.lambda.abs() < 0.05 || (at[1] - 0.5 * f64::from(SIZE)).abs() < 0.1
    }

    /// The unit vector that light at a point of the picture comes from.
    fn trace(&self, at: [f64; 2]) -> Option<[f64; 3]> {
        if self.is_doubtful(at) {
            return None;
        }
        let (photon, below) = self.photon(at);
        let sign = if below { -1.0 } else { 1.0 };
        let [theta, phi] = travel(photon, 1.0 / DISTANCE, self.inclination.cos(), true, sign).direction?;
        let (sin, cos) = (phi + self.azimuth).sin_cos();
        Some([theta.sin() * cos, theta.sin() * sin, theta.cos()])
    }

    /// The point of the picture, next to a given one, that light from a direction arrives at: by
    /// Newton's method.
    fn find(&self, towards: [f64; 3], mut at: [f64; 2]) -> Option<[f64; 2]> {
        let first = unit_vector(cross(towards, [0.3, -0.5, 0.8]));
        let second = cross(towards, first);
        let beside = |at| {
            let n = self.trace(at)?;
            (angle(n, towards) < 1.5)
                .then(|| [first, second].map(|axis| (0..3).map(|i| axis[i] * n[i]).sum::<f64>()))
        };
        for _ in 0..12 {
            let step = 1e-4;
            let [a, b] = beside(at)?;
            let right = beside([at[0] + step, at[1]])?.map(|c| c / step);
            let down = beside([at[0], at[1] + step])?.map(|c| c / step);
            let [ax, bx] = [right[0] - a / step, right[1] - b / step];
            let [ay, by] = [down[0] - a / step, down[1] - b / step];
            let det = ax * by - ay * bx;
            let change = [(ay * b - by * a) / det, (bx * a - ax * b) / det];
            at = [at[0] + change[0], at[1] + change[1]];
            if change[0].hypot(change[1]) < 1e-7 {
                return Some(at);
            }
        }
        None
    }
}
