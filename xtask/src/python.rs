//! The Python environment of tests, and the package in it.

use std::path::{Path, PathBuf};

use crate::{cargo, root, run};

/// What is installed: the reference implementations that read our files, and what the package's own tests need.
const REQUIREMENTS: [&str; 2] =
    ["crates/kerrscope/tests/requirements.txt", "crates/python/tests/requirements.txt"];

/// The interpreter of an environment under `target/` that has what the tests need. It is made again when that changes.
pub fn environment() -> Result<PathBuf, String> {
    let folder = root().join("target/python");
    let python = program(&folder, "python");
    let stamp = folder.join("requirements.txt");
    let wanted: String = REQUIREMENTS
        .iter()
        .map(|path| std::fs::read_to_string(root().join(path)).map_err(|e| format!("{path}: {e}")))
        .collect::<Result<_, _>>()?;
    if std::fs::read_to_string(&stamp).is_ok_and(|made| made == wanted) {
        return Ok(python);
    }
    let made = run(Path::new("python3"), &["-m", "venv", &folder.to_string_lossy()], &[]).and_then(|()| {
        let [ours, package] = REQUIREMENTS;
        run(&python, &["-m", "pip", "install", "-q", "-r", ours, "-r", package], &[])
    });
    made.map_err(|e| format!("no Python environment can be made: {e}"))?;
    std::fs::write(&stamp, wanted).map_err(|e| format!("{}: {e}", stamp.display()))?;
    Ok(python)
}

/// Builds the package's wheel, installs it, and runs its tests. The wheel is built as
/// tests are (`dev`), whose libraries are there already.
pub fn test(python: &Path) -> Result<(), String> {
    let folder = root().join("target/python");
    let wheels = root().join("target/wheels");
    // One wheel, so that it has no other beside it.
    let _ = std::fs::remove_dir_all(&wheels);
    let maturin = program(&folder, "maturin");
    let manifest = "crates/python/Cargo.toml";
    let out = wheels.to_string_lossy();
    run(
        &maturin,
        &[
            "build",
            "--quiet",
            "--profile",
            "dev",
            "--locked",
            "--manifest-path",
            manifest,
            "--interpreter",
            &python.to_string_lossy(),
            "--out",
            &out,
        ],
        &[],
    )?;
    let wheel = std::fs::read_dir(&wheels)
        .and_then(|mut found| found.next().transpose())
        .map_err(|e| format!("{out}: {e}"))?
        .ok_or_else(|| format!("{out} holds no wheel"))?
        .path();
    let wheel = wheel.to_string_lossy();
    run(python, &["-m", "pip", "install", "-q", "--no-deps", "--force-reinstall", &wheel], &[])?;
    // What the package says is compared with what the program says.
    cargo(&["build", "--quiet", "--package", "kerrscope-cli", "--locked"], &[])?;
    let kerrscope =
        root().join("target/debug").join(if cfg!(windows) { "kerrscope.exe" } else { "kerrscope" });
    let environment = [("KERRSCOPE_PROGRAM", &*kerrscope.to_string_lossy())];
    run(python, &["-m", "pytest", "-p", "no:cacheprovider", "crates/python/tests"], &environment)
}

/// A program of an environment.
fn program(environment: &Path, name: &str) -> PathBuf {
    if cfg!(windows) {
        environment.join("Scripts").join(format!("{name}.exe"))
    } else {
        environment.join("bin").join(name)
    }
}
