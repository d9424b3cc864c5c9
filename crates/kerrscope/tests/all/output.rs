//! PNG files and how they were made.

use std::fs;
use std::time::Instant;

use kerrscope::display::{Depth, Picture};
use kerrscope::output::png::{self, read_provenance};
use kerrscope::output::{Provenance, ProvenanceFault};
use kerrscope::render::Interpolation;
use proptest::prelude::*;

fn provenance() -> Provenance {
    Provenance {
        version: "1.2.3".into(),
        scene_toml: "# ünïcode 黒い穴 🕳\n[spacetime]\nspin = 0.99\n#\nx = 'y'\n".into(),
        seed: u64::MAX,
        instruction_level: "avx512".into(),
        interpolation: Some(Interpolation { samples: 1 << 40, compared: 9_990, missed: 3, worst: 8.1e-5 }),
    }
}

/// A picture with a ramp in each channel.
fn ramp(width: u32, height: u32) -> Picture {
    let last = (width * height - 1) as f32;
    let pixels = (0..width * height).map(|i| i as f32 / last).map(|x| [x, 1.0 - x, x * x]).collect();
    Picture { width, height, pixels }
}

fn encode(picture: &Picture, depth: Depth) -> Vec<u8> {
    let mut file = Vec::new();
    png::encode(&mut file, picture, depth, &provenance()).unwrap();
    file
}

// PNG

#[test]
fn pixels_are_the_nearest_steps_of_their_display_values() {
    let picture = ramp(16, 9);
    for depth in [Depth::Eight, Depth::Sixteen] {
        let steps = match depth {
            Depth::Eight => 255.0,
            Depth::Sixteen => 65535.0,
        };
        let image = image::load_from_memory(&encode(&picture, depth)).unwrap();
        assert_eq!(image.color().bits_per_pixel(), if steps > 255.0 { 48 } else { 24 });
        // Codes of 8 bits are widened to 257 times as much, which is exact.
        for (pixel, values) in image.to_rgb16().pixels().zip(&picture.pixels) {
            for (code, &value) in pixel.0.into_iter().zip(values) {
                let error = f64::from(code) / 65535.0 - f64::from(value);
                // Half a step, and what the product of 32 bits rounds.
                assert!(error.abs() <= 0.5 / steps + 6e-8, "{values:?} {error}");
            }
        }
    }
}

#[test]
fn rows_go_from_the_top() {
    let pixels = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0; 3], [0.0; 3], [1.0, 1.0, 0.0]];
    let picture = Picture { width: 2, height: 3, pixels };
    let image = image::load_from_memory(&encode(&picture, Depth::Eight)).unwrap();
    assert_eq!(image.to_rgb8().get_pixel(1, 0).0, [0, 255, 0]);
    assert_eq!(image.to_rgb8().get_pixel(0, 2).0, [0, 0, 0]);
}

#[test]
fn the_chunks_are_those_that_the_format_wants() {
    let file = encode(&ramp(16, 9), Depth::Eight);
    let (mut at, mut chunks) = (8, Vec::new());
    while at < file.len() {
        let length = u32::from_be_bytes(file[at..at + 4].try_into().unwrap()) as usize;
        chunks.push(String::from_utf8(file[at + 4..at + 8].to_vec()).unwrap());
        at += length + 12;
    }
    chunks.dedup();
    assert_eq!(chunks, ["IHDR", "sRGB", "iTXt", "IDAT", "IEND"]);
    let has = |text: &[u8]| file.windows(text.len()).any(|w| w == text);
    assert!(has(b"Software\0\0\0\0\0kerrscope 1.2.3"));
    assert!(has("黒い穴".as_bytes()));
}

#[test]
fn the_same_picture_is_the_same_bytes_for_any_number_of_threads() {
    let picture = ramp(300, 200);
    let bytes = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| encode(&picture, Depth::Eight))
    };
    assert_eq!(bytes(1), bytes(5));
}

#[test]
fn how_a_picture_was_made_can_be_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    png::write(&path, &ramp(2, 1), Depth::Eight, &provenance()).unwrap();
    assert_eq!(read_provenance(&path).unwrap(), provenance());
}

#[test]
fn a_zero_byte_in_a_scene_does_not_lose_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let made = Provenance { scene_toml: "a\0b".into(), ..provenance() };
    png::write(&path, &ramp(2, 1), Depth::Eight, &made).unwrap();
    assert_eq!(read_provenance(&path).unwrap().scene_toml, "a\u{FFFD}b");
}

#[test]
fn a_file_without_a_record_is_an_error_that_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.png");
    let message = || {
        let message = read_provenance(&path).unwrap_err().to_string();
        assert!(message.contains("other.png"), "{message}");
        message
    };
    assert!(message().contains("no such file"));
    image::GrayImage::new(2, 2).save(&path).unwrap();
    assert!(message().contains("does not say how"));
    fs::write(&path, b"hello").unwrap();
    assert!(message().contains("PNG"));
    fs::write(&path, b"").unwrap();
    message();
    let whole = encode(&ramp(2, 1), Depth::Eight);
    fs::write(&path, &whole[..60]).unwrap();
    message();
}

#[test]
fn a_full_hd_picture_is_written_in_a_fraction_of_a_second() {
    let picture = ramp(1920, 1080);
    let start = Instant::now();
    encode(&picture, Depth::Eight);
    // 0.1 s on an idle machine; the bound only notices a wrong choice of method.
    assert!(start.elapsed().as_secs_f64() < 2.0, "{:?}", start.elapsed());
}

// Provenance

proptest! {
    #[test]
    fn any_text_survives_as_provenance(
        version in any::<String>(), scene_toml in any::<String>(),
        seed in any::<u64>(), instruction_level in any::<String>(),
        counts in proptest::option::of(any::<(u64, u64, u64)>()), worst in 0.0..1e300_f64
    ) {
        let interpolation =
            counts.map(|(samples, compared, missed)| Interpolation { samples, compared, missed, worst });
        let made = Provenance { version, scene_toml, seed, instruction_level, interpolation };
        prop_assert_eq!(made.to_string().parse::<Provenance>(), Ok(made));
    }
}

#[test]
fn the_text_of_a_provenance_is_the_scene_after_a_comment() {
    let text = provenance().to_string();
    let (comment, scene) = text.split_at(text.find("# ünï").unwrap());
    assert!(comment.lines().all(|line| line.starts_with('#')));
    assert_eq!(scene, provenance().scene_toml);
    assert!(text.parse::<toml::Table>().is_ok());
}

#[test]
fn what_is_no_provenance_is_refused_with_its_fault() {
    let text = provenance().to_string();
    let parse = |text: &str| text.parse::<Provenance>().unwrap_err();
    assert_eq!(parse(""), ProvenanceFault::Foreign);
    assert_eq!(parse("[spacetime]"), ProvenanceFault::Foreign);
    assert_eq!(parse(&text[..60]), ProvenanceFault::Truncated);
    assert_eq!(parse(&text.replace("seed", "sead")), ProvenanceFault::Line("seed"));
    assert_eq!(parse(&text.replace(&u64::MAX.to_string(), "-1")), ProvenanceFault::Line("seed"));
    assert_eq!(parse(&text.replace("\"1.2.3\"", "1.2")), ProvenanceFault::Line("version"));
    // Lines that a later version adds are passed over.
    let later = text.replacen("# seed", "# moon = \"full\"\n# seed", 1);
    assert_eq!(later.parse::<Provenance>(), Ok(provenance()));
}
