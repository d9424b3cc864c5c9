//! Samples of a posterior by the No-U-Turn Sampler (Hoffman & Gelman 2014), with multinomial choice along the trajectory (Betancourt
//! 2017) and the turn of whole and half trajectories as its end.
//!
//! Its own implementation: the coordinates are already standard deviations of the Gaussian around a mode, so that no mass matrix has
//! to be learnt at length, and some hundred evaluations, all that a picture's model can afford, are enough to begin.

use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

/// A log-density with its gradient.
pub trait Target {
    /// ln p and its gradient; none where it is zero.
    fn at(&mut self, z: &[f64]) -> Option<(f64, Vec<f64>)>;
}

impl<F: FnMut(&[f64]) -> Option<(f64, Vec<f64>)>> Target for F {
    fn at(&mut self, z: &[f64]) -> Option<(f64, Vec<f64>)> {
        self(z)
    }
}

/// A place with its density.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct State {
    /// Coordinates.
    pub z: Vec<f64>,
    /// ln p.
    pub log: f64,
    /// Its gradient.
    pub gradient: Vec<f64>,
}

/// Doublings of a trajectory at most.
const DEPTH: u32 = 7;

/// An error of the energy from which on a trajectory has gone astray.
const ASTRAY: f64 = 200.0;

/// What a step was like.
#[derive(Clone, Copy, Debug, Default)]
pub struct Step {
    /// Mean probability of acceptance.
    pub acceptance: f64,
    /// Evaluations of the target.
    pub evaluations: usize,
    /// Whether the trajectory went astray.
    pub diverged: bool,
}

#[derive(Clone)]
struct Point {
    state: State,
    momentum: Vec<f64>,
}

struct Tree {
    ends: [Point; 2],
    chosen: State,
    /// ln Σ e^{−H}, with respect to the start.
    weight: f64,
    /// Sum of momenta.
    total: Vec<f64>,
    ended: bool,
}

struct Walk<'a, T> {
    target: &'a mut T,
    rng: &'a mut Pcg64Mcg,
    size: f64,
    energy: f64,
    acceptance: f64,
    evaluations: usize,
    diverged: bool,
}

/// One draw, with momenta of unit mass and a step size.
pub fn step<T: Target>(target: &mut T, state: &State, size: f64, rng: &mut Pcg64Mcg) -> (State, Step) {
    let momentum: Vec<f64> = state.z.iter().map(|_| StandardNormal.sample(rng)).collect();
    let start = Point { state: state.clone(), momentum };
    let energy = energy(&start);
    let mut walk = Walk { target, rng, size, energy, acceptance: 0.0, evaluations: 0, diverged: false };
    let mut tree = Tree {
        total: start.momentum.clone(),
        ends: [start.clone(), start],
        chosen: state.clone(),
        weight: 0.0,
        ended: false,
    };
    for depth in 0..DEPTH {
        let side = usize::from(walk.rng.random::<bool>());
        let from = tree.ends[side].clone();
        let next = walk.grow(&from, side, depth);
        if next.ended {
            break;
        }
        // The new half is preferred, so that draws move far.
        if walk.rng.random::<f64>() < (next.weight - tree.weight).exp() {
            tree.chosen = next.chosen.clone();
        }
        tree = join(tree, &next, side);
        if tree.ended {
            break;
        }
    }
    let count = walk.evaluations.max(1) as f64;
    let step =
        Step { acceptance: walk.acceptance / count, evaluations: walk.evaluations, diverged: walk.diverged };
    (tree.chosen, step)
}

/// H = −ln p + ½ p².
fn energy(point: &Point) -> f64 {
    -point.state.log + 0.5 * point.momentum.iter().map(|p| p * p).sum::<f64>()
}

/// Whether a trajectory has begun to come back: ends move against the way gone (Betancourt 2017, A.4.2).
fn turns(total: &[f64], ends: [&Point; 2]) -> bool {
    ends.iter().any(|end| end.momentum.iter().zip(total).map(|(a, b)| a * b).sum::<f64>() <= 0.0)
}

fn join(mut old: Tree, new: &Tree, side: usize) -> Tree {
    let total: Vec<f64> = old.total.iter().zip(&new.total).map(|(a, b)| a + b).collect();
    let (inner_old, inner_new) = (&old.ends[side], &new.ends[1 - side]);
    // Across the seam too.
    let to_seam: Vec<f64> = old.total.iter().zip(&inner_new.momentum).map(|(a, b)| a + b).collect();
    let from_seam: Vec<f64> = new.total.iter().zip(&inner_old.momentum).map(|(a, b)| a + b).collect();
    let seams =
        turns(&to_seam, [&old.ends[1 - side], inner_new]) || turns(&from_seam, [inner_old, &new.ends[side]]);
    old.ends[side] = new.ends[side].clone();
    let ended = new.ended || seams || turns(&total, [&old.ends[0], &old.ends[1]]);
    let top = old.weight.max(new.weight);
    let weight = top + ((old.weight - top).exp() + (new.weight - top).exp()).ln();
    Tree { ends: old.ends, chosen: old.chosen, weight, total, ended }
}

