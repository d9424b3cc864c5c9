//! `kerrscope render`, from outside.

use crate::common;

use common::{json, program, run};
use kerrscope::output::png::read_provenance;
use std::fs;
use std::path::Path;

const SMALL: [&str; 6] =
    ["--set", "render.width=48", "--set", "render.height=27", "--set", "render.samples=2"];

fn small<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [&["render"], arguments, &SMALL[..]].concat()
}

#[test]
fn without_arguments_it_saves_the_built_in_scene() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &small(&[]));
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stdout).starts_with("Saved kerrscope.png: 48 × 27 pixels"));
    let decoder = fs::read(folder.path().join("kerrscope.png")).unwrap();
    assert_eq!(&decoder[..8], b"\x89PNG\r\n\x1a\n");
}

#[test]
fn one_and_two_threads_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for threads in ["1", "2", "5"] {
        let name = format!("{threads}.png");
        assert!(run(folder.path(), &small(&["-o", &name, "--threads", threads])).status.success());
    }
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("1.png") == bytes("2.png") && bytes("1.png") == bytes("5.png"));
}

#[test]
fn a_picture_remakes_itself() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = small(&["-o", "a.png", "--set", "spacetime.spin=-0.3", "--set", "render.seed=9"]);
    assert!(run(folder.path(), &arguments).status.success());
    let made = read_provenance(&folder.path().join("a.png")).unwrap();
    assert_eq!(made.seed, 9);
    fs::write(folder.path().join("again.toml"), made.to_string()).unwrap();
    assert!(run(folder.path(), &["render", "again.toml"]).status.success());
    assert!(run(folder.path(), &["render", "a.png", "-o", "third.png"]).status.success());
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("a.png") == bytes("again.png"), "the scene in the picture makes the same picture");
    assert!(bytes("a.png") == bytes("third.png"), "the picture itself does");
}

#[test]
fn a_file_for_science_remakes_itself_too() {
    let folder = tempfile::tempdir().unwrap();
    let arguments =
        ["-o", "a.fits", "-o", "a.h5", "--set", "units.mass=6.5e9", "--set", "units.distance=16.8e6"];
    let output = run(folder.path(), &small(&arguments));
    assert!(output.status.success());
    // 27 pixels of 2 · 30.4 tan 25° M, and 3.818993 µas for each M.
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("On the sky 192.4875 × 108.2742 µas; M is 3.8190 µas\n"), "{said}");
    for name in ["a.fits", "a.h5"] {
        assert!(run(folder.path(), &["render", name, "-o", "b.fits", "-o", "b.h5"]).status.success());
        let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
        assert!(bytes("a.fits") == bytes("b.fits") && bytes("a.h5") == bytes("b.h5"), "{name}");
    }
}

#[test]
fn json_speaks_of_the_sky_where_it_can() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = |more: &[&'static str]| small(&[&["-o", "a.png", "--format", "json"], more].concat());
    let plain = json(folder.path(), &arguments(&[]));
    let units =
        ["--set", "units.mass=6.5e9", "--set", "units.distance=16.8e6", "--set", "units.frequency=230e9"];
    let scaled = json(folder.path(), &arguments(&units));
    assert_eq!((&plain["length_unit"], &scaled["length_unit"]), (&"M".into(), &"uas".into()));
    for key in ["centroid", "size"] {
        for k in 0..2 {
            let [m, uas] = [&plain, &scaled].map(|value| value[key][k].as_f64().unwrap());
            assert!((uas / m / 3.818993252 - 1.0).abs() < 1e-9, "{key}: {m} M, {uas} µas");
        }
    }
    // The built-in disk is drawn: it has no flux.
    assert!(scaled["total_flux_jy"].is_null());
}

#[test]
fn json_names_what_was_done() {
    let folder = tempfile::tempdir().unwrap();
    let arguments =
        small(&["-o", "a.png", "-o", "b.png", "--format", "json", "--set", "camera.display.bits=16"]);
    let value = json(folder.path(), &arguments);
    assert_eq!(value["outputs"], serde_json::json!(["a.png", "b.png"]));
    assert_eq!(value["rays"], 48 * 27 * 2);
    assert!(value["total_flux_jy"].is_null());
    assert!(value["wall_s"].as_f64().unwrap() > 0.0);
    let estimate = value["error_estimate"].as_f64().unwrap();
    assert!((1e-13..1e-7).contains(&estimate), "{estimate:e}");
    assert!(value["centroid"][0].is_number() && value["size"][1].is_number());
    assert_eq!((&value["rays_traced"], &value["interpolation"]), (&value["rays"], &serde_json::Value::Null));
}

