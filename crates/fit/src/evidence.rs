//! The evidence for a value of a parameter, such as that with which a spacetime is Kerr's, against all of the others that its prior allows.
//!
//! Of two models, one of which is the other at θ = θ₀, the Bayes factor is the density of the posterior at θ₀ over that of the prior
//! (Dickey 1971, Ann. Math. Statist. 42, 204: the Savage–Dickey ratio), if nothing else is assumed differently:
//!
//! ```text
//! K = p(d | θ = θ₀)/p(d | θ free) = p(θ₀ | d)/π(θ₀).
//! ```
//!
//! K > 1 speaks for θ₀. It depends on the prior: one that is ten times wider makes it ten times larger. It is the prior as stated that
//! counts; where the metric forbids some of it for other parameters, what is forbidden is counted as allowed.

use std::f64::consts::PI;

use serde::Serialize;

use crate::fit::Fit;
use crate::model::{Freedom, Parameter};
use crate::prior::Prior;

/// What a fit says of a value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Test {
    /// The parameter.
    pub name: String,
    /// The value.
    pub null: f64,
    /// How many standard deviations of the posterior its mean is away from the value.
    pub deviations: f64,
    /// The share of the posterior on the other side of the value than its mean, twice: 1 in the middle, 0 far off.
    pub tail: f64,
    /// ln K, above 0 where the picture speaks for the value; only a bound from above where no draw lies beyond it.
    pub ln_bayes: f64,
    /// Standard deviation of that, from how far chains differ; none for a bound.
    pub error: Option<f64>,
    /// ln K if the posterior were a Gaussian of its mean and deviation: all that is known of it far from all draws.
    pub gaussian: f64,
}

/// The number of effective draws that one may be wrong about: with 95 %, no more than 3/n lies where none of n draws does.
const UNSEEN: f64 = 3.0;

/// Tests a value of a parameter that was free; none if it was not, or the value has no density before.
pub fn test(
    fit: &Fit,
    parameters: &[Parameter],
    freedoms: &[Freedom],
    name: &str,
    null: f64,
) -> Option<Test> {
    let at = parameters.iter().position(|parameter| parameter.name == name)?;
    let Some(Freedom::Free(prior)) = freedoms.get(at) else { return None };
    let column = fit.free.iter().position(|(free, _)| free == name)?;
    let estimate = fit.estimates.iter().find(|estimate| estimate.name == name)?;
    let chains: Vec<Vec<f64>> =
        fit.draws.iter().map(|chain| chain.iter().map(|draw| draw[column]).collect()).collect();
    let range = prior.range(parameters[at].bounds);
    let before = density(prior, range, null)?;
    let all: Vec<f64> = chains.iter().flatten().copied().collect();
    let effective = estimate.effective.unwrap_or(1.0).clamp(1.0, all.len() as f64);
    let below = all.iter().filter(|value| **value < null).count() as f64 / all.len() as f64;
    let deviations = (estimate.mean - null) / estimate.sd;
    let tail = 2.0 * if deviations > 0.0 { below } else { 1.0 - below };
    let (lowest, highest) =
        all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(*value), b.max(*value)));
    let gap = (lowest - null).max(null - highest);
    // Silverman's width, which follows the smaller of both measures of spread; the draws are as good as so many.
    let spread = estimate.sd.min((estimate.q84 - estimate.q16) / 2.0);
    let width = 1.06 * spread * effective.powf(-0.2);
    let (ln_bayes, error) = if gap > width && null > range[0] && null < range[1] {
        // Beyond the outermost draw the density falls: at the value it is below the mean of all up to there.
        ((UNSEEN / effective / gap / before).ln(), None)
    } else {
        let each: Vec<f64> = chains.iter().map(|chain| kernel(chain, range, null, width)).collect();
        let mean = each.iter().sum::<f64>() / each.len() as f64;
        let variance =
            each.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (each.len() as f64 - 1.0).max(1.0);
        // At least that of as many draws within a kernel.
        let counted = (effective * mean * width * 2.0 * PI.sqrt()).max(1.0);
        let error = (variance.sqrt() / mean / (each.len() as f64).sqrt()).max(counted.sqrt().recip());
        if mean > 0.0 && error < 1.0 {
            ((mean / before).ln(), Some(error))
        } else {
            ((UNSEEN / effective / gap.max(width) / before).ln(), None)
        }
    };
    let gaussian = -0.5 * deviations * deviations - (estimate.sd * (2.0 * PI).sqrt() * before).ln();
    Some(Test { name: name.to_owned(), null, deviations, tail: tail.min(1.0), ln_bayes, error, gaussian })
}

/// Points at which a prior is added up.
const COUNT: u32 = 20_000;

