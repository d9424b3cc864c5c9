//! Running the program as a user would.

pub mod served;

use std::path::Path;
use std::process::{Command, Output};

/// The program with some arguments, in a folder.
pub fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_kerrscope"));
    command.args(arguments).current_dir(folder).env("NO_COLOR", "1");
    command
}

/// Runs it to the end.
pub fn run(folder: &Path, arguments: &[&str]) -> Output {
    program(folder, arguments).output().expect("the program starts")
}

/// What it prints as JSON; it must succeed.
pub fn json(folder: &Path, arguments: &[&str]) -> serde_json::Value {
    let output = run(folder, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).expect("standard output is JSON alone")
}
