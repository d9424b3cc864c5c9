//! Disks read off the edges of their light alone, for pictures whose brightness cannot be trusted.
//!
//! A tone curve, an exposure, a colour map or somebody's taste change how bright a place is, but not whether it is lit. What is lit, by light of
//! any image order, is a region of the screen that depends on the geometry alone: its outline has the disk's outer edge, its inner edge, and
//! those of the images of its underside within and around. What is compared is the share of each pixel that is lit.
//!
//! The other way would be points of the outline, compared with a model's by their distance from it. Shares were chosen because
//!
//! - an edge that one of both does not have counts, where points know nothing of edges of the model that the picture lacks;
//! - nothing is to be matched, where the nearest edge of a point jumps from one to another when edges come close;
//! - the mean over a pixel is what the painter computes exactly, with what edges sweep over as its derivatives.
//!
//! From brightness v to shares c ([`Silhouette::of`]):
//!
//! - Lit is what is above the sky by 0.1 % of the light, or six standard deviations of the noise; specks are left out (`lit.rs`).
//! - Pixels next to dark ones are at an edge. Their light is compared with that on the lit side, one to three pixels farther in,
//!   so that the dim side of a disk is lit as the bright one is (`edge.rs`).
//! - y = v/v_lit would be c in linear light. A tone curve bends that: c = y/(K + (1 − K) y), K above 1 for a curve that flattens out, with
//!   the slope K next to black. A straight edge has all places on the grid equally often, which tells K of each part of the range of
//!   brightness (`bend.rs`); what is left of it is a parameter of the fit, `tone`.
//! - Where light begins gradually, as at the inner edge of a disk with the flux of Page & Thorne, or in arcs thinner than two pixels, there is
//!   no edge whose place can be told: such pixels count nothing.
//!
//! The size of the errors is found from the residuals of the pixels at edges, and of these alone: the others would make it small. Residuals
//! of neighbours go together where a tone curve or a wrong model moves a whole stretch of an edge: then there are fewer independent
//! ones, and errors are larger (`misfit.rs`).

mod bend;
mod edge;
mod lit;
mod misfit;
mod model;
mod start;

pub use bend::bent;
pub use model::Silhouettes;

use edge::{Place, dips, look};
use lit::{Levels, Region};

use crate::fit::{FitError, Image, check};
use crate::likelihood::{Noise, Unknown};

/// Pixels across what is fitted: larger pictures are made of squares of their pixels.
const ACROSS: usize = 128;

/// What is assumed of a pixel's share: the painter's own error, that of a pixel within what is lit or dark, and a first guess at edges.
const PAINTED: f64 = 4e-3;
const PLAIN: f64 = 0.05;
const GUESS: f64 = 0.05;

/// The error of the share of a pixel beside one at an edge, of that one's.
const BESIDE: f64 = 0.25;

/// The error of what is not known.
const UNKNOWN: f64 = 1e3;

/// What is lit of a picture.
#[derive(Clone, Debug)]
pub struct Silhouette {
    /// The share of each pixel that is lit; a pixel is a square of pixels of the picture.
    pub image: Image,
    /// Errors of the shares.
    pub noise: Noise,
    /// How pixels of both go together.
    pub bins: Bins,
    /// Whether what is lit reaches over the picture's border.
    pub open: bool,
    /// The share of the pixels next to dark ones whose edge could not be told.
    pub doubtful: f64,
    /// How many of them there are.
    pub edges: usize,
}

/// Squares of pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bins {
    /// Pixels along the side of a square.
    pub factor: f64,
    /// Where the middle of the squares is, in pixels from that of the picture to the right and up.
    pub shift: [f64; 2],
}

impl Default for Bins {
    fn default() -> Self {
        Self { factor: 1.0, shift: [0.0; 2] }
    }
}

