//! Silhouettes: disks read off edges alone, in pictures that went through tone curves and eight bits.

use kerrscope::display::{Display, Tone};
use kerrscope::render::{Stage, Watch, draw};
use kerrscope::scene::Scene;
use kerrscope_fit::Observed;
use kerrscope_fit::fit::{Fit, Image, Models, Options, fit};
use kerrscope_fit::model::Source;
use kerrscope_fit::models::{Choice, Name};
use kerrscope_fit::request::Request;
use kerrscope_fit::silhouette::{Silhouette, Silhouettes};
use kerrscope_fit::traced::{Fineness, Lit, Outline, Projection};

/// A scene as a screen shows it with eight bits, read back as light.
fn photo(scene: &str, tone: Tone, exposure: f64) -> Image {
    let scene = Scene::from_toml(scene, std::path::Path::new("")).unwrap();
    let stage = Stage::new(&scene).unwrap();
    let film = draw(&stage, &Watch::default()).unwrap();
    shown(&Display { exposure, tone }.develop(&film).pixels, [film.width as usize, film.height as usize])
}

fn shown(pixels: &[[f32; 3]], size: [usize; 2]) -> Image {
    let light = |value: f32| kerrscope::display::srgb::decode(f64::from((value * 255.0).round()) / 255.0);
    let values = pixels.iter().map(|rgb| rgb.iter().map(|c| light(*c)).sum::<f64>() / 3.0).collect();
    Image { values, size, pixel: None }
}

fn run(image: &Image, choice: Choice, words: &[(&str, &str)]) -> (Silhouette, Fit) {
    let seen = Silhouette::of(image).unwrap();
    let choice = Choice { name: Name::Silhouette, ..choice };
    let models = Silhouettes::new(&seen, choice);
    let model = Observed::new(models.source(2), seen.image.size);
    let request =
        Request { parameters: words.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect() };
    let freedoms = request.freedoms(model.parameters()).unwrap();
    let starts = models.starts(&freedoms);
    let options = Options {
        freedoms,
        noise: None,
        seed: 5,
        rounds: 6,
        starts,
        progress: &|_| {},
        cancelled: &|| false,
        keeper: None,
    };
    let found = fit(&seen.image, &models, &options).unwrap();
    (seen, found)
}

fn show(seen: &Silhouette, fit: &Fit) {
    println!("size {:?} bins {:?} open {} doubtful {:.3} of {}", seen.image.size, seen.bins, seen.open, seen.doubtful, seen.edges);
    for e in fit.estimates.iter().filter(|e| e.free) {
        println!("{:16} {:10.5} ± {:.5} [{:.5} {:.5}]", e.name, e.mode, e.sd, e.q025, e.q975);
    }
    println!("good {} converged {} explained {:.5} chi2 {:.1}/{} evals {}", fit.good, fit.converged, fit.explained, fit.chi2, fit.degrees, fit.evaluations);
    for w in &fit.warnings {
        println!("  {w}");
    }
}

fn scene(spin: f64, inclination: f64, roll: f64, model: &str, size: usize, scale: f64, distance: f64) -> String {
    format!(
        "spacetime = {{ name = 'kerr', spin = {spin:?} }}\n\
         observer = {{ distance = {distance:?}, inclination = {inclination:?} }}\n\
         screen = {{ kind = 'angular', field_of_view = {:?}, roll = {roll:?} }}\n\
         sky = {{ kind = 'black' }}\n\
         [disk]\n{model}\n\
         [render]\nwidth = {size}\nheight = {size}\nsamples = 64\nadaptive = false\n",
        (scale * size as f64 / distance).to_degrees()
    )
}

const PAGE: &str = "model = 'page-thorne'\ninner = 'isco'\nouter = 12";
const POWER: &str = "model = 'power-law'\nindex = 2\ninner = 'isco'\nouter = 12";

