//! Files that cannot be written or read, and why.

use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// A file that could not be written or read: which, why, and what to do.
#[derive(Debug, thiserror::Error)]
#[error("cannot {action} {}: {fault}; {mend}", path.display())]
pub struct FileError {
    /// The file.
    pub path: PathBuf,
    /// What could not be done to it: `write` or `read`.
    pub action: &'static str,
    /// What is wrong.
    pub fault: String,
    /// What to do about it.
    pub mend: &'static str,
    /// What the system says of it; none if the system has nothing against it, but the file is not what it should be.
    pub kind: Option<ErrorKind>,
}

impl FileError {
    pub(crate) fn new(
        action: &'static str,
        path: &Path,
        fault: impl Into<String>,
        mend: &'static str,
    ) -> Self {
        Self { path: path.to_path_buf(), action, fault: fault.into(), mend, kind: None }
    }

    /// A file that could not be written.
    pub(crate) fn write(path: &Path, error: &io::Error) -> Self {
        let (fault, mend) = match error.kind() {
            ErrorKind::PermissionDenied => {
                ("no permission to write there".to_owned(), "choose another folder or change its permissions")
            }
            ErrorKind::ReadOnlyFilesystem => {
                ("the disk can only be read".to_owned(), "choose a folder on another disk")
            }
            ErrorKind::StorageFull => ("the disk is full".to_owned(), "make room or choose another disk"),
            ErrorKind::QuotaExceeded => {
                ("the disk quota is used up".to_owned(), "make room or choose another disk")
            }
            ErrorKind::FileTooLarge => (
                "the file is larger than the file system or a limit of this session allows".to_owned(),
                "choose another disk or a smaller picture",
            ),
            ErrorKind::InvalidFilename => {
                ("the name is too long or not allowed".to_owned(), "choose another name")
            }
            ErrorKind::NotFound => {
                ("the folder does not exist".to_owned(), "create it or choose another one")
            }
            ErrorKind::NotADirectory => ("a part of the path is not a folder".to_owned(), "check the path"),
            _ => (error.to_string(), "check the disk or choose another place"),
        };
        Self { kind: Some(error.kind()), ..Self::new("write", path, fault, mend) }
    }

    /// A file that could not be read.
    pub(crate) fn read(path: &Path, error: &io::Error) -> Self {
        let (fault, mend) = match error.kind() {
            ErrorKind::NotFound => ("there is no such file".to_owned(), "check the path"),
            ErrorKind::PermissionDenied => ("no permission to read it".to_owned(), "change its permissions"),
            ErrorKind::IsADirectory => ("it is a folder".to_owned(), "give a file in it"),
            _ => (error.to_string(), "check the file and the disk that it is on"),
        };
        Self { kind: Some(error.kind()), ..Self::new("read", path, fault, mend) }
    }
}
