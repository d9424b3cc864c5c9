//! Lines over a picture: where something about its rays changes, found with the rays themselves.
//!
//! Rays are followed at the corners of a grid. Between two that differ the place is halved until it is known to a small
//! part of a cell, or found by proportion where a number changes smoothly; marching squares join the places. So every
//! spacetime, screen and camera has its lines, and none is assumed to be anywhere.

use kerrscope::camera::Camera;
use kerrscope::render::tracer;
use kerrscope::scene::Scene;
use kerrscope::spacetime::Level;
use kerrscope::spacetime::emitter::{Circular, Sense};
use kerrscope::spacetime::geodesic::{Fate, Path, Query, Ray, Side, Tracer};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// What lines there are.
#[derive(Clone, Copy, Debug, Deserialize, Eq, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The edge of the shadow.
    Critical,
    /// Between numbers of crossings of the equatorial plane.
    Orders,
    /// Radii and azimuths in the equatorial plane, as it is first seen.
    Equator,
    /// Equal shifts of matter on circular orbits there.
    Shift,
}

/// Lines of a kind: the ends [x, y, x, y] of pieces, as shares of the picture's width and height.
#[derive(Debug, PartialEq, Serialize)]
pub struct Lines {
    kind: Kind,
    pieces: Vec<[f32; 4]>,
}

/// Cells along the longer edge.
const CELLS: f64 = 96.0;

/// Cells with rough edges are split into so many by so many, so often, if there are not more of them.
const FINER: usize = 4;
const LEVELS: usize = 2;
const MOST_SPLIT: usize = 4000;

/// Along an edge of a cell, 1/r and shifts that change by more are rough, and azimuths, radians.
const ROUGH: f64 = 0.05;
const TURNED: f64 = 0.2;

/// How often a place is halved.
const HALVINGS: usize = 6;

/// Rays followed together.
const BATCH: usize = 512;

/// Radii of circles, M, and how far from the hole the plane is looked at.
const CIRCLES: [f64; 8] = [2.0, 3.0, 4.0, 6.0, 10.0, 15.0, 20.0, 30.0];
const FAR: f64 = 40.0;

/// What a ray says. Numbers are those of its first crossing, NaN without one.
#[derive(Clone, Copy, Debug)]
struct Seen {
    captured: bool,
    crossings: usize,
    inverse_radius: f64,
    azimuth: f64,
    shift: f64,
}

const NOTHING: Seen =
    Seen { captured: false, crossings: 0, inverse_radius: f64::NAN, azimuth: f64::NAN, shift: f64::NAN };

impl Seen {
    /// Whether lines between the two may be lost or bent.
    fn differs(&self, other: &Self) -> bool {
        // A difference of what is not a number is none: one of both without a number differs by its crossings.
        let far = |a: f64, b: f64, most: f64| (a - b).abs() > most;
        let turned =
            (self.azimuth - other.azimuth).sin().abs().max(1.0 - (self.azimuth - other.azimuth).cos());
        self.captured != other.captured
            || self.crossings != other.crossings
            || self.inverse_radius.is_nan() != other.inverse_radius.is_nan()
            || far(self.inverse_radius, other.inverse_radius, ROUGH)
            || far(self.shift, other.shift, ROUGH)
            || turned > TURNED
    }
}

/// What looks along rays of a scene.
struct Look {
    camera: Camera,
    tracer: Box<dyn Tracer>,
    spin: Option<f64>,
    matter: Option<Circular>,
}

impl Look {
    fn along(&self, points: &[[f64; 2]]) -> Vec<Seen> {
        let query = Query { max_crossings: 4, ..Query::default() };
        let chunks = points.par_chunks(BATCH).map(|points| {
            let rays: Vec<Option<Ray>> = points.iter().map(|&[x, y]| self.camera.ray(x, y).ok()).collect();
            let real: Vec<Ray> = rays.iter().copied().flatten().collect();
            let mut paths = vec![Path::default(); real.len()];
            self.tracer.trace_all(&real, &query, &mut paths);
            let mut followed = real.iter().zip(&paths);
            let mut seen = Vec::with_capacity(rays.len());
            for ray in &rays {
                let found = if ray.is_some() { followed.next() } else { None };
                seen.push(found.map_or(NOTHING, |(ray, path)| self.seen(ray, path)));
            }
            seen
        });
        chunks.collect::<Vec<Vec<Seen>>>().concat()
    }

    fn seen(&self, ray: &Ray, path: &Path) -> Seen {
        let captured = path.fate == Fate::Captured;
        let crossings = path.crossings.len();
        let Some(first) = path.crossings.first().filter(|first| first.r < FAR) else {
            return Seen { captured, crossings, ..NOTHING };
        };
        let energy = match ray.side {
            Side::Reversed => ray.energy,
            Side::Ingoing => -ray.energy,
        };
        let lambda = ray.conserved(self.spin.unwrap_or(0.0)).lambda;
        let shift = self.matter.as_ref().and_then(|m| m.orbit(first.r)?.redshift_factor(lambda, energy));
        Seen {
            captured,
            crossings,
            inverse_radius: first.r.recip(),
            azimuth: first.position[1].atan2(first.position[0]),
            shift: shift.unwrap_or(f64::NAN),
        }
    }
}

