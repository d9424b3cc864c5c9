//! From impact parameters to pixels, and how that moves with its parameters.
//!
//! The observer is static at Boyer–Lindquist (r, θ = i), u = 1/r, and looks along −e_r. A photon of λ = −α sin i and p_θ = β comes
//! from the direction whose components along e_φ and −e_θ of its tetrad are, times r,
//!
//! ```text
//! (α − α₀) k_α,   β k_β,   α₀ = 2au sin i/(σ − 2u),   k_α = (1 − 2u/σ)/√(1 − 2u + a²u²),   k_β = √(1 − 2u/σ)/√σ,
//! ```
//!
//! σ = 1 + a²u² cos² i (from p_(φ) = (L + g_tφ/g_tt)/√(g_φφ − g_tφ²/g_tt), p_(θ) = p_θ/√Σ, p_(t) = 1/√(−g_tt)). At infinity they are
//! α and β. The picture's right axis lies along (cos roll, sin roll), and the projected spin axis at the position angle −roll.

use kerrscope::spacetime::{Dual, Scalar};

/// How a direction becomes a place in the picture.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Projection {
    /// Equal angles: sin x cos y to the right and sin y up.
    #[default]
    Angular,
    /// Tangents, as in a pinhole camera.
    Pinhole,
}

/// Where the picture is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Width and height in pixels.
    pub size: [usize; 2],
    /// M in a pixel, at the distance of the hole.
    pub scale: f64,
    /// Where −e_r is, in pixels from the middle of the picture to the right and up.
    pub center: [f64; 2],
    /// Position angle of the projected spin axis, radians, anticlockwise from up.
    pub position_angle: f64,
}

/// Parameters on which the screen depends: spin, inclination, 1/r, scale, both coordinates of the centre, position angle.
pub const SCREEN: usize = 7;

/// The screen of an observer.
#[derive(Clone, Copy, Debug)]
pub struct Screen {
    frame: Frame,
    projection: Projection,
    u: f64,
    /// −1 where the observer is below the plane: β is then that of the mirror image, seen from above.
    side: f64,
    /// Cosine and sine of roll.
    roll: [f64; 2],
    /// α₀, k_α and k_β.
    offset: Dual<f64, 3>,
    stretch: [Dual<f64, 3>; 2],
}

/// A place on the screen.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// Pixels from the top left corner, to the right and down.
    pub pixel: [f64; 2],
    /// How α and β of this pixel change with each of the parameters.
    pub drift: [[f64; 2]; SCREEN],
}

impl Screen {
    /// The screen of an observer at 1/r = u and inclination i in radians, below the plane beyond π/2.
    pub fn new(spin: f64, inclination: f64, u: f64, frame: Frame, projection: Projection) -> Self {
        let [a, i, u_] = Dual::<f64, 3>::variables([spin, inclination, u]);
        let (sin, cos) = i.sin_cos();
        let sigma = (a * u_ * cos).squared() + 1.0;
        let well = -(u_ * 2.0) / sigma + 1.0;
        let offset = a * u_ * sin * 2.0 / (sigma - u_ * 2.0);
        let delta = (a * u_).squared() - u_ * 2.0 + 1.0;
        let stretch = [well / delta.sqrt(), (well / sigma).sqrt()];
        let side = if inclination > std::f64::consts::FRAC_PI_2 { -1.0 } else { 1.0 };
        let (sin, cos) = (-frame.position_angle).sin_cos();
        Self { frame, projection, u, side, roll: [cos, sin], offset, stretch }
    }

    /// The same for another parameter than a, with which a changes by `turn`.
    pub fn turning(mut self, turn: f64) -> Self {
        self.offset.gradient[0] *= turn;
        for stretch in &mut self.stretch {
            stretch.gradient[0] *= turn;
        }
        self
    }

    /// The direction of light of impact parameters (α, β): components along e_φ and −e_θ, times r.
    pub fn towards(&self, [alpha, beta]: [f64; 2]) -> [f64; 2] {
        [(alpha - self.offset.value) * self.stretch[0].value, beta * self.stretch[1].value]
    }

    /// Direction times r, (right, up), from a place in M from the centre.
    #[cfg(test)]
    fn direction(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        if self.u == 0.0 {
            return [x, y];
        }
        let u = self.u;
        match self.projection {
            Projection::Angular => {
                let ((sin_x, _), (sin_y, cos_y)) = ((x * u).sin_cos(), (y * u).sin_cos());
                [sin_x * cos_y / u, sin_y / u]
            }
            Projection::Pinhole => {
                let length = ((x * x + y * y) * u * u + 1.0).sqrt();
                [x / length, y / length]
            }
        }
    }

