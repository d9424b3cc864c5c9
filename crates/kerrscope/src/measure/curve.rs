//! A closed curve in a picture, as points along it.

use std::f64::consts::{PI, TAU};

/// A closed curve that does not meet itself, of any shape. Lengths are in pixels.
///
/// What is a mean over directions from a centre, is ∮ … dθ/2π along the curve: where a direction meets it three times, the stretch in
/// between counts off. For a curve that each direction meets once it is the mean over directions.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its points, right and up of the picture's middle, anticlockwise; after the last comes the first.
    pub points: Vec<[f64; 2]>,
}

impl Curve {
    /// A curve through points, turned anticlockwise if it is not.
    pub fn through(mut points: Vec<[f64; 2]>) -> Self {
        if signed_area(&points) < 0.0 {
            points.reverse();
        }
        Self { points }
    }

    /// Pairs of neighbouring points.
    fn pieces(&self) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
        let next = self.points.iter().skip(1).chain(self.points.first());
        self.points.iter().zip(next).map(|(a, b)| [*a, *b])
    }

    /// Its length.
    pub fn length(&self) -> f64 {
        self.pieces().map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1])).sum()
    }

    /// The area within: ½ ∮ r² dθ around its centroid, by the trapezoidal rule. The points are on the curve and chords between them are not.
    pub fn area(&self) -> f64 {
        PI * self.mean(self.centroid(), |r| r * r)
    }

    /// The area of the polygon of its points, for curves of few points.
    pub fn polygon_area(&self) -> f64 {
        signed_area(&self.points)
    }

    /// Centre of the area within.
    pub fn centroid(&self) -> [f64; 2] {
        // From a point of the curve, so that nothing cancels far from the middle.
        let origin = self.points[0];
        let (mut area, mut sums) = (0.0, [0.0; 2]);
        for [a, b] in self.pieces() {
            let [a, b] = [a, b].map(|p| [p[0] - origin[0], p[1] - origin[1]]);
            let cross = a[0] * b[1] - a[1] * b[0];
            area += 0.5 * cross;
            sums = [0, 1].map(|k| sums[k] + cross * (a[k] + b[k]) / 6.0);
        }
        [0, 1].map(|k| origin[k] + sums[k] / area)
    }

    /// Mean of its distance from a centre within it, and its standard deviation.
    pub fn mean_radius(&self, centre: [f64; 2]) -> (f64, f64) {
        let mean = self.mean(centre, |r| r);
        (mean, (self.mean(centre, |r| r * r) - mean * mean).max(0.0).sqrt())
    }

    /// ∮ f(r) dθ/2π around a centre, by the trapezoidal rule.
    fn mean(&self, centre: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
        let piece = |[a, b]: [[f64; 2]; 2]| {
            let [a, b] = [a, b].map(|p| [p[0] - centre[0], p[1] - centre[1]]);
            let turn = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
            0.5 * (of(a[0].hypot(a[1])) + of(b[0].hypot(b[1]))) * turn
        };
        self.pieces().map(piece).sum::<f64>() / TAU
    }

    /// Second moments of the area within about its centroid, over the area: xx, yy and xy.
    pub fn second_moments(&self) -> [f64; 3] {
        let origin = self.centroid();
        let (mut area, mut sums) = (0.0, [0.0; 3]);
        for [a, b] in self.pieces() {
            let [[ax, ay], [bx, by]] = [a, b].map(|p| [p[0] - origin[0], p[1] - origin[1]]);
            let cross = ax * by - ay * bx;
            area += 0.5 * cross;
            let terms = [
                (ax * ax + ax * bx + bx * bx) / 12.0,
                (ay * ay + ay * by + by * by) / 12.0,
                (ax * by + 2.0 * ax * ay + 2.0 * bx * by + bx * ay) / 24.0,
            ];
            sums = [0, 1, 2].map(|k| sums[k] + cross * terms[k]);
        }
        sums.map(|sum| sum / area)
    }

    /// The area within over that of its convex hull: 1 for a curve without dents.
    pub fn solidity(&self) -> f64 {
        signed_area(&self.points) / signed_area(&hull(&self.points))
    }

    /// Whether a point is within.
    pub fn encloses(&self, [x, y]: [f64; 2]) -> bool {
        let crosses = |[a, b]: [[f64; 2]; 2]| {
            (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
        };
        self.pieces().filter(|piece| crosses(*piece)).count() % 2 == 1
    }

    /// How far a ray goes until it meets the curve for the last time; none if it does not.
    pub fn reach(&self, centre: [f64; 2], angle: f64) -> Option<f64> {
        let (sin, cos) = angle.sin_cos();
        let turned = |p: [f64; 2]| {
            let [x, y] = [p[0] - centre[0], p[1] - centre[1]];
            [cos * x + sin * y, cos * y - sin * x]
        };
        let meets = |piece: [[f64; 2]; 2]| {
            let [a, b] = piece.map(turned);
            ((a[1] > 0.0) != (b[1] > 0.0)).then(|| a[0] - a[1] / (b[1] - a[1]) * (b[0] - a[0]))
        };
        self.pieces().filter_map(meets).filter(|r| *r > 0.0).reduce(f64::max)
    }

    /// The same curve through points about a length apart.
    pub fn spaced(&self, step: f64) -> Self {
        let length = self.length();
        let count = ((length / step).round() as usize).max(8);
        let step = length / count as f64;
        let mut points = Vec::with_capacity(count);
        let mut passed = 0.0;
        for [a, b] in self.pieces() {
            let piece = (b[0] - a[0]).hypot(b[1] - a[1]);
            while points.len() < count && points.len() as f64 * step < passed + piece {
                let part = (points.len() as f64 * step - passed) / piece;
                points.push([0, 1].map(|k| a[k] + part * (b[k] - a[k])));
            }
            passed += piece;
        }
        Self { points }
    }

    /// Unit vectors outwards at its points, over a stretch of so many points on either side.
    pub fn normals(&self, stretch: usize) -> Vec<[f64; 2]> {
        let n = self.points.len();
        let at = |k: usize| {
            let (a, b) = (self.points[(k + n - stretch % n) % n], self.points[(k + stretch) % n]);
            let [x, y] = [b[0] - a[0], b[1] - a[1]];
            let size = x.hypot(y).max(f64::MIN_POSITIVE);
            [y / size, -x / size]
        };
        (0..n).map(at).collect()
    }

    /// Scatter of one point across the curve, from differences of third order between neighbours, in which a smooth curve vanishes.
    pub fn scatter(&self) -> f64 {
        let (n, normals) = (self.points.len(), self.normals(3));
        let p = |k: usize| self.points[k % n];
        let third = |k: usize| {
            let [x, y] = [0, 1].map(|i| p(k + 3)[i] - 3.0 * p(k + 2)[i] + 3.0 * p(k + 1)[i] - p(k)[i]);
            let normal = normals[(k + 1) % n];
            x * normal[0] + y * normal[1]
        };
        ((0..n).map(|k| third(k).powi(2)).sum::<f64>() / (20.0 * n as f64)).sqrt()
    }
}

