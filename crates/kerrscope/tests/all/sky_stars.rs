//! The built-in sky: the catalogue, where its stars are seen, and how bright.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use kerrscope::camera::Camera;
use kerrscope::light::Light;
use kerrscope::render::{Replay, Stage, Tally};
use kerrscope::scene::Scene;
use kerrscope::sky::{Frame, Glow, Orientation, Sky, Star, Stars, towards};

/// Right ascension in hours, minutes and seconds, declination in degrees, minutes and seconds,
/// magnitude and B − V.
type Named = (&'static str, [f64; 3], [f64; 3], f64, f64);

/// Five stars in J2000, from SIMBAD.
const NAMED: [Named; 5] = [
    ("Sirius", [6.0, 45.0, 8.917], [-16.0, -42.0, -58.02], -1.46, 0.00),
    ("Vega", [18.0, 36.0, 56.336], [38.0, 47.0, 1.28], 0.03, 0.00),
    ("Betelgeuse", [5.0, 55.0, 10.305], [7.0, 24.0, 25.43], 0.42, 1.85),
    ("Polaris", [2.0, 31.0, 49.095], [89.0, 15.0, 50.79], 2.02, 0.60),
    ("Canopus", [6.0, 23.0, 57.110], [-52.0, -41.0, -44.38], -0.74, 0.15),
];

/// An angle in whole units, minutes and seconds.
fn sexagesimal([whole, minutes, seconds]: [f64; 3]) -> f64 {
    whole + minutes / 60.0 + seconds / 3600.0
}

fn unit(longitude: f64, latitude: f64) -> [f64; 3] {
    [latitude.cos() * longitude.cos(), latitude.cos() * longitude.sin(), latitude.sin()]
}

fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let chord = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
    2.0 * (0.5 * chord).asin()
}

fn direction(star: &Star) -> [f64; 3] {
    unit(star.right_ascension.to_radians(), star.declination.to_radians())
}

#[test]
fn the_catalogue_is_whole() {
    let stars: Vec<Star> = Star::catalogue().collect();
    assert_eq!(stars.len(), 41_411);
    assert_eq!(stars.iter().filter(|s| s.color_index.is_none()).count(), 52);
    assert!(stars.is_sorted_by(|a, b| a.magnitude <= b.magnitude));
    assert_eq!((stars[0].magnitude, stars[41_410].magnitude), (-1.44, 8.0));
    for star in &stars {
        assert!((0.0..360.0).contains(&star.right_ascension) && star.declination.abs() <= 90.0, "{star:?}");
        assert!(star.color_index.is_none_or(|index| (-0.4..=5.46).contains(&index)), "{star:?}");
        assert_eq!(Star::from_code(star.code()), *star);
    }
    // Each whole magnitude has about three times the stars of the one before: 2.5 to 4.
    let brighter = |limit: f64| stars.iter().filter(|s| s.magnitude < limit).count() as f64;
    for limit in [3.0, 4.0, 5.0, 6.0, 7.0] {
        let growth = brighter(limit + 1.0) / brighter(limit);
        assert!((2.5..4.0).contains(&growth), "{limit} {growth}");
    }
}

#[test]
fn named_stars_are_in_the_catalogue() {
    for (name, ascension, declination, magnitude, index) in NAMED {
        let place = unit((15.0 * sexagesimal(ascension)).to_radians(), sexagesimal(declination).to_radians());
        let near = |star: &Star| angle(direction(star), place).to_degrees() * 3600.0;
        let star = Star::catalogue().take(100).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
        // The catalogue's epoch is 1991.25: Sirius moves 1.3″ a year.
        assert!(near(&star) < 15.0, "{name} {}", near(&star));
        // They vary, and catalogues differ.
        assert!((star.magnitude - magnitude).abs() < 0.15, "{name} {star:?}");
        assert!((star.color_index.unwrap() - index).abs() < 0.4, "{name} {star:?}");
    }
}

