//! Many rays at once, on SIMD lanes: a convoy of rays side by side, each with steps of its own.
//!
//! All lanes try a step together. A lane whose ray ends takes the next ray that waits. Steps in which something
//! happens are put aside, and looked into when there are as many as lanes (`events`). No lane's numbers depend on
//! another's, so that a ray's path has the same bits whichever rays are beside it.

mod column;
mod events;
mod pair;
mod rank;
mod record;

use super::inverted::{InvertedFlow, PLAIN};
use super::log::{Log, Origin};
use super::method::{Dop853, Tsit5};
use super::walk::{End, Visitor};
use super::{Integrator, Path, Query, Ray, Scheme};
use crate::lanes::{Lanes, OnLanes};
use crate::metric::Metric;
use crate::scalar::Scalar;
use crate::tensor::Vec3;
use column::Column;
use fearless_simd::Simd;
use pair::Pair;
use rank::Rank;

/// Rays to follow, without elapsed time, and where to put what is found.
pub struct Task<'a, M> {
    /// How.
    pub integrator: &'a Integrator<M>,
    /// The rays, all of [`super::Side::Reversed`].
    pub rays: &'a [Ray],
    /// What to find.
    pub query: &'a Query,
    /// A path for each ray.
    pub paths: &'a mut [Path],
    /// For each ray, what is to be added to its azimuth as counted from steps' ends.
    pub corrections: Vec<f64>,
}

impl<M: Metric> Task<'_, M> {
    fn flow(&self, ray: usize) -> InvertedFlow<M, f64> {
        InvertedFlow { metric: self.integrator.reversed, energy: self.rays[ray].energy }
    }

    /// The plane is crossed at state y, whose 1/distance has the rate `approach`.
    fn meet<const D: usize>(&mut self, ray: usize, y: &[f64; D], swept: f64, approach: f64) {
        let (flow, path) = (self.flow(ray), &mut self.paths[ray]);
        if path.crossings.len() < self.query.max_crossings {
            let origin = Origin::of(&flow.metric, &self.rays[ray], self.query);
            Log::new(&flow, flow.metric, self.query, origin, path).crossing(y, swept, approach);
        }
    }

    /// The end of a ray.
    fn conclude<const D: usize>(&mut self, ray: usize, end: &End<D>) {
        let flow = self.flow(ray);
        let azimuth = self.rays[ray].azimuth + end.swept;
        self.integrator.conclude(&self.rays[ray], &flow, end, azimuth, &mut self.paths[ray]);
    }
}

impl<M: Metric> OnLanes for Task<'_, M> {
    type Output = ();

    #[inline(always)]
    fn run<L: Simd>(mut self, simd: L) {
        // Where eight numbers are one register, two of them fill the processor better, unless equations are so long
        // that they fill all registers.
        if const { size_of::<L::f64s>() == 64 && M::PASSES_INFINITY } {
            self.follow::<L, Pair<Lanes<L>>, 16>(simd);
        } else {
            self.follow::<L, Lanes<L>, 8>(simd);
        }
    }
}

impl<M: Metric> Task<'_, M> {
    #[inline(always)]
    fn follow<L: Simd, S: Rank<L, W>, const W: usize>(&mut self, simd: L) {
        match self.integrator.scheme {
            Scheme::Dop853 { .. } => Column::<PLAIN, 12, W>::new().follow::<L, S, M, Dop853>(simd, self),
            Scheme::Tsit5 { .. } => Column::<PLAIN, 6, W>::new().follow::<L, S, M, Tsit5>(simd, self),
            Scheme::Rk4 { .. } => {}
        }
    }
}

/// The place in a state of the inverted chart, or in its slope.
#[inline(always)]
fn inverted_place<S: Scalar, const D: usize>(y: &[S; D]) -> Vec3<S> {
    [y[1], y[2], y[3]]
}