/// Cells over a picture: those of a grid, and smaller ones where rays next to each other differ much.
struct Mesh {
    places: Vec<[f64; 2]>,
    seen: Vec<Seen>,
    /// The corners of each cell, around it.
    cells: Vec<[usize; 4]>,
}

impl Mesh {
    fn new(look: &Look, size: [f64; 2]) -> Self {
        let cell = size[0].max(size[1]) / CELLS;
        let counts = size.map(|edge| (edge / cell).ceil().max(1.0) as usize);
        let mut mesh = Self { places: Vec::new(), seen: Vec::new(), cells: Vec::new() };
        mesh.grid([[0.0; 2], size], counts);
        mesh.seen = look.along(&mesh.places);
        for _ in 0..LEVELS {
            mesh.refine(look);
        }
        mesh
    }

    /// Adds the cells of a grid between two opposite corners.
    fn grid(&mut self, [from, to]: [[f64; 2]; 2], [columns, rows]: [usize; 2]) {
        let first = self.places.len();
        for corner in 0..(columns + 1) * (rows + 1) {
            let shares = [
                (corner % (columns + 1)) as f64 / columns as f64,
                (corner / (columns + 1)) as f64 / rows as f64,
            ];
            self.places.push([0, 1].map(|k| from[k] + shares[k] * (to[k] - from[k])));
        }
        for cell in 0..columns * rows {
            let corner = first + cell / columns * (columns + 1) + cell % columns;
            self.cells.push([corner, corner + 1, corner + columns + 2, corner + columns + 1]);
        }
    }

    /// Splits cells whose corners differ by more than lines can be drawn through.
    fn refine(&mut self, look: &Look) {
        let (rough, smooth): (Vec<_>, Vec<_>) = self
            .cells
            .iter()
            .partition(|cell| (0..4).any(|k| self.seen[cell[k]].differs(&self.seen[cell[(k + 1) % 4]])));
        if rough.len() > MOST_SPLIT {
            return;
        }
        self.cells = smooth;
        let known = self.places.len();
        for [from, _, to, _] in rough {
            self.grid([self.places[from], self.places[to]], [FINER; 2]);
        }
        self.seen.extend(look.along(&self.places[known..]));
    }

    /// Pieces through cells, between places on those of their edges for which there is one, as shares of the picture.
    fn join(&self, on_edge: impl Fn(usize, usize) -> Option<[f64; 2]>) -> Vec<[f32; 4]> {
        let size = self
            .cells
            .iter()
            .fold([0.0_f64; 2], |most, cell| [0, 1].map(|k| most[k].max(self.places[cell[2]][k])));
        let mut pieces = Vec::new();
        for corners in &self.cells {
            let places: Vec<[f64; 2]> = (0..4)
                .filter_map(|k| {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    on_edge(a.min(b), a.max(b))
                })
                .collect();
            for pair in places.chunks_exact(2) {
                let share = |place: [f64; 2], k: usize| (place[k] / size[k]) as f32;
                pieces.push([share(pair[0], 0), share(pair[0], 1), share(pair[1], 0), share(pair[1], 1)]);
            }
        }
        pieces
    }

    /// The edges of cells, each once, in the order of their corners.
    fn edges(&self) -> Vec<(usize, usize)> {
        let sides = self.cells.iter().flat_map(|cell| (0..4).map(|k| (cell[k], cell[(k + 1) % 4])));
        let mut edges: Vec<(usize, usize)> = sides.map(|(a, b)| (a.min(b), a.max(b))).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Where a property of rays changes.
    fn boundary(&self, look: &Look, has: impl Fn(&Seen) -> bool) -> Vec<[f32; 4]> {
        let mut edges = self.edges();
        edges.retain(|&(a, b)| has(&self.seen[a]) != has(&self.seen[b]));
        let mut spans: Vec<[[f64; 2]; 2]> =
            edges.iter().map(|&(a, b)| [self.places[a], self.places[b]]).collect();
        let middle = |[a, b]: &[[f64; 2]; 2]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        for _ in 0..HALVINGS {
            let middles: Vec<[f64; 2]> = spans.iter().map(middle).collect();
            let seen = look.along(&middles);
            for (((span, &(a, _)), middle), seen) in spans.iter_mut().zip(&edges).zip(middles).zip(&seen) {
                let same = has(seen) == has(&self.seen[a]);
                span[usize::from(!same)] = middle;
            }
        }
        self.join(|a, b| edges.binary_search(&(a, b)).ok().map(|place| middle(&spans[place])))
    }

    /// Where a number is 0 that changes smoothly from ray to ray, but not by more than `most` along an edge.
    fn zero(&self, most: f64, number: impl Fn(&Seen) -> f64) -> Vec<[f32; 4]> {
        self.join(|a, b| {
            let (low, high) = (number(&self.seen[a]), number(&self.seen[b]));
            // False for what is not a number.
            let between = (low < 0.0) != (high < 0.0) && (high - low).abs() < most;
            between.then(|| {
                let share = low / (low - high);
                let [from, to] = [a, b].map(|corner| self.places[corner]);
                [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])]
            })
        })
    }
}

