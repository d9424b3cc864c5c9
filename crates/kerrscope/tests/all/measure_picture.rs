//! Pictures that are read to be measured: of this program, of others, and what is none.

use std::fs;
use std::path::Path;

use kerrscope::measure::{Picture, PictureFault, PixelScale};
use kerrscope::output::Format;
use kerrscope::render::{Film, Stage, Watch, draw};
use kerrscope::scene::Scene;

const SCENE: &str = "observer = { distance = 1000, inclination = 60 }\n\
    screen = { kind = 'angular', field_of_view = 1.6 }\n\
    units = { mass = 6.5e9, distance = 16.8e6, frequency = 230e9 }\n\
    sky = { kind = 'black' }\n\
    camera = { display = { bits = 16, tone = 'none' } }\n\
    [render]\nwidth = 48\nheight = 30\nsamples = 4";

fn drawn(disk: &str) -> (Scene, Film) {
    let scene = Scene::from_toml(&format!("{disk}\n{SCENE}"), Path::new("")).unwrap();
    let film = draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap();
    (scene, film)
}

/// A FITS file of cards and numbers.
fn fits(cards: &[&str], data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for card in ["SIMPLE  =                    T"].iter().chain(cards).chain(&["END"]) {
        bytes.extend(format!("{card:<80}").bytes());
    }
    bytes.resize(bytes.len().next_multiple_of(2880), b' ');
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(2880), 0);
    bytes
}

fn card(key: &str, value: &str) -> String {
    format!("{key:<8}= {value:>20}")
}

/// What a render is written as, reads back: the same pixel at the same place, with the same number.
#[test]
fn a_render_reads_back() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, film) = drawn("");
    let mean: Vec<f64> =
        film.light.iter().map(|rgb| rgb.iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0).collect();
    let pixel = 1000.0 * 1.6_f64.to_radians() / 30.0;
    // 16 bits of sRGB: half a code is at most 1.2e-5 of white, at the bright end.
    for (name, allowed) in [("a.png", 2e-5), ("a.exr", 1e-7), ("a.fits", 0.0)] {
        let path = folder.path().join(name);
        Format::of(&path).unwrap().write(&path, &scene, &film).unwrap();
        let picture = Picture::open(&path).unwrap();
        assert_eq!((picture.width, picture.height), (48, 30), "{name}");
        for (k, (read, &drawn)) in picture.values.iter().zip(&mean).enumerate() {
            let drawn = if name == "a.png" { drawn.clamp(0.0, 1.0) } else { drawn };
            // In the picture each colour is cut off at white by itself.
            if name == "a.png" && film.light[k].iter().any(|&c| c > 1.0) {
                continue;
            }
            assert!((read - drawn).abs() <= allowed, "{name} {k}: {read} {drawn}");
        }
        assert_eq!(picture.trusted_brightness, name != "a.png");
        assert!(!picture.physical && picture.colour.is_some() && picture.provenance.is_some());
        let PixelScale { microarcseconds, gravitational_radii } = picture.pixel;
        assert!((gravitational_radii.unwrap() / pixel - 1.0).abs() < 1e-12, "{name}");
        assert!((microarcseconds.unwrap() / (pixel * 3.818_993) - 1.0).abs() < 1e-6, "{name}");
    }
}

/// A disk that shines is a flux: in Jy, the same numbers.
#[test]
fn a_flux_reads_back() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, film) = drawn("disk = { model = 'power-law', index = 3, outer = 20 }");
    let path = folder.path().join("flux.fits");
    Format::Fits.write(&path, &scene, &film).unwrap();
    let picture = Picture::open(&path).unwrap();
    assert!(picture.physical && picture.trusted_brightness && picture.colour.is_none());
    let set = kerrscope::output::ImageSet::of(&scene, &film);
    let image = set.images().next().unwrap();
    assert!((0..48 * 30).all(|k| picture.values[k].to_bits() == image.value(k).to_bits()));
}

/// Every kind of number, scaled, with axes of length 1, and the rows from below.
#[test]
fn kinds_of_fits() {
    // Two rows of three: below 1 2 3, above 4 5 6.
    type Bytes = fn(i16) -> Vec<u8>;
    let kinds: [(i32, Bytes); 6] = [
        (8, |n| vec![n as u8]),
        (16, |n| n.to_be_bytes().into()),
        (32, |n| i32::from(n).to_be_bytes().into()),
        (64, |n| i64::from(n).to_be_bytes().into()),
        (-32, |n| f32::from(n).to_be_bytes().into()),
        (-64, |n| f64::from(n).to_be_bytes().into()),
    ];
    for (bitpix, bytes) in kinds {
        let data: Vec<u8> = (1..=6).flat_map(bytes).collect();
        let cards = [
            card("BITPIX", &bitpix.to_string()),
            card("NAXIS", "4"),
            card("NAXIS1", "3"),
            card("NAXIS2", "2"),
            card("NAXIS3", "1"),
            card("NAXIS4", "1"),
            card("BSCALE", "0.5"),
            card("BZERO", "10.0"),
            card("CTYPE1", "'RA---SIN'"),
            card("CDELT1", "-1.0E-10"),
            card("CDELT2", "1.0E-10"),
        ];
        let cards: Vec<&str> = cards.iter().map(String::as_str).collect();
        let picture = Picture::decode(&fits(&cards, &data)).unwrap();
        assert_eq!(picture.values, [12.0, 12.5, 13.0, 10.5, 11.0, 11.5], "{bitpix}");
        assert!((picture.pixel.microarcseconds.unwrap() - 0.36).abs() < 1e-12);
        // With East to the right, and the rows from above.
        let turned: Vec<String> = cards
            .iter()
            .map(|c| c.replace("-1.0E-10", "+1.0E-10"))
            .map(|c| if c.starts_with("CDELT2") { c.replace("1.0E-10", "-1.E-10") } else { c })
            .collect();
        let turned: Vec<&str> = turned.iter().map(String::as_str).collect();
        let picture = Picture::decode(&fits(&turned, &data)).unwrap();
        assert_eq!(picture.values, [11.5, 11.0, 10.5, 13.0, 12.5, 12.0], "{bitpix}");
    }
}

