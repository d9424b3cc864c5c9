//! Polygons and curves onto pixels, by exact areas and lengths.

/// Channels of a picture: brightness, and what it changes by with each parameter.
pub const CHANNELS: usize = 12;

/// Parameters with which the brightness of matter changes: spin, inclination, 1/r, index.
pub const GLOWS: usize = 4;

/// Parameters with which places move: those of the screen.
pub const MOVERS: usize = 7;

/// Numbers of a corner: brightness, what it changes by for the matter that is there, and by how much that moves.
const NUMBERS: usize = 1 + GLOWS + 2 * MOVERS + 1;

/// A corner of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Pixels from the top left corner, to the right and down.
    pub place: [f64; 2],
    /// What the brightness changes by per pixel to the right and down.
    slope: [f64; 2],
    numbers: [f64; NUMBERS],
}

impl Corner {
    /// A corner with its brightness alone.
    pub fn lit(place: [f64; 2], light: f64) -> Self {
        let mut numbers = [0.0; NUMBERS];
        numbers[0] = light;
        Self { place, slope: [0.0; 2], numbers }
    }

    /// A corner whose matter has a brightness that changes by `glow` while it moves by `moves` pixels, and by `slope` from pixel to
    /// pixel.
    pub fn new(
        place: [f64; 2],
        (light, slope): (f64, [f64; 2]),
        glow: [f64; GLOWS],
        moves: [[f64; 2]; MOVERS],
    ) -> Self {
        let mut numbers = [0.0; NUMBERS];
        numbers[0] = light;
        numbers[1..=GLOWS].copy_from_slice(&glow);
        for (pair, moved) in numbers[1 + GLOWS..].chunks_exact_mut(2).zip(moves) {
            pair.copy_from_slice(&moved);
        }
        Self { place, slope, numbers }
    }

    /// Some of four.
    pub fn mixed(four: [&Self; 4], shares: [f64; 4]) -> Self {
        let mut corner = Self { place: [0.0; 2], slope: [0.0; 2], numbers: [0.0; NUMBERS] };
        for (one, share) in four.into_iter().zip(shares) {
            for (number, own) in corner.numbers.iter_mut().zip(one.numbers) {
                *number += share * own;
            }
            for k in 0..2 {
                corner.place[k] += share * one.place[k];
                corner.slope[k] += share * one.slope[k];
            }
        }
        corner
    }

    /// Its brightness.
    pub fn light(&self) -> f64 {
        self.numbers[0]
    }
}

/// Channels of the parameters in [`GLOWS`], and of those in [`MOVERS`].
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Of the changes of the matter's brightness.
    pub glows: [usize; GLOWS],
    /// Of the moves.
    pub movers: [usize; MOVERS],
}

/// What a picture collects.
#[derive(Clone, Debug)]
pub struct Canvas {
    width: usize,
    height: usize,
    /// Where derivatives are put, if they are drawn.
    layout: Option<Layout>,
    pixels: Vec<[f64; CHANNELS]>,
}

/// Corners of a polygon, at most.
const CORNERS: usize = 12;

/// A polygon of few corners.
#[derive(Clone, Copy)]
struct Polygon {
    corners: [[f64; 2]; CORNERS],
    count: usize,
}

impl Polygon {
    /// The part on one side of a line across an axis: where the coordinate is above `bound`, or below.
    fn clipped(&self, axis: usize, bound: f64, above: bool) -> Self {
        let mut part = Self { corners: [[0.0; 2]; CORNERS], count: 0 };
        if self.count == 0 {
            return part;
        }
        let depth = |p: &[f64; 2]| if above { p[axis] - bound } else { bound - p[axis] };
        let mut before = self.corners[self.count - 1];
        let mut before_depth = depth(&before);
        for corner in &self.corners[..self.count] {
            let here = depth(corner);
            if (here > 0.0) != (before_depth > 0.0) && part.count < CORNERS {
                let share = before_depth / (before_depth - here);
                let mut cut = [0.0; 2];
                for k in 0..2 {
                    cut[k] = before[k] + share * (corner[k] - before[k]);
                }
                cut[axis] = bound;
                part.corners[part.count] = cut;
                part.count += 1;
            }
            if here > 0.0 && part.count < CORNERS {
                part.corners[part.count] = *corner;
                part.count += 1;
            }
            (before, before_depth) = (*corner, here);
        }
        part
    }

