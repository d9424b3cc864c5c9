//! Pictures around a sphere: their mip maps, and where they are looked at.

use std::f64::consts::{PI, TAU};
use std::io::Cursor;

use image::{DynamicImage, GrayImage, ImageFormat, Luma};
use kerrscope::texture::{Sphere, Texture};
use proptest::prelude::*;

fn sphere(image: impl Into<DynamicImage>) -> Sphere {
    let mut file = Vec::new();
    image.into().write_to(&mut Cursor::new(&mut file), ImageFormat::Png).unwrap();
    Sphere::new(Texture::decode(&file).unwrap())
}

/// Light and opacity at the centre of a pixel.
fn pixel(texture: &Texture, x: u32, y: u32) -> [f64; 4] {
    let [u, v] = [(x, texture.width()), (y, texture.height())]
        .map(|(at, size)| (f64::from(at) + 0.5) / f64::from(size));
    let sheet = texture.sample(u, v, false);
    let [r, g, b] = sheet.light.rgb;
    [r, g, b, sheet.opacity]
}

/// The mean over the sphere.
fn mean(texture: &Texture) -> [f64; 4] {
    let [width, height] = [texture.width(), texture.height()];
    let mut sum = [0.0; 4];
    for y in 0..height {
        // The solid angle of a row, as a share of the sphere.
        let [upper, lower] = [y, y + 1].map(|y| (PI * f64::from(y) / f64::from(height)).cos());
        for x in 0..width {
            let light = pixel(texture, x, y);
            sum = std::array::from_fn(|k| sum[k] + light[k] * 0.5 * (upper - lower) / f64::from(width));
        }
    }
    sum
}

/// Pictures with 1 to 4 channels, of 16 × 8 pixels.
fn pictures() -> [DynamicImage; 4] {
    let rgba = image::RgbaImage::from_fn(16, 8, |x, y| {
        image::Rgba([16 * x as u8, 32 * y as u8, 200 - 8 * x as u8, 255 - 30 * (x as u8 % 4)])
    });
    let rgba = DynamicImage::ImageRgba8(rgba);
    [rgba.to_luma8().into(), rgba.to_luma_alpha8().into(), rgba.to_rgb8().into(), rgba.to_rgba16().into()]
}

#[test]
fn every_level_shines_as_much_as_the_picture() {
    for picture in pictures() {
        let sphere = sphere(picture.clone());
        let sizes: Vec<[u32; 2]> = sphere.levels().iter().map(|t| [t.width(), t.height()]).collect();
        assert_eq!(sizes, [[16, 8], [8, 4], [4, 2], [2, 1], [1, 1]]);
        let whole = mean(&sphere.levels()[0]);
        for level in sphere.levels() {
            let found = mean(level);
            // 11 bits, rounded at each level.
            let differ = (0..4).any(|k| (found[k] / whole[k] - 1.0).abs() > 1e-3);
            assert!(!differ, "{:?} {level:?} {found:?} {whole:?}", picture.color());
        }
    }
}

#[test]
fn sizes_that_are_no_powers_of_two() {
    // 5 × 3: the columns of the next level are two and a half pixels wide, its row is the sphere.
    let image = GrayImage::from_fn(5, 3, |x, _| Luma([if x == 1 || x > 2 { 255 } else { 0 }]));
    let sphere = sphere(image);
    let sizes: Vec<[u32; 2]> = sphere.levels().iter().map(|t| [t.width(), t.height()]).collect();
    assert_eq!(sizes, [[5, 3], [2, 1], [1, 1]]);
    let found = [0, 1].map(|x| pixel(&sphere.levels()[1], x, 0)[0]);
    assert!((found[0] - 0.4).abs() < 2e-4 && (found[1] - 0.8).abs() < 4e-4, "{found:?}");

    // The middle one of three rows covers half of the sphere: its latitudes end at ±30°.
    let image = GrayImage::from_fn(1, 3, |_, y| Luma([if y == 1 { 255 } else { 0 }]));
    let found = pixel(&self::sphere(image).levels()[1], 0, 0)[0];
    assert!((found - 0.5).abs() < 3e-4, "{found}");
}

#[test]
fn between_two_levels_the_light_is_interpolated() {
    // Single white pixels among black ones: 1 or 0, then 1/4 in the next level.
    let image = GrayImage::from_fn(32, 16, |x, y| Luma([if x % 2 == 1 && y % 2 == 1 { 255 } else { 0 }]));
    let sphere = sphere(image);
    // Rows 7 and 8 meet at the equator; white is row 7.
    let (u, v) = (17.5 / 32.0, 7.5 / 16.0);
    let pixel = TAU / 32.0;
    let at = |angle: f64| sphere.sample(u, v, angle).light.rgb[0];
    for angle in [0.0, -1.0, f64::NAN, 1e-300, 0.5 * pixel, pixel] {
        assert_eq!(at(angle), 1.0, "{angle}");
    }
    // One in four, but for what rows near the equator differ in size.
    let coarse = at(2.0 * pixel);
    assert!((coarse - 0.25).abs() < 0.01, "{coarse}");
    for share in [0.1, 0.5, 0.9] {
        let expected = 1.0 + share * (coarse - 1.0);
        assert!((at(pixel * share.exp2()) - expected).abs() < 1e-12, "{share}");
    }
    // From the level of one pixel on there is one light.
    for angle in [32.0 * pixel, 100.0, f64::INFINITY] {
        assert!((at(angle) - 0.25).abs() < 2e-3, "{angle} {}", at(angle));
    }
}

#[test]
fn the_finer_of_the_two_directions_of_a_picture_counts() {
    // Rows of a 64th of the half circle, columns of an 8th of the circle: four times as large.
    let image = GrayImage::from_fn(8, 64, |_, y| Luma([(y % 2 * 255) as u8]));
    let sphere = sphere(image);
    let row = PI / 64.0;
    let at = |y: f64, angle: f64| sphere.sample(0.3, y / 64.0, angle).light.rgb[0];
    assert_eq!([at(31.5, row), at(32.5, row)], [1.0, 0.0]);
    assert!([31.5, 32.5].iter().all(|&y| (at(y, 2.0 * row) - 0.5).abs() < 1e-2));
}

#[test]
fn over_a_pole_it_goes_on_half_a_turn_further() {
    // A 3-pixel row: half a turn is no whole number of pixels.
    let rows = vec![255, 0, 0, 0, 0, 255];
    let sphere = sphere(GrayImage::from_raw(3, 2, rows).unwrap());
    for u in [0.0, 0.13, 0.5, 0.77] {
        for v in [0.0, 1.0] {
            let [here, there] = [u, u + 0.5].map(|u| sphere.sample(u, v, 0.0).light.rgb[0]);
            assert!((here - there).abs() < 1e-6, "{u} {v}");
        }
    }
}

proptest! {
    #[test]
    fn samples_are_finite_anywhere(
        u in prop::num::f64::ANY, v in prop::num::f64::ANY, angle in prop::num::f64::ANY
    ) {
        let codes = vec![1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12];
        let sphere = sphere(image::GrayAlphaImage::from_raw(3, 2, codes).unwrap());
        let sheet = sphere.sample(u, v, angle);
        prop_assert!(sheet.light.rgb.iter().all(|c| (0.0..=1.0).contains(c)));
        prop_assert!((0.0..=1.0).contains(&sheet.opacity));
    }
}
