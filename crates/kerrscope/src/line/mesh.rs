//! The image of one order as a fine grid of cells.

use std::f64::consts::{PI, TAU};

use rayon::prelude::*;

use super::isoradial::{Isoradials, Screen};
use super::spread::Spread;
use super::{Line, LineError};
use crate::spacetime::emitter::{Circular, Departure, Sense};
use crate::spacetime::geodesic::Tracer;

/// Chebyshev nodes between two radii.
const NODES: usize = 40;

/// Directions, doubled until the series of Fourier converges.
const DIRECTIONS: [usize; 4] = [128, 256, 512, 1024];

/// The share of the last terms of a series of Fourier that counts as convergence.
const CONVERGED: f64 = 1e-8;

/// Cells between two radii, and around.
const ACROSS: usize = 800;
const AROUND: usize = 2048;

/// g at the corners of the cells of an image, and the flux from each cell.
pub struct Mesh {
    /// Rows of `AROUND` values from one x to the next.
    shifts: Vec<f64>,
    /// Rows of g⁰ weights: ε dα dβ.
    weights: Vec<f64>,
}

/// The image of one order, from the inner to the outer radius; in two parts if matter falls within the last stable orbit, for
/// there g has a kink.
pub fn meshes(line: &Line, tracer: &dyn Tracer, order: usize) -> Result<Vec<Mesh>, LineError> {
    let isco = Line::isco(line.spin);
    let mut ends = vec![line.inner, line.outer];
    if line.inner < isco * (1.0 - 1e-9) && isco < line.outer {
        ends.insert(1, isco);
    }
    ends.windows(2).map(|ends| Mesh::new(line, tracer, order, [ends[0], ends[1]])).collect()
}

/// The nodes of a part of a disk, in x = 1/√r.
struct Nodes {
    ends: [f64; 2],
}

impl Nodes {
    fn x(&self, node: usize) -> f64 {
        let [outer, inner] = self.ends;
        let t = -(PI * node as f64 / (NODES - 1) as f64).cos();
        0.5 * (outer + inner) + 0.5 * (inner - outer) * t
    }

    /// Weights of the nodes' values at x (barycentric, of nodes at the extrema).
    fn weights(&self, x: f64) -> [f64; NODES] {
        let mut weights = [0.0; NODES];
        let mut sum = 0.0;
        for (node, weight) in weights.iter_mut().enumerate() {
            let apart = x - self.x(node);
            if apart == 0.0 {
                let mut only = [0.0; NODES];
                only[node] = 1.0;
                return only;
            }
            let half = if node == 0 || node == NODES - 1 { 0.5 } else { 1.0 };
            *weight = half * if node % 2 == 0 { 1.0 } else { -1.0 } / apart;
            sum += *weight;
        }
        weights.map(|weight| weight / sum)
    }
}

impl Mesh {
    fn new(
        line: &Line,
        tracer: &dyn Tracer,
        order: usize,
        [inner, outer]: [f64; 2],
    ) -> Result<Self, LineError> {
        let nodes = Nodes { ends: [outer.sqrt().recip(), inner.sqrt().recip()] };
        let radii: Vec<f64> = (0..NODES).map(|node| nodes.x(node).powi(-2)).collect();
        let screen = Screen { spin: line.spin, inclination: line.inclination };
        let isoradials = Isoradials { tracer, screen, order };
        // Functions of the direction at each node, as series: 1/b² and the sign and size of the radial momentum.
        let mut series: [Vec<Vec<f64>>; 2] = [Vec::new(), Vec::new()];
        for directions in DIRECTIONS {
            let points = isoradials.points(&radii, directions);
            let failed = points.iter().filter(|point| point.is_none()).count();
            if failed > 0 {
                return Err(LineError::NoImage { order, failed });
            }
            let at = |direction: usize, node: usize| points[direction * NODES + node];
            series = [Vec::new(), Vec::new()];
            let mut tail = 0.0_f64;
            for node in 0..NODES {
                let scale = scale(order, nodes.x(node));
                let row = |k: usize| {
                    let point = at(k, node)?;
                    let [alpha, beta] = screen.place(point.distance, TAU * k as f64 / directions as f64);
                    let motion = radial_motion(line, radii[node], [alpha, beta], point.crossing.outward);
                    Some([(point.distance * scale).powi(-2), motion])
                };
                let rows: Vec<[f64; 2]> = (0..directions).filter_map(row).collect();
                for (f, series) in series.iter_mut().enumerate() {
                    series.push(fourier(&rows.iter().map(|row| row[f]).collect::<Vec<_>>()));
                }
                tail = tail.max(tail_of(&series[0][node]));
            }
            if tail < CONVERGED {
                break;
            }
        }
        Ok(Self::fine(line, screen, order, &nodes, &series))
    }

