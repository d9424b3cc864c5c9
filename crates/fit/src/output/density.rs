//! Densities of draws in two dimensions, and the regions of highest density.

/// Bins to either side.
pub const BINS: usize = 26;

/// Standard deviation of the smoothing in bins, and how many of these it reaches.
const SMOOTH: f64 = 1.0;
const REACH: usize = 3;

/// A histogram of points of the unit square, smoothed.
pub struct Density {
    /// Shares of the points, along the rows, the lowest one first.
    values: Vec<f64>,
}

/// A level of a density, drawn: lengths are shares of the square's side.
#[derive(Default)]
pub struct Region {
    /// Pieces of the region above the level, none of which overlap.
    pub pieces: Vec<Vec<[f64; 2]>>,
    /// Straight pieces of its edge.
    pub edges: Vec<[[f64; 2]; 2]>,
}

impl Density {
    /// Of points, of which those outside the square are left away; none if there are none within.
    ///
    /// The smoothing is a Gaussian of one bin. It mirrors what comes to an edge, so that a density that ends at one is not drawn away
    /// from it.
    pub fn of(points: impl Iterator<Item = [f64; 2]>) -> Option<Self> {
        let mut counts = vec![0.0; BINS * BINS];
        let mut total = 0.0;
        for point in points {
            if point.iter().all(|share| (0.0..=1.0).contains(share)) {
                let [x, y] = point.map(|share| ((share * BINS as f64) as usize).min(BINS - 1));
                counts[y * BINS + x] += 1.0;
                total += 1.0;
            }
        }
        if total == 0.0 {
            return None;
        }
        for count in &mut counts {
            *count /= total;
        }
        // Along the rows, then along the columns.
        Some(Self { values: smoothed(&smoothed(&counts)) })
    }

    /// The level above which a share of the points lie.
    pub fn level(&self, share: f64) -> f64 {
        let mut sorted = self.values.clone();
        sorted.sort_by(|a, b| b.total_cmp(a));
        let mut sum = 0.0;
        for value in sorted {
            sum += value;
            if sum >= share {
                return value;
            }
        }
        0.0
    }

    /// The region above a level: between the middles of the bins the density is a straight line along the sides of squares, and
    /// beyond the outermost it goes on as it is.
    pub fn region(&self, level: f64) -> Region {
        let mut region = Region::default();
        // Corners are the middles of bins and of a ring of bins around them.
        let at = |k: usize| k.clamp(1, BINS) - 1;
        for y in 0..=BINS {
            for x in 0..=BINS {
                let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]]
                    .map(|[x, y]| (self.values[at(y) * BINS + at(x)], [x, y].map(middle)));
                cut(&corners, level, &mut region);
            }
        }
        region
    }
}

/// The place of the middle of a bin, counted from the ring around the square.
fn middle(k: usize) -> f64 {
    (k as f64 - 0.5) / BINS as f64
}

/// Smooths along rows and gives the columns of the result as rows.
fn smoothed(values: &[f64]) -> Vec<f64> {
    let weight = |distance: usize| (-0.5 * (distance as f64 / SMOOTH).powi(2)).exp();
    let sum: f64 = (0..=2 * REACH).map(|k| weight(k.abs_diff(REACH))).sum();
    let mut turned = vec![0.0; values.len()];
    for row in 0..BINS {
        for column in 0..BINS {
            for k in 0..=2 * REACH {
                // Where it goes, counted from as many bins before the first.
                let to = column + k;
                let mirrored = if to < REACH {
                    REACH - 1 - to
                } else if to >= BINS + REACH {
                    2 * BINS + REACH - 1 - to
                } else {
                    to - REACH
                };
                let share = weight(k.abs_diff(REACH)) / sum;
                turned[mirrored * BINS + row] += share * values[row * BINS + column];
            }
        }
    }
    turned
}

