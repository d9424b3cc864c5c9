//! Many rays at once, on SIMD lanes.
//!
//! Rays are classified eight at a time, sorted by the kind of their motion, and followed eight of a kind at a
//! time. What a ray is found to do does not depend on the rays beside it.

use fearless_simd::Simd;

use super::course::Kind;
use super::distant::{self, Distant};
use super::kernel::{self, Meeting, Radial, Start};
use super::polar::{FEW, LARGE, SOME};
use super::quadrature::Nodes;
use super::radial::Sweep;
use super::ready::{NUMBERS, Prepared, Ready};
use super::series::Cosines;
use super::tracer::TYPICAL_ERROR;
use crate::geodesic::{Crossing, Fate, Path, Query, Ray, Side};
use crate::lanes::{Lanes, OnLanes};
use crate::metric::Kerr;
use crate::scalar::Scalar;

/// Rays followed at once.
pub const WIDTH: usize = 8;

/// Rays sorted at once: enough that few lanes stay empty, few enough to stay in the cache.
const MOST: usize = 1024;

/// What all rays around one hole share.
#[derive(Clone, Debug)]
pub struct Shared {
    /// s = −a: rays are followed in the spacetime reversed in time.
    pub metric: Kerr,
    /// 1/r₊.
    pub rim: f64,
    /// Nodes of the quadratures.
    pub nodes: Nodes,
    /// Nodes for the motions that are not factored.
    pub plain: Nodes,
    /// Cosines of the series of the motion in θ.
    pub few: Cosines<FEW>,
    /// The same for larger nomes.
    pub some: Cosines<SOME>,
    /// The same for large ones.
    pub large: Box<Cosines<LARGE>>,
    /// Cosines of the series of distant motion.
    pub distant: Cosines<{ distant::TERMS }>,
    /// The same for remote motion.
    pub remote: Cosines<{ distant::REMOTE_TERMS }>,
}

/// Whether a ray can be traced in closed form.
pub fn suits(ray: &Ray) -> bool {
    ray.side == Side::Reversed && ray.energy > 0.0
}

/// Rays that are followed alike.
struct Group {
    kind: Kind,
    /// How many terms their motion in θ needs: 0 for [`FEW`], 1 for [`SOME`], 2 for [`LARGE`].
    width: usize,
    escapes: bool,
    ready: Vec<Ready>,
}

/// Rays to follow, and where to put what is found.
pub struct Batch<'a> {
    /// What they share.
    pub shared: &'a Shared,
    /// The rays.
    pub rays: &'a [Ray],
    /// What to find.
    pub query: &'a Query,
    /// A path for each ray.
    pub paths: &'a mut [Path],
    /// Is told the numbers of rays that need more care, whose paths are left as they are.
    pub rest: &'a mut Vec<usize>,
}

impl OnLanes for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Simd>(self, simd: L) {
        let Self { shared, rays, query, paths, rest } = self;
        let mut groups = Groups::new();
        for first in (0..rays.len()).step_by(MOST) {
            let range = first..rays.len().min(first + MOST);
            groups.run(simd, shared, &rays[range.clone()], query, &mut paths[range], |ray| {
                rest.push(first + ray);
            });
        }
    }
}

struct Groups(Vec<Group>);

impl Groups {
    fn new() -> Self {
        let mut groups = Vec::new();
        for kind in Kind::ALL {
            for escapes in [false, true] {
                groups.push(Group { kind, width: 0, escapes, ready: Vec::new() });
            }
        }
        for width in [1, 2] {
            for escapes in [false, true] {
                groups.push(Group { kind: Kind::Plain, width, escapes, ready: Vec::new() });
            }
        }
        Self(groups)
    }

    /// The group of a kind, and of those whose motion in θ needs more terms.
    fn of(&mut self, kind: Kind, width: usize, escapes: bool) -> &mut Vec<Ready> {
        let number = if width > 0 { Kind::ALL.len() + width - 1 } else { kind as usize };
        &mut self.0[2 * number + usize::from(escapes)].ready
    }

