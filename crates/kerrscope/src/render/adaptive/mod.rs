//! Adaptive pictures: rays are traced where they are needed, and interpolated between.
//!
//! A tile is cut into squares, each into four, until over each square the rays at 9 × 9 knots are of one
//! kind (fate, number of crossings) and the interpolant through 5 × 5 of them meets the others. What is
//! interpolated are places and directions, never colours: every sample of a pixel still sees disk and sky
//! where its own ray meets them. Squares that stay rough down to the smallest are traced whole.

mod audit;
mod knot;
mod mesh;
mod painter;
mod patch;
mod quadtree;

pub(super) use audit::Audit;

use mesh::Mesh;
use painter::Painter;
use quadtree::{Cell, LEAST, Quadtree, Smooth};

use super::stage::{Replay, Stage};
use super::tally::Tally;
use super::tile::Area;
use crate::light::Light;

/// The longest edge of a tile in pixels.
const LONGEST: u32 = 64;
/// The most samples that a tile has, where it has more than one of the smallest squares.
const MOST_SAMPLES: u32 = 1 << 18;
/// The smallest square that is interpolated has at least so many samples: with fewer it is no dearer to
/// trace them than the knots.
const FEWEST_SAMPLES: u32 = 128;

/// Edge in pixels of the smallest square for pixels with so many samples. Quarters of it are whole pixels.
fn least_edge(samples: u32) -> u32 {
    let mut edge: u32 = 2;
    while edge < LONGEST && edge * edge * samples.min(FEWEST_SAMPLES) < FEWEST_SAMPLES {
        edge *= 2;
    }
    edge
}

/// Edge in pixels of the tiles of a picture with so many samples in a pixel.
pub(super) fn tile_edge(samples: u32) -> u32 {
    let mut edge = LONGEST;
    while edge > least_edge(samples) && u64::from(edge).pow(2) * u64::from(samples) > u64::from(MOST_SAMPLES)
    {
        edge /= 2;
    }
    edge
}

/// The light of each pixel of a tile, along the rows. `target` is the error that interpolation shall not
/// exceed.
pub(super) fn draw(
    stage: &Stage,
    target: f64,
    area: Area,
    replay: &mut Replay,
    tally: &mut Tally,
) -> Vec<Light> {
    let (least, edge) = (least_edge(stage.samples()), tile_edge(stage.samples()));
    let spacing = f64::from(least) / f64::from(LEAST);
    // Spacings of the mesh that cover so many pixels.
    let spacings = |pixels: u32| (pixels * LEAST).div_ceil(least);
    let root = Cell { corner: [0, 0], edge: spacings(edge) };
    let mut mesh = Mesh::new([area.left, area.top], spacing, root.edge + 1);
    let limits = [area.width, area.height].map(spacings);
    let tree = Quadtree::grow(&mut mesh, root, limits, target, stage, replay, tally);

    let pixels = |cell: Cell| {
        let [left, top] = cell.corner.map(|c| c * least / LEAST);
        let edge = cell.edge * least / LEAST;
        let columns = left..(left + edge).min(area.width);
        (top..(top + edge).min(area.height)).flat_map(move |y| columns.clone().map(move |x| [x, y]))
    };
    let mut light = vec![Light::DARK; (area.width * area.height) as usize];
    let mut painter = Painter::new(stage, area, &mesh, spacing);
    for Smooth { cell, kind } in &tree.smooth {
        for quarter in cell.quarters() {
            painter.paint(quarter, *kind, pixels(quarter), &mut light, tally);
        }
    }
    painter.comparison.judge(stage, replay, tally);

    let rough = || tree.rough.iter().flat_map(|cell| pixels(*cell));
    let place = |[x, y]: [u32; 2]| [area.left + x, area.top + y];
    let mut lit = rough();
    stage.pixels(rough().map(place), replay, tally, |seen| {
        if let Some([x, y]) = lit.next() {
            light[(y * area.width + x) as usize] = seen;
        }
    });
    light
}
