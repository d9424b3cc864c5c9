//! What is assumed of a parameter before the picture is seen.

use std::fmt;
use std::str::FromStr;

/// A density over the values of a parameter, within its bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prior {
    /// Alike between two values.
    Uniform(f64, f64),
    /// Alike in the logarithm between two positive values.
    LogUniform(f64, f64),
    /// A Gaussian of a mean and a standard deviation, cut off at the bounds.
    Normal(f64, f64),
    /// A direction of which nothing is known: inclinations in degrees as sin i, between two of them.
    Isotropic(f64, f64),
}

impl Prior {
    /// The range in which the density is not zero, within the bounds of the parameter.
    pub fn range(&self, [low, high]: [f64; 2]) -> [f64; 2] {
        match *self {
            Self::Uniform(a, b) | Self::LogUniform(a, b) | Self::Isotropic(a, b) => [a.max(low), b.min(high)],
            Self::Normal(..) => [low, high],
        }
    }

    /// The logarithm of the density but for a constant, its derivative, and a positive number near its negative curvature.
    pub fn log(&self, x: f64) -> [f64; 3] {
        match *self {
            Self::Uniform(..) => [0.0; 3],
            Self::LogUniform(..) => [-x.ln(), -1.0 / x, 0.0],
            Self::Normal(mean, deviation) => {
                let z = (x - mean) / deviation;
                [-0.5 * z * z, -z / deviation, deviation.powi(-2)]
            }
            Self::Isotropic(..) => {
                let (sin, cos) = x.to_radians().sin_cos();
                let sin = sin.abs().max(1e-12);
                [sin.ln(), cos / sin * 1f64.to_radians(), (1f64.to_radians() / sin).powi(2)]
            }
        }
    }

    /// Its standard deviation within a range, by quadrature: what a posterior has to be narrower than to say anything.
    pub fn deviation(&self, bounds: [f64; 2]) -> f64 {
        let [low, high] = match *self {
            Self::Normal(mean, deviation) => {
                [bounds[0].max(mean - 8.0 * deviation), bounds[1].min(mean + 8.0 * deviation)]
            }
            _ => self.range(bounds),
        };
        if !(low.is_finite() && high.is_finite()) {
            return f64::INFINITY;
        }
        if let Self::LogUniform(..) = self {
            let width = (high / low).ln();
            let mean = (high - low) / width;
            return (0.5 * (high * high - low * low) / width - mean * mean).max(0.0).sqrt();
        }
        let (mut sum, mut first, mut second) = (0.0, 0.0, 0.0);
        for k in 0..2000 {
            let x = low + (high - low) * (f64::from(k) + 0.5) / 2000.0;
            let weight = self.log(x)[0].exp();
            sum += weight;
            first += weight * (x - low);
            second += weight * (x - low) * (x - low);
        }
        (second / sum - (first / sum).powi(2)).max(0.0).sqrt()
    }

    /// The value below which a share of the density within the bounds lies, 0 < share < 1.
    pub fn quantile(&self, share: f64, bounds: [f64; 2]) -> f64 {
        let [low, high] = self.range(bounds);
        match *self {
            Self::Uniform(..) => low + share * (high - low),
            Self::LogUniform(..) => low * (high / low).powf(share),
            Self::Isotropic(..) => {
                let (from, to) = (low.to_radians().cos(), high.to_radians().cos());
                (from + share * (to - from)).clamp(-1.0, 1.0).acos().to_degrees()
            }
            Self::Normal(mean, deviation) => {
                // By halving within eight deviations: it is needed for starts alone.
                let [low, high] = [low.max(mean - 8.0 * deviation), high.min(mean + 8.0 * deviation)];
                let density = |x: f64| self.log(x)[0].exp();
                let count = 4000;
                let step = (high - low) / f64::from(count);
                let total: f64 = (0..count).map(|k| density(low + (f64::from(k) + 0.5) * step)).sum();
                let mut sum = 0.0;
                for k in 0..count {
                    let x = low + (f64::from(k) + 0.5) * step;
                    sum += density(x);
                    if sum >= share * total {
                        return x;
                    }
                }
                high
            }
        }
    }
}

impl fmt::Display for Prior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Uniform(a, b) => write!(f, "uniform({a}, {b})"),
            Self::LogUniform(a, b) => write!(f, "log-uniform({a}, {b})"),
            Self::Normal(a, b) => write!(f, "normal({a}, {b})"),
            Self::Isotropic(a, b) => write!(f, "isotropic({a}, {b})"),
        }
    }
}

impl FromStr for Prior {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        const FORMS: &str =
            "give uniform(FROM, TO), log-uniform(FROM, TO), normal(MEAN, DEVIATION) or isotropic(FROM, TO)";
        let inner = text.trim().strip_suffix(')').and_then(|text| text.split_once('('));
        let Some((name, numbers)) = inner else { return Err(format!("{text:?} is no prior: {FORMS}")) };
        // What is no number fails below.
        let numbers: Vec<f64> =
            numbers.split(',').map(|number| number.trim().parse().unwrap_or(f64::NAN)).collect();
        let [a, b] = numbers[..] else { return Err(format!("{text:?} has not two numbers: {FORMS}")) };
        let (prior, sound, rule) = match name.trim() {
            "uniform" => (Self::Uniform(a, b), a < b, "the second number has to be the larger one"),
            "log-uniform" => (Self::LogUniform(a, b), 0.0 < a && a < b, "both have to be above 0 and grow"),
            "normal" => (Self::Normal(a, b), b > 0.0, "the deviation has to be above 0"),
            "isotropic" => (
                Self::Isotropic(a, b),
                0.0 <= a && a < b && b <= 180.0,
                "both are degrees from 0 to 180, and grow",
            ),
            other => return Err(format!("no prior is called {other:?}: {FORMS}")),
        };
        if sound && a.is_finite() && b.is_finite() { Ok(prior) } else { Err(format!("{text:?}: {rule}")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_densities() {
        for text in ["uniform(0, 0.998)", "log-uniform(0.1, 10)", "normal(1, 0.5)", "isotropic(0, 90)"] {
            let prior: Prior = text.parse().unwrap();
            assert_eq!(prior.to_string(), text);
            let bounds = [0.05, 100.0];
            for share in [0.1, 0.5, 0.8] {
                let x = prior.quantile(share, bounds);
                let h = 1e-5 * x;
                let slope = (prior.log(x + h)[0] - prior.log(x - h)[0]) / (2.0 * h);
                assert!((slope - prior.log(x)[1]).abs() < 1e-6 * (1.0 + slope.abs()), "{text}");
            }
        }
        for text in [
            "uniform(1, 0)",
            "log-uniform(0, 1)",
            "normal(0, 0)",
            "flat(0, 1)",
            "uniform(1)",
            "uniform",
            "normal(0.5x, 3, 4)",
            "normal(x, 3)",
        ] {
            assert!(text.parse::<Prior>().is_err(), "{text}");
        }
        assert!((Prior::Uniform(0.0, 1.0).deviation([-1.0, 2.0]) - 12f64.powf(-0.5)).abs() < 1e-6);
        assert!((Prior::LogUniform(1e-4, 1e3).deviation([1e-4, 1e3]) / 164.838_760_263 - 1.0).abs() < 1e-9);
        assert!((Prior::Normal(3.0, 0.5).deviation([-9.0, 9.0]) - 0.5).abs() < 1e-6);
        assert!((Prior::Isotropic(0.0, 180.0).quantile(0.5, [0.0, 180.0]) - 90.0).abs() < 1e-9);
    }
}
