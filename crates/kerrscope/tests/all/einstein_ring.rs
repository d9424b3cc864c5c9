//! What a hole without spin makes of the sky behind it, against the exact lens equation.
//!
//! Light that leaves the sky at an angle β from the point straight behind the hole, and reaches a
//! static observer at r on the same side of the hole, sweeps the azimuth Δφ = π − β around the
//! hole, on the other side π + β, and 2π more for each further turn. By the orbit's integral Δφ is
//! a function of the impact parameter b, and the observer sees it at the angle α from the hole
//! with sin α = b √(1 − 2/r)/r. The scene is that of figure 4.5 of the thesis.

// One of the tests of the tracer; not all of it is used here.
#[allow(dead_code)]
use std::f64::consts::{PI, TAU};
use std::path::Path;

use crate::orbit::Orbit;
use image::{Rgb, RgbImage};
use kerrscope::render::{Film, Replay, Stage, Tally, Watch, draw};
use kerrscope::scene::file::{Sky, SkyKind};
use kerrscope::scene::{Scene, SceneFile};

/// The impact parameter of the photon orbit.
const CRITICAL: f64 = 5.196152422706632;

/// The observer's r: they are at (0, −30, 5).
fn distance() -> f64 {
    30_f64.hypot(5.0)
}

/// Distance from the picture's middle, in pixels, of light with an impact parameter.
fn radius(b: f64, height: u32) -> f64 {
    let r = distance();
    let sin = b * (1.0 - 2.0 / r).sqrt() / r;
    let pixel = 2.0 * 25_f64.to_radians().tan() / f64::from(height);
    sin.asin().tan() / pixel
}

/// The impact parameter of light that sweeps an azimuth.
fn impact(swept: f64) -> f64 {
    let u = 1.0 / distance();
    // From the photon orbit to light that arrives at a right angle; the azimuth falls with b.
    let (mut low, mut high) = (CRITICAL * (1.0 + 1e-12), 1.0 / (u * (1.0 - 2.0 * u).sqrt()) - 1e-9);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if Orbit::new(middle).swept(u, true, 0.0, true) > swept { low = middle } else { high = middle }
    }
    low
}

/// The scene with some keys changed and others added to the sky; `sky` is a panorama whose middle is
/// straight behind the hole, with the camera's up for north.
fn stage(sky: Option<&RgbImage>, set: &[&str]) -> Stage {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/thesis-4.5.toml");
    let mut set: Vec<String> = set.iter().map(ToString::to_string).collect();
    let folder = tempfile::tempdir().unwrap();
    if let Some(sky) = sky {
        let picture = folder.path().join("sky.png");
        sky.save(&picture).unwrap();
        let behind = -(5_f64 / 30.0).atan().to_degrees();
        set.extend([
            "sky.kind=panorama".to_owned(),
            format!("sky.image={}", picture.display()),
            "sky.image_frame=galactic".to_owned(),
            format!("sky.rotation=[{behind:?}, 0.0, 0.0]"),
        ]);
    }
    let scene = Scene::load(Some(&file), &set).unwrap_or_else(|faults| panic!("{faults}"));
    Stage::new(&scene).unwrap()
}

/// A sky that is dark but for one pixel straight behind the hole.
fn point() -> RgbImage {
    let mut sky = RgbImage::new(2001, 1001);
    sky.put_pixel(1000, 500, Rgb([255; 3]));
    sky
}

/// Angles of straight lines from the middle of the picture.
const LINES: [f64; 3] = [0.1, 2.0, 4.4];

/// The light at distances from the middle of the picture, along a line.
fn along(stage: &Stage, line: f64, from: f64, to: f64, step: f64) -> Vec<[f64; 2]> {
    let (mut replay, mut tally) = (Replay::default(), Tally::default());
    let (sin, cos) = line.sin_cos();
    (0..((to - from) / step) as usize)
        .map(|k| {
            let rho = from + step * k as f64;
            let light = stage.ray([960.0 + rho * cos, 540.0 - rho * sin], &mut replay, &mut tally);
            [rho, light.rgb[1]]
        })
        .collect()
}

/// The light's mean distance, and the least and the largest.
fn middle(light: &[[f64; 2]]) -> [f64; 3] {
    let lit: Vec<_> = light.iter().filter(|[_, light]| *light > 0.0).collect();
    let sum: f64 = lit.iter().map(|[_, light]| light).sum();
    let mean = lit.iter().map(|[rho, light]| rho * light).sum::<f64>() / sum;
    [mean, lit.first().expect("there is light")[0], lit.last().expect("there is light")[0]]
}