    /// The grid from the series.
    fn fine(line: &Line, screen: Screen, order: usize, nodes: &Nodes, series: &[Vec<Vec<f64>>; 2]) -> Self {
        let turns: Vec<[f64; 2]> = (0..AROUND)
            .map(|k| {
                let (sin, cos) = (TAU * k as f64 / AROUND as f64).sin_cos();
                [cos, sin]
            })
            .collect();
        let around = series.each_ref().map(|rows| {
            let fine = |row: &Vec<f64>| (0..AROUND).map(|k| evaluate(row, &turns, k)).collect();
            rows.par_iter().map(fine).collect::<Vec<Vec<f64>>>()
        });
        let matter = Circular::kerr(line.spin, Sense::Prograde);
        let isco = matter.isco().unwrap_or(f64::NAN);
        let [outer, inner] = nodes.ends;
        let mut mesh = Self { shifts: Vec::new(), weights: Vec::new() };
        let mut before: Option<Vec<f64>> = None;
        // Rows are as far apart as they are from the hole.
        let at = |row: f64| outer * (inner / outer).powf(row / ACROSS as f64);
        for row in 0..=ACROSS {
            let x = at(row as f64);
            let weights = nodes.weights(x);
            let [places, motions] = around.each_ref().map(|rows| mix(&weights, rows));
            let r = x.powi(-2);
            let (scale, falls) = (scale(order, x), r < isco * (1.0 - 1e-9));
            let orbit = matter.orbit(r.max(isco)).filter(|_| !falls);
            let falling = if falls { matter.velocity(r).zip(matter.equator(r)) } else { None };
            let mut squares = Vec::with_capacity(AROUND);
            for (k, [cos, _]) in turns.iter().enumerate() {
                let square = places[k].recip() / (scale * scale);
                let distance = square.sqrt();
                let alpha = distance * cos - screen.spin * screen.inclination.sin();
                let lambda = -alpha * screen.inclination.sin();
                let g = match (orbit, falling) {
                    (Some(orbit), _) => orbit.redshift_factor(lambda, 1.0).unwrap_or(f64::NAN),
                    (None, Some((velocity, _))) => {
                        // −u·p = u^t − λu^φ − u^r p_r, both radial parts along the unit vector.
                        (velocity.t - lambda * velocity.phi - velocity.radial * motions[k]).recip()
                    }
                    _ => f64::NAN,
                };
                squares.push(square);
                mesh.shifts.push(g);
            }
            if let Some(before) = before {
                // The middle of the cell in x.
                let emissivity = line.emissivity.at(at(row as f64 - 0.5).powi(-2));
                for k in 0..AROUND {
                    let next = (k + 1) % AROUND;
                    let area =
                        0.25 * (before[k] + before[next] - squares[k] - squares[next]) * TAU / AROUND as f64;
                    mesh.weights.push(emissivity * area);
                }
            }
            before = Some(squares);
        }
        mesh
    }

    /// The least and the largest g.
    pub fn edges(&self) -> [f64; 2] {
        self.shifts.iter().fold([f64::INFINITY, 0.0], |[low, high], g| [low.min(*g), high.max(*g)])
    }

    /// Spreads the light over bins.
    pub fn pour(&self, spread: &mut Spread) {
        for row in 0..ACROSS {
            let corner = |row: usize, k: usize| self.shifts[row * AROUND + k % AROUND];
            for k in 0..AROUND {
                let [a, b] = [corner(row, k), corner(row, k + 1)];
                let [c, d] = [corner(row + 1, k), corner(row + 1, k + 1)];
                let middle = 0.25 * (a + b + c + d);
                let halves = [0.25 * (c + d - a - b), 0.25 * (b + d - a - c)];
                spread.add(middle.powi(3) * self.weights[row * AROUND + k], middle, halves);
            }
        }
    }
}

/// By what distances are multiplied to vary slowly with x: the direct image grows with the disk, others do not.
fn scale(order: usize, x: f64) -> f64 {
    if order == 0 { x * x } else { 1.0 }
}

/// p_r√g^rr of the light, with its sign.
fn radial_motion(line: &Line, r: f64, [alpha, beta]: [f64; 2], outward: bool) -> f64 {
    let (sin, cos) = line.inclination.sin_cos();
    let a = line.spin;
    let light = Departure {
        energy: 1.0,
        lambda: -alpha * sin,
        normal: ((alpha * alpha - a * a) * cos * cos + beta * beta).max(0.0).sqrt() / r,
        outward,
    };
    let equator = crate::spacetime::emitter::Equator::kerr(a, r);
    light.legs(&equator)[0]
}

/// The sum of rows, each times its weight.
fn mix(weights: &[f64; NODES], rows: &[Vec<f64>]) -> Vec<f64> {
    let mut sum = vec![0.0; AROUND];
    for (weight, row) in weights.iter().zip(rows) {
        for (sum, value) in sum.iter_mut().zip(row) {
            *sum += weight * value;
        }
    }
    sum
}

/// The real series of Fourier of values around: mean, then cosine and sine of each wave.
fn fourier(values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let turns: Vec<(f64, f64)> = (0..n).map(|k| (TAU * k as f64 / n as f64).sin_cos()).collect();
    let mut series = vec![values.iter().sum::<f64>() / n as f64];
    for wave in 1..n / 2 {
        let (mut cosine, mut sine) = (0.0, 0.0);
        for (k, value) in values.iter().enumerate() {
            let (sin, cos) = turns[wave * k % n];
            cosine += value * cos;
            sine += value * sin;
        }
        series.extend([cosine * 2.0 / n as f64, sine * 2.0 / n as f64]);
    }
    series
}

/// The last eighth of a series, as a share of its largest term.
fn tail_of(series: &[f64]) -> f64 {
    let largest = series.iter().map(|c| c.abs()).fold(f64::MIN_POSITIVE, f64::max);
    series[series.len() * 7 / 8..].iter().map(|c| c.abs()).fold(0.0, f64::max) / largest
}

/// A series at a direction of the fine grid.
fn evaluate(series: &[f64], turns: &[[f64; 2]], k: usize) -> f64 {
    let mut sum = series[0];
    for (wave, pair) in (1..).zip(series[1..].chunks_exact(2)) {
        let [cos, sin] = turns[wave * k % turns.len()];
        sum += pair[0] * cos + pair[1] * sin;
    }
    sum
}
