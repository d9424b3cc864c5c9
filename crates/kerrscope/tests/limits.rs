//! Files made to take memory and time: none below 1 MB takes 2 GB, or keeps one waiting for minutes.
//!
//! How long they take is printed; what is asserted is only that none runs away.
#![cfg(target_os = "linux")]

mod bombs;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use exr::prelude::Compression;
use kerrscope::output::png::read_provenance;
use kerrscope::scene::Scene;
use kerrscope::texture::{Sphere, Texture};

/// The file that [`part`] reads.
const VARIABLE: &str = "KERRSCOPE_TEST_FILE";

/// No file takes longer than this in s, on however busy a machine; a quiet one takes 5 s at most.
const PATIENCE: f64 = 60.0;

/// One file at a time, for the sake of memory.
static TURN: Mutex<()> = Mutex::new(());

/// What it took to read a file.
struct Taken {
    bytes: u64,
    /// From the beginning to the end of reading.
    seconds: f64,
    outcome: String,
}

/// Reads a file in a process of its own, by what its name ends with, and holds it to the limits.
fn read(name: &str, contents: &[u8]) -> Taken {
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    assert!(contents.len() < 1_000_000, "{name} has {} bytes", contents.len());
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, contents).unwrap();
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "part", "--ignored", "--nocapture"])
        .env(VARIABLE, &path)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    let mut taken = told.lines().skip_while(|line| *line != "taken").skip(1);
    let mut next = || taken.next().unwrap_or_else(|| panic!("{name}: {output:?}"));
    let taken = Taken {
        bytes: next().parse().unwrap(),
        seconds: next().parse().unwrap(),
        outcome: next().to_owned(),
    };
    let Taken { bytes, seconds, outcome } = &taken;
    println!("{name}: {} MB, {seconds} s: {outcome}", bytes / 1_000_000);
    assert!(*bytes < 2_000_000_000 && *seconds < PATIENCE, "{name}: {bytes} bytes, {seconds} s");
    taken
}

#[test]
#[ignore = "is the part of the other tests that runs in a process of its own"]
fn part() {
    let path = std::env::var_os(VARIABLE).expect("the other tests name a file");
    let path = Path::new(&path);
    let start = Instant::now();
    let outcome = match path.extension().and_then(|ending| ending.to_str()) {
        Some("toml") => {
            Scene::load(Some(path), &[]).map(|_| "a scene".to_owned()).map_err(|e| e[0].to_string())
        }
        Some("record") => read_provenance(path).map(|made| made.to_string()).map_err(|e| e.to_string()),
        _ => Texture::load(path)
            .map(Sphere::new)
            .map(|sphere| format!("{}×{}", sphere.levels()[0].width(), sphere.levels()[0].height()))
            .map_err(|e| e.fault.to_string()),
    };
    let outcome = outcome.unwrap_or_else(|fault| fault);
    let seconds = start.elapsed().as_secs_f64();
    // proc(5): the most memory that was resident, in units of 1024 bytes.
    let status = fs::read_to_string("/proc/self/status").unwrap();
    let memory = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    let memory: u64 = memory.trim().trim_end_matches(" kB").parse().unwrap();
    println!("\ntaken\n{}\n{}\n{}", memory * 1024, seconds, outcome.replace('\n', " "));
}

#[test]
fn the_largest_pictures_are_read() {
    let deep = bombs::zeros(8192 * 8192 * 12);
    let float: &[(u16, &[u32])] = &[(258, &[32]), (278, &[8192]), (339, &[3, 3, 3])];
    for (name, file, size) in [
        ("turned.png", bombs::png(16384, 8192), "8192×16384"),
        ("scans.jpg", bombs::jpeg(16384, 8192, 32), "8192×16384"),
        ("animated.webp", bombs::webp_animated(16383, 8192), "16383×8192"),
        ("float.tiff", bombs::tiff(8192, 8192, 1, float, &deep), "8192×8192"),
        ("runs.hdr", bombs::hdr(8192, 8192), "8192×8192"),
        ("blocks.exr", bombs::exr(16384, 256, 32, Compression::DWAB(None)), "8192×4096"),
    ] {
        assert_eq!(read(name, &file).outcome, size, "{name}");
    }
}

#[test]
fn what_would_take_more_is_refused_at_once() {
    let small = bombs::zeros(1 << 20);
    let jpeg = bombs::jpeg(16384, 16384, 1);
    let wide: &[(u16, &[u32])] = &[(322, &[16384]), (323, &[16])];
    let samples: &[(u16, &[u32])] = &[(258, &[8]), (277, &[2000]), (278, &[8192]), (338, &[0; 1997])];
    let compressed: &[(u16, &[u32])] = &[(259, &[7]), (322, &[16]), (323, &[16])];
    for (name, file, fault) in [
        ("edges.png", bombs::png(65537, 8), "65537×8 pixels"),
        ("pixels.jpg", bombs::jpeg(16384, 8200, 1), "16384×8200 pixels"),
        ("scans.jpg", bombs::jpeg(16384, 8192, 33), "in 33 scans"),
        ("pixels.webp", bombs::webp(16383, 8200), "16383×8200 pixels"),
        ("exif.webp", bombs::webp_exif(u32::MAX - 1), "ends before the picture"),
        ("bytes.tiff", bombs::tiff(16384, 8192, 1, &[(258, &[32]), (278, &[8192])], &small), "of 1536 MiB"),
        ("tiles.tiff", bombs::tiff(1, 65536, 4096, wide, &small), "tiles that cover 16384×65536"),
        ("samples.tiff", bombs::tiff(640, 8192, 1, samples, &small), "pixels of 10000 MiB"),
        ("jpeg.tiff", bombs::tiff(16, 1600, 100, compressed, &jpeg), "JPEG within TIFF"),
        ("pixels.hdr", bombs::hdr(16385, 8192), "16385×8192 pixels"),
        ("pixels.exr", bombs::exr_header([65536, 65536], [64, 64]), "65536×65536 pixels"),
        ("tile.exr", bombs::exr_header([4, 4], [1 << 29, 1 << 29]), "in blocks of"),
        ("layers.exr", bombs::exr_layers(), "in blocks of 8 MiB"),
        ("text.record", bombs::png_text(900_000_000), "text"),
    ] {
        let taken = read(name, &file);
        assert!(taken.outcome.contains(fault), "{name}: {}", taken.outcome);
        assert!(taken.bytes < 100_000_000, "{name}: {} bytes", taken.bytes);
    }
}

#[test]
fn scenes_of_a_million_things() {
    let lines: Vec<String> = (0..90_000).map(|i| format!("k{i}=1\n")).collect();
    for (name, text, fault) in [
        ("faults.toml", "=\n".repeat(499_999), "a key is missing here"),
        ("keys.toml", lines.concat(), "`k0` is not in a section"),
        ("list.toml", format!("screen.look_at=[{}]", "{a.a.a=1},".repeat(90_000)), "has 90000 values"),
        ("digits.toml", format!("spacetime.spin=0.{}", "1".repeat(900_000)), "a scene"),
        ("text.toml", format!("disk.model=\"{}\"", "ring".repeat(200_000)), "cannot be"),
    ] {
        let taken = read(name, text.as_bytes());
        assert!(taken.outcome.contains(fault), "{name}: {}", taken.outcome);
    }
}
