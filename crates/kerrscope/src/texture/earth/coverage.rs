//! How much of each pixel of a map is land.

use rayon::prelude::*;

use super::outline::{Outlines, Ring, UNITS};

/// Lines of sight from the north in a pixel. Along each, coverage is exact.
const LINES: usize = 4;

/// Shares of land on an equirectangular map, twice as wide as high: longitude −180° at the left
/// edge, north up.
pub(super) struct Coverage {
    height: usize,
    /// 255 for land alone; column by column from the left, each from the north.
    shares: Vec<u8>,
}

impl Coverage {
    /// Land, without lakes, on a map of that many rows.
    pub(super) fn land(outlines: &Outlines, height: usize) -> Self {
        let [land, lakes] = [&outlines.land, &outlines.lakes].map(|rings| crossings(rings, height));
        let mut shares = vec![0; 2 * height * height];
        shares.par_chunks_mut(height).zip(land.par_chunks(LINES)).zip(lakes.par_chunks(LINES)).for_each(
            |((shares, land), lakes)| {
                let [land, lakes] = [land, lakes].map(|lines| inside(lines, height));
                for ((share, land), lake) in shares.iter_mut().zip(land).zip(lakes) {
                    *share = (255.0 * land * (1.0 - lake)).round() as u8;
                }
            },
        );
        Self { height, shares }
    }

    /// The inside of an outline.
    pub(super) fn of(ring: Ring, height: usize) -> Self {
        Self::land(&Outlines { land: vec![ring], lakes: Vec::new() }, height)
    }

    /// The share of a pixel from 0 to 1, `x` from the left and `y` from the top.
    pub(super) fn share(&self, x: usize, y: usize) -> f64 {
        f64::from(self.shares[x * self.height + y]) / 255.0
    }
}

/// Where outlines cross the lines of sight, in pixels from the north pole.
fn crossings(rings: &[Ring], height: usize) -> Vec<Vec<f64>> {
    let mut lines = vec![Vec::new(); 2 * height * LINES];
    let (around, half) = (lines.len().cast_signed() as i64, i64::from(180 * UNITS));
    // The first line of sight that is not west of a corner, in whole numbers: two edges that meet at a
    // corner, on either side of ±180° too, leave no line out and count none twice. Line k is at the
    // longitude (k + ½) 360° / around − 180°.
    let first = |x: i32| ((i64::from(x) + half) * around + half - 1).div_euclid(2 * half);
    for [[x0, y0], [x1, y1]] in rings.iter().flat_map(Ring::edges) {
        for k in first(x0.min(x1))..first(x0.max(x1)) {
            let x = (k as f64 + 0.5) * (2 * half) as f64 / around as f64 - half as f64;
            let y = f64::from(y0) + f64::from(y1 - y0) * (x - f64::from(x0)) / f64::from(x1 - x0);
            let line = k.rem_euclid(around) as usize;
            lines[line].push((f64::from(90 * UNITS) - y) * height as f64 / half as f64);
        }
    }
    lines
}

/// The shares of a column of pixels that lie inside, from the crossings of its lines of sight.
fn inside(lines: &[Vec<f64>], height: usize) -> Vec<f64> {
    let mut shares = vec![0.0; height];
    for line in lines {
        let mut line = line.clone();
        line.sort_by(f64::total_cmp);
        // An odd number of crossings goes around the south pole.
        line.push(height as f64);
        for pair in line.chunks_exact(2) {
            for (y, share) in (pair[0] as usize..height).zip(&mut shares[pair[0] as usize..]) {
                let (top, bottom) = (pair[0].max(y as f64), pair[1].min(y as f64 + 1.0));
                if bottom <= top {
                    break;
                }
                *share += (bottom - top) / LINES as f64;
            }
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share of the sphere that is land, by pixels and their areas.
    fn area(coverage: &Coverage) -> f64 {
        let height = coverage.height;
        let row = |y: usize| {
            let [upper, lower] = [y, y + 1].map(|y| (y as f64 * std::f64::consts::PI / height as f64).cos());
            let sum: f64 = (0..2 * height).map(|x| coverage.share(x, y)).sum();
            sum / (2 * height) as f64 * 0.5 * (upper - lower)
        };
        (0..height).map(row).sum()
    }

    #[test]
    fn land_covers_the_area_of_its_outlines() {
        let outlines = Outlines { lakes: Vec::new(), ..Outlines::built_in() };
        // All outlines enclose land, but for the Caspian Sea's within Eurasia's.
        let around: Vec<f64> =
            outlines.land.iter().filter(|ring| ring.contains(51.0, 42.0)).map(Ring::area).collect();
        assert_eq!(around.len(), 2);
        let known = outlines.land.iter().map(Ring::area).sum::<f64>() - 2.0 * around[0].min(around[1]);
        let found = area(&Coverage::land(&outlines, 1024));
        // Along lines of sight coverage is exact; islands may slip through between two of them, 0.04° apart.
        assert!((found / known - 1.0).abs() < 1e-4, "{known} {found}");
        for ring in outlines.land.into_iter().filter(|ring| ring.area() > 1e-3) {
            let (known, found) = (ring.area(), area(&Coverage::of(ring, 1024)));
            assert!((found / known - 1.0).abs() < 1e-3, "{known} {found}");
        }
    }

    #[test]
    fn land_is_where_outlines_say() {
        let outlines = Outlines::built_in();
        let coverage = Coverage::land(&outlines, 512);
        let (mut land, mut coast) = (0, 0);
        for k in 0..2000_usize {
            let (x, y) = (k * 397 % 1024, k * 211 % 512);
            let [longitude, latitude] = [x as f64 * 360.0 / 1024.0 - 179.9, 89.9 - y as f64 * 180.0 / 512.0];
            let share = coverage.share(x, y);
            if share == 0.0 || share == 1.0 {
                assert_eq!(outlines.is_land(longitude, latitude), share == 1.0, "{longitude} {latitude}");
                land += usize::from(share == 1.0);
            } else {
                coast += 1;
            }
        }
        assert!(land > 400 && coast > 40, "{land} {coast}");
    }

    #[test]
    fn lakes_are_not_land() {
        let square = |r: i32| Ring { corners: vec![[-r, -r], [r, -r], [r, r], [-r, r]] };
        let outlines = Outlines { land: vec![square(200)], lakes: vec![square(150), square(50)] };
        // A pixel is a degree: land to 2°, a lake from 1.5° to 0.5°.
        let coverage = Coverage::land(&outlines, 180);
        let row: Vec<f64> = (176..184).map(|x| coverage.share(x, 90)).collect();
        for (found, known) in row.iter().zip([0.0, 0.0, 0.5, 0.25, 0.25, 0.5, 0.0, 0.0]) {
            assert!((found - known).abs() < 0.5 / 255.0, "{row:?}");
        }
    }
}
