//! Thin disks.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI, TAU};
use std::sync::LazyLock;

use kerrscope::disk::{Disk, DiskHit, Mapping, Matter, Picture, Plane, Ring, Shifts, Surface};
use kerrscope::light::Sheet;
use kerrscope::texture::Texture;
use proptest::prelude::*;

fn ring(seed: u64) -> Disk {
    // Most tests use the same ring; its tables take milliseconds.
    static FIRST: LazyLock<Ring> = LazyLock::new(|| Ring::new(1));
    let ring = if seed == 1 { FIRST.clone() } else { Ring::new(seed) };
    Disk {
        inner: 6.0,
        outer: 16.0,
        plane: Plane::EQUATOR,
        surface: Surface::Ring(ring),
        matter: Matter { orbits: None, shifts: Shifts::NONE },
        tint: [1.0; 3],
        opacity: 1.0,
        thin: false,
        orders: None,
        time: None,
    }
}

fn at(disk: &Disk, radius: f64, azimuth: f64) -> Sheet {
    let position = [radius * azimuth.cos(), radius * azimuth.sin(), 0.0];
    disk.sheet(&disk.hit(radius, position)).unwrap()
}

fn pictured(image: &image::GrayImage, mapping: Mapping) -> Disk {
    let mut file = Vec::new();
    let mut to = std::io::Cursor::new(&mut file);
    image.write_to(&mut to, image::ImageFormat::Png).unwrap();
    let texture = Texture::decode(&file).unwrap();
    Disk { surface: Surface::Picture(Picture { texture, mapping }), ..ring(1) }
}

fn dot(n: u32, m: u32, x: u32, y: u32) -> image::GrayImage {
    let mut image = image::GrayImage::new(n, m);
    image.put_pixel(x, y, image::Luma([255]));
    image
}

/// Opacities of a ring along its radius, averaged over 16 azimuths.
fn profile(disk: &Disk, n: u32) -> Vec<f64> {
    (0..=n)
        .map(|i| {
            let r = 6.0 + 10.0 * f64::from(i) / f64::from(n);
            (0..16).map(|k| at(disk, r, f64::from(k) * TAU / 16.0).opacity / 16.0).sum()
        })
        .collect()
}

#[test]
fn nothing_is_seen_outside_the_radii() {
    for radius in [5.999, 16.001, 0.0, -8.0, f64::NAN, f64::INFINITY] {
        let within = ring(1).hit(9.0, [9.0, 0.0, 0.0]);
        assert_eq!(ring(1).sheet(&DiskHit { radius, ..within }), None);
    }
}

#[test]
fn both_edges_fade_out_within_a_tenth_of_the_width() {
    for seed in 1..10 {
        let disk = ring(seed);
        for edge in [6.0, 16.0] {
            assert_eq!(at(&disk, edge, 1.0).opacity, 0.0);
        }
        // Nowhere inside is the ring invisible.
        for i in 10..=90 {
            assert!(at(&disk, 6.0 + 0.1 * f64::from(i), 1.0).opacity > 0.03);
        }
        // Near an edge the opacity grows from zero with no step.
        assert!(at(&disk, 6.01, 1.0).opacity < 2e-3 && at(&disk, 15.99, 1.0).opacity < 2e-3);
    }
}

#[test]
fn there_are_bright_and_dark_bands() {
    for seed in 1..10 {
        let profile = profile(&ring(seed), 1000);
        let inside = &profile[100..900];
        let (low, high) = inside.iter().fold((1.0_f64, 0.0_f64), |(l, h), &x| (l.min(x), h.max(x)));
        assert!(high > 2.5 * low, "seed {seed}: {low} {high}");
        let peaks = inside.windows(3).filter(|w| w[1] > w[0] && w[1] > w[2]).count();
        assert!((8..80).contains(&peaks), "seed {seed}: {peaks} bands");
    }
}

#[test]
fn the_ring_varies_weakly_along_the_azimuth() {
    let mean_spread: f64 = (1..=9)
        .map(|i| {
            let r = 6.0 + f64::from(i);
            let (mut low, mut high) = (1.0_f64, 0.0_f64);
            for k in 0..360 {
                let opacity = at(&ring(1), r, f64::from(k).to_radians()).opacity;
                (low, high) = (low.min(opacity), high.max(opacity));
            }
            (high - low) / high / 9.0
        })
        .sum();
    assert!((0.1..0.5).contains(&mean_spread), "{mean_spread}");
}

