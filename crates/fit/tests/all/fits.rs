//! Whole fits of synthetic pictures.

use std::sync::Mutex;

use kerrscope_fit::Observed;
use kerrscope_fit::fit::{AIM, Fit, FitError, Image, Keeper, Models, Options, fit};
use kerrscope_fit::model::{Freedom, Parameter, Source};
use kerrscope_fit::models::{Choice, Name};
use kerrscope_fit::traced::{Disk, Fineness, Kind, Projection};
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};

/// A picture of a source, with noise of a share of the brightest pixel.
fn picture(source: Box<dyn Source>, values: &[f64], size: usize, noise: f64) -> Image {
    let model = Observed::new(source, [size; 2]);
    let mut pixels = model.predict(values, false).unwrap().values;
    let peak = pixels.iter().copied().fold(0.0, f64::max);
    let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(11);
    for pixel in &mut pixels {
        let z: f64 = StandardNormal.sample(&mut rng);
        *pixel += noise * peak * z;
    }
    Image { values: pixels, size: [size; 2], pixel: None }
}

fn ring(noise: f64) -> Image {
    let source = Choice { name: Name::Ring, ..Choice::default() }.source(2);
    picture(source, &[12.0, 5.0, 0.4, 145.0, 0.7, -1.1, 0.0, 3.0, 0.0], 28, noise)
}

