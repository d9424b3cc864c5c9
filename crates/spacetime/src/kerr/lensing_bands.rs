//! Image orders on a distant observer's sky.

use std::f64::consts::TAU;

use super::CriticalCurve;
use crate::closed::{ClosedForm, NODES};
use crate::geodesic::{Path, Query, Tracer};
use crate::observer::impact_ray;

/// Where the equatorial plane outside the horizon is seen at one image order: the lensing band (Gralla, Holz & Wald 2019, PRD 100,
/// 024018; Paugnat, Lupsasca, Vincent & Wielgus 2022, A&A 668, A11), around which the critical curve runs.
///
/// Places are on Bardeen's screen, M. The curves go once around, with the critical curve's own points between them.
#[derive(Clone, Debug, PartialEq)]
pub struct LensingBand {
    /// The image order n: how often the ray has met the plane before.
    pub order: usize,
    /// The image of the horizon. NaN where the plane is seen edge-on.
    pub inner: Vec<[f64; 2]>,
    /// The image of what is infinitely far away in the plane; for n = 0 it is all around, and the list empty.
    pub outer: Vec<[f64; 2]>,
}

/// Halvings of an interval of exponents, after which its ends are the same numbers.
const HALVINGS: usize = 60;

/// The smallest offset from the critical curve, as a share of its size: about what rounding leaves of it.
const CLOSEST: f64 = 1e-14;

impl LensingBand {
    /// Its width from the inner edge to the outer one at each point, M; nothing for n = 0.
    pub fn widths(&self) -> Vec<f64> {
        let apart = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).hypot(a[1] - b[1]);
        self.inner.iter().zip(&self.outer).map(apart).collect()
    }
}

/// The bands of orders 0 to `most` for spin a in [−1, 1], inclination i in [0, π] and an observer at infinity, at `points`
/// points around.
///
/// Crossing n exists on a ray between the edges of band n only, so that they are found by halving, in the logarithm of the offset
/// from the critical curve. An edge at the relative offset δ is known to some 10⁻¹⁵/δ of it: bands shrink by e^γ from one order
/// to the next (Johnson et al. 2020), e^π without spin.
///
/// ```
/// use kerrscope_spacetime::kerr::lensing_bands;
/// let bands = lensing_bands(0.0, 0.0, 3, 4);
/// let widths: Vec<f64> = bands.iter().skip(1).map(|band| band.widths()[0]).collect();
/// assert!((widths[1] / widths[2] / std::f64::consts::PI.exp() - 1.0).abs() < 0.015);
/// ```
pub fn lensing_bands(spin: f64, inclination: f64, most: usize, points: usize) -> Vec<LensingBand> {
    let curve = CriticalCurve::new(spin, inclination);
    let extent = curve.extent();
    let middle = [0.5 * (extent.alpha_min + extent.alpha_max), 0.0];
    let sight = Sight { tracer: ClosedForm::new(spin, NODES, 10_000), spin, inclination };
    let around: Vec<[f64; 2]> = (0..points).map(|k| curve.point(TAU * k as f64 / points as f64)).collect();
    let shadow = sight.within_horizon(middle[0], extent.beta_max);
    (0..=most)
        .map(|order| {
            let inner = if order == 0 {
                let edge = |to: &[f64; 2]| shadow.map_or([f64::NAN; 2], |from| sight.first(from, *to));
                around.iter().map(edge).collect()
            } else {
                around.iter().map(|at| sight.last(middle, *at, order, -1.0)).collect()
            };
            let outer = if order == 0 {
                Vec::new()
            } else {
                around.iter().map(|at| sight.last(middle, *at, order, 1.0)).collect()
            };
            LensingBand { order, inner, outer }
        })
        .collect()
}

struct Sight {
    tracer: ClosedForm,
    spin: f64,
    inclination: f64,
}

impl Sight {
    /// How often the ray of a point crosses the plane outside of the horizon, `most` times at most.
    fn crossings(&self, point: [f64; 2], most: usize) -> usize {
        let query = Query { max_crossings: most, ..Query::default() };
        let Ok(ray) = impact_ray(Some(self.spin), self.inclination, f64::INFINITY, point) else { return 0 };
        let mut path = Path::default();
        self.tracer.trace(&ray, &query, &mut path);
        path.crossings.len()
    }

    /// A point in the image of the horizon at order 0, where nothing of the plane is seen: the middle of those of one column
    /// of the critical curve.
    fn within_horizon(&self, alpha: f64, beta: f64) -> Option<[f64; 2]> {
        const STEPS: i32 = 400;
        let at = |k: i32| [alpha, beta * f64::from(k) / f64::from(STEPS)];
        let dark: Vec<i32> = (1 - STEPS..STEPS).filter(|k| self.crossings(at(*k), 1) == 0).collect();
        let (first, last) = (dark.first()?, dark.last()?);
        Some([alpha, 0.5 * (at(*first)[1] + at(*last)[1])])
    }