impl<T: Target> Walk<'_, T> {
    /// 2^depth steps on from an end.
    fn grow(&mut self, from: &Point, side: usize, depth: u32) -> Tree {
        if depth == 0 {
            return self.leap(from, side);
        }
        let first = self.grow(from, side, depth - 1);
        if first.ended {
            return first;
        }
        let second = self.grow(&first.ends[side].clone(), side, depth - 1);
        if second.ended {
            return second;
        }
        let chosen = if self.rng.random::<f64>().ln() < second.weight - log_sum(first.weight, second.weight) {
            second.chosen.clone()
        } else {
            first.chosen.clone()
        };
        Tree { chosen, ..join(first, &second, side) }
    }

    /// One leapfrog step.
    fn leap(&mut self, from: &Point, side: usize) -> Tree {
        let size = if side == 1 { self.size } else { -self.size };
        let half: Vec<f64> =
            from.momentum.iter().zip(&from.state.gradient).map(|(p, g)| p + 0.5 * size * g).collect();
        let z: Vec<f64> = from.state.z.iter().zip(&half).map(|(z, p)| z + size * p).collect();
        self.evaluations += 1;
        let (log, gradient) = self.target.at(&z).unwrap_or((f64::NEG_INFINITY, vec![0.0; z.len()]));
        let momentum: Vec<f64> = half.iter().zip(&gradient).map(|(p, g)| p + 0.5 * size * g).collect();
        let point = Point { state: State { z, log, gradient }, momentum };
        let gain = self.energy - energy(&point);
        let gain = if gain.is_finite() { gain } else { f64::NEG_INFINITY };
        self.acceptance += gain.exp().min(1.0);
        let astray = gain < -ASTRAY;
        self.diverged |= astray;
        Tree {
            total: point.momentum.clone(),
            chosen: point.state.clone(),
            ends: [point.clone(), point],
            weight: gain,
            ended: astray,
        }
    }
}

fn log_sum(a: f64, b: f64) -> f64 {
    let top = a.max(b);
    if top == f64::NEG_INFINITY { top } else { top + ((a - top).exp() + (b - top).exp()).ln() }
}

/// The step size that has a mean acceptance, learnt by dual averaging (Hoffman & Gelman 2014, §3.2).
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Pace {
    center: f64,
    error: f64,
    log: f64,
    mean: f64,
    count: f64,
}

/// The mean acceptance that is aimed at.
const ACCEPTANCE: f64 = 0.8;

impl Pace {
    /// Around a first step size.
    pub fn new(size: f64) -> Self {
        Self { center: (2.0 * size).ln(), error: 0.0, log: size.ln(), mean: 0.0, count: 0.0 }
    }

    /// The step size to try next.
    pub fn size(&self) -> f64 {
        self.log.exp()
    }

    /// The one to stay with.
    pub fn settled(&self) -> f64 {
        if self.count > 0.0 { self.mean.exp() } else { self.size() }
    }

    /// Takes note of the acceptance of a draw.
    pub fn learn(&mut self, acceptance: f64) {
        self.count += 1.0;
        let share = 1.0 / (self.count + 10.0);
        self.error = (1.0 - share) * self.error + share * (ACCEPTANCE - acceptance);
        self.log = self.center - self.count.sqrt() / 0.05 * self.error;
        self.log = self.log.clamp(-12.0, 1.5);
        let weight = self.count.powf(-0.75);
        self.mean = weight * self.log + (1.0 - weight) * self.mean;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;

    /// Means and variances of a correlated Gaussian, a cubic fold of it, within five standard errors.
    #[test]
    fn moments_are_known() {
        // x ~ N(1, 4), y | x ~ N(0.5 x², 1).
        let mut target = |z: &[f64]| {
            let (u, v) = ((z[0] - 1.0) / 2.0, z[1] - 0.5 * z[0] * z[0]);
            Some((-0.5 * (u * u + v * v), vec![-0.5 * u + v * z[0], -v]))
        };
        let mut rng = Pcg64Mcg::seed_from_u64(7);
        let (log, gradient) = target(&[1.0, 0.5]).unwrap();
        let mut state = State { z: vec![1.0, 0.5], log, gradient };
        let mut pace = Pace::new(0.5);
        for _ in 0..500 {
            let (next, step) = step(&mut target, &state, pace.size(), &mut rng);
            pace.learn(step.acceptance);
            state = next;
        }
        let (count, mut sums, mut accepted) = (60_000, [0.0; 4], 0.0);
        for _ in 0..count {
            let (next, step) = step(&mut target, &state, pace.settled(), &mut rng);
            accepted += step.acceptance;
            state = next;
            let [x, y] = state.z[..] else { unreachable!() };
            for (sum, value) in sums.iter_mut().zip([x, x * x, y, (y - 0.5 * x * x).powi(2)]) {
                *sum += value / f64::from(count);
            }
        }
        // Draws of x are worth about one in ten here.
        let error = 5.0 * 2.0 / (f64::from(count) / 10.0).sqrt();
        assert!((sums[0] - 1.0).abs() < error, "{sums:?}");
        assert!((sums[1] - 5.0).abs() < 4.0 * error, "{sums:?}");
        assert!((sums[2] - 2.5).abs() < 2.5 * error, "{sums:?}");
        assert!((sums[3] - 1.0).abs() < error, "{sums:?}");
        assert!((accepted / f64::from(count) - ACCEPTANCE).abs() < 0.12, "{accepted}");
    }
}
