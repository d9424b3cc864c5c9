//! A shear that straightens the valley along the observer's distance.
//!
//! What a picture looks like from afar goes linearly with u = 1/r; the coordinate of r is a logarithm, in which a distance that hardly
//! shows is one like any other. The other coordinates thus follow a line in u: with w the straight coordinates, d the distance's,
//! and P(u) the line, from P(u₀) = 0 at the place w₀ the shear is made for,
//!
//! ```text
//! q_d = w_d,   q_k = w_k + P_k(u(w_d)) − P′_k(u₀) u′(w₀) (w_d − w₀),   P′ = −H⁻¹_oo H_od / u′,
//! ```
//!
//! which touches the identity at w₀, and whose determinant is 1. P goes straight on from there, and where a picture tells so little of
//! the distance that the valley is long, through other places of it: cubic polynomials between each two, with the valley's own slopes.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::bounds::Bounds;
use crate::coordinates::{Coordinates, Reciprocal};
use crate::mode::factor;

/// A place of the valley.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Knot {
    u: f64,
    /// P and P′, 0 for the distance itself.
    line: Vec<[f64; 2]>,
}

/// The shear about a place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shear {
    distance: Reciprocal,
    /// The place it is made for, and u′ there.
    place: Vec<f64>,
    slope: f64,
    /// P′ there.
    along: Vec<f64>,
    /// Places of the valley by u, the one it is made for among them.
    knots: Vec<Knot>,
}

impl Shear {
    /// About a place with its curvature, minus the second derivatives there; none where no distance is looked for.
    pub fn about(coordinates: &Coordinates, place: &[f64], curvature: &DMatrix<f64>) -> Option<Self> {
        let distance = coordinates.distance()?;
        let (n, d) = (place.len(), distance.index);
        let [u, slope] = distance.at(place[d]);
        if n < 2 || slope == 0.0 {
            return None;
        }
        let others = curvature.clone().remove_row(d).remove_column(d);
        let both = DVector::from_iterator(n - 1, (0..n).filter(|k| *k != d).map(|k| curvature[(k, d)]));
        let turned = factor(others).solve(&both);
        let mut along: Vec<f64> = turned.iter().map(|t| -t / slope).collect();
        along.insert(d, 0.0);
        if along.iter().any(|b| !b.is_finite()) {
            return None;
        }
        let line = along.iter().map(|b| [0.0, *b]).collect();
        Some(Self { distance, place: place.to_vec(), slope, along, knots: vec![Knot { u, line }] })
    }

    /// Leads the line through the place that another shear is made for.
    pub fn lead_through(&mut self, other: &Self) {
        let [u, _] = self.distance.at(other.place[self.distance.index]);
        let mut line: Vec<[f64; 2]> =
            (0..self.place.len()).map(|k| [other.place[k] - self.place[k], other.along[k]]).collect();
        line[self.distance.index] = [0.0; 2];
        let at = self.knots.partition_point(|knot| knot.u < u);
        self.knots.insert(at, Knot { u, line });
    }

    /// The same line in coordinates that are straight between bounds about the same place.
    pub fn between(&self, bounds: &Bounds) -> Self {
        let mut shear = self.clone();
        for knot in &mut shear.knots {
            let mut there: Vec<f64> = self.place.iter().zip(&knot.line).map(|(q, [p, _])| q + p).collect();
            let slopes = bounds.slopes(&there);
            bounds.straighten(&mut there);
            for (k, [p, slope]) in knot.line.iter_mut().enumerate() {
                (*p, *slope) = (there[k] - self.place[k], *slope / slopes[k]);
            }
        }
        shear
    }

    /// Which coordinate is the distance's.
    pub fn index(&self) -> usize {
        self.distance.index
    }

    /// 1/r where the shear is made.
    pub fn u(&self) -> f64 {
        self.distance.at(self.place[self.distance.index])[0]
    }

    /// The valley's place at 1/r; none beyond the bounds of the distance.
    pub fn valley(&self, u: f64) -> Option<Vec<f64>> {
        let mut place: Vec<f64> = self.place.iter().zip(self.line(u)).map(|(q, [p, _])| q + p).collect();
        place[self.distance.index] = self.distance.of(u)?;
        Some(place)
    }

    /// P and P′ at 1/r.
    fn line(&self, u: f64) -> impl Iterator<Item = [f64; 2]> {
        let after = self.knots.partition_point(|knot| knot.u <= u);
        let from = &self.knots[after.max(1) - 1];
        let to = self.knots.get(after).filter(|_| after > 0);
        from.line.iter().enumerate().map(move |(k, [p, slope])| {
            let Some(to) = to else { return [p + slope * (u - from.u), *slope] };
            let (width, [end, last]) = (to.u - from.u, to.line[k]);
            let v = (u - from.u) / width;
            // Hermite's cubic polynomial: what is left of the straight line between both ends.
            let mean = (end - p) / width;
            let [a, b] = [slope - mean, last - mean];
            let (there, back) = (v * (1.0 - v) * (1.0 - v), v * v * (1.0 - v));
            let change = a * (1.0 - v) * (1.0 - 3.0 * v) - b * v * (2.0 - 3.0 * v);
            [p + width * (mean * v + a * there - b * back), mean + change]
        })
    }

