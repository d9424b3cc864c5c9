//! The two series of Kamminga's thesis: lengths in the picture of a disk, by spin and by inclination.
//!
//! "Imaging a Kerr Black Hole" (2022), chapter 5, reads off pictures of a disk with the outer radius 6 M how far its edge is from the centre of
//! the shadow: r− to the left and r+ to the right, edge-on, for holes of several spins; and h downwards, for a hole without spin at several
//! inclinations. It does not say where the disk begins nor from where it is seen; here it begins at the horizon and is seen by
//! an observer at rest.
//!
//! Both are read twice: off a drawn picture ([`Setting::measured`]), and from single rays ([`Setting::exact`]). Light of the order n = 0 alone is
//! counted, which meets the disk's plane once. What light of this order does not show, out to the image of the horizon, is the shadow here; its
//! centre is that of its area.
//!
//! Exactly edge-on the disk has no face: its near side is a line of no width, and what is seen of it is the far side, above and
//! below alike. r± are then the limits of the rows next to that line.

use std::path::Path as FilePath;

use rayon::prelude::*;
use serde::Serialize;

use super::sight::Sight;
use super::{Features, Fit, Manner, Part, Picture};
use crate::render::{Stage, Watch, draw};
use crate::scene::Scene;
use crate::spacetime::kerr::horizons;

/// Spins of the thesis's first table, with r− and r+ in its pixels.
const SPINS: [(f64, f64, f64); 7] = [
    (0.0, 76.0, 76.0),
    (0.2, 77.0, 72.0),
    (0.4, 79.0, 71.0),
    (0.6, 80.0, 69.0),
    (0.8, 86.0, 67.0),
    (0.9, 85.0, 65.0),
    (0.95, 87.0, 65.0),
];
/// h and r+ of its second table, in its pixels, for inclinations of kπ/14.
const INCLINATIONS: [(f64, f64); 7] =
    [(90.0, 89.0), (95.0, 90.0), (98.0, 90.0), (97.0, 91.0), (87.0, 91.0), (69.0, 91.0), (38.0, 93.0)];

/// A disk as it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// Spin, 0 to below 1.
    pub spin: f64,
    /// Inclination in degrees, 0 to 90.
    pub inclination: f64,
    /// Where the disk ends, M.
    pub edge: f64,
    /// Where the observer is, M.
    pub distance: f64,
    /// Height of the picture in degrees.
    pub field: f64,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Rays a pixel.
    pub samples: u32,
    /// Constant step of RK4, M, the thesis's way; without it rays are exact.
    pub step: Option<f64>,
    /// The thesis's manner of following rays, for [`Setting::exact`] alone.
    pub manner: Option<Manner>,
}

impl Default for Setting {
    /// No spin, face-on, as the thesis may have had it.
    fn default() -> Self {
        Self {
            spin: 0.0,
            inclination: 0.0,
            edge: 6.0,
            distance: 30.0,
            field: 50.0,
            size: [800, 800],
            samples: 64,
            step: None,
            manner: None,
        }
    }
}

/// The thesis's lengths, in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Lengths {
    /// Centre of the shadow, right and up of the picture's middle.
    pub centre: [f64; 2],
    /// r−.
    pub left: f64,
    /// r+.
    pub right: f64,
    /// h; 0 edge-on, where the lower edge is the line that the shadow's centre is on.
    pub below: f64,
}

impl Lengths {
    /// r−/(r− + r+).
    pub fn left_share(&self) -> f64 {
        self.left / (self.left + self.right)
    }

    /// h/r+.
    pub fn below_over_right(&self) -> f64 {
        self.below / self.right
    }
}

/// One row of a table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Reading {
    /// Spin, or inclination in degrees.
    pub parameter: f64,
    /// From single rays.
    pub exact: Lengths,
    /// Off the drawn picture, if it was drawn.
    pub measured: Option<Lengths>,
    /// The ratio of `exact`: r−/(r− + r+), or h/r+.
    pub ratio: f64,
    /// The thesis's lengths in its own pixels: r− and r+, or h and r+.
    pub thesis: [f64; 2],
    /// Their ratio.
    pub thesis_ratio: f64,
}

/// A table in the thesis's manner, as far as some of its parts go.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Repeat {
    /// The part that is added to those before.
    pub adds: Part,
    /// The ratio of each row; none where shadow or disk are not found.
    pub ratios: Vec<Option<f64>>,
    /// The straight line through them.
    pub fit: Option<Fit>,
    /// Which share of the difference between the thesis's slope and that of exact rays this one's has.
    pub explains: Option<f64>,
    /// Root mean square of the differences from the thesis's ratios.
    pub off: Option<f64>,
}

