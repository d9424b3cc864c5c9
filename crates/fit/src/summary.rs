//! What draws say of a parameter.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::diagnostics::{Convergence, quantile};

/// The posterior of one parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// Name.
    pub name: String,
    /// Unit, empty for a number.
    pub unit: String,
    /// Where the posterior is highest.
    pub mode: f64,
    /// Mean.
    pub mean: f64,
    /// Standard deviation; 0 for what is fixed.
    pub sd: f64,
    /// Value below which 2.5 % of the posterior lie.
    pub q025: f64,
    /// 16 %.
    pub q16: f64,
    /// 50 %.
    pub q50: f64,
    /// 84 %.
    pub q84: f64,
    /// 97.5 %.
    pub q975: f64,
    /// Whether it was looked for.
    pub free: bool,
    /// Rank-normalised split R̂ of the chains; none for what is fixed.
    pub r_hat: Option<f64>,
    /// Effective number of draws: the smaller of those for the middle and for the tails.
    pub effective: Option<f64>,
}

/// From this share of a turn on the standard deviation of an angle says that it is hardly told.
pub const SPREAD: f64 = 0.07;

impl Estimate {
    /// Of a parameter that is known.
    pub fn fixed(name: &str, unit: &str, value: f64) -> Self {
        let (name, unit) = (name.to_owned(), unit.to_owned());
        Self {
            name,
            unit,
            mode: value,
            mean: value,
            sd: 0.0,
            q025: value,
            q16: value,
            q50: value,
            q84: value,
            q975: value,
            free: false,
            r_hat: None,
            effective: None,
        }
    }

    /// From the draws of chains. `turn` is the period of an angle: all is then counted from its mean direction, and brought into
    /// [0, turn).
    pub fn of(name: &str, unit: &str, mode: f64, chains: &[Vec<f64>], turn: Option<f64>) -> Self {
        let middle = turn.map_or(0.0, |turn| circular_mean(chains, turn));
        let near = |x: f64| turn.map_or(x, |turn| (x - middle + 1.5 * turn).rem_euclid(turn) - 0.5 * turn);
        let unwrapped: Vec<Vec<f64>> = chains.iter().map(|c| c.iter().map(|x| near(*x)).collect()).collect();
        let mut all: Vec<f64> = unwrapped.iter().flatten().copied().collect();
        all.sort_by(f64::total_cmp);
        let count = all.len() as f64;
        let mean = all.iter().sum::<f64>() / count;
        let sd = (all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
        let back = |x: f64| turn.map_or(x, |turn| (x + middle).rem_euclid(turn));
        let at = |share: f64| back(quantile(&all, share));
        let convergence = match turn {
            // An angle from all around has no ends: its direction is what chains have to agree on.
            Some(turn) if sd > SPREAD * turn => {
                let along = |f: fn(f64) -> f64| {
                    let part = |x: &f64| f(x / turn * TAU);
                    Convergence::of(&chains.iter().map(|c| c.iter().map(part).collect()).collect::<Vec<_>>())
                };
                let [x, y] = [along(f64::cos), along(f64::sin)];
                Convergence {
                    r_hat: x.r_hat.max(y.r_hat),
                    bulk: x.bulk.min(y.bulk),
                    tail: x.tail.min(y.tail),
                }
            }
            _ => Convergence::of(&unwrapped),
        };
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            mode,
            mean: back(mean),
            sd,
            q025: at(0.025),
            q16: at(0.16),
            q50: at(0.5),
            q84: at(0.84),
            q975: at(0.975),
            free: true,
            r_hat: Some(convergence.r_hat),
            effective: Some(convergence.bulk.min(convergence.tail)),
        }
    }

    /// Whether its chains have become one and are worth so many draws.
    pub fn converged(&self, (r_hat, effective): (f64, f64)) -> bool {
        !self.free || (self.r_hat.is_some_and(|r| r < r_hat) && self.effective.is_some_and(|n| n > effective))
    }
}

fn circular_mean(chains: &[Vec<f64>], turn: f64) -> f64 {
    let (mut x, mut y) = (0.0, 0.0);
    for value in chains.iter().flatten() {
        let (sin, cos) = (value / turn * TAU).sin_cos();
        (x, y) = (x + cos, y + sin);
    }
    y.atan2(x) / TAU * turn
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An angle around North is not spread over the circle.
    #[test]
    fn angles_wrap() {
        let chains: Vec<Vec<f64>> = (0..4)
            .map(|c| (0..200).map(|k| f64::from(350 + (k * 7 + c) % 20).rem_euclid(360.0)).collect())
            .collect();
        let found = Estimate::of("position_angle", "deg", 0.0, &chains, Some(360.0));
        assert!((found.mean - 359.5).abs() < 0.6, "{found:?}");
        assert!((found.sd - 5.77).abs() < 0.1 && found.q025 > 349.0 && found.q975 < 10.0, "{found:?}");
    }
}
