//! Chains of draws from a posterior.
//!
//! Chains begin around the modes, drawn with a wider spread. In posteriors of clear pictures, which are nearly Gaussians, they leap: to
//! places drawn from Student's distributions around all modes (of eight degrees of freedom), accepted by Metropolis & Hastings, and by
//! short random walks between (`leap.rs`); leaps change between modes as often as their weights ask for. Where too few leaps succeed,
//! chains move by the No-U-Turn Sampler, one leap after each trajectory. A leap costs one evaluation of the model, a trajectory some
//! seven with gradients.
//!
//! A round of draws is a function of the round before and of the seed, whatever the number of threads.

use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::leap::weights;
use crate::likelihood::{Ask, Posterior};
use crate::metric::Metric;
use crate::mode::Mode;
use crate::model::Source;
use crate::nuts::{Pace, State, step};

/// Chains.
pub const CHAINS: usize = 4;

/// Draws of the first rounds, which are not kept: three of leaps, between which the draws' own covariance shapes them; and where
/// these fail, three of trajectories.
const TRIED: [usize; 3] = [40, 40, 30];
const WARM: [usize; 3] = [20, 30, 20];

/// The share of leaps of the last of these rounds that have to succeed: where fewer do, chains stay long in the tails.
const LEAPING: f64 = 0.3;

/// As long as fewer than this share succeed, all draws so far shape the next round's, up to this round: proposals that are functions of
/// earlier rounds leave what is drawn from as it is.
const GOOD: f64 = 0.5;
const SHAPED: usize = 10;

/// By how much less than with the best shape so far may succeed before that is gone back to.
const WORSE: f64 = 0.05;

/// Below this share of them, the draws' covariance is none to go on with.
const STUCK: f64 = 0.1;

/// Draws of a round of each chain.
pub const ROUND: usize = 50;

/// Where a chain is.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Chain {
    /// Coordinates.
    pub(crate) place: Vec<f64>,
    /// The same place in the metric, without a gradient where none was asked for.
    pub(crate) state: State,
    /// What the model leaves of each pixel there, where it is known.
    #[serde(skip)]
    pub(crate) residuals: Vec<f64>,
    pace: Pace,
}

/// What a round of a chain gave.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Draws {
    /// Coordinates.
    pub places: Vec<Vec<f64>>,
    /// Logarithm of the posterior's density.
    pub logs: Vec<f64>,
    /// Trajectories that went astray.
    pub diverged: usize,
    /// Evaluations of the model.
    pub evaluations: usize,
    /// Leaps that were tried, and that were accepted.
    pub leaps: [usize; 2],
}

/// All chains after a round.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Chains {
    metric: Metric,
    members: Vec<Chain>,
    /// Whether chains move along trajectories, because leaps fail.
    trajectories: bool,
    /// Rounds done, those that are not kept among them.
    pub rounds: u64,
    /// Draws that leaps are shaped by.
    gathered: Vec<Vec<f64>>,
    /// The shape with which most leaps succeeded, and the share that did.
    best: Option<(f64, Metric)>,
}

impl Chains {
    /// How the chains move.
    pub fn way(&self) -> &'static str {
        if self.trajectories { "trajectories" } else { "leaps" }
    }
}

/// What chains are run over.
pub struct Field<'a, S> {
    pub(crate) posterior: &'a Posterior<'a, S>,
    pub(crate) modes: &'a [Mode],
    /// What leaps around each are shaped by, and how often they lead there.
    pub(crate) around: Vec<(Metric, f64)>,
    seed: u64,
    patient: bool,
}

impl<'a, S: Source> Field<'a, S> {
    /// Of a posterior and its modes, the best first. All random numbers follow from the seed. Where one is not patient, trajectories
    /// are not tried, which take long: where the model describes no such picture.
    pub fn new(posterior: &'a Posterior<'a, S>, modes: &'a [Mode], seed: u64, patient: bool) -> Self {
        let metrics = modes.iter().map(|mode| Metric::between_bounds(mode, posterior.coordinates));
        let around = metrics.zip(weights(modes)).collect();
        Self { posterior, modes, around, seed, patient }
    }

    fn rng(&self, round: u64, chain: usize) -> Pcg64Mcg {
        Pcg64Mcg::seed_from_u64(kerrscope::random::mix(
            self.seed ^ kerrscope::random::mix(round * 64 + chain as u64),
        ))
    }

    /// Chains at their beginnings; none if the model has no picture anywhere near.
    pub fn begin(&self) -> Option<Chains> {
        let (metric, _) = self.around.first()?;
        let smooth: Vec<Metric> = self.modes.iter().map(Metric::around).collect();
        let chains: Option<Vec<Chain>> = (0..CHAINS)
            .into_par_iter()
            .map(|number| {
                let mut rng = self.rng(0, number);
                for attempt in 0..40 {
                    let wide = if attempt < 20 { 1.3 } else { 0.3 };
                    let smooth = &smooth[self.chosen(&mut rng)];
                    let z: Vec<f64> = (0..self.posterior.count())
                        .map(|_| wide * Distribution::<f64>::sample(&StandardNormal, &mut rng))
                        .collect();
                    if let Some(place) = smooth.outside(&z)
                        && let Some(state) = self.state(metric, &place)
                    {
                        return Some(Chain { place, state, residuals: Vec::new(), pace: Pace::new(0.6) });
                    }
                }
                None
            })
            .collect();
        Some(Chains {
            metric: metric.clone(),
            members: chains?,
            trajectories: false,
            rounds: 0,
            gathered: Vec::new(),
            best: None,
        })
    }

