//! Pictures read from files.

use std::fs;
use std::io::Cursor;

use image::{DynamicImage, ExtendedColorType, ImageFormat};
use kerrscope::display::srgb;
use kerrscope::texture::{Texture, TextureFault};
use proptest::prelude::*;

/// A PNG of the given pixels.
fn png(width: u32, height: u32, color: ExtendedColorType, bytes: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut to = Cursor::new(&mut file);
    image::write_buffer_with_format(&mut to, bytes, width, height, color, ImageFormat::Png).unwrap();
    file
}

fn texture(width: u32, height: u32, color: ExtendedColorType, bytes: &[u8]) -> Texture {
    Texture::decode(&png(width, height, color, bytes)).unwrap()
}

/// A 16×8 picture with all kinds of values, as a JPEG.
fn jpeg(format: fn(image::RgbImage) -> DynamicImage) -> Vec<u8> {
    let image =
        image::RgbImage::from_fn(16, 8, |x, y| image::Rgb([16 * x as u8, 32 * y as u8, 200 - 8 * x as u8]));
    let mut file = Vec::new();
    format(image).write_to(&mut Cursor::new(&mut file), ImageFormat::Jpeg).unwrap();
    file
}

fn close(a: f64, b: f64) -> bool {
    // The tables have 24 bits.
    (a - b).abs() < 1e-7
}

#[test]
fn every_8_bit_code_is_decoded_at_its_pixel_centre() {
    let codes: Vec<u8> = (0..=255).collect();
    let texture = texture(256, 1, ExtendedColorType::L8, &codes);
    for code in 0..=255_u8 {
        let sheet = texture.sample((f64::from(code) + 0.5) / 256.0, 0.5, false);
        let linear = srgb::decode(f64::from(code) / 255.0);
        assert!(sheet.light.rgb.iter().all(|&c| close(c, linear)), "{code}");
        assert_eq!(sheet.opacity, 1.0);
    }
}

#[test]
fn all_kinds_of_png_are_read() {
    use ExtendedColorType::{L8, L16, La8, La16, Rgb8, Rgb16, Rgba8, Rgba16};
    // Codes 51, 102, 204 are 0.2, 0.4, 0.8; alpha 128/255.
    let linear = |x: f64| srgb::decode(x);
    let half = 128.0 / 255.0;
    let wide = |codes: &[u8]| -> Vec<u8> {
        codes.iter().flat_map(|&c| (u16::from(c) * 257).to_ne_bytes()).collect()
    };
    let cases: [(_, _, &[u8], [f64; 3], f64); 4] = [
        (L8, L16, &[51], [0.2, 0.2, 0.2], 1.0),
        (La8, La16, &[51, 128], [0.2, 0.2, 0.2], half),
        (Rgb8, Rgb16, &[51, 102, 204], [0.2, 0.4, 0.8], 1.0),
        (Rgba8, Rgba16, &[51, 102, 204, 128], [0.2, 0.4, 0.8], half),
    ];
    for (narrow_color, wide_color, codes, rgb, alpha) in cases {
        for texture in [texture(1, 1, narrow_color, codes), texture(1, 1, wide_color, &wide(codes))] {
            let sheet = texture.sample(0.5, 0.5, false);
            for (got, x) in sheet.light.rgb.into_iter().zip(rgb) {
                assert!(close(got, linear(x) * alpha), "{narrow_color:?} {got}");
            }
            assert!(close(sheet.opacity, alpha));
        }
    }
}

#[test]
fn sixteen_bits_are_kept() {
    // Two neighbouring dark codes, which 8 bits, and linear 16 bits, would merge.
    let codes: Vec<u8> = [20_u16, 21].iter().flat_map(|c| c.to_ne_bytes()).collect();
    let texture = texture(2, 1, ExtendedColorType::L16, &codes);
    let (a, b) = (texture.sample(0.25, 0.5, false), texture.sample(0.75, 0.5, false));
    let ratio = b.light.rgb[0] / a.light.rgb[0];
    assert!((ratio - 1.05).abs() < 1e-6, "{ratio}");
}

#[test]
fn between_pixels_the_light_is_interpolated() {
    let texture = texture(2, 2, ExtendedColorType::L8, &[0, 255, 255, 0]);
    let at = |u, v| texture.sample(u, v, false).light.rgb[0];
    assert!(close(at(0.5, 0.25), 0.5));
    assert!(close(at(0.5, 0.5), 0.5));
    assert!(close(at(0.375, 0.25), 0.25));
    // Weights (3/4, 1/4) both ways: 3/4·1/4 + 1/4·3/4 of the light.
    assert!(close(at(0.375, 0.375), 0.375));
}

#[test]
fn transparent_pixels_do_not_bleed() {
    // Transparent green beside opaque red: half-way there is half of the red, no green.
    let codes = [0, 255, 0, 0, 255, 0, 0, 255];
    let texture = texture(2, 1, ExtendedColorType::Rgba8, &codes);
    let sheet = texture.sample(0.5, 0.5, false);
    assert_eq!(sheet.light.rgb, [0.5, 0.0, 0.0]);
    assert_eq!(sheet.opacity, 0.5);
}