impl Silhouette {
    /// Looks for what is lit of a picture in linear light, as far as somebody could tell.
    ///
    /// # Errors
    /// If nothing stands before a dark sky, or too little of it has sharp edges.
    pub fn of(image: &Image) -> Result<Self, FitError> {
        check(image)?;
        let [width, height] = image.size;
        let levels = Levels::of(image).map_err(FitError::NoSilhouette)?;
        let region = Region::of(image, &levels).map_err(FitError::NoSilhouette)?;
        let near = |pixel: usize| {
            let (column, row) = (pixel % width, pixel / width);
            let columns = column.saturating_sub(1)..(column + 2).min(width);
            (row.saturating_sub(1)..(row + 2).min(height))
                .flat_map(move |row| columns.clone().map(move |column| row * width + column))
        };
        let mut shares: Vec<f64> = region.lit.iter().map(|lit| f64::from(u8::from(*lit))).collect();
        // Unknown where specks were, and how wide around doubtful edges.
        let mut known: Vec<f64> =
            region.speck.iter().map(|speck| if *speck { UNKNOWN } else { PLAIN }).collect();
        let mut pattern = vec![0.0; shares.len()];
        let (mut sharp, mut doubtful) = (Vec::new(), 0_usize);
        for pixel in (0..shares.len()).filter(|pixel| region.lit[*pixel]) {
            let place = if near(pixel).any(|other| !region.lit[other]) {
                look(image, &levels, &region, pixel)
            } else if dips(image, &levels, pixel) {
                Place::Doubtful { reach: 1 }
            } else {
                continue;
            };
            match place {
                Place::Sharp(found) => sharp.push((pixel, found)),
                Place::Doubtful { reach } => {
                    doubtful += 1;
                    let (column, row) = (pixel % width, pixel / width);
                    for row in row.saturating_sub(reach)..(row + reach + 1).min(height) {
                        for column in column.saturating_sub(reach)..(column + reach + 1).min(width) {
                            known[row * width + column] = UNKNOWN;
                        }
                    }
                }
            }
        }
        let edges = sharp.len() + doubtful;
        if sharp.len() < 30 {
            return Err(FitError::NoSilhouette(format!(
                "of {edges} pixels between light and dark {} have a sharp edge: too few for a silhouette. If its brightness can be \
                 trusted, fit that",
                sharp.len()
            )));
        }
        let curve = bend::Curve::of(sharp.iter().map(|(_, found)| found));
        for (pixel, found) in &sharp {
            shares[*pixel] = curve.share(found);
            for other in near(*pixel) {
                pattern[other] = BESIDE.max(pattern[other]);
            }
        }
        for (pixel, _) in &sharp {
            pattern[*pixel] = 1.0;
        }
        let (image, noise, bins) = binned(image, &shares, &known, &pattern);
        Ok(Self { image, noise, bins, open: region.open, doubtful: doubtful as f64 / edges as f64, edges })
    }

    /// What is to be minded of it, in plain words.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.doubtful > 0.25 {
            warnings.push(format!(
                "{:.0} % of the {} pixels between light and dark have no sharp edge, and are left out: light begins gradually there, or arcs \
                 are thinner than two pixels",
                100.0 * self.doubtful,
                self.edges
            ));
        }
        warnings
    }
}

/// Shares and errors of squares of pixels, from those of pixels. Errors at edges are independent from pixel to pixel.
fn binned(image: &Image, shares: &[f64], known: &[f64], pattern: &[f64]) -> (Image, Noise, Bins) {
    let [width, height] = image.size;
    let factor = width.max(height).div_ceil(ACROSS);
    let size = [width / factor, height / factor];
    let area = (factor * factor) as f64;
    let mut squares = Image { values: Vec::new(), size, pixel: image.pixel };
    let (mut errors, mut patterns) = (Vec::new(), Vec::new());
    for row in 0..size[1] {
        for column in 0..size[0] {
            let (mut sum, mut worst, mut square, mut edges) = (0.0, 0.0_f64, 0.0, 0.0_f64);
            for y in 0..factor {
                let from = (row * factor + y) * width + column * factor;
                for pixel in from..from + factor {
                    sum += shares[pixel];
                    worst = worst.max(known[pixel]);
                    square += pattern[pixel] * pattern[pixel];
                    edges = edges.max(pattern[pixel]);
                }
            }
            squares.values.push(sum / area);
            patterns.push(square.sqrt() / area);
            let plain = worst < UNKNOWN && edges == 0.0;
            errors.push(if plain {
                PLAIN
            } else if worst < UNKNOWN {
                PAINTED
            } else {
                UNKNOWN
            });
        }
    }
    let shift =
        [0.5 * ((size[0] * factor) as f64 - width as f64), 0.5 * (height as f64 - (size[1] * factor) as f64)];
    let unknown = Unknown { pattern: patterns, guess: GUESS, spread: f64::INFINITY };
    let noise = Noise { known: errors, unknown: Some(unknown) };
    (squares, noise, Bins { factor: factor as f64, shift })
}
