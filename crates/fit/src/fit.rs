//! From a picture to what is known of its parameters.

use thiserror::Error;

use crate::chains::{CHAINS, Chains, Draws, Field, ROUND};
use crate::coordinates::Coordinates;
use crate::likelihood::{Noise, Posterior};
use crate::mode::{Mode, climb};
use crate::model::{Freedom, Prediction, Source};
use crate::noise;
use crate::observed::Observed;
use crate::search::modes;
use crate::summary::Estimate;
use crate::valley::follow;
use crate::verdict::{self, Seen};

/// A picture to fit.
#[derive(Clone, Debug)]
pub struct Image {
    /// Means over the pixels, along the rows, the top one first.
    pub values: Vec<f64>,
    /// Width and height.
    pub size: [usize; 2],
    /// Angle of a pixel on the sky, µas, if it is known.
    pub pixel: Option<f64>,
}

/// How a fit is done.
pub struct Options<'a> {
    /// What is known of each parameter of the model, in their order.
    pub freedoms: Vec<Freedom>,
    /// Standard deviation of each pixel's noise; none if it is to be found.
    pub noise: Option<f64>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Rounds of [`ROUND`] draws of each chain at most. Fewer are enough when the aim is reached.
    pub rounds: u64,
    /// What is called converged: R̂ below the first, more effective draws than the second; [`AIM`] where there is no other.
    pub aim: (f64, f64),
    /// Where to begin, besides where the model itself would: all parameters.
    pub starts: Vec<Vec<f64>>,
    /// Is told what is being done.
    pub progress: &'a (dyn Fn(&str) + Sync),
    /// Is told what is known by then.
    pub interim: Option<&'a (dyn Fn(Interim<'_>) + Sync)>,
    /// Whether to stop.
    pub cancelled: &'a (dyn Fn() -> bool + Sync),
    /// Keeps a round of chains under its number; and gives what was kept.
    pub keeper: Option<&'a dyn Keeper>,
}

/// What is known of a fit before its end.
#[derive(Clone, Copy, Debug)]
pub enum Interim<'a> {
    /// The model's picture where the posterior is highest, along the rows.
    Best(&'a [f64]),
    /// What the draws so far say of each parameter.
    Estimates(&'a [Estimate]),
}

/// What keeps rounds of chains, so that an interrupted fit goes on.
pub trait Keeper: Sync {
    /// What was kept of a round.
    fn kept(&self, round: u64) -> Option<Vec<u8>>;
    /// Keeps a round.
    ///
    /// # Errors
    /// If it cannot.
    fn keep(&self, round: u64, contents: &[u8]) -> Result<(), String>;
}

/// Convergence that is usually aimed at: R̂, and the effective number of draws.
pub const AIM: (f64, f64) = (1.01, 400.0);

/// Why there is no fit.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FitError {
    /// The picture is the same everywhere.
    #[error("all pixels of the picture are {0}: there is nothing to fit")]
    Constant(f64),
    /// There are too few pixels.
    #[error("the picture has {0} × {1} pixels: 8 × 8 at least are needed")]
    Small(usize, usize),
    /// A pixel is not a number.
    #[error(
        "{count} pixels are not finite numbers, the first of them in column {column}, row {row}, counted from the top left"
    )]
    NotFinite {
        /// How many.
        count: usize,
        /// Its column.
        column: usize,
        /// Its row.
        row: usize,
    },
    /// Nothing of it is lit before something dark, or there are no edges.
    #[error("{0}")]
    NoSilhouette(String),
    /// The model has no picture near the data.
    #[error(
        "no parameters were found with which the model has a picture: fix some, or give priors; from nearby, --fix outer=R below 0.8 of r"
    )]
    NoStart,
    /// It was stopped.
    #[error("stopped")]
    Cancelled,
    /// What is kept could not be written.
    #[error("{0}")]
    Keeper(String),
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Fit {
    /// All parameters, then what follows from them.
    pub estimates: Vec<Estimate>,
    /// Whether chains became one and are worth enough draws.
    pub converged: bool,
    /// What is to be minded.
    pub warnings: Vec<String>,
    /// Whether the model describes the picture.
    pub good: bool,
    /// Σ (d − m)²/σ² where the posterior is highest.
    pub chi2: f64,
    /// Pixels less free parameters.
    pub degrees: usize,
    /// The share of the picture's variance that is explained.
    pub explained: f64,
    /// Logarithm of the evidence by the Gaussian around the best mode, constants of the likelihood included.
    pub evidence: f64,
    /// Evaluations of the model.
    pub evaluations: usize,
    /// The picture where the posterior is highest.
    pub best: Prediction,
    /// Standard deviation of each pixel's error there.
    pub errors: Vec<f64>,
    /// Draws: for each chain, for each draw, all free parameters.
    pub draws: Vec<Vec<Vec<f64>>>,
    /// Their names and units.
    pub free: Vec<(String, String)>,
    /// Logarithm of the posterior's density of each draw.
    pub logs: Vec<Vec<f64>>,
    /// Trajectories that went astray.
    pub diverged: usize,
}

