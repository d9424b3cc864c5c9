//! What is wrong, as Python's exceptions with the program's own text.

use std::fmt::Display;
use std::io::{self, ErrorKind};
use std::path::Path;

use kerrscope::measure::{PictureError, PictureFault};
use kerrscope::output::{FileError, SavedError};
use kerrscope::render::StageError;
use kerrscope::scene::{Fault, Faults};
use kerrscope::texture::{TextureError, TextureFault};
use pyo3::PyErr;
use pyo3::exceptions::{
    PyFileNotFoundError, PyIsADirectoryError, PyNotADirectoryError, PyOSError, PyPermissionError,
    PyValueError,
};

/// Wrong input.
pub fn wrong(what: impl Display) -> PyErr {
    PyValueError::new_err(what.to_string())
}

/// What the system has against a file; none: the file is not what it should be.
fn system(kind: Option<ErrorKind>, text: String) -> PyErr {
    match kind {
        None => PyValueError::new_err(text),
        Some(ErrorKind::NotFound) => PyFileNotFoundError::new_err(text),
        Some(ErrorKind::PermissionDenied) => PyPermissionError::new_err(text),
        Some(ErrorKind::IsADirectory) => PyIsADirectoryError::new_err(text),
        Some(ErrorKind::NotADirectory) => PyNotADirectoryError::new_err(text),
        Some(_) => PyOSError::new_err(text),
    }
}

/// A file that cannot be written or read.
pub fn file(error: &FileError) -> PyErr {
    system(error.kind, error.to_string())
}

/// Everything that is wrong with a scene. Changes are called as they were given, not after a flag of the program.
pub fn scene(faults: &Faults) -> PyErr {
    let told = |fault: &Fault| {
        if fault.source.name.starts_with("--set ") {
            let help = fault.help.replace('\n', "\n        ");
            format!("{}: {}\n  help: {help}", fault.source.text, fault.message)
        } else {
            fault.to_string()
        }
    };
    let mut lines: Vec<String> = faults.iter().map(told).collect();
    if faults.omitted() > 0 {
        lines.push(format!("and {} more faults", faults.omitted()));
    }
    wrong(lines.join("\n"))
}

/// A file without a scene or a film.
pub fn saved(error: &SavedError) -> PyErr {
    match error {
        SavedError::File(error) => file(error),
        SavedError::Scene(faults) => scene(faults),
    }
}

fn of_texture(fault: &TextureFault) -> Option<ErrorKind> {
    match fault {
        TextureFault::Io(error) => Some(error.kind()),
        _ => None,
    }
}

/// A scene that cannot be made ready.
pub fn stage(error: &StageError) -> PyErr {
    match error {
        StageError::Texture(TextureError { fault, .. }) => system(of_texture(fault), error.to_string()),
        StageError::Observer(_) => wrong(error),
    }
}

/// A picture that cannot be measured.
pub fn picture(error: &PictureError) -> PyErr {
    match &error.fault {
        PictureFault::File(fault) => system(of_texture(fault), error.to_string()),
        _ => wrong(error),
    }
}

/// A scene file that the system does not let be read.
pub fn unreadable(path: &Path, error: &io::Error) -> PyErr {
    let (fault, mend) = match error.kind() {
        ErrorKind::NotFound => ("there is no such file".to_owned(), "check the path"),
        ErrorKind::IsADirectory => ("this is a folder".to_owned(), "give the scene file within it"),
        _ => (format!("it cannot be read: {error}"), "check the path and its permissions"),
    };
    system(Some(error.kind()), format!("{}: {fault}\n  help: {mend}", path.display()))
}
