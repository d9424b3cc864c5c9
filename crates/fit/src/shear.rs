//! A shear that straightens the valley along the observer's distance.
//!
//! What a picture looks like from afar goes linearly with u = 1/r; the coordinate of r is a logarithm, in which a distance that hardly
//! shows is one like any other. The other coordinates thus follow a straight line in u: with w the straight coordinates and d the
//! distance's,
//!
//! ```text
//! q_d = w_d,   q_k = w_k + b_k φ(w_d),   φ(w) = u(w) − u(w₀) − u′(w₀) (w − w₀),   b = −H⁻¹_oo H_od / u′(w₀),
//! ```
//!
//! which touches the identity at the place it was made for, and whose determinant is 1.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::coordinates::{Coordinates, Reciprocal};
use crate::mode::factor;

/// The shear about a place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shear {
    distance: Reciprocal,
    /// w₀, u(w₀) and u′(w₀).
    from: [f64; 3],
    /// b, 0 for the distance itself.
    along: Vec<f64>,
}

impl Shear {
    /// About a place with its curvature, minus the second derivatives there; none where no distance is looked for.
    pub fn about(coordinates: &Coordinates, place: &[f64], curvature: &DMatrix<f64>) -> Option<Self> {
        let distance = coordinates.distance()?;
        let (n, d) = (place.len(), distance.index);
        let [u, slope] = distance.at(place[d]);
        if n < 2 || slope == 0.0 {
            return None;
        }
        let others = curvature.clone().remove_row(d).remove_column(d);
        let both = DVector::from_iterator(n - 1, (0..n).filter(|k| *k != d).map(|k| curvature[(k, d)]));
        let turned = factor(others).solve(&both);
        let mut along: Vec<f64> = turned.iter().map(|t| -t / slope).collect();
        along.insert(d, 0.0);
        if along.iter().any(|b| !b.is_finite()) {
            return None;
        }
        Some(Self { distance, from: [place[d], u, slope], along })
    }

    /// φ and its derivative.
    fn bow(&self, w: f64) -> [f64; 2] {
        let [start, u, slope] = self.from;
        let [there, rate] = self.distance.at(w);
        [there - u - slope * (w - start), rate - slope]
    }

    /// From straight coordinates to those of the parameters.
    pub fn bend(&self, place: &mut [f64]) {
        let [bow, _] = self.bow(place[self.distance.index]);
        place.iter_mut().zip(&self.along).for_each(|(q, b)| *q += b * bow);
    }

    /// And back.
    pub fn straighten(&self, place: &mut [f64]) {
        let [bow, _] = self.bow(place[self.distance.index]);
        place.iter_mut().zip(&self.along).for_each(|(q, b)| *q -= b * bow);
    }

    /// From the gradient at a place in the parameters' coordinates to that in straight ones.
    pub fn pull(&self, place: &[f64], gradient: &mut [f64]) {
        let [_, rate] = self.bow(place[self.distance.index]);
        let sum: f64 = gradient.iter().zip(&self.along).map(|(g, b)| g * b).sum();
        gradient[self.distance.index] += rate * sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Freedom, Parameter};
    use crate::prior::Prior;

    /// There and back; the gradient against differences; and where the others follow 1/r, the valley is straight.
    #[test]
    fn straight_in_one_over_r() {
        let parameter = |name, bounds| Parameter {
            name,
            unit: "",
            meaning: "",
            bounds,
            pixels: 0,
            usual: Freedom::Fixed(0.0),
        };
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
        let parameters = [parameter("flux", everywhere), parameter("distance", [0.0, f64::INFINITY])];
        let free = [
            Freedom::Free(Prior::Uniform(f64::NEG_INFINITY, f64::INFINITY)),
            Freedom::Free(Prior::LogUniform(40.0, 1e4)),
        ];
        let coordinates = Coordinates::new(&parameters, &free, &[1.0, 1.0]);
        // ln p = −½ (1e4 (flux − 3 − 5/r))² − ½ (200 (1/r − 1e-3))², a narrow valley along flux = 3 + 5/r.
        let log = |q: &[f64]| {
            let values = coordinates.at(q).values;
            let u = 1.0 / values[1];
            -0.5 * (1e4 * (values[0] - 3.0 - 5.0 * u)).powi(2) - 0.5 * (2e3 * (u - 1e-3)).powi(2)
        };
        let place = coordinates.of(&[3.005, 1000.0]);
        let slope = coordinates.distance().unwrap().at(place[1])[1];
        let (a, b, c) = (1e8, -5e8 * slope, (25e8 + 4e6) * slope * slope);
        let shear =
            Shear::about(&coordinates, &place, &DMatrix::from_row_slice(2, 2, &[a, b, b, c])).unwrap();
        for step in [-0.9, -0.2, 0.1, 0.5, 1.4] {
            // The line that the curvature shows, by its straight coordinates.
            let straight = [place[0] + 5.0 * slope * step, place[1] + step];
            let mut bent = straight;
            shear.bend(&mut bent);
            let u = 1.0 / coordinates.at(&bent).values[1];
            assert!((log(&bent) + 0.5 * (2e3 * (u - 1e-3)).powi(2)).abs() < 1e-9);
            let mut back = bent;
            shear.straighten(&mut back);
            assert!(back.iter().zip(&straight).all(|(a, b)| (a - b).abs() < 1e-14));
            let far = |h: f64, k: usize, sheared: bool| {
                let mut q = if sheared { straight } else { bent };
                q[k] += h;
                if sheared {
                    shear.bend(&mut q);
                }
                log(&q)
            };
            let difference = |k, sheared| (far(1e-6, k, sheared) - far(-1e-6, k, sheared)) / 2e-6;
            let mut gradient = [difference(0, false), difference(1, false)];
            shear.pull(&bent, &mut gradient);
            for (k, g) in gradient.iter().enumerate() {
                let other = difference(k, true);
                assert!((g - other).abs() < 1e-4 * (1.0 + other.abs()), "{k}: {g} {other}");
            }
        }
    }
}
