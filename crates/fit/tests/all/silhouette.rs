//! Silhouettes: disks read off edges alone, in pictures that went through tone curves and eight bits.

use std::path::Path;

use kerrscope::display::{Display, Tone, srgb};
use kerrscope::light::Light;
use kerrscope::render::{Stage, Watch, draw};
use kerrscope::scene::Scene;
use kerrscope_fit::fit::{FitError, Image, Models};
use kerrscope_fit::likelihood::Posterior;
use kerrscope_fit::mode::climb;
use kerrscope_fit::model::{Freedom, Source};
use kerrscope_fit::models::{Choice, Name};
use kerrscope_fit::silhouette::{Silhouette, Silhouettes};
use kerrscope_fit::traced::{Fineness, Lit, Outline, Projection};
use kerrscope_fit::{Coordinates, Observed};

const CHOICE: Choice = Choice { name: Name::Silhouette, projection: Projection::Angular, orders: None };

/// Light as a screen with eight bits shows it, read back as light.
fn shown(display: &Display, pixels: &[[f32; 3]], size: [usize; 2]) -> Image {
    let back = |value: f64| srgb::decode((value * 255.0).round() / 255.0);
    let values = pixels
        .iter()
        .map(|rgb| display.encode(Light::new(rgb.map(f64::from))).iter().map(|c| back(*c)).sum::<f64>() / 3.0)
        .collect();
    Image { values, size, pixel: None }
}

/// The mode near a start, with the noise that it shows: parameters, standard deviations of the coordinates, pulls of the truth in them, and
/// the share of the variance that is left.
struct Found {
    values: Vec<f64>,
    pulls: Vec<f64>,
    left: f64,
}

/// Climbs with the parameters numbered `free` free, the others as in the truth.
fn climbed(image: &Image, start: &[f64; 10], truth: &[f64; 10], free: &[usize]) -> Found {
    let seen = Silhouette::of(image).unwrap();
    let models = Silhouettes::new(&seen, CHOICE);
    let model = Observed::new(models.source(2), seen.image.size);
    let both = model.parameters().iter().zip(truth).enumerate();
    let freedoms: Vec<Freedom> = both
        .map(|(k, (p, value))| if free.contains(&k) { p.usual } else { Freedom::Fixed(*value) })
        .collect();
    let coordinates = Coordinates::new(model.parameters(), &freedoms, &[1.0; 10]);
    let (start, goal) = (coordinates.of(start), coordinates.of(truth));
    let first = models.noise(&seen.image, None);
    let data = seen.image.values.as_slice();
    let posterior = Posterior { model: &model, data, noise: &first, coordinates: &coordinates };
    let mode = climb(&posterior, &[start.as_slice(), &[0.0]].concat(), 60, &|| false).unwrap();
    let best = model.predict(&mode.evaluation.values[..10], false).unwrap();
    let noise = models.revised(&seen.image, &best.values).unwrap();
    let posterior = Posterior { noise: &noise, ..posterior };
    let mode = climb(&posterior, &mode.place[..start.len()], 40, &|| false).unwrap();
    let covariance = mode.factor.inverse();
    let pulls = (0..start.len()).map(|k| (mode.place[k] - goal[k]) / covariance[(k, k)].sqrt()).collect();
    let mean = data.iter().sum::<f64>() / data.len() as f64;
    let variance: f64 = data.iter().map(|d| (d - mean).powi(2)).sum();
    let left = data.iter().zip(&best.values).map(|(d, m)| (d - m).powi(2)).sum::<f64>() / variance;
    Found { values: mode.evaluation.values, pulls, left }
}

/// Derivatives of what is lit against differences of shares, for an inner edge at the last stable orbit and near the horizon.
#[test]
fn derivatives_are_differences() {
    let finer = Fineness { lines: 2400, ..Fineness::default() };
    let outline = Outline { orders: Some(3), ..Outline::default() };
    let source = Lit::new(outline, Projection::Pinhole, finer);
    for inner in [1.0, 0.05] {
        let values = [0.7, 62.0, 25.0, 0.7, 0.6, -0.8, 60.0, inner, 9.0, 0.3];
        let found = source.draw(&values, [36; 2], true).unwrap();
        for k in 0..values.len() {
            let step = 1e-3 * values[k].abs().max(0.1);
            let moved = |sign: f64| {
                let mut values = values;
                values[k] += sign * step;
                source.draw(&values, [36; 2], false).unwrap().values
            };
            let (high, low) = (moved(1.0), moved(-1.0));
            let differences: Vec<f64> = high.iter().zip(&low).map(|(h, l)| (h - l) / (2.0 * step)).collect();
            let norm = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>().sqrt();
            let errors: Vec<f64> =
                differences.iter().zip(&found.derivatives[k]).map(|(a, b)| a - b).collect();
            assert!(
                norm(&errors) < 0.01 * norm(&differences),
                "{k}: {} {}",
                norm(&errors),
                norm(&differences)
            );
        }
    }
}

