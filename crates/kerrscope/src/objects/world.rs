//! All things of a scene together.

use super::piece::{Course, Piece};
use super::tree::{Chord, Tree};
use super::{Bounds, Shape};
use crate::spacetime::geodesic::{Curve, Line, Obstacles, Segment};
use crate::spacetime::tensor::{Vec3, dot};

/// Shapes in a tree, so that a ray finds the first that it meets.
///
/// ```
/// use kerrscope::objects::{Shape, Sphere, World};
/// use kerrscope::spacetime::geodesic::{Line, Obstacles, Segment};
/// let ball = |x| Shape::Sphere(Sphere { center: [x, 0.0, 0.0], radius: 1.0, axes: Sphere::axes([0.0; 3]) });
/// let world = World::new(vec![ball(9.0), ball(5.0), ball(-5.0)]);
/// let line = Line { origin: [0.0; 3], direction: [1.0, 0.0, 0.0], start: 0.0 };
/// assert_eq!(world.first(&Segment::Line(line)), Some((4.0, 1)));
/// ```
#[derive(Clone, Debug)]
pub struct World {
    shapes: Vec<Shape>,
    tree: Tree,
    bounds: Bounds,
    /// The size of a middling thing, M.
    grain: f64,
}

/// Halvings of a step, after which its pieces are compared with everything.
const MOST_HALVINGS: u32 = 40;

impl World {
    /// A world of these shapes, numbered from 0.
    pub fn new(shapes: Vec<Shape>) -> Self {
        let boxes: Vec<Bounds> = shapes.iter().map(Shape::bounds).collect();
        let size = |bounds: &Bounds| bounds.edges().into_iter().fold(0.0, f64::max);
        let mut sizes: Vec<f64> = boxes.iter().map(size).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        let grain = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
        let tree = Tree::new(&boxes);
        Self { shapes, bounds: tree.bounds(), tree, grain }
    }

    /// A shape.
    pub fn shape(&self, number: usize) -> &Shape {
        &self.shapes[number]
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.shapes.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.shapes.is_empty()
    }

    /// What a straight ray meets first: its distance from `origin` and its number.
    #[inline]
    pub fn along(&self, line: &Line) -> Option<(f64, usize)> {
        let mut line = *line;
        let mut shift = 0.0;
        if line.start.is_infinite() {
            // From where nothing has been met yet.
            shift = -2.0 * (self.bounds.reach() + dot(&line.origin, &line.origin).sqrt());
            line.origin = std::array::from_fn(|i| line.origin[i] + shift * line.direction[i]);
            line.start = 0.0;
        }
        let chord = Chord {
            origin: line.origin,
            direction: line.direction,
            until: f64::INFINITY,
            // Flat things have flat boxes: as much as rounding can miss them by.
            margin: 1e-12 * (line.origin.iter().map(|c| c.abs()).fold(0.0, f64::max) + self.grain),
        };
        let mut found = None;
        self.tree.visit(&chord, |number, until| {
            let d = self.shapes[number].meets_line(&line, until)?;
            found = Some((d + shift, number));
            Some(d)
        });
        found
    }

    /// What a bent ray meets first: θ and its number.
    ///
    /// A step is halved until its pieces are nearly straight, or past everything. The things near a piece's chord are then
    /// compared with the curve itself.
    fn along_curve(&self, curve: &Curve, halvings: u32) -> Option<(f64, usize)> {
        match Piece::of(curve, &self.bounds, self.grain) {
            Course::Past => None,
            Course::Near(piece) => self.in_piece(&piece),
            Course::Unclear if halvings == MOST_HALVINGS => self.in_piece(&Piece::anywhere(curve)),
            Course::Unclear => {
                let (before, after) = curve.split(0.5);
                let half = |(theta, number)| (0.5 * theta, number);
                let first = self.along_curve(&before, halvings + 1).map(half);
                first.or_else(|| {
                    let (theta, number) = self.along_curve(&after, halvings + 1).map(half)?;
                    Some((0.5 + theta, number))
                })
            }
        }
    }

    fn in_piece(&self, piece: &Piece<'_>) -> Option<(f64, usize)> {
        let mut found: Option<(f64, usize)> = None;
        self.tree.visit(&piece.chord, |number, _| {
            if let Some(theta) = self.shapes[number].meets_piece(piece)
                && found.is_none_or(|(nearest, _)| theta < nearest)
            {
                found = Some((theta, number));
            }
            None
        });
        found
    }

    /// A point next to a shape's surface, on the side towards which `outwards` points: far enough for a ray that starts
    /// there not to meet the surface that it leaves, some thousand times what rounding may be.
    #[inline]
    pub fn lift(&self, number: usize, x: &Vec3<f64>, outwards: &Vec3<f64>) -> Vec3<f64> {
        let size = match &self.shapes[number] {
            Shape::Sphere(sphere) => sphere.radius,
            Shape::Flat(_) => 0.0,
        };
        let away = 1e-10 * (x[0].abs() + x[1].abs() + x[2].abs() + size);
        std::array::from_fn(|i| x[i] + away * outwards[i])
    }
}

impl Obstacles for World {
    fn first(&self, segment: &Segment) -> Option<(f64, usize)> {
        match segment {
            Segment::Line(line) => self.along(line),
            Segment::Curve(curve) => self.along_curve(curve, 0),
        }
    }
}
