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
    let [ours, package] = REQUIREMENTS;
    make(&folder)
        .and_then(|()| run(&python, &["-m", "pip", "install", "-q", "-r", ours, "-r", package], &[]))
        .map_err(|e| format!("no Python environment can be made: {e}"))?;
    std::fs::write(&stamp, wanted).map_err(|e| format!("{}: {e}", stamp.display()))?;
    Ok(python)
}

fn make(folder: &Path) -> Result<(), String> {
    run(Path::new("python3"), &["-m", "venv", "--clear", &folder.to_string_lossy()], &[])
}

/// The package's tests alone, as `cargo xtask test` builds and runs them among the others: with the features that the whole workspace asks
/// of its dependencies, so that nothing is compiled twice.
pub fn test() -> Result<(), String> {
    let python = environment()?;
    let environment = [("KERRSCOPE_TEST_PYTHON", &*python.to_string_lossy())];
    // Tests of the program bring the program, with which the package is compared.
    cargo(&["test", "--workspace", "--locked", "--no-run", "--quiet", "--test", "all"], &[])?;
    cargo(
        &["test", "--workspace", "--locked", "--quiet", "--test", "package", "--", "--nocapture"],
        &environment,
    )
}

/// Builds the wheel that is given to people, and runs the README's lines with it in a fresh environment, where numpy is all that comes
/// along.
pub fn wheel() -> Result<(), String> {
    let tools = environment()?;
    let wheels = root().join("target/wheels");
    // One wheel, so that there is no other beside it.
    let _ = std::fs::remove_dir_all(&wheels);
    let out = wheels.to_string_lossy();
    let manifest = "crates/python/Cargo.toml";
    let maturin = program(&root().join("target/python"), "maturin");
    let interpreter = tools.to_string_lossy();
    run(
        &maturin,
        &["build", "--release", "--locked", "-m", manifest, "-i", &interpreter, "--out", &out],
        &[],
    )?;
    let wheel = std::fs::read_dir(&wheels)
        .and_then(|mut found| found.next().transpose())
        .map_err(|e| format!("{out}: {e}"))?
        .ok_or_else(|| format!("{out} holds no wheel"))?
        .path();
    let folder = root().join("target/python-fresh");
    make(&folder)?;
    let python = program(&folder, "python");
    run(&python, &["-m", "pip", "install", "-q", &wheel.to_string_lossy()], &[])?;
    let readme = std::fs::read_to_string(root().join("README.md")).map_err(|e| format!("README.md: {e}"))?;
    let lines = readme
        .split_once("```python\n")
        .and_then(|(_, rest)| rest.split_once("```"))
        .map(|(lines, _)| lines)
        .ok_or("README.md has no lines in Python")?;
    let script = folder.join("readme.py");
    // The picture goes where the environment is.
    let program = format!(
        "import os, sys\nos.chdir(sys.prefix)\n{lines}\nassert os.path.getsize('hole.png') > 10_000\nprint(image)\n"
    );
    std::fs::write(&script, program).map_err(|e| format!("{}: {e}", script.display()))?;
    // No browser: what shows pictures is told to do nothing.
    run(&python, &[&script.to_string_lossy()], &[("BROWSER", "true")])?;
    run(&python, &["-m", "pip", "list", "--format", "freeze"], &[])
}

/// A program of an environment.
fn program(environment: &Path, name: &str) -> PathBuf {
    if cfg!(windows) {
        environment.join("Scripts").join(format!("{name}.exe"))
    } else {
        environment.join("bin").join(name)
    }
}
