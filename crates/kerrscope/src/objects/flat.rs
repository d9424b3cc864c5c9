//! Flat pieces: parallelograms and annuli.

use std::f64::consts::TAU;

use super::bounds::Bounds;
use super::piece::Piece;
use super::roots;
use crate::spacetime::geodesic::Line;
use crate::spacetime::tensor::{Vec3, cross, dot};

/// A flat piece of a plane, flat in the coordinates; seen from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flat {
    /// A point of the plane: a corner, or the centre, M.
    origin: Vec3<f64>,
    /// Two vectors in the plane: edges, or perpendicular radii as long as the outer one, M.
    edges: [Vec3<f64>; 2],
    /// x ↦ (duals · (x − origin)) are the components along the edges.
    duals: [Vec3<f64>; 2],
    normal: Vec3<f64>,
    outline: Outline,
}

/// Where a flat piece ends, by the components along its edges.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outline {
    /// Both from 0 to 1.
    Parallelogram,
    /// The root of the sum of their squares from this to 1.
    Annulus(f64),
}

impl Flat {
    /// The parallelogram with a corner, in M, and the edges that leave it. `None` if it has no area.
    pub fn parallelogram(corner: Vec3<f64>, edges: [Vec3<f64>; 2]) -> Option<Self> {
        let across = cross(&edges[0], &edges[1]);
        let area = dot(&across, &across).sqrt();
        let [a, b] = edges.map(|e| dot(&e, &e).sqrt());
        // A thousandth of a degree between the edges.
        if !(area > 1e-5 * a * b && area.is_finite()) {
            return None;
        }
        let normal = across.map(|c| c / area);
        let duals = [cross(&edges[1], &normal), cross(&normal, &edges[0])].map(|d| d.map(|c| c / area));
        Some(Self { origin: corner, edges, duals, normal, outline: Outline::Parallelogram })
    }

    /// The annulus about a centre, at right angles to `normal` (not zero), between two radii, 0 ≤ inner < outer, in M.
    /// Azimuth is measured from where its plane rises through a plane of equal z, or from +x if it is such a plane.
    pub fn annulus(center: Vec3<f64>, normal: Vec3<f64>, [inner, outer]: [f64; 2]) -> Option<Self> {
        let length = dot(&normal, &normal).sqrt();
        let normal = normal.map(|c| c / length);
        let flat = normal[0].hypot(normal[1]);
        let node = if flat > 1e-12 { [-normal[1] / flat, normal[0] / flat, 0.0] } else { [1.0, 0.0, 0.0] };
        let ahead = cross(&normal, &node);
        let good = length > 0.0 && outer > inner && (0.0..f64::INFINITY).contains(&inner);
        (good && normal.iter().all(|c| c.is_finite())).then(|| Self {
            origin: center,
            edges: [node, ahead].map(|e| e.map(|c| c * outer)),
            duals: [node, ahead].map(|e| e.map(|c| c / outer)),
            normal,
            outline: Outline::Annulus(inner / outer),
        })
    }

    pub(super) fn bounds(&self) -> Bounds {
        let [a, b] = self.edges;
        match self.outline {
            Outline::Parallelogram => Bounds::of(
                [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]
                    .map(|[u, v]| std::array::from_fn(|i| self.origin[i] + u * a[i] + v * b[i])),
            ),
            Outline::Annulus(_) => {
                let half: Vec3<f64> = std::array::from_fn(|i| a[i].hypot(b[i]));
                Bounds {
                    low: std::array::from_fn(|i| self.origin[i] - half[i]),
                    high: std::array::from_fn(|i| self.origin[i] + half[i]),
                }
            }
        }
    }

    /// Components of a point along the edges.
    fn components(&self, x: &Vec3<f64>) -> [f64; 2] {
        let off = [x[0] - self.origin[0], x[1] - self.origin[1], x[2] - self.origin[2]];
        [dot(&self.duals[0], &off), dot(&self.duals[1], &off)]
    }

    fn holds(&self, x: &Vec3<f64>) -> bool {
        let [u, v] = self.components(x);
        match self.outline {
            Outline::Parallelogram => (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v),
            Outline::Annulus(inner) => (inner..=1.0).contains(&u.hypot(v)),
        }
    }

    /// The d from the line's start to `until`.
    #[inline]
    pub(super) fn meets_line(&self, line: &Line, until: f64) -> Option<f64> {
        let off: Vec3<f64> = std::array::from_fn(|i| self.origin[i] - line.origin[i]);
        let d = dot(&self.normal, &off) / dot(&self.normal, &line.direction);
        if !(d > line.start && d < until) {
            return None;
        }
        self.holds(&std::array::from_fn(|i| line.origin[i] + d * line.direction[i])).then_some(d)
    }

    /// The first θ at which the curve passes through: N·X − N·c W = 0, a polynomial of degree 7.
    pub(super) fn meets_piece(&self, piece: &Piece<'_>) -> Option<f64> {
        let height = dot(&self.normal, &self.origin);
        let b: [f64; 8] = std::array::from_fn(|k| {
            let [x, y, z, w] = piece.curve.points[k];
            dot(&self.normal, &[x, y, z]) - height * w
        });
        roots::first(&b, |theta| self.holds(&piece.curve.position(theta)))
    }

    /// The point of the plane next to a point, and the normal.
    #[inline]
    pub(super) fn settle(&self, x: &Vec3<f64>) -> [Vec3<f64>; 2] {
        let off: Vec3<f64> = std::array::from_fn(|i| x[i] - self.origin[i]);
        let height = dot(&self.normal, &off);
        [std::array::from_fn(|i| x[i] - height * self.normal[i]), self.normal]
    }

    /// Components along a parallelogram's edges; azimuth and radius in an annulus; from 0 to 1.
    pub(super) fn coordinates(&self, x: &Vec3<f64>) -> [f64; 2] {
        let [u, v] = self.components(x);
        match self.outline {
            Outline::Parallelogram => [u, v],
            Outline::Annulus(inner) => {
                let turn = v.atan2(u) / TAU;
                [if turn < 0.0 { turn + 1.0 } else { turn }, (u.hypot(v) - inner) / (1.0 - inner)]
            }
        }
    }

    /// The point with these coordinates.
    pub(super) fn point(&self, [u, v]: [f64; 2]) -> Vec3<f64> {
        let [u, v] = match self.outline {
            Outline::Parallelogram => [u, v],
            Outline::Annulus(inner) => {
                let (sin, cos) = (TAU * u).sin_cos();
                let radius = inner + v * (1.0 - inner);
                [radius * cos, radius * sin]
            }
        };
        let [a, b] = self.edges;
        std::array::from_fn(|i| self.origin[i] + u * a[i] + v * b[i])
    }
}
