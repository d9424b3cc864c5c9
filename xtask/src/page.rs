//! What the live page is tested with: a browser, and what drives it.

use std::path::Path;

use crate::{root, run};

/// Names of the browser.
const BROWSERS: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// Sees to it that there are both.
pub fn tools() -> Result<(), String> {
    browser()?;
    driver()
}

/// Whether a program is on the path.
fn found(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}

/// Chromium: installed where that is root's to do, by Debian's packages.
fn browser() -> Result<(), String> {
    if BROWSERS.iter().any(|name| found(name)) {
        return Ok(());
    }
    let root = std::process::Command::new("id")
        .arg("-u")
        .output()
        .is_ok_and(|said| String::from_utf8_lossy(&said.stdout).trim() == "0");
    if !root || !found("apt-get") {
        return Err("there is no Chromium".to_owned());
    }
    let apt = Path::new("apt-get");
    let quiet = [("DEBIAN_FRONTEND", "noninteractive")];
    run(apt, &["-qq", "update"], &quiet)?;
    run(apt, &["-qq", "install", "--yes", "--no-install-recommends", "chromium"], &quiet)
}

/// What drives it, and checks the page's types; fetched once, and again when that changes.
fn driver() -> Result<(), String> {
    let web = root().join("web");
    let lock =
        std::fs::read(web.join("package-lock.json")).map_err(|e| format!("web/package-lock.json: {e}"))?;
    let stamp = web.join("node_modules/fetched.json");
    if std::fs::read(&stamp).is_ok_and(|fetched| fetched == lock) {
        return Ok(());
    }
    run(Path::new("npm"), &["ci", "--prefix", "web", "--no-audit", "--no-fund"], &[])?;
    std::fs::write(&stamp, lock).map_err(|e| format!("{}: {e}", stamp.display()))
}
