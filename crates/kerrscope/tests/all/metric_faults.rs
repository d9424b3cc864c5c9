//! Metrics as text that are wrong: each refused at its place, with the mend.

use std::path::Path;

use kerrscope::scene::{Faults, Scene};

/// Flat space in words, to be broken.
const GOOD: &str = r#"
disk.model = "none"
[spacetime]
name = "text"
coordinates = ["t", "x", "y", "z"]
horizon = "2*m"
[spacetime.parameters]
m = 1.0
[spacetime.let]
r = "sqrt(x^2 + y^2 + z^2)"
h = "2*m/(r + m)"
[spacetime.metric]
tt = "h - 1"
xx = "1 + h"
yy = "1 + h"
zz = "1 + h"
"#;

fn faults(text: &str) -> Faults {
    match Scene::from_toml(text, Path::new("")) {
        Ok(_) => panic!("{text}\nis no fault"),
        Err(faults) => faults,
    }
}

#[test]
fn a_right_text_is_a_spacetime() {
    let scene = Scene::from_toml(GOOD, Path::new("")).unwrap();
    let element = scene.spacetime.text().unwrap();
    assert_eq!(element.horizon(), 2.0);
    assert!(element.is_axisymmetric() && element.is_stationary());
    // What a scene says of itself is that scene.
    assert_eq!(Scene::from_toml(&scene.to_toml(), Path::new("")).unwrap(), scene);
}

/// Each: what is replaced, by what, the text that the fault points at, what it says, and the mend.
const BROKEN: [(&str, &str, &str, &str, &str); 25] = [
    ("2*m/(r + m)", "2m/(r + m)", "m/(r + m)", "an operator is missing", "2*x"),
    ("2*m/(r + m)", "2*m/(r + m", "(r + m\"", "never closed", "close it"),
    ("2*m/(r + m)", "2*m/(R + m)", "R + m", "`R` is not known", "did you mean `r`?"),
    ("2*m/(r + m)", "2*m/h", "\"2*m/h\"", "`h` is defined by itself", "do not use it in turn"),
    ("sqrt(x^2", "squrt(x^2", "squrt", "there is no function `squrt`", "did you mean sqrt?"),
    ("x^2 + y^2", "x^2 + y²", "²", "`²` has no meaning", "x^2"),
    ("x^2 + y^2 + z^2", "x^2, y^2 + z^2", "sqrt(", "sqrt has 1 argument", "sqrt(x)"),
    ("\"h - 1\"", "\"h - \"", "\"", "a value is missing", "write a number"),
    ("\"h - 1\"", "\"\"", "\"\"", "the formula is empty", "write a number"),
    ("\"h - 1\"", "\"h/0 - 1\"", "0 - 1", "divides by zero", "correct the divisor"),
    ("tt = ", "ta = ", "ta = ", "`ta` is no component", "write tt or t_x"),
    ("yy = ", "x_x = ", "xx = ", "given twice", "keep one"),
    ("zz = \"1 + h\"", "", "metric", "lacks its component `zz`", "give every component"),
    ("horizon = \"2*m\"", "horizon = \"2*r\"", "2*r", "cannot depend on coordinates", "depth"),
    ("horizon = \"2*m\"", "horizon = \"sqrt(-m)\"", "sqrt(-m)", "not a number", "change the parameters"),
    ("horizon = \"2*m\"", "horizon = \"m\"\ndepth = \"1/r\"", "\"1/r\"", "both say", "keep one"),
    ("horizon = \"2*m\"", "horizon = \"m\"\nthroat = 2", "2\n", "go on through a throat", "keep one"),
    ("horizon = \"2*m\"", "horizon = \"m\"\nouter = 0.5", "0.5", "within the horizon", "larger radius"),
    ("[\"t\", \"x\", \"y\", \"z\"]", "[\"t\", \"x\", \"y\"]", "[\"t\"", "has 3 values", "give"),
    ("m = 1.0", "sin = 1.0\nm = 1.0", "sin", "is the name of a function", "another name"),
    ("m = 1.0", "x = 1.0\nm = 1.0", "x = 1.0", "is the name of two things", "another name"),
    ("m = 1.0", "m = \"1\"", "\"1\"", "cannot be the text", "remove the quotation marks"),
    ("xx = \"1 + h\"", "xx = \"1 + h + t/r^2\"", "metric", "depends on time", "do not depend"),
    ("xx = \"1 + h\"", "xx = \"2 + h\"", "metric", "does not become flat", "`outer`"),
    ("xx = \"1 + h\"", "xx = \"1 + h*x/r\"\nyy = \"1\"", "yy", "given twice", "keep one"),
];

#[test]
fn broken_metrics_are_refused_at_their_place() {
    for (good, bad, at, what, mend) in BROKEN {
        assert!(GOOD.contains(good), "{good}");
        let text = GOOD.replacen(good, bad, 1);
        let found = faults(&text);
        let said = found.to_string();
        let first = &found[0];
        assert!(first.message.contains(what), "{bad}\n{said}");
        assert!(first.help.contains(mend), "{bad}\n{said}");
        let span = first.span.clone().unwrap();
        let typed = &text[span.start..];
        assert!(typed.starts_with(at), "{bad}\n{said}\n{}", typed.lines().next().unwrap_or(""));
    }
}

#[test]
fn faults_of_all_formulas_are_told_at_once() {
    let text = GOOD.replacen("h - 1", "hh - 1", 1).replacen("\"1 + h\"", "\"1 + hhh*q\"", 1);
    let found = faults(&text);
    assert_eq!(found.len(), 3, "{found}");
}

