//! How fine a panorama is looked at: as fine as the rays of a pixel are apart on the sky.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::Path;

use image::{GrayImage, Luma};
use kerrscope::render::{Replay, Sampler, Stage, Tally, Watch, draw, tracer};
use kerrscope::scene::Scene;
use kerrscope::sky::{Orientation, Panorama, footprint, towards};
use kerrscope::spacetime::geodesic::{Path as Trajectory, Query};
use kerrscope::texture::Texture;

#[test]
fn the_footprint_is_the_rays_distance_from_each_other() {
    // A linear map with two stretches, turned by an angle.
    for (stretches, turn) in [([1e-3, 1e-3], 0.0), ([2e-4, 3e-3], 0.7), ([0.0_f64, 1e-2], 2.0)] {
        let (sin, cos) = f64::sin_cos(turn);
        for samples in [4, 8, 9, 16, 25, 100] {
            let sampler = Sampler::new(samples, 1, true);
            let expected = (0.5 * (stretches[0].powi(2) + stretches[1].powi(2)) / f64::from(samples)).sqrt();
            let (mut sum, pixels) = (0.0, 200);
            for pixel in 0..pixels {
                let directions = (0..samples).map(|sample| {
                    let [x, y] = sampler.place(pixel, sample);
                    let [along, across] = [x * stretches[0], y * stretches[1]];
                    towards(FRAC_PI_2 + cos * along - sin * across, 1.0 + sin * along + cos * across)
                });
                sum += (footprint(directions, 1.0) / expected).powi(2);
            }
            let rms = (sum / pixels as f64).sqrt();
            assert!((rms - 1.0).abs() < 0.03, "{stretches:?} {samples} {rms}");
        }
    }
}

#[test]
fn rays_from_everywhere_stand_for_the_whole_sky() {
    // Evenly on a sphere: their mean is its middle, and the variance 1.
    let rays = 400;
    let directions = (0..rays).map(|k| {
        let z = (2.0 * f64::from(k) + 1.0) / f64::from(rays) - 1.0;
        towards(z.acos(), 2.399963229728653 * f64::from(k))
    });
    let found = footprint(directions, 0.0);
    assert!((found - (6.0 / f64::from(rays)).sqrt()).abs() < 1e-4, "{found}");
}

#[test]
fn few_rays_are_not_believed_to_be_close_together() {
    let one = towards(1.0, 2.0);
    assert_eq!(footprint([], 1e-3), 1e-3);
    for rays in 1..4 {
        assert_eq!(footprint(vec![one; rays], 1e-3), 1e-3);
    }
    assert!(footprint([one; 4], 1e-3) < 1e-7);
    // They may be farther apart.
    assert!(footprint([one, towards(1.5, 2.0)], 1e-3) > 0.3);
}

/// The scene of figure 4.5 of the thesis, a quarter as large, before a panorama.
fn scene(folder: &Path, sky: &GrayImage, seed: u32, samples: u32) -> Scene {
    sky.save(folder.join("sky.png")).unwrap();
    let text = format!(
        "spacetime.name = \"schwarzschild\"\ndisk.model = \"none\"\n\
         observer.position = [0.0, -30.0, 5.0]\n\
         screen = {{ kind = \"pinhole\", field_of_view = 50, look_at = [0.0, 0.0, 0.0] }}\n\
         sky = {{ kind = \"panorama\", image = \"sky.png\" }}\n\
         render = {{ width = 480, height = 270, samples = {samples}, seed = {seed} }}\n"
    );
    Scene::from_toml(&text, folder).unwrap_or_else(|faults| panic!("{faults}"))
}

/// A checkerboard whose squares are 0.7° large, five times a pixel of the picture.
fn checkerboard() -> GrayImage {
    GrayImage::from_fn(2048, 1024, |x, y| Luma([if (x / 4 + y / 4) % 2 == 0 { 255 } else { 0 }]))
}

/// Pixels that lie at least partly within three pixels' width outside the edge of the shadow.
fn around_the_shadow() -> Vec<[u32; 2]> {
    let pixel = 2.0 * 25_f64.to_radians().tan() / 270.0;
    let r = 30_f64.hypot(5.0);
    let edge = (27_f64.sqrt() * (1.0 - 2.0 / r).sqrt() / r).asin().tan() / pixel;
    let places = (0..480 * 270).map(|k| [k % 480, k / 480]);
    places
        .filter(|[x, y]| {
            let rho = (f64::from(*x) - 239.5).hypot(f64::from(*y) - 134.5);
            (edge - 0.5..edge + 3.0).contains(&rho)
        })
        .collect()
}

