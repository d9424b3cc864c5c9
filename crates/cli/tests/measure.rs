//! `kerrscope measure` and `kerrscope thesis`.

mod common;

use common::{json, run};

/// A picture of our own is measured in M, drawn on, and agrees with the rays.
#[test]
fn a_picture_of_our_own() {
    let folder = tempfile::tempdir().unwrap();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/thesis-5.1a.toml");
    let set = ["--set", "render.width=400", "--set", "render.height=400", "--quiet"];
    let output = run(folder.path(), &[&["render", scene, "-o", "a.png"][..], &set].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found = json(folder.path(), &["measure", "a.png", "--overlay", "b.png", "--format", "json"]);
    assert_eq!(found["size"], serde_json::json!([400, 400]));
    let pixel = found["pixel"]["gravitational_radii"].as_f64().unwrap();
    assert!((pixel / (60.0 * 25_f64.to_radians().tan() / 400.0) - 1.0).abs() < 1e-9, "{pixel}");
    let disk = &found["disk"]["found"];
    let rows = json(folder.path(), &["thesis", "spins", "--exact", "--size", "400", "--format", "json"]);
    let exact = &rows["rows"][6]["exact"];
    for side in ["left", "right"] {
        let (found, exact) = (disk[side]["value"].as_f64().unwrap(), exact[side].as_f64().unwrap());
        assert!((found - exact).abs() < 0.06, "{side}: {found} {exact}");
    }
    let drawn = std::fs::read(folder.path().join("b.png")).unwrap();
    assert!(drawn.starts_with(b"\x89PNG"));
}

#[test]
fn what_is_no_picture() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.png"), "only words, and enough of them").unwrap();
    let output = run(folder.path(), &["measure", "a.png"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("not a FITS, EXR, PNG") && said.contains("convert it"), "{said}");
    let output = run(folder.path(), &["thesis", "spins", "--exact", "--edge", "-3"]);
    assert_eq!(output.status.code(), Some(2));
}