#[test]
fn a_point_straight_behind_the_hole_is_a_ring_where_the_lens_equation_puts_it() {
    let stage = stage(Some(&point()), &[]);
    let ring = radius(impact(PI), 1080);
    // Interpolation spreads the pixel over a square twice as wide: to √2 of its width from straight
    // behind the hole, and images of what is there lie on both sides of the ring.
    let away = 2_f64.sqrt() * TAU / 2001.0;
    let [inner, outer] = [PI + away, PI - away].map(|swept| radius(impact(swept), 1080));
    for line in LINES {
        // From the photon orbit to the picture's edge: no other light than that of the ring.
        let outside = along(&stage, line, radius(CRITICAL, 1080) + 1.0, 540.0, 0.05);
        let [mean, least, largest] = middle(&outside);
        // The map of the pixel's 0.36° to the picture is bent: by θ ≈ θ_E + β/2 + β²/8θ_E the mean is
        // about 0.4 ⟨β²⟩/θ_E off, 0.002 pixels.
        assert!((mean - ring).abs() < 5e-3, "{line} {mean} {ring}");
        assert!(least > inner && largest < outer, "{line} {inner} {least} {largest} {outer}");
    }
}

#[test]
fn the_ring_is_in_the_rendered_picture_too() {
    let stage = stage(Some(&point()), &[]);
    let ring = radius(impact(PI), 1080);
    let (mut replay, mut tally) = (Replay::default(), Tally::default());
    let (mut sum, mut moment) = (0.0, 0.0);
    // On the right, the ring stands upright.
    for y in 520..560 {
        for x in (960.0 + ring - 6.0) as u32..(960.0 + ring + 6.0) as u32 {
            let light = stage.pixel([x, y], &mut replay, &mut tally).rgb[1];
            sum += light;
            moment += light * (f64::from(x) + 0.5 - 960.0).hypot(f64::from(y) + 0.5 - 540.0);
        }
    }
    let found = moment / sum;
    assert!((found - ring).abs() < 0.01, "{found} {ring}");
}

#[test]
fn light_that_turns_around_the_hole_once_is_a_second_ring() {
    let stage = stage(Some(&point()), &[]);
    let [first, second] = [PI, 3.0 * PI].map(|swept| radius(impact(swept), 1080));
    let critical = radius(CRITICAL, 1080);
    assert!(second - critical < 0.5 && first > 2.0 * second, "{critical} {second} {first}");
    for line in LINES {
        // It is a thousandth of a pixel wide, and the third ring a millionth.
        let light = along(&stage, line, critical + 1e-2, critical + 1.0, 1e-4);
        let [mean, least, largest] = middle(&light);
        assert!((mean - second).abs() < 1e-5, "{line} {mean} {second}");
        assert!(largest - least < 5e-3, "{line} {least} {largest}");
    }
}

/// Three spots behind the hole, one in each colour: pixels of the panorama, right and up from its
/// middle. Two in one direction, the third beside the first.
const SPOTS: [[i32; 2]; 3] = [[20, 0], [36, 0], [16, 12]];

/// How far apart from straight behind the hole, and in which direction, right being 0.
fn place([right, up]: [i32; 2]) -> [f64; 2] {
    let [longitude, latitude] = [-2.0 * PI * f64::from(right) / 721.0, PI * f64::from(up) / 361.0];
    let [ahead, left, up] =
        [latitude.cos() * longitude.cos(), latitude.cos() * longitude.sin(), latitude.sin()];
    [ahead.acos(), up.atan2(-left)]
}

/// Mean distance and direction of one colour's light between two distances from the middle.
fn image(film: &Film, color: usize, from: f64, to: f64) -> [f64; 2] {
    let [width, height] = [film.width, film.height].map(f64::from);
    let (mut sum, mut moment, mut towards) = (0.0, 0.0, [0.0; 2]);
    for (k, light) in film.light.iter().enumerate() {
        let [x, y] = [k as u32 % film.width, k as u32 / film.width].map(|at| f64::from(at) + 0.5);
        let (x, y) = (x - 0.5 * width, 0.5 * height - y);
        let (rho, light) = (x.hypot(y), f64::from(light[color]));
        if light > 0.0 && (from..to).contains(&rho) {
            sum += light;
            moment += light * rho;
            towards = [towards[0] + light * x / rho, towards[1] + light * y / rho];
        }
    }
    [moment / sum, towards[1].atan2(towards[0])]
}

