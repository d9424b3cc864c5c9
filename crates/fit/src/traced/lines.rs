//! The image of an order along directions that lie close: series in t for each.

use std::f64::consts::PI;

use super::order::{HOLE, NODES, Nodes, VALUES, View, node, scale};

/// Numbers of a term of the series of a direction: those of a node, and what the first changes by with χ.
const TERM: usize = VALUES + 1;

/// From values at so many equal steps around to as many lines, by Fourier's series.
#[derive(Clone, Debug)]
pub struct Around {
    /// How many lines.
    pub lines: usize,
    /// How many directions.
    pub directions: usize,
    /// For each line the share of each direction's value, and of its slope in χ.
    shares: Vec<f64>,
    slopes: Vec<f64>,
}

impl Around {
    /// Between two numbers of points around.
    pub fn new(directions: usize, lines: usize) -> Self {
        let n = directions as f64;
        let (mut shares, mut slopes) = (Vec::new(), Vec::new());
        for line in 0..lines {
            for direction in 0..directions {
                let angle = 2.0 * PI * (line as f64 / lines as f64 - direction as f64 / n);
                shares.push(super::order::periodic(directions, angle));
                let half = 0.5 * angle;
                let (sin, cos) = half.sin_cos();
                slopes.push(if sin.abs() < 1e-12 {
                    0.0
                } else {
                    ((n * half).cos() * cos / sin - (n * half).sin() / (n * sin * sin)) * 0.5
                });
            }
        }
        Self { lines, directions, shares, slopes }
    }

    /// Values and slopes of a function around.
    pub fn spread(&self, values: &[f64]) -> Vec<[f64; 2]> {
        let row = |table: &[f64], line: usize| {
            let row = &table[line * self.directions..][..self.directions];
            row.iter().zip(values).map(|(share, value)| share * value).sum::<f64>()
        };
        (0..self.lines).map(|line| [row(&self.shares, line), row(&self.slopes, line)]).collect()
    }
}

/// Chebyshev's T_k and dT_k/dt at a place of t in [0, 1].
#[derive(Clone, Copy, Debug)]
pub struct Basis {
    values: [f64; NODES],
    slopes: [f64; NODES],
}

impl Basis {
    /// At t.
    pub fn at(t: f64) -> Self {
        let z = 2.0 * t - 1.0;
        let (mut values, mut slopes) = ([1.0; NODES], [0.0; NODES]);
        (values[1], slopes[1]) = (z, 2.0);
        for k in 2..NODES {
            values[k] = 2.0 * z * values[k - 1] - values[k - 2];
            slopes[k] = 4.0 * values[k - 1] + 2.0 * z * slopes[k - 1] - slopes[k - 2];
        }
        Self { values, slopes }
    }
}

/// A point of the image.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// ρ, M.
    pub rho: f64,
    /// x = 1/√r.
    pub x: f64,
    /// dx/dρ at fixed ψ, and dx/dψ at fixed ρ.
    pub slope: [f64; 2],
    /// dρ/dp at fixed ψ and x.
    pub drift: [f64; HOLE],
}

/// The image of an order along lines of constant χ.
#[derive(Clone, Debug)]
pub struct Lines {
    order: usize,
    /// Terms of all lines, those of a line side by side.
    terms: Vec<[f64; TERM]>,
    /// How many of a line's terms matter.
    used: usize,
    /// Of each line: cos ψ, sin ψ, dψ/dχ, the weight of y and its slope.
    pub rays: Vec<[f64; 5]>,
    /// x at the inner edge.
    inner: f64,
    /// x at the outer edge, and its slope in χ.
    outer: Vec<[f64; 2]>,
}

/// The last terms of a series as a share of the first from which on they are left away.
const NEGLIGIBLE: f64 = 1e-7;

