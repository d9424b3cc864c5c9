//! Pixels whose rays are interpolated.

use fearless_simd::Simd;

use super::audit::Comparison;
use super::knot::{CROSSING, Kind};
use super::mesh::Mesh;
use super::patch::{Patch, put, take};
use super::quadtree::Cell;
use crate::disk::DiskHit;
use crate::light::Light;
use crate::render::stage::{Origin, Stage, View};
use crate::render::tally::Tally;
use crate::render::tile::Area;
use crate::spacetime::{OnLanes, Scalar};

/// Samples whose numbers are interpolated together: they stay in the cache.
const BATCH: usize = 1024;

/// Fills quarters of squares with interpolated light.
pub(super) struct Painter<'a> {
    stage: &'a Stage,
    area: Area,
    mesh: &'a Mesh,
    /// Pixels between neighbours of the mesh.
    spacing: f64,
    /// Samples that are to be traced too.
    pub(super) comparison: Comparison,
    pixels: Vec<[u32; 2]>,
    x: Vec<f64>,
    y: Vec<f64>,
    views: Vec<View>,
    sights: Sights,
}

/// What samples see, interpolated.
#[derive(Default)]
struct Sights {
    /// 1/r, cosine and sine of the azimuth of each sheet; then, if `directed`, the direction.
    patches: Vec<Patch>,
    sheets: usize,
    directed: bool,
    /// Radii of the samples on the first sheet, their azimuths, those on the next sheet …; then x, y and z of
    /// their directions.
    numbers: Vec<f64>,
}

impl<'a> Painter<'a> {
    pub(super) fn new(stage: &'a Stage, area: Area, mesh: &'a Mesh, spacing: f64) -> Self {
        Self {
            stage,
            area,
            mesh,
            spacing,
            comparison: Comparison::default(),
            pixels: Vec::new(),
            x: Vec::new(),
            y: Vec::new(),
            views: Vec::new(),
            sights: Sights::default(),
        }
    }

    /// Fills the pixels of a quarter, all of whose rays are of a kind.
    pub(super) fn paint(
        &mut self,
        cell: Cell,
        kind: Kind,
        pixels: impl Iterator<Item = [u32; 2]>,
        light: &mut [Light],
        tally: &mut Tally,
    ) {
        let (stage, area) = (self.stage, self.area);
        let samples = stage.samples();
        let on_picture = |[x, y]: [u32; 2]| [area.left + x, area.top + y];
        let in_light = |[x, y]: [u32; 2]| (y * area.width + x) as usize;
        self.pixels.clear();
        self.pixels.extend(pixels);
        tally.interpolation.samples += self.pixels.len() as u64 * u64::from(samples);
        self.pick(cell, kind);

        let escapes = kind.direction().is_some();
        let other_side = kind.is_other_side();
        let from = |direction| Origin { direction, other_side };
        let anywhere = escapes.then(|| from([0.0, 0.0, 1.0]));
        self.look(cell, kind);
        if self.sights.patches.is_empty() {
            let same = stage.mean(&[stage.seen(std::iter::empty(), anywhere)]);
            for pixel in &self.pixels {
                light[in_light(*pixel)] = same;
            }
            return;
        }
        let frame = Frame::new(area, cell, self.spacing);
        let Self { pixels, x, y, views, sights, .. } = self;
        for some in pixels.chunks((BATCH / samples as usize).max(1)) {
            x.clear();
            y.clear();
            for pixel in some {
                for sample in 0..samples {
                    let [right, down] = frame.place(stage.sample(on_picture(*pixel), sample));
                    x.push(right);
                    y.push(down);
                }
            }
            stage.level().run(See { sights, x, y });
            views.clear();
            for sample in 0..x.len() {
                let number = |row: usize| sights.numbers[row * x.len() + sample];
                let hits = (0..sights.sheets).map(|sheet| DiskHit {
                    radius: number(2 * sheet),
                    azimuth: number(2 * sheet + 1),
                    // Disks that ask for more are not interpolated.
                    order: 0,
                    light: None,
                    elapsed: f64::NAN,
                });
                let first = 2 * sights.sheets;
                let direction =
                    sights.directed.then(|| [number(first), number(first + 1), number(first + 2)]);
                views.push(stage.seen(hits, direction.map(from).or(anywhere)));
            }
            for (pixel, views) in some.iter().zip(views.chunks(samples as usize)) {
                light[in_light(*pixel)] = stage.mean(views);
            }
        }
    }