    /// The inverse of `direction`, and there ∂direction/∂(x, y), as rows, and ∂direction/∂u.
    fn place(&self, [x, y]: [f64; 2]) -> ([f64; 2], [[f64; 2]; 3]) {
        let u = self.u;
        if u == 0.0 {
            return ([x, y], [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]);
        }
        match self.projection {
            Projection::Angular => {
                let cos = |sin: f64| (1.0 - sin * sin).sqrt();
                let sin_y = (y * u).clamp(-1.0, 1.0);
                let cos_y = cos(sin_y);
                let sin_x = if cos_y > 0.0 { (x * u / cos_y).clamp(-1.0, 1.0) } else { 0.0 };
                let cos_x = cos(sin_x);
                let [x, y] = [sin_x.asin() / u, sin_y.asin() / u];
                let right = x * cos_x * cos_y - y * sin_x * sin_y - sin_x * cos_y / u;
                let up = y * cos_y - sin_y / u;
                ([x, y], [[cos_x * cos_y, -sin_x * sin_y], [0.0, cos_y], [right / u, up / u]])
            }
            Projection::Pinhole => {
                let forward = (1.0 - (x * x + y * y) * u * u).max(1e-6).sqrt();
                let [x, y] = [x / forward, y / forward];
                let square = x * x + y * y;
                let length = (square * u * u + 1.0).sqrt();
                let cube = length.powi(-3);
                let rate = -square * u * cube;
                let [xx, xy, yy] = [x * x * u * u * cube, x * y * u * u * cube, y * y * u * u * cube];
                ([x, y], [[1.0 / length - xx, -xy], [-xy, 1.0 / length - yy], [x * rate, y * rate]])
            }
        }
    }

    /// Where light of impact parameters (α, β) is seen.
    pub fn spot(&self, [alpha, beta]: [f64; 2]) -> Spot {
        let [cos, sin] = self.roll;
        let Frame { size, scale, center, .. } = self.frame;
        let along = (alpha - self.offset.value) * self.stretch[0].value;
        let up = self.side * beta * self.stretch[1].value;
        let (place, [right, upward, outward]) = self.place([cos * along + sin * up, cos * up - sin * along]);
        let pixel = [
            0.5 * size[0] as f64 + center[0] + place[0] / scale,
            0.5 * size[1] as f64 - center[1] - place[1] / scale,
        ];
        // What a change of the direction, times r, does to α and β at a fixed pixel.
        let impact = |[x, y]: [f64; 2]| {
            let (along, up) = (cos * x - sin * y, sin * x + cos * y);
            [along / self.stretch[0].value, self.side * up / self.stretch[1].value]
        };
        let moved = |[x, y]: [f64; 2]| impact([right[0] * x + right[1] * y, upward[0] * x + upward[1] * y]);
        let mut drift = [[0.0; 2]; SCREEN];
        for (k, drift) in drift.iter_mut().take(3).enumerate() {
            let [stretch_along, stretch_up] = self.stretch.map(|stretch| stretch.gradient[k] / stretch.value);
            *drift =
                [self.offset.gradient[k] - (alpha - self.offset.value) * stretch_along, -beta * stretch_up];
        }
        let farther = impact(outward);
        drift[2] = [drift[2][0] + farther[0], drift[2][1] + farther[1]];
        drift[3] = moved([place[0] / scale, place[1] / scale]);
        drift[4] = moved([-scale, 0.0]);
        drift[5] = moved([0.0, -scale]);
        // Roll turns (along, up) by itself; the position angle is −roll.
        drift[6] = [up / self.stretch[0].value, -self.side * along / self.stretch[1].value];
        Spot { pixel, drift }
    }

    #[cfg(test)]
    /// Impact parameters (α, β) that are seen at a place of the picture, in pixels from the top left corner.
    pub fn impact(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Frame { size, scale, center, .. } = self.frame;
        let [right, up] = self.direction([
            (x - 0.5 * size[0] as f64 - center[0]) * scale,
            (0.5 * size[1] as f64 - center[1] - y) * scale,
        ]);
        let [cos, sin] = self.roll;
        let [along, up] = [cos * right - sin * up, sin * right + cos * up];
        [self.offset.value + along / self.stretch[0].value, self.side * up / self.stretch[1].value]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame { size: [64, 48], scale: 0.3, center: [1.5, -2.0], position_angle: 0.7 };

    /// There and back, and drifts against differences, at finite and infinite distance, from above and from below.
    #[test]
    fn drifts_are_those_of_fixed_pixels() {
        for projection in [Projection::Angular, Projection::Pinhole] {
            for (u, i) in [(0.0, 0.9), (0.02, 0.9), (0.01, 2.2)] {
                let at = |p: [f64; SCREEN]| {
                    let frame = Frame { scale: p[3], center: [p[4], p[5]], position_angle: p[6], ..FRAME };
                    Screen::new(p[0], p[1], p[2], frame, projection)
                };
                let p = [0.8, i, u, 0.3, 1.5, -2.0, 0.7];
                let pixel = [11.0, 37.5];
                let impact = at(p).impact(pixel);
                let spot = at(p).spot(impact);
                assert!((0..2).all(|k| (spot.pixel[k] - pixel[k]).abs() < 1e-10), "{spot:?}");
                for k in 0..SCREEN {
                    if k == 2 && u == 0.0 {
                        continue;
                    }
                    let step = 1e-5 * p[k].abs();
                    let moved = |sign: f64| {
                        let mut p = p;
                        p[k] += sign * step;
                        at(p).impact(pixel)
                    };
                    let (high, low) = (moved(1.0), moved(-1.0));
                    for c in 0..2 {
                        let difference = (high[c] - low[c]) / (2.0 * step);
                        let error = (spot.drift[k][c] - difference).abs();
                        assert!(
                            error < 1e-6 * (1.0 + difference.abs()),
                            "{k} {c}: {:?} {difference}",
                            spot.drift[k]
                        );
                    }
                }
            }
        }
    }
}
