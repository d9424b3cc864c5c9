//! A closed curve around a centre, as radii in equally spaced directions.

use std::f64::consts::TAU;

/// A closed curve that each direction from a centre meets once. Lengths are in pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Where its directions begin: right and up of the picture's middle.
    pub centre: [f64; 2],
    /// Distances from the centre, the first to the right, the others anticlockwise in equal steps.
    pub radii: Vec<f64>,
}

impl Outline {
    /// Its points, right and up of the picture's middle.
    pub fn points(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let step = TAU / self.radii.len() as f64;
        self.radii.iter().enumerate().map(move |(k, radius)| {
            let (sin, cos) = (k as f64 * step).sin_cos();
            [self.centre[0] + radius * cos, self.centre[1] + radius * sin]
        })
    }

    /// ½ ∫ r² dθ, by the trapezoidal rule, which for a smooth closed curve errs by less than any power of the step.
    pub fn area(&self) -> f64 {
        0.5 * self.mean(|r, _| r * r) * TAU
    }

    /// Centre of the area within: ∫ r³ (cos θ, sin θ) dθ/3 over the area.
    pub fn centroid(&self) -> [f64; 2] {
        let area = self.area();
        let moment =
            |part: fn(f64) -> f64| self.mean(|r, angle| r.powi(3) * part(angle)) * TAU / (3.0 * area);
        [self.centre[0] + moment(f64::cos), self.centre[1] + moment(f64::sin)]
    }

    /// Mean of the radii over directions, and their standard deviation.
    pub fn mean_radius(&self) -> (f64, f64) {
        let mean = self.mean(|r, _| r);
        (mean, self.mean(|r, _| (r - mean).powi(2)).sqrt())
    }

    fn mean(&self, of: impl Fn(f64, f64) -> f64) -> f64 {
        let n = self.radii.len() as f64;
        self.radii.iter().enumerate().map(|(k, r)| of(*r, TAU * k as f64 / n)).sum::<f64>() / n
    }

    /// Scatter of one radius, from differences of third order between neighbours, in which a smooth curve vanishes.
    pub fn scatter(&self) -> f64 {
        let n = self.radii.len();
        let r = |k: usize| self.radii[k % n];
        let third = |k: usize| r(k + 3) - 3.0 * r(k + 2) + 3.0 * r(k + 1) - r(k);
        ((0..n).map(|k| third(k).powi(2)).sum::<f64>() / (20.0 * n as f64)).sqrt()
    }

    /// Largest step between neighbouring radii.
    pub fn largest_jump(&self) -> f64 {
        let n = self.radii.len();
        (0..n).map(|k| (self.radii[(k + 1) % n] - self.radii[k]).abs()).fold(0.0, f64::max)
    }
}