    fn state(&self, metric: &Metric, q: &[f64]) -> Option<State> {
        let found = self.posterior.at(q, Ask::Gradient)?;
        let gradient = metric.pull(q, &found.gradient);
        Some(State { z: metric.inside(q).as_slice().to_vec(), log: found.log, gradient })
    }

    /// The next round of all chains, and its draws; those of warming up, which do not count, are empty.
    pub fn go_on(&self, mut chains: Chains, cancelled: &(dyn Fn() -> bool + Sync)) -> (Chains, Vec<Draws>) {
        let round = chains.rounds as usize;
        let warm = if round < TRIED.len() {
            Some(TRIED[round])
        } else if chains.trajectories {
            WARM.get(round - TRIED.len()).copied()
        } else {
            None
        };
        let (metric, trajectories) = (chains.metric.clone(), chains.trajectories);
        let mut draws: Vec<Draws> = chains
            .members
            .par_iter_mut()
            .enumerate()
            .map(|(number, chain)| {
                let mut rng = self.rng(round as u64 + 1, number);
                if trajectories {
                    self.trajectories(&metric, chain, warm, &mut rng, cancelled)
                } else {
                    self.leaps(&metric, chain, warm.unwrap_or(ROUND), &mut rng, cancelled)
                }
            })
            .collect();
        let places = || {
            let mut places: Vec<Vec<f64>> = draws.iter().flat_map(|d| d.places.iter().cloned()).collect();
            let (coordinates, best) = (self.posterior.coordinates, &self.modes[0].place);
            for place in &mut places {
                coordinates.near(place, best);
                *place = coordinates.beside(place, best);
            }
            places
        };
        let [tried, accepted] = [0, 1].map(|k| draws.iter().map(|d| d.leaps[k]).sum::<usize>());
        let share = accepted as f64 / tried.max(1) as f64;
        if trajectories {
            if round == TRIED.len() + 1 {
                let next = metric.shaped_by(&places());
                Self::change(&mut chains, next);
            }
        } else {
            if chains.best.as_ref().is_none_or(|(most, _)| share > *most) {
                chains.best = Some((share, metric.clone()));
            }
            let most = chains.best.as_ref().map_or(0.0, |(most, _)| *most);
            chains.trajectories = self.patient && round + 1 == TRIED.len() && most < LEAPING;
            if chains.trajectories {
                // They need coordinates without an end. Draws that hardly moved have no shape.
                let smooth = Metric::around(&self.modes[0]);
                let next = if most < STUCK { smooth } else { smooth.shaped_by(&chains.gathered) };
                Self::change(&mut chains, next);
            } else if round < SHAPED && (round + 1 < TRIED.len() || share < GOOD) {
                // Chains began wide: the first draws make a first shape alone.
                let shape = if round == 0 {
                    metric.shaped_by(&places())
                } else {
                    chains.gathered.extend(places());
                    metric.shaped_by(&chains.gathered)
                };
                // What draws make of it may be worse: few of them, or a posterior that is no Gaussian.
                let next =
                    chains.best.clone().filter(|_| share < most - WORSE).map_or(shape, |(_, best)| best);
                Self::change(&mut chains, next);
            }
        }
        if warm.is_some() {
            for d in &mut draws {
                *d = Draws { evaluations: d.evaluations, leaps: d.leaps, ..Draws::default() };
            }
        }
        chains.rounds += 1;
        (chains, draws)
    }

    /// Goes over to other coordinates.
    fn change(chains: &mut Chains, next: Metric) {
        for chain in &mut chains.members {
            let z = next.inside(&chain.place).as_slice().to_vec();
            chain.state = State { z, log: chain.state.log, gradient: Vec::new() };
            chain.pace = Pace::new(0.7);
        }
        chains.metric = next;
    }

    /// Draws by trajectories, a leap after each.
    fn trajectories(
        &self,
        metric: &Metric,
        chain: &mut Chain,
        warm: Option<usize>,
        rng: &mut Pcg64Mcg,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Draws {
        let mut draws = Draws::default();
        let mut target = |y: &[f64]| {
            let q = metric.outside(y)?;
            let found = self.posterior.at(&q, Ask::Gradient)?;
            Some((found.log, metric.pull(&q, &found.gradient)))
        };
        for _ in 0..warm.unwrap_or(ROUND) {
            if cancelled() {
                break;
            }
            if chain.state.gradient.is_empty()
                && let Some(state) = self.state(metric, &chain.place)
            {
                chain.state = state;
                draws.evaluations += 1;
            }
            // From a place without a gradient there is no trajectory, and none enters one.
            if !chain.state.gradient.is_empty() {
                let size = if warm.is_some() { chain.pace.size() } else { chain.pace.settled() };
                // Steps of many sizes: trajectories of one length may be periodic.
                let size = size * (0.9 + 0.2 * rng.random::<f64>());
                let (state, step) = step(&mut target, &chain.state, size, rng);
                if let Some(place) = metric.outside(&state.z) {
                    (chain.place, chain.state) = (place, state);
                    chain.residuals.clear();
                }
                if warm.is_some() {
                    chain.pace.learn(step.acceptance);
                }
                draws.evaluations += step.evaluations;
                draws.diverged += usize::from(step.diverged && warm.is_none());
            }
            draws.evaluations += 1;
            draws.leaps[0] += 1;
            draws.leaps[1] += usize::from(self.leap(metric, chain, rng));
            draws.places.push(chain.place.clone());
            draws.logs.push(chain.state.log);
        }
        draws
    }
}
