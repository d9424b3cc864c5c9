//! The image of a Page–Thorne disk by Gyoto, where it is at hand.

use std::path::Path;

use kerrscope::render::{Stage, Watch, draw};
use kerrscope::scene::Scene;

/// Pixels of a FITS image of 64-bit floating-point numbers: its header is blocks of 2880 bytes of cards of 80.
fn pixels(bytes: &[u8], count: usize) -> Vec<f64> {
    let end = bytes.chunks(80).position(|card| card.starts_with(b"END ")).expect("a header ends") + 1;
    let start = (end * 80).next_multiple_of(2880);
    let data = &bytes[start..start + 8 * count];
    data.chunks_exact(8).map(|b| f64::from_be_bytes(b.try_into().unwrap())).collect()
}

/// After one common scale, over pixels above 1 % of the peak.
#[test]
fn a_page_thorne_disk_is_that_of_gyoto() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let reference = root.join("../shared/reference/gyoto_page_thorne_a0.9_i60.fits");
    let Ok(bytes) = std::fs::read(reference) else {
        eprintln!("skipped: the reference image is not here");
        return;
    };
    let scene = Scene::load(Some(&root.join("scenes/validation/gyoto.toml")), &[]).unwrap();
    let film = draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap();
    // There the first row is the top one, against the standard, and α grows to the left.
    let reference = pixels(&bytes, 128 * 128);
    let theirs: Vec<f64> = (0..128 * 128).map(|i| reference[i / 128 * 128 + (127 - i % 128)]).collect();
    let ours = &film.intensity;
    let peak = theirs.iter().copied().fold(0.0, f64::max);
    let mut ratios: Vec<f64> =
        ours.iter().zip(&theirs).filter(|(_, t)| **t > 0.01 * peak).map(|(o, t)| o / t).collect();
    ratios.sort_unstable_by(f64::total_cmp);
    let scale = ratios[ratios.len() / 2];
    let mut apart: Vec<f64> = ratios.iter().map(|ratio| (ratio / scale - 1.0).abs()).collect();
    apart.sort_unstable_by(f64::total_cmp);
    let (median, most) = (apart[apart.len() / 2], apart[apart.len() * 95 / 100]);
    let mask = ours.iter().zip(&theirs).filter(|(o, t)| (**o > 0.0) != (**t > 0.0)).count();
    println!(
        "scale {scale}, median {median:.1e}, 95 % {most:.1e}, largest {:.1e}, mask {mask}",
        apart[apart.len() - 1]
    );
    assert!(median < 1e-5 && most < 5e-5, "{median:e} {most:e}");
    assert_eq!(mask, 0);
    assert!((scale - 1.0).abs() < 1e-4, "{scale}");
}