#[test]
fn an_adaptive_picture_says_how_good_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["render", "-o", "a.png", "--set", "render.width=192", "--set", "render.height=108"];
    let value = json(folder.path(), &[&arguments[..], &["--format", "json"]].concat());
    let found = &value["interpolation"];
    assert_eq!((&value["rays"], &found["error_target"]), (&(192 * 108 * 4).into(), &1e-4.into()));
    assert!(value["rays_traced"].as_u64() < value["rays"].as_u64());
    assert!(found["compared"].as_u64().unwrap() > 3000 && found["samples"].as_u64().unwrap() > 40_000);
    let made = read_provenance(&folder.path().join("a.png")).unwrap().interpolation.unwrap();
    assert_eq!(found["error_max"], made.worst);
    assert!(made.worst > 0.0 && made.worst < 1e-4, "{:e}", made.worst);
    // In words too, and the same bytes for any number of threads.
    for threads in ["1", "3"] {
        let output = run(folder.path(), &[&arguments[..], &["-o", "b.png", "--threads", threads]].concat());
        assert!(String::from_utf8_lossy(&output.stdout).contains("interpolated; largest error"));
        let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
        assert!(bytes("a.png") == bytes("b.png"), "{threads} threads");
    }
}

#[test]
fn engines_and_instructions_can_be_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let best = kerrscope::spacetime::Level::best().name();
    for (arguments, engine, level) in [
        (&[][..], "closed-form", best),
        (&["--engine", "integrator"], "integrator", best),
        (&["--engine", "closed-form", "--simd", "baseline"], "closed-form", "baseline"),
        (&["--simd", best], "closed-form", best),
    ] {
        let value = json(folder.path(), &small(&[&["--format", "json"], arguments].concat()));
        assert_eq!((&value["engine"], &value["instruction_level"]), (&engine.into(), &level.into()));
        let made = read_provenance(&folder.path().join("kerrscope.png")).unwrap();
        assert_eq!(made.instruction_level, level);
    }
    let output = run(folder.path(), &small(&["--simd", "mmx"]));
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("baseline"));
}

#[test]
fn rays_that_are_given_up_have_no_error_estimate() {
    let folder = tempfile::tempdir().unwrap();
    let value = json(
        folder.path(),
        &small(&["--format", "json", "--engine", "integrator", "--set", "render.max_steps=3"]),
    );
    assert_eq!(value["rays_given_up"], value["rays"]);
    assert!(value["error_estimate"].is_null() && value["error_estimate_max"].is_null());
}

#[test]
fn wrong_input_exits_with_2_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(
        folder.path().join("bad.toml"),
        "[spacetime]\nspin = 1.5\nspeen = 1\n[render]\nwidth = \"wide\"\n",
    )
    .unwrap();
    let output = run(folder.path(), &["render", "bad.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8_lossy(&output.stderr);
    for expected in ["bad.toml:2", "speen", "width", "3 faults"] {
        assert!(text.contains(expected), "{expected:?} is missing in:\n{text}");
    }
    assert!(!folder.path().join("bad.png").exists());
    for arguments in [
        &["render", "-o", "a.gif"][..],
        &["render", "--set", "spin=1"],
        &["render", "none.toml"],
        &["rendre"],
    ] {
        let output = run(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!output.stderr.is_empty());
    }
}

#[test]
fn an_unwritable_file_exits_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let output = run(folder.path(), &small(&["-o", "missing/a.png"]));
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("missing"));
}

#[cfg(unix)]
#[test]
fn interrupted_it_exits_with_130_and_keeps_the_old_file() {
    use std::process::{Command, Stdio};
    let folder = tempfile::tempdir().unwrap();
    let path: &Path = folder.path();
    fs::write(path.join("a.png"), "old").unwrap();
    // Minutes of work, interrupted at once.
    let arguments = ["render", "-o", "a.png", "--set", "render.width=4000", "--set", "render.height=4000"];
    let mut child = program(path, &arguments).stderr(Stdio::piped()).stdout(Stdio::null()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(700));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(fs::read(path.join("a.png")).unwrap(), b"old");
    assert!(path.join("a.png.checkpoint").exists());
    assert_eq!(fs::read_dir(path).unwrap().count(), 2, "no other litter");
    let mut text = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().unwrap(), &mut text).unwrap();
    assert!(text.contains("--resume goes on from a.png.checkpoint"), "{text}");
}