/// Twice the area of a triangle in the order of its corners: negative for its mirror image.
fn turns(corners: [[f64; 2]; 3]) -> f64 {
    let [a, b, c] = corners.map(|[rho, towards]| [rho * towards.cos(), rho * towards.sin()]);
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// A point behind the hole has an image outside of the Einstein ring on its own side, and one
/// inside on the opposite side. The farther the point is from straight behind the hole, the
/// farther out is the first and the farther in the second: the second image is a mirror image.
#[test]
fn what_is_behind_the_hole_is_seen_again_within_the_ring_inverted() {
    let mut sky = RgbImage::new(721, 361);
    for (color, [right, up]) in SPOTS.into_iter().enumerate() {
        let mut light = [0; 3];
        light[color] = 255;
        sky.put_pixel((360 + right) as u32, (180 - up) as u32, Rgb(light));
    }
    let set = ["render.width=320", "render.height=180", "render.samples=9"];
    let film = draw(&stage(Some(&sky), &set), &Watch::default()).unwrap();
    let [critical, ring] = [CRITICAL, impact(PI)].map(|b| radius(b, 180));

    let sources = SPOTS.map(place);
    let mut seen = [[[0.0; 2]; 3]; 2];
    for (color, [away, towards]) in sources.into_iter().enumerate() {
        let outer = [radius(impact(PI - away), 180), towards];
        let inner = [radius(impact(PI + away), 180), towards - PI];
        let limits = [[ring, f64::INFINITY], [critical + 1.0, ring]];
        for (k, (expected, [from, to])) in [outer, inner].into_iter().zip(limits).enumerate() {
            let found = image(&film, color, from, to);
            let beside = expected[0] * (found[1] - expected[1]).sin();
            assert!((found[0] - expected[0]).abs() < 0.1, "{color} {found:?} {expected:?}");
            assert!(beside.abs() < 0.1 && (found[1] - expected[1]).cos() > 0.0, "{found:?} {expected:?}");
            seen[k][color] = found;
        }
    }
    let [outer, inner] = seen;
    // The second spot is beyond the first.
    assert!(sources[1][0] > sources[0][0] && outer[1][0] > outer[0][0] + 5.0, "{outer:?}");
    assert!(inner[1][0] < inner[0][0] - 5.0, "{inner:?}");
    // The third is anticlockwise of the first in each.
    for [first, _, third] in [sources, outer, inner] {
        assert!((third[1] - first[1]).sin() > 0.5);
    }
    assert!(turns(sources) > 0.0 && turns(outer) > 0.0 && turns(inner) < 0.0);
}

/// Whether light arrives from a white sky is a matter of the critical impact parameter alone.
#[test]
fn within_the_shadow_there_is_nothing_and_outside_it_all_of_the_sky() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/thesis-4.5.toml");
    let mut file = SceneFile::from_toml(&std::fs::read_to_string(file).unwrap()).unwrap();
    file.sky = Sky { kind: SkyKind::Uniform, color: Some([1.0; 3]), ..Sky::default() };
    let mut build = |height: u32| {
        (file.render.width, file.render.height) = (height * 16 / 9, height);
        let scene = file.build(Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
        Stage::new(&scene).unwrap()
    };
    let judge = |stage: &Stage, height: u32, within: std::ops::Range<f64>| {
        let edge = radius(CRITICAL, height);
        let [width, height] = stage.size();
        let (mut replay, mut tally, mut counts) = (Replay::default(), Tally::default(), [0; 2]);
        for y in 0..height {
            for x in 0..width {
                let [dx, dy] =
                    [[x, width], [y, height]].map(|[a, n]| f64::from(a) + 0.5 - 0.5 * f64::from(n));
                let away = dx.hypot(dy) - edge;
                if away.abs() >= 1.0 && within.contains(&away) {
                    let light = stage.pixel([x, y], &mut replay, &mut tally).rgb;
                    let outside = away > 0.0;
                    assert_eq!(light, [f64::from(u8::from(outside)); 3], "{x} {y} {away}");
                    counts[usize::from(outside)] += 1;
                }
            }
        }
        assert_eq!(tally.given_up, 0);
        counts
    };
    // All of a small picture, then all around the edge of the full one.
    let counts = judge(&build(180), 180, -1e3..30.0);
    assert!(counts[0] > 3000 && counts[1] > 5000, "{counts:?}");
    let counts = judge(&build(1080), 1080, -3.0..3.0);
    assert!(counts[0] > 2000 && counts[1] > 2000, "{counts:?}");
}
