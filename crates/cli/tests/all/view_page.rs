//! The live page in a browser: headless Chromium, driven by Playwright.

use super::common::served::Served;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::tempdir;

/// A program of the path.
fn found(names: &[&str]) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    names.iter().find_map(|name| folders.iter().map(|folder| folder.join(name)).find(|file| file.is_file()))
}

#[test]
fn the_page_does_what_it_shall() {
    let web = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web");
    let Some(node) = found(&["node", "nodejs"]) else {
        eprintln!("skipped: there is no node, which drives the browser");
        return;
    };
    let Some(browser) = found(&["chromium", "chromium-browser", "google-chrome"]) else {
        eprintln!("skipped: there is no Chromium");
        return;
    };
    if !web.join("node_modules/playwright-core").is_dir() {
        eprintln!("skipped: Playwright is not there; `npm ci` in web/ fetches it");
        return;
    }
    let folder = tempdir().unwrap();
    let served = Served::start(folder.path(), &[]);
    let done = Command::new(node)
        .arg(web.join("tests/page.mjs"))
        .args([served.address.as_str()])
        .arg(folder.path())
        .arg(browser)
        .arg(env!("CARGO_BIN_EXE_kerrscope"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&done.stdout);
    println!("{said}");
    assert!(done.status.success(), "{said}\n{}", String::from_utf8_lossy(&done.stderr));
}
