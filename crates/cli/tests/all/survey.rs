//! `kerrscope survey`: plans, runs that go on, shards, libraries.

use crate::common;

use common::{json, program, run};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

const SURVEY: &str = r#"
[set]
"render.width" = 24
"render.height" = 16
"render.samples" = 1
"disk.model" = "page-thorne"

[[axis]]
key = "spacetime.spin"
from = 0.0
to = 0.9
steps = 4

[[axis]]
key = "disk.outer"
values = [12, "isco-outer", 20]
"#;

fn folder(survey: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("survey.toml"), survey).unwrap();
    folder
}

/// The results in a folder by their names.
fn results(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let results = files.filter(|path| path.extension().is_some_and(|ending| ending == "h5"));
    results
        .map(|path| (path.file_name().unwrap().to_string_lossy().into_owned(), fs::read(path).unwrap()))
        .collect()
}

fn good() -> String {
    SURVEY.replace("\"isco-outer\", ", "")
}

/// A result is what `render` makes of the same scene; for any number of threads; in parts as in one; and nothing is made twice.
#[test]
fn results_are_renders_whoever_makes_them() {
    let folder = folder(&good());
    let path = folder.path();
    let plan = json(path, &["survey", "plan", "survey.toml", "-o", "plan.json", "--format", "json"]);
    let tasks = plan["tasks"].as_array().unwrap();
    assert_eq!(tasks.len(), 8);
    let made = json(
        path,
        &["survey", "run", "survey.toml", "--folder", "one", "--threads", "1", "--format", "json"],
    );
    assert_eq!((made["made"].as_u64(), made["tasks"].as_u64()), (Some(8), Some(8)));
    assert_eq!(
        run(path, &["survey", "run", "plan.json", "--folder", "three", "--threads", "3"]).status.code(),
        Some(0)
    );
    let one = results(&path.join("one"));
    assert_eq!(one.len(), 8);
    assert_eq!(one, results(&path.join("three")));
    let last = &tasks[7];
    assert_eq!((last["values"][0].as_f64(), last["values"][1].as_f64()), (Some(0.9), Some(20.0)));
    let set = [
        "spacetime.spin=0.9",
        "disk.outer=20",
        "render.width=24",
        "render.height=16",
        "render.samples=1",
        "disk.model=page-thorne",
    ];
    let arguments =
        ["render", "-o", "x.h5"].into_iter().chain(set.into_iter().flat_map(|set| ["--set", set]));
    assert!(run(path, &arguments.collect::<Vec<_>>()).status.success());
    assert!(one[&format!("{}.h5", last["name"].as_str().unwrap())] == fs::read(path.join("x.h5")).unwrap());

    for shard in ["1/3", "2/3", "3/3"] {
        let into = format!("part-{}", &shard[..1]);
        assert!(
            run(path, &["survey", "run", "survey.toml", "--folder", &into, "--shard", shard])
                .status
                .success()
        );
    }
    let merge = |folders: &[&str], output: &str| {
        let mut arguments = vec!["survey", "merge", "survey.toml", "-o", output];
        arguments.extend(folders.iter().flat_map(|folder| ["--folder", *folder]));
        run(path, &arguments)
    };
    assert!(merge(&["one"], "whole.h5").status.success());
    assert!(merge(&["part-1", "part-2", "part-3"], "parts.h5").status.success());
    assert!(fs::read(path.join("whole.h5")).unwrap() == fs::read(path.join("parts.h5")).unwrap());
    let output = merge(&["part-1", "part-3"], "some.h5");
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(errors.contains("3 of 8 pictures are missing"), "{errors}");

    // Again: nothing is left to do, and the journal says so.
    let again = json(path, &["survey", "run", "survey.toml", "--folder", "one", "--format", "json"]);
    assert_eq!(again["made"].as_u64(), Some(0));
    let status = json(path, &["survey", "status", "survey.toml", "--folder", "one", "--format", "json"]);
    assert_eq!(
        (status["done"].as_u64(), status["repeated"].as_u64(), status["others"].as_u64()),
        (Some(8), Some(0), Some(0))
    );
}