    /// What is added to each coordinate, and its change with w.
    fn added(&self, w: f64) -> impl Iterator<Item = [f64; 2]> {
        let [u, rate] = self.distance.at(w);
        let step = w - self.place[self.distance.index];
        self.along
            .iter()
            .zip(self.line(u))
            .map(move |(b, [p, change])| [p - b * self.slope * step, change * rate - b * self.slope])
    }

    /// From straight coordinates to those of the parameters.
    pub fn bend(&self, place: &mut [f64]) {
        let added = self.added(place[self.distance.index]);
        place.iter_mut().zip(added).for_each(|(q, [sum, _])| *q += sum);
    }

    /// And back.
    pub fn straighten(&self, place: &mut [f64]) {
        let added = self.added(place[self.distance.index]);
        place.iter_mut().zip(added).for_each(|(q, [sum, _])| *q -= sum);
    }

    /// From the gradient at a place in the parameters' coordinates to that in straight ones.
    pub fn pull(&self, place: &[f64], gradient: &mut [f64]) {
        let added = self.added(place[self.distance.index]);
        let sum: f64 = gradient.iter().zip(added).map(|(g, [_, change])| g * change).sum();
        gradient[self.distance.index] += sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Freedom, Parameter};
    use crate::prior::Prior;

    fn parameter(name: &'static str, bounds: [f64; 2]) -> Parameter {
        Parameter { name, unit: "", meaning: "", bounds, pixels: 0, usual: Freedom::Fixed(0.0) }
    }

    /// Coordinates of a flux anywhere and of a distance.
    fn flux_and_distance() -> Coordinates {
        let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
        let parameters = [parameter("flux", everywhere), parameter("distance", [0.0, f64::INFINITY])];
        let free = [
            Freedom::Free(Prior::Uniform(f64::NEG_INFINITY, f64::INFINITY)),
            Freedom::Free(Prior::LogUniform(40.0, 1e4)),
        ];
        Coordinates::new(&parameters, &free, &[1.0, 1.0])
    }

    /// A valley that is a cubic polynomial in 1/r is the line between places of it, and beyond them goes straight on; there and back;
    /// slopes against differences.
    #[test]
    fn led_through_a_bent_valley() {
        let coordinates = flux_and_distance();
        let valley =
            |u: f64| [3.0 + 5.0 * u - 900.0 * u * u + 2e5 * u.powi(3), 5.0 - 1800.0 * u + 6e5 * u * u];
        let about = |r: f64| {
            let [flux, rate] = valley(1.0 / r);
            let place = coordinates.of(&[flux, r]);
            let rate = rate * coordinates.distance().unwrap().at(place[1])[1];
            let curvature = [1e8, -1e8 * rate, -1e8 * rate, 1e8 * rate * rate + 1.0];
            Shear::about(&coordinates, &place, &DMatrix::from_row_slice(2, 2, &curvature)).unwrap()
        };
        let mut shear = about(800.0);
        for r in [150.0, 4000.0, 300.0] {
            shear.lead_through(&about(r));
        }
        for r in [150.0, 180.0, 290.0, 500.0, 800.0, 2000.0, 4000.0] {
            let u: f64 = 1.0 / r;
            let place = shear.valley(u).unwrap();
            let values = coordinates.at(&place).values;
            assert!((values[1] / r - 1.0).abs() < 1e-12 && (values[0] - valley(u)[0]).abs() < 1e-13);
            // In straight coordinates it is the straight line that touches it.
            let mut straight = place.clone();
            shear.straighten(&mut straight);
            let expected =
                valley(1.0 / 800.0)[0] + shear.along[0] * shear.slope * (place[1] - shear.place[1]);
            assert!((straight[0] - expected).abs() < 1e-12, "{r}");
            let mut back = straight.clone();
            shear.bend(&mut back);
            assert!((back[0] - place[0]).abs() < 1e-14 && back[1] == place[1]);
            if [150.0, 800.0, 4000.0].contains(&r) {
                // Second derivatives jump here.
                continue;
            }
            let added = |w: f64| shear.added(w).next().unwrap();
            let difference = (added(place[1] + 1e-5)[0] - added(place[1] - 1e-5)[0]) / 2e-5;
            assert!((added(place[1])[1] - difference).abs() < 1e-7 * shear.along[0].abs(), "{r}");
        }
        let [end, rate] = valley(1.0 / 150.0);
        let place = shear.valley(0.009).unwrap();
        assert!((place[0] - end - rate * (0.009 - 1.0 / 150.0)).abs() < 1e-12);
        assert!(shear.valley(0.03).is_none());
    }

