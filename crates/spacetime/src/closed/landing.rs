//! Where light of an image order leaves the equatorial plane, with derivatives, for many rays at once.

use fearless_simd::Simd;

use super::impact::{Impact, Tables};
use crate::dual::Dual;
use crate::lanes::{Lanes, Level, OnLanes};

/// Rays followed at once.
const WIDTH: usize = 8;

/// 1/r of a crossing of the equatorial plane and its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Landing {
    /// 1/r, continued beyond the ends of the ray: see [`Impact::inverse_radius`].
    pub u: f64,
    /// Its derivatives with respect to spin, inclination, α, β and 1/r of the observer.
    pub gradient: [f64; 5],
}

/// Finds landings on SIMD lanes.
///
/// ```
/// use kerrscope_spacetime::closed::{Landing, Landings};
/// let landings = Landings::default();
/// let mut found = [Landing::default(); 2];
/// let near = [[4.0, -6.0], [4.0 + 1e-5, -6.0]];
/// landings.find([0.9, 1.0, 0.0], 0, &near, &mut found);
/// let difference = (found[1].u - found[0].u) / 1e-5;
/// assert!((found[0].gradient[2] / difference - 1.0).abs() < 1e-4);
/// ```
#[derive(Clone, Debug)]
pub struct Landings {
    level: Level,
    tables: Tables,
}

impl Default for Landings {
    /// With the best instructions that the processor has.
    fn default() -> Self {
        Self::new(Level::best())
    }
}

impl Landings {
    /// With given vector instructions.
    pub fn new(level: Level) -> Self {
        Self { level, tables: Tables::default() }
    }

    /// The landings of rays of impact parameters (α, β), M, at crossing number `order`, for a hole and an observer of spin a,
    /// inclination i in radians, and 1/r.
    ///
    /// # Panics
    /// If there is not a place for each ray.
    pub fn find(&self, hole: [f64; 3], order: usize, rays: &[[f64; 2]], found: &mut [Landing]) {
        assert_eq!(rays.len(), found.len(), "a landing for each ray");
        self.level.run(Batch { tables: &self.tables, hole, order, rays, found });
    }

    /// The same landings with one derivative alone, with respect to a step of (α, β): 1/r and ∂(1/r)/∂step. It takes a third of the
    /// time.
    ///
    /// # Panics
    /// If there is not a step and a place for each ray.
    pub fn along(
        &self,
        hole: [f64; 3],
        order: usize,
        rays: &[[f64; 2]],
        steps: &[[f64; 2]],
        found: &mut [[f64; 2]],
    ) {
        assert_eq!(rays.len(), found.len(), "a landing for each ray");
        assert_eq!(rays.len(), steps.len(), "a step for each ray");
        self.level.run(Along { tables: &self.tables, hole, order, rays, steps, found });
    }
}

struct Batch<'a> {
    tables: &'a Tables,
    hole: [f64; 3],
    order: usize,
    rays: &'a [[f64; 2]],
    found: &'a mut [Landing],
}

struct Along<'a> {
    tables: &'a Tables,
    hole: [f64; 3],
    order: usize,
    rays: &'a [[f64; 2]],
    steps: &'a [[f64; 2]],
    found: &'a mut [[f64; 2]],
}

/// α and β on lanes; those beyond the last ray follow the first again.
#[inline(always)]
fn on_lanes(pairs: &[[f64; 2]]) -> [[f64; WIDTH]; 2] {
    let (mut first, mut second) = ([0.0; WIDTH], [0.0; WIDTH]);
    for lane in 0..WIDTH {
        [first[lane], second[lane]] = pairs[if lane < pairs.len() { lane } else { 0 }];
    }
    [first, second]
}

impl OnLanes for Along<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Simd>(self, simd: L) {
        let [spin, inclination, u] = self.hole;
        let both = self.rays.chunks(WIDTH).zip(self.steps.chunks(WIDTH));
        for ((rays, steps), found) in both.zip(self.found.chunks_mut(WIDTH)) {
            let (places, steps) = (on_lanes(rays), on_lanes(steps));
            simd.vectorize(
                #[inline(always)]
                || {
                    let fixed = |value: f64| Dual::<Lanes<L>, 1>::fixed(Lanes::new(simd, [value; WIDTH]));
                    let moving = |k: usize| Dual {
                        value: Lanes::new(simd, places[k]),
                        gradient: [Lanes::new(simd, steps[k])],
                    };
                    let impact = Impact {
                        spin: fixed(spin),
                        inclination: fixed(inclination),
                        alpha: moving(0),
                        beta: moving(1),
                        u: fixed(u),
                    };
                    let u = impact.inverse_radius(self.tables, self.order);
                    let (values, slopes) = (u.value.to_array(), u.gradient[0].to_array());
                    for (lane, landing) in found.iter_mut().enumerate() {
                        *landing = [values[lane], slopes[lane]];
                    }
                },
            );
        }
    }
}

impl OnLanes for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Simd>(self, simd: L) {
        let [spin, inclination, u] = self.hole;
        for (rays, found) in self.rays.chunks(WIDTH).zip(self.found.chunks_mut(WIDTH)) {
            let [alpha, beta] = on_lanes(rays);
            simd.vectorize(
                #[inline(always)]
                || {
                    let [alpha, beta] = [Lanes::new(simd, alpha), Lanes::new(simd, beta)];
                    let same = |value: f64| Lanes::new(simd, [value; WIDTH]);
                    let at = [same(spin), same(inclination), alpha, beta, same(u)];
                    let [spin, inclination, alpha, beta, u] = Dual::<Lanes<L>, 5>::variables(at);
                    let u =
                        Impact { spin, inclination, alpha, beta, u }.inverse_radius(self.tables, self.order);
                    let values = u.value.to_array();
                    for (lane, landing) in found.iter_mut().enumerate() {
                        landing.u = values[lane];
                    }
                    for k in 0..5 {
                        let slopes = u.gradient[k].to_array();
                        for (lane, landing) in found.iter_mut().enumerate() {
                            landing.gradient[k] = slopes[lane];
                        }
                    }
                },
            );
        }
    }
}
