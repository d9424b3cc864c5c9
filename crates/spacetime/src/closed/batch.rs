//! Many rays at once, on SIMD lanes.
//!
//! Rays are classified eight at a time, sorted by the kind of their motion, and followed eight of a kind at a
//! time. What a ray is found to do does not depend on the rays beside it.

use fearless_simd::Simd;

use super::kernel::{self, Meeting, Start, Tables};
use super::photon::Photon;
use super::polar::{Cosines, FEW, FEW_REACH, size_of_nome};
use super::quadrature::Nodes;
use super::radial::{Class, Course, Horizons, Kind};
use super::tracer::{PLANAR, TYPICAL_ERROR};
use crate::geodesic::{Crossing, Fate, Path, Query, Ray, Side};
use crate::lanes::{Lanes, OnLanes};
use crate::metric::{Inverted, Kerr};
use crate::scalar::Scalar;

/// Rays followed at once.
const WIDTH: usize = 8;

/// Rays sorted at once: enough that few lanes stay empty, few enough to stay in the cache.
const MOST: usize = 4096;

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
    /// The Fourier series' cosines.
    pub cosines: Cosines<FEW>,
}

/// Whether a ray can be traced in closed form.
pub fn suits(ray: &Ray) -> bool {
    ray.side == Side::Reversed && ray.energy > 0.0
}

/// A ray ready to be followed among others of its kind.
#[derive(Clone, Copy)]
struct Ready {
    /// Its number.
    ray: u32,
    /// λ, η, u, u′, μ, μ′; inwards, side, shape, lead, end; azimuth.
    numbers: [f64; 12],
}

/// Rays of one kind and end.
struct Group {
    kind: Kind,
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
        for (paths, rays, first) in paths
            .chunks_mut(MOST)
            .zip(rays.chunks(MOST))
            .enumerate()
            .map(|(k, (paths, rays))| (paths, rays, k * MOST))
        {
            run(simd, shared, rays, query, paths, |ray| rest.push(first + ray));
        }
    }
}

#[inline(always)]
fn run<L: Simd>(
    simd: L,
    shared: &Shared,
    rays: &[Ray],
    query: &Query,
    paths: &mut [Path],
    mut rest: impl FnMut(usize),
) {
    let kinds = [Kind::Plain, Kind::Factored, Kind::Spread];
    let mut groups = kinds.map(|kind| {
        [false, true].map(|escapes| Group { kind, escapes, ready: Vec::with_capacity(rays.len()) })
    });
    for first in (0..rays.len()).step_by(WIDTH) {
        let count = WIDTH.min(rays.len() - first);
        let ray = |lane: usize| &rays[first + lane.min(count - 1)];
        let prepared = simd.vectorize(
            #[inline(always)]
            || prepare(simd, shared, ray),
        );
        for lane in 0..count {
            if prepared.careful[lane] > 0.0 || !suits(&rays[first + lane]) {
                rest(first + lane);
                continue;
            }
            let path = &mut paths[first + lane];
            path.clear();
            path.error_estimate = TYPICAL_ERROR * prepared.sensitivity[lane];
            let escapes = prepared.escapes[lane] > 0.0;
            path.fate = if escapes { Fate::Escaped } else { Fate::Captured };
            let kind =
                if prepared.plain[lane] > 0.0 { 0 } else { 1 + usize::from(prepared.spread[lane] > 0.0) };
            let numbers = prepared.numbers.map(|values| values[lane]);
            groups[kind][usize::from(escapes)].ready.push(Ready { ray: (first + lane) as u32, numbers });
        }
    }
    for group in groups.iter().flatten() {
        match (group.kind, query.elapsed) {
            (Kind::Plain, false) => follow::<L, true, false, false>(simd, shared, group, query, paths),
            (Kind::Plain, true) => follow::<L, true, true, false>(simd, shared, group, query, paths),
            (Kind::Factored, false) => follow::<L, false, false, false>(simd, shared, group, query, paths),
            (Kind::Factored, true) => follow::<L, false, true, false>(simd, shared, group, query, paths),
            (Kind::Spread, false) => follow::<L, false, false, true>(simd, shared, group, query, paths),
            (Kind::Spread, true) => follow::<L, false, true, true>(simd, shared, group, query, paths),
        }
    }
}

/// Eight rays, classified.
struct Prepared {
    numbers: [[f64; WIDTH]; 12],
    plain: [f64; WIDTH],
    spread: [f64; WIDTH],
    escapes: [f64; WIDTH],
    sensitivity: [f64; WIDTH],
    careful: [f64; WIDTH],
}

