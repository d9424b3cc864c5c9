//! Parameters as functions of coordinates, with what they change by and the prior's density.

use crate::prior::Prior;

/// ∂parameter/∂coordinate, for each coordinate the parameters that it changes.
type Slopes = Vec<Vec<(usize, f64)>>;

/// Parameters as functions of coordinates.
#[derive(Clone, Debug)]
pub struct Place {
    /// All parameters, fixed ones too.
    pub values: Vec<f64>,
    /// For each coordinate, the parameters that it changes and by how much.
    pub slopes: Slopes,
    /// The logarithm of the prior's density over the coordinates, but for a constant; with its gradient, and numbers near its
    /// negative curvature along each.
    pub prior: f64,
    /// Its gradient.
    pub gradient: Vec<f64>,
    /// About its negative curvature along each coordinate, at least a little above 0.
    pub curvature: Vec<f64>,
}

/// ln of an angle's prior, its derivative and negative curvature per degree: a Gaussian goes around, all else is alike.
pub fn turned(prior: &Prior, value: f64) -> [f64; 3] {
    match prior {
        Prior::Normal(mean, _) => prior.log(mean + (value - mean + 180.0).rem_euclid(360.0) - 180.0),
        _ => [0.0; 3],
    }
}

impl Place {
    /// A parameter of a coordinate of its own, with the logarithm of ∂value/∂coordinate but for a constant, and of that the derivative and
    /// about the negative curvature.
    pub fn one(&mut self, k: usize, value: f64, slope: f64, prior: Prior, jacobian: [f64; 3]) {
        self.values[k] = value;
        let [log, rate, bend] = prior.log(value);
        self.slopes.push(vec![(k, slope)]);
        self.prior += log + jacobian[0];
        self.gradient.push(rate * slope + jacobian[1]);
        self.curvature.push((bend * slope * slope + jacobian[2]).max(1e-6));
    }

    /// With ρ = |v|: i = 2 atan(ρ/2), sin i di dχ = d²v/(1 + ρ²/4)², so that what is not isotropic of the prior remains.
    pub fn axis(&mut self, k: usize, [x, y]: [f64; 2], [prior, other]: [Prior; 2]) {
        let square = x * x + y * y;
        let reach = square.sqrt();
        let inclination = 2.0 * (0.5 * reach).atan();
        self.values[k] = inclination.to_degrees();
        self.values[k + 1] = y.atan2(x).to_degrees().rem_euclid(360.0);
        let per = (1.0 + 0.25 * square).recip();
        let [cos, sin] = if reach > 0.0 { [x / reach, y / reach] } else { [1.0, 0.0] };
        let (along, around) = (per.to_degrees(), reach.max(1e-9).recip().to_degrees());
        self.slopes.push(vec![(k, along * cos), (k + 1, -around * sin)]);
        self.slopes.push(vec![(k, along * sin), (k + 1, around * cos)]);
        let (mut log, mut rate) = (2.0 * per.ln(), -per * reach);
        let [low, high] = prior.range([0.0, 180.0]);
        // Outside of its range it falls steeply instead of ending.
        let beyond = (low - self.values[k]).max(self.values[k] - high).max(0.0);
        let side = if self.values[k] < low { 1.0 } else { -1.0 };
        log -= 50.0 * beyond * beyond;
        rate += 100.0 * beyond * side * along;
        if !matches!(prior, Prior::Isotropic(..)) {
            let [own, slope, _] = prior.log(self.values[k]);
            // Per solid angle: divided by sin i.
            let (sin_i, cos_i) = inclination.sin_cos();
            let sin_i = sin_i.max(1e-9);
            log += own - sin_i.ln();
            rate += slope * along - cos_i / sin_i * per;
        }
        let [own, slope, bend] = turned(&other, self.values[k + 1]);
        log += own;
        let turn = slope * around;
        self.prior += log;
        self.gradient.extend([rate * cos - turn * sin, rate * sin + turn * cos]);
        let stiff = bend * around * around;
        self.curvature.extend([per + stiff * sin * sin, per + stiff * cos * cos]);
    }

    /// Derivatives with respect to coordinates from those with respect to parameters.
    pub fn chain(&self, derivatives: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let column = |slopes: &Vec<(usize, f64)>| {
            let mut sum = vec![0.0; derivatives.first().map_or(0, Vec::len)];
            for (parameter, slope) in slopes {
                sum.iter_mut().zip(&derivatives[*parameter]).for_each(|(s, d)| *s += slope * d);
            }
            sum
        };
        self.slopes.iter().map(column).collect()
    }
}
