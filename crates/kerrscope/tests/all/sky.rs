//! Light from infinitely far away.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use kerrscope::light::Light;
use kerrscope::sky::{Grid, Orientation, Panorama, Sky, towards};
use kerrscope::texture::Texture;
use proptest::prelude::*;

const WIDTH: u32 = 72;
const HEIGHT: u32 = 36;

/// A panorama that is black but for one white pixel.
fn star(x: u32, y: u32, longitude: f64, brightness: f64) -> Panorama {
    let mut image = image::GrayImage::new(WIDTH, HEIGHT);
    image.put_pixel(x, y, image::Luma([255]));
    panorama(&image, longitude, brightness)
}

fn panorama(image: &image::GrayImage, longitude: f64, brightness: f64) -> Panorama {
    let mut file = Vec::new();
    let mut to = std::io::Cursor::new(&mut file);
    image.write_to(&mut to, image::ImageFormat::Png).unwrap();
    Panorama::new(Texture::decode(&file).unwrap(), Orientation::upright(longitude), brightness)
}

/// Where the pixel is, from the direction of sight of a viewer at the centre who faces
/// the middle column at the equator, +z up: angles to the right and up.
///
/// This is written with vectors rather than with the formula under test.
fn direction_of_pixel(x: u32, y: u32, longitude: f64) -> (f64, f64) {
    let right = (f64::from(x) + 0.5) / f64::from(WIDTH) * TAU - PI;
    let up = FRAC_PI_2 - (f64::from(y) + 0.5) / f64::from(HEIGHT) * PI;
    let ahead = [longitude.cos(), longitude.sin()];
    // Right of the direction of sight f with up z is f × z = (f_y, −f_x).
    let rightwards = [ahead[1], -ahead[0]];
    let level: [f64; 2] =
        std::array::from_fn(|k| up.cos() * (right.cos() * ahead[k] + right.sin() * rightwards[k]));
    (up.sin().acos(), level[1].atan2(level[0]))
}

#[test]
fn a_star_in_a_panorama_is_where_a_viewer_inside_sees_it() {
    for (x, y) in [(36, 17), (0, 3), (71, 30), (50, 10), (20, 25)] {
        for longitude in [0.0, 1.0, -2.5, 9.0] {
            let sky = Sky::Panorama(star(x, y, longitude, 1.0));
            let (theta, phi) = direction_of_pixel(x, y, longitude);
            for turns in [-2.0, 0.0, 5.0] {
                let light = sky.radiance(towards(theta, phi + turns * TAU), 0.0);
                assert!((light.rgb[0] - 1.0).abs() < 1e-9, "{x} {y} {longitude} {light:?}");
            }
            // Two pixels (10°) away there is nothing.
            for (dt, dp) in [(0.18, 0.0), (-0.18, 0.0), (0.0, 0.18), (0.0, -0.18)] {
                assert_eq!(sky.radiance(towards(theta + dt, phi + dp), 0.0), Light::DARK);
            }
        }
    }
}

#[test]
fn a_panorama_joins_across_its_left_and_right_edges() {
    let sky = star(0, 18, 0.0, 1.0);
    let theta = 18.5 / f64::from(HEIGHT) * PI;
    let pixel = TAU / f64::from(WIDTH);
    // The left edge is at azimuth +π. The star lies half a pixel to its right, and shines
    // half as bright on the edge itself, from both sides.
    for (phi, light) in [(PI - 0.5 * pixel, 1.0), (PI, 0.5), (-PI, 0.5), (-PI + 0.25 * pixel, 0.25)] {
        assert!((sky.radiance(towards(theta, phi), 0.0).rgb[0] - light).abs() < 1e-9, "{phi}");
    }
}

#[test]
fn a_panorama_has_no_seam_across_the_poles() {
    let image =
        image::GrayImage::from_fn(WIDTH, HEIGHT, |x, y| image::Luma([(x * 53 % 256) as u8 ^ (y * 29) as u8]));
    let sky = panorama(&image, 0.3, 1.0);
    for pole in [0.0, PI] {
        for phi in [0.0, 0.7, 2.0, 4.4] {
            let theta = (pole - 1e-9_f64).abs();
            let (here, there) =
                (sky.radiance(towards(theta, phi), 0.0), sky.radiance(towards(theta, phi + PI), 0.0));
            assert!((here.rgb[0] - there.rgb[0]).abs() < 1e-6, "{here:?} {there:?}");
        }
    }
}

#[test]
fn brightness_is_a_factor() {
    let sky = star(36, 17, 0.0, 3.0);
    let (theta, phi) = direction_of_pixel(36, 17, 0.0);
    assert!((sky.radiance(towards(theta, phi), 0.0).rgb[2] - 3.0).abs() < 1e-9);

    let colour = Light::new([0.9, 0.8, 0.7]);
    let (plain, bright) = (Grid::new(0.2, colour, 1.0), Grid::new(0.2, colour, 2.5));
    assert_eq!(plain.radiance(towards(0.3, 0.4)) * 2.5, bright.radiance(towards(0.3, 0.4)));
}

