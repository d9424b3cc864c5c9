//! The orbits and the flux of a metric, tabulated: a crossing of the plane asks in tens of nanoseconds what the metric's
//! formulas would take microseconds for.

use std::f64::consts::PI;

use super::circular::Orbit;
use super::family::Family;
use super::panels::{NODES, Panels};
use super::search::{Stable, inner_end, photon_orbit, stable};
use super::{CircularError, Equator, Sense};
use crate::closed::Nodes;
use crate::dual::Dual;
use crate::metric::Metric;

/// Differences from the functions themselves, as a share.
const TOLERANCE: f64 = 1e-12;

/// Nodes of each quadrature of the flux.
const QUADRATURE: usize = 20;

/// Tables over x = 1/√r, in which orbits are smooth out to infinity.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    sense: Sense,
    /// g_tt, r g_tφ, g_φφ/r², g_zz.
    equator: Panels<4>,
    /// r^{3/2} Ω, and F/[x⁶ (1 − x/x₀)²], zero where there is no last stable orbit.
    orbits: Panels<2>,
    /// Radii between which the metric is known.
    reach: [f64; 2],
    /// The radius of the innermost stable orbit, and what falls from it; the radius of the photon orbit.
    pub isco: Option<(f64, Orbit)>,
    pub photon: Option<f64>,
    /// Where stable orbits begin.
    inner: f64,
}

impl Table {
    /// From the horizon to `outer`, a radius.
    pub fn new<M: Metric>(metric: &M, sense: Sense, outer: f64) -> Result<Self, CircularError> {
        if !metric.is_axisymmetric() {
            return Err(CircularError::NotAxisymmetric);
        }
        let family = Family { metric, sense };
        let edge = metric.edge().recip();
        let inverse = Inverse { family };
        let reach = inverse.place(outer).min(edge);
        // Orbits are followed from well outside.
        let far = (16.0 * reach).max(1000.0).min(edge);
        let end = inner_end(metric, far);
        if !family.is_level(0.5 * (end + reach)) || !family.is_level(reach) {
            return Err(CircularError::NotLevel);
        }
        let Stable { inner, ends, outer: outermost } =
            stable(&family, end, far).filter(|s| s.inner < reach).ok_or(CircularError::NoOrbits { outer })?;
        // Outside of the horizon itself, where formulas may have no value.
        let rim = if end > 0.0 { end * (1.0 + 1e-6) } else { inner.min(1e-3 * reach) };
        let range = |from: f64, to: f64| [inverse.variable(to), inverse.variable(from)];
        let equator = Panels::new(range(rim, reach), TOLERANCE, |_, nodes| {
            nodes.map(|x| {
                let Equator { tt, tp, pp, zz } = family.equator(inverse.at(x));
                let r = 1.0 / (x * x);
                [tt, tp * r, pp / (r * r), zz]
            })
        });
        let ring = |r: f64| family.ring(r);
        let isco = ring(inner).filter(|_| ends).map(|ring| (family.radius(inner), ring.orbit));
        let mut flux = Flux { inverse, nodes: Nodes::new(QUADRATURE), known: (inner, 0.0), inner };
        let start = inverse.variable(inner);
        let stop = inverse.variable(reach.min(outermost));
        // From the last stable orbit outwards: −x grows.
        let orbits = Panels::new([-start, -stop], TOLERANCE, |from, nodes| {
            if ends {
                flux.begin(inverse.at(-from));
            }
            let mut rows = [[0.0; 2]; NODES];
            for (row, x) in rows.iter_mut().zip(nodes.map(|x| -x)) {
                let place = inverse.at(x);
                let Some(found) = ring(place) else { continue };
                let scale = x.powi(6) * (1.0 - x / start).powi(2);
                let shine = if ends { flux.at(place) / scale } else { 0.0 };
                *row = [found.orbit.rate / x.powi(3), shine];
            }
            rows
        });
        let photon = photon_orbit(&family, end, inner).map(|x| family.radius(x));
        let reach = [family.radius(rim), family.radius(reach)];
        Ok(Self { sense, equator, orbits, reach, isco, photon, inner: family.radius(inner) })
    }

    /// The metric of a circle between the horizon and the outer radius.
    pub fn equator(&self, r: f64) -> Option<Equator> {
        let [near, far] = self.reach;
        (r >= near && r <= far * (1.0 + 1e-12)).then(|| {
            let [tt, tp, pp, zz] = self.equator.at(r.sqrt().recip());
            Equator { tt, tp: tp / r, pp: pp * r * r, zz }
        })
    }

