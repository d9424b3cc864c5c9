//! `kerrscope fit`, on small pictures of rings, so that it is quick.

use std::path::Path;
use std::process::{Command, Output};

use kerrscope_fit::Observed;
use kerrscope_fit::fit::Models;
use kerrscope_fit::models::{Choice, Name};
use serde_json::Value;

fn kerrscope(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_kerrscope"))
        .arg("fit")
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program runs")
}

/// A ring as a 16-bit picture for screens, which keeps four digits of its light.
fn ring(folder: &Path) {
    let choice = Choice { name: Name::Ring, ..Choice::default() };
    let model = Observed::new(choice.source(2), [24; 2]);
    let values = model.predict(&[10.0, 5.0, 0.5, 60.0, 0.5, -1.0, 0.0, 1.0, 0.0], false).unwrap().values;
    let peak = values.iter().copied().fold(0.0, f64::max);
    let encoded = |light: f64| {
        let sign = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
        (sign * 65535.0).round() as u16
    };
    let bytes: Vec<u8> = values.iter().flat_map(|v| encoded(0.8 * v / peak).to_ne_bytes()).collect();
    image::save_buffer(folder.join("ring.png"), &bytes, 24, 24, image::ColorType::L16).unwrap();
}

fn error(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The fields that scripts rely on, the truth, and all files.
#[test]
fn a_ring_as_json_and_files() {
    let folder = tempfile::tempdir().unwrap();
    ring(folder.path());
    let output = kerrscope(
        &["ring.png", "--model", "ring", "--format", "json", "--rounds", "4", "-o", "found"],
        folder.path(),
    );
    assert!(output.status.success(), "{}", error(&output));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    for field in ["converged", "warnings", "chi2", "evaluations", "wall_s", "seed", "good"] {
        assert!(!found[field].is_null(), "{field}");
    }
    let parameters = found["parameters"].as_array().unwrap();
    let at = |name: &str| parameters.iter().find(|p| p["name"] == name).unwrap();
    for field in ["mode", "mean", "sd", "q025", "q16", "q50", "q84", "q975"] {
        assert!(at("diameter")[field].is_f64(), "{field}");
    }
    for (name, truth, close) in
        [("diameter", 10.0, 0.02), ("width", 5.0, 0.02), ("position_angle", 60.0, 0.2)]
    {
        let mean = at(name)["mean"].as_f64().unwrap();
        assert!((mean - truth).abs() < close, "{name}: {mean}");
    }
    assert_eq!(at("blur")["free"], false);
    for ending in ["json", "chain.h5", "corner.svg", "residual.png", "residual.fits"] {
        assert!(folder.path().join(format!("found.{ending}")).metadata().unwrap().len() > 500, "{ending}");
    }
    assert!(!folder.path().join("found.checkpoint").exists());
    let table = kerrscope(&["ring.png", "--model", "ring", "--rounds", "3"], folder.path());
    let text = String::from_utf8_lossy(&table.stdout).into_owned();
    assert!(text.contains("diameter") && text.contains("fixed: blur = 0 px"), "{text}");
}

/// The thesis's figure 5.1 (b), smaller: the inclination of a disk, from its edges in a picture with eight bits.
#[test]
fn a_silhouette() {
    let folder = tempfile::tempdir().unwrap();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/thesis-5.1b.toml");
    let drawn = Command::new(env!("CARGO_BIN_EXE_kerrscope"))
        .args(["render", scene, "-o", "disk.png", "--set", "render.width=100", "--set", "render.height=100"])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(drawn.status.success(), "{}", error(&drawn));
    let known = ["spin=0", "inner=0", "outer=6", "position_angle=0"].map(|known| ["--fix", known]);
    let mut arguments = vec!["disk.png", "--silhouette", "--orders", "1", "--distance", "30"];
    arguments.extend(["--projection", "pinhole", "--rounds", "3", "--format", "json"]);
    arguments.extend(["--prior", "inclination=isotropic(0, 90)"]);
    arguments.extend(known.iter().flatten());
    let output = kerrscope(&arguments, folder.path());
    assert!(output.status.success(), "{}", error(&output));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["model"], "silhouette");
    let at = |name: &str, field: &str| {
        let parameters = found["parameters"].as_array().unwrap();
        parameters.iter().find(|p| p["name"] == name).unwrap()[field].as_f64().unwrap()
    };
    let scale = 60.0 * 25_f64.to_radians().tan() / 100.0;
    for (name, truth, small) in [("inclination", 270.0 / 7.0, 0.8), ("scale", scale, 0.01 * scale)] {
        let (mean, sd) = (at(name, "mean"), at(name, "sd"));
        let close = (3.0 * sd).min(0.5 * small);
        assert!((mean - truth).abs() < close && sd < small, "{name}: {mean} ± {sd}");
    }
}

/// Faults of flags, all at once; of pictures, with the reason. Exit code 2.
#[test]
fn faults() {
    let folder = tempfile::tempdir().unwrap();
    ring(folder.path());
    let refused = |arguments: &[&str], parts: &[&str]| {
        let output = kerrscope(arguments, folder.path());
        assert_eq!(output.status.code(), Some(2), "{}", error(&output));
        assert!(output.stdout.is_empty());
        for part in parts {
            assert!(error(&output).contains(part), "{part:?} in {}", error(&output));
        }
    };
    refused(
        &["ring.png", "--fix", "spun=0.9", "--fix", "spin=3", "--prior", "scale=flat"],
        &["Did you mean spin?", "spin is 3", "log-uniform(FROM, TO)"],
    );
    refused(&["ring.png", "--model", "cat", "--noise", "-1"], &["page-thorne", "above 0"]);
    refused(
        &["ring.png", "--model", "ring", "--silhouette", "--orders", "2"],
        &["--silhouette is a model", "--orders is for silhouettes"],
    );
    refused(&["ring.png", "--silhouette", "--noise", "0.1"], &["leave --noise away"]);
    // Theories: what is none, what has no disk, what a number of the text may not be, and names that there are not.
    refused(&["ring.png", "--spacetime", "newton"], &["neither a file", "johannsen", "kerr-newman"]);
    refused(&["ring.png", "--spacetime", "two-kerr"], &["two-kerr", "all around the z axis"]);
    refused(&["ring.png", "--spacetime", "ellis"], &["ellis"]);
    refused(&["ring.png", "--spacetime", "johannsen", "--model", "ring"], &["page-thorne or power-law"]);
    refused(
        &["ring.png", "--spacetime", "johannsen", "--null", "b13=0", "--null", "a13"],
        &["no parameter \"b13\"", "a13", "NAME=VALUE"],
    );
    refused(&["ring.png", "--spacetime", "johannsen", "--free", "a13"], &["a13=uniform(-1, 1)"]);
    refused(&["none.png"], &["none.png"]);
    std::fs::write(folder.path().join("text.png"), "no picture").unwrap();
    refused(&["text.png"], &["text.png"]);
    image::save_buffer(folder.path().join("black.png"), &[0; 256], 16, 16, image::ColorType::L8).unwrap();
    refused(&["black.png"], &["black.png"]);
}