fn grid() -> Grid {
    Grid::new(15_f64.to_radians(), Light::new([1.0; 3]), 1.0)
}

/// Angular width of a line: where it is brighter than half-way to its middle, summed
/// along a path through it.
fn width(path: impl Fn(f64) -> (f64, f64)) -> f64 {
    let light = |s: f64| {
        let (theta, phi) = path(s);
        grid().radiance(towards(theta, phi)).rgb[0]
    };
    let (middle, beside) = (light(0.0), light(0.05));
    let step = 1e-6;
    (-50_000..50_000).filter(|&i| light(f64::from(i) * step) > 0.5 * (middle + beside)).count() as f64 * step
}

#[test]
fn lines_have_one_width_on_the_sky_wherever_they_are() {
    let (step, plain) = (15_f64.to_radians(), 0.26_f64.to_radians());
    // An ordinary line of 0.4° with soft edges is half as bright 0.13° from its middle.
    for theta in [1.4, 1.2, 0.9, 0.45] {
        let measured = width(|s| (theta, 3.0 * step + s / theta.sin()));
        assert!((measured - plain).abs() < 0.01 * plain, "{theta} {measured}");
    }
    for phi in [0.4, 2.0, 5.0] {
        let measured = width(|s| (FRAC_PI_2 - 2.0 * step + s, phi));
        assert!((measured - plain).abs() < 0.01 * plain, "{phi} {measured}");
    }
    for measured in [width(|s| (FRAC_PI_2 + s, 0.4)), width(|s| (1.3, s / 1.3_f64.sin()))] {
        // The tints on the two sides differ, so the half-way points do a little.
        assert!((measured - 2.5 * plain).abs() < 0.02 * 2.5 * plain, "{measured}");
    }
}

#[test]
fn the_main_lines_are_brighter_and_the_rest_closes_around_the_sky() {
    let light = |theta, phi| grid().radiance(towards(theta, phi)).rgb[0];
    assert_eq!(light(FRAC_PI_2, 0.4), 1.0);
    assert_eq!(light(1.2, 0.0), 1.0);
    // The meridian opposite to 0 is an ordinary one.
    assert!((light(1.2, PI) - 0.4).abs() < 1e-9);
    // A spacing that divides nothing is rounded to one that does.
    for degrees in [7.0, 11.0, 13.0, 40.0] {
        let grid = Grid::new(f64::to_radians(degrees), Light::new([1.0; 3]), 1.0);
        let brightest = grid.radiance(towards(1.2, PI)).rgb[1];
        assert!((brightest - 0.4).abs() < 1e-9, "{degrees}");
    }
}

#[test]
fn the_four_parts_differ() {
    let tints: Vec<Light> = [(1.4, 0.4), (1.4, 3.6), (1.75, 0.4), (1.75, 3.6)]
        .map(|(theta, phi)| grid().radiance(towards(theta, phi)))
        .to_vec();
    for (i, a) in tints.iter().enumerate() {
        // Dim: below a tenth of the lines.
        assert!(a.rgb.iter().all(|&c| c < 0.1));
        for b in &tints[..i] {
            let difference = (0..3).map(|k| (a.rgb[k] - b.rgb[k]).abs()).fold(0.0, f64::max);
            // 0.005 is code 16 of 255 in sRGB: to be seen beside black.
            assert!(difference > 0.005, "{a:?} {b:?}");
        }
    }
}

proptest! {
    #[test]
    fn any_direction_gives_finite_light(
        theta in prop::num::f64::ANY, phi in prop::num::f64::ANY,
        spacing in prop::num::f64::ANY, angle in prop::num::f64::ANY,
    ) {
        let grid = Grid::new(spacing, Light::new([1.0; 3]), 1.0);
        for sky in [Sky::Grid(grid), Sky::Panorama(star(3, 4, 0.0, 1.0))] {
            let light = sky.radiance(towards(theta, phi), angle);
            prop_assert!(light.rgb.iter().all(|c| (0.0..=1.0).contains(c)), "{:?}", light);
        }
    }

    #[test]
    fn the_grid_is_continuous_at_the_poles(phi in 0.0..TAU, away in 0.0..PI) {
        // Within the cap where the meridians merge all is line.
        let here = grid().radiance(towards(1e-4, phi)).rgb[0];
        let there = grid().radiance(towards(1e-4, phi + away)).rgb[0];
        prop_assert!((here - there).abs() < 0.01, "{} {}", here, there);
    }
}
