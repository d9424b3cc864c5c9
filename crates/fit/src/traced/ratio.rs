//! The image of an order in a spacetime given as text, by its ratio to that around the Kerr hole of the same spin.
//!
//! Both images are taken at the same t and χ, so that they end at the last stable orbit of their own; ρ = Q ρ_Kerr. Q is smoother than
//! either, and needs far fewer nodes: each of them is found by secants, from rays that the integrator follows. What it changes by with
//! a parameter p at a fixed ρ is known from rays in neighbouring spacetimes,
//!
//! ```text
//! ∂ln ρ/∂p at fixed ψ and x = −(∂x/∂p)/(∂x/∂ln ρ),
//! ```
//!
//! with the slope of the series in t, and that is kept less Kerr's.

use std::f64::consts::PI;

use super::order::{HOLE, NODES, Nodes, NotFound, VALUES, View, node, periodic, scale};
use super::secant::{FIRST, Search};
use super::sight::{Landing, Sight};
use super::tabulated::difference;

/// Nodes of Q in t at most, and per image order: the thinner an image, the less Q changes across it. With these, pictures are within
/// 4e-5 of their brightest of those with 20, 20 and 10 (Johannsen's a13 from −2 to 3, all of his four at 1, a charge of 0.6).
const COARSE: usize = 8;
const NODES_OF: [usize; 4] = [COARSE, 6, 3, 3];

/// The order from which on derivatives are not traced: what an image that is so thin moves by more than Kerr's is what the inner edge of
/// the one before does, which is next to the critical curve as well.
const INHERITED: usize = 2;

/// Directions with which Q is tried first.
const DIRECTIONS: usize = 8;

/// The last terms around, in ln Q, at which there are directions enough, per image order.
const CONVERGED: [f64; 4] = [1e-4, 4e-5, 2e-5, 1e-5];

/// Rays of a search at most.
const STEPS: usize = 60;

/// The image around the Kerr hole.
pub struct Base<'a> {
    /// From where it is seen.
    pub view: &'a View,
    /// Its nodes.
    pub nodes: &'a Nodes,
    /// x at the inner edge, and in each direction at the outer edge.
    pub ends: (f64, &'a [f64]),
}

/// The observer in neighbouring spacetimes, or at neighbouring places, a step below and above in one parameter.
pub struct Moved {
    /// Both.
    pub sides: [Option<Sight>; 2],
    /// The step.
    pub step: f64,
    /// Which of the Kerr hole's parameters changes along, and by how much per change of this one.
    pub kerr: (usize, f64),
}

/// An image that is looked for.
pub struct Sought<'a> {
    /// Its order.
    pub order: usize,
    /// That around the Kerr hole.
    pub base: Base<'a>,
    /// Who sees it.
    pub sight: &'a Sight,
    /// x at the inner edge, and in each direction at the outer edge.
    pub ends: (f64, &'a [f64]),
    /// Neighbours, of which derivatives are found.
    pub moved: &'a [Moved],
    /// What is known from the order before.
    pub before: Option<&'a Critical>,
}

/// What an image has next to the critical curve, at its inner edge in equal steps around.
#[derive(Clone, Debug)]
pub struct Critical {
    /// ln Q.
    ratio: Vec<f64>,
    /// ∂ln ρ/∂p less Kerr's for each parameter.
    drifts: Vec<Vec<f64>>,
}

/// The image of an order.
pub struct Image {
    /// ρ at the nodes of the Kerr image.
    pub nodes: Nodes,
    /// ∂ln ρ/∂p for each parameter, node by node.
    pub drifts: Vec<Vec<f64>>,
    /// What helps to find the next order.
    pub critical: Critical,
}

/// What is known of the Kerr image at the coarse nodes of a direction.
struct Along {
    /// ln ρ, and its derivative in t.
    log: [[f64; 2]; COARSE],
    /// Kerr's derivatives.
    drift: [[f64; HOLE]; COARSE],
}

/// An image that was found, and what of the Kerr image is at its nodes.
struct Found {
    along: Vec<Along>,
    /// How much of the values at the nodes makes the slopes there.
    slopes: Vec<Vec<[f64; 2]>>,
    /// ρ and (cos ψ, sin ψ) of all nodes.
    places: Vec<(f64, [f64; 2])>,
}

/// t of a coarse node of so many.
fn coarse(count: usize, k: usize) -> f64 {
    0.5 - 0.5 * (PI * k as f64 / (count - 1) as f64).cos()
}

