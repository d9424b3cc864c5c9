//! The geodesic from one point to another.
//!
//! Shooting: a velocity v at the first point leads to x(1; v); Newton's method makes it the second point, with the exact
//! derivative ∂x(1)/∂v by dual numbers through the integrator. The second point moves to its place from next to the first
//! in steps, each from the solution of the one before; where that fails, other guesses are tried.

use super::motion::{Stop, drive, pack, unpack};
use super::{Geometry, Options, matrix};
use crate::dual::Dual;

/// How geodesics between points are searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// How they are integrated.
    pub options: Options,
    /// Turns around periodic coordinates to try in either sense, 0 for the nearest way alone.
    pub turns: u32,
}

impl Default for Search {
    fn default() -> Self {
        Self { options: Options { tolerance: 1e-13, max_steps: 2_000 }, turns: 1 }
    }
}

/// A geodesic between two points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Connected<const N: usize> {
    /// dx^μ/ds at the first point, s from 0 to 1.
    pub velocity: [f64; N],
    /// The second point, with whole periods added for turns.
    pub end: [f64; N],
    /// g(v, v): positive if spacelike, negative if timelike; its square root is the proper length or time.
    pub norm: f64,
    /// How far from the second point it ends, largest in any coordinate.
    pub miss: f64,
    /// Whether the second point is conjugate to the first, or nearly so: then this is one of a family of geodesics.
    pub conjugate: bool,
}

impl<const N: usize> Connected<N> {
    /// Proper length or proper time.
    pub fn length(&self) -> f64 {
        self.norm.abs().sqrt()
    }
}

/// No geodesic was found. That does not mean that there is none.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "no geodesic between the points was found: of {starts} starts the best misses the second point by {miss:.1e}; \
     there may be none within these coordinates, or it may need a guess of its own"
)]
pub struct NotConnected {
    /// Starts tried.
    pub starts: usize,
    /// The least miss, in units of the coordinates.
    pub miss: f64,
}

/// A miss at which a geodesic counts as found, relative to the size of coordinates.
const HIT: f64 = 1e-11;
const NEWTON_STEPS: usize = 20;
/// Largest change of a velocity in one step, as a share of it.
const MOST_CHANGE: f64 = 0.3;
/// Smallest move of the second point on its way from the first, as a share.
const LEAST_MOVE: f64 = 1.0 / 64.0;
const VARIED_STARTS: usize = 8;

/// The geodesics from a to b: one for each number of turns of [`Search::turns`] that has one, the shortest first (by
/// the way in coordinates where lengths may be timelike).
///
/// # Errors
/// If none is found.
pub fn between<G: Geometry<N>, const N: usize>(
    geometry: &G,
    a: &[f64; N],
    b: &[f64; N],
    search: &Search,
) -> Result<Vec<Connected<N>>, NotConnected> {
    let shooter = Shooter { geometry, a, options: &search.options };
    let mut found: Vec<Connected<N>> = Vec::new();
    let mut failure = NotConnected { starts: 0, miss: f64::INFINITY };
    for (number, target) in targets(geometry, a, b, search.turns).iter().enumerate() {
        if let Some(connected) = shooter.reach(target, number == 0, &mut failure) {
            let known = |c: &Connected<N>| {
                let apart = (0..N).map(|i| (c.velocity[i] - connected.velocity[i]).abs());
                apart.fold(0.0, f64::max) < 1e-6
            };
            if !found.iter().any(known) {
                found.push(connected);
            }
        }
    }
    if found.is_empty() {
        return Err(failure);
    }
    if found.iter().all(|c| c.norm > 0.0) {
        found.sort_by(|one, other| one.norm.total_cmp(&other.norm));
    }
    Ok(found)
}

/// The second point with whole periods added, the nearest first.
fn targets<G: Geometry<N>, const N: usize>(
    geometry: &G,
    a: &[f64; N],
    b: &[f64; N],
    turns: u32,
) -> Vec<[f64; N]> {
    let mut all = vec![*b];
    for (i, coordinate) in geometry.coordinates().iter().enumerate() {
        let Some(period) = coordinate.period else { continue };
        let nearest = b[i] - ((b[i] - a[i]) / period).round() * period;
        all = all
            .iter()
            .flat_map(|target| {
                (-i64::from(turns)..=i64::from(turns)).map(|k| {
                    let mut moved = *target;
                    moved[i] = nearest + k as f64 * period;
                    moved
                })
            })
            .collect();
    }
    let way = |x: &[f64; N]| (0..N).map(|i| (x[i] - a[i]).powi(2)).sum::<f64>();
    all.sort_by(|one, other| way(one).total_cmp(&way(other)));
    all
}

struct Shooter<'a, G, const N: usize> {
    geometry: &'a G,
    a: &'a [f64; N],
    options: &'a Options,
}

/// Where a shot ends, and how that depends on its velocity.
struct Shot<const N: usize> {
    end: [f64; N],
    slope: [[f64; N]; N],
}

