//! Where the rows of a picture's cells lie, from the inner edge of an image to the outer one.

use super::order::ORDERS;
use super::picture::{COARSE, Fineness};
use super::shine::Shine;

/// Inclinations, degrees, and the steps between rows there as a share of those from the side.
const CLOSER: [(f64, f64); 3] = [(7.0, 0.3), (22.0, 0.5), (40.0, 1.0)];

/// Steps between which the rows of a disk are spread.
const GRID: usize = 400;

/// How many of the rows images have by their orders, from the side, and at least.
const ROWS: [f64; ORDERS] = [1.0, 0.4, 0.1, 0.05];
const FEWEST: f64 = 8.0;

/// Rows of a disk that is lit evenly.
const EVEN_ROWS: usize = 6;

impl Fineness {
    /// The steps between rows, in those of the fineness. From above, spin, scale and distance change almost nothing but the brightness
    /// along the radius, and what is straight between rows is mistaken for them: with whole steps for 8e-3 of the spin at 0°
    /// (a = 0.6), for 3e-3 at 20° (a = 0.7), for less than 5e-4 from 25° on; but from anywhere for what a theory's numbers do together
    /// with the spin (for 0.02 of Johannsen's α₁₃ at 50°).
    fn closer(&self, inclination: f64) -> f64 {
        if self.tail >= COARSE {
            return 1.0;
        }
        if self.radial {
            return CLOSER[0].1;
        }
        let degrees = inclination.to_degrees();
        let piece = CLOSER.windows(2).find(|ends| degrees < ends[1].0);
        piece.map_or(1.0, |ends| {
            let [(from, low), (to, high)] = [ends[0], ends[1]];
            low + (high - low) * (degrees - from).max(0.0) / (to - from)
        })
    }

    /// t of the rows of an image: close where the flux bends, and fewer where it is thinner.
    pub(super) fn rows(
        &self,
        matter: &dyn Shine,
        [inner, outer]: [f64; 2],
        order: usize,
        inclination: f64,
    ) -> Vec<f64> {
        if matter.even() {
            // What is the same everywhere has edges alone.
            return (0..=EVEN_ROWS).map(|row| row as f64 / EVEN_ROWS as f64).collect();
        }
        let x = |t: f64| inner + (outer - inner) * t;
        let largest = (0..=GRID).map(|k| matter.flux(x(k as f64 / GRID as f64))[0]).fold(0.0, f64::max);
        let mut sums = vec![0.0];
        for k in 0..GRID {
            let middle = x((k as f64 + 0.5) / GRID as f64);
            let relative = 2.0 * (inner - outer) / GRID as f64 / middle;
            let bend = matter.smoothness(middle, largest) * self.bend;
            let steps = (relative / self.step).max(relative * middle.powi(-2) / bend);
            sums.push(sums[k] + steps);
        }
        let share = if order == 0 { self.closer(inclination).recip() } else { ROWS[order] };
        let count = (sums[GRID] * share).ceil().clamp(FEWEST, 2000.0);
        let mut rows = Vec::new();
        let mut k = 0;
        for row in 0..=count as usize {
            let target = sums[GRID] * row as f64 / count;
            while k + 1 < GRID && sums[k + 1] < target {
                k += 1;
            }
            rows.push(
                ((k as f64 + (target - sums[k]) / (sums[k + 1] - sums[k])) / GRID as f64).clamp(0.0, 1.0),
            );
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::traced::matter::{Matter, Profile};

    #[test]
    fn rows_lie_closer_from_above_and_for_theories() {
        let [inner, outer] = [0.51, 0.1];
        let matter = Matter::new(0.6, Profile::PageThorne, [outer, inner]);
        let rows = |fineness: Fineness, order, degrees: f64| {
            let rows = fineness.rows(&matter, [inner, outer], order, degrees.to_radians());
            assert!(rows[0] == 0.0 && (rows[rows.len() - 1] - 1.0).abs() < 1e-12, "{rows:?}");
            assert!(rows.windows(2).all(|pair| pair[1] > pair[0]), "{rows:?}");
            rows.len() as f64 - 1.0
        };
        let side = rows(Fineness::default(), 0, 60.0);
        let theory = Fineness { radial: true, ..Fineness::default() };
        for (found, share) in [
            (rows(Fineness::default(), 0, 0.0), 0.3),
            (rows(Fineness::default(), 0, 22.0), 0.5),
            (rows(theory, 0, 60.0), 0.3),
        ] {
            assert!((found * share / side - 1.0).abs() < 0.02, "{found} {side}");
        }
        assert!((rows(Fineness::default(), 1, 60.0) / side - ROWS[1]).abs() < 0.02);
        assert_eq!(rows(Fineness::default(), 3, 60.0), FEWEST);
        // What is noisier than that needs no more.
        assert_eq!(rows(Fineness::SKETCH, 0, 0.0), rows(Fineness::SKETCH, 0, 60.0));
    }
}
