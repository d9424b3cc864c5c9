//! Writing a file whole or not at all.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use super::FileError;

/// Writes a file so that it is there whole or not at all.
///
/// The contents go to a temporary file beside the target, then to the disk, and only then
/// take the target's name. If anything fails, what was at the target stays as it was and
/// nothing is left over. (A process that is killed on the spot may leave a file
/// `.NAME.*.part` behind, never half a picture under the target's name.)
///
/// A new file gets the permissions that any new file gets; one that replaces another
/// keeps that one's. A link to a file is followed. Where the target is no ordinary file, such as
/// `/dev/stdout` or a pipe, the contents are written to it directly.
///
/// ```
/// use kerrscope::output::file::write_atomically;
/// use std::io::Write;
/// # let folder = tempfile::tempdir()?;
/// let path = folder.path().join("answer.txt");
/// write_atomically(&path, |file| writeln!(file, "42"))?;
/// assert_eq!(std::fs::read_to_string(&path)?, "42\n");
///
/// let error = write_atomically(&folder.path().join("none/answer.txt"), |_| Ok(()));
/// assert!(error.unwrap_err().to_string().contains("the folder does not exist; create it"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When the folder is missing, the target is a folder or protected, the disk is full, or
/// `contents` fails.
pub fn write_atomically(
    path: &Path,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), FileError> {
    let failed = |error: io::Error| FileError::write(path, &error);
    if path.as_os_str().is_empty() {
        return Err(FileError::new("write", path, "the name is empty", "give a file name"));
    }
    let is_folder = || FileError {
        kind: Some(io::ErrorKind::IsADirectory),
        ..FileError::new("write", path, "it is a folder", "give a file name in it")
    };
    // Paths drop a slash at the end, which says that a folder is meant.
    if path.as_os_str().as_encoded_bytes().ends_with(b"/") || path.file_name().is_none() {
        return Err(is_folder());
    }
    // A link is followed, so that the file that it points to is replaced.
    match fs::metadata(path) {
        Ok(old) if old.is_dir() => Err(is_folder()),
        Ok(old) if !old.is_file() => {
            let file = OpenOptions::new().write(true).open(path).map_err(failed)?;
            stream(&file, contents).map_err(failed)
        }
        Ok(old) if old.permissions().readonly() => Err(FileError::new(
            "write",
            path,
            "there is such a file and it is write-protected",
            "choose another name or unprotect it",
        )),
        Ok(old) => {
            let target = fs::canonicalize(path).map_err(failed)?;
            replace(&target, Some(old.permissions()), contents).map_err(failed)
        }
        Err(_) => replace(path, None, contents).map_err(failed),
    }
}

fn stream(file: &File, contents: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut buffer = BufWriter::with_capacity(1 << 18, file);
    contents(&mut buffer)?;
    buffer.flush()
}

fn replace(
    target: &Path,
    permissions: Option<Permissions>,
    contents: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
        _ => PathBuf::from("."),
    };
    // From here on an error or a panic removes the temporary file as it is dropped.
    let temporary = create_beside(target, &folder)?;
    stream(temporary.as_file(), contents)?;
    if let Some(permissions) = permissions {
        temporary.as_file().set_permissions(permissions)?;
    }
    temporary.as_file().sync_all()?;
    temporary.persist(target).map_err(|e| e.error)?;
    // The new name is safe once the folder is on the disk. Not every file system can do
    // that, and the file itself is whole either way.
    #[cfg(unix)]
    if let Ok(folder) = File::open(&folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

fn create_beside(target: &Path, folder: &Path) -> io::Result<NamedTempFile> {
    // Part of the name, so that a long one that is allowed does not become too long.
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let prefix: String = std::iter::once('.').chain(name.chars().take(24)).collect();
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(".part");
    // What File::create asks for; the system takes the process's umask away from it.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}
