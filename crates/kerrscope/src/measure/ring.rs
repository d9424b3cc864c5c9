//! The ring of light, by the definitions of the Event Horizon Telescope.
//!
//! EHT Collaboration 2019, ApJL 875, L4 (Paper IV), §9: from a centre, profiles I(r, θ) in many directions; r_pk(θ) is where each is brightest.
//!
//! ```text
//! d = 2⟨r_pk⟩, σ_d = 2 σ(r_pk)
//! w = ⟨full width at half maximum of I(r, θ)⟩
//! η = ⟨Arg ∫ I e^{iθ} dθ⟩, A = ⟨|∫ I e^{iθ} dθ| / ∫ I dθ⟩   over r from (d − w)/2 to (d + w)/2
//! f = ⟨I⟩ within a tenth of d of the centre / ⟨I⟩ at d/2
//! ```
//!
//! The averages of η and A are over radii, that of η one of directions; (d − w)/2 is 0 at least. The program with which the collaboration
//! reads pictures (REx, also in eht-imaging) does the same. It differs from this in what follows:
//!
//! - The centre here is where r_pk has no first harmonic, ∫ r_pk e^{iθ} dθ = 0, which is where its spread is least to first order; there it
//!   is looked for on a grid.
//! - The sky's light is taken off from everything here; there the mean at 50 µas, and from the profile whose width is taken alone. Where the
//!   sky is dark, as in their pictures, it is the same. Negative values count here as they are, and as zero there.
//! - f here is the mean over r up to d/10 and θ, each radius counting as much as any other; there up to 5 µas, which for M87* is 0.12 d.
//!
//! Position angles are East of North with North up and East to the left.

use std::f64::consts::TAU;

use serde::Serialize;

use super::profile::Field;
use super::shadow::{DIRECTIONS, Levels};
use super::{Measured, Picture};

/// Samples of a pixel's length along a profile.
const FINE: f64 = 4.0;

/// The ring. Lengths are in pixels; errors are of one standard deviation over directions or radii, as in Paper IV.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ring {
    /// Its centre, right and up of the picture's middle.
    pub centre: [f64; 2],
    /// d and σ_d.
    pub diameter: Measured,
    /// w, and the spread of the widths.
    pub width: Measured,
    /// A, and its spread over radii.
    pub asymmetry: Measured,
    /// η, the position angle of the bright side in degrees East of North, in [0, 360), and its spread over radii.
    pub position_angle: Measured,
    /// f.
    pub central_brightness: f64,
    /// r_pk in directions anticlockwise from the right.
    #[serde(skip)]
    pub peaks: Vec<f64>,
}

