//! What is done with bytes that may be anything. A panic is a fault found.
//!
//! The targets of libFuzzer call this, and so do ordinary tests, which include this file:
//! `crates/kerrscope/tests/all/fuzz.rs`.

use std::io::Cursor;
use std::path::Path;

use kerrscope::light::Sheet;
use kerrscope::output::{Provenance, exr, fits, hdf5, png};
use kerrscope::scene::{Faults, Scene};
use kerrscope::texture::{Sphere, Texture};

/// Pixels up to which a mip map is made of a picture; above, the time is better spent otherwise.
const MIPMAP_PIXELS: u32 = 1 << 16;

/// A scene as text.
pub fn scene(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        examine(&Scene::from_toml(text, Path::new("")));
    }
}

/// Lines, each of which is given to `--set`.
pub fn overrides(bytes: &[u8]) {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let overrides: Vec<String> = text.split('\n').map(str::to_owned).collect();
        examine(&Scene::load(None, &overrides));
    }
}

/// A scene is what its record says; faults lie within their texts and can be told.
fn examine(result: &Result<Scene, Faults>) {
    match result {
        Ok(scene) => {
            let again = Scene::from_toml(&scene.to_toml(), Path::new(""));
            assert_eq!(again.as_ref(), Ok(scene));
        }
        Err(faults) => {
            assert!(!faults.is_empty() && faults.len() <= Faults::MAX);
            for fault in faults {
                let span = fault.span.clone().unwrap_or_default();
                assert!(fault.source.text.get(span).is_some(), "{fault}");
                assert!(!fault.message.is_empty() && !fault.help.is_empty(), "{fault}");
                assert!(!fault.message.contains('\n') && fault.message.len() < 4096, "{fault}");
            }
            assert!(faults.to_string().len() < 1 << 20);
        }
    }
}

/// A picture in any format.
pub fn texture(bytes: &[u8]) {
    let Ok(texture) = Texture::decode(bytes) else {
        return;
    };
    for (u, v) in PLACES {
        examine_sheet(&texture.sample(u, v, true));
    }
    if texture.width() * texture.height() <= MIPMAP_PIXELS {
        let sphere = Sphere::new(texture);
        for (u, v) in PLACES {
            examine_sheet(&sphere.sample(u, v, 0.5));
        }
    }
}

const PLACES: [(f64, f64); 3] = [(0.0, 0.0), (0.3, 0.6), (1.0, 1.0)];

fn examine_sheet(sheet: &Sheet) {
    assert!(sheet.light.rgb.iter().all(|light| light.is_finite() && *light >= 0.0), "{sheet:?}");
    assert!((0.0..=1.0).contains(&sheet.opacity), "{sheet:?}");
}

/// A PNG, OpenEXR, FITS or HDF5 file with the record of how it was made, or that record as text.
pub fn provenance(bytes: &[u8]) {
    let from_png = png::decode_provenance(Cursor::new(bytes), Path::new("picture.png")).ok();
    let from_exr = exr::decode_provenance(bytes, Path::new("picture.exr")).ok();
    let from_fits = fits::decode_provenance(Cursor::new(bytes), Path::new("picture.fits")).ok();
    let from_hdf5 = hdf5::decode_provenance(bytes.to_vec(), Path::new("picture.h5")).ok();
    let from_text = std::str::from_utf8(bytes).ok().and_then(|text| text.parse::<Provenance>().ok());
    for made in [from_png, from_exr, from_fits, from_hdf5, from_text].into_iter().flatten() {
        assert_eq!(made.to_string().parse().as_ref(), Ok(&made));
        // The record is given as a scene.
        examine(&Scene::from_record("picture", &made.scene_toml, &[], Path::new("")));
    }
}
