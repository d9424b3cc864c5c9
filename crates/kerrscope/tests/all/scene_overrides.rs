//! `--set PATH=VALUE`.

use std::path::Path;

use kerrscope::scene::{Faults, Scene, Spacetime};
use kerrscope::spacetime::observer::Motion;

fn load(overrides: &[&str]) -> Result<Scene, Faults> {
    load_file(None, overrides)
}

fn load_file(path: Option<&Path>, overrides: &[&str]) -> Result<Scene, Faults> {
    let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
    Scene::load(path, &overrides)
}

#[track_caller]
fn assert_fault(override_: &str, expected: &str) {
    let faults = load(&["render.width=10", override_]).expect_err(override_);
    assert_eq!(faults.to_string(), expected);
}

#[test]
fn values_and_bare_words() {
    let scene = load(&[
        "spacetime.spin=0.9",
        "observer.motion=\"fall\"",
        " render . width = 400 ",
        "sky.kind=black",
        "disk.inner=isco",
        "screen.look_at=[0, 0, 1]",
        "camera.display.exposure=-1",
        "render.jitter=false",
    ])
    .unwrap();
    assert_eq!(scene.spacetime, Spacetime::Kerr { spin: 0.9 });
    assert_eq!(scene.observer.motion, Motion::Fall);
    assert_eq!(scene.render.width, 400);
    assert_eq!(scene.screen.look_at, Some([0.0, 0.0, 1.0]));
    assert_eq!(scene.display.view.exposure, -1.0);
    assert!(!scene.render.jitter);
    let flat = load(&["spacetime.name=minkowski", "disk.model=none"]).unwrap();
    assert_eq!(flat.spacetime, Spacetime::Minkowski);
    let far = load(&["observer.distance=inf", "screen.kind=impact"]).unwrap();
    assert!(far.observer.place.r.is_infinite());
}

#[test]
fn later_ones_hold() {
    let scene = load(&["render.width=1", "render.width=2"]).unwrap();
    assert_eq!(scene.render.width, 2);
    // A whole section, then a key of it.
    let scene = load(&["spacetime={ name = \"kerr\", spin = 0.5 }", "spacetime.spin=0.1"]).unwrap();
    assert_eq!(scene.spacetime, Spacetime::Kerr { spin: 0.1 });
    // A word, then a table in its place.
    let scene = load(&["observer.motion=fall", "observer.motion.velocity=[0, 0, 0.5]"]).unwrap();
    assert_eq!(scene.observer.motion, Motion::Velocity([0.0, 0.0, 0.5]));
}

#[test]
fn they_hold_against_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, "[spacetime]\nspin = 7\n[render]\nwidth = 3\nheight = 5\n").unwrap();
    let scene = load_file(Some(&path), &["spacetime.spin=0.7", "render.width=4"]).unwrap();
    assert_eq!(scene.spacetime.spin(), Some(0.7));
    assert_eq!((scene.render.width, scene.render.height), (4, 5));

    let faults = load_file(Some(&path), &["render.width=0", "disk.outer=1"]).unwrap_err();
    let places: Vec<(String, Option<(usize, usize)>)> =
        faults.iter().map(|fault| (fault.source.name.clone(), fault.line_column())).collect();
    // The disk is not judged: its inner edge follows from a spin that is wrong.
    let name = path.display().to_string();
    assert_eq!(places, [(name, Some((2, 8))), ("--set #1".to_owned(), Some((1, 14)))]);
}

#[test]
fn what_is_wrong_with_them_together_is_told_at_one() {
    assert_fault(
        "disk.outer=1",
        "--set #2:1:12: the disk's outer edge 1 is not outside its inner edge 1.454498, the isco\n  \
         help: give `disk.outer` more than 1.454498, or a smaller `disk.inner`",
    );
    assert_fault(
        "spacetime.name=minkowski",
        "--set #2:1:16: in flat space there is no innermost stable orbit for `disk.inner = \"isco\"`\n  \
         help: give `disk.inner` a radius in M, or set `disk.model = \"none\"`",
    );
}

#[test]
fn wrong_paths() {
    let write = "write SECTION.KEY=VALUE, as in spacetime.spin=0.9";
    assert_fault("=3", &format!("--set #2:1:1: there is no path before `=`\n  help: {write}"));
    for path in ["spacetime..spin", ".spin", "spin.", "[spacetime]", "\"spin\"", "space time", "a#b"] {
        let expected = format!("--set #2:1:1: `{path}` is no path to a key\n  help: {write}");
        assert_fault(&format!("{path}=1"), &expected);
    }
    assert_fault(
        "spin=0.9",
        "--set #2:1:1: `spin` is not in a section\n  help: `spin` belongs in [spacetime]",
    );
    assert_fault(
        "spacetime.spni=0.9",
        "--set #2:1:11: [spacetime] has no key `spni`\n  help: did you mean `spin`?",
    );
    assert_fault(
        "spacetime.spin.x=0.9",
        "--set #2:1:11: `spacetime.spin` cannot be a table\n  \
         help: give a number from -1 to 1; the default is 0.99",
    );
}

#[test]
fn wrong_values() {
    let write = "as in spacetime.spin=0.9";
    assert_fault("", &format!("--set #2:1:1: this override is empty\n  help: write PATH=VALUE, {write}"));
    assert_fault("spin", &format!("--set #2:1:1: `spin` gives no value\n  help: write PATH=VALUE, {write}"));
    assert_fault(
        "spacetime.spin= ",
        &format!(
            "--set #2:1:17: `spacetime.spin` is given no value\n  \
             help: write the value after `=`, {write}"
        ),
    );
    assert_fault(
        "spacetime.spin=0.9.1",
        "--set #2:1:16: `spacetime.spin` cannot be the text 0.9.1\n  \
         help: give a number from -1 to 1; the default is 0.99",
    );
    assert_fault(
        "screen.look_at=[0, 0",
        "--set #2:1:16: this list is never closed\n  help: close it with `]`",
    );
    assert_fault("sky.kind=\"black", "--set #2:1:16: this text is never closed\n  help: end it with `\"`");
    assert_fault(
        "render.seed=1\nrender.height=2",
        "--set #2:1:14: a control character in an override\n  \
         help: an override is one line, PATH=VALUE",
    );
    assert_fault(
        "render.jitter=False",
        "--set #2:1:15: `render.jitter` cannot be the text False\n  help: write it plainly: false",
    );
    assert_fault(
        "render.seed=1\u{85}",
        "--set #2:1:14: a control character in an override\n  \
         help: an override is one line, PATH=VALUE",
    );
    assert_fault(
        "render.jitter=maybe",
        "--set #2:1:15: `render.jitter` cannot be the text maybe\n  \
         help: give true or false; the default is true",
    );
}

#[test]
fn several_are_told_in_their_order() {
    let faults = load(&["render.width=0", "a=1", "=", "render.height=0"]).unwrap_err();
    let names: Vec<&str> = faults.iter().map(|fault| fault.source.name.as_str()).collect();
    assert_eq!(names, ["--set #1", "--set #2", "--set #3", "--set #4"]);
}