/// A scene in flat space that looks towards a direction, with one of its orientations of the sky.
fn scene(towards: [f64; 3], sky: &str) -> Scene {
    let [x, y, z] = towards;
    let text = format!(
        "spacetime.name = \"minkowski\"\ndisk.model = \"none\"\n\
         observer = {{ position = [2, 1, 0], motion = \"static\" }}\n\
         screen = {{ kind = \"pinhole\", field_of_view = 40, look_at = [{}, {}, {}] }}\n\
         render = {{ width = 240, height = 160, samples = 4, jitter = false }}\n\
         sky = {{ {sky} }}\n",
        2.0 + x,
        1.0 + y,
        z
    );
    Scene::from_toml(&text, Path::new("")).unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn named_stars_are_at_their_pixels_in_flat_space() {
    // Where the axes of the frame point: longitude 0, 90° and north, in equatorial coordinates.
    // The galactic ones by the definition of 1958 carried over to J2000 (Reid & Brunthaler 2004,
    // appendix): the pole at 12h 51m 26.282s, +27° 07′ 42.01″, the centre at 17h 45m 37.224s,
    // −28° 56′ 10.23″.
    let pole = unit(
        (15.0 * sexagesimal([12.0, 51.0, 26.282])).to_radians(),
        sexagesimal([27.0, 7.0, 42.01]).to_radians(),
    );
    let centre = unit(
        (15.0 * sexagesimal([17.0, 45.0, 37.224])).to_radians(),
        sexagesimal([-28.0, -56.0, -10.23]).to_radians(),
    );
    let left = [
        pole[1] * centre[2] - pole[2] * centre[1],
        pole[2] * centre[0] - pole[0] * centre[2],
        pole[0] * centre[1] - pole[1] * centre[0],
    ];
    let galactic = [centre, left, pole];
    let equatorial = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (axes, frame) in [(galactic, "galactic"), (equatorial, "equatorial")] {
        for (name, ascension, declination, ..) in NAMED {
            let place =
                unit((15.0 * sexagesimal(ascension)).to_radians(), sexagesimal(declination).to_radians());
            let [a, b, c] = axes.map(|axis| (0..3).map(|k| axis[k] * place[k]).sum::<f64>());
            // Longitude 0 is at azimuth 90°, +y, and longitude 90° at azimuth 180°, −x.
            let towards = [-b, a, c];
            // Look 9° beside the star, so that it is no artefact of the middle.
            let aside = unit(towards[1].atan2(towards[0]) + 0.1 / c.acos().sin().max(0.5), c.asin() * 0.93);
            let scene = scene(aside, &format!("frame = \"{frame}\", longitude = 90"));
            let stage = Stage::new(&scene).unwrap();

            // Pinhole, written out: the camera's forward, right and up, and tangents.
            let forward = aside;
            let length = forward[0].hypot(forward[1]);
            let right = [forward[1] / length, -forward[0] / length, 0.0];
            let up = [
                right[1] * forward[2] - right[2] * forward[1],
                right[2] * forward[0] - right[0] * forward[2],
                right[0] * forward[1] - right[1] * forward[0],
            ];
            let dot = |v: [f64; 3]| (0..3).map(|k| v[k] * towards[k]).sum::<f64>();
            let tangent = 80.0 / 20_f64.to_radians().tan() / dot(forward);
            let expected = [120.0 + tangent * dot(right), 80.0 - tangent * dot(up)];

            // The picture's light around that place, in a square of 7 × 7 pixels.
            let (mut sum, mut moment) = (0.0, [0.0; 2]);
            let (mut replay, mut tally) = (Replay::default(), Tally::default());
            for dy in -3..=3 {
                for dx in -3..=3 {
                    let pixel = [(expected[0] + f64::from(dx)) as u32, (expected[1] + f64::from(dy)) as u32];
                    let light: f64 = stage.pixel(pixel, &mut replay, &mut tally).rgb.iter().sum();
                    sum += light;
                    for k in 0..2 {
                        moment[k] += light * (f64::from(pixel[k]) + 0.5);
                    }
                }
            }
            let found = moment.map(|m| m / sum);
            let error = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(error < 0.5 && sum > 1.0, "{frame} {name} {found:?} {expected:?} {sum}");
        }
    }
}

#[test]
fn the_cameras_rays_and_the_orientation_agree() {
    let scene = scene([0.0, 1.0, 0.2], "rotation = [10, -20, 30]");
    let camera = Camera::new(&scene).unwrap();
    assert!(camera.ray(120.0, 80.0).is_ok());
    // The first turn is about x: y goes towards z. The last is about z: x goes towards y.
    let turned = Orientation::upright(0.0).turned([FRAC_PI_2, 0.0, FRAC_PI_2]);
    let [theta, phi] = turned.scene_angles([0.0, 0.0]);
    assert!((theta - FRAC_PI_2).abs() < 1e-15 && (phi - FRAC_PI_2).abs() < 1e-15, "{theta} {phi}");
    let [theta, _] = turned.scene_angles([FRAC_PI_2, 0.0]);
    assert!(theta.abs() < 1e-15);
    // North goes to −y, then to +x.
    let [theta, phi] = turned.scene_angles([0.0, FRAC_PI_2]);
    assert!((theta - FRAC_PI_2).abs() < 1e-15 && phi.abs() < 1e-15, "{theta} {phi}");
    // The other way around it is the same rotation.
    let orientation = Orientation::celestial(Frame::Equatorial, Frame::Galactic, 0.3).turned([0.4, 0.5, 0.6]);
    for (longitude, latitude) in [(0.1, 0.2), (3.0, -1.2), (-2.0, 1.5)] {
        let [theta, phi] = orientation.scene_angles([longitude, latitude]);
        assert!(angle(orientation.inwards(towards(theta, phi)), unit(longitude, latitude)) < 1e-14);
    }
}

/// The light of the sky within a distance from a place, integrated over solid angle.
fn light_around(stars: &Stars, [theta, phi]: [f64; 2], radius: f64) -> [f64; 3] {
    let steps = 400;
    let step = 2.0 * radius / f64::from(steps);
    let mut sum = Light::DARK;
    for i in 0..steps {
        for j in 0..steps {
            let [down, right] = [i, j].map(|k| (f64::from(k) + 0.5) * step - radius);
            if down.hypot(right) < radius {
                let theta = theta + down;
                sum += stars.radiance(towards(theta, phi + right / theta.sin())) * (step * step);
            }
        }
    }
    sum.rgb
}

#[test]
fn a_stars_light_does_not_depend_on_the_pixels() {
    let orientation = Orientation::upright(0.0);
    // Vega, by far the brightest within 6°.
    let vega = Star::catalogue().find(|s| (s.magnitude, s.declination > 38.0) == (0.03, true)).unwrap();
    let place = orientation.scene_angles([vega.right_ascension.to_radians(), vega.declination.to_radians()]);
    let luminance = |rgb: [f64; 3]| 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    let expected = 1e-4 * 10_f64.powf(-0.4 * 0.03);
    for pixel in [1e-5, 1e-4, 1e-3, 3e-3] {
        let stars = Stars::new(pixel, orientation, 1.0);
        assert_eq!(stars.spot_width(), pixel);
        let radius = 5.1 * pixel;
        let glow = Glow::brightness(direction(&vega)) * 0.03 * PI * radius * radius;
        let found = luminance(light_around(&stars, place, radius)) - glow;
        // Stars of magnitude 8 within its halo give a thousandth each.
        assert!((found / expected - 1.0).abs() < 5e-3, "{pixel} {found} {expected}");
        // Half-way out it is half as bright. Unit vectors are kept with 24 bits, 6e-8 of a radian.
        let [theta, phi] = place;
        let (peak, half) =
            (stars.radiance(towards(theta, phi)), stars.radiance(towards(theta + 0.5 * pixel, phi)));
        assert!((half.rgb[1] / peak.rgb[1] - 0.5).abs() < 0.01 + 3e-7 / pixel, "{pixel}");
    }
}

#[test]
fn every_star_is_seen_whatever_the_size_of_the_pixels() {
    // The place of each star in the grid of cells must cover its whole spot. The sum over all
    // stars, without the grid, is the independent way.
    let orientation = Orientation::upright(0.0);
    for pixel in [1e-6, 3e-4, 2e-3, 0.05, 1.0] {
        let stars = Stars::new(pixel, orientation, 1.0);
        let width = stars.spot_width();
        let scale = 1e-4 / ((FRAC_PI_2 - 2.0 / PI) * width * width);
        let all: Vec<(Star, [f64; 3])> = Star::catalogue().map(|s| (s, direction(&s))).collect();
        for (k, (_, n)) in all.iter().enumerate().step_by(499) {
            // At places within and beside the spot.
            for (i, share) in [0.0, 0.3, 0.6, 0.99, 3.0, 4.9].into_iter().enumerate() {
                let turn = 1.3 * (k + i) as f64;
                let (theta, phi) = (n[2].acos(), n[1].atan2(n[0]));
                let theta = (theta + share * width * turn.cos()).clamp(1e-3, PI - 1e-3);
                let phi = phi + share * width * turn.sin() / theta.sin();
                let sight = orientation.inwards(towards(theta, phi));
                let expected: f64 = all
                    .iter()
                    .map(|(star, n)| {
                        let chord = (0..3).map(|k| (n[k] - sight[k]).powi(2)).sum::<f64>().sqrt();
                        let core = if chord < width { 0.5 + 0.5 * (PI * chord / width).cos() } else { 0.0 };
                        let part = 0.15 * ((5.0 - star.magnitude) / 3.0).clamp(0.0, 1.0);
                        let halo = (1.0 - (0.2 * chord / width).powi(2)).max(0.0).powi(4);
                        let halo = halo * (FRAC_PI_2 - 2.0 / PI) / (5.0 * PI);
                        scale * ((1.0 - part) * core + part * halo) * 10_f64.powf(-0.4 * star.magnitude)
                    })
                    .sum();
                let [r, g, b] = stars.radiance(towards(theta, phi)).rgb;
                let found = 0.2126 * r + 0.7152 * g + 0.0722 * b - 0.03 * Glow::brightness(sight);
                // Unit vectors are kept with 24 bits, 6e-8 of a radian.
                let error = (found - expected).abs();
                assert!(
                    error < 1e-6 + expected * (1e-5 + 2e-7 / width) + 0.1 * scale * 1e-7 / width.max(1e-5),
                    "{pixel} {k} {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn the_milky_way_is_where_it_is() {
    let galactic = Orientation::celestial(Frame::Equatorial, Frame::Galactic, 0.0);
    let at = |longitude: f64, latitude: f64| {
        let [theta, phi] = [FRAC_PI_2 - latitude.to_radians(), longitude.to_radians()];
        Glow::brightness(galactic.inwards(towards(theta, phi)))
    };
    let mean = |latitude: f64| (0..360).map(|l| at(f64::from(l), latitude)).sum::<f64>() / 360.0;
    // Bright along the plane, dark at the poles, about as bright on both sides.
    assert!(mean(0.0) > 0.3, "{}", mean(0.0));
    for latitude in [45.0, -60.0, 80.0, -89.0] {
        assert!(mean(latitude) < 0.02, "{latitude} {}", mean(latitude));
    }
    // The bulge outshines the opposite side; the Coalsack is darker than its surroundings.
    assert!(at(5.0, -4.0) > 1.5 * at(180.0, 0.0), "{} {}", at(5.0, -4.0), at(180.0, 0.0));
    assert!(at(302.5, 0.0) < 0.8 * at(308.0, 0.0).max(at(290.0, 0.0)));
    // No edge: over a quarter of a degree it changes by a small part of the whole.
    for i in 0..1440 {
        for j in -100..100 {
            let (longitude, latitude) = (0.25 * f64::from(i), 0.25 * f64::from(j));
            let step = (at(longitude + 0.25, latitude) - at(longitude, latitude)).abs();
            assert!(step < 0.08, "{longitude} {latitude} {step}");
        }
    }
}

#[test]
fn brightness_is_a_factor_and_light_is_finite_everywhere() {
    let [one, three] = [1.0, 3.0].map(|b| Stars::new(2e-3, Orientation::upright(0.0), b));
    for k in 0..2000 {
        let (theta, phi) = (1e-3 * PI * f64::from(k % 1000), 0.77 * f64::from(k));
        let (a, b) = (one.radiance(towards(theta, phi)).rgb, three.radiance(towards(theta, phi)).rgb);
        assert!((0..3).all(|k| a[k] > -1e-12 && (b[k] - 3.0 * a[k]).abs() <= 1e-6 * b[k]));
    }
    let sky = Sky::Stars(one);
    for bad in [f64::NAN, f64::INFINITY, -1e300] {
        for (theta, phi) in [(bad, 1.0), (1.0, bad)] {
            assert!(sky.radiance(towards(theta, phi), 1e-3).rgb.iter().all(|c| c.is_finite()));
        }
    }
}