#[test]
fn the_ring_has_no_seam() {
    let disk = ring(1);
    for r in [7.0, 8.5, 11.0, 15.0] {
        for azimuth in [0.0, PI] {
            let (here, there) = (at(&disk, r, azimuth - 1e-7), at(&disk, r, azimuth + 1e-7));
            assert!((here.opacity - there.opacity).abs() < 1e-5);
            // Not only the value goes on but also the slope.
            let h = 0.02;
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(&disk, r, azimuth + k * h).opacity);
            assert!(((b - a) - (d - c)).abs() < 0.01, "{a} {b} {c} {d}");
        }
    }
}

#[test]
fn the_ring_is_orange_paler_and_brighter_inside() {
    // Light per opacity, averaged over bands and azimuths.
    let mean = |from: f64| {
        let (mut rgb, mut opacity) = ([0.0; 3], 0.0);
        for i in 0..300 {
            let sheet = at(&ring(1), from + 0.01 * f64::from(i), f64::from(i));
            opacity += sheet.opacity;
            for (sum, c) in rgb.iter_mut().zip(sheet.light.rgb) {
                *sum += c;
            }
        }
        rgb.map(|c| c / opacity)
    };
    let (inside, outside) = (mean(6.5), mean(12.5));
    for [r, g, b] in [inside, outside] {
        assert!(r > 1.4 * g && g > 2.0 * b, "{r} {g} {b}");
    }
    assert!(inside[0] > 1.5 * outside[0]);
    assert!(inside[2] / inside[0] > 2.0 * outside[2] / outside[0]);
}

#[test]
fn a_seed_is_a_ring() {
    assert_eq!(profile(&ring(5), 50), profile(&ring(5), 50));
    assert_ne!(profile(&ring(5), 50), profile(&ring(6), 50));
    assert_eq!(ring(5), ring(5));
    // The noise uses integers, sums and products alone: the same everywhere and always.
    let opacity = at(&ring(1), 9.0, 0.0).opacity;
    assert!((opacity - RING_1_AT_9).abs() < 1e-12, "{opacity}");
}

/// Opacity of the ring of seed 1 at r = 9 at the node: a change here changes pictures
/// that people have made.
const RING_1_AT_9: f64 = 0.5479862809181215;

#[test]
fn brightness_and_opacity_are_factors() {
    let plain = ring(2);
    let changed = Disk { tint: [3.0; 3], opacity: 0.5, ..plain.clone() };
    let (a, b) = (at(&plain, 9.0, 1.0), at(&changed, 9.0, 1.0));
    assert!((b.opacity - 0.5 * a.opacity).abs() < 1e-15);
    assert!((b.light.rgb[0] - 1.5 * a.light.rgb[0]).abs() < 1e-15);
}

#[test]
fn a_picture_goes_around_from_the_node_with_its_top_outside() {
    // 8 × 4 pixels: column 2 is azimuth 45° · 2.5, row 1 is 1.5 quarters from the outside.
    let disk = pictured(&dot(8, 4, 2, 1), Mapping::Around);
    let (r, azimuth) = (16.0 - 10.0 * 1.5 / 4.0, 2.5 / 8.0 * TAU);
    assert!((at(&disk, r, azimuth).light.rgb[0] - 1.0).abs() < 1e-9);
    assert!(at(&disk, r - 2.6, azimuth).light.rgb[0] < 1e-9);
    assert!(at(&disk, r, azimuth + 0.8).light.rgb[0] < 1e-9);
    // Column 0 and column 7 are neighbours.
    let disk = pictured(&dot(8, 4, 0, 1), Mapping::Around);
    assert!((at(&disk, r, 0.0).light.rgb[0] - 0.5).abs() < 1e-9);
    assert!((at(&disk, r, TAU / 32.0).light.rgb[0] - 0.75).abs() < 1e-9);
    assert!((at(&disk, r, -TAU / 32.0).light.rgb[0] - 0.25).abs() < 1e-9);
}

