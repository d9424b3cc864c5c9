//! Checkpoints: what is kept, what is refused and why.

use std::fs;
use std::path::{Path, PathBuf};

use kerrscope::checkpoint::{Checkpoint, CheckpointError, Identity};
use kerrscope::scene::Scene;
use kerrscope::spacetime::Level;

fn identity(work: u8) -> Identity {
    Identity { program: "1.2.3".into(), instruction_level: "baseline".into(), work: [work; 32] }
}

/// A checkpoint with parts 0 to 9 in a new folder.
fn ten() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    let checkpoint = Checkpoint::start(&path, &identity(1)).unwrap();
    for number in 0..10 {
        checkpoint.keep(number, &contents(number)).unwrap();
    }
    checkpoint.flush().unwrap();
    (folder, path)
}

fn contents(number: u64) -> Vec<u8> {
    vec![number as u8; 100 * number as usize]
}

fn parts(checkpoint: &Checkpoint) -> Vec<u64> {
    let mut numbers = Vec::new();
    checkpoint
        .parts(|number, bytes| {
            assert_eq!(bytes, contents(number));
            numbers.push(number);
        })
        .unwrap();
    numbers
}

fn refusal(path: &Path, identity: &Identity) -> String {
    Checkpoint::resume(path, identity).unwrap_err().to_string()
}

#[test]
fn parts_come_back_and_more_can_be_kept() {
    let (_folder, path) = ten();
    let again = Checkpoint::resume(&path, &identity(1)).unwrap();
    assert_eq!(parts(&again), (0..10).collect::<Vec<_>>());
    again.keep(10, &contents(10)).unwrap();
    again.flush().unwrap();
    drop(again);
    let third = Checkpoint::resume(&path, &identity(1)).unwrap();
    assert_eq!(parts(&third), (0..11).collect::<Vec<_>>());
    third.remove().unwrap();
    assert!(!path.exists());
}

#[test]
fn cut_off_anywhere_it_keeps_the_parts_before() {
    let (_folder, path) = ten();
    let whole = fs::read(&path).unwrap();
    let mut last = 0;
    for length in (0..whole.len()).step_by(7) {
        fs::write(&path, &whole[..length]).unwrap();
        match Checkpoint::resume(&path, &identity(1)) {
            Ok(checkpoint) => {
                let found = parts(&checkpoint);
                assert!(found.iter().copied().eq(0..found.len() as u64) && found.len() >= last);
                last = found.len();
                // What is kept next is not spoilt by the torn rest.
                checkpoint.keep(77, &contents(77)).unwrap();
                checkpoint.flush().unwrap();
                drop(checkpoint);
                let numbers = parts(&Checkpoint::resume(&path, &identity(1)).unwrap());
                assert_eq!(numbers.last(), Some(&77));
                assert_eq!(numbers.len(), last + 1);
            }
            Err(error) => assert!(last == 0 && length < 100, "{length}: {error}"),
        }
    }
    assert_eq!(last, 9);
}

#[test]
fn a_damaged_part_ends_what_is_trusted() {
    let (_folder, path) = ten();
    let mut bytes = fs::read(&path).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&path, bytes).unwrap();
    let found = parts(&Checkpoint::resume(&path, &identity(1)).unwrap());
    assert!(!found.is_empty() && found.len() < 10, "{found:?}");
}

#[test]
fn foreign_checkpoints_are_refused_with_the_reason() {
    let (_folder, path) = ten();
    assert!(refusal(&path, &identity(2)).contains("another scene"));
    let other = Identity { program: "1.2.4".into(), ..identity(1) };
    assert!(refusal(&path, &other).contains("made by kerrscope 1.2.3, and this is 1.2.4"));
    let other = Identity { instruction_level: "avx2".into(), ..identity(1) };
    assert!(refusal(&path, &other).contains("baseline"));
    let mut bytes = fs::read(&path).unwrap();
    bytes[8] = 9;
    fs::write(&path, &bytes).unwrap();
    let message = refusal(&path, &identity(1));
    assert!(message.contains("version 9") && message.contains("a.checkpoint"), "{message}");
    fs::write(&path, "# notes of mine").unwrap();
    assert!(refusal(&path, &identity(1)).contains("no checkpoint"));
    assert_eq!(fs::read(&path).unwrap(), b"# notes of mine", "a refused file is left alone");
}

#[test]
fn one_process_at_a_time() {
    let (_folder, path) = ten();
    let first = Checkpoint::resume(&path, &identity(1)).unwrap();
    let in_use = |result| matches!(result, Err(CheckpointError::InUse(_)));
    assert!(in_use(Checkpoint::resume(&path, &identity(1))));
    assert!(in_use(Checkpoint::start(&path, &identity(1))));
    drop(first);
    assert!(Checkpoint::resume(&path, &identity(1)).is_ok());
}

#[test]
fn starting_afresh_replaces_the_file_when_there_is_something_to_keep() {
    let (_folder, path) = ten();
    let before = fs::read(&path).unwrap();
    let afresh = Checkpoint::start(&path, &identity(1)).unwrap();
    assert!(parts(&afresh).is_empty());
    assert_eq!(fs::read(&path).unwrap(), before);
    afresh.keep(3, &contents(3)).unwrap();
    afresh.flush().unwrap();
    drop(afresh);
    assert_eq!(parts(&Checkpoint::resume(&path, &identity(1)).unwrap()), [3]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_that_names_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.checkpoint");
    std::os::unix::fs::symlink("/dev/full", &path).unwrap();
    let checkpoint = Checkpoint::start(&path, &identity(1)).unwrap();
    checkpoint.keep(1, &[0; 9]).unwrap();
    let message = checkpoint.flush().unwrap_err().to_string();
    assert!(message.contains("a.checkpoint") && message.contains("full"), "{message}");
}

#[test]
fn the_identity_of_a_render_is_all_that_it_depends_on() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("sky.png");
    let of = |text: &str| {
        let scene = Scene::from_toml(text, folder.path()).unwrap();
        Identity::of_render(&scene, Level::Baseline).unwrap()
    };
    assert_eq!(of(""), of("[spacetime]\nname = 'kerr'"));
    assert_ne!(of(""), of("spacetime.spin = 0.98"));
    assert_ne!(of(""), of("render.seed = 2"));
    let mut seen = Vec::new();
    for level in [0, 255] {
        image::save_buffer(&picture, &[level; 2], 2, 1, image::ColorType::L8).unwrap();
        seen.push(of("sky = { kind = 'panorama', image = 'sky.png' }"));
    }
    assert_ne!(seen[0], seen[1], "another picture of the same name");
}