    /// Interpolates the samples by which the picture is judged.
    fn pick(&mut self, cell: Cell, kind: Kind) {
        let (stage, frame) = (self.stage, Frame::new(self.area, cell, self.spacing));
        for pixel in &self.pixels {
            let on_picture = [self.area.left + pixel[0], self.area.top + pixel[1]];
            for sample in stage.audit().samples(stage.number(on_picture)) {
                let point = stage.sample(on_picture, sample);
                let [x, y] = frame.place(point);
                let patch = |number| self.mesh.patch(cell.corner, cell.edge / 4, number);
                let numbers: Vec<f64> = (0..kind.numbers()).map(|number| patch(number).at(x, y)).collect();
                self.comparison.push(point, kind, &numbers);
            }
        }
    }

    /// Finds what of the disk and the sky is seen in a quarter, and how to interpolate it.
    fn look(&mut self, cell: Cell, kind: Kind) {
        let patch = |number| self.mesh.patch(cell.corner, cell.edge / 4, number);
        let sights = &mut self.sights;
        sights.patches.clear();
        sights.sheets = 0;
        for first in (0..kind.crossings()).map(|k| CROSSING * k) {
            let inverse_radius = patch(first);
            if self.stage.meets_disk(inverse_radius.range) {
                sights.sheets += 1;
                sights.patches.extend([inverse_radius, patch(first + 1), patch(first + 2)]);
            }
        }
        let direction = kind.direction().filter(|_| self.stage.sky_varies());
        sights.directed = direction.is_some();
        if let Some(first) = direction {
            sights.patches.extend((0..3).map(|k| patch(first + k)));
        }
    }
}

/// From points of the picture to −1 … 1 across a cell.
#[derive(Clone, Copy)]
struct Frame {
    middle: [f64; 2],
    scale: f64,
}

impl Frame {
    fn new(area: Area, cell: Cell, spacing: f64) -> Self {
        let half = 0.5 * f64::from(cell.edge) * spacing;
        let middle = |corner: u32, steps: u32| f64::from(corner) + f64::from(steps) * spacing + half;
        Self {
            middle: [middle(area.left, cell.corner[0]), middle(area.top, cell.corner[1])],
            scale: 1.0 / half,
        }
    }

    fn place(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.middle[0]) * self.scale, (y - self.middle[1]) * self.scale]
    }
}

/// Fills in the numbers of sights at points.
struct See<'a> {
    sights: &'a mut Sights,
    x: &'a [f64],
    y: &'a [f64],
}

impl OnLanes for See<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Simd>(self, simd: L) {
        let Self { sights: Sights { patches, sheets, directed, numbers }, x, y } = self;
        let count = x.len();
        numbers.clear();
        numbers.resize((2 * *sheets + if *directed { 3 } else { 0 }) * count, 0.0);
        for first in (0..count).step_by(8) {
            let (px, py) = (take(simd, x, first), take(simd, y, first));
            let mut rows = numbers.chunks_exact_mut(count);
            for sheet in patches[..3 * *sheets].chunks_exact(3) {
                let [inverse_radius, cos, sin] =
                    [sheet[0].at(px, py), sheet[1].at(px, py), sheet[2].at(px, py)];
                for row in [inverse_radius.recip(), sin.atan2(cos)] {
                    if let Some(numbers) = rows.next() {
                        put(row, numbers, first);
                    }
                }
            }
            if let [nx, ny, nz] = &patches[3 * *sheets..] {
                let n = [nx.at(px, py), ny.at(px, py), nz.at(px, py)];
                let inverse = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt().recip();
                for k in 0..3 {
                    if let Some(numbers) = rows.next() {
                        put(n[k] * inverse, numbers, first);
                    }
                }
            }
        }
    }
}