impl<G: Geometry<N>, const N: usize> Shooter<'_, G, N> {
    fn shoot(&self, v: &[f64; N]) -> Option<Shot<N>> {
        let g = self.geometry.metric(self.a).map(|row| row.map(Dual::<f64, N>::fixed));
        let p = matrix::apply(&g, &Dual::variables(*v));
        let y = pack(&self.a.map(Dual::fixed), &p);
        let Options { tolerance, max_steps } = *self.options;
        let arrival = drive::<_, _, N>(self.geometry, y, 1.0, tolerance, max_steps, None);
        let (x, _) = unpack::<_, N>(&arrival.y);
        (arrival.stop == Stop::Complete)
            .then(|| Shot { end: x.map(|c| c.value), slope: x.map(|c| c.gradient) })
    }

    /// The largest difference from the target, and against the size of its coordinates.
    fn miss(end: &[f64; N], target: &[f64; N]) -> [f64; 2] {
        let mut largest = [0.0_f64; 2];
        for i in 0..N {
            let off = (end[i] - target[i]).abs();
            largest = [largest[0].max(off), largest[1].max(off / (1.0 + target[i].abs()))];
        }
        largest
    }

    /// Newton's method from a velocity, its steps halved until they lead nearer.
    fn newton(&self, target: &[f64; N], guess: &[f64; N], least: &mut f64) -> Option<Connected<N>> {
        let mut v = *guess;
        let mut shot = self.shoot(&v)?;
        let mut polished = false;
        for _ in 0..NEWTON_STEPS {
            let [off, share] = Self::miss(&shot.end, target);
            *least = least.min(off);
            if share < HIT && (polished || off == 0.0) {
                return Some(self.connected(target, &v, &shot));
            }
            let wanted = std::array::from_fn(|i| target[i] - shot.end[i]);
            let step = matrix::solve(&shot.slope, &wanted);
            if !step.iter().all(|c| c.is_finite()) {
                return if share < HIT { Some(self.connected(target, &v, &shot)) } else { None };
            }
            // A long step may lead to another geodesic than that which the guess is near.
            let size = |a: &[f64; N]| a.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
            let longest = MOST_CHANGE * size(&v) / size(&step);
            let mut nearer = None;
            let mut scale = longest.min(1.0);
            let least_scale = 0.01 * scale;
            while nearer.is_none() && scale > least_scale {
                let tried = std::array::from_fn(|i| v[i] + scale * step[i]);
                let better = |s: &Shot<N>| Self::miss(&s.end, target)[1] < (1.0 - 0.1 * scale) * share;
                nearer = self.shoot(&tried).filter(better).map(|s| (tried, s));
                scale *= 0.5;
            }
            polished = share < HIT;
            match nearer {
                Some((tried, next)) => (v, shot) = (tried, next),
                // What cannot be bettered by the last bits is good.
                None if polished => return Some(self.connected(target, &v, &shot)),
                None => return None,
            }
        }
        None
    }

    fn connected(&self, target: &[f64; N], v: &[f64; N], shot: &Shot<N>) -> Connected<N> {
        let size = |m: &[[f64; N]; N]| m.as_flattened().iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let condition = size(&shot.slope) * size(&matrix::invert(&shot.slope));
        Connected {
            velocity: *v,
            end: *target,
            norm: matrix::product(&self.geometry.metric(self.a), v, v),
            miss: Self::miss(&shot.end, target)[0],
            conjugate: !(condition < 1e8),
        }
    }

    /// A target that moves to its place first, so that what is found belongs to the short geodesics next to the first
    /// point; if that fails, the straight line, and if it is worth it varied starts.
    fn reach(&self, target: &[f64; N], thorough: bool, failure: &mut NotConnected) -> Option<Connected<N>> {
        let chord: [f64; N] = std::array::from_fn(|i| target[i] - self.a[i]);
        failure.starts += 1;
        if let Some(found) = self.creep(target, &chord, failure) {
            return Some(found);
        }
        failure.starts += 1;
        if let Some(found) = self.newton(target, &chord, &mut failure.miss) {
            return Some(found);
        }
        if !thorough {
            return None;
        }
        (1..=VARIED_STARTS).find_map(|k| {
            failure.starts += 1;
            // Fractions of the golden section and its like spread evenly without chance.
            let varied = std::array::from_fn(|i| {
                let spread =
                    (k as f64 * [0.8191725134, 0.6710436067, 0.5497004779, 0.4503495861][i % 4]).fract();
                chord[i] + (2.0 * spread - 1.0) * (0.3 + chord[i].abs())
            });
            self.newton(target, &varied, &mut failure.miss)
        })
    }

    /// Moves the target from near the first point to its place.
    fn creep(&self, target: &[f64; N], chord: &[f64; N], failure: &mut NotConnected) -> Option<Connected<N>> {
        let (mut at, mut step) = (0.0, 0.25);
        let mut v = [0.0; N];
        loop {
            let next = f64::min(at + step, 1.0);
            let goal = std::array::from_fn(|i| self.a[i] + next * chord[i]);
            let guess = std::array::from_fn(|i| if at > 0.0 { v[i] * next / at } else { next * chord[i] });
            let mut least = f64::INFINITY;
            match self.newton(&goal, &guess, &mut least) {
                Some(found) if next >= 1.0 => return Some(Connected { end: *target, ..found }),
                Some(found) => {
                    (at, v) = (next, found.velocity);
                    step = (step * 1.5).min(0.25);
                }
                None => step *= 0.5,
            }
            if step < LEAST_MOVE {
                failure.miss =
                    failure.miss.min((0..N).map(|i| (1.0 - at) * chord[i].abs()).fold(0.0, f64::max));
                return None;
            }
        }
    }
}
