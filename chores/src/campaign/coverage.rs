//! Whether the errors of fits mean what they say: pictures of known parameters are fitted, and the true values are looked for among
//! the draws.
//!
//! Where parameters are drawn from the prior and fits are right, the rank of a true value among the draws of its posterior is uniform
//! (Cook, Gelman & Rubin 2006; Talts et al. 2018).

use std::fmt::Write;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use kerrscope::output::file::write_atomically;
use kerrscope::random::mix;
use kerrscope_fit::fit::{Fit, Image, Models, Options, fit};
use kerrscope_fit::model::Freedom;
use kerrscope_fit::models::Choice;
use kerrscope_fit::traced::{Disk, Fineness, Kind, Projection};
use kerrscope_fit::{Observed, Prior};
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use serde::{Deserialize, Serialize};

use super::ranks::{Band, departure};

/// Fixed before the first run.
const SEED: u64 = 20_261_130;
const RUNS: usize = 100;

/// Pixels along an edge.
const SIZE: usize = 40;

/// Draws of a posterior among which a true value is ranked: few enough to be nearly independent.
const RANKED: usize = 99;

/// Convergence of chains that this needs: R̂, effective draws.
const AIM: (f64, f64) = (1.02, 200.0);

/// The share of runs in which 68 % intervals hold the truth has to lie between: 99 % of binomial numbers of 100 do.
const HELD: [usize; 2] = [56, 79];

/// From what parameters are drawn, and what fits assume of them. The distance is known, 1000 M; the
/// disk begins at the last stable orbit and goes beyond the picture, as `kerrscope fit` assumes. Pictures from below are mirror images
/// of those from above; seen from its own plane a thin disk has no picture.
const PRIORS: [(&str, Prior); 9] = [
    ("spin", Prior::Uniform(-0.998, 0.998)),
    ("inclination", Prior::Isotropic(0.0, 89.0)),
    ("position_angle", Prior::Uniform(0.0, 360.0)),
    ("scale", Prior::LogUniform(0.5, 1.0)),
    ("center_x", Prior::Uniform(-3.0, 3.0)),
    ("center_y", Prior::Uniform(-3.0, 3.0)),
    ("blur", Prior::Uniform(0.0, 3.0)),
    ("flux", Prior::Uniform(500.0, 1500.0)),
    ("background", Prior::Uniform(-0.5, 0.5)),
];

/// Noise, as a share of the brightest pixel.
const NOISE: Prior = Prior::LogUniform(0.015, 0.06);

/// A parameter of one run.
#[derive(Serialize, Deserialize)]
struct Found {
    name: String,
    truth: f64,
    mean: f64,
    sd: f64,
    /// Bounds of the 68 % interval.
    interval: [f64; 2],
    /// Whether they hold the truth.
    held: bool,
    /// The truth's rank among the draws, from 0 to 1, spread within its step.
    rank: f64,
}

#[derive(Serialize, Deserialize)]
struct Run {
    number: usize,
    parameters: Vec<Found>,
    converged: bool,
    good: bool,
    warnings: Vec<String>,
    evaluations: usize,
    seconds: f64,
}

/// Runs what is missing, and ranks; passed if all intervals and curves are as they should be. Runs are kept as lines of one file.
pub fn run(root: &Path) -> Result<(bool, String), String> {
    let file = root.join(format!("reports/coverage-{SEED}.jsonl"));
    let done = Mutex::new(read(&file));
    let next = AtomicUsize::new(0);
    let work = || -> Result<(), String> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|e| e.to_string())?;
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            if number >= RUNS {
                return Ok(());
            }
            if done.lock().map_err(|e| e.to_string())?.iter().any(|run: &Run| run.number == number) {
                continue;
            }
            let run = pool.install(|| one(number))?;
            eprintln!("run {number}: {:.0} s, converged: {}", run.seconds, run.converged);
            let mut done = done.lock().map_err(|e| e.to_string())?;
            done.push(run);
            done.sort_by_key(|run| run.number);
            write(&file, &done)?;
        }
    };
    let fault = std::thread::scope(|scope| {
        // Each fit on a core of its own: its draws are the same for any number of threads.
        let workers: Vec<_> = (0..rayon::current_num_threads()).map(|_| scope.spawn(work)).collect();
        let mut ends =
            workers.into_iter().map(|w| w.join().unwrap_or_else(|_| Err("a run panicked".to_owned())));
        ends.find_map(Result::err)
    });
    match fault {
        Some(fault) => Err(fault),
        None => Ok(report(&done.into_inner().map_err(|e| e.to_string())?)),
    }
}