/// Models of three finenesses: to look around with, for noisy pictures, and for all others.
pub trait Models: Sync {
    /// The light.
    fn source(&self, fineness: usize) -> Box<dyn Source>;

    /// What is assumed of a picture's errors, the standard deviation of its pixels' noise being known or not.
    fn noise(&self, image: &Image, known: Option<f64>) -> Noise {
        noise::assume(&image.values, image.size, known)
    }

    /// What the best picture tells of the errors: none if nothing new.
    fn revised(&self, _image: &Image, _best: &[f64]) -> Option<Noise> {
        None
    }

    /// Standard deviation of what the model need not explain.
    fn level(&self, image: &Image) -> f64 {
        noise::estimate(&image.values, image.size)
    }
}

/// Noise above this share of the brightest pixel lets a coarser model do.
const NOISY: f64 = 0.01;

/// Rounds of draws of a model that does not describe the picture: more tell nothing.
const POOR_ROUNDS: u64 = 2;

/// Fits a model to a picture.
///
/// # Errors
/// If there is nothing to fit, or it was stopped.
pub fn fit(image: &Image, models: &dyn Models, options: &Options<'_>) -> Result<Fit, FitError> {
    check(image)?;
    let peak = noise::peak(&image.values);
    let assumed = models.noise(image, options.noise);
    let level = options.noise.unwrap_or_else(|| noise::estimate(&image.values, image.size));
    let fineness = if level > NOISY * peak { 1 } else { 2 };
    let model = Observed::new(models.source(fineness), image.size);
    let sizes: Vec<f64> = model
        .parameters()
        .iter()
        .map(|p| if p.name == "flux" { image.values.iter().map(|v| v.abs()).sum::<f64>() } else { peak })
        .collect();
    let coordinates = Coordinates::new(model.parameters(), &options.freedoms, &sizes);
    let posterior =
        Posterior { model: &model, data: &image.values, noise: &assumed, coordinates: &coordinates };
    (options.progress)("looking for modes");
    let (mut modes, mut evaluations) = modes(image, models, options, &posterior, &sizes)?;
    (options.progress)(&match modes.len() {
        1 => "one mode".to_owned(),
        several => format!("{several} modes compete"),
    });
    let values = &modes[0].evaluation.values;
    let best = model.predict(&values[..model.parameters().len()], false).map_err(|_| FitError::NoStart)?;
    let tell = |known: Interim<'_>| {
        if let Some(interim) = options.interim {
            interim(known);
        }
    };
    tell(Interim::Best(&best.values));
    let revised = models.revised(image, &best.values);
    let assumed = revised.as_ref().unwrap_or(&assumed);
    let posterior =
        Posterior { model: &model, data: &image.values, noise: assumed, coordinates: &coordinates };
    if revised.is_some() {
        let again = |mode: &Mode| climb(&posterior, &mode.place[..posterior.count()], 40, options.cancelled);
        modes = modes.iter().filter_map(again).collect();
        evaluations += modes.iter().map(|mode| mode.evaluations).sum::<usize>();
        modes.sort_by(|a, b| b.evaluation.log.total_cmp(&a.evaluation.log));
        if (options.cancelled)() {
            return Err(FitError::Cancelled);
        }
        if modes.is_empty() {
            return Err(FitError::NoStart);
        }
    }
    for mode in &mut modes {
        let (shear, more) = follow(&posterior, mode, options.cancelled);
        mode.shear = shear;
        evaluations += more;
    }
    let names = names(&model, &coordinates, assumed.unknown.is_some());
    let top = &modes[0].evaluation;
    let best =
        model.predict(&top.values[..model.parameters().len()], false).map_err(|_| FitError::NoStart)?;
    let degrees = image.values.len().saturating_sub(posterior.count());
    let seen = Seen { chi2: top.chi2, degrees, free: names.len(), known_noise: assumed.unknown.is_none() };
    let poor = seen.compare(image, &best.values, models.level(image)).1.is_some();
    let field = Field::new(&posterior, &modes, options.seed, !poor);
    let mut chains = field.begin().ok_or(FitError::NoStart)?;
    let mut all: Vec<Draws> = vec![Draws::default(); CHAINS];
    let mut estimates;
    let mut kept_rounds = 0;
    let most = if poor { options.rounds.min(POOR_ROUNDS) } else { options.rounds };
    loop {
        let draws = round(&field, &mut chains, options)?;
        let [tried, made] = [0, 1].map(|k| draws.iter().map(|d| d.leaps[k]).sum::<usize>());
        evaluations += draws.iter().map(|d| d.evaluations).sum::<usize>();
        for (all, draws) in all.iter_mut().zip(draws) {
            all.places.extend(draws.places);
            all.logs.extend(draws.logs);
            all.diverged += draws.diverged;
        }
        let count = all[0].places.len();
        let share = 100 * made / tried.max(1);
        (options.progress)(&format!(
            "{count} draws of {CHAINS} chains, by {}; {share} % of leaps succeed",
            chains.way()
        ));
        if count < 2 * ROUND {
            continue;
        }
        kept_rounds += 1;
        estimates = summarise(&model, &posterior, &modes[0], &all, image.pixel);
        tell(Interim::Estimates(&estimates));
        let done = estimates.iter().all(|estimate| estimate.converged(options.aim));
        if done || kept_rounds + 1 >= most {
            break;
        }
    }
    let values: Vec<Vec<Vec<f64>>> =
        all.iter().map(|draws| draws.places.iter().map(|q| posterior.values(q)).collect()).collect();
    let mut fit = Fit {
        converged: estimates.iter().all(|estimate| estimate.converged(options.aim)),
        estimates,
        warnings: Vec::new(),
        good: true,
        chi2: top.chi2,
        degrees,
        explained: 0.0,
        evidence: modes[0].evidence(),
        evaluations,
        errors: errors(assumed, &top.values),
        best,
        draws: values
            .iter()
            .map(|chain| chain.iter().map(|v| names.iter().map(|(k, _)| v[*k]).collect()).collect())
            .collect(),
        free: names.into_iter().map(|(_, name)| name).collect(),
        logs: all.iter().map(|draws| draws.logs.clone()).collect(),
        diverged: all.iter().map(|draws| draws.diverged).sum(),
    };
    let known = (model.parameters(), options.freedoms.as_slice());
    verdict::judge(&mut fit, image, known, modes.len(), (models.level(image), options.aim));
    Ok(fit)
}

