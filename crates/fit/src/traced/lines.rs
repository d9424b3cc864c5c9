//! The image of an order along directions that lie close: series in t for each.

use std::f64::consts::PI;

use nalgebra::DMatrix;

use super::order::{HOLE, NODES, Nodes, View, node, scale};

/// From values at so many equal steps around to as many lines, by Fourier's series.
#[derive(Clone, Debug)]
pub struct Around {
    /// How many lines.
    pub lines: usize,
    /// How many directions.
    pub directions: usize,
    /// For each line, a column, the share of each direction's value, and of its slope in χ.
    shares: DMatrix<f64>,
    slopes: DMatrix<f64>,
}

impl Around {
    /// Between two numbers of points around.
    pub fn new(directions: usize, lines: usize) -> Self {
        let n = directions as f64;
        let angle =
            |direction: usize, line: usize| 2.0 * PI * (line as f64 / lines as f64 - direction as f64 / n);
        let share = |direction, line| super::order::periodic(directions, angle(direction, line));
        let slope = |direction, line| {
            let half = 0.5 * angle(direction, line);
            let (sin, cos) = half.sin_cos();
            if sin.abs() < 1e-12 {
                0.0
            } else {
                ((n * half).cos() * cos / sin - (n * half).sin() / (n * sin * sin)) * 0.5
            }
        };
        Self {
            lines,
            directions,
            shares: DMatrix::from_fn(directions, lines, share),
            slopes: DMatrix::from_fn(directions, lines, slope),
        }
    }

    /// Values and slopes of a function around.
    pub fn spread(&self, values: &[f64]) -> Vec<[f64; 2]> {
        let values = DMatrix::from_row_slice(1, self.directions, values);
        let [shares, slopes] = [&values * &self.shares, &values * &self.slopes];
        shares.iter().zip(slopes.iter()).map(|(value, slope)| [*value, *slope]).collect()
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
    /// Which image.
    pub order: usize,
    /// Terms of the first of a node's values, and what they change by with χ: a column for each line.
    terms: [DMatrix<f64>; 2],
    /// Terms of ∂ln ρ/∂p, those of all p side by side; none if they are not asked for.
    drifts: Option<DMatrix<f64>>,
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
    /// Spreads nodes over lines, with what they move by if that is asked for.
    pub fn new(
        view: &View,
        order: usize,
        (nodes, derivatives): (&Nodes, bool),
        around: &Around,
        inner: f64,
        outer: &[f64],
    ) -> Self {
        let transform = transform();
        let coarse = |v: usize| {
            let values = DMatrix::from_fn(NODES, nodes.directions, |k, j| nodes.values[j * NODES + k][v]);
            &transform * values
        };
        let places = coarse(0);
        let size = |k: usize| {
            let here = |j: usize| (places[(k, j)] / places[(0, j)]).abs();
            (0..nodes.directions).map(here).fold(0.0, f64::max)
        };
        let used = (1..NODES).rev().find(|k| size(*k) > NEGLIGIBLE).map_or(2, |k| (k + 1).max(2));
        let places = places.rows(0, used);
        let terms = [places * &around.shares, places * &around.slopes];
        let drifts = derivatives.then(|| {
            let each: [DMatrix<f64>; HOLE] = std::array::from_fn(|p| coarse(1 + p));
            DMatrix::from_fn(HOLE * used, nodes.directions, |row, j| each[row % HOLE][(row / HOLE, j)])
                * &around.shares
        });
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
        Self { order, terms, drifts, rays, inner, outer: around.spread(outer) }
    }

    /// The point of a line at t.
    pub fn at(&self, line: usize, t: f64) -> Point {
        self.along(line, t, &Basis::at(t))
    }

    /// The same with the polynomials at t.
    pub fn along(&self, line: usize, t: f64, basis: &Basis) -> Point {
        let [terms, turned] = &self.terms;
        let used = terms.nrows();
        let here = line * used..(line + 1) * used;
        let (mut y, mut y_t, mut y_chi) = (0.0, 0.0, 0.0);
        let both = terms.as_slice()[here.clone()].iter().zip(&turned.as_slice()[here]);
        for (k, (term, turned)) in both.enumerate() {
            y += basis.values[k] * term;
            y_t += basis.slopes[k] * term;
            y_chi += basis.values[k] * turned;
        }
        let [_, _, rate, weight, weight_slope] = self.rays[line];
        let [outer, outer_slope] = self.outer[line];
        let width = outer - self.inner;
        let x = self.inner + width * t;
        let s = scale(self.order, x);
        let rho = (weight / y).sqrt() / s;
        // d ln ρ = ½ d ln w − ½ d ln y − d ln s.
        let per_x = if self.order == 0 { 2.0 / x } else { 0.0 };
        let rho_t = rho * (-0.5 * y_t / y - per_x * width);
        let x_chi = outer_slope * t;
        let rho_chi = rho * (0.5 * weight_slope / weight - 0.5 * y_chi / y - per_x * x_chi);
        let per_rho = width / rho_t;
        let mut drift = [0.0; HOLE];
        if let Some(drifts) = &self.drifts {
            let rows = &drifts.as_slice()[line * HOLE * used..][..HOLE * used];
            for (value, terms) in basis.values.iter().zip(rows.as_chunks::<HOLE>().0) {
                for p in 0..HOLE {
                    drift[p] += value * terms[p];
                }
            }
            drift = drift.map(|d| rho * d);
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
fn transform() -> DMatrix<f64> {
    let n = (NODES - 1) as f64;
    DMatrix::from_fn(NODES, NODES, |k, j| {
        // Nodes go from t = 0, where T_k is (−1)^k.
        let z = 2.0 * node(j) - 1.0;
        let polynomial = (k as f64 * z.clamp(-1.0, 1.0).acos()).cos();
        let ends = |i: usize| if i == 0 || i == NODES - 1 { 0.5 } else { 1.0 };
        2.0 / n * ends(j) * ends(k) * polynomial
    })
}