/// A disk with a sharp inner edge, brighter on one side by its motion, rendered ray by ray and shown by two tone curves: spin,
/// inclination, outer radius and scale come back within their errors, and close.
#[test]
fn tone_curves_do_not_matter() {
    let size = 72_usize;
    let scale = 28.0 / size as f64;
    let text = format!(
        "spacetime = {{ name = 'kerr', spin = 0.8 }}\n\
         observer = {{ distance = 1000, inclination = 60 }}\n\
         screen = {{ kind = 'angular', field_of_view = {:?}, roll = 20 }}\n\
         sky = {{ kind = 'black' }}\n\
         disk = {{ model = 'power-law', index = 2, inner = 'isco', outer = 12 }}\n\
         [render]\nwidth = {size}\nheight = {size}\nsamples = 64\nadaptive = false\n",
        (scale * size as f64 / 1000.0).to_degrees()
    );
    let scene = Scene::from_toml(&text, Path::new("")).unwrap();
    let film = draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap();
    let truth = [0.8, 60.0, 340.0, scale, 0.0, 0.0, 1000.0, 1.0, 12.0, 0.0];
    let start = [0.6, 56.0, 345.0, 1.03 * scale, 0.5, -0.5, 1000.0, 1.0, 11.5, 0.0];
    for (tone, exposure) in [(Tone::None, 0.0), (Tone::Filmic, 1.0)] {
        let image = shown(&Display { exposure, tone }, &film.light, [size; 2]);
        let found = climbed(&image, &start, &truth, &[0, 1, 2, 3, 4, 5, 8, 9]);
        println!("{tone:?} {:?} {:?} {}", found.values, found.pulls, found.left);
        assert!(found.pulls[..7].iter().all(|pull| pull.abs() < 4.0), "{:?}", found.pulls);
        for (k, close) in [(0, 0.05), (1, 1.0), (3, 0.01 * scale), (8, 0.2)] {
            assert!((found.values[k] - truth[k]).abs() < close, "{k}: {:?}", found.values);
        }
        assert!(found.left < 0.02, "{}", found.left);
    }
}

/// Twenty disks, lit unevenly, shown by several tone curves: how far the truth is from the mode in units of the posterior's width.
#[test]
fn errors_cover_the_truth() {
    const CASES: usize = 20;
    let size = 56_usize;
    let outline = Outline::default();
    let free = [0, 1, 2, 3, 4, 5, 8, 9];
    let (mut within, mut squares) = ([0; 4], 0.0);
    for case in 0..CASES {
        let random = |salt: usize| ((case * 31 + salt * 17 + 5) as f64 * 0.618_033_988_749_895).fract();
        let truth = [
            -0.3 + 1.2 * random(1),
            25.0 + 50.0 * random(2),
            360.0 * random(3),
            0.54 + 0.08 * random(4),
            random(5) - 0.5,
            random(6) - 0.5,
            1000.0,
            1.0,
            11.0 + 2.0 * random(7),
            0.0,
        ];
        let shares = Lit::new(outline, Projection::Angular, Fineness::default())
            .draw(&truth, [size; 2], false)
            .unwrap()
            .values;
        let tone = [Tone::None, Tone::Neutral, Tone::Filmic][case % 3];
        let light: Vec<[f32; 3]> = shares
            .iter()
            .enumerate()
            .map(|(pixel, share)| {
                // Seven times as bright on one side as on the other.
                let side = (pixel % size) as f64 / size as f64;
                [(share * (0.15 + 0.9 * side)) as f32; 3]
            })
            .collect();
        let image = shown(&Display { exposure: 0.3 * (case % 4) as f64, tone }, &light, [size; 2]);
        let found = climbed(&image, &truth, &truth, &free);
        // Coordinates of spin, both of the axis, and scale come first.
        for (pull, count) in found.pulls.iter().zip(&mut within) {
            *count += usize::from(pull.abs() < 2.0);
            squares += pull * pull / (4 * CASES) as f64;
        }
    }
    println!("within two standard deviations: {within:?} of {CASES}; mean square {squares:.2}");
    // Of 20, 19 are expected within two standard deviations; errors as wide as said have a mean square of 1.
    assert!(within.iter().all(|count| *count >= 15), "{within:?}");
    assert!((0.05..2.5).contains(&squares), "{squares}");
}

/// What is no disk says so, or is refused.
#[test]
fn what_is_no_disk() {
    let image = |light: &dyn Fn(f64, f64) -> bool| {
        let size = 48_usize;
        let at = |k: usize| {
            let lit = |s: usize| {
                let place = |k: usize, s: usize| k as f64 + (s as f64 + 0.5) / 6.0 - 24.0;
                f64::from(u8::from(light(place(k % size, s % 6), -place(k / size, s / 6))))
            };
            (0..36).map(lit).sum::<f64>() / 36.0
        };
        Image { values: (0..size * size).map(at).collect(), size: [size; 2], pixel: None }
    };
    // A head with two ears.
    let cat = image(&|x, y| {
        let ear = |side: f64| y > 4.0 && y < 20.0 - 2.0 * (x * side - 8.0).abs();
        x.hypot(y + 2.0) < 13.0 || ear(1.0) || ear(-1.0)
    });
    // More is left of its variance than the verdict allows (5 %).
    let start = [0.0, 40.0, 0.0, 0.7, 0.0, 0.0, 1000.0, 1.0, 8.0, 0.0];
    let found = climbed(&cat, &start, &start, &[1, 2, 3, 4, 5, 8, 9]);
    assert!(found.left > 0.05, "{}", found.left);
    let refused = |image: &Image| Silhouette::of(image).unwrap_err();
    let mut noise = Image { values: Vec::new(), size: [48; 2], pixel: None };
    noise.values = (0..48 * 48).map(|k| (f64::from(k) * 0.618_033_988_749_895).fract()).collect();
    assert!(matches!(refused(&noise), FitError::NoSilhouette(_)));
    noise.values[7] = f64::NAN;
    assert_eq!(refused(&noise), FitError::NotFinite { count: 1, column: 7, row: 0 });
}