/// Light of pixels whose rays all look at the picture itself, not at its smaller levels.
fn unfiltered(scene: &Scene, sky: &Panorama, pixels: &[[u32; 2]]) -> Vec<f64> {
    let camera = kerrscope::camera::Camera::new(scene).unwrap();
    let (tracer, mut path) = (tracer(scene, kerrscope::spacetime::Level::best()), Trajectory::default());
    let render = &scene.render;
    let sampler = Sampler::new(render.samples, render.seed, render.jitter);
    let query = Query { max_crossings: 0, ..Query::default() };
    let mut light = |[x, y]: [u32; 2]| {
        let mut sum = 0.0;
        for sample in 0..render.samples {
            let [right, down] = sampler.place(u64::from(y * render.width + x), sample);
            let ray = camera.ray(f64::from(x) + right, f64::from(y) + down).unwrap();
            tracer.trace(&ray, &query, &mut path);
            sum += path.direction.map_or(0.0, |[theta, phi]| sky.radiance(towards(theta, phi), 0.0).rgb[0]);
        }
        sum / f64::from(render.samples)
    };
    pixels.iter().map(|&pixel| light(pixel)).collect()
}

fn filtered(scene: &Scene, pixels: &[[u32; 2]]) -> Vec<f64> {
    let stage = Stage::new(scene).unwrap();
    let (mut replay, mut tally) = (Replay::default(), Tally::default());
    pixels.iter().map(|&pixel| stage.pixel(pixel, &mut replay, &mut tally).rgb[0]).collect()
}

/// Mean square of the difference.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64
}

#[test]
fn next_to_the_shadow_a_checkerboard_is_grey_and_no_noise() {
    let folder = tempfile::tempdir().unwrap();
    let sky = checkerboard();
    let panorama = {
        let mut file = Vec::new();
        sky.write_to(&mut std::io::Cursor::new(&mut file), image::ImageFormat::Png).unwrap();
        Panorama::new(Texture::decode(&file).unwrap(), Orientation::upright(PI), 1.0)
    };
    let pixels = around_the_shadow();
    assert!(pixels.len() > 800);
    let truth = unfiltered(&scene(folder.path(), &sky, 1, 144), &panorama, &pixels);
    for samples in [4, 9] {
        let scenes = [1, 2].map(|seed| scene(folder.path(), &sky, seed, samples));
        let [with, without] = [
            scenes.each_ref().map(|scene| filtered(scene, &pixels)),
            scenes.each_ref().map(|scene| unfiltered(scene, &panorama, &pixels)),
        ];
        // Between seeds.
        let noise = [&with, &without].map(|[a, b]| 0.5 * apart(a, b));
        let error = [&with, &without].map(|[a, _]| apart(a, &truth));
        assert!(noise[0] < 0.1 * noise[1], "{samples} {noise:?}");
        assert!(error[0] < 0.15 * error[1], "{samples} {error:?}");
        // No light is lost, and none added.
        let [bright, dim] = [&with[0], &truth].map(|all| all.iter().sum::<f64>() / all.len() as f64);
        assert!((bright - dim).abs() < 0.01, "{samples} {bright} {dim}");
    }
}

#[test]
fn pixels_are_the_same_in_any_order_and_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = scene(folder.path(), &checkerboard(), 1, 5);
    (scene.render.width, scene.render.height, scene.render.adaptive) = (64, 36, None);
    let stage = Stage::new(&scene).unwrap();
    let (mut replay, mut tally) = (Replay::default(), Tally::default());
    let mut backwards: Vec<_> = (0..64 * 36)
        .rev()
        .map(|k| stage.pixel([k % 64, k / 64], &mut replay, &mut tally).rgb.map(|c| c as f32))
        .collect();
    backwards.reverse();
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let film = pool.install(|| draw(&stage, &Watch::default())).unwrap();
        assert_eq!(film.light, backwards);
    }
}

#[test]
fn pixels_wide_enough_see_the_mean_of_the_picture() {
    // In flat space, single pixels of 0.5° in black and white.
    let folder = tempfile::tempdir().unwrap();
    let sky = GrayImage::from_fn(720, 360, |x, y| Luma([((x + y) % 2 * 255) as u8]));
    for (height, samples, grey) in [(12, 4, true), (12, 1, true), (160, 1, false), (160, 4, false)] {
        let mut scene = scene(folder.path(), &sky, 1, samples);
        scene.spacetime = kerrscope::scene::Spacetime::Minkowski;
        (scene.render.width, scene.render.height, scene.render.jitter) = (height, height, false);
        let stage = Stage::new(&scene).unwrap();
        let film = draw(&stage, &Watch::default()).unwrap();
        let away = film.light.iter().map(|light| (light[0] - 0.5).abs()).fold(0.0, f32::max);
        // A pixel of the screen is 4.5° or 0.33° wide.
        assert_eq!(away < 1e-3, grey, "{height} {samples} {away}");
    }
}