/// Which of the two tables.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Series {
    /// r−/(r− + r+) by spin, edge-on.
    Spins,
    /// h/r+ by inclination, without spin.
    Inclinations,
}

impl Setting {
    /// The scene: a disk of the same brightness everywhere, and light of the order n = 0.
    ///
    /// # Errors
    /// When the setting is none that can be seen, in words.
    pub fn scene(&self) -> Result<Scene, String> {
        let Self { spin, inclination, edge, distance, field, size: [width, height], samples, step, .. } =
            *self;
        let inner = horizons(spin).0 * (1.0 + 1e-6);
        let method = step.map_or_else(String::new, |step| {
            format!("engine = 'integrator'\nmethod = 'rk4'\nstep = {step:?}\nadaptive = false\n")
        });
        let text = format!(
            "spacetime = {{ name = 'kerr', spin = {spin:?} }}\n\
             observer = {{ distance = {distance:?}, inclination = {inclination:?} }}\n\
             screen = {{ kind = 'pinhole', field_of_view = {field:?} }}\n\
             sky = {{ kind = 'black' }}\n\
             [disk]\nmodel = 'profile'\nprofile = [[{inner:?}, 1.0], [{edge:?}, 1.0]]\n\
             inner = {inner:?}\nouter = {edge:?}\n\
             doppler = false\ngravitational = false\nbeaming = false\n\
             [render]\nwidth = {width}\nheight = {height}\nsamples = {samples}\nmax_crossings = 1\n{method}"
        );
        Scene::from_toml(&text, FilePath::new("")).map_err(|faults| faults.to_string())
    }

    /// The lengths from single rays: to about 1e-9 pixels, 1e-5 in the thesis's manner.
    ///
    /// # Errors
    /// As [`Setting::scene`], and when the shadow or the disk's edge is not in view.
    pub fn exact(&self) -> Result<Lengths, String> {
        Sight::new(self)?.lengths((self.inclination - 90.0).abs() >= 1e-12)
    }

    /// The picture.
    ///
    /// # Errors
    /// As [`Setting::scene`], and when the disk is not in view.
    pub fn picture(&self) -> Result<Picture, String> {
        let scene = self.scene()?;
        let stage = Stage::new(&scene).map_err(|e| e.to_string())?;
        let film = draw(&stage, &Watch::default()).map_err(|e| e.to_string())?;
        let values =
            film.light.iter().map(|rgb| rgb.iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0).collect();
        let [width, height] = self.size.map(|n| n as usize);
        Picture::of_values(width, height, values).map_err(|e| e.to_string())
    }

    /// The lengths off the picture, as [`Features`] finds them.
    ///
    /// # Errors
    /// As [`Setting::picture`], and when shadow or disk are not found in it.
    pub fn measured(&self) -> Result<Lengths, String> {
        let features = Features::of(&self.picture()?);
        let shadow = match &features.shadow {
            super::Feature::Found(shadow) => shadow,
            super::Feature::NotFound(why) => return Err(why.clone()),
        };
        let disk = match &features.disk {
            super::Feature::Found(disk) => disk,
            super::Feature::NotFound(why) => return Err(why.clone()),
        };
        let below = if (self.inclination - 90.0).abs() < 1e-12 { 0.0 } else { disk.below.value };
        let centre = shadow.centre.map(|c| c.value);
        Ok(Lengths { centre, left: disk.left.value, right: disk.right.value, below })
    }

    /// A pixel's side at the picture's middle, as the tangent of an angle.
    pub(super) fn pixel(&self) -> f64 {
        2.0 * (0.5 * self.field.to_radians()).tan() / f64::from(self.size[1])
    }
}

impl Series {
    /// The thesis's parameters, the ratio's table beside them.
    fn rows(self) -> Vec<(f64, [f64; 2])> {
        match self {
            Self::Spins => SPINS.iter().map(|&(spin, left, right)| (spin, [left, right])).collect(),
            Self::Inclinations => {
                let degrees = |k: usize| 180.0 * k as f64 / 14.0;
                INCLINATIONS.iter().enumerate().map(|(k, &(h, right))| (degrees(k), [h, right])).collect()
            }
        }
    }

    /// A setting with the parameter of this series: a spin seen edge-on, or an inclination without spin.
    pub fn at(self, parameter: f64, base: Setting) -> Setting {
        match self {
            Self::Spins => Setting { spin: parameter, inclination: 90.0, ..base },
            Self::Inclinations => Setting { spin: 0.0, inclination: parameter, ..base },
        }
    }

