//! The profile of a spectral line from a disk around a Kerr hole: flux against g.
//!
//! ```text
//! F(g) = ∫ g³ ε(r) δ(g − g(α, β)) dα dβ
//! ```
//!
//! over the observer's plane of impact parameters (α, β) at infinity, g = ν observed/ν sent, and ε(r) the emissivity in the frame
//! of the matter, alike in all directions: I_ν = ε δ(ν − ν₀). F counts photons per frequency, as a detector does; times g it is the
//! flux of energy. The disk lies in the equatorial plane and is transparent to its own light, so that each image order is seen whole.
//!
//! For each order the screen is divided by isoradials, curves on which light leaves at one radius (`isoradial`). In the coordinates
//! x = 1/√r and the angle ψ around the point of the principal null ray, which meets no plane, the place on the screen is a smooth
//! function, known from few rays: a series of Chebyshev in x and of Fourier in ψ. It is evaluated on a fine grid, and each of
//! its cells spread over the range of g that it has (`spread`). No ray is drawn by chance: a profile has no noise.

mod emissivity;
mod isoradial;
mod mesh;
mod spread;

use std::f64::consts::PI;

use thiserror::Error;

use crate::spacetime::closed::{ClosedForm, NODES};
use crate::spacetime::emitter::{Circular, Sense};
use crate::spacetime::geodesic::{Integrator, Scheme, Tracer};
use crate::spacetime::kerr::horizons;
use crate::spacetime::metric::Kerr;

pub use emissivity::{Emissivity, TableError};
pub use isoradial::{Isoradials, Screen};

/// Image orders that are followed at most: each is e^π times thinner than the one before.
pub const ORDERS: usize = 5;

/// A disk that shines in one line, and where it is seen from.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Spin a in [−1, 1]; matter turns about +z, so that below 0 it goes against the hole.
    pub spin: f64,
    /// Inclination in radians, 0 face-on; not π/2, where the disk has no face.
    pub inclination: f64,
    /// Inner radius, M. Within the last stable orbit matter falls.
    pub inner: f64,
    /// Outer radius, M.
    pub outer: f64,
    /// ε(r).
    pub emissivity: Emissivity,
    /// Image orders to add up, each below [`ORDERS`].
    pub orders: Vec<usize>,
}

/// Why a line has no profile.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum LineError {
    /// The disk has no face there.
    #[error("at an inclination of 90° a thin disk shows no face: give another, as 89.9")]
    EdgeOn,
    /// Not a number within its bounds.
    #[error("{what} is {value}, and has to be {bounds}")]
    OutOfBounds {
        /// What.
        what: &'static str,
        /// As it is.
        value: f64,
        /// As it may be.
        bounds: String,
    },
    /// No image order, or one that is too high.
    #[error("image orders are 0 to {}, one of them at least", ORDERS - 1)]
    Orders,
    /// No bin, or an impossible range.
    #[error("the range of g has to grow, from 0 or more, and have a bin at least")]
    Bins,
    /// The emissivity is not known in the whole disk.
    #[error(
        "the table of emissivity is from r = {} to {} M, and the disk from {inner} to {outer} M",
        .table[0],
        .table[1]
    )]
    Table {
        /// First and last radius of the table.
        table: [f64; 2],
        /// Inner radius of the disk.
        inner: f64,
        /// Outer radius of the disk.
        outer: f64,
    },
    /// Rays did not tell where an image is.
    #[error(
        "the image of order {order} was not found: {failed} of its rays do not meet the disk where they should"
    )]
    NoImage {
        /// The order.
        order: usize,
        /// How many.
        failed: usize,
    },
}

/// Flux in bins of g.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The lower end of the first bin and the upper end of the last.
    pub range: [f64; 2],
    /// F(g) in each bin: the mean density over it, in M² per unit of ε.
    pub flux: Vec<f64>,
    /// The least and the largest g of the line, whatever the bins.
    pub edges: [f64; 2],
}

impl Profile {
    /// The middle of a bin.
    pub fn middle(&self, bin: usize) -> f64 {
        let [low, high] = self.range;
        low + (high - low) * (bin as f64 + 0.5) / self.flux.len() as f64
    }

    /// The largest flux.
    pub fn peak(&self) -> f64 {
        self.flux.iter().copied().fold(0.0, f64::max)
    }
}

/// The tracers that rays of a line can be followed by.
pub fn tracer(spin: f64, integrated: bool) -> Box<dyn Tracer> {
    if integrated {
        Integrator::new(Kerr::new(spin), Scheme::Dop853 { tolerance: 1e-11 }, 10_000).boxed()
    } else {
        Box::new(ClosedForm::new(spin, NODES, 10_000))
    }
}

impl Line {
    /// The last stable orbit of matter about +z: the usual inner radius.
    pub fn isco(spin: f64) -> f64 {
        Circular::kerr(spin, Sense::Prograde).isco().unwrap_or(f64::NAN)
    }

    fn check(&self) -> Result<(), LineError> {
        let bound = |what, value: f64, low: f64, high: f64, bounds: String| {
            if value >= low && value <= high {
                Ok(())
            } else {
                Err(LineError::OutOfBounds { what, value, bounds })
            }
        };
        bound("the spin", self.spin, -1.0, 1.0, "from -1 to 1".to_owned())?;
        bound("the inclination", self.inclination, 0.0, PI, "from 0 to 180°".to_owned())?;
        if self.inclination.cos().abs() < 1e-6 {
            return Err(LineError::EdgeOn);
        }
        let horizon = horizons(self.spin).0;
        let least = 1.001 * horizon;
        bound(
            "the inner radius",
            self.inner,
            least,
            1e5,
            format!("from {least:.6} M, next to the horizon, to 100000"),
        )?;
        let bounds = format!("above the inner radius of {} M and at most 1000000", self.inner);
        bound("the outer radius", self.outer, self.inner * 1.000_001, 1e6, bounds)?;
        if self.orders.is_empty() || self.orders.iter().any(|order| *order >= ORDERS) {
            return Err(LineError::Orders);
        }
        if let Some(table) = self.emissivity.range()
            && (table[0] > self.inner || table[1] < self.outer)
        {
            return Err(LineError::Table { table, inner: self.inner, outer: self.outer });
        }
        Ok(())
    }

    /// The profile in so many bins over a range of g; all of the line if there is none.
    ///
    /// # Errors
    /// If the line, the range or the bins are impossible.
    pub fn profile(
        &self,
        tracer: &dyn Tracer,
        bins: usize,
        range: Option<[f64; 2]>,
    ) -> Result<Profile, LineError> {
        self.check()?;
        if bins == 0 || range.is_some_and(|[low, high]| !(low >= 0.0 && high > low && high.is_finite())) {
            return Err(LineError::Bins);
        }
        let mut meshes = Vec::new();
        for order in &self.orders {
            meshes.extend(mesh::meshes(self, tracer, *order)?);
        }
        let edges = meshes.iter().fold([f64::INFINITY, 0.0], |[low, high], mesh| {
            let [least, most] = mesh.edges();
            [f64::min(low, least), f64::max(high, most)]
        });
        let range = range.unwrap_or(edges);
        let mut spread = spread::Spread::new(range, bins);
        for mesh in &meshes {
            mesh.pour(&mut spread);
        }
        Ok(Profile { range, flux: spread.densities(), edges })
    }
}