impl Ring {
    /// Looks for the ring from a first centre.
    pub(super) fn of(picture: &Picture, levels: Levels, start: [f64; 2], least: f64) -> Result<Self, String> {
        let field = Field::new(picture);
        let mut centre = start;
        let mut peaks = peaks(&field, centre)?;
        for _ in 0..30 {
            let step = harmonic(&peaks);
            centre = [centre[0] + step[0], centre[1] + step[1]];
            if centre[0].hypot(centre[1]) > picture.width.max(picture.height) as f64 {
                return Err("the brightest places around do not lie on a ring".to_owned());
            }
            peaks = self::peaks(&field, centre)?;
            if step[0].hypot(step[1]) < 1e-4 {
                break;
            }
        }
        let (mean, spread) = mean_and_spread(&peaks);
        if spread > 0.25 * mean || mean < least {
            return Err("the brightest places around do not lie on a ring".to_owned());
        }
        let widths: Vec<f64> =
            (0..DIRECTIONS).filter_map(|k| width(&field, levels.sky, centre, angle(k), peaks[k])).collect();
        if widths.len() * 4 < DIRECTIONS * 3 {
            return Err("the light does not fall to half of its peak on both sides of a ring".to_owned());
        }
        let (w, w_spread) = mean_and_spread(&widths);
        let diameter = 2.0 * mean;
        let radii = [0.5 * (diameter - w), 0.5 * (diameter + w)];
        let value = |r: f64, k: usize| field.on_ray(centre, angle(k), r) - levels.sky;
        let steps = 32;
        let vectors: Vec<[f64; 3]> = (0..=steps)
            .map(|n| radii[0].max(0.0) + (radii[1] - radii[0].max(0.0)) * f64::from(n) / f64::from(steps))
            .map(|r| {
                let mut sums = [0.0; 3];
                for k in 0..DIRECTIONS {
                    let (sin, cos) = angle(k).sin_cos();
                    let v = value(r, k);
                    sums = [sums[0] + v, sums[1] + v * cos, sums[2] + v * sin];
                }
                sums
            })
            .collect();
        if vectors.iter().any(|[all, ..]| !(*all > 0.0)) {
            return Err("the light has no crest: it is as bright all over, with an edge".to_owned());
        }
        let share = |[all, x, y]: &[f64; 3]| x.hypot(*y) / all;
        let (a, a_spread) = mean_and_spread(&vectors.iter().map(share).collect::<Vec<_>>());
        // East of North: from up, over left.
        let angles: Vec<f64> = vectors.iter().map(|[_, x, y]| (-x).atan2(*y)).collect();
        let [sin, cos] = angles
            .iter()
            .fold([0.0; 2], |[s, c], a| [s + a.sin(), c + a.cos()])
            .map(|sum| sum / angles.len() as f64);
        let pa_spread = (-2.0 * sin.hypot(cos).min(1.0).ln()).max(0.0).sqrt();
        let at_ring = (0..DIRECTIONS).map(|k| value(mean, k)).sum::<f64>() / DIRECTIONS as f64;
        let radii = (0..=steps).map(|n| 0.1 * diameter * f64::from(n) / f64::from(steps));
        let within = radii.map(|r| (0..DIRECTIONS).map(|k| value(r, k)).sum::<f64>()).sum::<f64>()
            / (DIRECTIONS as f64 * f64::from(steps + 1));
        Ok(Self {
            centre,
            diameter: Measured::new(diameter, 2.0 * spread),
            width: Measured::new(w, w_spread),
            asymmetry: Measured::new(a, a_spread),
            position_angle: Measured::new(
                sin.atan2(cos).to_degrees().rem_euclid(360.0),
                pa_spread.to_degrees(),
            ),
            central_brightness: within / at_ring,
            peaks,
        })
    }
}

fn angle(k: usize) -> f64 {
    TAU * k as f64 / DIRECTIONS as f64
}

fn mean_and_spread(values: &[f64]) -> (f64, f64) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    (mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n).sqrt())
}

/// How far off the centre of a circle is that has these radii: twice the first harmonic.
fn harmonic(radii: &[f64]) -> [f64; 2] {
    let sums = radii.iter().enumerate().fold([0.0; 2], |[x, y], (k, r)| {
        let (sin, cos) = angle(k).sin_cos();
        [x + r * cos, y + r * sin]
    });
    sums.map(|sum| 2.0 * sum / radii.len() as f64)
}

/// Where each direction's profile is brightest, by a parabola through three samples a pixel apart.
fn peaks(field: &Field<'_>, centre: [f64; 2]) -> Result<Vec<f64>, String> {
    (0..DIRECTIONS)
        .map(|k| {
            let value = |r: f64| field.on_ray(centre, angle(k), r);
            let count = (field.reach(centre, angle(k)) * FINE) as usize;
            let best = (0..count).map(|n| n as f64 / FINE).max_by(|a, b| value(*a).total_cmp(&value(*b)));
            let best = best.filter(|r| *r >= 1.0 && *r + 1.5 < count as f64 / FINE);
            let at = best.ok_or_else(|| {
                "the light is brightest at the centre or the border, not on a ring".to_owned()
            })?;
            let [before, here, after] = [at - 1.0, at, at + 1.0].map(value);
            let bend = before - 2.0 * here + after;
            Ok(if bend < 0.0 { at + (0.5 * (before - after) / bend).clamp(-1.0, 1.0) } else { at })
        })
        .collect()
}

/// Full width at half maximum of a profile around its peak; none if it does not fall to half on both sides.
fn width(field: &Field<'_>, sky: f64, centre: [f64; 2], angle: f64, peak: f64) -> Option<f64> {
    let value = |r: f64| field.on_ray(centre, angle, r) - sky;
    let half = 0.5 * value(peak);
    let walk = |step: f64| {
        let (mut at, mut before) = (peak, value(peak));
        loop {
            at += step;
            if at < 0.0 || at > field.reach(centre, angle) {
                return None;
            }
            let here = value(at);
            if here <= half {
                return Some(at - step * (half - here) / (before - here));
            }
            before = here;
        }
    };
    Some(walk(0.125)? - walk(-0.125)?)
}
