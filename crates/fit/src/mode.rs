//! The most probable parameters near a start: damped Gauss–Newton steps (Levenberg 1944, Marquardt 1963) up the posterior.
//!
//! The steps are our own because what is climbed is a posterior with priors and an unknown noise, of which libraries for least squares
//! know nothing; coordinates without bounds make the bounded problem a free one.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::likelihood::{Ask, Evaluation, Posterior};
use crate::model::{Cancelled, Source};
use crate::shear::Shear;

/// A maximum of the posterior, and its surroundings as a Gaussian.
#[derive(Clone, Debug)]
pub struct Mode {
    /// Coordinates.
    pub place: Vec<f64>,
    /// The posterior there.
    pub evaluation: Evaluation,
    /// L of LLᵀ = minus the second derivatives, nearly.
    pub factor: Cholesky<f64, Dyn>,
    /// What makes the surroundings more of a Gaussian.
    pub shear: Option<Shear>,
    /// Whether steps had become small.
    pub converged: bool,
    /// How often the model was evaluated.
    pub evaluations: usize,
}

impl Mode {
    /// The logarithm of the evidence if the posterior were the Gaussian around it, but for a constant: ln p + ½ ln det(2π H⁻¹).
    pub fn evidence(&self) -> f64 {
        let n = self.place.len() as f64;
        let half: f64 = self.factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        self.evaluation.log + 0.5 * n * std::f64::consts::TAU.ln() - half
    }
}

/// The factor of a matrix that is made positive where it is not.
pub fn factor(mut matrix: DMatrix<f64>) -> Cholesky<f64, Dyn> {
    let n = matrix.nrows();
    let trace: f64 = (0..n).map(|k| matrix[(k, k)].abs()).sum::<f64>().max(1e-300);
    let mut extra = 0.0;
    loop {
        if let Some(factor) = Cholesky::new(matrix.clone()) {
            return factor;
        }
        // Rounding: what was added grows until it is enough, at the latest when it is all there is.
        let next = if extra == 0.0 { 1e-14 * trace } else { 10.0 * extra };
        for k in 0..n {
            if !matrix[(k, k)].is_finite() {
                matrix = DMatrix::identity(n, n);
                break;
            }
            matrix[(k, k)] += next;
        }
        extra = next;
    }
}

/// What a step has to promise in ln p to be taken: a tenth of a standard deviation.
const ENOUGH: f64 = 5e-3;

/// Climbs from a start; none if the model has no picture there, or it was cancelled. `most` bounds the evaluations.
pub fn climb<S: Source>(
    posterior: &Posterior<'_, S>,
    start: &[f64],
    most: usize,
    cancelled: Cancelled<'_>,
) -> Option<Mode> {
    climb_holding(posterior, start, None, most, cancelled)
}

/// The same with one coordinate kept as it is.
pub fn climb_holding<S: Source>(
    posterior: &Posterior<'_, S>,
    start: &[f64],
    held: Option<usize>,
    most: usize,
    cancelled: Cancelled<'_>,
) -> Option<Mode> {
    let mut place = start.to_vec();
    let mut here = posterior.at(&place, Ask::Curvature)?;
    let mut evaluations = 1;
    let (mut damping, mut converged) = (1e-3, false);
    while evaluations < most {
        if cancelled() {
            return None;
        }
        let mut matrix = here.curvature.clone();
        for k in 0..matrix.nrows() {
            matrix[(k, k)] *= 1.0 + damping;
        }
        let mut gradient = DVector::from_column_slice(&here.gradient);
        if let Some(held) = held {
            matrix.row_mut(held).fill(0.0);
            matrix.column_mut(held).fill(0.0);
            matrix[(held, held)] = 1.0;
            gradient[held] = 0.0;
        }
        let step = factor(matrix).solve(&gradient);
        // What the step should gain.
        let promise = step.dot(&gradient);
        if promise < ENOUGH {
            converged = true;
            break;
        }
        // A coordinate of a bounded parameter does not leap over all of its range.
        let largest = step.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
        let shrink = (3.0 / largest).min(1.0);
        let mut next: Vec<f64> = place.iter().zip(step.iter()).map(|(q, s)| q + shrink * s).collect();
        if let Some(shear) = Shear::about(posterior.coordinates, &place, &here.curvature) {
            shear.bend(&mut next);
        }
        evaluations += 1;
        match posterior.at(&next, Ask::Curvature) {
            Some(there) if there.log > here.log => {
                damping = (damping * 0.2).max(1e-6);
                let gain = there.log - here.log;
                (place, here) = (next, there);
                if gain < 0.1 * ENOUGH && damping < 1e-2 {
                    converged = true;
                    break;
                }
            }
            _ => {
                damping *= 8.0;
                if damping > 1e3 {
                    // No step leads upwards: the top, within what the model's own rounding allows.
                    converged = true;
                    break;
                }
            }
        }
    }
    let factor = factor(here.curvature.clone());
    let shear = Shear::about(posterior.coordinates, &place, &here.curvature);
    Some(Mode { place, evaluation: here, factor, shear, converged, evaluations })
}
