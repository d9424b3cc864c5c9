//! The light of a pixel at an edge, and that beside it.

use super::lit::{Levels, Region};
use crate::fit::Image;

/// Light that grows by more than this from one and a half to two and a half pixels within an edge begins gradually.
const GRADUAL: f64 = 1.3;

/// Light that falls below this there is a narrow arc, whose own level is never seen.
const NARROW: f64 = 0.6;

/// Light below this share of that on both sides.
const DIP: f64 = 0.85;

/// Light is seen across a gap that is as narrow as this, pixels.
const GAP: [f64; 2] = [2.0, 3.0];

/// Pixels within which light that begins gradually has become bright, at most.
const FARTHEST: usize = 6;

/// A pixel whose edge can be told.
#[derive(Clone, Copy, Debug)]
pub struct Sharp {
    /// Its light as a share of that on the lit side.
    pub share: f64,
    /// That light, above the sky.
    pub level: f64,
    /// The faintest light that counts as lit, as a share of it.
    pub faint: f64,
    /// Angle of the edge's normal from the nearest axis, radians, 0 to π/4.
    pub slant: f64,
}

/// What is found at a pixel.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    Sharp(Sharp),
    /// There is no telling where within so many pixels.
    Doubtful {
        reach: usize,
    },
}

/// Looks at a lit pixel beside a dark one.
pub fn look(image: &Image, levels: &Levels, region: &Region, pixel: usize) -> Place {
    let [width, height] = image.size;
    let (column, row) = ((pixel % width) as f64, (pixel / width) as f64);
    let Some([x, y]) = inwards(region, image.size, pixel) else { return Place::Doubtful { reach: 2 } };
    let last = [(width - 1) as f64, (height - 1) as f64];
    let at = |step: f64| {
        let (x, y) = ((column + step * x).clamp(0.0, last[0]), (row + step * y).clamp(0.0, last[1]));
        let (left, top) = (x.floor().min((last[0] - 1.0).max(0.0)), y.floor().min((last[1] - 1.0).max(0.0)));
        let (s, t) = (x - left, y - top);
        let value = |x: f64, y: f64| image.values[y as usize * width + x as usize] - levels.sky;
        let (right, below) = ((left + 1.0).min(last[0]), (top + 1.0).min(last[1]));
        (1.0 - t) * ((1.0 - s) * value(left, top) + s * value(right, top))
            + t * ((1.0 - s) * value(left, below) + s * value(right, below))
    };
    let own = image.values[pixel] - levels.sky;
    let (near, far) = (at(1.5), at(2.5));
    if near < levels.clear || far < levels.clear || far > GRADUAL * near {
        // What would be an edge if four times as much light were faint lies as much farther in.
        let bright = (1..FARTHEST).find(|step| at(*step as f64) > 4.0 * levels.faint).unwrap_or(FARTHEST);
        return Place::Doubtful { reach: bright + 1 };
    }
    if far < NARROW * near || GAP.iter().any(|step| at(-step) > levels.faint) || own > 1.1 * near.max(far) {
        return Place::Doubtful { reach: 2 };
    }
    // The part of the pixel that is lit lies about a quarter of a pixel farther in than its middle.
    let level = near - 1.25 * (far - near);
    let (long, short) = if x.abs() > y.abs() { (x.abs(), y.abs()) } else { (y.abs(), x.abs()) };
    Place::Sharp(Sharp { share: own / level, level, faint: levels.faint / level, slant: short.atan2(long) })
}

/// Whether a lit pixel is darker than those on both sides of it, as one with a gap is that is narrower than itself.
pub fn dips(image: &Image, levels: &Levels, pixel: usize) -> bool {
    let [width, height] = image.size;
    let (column, row) = (pixel % width, pixel / width);
    if column < 2 || row < 2 || column + 2 >= width || row + 2 >= height {
        return false;
    }
    let own = image.values[pixel] - levels.sky;
    [(2, 0), (0, 2), (2, 2), (2, -2)].iter().any(|(x, y): &(isize, isize)| {
        let at = |sign: isize| {
            let row = row.saturating_add_signed(sign * y);
            image.values[row * width + column.saturating_add_signed(sign * x)] - levels.sky
        };
        let least = at(1).min(at(-1));
        least > levels.clear && own < DIP * least
    })
}

/// The direction in which most of what is lit lies, within three pixels; none where it lies all around.
fn inwards(region: &Region, [width, height]: [usize; 2], pixel: usize) -> Option<[f64; 2]> {
    let (column, row) = (pixel % width, pixel / width);
    let mut sum = [0.0; 2];
    for y in -3..=3_i32 {
        for x in -3..=3_i32 {
            if x * x + y * y > 10 {
                continue;
            }
            // Beyond the border it goes on as it is there.
            let moved =
                |from: usize, by: i32, size: usize| from.saturating_add_signed(by as isize).min(size - 1);
            if region.lit[moved(row, y, height) * width + moved(column, x, width)] {
                sum = [sum[0] + f64::from(x), sum[1] + f64::from(y)];
            }
        }
    }
    let length = f64::hypot(sum[0], sum[1]);
    // Half of such a disk has about 24.
    (length > 8.0).then(|| [sum[0] / length, sum[1] / length])
}

/// The share of a pixel that lies on one side of a straight line, whose middle lies a distance within: `slant` is the angle of the
/// line's normal from the nearest axis.
pub fn covered(distance: f64, slant: f64) -> f64 {
    let (b, a) = slant.sin_cos();
    if b < 1e-6 {
        return (distance / a + 0.5).clamp(0.0, 1.0);
    }
    let ramp = |x: f64| 0.5 * x.max(0.0).powi(2);
    let (sum, difference) = (0.5 * (a + b), 0.5 * (a - b));
    let area = ramp(distance + sum) - ramp(distance + difference) - ramp(distance - difference)
        + ramp(distance - sum);
    (area / (a * b)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::covered;

    /// Against points on a grid.
    #[test]
    fn shares_of_half_planes() {
        const N: usize = 400;
        for slant in [0.0, 0.1, 0.5, 0.785] {
            let (sin, cos) = f64::sin_cos(slant);
            for distance in [-0.6, -0.3, 0.0, 0.2, 0.55] {
                let count = (0..N * N)
                    .filter(|k| {
                        let place = |k: usize| (k as f64 + 0.5) / N as f64 - 0.5;
                        place(k % N) * cos + place(k / N) * sin + distance > 0.0
                    })
                    .count();
                let counted = count as f64 / (N * N) as f64;
                assert!((covered(distance, slant) - counted).abs() < 3e-3, "{slant} {distance}");
            }
        }
    }
}
