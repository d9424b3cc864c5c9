//! The image of one order: where on the screen light is seen that leaves the plane at a radius.
//!
//! On the screen of impact parameters, in polar coordinates (ρ, ψ) about the principal null ray (−a sin i, 0), which meets no plane,
//! every direction has each radius once. With x = 1/√r, from the inner to the outer edge x = x_in + (x_out(ψ) − x_in) t, and an angle
//! χ, tan ψ = q tan χ, in which inclined disks are nearly round, the place is a smooth function of t and χ. It is solved for at
//! Chebyshev's nodes in t and equal steps in χ, by Newton's method with exact slopes, and so is how it moves: with u(α, β; p) = 1/r,
//!
//! ```text
//! ∂ρ/∂p at fixed ψ and x = −(∂u/∂p + ∂u/∂α ∂α₀/∂p)/(∂u/∂ρ),   α₀ = −a sin i.
//! ```

use std::f64::consts::PI;

use kerrscope::line::{Isoradials, Screen as Polar};
use kerrscope::spacetime::closed::{ClosedForm, Landing, Landings};

/// Parameters of hole and observer: spin, inclination, 1/r.
pub const HOLE: usize = 3;

/// Image orders that are drawn.
pub const ORDERS: usize = 4;

/// Nodes in t.
pub const NODES: usize = 24;

/// Values kept at a node: (ρ s(x))⁻² times what makes a flat disk's the same all around, and ∂ln ρ/∂p.
pub const VALUES: usize = 1 + HOLE;

/// Newton's steps at a node, at most.
const STEPS: usize = 30;

/// Newton's last step, as a share of ρ, per image order: each is e^π times thinner than the one before.
const CLOSE: [f64; ORDERS] = [1e-4, 5e-6, 2e-7, 1e-8];

/// A hole, an observer at or above its plane, and how finely it is looked at.
#[derive(Clone, Copy, Debug)]
pub struct View {
    /// a.
    pub spin: f64,
    /// i, radians, in [0, π/2).
    pub inclination: f64,
    /// 1/r of the observer.
    pub u: f64,
    /// What a changes by with the first of the hole's parameters: 1 where that is a.
    pub turn: f64,
}

impl View {
    /// α of the centre of polar coordinates, and its derivatives.
    pub fn center(&self) -> (f64, [f64; HOLE]) {
        let (sin, cos) = self.inclination.sin_cos();
        (-self.spin * sin, [-sin * self.turn, -self.spin * cos, 0.0])
    }

    /// q: how flat the disk is, but for what its light's bending does.
    fn flatness(&self) -> f64 {
        self.inclination.cos().max(0.2)
    }

    /// ψ and dψ/dχ.
    pub fn angle(&self, chi: f64) -> [f64; 2] {
        let q = self.flatness();
        let (sin, cos) = chi.sin_cos();
        [(q * sin).atan2(cos), q / (cos * cos + q * q * sin * sin)]
    }

    /// cos² χ + q² sin² χ = q²/(q² cos² ψ + sin² ψ).
    pub fn weight(&self, chi: f64) -> f64 {
        let (sin, cos) = chi.sin_cos();
        cos * cos + (self.flatness() * sin).powi(2)
    }
}

/// The image at its nodes: for each direction the nodes in t, for each node its values.
#[derive(Clone, Debug)]
pub struct Nodes {
    /// How many directions.
    pub directions: usize,
    /// Values, those of one node side by side.
    pub values: Vec<[f64; VALUES]>,
}

/// t of a node.
pub fn node(k: usize) -> f64 {
    0.5 - 0.5 * (PI * k as f64 / (NODES - 1) as f64).cos()
}

/// Why an image was not found.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub struct NotFound;

/// What distances are multiplied by to vary slowly with x.
pub fn scale(order: usize, x: f64) -> f64 {
    if order == 0 { x * x } else { 1.0 }
}

/// A direction that is followed from node to node.
struct Walk {
    polar: [f64; 2],
    /// x at the inner edge, and how much it changes to the outer edge.
    x: [f64; 2],
    /// (x, ρ, dρ/dx) of the last node and of the one before.
    known: [[f64; 3]; 2],
    count: usize,
}

