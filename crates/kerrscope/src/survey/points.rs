//! Points of a survey's axes.

use super::file::{Axis, Design, Sample, Setting, Spacing};
use crate::random::{mix, unit};

/// What an axis is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind<'a> {
    /// Values one after another.
    List(&'a [Setting]),
    /// So many numbers from one to another.
    Grid(f64, f64, u32),
    /// Numbers between two, sampled.
    Range(f64, f64),
}

/// What an axis is, or why it is nothing.
///
/// # Errors
/// What does not go together, and how to mend it.
pub fn kind(axis: &Axis) -> Result<Kind<'_>, (String, String)> {
    let mend = || "give values = […], or from and to, with steps for a grid".to_owned();
    let range = match (&axis.values, axis.from, axis.to) {
        (Some(values), None, None) if axis.steps.is_none() => {
            return if axis.spacing == Spacing::Log {
                Err(("values are spaced as they are given".to_owned(), "leave out `spacing`".to_owned()))
            } else {
                Ok(Kind::List(values))
            };
        }
        (None, Some(from), Some(to)) => [from, to],
        (Some(_), ..) => return Err(("`values` do not go with a range".to_owned(), mend())),
        _ => return Err(("this axis has neither values nor a range".to_owned(), mend())),
    };
    let [from, to] = range;
    if axis.spacing == Spacing::Log && (from <= 0.0 || to <= 0.0) {
        let what = format!("equal ratios do not lead from {from} to {to}");
        return Err((what, "give ends above 0, or spacing = \"linear\"".to_owned()));
    }
    match axis.steps {
        Some(1) if from != to => {
            Err((format!("one step does not lead from {from} to {to}"), "give 2 steps or more".to_owned()))
        }
        Some(steps) => Ok(Kind::Grid(from, to, steps)),
        None => Ok(Kind::Range(from, to)),
    }
}

/// The number at a share of the way from one end to the other, the ends exact.
fn between(from: f64, to: f64, share: f64, spacing: Spacing) -> f64 {
    if share <= 0.0 {
        return from;
    }
    if share >= 1.0 {
        return to;
    }
    match spacing {
        Spacing::Linear => from + (to - from) * share,
        Spacing::Log => from * (to / from).powf(share),
    }
}

/// The values of a grid.
pub fn grid(from: f64, to: f64, steps: u32, spacing: Spacing) -> Vec<Setting> {
    let last = f64::from(steps.max(2) - 1);
    (0..steps).map(|k| Setting::Real(between(from, to, f64::from(k) / last, spacing))).collect()
}

/// Points of all sampled axes together: for each point its value on each axis.
pub fn sampled(sample: &Sample, ranges: &[(f64, f64, Spacing)]) -> Vec<Vec<Setting>> {
    let shares = match sample.design {
        Design::LatinHypercube => hypercube(sample, ranges.len()),
        Design::Sobol => sobol(sample, ranges.len()),
    };
    let value = |(share, (from, to, spacing)): (f64, &(f64, f64, Spacing))| {
        Setting::Real(between(*from, *to, share, *spacing))
    };
    shares.into_iter().map(|point| point.into_iter().zip(ranges).map(value).collect()).collect()
}

/// Each axis's parts in an order of its own (Fisher & Yates), and a place within the part.
fn hypercube(sample: &Sample, axes: usize) -> Vec<Vec<f64>> {
    let count = sample.count as usize;
    let mut points = vec![vec![0.0; axes]; count];
    for axis in 0..axes {
        let seed = mix(u64::from(sample.seed) ^ mix(axis as u64));
        let random = |k: usize, salt: u64| unit(mix(seed ^ mix(2 * k as u64 + salt)));
        let mut order: Vec<usize> = (0..count).collect();
        for k in (1..count).rev() {
            order.swap(k, (random(k, 0) * (k + 1) as f64) as usize);
        }
        for (k, (point, part)) in points.iter_mut().zip(order).enumerate() {
            point[axis] = (part as f64 + random(k, 1)) / count as f64;
        }
    }
    points
}

fn sobol(sample: &Sample, axes: usize) -> Vec<Vec<f64>> {
    let point =
        |k: u32| (0..axes).map(|axis| f64::from(sobol_burley::sample(k, axis as u32, sample.seed))).collect();
    (0..sample.count).map(point).collect()
}

/// Axes that can be sampled together: as many dimensions as the sequence's tables have.
pub const MOST_AXES: usize = sobol_burley::NUM_DIMENSIONS as usize;

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(values: &[Setting]) -> Vec<f64> {
        values.iter().filter_map(Setting::number).collect()
    }

    #[test]
    fn grids_have_both_ends() {
        assert_eq!(numbers(&grid(0.0, 0.9, 4, Spacing::Linear)), [0.0, 0.3, 0.6, 0.9]);
        let ratios = numbers(&grid(1e-3, 10.0, 5, Spacing::Log));
        assert_eq!((ratios[0], ratios[4]), (1e-3, 10.0));
        assert!(ratios.windows(2).all(|pair| (pair[1] / pair[0] - 10.0).abs() < 1e-12), "{ratios:?}");
        assert_eq!(numbers(&grid(0.5, 0.5, 1, Spacing::Linear)), [0.5]);
    }

    /// A hypercube has one point in each part of each axis; Sobol's first 64 have so too, and one in each square of 8 × 8.
    #[test]
    fn points_are_spread() {
        for design in [Design::LatinHypercube, Design::Sobol] {
            let sample = Sample { design, count: 64, seed: 5 };
            let points = sampled(&sample, &[(0.0, 64.0, Spacing::Linear); 2]);
            for axis in 0..2 {
                let mut parts: Vec<usize> =
                    points.iter().filter_map(|p| p[axis].number()).map(|x| x as usize).collect();
                parts.sort_unstable();
                assert_eq!(parts, (0..64).collect::<Vec<_>>(), "{design:?} {axis}");
            }
            if design == Design::Sobol {
                let cell = |p: &Vec<Setting>| {
                    let [x, y] = [0, 1].map(|k| p[k].number().unwrap_or(f64::NAN) as usize / 8);
                    8 * y + x
                };
                let mut cells: Vec<usize> = points.iter().map(cell).collect();
                cells.sort_unstable();
                assert_eq!(cells, (0..64).collect::<Vec<_>>());
            }
            assert_eq!(points, sampled(&sample, &[(0.0, 64.0, Spacing::Linear); 2]));
            assert_ne!(points, sampled(&Sample { seed: 6, ..sample }, &[(0.0, 64.0, Spacing::Linear); 2]));
        }
    }
}
