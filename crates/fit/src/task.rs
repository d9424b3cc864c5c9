//! A fit from what is asked to what is answered: the one way that the program and the Python package go.

use serde::Serialize;

use crate::Observed;
use crate::evidence::Test;
use crate::fit::{AIM, Fit, FitError, Image, Interim, Keeper, Models, Options, fit};
use crate::model::{Freedom, Parameter};
use crate::models::{Choice, Name};
use crate::question::Question;
use crate::request::Request;
use crate::silhouette::{Silhouette, Silhouettes};
use crate::summary::Estimate;

/// What is asked.
#[derive(Clone, Debug, Default)]
pub struct Task {
    /// The model.
    pub choice: Choice,
    /// What is known of its parameters.
    pub request: Request,
    /// The spacetime that is tested, if it is not Kerr's own.
    pub question: Option<Question>,
    /// Standard deviation of each pixel's noise, if it is known.
    pub noise: Option<f64>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Rounds of draws at most.
    pub rounds: u64,
}

/// What goes on beside a fit: as in [`Options`].
#[derive(Clone, Copy)]
pub struct Watch<'a> {
    /// Is told what is being done.
    pub progress: &'a (dyn Fn(&str) + Sync),
    /// Is told what is known by then.
    pub interim: Option<&'a (dyn Fn(Interim<'_>) + Sync)>,
    /// Whether to stop.
    pub cancelled: &'a (dyn Fn() -> bool + Sync),
    /// Keeps rounds of chains.
    pub keeper: Option<&'a dyn Keeper>,
}

/// Why a task cannot be done with a picture.
#[derive(Debug, thiserror::Error)]
pub enum TaskError {
    /// What is asked is wrong: all faults.
    #[error("{}", .0.join("\n"))]
    Asked(Vec<String>),
    /// The picture has nothing that such a model could be compared with.
    #[error(transparent)]
    Picture(#[from] FitError),
}

/// A task and its picture, ready to be done.
pub struct Ready {
    task: Task,
    image: Image,
    seen: Option<Silhouette>,
    parameters: Vec<Parameter>,
    freedoms: Vec<Freedom>,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The posterior.
    pub fit: Fit,
    /// What it says of Kerr's values of the parameters of another spacetime that were free.
    pub tests: Option<Vec<Test>>,
}

impl Task {
    /// What of the settings does not go together. `spell` says how a setting of a name is written: `--noise`, or `noise`.
    pub fn faults(&self, spell: impl Fn(&str) -> String) -> Vec<String> {
        let mut faults = Vec::new();
        let name = self.choice.name;
        let said = |wanted: &str| self.request.parameters.iter().any(|(name, _)| name == wanted);
        if name != Name::Silhouette && self.choice.orders.is_some() {
            let orders = spell("orders");
            faults.push(format!(
                "{orders} is for silhouettes: choose the model {}, or leave it away",
                Name::Silhouette.name()
            ));
        }
        if name == Name::Silhouette && self.noise.is_some() {
            let noise = spell("noise");
            faults.push(format!("a silhouette has edges alone, whose error is found: leave {noise} away"));
        }
        if let Some(noise) = self.noise
            && !(noise > 0.0 && noise.is_finite())
        {
            faults.push(format!("{} is {noise}, and has to be above 0", spell("noise")));
        }
        if name == Name::Ring && said("distance") {
            faults.push(format!("a ring on the sky has no distance: leave {} away", spell("distance")));
        }
        faults
    }

    /// Takes a picture, and finds what is wrong with the rest of what is asked.
    ///
    /// # Errors
    /// All that is wrong with it.
    pub fn with(mut self, picture: Image) -> Result<Ready, TaskError> {
        let seen = (self.choice.name == Name::Silhouette).then(|| Silhouette::of(&picture)).transpose()?;
        let image = seen.as_ref().map_or(picture, |seen| seen.image.clone());
        let silhouettes = seen.as_ref().map(|seen| Silhouettes::new(seen, self.choice));
        let source = models(&self, silhouettes.as_ref()).source(2);
        let parameters = Observed::new(source, image.size).parameters().to_vec();
        let freedoms = self.request.freedoms(&parameters).map_err(TaskError::Asked)?;
        if let Some(question) = &mut self.question {
            question.seek(&parameters, &freedoms);
        }
        Ok(Ready { task: self, image, seen, parameters, freedoms })
    }
}

/// The models that a task compares pictures with.
fn models<'a>(task: &'a Task, silhouettes: Option<&'a Silhouettes<'a>>) -> &'a dyn Models {
    match (&task.question, silhouettes) {
        (Some(question), _) => &question.tested,
        (None, Some(silhouettes)) => silhouettes,
        (None, None) => &task.choice,
    }
}

