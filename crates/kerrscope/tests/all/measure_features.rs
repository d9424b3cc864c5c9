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

/// A disk that a direction from its hole leaves and meets again: a hump with wings.
#[test]
fn wings() {
    let light = |x: f64, y: f64| {
        let wings = (x / 90.3).hypot((y + 14.2) / 21.7) < 1.0;
        let hump = (x - 1.1).hypot(y) < 52.4;
        let hole = ((x - 2.2) / 24.6).hypot((y - 12.7) / 17.3) < 1.0;
        f64::from(u8::from((wings || hump) && !hole))
    };
    let picture = box_averaged(220, light);
    let features = Features::of(&picture);
    let shadow = features.shadow.found().unwrap();
    let near = |found: f64, expected: f64, allowed: f64| {
        assert!((found - expected).abs() < allowed, "{found} {expected}");
    };
    near(shadow.centre[0].value, 2.2, 0.03);
    near(shadow.centre[1].value, 12.7, 0.03);
    near(shadow.area.value, PI * 24.6 * 17.3, 3.0);
    // ∮ r dθ/π of an ellipse.
    let mean = (0..720).map(|k| {
        let (sin, cos) = (PI * f64::from(k) / 360.0).sin_cos();
        (cos / 24.6).hypot(sin / 17.3).recip()
    });
    near(shadow.diameter.value, mean.sum::<f64>() / 360.0, 0.05);
    let disk = features.disk.found().unwrap();
    assert!(disk.sharp);
    // At the hole's height the hump ends before the wings do.
    let hump = (52.4_f64 * 52.4 - 12.7 * 12.7).sqrt();
    near(disk.right.value, 1.1 - 2.2 + hump, 0.1);
    near(disk.left.value, 2.2 - 1.1 + hump, 0.1);
    near(disk.far_right.value, 90.3 - 2.2, 0.15);
    near(disk.far_left.value, 90.3 + 2.2, 0.15);
    near(disk.below.value, 12.7 + (52.4_f64 * 52.4 - 1.1 * 1.1).sqrt(), 0.1);
    let lit: f64 = picture.values.iter().sum::<f64>() + PI * 24.6 * 17.3;
    near(disk.outline.area() / lit, 1.0, 2e-3);
}

/// The thesis's figure 4.8, drawn with a disk that fades away: its shadow and its edge are found, and the edge is that of a disk
/// of the same size and even light, but for the fading.
#[test]
fn a_disk_that_fades_away() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let features = Features::of(&Picture::open(scenes.join("thesis-4.8.png")).unwrap());
    let (shadow, disk) = (features.shadow.found().unwrap(), features.disk.found().unwrap());
    assert!(!disk.sharp && disk.right.error > 0.2 && shadow.level > 0.3, "{features:?}");
    let setting = Setting {
        spin: 0.99,
        inclination: 30_f64.atan2(5.0).to_degrees(),
        edge: 16.0,
        distance: 925_f64.sqrt(),
        size: [400, 225],
        samples: 16,
        ..Setting::default()
    };
    let even = Features::of(&setting.picture().unwrap());
    let (even, centre) = (even.disk.found().unwrap(), even.shadow.found().unwrap().centre[0].value);
    assert!(even.sharp);
    let own = shadow.centre[0].value;
    for (fading, even) in [
        (disk.far_right.value + own, even.far_right.value + centre),
        (disk.far_left.value - own, even.far_left.value - centre),
    ] {
        assert!(fading < even + 0.5 && fading > 0.97 * even, "{fading} {even}");
    }
}

/// Whether a point is in a triangle whose corners go anticlockwise.
fn in_triangle([x, y]: [f64; 2], corners: [[f64; 2]; 3]) -> bool {
    (0..3).all(|k| {
        let ([ax, ay], [bx, by]) = (corners[k], corners[(k + 1) % 3]);
        (bx - ax) * (y - ay) > (by - ay) * (x - ax)
    })
}

