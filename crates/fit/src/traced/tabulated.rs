//! The light of a disk in a spacetime given as text, and what it changes by with each of the metric's parameters.
//!
//! With the matter's u^t and Ω, I = g⁴F and
//!
//! ```text
//! g = 1/[u^t (1 − Ωλ)],   d ln g = −d ln u^t + λ dΩ/(1 − Ωλ).
//! ```

use super::matter::{Glow, Profile};
use super::shine::Shine;
use super::spacetime::Spacetime;

/// Intervals of the table in x = 1/√r.
const INTERVALS: usize = 512;

/// F, ln u^t and Ω/x³.
type Row = [f64; 3];

/// The neighbours of a spacetime in one parameter, a step below and a step above; one may be missing.
pub struct Neighbours<'a> {
    /// Both.
    pub sides: [Option<&'a Spacetime>; 2],
    /// The step.
    pub step: f64,
}

/// Matter on circular geodesics about +z, tabulated.
#[derive(Clone, Debug)]
pub struct Tabulated {
    profile: Profile,
    /// Values and slopes in x at equal steps of x, from `first` on.
    rows: Vec<[Row; 2]>,
    /// For each parameter the derivatives at the same places.
    changes: Vec<Vec<Row>>,
    first: f64,
    per_step: f64,
}

impl Tabulated {
    /// Of a spacetime, for radii whose x lies between the two, and of its neighbours in each parameter.
    pub fn new(
        here: &Spacetime,
        neighbours: &[Neighbours<'_>],
        profile: Profile,
        [low, high]: [f64; 2],
    ) -> Self {
        let step = (high - low) / INTERVALS as f64;
        let place = |k: usize| low + step * k as f64;
        let last = here.isco.powf(-0.5);
        let rows = (0..=INTERVALS)
            .map(|k| {
                let h = 1e-4 * place(k);
                // The last stable orbit is not stepped over.
                let ends = [place(k) - h, (place(k) + h).min(last)];
                let [from, to] = ends.map(|x| row(here, x).unwrap_or_default());
                let value = row(here, place(k).min(last)).unwrap_or_default();
                [value, std::array::from_fn(|f| (to[f] - from[f]) / (ends[1] - ends[0]))]
            })
            .collect();
        let changes = neighbours.iter();
        let changes = changes.map(|pair| (0..=INTERVALS).map(|k| change(here, pair, place(k))).collect());
        Self { profile, rows, changes: changes.collect(), first: low, per_step: step.recip() }
    }

    /// The interval of x, and the share of it.
    fn find(&self, x: f64) -> (usize, f64) {
        let place = ((x - self.first) * self.per_step).clamp(0.0, INTERVALS as f64);
        let k = (place as usize).min(INTERVALS - 1);
        (k, place - k as f64)
    }

    /// Values and slopes in x, by Hermite's cubic.
    fn at(&self, (k, s): (usize, f64)) -> [Row; 2] {
        let [from, to] = [&self.rows[k], &self.rows[k + 1]];
        let h = self.per_step.recip();
        let (mut value, mut slope) = ([0.0; 3], [0.0; 3]);
        for f in 0..3 {
            let rise = to[0][f] - from[0][f];
            let (c, d) =
                (3.0 * rise - h * (2.0 * from[1][f] + to[1][f]), h * (from[1][f] + to[1][f]) - 2.0 * rise);
            value[f] = from[0][f] + s * (h * from[1][f] + s * (c + s * d));
            slope[f] = (h * from[1][f] + s * (2.0 * c + 3.0 * s * d)) * self.per_step;
        }
        [value, slope]
    }

    /// F and its derivatives in x and in the index.
    fn profile(&self, x: f64, tabulated: [f64; 2]) -> [f64; 3] {
        match self.profile {
            Profile::PageThorne => [tabulated[0], tabulated[1], 0.0],
            Profile::Even => [1.0, 0.0, 0.0],
            Profile::PowerLaw { index } => {
                let flux = x.powf(2.0 * index);
                [flux, 2.0 * index * flux / x, 2.0 * x.ln() * flux]
            }
        }
    }
}

/// F, ln u^t and Ω/x³ at x, where there is an orbit.
fn row(spacetime: &Spacetime, x: f64) -> Option<Row> {
    let r = x.powi(-2);
    let orbit = spacetime.matter.orbit(r)?;
    Some([spacetime.matter.flux(r), orbit.time.ln(), orbit.rate / x.powi(3)])
}

/// The derivatives of a row in a parameter: a neighbour whose last stable orbit lies farther out is left away.
fn change(here: &Spacetime, pair: &Neighbours<'_>, x: f64) -> Row {
    let [below, above] = pair.sides.map(|side| row(side?, x));
    match difference([below, above], || row(here, x), pair.step) {
        Some((from, to, width)) => std::array::from_fn(|f| (to[f] - from[f]) / width),
        None => [0.0; 3],
    }
}

/// What to divide by what, of values a step below and a step above, or one of them and that in the middle.
pub fn difference<T>(
    sides: [Option<T>; 2],
    here: impl FnOnce() -> Option<T>,
    step: f64,
) -> Option<(T, T, f64)> {
    match sides {
        [Some(below), Some(above)] => Some((below, above, 2.0 * step)),
        [Some(below), None] => Some((below, here()?, step)),
        [None, Some(above)] => Some((here()?, above, step)),
        [None, None] => None,
    }
}

/// A tabulated disk, the first of whose parameters is one of the metric's.
pub struct Changing<'a> {
    /// The disk.
    pub matter: &'a Tabulated,
    /// Which parameter; none where derivatives are not known.
    pub parameter: Option<usize>,
}

impl Changing<'_> {
    fn change(&self, (k, s): (usize, f64)) -> Row {
        let Some(rows) = self.parameter.and_then(|p| self.matter.changes.get(p)) else { return [0.0; 3] };
        std::array::from_fn(|f| rows[k][f] + s * (rows[k + 1][f] - rows[k][f]))
    }
}

impl Shine for Changing<'_> {
    fn flux(&self, x: f64) -> [f64; 4] {
        let place = self.matter.find(x);
        let [value, slope] = self.matter.at(place);
        let [flux, per_x, per_index] = self.matter.profile(x, [value[0], slope[0]]);
        let changed = if self.matter.profile == Profile::PageThorne { self.change(place)[0] } else { 0.0 };
        // dx/dr = −x³/2.
        [flux, -0.5 * x.powi(3) * per_x, changed, per_index]
    }

    fn glow(&self, x: f64, lambda: f64) -> Glow {
        let place = self.matter.find(x);
        let [value, slope] = self.matter.at(place);
        let [flux, per_x, per_index] = self.matter.profile(x, [value[0], slope[0]]);
        let x3 = x.powi(3);
        let rate = value[2] * x3;
        let behind = 1.0 - rate * lambda;
        if !(behind > 0.0) {
            return Glow::default();
        }
        let beamed = ((-value[1]).exp() / behind).powi(4);
        let light = beamed * flux;
        let per_rate = lambda / behind;
        let rate_x = slope[2] * x3 + 3.0 * value[2] * x * x;
        let changed = self.change(place);
        let flux_changed = if self.matter.profile == Profile::PageThorne { changed[0] } else { 0.0 };
        let along = 4.0 * light * (per_rate * rate_x - slope[1]) + beamed * per_x;
        Glow {
            value: light,
            radius: -0.5 * x3 * along,
            lambda: 4.0 * light * rate / behind,
            spin: 4.0 * light * (per_rate * changed[2] * x3 - changed[1]) + beamed * flux_changed,
            index: beamed * per_index,
        }
    }
}
