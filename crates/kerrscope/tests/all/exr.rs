//! OpenEXR files: every layer bit for bit, as the reference implementation reads it.

use std::fs;
use std::path::Path;
use std::process::Command;

use kerrscope::output::{Format, Provenance};
use kerrscope::render::{Film, Layer, Stage, Watch, draw};
use kerrscope::scene::Scene;

/// Every layer of a small picture with a falling camera near a fast hole.
const SCENE: &str = "spacetime.spin = 0.95\nobserver = { distance = 12, inclination = 70, motion = 'fall' }\n\
    [render]\nwidth = 48\nheight = 27\nsamples = 2\n\
    layers = ['depth', 'fate', 'crossings', 'windings', 'steps', 'error', 'r', 'phi', 't', 'g', 'sky_theta', 'sky_phi']";

fn drawn() -> (Scene, Film) {
    let scene = Scene::from_toml(SCENE, Path::new("")).unwrap();
    let stage = Stage::new(&scene).unwrap();
    let film = draw(&stage, &Watch::default()).unwrap();
    (scene, film)
}

/// Writes each channel's numbers to a file of its name, and the header's texts.
const READER: &str = "
import sys, OpenEXR
file = OpenEXR.File('a.exr', separate_channels=True)
for name, channel in file.channels().items():
    assert channel.pixels.dtype == 'float32', name
    channel.pixels.astype('<f4').tofile(name + '.raw')
for name in 'comments', 'kerrscope':
    open(name + '.txt', 'w', encoding='utf-8').write(file.header()[name])
";

#[test]
fn the_reference_implementation_reads_every_bit() {
    // Set by `cargo xtask test`, which makes a Python environment with OpenEXR.
    let Some(python) = std::env::var_os("KERRSCOPE_TEST_PYTHON") else {
        eprintln!("skipped: KERRSCOPE_TEST_PYTHON is not set");
        return;
    };
    let (scene, film) = drawn();
    let folder = tempfile::tempdir().unwrap();
    Format::Exr.write(&folder.path().join("a.exr"), &scene, &film).unwrap();
    let status = Command::new(python).args(["-c", READER]).current_dir(&folder).status().unwrap();
    assert!(status.success());
    let check = |name: &str, expected: &mut dyn Iterator<Item = f32>| {
        let raw = fs::read(folder.path().join(format!("{name}.raw"))).unwrap();
        let read = raw.as_chunks().0.iter().map(|&bytes| u32::from_le_bytes(bytes));
        assert!(read.eq(expected.map(f32::to_bits)), "{name}");
    };
    for (k, name) in ["R", "G", "B"].into_iter().enumerate() {
        check(name, &mut film.light.iter().map(|rgb| rgb[k]));
    }
    assert_eq!(film.planes.len(), 20);
    for plane in &film.planes {
        check(&plane.channel.name(), &mut plane.values.iter().copied());
    }
    let text = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(text("comments.txt").contains("n2.phi: azimuth φ, image order 2 [rad]"));
    assert_eq!(text("kerrscope.txt").parse(), Ok(Provenance::of(&scene, &film)));
}

#[test]
fn the_same_picture_is_the_same_bytes_and_says_how_it_was_made() {
    let (scene, film) = drawn();
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = ["a.exr", "b.exr"].map(|name| folder.path().join(name));
    for path in [&a, &b] {
        Format::of(path).unwrap().write(path, &scene, &film).unwrap();
    }
    assert!(fs::read(&a).unwrap() == fs::read(&b).unwrap());
    assert_eq!(Format::Exr.read_provenance(&a).unwrap(), Provenance::of(&scene, &film));
    fs::write(&a, b"v/1\x01 no").unwrap();
    let message = Format::Exr.read_provenance(&a).unwrap_err().to_string();
    assert!(message.contains("a.exr"), "{message}");
}

#[test]
fn layers_say_what_the_ray_through_the_centre_meets() {
    let (_, film) = drawn();
    let values = |layer: Layer, order: usize| {
        let channel = layer.channels().nth(order).unwrap();
        &film.plane(channel).unwrap().values
    };
    let [fate, crossings, windings] =
        [Layer::Fate, Layer::Crossings, Layer::Windings].map(|layer| values(layer, 0));
    let [r, g, depth, sky] =
        [Layer::R, Layer::G, Layer::Depth, Layer::SkyTheta].map(|layer| values(layer, 0));
    let (isco, outer) = (1.9372, 16.0);
    for i in 0..film.light.len() {
        assert_eq!(fate[i] == 0.0, sky[i].is_finite(), "light from infinity has a direction");
        assert_eq!(crossings[i] >= 1.0, r[i].is_finite());
        assert_eq!(g[i].is_finite(), r[i] >= isco, "r = {}, g = {}", r[i], g[i]);
        // The disk is seen at order 0 where the plane is crossed within it.
        if (isco..outer).contains(&r[i]) {
            assert!(depth[i] < 30.0, "depth {}", depth[i]);
        }
        // Half a turn and less between two crossings; a whole one has two or more.
        assert!(windings[i].is_nan() || (crossings[i] - 2.0 * windings[i]).abs() < 1.0);
    }
    let t = [0, 1].map(|order| values(Layer::T, order));
    let later = t[0].iter().zip(t[1]).filter(|(first, second)| second.is_finite() && second <= first);
    assert_eq!(later.count(), 0, "a higher order comes from earlier");
}
