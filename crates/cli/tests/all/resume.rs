//! `kerrscope render --resume` after interruptions.

#![cfg(unix)]

use crate::common;

use common::{json, program, run};
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

/// About two seconds of work on two processors, with layers.
const SCENE: &str =
    "render = { width = 160, height = 90, method = 'rk4', step = 0.4, layers = ['g', 'fate', 'sky_phi'] }";

const OUTPUT: [&str; 5] = ["render", "scene.toml", "-o", "a.exr", "--resume"];

/// Starts a render and kills it as soon as it has kept more than was there; whether it was still at work.
fn killed(folder: &Path) -> bool {
    let kept = || fs::metadata(folder.join("a.exr.checkpoint")).map_or(0, |about| about.len());
    let before = kept();
    let mut child = program(folder, &OUTPUT).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    while kept() <= before {
        if child.try_wait().unwrap().is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    true
}

#[test]
fn killed_it_goes_on_to_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("scene.toml"), SCENE).unwrap();
    assert!(run(path, &OUTPUT).status.success());
    let whole = fs::read(path.join("a.exr")).unwrap();
    assert_eq!(fs::read_dir(path).unwrap().count(), 2, "no checkpoint is left");
    fs::remove_file(path.join("a.exr")).unwrap();
    // Killed over and over, it gets on: each time more is kept.
    for _ in 0..3 {
        assert!(killed(path), "it was still at work");
        assert!(!path.join("a.exr").exists(), "no half-written file");
    }
    let value = json(path, &[&OUTPUT[..], &["--format", "json"]].concat());
    assert_eq!(value["rays"], 160 * 90 * 5, "four samples and the layers' ray; those of earlier tries count");
    assert!(fs::read(path.join("a.exr")).unwrap() == whole, "the same bytes");
    assert!(!path.join("a.exr.checkpoint").exists());
}

#[test]
fn a_checkpoint_of_another_scene_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("scene.toml"), SCENE).unwrap();
    assert!(killed(path));
    let before = fs::read(path.join("a.exr.checkpoint")).unwrap();
    let other = [&OUTPUT[..], &["--set", "spacetime.spin=0.5"]].concat();
    let output = run(path, &other);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(text.contains("a.exr.checkpoint") && text.contains("another scene"), "{text}");
    assert_eq!(fs::read(path.join("a.exr.checkpoint")).unwrap(), before);
    // Without --resume the other scene starts afresh.
    let small =
        ["render", "scene.toml", "-o", "a.exr", "--set", "render.width=16", "--set", "render.height=9"];
    assert!(run(path, &small).status.success());
}

#[test]
fn a_full_disk_is_an_error_that_names_the_file() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("scene.toml"), SCENE).unwrap();
    std::os::unix::fs::symlink("/dev/full", path.join("a.exr.checkpoint")).unwrap();
    let output = run(path, &OUTPUT[..4]);
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("a.exr.checkpoint: the disk is full"), "{text}");
}
