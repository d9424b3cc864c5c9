//! A fit made up for tests of files.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::fit::{Fit, Image};
use crate::model::Prediction;

/// Chains and draws of each.
pub const SHAPE: [usize; 2] = [4, 500];

/// A diameter and a width that depend on each other, and an angle around North.
pub fn fit(image: &Image) -> Fit {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    // A sum of twelve even numbers is Gaussian enough.
    let mut normal = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let draws: Vec<Vec<Vec<f64>>> = (0..SHAPE[0])
        .map(|_| {
            (0..SHAPE[1])
                .map(|_| {
                    let [a, b, c]: [f64; 3] = [normal(), normal(), normal()];
                    vec![42.0 + 0.5 * a, 7.0 + 0.8 * (0.6 * b - 0.8 * a), (5.0 * c).rem_euclid(360.0)]
                })
                .collect()
        })
        .collect();
    let logs = draws.iter().map(|chain| chain.iter().map(|values| -values[0]).collect()).collect();
    let pixels = image.values.len();
    Fit {
        estimates: Vec::new(),
        converged: true,
        warnings: Vec::new(),
        good: true,
        chi2: 0.0,
        degrees: 1,
        explained: 1.0,
        evidence: 0.0,
        evaluations: 0,
        best: Prediction { values: image.values.iter().map(|v| 0.5 * v).collect(), derivatives: Vec::new() },
        errors: vec![0.25; pixels],
        draws,
        free: [("diameter", "px"), ("width", "px"), ("position_angle", "deg")]
            .map(|(name, unit)| (name.to_owned(), unit.to_owned()))
            .to_vec(),
        logs,
        diverged: 3,
    }
}

/// A picture that rises along each row and from row to row.
pub fn image([width, height]: [usize; 2]) -> Image {
    let values = (0..width * height).map(|k| k as f64 / (width * height - 1) as f64).collect();
    Image { values, size: [width, height], pixel: Some(2.0) }
}
