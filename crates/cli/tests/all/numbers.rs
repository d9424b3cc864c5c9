//! The commands that print numbers, from outside.

use crate::common;

use common::{json, run};
use std::path::Path;

fn here(arguments: &[&str]) -> serde_json::Value {
    json(Path::new("."), arguments)
}

fn near(value: &serde_json::Value, expected: f64, tolerance: f64) {
    let x = value.as_f64().unwrap_or(f64::NAN);
    assert!((x - expected).abs() <= tolerance, "{x} is not {expected}");
}

#[test]
fn orbits() {
    let value = here(&["orbits", "--spin", "-0.9", "--format", "json"]);
    near(&value["isco"], 8.71735227961, 1e-10);
    near(&value["isco_retrograde"], 2.32088304176, 1e-10);
    near(&value["photon_prograde"], 3.9102679391, 1e-10);
    near(&value["impact_retrograde"], 2.84442140348, 1e-10);
}

#[test]
fn shadow() {
    let value =
        here(&["shadow", "--spin", "0.9", "--inclination", "17", "--points", "12", "--format", "json"]);
    near(&value["alpha_min"], -4.303168, 1e-6);
    near(&value["beta_max"], 4.94500, 5e-6);
    near(&value["area"], 76.1857, 5e-5);
    assert_eq!(value["curve"].as_array().unwrap().len(), 12);
}

#[test]
fn a_ray_of_impact_parameters() {
    for engine in ["closed-form", "integrator"] {
        let arguments = [
            "trace",
            "--engine",
            engine,
            "--spin",
            "0.42",
            "--inclination",
            "60",
            "--alpha",
            "-17",
            "--beta",
            "0",
            "--format",
            "json",
        ];
        let value = here(&arguments);
        assert_eq!((&value["engine"], &value["fate"]), (&engine.into(), &"escaped".into()));
        near(&value["conserved"]["lambda"], 17.0 * 60f64.to_radians().sin(), 1e-12);
        near(&value["conserved"]["eta"], (289.0 - 0.42 * 0.42) * 0.25, 1e-10);
        let crossing = &value["crossings"][0];
        let (r, phi) = (crossing["r"].as_f64().unwrap(), crossing["phi"].as_f64().unwrap());
        assert!((r * phi.cos() + 0.0522336).abs() < 1e-6 && (r * phi.sin() + 16.0342).abs() < 1e-4);
        // The light left before it arrived, by about the distance.
        let t = crossing["t"].as_f64().unwrap();
        assert!((900.0..1100.0).contains(&t), "{t}");
        assert!(crossing["g"].as_f64().unwrap() > 1.0, "the left side approaches");
        assert!(value["direction"]["theta"].is_number());
    }
}

#[test]
fn numbers_may_be_negative_separate_words() {
    for (word, lambda) in [("-1e-3", 1e-3), ("-.5", 0.5), ("-1.5e-05", 1.5e-5), ("-7", 7.0)] {
        let arguments = [
            "trace",
            "--spin",
            "-.5",
            "--inclination",
            "90",
            "--alpha",
            word,
            "--beta",
            "-2e0",
            "--format",
            "json",
        ];
        near(&here(&arguments)["conserved"]["lambda"], lambda, 1e-15 * lambda.max(1.0));
    }
    near(&here(&["orbits", "--spin", "-5e-1", "--format", "json"])["spin"], -0.5, 0.0);
}

#[test]
fn a_ray_that_does_not_come_back() {
    let arguments = [
        "trace",
        "--spin",
        "0.9",
        "--inclination",
        "90",
        "--distance",
        "inf",
        "--alpha",
        "1",
        "--beta",
        "0",
        "--format",
        "json",
    ];
    let value = here(&arguments);
    assert_eq!(value["fate"], "captured");
    assert!(value["direction"].is_null());
    assert_eq!(value["crossings"], serde_json::json!([]), "rays in the plane do not cross it");
}

#[test]
fn a_path_in_four_formats() {
    let ray = [
        "trace",
        "--spin",
        "0.9",
        "--inclination",
        "85",
        "--distance",
        "20",
        "--alpha",
        "4",
        "--beta",
        "3",
        "--path",
        "50",
    ];
    let print = |format: &str| {
        let output = run(Path::new("."), &[&ray[..], &["--format", format]].concat());
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let value: serde_json::Value = serde_json::from_str(&print("json")).unwrap();
    let points = value["path"].as_array().unwrap();
    assert_eq!(points.len(), 50);
    near(&points[0][0], 0.0, 1e-12);
    assert!(points[49][0].as_f64().unwrap() < -20.0, "time runs backwards");
    let csv = print("csv");
    assert_eq!((csv.lines().count(), csv.lines().next()), (51, Some("t,x,y,z")));
    let svg = print("svg");
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && svg.contains("<polyline"));
    assert!(print("text").contains("crossing"));
}

