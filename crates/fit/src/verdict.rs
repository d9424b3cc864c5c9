//! What is to be minded of a fit, in plain words.

use crate::fit::{Fit, Image};
use crate::model::{Freedom, Parameter};
use crate::noise::peak;
use crate::summary::SPREAD;

/// A model that leaves more of a picture's variance than this, beyond its noise, does not describe it.
const UNEXPLAINED: f64 = 0.05;

/// Residuals this many times the pixels' own noise, and this large a share of the brightest, are the model's fault.
const LARGE: (f64, f64) = (1.5, 0.02);

/// What is seen at all makes the residuals' variance v of n pixels less than the picture's V: −2 Δ ln L = n ln(V/v). In noise alone each
/// parameter finds about 1 of it, and the best of many places more: this for each, and this for all.
const SEEN: (f64, f64) = (4.0, 30.0);

/// A posterior nearly as wide as its prior says nothing.
const WIDE: f64 = 0.8;

/// Adds warnings, and judges whether the model describes the picture.
pub fn judge(
    fit: &mut Fit,
    image: &Image,
    (parameters, freedoms): (&[Parameter], &[Freedom]),
    modes: usize,
    (pixel_noise, aim): (f64, (f64, f64)),
) {
    let mut warnings = Vec::new();
    let seen = Seen {
        chi2: fit.chi2,
        degrees: fit.degrees,
        free: fit.free.len(),
        known_noise: known_noise(fit, freedoms),
    };
    let (explained, fault) = seen.compare(image, &fit.best.values, pixel_noise);
    fit.explained = explained;
    fit.good = fault.is_none();
    warnings.extend(fault);
    if !fit.converged {
        let worst = fit
            .estimates
            .iter()
            .filter(|e| !e.converged(aim))
            .map(|e| {
                let (r, n) = (e.r_hat.unwrap_or(f64::NAN), e.effective.unwrap_or(f64::NAN));
                format!("{} (R̂ {r:.3}, {n:.0} effective draws)", e.name)
            })
            .collect::<Vec<_>>()
            .join(", ");
        warnings.push(format!(
            "chains have not converged to R̂ < {} and {} effective draws for {worst}: give more with --rounds, or fix or bound what \
             cannot be told",
            aim.0, aim.1
        ));
    }
    if modes > 1 {
        warnings.push(format!("{modes} modes compete: look at the chains, not at means alone"));
    }
    for (parameter, freedom) in parameters.iter().zip(freedoms) {
        let Freedom::Free(prior) = freedom else { continue };
        let Some(estimate) = fit.estimates.iter().find(|e| e.name == parameter.name) else { continue };
        let [low, high] = prior.range(parameter.bounds);
        let wide = prior.deviation(parameter.bounds);
        match parameter.name {
            "position_angle" if estimate.sd > SPREAD * 360.0 => warnings.push(
                "the position angle cannot be told: the picture is as good as the same all around, as of a disk seen face-on; nor can it be \
                 told whether that is seen from above or below, at 180° less the inclination"
                    .to_owned(),
            ),
            "spin" if estimate.q025 < 0.0 && estimate.q975 > 0.0 => warnings.push(format!(
                "the sign of the spin cannot be told: 95 % of the posterior lie between {:.3} and {:.3}",
                estimate.q025, estimate.q975
            )),
            _ => {}
        }
        if parameter.name == "distance" && high - estimate.q975 < 0.2 * high {
            // Far away all distances look alike: its range's end is a choice, no fault.
            warnings.push(format!(
                "how far away the observer is cannot be told beyond {:.0} M; --distance gives it where it is known",
                estimate.q025
            ));
            continue;
        }
        if parameter.name != "position_angle" && estimate.sd > WIDE * wide {
            warnings.push(format!(
                "{} is hardly told by the picture: its posterior is as wide as its prior {prior}",
                parameter.name
            ));
        } else if parameter.name != "position_angle" && parameter.name != "inclination" {
            let near = |bound: f64, value: f64| (bound - value).abs() < 0.25 * estimate.sd;
            if near(low, estimate.q025) || near(high, estimate.q975) {
                warnings.push(format!(
                    "{} lies at the end of its range, {low} to {high}: its interval is cut off there",
                    parameter.name
                ));
            }
        }
    }
    for (a, b, correlation) in correlations(fit) {
        warnings.push(format!(
            "{a} and {b} go together (correlation {correlation:.3}): only a combination of both is told"
        ));
    }
    if fit.diverged > 0 {
        warnings.push(format!(
            "{} trajectories went astray: the posterior has corners that draws may miss",
            fit.diverged
        ));
    }
    fit.warnings = warnings;
}

fn known_noise(fit: &Fit, freedoms: &[Freedom]) -> bool {
    !freedoms.is_empty() && fit.estimates.iter().all(|e| e.name != "noise")
}