#[inline(always)]
fn prepare<'a, L: Simd>(simd: L, shared: &Shared, ray: impl Fn(usize) -> &'a Ray) -> Prepared {
    let of = |values: [f64; WIDTH]| Lanes::new(simd, values);
    let state = Inverted {
        w: of(std::array::from_fn(|lane| ray(lane).start.w)),
        n: std::array::from_fn(|i| of(std::array::from_fn(|lane| ray(lane).start.n[i]))),
        q: of(std::array::from_fn(|lane| ray(lane).start.q)),
        j: std::array::from_fn(|i| of(std::array::from_fn(|lane| ray(lane).start.j[i]))),
    };
    let energy = of(std::array::from_fn(|lane| ray(lane).energy));
    let spin = energy.constant(shared.metric.spin());
    let photon = Photon::new(spin, energy, &state);
    let class = Class::of(&photon, energy.constant(shared.rim));
    let (zero, one) = (energy.constant(0.0), energy.constant(1.0));
    // Everything must hold; NaN holds nothing.
    let mut fine = Lanes::select(zero.less(energy), one, zero);
    fine *= Lanes::select(zero.constant(PLANAR).less(photon.eta), one, zero);
    let nome = size_of_nome(&photon);
    fine *= Lanes::select(nome.less(zero.constant(FEW_REACH)), one, zero);
    // The axis, and rays that graze the critical curve by less than any digit.
    fine *= Lanes::select((photon.mu * photon.mu).less(one), one, zero);
    fine *= Lanes::select(class.sensitivity.less(zero.constant(1e12)), one, zero);
    let Course { inwards, side, shape, lead, end } = class.course;
    let Photon { lambda, eta, u, u_rate, mu, mu_rate, .. } = photon;
    // From the Kerr–Schild azimuth of n to that of Boyer and Lindquist, atan2(s, r) + tw before.
    let shown = of(std::array::from_fn(|lane| ray(lane).azimuth));
    let azimuth = shown - (spin * u).atan2(one) - Horizons::new(spin).twist(u);
    let numbers = [lambda, eta, u, u_rate, mu, mu_rate, inwards, side, shape, lead, end, azimuth];
    Prepared {
        numbers: numbers.map(Lanes::to_array),
        plain: class.plain.to_array(),
        spread: class.spread.to_array(),
        escapes: class.escapes.to_array(),
        sensitivity: class.sensitivity.to_array(),
        careful: (one - fine).to_array(),
    }
}

/// Follows a group, eight rays at a time.
#[inline(always)]
fn follow<L: Simd, const PLAIN: bool, const TIMED: bool, const SPREAD: bool>(
    simd: L,
    shared: &Shared,
    group: &Group,
    query: &Query,
    paths: &mut [Path],
) {
    let nodes = if PLAIN { &shared.plain } else { &shared.nodes };
    let tables = Tables { nodes, cosines: &shared.cosines };
    for some in group.ready.chunks(WIDTH) {
        let lane_of = |lane: usize| &some[lane.min(some.len() - 1)];
        let number = |k: usize| Lanes::new(simd, std::array::from_fn(|lane| lane_of(lane).numbers[k]));
        let photon = Photon {
            spin: number(0).constant(shared.metric.spin()),
            lambda: number(0),
            eta: number(1),
            u: number(2),
            u_rate: number(3),
            mu: number(4),
            mu_rate: number(5),
        };
        let course = Course {
            inwards: number(6),
            side: number(7),
            shape: number(8),
            lead: number(9),
            end: number(10),
        };
        let start = Start { photon, course, azimuth: number(11) };
        let one = photon.spin.constant(1.0);
        let meet = |meeting: &Meeting<Lanes<L>>| {
            let met = Lanes::select(meeting.met, one, one.constant(0.0)).to_array();
            let [x, y] = meeting.position.map(Lanes::to_array);
            let [r, phi, elapsed] = [meeting.r, meeting.phi, meeting.elapsed].map(Lanes::to_array);
            for (lane, ready) in some.iter().enumerate() {
                if met[lane] > 0.0 {
                    paths[ready.ray as usize].crossings.push(Crossing {
                        position: [x[lane], y[lane], 0.0],
                        r: r[lane],
                        phi: phi[lane],
                        elapsed: if TIMED { elapsed[lane] } else { f64::NAN },
                    });
                }
            }
        };
        let direction = kernel::follow::<_, FEW, PLAIN, TIMED, SPREAD>(
            &start,
            &tables,
            group.escapes,
            query.max_crossings,
            meet,
        );
        if group.escapes {
            let [theta, phi] = direction.map(Lanes::to_array);
            for (lane, ready) in some.iter().enumerate() {
                paths[ready.ray as usize].direction = Some([theta[lane], phi[lane]]);
            }
        }
    }
}