    /// Area, positive whichever way it goes around, and the first moments about a point.
    fn moments(&self, about: [f64; 2]) -> [f64; 3] {
        let (mut area, mut first) = (0.0, [0.0; 2]);
        if self.count < 3 {
            return [0.0; 3];
        }
        let at = |k: usize| [self.corners[k][0] - about[0], self.corners[k][1] - about[1]];
        let mut before = at(self.count - 1);
        for k in 0..self.count {
            let here = at(k);
            let cross = before[0] * here[1] - here[0] * before[1];
            area += cross;
            first[0] += (before[0] + here[0]) * cross;
            first[1] += (before[1] + here[1]) * cross;
            before = here;
        }
        let sign = if area < 0.0 { -1.0 } else { 1.0 };
        [0.5 * area * sign, first[0] * sign / 6.0, first[1] * sign / 6.0]
    }
}

impl Canvas {
    /// A dark one.
    pub fn new(width: usize, height: usize, layout: Option<Layout>) -> Self {
        Self { width, height, layout, pixels: vec![[0.0; CHANNELS]; width * height] }
    }

    /// The channels of each pixel, the top row first.
    pub fn pixels(&self) -> &[[f64; CHANNELS]] {
        &self.pixels
    }

    /// Whether what lies between two places may be in the picture.
    pub fn sees(&self, [from, to]: [[f64; 2]; 2]) -> bool {
        let size = [self.width as f64, self.height as f64];
        (0..2).all(|k| from[k].max(to[k]) > 0.0 && from[k].min(to[k]) < size[k])
    }

