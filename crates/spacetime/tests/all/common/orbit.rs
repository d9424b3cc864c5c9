//! Light around a hole without spin: (du/dψ)² = P(u) = 1/b² − u² + 2u³ with u = 1/r and ψ the
//! angle in the plane of the orbit (Darwin 1959; integrals in Byrd & Friedman 1971, Carlson 1979).

use ellip::{ellipf, elliprf};
use std::f64::consts::PI;

/// The orbits with one impact parameter b.
pub struct Orbit {
    pub b: f64,
    /// The roots of P, three if b > √27, else one.
    pub roots: Vec<f64>,
}

impl Orbit {
    pub fn new(b: f64) -> Self {
        // u = 1/6 + v/3 gives 4v³ − 3v = 1 − 54/b², the cosine of three times an angle.
        let cos = 1.0 - 54.0 / (b * b);
        let roots = if b * b > 27.0 {
            let sin = (54.0 * 2.0 * (b - 27f64.sqrt()) * (b + 27f64.sqrt())).sqrt() / (b * b);
            let third = sin.atan2(cos) / 3.0;
            // −cos(60° − x) for cos(120° + x), so that u₁ < u₂ < u₃.
            [2.0, 4.0, 0.0].iter().map(|k| 1.0 / 6.0 + (third + k * PI / 3.0).cos() / 3.0).collect()
        } else {
            vec![1.0 / 6.0 - ((-cos).acosh() / 3.0).cosh() / 3.0]
        };
        let roots = roots.into_iter().map(|root: f64| polish(root, b)).collect();
        Self { b, roots }
    }

    /// P(u).
    pub fn square(&self, u: f64) -> f64 {
        1.0 / (self.b * self.b) + u * u * (2.0 * u - 1.0)
    }

    /// ∫du/√P from the least root, or where u lies beyond the barrier from ∞ (negative).
    pub fn angle(&self, u: f64) -> f64 {
        match self.roots[..] {
            [u1, u2, u3] if u <= u2 * (1.0 + 1e-12) => {
                // 2F/√(2(u₃ − u₁)) with sin² = (u − u₁)/(u₂ − u₁), in Carlson's form.
                let (x, y) = ((u2 - u).max(0.0) / (u2 - u1), (u3 - u) / (u3 - u1));
                let sin = ((u - u1) / (u2 - u1)).sqrt();
                (2.0 / (u3 - u1)).sqrt() * sin * elliprf(x, y, 1.0).unwrap()
            }
            [u1, u2, u3] => {
                // 2F/√(2(u₃ − u₁)) with sin² = (u₃ − u₁)/(u − u₁).
                let (x, y) = ((u - u3).max(0.0) / (u - u1), (u - u2) / (u - u1));
                let sin = ((u3 - u1) / (u - u1)).sqrt();
                -(2.0 / (u3 - u1)).sqrt() * sin * elliprf(x, y, 1.0).unwrap()
            }
            [u1] => {
                // P = 2(u − u₁)((u − c)² + d²): Byrd & Friedman 239.00.
                let c = 0.5 * (0.5 - u1);
                // The product of the pair is −1/(2 b² u₁).
                let big = (u1 * u1 - 2.0 * c * u1 - 0.5 / (self.b * self.b * u1)).sqrt();
                let amplitude = 2.0 * ((u - u1) / big).sqrt().atan();
                ellipf(amplitude, (big + c - u1) / (2.0 * big)).unwrap() / (2.0 * big).sqrt()
            }
            _ => unreachable!(),
        }
    }

    /// The angle between a photon at 1/u₀, going inwards or outwards there, and at 1/u, before or
    /// after its turning point.
    pub fn swept(&self, u0: f64, inward: bool, u: f64, turned: bool) -> f64 {
        let leg = if inward { self.angle(u) - self.angle(u0) } else { self.angle(u0) - self.angle(u) };
        match self.turn(u0, inward) {
            Some(turn) if turned => {
                let (start, end) = (self.angle(turn) - self.angle(u0), self.angle(turn) - self.angle(u));
                start.abs() + end.abs()
            }
            _ => leg,
        }
    }

    /// 1/r of the turning point ahead.
    pub fn turn(&self, u0: f64, inward: bool) -> Option<f64> {
        match self.roots[..] {
            [_, u2, _] if inward && u0 <= u2 => Some(u2),
            [_, _, u3] if !inward && u0 >= u3 => Some(u3),
            _ => None,
        }
    }
}

/// Two steps of Newton's method for a root of P, unless it is nearly double.
fn polish(root: f64, b: f64) -> f64 {
    let mut u = root;
    for _ in 0..2 {
        let slope = u * (6.0 * u - 2.0);
        if slope.abs() > 0.03 {
            u -= (1.0 / (b * b) + u * u * (2.0 * u - 1.0)) / slope;
        }
    }
    u
}
