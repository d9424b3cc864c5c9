//! How fast the live page is, measured in a browser.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

/// Serves the built-in scene, and has `web/tests/figures.mjs` look at it. `cargo xtask test` fetches what drives the browser.
pub fn run(root: &Path) -> Result<(bool, String), String> {
    let program = super::program(root)?;
    let mut served = Command::new(program)
        .args(["view", "--port", "0", "--no-open"])
        .current_dir(root)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|e| e.to_string())?;
    let mut address = String::new();
    let read = served.stdout.take().map(|out| BufReader::new(out).read_line(&mut address));
    let done = Command::new("node")
        .arg("web/tests/figures.mjs")
        .arg(address.trim())
        .current_dir(root)
        .stderr(Stdio::inherit())
        .output();
    let _ = served.kill().and_then(|()| served.wait());
    if !matches!(read, Some(Ok(_))) {
        return Err("kerrscope view said nothing".to_owned());
    }
    let done = done.map_err(|e| format!("node: {e}"))?;
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    if said.is_empty() { Err("figures.mjs failed".to_owned()) } else { Ok((done.status.success(), said)) }
}
