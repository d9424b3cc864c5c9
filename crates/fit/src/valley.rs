//! The valley of a posterior along the observer's distance, where it is long.
//!
//! Of a disk that is seen from above, for one, pictures hardly tell the distance: it may be anything from some hundred M on, while the
//! others are known to 1e-5 for each distance. So narrow a valley, so long, is no straight line in 1/r either.

use crate::likelihood::Posterior;
use crate::mode::{Mode, climb_holding};
use crate::model::{Cancelled, Source};
use crate::shear::Shear;

/// Standard deviation of the distance's coordinate from which a valley is long: a tenth of the distance.
const LONG: f64 = 0.1;

/// How much less probable the ends of a valley are than its middle; what is less probable still is lost.
const END: f64 = 10.0;
const LOST: f64 = 30.0;

/// Steps to each end at most: half as long after one that was lost, else longer by this.
const STEPS: usize = 24;
const LONGER: f64 = 1.5;

/// The first step, as a share of 1/r at the mode, and the shortest, as a share of 1/r there.
const FIRST: f64 = 0.2;
const SHORT: f64 = 0.05;

/// Evaluations at a step at most.
const MOST: usize = 12;

/// The shear of a mode led along its valley, if that is long, and evaluations that this took.
pub fn follow<S: Source>(
    posterior: &Posterior<'_, S>,
    mode: &Mode,
    cancelled: Cancelled<'_>,
) -> (Option<Shear>, usize) {
    let Some(mut shear) = mode.shear.clone() else { return (None, 0) };
    let d = shear.index();
    if mode.factor.inverse()[(d, d)].sqrt() < LONG {
        return (Some(shear), 0);
    }
    let mut evaluations = 0;
    for way in [-1.0, 1.0] {
        let (mut u, mut step) = (shear.u(), way * FIRST * shear.u());
        for _ in 0..STEPS {
            if step.abs() < SHORT * u {
                break;
            }
            let Some(start) = shear.valley(u + step) else {
                // Beyond the distance's bounds.
                step *= 0.5;
                continue;
            };
            let found = climb_holding(posterior, &start, Some(d), MOST, cancelled);
            let deep = found.as_ref().map_or(f64::INFINITY, |f| mode.evaluation.log - f.evaluation.log);
            evaluations += found.as_ref().map_or(1, |found| found.evaluations);
            let Some(next) = found.and_then(|found| found.shear).filter(|_| deep < LOST) else {
                step *= 0.5;
                continue;
            };
            shear.lead_through(&next);
            u += step;
            step *= LONGER;
            if deep > END {
                break;
            }
        }
    }
    (Some(shear), evaluations)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinates::Coordinates;
    use crate::likelihood::Noise;
    use crate::mode::climb;
    use crate::model::{Freedom, Parameter, Prediction, Unpredictable};
    use crate::observed::Observed;
    use crate::prior::Prior;

    /// Two pixels: what is left of a sum once it follows a bent line in 1/r, and 1/r itself.
    struct Bent;

    fn line(u: f64) -> [f64; 2] {
        [1.0 + 40.0 * u - 2e4 * u * u, 40.0 - 4e4 * u]
    }

    impl Source for Bent {
        fn parameters(&self) -> Vec<Parameter> {
            let parameter = |name, low, usual| Parameter {
                name,
                unit: "",
                meaning: "",
                bounds: [low, f64::INFINITY],
                pixels: 0,
                usual: Freedom::Free(usual),
            };
            vec![
                parameter("sum", f64::NEG_INFINITY, Prior::Normal(1.0, 1.0)),
                parameter("distance", 0.0, Prior::LogUniform(40.0, 1e4)),
            ]
        }

        fn draw(&self, values: &[f64], _: [usize; 2], _: bool) -> Result<Prediction, Unpredictable> {
            let u = values[1].recip();
            let [middle, rate] = line(u);
            let slope = -u * u;
            let values = vec![values[0] - middle, u];
            Ok(Prediction { values, derivatives: vec![vec![1.0, 0.0], vec![-rate * slope, slope]] })
        }

        fn starts(&self, _: &[f64], _: [usize; 2], _: Cancelled<'_>) -> Vec<Vec<f64>> {
            Vec::new()
        }

        fn finished(&self) -> bool {
            true
        }
    }

    /// A valley 1e-5 wide, from some 330 M to the prior's end: where it is followed to, the line lies in its middle.
    #[test]
    fn to_both_ends() {
        let model = Observed::new(Bent, [2, 1]);
        let freedoms: Vec<Freedom> = model.parameters().iter().map(|p| p.usual).collect();
        let coordinates = Coordinates::new(model.parameters(), &freedoms, &[1.0, 1.0]);
        let noise = Noise { known: vec![1e-5, 5e-4], unknown: None };
        let data = [0.0, 1e-3];
        let posterior = Posterior { model: &model, data: &data, noise: &noise, coordinates: &coordinates };
        let start = coordinates.of(&[1.02, 1000.0]);
        let mode = climb(&posterior, &start, 100, &|| false).unwrap();
        let (shear, _) = follow(&posterior, &mode, &|| false);
        let shear = shear.unwrap();
        for r in [350.0, 500.0, 1000.0, 3000.0, 9000.0] {
            let found = coordinates.at(&shear.valley(1.0 / r).unwrap()).values;
            let off = found[0] - line(1.0 / r)[0];
            assert!(off.abs() < 5e-6, "{r}: {off}");
        }
        // A straight line would leave it by many of its widths.
        let straight = mode.shear.unwrap();
        let found = coordinates.at(&straight.valley(1.0 / 350.0).unwrap()).values;
        assert!((found[0] - line(1.0 / 350.0)[0]).abs() > 1e-3);
    }
}
