//! Chores of the repository.
//!
//!     cargo xtask test             every test, with what they need (a Python environment, a browser)
//!     cargo xtask python           tests of the Python package alone
//!     cargo xtask wheel            the Python package as it is given to people, tried in a fresh environment
//!     cargo xtask check            formatting, lints, documentation
//!     cargo xtask pictures [NAME...]
//!                                  the pictures of README.md and scenes/, all or those of these names
//!     cargo xtask campaign NAME    longer work, its dated report kept in reports/
//!     cargo xtask fuzz [TARGET] [--seconds N]
//!                                  libFuzzer on what reads files, 10 minutes a target
//!     cargo xtask sky-data FOLDER  data of the sky again; see crates/kerrscope/data/README.md
//!     cargo xtask earth-data FOLDER
//!                                  data of the Earth again; see there too

mod page;
mod python;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const USAGE: &str = "usage: cargo xtask test | python | wheel | check | pictures [NAME...] | campaign NAME | fuzz [TARGET] \
     | sky-data FOLDER | earth-data FOLDER";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["test"] => test(),
        ["python"] => python::test(),
        ["wheel"] => python::wheel(),
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

/// Unit, integration and documentation tests. Where there is a Python, the package for it is tested, and so is what compares with other
/// programs; otherwise it is said that these are skipped.
fn test() -> Result<(), String> {
    let python = python::environment();
    if let Err(fault) = &python {
        eprintln!("xtask: {fault}; tests that need Python are skipped");
    }
    if let Err(fault) = page::tools() {
        eprintln!("xtask: {fault}; the live page is not tested in a browser");
    }
    let path = python.map(|path| path.to_string_lossy().into_owned()).ok();
    let environment: Vec<_> = path.iter().map(|path| ("KERRSCOPE_TEST_PYTHON", path.as_str())).collect();
    cargo(&["test", "--workspace", "--locked"], &environment)
}

fn check() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"], &[])?;
    cargo(&["fmt", "--manifest-path", "fuzz/Cargo.toml", "--check"], &[])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"], &[])?;
    cargo(&["doc", "--workspace", "--no-deps", "--locked"], &[("RUSTDOCFLAGS", "-D warnings")])
}

/// Runs cargo in the root folder.
fn cargo(arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), String> {
    run(Path::new(env!("CARGO")), arguments, environment)
}

/// Runs a program in the root folder.
fn run(program: &Path, arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), String> {
    let name = program.file_stem().unwrap_or_default().to_string_lossy();
    eprintln!("$ {name} {}", arguments.join(" "));
    let status = Command::new(program)
        .args(arguments)
        .envs(environment.iter().copied())
        .current_dir(root())
        .status()
        .map_err(|e| format!("{name}: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("{name} {} failed", arguments.join(" "))) }
}
