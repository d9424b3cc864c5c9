//! Chores of the repository.
//!
//!     cargo xtask test             every test
//!     cargo xtask check            formatting, lints, documentation
//!     cargo xtask pictures [NAME...]
//!                                  the pictures of README.md and scenes/, all or those of these names
//!     cargo xtask campaign NAME    longer work, its dated report kept in reports/
//!     cargo xtask fuzz [TARGET] [--seconds N]
//!                                  libFuzzer on what reads files, 10 minutes a target
//!     cargo xtask sky-data FOLDER  data of the sky again; see crates/kerrscope/data/README.md
//!     cargo xtask earth-data FOLDER
//!                                  data of the Earth again; see there too

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const USAGE: &str = "usage: cargo xtask test | check | pictures [NAME...] | campaign NAME | fuzz [TARGET] \
     | sky-data FOLDER | earth-data FOLDER";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["test"] => test(),
        ["check"] => check(),
        ["pictures" | "campaign" | "fuzz" | "sky-data" | "earth-data", ..] => chores(&words),
        _ => Err(USAGE.to_owned()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// The repository's root folder.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_path_buf)
}

/// What needs the library is in a crate of its own, so that `test` and `check` build nothing before they begin.
fn chores(words: &[&str]) -> Result<(), String> {
    let cargo_run = ["run", "--quiet", "--release", "--locked", "--package", "kerrscope-chores", "--"];
    cargo(&[&cargo_run[..], words].concat(), &[])
}

/// Unit, integration and documentation tests. Where there is a Python, those that compare with other
/// programs run too; otherwise they say that they are skipped.
fn test() -> Result<(), String> {
    let python = python();
    let environment: Vec<_> = python.iter().map(|path| ("KERRSCOPE_TEST_PYTHON", path.as_str())).collect();
    cargo(&["test", "--workspace", "--locked"], &environment)
}

/// A Python environment under `target/` with what the tests need.
fn python() -> Option<String> {
    let folder = root().join("target/python");
    let python = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let wanted = root().join("crates/kerrscope/tests/requirements.txt");
    let stamp = folder.join("requirements.txt");
    let same = std::fs::read(&stamp).is_ok_and(|made| std::fs::read(&wanted).is_ok_and(|now| made == now));
    if !same {
        let run = |program: &Path, arguments: &[&std::ffi::OsStr]| {
            Command::new(program).args(arguments).status().is_ok_and(|status| status.success())
        };
        let made = run(Path::new("python3"), &["-m".as_ref(), "venv".as_ref(), folder.as_os_str()])
            && run(
                &python,
                &["-m", "pip", "install", "-q", "-r"]
                    .map(AsRef::as_ref)
                    .into_iter()
                    .chain([wanted.as_os_str()])
                    .collect::<Vec<_>>(),
            )
            && std::fs::copy(&wanted, &stamp).is_ok();
        if !made {
            eprintln!("xtask: no Python environment can be made; tests that need one are skipped");
            return None;
        }
    }
    Some(python.to_string_lossy().into_owned())
}

fn check() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"], &[])?;
    cargo(&["fmt", "--manifest-path", "fuzz/Cargo.toml", "--check"], &[])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"], &[])?;
    cargo(&["doc", "--workspace", "--no-deps", "--locked"], &[("RUSTDOCFLAGS", "-D warnings")])
}

/// Runs cargo in the root folder.
fn cargo(arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), String> {
    eprintln!("$ cargo {}", arguments.join(" "));
    let status = Command::new(env!("CARGO"))
        .args(arguments)
        .envs(environment.iter().copied())
        .current_dir(root())
        .status()
        .map_err(|e| format!("cargo: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("cargo {} failed", arguments.join(" "))) }
}
