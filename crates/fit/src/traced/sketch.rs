//! Corners of the cells that an image is drawn with, and the edges between lines.

use super::canvas::{CHANNELS, Canvas, Corner, MOVERS};
use super::lines::{Lines, Point};
use super::order::{HOLE, View};
use super::picture::{AT_EDGES, AT_FRAME, AT_HOLE, Setting};
use super::pieces::MOVES;
use super::screen::{SCREEN, Screen};
use super::shine::Shine;
use super::strips::Strip;

/// What corners are computed from.
pub struct Sketch<'a> {
    /// Whether the observer is above the plane.
    pub above: bool,
    /// The disk.
    pub setting: &'a Setting,
    /// The observer, or its mirror image above the plane.
    pub view: &'a View,
    /// Its screen.
    pub screen: &'a Screen,
    /// What shines.
    pub matter: &'a dyn Shine,
    /// λ at α = 0, and what it changes by with α.
    pub lambda: [f64; 2],
    /// Whether derivatives are wanted.
    pub derivatives: bool,
}

impl Sketch<'_> {
    /// How the centre of polar coordinates moves with the hole's parameters.
    fn center(&self) -> (f64, [f64; HOLE]) {
        let (alpha, mut moves) = self.view.center();
        if !self.above {
            moves[1] = -moves[1];
        }
        (alpha, moves)
    }

    /// The derivative in the hole's parameter `p` of what is a function of the view, whose inclination is that of the mirror image.
    fn own(&self, p: usize, value: f64) -> f64 {
        if p == 1 && !self.above { -value } else { value }
    }

    /// The corner at a point of a line.
    pub fn corner(&self, image: &Lines, line: usize, point: &Point) -> Corner {
        let [cos, sin, ..] = image.rays[line];
        let (center, center_moves) = self.center();
        let impact = [center + point.rho * cos, point.rho * sin];
        let [lambda, per_alpha] = self.lambda;
        let glow = self.matter.glow(point.x, lambda + per_alpha * impact[0]);
        let spot = self.screen.spot(impact);
        if !self.derivatives {
            return Corner::lit(spot.pixel, glow.value);
        }
        // The matter keeps its radius and its direction ψ.
        let mut glows = [glow.spin, 0.0, 0.0, glow.index];
        let mut moves = [[0.0; 2]; MOVERS];
        // ∂(α, β)/∂(pixel), inverted.
        let [[xx, yx], [xy, yy]] = [spot.drift[4].map(|c| -c), spot.drift[5]];
        let determinant = xx * yy - xy * yx;
        for (k, drift) in spot.drift.iter().enumerate() {
            let mut own = [0.0; 2];
            if k < HOLE {
                let along = self.own(k, point.drift[k]);
                own = [center_moves[k] + along * cos, along * sin];
                glows[k] += glow.lambda * per_alpha * own[0];
            }
            if k == 1 {
                glows[1] -= glow.lambda * impact[0] * self.setting.inclination.cos();
            }
            let [x, y] = [own[0] - drift[0], own[1] - drift[1]];
            moves[k] = [(yy * x - xy * y) / determinant, (xx * y - yx * x) / determinant];
        }
        // dr/dx = −2/x³.
        let per_x = -2.0 * glow.radius / point.x.powi(3);
        let outwards = per_x * point.slope[0] + glow.lambda * per_alpha * cos;
        let around = per_x * point.slope[1] / point.rho - glow.lambda * per_alpha * sin;
        let [by_alpha, by_beta] = [outwards * cos - around * sin, outwards * sin + around * cos];
        let slope = [by_alpha * xx + by_beta * yx, by_alpha * xy + by_beta * yy];
        Corner::new(spot.pixel, (glow.value, slope), glows, moves)
    }

    /// What both edges sweep over between two lines.
    pub fn sweep(&self, from: &Strip, to: &Strip, canvas: &mut Canvas) {
        let (center, center_moves) = self.center();
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            let ends = [from, to];
            let corners = ends.map(|strip| strip.ends()[side]);
            if corners.iter().all(|corner| corner.light() == 0.0) || !canvas.sees(corners.map(|c| c.place)) {
                continue;
            }
            let bounds = ends.map(|strip| strip.bounds[side]);
            let rays = ends.map(|strip| strip.ray);
            let impact = [0, 1].map(|k| [center + bounds[k].rho * rays[k][0], bounds[k].rho * rays[k][1]]);
            let along = [impact[1][0] - impact[0][0], impact[1][1] - impact[0][1]];
            let ends = [0, 1].map(|k| {
                let mut sweep = [0.0; CHANNELS];
                let [cos, sin] = rays[k];
                let drift = self.screen.spot(impact[k]).drift;
                let pixel = (drift[4][0] * drift[5][1] - drift[4][1] * drift[5][0]).abs();
                let area = |[x, y]: [f64; 2]| sign * (x * along[1] - y * along[0]) / pixel;
                for p in 0..SCREEN {
                    let mut moved = [-drift[p][0], -drift[p][1]];
                    if p < HOLE {
                        let outwards = self.own(p, bounds[k].moves[p]);
                        moved = [moved[0] + center_moves[p] + outwards * cos, moved[1] + outwards * sin];
                    }
                    let channel = if p < HOLE { AT_HOLE + p } else { AT_FRAME + p - HOLE };
                    sweep[channel] += area(moved);
                }
                for p in HOLE..MOVES {
                    let outwards = bounds[k].moves[p];
                    sweep[AT_EDGES + p - HOLE] += area([outwards * cos, outwards * sin]);
                }
                (corners[k].place, corners[k].light(), sweep)
            });
            canvas.edge(ends);
        }
    }
}