    /// The place between a point that sees nothing of the plane and one that does, from which on it is seen.
    fn first(&self, from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
        let at = |share: f64| [0, 1].map(|i| from[i] + share * (to[i] - from[i]));
        let (mut dark, mut seen) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let share = 0.5 * (dark + seen);
            if self.crossings(at(share), 1) > 0 {
                seen = share;
            } else {
                dark = share;
            }
        }
        at(seen)
    }

    /// The last place, from a point of the critical curve outwards (`side` 1) or inwards (−1), that is seen at an order above 0.
    fn last(&self, middle: [f64; 2], critical: [f64; 2], order: usize, side: f64) -> [f64; 2] {
        let at = |offset: f64| [0, 1].map(|i| critical[i] + side * offset * (critical[i] - middle[i]));
        // Exponents of the offset.
        let (mut seen, mut dark) = (CLOSEST.ln(), if side < 0.0 { 0.0 } else { 20.0 });
        for _ in 0..HALVINGS {
            let exponent = 0.5 * (seen + dark);
            if self.crossings(at(exponent.exp()), order + 1) > order {
                seen = exponent;
            } else {
                dark = exponent;
            }
        }
        at(seen.exp())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed::Nodes;
    use std::f64::consts::PI;

    /// The angle that light of impact parameter b sweeps around a hole without spin, from infinity to infinity or to the
    /// horizon: ∫ du/√(1/b² − u² + 2u³), another route than the closed form's. Towards a turning point u = u_t(1 − x²).
    fn swept(b: f64) -> f64 {
        let nodes = Nodes::new(400);
        let integral = |f: &dyn Fn(f64) -> f64| -> f64 {
            nodes.half().iter().map(|&(x, weight)| 0.5 * weight * (f(0.5 + 0.5 * x) + f(0.5 - 0.5 * x))).sum()
        };
        if b < 27f64.sqrt() {
            // Most of it next to u = 1/3: u = 1/3 + w sinh s.
            let w = ((1.0 / (b * b) - 1.0 / 27.0).max(0.0)).sqrt();
            let [low, high] = [-1.0 / 3.0, 0.5 - 1.0 / 3.0].map(|u: f64| (u / w).asinh());
            return integral(&|x| {
                let s = low + (high - low) * x;
                let u = 1.0 / 3.0 + w * s.sinh();
                (high - low) * w * s.cosh() / (1.0 / (b * b) - u * u + 2.0 * u * u * u).sqrt()
            });
        }
        // u_t by Newton's method from below; then 1/b² − u² + 2u³ = (u_t − u)(u_t + u − 2(u_t² + u_t u + u²)).
        let mut turn = 0.3;
        for _ in 0..200 {
            let f: f64 = 1.0 / (b * b) - turn * turn + 2.0 * turn * turn * turn;
            turn += f / (2.0 * turn - 6.0 * turn * turn);
        }
        // x = e^(−y) spreads what is next to the turning point.
        let end = 40.0;
        2.0 * integral(&|y| {
            let x = (-end * y * y).exp();
            let u = turn * (1.0 - x * x);
            let rest = turn + u - 2.0 * (turn * turn + turn * u + u * u);
            2.0 * end * y * x * 2.0 * turn * x / (turn * x * x * rest).sqrt()
        })
    }

    /// Face-on without spin: the edges of order n are where light sweeps (n + ½)π.
    #[test]
    fn edges_around_a_hole_without_spin() {
        for band in lensing_bands(0.0, 0.0, 4, 3) {
            let angle = (band.order as f64 + 0.5) * PI;
            for [alpha, beta] in band.inner.iter().chain(&band.outer) {
                let b = alpha.hypot(*beta);
                // Next to the critical curve the angle goes with the logarithm of the offset.
                let offset = (b / 27f64.sqrt() - 1.0).abs();
                let found = swept(b);
                assert!((found - angle).abs() < 1e-9 + 1e-14 / offset, "{}: {b} {found} {angle}", band.order);
            }
        }
    }

    /// Successive widths shrink by e^π without spin, wherever the observer is, but for the next power of the offset. The edges
    /// themselves are exact, so that this is how it is: seen face-on 1.1 % from n = 2 to 3 and 0.05 % from 3 to 4; at an
    /// inclination, where light of one order sweeps up to a quarter turn less, up to 4 times as much.
    #[test]
    fn bands_shrink() {
        for inclination in [0.0, 0.6, 1.3] {
            let bands = lensing_bands(0.0, inclination, 4, 12);
            let widths: Vec<Vec<f64>> = bands.iter().map(LensingBand::widths).collect();
            for k in 0..12 {
                let ratio = widths[2][k] / widths[3][k] / PI.exp();
                let most = if inclination == 0.0 { 0.0115 } else { 0.05 };
                assert!((ratio - 1.0).abs() < most, "{inclination}: {ratio}");
                let ratio = widths[3][k] / widths[4][k] / PI.exp();
                assert!((ratio - 1.0).abs() < 0.1 * most, "{inclination}: {ratio}");
            }
        }
    }

    /// Bands lie within each other, around the critical curve, and with spin as well.
    #[test]
    fn bands_are_nested() {
        let bands = lensing_bands(0.9, 1.2, 3, 24);
        let curve = CriticalCurve::new(0.9, 1.2);
        let extent = curve.extent();
        let middle = [0.5 * (extent.alpha_min + extent.alpha_max), 0.0];
        let far = |p: &[f64; 2]| (p[0] - middle[0]).hypot(p[1] - middle[1]);
        for k in 0..24 {
            let critical = far(&curve.point(TAU * f64::from(k) / 24.0));
            let k = k as usize;
            for pair in bands[1..].windows(2) {
                assert!(far(&pair[0].inner[k]) < far(&pair[1].inner[k]));
                assert!(far(&pair[1].inner[k]) < critical && critical < far(&pair[1].outer[k]));
                assert!(far(&pair[1].outer[k]) < far(&pair[0].outer[k]));
            }
        }
        assert!(bands[0].inner.iter().all(|p| p[0].is_finite() && p[1].is_finite()));
    }
}