/// Whether there is something to fit.
pub(crate) fn check(image: &Image) -> Result<(), FitError> {
    let [width, height] = image.size;
    if width < 8 || height < 8 {
        return Err(FitError::Small(width, height));
    }
    let wrong = |value: &&f64| !value.is_finite();
    if let Some(first) = image.values.iter().position(|value| !value.is_finite()) {
        let count = image.values.iter().filter(wrong).count();
        return Err(FitError::NotFinite { count, column: first % width, row: first / width });
    }
    let first = image.values[0];
    if image.values.iter().all(|value| *value == first) { Err(FitError::Constant(first)) } else { Ok(()) }
}

fn errors(noise: &Noise, values: &[f64]) -> Vec<f64> {
    noise.variances(values.last().copied().unwrap_or(0.0)).into_iter().map(f64::sqrt).collect()
}

/// The next round, done or kept.
fn round(
    field: &Field<'_, Box<dyn Source>>,
    chains: &mut Chains,
    options: &Options<'_>,
) -> Result<Vec<Draws>, FitError> {
    let number = chains.rounds;
    let kept = options.keeper.and_then(|keeper| keeper.kept(number));
    if let Some((after, draws)) =
        kept.and_then(|kept| serde_json::from_slice::<(Chains, Vec<Draws>)>(&kept).ok())
    {
        *chains = after;
        return Ok(draws);
    }
    let (after, draws) = field.go_on(chains.clone(), options.cancelled);
    if (options.cancelled)() {
        return Err(FitError::Cancelled);
    }
    if let Some(keeper) = options.keeper {
        let contents = serde_json::to_vec(&(&after, &draws)).map_err(|e| FitError::Keeper(e.to_string()))?;
        keeper.keep(number, &contents).map_err(FitError::Keeper)?;
    }
    *chains = after;
    Ok(draws)
}