    /// The ratio of this series.
    pub fn ratio(self, lengths: &Lengths) -> f64 {
        match self {
            Self::Spins => lengths.left_share(),
            Self::Inclinations => lengths.below_over_right(),
        }
    }

    /// The table.
    ///
    /// # Errors
    /// As [`Setting::exact`] and, if pictures are drawn, [`Setting::measured`].
    pub fn table(self, base: Setting, drawn: bool) -> Result<Vec<Reading>, String> {
        let row = |(parameter, thesis): (f64, [f64; 2])| {
            let setting = self.at(parameter, base);
            let exact = setting.exact()?;
            let measured = if drawn { Some(setting.measured()?) } else { None };
            let thesis_ratio = match self {
                Self::Spins => thesis[0] / (thesis[0] + thesis[1]),
                Self::Inclinations => thesis[0] / thesis[1],
            };
            Ok(Reading { parameter, exact, measured, ratio: self.ratio(&exact), thesis, thesis_ratio })
        };
        self.rows().into_iter().map(row).collect()
    }

    /// The table in the thesis's manner, its parts added one after another, beside that of exact rays.
    pub fn repeats(self, exact: &[Reading], base: Setting, parts: &[Part]) -> Vec<Repeat> {
        let slope = |ratio: fn(&Reading) -> f64| {
            Fit::of(&exact.iter().map(|row| [row.parameter, ratio(row)]).collect::<Vec<_>>())
                .map(|fit| fit.slope)
        };
        let (here, theirs) = (slope(|row| row.ratio), slope(|row| row.thesis_ratio));
        let repeat = |count: usize| {
            let manner = Some(Manner::of(&parts[..=count]));
            let ratio = |row: &Reading| {
                let setting = Setting { manner, ..self.at(row.parameter, base) };
                setting.exact().ok().map(|lengths| self.ratio(&lengths)).filter(|ratio| ratio.is_finite())
            };
            let ratios: Vec<Option<f64>> = exact.par_iter().map(ratio).collect();
            let rows = || exact.iter().zip(&ratios).filter_map(|(row, ratio)| Some((row, (*ratio)?)));
            let fit = Fit::of(&rows().map(|(row, ratio)| [row.parameter, ratio]).collect::<Vec<_>>());
            let squares = rows().map(|(row, ratio)| (ratio - row.thesis_ratio).powi(2)).sum::<f64>();
            let explains = match (fit, here, theirs) {
                (Some(fit), Some(here), Some(theirs)) => Some((fit.slope - here) / (theirs - here)),
                _ => None,
            };
            let off = Some((squares / rows().count() as f64).sqrt()).filter(|off| off.is_finite());
            Repeat { adds: parts[count], ratios, fit, explains, off }
        };
        (0..parts.len()).map(repeat).collect()
    }

    /// How the exact ratio changes with one of the setting's numbers: its derivative, by a central difference.
    ///
    /// # Errors
    /// As [`Setting::exact`].
    pub fn derivative(
        self,
        setting: Setting,
        step: f64,
        moved: impl Fn(Setting, f64) -> Setting,
    ) -> Result<f64, String> {
        let at = |offset: f64| moved(setting, offset).exact().map(|lengths| self.ratio(&lengths));
        Ok((at(step)? - at(-step)?) / (2.0 * step))
    }

    /// The parameter at which the exact ratio has a value, and its error: spins from 0 to 0.998, inclinations from that of the largest ratio
    /// to 89.9°.
    ///
    /// # Errors
    /// As [`Setting::exact`], and when no parameter has that ratio.
    pub fn invert(self, ratio: f64, error: f64, base: Setting) -> Result<[f64; 2], String> {
        let value = |parameter: f64| self.at(parameter, base).exact().map(|lengths| self.ratio(&lengths));
        let (mut low, mut high) = match self {
            Self::Spins => (0.0, 0.998),
            Self::Inclinations => (0.0, 89.9),
        };
        let ends = [value(low)?, value(high)?];
        if !((ends[0] - ratio) * (ends[1] - ratio) <= 0.0) {
            return Err(format!(
                "no parameter from {low} to {high} has the ratio {ratio}: it runs from {:.4} to {:.4}",
                ends[0], ends[1]
            ));
        }
        let rising = ends[1] > ends[0];
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if (value(middle)? < ratio) == rising {
                low = middle;
            } else {
                high = middle;
            }
        }
        let found = 0.5 * (low + high);
        let step = 1e-3 * if self == Self::Spins { 1.0 } else { 90.0 };
        let slope = (value(found + step)? - value((found - step).max(0.0))?) / (step + step.min(found));
        Ok([found, error / slope.abs()])
    }
}
