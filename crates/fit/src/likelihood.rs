//! How well parameters explain a picture.
//!
//! Pixels are independent Gaussians: ln L = −½ Σ (d − m)²/σ² − Σ ln σ, σ² = known² + s² unknown². Where the noise is known there is no
//! unknown part; else s is a parameter, `noise`, with a density of 1/σ: in ln s it goes with the mean over the pixels of the unknown
//! part's share of σ², and so ends where the known part is all there is.

use nalgebra::DMatrix;
use rand::{Rng, RngExt};

use crate::coordinates::Coordinates;
use crate::model::Source;
use crate::observed::Observed;
use crate::place::Place;

/// What is known of the errors of a picture's pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    /// Standard deviation of what is known of each pixel's error.
    pub known: Vec<f64>,
    /// What else there is, but for a common factor s.
    pub unknown: Option<Unknown>,
}

/// Errors of which the size is not known.
#[derive(Clone, Debug, PartialEq)]
pub struct Unknown {
    /// How they are spread over the pixels.
    pub pattern: Vec<f64>,
    /// A first guess of s.
    pub guess: f64,
    /// Standard deviation of ln s about the guess that is assumed; infinite if nothing is, as where s shows in many pixels.
    pub spread: f64,
}

impl Noise {
    /// The variance of each pixel for a factor s.
    pub fn variances(&self, s: f64) -> Vec<f64> {
        match &self.unknown {
            None => self.known.iter().map(|known| known * known).collect(),
            Some(unknown) => {
                let both = self.known.iter().zip(&unknown.pattern);
                both.map(|(known, pattern)| known * known + (s * pattern).powi(2)).collect()
            }
        }
    }
}

/// Widths of a slice at most.
const STEPS: usize = 8;

/// A picture that is compared with a model.
pub struct Posterior<'a, S> {
    /// The model.
    pub model: &'a Observed<S>,
    /// Means over the pixels.
    pub data: &'a [f64],
    /// Their errors.
    pub noise: &'a Noise,
    /// Coordinates of the free parameters.
    pub coordinates: &'a Coordinates,
}

/// What is asked of a place.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Ask {
    /// The density alone.
    Value,
    /// With its gradient.
    Gradient,
    /// With its curvature too.
    Curvature,
}

/// The posterior at a place.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The logarithm of its density over the coordinates, but for a constant.
    pub log: f64,
    /// That of the likelihood alone.
    pub likelihood: f64,
    /// Its gradient; empty if not asked for.
    pub gradient: Vec<f64>,
    /// Fisher's information and the prior's curvature: about minus the second derivatives.
    pub curvature: DMatrix<f64>,
    /// Σ (d − m)²/σ².
    pub chi2: f64,
    /// Parameters, then `noise` if it is one.
    pub values: Vec<f64>,
    /// What the model leaves of each pixel.
    pub residuals: Vec<f64>,
}

/// What residuals say, the noise's ln s being q.
struct Sums {
    /// ln L.
    likelihood: f64,
    /// Σ r²/σ².
    chi2: f64,
    /// The logarithm of the noise's prior over q.
    prior: f64,
    /// The derivative of both in q, and about minus their second derivative.
    rise: f64,
    information: f64,
}