/// Numbers, names and units of what is looked for.
fn names(
    model: &Observed<Box<dyn Source>>,
    coordinates: &Coordinates,
    noise: bool,
) -> Vec<(usize, (String, String))> {
    let parameters = model.parameters();
    let mut names: Vec<(usize, (String, String))> = coordinates
        .free()
        .into_iter()
        .map(|k| (k, (parameters[k].name.to_owned(), parameters[k].unit.to_owned())))
        .collect();
    if noise {
        names.push((parameters.len(), ("noise".to_owned(), String::new())));
    }
    names
}

fn summarise(
    model: &Observed<Box<dyn Source>>,
    posterior: &Posterior<'_, Box<dyn Source>>,
    best: &Mode,
    draws: &[Draws],
    pixel: Option<f64>,
) -> Vec<Estimate> {
    let values: Vec<Vec<Vec<f64>>> =
        draws.iter().map(|chain| chain.places.iter().map(|q| posterior.values(q)).collect()).collect();
    let column = |f: &dyn Fn(&Vec<f64>) -> f64| -> Vec<Vec<f64>> {
        values.iter().map(|chain| chain.iter().map(f).collect()).collect()
    };
    let free = posterior.coordinates.free();
    let mode = &best.evaluation.values;
    let mut estimates: Vec<Estimate> = Vec::new();
    for (k, parameter) in model.parameters().iter().enumerate() {
        estimates.push(if free.contains(&k) {
            let turn = (parameter.name == "position_angle").then_some(360.0);
            Estimate::of(parameter.name, parameter.unit, mode[k], &column(&|v| v[k]), turn)
        } else {
            Estimate::fixed(parameter.name, parameter.unit, mode[k])
        });
    }
    if posterior.noise.unknown.is_some() {
        let k = model.parameters().len();
        estimates.push(Estimate::of("noise", "", mode[k], &column(&|v| v[k]), None));
    }
    if let Some(pixel) = pixel {
        let mut more = Vec::new();
        for (k, parameter) in model.parameters().iter().enumerate().filter(|(k, _)| free.contains(k)) {
            // A length on the sky, of what is one in pixels or M.
            let (name, angle): (String, Box<dyn Fn(f64) -> f64>) = match parameter.name {
                "scale" => ("theta_g_uas".to_owned(), Box::new(move |scale| pixel / scale)),
                "diameter" | "width" | "blur" => {
                    (format!("{}_uas", parameter.name), Box::new(move |length| length * pixel))
                }
                _ => continue,
            };
            more.push(Estimate::of(&name, "uas", angle(mode[k]), &column(&|v| angle(v[k])), None));
        }
        estimates.extend(more);
    }
    estimates
}