#[test]
fn edges_go_on_or_join() {
    let texture = texture(4, 1, ExtendedColorType::L8, &[255, 0, 0, 0]);
    let at = |u, wrap| texture.sample(u, 0.5, wrap).light.rgb[0];
    assert_eq!(at(0.0, false), 1.0);
    assert_eq!(at(-3.0, false), 1.0);
    assert_eq!(at(1.0, false), 0.0);
    assert_eq!(at(0.0, true), 0.5);
    assert_eq!(at(1.0, true), 0.5);
    assert!(close(at(0.9375, true), 0.25));
    for u in [-2.0, -1.0, 1.0, 7.0] {
        assert!(close(at(u + 0.07, true), at(0.07, true)), "{u}");
    }
}

#[test]
fn jpeg_is_read() {
    for file in [
        jpeg(DynamicImage::ImageRgb8),
        jpeg(|i| DynamicImage::ImageLuma8(DynamicImage::ImageRgb8(i).to_luma8())),
    ] {
        let texture = Texture::decode(&file).unwrap();
        assert_eq!((texture.width(), texture.height()), (16, 8));
        let sheet = texture.sample(0.5, 0.5, false);
        assert!(sheet.light.rgb[1] > 0.05 && sheet.opacity == 1.0);
    }
}

#[test]
fn the_orientation_noted_by_a_camera_is_applied() {
    // An EXIF block with orientation 6 (turn by 90° clockwise), after the start marker.
    let exif: &[u8] = b"\xFF\xE1\x00\x22Exif\0\0MM\0\x2A\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\
        \0\x06\0\0\0\0\0\0";
    let plain = jpeg(DynamicImage::ImageRgb8);
    let file = [&plain[..2], exif, &plain[2..]].concat();
    let texture = Texture::decode(&file).unwrap();
    assert_eq!((texture.width(), texture.height()), (8, 16));
}

#[test]
fn a_file_that_is_cut_short_is_refused_wherever_it_is_cut() {
    let mut noise = 1_u32;
    let codes: Vec<u8> = (0..24 * 24 * 3)
        .map(|_| {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (noise >> 24) as u8
        })
        .collect();
    let png = png(24, 24, ExtendedColorType::Rgb8, &codes);
    // The last 12 bytes, an empty chunk, say that there is nothing more.
    for (file, needed) in [(jpeg(DynamicImage::ImageRgb8), 0), (png, 12)] {
        assert!(Texture::decode(&file).is_ok());
        for length in 0..file.len() - needed {
            match Texture::decode(&file[..length]) {
                Err(_) => {}
                Ok(_) => panic!("{length} of {} bytes", file.len()),
            }
        }
    }
}

#[test]
fn an_error_names_the_file_what_is_wrong_and_the_mend() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sky picture.png");
    let message = |contents: &[u8]| {
        fs::write(&path, contents).unwrap();
        let message = Texture::load(&path).unwrap_err().to_string();
        assert!(message.contains("sky picture.png"), "{message}");
        message
    };
    let has = |message: String, words: &[&str]| {
        for word in words {
            assert!(message.contains(word), "{message}");
        }
    };
    has(message(b""), &["empty", "again"]);
    has(message(b"hello, this is text"), &["not a PNG, JPEG,", "convert"]);
    has(message(b"GIF89a\x01\0\x01\0\0\0\0;"), &["GIF", "convert"]);
    let whole = png(64, 64, ExtendedColorType::L8, &[7; 4096]);
    has(message(&whole[..whole.len() / 2]), &["ends before", "again"]);
    let mut damaged = whole;
    let middle = damaged.len() / 2;
    damaged[middle] ^= 0x55;
    has(message(&damaged), &["damaged", "again"]);

    let missing = Texture::load(folder.path().join("none.png")).unwrap_err().to_string();
    has(missing, &["none.png", "check the path"]);
    let error = Texture::load(folder.path()).unwrap_err().to_string();
    has(error, &["give a file"]);
}

#[test]
fn a_picture_that_claims_to_be_huge_is_refused_before_memory_is_taken() {
    // Only a header: 60000 × 60000 pixels of RGBA in 16 bits, 29 GB.
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, 60000, 60000);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Sixteen);
    drop(encoder.write_header().unwrap());
    // In place of the end chunk, which the writer adds on being dropped.
    file.truncate(file.len() - 12);
    file.extend_from_slice(b"\0\0\x10\0IDAT");
    let fault = Texture::decode(&file).unwrap_err();
    assert!(matches!(fault, TextureFault::TooLarge { width: 60000, height: 60000, .. }), "{fault}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_without_end_is_refused_at_its_beginning() {
    let error = Texture::load("/dev/zero").unwrap_err();
    assert!(matches!(error.fault, TextureFault::Foreign(None)), "{error}");
}

proptest! {
    #[test]
    fn damage_never_panics(at in 0_usize..600, bits in 1_u8..=255) {
        let codes: Vec<u8> = (0..=255).collect();
        for mut file in [png(16, 16, ExtendedColorType::L8, &codes), jpeg(DynamicImage::ImageRgb8)] {
            let at = at % file.len();
            file[at] ^= bits;
            let _ = Texture::decode(&file);
        }
    }

    #[test]
    fn samples_are_finite_anywhere(u in prop::num::f64::ANY, v in prop::num::f64::ANY) {
        let texture = texture(3, 2, ExtendedColorType::La8, &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]);
        for sheet in [texture.sample(u, v, true), texture.sample(u, v, false)] {
            prop_assert!(sheet.light.rgb.iter().all(|c| (0.0..=1.0).contains(c)));
            prop_assert!((0.0..=1.0).contains(&sheet.opacity));
        }
    }
}
