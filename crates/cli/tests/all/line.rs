//! `kerrscope line`.

use crate::common;

use common::{json, run};

const LINE: [&str; 9] = ["line", "--spin", "0.5", "--inclination", "30", "--outer", "15", "--bins", "50"];

#[test]
fn a_profile_as_json_csv_and_plot() {
    let folder = tempfile::tempdir().unwrap();
    let found = json(folder.path(), &[&LINE[..], &["--format", "json"]].concat());
    let edges = [&found["edges"][0], &found["edges"][1]].map(|edge| edge.as_f64().unwrap());
    assert!((edges[0] - 0.467346).abs() < 2e-6 && (edges[1] - 1.037756).abs() < 2e-6, "{edges:?}");
    assert!((found["inner"].as_f64().unwrap() - 4.23300252953).abs() < 1e-10);
    let flux = found["flux"].as_array().unwrap();
    assert_eq!((flux.len(), found["g"].as_array().unwrap().len()), (50, 50));
    assert_eq!(found["engine"], "closed-form");

    let csv = run(folder.path(), &LINE);
    let text = String::from_utf8(csv.stdout).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!((rows[0], rows.len()), ("g,flux", 51));
    let first: Vec<f64> = rows[1].split(',').map(|number| number.parse().unwrap()).collect();
    assert_eq!(first[1], flux[0].as_f64().unwrap());

    let files = ["-o", "a.svg", "-o", "a.csv", "-o", "a.json"];
    assert!(run(folder.path(), &[&LINE[..], &files].concat()).status.success());
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("a.csv"), text);
    assert!(read("a.svg").starts_with("<svg") && read("a.svg").contains("0.5"));
    assert!(read("a.json").contains("\"edges\""));
}

#[test]
fn engines_orders_and_tables() {
    let folder = tempfile::tempdir().unwrap();
    let rows: Vec<String> =
        (8..60).map(|k| f64::from(k) * 0.5).map(|r| format!("{r}, {}", r.powi(-3))).collect();
    std::fs::write(folder.path().join("e.csv"), format!("r, e\n{}\n", rows.join("\n"))).unwrap();
    let profile = |more: &[&str]| -> Vec<f64> {
        let arguments = [&LINE[..], &["--range", "0.4,1.2", "--format", "json"], more].concat();
        let found = json(folder.path(), &arguments);
        found["flux"].as_array().unwrap().iter().map(|flux| flux.as_f64().unwrap()).collect()
    };
    let usual = profile(&[]);
    let peak = usual.iter().copied().fold(0.0, f64::max);
    for other in [profile(&["--engine", "integrator"]), profile(&["--emissivity", "e.csv"])] {
        let off = usual.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-4 * peak, "{off} {peak}");
    }
    let both = profile(&["--orders", "0,1"]);
    assert!(usual.iter().zip(&both).all(|(one, two)| two >= one), "light is added");
    assert!(both.iter().sum::<f64>() > usual.iter().sum::<f64>());
}

#[test]
fn what_is_wrong_is_said() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bad.csv"), "5 1\n4 1\n6 x\n").unwrap();
    for (more, said) in [
        (&["--emissivity", "none.csv"][..], "neither a number nor a file"),
        (&["--emissivity", "bad.csv"], "line 2"),
        (&["--emissivity", "bad.csv"], "line 3"),
        (&["--inner", "1"], "the inner radius is 1"),
        (&["--inclination", "90"], "no face"),
        (&["--orders", "9"], "image orders are 0 to 4"),
        (&["--range", "1,0.5"], "the range of g has to grow"),
        (&["-o", "a.txt", "-o", "b"], "a.txt, b"),
    ] {
        // The last of a flag given twice counts nowhere: leave the first out.
        let mut arguments = LINE.to_vec();
        if let Some(place) = arguments.iter().position(|word| *word == more[0]) {
            arguments.drain(place..place + 2);
        }
        let output = run(folder.path(), &[&arguments[..], more].concat());
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{more:?}: {error}");
        assert!(error.contains(said), "{more:?}: {error}");
    }
}
