//! `kerrscope measure` and `kerrscope thesis`.

use crate::common;

use std::path::Path;

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

/// Light that is 255 where a point of the unit square is lit.
fn draw(path: &Path, size: u32, is_lit: impl Fn(f64, f64) -> bool) {
    let at = |k: u32| (f64::from(k) + 0.5) / f64::from(size);
    let pixels: Vec<u8> =
        (0..size * size).map(|k| if is_lit(at(k % size), at(k / size)) { 255 } else { 0 }).collect();
    image::save_buffer(path, &pixels, size, size, image::ColorType::L8).unwrap();
}

/// A FITS file of 16 × 16 numbers.
fn fits(path: &Path, values: &[f64]) {
    let cards = [
        "SIMPLE  =                    T",
        "BITPIX  =                  -64",
        "NAXIS   =                    2",
    ];
    let sizes = ["NAXIS1  =                   16", "NAXIS2  =                   16", "END"];
    let mut bytes: Vec<u8> =
        cards.iter().chain(&sizes).flat_map(|card| format!("{card:<80}").into_bytes()).collect();
    bytes.resize(2880, b' ');
    bytes.extend(values.iter().flat_map(|value| value.to_be_bytes()));
    bytes.resize(5760, 0);
    std::fs::write(path, bytes).unwrap();
}

/// No picture: exit code 2, with what is wrong and how to mend it.
#[test]
fn what_is_no_picture() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    std::fs::write(file("text.png"), "only words, and enough of them").unwrap();
    std::fs::write(file("empty.png"), "").unwrap();
    draw(&file("black.png"), 32, |_, _| false);
    draw(&file("white.png"), 32, |_, _| true);
    draw(&file("one.png"), 1, |_, _| true);
    let mut values = [0.0; 256];
    values[3] = 1.0;
    values[40] = f64::NAN;
    fits(&file("nan.fits"), &values);
    for (name, parts) in [
        ("text.png", ["not a FITS, EXR, PNG", "convert it"]),
        ("empty.png", ["is empty", "again"]),
        ("black.png", ["all pixels have the value 0", "check"]),
        ("white.png", ["all pixels have the value 1", "check"]),
        ("one.png", ["all pixels have the value 1", "check"]),
        ("nan.fits", ["1 of 256 pixels are no finite number", "fill these pixels"]),
        ("none.png", ["none.png", "check the path"]),
    ] {
        let output = run(folder.path(), &["measure", name]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.stdout.is_empty() && parts.iter().all(|part| said.contains(part)), "{name}: {said}");
    }
    let output = run(folder.path(), &["thesis", "spins", "--exact", "--edge", "-3"]);
    assert_eq!(output.status.code(), Some(2));
}

/// Pictures of other things have reasons, no numbers, and exit code 0.
#[test]
fn pictures_of_other_things() {
    let folder = tempfile::tempdir().unwrap();
    let disk = |x: f64, y: f64, [cx, cy, r]: [f64; 3]| (x - cx).hypot(y - cy) < r;
    let cat = |x: f64, y: f64| {
        let ear = |side: f64| {
            let x = side * (x - 0.5);
            (0.02..0.28).contains(&x) && y > 0.1 + 1.2 * (0.28 - x) && y < 0.5
        };
        (disk(x, y, [0.5, 0.56, 0.3]) || ear(1.0) || ear(-1.0))
            && !disk(x, y, [0.38, 0.5, 0.06])
            && !disk(x, y, [0.62, 0.5, 0.06])
    };
    draw(&folder.path().join("cat.png"), 96, cat);
    draw(&folder.path().join("stripes.png"), 96, |x, _| ((x * 12.0) as u32).is_multiple_of(2));
    draw(&folder.path().join("dot.png"), 96, |x, y| disk(x, y, [0.5, 0.5, 0.2]));
    draw(&folder.path().join("two.png"), 2, |x, _| x < 0.5);
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes/");
    let small =
        ["--set", "render.width=160", "--set", "render.height=90", "--set", "render.samples=4", "--quiet"];
    let scene = format!("{scenes}two-holes.toml");
    let output = run(folder.path(), &[&["render", &scene, "-o", "two-holes.png"][..], &small].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for name in ["cat", "stripes", "dot", "two", "two-holes"] {
        let found = json(folder.path(), &["measure", &format!("{name}.png"), "--format", "json"]);
        for feature in ["shadow", "ring", "disk"] {
            let reason = found[feature]["not_found"].as_str();
            assert!(reason.is_some_and(|reason| reason.len() > 10), "{name} {feature}: {}", found[feature]);
        }
        let output = run(folder.path(), &["measure", &format!("{name}.png")]);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(text.contains("shadow: not found: "), "{text}");
    }
}

/// The thesis's large steps run, and what they explain is told.
#[test]
fn as_the_thesis() {
    let folder = tempfile::tempdir().unwrap();
    let rows = json(folder.path(), &["thesis", "spins", "--exact", "--step", "1.5", "--format", "json"]);
    assert_eq!(rows["rows"].as_array().unwrap().len(), 7);
    let found = json(
        folder.path(),
        &["thesis", "inclinations", "--exact", "--as-thesis=step,chords", "--format", "json"],
    );
    let repeats = found["as_thesis"].as_array().unwrap();
    assert_eq!((repeats.len(), &repeats[1]["adds"]), (2, &serde_json::json!("chords")));
    assert!(repeats[1]["explains"].is_f64() && repeats[1]["off"].is_f64());
    let output = run(folder.path(), &["thesis", "spins", "--exact", "--as-thesis=step"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(text.contains("explain") && text.contains("RK4 with steps of 1.5 M"), "{text}");
}