    /// Draws a cell of four corners, between which its numbers are linear: the mean over each pixel of what lies in it. Its second and
    /// its fourth side may be bent, by way of further places.
    pub fn cell(
        &mut self,
        corners: [&Corner; 4],
        second: impl Iterator<Item = [f64; 2]>,
        fourth: impl Iterator<Item = [f64; 2]>,
    ) {
        let [a, b, c, d] = corners.map(|corner| corner.place);
        let mut polygon = Polygon { corners: [[0.0; 2]; CORNERS], count: 0 };
        for place in [a, b].into_iter().chain(second).chain([c, d]).chain(fourth) {
            polygon.corners[polygon.count] = place;
            polygon.count += 1;
        }
        let bounds = |axis: usize| {
            let values = polygon.corners[..polygon.count].iter().map(|place| place[axis]);
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let ((left, right), (top, bottom)) = (bounds(0), bounds(1));
        let (width, height) = (self.width as f64, self.height as f64);
        if !(right > 0.0 && left < width && bottom > 0.0 && top < height) {
            return;
        }
        let plane = Plane::through(&corners, &polygon);
        let columns = [left.max(0.0).floor(), right.min(width).ceil()];
        let rows = [top.max(0.0).floor(), bottom.min(height).ceil()];
        let inside = left >= 0.0 && right <= width && top >= 0.0 && bottom <= height;
        if inside && columns[1] - columns[0] <= 1.0 && rows[1] - rows[0] <= 1.0 {
            self.add(rows[0] as usize * self.width + columns[0] as usize, &polygon, &plane, &corners);
            return;
        }
        let mut column = columns[0];
        while column < columns[1] {
            let strip = polygon.clipped(0, column, true).clipped(0, column + 1.0, false);
            let mut row = rows[0];
            while row < rows[1] && strip.count > 2 {
                let piece = strip.clipped(1, row, true).clipped(1, row + 1.0, false);
                if piece.count > 2 {
                    self.add(row as usize * self.width + column as usize, &piece, &plane, &corners);
                }
                row += 1.0;
            }
            column += 1.0;
        }
    }

    fn add(&mut self, pixel: usize, piece: &Polygon, plane: &Plane, corners: &[&Corner; 4]) {
        let [area, x, y] = piece.moments(plane.middle);
        let shares = plane.shares(area, [x, y]);
        let pixel = &mut self.pixels[pixel];
        let Some(layout) = &self.layout else {
            for (share, corner) in shares.iter().zip(corners) {
                pixel[0] += share * corner.numbers[0];
            }
            return;
        };
        let mut sums = [0.0; NUMBERS];
        for (share, corner) in shares.iter().zip(corners) {
            for (sum, number) in sums.iter_mut().zip(&corner.numbers) {
                *sum += share * number;
            }
        }
        let [along, across] = plane.slope_at(area, [x, y]);
        pixel[0] += sums[0];
        // At a fixed place: what the matter's brightness changes by, less what comes by with its motion.
        for (channel, sum) in layout.glows.iter().zip(&sums[1..]) {
            pixel[*channel] += sum;
        }
        for (channel, moved) in layout.movers.iter().zip(sums[1 + GLOWS..].chunks_exact(2)) {
            pixel[*channel] -= along * moved[0] + across * moved[1];
        }
    }

    /// Draws a stretch of an edge, straight between two places: at each end the brightness on its side, and the area in pixels² that
    /// it sweeps over per change of each channel's parameter, as if all of it moved as that end.
    pub fn edge(&mut self, ends: [([f64; 2], f64, [f64; CHANNELS]); 2]) {
        let [(from, from_light, from_sweep), (to, to_light, to_sweep)] = ends;
        let mut cuts = [0.0; 64];
        let mut count = 1;
        for axis in 0..2 {
            let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
            let mut line = low.floor() + 1.0;
            while line < high && count < 62 {
                cuts[count] = (line - from[axis]) / (to[axis] - from[axis]);
                count += 1;
                line += 1.0;
            }
        }
        cuts[count] = 1.0;
        cuts[1..count].sort_unstable_by(f64::total_cmp);
        for pair in cuts[..=count].windows(2) {
            let middle = 0.5 * (pair[0] + pair[1]);
            let [x, y] = [0, 1].map(|k| from[k] + middle * (to[k] - from[k]));
            if !(x >= 0.0 && y >= 0.0 && x < self.width as f64 && y < self.height as f64) {
                continue;
            }
            let pixel = &mut self.pixels[y as usize * self.width + x as usize];
            // A product of two linear functions: Simpson's rule is exact.
            for (s, weight) in [(pair[0], 1.0), (middle, 4.0), (pair[1], 1.0)] {
                let light = (from_light + s * (to_light - from_light)) * weight * (pair[1] - pair[0]) / 6.0;
                for channel in 1..CHANNELS {
                    pixel[channel] +=
                        light * (from_sweep[channel] + s * (to_sweep[channel] - from_sweep[channel]));
                }
            }
        }
    }
}

/// Linear functions that come closest to values at four corners.
struct Plane {
    middle: [f64; 2],
    /// How much of each corner's value makes the slopes.
    slopes: [[f64; 2]; 4],
    /// The slope of the brightness: such that what it rises by across the cell is the difference of its corners.
    slope: [f64; 2],
    /// What that slope changes by per pixel, and where it is the mean.
    bend: [[f64; 2]; 2],
    center: [f64; 2],
}

impl Plane {
    fn through(corners: &[&Corner; 4], cell: &Polygon) -> Self {
        let mut middle = [0.0; 2];
        for corner in corners {
            middle = [middle[0] + 0.25 * corner.place[0], middle[1] + 0.25 * corner.place[1]];
        }
        let from: [[f64; 2]; 4] =
            std::array::from_fn(|k| [corners[k].place[0] - middle[0], corners[k].place[1] - middle[1]]);
        let [mut xx, mut xy, mut yy] = [0.0; 3];
        for [x, y] in from {
            (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
        }
        let determinant = xx * yy - xy * xy;
        // A cell without width has no slope across: nothing is in it.
        let per = if determinant > 1e-12 * xx * yy { determinant.recip() } else { 0.0 };
        let slopes = from.map(|[x, y]| [(yy * x - xy * y) * per, (xx * y - xy * x) * per]);
        let (mut slope, mut bend) = ([0.0; 2], [[0.0; 2]; 2]);
        for (share, corner) in slopes.iter().zip(corners) {
            for k in 0..2 {
                slope[k] += share[k] * corner.numbers[0];
                for (bend, slope) in bend.iter_mut().zip(corner.slope) {
                    bend[k] += share[k] * slope;
                }
            }
        }
        let [area, x, y] = cell.moments(middle);
        let center = if area > 0.0 { [x / area, y / area] } else { [0.0; 2] };
        Self { middle, slopes, slope, bend, center }
    }

    /// The mean slope of the brightness in a piece, from its area and its first moments.
    fn slope_at(&self, area: f64, [x, y]: [f64; 2]) -> [f64; 2] {
        if area <= 0.0 {
            return self.slope;
        }
        let [x, y] = [x / area - self.center[0], y / area - self.center[1]];
        [0, 1].map(|k| self.slope[k] + self.bend[k][0] * x + self.bend[k][1] * y)
    }

    /// What of each corner's value makes the integral over a piece.
    fn shares(&self, area: f64, [x, y]: [f64; 2]) -> [f64; 4] {
        self.slopes.map(|[along, across]| 0.25 * area + along * x + across * y)
    }
}