    #[inline(always)]
    fn run<L: Simd>(
        &mut self,
        simd: L,
        shared: &Shared,
        rays: &[Ray],
        query: &Query,
        paths: &mut [Path],
        mut rest: impl FnMut(usize),
    ) {
        for group in &mut self.0 {
            group.ready.clear();
        }
        for first in (0..rays.len()).step_by(WIDTH) {
            let count = WIDTH.min(rays.len() - first);
            let prepared = simd.vectorize(
                #[inline(always)]
                || Prepared::new(simd, shared, &rays[first..first + count]),
            );
            for lane in 0..count {
                let is = |flags: &[f64; WIDTH]| flags[lane] > 0.0;
                let flags = [&prepared.plain, &prepared.spread, &prepared.distant].map(|flags| flags[lane]);
                if is(&prepared.careful) || !suits(&rays[first + lane]) {
                    rest(first + lane);
                    continue;
                }
                let kind = Kind::of(flags, query.elapsed);
                let width = prepared.width[lane] as usize;
                if width > 0 && kind != Kind::Plain {
                    rest(first + lane);
                    continue;
                }
                let path = &mut paths[first + lane];
                path.clear();
                path.error_estimate = TYPICAL_ERROR * prepared.sensitivity[lane];
                let escapes = is(&prepared.escapes);
                path.fate = if escapes { Fate::Escaped } else { Fate::Captured };
                // Light that never meets the plane and falls in is known.
                if is(&prepared.planar) {
                    continue;
                }
                let mut numbers = [0.0; NUMBERS];
                for (number, values) in numbers.iter_mut().zip(&prepared.numbers) {
                    *number = values[lane];
                }
                self.of(kind, width, escapes).push(Ready { ray: (first + lane) as u32, numbers });
            }
        }
        for group in &self.0 {
            let work = Work { shared, query, group };
            match (group.kind, query.elapsed, group.width) {
                (Kind::Plain, false, 0) => {
                    work.sweep::<L, true, false, false, FEW>(simd, &shared.few, paths);
                }
                (Kind::Plain, true, 0) => {
                    work.sweep::<L, true, true, false, FEW>(simd, &shared.few, paths);
                }
                (Kind::Plain, false, 1) => {
                    work.sweep::<L, true, false, false, SOME>(simd, &shared.some, paths);
                }
                (Kind::Plain, true, 1) => {
                    work.sweep::<L, true, true, false, SOME>(simd, &shared.some, paths);
                }
                (Kind::Plain, false, _) => {
                    work.sweep::<L, true, false, false, LARGE>(simd, &shared.large, paths);
                }
                (Kind::Plain, true, _) => {
                    work.sweep::<L, true, true, false, LARGE>(simd, &shared.large, paths);
                }
                (Kind::Factored, false, _) => {
                    work.sweep::<L, false, false, false, FEW>(simd, &shared.few, paths);
                }
                (Kind::Factored, true, _) => {
                    work.sweep::<L, false, true, false, FEW>(simd, &shared.few, paths);
                }
                (Kind::Spread, false, _) => {
                    work.sweep::<L, false, false, true, FEW>(simd, &shared.few, paths);
                }
                (Kind::Spread, true, _) => work.sweep::<L, false, true, true, FEW>(simd, &shared.few, paths),
                (Kind::Distant, ..) => work.distant(simd, &shared.distant, paths),
                (Kind::Remote, ..) => work.distant(simd, &shared.remote, paths),
            }
        }
    }
}

/// A group to follow.
struct Work<'a> {
    shared: &'a Shared,
    query: &'a Query,
    group: &'a Group,
}

impl Work<'_> {
    #[inline(always)]
    fn distant<L: Simd, const N: usize>(&self, simd: L, cosines: &Cosines<N>, paths: &mut [Path]) {
        for some in self.group.ready.chunks(WIDTH) {
            simd.vectorize(
                #[inline(always)]
                || {
                    let start = Ready::start(simd, some, self.shared.metric.spin());
                    let radial = Distant::new(&start, cosines);
                    self.follow::<L, _, FEW, false>(some, &start, &radial, &self.shared.few, paths);
                },
            );
        }
    }

    #[inline(always)]
    fn sweep<L: Simd, const PLAIN: bool, const TIMED: bool, const SPREAD: bool, const N: usize>(
        &self,
        simd: L,
        cosines: &Cosines<N>,
        paths: &mut [Path],
    ) {
        let nodes = if PLAIN { &self.shared.plain } else { &self.shared.nodes };
        for some in self.group.ready.chunks(WIDTH) {
            simd.vectorize(
                #[inline(always)]
                || {
                    let start = Ready::start(simd, some, self.shared.metric.spin());
                    let radial = Sweep::<_, PLAIN, TIMED>::new::<SPREAD>(&start, nodes);
                    self.follow::<L, _, N, TIMED>(some, &start, &radial, cosines, paths);
                },
            );
        }
    }

    #[inline(always)]
    fn follow<L: Simd, R: Radial<Lanes<L>>, const N: usize, const TIMED: bool>(
        &self,
        some: &[Ready],
        start: &Start<Lanes<L>>,
        radial: &R,
        cosines: &Cosines<N>,
        paths: &mut [Path],
    ) {
        let one = start.azimuth.constant(1.0);
        let meet = |meeting: &Meeting<Lanes<L>>| {
            let met = Lanes::select(meeting.met, one, one.constant(0.0)).to_array();
            let [x, y] = meeting.position;
            let (x, y) = (x.to_array(), y.to_array());
            let (r, phi, elapsed) =
                (meeting.r.to_array(), meeting.phi.to_array(), meeting.elapsed.to_array());
            let (normal, inwards) = (meeting.normal.to_array(), meeting.inwards.to_array());
            for (lane, ready) in some.iter().enumerate() {
                if met[lane] > 0.0 {
                    paths[ready.ray as usize].crossings.push(Crossing {
                        position: [x[lane], y[lane], 0.0],
                        r: r[lane],
                        phi: phi[lane],
                        elapsed: elapsed[lane],
                        normal: normal[lane],
                        outward: inwards[lane] > 0.0,
                    });
                }
            }
        };
        let count = self.query.max_crossings;
        let [theta, phi] =
            kernel::follow::<_, R, N, TIMED>(start, radial, cosines, self.group.escapes, count, meet);
        if self.group.escapes {
            let (theta, phi) = (theta.to_array(), phi.to_array());
            for (lane, ready) in some.iter().enumerate() {
                paths[ready.ray as usize].direction = Some([theta[lane], phi[lane]]);
            }
        }
    }
}