impl<S: Source> Posterior<'_, S> {
    /// Coordinates: those of the parameters, and ln s where the noise is unknown.
    pub fn count(&self) -> usize {
        self.coordinates.count() + usize::from(self.noise.unknown.is_some())
    }

    /// Parameters at coordinates, `noise` the last if it is one.
    pub fn values(&self, q: &[f64]) -> Vec<f64> {
        let mut values = self.coordinates.at(q).values;
        values.extend(self.scale(q));
        values
    }

    /// s.
    fn scale(&self, q: &[f64]) -> Option<f64> {
        self.noise
            .unknown
            .as_ref()
            .map(|unknown| unknown.guess * q.last().map_or(1.0, |q| q.clamp(-40.0, 40.0).exp()))
    }

    /// The posterior at coordinates; none where the model has no picture.
    pub fn at(&self, q: &[f64], ask: Ask) -> Option<Evaluation> {
        if q.iter().any(|q| !q.is_finite()) {
            return None;
        }
        let place = self.coordinates.at(q);
        let prediction = self.model.predict(&place.values, ask != Ask::Value).ok()?;
        let scale = self.scale(q);
        let residuals: Vec<f64> =
            self.data.iter().zip(&prediction.values).map(|(datum, value)| datum - value).collect();
        let variances = self.noise.variances(scale.unwrap_or(0.0));
        let sums = self.sums(&residuals, &variances, q.last().copied().unwrap_or(0.0));
        let log = sums.likelihood + sums.prior + place.prior;
        if !log.is_finite() {
            return None;
        }
        let mut values = place.values.clone();
        values.extend(scale);
        let mut evaluation = Evaluation {
            log,
            likelihood: sums.likelihood,
            gradient: Vec::new(),
            curvature: DMatrix::zeros(0, 0),
            chi2: sums.chi2,
            values,
            residuals,
        };
        if ask != Ask::Value {
            let columns = place.chain(&prediction.derivatives);
            let pulls: Vec<f64> =
                evaluation.residuals.iter().zip(&variances).map(|(residual, v)| residual / v).collect();
            evaluation.gradient = columns
                .iter()
                .zip(&place.gradient)
                .map(|(column, prior)| column.iter().zip(&pulls).map(|(c, p)| c * p).sum::<f64>() + prior)
                .collect();
            if scale.is_some() {
                evaluation.gradient.push(sums.rise);
            }
            if ask == Ask::Curvature {
                evaluation.curvature = self.curvature(&columns, &place, &variances, sums.information);
            }
        }
        Some(evaluation)
    }

    fn sums(&self, residuals: &[f64], variances: &[f64], q: f64) -> Sums {
        let (mut chi2, mut logs, mut spread) = (0.0, 0.0, 0.0);
        // Fisher's information on ln s, the curvature in it where residuals are smaller than what is known of the errors explains, and
        // the gradient.
        let (mut information, mut small, mut rise, mut bend) = (0.0, 0.0, 0.0, 0.0);
        for ((residual, variance), known) in residuals.iter().zip(variances).zip(&self.noise.known) {
            let square = residual * residual / variance;
            chi2 += square;
            logs += variance.ln();
            let share = 1.0 - known * known / variance;
            rise += share * (square - 1.0);
            information += 2.0 * share * share;
            small += 2.0 * share * (share * square + (1.0 - share) * (1.0 - square));
            spread += share;
            bend += 2.0 * share * (1.0 - share);
        }
        information = small.max(information);
        let mut prior = 0.0;
        if let Some(unknown) = &self.noise.unknown {
            if unknown.spread.is_infinite() && spread > 0.0 {
                prior += (spread / residuals.len() as f64).ln();
                rise += bend / spread;
                information += 2.0 * bend / residuals.len() as f64;
            }
            prior -= 0.5 * (q / unknown.spread).powi(2);
            rise -= q / unknown.spread.powi(2);
            information += unknown.spread.powi(-2);
        }
        Sums {
            likelihood: -0.5 * (chi2 + logs),
            chi2,
            prior,
            rise,
            information: information.max(0.1 * spread),
        }
    }

    /// Another ln s/guess, drawn given what the model leaves of each pixel, which costs no picture; and by how much ln p changes: a step
    /// of slice sampling (Neal 2003, Ann. Statist. 31, 705). None where the noise is known.
    pub fn noise_given(&self, residuals: &[f64], q: f64, rng: &mut impl Rng) -> Option<(f64, f64)> {
        self.noise.unknown.as_ref()?;
        let at = |q: f64| self.sums(residuals, &self.noise.variances(self.scale(&[q]).unwrap_or(0.0)), q);
        let here = at(q);
        let log = |q: f64| {
            let sums = at(q);
            sums.likelihood + sums.prior - here.likelihood - here.prior
        };
        let level = (1.0 - rng.random::<f64>()).ln();
        let width = 2.0 / here.information.max(0.1).sqrt();
        let mut low = q - width * rng.random::<f64>();
        let mut high = low + width;
        let before = rng.random_range(0..STEPS);
        for _ in 0..before {
            if log(low) < level {
                break;
            }
            low -= width;
        }
        for _ in before..STEPS - 1 {
            if log(high) < level {
                break;
            }
            high += width;
        }
        loop {
            let next = low + (high - low) * rng.random::<f64>();
            let change = log(next);
            if change >= level {
                return Some((next, change));
            }
            *(if next < q { &mut low } else { &mut high }) = next;
            if high - low < 1e-12 {
                return Some((q, 0.0));
            }
        }
    }

    fn curvature(
        &self,
        columns: &[Vec<f64>],
        place: &Place,
        variances: &[f64],
        information: f64,
    ) -> DMatrix<f64> {
        let n = columns.len();
        let mut matrix = DMatrix::zeros(self.count(), self.count());
        for a in 0..n {
            let weighted: Vec<f64> =
                columns[a].iter().zip(variances).map(|(c, variance)| c / variance).collect();
            for b in 0..=a {
                let sum: f64 = weighted.iter().zip(&columns[b]).map(|(x, y)| x * y).sum();
                matrix[(a, b)] = sum;
                matrix[(b, a)] = sum;
            }
            matrix[(a, a)] += place.curvature[a];
        }
        if self.noise.unknown.is_some() {
            matrix[(n, n)] = information.max(1e-6);
        }
        matrix
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::coordinates::Coordinates;
    use crate::model::{Cancelled, Freedom, Parameter, Prediction, Unpredictable};

    /// A picture of nothing.
    struct Dark;

    impl Source for Dark {
        fn parameters(&self) -> Vec<Parameter> {
            Vec::new()
        }

        fn draw(&self, _: &[f64], [width, height]: [usize; 2], _: bool) -> Result<Prediction, Unpredictable> {
            Ok(Prediction { values: vec![0.0; width * height], derivatives: Vec::new() })
        }

        fn starts(&self, _: &[f64], _: [usize; 2], _: Cancelled<'_>) -> Vec<Vec<f64>> {
            Vec::new()
        }

        fn finished(&self) -> bool {
            true
        }
    }

    /// Draws of the noise alone have the density that the posterior has: shares below some values against quadrature, within five
    /// standard errors of draws that are worth a fifth; of noise that shows, and of residuals that the known part explains alone.
    #[test]
    fn noise_given_a_picture() {
        let model = Observed::new(Dark, [12, 1]);
        let freedoms: [Freedom; 0] = [];
        let coordinates = Coordinates::new(model.parameters(), &freedoms, &[]);
        for (size, spread) in [(3.0, f64::INFINITY), (0.7, 2.0), (0.7, f64::INFINITY)] {
            let data: Vec<f64> = (0..12).map(|k| size * (f64::from(k) * 2.3).sin()).collect();
            let unknown = Unknown { pattern: vec![1.0; 12], guess: 2.0, spread };
            let noise = Noise { known: vec![0.8; 12], unknown: Some(unknown) };
            let posterior =
                Posterior { model: &model, data: &data, noise: &noise, coordinates: &coordinates };
            let here = posterior.at(&[0.0], Ask::Gradient).unwrap();
            let mut rng = Pcg64Mcg::seed_from_u64(11);
            let (mut q, mut log, mut draws) = (0.0, here.log, Vec::new());
            for _ in 0..40_000 {
                let (next, change) = posterior.noise_given(&here.residuals, q, &mut rng).unwrap();
                (q, log) = (next, log + change);
                draws.push(q);
            }
            // The changes sum up to the difference.
            assert!((posterior.at(&[q], Ask::Value).unwrap().log - log).abs() < 1e-8);
            let grid: Vec<(f64, f64)> = (0..6000)
                .map(|k| -12.0 + 0.003 * (f64::from(k) + 0.5))
                .map(|q| (q, (posterior.at(&[q], Ask::Value).unwrap().log - here.log).exp()))
                .collect();
            let all: f64 = grid.iter().map(|(_, p)| p).sum();
            for bound in [-2.0, -1.0, -0.5, 0.0, 0.5] {
                let expected = grid.iter().filter(|(q, _)| *q < bound).map(|(_, p)| p).sum::<f64>() / all;
                let share = draws.iter().filter(|q| **q < bound).count() as f64 / draws.len() as f64;
                let error = 5.0 * (5.0 * expected * (1.0 - expected) / draws.len() as f64).sqrt();
                assert!(
                    (share - expected).abs() < error + 1e-4,
                    "{size} {spread} {bound}: {share} {expected}"
                );
            }
        }
    }
}