/// What a picture is compared with a model by, besides its pixels.
pub struct Seen {
    /// Σ (d − m)²/σ².
    pub chi2: f64,
    /// Pixels less free parameters.
    pub degrees: usize,
    /// Free parameters.
    pub free: usize,
    /// Whether σ is known, and χ² thus says something.
    pub known_noise: bool,
}

impl Seen {
    /// The share of a picture's variance that a model explains, and why it does not describe the picture, if it does not.
    pub fn compare(&self, image: &Image, model: &[f64], pixel_noise: f64) -> (f64, Option<String>) {
        let residuals: Vec<f64> = image.values.iter().zip(model).map(|(d, m)| d - m).collect();
        let n = residuals.len() as f64;
        let mean = image.values.iter().sum::<f64>() / n;
        let variance = image.values.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / n;
        let left = residuals.iter().map(|r| r * r).sum::<f64>() / n;
        let explained = 1.0 - left / variance;
        let beyond = (left - pixel_noise * pixel_noise).max(0.0);
        let alike = neighbours(&residuals, image.size);
        let excess =
            left.sqrt() > LARGE.0 * pixel_noise && left.sqrt() > LARGE.1 * peak(&image.values) && alike > 0.3;
        let degrees = self.degrees as f64;
        let heavy = self.known_noise && self.chi2 > degrees + 6.0 * (2.0 * degrees).sqrt();
        let [found, least] = seen(n, variance, left, self.free);
        let fault = if beyond > UNEXPLAINED * variance || excess || heavy {
            Some(format!(
                "poor fit: the model leaves {:.1} % of the picture's variance, {:.1} % of it beyond the noise, and residuals of \
                 neighbouring pixels go together (correlation {alike:.2}); χ² is {:.0} for {} degrees of freedom. Its numbers describe \
                 no such picture: do not use them",
                100.0 * left / variance,
                100.0 * beyond / variance,
                self.chi2,
                self.degrees,
            ))
        } else if !(found > least) {
            Some(format!(
                "poor fit: the model explains {:.1} % of the picture's variance, no more than its {} free parameters may find in noise \
                 (n ln(V/v) is {found:.0}, and has to be above {least:.0}). Nothing like the model is seen: do not use its numbers",
                100.0 * explained,
                self.free,
            ))
        } else {
            None
        };
        (explained, fault)
    }
}

/// How much of what is there to see n pixels show, n ln(V/v), and how much it has to be.
fn seen(n: f64, variance: f64, left: f64, free: usize) -> [f64; 2] {
    [n * (variance / left.max(f64::MIN_POSITIVE)).ln(), SEEN.0 * free as f64 + SEEN.1]
}

/// Correlation of residuals with those to the right and below.
fn neighbours(residuals: &[f64], [width, height]: [usize; 2]) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for row in 0..height - 1 {
        for column in 0..width - 1 {
            let here = residuals[row * width + column];
            product +=
                0.5 * here * (residuals[row * width + column + 1] + residuals[(row + 1) * width + column]);
            square += here * here;
        }
    }
    if square > 0.0 { product / square } else { 0.0 }
}

/// Pairs of parameters that determine each other.
fn correlations(fit: &Fit) -> Vec<(String, String, f64)> {
    // Angles are counted from the first draw.
    let column = |k: usize| -> Vec<f64> {
        let all: Vec<f64> = fit.draws.iter().flatten().map(|draw| draw[k]).collect();
        let first = all.first().copied().unwrap_or(0.0);
        let turn = |x: f64| (x - first + 540.0).rem_euclid(360.0) - 180.0;
        if fit.free[k].0 == "position_angle" { all.into_iter().map(turn).collect() } else { all }
    };
    let columns: Vec<Vec<f64>> = (0..fit.free.len()).map(column).collect();
    let standard: Vec<Vec<f64>> = columns
        .iter()
        .map(|column| {
            let mean = column.iter().sum::<f64>() / column.len() as f64;
            let sd = (column.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / column.len() as f64).sqrt();
            column.iter().map(|x| (x - mean) / sd).collect()
        })
        .collect();
    let mut pairs = Vec::new();
    for a in 0..standard.len() {
        for b in 0..a {
            let count = standard[a].len() as f64;
            let correlation: f64 =
                standard[a].iter().zip(&standard[b]).map(|(x, y)| x * y).sum::<f64>() / count;
            if correlation.abs() > 0.98 {
                pairs.push((fit.free[b].0.clone(), fit.free[a].0.clone(), correlation));
            }
        }
    }
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eight parameters that each take one standard deviation from the noise of 28 × 28 pixels see nothing; a ring twelve times as bright as its
    /// own error is seen.
    #[test]
    fn noise_and_a_faint_ring() {
        let [found, least] = seen(784.0, 1.0, 1.0 - 8.0 / 784.0, 8);
        assert!(found < least && (found - 8.04).abs() < 0.01, "{found} {least}");
        let [found, least] = seen(784.0, 1.0 + 144.0 / 784.0, 1.0, 8);
        assert!(found > least, "{found} {least}");
        let [found, least] = seen(784.0, 1.0, 1.2, 8);
        assert!(!(found > least));
    }
}
