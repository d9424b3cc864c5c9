//! Adaptive pictures: rays are traced where they are needed, and interpolated between.
//!
//! A tile is cut into squares, each into four, until over each square the rays at 9 × 9 knots are of one
//! kind (fate, number of crossings) and the interpolant through 5 × 5 of them meets the others. What is
//! interpolated are places and directions, never colours: every sample of a pixel still sees disk and sky
//! where its own ray meets them. Squares that stay rough down to the smallest are traced whole.

mod audit;
mod knot;
mod mesh;
mod patch;
mod quadtree;

pub(super) use audit::Audit;

use audit::Comparison;
use knot::{CROSSING, Kind};
use mesh::Mesh;
use patch::{Evaluate, Patch};
use quadtree::{Cell, LEAST, Quadtree, Smooth};

use super::stage::{Replay, Stage, View};
use super::tally::Tally;
use super::tile::Area;
use crate::disk::DiskHit;
use crate::light::Light;
use crate::spacetime::tensor::Vec3;

/// The longest edge of a tile in pixels.
const LONGEST: u32 = 64;
/// The most samples that a tile has, where it has more than one of the smallest squares.
const MOST_SAMPLES: u32 = 1 << 18;
/// The smallest square that is interpolated has at least so many samples: with fewer it is no dearer to
/// trace them than the knots.
const FEWEST_SAMPLES: u32 = 128;
/// Samples whose numbers are interpolated together: they stay in the cache.
const BATCH: usize = 1024;

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
    // Spacings of the mesh in so many pixels.
    let spacings = |pixels: u32| pixels * LEAST / least;
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
    let mut painter = Painter {
        stage,
        area,
        mesh: &mesh,
        spacing,
        comparison: Comparison::default(),
        work: Work::default(),
    };
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
    // These are traced, so that there is nothing to compare.
    let audited = rough().map(|pixel| stage.audit().samples(stage.number(place(pixel))).count() as u64);
    tally.interpolation.compared += audited.sum::<u64>();
    light
}

/// Fills quarters of squares with interpolated light.
struct Painter<'a> {
    stage: &'a Stage,
    area: Area,
    mesh: &'a Mesh,
    spacing: f64,
    comparison: Comparison,
    work: Work,
}

/// Memory that is used again and again.
#[derive(Default)]
struct Work {
    patches: Vec<Patch>,
    pixels: Vec<[u32; 2]>,
    x: Vec<f64>,
    y: Vec<f64>,
    values: Vec<f64>,
    views: Vec<View>,
}

impl Painter<'_> {
    fn paint(
        &mut self,
        cell: Cell,
        kind: Kind,
        pixels: impl Iterator<Item = [u32; 2]> + Clone,
        light: &mut [Light],
        tally: &mut Tally,
    ) {
        let stage = self.stage;
        let samples = stage.samples() as usize;
        let patch = |number| self.mesh.patch(cell.corner, cell.edge / 4, number);
        // What of it is seen at all?
        self.work.patches.clear();
        let mut sheets = 0;
        for first in (0..kind.crossings()).map(|k| CROSSING * k) {
            let inverse_radius = patch(first);
            if stage.meets_disk(inverse_radius.range) {
                sheets += 1;
                self.work.patches.push(inverse_radius);
                self.work.patches.extend((1..CROSSING).map(|k| patch(first + k)));
            }
        }
        let escapes = kind.direction().is_some();
        let directed = kind.direction().filter(|_| stage.sky_varies());
        if let Some(first) = directed {
            self.work.patches.extend((0..3).map(|k| patch(first + k)));
        }
        let constant = self.work.patches.is_empty().then(|| {
            let direction = escapes.then_some([0.0; 2]);
            stage.mean(&[stage.seen(std::iter::empty(), direction)])
        });
        let corner = cell.corner.map(|c| f64::from(c) * self.spacing);
        let scale = 2.0 / (f64::from(cell.edge) * self.spacing);
        let place = |[x, y]: [f64; 2]| {
            [
                (x - f64::from(self.area.left) - corner[0]) * scale - 1.0,
                (y - f64::from(self.area.top) - corner[1]) * scale - 1.0,
            ]
        };
        for pixel in pixels.clone() {
            tally.interpolation.samples += samples as u64;
            let on_picture = [self.area.left + pixel[0], self.area.top + pixel[1]];
            for sample in stage.audit().samples(stage.number(on_picture)) {
                let point = stage.sample(on_picture, sample);
                let [x, y] = place(point);
                let numbers: Vec<f64> = (0..kind.numbers()).map(|number| patch(number).at(x, y)).collect();
                self.comparison.push(point, kind, &numbers);
            }
            if let Some(constant) = constant {
                light[(pixel[1] * self.area.width + pixel[0]) as usize] = constant;
            }
        }
        if constant.is_some() {
            return;
        }
        self.work.pixels.clear();
        self.work.pixels.extend(pixels);
        let Work { patches, pixels, x, y, values, views } = &mut self.work;
        for some in pixels.chunks((BATCH / samples).max(1)) {
            x.clear();
            y.clear();
            for pixel in some {
                let on_picture = [self.area.left + pixel[0], self.area.top + pixel[1]];
                for sample in 0..stage.samples() {
                    let [right, down] = place(stage.sample(on_picture, sample));
                    x.push(right);
                    y.push(down);
                }
            }
            Evaluate { patches, x, y, values }.at_level(stage.level());
            let count = x.len();
            let vector = |first: usize, sample: usize| -> Vec3<f64> {
                std::array::from_fn(|k| values[(first + k) * count + sample])
            };
            views.clear();
            for sample in 0..count {
                let hits = (0..sheets).map(|sheet| DiskHit {
                    radius: values[CROSSING * sheet * count + sample].recip(),
                    position: vector(CROSSING * sheet + 1, sample),
                });
                let direction = if directed.is_some() {
                    let [x, y, z] = vector(CROSSING * sheets, sample);
                    Some([x.hypot(y).atan2(z), y.atan2(x)])
                } else {
                    escapes.then_some([0.0; 2])
                };
                views.push(stage.seen(hits, direction));
            }
            for (pixel, views) in some.iter().zip(views.chunks(samples)) {
                light[(pixel[1] * self.area.width + pixel[0]) as usize] = stage.mean(views);
            }
        }
    }
}