/// The part of a square that is above a level.
fn cut(corners: &[(f64, [f64; 2]); 4], level: f64, region: &mut Region) {
    let (mut piece, mut crossings) = (Vec::new(), Vec::new());
    for k in 0..4 {
        let ((value, from), (next, to)) = (corners[k], corners[(k + 1) % 4]);
        if value >= level {
            piece.push(from);
        }
        if (value >= level) != (next >= level) {
            let along = (level - value) / (next - value);
            let place = [from[0] + along * (to[0] - from[0]), from[1] + along * (to[1] - from[1])];
            piece.push(place);
            crossings.push(place);
        }
    }
    // Four crossings are a saddle, through which the region goes: its edges cut off the corners below the level.
    if crossings.len() == 4 && corners[0].0 >= level {
        region.edges.extend([[crossings[0], crossings[1]], [crossings[2], crossings[3]]]);
    } else if crossings.len() == 4 {
        region.edges.extend([[crossings[3], crossings[0]], [crossings[1], crossings[2]]]);
    } else if let [from, to] = crossings[..] {
        region.edges.push([from, to]);
    }
    if piece.len() > 2 {
        region.pieces.push(piece);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(piece: &[[f64; 2]]) -> f64 {
        let next = piece.iter().cycle().skip(1);
        0.5 * piece.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
    }

    /// A Gaussian on a grid: the regions are circles of the radii 1 σ and 2 σ, of the smoothed Gaussian.
    #[test]
    fn regions_of_a_gaussian() {
        let sigma = 0.12_f64;
        let mut points = Vec::new();
        for y in 0..260 {
            for x in 0..260 {
                let place = [x, y].map(|k| (f64::from(k) + 0.5) / 260.0);
                let squared = place.map(|p| ((p - 0.5) / sigma).powi(2)).iter().sum::<f64>();
                points.extend(std::iter::repeat_n(place, (100.0 * (-0.5 * squared).exp()).round() as usize));
            }
        }
        let density = Density::of(points.into_iter()).expect("there are points");
        assert!((density.values.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let smooth = (sigma.powi(2) + (SMOOTH / BINS as f64).powi(2)).sqrt();
        for (share, radius) in [(0.393, smooth), (0.865, 2.0 * smooth)] {
            let region = density.region(density.level(share));
            let covered: f64 = region.pieces.iter().map(|piece| area(piece)).sum();
            let expected = std::f64::consts::PI * radius * radius;
            // A level is one of a bin's: one row of bins around the circle is what it may be off.
            let slack = std::f64::consts::TAU * radius * 0.5 / BINS as f64;
            assert!((covered - expected).abs() < slack, "{share}: {covered} for {expected}");
            for place in region.edges.iter().flatten() {
                let distance = (place[0] - 0.5).hypot(place[1] - 0.5);
                assert!((distance - radius).abs() < 0.5 / BINS as f64, "{share}: {distance} for {radius}");
            }
        }
    }

    /// What is even up to an edge is so after smoothing too, and its region reaches the edge.
    #[test]
    fn edges_do_not_lose() {
        let points = (0..BINS * BINS).map(|k| [k % BINS, k / BINS].map(|k| (k as f64 + 0.5) / BINS as f64));
        let density = Density::of(points).expect("there are points");
        let even = 1.0 / (BINS * BINS) as f64;
        assert!(density.values.iter().all(|value| (value / even - 1.0).abs() < 1e-12));
        let region = density.region(0.5 * even);
        assert!(region.edges.is_empty() && region.pieces.len() == (BINS + 1) * (BINS + 1));
        assert!(Density::of([[2.0, 0.5], [f64::NAN, 0.5]].into_iter()).is_none());
    }

    /// Two opposite corners above: the region is one, with two edges that cut off the others.
    #[test]
    fn saddles_are_crossed() {
        let mut region = Region::default();
        let places = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let corners = std::array::from_fn(|k| (if k % 2 == 0 { 1.0 } else { 0.0 }, places[k]));
        cut(&corners, 0.5, &mut region);
        assert_eq!(region.pieces.len(), 1);
        assert!((area(&region.pieces[0]) - 0.75).abs() < 1e-12);
        assert_eq!(region.edges, [[[0.5, 0.0], [1.0, 0.5]], [[0.5, 1.0], [0.0, 0.5]]]);
    }
}