/// A function of the angle known at equal steps around, by Fourier's series.
fn around(values: &[f64], chi: f64) -> f64 {
    let count = values.len();
    let share = |j: usize| periodic(count, chi - 2.0 * PI * j as f64 / count as f64);
    values.iter().enumerate().map(|(j, value)| value * share(j)).sum()
}

/// How much of the values at so many of Chebyshev's nodes makes the value at t, and the derivative there.
fn shares(count: usize, t: f64) -> Vec<[f64; 2]> {
    let n = (count - 1) as f64;
    let z = (2.0 * t - 1.0).clamp(-1.0, 1.0);
    let (mut basis, mut slopes) = (vec![1.0, z], vec![0.0, 2.0]);
    for k in 2..count {
        basis.push(2.0 * z * basis[k - 1] - basis[k - 2]);
        slopes.push(4.0 * basis[k - 1] + 2.0 * z * slopes[k - 1] - slopes[k - 2]);
    }
    let half = |k: usize| if k == 0 || k == count - 1 { 0.5 } else { 1.0 };
    (0..count)
        .map(|j| {
            // Nodes go from z = −1, cos(π (1 − j/n)).
            let mut share = [0.0; 2];
            for k in 0..count {
                let own = (PI * k as f64 * (1.0 - j as f64 / n)).cos() * half(k);
                share = [share[0] + own * basis[k], share[1] + own * slopes[k]];
            }
            share.map(|share| 2.0 / n * half(j) * share)
        })
        .collect()
}