fn read(file: &Path) -> Vec<Run> {
    let text = std::fs::read_to_string(file).unwrap_or_default();
    text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect()
}

fn write(file: &Path, runs: &[Run]) -> Result<(), String> {
    let lines = runs.iter().map(serde_json::to_string).collect::<Result<Vec<_>, _>>();
    let text = lines.map_err(|e| e.to_string())?.join("\n") + "\n";
    write_atomically(file, |out| out.write_all(text.as_bytes())).map_err(|e| e.to_string())
}

/// One picture, drawn and fitted.
fn one(number: usize) -> Result<Run, String> {
    let start = Instant::now();
    let mut rng = Pcg64Mcg::seed_from_u64(mix(SEED ^ mix(number as u64)));
    // Drawn twice as finely as it is fitted.
    let finer = Fineness { lines: 640, step: 0.015, bend: 0.03, ..Fineness::default() };
    let source = Disk::new(Kind::PageThorne, true, Projection::Angular, finer);
    let model = Observed::new(source, [SIZE; 2]);
    let mut freedoms: Vec<Freedom> = model.parameters().iter().map(|parameter| parameter.usual).collect();
    let mut truth = Vec::new();
    for (parameter, freedom) in model.parameters().iter().zip(&mut freedoms) {
        if let Some((_, prior)) = PRIORS.iter().find(|(name, _)| *name == parameter.name) {
            *freedom = Freedom::Free(*prior);
        }
        if parameter.name == "distance" {
            *freedom = Freedom::Fixed(1000.0);
        }
        truth.push(match freedom {
            Freedom::Fixed(value) => *value,
            Freedom::Free(prior) => prior.quantile(rng.random(), parameter.bounds),
        });
    }
    let mut values = model.predict(&truth, false).map_err(|e| format!("run {number}: {e}"))?.values;
    let peak = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let noise = peak * NOISE.quantile(rng.random(), [0.0, 1.0]);
    for value in &mut values {
        let z: f64 = StandardNormal.sample(&mut rng);
        *value += noise * z;
    }
    truth.push(noise);
    let options = Options {
        freedoms,
        noise: None,
        seed: rng.random(),
        rounds: 60,
        aim: AIM,
        starts: Vec::new(),
        progress: &|_| {},
        interim: None,
        cancelled: &|| false,
        keeper: None,
    };
    let image = Image { values, size: [SIZE; 2], pixel: None };
    let choice = Choice::default();
    let found = fit(&image, &choice as &dyn Models, &options).map_err(|e| format!("run {number}: {e}"))?;
    let names: Vec<&str> = model.parameters().iter().map(|p| p.name).chain(["noise"]).collect();
    let parameters = found.free.iter().enumerate().filter_map(|(column, (name, _))| {
        let k = names.iter().position(|known| known == name)?;
        ranked(&found, column, truth[k], rng.random())
    });
    Ok(Run {
        number,
        parameters: parameters.collect(),
        converged: found.converged,
        good: found.good,
        warnings: found.warnings.clone(),
        evaluations: found.evaluations,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// Where the true value of a free parameter lies among its draws.
fn ranked(found: &Fit, column: usize, truth: f64, share: f64) -> Option<Found> {
    let name = &found.free[column].0;
    let estimate = found.estimates.iter().find(|e| e.name == *name)?;
    // An angle is counted from its mean.
    let turn = |x: f64| {
        if name == "position_angle" { (x - estimate.mean + 540.0).rem_euclid(360.0) - 180.0 } else { x }
    };
    let all: Vec<f64> = found.draws.iter().flatten().map(|draw| turn(draw[column])).collect();
    let below = (0..RANKED).filter(|k| all[k * all.len() / RANKED] < turn(truth)).count();
    let interval = [estimate.q16, estimate.q84];
    Some(Found {
        name: name.clone(),
        truth,
        mean: estimate.mean,
        sd: estimate.sd,
        interval,
        held: turn(interval[0]) <= turn(truth) && turn(truth) <= turn(interval[1]),
        rank: (below as f64 + share) / (RANKED + 1) as f64,
    })
}

fn report(runs: &[Run]) -> (bool, String) {
    let band = Band::new(RUNS, 0.99, SEED);
    let mut body = format!(
        "{RUNS} pictures of {SIZE}² pixels, seed {SEED}, none left out. True values are drawn from the priors that fits assume:\n\n"
    );
    for (name, prior) in PRIORS {
        let _ = writeln!(body, "- {name}: {prior}");
    }
    let _ = writeln!(
        body,
        "- noise: {NOISE} of the brightest pixel; fits are not told, and take 1/σ\n\n\
         The pictures are drawn with lines twice as close as in any fit. A 68 % interval should hold the truth in {} to {} of {RUNS} runs \
         (99 % of binomial numbers); the curve of ranks (the share of runs below each rank, less the rank) should stay within \
         simultaneous 99 % bands (Säilynoja, Bürkner & Vehtari 2022): its departure is the largest share of the half width of the \
         band that it takes, below 1 where it stays inside.\n\n\
         | parameter | 68 % held | departure of the curve | mean (found − true)/sd | its spread |\n|---|---|---|---|---|",
        HELD[0], HELD[1]
    );
    let mut passed = true;
    for name in runs[0].parameters.iter().map(|found| &found.name) {
        let all: Vec<&Found> =
            runs.iter().filter_map(|run| run.parameters.iter().find(|found| found.name == *name)).collect();
        let held = all.iter().filter(|found| found.held).count();
        let ranks: Vec<f64> = all.iter().map(|found| found.rank).collect();
        let out = departure(&band, &ranks);
        passed &= (HELD[0]..=HELD[1]).contains(&held) && out < 1.0 && all.len() == runs.len();
        let pulls: Vec<f64> = all
            .iter()
            .map(|found| {
                let off = found.mean - found.truth;
                let turned =
                    if *name == "position_angle" { (off + 540.0).rem_euclid(360.0) - 180.0 } else { off };
                turned / found.sd
            })
            .collect();
        let mean = pulls.iter().sum::<f64>() / pulls.len() as f64;
        let spread = (pulls.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / pulls.len() as f64).sqrt();
        let _ = writeln!(body, "| {name} | {held} | {out:.2} | {mean:+.2} | {spread:.2} |");
    }
    let count = |test: &dyn Fn(&Run) -> bool| runs.iter().filter(|run| test(run)).count();
    let mut seconds: Vec<f64> = runs.iter().map(|run| run.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let _ = writeln!(
        body,
        "\nConverged (R̂ < {}, {} effective draws): {}; judged to describe the picture: {}. Time of a fit on one core: median {:.0} s, \
         longest {:.0} s.\n\n\
         Each run: true spin, inclination; found.\n\n\
         | run | spin | found | inclination | found | converged | good |\n|---|---|---|---|---|---|---|",
        AIM.0,
        AIM.1,
        count(&|run| run.converged),
        count(&|run| run.good),
        seconds[seconds.len() / 2],
        seconds[seconds.len() - 1]
    );
    for run in runs {
        let of = |name: &str| {
            run.parameters.iter().find(|found| found.name == name).map_or_else(
                || ("?".to_owned(), "?".to_owned()),
                |f| (format!("{:.3}", f.truth), format!("{:.3} ± {:.3}", f.mean, f.sd)),
            )
        };
        let ((spin, spin_found), (tilt, tilt_found)) = (of("spin"), of("inclination"));
        let _ = writeln!(
            body,
            "| {} | {spin} | {spin_found} | {tilt} | {tilt_found} | {} | {} |",
            run.number, run.converged, run.good
        );
    }
    (passed, body)
}