#[test]
#[ignore]
fn experiment() {
    let size = std::env::var("SIZE").map_or(96, |s| s.parse().unwrap());
    let text = scene(0.8, 60.0, 20.0, if std::env::var("PT").is_ok() { PAGE } else { POWER }, size, 28.0 / size as f64, 1000.0);
    for (tone, exposure) in [(Tone::None, 0.0), (Tone::Neutral, 1.5), (Tone::Filmic, 1.0)] {
        let start = std::time::Instant::now();
        let image = photo(&text, tone, exposure);
        let peak = image.values.iter().copied().fold(0.0, f64::max);
        println!("== {tone:?} {exposure} peak {peak} render {:?}", start.elapsed());
        let (seen, fit) = run(&image, Choice::default(), &[]);
        show(&seen, &fit);
        println!("{:?}", start.elapsed());
    }
}

/// Derivatives of what is lit against differences of shares drawn finer.
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
            let differences: Vec<f64> =
                high.iter().zip(&low).map(|(h, l)| (h - l) / (2.0 * step)).collect();
            let size = differences.iter().map(|d| d * d).sum::<f64>().sqrt();
            let error = differences
                .iter()
                .zip(&found.derivatives[k])
                .map(|(a, b)| (a - b).powi(2))
                .sum::<f64>()
                .sqrt();
            println!("{k} {size:.4} {:.2e}", error / size);
            assert!(error < 0.01 * size, "{k}: {error} of {size}");
        }
    }
}

#[test]
#[ignore]
fn diagnose() {
    let size: usize = std::env::var("SIZE").map_or(96, |s| s.parse().unwrap());
    for (tone, exposure) in [(Tone::None, -2.0), (Tone::None, 0.0), (Tone::Neutral, 3.0), (Tone::Filmic, 1.0)] {
        let text = scene(0.8, 60.0, 20.0, if std::env::var("PT").is_ok() { PAGE } else { POWER }, size, 28.0 / size as f64, 1000.0);
        let image = photo(&text, tone, exposure);
        let seen = Silhouette::of(&image).unwrap();
        let models = Silhouettes::new(&seen, Choice { name: Name::Silhouette, ..Choice::default() });
        let truth = [0.8, 60.0, 340.0, 28.0 / size as f64, 0.0, 0.0, 1000.0, 1.0, 12.0, 0.0];
        let model = models.source(2).draw(&truth, seen.image.size, false).unwrap().values;
        println!("== {tone:?} {exposure} doubtful {:.3} of {}", seen.doubtful, seen.edges);
        let pattern = &seen.noise.unknown.as_ref().unwrap().pattern;
        let [w, h] = seen.image.size;
        let mut groups = std::collections::BTreeMap::<String, Vec<(f64, f64)>>::new();
        for p in 0..model.len() {
            let r = seen.image.values[p] - model[p];
            let (x, y) = ((p % w) as f64 + 0.5 - 0.5 * w as f64, (p / w) as f64 + 0.5 - 0.5 * h as f64);
            let rad = x.hypot(y) / size as f64 * 28.0;
            let side = if x < 0.0 { "left" } else { "right" };
            let zone = if rad > 6.8 { "outer" } else { "inner" };
            let kind = if seen.noise.known[p] > 1.0 { "unknown".to_owned() } else if pattern[p] > 0.5 { format!("edge {zone} {side}") } else if pattern[p] > 0.0 { format!("beside {zone}") } else { "plain".to_owned() };
            groups.entry(kind).or_default().push((r, model[p]));
        }
        for (kind, v) in &groups {
            let n = v.len() as f64;
            let mean = v.iter().map(|r| r.0).sum::<f64>() / n;
            let rms = (v.iter().map(|r| r.0 * r.0).sum::<f64>() / n).sqrt();
            let worst = v.iter().fold(0.0_f64, |m, r| m.max(r.0.abs()));
            println!("{kind:20} n {n:5} mean {mean:+.4} rms {rms:.4} worst {worst:.3}");
        }
        if std::env::var("MAP").is_ok() {
            for y in 0..h {
                let line: String = (0..w).map(|x| {
                    let p = y * w + x;
                    let r = seen.image.values[p] - model[p];
                    if seen.noise.known[p] > 1.0 { '?' } else if r > 0.3 { 'P' } else if r > 0.1 { 'p' } else if r < -0.3 { 'M' } else if r < -0.1 { 'm' } else if pattern[p] > 0.5 { ':' } else if model[p] > 0.5 { '#' } else { ' ' }
                }).collect();
                println!("{line}");
            }
        }
    }
}
