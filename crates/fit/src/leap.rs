//! Leaps: proposals of places from around all modes, and between them short random walks and draws of the noise alone.
//!
//! Proposals are drawn in coordinates that are straight between bounds, again and again until one lies within them, so that their density
//! is the same there but for a constant. A place and its mirror image (of a blur below 0) are one: both are proposed alike.

use rand::RngExt;
use rand_distr::{ChiSquared, Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use crate::chains::{Chain, Draws, Field};
use crate::likelihood::Ask;
use crate::metric::Metric;
use crate::mode::Mode;
use crate::model::Source;
use crate::nuts::State;

/// Degrees of freedom of proposals.
const FREEDOM: f64 = 8.0;

/// Leaps for a draw.
const LEAPS: usize = 2;

/// How often a place within all bounds is looked for.
const ATTEMPTS: usize = 1000;

/// How probable modes are, if each were a Gaussian.
pub fn weights(modes: &[Mode]) -> Vec<f64> {
    let logs: Vec<f64> = modes.iter().map(Mode::evidence).collect();
    let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // None is so improbable that it is never tried.
    let weights: Vec<f64> = logs.iter().map(|log| (log - top).exp().max(0.02)).collect();
    let sum: f64 = weights.iter().sum();
    weights.iter().map(|weight| weight / sum).collect()
}

impl<S: Source> Field<'_, S> {
    /// A mode's number, by its weight.
    pub(crate) fn chosen(&self, rng: &mut Pcg64Mcg) -> usize {
        let mut rest: f64 = rng.random();
        let reached = self.around.iter().position(|(_, weight)| {
            rest -= weight;
            rest <= 0.0
        });
        reached.unwrap_or(0)
    }

    /// Draws by leaps and random walks.
    pub(crate) fn leaps(
        &self,
        metric: &Metric,
        chain: &mut Chain,
        count: usize,
        rng: &mut Pcg64Mcg,
        cancelled: &(dyn Fn() -> bool + Sync),
    ) -> Draws {
        let mut draws = Draws::default();
        for _ in 0..count {
            if cancelled() {
                break;
            }
            for _ in 0..LEAPS {
                draws.leaps[0] += 1;
                draws.leaps[1] += usize::from(self.leap(metric, chain, rng));
            }
            self.wander(metric, chain, rng);
            self.reckon(metric, chain, rng);
            draws.evaluations += LEAPS + 1;
            draws.places.push(chain.place.clone());
            draws.logs.push(chain.state.log);
        }
        draws
    }

    /// A step of a random walk, of the size that suits a Gaussian (Roberts, Gelman & Gilks 1997), or a fifth of it.
    fn wander(&self, metric: &Metric, chain: &mut Chain, rng: &mut Pcg64Mcg) {
        let n = chain.state.z.len() as f64;
        let size = 2.38 / n.sqrt() * if rng.random::<bool>() { 1.0 } else { 0.2 };
        let z = chain.state.z.iter();
        let z: Vec<f64> = z.map(|z| z + size * Distribution::<f64>::sample(&StandardNormal, rng)).collect();
        let chance: f64 = rng.random();
        let Some(to) = metric.outside(&z) else { return };
        // The walk is even in z.
        let volumes = metric.volume(&to) - metric.volume(&chain.place);
        if let Some(found) = self.posterior.at(&to, Ask::Value)
            && chance.ln() < found.log - chain.state.log + volumes
        {
            chain.state = State { z, log: found.log, gradient: Vec::new() };
            chain.place = to;
            chain.residuals = found.residuals;
        }
    }

    /// Draws the noise anew for the picture as it is: where the model's own errors explain most of the residuals it may be anything
    /// below them, far from the other proposals.
    fn reckon(&self, metric: &Metric, chain: &mut Chain, rng: &mut Pcg64Mcg) {
        if chain.residuals.is_empty()
            && let Some(found) = self.posterior.at(&chain.place, Ask::Value)
        {
            chain.residuals = found.residuals;
        }
        if let Some(last) = chain.place.last_mut()
            && let Some((q, change)) = self.posterior.noise_given(&chain.residuals, *last, rng)
        {
            *last = q;
            let z = metric.inside(&chain.place).as_slice().to_vec();
            chain.state = State { z, log: chain.state.log + change, gradient: Vec::new() };
        }
    }

    /// Tries to change to a place that is drawn from around all modes. A new place has no gradient yet.
    pub(crate) fn leap(&self, metric: &Metric, chain: &mut Chain, rng: &mut Pcg64Mcg) -> bool {
        let Some(to) = (0..ATTEMPTS).find_map(|_| self.proposed(metric, rng)) else { return false };
        let chance: f64 = rng.random();
        let Some(found) = self.posterior.at(&to, Ask::Value) else { return false };
        let mut from = chain.place.clone();
        self.posterior.coordinates.near(&mut from, &self.modes[0].place);
        let gain = found.log - chain.state.log + self.density(metric, &from) - self.density(metric, &to);
        let accepted = chance.ln() < gain;
        if accepted {
            let z = metric.inside(&to).as_slice().to_vec();
            chain.state = State { z, log: found.log, gradient: Vec::new() };
            chain.place = to;
            chain.residuals = found.residuals;
        }
        accepted
    }

    /// A place from around a mode, if it lies within all bounds.
    fn proposed(&self, metric: &Metric, rng: &mut Pcg64Mcg) -> Option<Vec<f64>> {
        let number = self.chosen(rng);
        let stretch = ChiSquared::new(FREEDOM)
            .map_or(1.0, |chi| (FREEDOM / Distribution::<f64>::sample(&chi, rng).max(1e-3)).sqrt());
        let z: Vec<f64> = (0..self.posterior.count())
            .map(|_| stretch * Distribution::<f64>::sample(&StandardNormal, rng))
            .collect();
        let mirrored = rng.random::<bool>();
        let mut to = self.shape(metric, number).outside(&z)?;
        // Places that differ by whole turns are one: those within half a turn of the best mode stand for all.
        let mut within = to.clone();
        self.posterior.coordinates.near(&mut within, &self.modes[0].place);
        if within != to {
            return None;
        }
        if let Some(k) = self.posterior.coordinates.even().filter(|_| mirrored) {
            to[k] = -to[k];
        }
        Some(to)
    }

    /// What leaps around a mode are shaped by: the only mode has the shape that draws have shown.
    fn shape<'b>(&'b self, metric: &'b Metric, number: usize) -> &'b Metric {
        if self.around.len() == 1 { metric } else { &self.around[number].0 }
    }

    /// The logarithm of the density of proposals over the coordinates, but for a constant: Σ w_k t(y_k) |dy_k/dq|, of a place and
    /// its mirror image.
    fn density(&self, metric: &Metric, q: &[f64]) -> f64 {
        let mut places = vec![q.to_vec()];
        if let Some(k) = self.posterior.coordinates.even() {
            let mut image = q.to_vec();
            image[k] = -image[k];
            places.push(image);
        }
        let mut logs = Vec::new();
        for place in &places {
            for (number, (_, weight)) in self.around.iter().enumerate() {
                let shape = self.shape(metric, number);
                let square = shape.inside(place).norm_squared();
                let student = -0.5 * (FREEDOM + q.len() as f64) * (1.0 + square / FREEDOM).ln();
                logs.push(weight.ln() + student - shape.volume(place));
            }
        }
        let top = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        top + logs.iter().map(|log| (log - top).exp()).sum::<f64>().ln()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chains::CHAINS;
    use crate::coordinates::Coordinates;
    use crate::likelihood::{Noise, Posterior};
    use crate::mode::climb;
    use crate::model::{Cancelled, Freedom, Parameter, Prediction, Source, Unpredictable};
    use crate::observed::Observed;
    use crate::prior::Prior;

    /// Pixels: a share, what is left of a sum once thrice the share is subtracted, and the square of a blur.
    struct CutOff;

    impl Source for CutOff {
        fn parameters(&self) -> Vec<Parameter> {
            let parameter = |name, bounds, prior| Parameter {
                name,
                unit: "",
                meaning: "",
                bounds,
                pixels: 0,
                usual: Freedom::Free(prior),
            };
            let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
            vec![
                parameter("share", [0.0, 1.0], Prior::Uniform(0.0, 1.0)),
                parameter("sum", everywhere, Prior::Uniform(everywhere[0], everywhere[1])),
                parameter("blur", [0.0, 8.0], Prior::Uniform(0.0, 3.0)),
            ]
        }

        fn draw(&self, values: &[f64], _: [usize; 2], _: bool) -> Result<Prediction, Unpredictable> {
            let [share, sum, blur] = [values[0], values[1], values[2]];
            Ok(Prediction {
                values: vec![share, sum - 3.0 * share, blur * blur],
                derivatives: vec![vec![1.0, -3.0, 0.0], vec![0.0, 1.0, 0.0], vec![0.0, 0.0, 2.0 * blur]],
            })
        }

        fn starts(&self, _: &[f64], _: [usize; 2], _: Cancelled<'_>) -> Vec<Vec<f64>> {
            Vec::new()
        }

        fn finished(&self) -> bool {
            true
        }
    }

    /// ∫ x p dx/∫ p dx.
    fn mean(to: f64, log: impl Fn(f64) -> f64) -> f64 {
        let sums = (0..20_000).fold([0.0; 2], |[m, n], k| {
            let x = to * (f64::from(k) + 0.5) / 20_000.0;
            let p = log(x).exp();
            [m + x * p, n + p]
        });
        sums[0] / sums[1]
    }

    /// Of a Gaussian cut off half a deviation below its top, of a sum that follows it to a hundredth of its width, and of a blur that
    /// may be 0: most leaps succeed, and means are those of quadrature within five standard errors.
    #[test]
    fn to_the_bounds() {
        let model = Observed::new(CutOff, [3, 1]);
        let freedoms: Vec<Freedom> = model.parameters().iter().map(|p| p.usual).collect();
        let coordinates = Coordinates::new(model.parameters(), &freedoms, &[1.0, 1.0, 1.0]);
        let noise = Noise { known: vec![0.1, 1e-3, 0.1], unknown: None };
        let data = [1.05, 0.0, 0.02];
        let posterior = Posterior { model: &model, data: &data, noise: &noise, coordinates: &coordinates };
        let mode = climb(&posterior, &coordinates.of(&[0.8, 2.0, 0.4]), 100, &|| false).unwrap();
        let modes = [mode];
        let field = Field::new(&posterior, &modes, 5, true);
        let mut chains = field.begin().unwrap();
        let (mut values, mut leaps) = (Vec::new(), [0; 2]);
        for _ in 0..40 {
            let (next, draws) = field.go_on(chains, &|| false);
            chains = next;
            for draw in draws {
                leaps = [leaps[0] + draw.leaps[0], leaps[1] + draw.leaps[1]];
                values.extend(draw.places.iter().map(|q| posterior.values(q)));
            }
        }
        assert_eq!(chains.way(), "leaps");
        assert!(values.len() > 37 * CHAINS * 50 - 1 && 2 * leaps[1] > leaps[0], "{leaps:?}");
        let expected = [
            mean(1.0, |x| -0.5 * ((x - 1.05) / 0.1).powi(2)),
            mean(3.0, |x| -0.5 * ((x * x - 0.02) / 0.1).powi(2)),
        ];
        let count = values.len() as f64;
        for (k, expected) in [(0, expected[0]), (1, 3.0 * expected[0]), (2, expected[1])] {
            let mean = values.iter().map(|v| v[k]).sum::<f64>() / count;
            let square = values.iter().map(|v| (v[k] - mean).powi(2)).sum::<f64>() / count;
            // A draw is worth a half at least.
            let error = 5.0 * (2.0 * square / count).sqrt();
            assert!((mean - expected).abs() < error, "{k}: {mean} {expected} ± {error}");
        }
    }
}