#[test]
fn mirrored_time_needs_the_same_all_around() {
    let text = GOOD.replacen("xx = \"1 + h\"", "xx = \"1 + h*abs(x)/r\"", 1);
    let text = text.replacen("horizon", "reversal = \"mirror\"\nhorizon", 1);
    let found = faults(&text);
    assert!(found[0].message.contains("its own mirror image"), "{found}");
}

#[test]
fn names_that_are_known_take_parameters_alone() {
    let start = "disk.model = \"none\"\nspacetime.name = \"kerr-newman\"\n";
    let scene =
        Scene::from_toml(&format!("{start}spacetime.parameters.charge = 0.1"), Path::new("")).unwrap();
    let horizon = scene.spacetime.text().unwrap().horizon();
    assert!((horizon - (1.0 + (1.0_f64 - 0.25 - 0.01).sqrt())).abs() < 1e-15);
    assert_eq!(Scene::from_toml(&scene.to_toml(), Path::new("")).unwrap(), scene);
    for (line, at, what) in [
        ("spacetime.parameters.chargé = 0.1", "é", "this is no key"),
        ("spacetime.parameters.carge = 0.1", "0.1", "has no parameter `carge`"),
        ("spacetime.parameters.charge = 0.9", "parameters.charge", "not a number"),
        ("spacetime.horizon = 2", "2", "`spacetime.horizon` would change it"),
        ("spacetime.spin = 0.3", "0.3", "no `spin` of its own"),
        ("render.engine = \"closed-form\"", "\"closed-form\"", "this spacetime is a text"),
        ("observer.motion = \"orbit\"", "\"orbit\"", "around Kerr holes only"),
        ("render.layers = [\"g\"]", "[\"g\"]", "around Kerr holes only"),
        ("screen = { kind = \"impact\" }", "\"impact\"", "at infinity only"),
        ("other_sky.kind = \"grid\"", "other_sky", "has none"),
        ("observer.distance = 1.2", "1.2", "horizon"),
    ] {
        let text = format!("{start}{line}");
        let found = faults(&text);
        assert!(found.iter().any(|fault| fault.message.contains(what)), "{line}\n{found}");
        let place = found.iter().find(|fault| fault.message.contains(what)).unwrap().span.clone().unwrap();
        assert!(text[place.start..].starts_with(at), "{line}\n{found}");
    }
    // The last stable orbit is looked for, and may not be there.
    let scene = Scene::from_toml("spacetime.name = \"kerr-text\"", Path::new("")).unwrap();
    assert!((scene.disk.unwrap().inner - 2.32088304176).abs() < 1e-9);
    let found = faults("spacetime.name = \"two-kerr\"\nobserver.distance = 50");
    assert!(found[0].message.contains("same all around") && found[0].help.contains("radius in M"), "{found}");
    let layers = "disk.outer = 30\nrender.layers = [\"g\"]";
    assert!(Scene::from_toml(&format!("spacetime.name = \"kerr-newman\"\n{layers}"), Path::new("")).is_ok());
    let found = faults(&format!("spacetime.name = \"kerr-newman\"\ndisk.inner = 7\n{layers}"));
    assert!(found[0].help.contains("isco"), "{found}");
}

#[test]
fn a_file_of_its_own_shows_its_faults() {
    let folder = tempfile::tempdir().unwrap();
    let metric = GOOD.split_once("name = \"text\"\n").unwrap().1.replace("[spacetime.", "[");
    let path = folder.path().join("own.toml");
    std::fs::write(&path, &metric).unwrap();
    let scene = "disk.model = \"none\"\nspacetime = { name = \"text\", file = \"own.toml\", parameters = { m = 0.5 } }";
    let read = Scene::from_toml(scene, folder.path()).unwrap();
    assert_eq!(read.spacetime.text().unwrap().horizon(), 1.0);
    // The record has no need of the file.
    assert_eq!(Scene::from_toml(&read.to_toml(), Path::new("")).unwrap().spacetime, read.spacetime);
    std::fs::write(&path, metric.replace("r + m)", "r + n)")).unwrap();
    let found = Scene::from_toml(scene, folder.path()).unwrap_err();
    assert!(found[0].source.name.ends_with("own.toml"), "{found}");
    assert_eq!(found[0].line_column(), Some((7, 15)), "{found}");
    let found = Scene::from_toml(&scene.replace("own.toml", "none.toml"), folder.path()).unwrap_err();
    assert!(found[0].message.contains("no such file"), "{found}");
    std::fs::write(&path, format!("spin = 0.5\n{metric}")).unwrap();
    let found = Scene::from_toml(scene, folder.path()).unwrap_err();
    assert!(found[0].message.contains("no meaning in a metric's file"), "{found}");
}

/// Reading never fails otherwise than by faults, whatever is typed.
#[test]
fn formulas_of_any_text_are_refused_or_read() {
    let pieces =
        ["x", "r", "(", ")", "^", "*", "/", "-", "1e3", ".", ",", "sqrt", "θ", "²", " ", "0", "atan2(", "m"];
    let mut state = 7_u64;
    for _ in 0..400 {
        let mut formula = String::new();
        for _ in 0..12 {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            formula.push_str(pieces[(state >> 33) as usize % pieces.len()]);
        }
        let _ = Scene::from_toml(&GOOD.replacen("h - 1", &formula, 1), Path::new(""));
    }
}
