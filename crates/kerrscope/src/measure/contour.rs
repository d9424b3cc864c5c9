//! Regions of a picture that are darker or lighter than a level, and the curves around them.
//!
//! The curve is that at which the values, interpolated between the centres of pixels, have the level (marching squares). Where light and
//! dark meet crosswise between four pixels, what is in the region is not joined, as its pixels are not.

#![expect(clippy::cast_possible_wrap, reason = "a picture has 16384 pixels along an edge at most")]

use super::{Curve, Picture};

/// Pixels on one side of a level that are joined by edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Region {
    /// Its first pixel, row by row from the top: the one above is not in it.
    pub first: usize,
    /// How many pixels it has.
    pub pixels: usize,
    /// Whether it reaches the picture's border.
    pub open: bool,
}

/// On which side of the level.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) enum Side {
    /// Below it, or at it.
    Dark,
    /// Above it.
    Light,
}

/// All regions on one side of a level, in the order of their first pixels.
pub(super) fn regions(picture: &Picture, level: f64, side: Side) -> Vec<Region> {
    let Picture { width, height, values, .. } = picture;
    let (width, height) = (*width, *height);
    let mut seen: Vec<bool> = values.iter().map(|value| (*value > level) == (side == Side::Dark)).collect();
    let (mut found, mut queue) = (Vec::new(), Vec::new());
    for first in 0..values.len() {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        queue.push(first);
        let mut region = Region { first, pixels: 0, open: false };
        while let Some(at) = queue.pop() {
            region.pixels += 1;
            let (column, row) = (at % width, at / width);
            region.open |= column == 0 || row == 0 || column + 1 == width || row + 1 == height;
            let mut visit = |next: usize| {
                if !seen[next] {
                    seen[next] = true;
                    queue.push(next);
                }
            };
            if column > 0 {
                visit(at - 1);
            }
            if column + 1 < width {
                visit(at + 1);
            }
            if row > 0 {
                visit(at - width);
            }
            if row + 1 < height {
                visit(at + width);
            }
        }
        found.push(region);
    }
    found
}

/// The outer curve around a region. Outside of the picture is the other side.
pub(super) fn around(picture: &Picture, level: f64, side: Side, region: &Region) -> Curve {
    let grid = Grid { picture, level, side };
    let (column, row) = ((region.first % picture.width) as isize, (region.first / picture.width) as isize);
    // The region on the left: to the left over the top of its first pixel.
    let start = Crossing { x: column, y: row - 1, upright: true };
    let mut points = vec![grid.place(start)];
    let (mut at, mut cell) = (start, [column - 1, row - 1]);
    loop {
        (at, cell) = grid.next(at, cell);
        if at == start {
            return Curve::through(points);
        }
        points.push(grid.place(at));
    }
}

/// Where the level lies between two neighbouring pixels: (x, y) and that to the right, or, `upright`, that below.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Crossing {
    x: isize,
    y: isize,
    upright: bool,
}

struct Grid<'a> {
    picture: &'a Picture,
    level: f64,
    side: Side,
}