impl Ready {
    /// What is fitted: the picture, or what is lit of it.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// What is asked.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Does it, with the threads of the current rayon pool.
    ///
    /// # Errors
    /// As [`fit`].
    pub fn run(&self, watch: &Watch<'_>) -> Result<Found, FitError> {
        let silhouettes = self.seen.as_ref().map(|seen| Silhouettes::new(seen, self.task.choice));
        let options = Options {
            freedoms: self.freedoms.clone(),
            noise: self.task.noise,
            seed: self.task.seed,
            rounds: self.task.rounds,
            aim: AIM,
            starts: silhouettes.as_ref().map_or_else(Vec::new, |s| s.starts(&self.freedoms, watch.cancelled)),
            progress: watch.progress,
            interim: watch.interim,
            cancelled: watch.cancelled,
            keeper: watch.keeper,
        };
        let mut found = fit(&self.image, models(&self.task, silhouettes.as_ref()), &options)?;
        found.warnings.extend(self.seen.iter().flat_map(Silhouette::warnings));
        let answers = |question: &Question| question.answers(&found, &self.parameters, &self.freedoms);
        let tests = self.task.question.as_ref().map(answers);
        Ok(Found { fit: found, tests })
    }
}

/// A fit as JSON has it.
#[derive(Clone, Debug, Serialize)]
pub struct Report<'a> {
    /// The model's name.
    pub model: &'a str,
    /// The spacetime's name, where one was given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spacetime: Option<&'a str>,
    /// All parameters, then what follows from them.
    pub parameters: &'a [Estimate],
    /// What the posterior says of Kerr's values.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tests: Option<&'a [Test]>,
    /// Whether chains became one and are worth enough draws.
    pub converged: bool,
    /// Whether the model describes the picture.
    pub good: bool,
    /// What is to be minded.
    pub warnings: &'a [String],
    /// Σ (d − m)²/σ² where the posterior is highest.
    pub chi2: f64,
    /// Pixels less free parameters.
    pub degrees: usize,
    /// The share of the picture's variance that is explained.
    pub explained: f64,
    /// Logarithm of the evidence.
    pub evidence: f64,
    /// Evaluations of the model.
    pub evaluations: usize,
    /// How long it took, s.
    pub wall_s: f64,
    /// Seed of all random numbers.
    pub seed: u64,
    /// The program's version.
    pub version: &'static str,
}

impl<'a> Report<'a> {
    /// Of what was found for a task in `wall_s` seconds; `spacetime` is the name that was given.
    pub fn of(task: &Task, found: &'a Found, spacetime: Option<&'a str>, wall_s: f64) -> Self {
        let Found { fit, tests } = found;
        Self {
            model: task.choice.name.name(),
            spacetime,
            parameters: &fit.estimates,
            tests: tests.as_deref(),
            converged: fit.converged,
            good: fit.good,
            warnings: &fit.warnings,
            chi2: fit.chi2,
            degrees: fit.degrees,
            explained: fit.explained,
            evidence: fit.evidence,
            evaluations: fit.evaluations,
            wall_s,
            seed: task.seed,
            version: env!("CARGO_PKG_VERSION"),
        }
    }

    /// What files say of the model: its name, and what was fixed.
    pub fn words(&self) -> Vec<(String, String)> {
        let fixed = self.parameters.iter().filter(|e| !e.free).map(|e| (e.name.clone(), e.mode.to_string()));
        std::iter::once(("model".to_owned(), self.model.to_owned())).chain(fixed).collect()
    }
}
