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

/// The step after which one more is enough: its square, by the width of the order, is smaller than that.
const NEAR: [f64; ORDERS] = [5e-3, 2e-4, 1e-5, 5e-7];

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
        self.inclination.cos().max(0.3)
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
#[derive(Clone, Copy)]
struct Try {
    direction: usize,
    rho: f64,
    x: f64,
    done: bool,
}

/// Solves for the image of an order: `edges` are x_in and, for each direction, x_out. How it moves is found if asked for, else 0.
///
/// # Errors
/// If some light does not come from where it should.
pub fn solve(
    view: &View,
    landings: &Landings,
    order: usize,
    (inner, outer): (f64, &[f64]),
    derivatives: bool,
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
    let mut solver = Solver {
        view,
        landings,
        order,
        derivatives,
        rays: Vec::new(),
        polar: Vec::new(),
        slopes: Vec::new(),
        found: Vec::new(),
    };
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
    derivatives: bool,
    rays: Vec<[f64; 2]>,
    polar: Vec<[f64; 2]>,
    slopes: Vec<[f64; 2]>,
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
        let near = self.approach(walks, &mut tries)?;
        if self.derivatives {
            return self.finish(walks, nodes, k, near);
        }
        for (tried, slope) in near {
            self.keep(walks, nodes, k, &tried, slope, [0.0; HOLE]);
        }
        Ok(())
    }

    fn look(&mut self, walks: &[Walk], tries: &[Try]) {
        let (center, _) = self.view.center();
        self.polar.clear();
        self.polar.extend(tries.iter().map(|t| walks[t.direction].polar));
        self.rays.clear();
        self.rays
            .extend(tries.iter().zip(&self.polar).map(|(t, [cos, sin])| [center + t.rho * cos, t.rho * sin]));
    }

    fn hole(&self) -> [f64; 3] {
        [self.view.spin, self.view.inclination, self.view.u]
    }

    /// Newton's method with the slope along ρ alone, until the next step with all derivatives is the last one, or to the end if there
    /// is none. Gives all tries with their slopes.
    fn approach(&mut self, walks: &[Walk], tries: &mut Vec<Try>) -> Result<Vec<(Try, f64)>, NotFound> {
        let close = if self.derivatives { NEAR[self.order] } else { CLOSE[self.order] };
        let mut near = Vec::with_capacity(tries.len());
        for _ in 0..STEPS {
            self.look(walks, tries);
            self.slopes.resize(self.rays.len(), [0.0; 2]);
            self.landings.along(self.hole(), self.order, &self.rays, &self.polar, &mut self.slopes);
            for (tried, [u, slope]) in tries.iter_mut().zip(&self.slopes) {
                tried.newton(*u, *slope, close)?;
                if tried.done {
                    near.push((*tried, *slope));
                }
            }
            tries.retain(|t| !t.done);
            if tries.is_empty() {
                return Ok(near);
            }
        }
        Err(NotFound)
    }

    /// Newton's last steps, with what the place changes by.
    fn finish(
        &mut self,
        walks: &mut [Walk],
        nodes: &mut Nodes,
        k: usize,
        near: Vec<(Try, f64)>,
    ) -> Result<(), NotFound> {
        let (_, moved) = self.view.center();
        let mut tries: Vec<Try> = near.into_iter().map(|(tried, _)| Try { done: false, ..tried }).collect();
        for _ in 0..STEPS {
            self.look(walks, &tries);
            self.found.resize(self.rays.len(), Landing::default());
            self.landings.find(self.hole(), self.order, &self.rays, &mut self.found);
            let found = std::mem::take(&mut self.found);
            for (tried, landing) in tries.iter_mut().zip(&found) {
                let [cos, sin] = walks[tried.direction].polar;
                let g = &landing.gradient;
                let slope = g[2] * cos + g[3] * sin;
                tried.newton(landing.u, slope, CLOSE[self.order])?;
                if tried.done {
                    // The rest is of second order in the step.
                    let own = [g[0], g[1], g[4]];
                    let rate = |p: usize| -(own[p] + g[2] * moved[p]) / slope / tried.rho;
                    self.keep(walks, nodes, k, tried, slope, std::array::from_fn(rate));
                }
            }
            self.found = found;
            tries.retain(|t| !t.done);
            if tries.is_empty() {
                return Ok(());
            }
        }
        Err(NotFound)
    }

    /// Keeps a node that was found, and its derivatives ∂ln ρ/∂p.
    fn keep(
        &self,
        walks: &mut [Walk],
        nodes: &mut Nodes,
        k: usize,
        tried: &Try,
        slope: f64,
        rates: [f64; HOLE],
    ) {
        let s = scale(self.order, tried.x);
        let chi = 2.0 * PI * tried.direction as f64 / nodes.directions as f64;
        let value = &mut nodes.values[tried.direction * NODES + k];
        value[0] = self.view.weight(chi) / (tried.rho * s).powi(2);
        value[1..].copy_from_slice(&rates);
        let walk = &mut walks[tried.direction];
        walk.known = [[tried.x, tried.rho, 2.0 * tried.x / slope], walk.known[0]];
        walk.count += 1;
    }
}

impl Try {
    /// A step of Newton's method, and whether it was so small a share of ρ that it is the last.
    fn newton(&mut self, u: f64, slope: f64, close: f64) -> Result<(), NotFound> {
        if !(u + slope).is_finite() {
            return Err(NotFound);
        }
        // u falls outwards. x = √u is closer to a straight line, where there is one.
        let step = if u > 0.0 {
            (u.sqrt() - self.x) * 2.0 * u.sqrt() / slope
        } else {
            (u - self.x * self.x) / slope
        };
        let bounded = step.clamp(-0.3 * self.rho, 0.3 * self.rho);
        self.rho -= bounded;
        self.done = bounded.abs() < close * self.rho && slope < 0.0;
        Ok(())
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