/// Where a node is looked for.
struct Try {
    direction: usize,
    rho: f64,
    x: f64,
    done: bool,
}

/// Solves for the image of an order: `edges` are x_in and, for each direction, x_out.
///
/// # Errors
/// If some light does not come from where it should.
pub fn solve(
    view: &View,
    landings: &Landings,
    order: usize,
    inner: f64,
    outer: &[f64],
) -> Result<Nodes, NotFound> {
    let directions = outer.len();
    let chi = |j: usize| 2.0 * PI * j as f64 / directions as f64;
    let angles: Vec<f64> = (0..directions).map(|j| view.angle(chi(j))[0]).collect();
    let mut walks: Vec<Walk> = angles
        .iter()
        .zip(outer)
        .map(|(angle, outer)| {
            let (sin, cos) = angle.sin_cos();
            Walk { polar: [cos, sin], x: [inner, outer - inner], known: [[0.0; 3]; 2], count: 0 }
        })
        .collect();
    let mut nodes = Nodes { directions, values: vec![[0.0; VALUES]; directions * NODES] };
    // From a node in the middle, where its place is looked for without knowing anything, to both ends.
    let first = NODES / 3;
    let begin = beginnings(view, order, &walks, &angles, node(first))?;
    let mut solver = Solver { view, landings, order, found: Vec::new(), rays: Vec::new() };
    let start: Vec<f64> = begin;
    solver.step(&mut walks, &mut nodes, first, &start)?;
    let kept: Vec<[f64; 3]> = walks.iter().map(|walk| walk.known[0]).collect();
    for k in (0..first).rev() {
        let guess: Vec<f64> = walks.iter().map(|walk| walk.guess(order, node(k))).collect();
        solver.step(&mut walks, &mut nodes, k, &guess)?;
    }
    for (walk, kept) in walks.iter_mut().zip(kept) {
        (walk.known, walk.count) = ([kept; 2], 1);
    }
    for k in first + 1..NODES {
        let guess: Vec<f64> = walks.iter().map(|walk| walk.guess(order, node(k))).collect();
        solver.step(&mut walks, &mut nodes, k, &guess)?;
    }
    Ok(nodes)
}

/// Distances at t of the image, nearly: searched for by the light that arrives at infinity.
fn beginnings(
    view: &View,
    order: usize,
    walks: &[Walk],
    angles: &[f64],
    t: f64,
) -> Result<Vec<f64>, NotFound> {
    let tracer = ClosedForm::new(view.spin, 12, 1000);
    let screen = Polar { spin: view.spin, inclination: view.inclination };
    let isoradials = Isoradials { tracer: &tracer, screen, order };
    let places = walks.iter().zip(angles).map(|(walk, angle)| [(walk.x[0] + walk.x[1] * t).powi(-2), *angle]);
    let found = isoradials.at(&places.collect::<Vec<_>>());
    found.iter().map(|point| point.map(|point| point.distance).ok_or(NotFound)).collect()
}

/// The function of Fourier's series of an even number of points that is 1 at one of them and 0 at the others.
pub fn periodic(count: usize, angle: f64) -> f64 {
    let half = 0.5 * angle;
    let (sin, cos) = half.sin_cos();
    if sin.abs() < 1e-12 {
        return 1.0;
    }
    let n = count as f64;
    (n * half).sin() * cos / (n * sin)
}

impl Walk {
    /// ρ at t, from the nodes before: (ρs)⁻² varies slowly with x.
    fn guess(&self, order: usize, t: f64) -> f64 {
        let x = self.x[0] + self.x[1] * t;
        let slow = |[x, rho, slope]: [f64; 3]| {
            let s = scale(order, x);
            let y = (rho * s).powi(-2);
            let relative = slope / rho + if order == 0 { 2.0 / x } else { 0.0 };
            [y, -2.0 * y * relative]
        };
        let [y, slope] = slow(self.known[0]);
        let step = x - self.known[0][0];
        let mut guess = y + slope * step;
        if self.count > 1 {
            // The parabola that has the slope of the node before too.
            let before = slow(self.known[1]);
            let bend = (slope - before[1]) / (self.known[0][0] - self.known[1][0]);
            guess += 0.5 * bend * step * step;
        }
        let guess = if guess > 0.2 * y { guess } else { 0.2 * y };
        guess.powf(-0.5) / scale(order, x)
    }
}

