//! Chores that draw and measure with the library, for `cargo xtask`: pictures, campaigns, fuzzing, data.

mod campaign;
mod earth_data;
mod fuzz;
mod pictures;
mod sky_data;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["pictures", ref names @ ..] => pictures::draw(&root(), names),
        ["campaign", name] => campaign::run(&root(), name),
        ["fuzz", ref words @ ..] => fuzz::run(&root(), words),
        ["sky-data", folder] => sky_data::write(&root(), Path::new(folder)),
        ["earth-data", folder] => earth_data::write(&root(), Path::new(folder)),
        _ => Err("a chore is pictures [NAME...], campaign NAME, fuzz [TARGET], sky-data FOLDER or earth-data FOLDER"
            .to_owned()),
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

/// Runs cargo in the root folder.
fn cargo(arguments: &[&str]) -> Result<(), String> {
    eprintln!("$ cargo {}", arguments.join(" "));
    let status = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(root())
        .status()
        .map_err(|e| format!("cargo: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("cargo {} failed", arguments.join(" "))) }
}
