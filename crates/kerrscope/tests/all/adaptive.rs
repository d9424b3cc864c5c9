//! Adaptive pictures against those whose every sample is traced.

use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use kerrscope::checkpoint::{Checkpoint, Identity};
use kerrscope::render::{Film, Interpolation, Stage, Watch, draw};
use kerrscope::scene::Scene;

fn film(text: &str, adaptive: &str) -> Film {
    let scene = Scene::from_toml(&format!("{text}\n{adaptive}"), Path::new("")).unwrap();
    draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap()
}

/// Largest and mean difference of two films' light.
fn difference(a: &Film, b: &Film) -> (f32, f64) {
    let pairs = a.light.as_flattened().iter().zip(b.light.as_flattened());
    let differences: Vec<f32> = pairs.map(|(a, b)| (a - b).abs()).collect();
    let mean = differences.iter().map(|d| f64::from(*d)).sum::<f64>() / differences.len() as f64;
    (differences.into_iter().fold(0.0, f32::max), mean)
}

const SIZE: &str = "render.width = 320\nrender.height = 240\nrender.samples = 4";

/// Scenes of every kind, and the mean difference in their pictures: it comes from the edges of what is drawn
/// with sharp edges, moved by a ten-thousandth at most.
const SCENES: [(&str, &str, f64); 7] = [
    (
        "a disk around a fast hole",
        "spacetime.spin = 0.99\nobserver.inclination = 80\nsky.kind = \"black\"",
        2e-6,
    ),
    ("a disk before the stars", "spacetime.spin = 0.5\nobserver.inclination = 45", 1e-5),
    ("a grid", "spacetime.spin = -0.8\ndisk.model = \"none\"\nsky.kind = \"grid\"", 1e-6),
    (
        "a disk down to the horizon, in impact parameters from infinity",
        "spacetime.spin = 0.9\nobserver = { distance = inf, inclination = 17 }\nscreen = { kind = \"impact\", field_of_view = 24 }\n\
      disk = { inner = 1.5, outer = 9 }\nsky.kind = \"black\"",
        1e-6,
    ),
    (
        "inside the photon shell",
        "spacetime.spin = 0.7\nobserver = { distance = 2.6, motion = \"zamo\" }\n\
      screen.field_of_view = 120\nsky.kind = \"grid\"",
        1e-6,
    ),
    ("on the axis", "spacetime.spin = 1\nobserver.inclination = 0\nsky.kind = \"grid\"", 1e-5),
    ("a tilted disk, integrated", "spacetime.spin = 0.6\ndisk.tilt = 30\nsky.kind = \"black\"", 2e-6),
];

/// No pixel is left out, whatever is left over at the right and the bottom.
#[test]
fn pictures_of_any_size_are_whole() {
    for [width, height] in [[1, 1], [33, 17], [17, 49], [65, 34], [131, 3]] {
        for samples in 1..=8 {
            let text = format!(
                "disk.model = \"none\"\nsky.kind = \"uniform\"\n\
                 render = {{ width = {width}, height = {height}, samples = {samples}, adaptive = true }}"
            );
            let traced = film(&text.replace("= true", "= false"), "");
            assert!(film(&text, "").light == traced.light, "{width} × {height}, {samples} samples");
        }
    }
}

#[test]
fn they_show_the_same_within_the_error_asked_for() {
    for (name, scene, bound) in SCENES {
        let text = format!("{scene}\n{SIZE}");
        let traced = film(&text, "render.adaptive = false");
        assert_eq!(traced.tally.interpolation, Interpolation::default());
        let adaptive = film(&text, "render.adaptive = true");
        let Interpolation { samples, compared, missed, worst } = adaptive.tally.interpolation;
        let (largest, mean) = difference(&traced, &adaptive);
        println!(
            "{name}: {} rays for {samples} samples; worst {worst:.1e} of {compared}, {missed} missed; pixels {largest:.3} largest, {mean:.1e} mean",
            adaptive.tally.rays
        );
        assert!(worst <= 1e-4 && missed <= compared / 2000, "{name}");
        // A twentieth of the samples would be 15,360, so there are ten thousand.
        // One sample in 25.6 is picked, within five standard deviations.
        let expected = samples as f64 * (12_000.0 / (320.0 * 240.0 * 4.0));
        assert!((compared as f64 - expected).abs() < 5.0 * expected.sqrt(), "{name}: {compared}");
        assert!(2 * samples > traced.tally.rays && 2 * adaptive.tally.rays < traced.tally.rays, "{name}");
        assert!(mean < bound && largest < 0.01, "{name}: {mean:e}, {largest:e}");
    }
}

#[test]
fn a_smaller_error_is_a_smaller_error() {
    let text = format!("{}\n{SIZE}", SCENES[0].1);
    for target in ["1e-3", "1e-6", "1e-8"] {
        let found = film(&text, &format!("render.adaptive = true\nrender.adaptive_error = {target}")).tally;
        assert!(found.interpolation.worst <= target.parse().unwrap(), "{target}: {:?}", found.interpolation);
        assert!(found.interpolation.samples > 0, "{target}");
    }
}

#[test]
fn data_layers_are_traced() {
    let text = format!(
        "{}\nrender.width = 80\nrender.height = 60\nrender.layers = [\"r\", \"sky_theta\", \"fate\"]",
        SCENES[0].1
    );
    let traced = film(&text, "render.adaptive = false");
    let adaptive = film(&text, "render.adaptive = true");
    for (a, b) in traced.planes.iter().zip(&adaptive.planes) {
        let bits =
            |plane: &kerrscope::render::Plane| plane.values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!((a.channel, bits(a)), (b.channel, bits(b)));
    }
}

#[test]
fn an_interrupted_one_goes_on_to_the_same_film() {
    let folder = tempfile::tempdir().unwrap();
    let scene = Scene::from_toml(&format!("{}\n{SIZE}", SCENES[1].1), Path::new("")).unwrap();
    let stage = Stage::new(&scene).unwrap();
    let whole = draw(&stage, &Watch::default()).unwrap();
    let identity = Identity::of_render(&scene, stage.level()).unwrap();
    let path = folder.path().join("a.checkpoint");
    let mut checkpoint = Checkpoint::start(&path, &identity).unwrap();
    // Stopped after every few tiles.
    let (mut stops, mut done) = (0, 0);
    let film = loop {
        let (cancelled, rays) = (AtomicBool::new(false), AtomicU64::new(0));
        let progress = |more: u64| {
            if rays.fetch_add(more, Ordering::Relaxed) + more > done + 20_000 {
                cancelled.store(true, Ordering::Relaxed);
            }
        };
        let watch = Watch { cancelled: &cancelled, progress: &progress, checkpoint: Some(&checkpoint) };
        match draw(&stage, &watch) {
            Ok(film) => break film,
            Err(_) => stops += 1,
        }
        done = rays.load(Ordering::Relaxed);
        drop(checkpoint);
        checkpoint = Checkpoint::resume(&path, &identity).unwrap();
    };
    assert!(stops > 2, "{stops}");
    assert_eq!(film, whole);
}
