//! The formats beside PNG and JPEG.

use std::io::Cursor;

use exr::prelude::{Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage};
use image::{DynamicImage, ImageFormat};
use kerrscope::texture::{Texture, TextureFault};

fn written(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut file = Vec::new();
    image.write_to(&mut Cursor::new(&mut file), format).unwrap();
    file
}

fn small() -> DynamicImage {
    image::RgbImage::from_fn(16, 8, |x, y| image::Rgb([16 * x as u8, 32 * y as u8, 200 - 8 * x as u8])).into()
}

/// The light at the centre of a pixel.
fn pixel(texture: &Texture, x: u32, y: u32) -> [f64; 3] {
    let [u, v] = [(x, texture.width()), (y, texture.height())]
        .map(|(at, size)| (f64::from(at) + 0.5) / f64::from(size));
    texture.sample(u, v, false).light.rgb
}

fn exr(size: [usize; 2], light: impl Fn(usize, usize) -> (f32, f32, f32) + Sync) -> Vec<u8> {
    let mut file = Vec::new();
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| light(at.x(), at.y()));
    let layer = Layer::new((size[0], size[1]), LayerAttributes::default(), Encoding::FAST_LOSSLESS, channels);
    Image::from_layer(layer).write().to_buffered(Cursor::new(&mut file)).unwrap();
    file
}

#[test]
fn tiff_and_webp_are_read_like_png() {
    let png = Texture::decode(&written(&small(), ImageFormat::Png)).unwrap();
    for format in [ImageFormat::Tiff, ImageFormat::WebP] {
        assert_eq!(Texture::decode(&written(&small(), format)).unwrap(), png, "{format:?}");
    }
}

#[test]
fn floating_point_numbers_are_linear_light() {
    let values = [0.0_f32, 1e-4, 0.18, 1.0, 37.5, 60000.0];
    let image = image::Rgb32FImage::from_fn(6, 1, |x, _| image::Rgb([values[x as usize], 0.5, 2.0]));
    let tiff = written(&DynamicImage::ImageRgb32F(image.clone()), ImageFormat::Tiff);
    let hdr = written(&DynamicImage::ImageRgb32F(image), ImageFormat::Hdr);
    let exr = exr([6, 1], |x, _| (values[x], 0.5, 2.0));
    // 11 significant bits, and above 6e-5 no fewer; HDR has 8 below the largest component.
    for (file, relative, absolute) in [(tiff, 5e-4, 0.0), (hdr, 1e-2, 1e-2), (exr, 5e-4, 0.0)] {
        let texture = Texture::decode(&file).unwrap();
        for (x, value) in (0..6).zip(values.map(f64::from)) {
            let [r, g, b] = pixel(&texture, x, 0);
            assert!((r - value).abs() <= relative * value + absolute, "{r} {value}");
            if value < 10.0 {
                assert!((g - 0.5).abs() <= 2.0 * absolute && (b - 2.0).abs() <= 2.0 * absolute, "{g} {b}");
            }
        }
    }
}

#[test]
fn what_is_no_light_is_dark_and_what_is_too_bright_is_limited() {
    let values = [f32::NAN, -1.0, f32::INFINITY, f32::NEG_INFINITY, 1e9];
    let texture = Texture::decode(&exr([5, 1], |x, _| (values[x], 0.0, 1.0))).unwrap();
    let found = [0, 1, 2, 3, 4].map(|x| pixel(&texture, x, 0)[0]);
    assert_eq!(found, [0.0, 0.0, 65504.0, 0.0, 65504.0]);
}

#[test]
fn alpha_of_exr_is_in_its_light_already() {
    let mut file = Vec::new();
    let channels = SpecificChannels::rgba(|_: Vec2<usize>| (0.25_f32, 0.5_f32, 0.0_f32, 0.5_f32));
    Image::from_channels((4, 2), channels).write().to_buffered(Cursor::new(&mut file)).unwrap();
    let sheet = Texture::decode(&file).unwrap().sample(0.3, 0.4, false);
    assert_eq!((sheet.light.rgb, sheet.opacity), ([0.25, 0.5, 0.0], 0.5));
}

#[test]
fn a_large_exr_is_made_smaller_while_it_is_read() {
    // 12288 × 6144 in three channels of 16 bits are 432 MiB, above the 256 that are kept.
    let file = exr([12288, 6144], |x, y| if x < 6144 { (1.0, (y % 2) as f32, 0.0) } else { (0.0, 0.0, 4.0) });
    let texture = Texture::decode(&file).unwrap();
    assert_eq!((texture.width(), texture.height()), (6144, 3072));
    assert_eq!(pixel(&texture, 100, 200), [1.0, 0.5, 0.0]);
    assert_eq!(pixel(&texture, 6000, 3000), [0.0, 0.0, 4.0]);
}

#[test]
fn files_cut_short_never_panic_and_are_refused_where_the_format_tells() {
    let light = |x: usize, y: usize| ((x * 7 % 5) as f32, (y * 3 % 7) as f32, 0.3);
    let float = DynamicImage::ImageRgb32F(small().to_rgb32f());
    for (file, needed) in [
        (exr([24, 24], light), 0),
        (written(&small(), ImageFormat::Tiff), 0),
        (written(&small(), ImageFormat::WebP), 1),
        (written(&float, ImageFormat::Hdr), 0),
    ] {
        assert!(Texture::decode(&file).is_ok());
        for length in 0..file.len() - needed {
            assert!(Texture::decode(&file[..length]).is_err(), "{length} of {} bytes", file.len());
        }
        for at in 0..file.len() {
            let mut damaged = file.clone();
            damaged[at] ^= 0x55;
            let _ = Texture::decode(&damaged);
        }
    }
}

#[test]
fn an_exr_without_colours_is_refused_with_the_mend() {
    let mut file = Vec::new();
    let channels = SpecificChannels::build().with_channel("Y").with_pixel_fn(|_: Vec2<usize>| (0.5_f32,));
    Image::from_channels((4, 2), channels).write().to_buffered(Cursor::new(&mut file)).unwrap();
    let fault = Texture::decode(&file).unwrap_err();
    assert!(matches!(fault, TextureFault::Unsupported(_)), "{fault}");
    assert!(fault.to_string().contains("R, G and B") && fault.mend().contains("RGB"), "{fault}");
}
