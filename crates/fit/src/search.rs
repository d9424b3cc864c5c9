//! The modes of a posterior.

use rayon::prelude::*;

use crate::coordinates::Coordinates;
use crate::fit::{FitError, Image, Interim, Models, Options};
use crate::likelihood::{Noise, Posterior, Unknown};
use crate::metric::Metric;
use crate::mode::{Mode, climb};
use crate::model::{Freedom, Parameter, Source};
use crate::noise;
use crate::observed::Observed;
use crate::prior::Prior;
use crate::reduce::reduced;

/// Pixels across the pictures with which modes are looked for.
const SMALL: usize = 48;

/// Evaluations of the first climb of every start; how many then go on, and for how many evaluations.
const FIRST: usize = 9;
const HOPEFUL: usize = 12;
const SECOND: usize = 25;

/// Modes that are followed, and how much less probable than the best they may be.
const MODES: usize = 6;
const FORGOTTEN: f64 = 12.0;

/// Modes of the posterior, the best first: found in a picture of fewer pixels with a coarser model, then climbed again.
pub fn modes(
    image: &Image,
    models: &dyn Models,
    options: &Options<'_>,
    posterior: &Posterior<'_, Box<dyn Source>>,
    sizes: &[f64],
) -> Result<(Vec<Mode>, usize), FitError> {
    let factor = image.size[0].max(image.size[1]).div_ceil(SMALL).max(1);
    let (small, size) = reduced(&image.values, image.size, factor);
    let sketch = Observed::new(models.source(0), size);
    let parameters = posterior.model.parameters();
    let shrink = |value: f64, parameter: &Parameter, power: i32| {
        value * (factor as f64).powi(-power * parameter.pixels)
    };
    let freedoms: Vec<Freedom> = options
        .freedoms
        .iter()
        .zip(parameters)
        .map(|(freedom, parameter)| match freedom {
            Freedom::Fixed(value) => Freedom::Fixed(shrink(*value, parameter, 1)),
            free @ Freedom::Free(_) => *free,
        })
        .collect();
    // Priors are for the picture's own pixels; to look around, bounds are enough.
    let loose: Vec<Freedom> =
        if factor == 1 { options.freedoms.clone() } else { loosened(&freedoms, sketch.parameters()) };
    let coordinates = Coordinates::new(sketch.parameters(), &loose, sizes);
    let peak = noise::peak(&small);
    let unknown = Unknown { pattern: vec![1.0; small.len()], guess: 0.02 * peak, spread: f64::INFINITY };
    let rough = Noise { known: vec![0.02 * peak; small.len()], unknown: Some(unknown) };
    let near = Posterior { model: &sketch, data: &small, noise: &rough, coordinates: &coordinates };
    let flux: f64 = image.values.iter().sum();
    let mut starts: Vec<Vec<f64>> = options.starts.clone();
    for own in posterior.model.source().starts(&image.values, image.size, options.cancelled) {
        let mut start = own;
        start.extend([2.0, flux, 0.0]);
        starts.push(start);
    }
    if (options.cancelled)() {
        return Err(FitError::Cancelled);
    }
    for start in &mut starts {
        for (value, freedom) in start.iter_mut().zip(&options.freedoms) {
            if let Freedom::Fixed(fixed) = freedom {
                *value = *fixed;
            }
        }
    }
    let places: Vec<Vec<f64>> = starts
        .iter()
        .map(|start| {
            let values: Vec<f64> = start.iter().zip(parameters).map(|(v, p)| shrink(*v, p, 1)).collect();
            let mut q = coordinates.of(&values);
            q.push(0.0);
            q
        })
        .collect();
    let ascend = |places: &[Vec<f64>], most: usize| -> Vec<Mode> {
        let climbed = |q: &Vec<f64>| {
            if (options.cancelled)() { None } else { climb(&near, q, most, options.cancelled) }
        };
        let mut modes: Vec<Mode> = places.par_iter().filter_map(climbed).collect();
        modes.sort_by(|a, b| b.evaluation.log.total_cmp(&a.evaluation.log));
        modes
    };
    let values = |mode: &Mode| -> Vec<f64> {
        let values = &mode.evaluation.values[..parameters.len()];
        values.iter().zip(parameters).map(|(v, p)| shrink(*v, p, -1)).collect()
    };
    let tell = |best: Option<Vec<f64>>| {
        if let (Some(interim), Some(values)) = (options.interim, best)
            && let Ok(best) = posterior.model.predict(&values, false)
        {
            interim(Interim::Best(&best.values));
        }
    };
    // All for a little, then those that have come far.
    let first = ascend(&places, FIRST);
    tell(first.first().map(&values));
    let hopeful: Vec<Vec<f64>> = first.iter().take(HOPEFUL).map(|mode| mode.place.clone()).collect();
    let second = ascend(&hopeful, SECOND);
    tell(second.first().map(&values));
    let rough_modes: Vec<Vec<f64>> = second.iter().map(&values).collect();
    if (options.cancelled)() {
        return Err(FitError::Cancelled);
    }
    let mut evaluations: usize = first.iter().chain(&second).map(|mode| mode.evaluations).sum();
    let mut distinct: Vec<Vec<f64>> = Vec::new();
    for values in rough_modes {
        let q = posterior.coordinates.of(&values);
        let same = |other: &Vec<f64>| {
            let mut other = posterior.coordinates.of(other);
            posterior.coordinates.near(&mut other, &q);
            q.iter().zip(&other).all(|(a, b)| (a - b).abs() < 0.05 * (1.0 + a.abs()))
        };
        if !distinct.iter().any(same) {
            distinct.push(values);
        }
        if distinct.len() == MODES {
            break;
        }
    }
    let mut found: Vec<Mode> = distinct
        .par_iter()
        .filter_map(|values| {
            let mut q = posterior.coordinates.of(values);
            if posterior.noise.unknown.is_some() {
                q.push(0.0);
            }
            if (options.cancelled)() { None } else { climb(posterior, &q, 60, options.cancelled) }
        })
        .collect();
    evaluations += found.iter().map(|mode| mode.evaluations).sum::<usize>();
    if (options.cancelled)() {
        return Err(FitError::Cancelled);
    }
    found.sort_by(|a, b| b.evaluation.log.total_cmp(&a.evaluation.log));
    let mut kept: Vec<Mode> = Vec::new();
    for mut mode in found {
        if let Some(best) = kept.first() {
            posterior.coordinates.near(&mut mode.place, &best.place);
        }
        let same = |other: &Mode| {
            let place = posterior.coordinates.beside(&mode.place, &other.place);
            Metric::around(other).inside(&place).norm() < 1.5
        };
        let top = kept.first().map_or(mode.evaluation.log, |best| best.evaluation.log);
        if mode.evaluation.log > top - FORGOTTEN && !kept.iter().any(same) {
            kept.push(mode);
        }
    }
    if kept.is_empty() { Err(FitError::NoStart) } else { Ok((kept, evaluations)) }
}

/// The same parameters free, anywhere within their bounds.
fn loosened(freedoms: &[Freedom], parameters: &[Parameter]) -> Vec<Freedom> {
    let loose = |(freedom, parameter): (&Freedom, &Parameter)| match (freedom, parameter.usual) {
        (Freedom::Free(_), usual @ Freedom::Free(_)) if parameter.pixels != 0 => usual,
        (Freedom::Free(_), _)
            if parameter.pixels != 0 && parameter.bounds.iter().all(|bound| bound.is_finite()) =>
        {
            Freedom::Free(Prior::Uniform(parameter.bounds[0], parameter.bounds[1]))
        }
        _ => *freedom,
    };
    freedoms.iter().zip(parameters).map(loose).collect()
}
