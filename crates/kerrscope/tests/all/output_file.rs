//! Writing a file whole or not at all.

use std::fs;
use std::io;
use std::path::Path;

use kerrscope::output::file::write_atomically;

/// Names in a folder.
fn listing(folder: &Path) -> Vec<String> {
    fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn a_failure_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    fs::write(&path, "old").unwrap();
    let error = write_atomically(&path, |file| {
        file.write_all(&vec![7; 1 << 20])?;
        Err(io::Error::from(io::ErrorKind::StorageFull))
    })
    .unwrap_err();
    assert!(error.to_string().contains("a.txt: the disk is full; make room"), "{error}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(listing(folder.path()), ["a.txt"]);

    let panicked = std::panic::catch_unwind(|| {
        let _ = write_atomically(&path, |_| panic!("on purpose"));
    });
    assert!(panicked.is_err());
    assert_eq!(listing(folder.path()), ["a.txt"]);
}

#[test]
fn the_target_is_whole_before_it_has_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    write_atomically(&path, |file| {
        file.write_all(b"half")?;
        file.flush()?;
        assert!(!path.exists());
        file.write_all(b" whole")
    })
    .unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "half whole");
    assert_eq!(listing(folder.path()), ["a.txt"]);
}

#[test]
fn what_cannot_be_written_says_why_and_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let in_folder = |name: &str| folder.path().join(name);
    fs::write(in_folder("file"), "").unwrap();
    let long = "n".repeat(300);
    for (name, fault, mend) in [
        ("none/a.png", "the folder does not exist", "create it"),
        ("", "it is a folder", "give a file name"),
        ("new/", "it is a folder", "give a file name"),
        ("..", "it is a folder", "give a file name"),
        ("file/a.png", "not a folder", "check the path"),
        (long.as_str(), "too long", "another name"),
    ] {
        let path = in_folder(name);
        let message = write_atomically(&path, |_| Ok(())).unwrap_err().to_string();
        assert!(message.contains(path.to_str().unwrap()), "{message}");
        assert!(message.contains(fault) && message.contains(mend), "{name}: {message}");
    }
    assert!(write_atomically(Path::new(""), |_| Ok(())).is_err());
    assert_eq!(listing(folder.path()), ["file"]);
}

#[test]
fn a_name_as_long_as_allowed_can_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("é".repeat(127));
    write_atomically(&path, |_| Ok(())).unwrap();
    assert!(path.exists());
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn permissions_are_those_of_any_new_file_or_of_the_old_one() {
        let folder = tempfile::tempdir().unwrap();
        let (ours, usual) = (folder.path().join("ours"), folder.path().join("usual"));
        write_atomically(&ours, |_| Ok(())).unwrap();
        fs::write(&usual, "").unwrap();
        assert_eq!(mode(&ours), mode(&usual));

        fs::set_permissions(&ours, fs::Permissions::from_mode(0o640)).unwrap();
        write_atomically(&ours, |_| Ok(())).unwrap();
        assert_eq!(mode(&ours), 0o640);
    }

    #[test]
    fn a_protected_file_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "keep").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).unwrap();
        let error = write_atomically(&path, |_| Ok(())).unwrap_err();
        assert!(error.to_string().contains("write-protected"), "{error}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "keep");
    }

    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (link, file) = (folder.path().join("link"), folder.path().join("file"));
        fs::write(&file, "old").unwrap();
        symlink("file", &link).unwrap();
        write_atomically(&link, |to| to.write_all(b"new")).unwrap();
        assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }

    #[test]
    fn a_pipe_is_written_to_and_stays_a_pipe() {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read_to_string(pipe).unwrap()
        });
        write_atomically(&pipe, |to| to.write_all(b"through")).unwrap();
        assert_eq!(reader.join().unwrap(), "through");
        assert_eq!(listing(folder.path()), ["pipe"]);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_named() {
        let error = write_atomically(Path::new("/dev/full"), |to| to.write_all(b"a")).unwrap_err();
        assert!(error.to_string().contains("/dev/full: the disk is full"), "{error}");
    }
}
