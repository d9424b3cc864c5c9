//! The search for a node of an image by secants, along one direction: light lands farther out the farther its ray passes.

use super::sight::Landing;

/// The last step of a search, in ln ρ, per image order.
const CLOSE: [f64; 4] = [1e-4, 1e-5, 1e-6, 1e-7];

/// How far a search goes at first where it does not know how far, and at most at a time, in ln ρ per image order.
pub const FIRST: [f64; 4] = [0.03, 0.01, 1e-3, 1e-4];
const MOST: [f64; 4] = [0.3, 0.05, 5e-3, 5e-4];

/// A node that is looked for.
pub struct Search {
    /// Which direction and which node.
    pub direction: usize,
    /// The node.
    pub node: usize,
    /// x, and dx/d ln ρ, nearly.
    pub target: f64,
    /// That slope.
    pub slope: f64,
    /// ln Q, nearly.
    pub log: f64,
    /// What is known: ln Q where light lands too far in, and too far out.
    pub low: f64,
    /// The second.
    pub high: f64,
    /// The ray before: ln Q, and where it landed.
    pub last: Option<[f64; 2]>,
    /// How far the next step goes where nothing is known.
    pub grow: f64,
    /// Whether it was found.
    pub done: bool,
}

impl Search {
    /// Learns from a ray; false where it was given up.
    pub fn learn(&mut self, landing: Landing, order: usize) -> bool {
        let x = match landing {
            Landing::Lost => return false,
            Landing::Captured => {
                self.low = self.low.max(self.log);
                self.wander(1.0);
                return true;
            }
            Landing::Sky => {
                self.high = self.high.min(self.log);
                self.wander(-1.0);
                return true;
            }
            Landing::At(x) => x,
        };
        if x > self.target {
            self.low = self.low.max(self.log);
        } else {
            self.high = self.high.min(self.log);
        }
        if let Some([log, before]) = self.last {
            let secant = (x - before) / (self.log - log);
            // Far from what Kerr's image says, two rays do not tell a slope.
            let share = secant / self.slope;
            if share.is_finite() && share > 0.2 && share < 5.0 {
                self.slope = secant;
            }
        }
        self.last = Some([self.log, x]);
        let step = ((self.target - x) / self.slope).clamp(-MOST[order], MOST[order]);
        self.done = step.abs() < CLOSE[order];
        let next = self.log + step;
        self.log = if self.done || (next > self.low && next < self.high) {
            next
        } else if self.low.is_finite() && self.high.is_finite() {
            0.5 * (self.low + self.high)
        } else {
            next
        };
        true
    }

    /// Goes on where nothing landed.
    fn wander(&mut self, sign: f64) {
        self.log = if self.low.is_finite() && self.high.is_finite() {
            0.5 * (self.low + self.high)
        } else {
            self.grow *= 2.0;
            self.log + 0.5 * sign * self.grow
        };
    }
}