struct Solver<'a> {
    view: &'a View,
    landings: &'a Landings,
    order: usize,
    rays: Vec<[f64; 2]>,
    found: Vec<Landing>,
}

impl Solver<'_> {
    /// Solves node number `k` in all directions.
    fn step(
        &mut self,
        walks: &mut [Walk],
        nodes: &mut Nodes,
        k: usize,
        guess: &[f64],
    ) -> Result<(), NotFound> {
        let t = node(k);
        let (center, moved) = self.view.center();
        let mut tries: Vec<Try> = walks
            .iter()
            .zip(guess)
            .enumerate()
            .map(|(direction, (walk, rho))| Try {
                direction,
                rho: *rho,
                x: walk.x[0] + walk.x[1] * t,
                done: false,
            })
            .collect();
        for _ in 0..STEPS {
            self.rays.clear();
            self.rays.extend(tries.iter().map(|t| {
                let [cos, sin] = walks[t.direction].polar;
                [center + t.rho * cos, t.rho * sin]
            }));
            self.found.resize(self.rays.len(), Landing::default());
            let hole = [self.view.spin, self.view.inclination, self.view.u];
            self.landings.find(hole, self.order, &self.rays, &mut self.found);
            for (tried, landing) in tries.iter_mut().zip(&self.found) {
                let walk = &mut walks[tried.direction];
                let [cos, sin] = walk.polar;
                let g = &landing.gradient;
                let slope = g[2] * cos + g[3] * sin;
                if !(landing.u + slope).is_finite() {
                    return Err(NotFound);
                }
                // u falls outwards. x = √u is closer to a straight line, where there is one.
                let target = tried.x * tried.x;
                let step = if landing.u > 0.0 {
                    (landing.u.sqrt() - tried.x) * 2.0 * landing.u.sqrt() / slope
                } else {
                    (landing.u - target) / slope
                };
                let bounded = step.clamp(-0.3 * tried.rho, 0.3 * tried.rho);
                tried.rho -= bounded;
                tried.done = bounded.abs() < CLOSE[self.order] * tried.rho && slope < 0.0;
                if tried.done {
                    // The rest is of second order in the step.
                    let s = scale(self.order, tried.x);
                    let chi = 2.0 * PI * tried.direction as f64 / nodes.directions as f64;
                    let value = &mut nodes.values[tried.direction * NODES + k];
                    value[0] = self.view.weight(chi) / (tried.rho * s).powi(2);
                    for p in 0..HOLE {
                        let own = if p == 2 { g[4] } else { g[p] };
                        value[1 + p] = -(own + g[2] * moved[p]) / slope / tried.rho;
                    }
                    let rate = 2.0 * tried.x / slope;
                    walk.known = [[tried.x, tried.rho, rate], walk.known[0]];
                    walk.count += 1;
                }
            }
            tries.retain(|t| !t.done);
            if tries.is_empty() {
                return Ok(());
            }
        }
        Err(NotFound)
    }
}

impl Nodes {
    /// The last eighth of the series around, as a share of the largest term: the worst of the innermost, a middle and the
    /// outermost node.
    pub fn tail(&self) -> f64 {
        let n = self.directions;
        let mut worst = 0.0_f64;
        for k in [0, NODES / 2, NODES - 1] {
            let value = |j: usize| self.values[j * NODES + k][0];
            let mean = (0..n).map(value).sum::<f64>() / n as f64;
            for wave in n / 2 - n / 16..n / 2 {
                let (mut cosine, mut sine) = (0.0, 0.0);
                for j in 0..n {
                    let (sin, cos) = (2.0 * PI * (wave * j % n) as f64 / n as f64).sin_cos();
                    cosine += value(j) * cos;
                    sine += value(j) * sin;
                }
                worst = worst.max(cosine.hypot(sine) * 2.0 / n as f64 / mean);
            }
        }
        worst
    }
}
