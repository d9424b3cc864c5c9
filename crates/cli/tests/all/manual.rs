//! What the program says of itself.

use crate::common;

use common::{json, run};
use std::path::Path;

fn text(arguments: &[&str]) -> String {
    let output = run(Path::new("."), arguments);
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_schema_knows_the_keys() {
    let schema = json(Path::new("."), &["schema"]);
    let spin = &schema["properties"]["spacetime"]["properties"]["spin"];
    assert_eq!((&spin["minimum"], &spin["maximum"]), (&(-1).into(), &1.into()));
    assert_eq!(schema["additionalProperties"], false);
}

#[test]
fn a_printed_scene_is_that_scene() {
    let folder = tempfile::tempdir().unwrap();
    let printed =
        text(&["scene", "--print", "--set", "spacetime.spin=0.25", "--set", "observer.distance=50"]);
    assert!(printed.contains("spin = 0.25") && printed.contains("tolerance"), "{printed}");
    std::fs::write(folder.path().join("a.toml"), &printed).unwrap();
    let again = run(folder.path(), &["scene", "a.toml", "--print"]);
    assert_eq!(String::from_utf8(again.stdout).unwrap(), printed);
    assert_eq!(text(&["scene"]), "", "a good scene needs no word");
}

#[test]
fn completions_and_manual_pages() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(text(&["completions", shell]).contains("render"), "{shell}");
    }
    assert!(text(&["man"]).contains(".TH kerrscope 1"));
    let folder = tempfile::tempdir().unwrap();
    assert!(run(folder.path(), &["man", "--folder", "."]).status.success());
    for page in ["kerrscope.1", "kerrscope-render.1", "kerrscope-trace.1"] {
        assert!(folder.path().join(page).exists(), "{page}");
    }
}

#[test]
fn quiet_and_verbose() {
    let folder = tempfile::tempdir().unwrap();
    let small = ["render", "--set", "render.width=8", "--set", "render.height=8"];
    let quiet = run(folder.path(), &[&small[..], &["--quiet"]].concat());
    assert!(quiet.status.success() && quiet.stdout.is_empty() && quiet.stderr.is_empty());
    let verbose = run(folder.path(), &[&small[..], &["--verbose"]].concat());
    let said = String::from_utf8_lossy(&verbose.stderr);
    assert!(said.contains("rays traced") && said.contains("kerrscope.png"), "{said}");
    assert!(!said.contains('\u{1b}'), "no colours with NO_COLOR");
}

#[test]
fn every_command_explains_itself() {
    for command in [
        "render",
        "trace",
        "orbits",
        "shadow",
        "spacetime",
        "validate",
        "bench",
        "scene",
        "schema",
        "completions",
        "man",
    ] {
        assert!(text(&[command, "--help"]).contains("Usage"), "{command}");
    }
}
