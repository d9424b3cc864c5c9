//! libFuzzer on the targets of `fuzz/`, by way of cargo-fuzz.
//!
//! It needs no nightly Rust: no sanitizer is asked for, as there is no unsafe code of our own to
//! watch. It needs a C++ compiler, for libFuzzer.

use kerrscope::scene::SceneFile;
use rayon::prelude::*;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const CARGO_FUZZ: &str = "0.13.2";

/// Targets, and whether they read text with the words of a scene.
const TARGETS: [(&str, bool); 4] =
    [("scene", true), ("overrides", true), ("texture", false), ("provenance", true)];

/// Seconds that each target is given.
const SECONDS: u32 = 600;

/// No input below 1 MB may take 2 GB or 10 s. Without a sanitizer libFuzzer sees no single
/// allocations, but all of the memory.
const LIMITS: [&str; 4] = ["-max_len=1000000", "-rss_limit_mb=2048", "-malloc_limit_mb=2048", "-timeout=10"];

const TABLE: &str = "| target | inputs run | in a second | code edges | features | inputs kept | slowest input (s) | most memory (MiB) |\n\
                     |---|---|---|---|---|---|---|---|\n";

/// Runs a target, or all: `[TARGET] [--seconds N]`.
pub fn run(root: &Path, words: &[&str]) -> Result<(), String> {
    let (target, seconds) = match *words {
        [] => (None, SECONDS),
        [target] => (Some(target), SECONDS),
        ["--seconds", seconds] => (None, number(seconds)?),
        [target, "--seconds", seconds] => (Some(target), number(seconds)?),
        _ => return Err("usage: cargo xtask fuzz [TARGET] [--seconds N]".to_owned()),
    };
    let targets: Vec<_> =
        TARGETS.into_iter().filter(|(name, _)| target.is_none_or(|target| target == *name)).collect();
    if targets.is_empty() {
        let names = TARGETS.map(|(name, _)| name).join(", ");
        return Err(format!(
            "no target is called {target:?}; there are: {names}",
            target = target.unwrap_or("")
        ));
    }
    let (passed, table) = fuzz(root, &targets, seconds)?;
    println!("{table}");
    if passed { Ok(()) } else { Err("a fault was found; the input is in fuzz/found/".to_owned()) }
}

fn number(word: &str) -> Result<u32, String> {
    word.parse().map_err(|_| format!("{word:?} is no number of seconds"))
}

/// Every target for its time: whether none failed, and the table of the report.
pub fn campaign(root: &Path) -> Result<(bool, String), String> {
    let (passed, table) = fuzz(root, &TARGETS, SECONDS)?;
    let about = format!(
        "Each target {SECONDS} s with one worker, from the seeds and from what earlier runs kept \
         (`fuzz/corpus/`, `fuzz/found/`): `cargo fuzz run -O -s none TARGET -- {}`.\n\n",
        LIMITS.join(" ")
    );
    Ok((passed, about + &table))
}

fn fuzz(root: &Path, targets: &[(&str, bool)], seconds: u32) -> Result<(bool, String), String> {
    let tool = tool(root)?;
    let found = root.join("fuzz/found");
    let dictionary = found.join("words");
    let failed = |e: std::io::Error| format!("{}: {e}", found.display());
    fs::create_dir_all(&found).and_then(|()| fs::write(&dictionary, words())).map_err(failed)?;
    let cargo_fuzz = |command: &str| {
        let mut start = Command::new(&tool);
        start.args([command, "-O", "-s", "none", "--target-dir"]).arg(root.join("target/fuzz"));
        start.current_dir(root.join("fuzz"));
        start
    };
    let built = cargo_fuzz("build").status().map_err(|e| format!("cargo-fuzz: {e}"))?;
    if !built.success() {
        return Err("the fuzz targets cannot be built".to_owned());
    }
    // As many at a time as there are processors.
    let rows: Result<Vec<_>, String> = targets
        .par_iter()
        .map(|(target, reads_words)| {
            let kept = found.join(target);
            fs::create_dir_all(&kept).map_err(failed)?;
            let mut command = cargo_fuzz("run");
            command
                .arg(target)
                .args([&kept, &root.join("fuzz/corpus").join(target)])
                .arg("--")
                .args(LIMITS)
                .arg(format!("-max_total_time={seconds}"))
                .arg(format!("-artifact_prefix={}/{target}-", found.display()))
                .arg("-print_final_stats=1");
            if *reads_words {
                command.arg(format!("-dict={}", dictionary.display()));
            }
            follow(&mut command, target)
        })
        .collect();
    let (goods, table): (Vec<bool>, Vec<String>) = rows?.into_iter().unzip();
    Ok((goods.into_iter().all(|good| good), TABLE.to_owned() + &table.concat()))
}