#[test]
fn a_flat_picture_lies_over_the_plane() {
    // 32 × 32 pixels of 1 M. Pixel (29, 15): x = 13.5, y = 0.5.
    let disk = pictured(&dot(32, 32, 29, 15), Mapping::Flat);
    let here = |x: f64, y: f64| at(&disk, x.hypot(y), y.atan2(x)).light.rgb[0];
    assert!((here(13.5, 0.5) - 1.0).abs() < 1e-9);
    assert!((here(13.0, 0.5) - 0.5).abs() < 1e-9);
    assert!(here(-13.5, 0.5) < 1e-9 && here(0.5, 13.5) < 1e-9);
    // Up in the picture is 90° ahead. Pixel (16, 2): x = 0.5, y = 13.5.
    let disk = pictured(&dot(32, 32, 16, 2), Mapping::Flat);
    let here = |x: f64, y: f64| at(&disk, x.hypot(y), y.atan2(x)).light.rgb[0];
    assert!((here(0.5, 13.5) - 1.0).abs() < 1e-9);
}

#[test]
fn alpha_of_a_picture_is_opacity() {
    let image = image::RgbaImage::from_pixel(1, 1, image::Rgba([255, 0, 0, 51]));
    let mut file = Vec::new();
    let mut to = std::io::Cursor::new(&mut file);
    image.write_to(&mut to, image::ImageFormat::Png).unwrap();
    let texture = Texture::decode(&file).unwrap();
    let surface = Surface::Picture(Picture { texture, mapping: Mapping::Around });
    let sheet = at(&Disk { surface, opacity: 0.5, ..ring(1) }, 9.0, 0.0);
    assert!((sheet.opacity - 0.1).abs() < 1e-12 && (sheet.light.rgb[0] - 0.1).abs() < 1e-12);
}

#[test]
fn azimuth_is_counted_in_a_tilted_plane() {
    // Tilted by 90° about the x axis: the disk stands up, and +z is 90° ahead of +x.
    let disk = Disk { plane: Plane::new(FRAC_PI_2, 0.0), ..pictured(&dot(4, 1, 1, 0), Mapping::Around) };
    let radius = 10.0;
    let c = radius * FRAC_1_SQRT_2;
    // Column 1 of 4 is azimuth 135°: half-way from +z to −x.
    let sheet = disk.sheet(&disk.hit(radius, [-c, 0.0, c])).unwrap();
    assert!((sheet.light.rgb[0] - 1.0).abs() < 1e-9);
}

proptest! {
    #[test]
    fn the_frame_of_a_plane_is_orthonormal_and_right_handed(
        tilt in -7.0..7.0, node in -7.0..7.0, azimuth in -3.1..3.1
    ) {
        let plane = Plane::new(tilt, node);
        let n = plane.normal();
        prop_assert!((n.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-14);
        prop_assert!((n[2] - f64::cos(tilt)).abs() < 1e-15);
        // A point made by turning the node about the normal (Rodrigues) has that azimuth.
        let e = [f64::cos(node), f64::sin(node), 0.0];
        prop_assert!((0..3).map(|k| n[k] * e[k]).sum::<f64>().abs() < 1e-15);
        let cross = [n[1] * e[2] - n[2] * e[1], n[2] * e[0] - n[0] * e[2], n[0] * e[1] - n[1] * e[0]];
        let (sin, cos) = f64::sin_cos(azimuth);
        let point = std::array::from_fn(|k| 7.0 * (cos * e[k] + sin * cross[k]));
        prop_assert!((plane.azimuth(point) - azimuth).abs() < 1e-14);
    }

    #[test]
    fn anything_gives_a_finite_sheet(
        radius in prop::num::f64::ANY, x in prop::num::f64::ANY, y in prop::num::f64::ANY,
        inner in prop::num::f64::ANY, outer in prop::num::f64::ANY, tilt in prop::num::f64::ANY
    ) {
        let image = image::GrayImage::from_pixel(2, 2, image::Luma([200]));
        let around = pictured(&image, Mapping::Around);
        let flat = pictured(&image, Mapping::Flat);
        for disk in [ring(1), around, flat] {
            for (inner, outer) in [(inner, outer), (6.0, 16.0), (radius, radius)] {
                let disk = Disk { inner, outer, plane: Plane::new(tilt, tilt), ..disk.clone() };
                for radius in [radius, 6.0 + radius.abs() % 10.0] {
                    if let Some(sheet) = disk.sheet(&disk.hit(radius, [x, y, x])) {
                        prop_assert!((0.0..=1.0).contains(&sheet.opacity));
                        prop_assert!(sheet.light.rgb.iter().all(|c| (0.0..4.0).contains(c)));
                    }
                }
            }
        }
    }
}
