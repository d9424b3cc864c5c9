//! Features of pictures whose answer is known, and none in pictures of other things.

use std::f64::consts::PI;
use std::path::Path;

use kerrscope::measure::{Features, Picture, Setting};

/// A picture of n² pixels, each the mean over 16 × 16 points of light at (right, up) of the middle.
fn box_averaged(n: usize, light: impl Fn(f64, f64) -> f64) -> Picture {
    let half = 0.5 * n as f64;
    let value = |k: usize| {
        let (left, top) = ((k % n) as f64 - half, half - (k / n) as f64);
        let at = |m: usize| (m as f64 + 0.5) / 16.0;
        (0..256).map(|m| light(left + at(m % 16), top - at(m / 16))).sum::<f64>() / 256.0
    };
    Picture::of_values(n, n, (0..n * n).map(value).collect()).unwrap()
}

/// A round hole in an elliptic disk, at places between pixels.
#[test]
fn sharp_edges() {
    for shift in [0.0, 0.25, 0.37, 0.5, 0.81] {
        let (x0, y0) = (3.0 + shift, -2.0 - 0.6 * shift);
        let picture = box_averaged(200, |x, y| {
            let hole = (x - x0).hypot(y - y0) < 30.3;
            let disk = (x / 80.4).hypot(y / 60.2) < 1.0;
            f64::from(u8::from(disk && !hole))
        });
        let features = Features::of(&picture);
        let shadow = features.shadow.found().unwrap();
        assert!(shadow.sharp);
        let near = |found: f64, expected: f64, allowed: f64| {
            assert!((found - expected).abs() < allowed, "{shift}: {found} {expected}");
        };
        near(shadow.centre[0].value, x0, 0.01);
        near(shadow.centre[1].value, y0, 0.01);
        near(shadow.diameter.value, 60.6, 0.02);
        near(shadow.area_diameter, 60.6, 0.03);
        near(shadow.area.value, PI * 30.3 * 30.3, 2.0);
        assert!(shadow.circularity.value < 1e-3);
        let disk = features.disk.found().unwrap();
        let across = 80.4 * (1.0 - (y0 / 60.2).powi(2)).sqrt();
        near(disk.right.value, across - x0, 0.05);
        near(disk.left.value, across + x0, 0.05);
        near(disk.below.value, 60.2 * (1.0 - (x0 / 80.4).powi(2)).sqrt() + y0, 0.05);
        near(disk.axes[0], 160.8, 0.05);
        near(disk.axes[1], 120.4, 0.05);
        near(disk.major_axis, 0.0, 0.05);
        near(disk.displacement[0].value, x0, 0.02);
    }
}

/// A ring of Gaussian profile that is brighter on one side: A and η as Paper IV defines them.
#[test]
fn a_ring() {
    let (radius, sigma, a, pa) = (40.0, 5.0, 0.23, 147_f64.to_radians());
    let picture = box_averaged(200, |x, y| {
        let (x, y) = (x - 2.3, y + 1.4);
        let (r, side) = (x.hypot(y), (-x * pa.sin() + y * pa.cos()) / x.hypot(y).max(1e-9));
        (-0.5 * ((r - radius) / sigma).powi(2)).exp() * (1.0 + 2.0 * a * side)
    });
    let features = Features::of(&picture);
    let ring = features.ring.found().unwrap();
    assert!((ring.centre[0] - 2.3).abs() < 0.02 && (ring.centre[1] + 1.4).abs() < 0.02, "{:?}", ring.centre);
    assert!((ring.diameter.value - 80.0).abs() < 0.05, "{:?}", ring.diameter);
    // A pixel's box and the interpolation widen a Gaussian by variances of 1/12 to 1/4.
    let fwhm = (8.0 * 2_f64.ln()).sqrt() * (sigma * sigma + 0.2_f64).sqrt();
    assert!((ring.width.value - fwhm).abs() < 0.05, "{:?} {fwhm}", ring.width);
    assert!((ring.asymmetry.value - a).abs() < 2e-3, "{:?}", ring.asymmetry);
    assert!((ring.position_angle.value - 147.0).abs() < 0.2, "{:?}", ring.position_angle);
    assert!(ring.central_brightness < 1e-3);
    let shadow = features.shadow.found().unwrap();
    assert!(!shadow.sharp, "a Gaussian ring has no edge");
}

/// Face-on, without spin: the dark region and the disk are circles of the radii that single rays give.
#[test]
fn a_render_face_on() {
    let setting = Setting { size: [400, 400], ..Setting::default() };
    let (exact, features) = (setting.exact().unwrap(), Features::of(&setting.picture().unwrap()));
    let disk = features.disk.found().unwrap();
    for side in [disk.right, disk.left, disk.below, disk.above] {
        assert!((side.value - exact.right).abs() < 0.05, "{side:?} {exact:?}");
    }
    let shadow = features.shadow.found().unwrap();
    assert!(shadow.circularity.value < 2e-3 && (shadow.diameter.value - shadow.area_diameter).abs() < 0.05);
}

/// Things without a hole, noise and gradients have no numbers.
#[test]
fn other_pictures() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for name in ["balls.png", "room.png", "thesis-4.3.png", "thesis-4.2.png"] {
        let features = Features::of(&Picture::open(scenes.join(name)).unwrap());
        assert!(features.shadow.found().is_none() && features.ring.found().is_none(), "{name}: {features:?}");
        assert!(features.disk.found().is_none(), "{name}");
    }
    let mut state = 1_u64;
    let noise: Vec<f64> = (0..128 * 128)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64
        })
        .collect();
    let features = Features::of(&Picture::of_values(128, 128, noise).unwrap());
    assert!(features.shadow.found().is_none() && features.ring.found().is_none());
    let gradient: Vec<f64> = (0..64 * 64).map(|k| f64::from(k % 64)).collect();
    assert!(Features::of(&Picture::of_values(64, 64, gradient).unwrap()).shadow.found().is_none());
    // A dot is light without a hole in it.
    let dot = box_averaged(100, |x, y| f64::from(u8::from(x.hypot(y) < 20.0)));
    assert!(Features::of(&dot).shadow.found().is_none());
}