/// A cat's head with ears, larger by `more`.
fn is_cat(x: f64, y: f64, more: f64) -> bool {
    let ear = |side: f64| {
        let corner = |x: f64, y: f64| [side * x, y];
        let (tip, out, within) = (
            corner(34.0 + more, 44.0 + 1.6 * more),
            corner(34.0 + more, 2.0 - more),
            corner(4.0 - more, 20.0),
        );
        in_triangle([x, y], if side > 0.0 { [tip, within, out] } else { [tip, out, within] })
    };
    (x / (38.0 + more)).hypot((y + 8.0) / (34.0 + more)) < 1.0 || ear(1.0) || ear(-1.0)
}

/// Cats, frames, two holes, stripes, blobs: reasons instead of numbers.
#[test]
fn what_is_no_hole() {
    let lit = |is: bool| f64::from(u8::from(is));
    let eyes = |x: f64, y: f64| ((x.abs() - 16.0) / 8.0).hypot((y + 2.0) / 9.0) < 1.0;
    let ring = |x: f64, y: f64, r: f64| (x.hypot(y) - r).abs() < 4.0;
    let pictures: [(&str, Picture, &str); 7] = [
        ("a cat", box_averaged(128, |x, y| lit(is_cat(x, y, 0.0) && !eyes(x, y))), "dark regions of"),
        ("its outline", box_averaged(128, |x, y| lit(is_cat(x, y, 2.0) && !is_cat(x, y, -2.0))), "dents"),
        ("a dark cat", box_averaged(128, |x, y| 0.7 - 0.6 * lit(is_cat(x, y, 0.0))), "no brighter inside"),
        ("two rings", box_averaged(128, |x, y| lit(ring(x.abs() - 28.0, y, 18.0))), "dark regions of"),
        (
            "two rings of two sizes",
            box_averaged(128, |x, y| lit(ring(x + 25.0, y, 24.0) || ring(x - 35.0, y, 12.0))),
            "two rings of light",
        ),
        (
            "stripes",
            box_averaged(128, |x, _| lit((x / 6.0).floor().rem_euclid(2.0) < 0.5)),
            "no brighter inside",
        ),
        ("a hill", box_averaged(128, |x, y| (1.0 - x.hypot(y) / 64.0).max(0.0)), "no dark region"),
    ];
    for (name, picture, reason) in pictures {
        let features = Features::of(&picture);
        let kerrscope::measure::Feature::NotFound(why) = &features.shadow else {
            panic!("{name} has a shadow")
        };
        assert!(why.contains(reason), "{name}: {why}");
        assert!(features.ring.found().is_none() && features.disk.found().is_none(), "{name}");
    }
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    for (name, reason) in [
        ("earth.png", "dark regions of"),
        ("two-holes.png", "no darker than the sky"),
        ("wormhole.png", ""),
        ("thesis-4.5.png", "border"),
    ] {
        let features = Features::of(&Picture::open(scenes.join(name)).unwrap());
        let kerrscope::measure::Feature::NotFound(why) = &features.shadow else {
            panic!("{name} has a shadow")
        };
        assert!(why.contains(reason), "{name}: {why}");
        assert!(features.ring.found().is_none() && features.disk.found().is_none(), "{name}");
    }
}

/// Blobs of light at random before a dark sky, as in a photograph: of forty pictures none has a shadow, ring or disk.
#[test]
fn blobs() {
    let mut state = 5_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for picture in 0..40 {
        let blobs: Vec<[f64; 4]> = (0..60)
            .map(|_| [96.0 * random() - 48.0, 96.0 * random() - 48.0, 3.0 + 10.0 * random(), random()])
            .collect();
        let value = |k: usize| {
            let (x, y) = ((k % 96) as f64 - 47.5, 47.5 - (k / 96) as f64);
            let light: f64 = blobs
                .iter()
                .map(|[bx, by, width, peak]| {
                    peak * (-0.5 * ((x - bx).powi(2) + (y - by).powi(2)) / (width * width)).exp()
                })
                .sum();
            light * (-(x.hypot(y) / 29.0).powi(6)).exp()
        };
        let features = Features::of(&Picture::of_values(96, 96, (0..96 * 96).map(value).collect()).unwrap());
        assert!(
            features.shadow.found().is_none(),
            "{picture}: {:?}",
            features.shadow.found().map(|s| (s.diameter, s.level))
        );
        assert!(features.ring.found().is_none() && features.disk.found().is_none(), "{picture}");
    }
}