    /// A stable orbit.
    pub fn orbit(&self, r: f64) -> Option<Orbit> {
        if !(r >= self.inner * (1.0 - 1e-12)) {
            return None;
        }
        let Equator { tt, tp, pp, .. } = self.equator(r)?;
        let x = r.sqrt().recip();
        let [rate, _] = self.orbits.at(-x);
        let rate = rate * x.powi(3);
        let time = (-(tt + 2.0 * tp * rate + pp * rate * rate)).sqrt().recip();
        Some(Orbit { rate, time, energy: -time * (tt + tp * rate), momentum: time * (tp + pp * rate) })
    }

    /// F, for Ṁ = 1.
    pub fn flux(&self, r: f64) -> f64 {
        let Some((isco, _)) = self.isco else { return 0.0 };
        if !(r > isco && r <= self.reach[1] * (1.0 + 1e-12)) {
            return 0.0;
        }
        let x = r.sqrt().recip();
        let [_, shine] = self.orbits.at(-x);
        // 1 − x/x₀ = (r − r₀)/(r + √(r r₀)).
        shine * x.powi(6) * ((r - isco) / (r + (r * isco).sqrt())).powi(2)
    }

    pub fn sense(&self) -> Sense {
        self.sense
    }

    /// The largest difference of the tables from the metric, as a share of what they hold.
    pub fn error(&self) -> f64 {
        self.equator.error().max(self.orbits.error())
    }
}

/// From radii to places.
#[derive(Clone, Copy)]
struct Inverse<'a, M> {
    family: Family<'a, M>,
}

impl<M: Metric> Inverse<'_, M> {
    /// x = 1/√r at (ρ, 0, 0).
    fn variable(&self, place: f64) -> f64 {
        self.family.radius(place).sqrt().recip()
    }

    fn at(&self, x: f64) -> f64 {
        self.place(1.0 / (x * x))
    }

    /// ρ at a radius, by Newton's method: both are nearly the same.
    fn place(&self, r: f64) -> f64 {
        let mut place = r;
        for _ in 0..60 {
            let zero = Dual::fixed(0.0);
            let found = self.family.metric.radius(&[Dual::variable([place], 0), zero, zero]);
            let step = (found.value - r) / found.gradient[0];
            if !step.is_finite() {
                break;
            }
            let next = (place - step).clamp(0.25 * place, 4.0 * place);
            let moved = (next - place).abs();
            place = next;
            if moved <= 2e-16 * place {
                break;
            }
        }
        place
    }
}

/// The flux by quadrature (Page & Thorne 1974, eq. 11 and 12), in which any ρ will do for r:
///   F = −(Ṁ/4π) Ω′/[√−g (E − ΩL)²] ∫ (E − ΩL) L′ dρ from the last stable orbit on, √−g that of t, ρ and φ.
struct Flux<'a, M> {
    inverse: Inverse<'a, M>,
    nodes: Nodes,
    /// A place, and the integral up to there.
    known: (f64, f64),
    /// The last stable orbit.
    inner: f64,
}

impl<M: Metric> Flux<'_, M> {
    /// The integral is to be known from here on.
    fn begin(&mut self, place: f64) {
        if place > self.known.0 {
            self.known = (place, self.known.1 + self.integral(self.known.0, place));
        }
    }

    fn at(&self, place: f64) -> f64 {
        let (from, sum) = self.known;
        let Some(ring) = self.inverse.family.ring(place) else { return 0.0 };
        let free = ring.orbit.energy - ring.orbit.rate * ring.orbit.momentum;
        let sum = sum + self.integral(from, place);
        // ∂_ρ of a circle within `inner` has no meaning; rounding may ask for it.
        let sum = if place > self.inner { sum } else { 0.0 };
        -ring.rate_slope / (4.0 * PI * ring.volume * free * free) * sum
    }

    /// ∫ (E − ΩL) L′ dρ over s = 1/√ρ, dρ = −2ρ^{3/2} ds.
    fn integral(&self, from: f64, to: f64) -> f64 {
        let (a, b) = (from.sqrt().recip(), to.sqrt().recip());
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let at = |s: f64| {
            let place = 1.0 / (s * s);
            let Some(ring) = self.inverse.family.ring(place) else { return 0.0 };
            let free = ring.orbit.energy - ring.orbit.rate * ring.orbit.momentum;
            -2.0 * place / s * free * ring.momentum_slope
        };
        let pair = |&(x, weight): &(f64, f64)| weight * (at(middle + half * x) + at(middle - half * x));
        half * self.nodes.half().iter().map(pair).sum::<f64>()
    }
}