/// The prior's density, whose integral over its range is one; none outside, or where the range is infinite.
fn density(prior: &Prior, [low, high]: [f64; 2], x: f64) -> Option<f64> {
    if !(x >= low && x <= high) {
        return None;
    }
    if let Prior::LogUniform(..) = prior {
        return (low > 0.0 && high.is_finite() && low < high).then(|| 1.0 / (x * (high / low).ln()));
    }
    let [from, to] = match *prior {
        Prior::Normal(mean, deviation) => {
            [low.max(mean - 10.0 * deviation), high.min(mean + 10.0 * deviation)]
        }
        _ => [low, high],
    };
    if !(from.is_finite() && to.is_finite() && from < to) {
        return None;
    }
    let step = (to - from) / f64::from(COUNT);
    let sum: f64 = (0..COUNT).map(|k| prior.log(from + step * (f64::from(k) + 0.5))[0].exp() * step).sum();
    let value = prior.log(x)[0].exp() / sum;
    (value > 0.0 && value.is_finite()).then_some(value)
}

/// The density of draws at a place, by Gaussians that are mirrored at the ends of the range.
fn kernel(draws: &[f64], [low, high]: [f64; 2], x: f64, width: f64) -> f64 {
    let bell = |z: f64| (-0.5 * z * z).exp();
    let sum: f64 = draws
        .iter()
        .map(|draw| {
            let mirrored = [low, high].into_iter().filter(|end| end.is_finite()).map(|end| 2.0 * end - draw);
            bell((x - draw) / width) + mirrored.map(|image| bell((x - image) / width)).sum::<f64>()
        })
        .sum();
    sum / (draws.len() as f64 * width * (2.0 * PI).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::summary::Estimate;
    use rand::SeedableRng;
    use rand_distr::{Distribution, StandardNormal};

    /// A fit whose posterior of one parameter is a Gaussian, cut off where it is asked.
    fn fit(mean: f64, sd: f64, least: f64) -> Fit {
        let mut rng = rand_pcg::Pcg64Mcg::seed_from_u64(3);
        let mut draw = || loop {
            let z: f64 = StandardNormal.sample(&mut rng);
            if mean + sd * z >= least {
                return mean + sd * z;
            }
        };
        let chains: Vec<Vec<f64>> = (0..4).map(|_| (0..1000).map(|_| draw()).collect()).collect();
        Fit {
            estimates: vec![Estimate::of("charge", "", mean, &chains, None)],
            converged: true,
            warnings: Vec::new(),
            good: true,
            chi2: 0.0,
            degrees: 1,
            explained: 1.0,
            evidence: 0.0,
            evaluations: 1,
            best: crate::model::Prediction::default(),
            errors: Vec::new(),
            draws: chains.iter().map(|chain| chain.iter().map(|x| vec![*x]).collect()).collect(),
            free: vec![("charge".to_owned(), String::new())],
            logs: Vec::new(),
            diverged: 0,
        }
    }

    fn found(fit: &Fit, prior: Prior, null: f64) -> Option<Test> {
        let parameter = Parameter {
            name: "charge",
            unit: "",
            meaning: "",
            bounds: [f64::NEG_INFINITY, f64::INFINITY],
            pixels: 0,
            usual: Freedom::Fixed(0.0),
        };
        test(fit, &[parameter], &[Freedom::Free(prior)], "charge", null)
    }

    /// K of Gaussian posteriors, whose density is known, at the middle, at two deviations, and at the end of a prior.
    #[test]
    fn ratios_of_gaussians() {
        let bell = |z: f64| (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
        for (prior, before) in [(Prior::Uniform(-5.0, 5.0), 0.1), (Prior::Normal(0.0, 2.0), bell(0.0) / 2.0)]
        {
            for mean in [0.0, 0.4] {
                let test = found(&fit(mean, 0.2, f64::NEG_INFINITY), prior, 0.0).unwrap();
                let expected = (bell(mean / 0.2) / 0.2 / before).ln();
                let error = test.error.unwrap();
                assert!((test.ln_bayes - expected).abs() < 0.15 + 3.0 * error, "{test:?} {expected}");
                assert!((test.deviations - mean / 0.2).abs() < 0.1, "{test:?}");
                assert!((test.gaussian - expected).abs() < 0.15, "{test:?} {expected}");
            }
        }
        // Half of a Gaussian, at its top.
        let test = found(&fit(0.0, 0.2, 0.0), Prior::Uniform(0.0, 1.0), 0.0).unwrap();
        let expected = (2.0 * bell(0.0) / 0.2).ln();
        assert!((test.ln_bayes - expected).abs() < 0.15 + 3.0 * test.error.unwrap(), "{test:?} {expected}");
    }

    /// Far from all draws there is a bound, and it is above the truth; outside of the prior there is nothing.
    #[test]
    fn what_no_draw_comes_near_is_bounded() {
        let prior = Prior::Uniform(-5.0, 5.0);
        let test = found(&fit(2.0, 0.2, f64::NEG_INFINITY), prior, 0.0).unwrap();
        assert_eq!(test.error, None);
        assert!(test.ln_bayes < -3.0 && test.ln_bayes > -50.0 && test.tail == 0.0, "{test:?}");
        assert!(found(&fit(2.0, 0.2, f64::NEG_INFINITY), prior, 6.0).is_none());
    }
}
