//! What several tests of things in scenes use.

// Each test uses some of it.
#![allow(dead_code)]

use std::path::Path;

use kerrscope::render::{Film, Replay, Stage, Tally, Watch, draw};
use kerrscope::scene::{Faults, Scene};

/// A scene without a disk, from the rest of its text; `[render]` is not in it.
pub fn scene(text: &str) -> Scene {
    let text = format!("disk.model = \"none\"\n{text}");
    Scene::from_toml(&text, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Its stage.
pub fn stage(text: &str) -> Stage {
    Stage::new(&scene(text)).unwrap()
}

/// Its picture.
pub fn film(text: &str) -> Film {
    draw(&stage(text), &Watch::default()).unwrap()
}

/// The light of one point of the picture, by one path.
pub fn ray(stage: &Stage, point: [f64; 2]) -> [f64; 3] {
    stage.ray(point, &mut Replay::default(), &mut Tally::default()).rgb
}

/// Mean of the green light of a picture, and the standard deviation from pixel to pixel.
pub fn statistics(film: &Film) -> [f64; 2] {
    let count = film.light.len() as f64;
    let mean = film.light.iter().map(|light| f64::from(light[1])).sum::<f64>() / count;
    let square = film.light.iter().map(|light| (f64::from(light[1]) - mean).powi(2)).sum::<f64>();
    [mean, (square / (count - 1.0)).sqrt()]
}

/// Linear light of a code of sRGB (IEC 61966-2-1), above its linear part.
pub fn linear(code: f64) -> f64 {
    ((code + 0.055) / 1.055).powf(2.4)
}

/// The slope of the straight line through points, by least squares.
pub fn slope(points: &[[f64; 2]]) -> f64 {
    let count = points.len() as f64;
    let [x, y] = [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / count);
    let (mut up, mut along) = (0.0, 0.0);
    for p in points {
        up += (p[0] - x) * (p[1] - y);
        along += (p[0] - x).powi(2);
    }
    up / along
}

/// The error of a pixel shrinks as 1/√N of its samples, and the mean of all pixels is the exact value within four standard
/// errors. `text` is the scene with `SAMPLES` for their number.
pub fn converges(text: &str, exact: f64, samples: &[u32]) {
    let mut points = Vec::new();
    for samples in samples {
        let film = film(&text.replace("SAMPLES", &samples.to_string()));
        let [mean, deviation] = statistics(&film);
        let error = deviation / (film.light.len() as f64).sqrt();
        assert!((mean - exact).abs() < 4.0 * error, "{samples} samples: {mean} ± {error}, exactly {exact}");
        points.push([f64::from(*samples).ln(), deviation.ln()]);
    }
    let slope = slope(&points);
    assert!((slope + 0.5).abs() < 0.05, "{slope} {points:?}");
}

/// Line, column, message, mend.
pub type Expected<'a> = (usize, usize, &'a str, &'a str);

/// What is wrong with a scene.
pub fn faults(text: &str) -> Faults {
    Scene::from_toml(text, Path::new("/nowhere")).expect_err("the scene is wrong")
}

/// Holds all that is wrong with a scene to what is expected, in its order.
#[track_caller]
pub fn assert_faults(text: &str, expected: &[Expected]) {
    let faults = faults(text);
    let found: Vec<Expected> = faults
        .iter()
        .map(|fault| {
            let (line, column) = fault.line_column().expect("the fault has a place");
            (line, column, fault.message.as_str(), fault.help.as_str())
        })
        .collect();
    assert_eq!(found, expected, "\n{faults}");
}
