//! Chores of the repository.
//!
//!     cargo xtask test             every test
//!     cargo xtask check            formatting, lints, documentation
//!     cargo xtask pictures         the pictures of README.md and scenes/
//!     cargo xtask campaign NAME    longer work, its dated report kept in reports/
//!     cargo xtask sky-data FOLDER  data of the sky again; see crates/kerrscope/data/README.md

mod campaign;
mod pictures;
mod sky_data;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const USAGE: &str = "usage: cargo xtask test | check | pictures | campaign NAME | sky-data FOLDER";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["test"] => test(),
        ["check"] => check(),
        ["pictures"] => pictures::draw(&root()),
        ["campaign", name] => campaign::run(&root(), name),
        ["sky-data", folder] => sky_data::write(&root(), Path::new(folder)),
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

/// Unit, integration and documentation tests. They need nothing but Rust.
fn test() -> Result<(), String> {
    cargo(&["test", "--workspace", "--locked"], &[])
}

fn check() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"], &[])?;
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
