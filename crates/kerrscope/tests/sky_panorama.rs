//! Panoramas in scenes: where they stand, and how fine they are.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

use kerrscope::render::{Replay, Stage, Tally};
use kerrscope::scene::Scene;
use kerrscope::sky::{Orientation, Panorama};
use kerrscope::spacetime::geodesic::Query;
use kerrscope::texture::Texture;

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
        // A hole that turns, seen from 20 M; the camera looks past it, at where the pixel would be
        // without it.
        let axis = turn([1.0, 0.0, 0.0], 2, 90.0 * k as f64);
        let aside = [
            towards[1] * axis[2] - towards[2] * axis[1],
            towards[2] * axis[0] - towards[0] * axis[2],
            towards[0] * axis[1] - towards[1] * axis[0],
        ];
        let length = aside.iter().map(|c| c * c).sum::<f64>().sqrt();
        let position: [f64; 3] = std::array::from_fn(|i| 12.0 * aside[i] / length - 20.0 * towards[i]);
        let look_at: [f64; 3] = std::array::from_fn(|i| position[i] + 30.0 * towards[i]);
        let text = format!(
            "spacetime = {{ name = \"kerr\", spin = 0.7 }}\nobserver.position = {position:?}\n\
             screen = {{ kind = \"pinhole\", field_of_view = 60, look_at = {look_at:?} }}\n\
             disk.model = \"none\"\nrender = {{ width = 60, height = 60, samples = 1 }}\n\
             sky = {{ kind = \"panorama\", image = \"sky.png\", {sky} }}\n"
        );
        let scene = Scene::from_toml(&text, folder.path()).unwrap_or_else(|faults| panic!("{faults}"));
        let stage = Stage::new(&scene).unwrap();
        let tracer = kerrscope::render::tracer(&scene);
        let (mut replay, mut tally, mut seen) = (Replay::default(), Tally::default(), 0);
        for y in 0..240 {
            for x in 0..240 {
                let at = [0.25 * f64::from(x) + 0.1, 0.25 * f64::from(y) + 0.1];
                let light = stage.ray(at, &mut replay, &mut tally).rgb[0];
                let mut path = kerrscope::spacetime::geodesic::Path::default();
                let ray = stage.camera().ray(at[0], at[1]).unwrap();
                tracer.trace(&ray, &Query { max_crossings: 0, ..Query::default() }, &mut path);
                let Some([theta, phi]) = path.direction else {
                    assert_eq!(light, 0.0);
                    continue;
                };
                let n = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
                let cos: f64 = (0..3).map(|i| n[i] * towards[i]).sum();
                let away = cos.clamp(-1.0, 1.0).acos().to_degrees();
                // Interpolation spreads the pixel of 1° × 0.94° to twice that: within 0.3° it is
                // brighter than (1 − 0.3/0.936)(1 − 0.3), beyond 1.42° there is nothing.
                if away < 0.3 {
                    assert!(light > 0.4, "{sky} {away} {light}");
                    seen += 1;
                }
                assert!(light == 0.0 || away < 1.42, "{sky} {away} {light}");
            }
        }
        assert!(seen > 0, "{sky}");
    }
}
