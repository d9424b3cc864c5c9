//! How long a likelihood with its gradients takes, and a whole fit.

use std::fmt;
use std::time::Instant;

use kerrscope_fit::fit::{AIM, Image, Models, Options, fit};
use kerrscope_fit::likelihood::{Ask, Noise, Posterior};
use kerrscope_fit::model::{Freedom, Source};
use kerrscope_fit::models::Choice;
use kerrscope_fit::noise::peak;
use kerrscope_fit::traced::{Disk, Fineness, Kind, Projection};
use kerrscope_fit::{Coordinates, Observed, Prior};
use serde::Serialize;

use crate::report::Failure;

/// Pixels along an edge.
const SIZE: usize = 128;

/// M in a pixel: a Page–Thorne disk of a = 0.9 fills the picture.
const SCALE: f64 = 0.24;

/// Evaluations that are timed.
const TIMES: usize = 15;

/// Inclinations of the likelihoods, degrees; and of the fit.
const INCLINATIONS: [f64; 4] = [20.0, 40.0, 60.0, 80.0];
const FITTED: f64 = 60.0;

/// Noise of the pictures, as a share of the brightest pixel.
const NOISE: f64 = 5e-3;

#[derive(Serialize)]
pub struct Likelihood {
    inclination: f64,
    gradients: usize,
    median_ms: f64,
    least_ms: f64,
    most_ms: f64,
    /// The largest difference of a pixel from a picture whose lines lie four times closer, as a share of the brightest.
    pixel_error: f64,
}

#[derive(Serialize)]
pub struct Whole {
    inclination: f64,
    threads: u32,
    wall_s: f64,
    evaluations: usize,
    parameters: usize,
    r_hat: f64,
    effective: f64,
    /// (found − true)/error of the spin and the inclination.
    pulls: [f64; 2],
}

#[derive(Serialize)]
pub struct Fits {
    likelihoods: Vec<Likelihood>,
    fit: Whole,
}

/// The model's parameters at an inclination, `blur`, `flux` and `background` at the end.
fn truth(inclination: f64) -> Vec<f64> {
    let light = [0.9, inclination, 30.0, SCALE, 1.3, -2.1, 1000.0, 1.0, f64::INFINITY];
    light.into_iter().chain([0.0, 1000.0, 0.0]).collect()
}

/// All parameters free but for the edges, which a likelihood has its gradients in all the same.
fn freedoms(model: &Observed<Box<dyn Source>>) -> Vec<Freedom> {
    let known = model.parameters().iter();
    known
        .map(|parameter| match parameter.name {
            "distance" => Freedom::Free(Prior::LogUniform(100.0, 1e5)),
            "inner" => Freedom::Free(Prior::Uniform(1.0, 2.0)),
            "blur" => Freedom::Free(Prior::Uniform(0.0, 4.0)),
            "background" => Freedom::Free(Prior::Normal(0.0, 0.01)),
            _ => parameter.usual,
        })
        .collect()
}

fn picture(inclination: f64) -> Result<Vec<f64>, Failure> {
    let finer = Fineness { lines: 1280, step: 0.0075, bend: 0.015, ..Fineness::default() };
    let source = Disk::new(Kind::PageThorne, true, Projection::Angular, finer);
    Observed::new(source, [SIZE; 2])
        .predict(&truth(inclination), false)
        .map(|prediction| prediction.values)
        .map_err(|e| Failure::Failed(e.to_string()))
}

/// Measures both; the likelihoods on one thread.
pub fn measure(threads: u32) -> Result<Fits, Failure> {
    let pool = |count: u32| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(count as usize)
            .build()
            .map_err(|e| Failure::Failed(format!("no threads: {e}; give fewer with --threads")))
    };
    let one = pool(1)?;
    let likelihoods =
        INCLINATIONS.iter().map(|i| one.install(|| likelihood(*i))).collect::<Result<Vec<_>, _>>()?;
    Ok(Fits { likelihoods, fit: pool(threads)?.install(|| whole(threads))? })
}