/// Shows what a run says, and makes a row of the table of it.
fn follow(command: &mut Command, target: &str) -> Result<(bool, String), String> {
    let failed = |e: std::io::Error| format!("cargo-fuzz: {e}");
    let mut child = command.stderr(Stdio::piped()).spawn().map_err(failed)?;
    let (mut coverage, mut statistics) = (String::new(), String::new());
    for line in child.stderr.take().into_iter().flat_map(|said| BufReader::new(said).lines()) {
        // What is not UTF-8 is an input shown.
        let Ok(line) = line else { continue };
        if line.starts_with('#') && line.contains("cov:") {
            coverage.clone_from(&line);
        } else if line.starts_with("stat::") {
            let _ = writeln!(statistics, "{line}");
        }
        // New inputs are too many to be shown, and the dictionary is of no use to people.
        if !line.contains("\tNEW ") && !line.contains("\tREDUCE ") && !line.starts_with('"') {
            eprintln!("{line}");
        }
    }
    let good = child.wait().map_err(failed)?.success();
    let after = |text: &str, name: &str| {
        let rest = text.split_once(name).map_or("", |(_, rest)| rest.trim_start());
        rest.split_whitespace().next().unwrap_or("?").to_owned()
    };
    let row = [
        target.to_owned(),
        after(&statistics, "number_of_executed_units:"),
        after(&statistics, "average_exec_per_sec:"),
        after(&coverage, "cov:"),
        after(&coverage, "ft:"),
        after(&coverage, "corp:"),
        after(&statistics, "slowest_unit_time_sec:"),
        after(&statistics, "peak_rss_mb:"),
    ];
    Ok((good, format!("| {} |\n", row.join(" | "))))
}

/// cargo-fuzz, which is installed in `target/` if it is not there.
fn tool(root: &Path) -> Result<PathBuf, String> {
    let folder = root.join(format!("target/cargo-fuzz-{CARGO_FUZZ}"));
    let tool = folder.join("bin").join(format!("cargo-fuzz{}", std::env::consts::EXE_SUFFIX));
    if !tool.exists() {
        let to = folder.to_string_lossy();
        super::cargo(&["install", "cargo-fuzz", "--version", CARGO_FUZZ, "--locked", "--root", &to])?;
    }
    Ok(tool)
}

/// The keys and words of a scene, as a dictionary for libFuzzer.
fn words() -> String {
    let mut words = BTreeSet::new();
    gather(&SceneFile::schema(), &mut words);
    words.iter().fold(String::new(), |text, word| text + "\"" + word + "\"\n")
}

fn gather(schema: &Value, words: &mut BTreeSet<String>) {
    match schema {
        Value::Object(map) => {
            for (key, value) in map {
                match (key.as_str(), value) {
                    ("properties", Value::Object(keys)) => words.extend(keys.keys().cloned()),
                    ("const", Value::String(word)) => drop(words.insert(word.clone())),
                    _ => {}
                }
                gather(value, words);
            }
        }
        Value::Array(list) => list.iter().for_each(|value| gather(value, words)),
        _ => {}
    }
}