fn run(
    image: &Image,
    name: Name,
    rounds: u64,
    keeper: Option<&dyn Keeper>,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<Fit, FitError> {
    let choice = Choice { name, ..Choice::default() };
    let model = Observed::new(choice.source(2), image.size);
    let known = |p: &Parameter| if p.name == "distance" { Freedom::Fixed(1000.0) } else { p.usual };
    let freedoms: Vec<Freedom> = model.parameters().iter().map(known).collect();
    let options = Options {
        freedoms,
        noise: None,
        seed: 5,
        rounds,
        aim: AIM,
        starts: Vec::new(),
        progress: &|_| {},
        interim: None,
        cancelled,
        keeper,
    };
    fit(image, &choice, &options)
}

/// A ring is found within five standard deviations, with chains that have converged.
#[test]
fn a_ring() {
    let found = run(&ring(0.03), Name::Ring, 12, None, &|| false).unwrap();
    assert!(found.converged && found.good, "{:?}", found.warnings);
    for (name, truth) in [
        ("diameter", 12.0),
        ("width", 5.0),
        ("asymmetry", 0.4),
        ("position_angle", 145.0),
        ("center_x", 0.7),
        ("center_y", -1.1),
        ("flux", 3.0),
    ] {
        let estimate = found.estimates.iter().find(|e| e.name == name).unwrap();
        assert!((estimate.mean - truth).abs() < 5.0 * estimate.sd, "{estimate:?}");
        assert!(estimate.q025 < estimate.q16 && estimate.q16 < estimate.q84 && estimate.q84 < estimate.q975);
    }
    // Noise as it was put in, to five of its own errors.
    let noise = found.estimates.iter().find(|e| e.name == "noise").unwrap();
    let peak = ring(0.0).values.iter().copied().fold(0.0, f64::max);
    assert!((noise.mean / peak - 0.03).abs() < 5.0 * noise.sd / peak, "{noise:?}");
}

/// What is no ring is not fitted well, and says so.
#[test]
fn stripes_are_no_ring() {
    let values = (0..784).map(|p| if (p % 28) / 4 % 2 == 0 { 1.0 } else { 0.1 }).collect();
    let found = run(&Image { values, size: [28; 2], pixel: None }, Name::Ring, 3, None, &|| false).unwrap();
    assert!(!found.good && found.warnings[0].starts_with("poor fit"), "{:?}", found.warnings);
}

/// A cat's head with its eyes and two rings are no ring, and the fits say so.
#[test]
fn other_pictures_are_no_ring() {
    let lit = |light: &dyn Fn(f64, f64) -> bool| -> Vec<f64> {
        let value = |k: u32| f64::from(u8::from(light(f64::from(k % 28) - 13.5, 13.5 - f64::from(k / 28))));
        (0..784).map(value).collect()
    };
    let cat = lit(&|x, y| {
        let ear = (1.0..8.0).contains(&x.abs()) && y > 0.0 && y < 5.0 + 1.2 * (x.abs() - 1.0);
        (x.hypot(y + 3.0) < 8.5 || ear) && (x.abs() - 3.5).hypot(y + 1.5) > 1.6
    });
    let two = lit(&|x, y| ((x.abs() - 6.5).hypot(y) - 4.0).abs() < 1.2);
    for (name, values) in [("a cat", cat), ("two rings", two)] {
        let found =
            run(&Image { values, size: [28; 2], pixel: None }, Name::Ring, 3, None, &|| false).unwrap();
        assert!(!found.good && found.warnings[0].starts_with("poor fit"), "{name}: {:?}", found.warnings);
    }
}

/// What cannot be fitted is refused.
#[test]
fn nothing_to_fit() {
    let image = |values: Vec<f64>| Image { values, size: [28; 2], pixel: None };
    let refused = |image| run(&image, Name::Ring, 3, None, &|| false).unwrap_err();
    assert_eq!(refused(image(vec![0.0; 784])), FitError::Constant(0.0));
    let mut values = ring(0.0).values;
    values[28 + 5] = f64::NAN;
    assert_eq!(refused(image(values)), FitError::NotFinite { count: 1, column: 5, row: 1 });
    let small = Image { values: vec![1.0; 49], size: [7; 2], pixel: None };
    assert_eq!(refused(small), FitError::Small(7, 7));
}

/// Rounds in memory.
#[derive(Default)]
struct Memory(Mutex<Vec<(u64, Vec<u8>)>>);

impl Keeper for Memory {
    fn kept(&self, round: u64) -> Option<Vec<u8>> {
        self.0
            .lock()
            .unwrap()
            .iter()
            .find(|(number, _)| *number == round)
            .map(|(_, contents)| contents.clone())
    }

    fn keep(&self, round: u64, contents: &[u8]) -> Result<(), String> {
        self.0.lock().unwrap().push((round, contents.to_vec()));
        Ok(())
    }
}

/// The draws are the same for any number of threads, and after an interruption.
#[test]
fn draws_are_reproducible() {
    let image = ring(0.05);
    let within = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(&image, Name::Ring, 3, None, &|| false)).unwrap()
    };
    let (one, three) = (within(1), within(3));
    assert_eq!(one.draws, three.draws);
    let memory = Memory::default();
    let kept = || memory.0.lock().unwrap().len();
    // Stopped once three rounds are kept.
    let stopped = run(&image, Name::Ring, 3, Some(&memory), &|| kept() >= 3);
    assert_eq!(stopped.unwrap_err(), FitError::Cancelled);
    assert_eq!(kept(), 3);
    let resumed = run(&image, Name::Ring, 3, Some(&memory), &|| false).unwrap();
    assert_eq!(resumed.draws, one.draws);
    assert_eq!(resumed.estimates, one.estimates);
}

/// A disk without noise, drawn four times finer than it is fitted: spin to 1e-3, inclination to 0.05°.
#[test]
fn a_disk_without_noise() {
    let finer = Fineness { lines: 1280, step: 0.0075, bend: 0.015, ..Fineness::default() };
    let source = Disk::new(Kind::PageThorne, true, Projection::Angular, finer);
    let values = [0.7, 52.0, 200.0, 0.9, 0.4, -0.7, 1000.0, 1.0, f64::INFINITY, 0.0, 1.0, 0.0];
    let found =
        run(&picture(Box::new(source), &values, 32, 0.0), Name::PageThorne, 3, None, &|| false).unwrap();
    let at = |name: &str| found.estimates.iter().find(|e| e.name == name).unwrap();
    assert!(found.good, "{:?}", found.warnings);
    assert!((at("spin").mode - 0.7).abs() < 1e-3, "{:?}", at("spin"));
    assert!((at("inclination").mode - 52.0).abs() < 0.05, "{:?}", at("inclination"));
    assert!((at("position_angle").mode - 200.0).abs() < 0.05, "{:?}", at("position_angle"));
    assert!((at("scale").mode / 0.9 - 1.0).abs() < 2e-3, "{:?}", at("scale"));
}
