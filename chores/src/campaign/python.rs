//! What the Python package costs, measured with the wheel that is given to people.

use std::path::Path;
use std::process::{Command, Stdio};

/// Builds the wheel, tries it in an environment of its own, and measures with it in the one of the tests.
pub fn run(root: &Path) -> Result<(bool, String), String> {
    let program = super::program(root)?;
    super::super::cargo(&["xtask", "wheel"])?;
    let wheel = std::fs::read_dir(root.join("target/wheels"))
        .and_then(|mut found| found.next().transpose())
        .map_err(|e| format!("target/wheels: {e}"))?
        .ok_or("target/wheels holds no wheel")?
        .path();
    let (scripts, end) = if cfg!(windows) { ("Scripts", ".exe") } else { ("bin", "") };
    let python = root.join("target/python").join(scripts).join(format!("python{end}"));
    let folder = root.join("target/figures");
    let _ = std::fs::remove_dir_all(&folder);
    let package = folder.join("package");
    std::fs::create_dir_all(&package).map_err(|e| format!("{}: {e}", package.display()))?;
    let installed = Command::new(&python)
        .args(["-m", "pip", "install", "-q", "--no-deps", "--target"])
        .args([&package, &wheel])
        .status()
        .map_err(|e| format!("{}: {e}", python.display()))?;
    if !installed.success() {
        return Err("the wheel cannot be installed".to_owned());
    }
    let done = Command::new(&python)
        .arg(root.join("crates/python/campaign/figures.py"))
        .arg(program)
        .arg(&folder)
        .env("PYTHONPATH", &package)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| e.to_string())?;
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    let _ = std::fs::remove_dir_all(&folder);
    if said.is_empty() { Err("figures.py failed".to_owned()) } else { Ok((done.status.success(), said)) }
}