    /// In coordinates that are straight between bounds the line leads through the same places, the same way.
    #[test]
    fn between_bounds_too() {
        let parameters = [parameter("spin", [-1.0, 1.0]), parameter("distance", [0.0, f64::INFINITY])];
        let free = [Freedom::Free(Prior::Uniform(-1.0, 1.0)), Freedom::Free(Prior::LogUniform(40.0, 1e4))];
        let coordinates = Coordinates::new(&parameters, &free, &[1.0, 1.0]);
        // q = 2 + 300 u − 2e4 u², near the bound of 1.
        let valley = |u: f64| [2.0 + 300.0 * u - 2e4 * u * u, 300.0 - 4e4 * u];
        let about = |r: f64| {
            let mut place = coordinates.of(&[0.0, r]);
            let [q, rate] = valley(1.0 / r);
            place[0] = q;
            let rate = rate * coordinates.distance().unwrap().at(place[1])[1];
            let curvature = [1e8, -1e8 * rate, -1e8 * rate, 1e8 * rate * rate + 1.0];
            (Shear::about(&coordinates, &place, &DMatrix::from_row_slice(2, 2, &curvature)).unwrap(), place)
        };
        let (mut shear, place) = about(800.0);
        for r in [150.0, 4000.0, 300.0] {
            shear.lead_through(&about(r).0);
        }
        let bounds = Bounds::about(&coordinates, &place);
        let between = shear.between(&bounds);
        for r in [150.0, 300.0, 800.0, 4000.0] {
            let at = |u: f64| {
                let mut place = between.valley(u).unwrap();
                assert!(bounds.bend(&mut place));
                place[0]
            };
            let (u, [q, rate]) = (1.0 / r, valley(1.0 / r));
            assert!((at(u) - q).abs() < 1e-12, "{r}: {} {q}", at(u));
            let step = 1e-8;
            let difference = (at(u + step) - at(u - step)) / (2.0 * step);
            assert!((difference / rate - 1.0).abs() < 1e-4, "{r}: {difference} {rate}");
        }
        // Where it is made, both touch the identity.
        let mut straight = place.clone();
        between.straighten(&mut straight);
        assert!(straight.iter().zip(&place).all(|(a, b)| (a - b).abs() < 1e-12));
    }

    /// There and back; the gradient against differences; and where the others follow 1/r, the valley is straight.
    #[test]
    fn straight_in_one_over_r() {
        let coordinates = flux_and_distance();
        // ln p = −½ (1e4 (flux − 3 − 5/r))² − ½ (200 (1/r − 1e-3))², a narrow valley along flux = 3 + 5/r.
        let log = |q: &[f64]| {
            let values = coordinates.at(q).values;
            let u = 1.0 / values[1];
            -0.5 * (1e4 * (values[0] - 3.0 - 5.0 * u)).powi(2) - 0.5 * (2e3 * (u - 1e-3)).powi(2)
        };
        let place = coordinates.of(&[3.005, 1000.0]);
        let slope = coordinates.distance().unwrap().at(place[1])[1];
        let (a, b, c) = (1e8, -5e8 * slope, (25e8 + 4e6) * slope * slope);
        let shear =
            Shear::about(&coordinates, &place, &DMatrix::from_row_slice(2, 2, &[a, b, b, c])).unwrap();
        for step in [-0.9, -0.2, 0.1, 0.5, 1.4] {
            // The line that the curvature shows, by its straight coordinates.
            let straight = [place[0] + 5.0 * slope * step, place[1] + step];
            let mut bent = straight;
            shear.bend(&mut bent);
            let u = 1.0 / coordinates.at(&bent).values[1];
            assert!((log(&bent) + 0.5 * (2e3 * (u - 1e-3)).powi(2)).abs() < 1e-9);
            let mut back = bent;
            shear.straighten(&mut back);
            assert!(back.iter().zip(&straight).all(|(a, b)| (a - b).abs() < 1e-14));
            let far = |h: f64, k: usize, sheared: bool| {
                let mut q = if sheared { straight } else { bent };
                q[k] += h;
                if sheared {
                    shear.bend(&mut q);
                }
                log(&q)
            };
            let difference = |k, sheared| (far(1e-6, k, sheared) - far(-1e-6, k, sheared)) / 2e-6;
            let mut gradient = [difference(0, false), difference(1, false)];
            shear.pull(&bent, &mut gradient);
            for (k, g) in gradient.iter().enumerate() {
                let other = difference(k, true);
                assert!((g - other).abs() < 1e-4 * (1.0 + other.abs()), "{k}: {g} {other}");
            }
        }
    }
}