impl Sought<'_> {
    /// Finds the image.
    ///
    /// # Errors
    /// If some light does not come from where it should.
    pub fn find(&self) -> Result<Image, NotFound> {
        let full = self.base.nodes.directions;
        let mut count = DIRECTIONS.min(full);
        // The direct image lies elsewhere than all others, which are next to each other.
        let guess = self.before.filter(|_| self.order > 1).map_or(&[0.0; 2][..], |before| &before.ratio);
        let mut ratios = self.settle(&every(full, count, false), guess)?;
        loop {
            if count == full || tail(&ratios, self.nodes()) < CONVERGED[self.order] {
                return Ok(self.spread(&ratios));
            }
            // As many directions between those.
            let middles: Vec<f64> = ratios.iter().map(|ratio| ratio[self.nodes() / 2]).collect();
            let between = self.settle(&every(full, 2 * count, true), &middles)?;
            ratios = ratios.into_iter().zip(between).flat_map(|(a, b)| [a, b]).collect();
            count *= 2;
        }
    }

    /// How many nodes of Q there are in t.
    fn nodes(&self) -> usize {
        NODES_OF[self.order]
    }

    /// For each of them, how much of the values at `count` of Chebyshev's nodes makes the value and the slope there.
    fn table(&self, count: usize) -> Vec<Vec<[f64; 2]>> {
        (0..self.nodes()).map(|k| shares(count, coarse(self.nodes(), k))).collect()
    }

    fn chi(&self, direction: usize) -> f64 {
        2.0 * PI * direction as f64 / self.base.nodes.directions as f64
    }

    fn polar(&self, direction: usize) -> [f64; 2] {
        let (sin, cos) = self.base.view.angle(self.chi(direction))[0].sin_cos();
        [cos, sin]
    }

    /// x of the image at t, and its derivative in t.
    fn target(&self, direction: usize, t: f64) -> [f64; 2] {
        let (inner, outer) = (self.ends.0, self.ends.1[direction]);
        [inner + (outer - inner) * t, outer - inner]
    }

    /// The Kerr image along a direction.
    fn along(&self, direction: usize, table: &[Vec<[f64; 2]>]) -> Along {
        let values = &self.base.nodes.values[direction * NODES..][..NODES];
        let weight = self.base.view.weight(self.chi(direction));
        let (inner, outer) = (self.base.ends.0, self.base.ends.1[direction]);
        let mut along = Along { log: [[0.0; 2]; COARSE], drift: [[0.0; HOLE]; COARSE] };
        for (k, shares) in table.iter().enumerate() {
            let (mut y, mut slope) = (0.0, 0.0);
            for (share, value) in shares.iter().zip(values) {
                y += share[0] * value[0];
                slope += share[1] * value[0];
                for p in 0..HOLE {
                    along.drift[k][p] += share[0] * value[1 + p];
                }
            }
            // y = w/(ρ s)², s = x² for the direct image and 1 for others.
            let x = inner + (outer - inner) * coarse(self.nodes(), k);
            let log = 0.5 * (weight / y).ln() - scale(self.order, x).ln();
            let per_x = if self.order == 0 { 2.0 / x } else { 0.0 };
            along.log[k] = [log, -0.5 * slope / y - per_x * (outer - inner)];
        }
        along
    }

    /// ln Q at the coarse nodes of directions.
    fn settle(&self, directions: &[usize], guess: &[f64]) -> Result<Vec<[f64; COARSE]>, NotFound> {
        let table = self.table(NODES);
        let along: Vec<Along> = directions.iter().map(|d| self.along(*d, &table)).collect();
        let mut ratios = vec![[0.0; COARSE]; directions.len()];
        let search = |at: usize, node: usize, log: f64| {
            let [target, rate] = self.target(directions[at], coarse(self.nodes(), node));
            Search {
                direction: at,
                node,
                target,
                slope: rate / along[at].log[node][1],
                log,
                low: f64::NEG_INFINITY,
                high: f64::INFINITY,
                last: None,
                grow: FIRST[self.order],
                done: false,
            }
        };
        // One node in the middle first, from which all the others are near.
        let first = self.nodes() / 2;
        let mut searches: Vec<Search> = (0..directions.len())
            .map(|at| search(at, first, around(guess, self.chi(directions[at]))))
            .collect();
        self.run(&mut searches, directions, &along)?;
        let middles: Vec<f64> = searches.iter().map(|found| found.log).collect();
        let mut rest: Vec<Search> = (0..directions.len())
            .flat_map(|at| (0..self.nodes()).filter(|k| *k != first).map(move |k| (at, k)))
            .map(|(at, k)| search(at, k, middles[at]))
            .collect();
        self.run(&mut rest, directions, &along)?;
        for found in searches.iter().chain(&rest) {
            ratios[found.direction][found.node] = found.log;
        }
        Ok(ratios)
    }

    fn run(&self, searches: &mut [Search], directions: &[usize], along: &[Along]) -> Result<(), NotFound> {
        let polar: Vec<[f64; 2]> = directions.iter().map(|d| self.polar(*d)).collect();
        for _ in 0..STEPS {
            let open: Vec<usize> = (0..searches.len()).filter(|k| !searches[*k].done).collect();
            if open.is_empty() {
                return Ok(());
            }
            let places = open.iter().map(|k| {
                let search = &searches[*k];
                let rho = (along[search.direction].log[search.node][0] + search.log).exp();
                (rho, polar[search.direction])
            });
            let landings = self.sight.land(self.order, places);
            for (k, landing) in open.into_iter().zip(landings) {
                if !searches[k].learn(landing, self.order) {
                    return Err(NotFound);
                }
            }
        }
        Err(NotFound)
    }

    /// ∂ln ρ/∂p less Kerr's at the coarse nodes, for each parameter.
    fn drifts(&self, directions: &[usize], ratios: &[[f64; COARSE]]) -> Vec<Vec<[f64; COARSE]>> {
        if let Some(before) = self.before.filter(|_| self.order >= INHERITED) {
            let row = |values: &[f64]| -> Vec<[f64; COARSE]> {
                directions.iter().map(|d| [around(values, self.chi(*d)); COARSE]).collect()
            };
            return before.drifts.iter().map(|values| row(values)).collect();
        }
        let table = self.table(NODES);
        let along: Vec<Along> = directions.iter().map(|d| self.along(*d, &table)).collect();
        let places = (0..directions.len())
            .flat_map(|at| {
                let polar = self.polar(directions[at]);
                let logs = ratios[at].iter().zip(&along[at].log).take(self.nodes());
                logs.map(move |(q, log)| ((log[0] + q).exp(), polar))
            })
            .collect();
        let found = Found { along, slopes: self.table(self.nodes()), places };
        self.moved.iter().map(|moved| self.drift(moved, directions, ratios, &found)).collect()
    }

    /// The same for one.
    fn drift(
        &self,
        moved: &Moved,
        directions: &[usize],
        ratios: &[[f64; COARSE]],
        found: &Found,
    ) -> Vec<[f64; COARSE]> {
        let landed = |landing: Landing| if let Landing::At(x) = landing { Some(x) } else { None };
        let sides = moved.sides.each_ref();
        let sides = sides.map(|side| Some(side.as_ref()?.land(self.order, found.places.iter().copied())));
        let mut drifts = vec![[0.0; COARSE]; directions.len()];
        for (at, row) in drifts.iter_mut().enumerate() {
            for (k, drift) in row.iter_mut().enumerate().take(self.nodes()) {
                let both = [0, 1].map(|s| landed(sides[s].as_ref()?[at * self.nodes() + k]));
                let [target, rate] = self.target(directions[at], coarse(self.nodes(), k));
                // Next to where light does not land any more there is no difference, and the derivative remains Kerr's.
                let Some((from, to, width)) = difference(both, || Some(target), moved.step) else { continue };
                let per_t = found.along[at].log[k][1]
                    + found.slopes[k].iter().zip(&ratios[at]).map(|(share, q)| share[1] * q).sum::<f64>();
                let (slot, share) = moved.kerr;
                *drift = -(to - from) / width * per_t / rate - share * found.along[at].drift[k][slot];
            }
        }
        drifts
    }

    /// From ln Q to the nodes of the image.
    fn spread(&self, ratios: &[[f64; COARSE]]) -> Image {
        let (full, count) = (self.base.nodes.directions, ratios.len());
        let directions = every(full, count, false);
        let drifts = self.drifts(&directions, ratios);
        let table: Vec<Vec<[f64; 2]>> = (0..NODES).map(|k| shares(self.nodes(), node(k))).collect();
        let mut image = Image {
            nodes: Nodes { directions: full, values: vec![[0.0; VALUES]; full * NODES] },
            drifts: vec![vec![0.0; full * NODES]; self.moved.len()],
            critical: Critical {
                ratio: ratios.iter().map(|ratio| ratio[0]).collect(),
                drifts: drifts.iter().map(|rows| rows.iter().map(|row| row[0]).collect()).collect(),
            },
        };
        for direction in 0..full {
            let share: Vec<f64> = (0..count)
                .map(|j| periodic(count, self.chi(direction) - 2.0 * PI * j as f64 / count as f64))
                .collect();
            let row = |rows: &[[f64; COARSE]]| -> [f64; COARSE] {
                std::array::from_fn(|k| share.iter().zip(rows).map(|(share, row)| share * row[k]).sum())
            };
            let logs = row(ratios);
            let changes: Vec<[f64; COARSE]> = drifts.iter().map(|rows| row(rows)).collect();
            let (inner, outer) = (self.base.ends.0, self.base.ends.1[direction]);
            for k in 0..NODES {
                let at = |row: &[f64; COARSE]| table[k].iter().zip(row).map(|(s, v)| s[0] * v).sum::<f64>();
                let base = &self.base.nodes.values[direction * NODES + k];
                let here = scale(self.order, self.target(direction, node(k))[0]);
                let there = scale(self.order, inner + (outer - inner) * node(k));
                let value = &mut image.nodes.values[direction * NODES + k];
                *value = *base;
                value[0] *= (-2.0 * at(&logs)).exp() * (there / here).powi(2);
                for (p, moved) in self.moved.iter().enumerate() {
                    let (slot, share) = moved.kerr;
                    image.drifts[p][direction * NODES + k] = share * base[1 + slot] + at(&changes[p]);
                }
            }
        }
        image
    }
}

/// So many of all directions, or those between them.
fn every(full: usize, count: usize, odd: bool) -> Vec<usize> {
    let step = full / count;
    (0..count).filter(|k| !odd || k % 2 == 1).map(|k| k * step).collect()
}

/// The last eighth of the series around, in ln Q: the worst of the innermost, a middle and the outermost node.
fn tail(ratios: &[[f64; COARSE]], nodes: usize) -> f64 {
    let n = ratios.len();
    let mut worst = 0.0_f64;
    for k in [0, nodes / 2, nodes - 1] {
        for wave in n / 2 - n.div_ceil(8)..n / 2 {
            let (mut cosine, mut sine) = (0.0, 0.0);
            for (j, ratio) in ratios.iter().enumerate() {
                let (sin, cos) = (2.0 * PI * (wave * j % n) as f64 / n as f64).sin_cos();
                cosine += ratio[k] * cos;
                sine += ratio[k] * sin;
            }
            worst = worst.max(cosine.hypot(sine) * 2.0 / n as f64);
        }
    }
    worst
}
