//! Bounds of parameters that cut a posterior off.
//!
//! Between bounds a parameter is a logistic function of its coordinate, s = 1/(1 + e^−q) of the way from one to the other. A narrow
//! valley, which is straight in parameters, is bent in q where it ends at a bound, and no Gaussian. Straight coordinates w go with s:
//!
//! ```text
//! s(q) = s₀ + s₀ (1 − s₀) (w − q₀),   dq/dw = s₀ (1 − s₀) / (s (1 − s)),
//! ```
//!
//! which touches the identity at q₀. Beyond the bounds there is no q.

use serde::{Deserialize, Serialize};

use crate::coordinates::Coordinates;

/// Straight coordinates about a place.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    /// Which coordinates have bounds, and their q₀.
    all: Vec<(usize, f64)>,
}

/// s and s (1 − s).
fn share(q: f64) -> [f64; 2] {
    let [s, rest] = [(1.0 + (-q).exp()).recip(), (1.0 + q.exp()).recip()];
    [s, (s * rest).max(1e-300)]
}

impl Bounds {
    /// About a place.
    pub fn about(coordinates: &Coordinates, place: &[f64]) -> Self {
        Self { all: coordinates.bounded().into_iter().map(|k| (k, place[k])).collect() }
    }

    /// From straight coordinates to those of the parameters; false if a parameter lies beyond its bounds.
    pub fn bend(&self, place: &mut [f64]) -> bool {
        self.all.iter().all(|&(k, q)| {
            let [start, rate] = share(q);
            let s = start + rate * (place[k] - q);
            place[k] = (s / (1.0 - s)).ln();
            place[k].is_finite()
        })
    }

    /// And back.
    pub fn straighten(&self, place: &mut [f64]) {
        for &(k, q) in &self.all {
            let [start, rate] = share(q);
            place[k] = q + (share(place[k])[0] - start) / rate;
        }
    }

    /// dq/dw of every coordinate at a place.
    pub fn slopes(&self, place: &[f64]) -> Vec<f64> {
        let mut slopes = vec![1.0; place.len()];
        for &(k, q) in &self.all {
            slopes[k] = share(q)[1] / share(place[k])[1];
        }
        slopes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// There and back, slopes against differences, nothing beyond the bounds, and the identity where it is made.
    #[test]
    fn straight_between_bounds() {
        let bounds = Bounds { all: vec![(0, 2.0), (2, -0.5)] };
        for q in [[2.0, 7.0, -0.5], [5.0, 7.0, -3.0], [-1.0, 7.0, 12.0]] {
            let mut w = q.to_vec();
            bounds.straighten(&mut w);
            let mut back = w.clone();
            assert!(bounds.bend(&mut back));
            assert!(back.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-9), "{back:?}");
            assert_eq!(w[1], 7.0);
            for (k, slope) in bounds.slopes(&q).into_iter().enumerate() {
                let moved = |h: f64| {
                    let mut w = w.clone();
                    w[k] += h / slope;
                    assert!(bounds.bend(&mut w));
                    w[k]
                };
                let difference = (moved(1e-3) - moved(-1e-3)) / 2e-3;
                assert!((difference - 1.0).abs() < 1e-5, "{q:?} {k}: {difference}");
            }
        }
        assert_eq!(bounds.slopes(&[2.0, 7.0, -0.5]), [1.0; 3]);
        // s = 1 is 1/s₀ from where it is made.
        let end = 2.0 + 1.0 + (-2.0_f64).exp();
        assert!(bounds.bend(&mut [end - 1e-9, 0.0, 0.0]));
        assert!(!bounds.bend(&mut [end + 1e-9, 0.0, 0.0]));
        assert!(!bounds.bend(&mut [0.0, 0.0, -3.0]));
    }
}