impl Lines {
    /// Spreads nodes over lines.
    pub fn new(view: &View, order: usize, nodes: &Nodes, around: &Around, inner: f64, outer: &[f64]) -> Self {
        let transform = transform();
        let mut coarse = vec![[0.0; VALUES]; nodes.values.len()];
        for (coarse, values) in coarse.chunks_exact_mut(NODES).zip(nodes.values.chunks_exact(NODES)) {
            for (row, term) in transform.iter().zip(coarse) {
                for (share, value) in row.iter().zip(values) {
                    for v in 0..VALUES {
                        term[v] += share * value[v];
                    }
                }
            }
        }
        let size = |k: usize| {
            let here = |j: usize| coarse[j * NODES + k][0].abs() / coarse[j * NODES][0].abs();
            (0..nodes.directions).map(here).fold(0.0, f64::max)
        };
        let used = (1..NODES).rev().find(|k| size(*k) > NEGLIGIBLE).map_or(2, |k| (k + 1).max(2));
        let mut terms = vec![[0.0; TERM]; around.lines * NODES];
        for (line, terms) in terms.chunks_exact_mut(NODES).enumerate() {
            let at = line * around.directions;
            for direction in 0..around.directions {
                let (share, slope) = (around.shares[at + direction], around.slopes[at + direction]);
                let from = &coarse[direction * NODES..][..used];
                for (term, from) in terms.iter_mut().zip(from) {
                    for v in 0..VALUES {
                        term[v] += share * from[v];
                    }
                    term[VALUES] += slope * from[0];
                }
            }
        }
        let rays = (0..around.lines)
            .map(|line| {
                let chi = 2.0 * PI * line as f64 / around.lines as f64;
                let [psi, rate] = view.angle(chi);
                let (sin, cos) = psi.sin_cos();
                let step = 1e-6;
                let slope = (view.weight(chi + step) - view.weight(chi - step)) / (2.0 * step);
                [cos, sin, rate, view.weight(chi), slope]
            })
            .collect();
        Self { order, terms, used, rays, inner, outer: around.spread(outer) }
    }

    /// The point of a line at t.
    pub fn at(&self, line: usize, t: f64) -> Point {
        self.along(line, t, &Basis::at(t))
    }

    /// The same with the polynomials at t.
    pub fn along(&self, line: usize, t: f64, basis: &Basis) -> Point {
        let mut sum = [0.0; TERM];
        let mut slope = 0.0;
        let terms = &self.terms[line * NODES..][..self.used];
        for (k, term) in terms.iter().enumerate() {
            for v in 0..TERM {
                sum[v] += basis.values[k] * term[v];
            }
            slope += basis.slopes[k] * term[0];
        }
        let [_, _, rate, weight, weight_slope] = self.rays[line];
        let [outer, outer_slope] = self.outer[line];
        let width = outer - self.inner;
        let x = self.inner + width * t;
        let s = scale(self.order, x);
        let rho = (weight / sum[0]).sqrt() / s;
        // d ln ρ = ½ d ln w − ½ d ln y − d ln s.
        let per_x = if self.order == 0 { 2.0 / x } else { 0.0 };
        let rho_t = rho * (-0.5 * slope / sum[0] - per_x * width);
        let x_chi = outer_slope * t;
        let rho_chi = rho * (0.5 * weight_slope / weight - 0.5 * sum[VALUES] / sum[0] - per_x * x_chi);
        let per_rho = width / rho_t;
        let mut drift = [0.0; HOLE];
        for p in 0..HOLE {
            drift[p] = rho * sum[1 + p];
        }
        Point { rho, x, slope: [per_rho, (x_chi - per_rho * rho_chi) / rate], drift }
    }

    /// t at which a line has the distance ρ, within its ends.
    pub fn find(&self, line: usize, rho: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        if self.at(line, low).rho >= rho {
            return low;
        }
        if self.at(line, high).rho <= rho {
            return high;
        }
        let mut t = 0.5;
        for _ in 0..60 {
            let point = self.at(line, t);
            if point.rho < rho {
                low = t;
            } else {
                high = t;
            }
            let width = self.outer[line][0] - self.inner;
            let step = (rho - point.rho) * point.slope[0] / width;
            if step.abs() < 1e-11 {
                break;
            }
            let next = t + step;
            t = if next > low && next < high { next } else { 0.5 * (low + high) };
        }
        t
    }
}

/// From values at Chebyshev's nodes to the factors of T_k.
fn transform() -> [[f64; NODES]; NODES] {
    let n = (NODES - 1) as f64;
    let mut rows = [[0.0; NODES]; NODES];
    for (k, row) in rows.iter_mut().enumerate() {
        for (j, share) in row.iter_mut().enumerate() {
            // Nodes go from t = 0, where T_k is (−1)^k.
            let z = 2.0 * node(j) - 1.0;
            let polynomial = (k as f64 * z.clamp(-1.0, 1.0).acos()).cos();
            let ends = |i: usize| if i == 0 || i == NODES - 1 { 0.5 } else { 1.0 };
            *share = 2.0 / n * ends(j) * ends(k) * polynomial;
        }
    }
    rows
}