fn likelihood(inclination: f64) -> Result<Likelihood, Failure> {
    let data = picture(inclination)?;
    let model = Observed::new(Choice::default().source(2), [SIZE; 2]);
    let values = truth(inclination);
    let nearly = model.predict(&values, false).map_err(|e| Failure::Failed(e.to_string()))?;
    let off = data.iter().zip(&nearly.values).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let sizes = vec![1.0; values.len()];
    let coordinates = Coordinates::new(model.parameters(), &freedoms(&model), &sizes);
    let noise = Noise { known: vec![NOISE * peak(&data); data.len()], unknown: None };
    let posterior = Posterior { model: &model, data: &data, noise: &noise, coordinates: &coordinates };
    let q = coordinates.of(&values);
    let mut times = Vec::new();
    for _ in 0..TIMES {
        let start = Instant::now();
        let found = posterior.at(&q, Ask::Gradient);
        times.push(1e3 * start.elapsed().as_secs_f64());
        if found.is_none() {
            return Err(Failure::Failed(format!("no likelihood at {inclination}°")));
        }
    }
    times.sort_by(f64::total_cmp);
    Ok(Likelihood {
        inclination,
        gradients: coordinates.count(),
        median_ms: times[TIMES / 2],
        least_ms: times[0],
        most_ms: times[TIMES - 1],
        pixel_error: off / peak(&data),
    })
}

/// A fit as `kerrscope fit` does it where the distance is known, of a picture with noise of the sum of twelve even numbers a pixel.
fn whole(threads: u32) -> Result<Whole, Failure> {
    let mut values = picture(FITTED)?;
    let size = NOISE * peak(&values);
    for (pixel, value) in values.iter_mut().enumerate() {
        let even = |k: u64| {
            let word = kerrscope::random::mix(12 * pixel as u64 + k);
            (word >> 11) as f64 / (1_u64 << 53) as f64
        };
        *value += size * ((0..12).map(even).sum::<f64>() - 6.0);
    }
    let image = Image { values, size: [SIZE; 2], pixel: None };
    let choice = Choice::default();
    let model = Observed::new(choice.source(2), image.size);
    let freedoms = model
        .parameters()
        .iter()
        .map(|p| if p.name == "distance" { Freedom::Fixed(1000.0) } else { p.usual })
        .collect();
    let options = Options {
        freedoms,
        noise: None,
        seed: 1,
        rounds: 30,
        aim: AIM,
        starts: Vec::new(),
        progress: &|_| {},
        interim: None,
        cancelled: &|| false,
        keeper: None,
    };
    let start = Instant::now();
    let found = fit(&image, &choice, &options).map_err(|e| Failure::Failed(e.to_string()))?;
    let wall_s = start.elapsed().as_secs_f64();
    let free = || found.estimates.iter().filter(|e| e.free);
    let pull = |name: &str, truth: f64| {
        free().find(|e| e.name == name).map_or(f64::NAN, |e| (e.mean - truth) / e.sd)
    };
    Ok(Whole {
        inclination: FITTED,
        threads,
        wall_s,
        evaluations: found.evaluations,
        parameters: free().count(),
        r_hat: free().filter_map(|e| e.r_hat).fold(0.0, f64::max),
        effective: free().filter_map(|e| e.effective).fold(f64::INFINITY, f64::min),
        pulls: [pull("spin", 0.9), pull("inclination", FITTED)],
    })
}

impl fmt::Display for Fits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "likelihood of {SIZE}² pixels with its gradients, one thread, {TIMES} times")?;
        writeln!(f, "inclination  gradients   median (least to most)   largest error of a pixel")?;
        for l in &self.likelihoods {
            writeln!(
                f,
                "{:>10}°  {:>9}   {:.1} ms ({:.1} to {:.1})   {:.1e} of the brightest",
                l.inclination, l.gradients, l.median_ms, l.least_ms, l.most_ms, l.pixel_error
            )?;
        }
        let Whole { inclination, threads, wall_s, evaluations, parameters, r_hat, effective, pulls } =
            &self.fit;
        write!(
            f,
            "whole fit of {SIZE}² pixels at {inclination}° with noise of {NOISE} of the brightest: {wall_s:.0} s with {threads} threads, \
             {evaluations} evaluations; {parameters} parameters, R̂ at most {r_hat:.4}, {effective:.0} effective draws at least; \
             spin and inclination {:+.1} and {:+.1} of their errors off",
            pulls[0], pulls[1]
        )
    }
}