/// Killed over and over, it gets on; no result is half there, and each is made once but those at work at a kill.
#[cfg(unix)]
#[test]
fn killed_it_goes_on() {
    let slow = good()
        .replace("steps = 4", "steps = 2")
        .replace("= 24", "= 160")
        .replace("= 16", "= 120")
        .replace("\"render.samples\" = 1", "\"render.samples\" = 16");
    let folder = folder(&slow);
    let path = folder.path();
    let arguments = ["survey", "run", "survey.toml", "--threads", "1"];
    let into = path.join("survey");
    let count = || if into.is_dir() { results(&into).len() } else { 0 };
    // Killed as soon as there is one result more, while it is at the next.
    for _ in 0..2 {
        let before = count();
        let mut child =
            program(path, &arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        while count() == before {
            assert!(child.try_wait().unwrap().is_none(), "it ended without a result more");
            std::thread::sleep(Duration::from_millis(5));
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!((2..4).contains(&count()), "{} results", count());
    assert!(run(path, &arguments).status.success());
    let status = json(path, &["survey", "status", "survey.toml", "--format", "json"]);
    assert_eq!(status["done"].as_u64(), Some(4));
    assert_eq!(status["repeated"].as_u64(), Some(0));
    let sound = json(path, &["survey", "run", "survey.toml", "--folder", "sound", "--format", "json"]);
    assert_eq!(sound["made"].as_u64(), Some(4));
    assert!(results(&path.join("survey")) == results(&path.join("sound")));
}

/// Faults of the survey and of its scenes say where they are; nothing is written.
#[test]
fn faults_are_told_at_once() {
    let cases = [
        (SURVEY.to_owned(), vec!["disk.outer"]),
        ("[[axis]]\nkey = \"spacetime.spin\"\nfrom = 0\nto = 1".to_owned(), vec!["survey.toml:2:7", "[sample]"]),
        (
            "[sample]\ndesign = \"sobol\"\ncount = 0\n[[axis]]\nkey = \"spacetime.spin\"\nvalue = [1]".to_owned(),
            vec!["survey.toml:3:9", "survey.toml:6:1", "did you mean `values`"],
        ),
        ("[[axis]]\nkey = \"spacetime.spni\"\nvalues = [0.5]".to_owned(), vec!["spin"]),
        ("scene = \"none.toml\"".to_owned(), vec!["none.toml", "there is no such file"]),
        (
            "[[axis]]\nkey = \"spacetime.spin\"\nfrom = 0\nto = 1\nsteps = 1000000\n[[axis]]\nkey = \"observer.inclination\"\nfrom = 0\nto = \
             1\nsteps = 1000000"
                .to_owned(),
            vec!["too many combinations"],
        ),
        (
            "set = { \"spacetime.spin\" = 0.1 }\n[[axis]]\nkey = \"spacetime.spin\"\nvalues = [0.5]".to_owned(),
            vec!["is set twice"],
        ),
    ];
    for (survey, expected) in cases {
        let folder = folder(&survey);
        let output = run(folder.path(), &["survey", "run", "survey.toml"]);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{survey}: {errors}");
        for part in expected {
            assert!(errors.contains(part), "{survey}: {part:?} is not in\n{errors}");
        }
        assert!(!folder.path().join("survey").exists(), "{survey}");
    }
    let folder = folder(&good());
    let output = run(folder.path(), &["survey", "run", "survey.toml", "--shard", "4/3"]);
    assert_eq!(output.status.code(), Some(2));
    let output = run(folder.path(), &["survey", "status", "survey.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let output = run(folder.path(), &["survey", "run", "none.toml"]);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(errors.contains("none.toml: there is no such file"), "{errors}");
}