#[test]
fn a_pixel_of_a_scene() {
    let value = here(&["trace", "--pixel", "480,270", "--engine", "integrator", "--format", "json"]);
    assert!(value["steps"].as_u64().unwrap() > 3);
    let centre = here(&["trace", "--pixel", "10,20", "--sample", "3", "--format", "json"]);
    assert_eq!(centre["fate"], "escaped");
    let flat = here(&[
        "trace",
        "--pixel",
        "3,3",
        "--set",
        "spacetime.name=minkowski",
        "--set",
        "disk.model=none",
        "--format",
        "json",
    ]);
    assert_eq!(flat["engine"], "straight");
}

#[test]
fn a_ray_that_meets_a_thing() {
    let ball = "object=[{center=[0,9,0],radius=1},{center=[20,0,3.3],radius=0.5}]";
    let common =
        ["--set", "disk.model=none", "--set", "observer.inclination=80", "--set", ball, "--format", "json"];
    let trace = |more: &[&str]| here(&[&["trace"], more, &common[..]].concat());
    for name in ["spacetime.name=kerr", "spacetime.name=minkowski"] {
        let met = trace(&["--set", name, "--pixel", "480,270", "--set", "screen.look_at=[20,0,3.3]"]);
        assert_eq!((&met["fate"], &met["hit"]["object"]), (&"hit".into(), &1.into()));
        let x: Vec<f64> = (0..3).map(|i| met["hit"]["position"][i].as_f64().unwrap()).collect();
        let off = [x[0] - 20.0, x[1], x[2] - 3.3];
        assert!((off.iter().map(|c| c * c).sum::<f64>().sqrt() - 0.5).abs() < 1e-9, "{x:?}");
        assert!(met["direction"].is_null() && off[0] > 0.4, "the near side of the ball");
        let past = trace(&["--set", name, "--pixel", "10,20"]);
        assert_eq!((&past["fate"], &past["hit"]), (&"escaped".into(), &serde_json::Value::Null));
        // The points of the path end where the ray does.
        let path = trace(&[
            "--set",
            name,
            "--pixel",
            "480,270",
            "--set",
            "screen.look_at=[20,0,3.3]",
            "--path",
            "9",
        ]);
        let last = &path["path"][8];
        let end: Vec<f64> = (1..4).map(|i| last[i].as_f64().unwrap()).collect();
        let apart: f64 = end.iter().zip(&x).map(|(a, b)| (a - b).powi(2)).sum();
        assert!(apart.sqrt() < 1e-6, "{end:?} {x:?}");
    }
}

#[test]
fn wrong_questions_exit_with_2() {
    let wrong: [&[&str]; 9] = [
        &["orbits", "--spin", "1.2"],
        &["orbits"],
        &["shadow", "--spin", "0.5", "--inclination", "200"],
        &["trace"],
        &["trace", "--spin", "0.5", "--inclination", "60"],
        &["trace", "--alpha", "1"],
        &["trace", "--pixel", "5000,1"],
        &[
            "trace",
            "--spin",
            "0.9",
            "--inclination",
            "90",
            "--distance",
            "1.5",
            "--alpha",
            "1",
            "--beta",
            "1",
        ],
        &["trace", "--spin", "0.9", "--inclination", "60", "--alpha", "nan", "--beta", "1"],
    ];
    for arguments in wrong {
        let output = run(Path::new("."), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!output.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn bench_tells_speed_and_error_together() {
    let rows = here(&["bench", "--thin", "40", "--format", "json"]);
    let rows = rows.as_array().unwrap();
    let number = |row: &serde_json::Value, key: &str| row[key].as_f64().unwrap();
    for row in rows {
        assert_eq!((&row["rays"], &row["mismatched"]), (&400.into(), &0.into()), "{row}");
        assert_eq!(number(row, "captured") + number(row, "escaped"), 400.0, "{row}");
        assert!(number(row, "rays_per_cpu_s") > 0.0 && number(row, "crossings_total") > 300.0, "{row}");
    }
    let closed = rows.iter().find(|row| row["method"] == "gauss-legendre-24").unwrap();
    assert_eq!((&closed["engine"], &closed["tolerance"]), (&"closed-form".into(), &serde_json::Value::Null));
    assert!(number(closed, "sky_error_max") < 1e-12 && number(closed, "radius_error_share_of_bound") < 1.0);
    let integrated = rows.iter().find(|row| row["tolerance"] == 1e-8).unwrap();
    let error = number(integrated, "sky_error_median");
    assert!(error > 0.0 && error < 1e-8, "{error:e}");
    let some =
        here(&["bench", "--thin", "80", "--engine", "closed-form", "--simd", "baseline", "--format", "json"]);
    assert!(
        some.as_array()
            .unwrap()
            .iter()
            .all(|row| row["simd"] == "baseline" && row["engine"] == "closed-form")
    );
}

#[test]
fn validate_agrees_with_every_source() {
    let rows = here(&["validate", "--format", "json"]);
    let rows = rows.as_array().unwrap();
    assert!(rows.len() >= 190, "{}", rows.len());
    assert!(rows.iter().all(|row| row["passed"] == true));
}
