//! The package as Python has it, tested by pytest with the interpreter that `KERRSCOPE_TEST_PYTHON` names.

use std::env::consts::DLL_SUFFIX;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where Cargo puts what it builds: this test is in `deps` of it.
fn built() -> Result<PathBuf, Box<dyn Error>> {
    let own = std::env::current_exe()?;
    Ok(own.ancestors().nth(2).ok_or("the test is nowhere")?.to_path_buf())
}

/// The package in a folder: what people import, and the compiled module, by the name that every Python from 3.10 on takes.
fn assemble(folder: &Path, built: &Path) -> Result<(), Box<dyn Error>> {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/kerrscope");
    let package = folder.join("kerrscope");
    fs::create_dir(&package)?;
    for entry in fs::read_dir(sources)? {
        let path = entry?.path();
        if path.is_file() {
            fs::copy(&path, package.join(path.file_name().ok_or("no name")?))?;
        }
    }
    let (library, module) = if cfg!(windows) {
        ("_core.dll".to_owned(), "_core.pyd")
    } else {
        (format!("lib_core{DLL_SUFFIX}"), "_core.abi3.so")
    };
    let library = built.join("deps").join(library);
    fs::copy(&library, package.join(module)).map_err(|e| format!("{}: {e}", library.display()))?;
    Ok(())
}

#[test]
fn the_package_passes_its_tests() -> Result<(), Box<dyn Error>> {
    let Some(python) = std::env::var_os("KERRSCOPE_TEST_PYTHON") else {
        eprintln!("skipped: KERRSCOPE_TEST_PYTHON is not set; `cargo xtask test` sets it");
        return Ok(());
    };
    let folder = tempfile::tempdir()?;
    let built = built()?;
    assemble(folder.path(), &built)?;
    let mut pytest = Command::new(python);
    pytest
        .args(["-m", "pytest", "-p", "no:cacheprovider", "--durations=5"])
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests"))
        .env("PYTHONPATH", folder.path())
        .env("PYTHONDONTWRITEBYTECODE", "1");
    let program = built.join(if cfg!(windows) { "kerrscope.exe" } else { "kerrscope" });
    if program.is_file() {
        pytest.env("KERRSCOPE_PROGRAM", program);
    } else {
        eprintln!("the program is not built: what it says is compared with nothing");
    }
    let done = pytest.output()?;
    let said = String::from_utf8_lossy(&done.stdout);
    println!("{said}");
    assert!(done.status.success(), "{said}\n{}", String::from_utf8_lossy(&done.stderr));
    Ok(())
}