/// The area within, negative for a curve that goes clockwise.
fn signed_area(points: &[[f64; 2]]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    let next = points.iter().skip(1).chain(points.first());
    let cross = |(a, b): (&[f64; 2], &[f64; 2])| {
        (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0])
    };
    0.5 * points.iter().zip(next).map(cross).sum::<f64>()
}

/// The convex hull of points, anticlockwise (Andrew 1979: the lower and the upper chain of the points sorted by x).
fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let chain = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut sorted.iter().copied());
    hull.extend(chain(&mut sorted.iter().rev().copied()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A bean that directions from its middle meet up to three times: x = (2 + cos t) turned along an arc, against sums over a fine grid.
    #[test]
    fn a_bean() {
        let place = |t: f64| {
            let (along, across) = (1.9 * t.cos(), 0.35 * t.sin());
            let r = 1.0 + across;
            [r * along.cos() * 30.0, r * along.sin() * 30.0]
        };
        let curve = Curve::through((0..4000).map(|k| place(-TAU * f64::from(k) / 4000.0)).collect());
        let (mut sum, mut first, mut second) = (0.0, [0.0; 2], [0.0; 3]);
        let cell = 0.05;
        for k in 0..2400 * 2400 {
            let (x, y) = ((f64::from(k % 2400) - 1199.5) * cell, (f64::from(k / 2400) - 1199.5) * cell);
            let (r, along) = (x.hypot(y) / 30.0, y.atan2(x));
            if ((r - 1.0) / 0.35).powi(2) + (along / 1.9).powi(2) < 1.0 {
                sum += 1.0;
                first = [first[0] + x, first[1] + y];
                second = [second[0] + x * x, second[1] + y * y, second[2] + x * y];
            }
        }
        let centre = first.map(|f| f / sum);
        let second = [
            second[0] / sum - centre[0] * centre[0],
            second[1] / sum - centre[1] * centre[1],
            second[2] / sum - centre[0] * centre[1],
        ];
        assert!((curve.area() / (sum * cell * cell) - 1.0).abs() < 1e-3, "{}", curve.area());
        let found = curve.centroid();
        assert!(
            (found[0] - centre[0]).abs() < 0.01 && (found[1] - centre[1]).abs() < 0.01,
            "{found:?} {centre:?}"
        );
        for (found, expected) in curve.second_moments().iter().zip(second) {
            assert!((found - expected).abs() < 0.3, "{found} {expected}");
        }
        assert!(curve.solidity() < 0.9 && curve.encloses([30.0, 0.0]) && !curve.encloses([-30.0, 0.0]));
        assert!((curve.reach([0.0, 0.0], 0.0).unwrap() - 40.5).abs() < 1e-3);
        let spaced = curve.spaced(0.5);
        assert!(
            (spaced.area() / curve.area() - 1.0).abs() < 1e-3
                && (spaced.length() / curve.length() - 1.0).abs() < 1e-3
        );
        assert!(spaced.scatter() < 1e-2);
    }

    /// A circle off the middle.
    #[test]
    fn a_circle() {
        let curve = Curve::through(
            (0..90)
                .map(|k| (TAU * f64::from(k) / 90.0).sin_cos())
                .map(|(s, c)| [7.0 + 5.0 * c, s * 5.0 - 3.0])
                .collect(),
        );
        assert!((curve.area() - 25.0 * PI).abs() < 1e-9 && (curve.solidity() - 1.0).abs() < 1e-12);
        let (mean, spread) = curve.mean_radius(curve.centroid());
        assert!((mean - 5.0).abs() < 1e-12 && spread < 1e-6);
    }
}
