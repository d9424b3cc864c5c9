//! The continuum spectrum of a disk.

use rayon::prelude::*;

use super::stage::{Replay, Stage};
use super::tally::Tally;
use crate::disk::{Disk, Surface};

/// Mean of I_ν over the picture, in W m⁻² Hz⁻¹ sr⁻¹, at each frequency in Hz: of the disk's black bodies, as its samples see
/// them. Times the picture's solid angle it is the flux density. `None` if there is no disk of black bodies, or if
/// there are things in the scene.
///
/// Rays are followed once; their temperatures serve for all frequencies. Rows are added up in their order, so that the sum does not
/// depend on the number of threads.
pub fn continuum(stage: &Stage, frequencies: &[f64]) -> Option<(Vec<f64>, Tally)> {
    stage.radiance()?;
    let disk = stage.disk()?;
    if !matches!(&disk.surface, Surface::Shining(emission) if emission.is_thermal()) {
        return None;
    }
    let [width, height] = stage.size();
    let rows: Vec<(Vec<f64>, Tally)> = (0..height)
        .into_par_iter()
        .map_init(Replay::default, |replay, row| of_row(stage, disk, [width, row], frequencies, replay))
        .collect();
    let mut sum = vec![0.0; frequencies.len()];
    let mut tally = Tally::default();
    for (light, rays) in rows {
        for (sum, light) in sum.iter_mut().zip(light) {
            *sum += light;
        }
        tally.add(&rays);
    }
    let samples = f64::from(width) * f64::from(height) * f64::from(stage.samples());
    Some((sum.into_iter().map(|light| light / samples).collect(), tally))
}

fn of_row(
    stage: &Stage,
    disk: &Disk,
    [width, row]: [u32; 2],
    frequencies: &[f64],
    replay: &mut Replay,
) -> (Vec<f64>, Tally) {
    let mut sum = vec![0.0; frequencies.len()];
    let mut tally = Tally::default();
    let samples =
        (0..width).flat_map(|x| (0..stage.samples()).map(move |sample| stage.sample([x, row], sample)));
    let points: Vec<[f64; 2]> = samples.collect();
    stage.trace_rays(&points, replay, &mut tally, |ray, path| {
        let mut share = 1.0;
        for hit in disk.hits(ray, path) {
            let Some(sheet) = disk.sheet(&hit) else { continue };
            if let Some(thermal) = disk.thermal(&hit) {
                for (sum, frequency) in sum.iter_mut().zip(frequencies) {
                    *sum += share * thermal.at(*frequency);
                }
            }
            share *= 1.0 - sheet.opacity;
        }
    });
    (sum, tally)
}
