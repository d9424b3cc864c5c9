//! `kerrscope spacetime`, from outside.

use crate::common;

use common::{json, run};
use serde_json::Value;
use std::f64::consts::{PI, TAU};
use std::path::Path;

fn here(words: &str) -> Value {
    let arguments: Vec<&str> =
        ["spacetime"].into_iter().chain(words.split(' ')).chain(["--format", "json"]).collect();
    json(Path::new("."), &arguments)
}

fn text(words: &str) -> String {
    let arguments: Vec<&str> =
        ["spacetime"].into_iter().chain(words.split(' ').filter(|w| !w.is_empty())).collect();
    let output = run(Path::new("."), &arguments);
    assert!(output.status.success(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn near(value: &Value, expected: f64, tolerance: f64) {
    let x = value.as_f64().unwrap_or(f64::NAN);
    assert!((x - expected).abs() <= tolerance, "{x} is not {expected}");
}

#[test]
fn what_there_is() {
    let all = text("");
    for name in ["polar", "sphere", "stereographic-south", "schwarzschild", "kerr-schild", "ellis"] {
        assert!(all.contains(name), "{name}");
        assert!(text(name).contains("coordinates"), "{name}");
    }
    let kerr = here("kerr --set spin=0.6");
    assert_eq!(kerr["coordinates"], serde_json::json!(["t", "r", "theta", "phi"]));
    near(&kerr["ranges"][1][0], 1.8, 1e-14);
}

#[test]
fn a_metric_and_its_inverse() {
    let value = here("schwarzschild metric --at 0,6,90deg,0");
    near(&value["metric"][0][0], -2.0 / 3.0, 1e-15);
    near(&value["inverse"][1][1], 2.0 / 3.0, 1e-15);
    near(&value["metric"][3][3], 36.0, 1e-12);
    assert!(text("polar metric --at 2,1").contains("inverse"));
}

#[test]
fn connection_coefficients() {
    let value = here("sphere connection --at pi/3,1");
    let list = value["connection"].as_array().unwrap();
    assert_eq!(list.len(), 2);
    for entry in list {
        let expected = if entry["upper"] == "phi" { 1.0 / 3f64.sqrt() } else { -(3f64.sqrt()) / 4.0 };
        near(&entry["value"], expected, 1e-15);
    }
    let said = text("schwarzschild connection --at 0,6,pi/2,0");
    assert!(said.contains("Γ^t_{t r} = Γ^t_{r t} = 0.0416666666667"), "{said}");
    assert!(text("minkowski connection --at 0,1,2,3").contains("zero"));
}

#[test]
fn geodesic_equations() {
    let said = text("polar equations --at 2,0");
    assert!(said.contains("r'' = 2 phi'²") && said.contains("phi'' = -1 r' phi'"), "{said}");
    let value = here("polar equations --at 2,0");
    near(&value["equations"][1]["second_derivative"][0]["factor"], -1.0, 1e-15);
}

#[test]
fn curvature_at_a_point() {
    near(&here("schwarzschild curvature --at 0,3,1,0")["kretschmann"], 48.0 / 729.0, 1e-14);
    near(&here("ellis curvature --at 0,0,1,0 --set throat=2")["ricci"][1][1], -0.5, 1e-14);
    near(&here("sphere curvature --at 1,0 --set radius=2")["ricci_scalar"], 0.5, 1e-14);
    assert!(text("kerr curvature --at 0,4,1,0").contains("Kretschmann"));
}

#[test]
fn geodesics_as_csv_json_and_svg() {
    let circle = "sphere geodesic --from pi/2,0 --velocity 0.3,1 --length 2pi";
    let value = here(circle);
    assert_eq!((&value["end"], &value["kind"]), (&"complete".into(), &"spacelike".into()));
    let points = value["points"].as_array().unwrap();
    assert_eq!(points.len(), 1000);
    near(&points[999]["x"][0], PI / 2.0, 1e-10);
    near(&points[999]["x"][1], TAU, 1e-10);
    let csv = text(&format!("{circle} --format csv --points 5"));
    assert_eq!(csv.lines().count(), 6);
    assert!(csv.starts_with("parameter,theta,phi,d_theta,d_phi\n0,"), "{csv}");
    let svg = text("kerr geodesic --from 0,8,70deg,0 --velocity 0,0.03,0.04 --length 500 --format svg");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && svg.contains("circle"));
    let light = here("schwarzschild geodesic --kind null --from 0,3,pi/2,0 --velocity 0,0,1 --length 1");
    near(&light["conserved"][0]["value"], 0.0, 1e-12);
    let fall = text("schwarzschild geodesic --from 0,10,1,0 --velocity 0,0,0 --length 100");
    assert!(fall.contains("ended where the coordinates end") && fall.contains("kept to"), "{fall}");
}

#[test]
fn between_points() {
    let value = here("sphere between --from 40deg,0 --to 60deg,100deg");
    let (a, b) = (40f64.to_radians(), 60f64.to_radians());
    let cos = a.cos() * b.cos() + a.sin() * b.sin() * 100f64.to_radians().cos();
    near(&value["geodesics"][0]["length"], cos.acos(), 1e-9);
    // Straight lines of the plane do not go round its origin by more than half a turn.
    let none = run(Path::new("."), &["spacetime", "polar", "between", "--from", "1,0", "--to", "0,1"]);
    assert_eq!(none.status.code(), Some(2), "the origin is singular");
    let none = run(
        Path::new("."),
        &["spacetime", "polar", "between", "--from", "1,0", "--to", "1,pi", "--turns", "0"],
    );
    assert_eq!(none.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&none.stderr).contains("no geodesic"));
}

#[test]
fn lengths_of_curves() {
    near(
        &here("sphere length --through pi/2,0 --through pi/2,2pi --set radius=3")["length"],
        TAU * 3.0,
        1e-12,
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("curve.csv"), "t,x,y,z\n0,0,0,0\n5,3,0,0\n\n10,0,0,0\n").unwrap();
    let found = json(
        folder.path(),
        &["spacetime", "minkowski", "length", "--curve", "curve.csv", "--format", "json"],
    );
    near(&found["proper_time"], 8.0, 1e-12);
    std::fs::write(folder.path().join("bad.csv"), "0,0,0,0\n5,x,0,0\n10,0\n").unwrap();
    let bad = run(folder.path(), &["spacetime", "minkowski", "length", "--curve", "bad.csv"]);
    let said = String::from_utf8_lossy(&bad.stderr).into_owned();
    assert_eq!(bad.status.code(), Some(2));
    assert!(said.contains("bad.csv: line 2") && said.contains("bad.csv: line 3"), "{said}");
}

#[test]
fn checks() {
    let kerr = here("kerr-schild check --set spin=0.9 --points 200");
    assert_eq!(
        (&kerr["good"], &kerr["vacuum"], &kerr["asymptotically_flat"]),
        (&true.into(), &true.into(), &true.into())
    );
    assert_eq!(kerr["independent_of"], serde_json::json!(["t"]));
    let ellis = text("ellis check --points 100");
    assert!(ellis.contains("vacuum              no"), "{ellis}");
}

/// Each input that is wrong is refused with what is wrong about it.
#[test]
fn wrong_inputs() {
    for (words, said) in [
        ("nowhere check", "no geometry is called \"nowhere\": there are polar"),
        ("kerr --set spin=2 check", "spin = 2 is out of range: give a number from -1 to 1"),
        ("kerr --set charge=1 check", "has no parameter \"charge\": it has spin"),
        ("polar --set spin=1 check", "it has none"),
        ("kerr --set spin check", "NAME=VALUE"),
        ("kerr metric --at 0,6,1", "kerr has 4 coordinates, t,r,theta,phi, and 3 are given"),
        ("kerr metric --at 0,6,x,0", "is no number"),
        ("schwarzschild metric --at 0,2,1,0", "singular there"),
        ("schwarzschild metric --at 0,6,0,0", "singular there"),
        ("schwarzschild metric --at 0,6,1,0 --format svg", "the action geodesic"),
        ("schwarzschild geodesic --from 0,1,1,0 --velocity 0,0,0 --length 1", "outside its coordinates"),
        ("sphere geodesic --from 1,0 --velocity 0,0 --length 1", "no direction"),
        ("sphere geodesic --from 1,0 --velocity 0,1 --kind null --length 1", "no time"),
        ("sphere geodesic --from 1,0 --velocity 0,1 --length 1 --tolerance 1e-20", "4e-14"),
        ("sphere length --through 1,0", "two points"),
        ("sphere length --curve /nowhere/a.csv", "/nowhere/a.csv"),
        ("check", "which geometry"),
    ] {
        let arguments: Vec<&str> = ["spacetime"].into_iter().chain(words.split(' ')).collect();
        let output = run(Path::new("."), &arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{words}: {errors}");
        assert!(errors.contains(said), "{words}: {errors}");
    }
}

/// Metrics as text: by name, from a file of their own, from a scene, and one that depends on time.
#[test]
fn metrics_as_text() {
    // Two holes side by side are no vacuum, but the less so the farther apart they are; one alone is.
    let ricci = |set: &str| {
        let found = here(&format!("two-kerr curvature --at 0,0,3,0 {set}"));
        let all = found["ricci"].as_array().unwrap().iter().flat_map(|row| row.as_array().unwrap());
        all.map(|c| c.as_f64().unwrap().abs()).fold(0.0, f64::max)
    };
    assert!(ricci("--set mass2=0 --set spin2=0") < 1e-14);
    let [close, apart] = ["--set separation=10", "--set separation=100"].map(ricci);
    assert!(close > 1e-3 && apart < 1e-2 * close, "{close} {apart}");

    let folder = tempfile::tempdir().unwrap();
    let metric = "coordinates = [\"t\", \"x\", \"y\", \"z\"]\nparameters = { h = 0.1 }\nlet = { a2 = \"exp(2*h*t)\" }\n\
                  metric = { tt = -1, xx = \"a2\", yy = \"a2\", zz = \"a2\" }\n";
    std::fs::write(folder.path().join("growing.toml"), metric).unwrap();
    let sitter = folder.path().join("growing.toml").display().to_string();
    // De Sitter's universe: R = 12 h².
    let found = here(&format!("{sitter} curvature --at 3,1,2,0 --set h=0.2"));
    near(&found["ricci_scalar"], 0.48, 1e-13);
    assert_eq!(found["geometry"], "growing");

    let scene = folder.path().join("scene.toml");
    let keys =
        metric.replace("exp(2*h*t)", "1 + h/r").replace("let = {", "let = { r = \"sqrt(x^2 + y^2 + z^2)\",");
    std::fs::write(&scene, format!("render.width = 9\n[spacetime]\nname = \"text\"\n{keys}")).unwrap();
    let found = here(&format!("{} metric --at 0,2,0,0", scene.display()));
    near(&found["metric"][1][1], 1.05, 1e-15);

    for (words, said) in [
        ("kerr-newman --set charg=0.1", "has no parameter `charg`"),
        ("nowhere.toml check", "there is no such file"),
        ("two-kers check", "two-kerr"),
    ] {
        let arguments: Vec<&str> = ["spacetime"].into_iter().chain(words.split(' ')).collect();
        let output = run(Path::new("."), &arguments);
        assert_eq!(output.status.code(), Some(2));
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(stderr.contains(said), "{stderr}");
    }
}