/// The lines of some kinds over the picture of a scene, with the threads of the current rayon pool.
pub fn lines(scene: &Scene, kinds: &[Kind]) -> Vec<Lines> {
    let Ok(camera) = Camera::new(scene) else { return Vec::new() };
    let spin = scene.spacetime.spin();
    let matter = spin.map(|spin| Circular::kerr(spin, Sense::Prograde));
    let look = Look { camera, tracer: tracer(scene, Level::best()), spin, matter };
    let mesh = Mesh::new(&look, [scene.render.width, scene.render.height].map(f64::from));
    let mut known: Vec<Kind> = Vec::new();
    for kind in kinds {
        if !known.contains(kind) {
            known.push(*kind);
        }
    }
    let of = |kind: Kind| match kind {
        Kind::Critical => mesh.boundary(&look, |seen| seen.captured),
        // The edges of higher orders are closer to each other than cells are wide.
        Kind::Orders => {
            (1..=2).flat_map(|order| mesh.boundary(&look, move |seen| seen.crossings >= order)).collect()
        }
        Kind::Equator => {
            let circles =
                CIRCLES.iter().flat_map(|radius| mesh.zero(0.3, |seen| seen.inverse_radius - radius.recip()));
            // Zero at every 30°.
            let spokes = mesh.zero(1.0, |seen| (6.0 * seen.azimuth).sin());
            circles.chain(spokes).collect()
        }
        Kind::Shift => (1..=9)
            .flat_map(|tenths| mesh.zero(0.3, move |seen| seen.shift - 0.2 * f64::from(tenths)))
            .collect(),
    };
    known.into_iter().map(|kind| Lines { kind, pieces: of(kind) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kerrscope::spacetime::kerr::CriticalCurve;
    use std::path::Path as FilePath;

    #[test]
    fn the_edge_of_the_shadow_is_the_critical_curve() {
        let text = "[spacetime]\nspin = 0.9\n[observer]\ndistance = inf\ninclination = 60\n[screen]\nkind = \"impact\"\n\
                    field_of_view = 16\n[render]\nwidth = 160\nheight = 160";
        let scene = Scene::from_toml(text, FilePath::new("")).unwrap();
        let lines = lines(&scene, &[Kind::Critical, Kind::Critical]);
        assert_eq!(lines.len(), 1);
        let found: Vec<[f64; 2]> = lines[0]
            .pieces
            .iter()
            .map(|[x, y, ..]| [(f64::from(*x) - 0.5) * 16.0, (0.5 - f64::from(*y)) * 16.0])
            .collect();
        assert!(found.len() > 100, "{}", found.len());
        let curve = CriticalCurve::new(0.9, 60f64.to_radians()).points(40_000);
        // A cell next to it is 1/96 M, halved six times; points of the curve are 8e-4 M apart.
        let off =
            |p: &[f64; 2]| curve.iter().map(|q| (p[0] - q[0]).hypot(p[1] - q[1])).fold(f64::MAX, f64::min);
        let worst = found.iter().map(off).fold(0.0, f64::max);
        assert!(worst < 1e-3, "{worst}");
    }

    #[test]
    fn flat_space_has_no_shadow_and_round_circles() {
        let text = "[spacetime]\nname = \"minkowski\"\n[observer]\ndistance = inf\ninclination = 0\n[screen]\nkind = \"impact\"\n\
                    field_of_view = 40\n[disk]\nmodel = \"none\"\n[render]\nwidth = 100\nheight = 100";
        let scene = Scene::from_toml(text, FilePath::new("")).unwrap();
        let lines = lines(&scene, &[Kind::Critical, Kind::Equator]);
        assert!(lines[0].pieces.is_empty());
        let radius = |[x, y, ..]: &[f32; 4]| 40.0 * (f64::from(*x) - 0.5).hypot(f64::from(*y) - 0.5);
        let near = |wanted: f64| {
            lines[1].pieces.iter().filter(|piece| (radius(piece) - wanted).abs() < 0.05).count()
        };
        for circle in [6.0, 10.0, 15.0] {
            assert!(near(circle) > 40, "{circle}: {}", near(circle));
        }
    }
}