#[test]
fn a_picture_by_gyoto() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../../shared/reference/gyoto_page_thorne_a0.9_i60.fits");
    if !path.exists() {
        eprintln!("skipped: the reference image is not here");
        return;
    }
    let picture = Picture::open(path).unwrap();
    assert_eq!((picture.width, picture.height, picture.pixel), (128, 128, PixelScale::default()));
    assert!(picture.physical && picture.values.iter().any(|&v| v > 0.0));
}

/// An EXR with a channel of its own for the intensity.
#[test]
fn an_intensity_in_exr() {
    use exr::prelude::{
        AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
    };
    let channel = |name: &str, values: [f32; 4]| AnyChannel::new(name, FlatSamples::F32(values.to_vec()));
    let write = |channels: Vec<AnyChannel<FlatSamples>>| {
        let channels = AnyChannels::sort(channels.into_iter().collect());
        let layer = Layer::new((2, 2), LayerAttributes::default(), Encoding::FAST_LOSSLESS, channels);
        let mut file = std::io::Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut file).unwrap();
        file.into_inner()
    };
    let file = write(vec![channel("R", [0.0; 4]), channel("intensity", [1.0, 2.0, 3.0, 4e9])]);
    let picture = Picture::decode(&file).unwrap();
    assert_eq!(picture.values, [1.0, 2.0, 3.0, 4e9]);
    assert!(picture.physical);
    let fault = Picture::decode(&write(vec![channel("R", [0.0; 4])])).unwrap_err();
    assert!(matches!(fault, PictureFault::NoChannels), "{fault}");
    let fault = Picture::decode(&file[..file.len() / 2]).unwrap_err();
    assert!(matches!(fault, PictureFault::Damaged(_)), "{fault}");
}

#[test]
fn transparent_pixels_are_black() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let bytes = [255, 255, 255, 0, 255, 0, 0, 255, 255, 255, 255, 51];
    image::save_buffer(&path, &bytes, 3, 1, image::ColorType::Rgba8).unwrap();
    let picture = Picture::open(&path).unwrap();
    for (value, expected) in picture.values.iter().zip([0.0, 1.0 / 3.0, 0.2]) {
        assert!((value - expected).abs() < 1e-7, "{value} {expected}");
    }
}

/// What is wrong is said: what, where, and what to do.
#[test]
fn faults() {
    let folder = tempfile::tempdir().unwrap();
    let said = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        Picture::open(&path).unwrap_err().to_string()
    };
    let text = said("words.txt", b"it is only words, and long enough to be read");
    assert!(text.contains("not a FITS, EXR, PNG") && text.contains("convert it to FITS"), "{text}");
    assert!(said("empty.png", b"").contains("empty"));
    let missing = Picture::open(folder.path().join("none.fits")).unwrap_err().to_string();
    assert!(missing.contains("check the path"), "{missing}");

    let none = fits(&[&card("BITPIX", "8"), &card("NAXIS", "0")], &[]);
    assert!(said("none.fits", &none).contains("no image with data"));
    let shape = |axes: &[usize], bitpix: &str, data: &[u8]| {
        let mut cards = vec![card("BITPIX", bitpix), card("NAXIS", &axes.len().to_string())];
        cards.extend(axes.iter().enumerate().map(|(k, n)| card(&format!("NAXIS{}", k + 1), &n.to_string())));
        fits(&cards.iter().map(String::as_str).collect::<Vec<_>>(), data)
    };
    assert!(said("cube.fits", &shape(&[2, 2, 2], "8", &[1; 8])).contains("2×2×2"));
    let large = said("large.fits", &shape(&[16385, 1], "8", &[1_u8].repeat(16385)));
    assert!(large.contains("16385×1") && large.contains("16384"), "{large}");
    let short = shape(&[100, 100], "-64", &[]);
    assert!(said("short.fits", &short).contains("cannot take"));

    let numbers: Vec<u8> = [1.0, f64::NAN, f64::INFINITY, 2.0].iter().flat_map(|x| x.to_be_bytes()).collect();
    let text = said("nan.fits", &shape(&[2, 2], "-64", &numbers));
    assert!(text.contains("2 of 4 pixels") && text.contains("column 0, row 0"), "{text}");
    let same = said("same.fits", &shape(&[2, 2], "8", &[0; 4]));
    assert!(same.contains("all pixels have the value 0") && same.contains("exposure"), "{same}");
    assert!(matches!(Picture::of_values(2, 2, vec![0.0; 3]), Err(PictureFault::Count { .. })));
    assert!(matches!(Picture::of_values(0, 2, Vec::new()), Err(PictureFault::NoPixels)));
}

/// Pixels that are not square would make ellipses of circles.
#[test]
fn pixels_are_square() {
    let cards = [
        card("BITPIX", "8"),
        card("NAXIS", "2"),
        card("NAXIS1", "2"),
        card("NAXIS2", "1"),
        card("CTYPE1", "'RA---SIN'"),
        card("CDELT1", "-2.0E-10"),
        card("CDELT2", "1.0E-10"),
    ];
    let cards: Vec<&str> = cards.iter().map(String::as_str).collect();
    let fault = Picture::decode(&fits(&cards, &[1, 2])).unwrap_err();
    assert!(matches!(fault, PictureFault::NotSquare(..)), "{fault}");
}