impl Grid<'_> {
    /// How far a pixel is on the side asked for; none outside of the picture.
    fn excess(&self, x: isize, y: isize) -> Option<f64> {
        let (width, height) = (self.picture.width as isize, self.picture.height as isize);
        if !(0..width).contains(&x) || !(0..height).contains(&y) {
            return None;
        }
        let above = self.picture.values[(y * width + x) as usize] - self.level;
        Some(if self.side == Side::Light { above } else { -above })
    }

    fn is_in(&self, x: isize, y: isize) -> bool {
        self.excess(x, y).is_some_and(|excess| excess > 0.0 || (self.side == Side::Dark && excess == 0.0))
    }

    /// Right and up of the picture's middle; half way where one of the two is outside of the picture.
    fn place(&self, at: Crossing) -> [f64; 2] {
        let Crossing { x, y, upright } = at;
        let here = self.excess(x, y);
        let there = if upright { self.excess(x, y + 1) } else { self.excess(x + 1, y) };
        let part = match (here, there) {
            (Some(here), Some(there)) if here - there != 0.0 => here / (here - there),
            _ => 0.5,
        };
        let (dx, dy) = if upright { (0.0, part) } else { (part, 0.0) };
        let middle = [self.picture.width, self.picture.height].map(|n| 0.5 * n as f64);
        [x as f64 + 0.5 + dx - middle[0], middle[1] - y as f64 - 0.5 - dy]
    }

    /// From a crossing into the cell whose upper left pixel is given, with the region on the left: the crossing by which the curve leaves the
    /// cell, and the next cell.
    fn next(&self, at: Crossing, [x, y]: [isize; 2]) -> (Crossing, [isize; 2]) {
        // Its pixels and its sides, clockwise from the upper left and the upper side.
        let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
        let sides = [
            (Crossing { x, y, upright: false }, [x, y - 1]),
            (Crossing { x: x + 1, y, upright: true }, [x + 1, y]),
            (Crossing { x, y: y + 1, upright: false }, [x, y + 1]),
            (Crossing { x, y, upright: true }, [x - 1, y]),
        ];
        let inside = corners.map(|[x, y]| self.is_in(x, y));
        let from = sides.iter().position(|(crossing, _)| *crossing == at).unwrap_or(0);
        // Clockwise it enters the region at `from`, and leaves it at the next side that is crossed.
        let leaves = |k: &usize| inside[k % 4] && !inside[(k + 1) % 4];
        sides[(from + 1..from + 4).find(leaves).unwrap_or(from + 1) % 4]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(rows: &[&str]) -> Picture {
        let values = rows.concat().bytes().map(|b| f64::from(b - b'0')).collect();
        Picture::of_values(rows[0].len(), rows.len(), values).unwrap()
    }

    /// Crosswise pixels are not joined, on either side; the border is the other side.
    #[test]
    fn saddles_and_borders() {
        let cross = picture(&["000000", "090000", "004000", "000000"]);
        let all = regions(&cross, 3.9, Side::Light);
        // A diamond with the half diagonals 1 − 3.9/9.
        let half = 1.0 - 3.9 / 9.0;
        assert_eq!(all.len(), 2);
        let area = around(&cross, 3.9, Side::Light, &all[0]).polygon_area();
        assert!((area - 2.0 * half * half).abs() < 1e-12, "{area}");
        let touching = picture(&["99", "00"]);
        let all = regions(&touching, 4.5, Side::Light);
        assert!(all[0].open && all[0].pixels == 2);
        let curve = around(&touching, 4.5, Side::Light, &all[0]);
        assert!(curve.encloses([0.0, 0.5]) && !curve.encloses([0.0, -0.5]));
        let dark = regions(&touching, 4.5, Side::Dark);
        assert!(
            (dark.len(), dark[0].first) == (1, 2)
                && !around(&touching, 4.5, Side::Dark, &dark[0]).encloses([0.0, 0.4])
        );
    }

    /// Each region's curve encloses it, and its area is about the number of its pixels.
    #[test]
    fn areas() {
        let mut state = 7_u64;
        let values: Vec<f64> = (0..60 * 40)
            .map(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 40) as f64
            })
            .collect();
        let picture = Picture::of_values(60, 40, values).unwrap();
        let level = f64::from(1 << 23);
        for side in [Side::Dark, Side::Light] {
            let all = regions(&picture, level, side);
            for region in &all {
                let curve = around(&picture, level, side, region);
                let (x, y) = ((region.first % 60) as f64 - 29.5, 19.5 - (region.first / 60) as f64);
                assert!(curve.encloses([x, y]), "{region:?}");
            }
            let total: usize = all.iter().map(|r| r.pixels).sum();
            let expected = picture.values.iter().filter(|v| (**v > level) == (side == Side::Light)).count();
            assert_eq!(total, expected);
        }
    }
}
