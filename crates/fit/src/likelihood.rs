//! How well parameters explain a picture.
//!
//! Pixels are independent Gaussians: ln L = −½ Σ (d − m)²/σ² − Σ ln σ, σ² = known² + s² unknown². Where the noise is known there is no
//! unknown part; else s is a parameter, `noise`, with a density of 1/σ: in ln s it goes with the mean over the pixels of the unknown
//! part's share of σ², and so ends where the known part is all there is.

use nalgebra::DMatrix;

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
        let variances = self.noise.variances(scale.unwrap_or(0.0));
        let (mut chi2, mut logs, mut spread) = (0.0, 0.0, 0.0);
        let mut pulls = Vec::with_capacity(self.data.len());
        // Fisher's information on ln s, the curvature in it where residuals are smaller than what is known of the errors explains, and
        // the gradient.
        let (mut information, mut small, mut rise, mut bend) = (0.0, 0.0, 0.0, 0.0);
        for (pixel, (datum, value)) in self.data.iter().zip(&prediction.values).enumerate() {
            let (variance, known) = (variances[pixel], self.noise.known[pixel]);
            let residual = datum - value;
            let square = residual * residual / variance;
            chi2 += square;
            logs += variance.ln();
            pulls.push(residual / variance);
            let share = 1.0 - known * known / variance;
            rise += share * (square - 1.0);
            information += 2.0 * share * share;
            small += 2.0 * share * (share * square + (1.0 - share) * (1.0 - square));
            spread += share;
            bend += 2.0 * share * (1.0 - share);
        }
        information = small.max(information);
        let likelihood = -0.5 * (chi2 + logs);
        let mut log = likelihood + place.prior;
        if let (Some(unknown), Some(q)) = (&self.noise.unknown, q.last()) {
            if unknown.spread.is_infinite() && spread > 0.0 {
                log += (spread / self.data.len() as f64).ln();
                rise += bend / spread;
                information += 2.0 * bend / self.data.len() as f64;
            }
            log -= 0.5 * (q / unknown.spread).powi(2);
            rise -= q / unknown.spread.powi(2);
            information += unknown.spread.powi(-2);
        }
        if !log.is_finite() {
            return None;
        }
        let mut values = place.values.clone();
        values.extend(scale);
        let mut evaluation = Evaluation {
            log,
            likelihood,
            gradient: Vec::new(),
            curvature: DMatrix::zeros(0, 0),
            chi2,
            values,
        };
        if ask != Ask::Value {
            let columns = place.chain(&prediction.derivatives);
            evaluation.gradient = columns
                .iter()
                .zip(&place.gradient)
                .map(|(column, prior)| column.iter().zip(&pulls).map(|(c, p)| c * p).sum::<f64>() + prior)
                .collect();
            if scale.is_some() {
                evaluation.gradient.push(rise);
            }
            if ask == Ask::Curvature {
                evaluation.curvature =
                    self.curvature(&columns, &place, &variances, information.max(0.1 * spread));
            }
        }
        Some(evaluation)
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
