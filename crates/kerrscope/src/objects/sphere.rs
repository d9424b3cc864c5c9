//! Spheres.

use std::f64::consts::{PI, TAU};

use super::bounds::Bounds;
use super::piece::Piece;
use super::roots;
use crate::spacetime::geodesic::Line;
use crate::spacetime::tensor::{Vec3, dot};

/// All points at one coordinate distance from a point: a surface with nothing in it, seen from both sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// The point, M.
    pub center: Vec3<f64>,
    /// The distance, M.
    pub radius: f64,
    /// Unit vectors from the centre to longitude 0 on the equator, to longitude 90° on it, and to the north pole, by
    /// which patterns lie on it.
    pub axes: [Vec3<f64>; 3],
}

impl Sphere {
    /// The axes of a sphere that stands upright, turned about x, y and z by angles in radians, in this order.
    pub fn axes(turns: Vec3<f64>) -> [Vec3<f64>; 3] {
        let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (k, angle) in turns.into_iter().enumerate() {
            let (sin, cos) = angle.sin_cos();
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            for axis in &mut axes {
                (axis[i], axis[j]) = (cos * axis[i] - sin * axis[j], sin * axis[i] + cos * axis[j]);
            }
        }
        axes
    }

    pub(super) fn bounds(&self) -> Bounds {
        Bounds { low: self.center.map(|c| c - self.radius), high: self.center.map(|c| c + self.radius) }
    }

    /// The first d from the line's start to `until`: |o + d v|² = R², o from the centre. With p = o − (o·v)v the roots are
    /// −o·v ± √(R² − p²), which does not cancel for a sphere that is far away; the nearer one to zero comes from their
    /// product o² − R² = (|o| − R)(|o| + R) (Haines et al. 2019, in Ray Tracing Gems, ch. 7).
    #[inline]
    pub(super) fn meets_line(&self, line: &Line, until: f64) -> Option<f64> {
        let v = &line.direction;
        let o = [
            line.origin[0] - self.center[0],
            line.origin[1] - self.center[1],
            line.origin[2] - self.center[2],
        ];
        let along = dot(&o, v);
        let p = [o[0] - along * v[0], o[1] - along * v[1], o[2] - along * v[2]];
        let square = self.radius * self.radius - dot(&p, &p);
        if !(square >= 0.0) {
            return None;
        }
        let far = -along - square.sqrt().copysign(along);
        let length = dot(&o, &o).sqrt();
        let product = (length - self.radius) * (length + self.radius);
        let other = product / far;
        let (first, second) = if far < other { (far, other) } else { (other, far) };
        let d = if first > line.start { first } else { second };
        (d > line.start && d < until).then_some(d)
    }

    /// The first θ at which the curve passes through: |X − c W|² − R²W² = 0, a polynomial of degree 14.
    pub(super) fn meets_piece(&self, piece: &Piece<'_>) -> Option<f64> {
        if piece.is_off(&self.center, self.radius) {
            return None;
        }
        let points = &piece.curve.points;
        let part =
            |i: usize| -> [f64; 8] { std::array::from_fn(|k| points[k][i] - self.center[i] * points[k][3]) };
        let reach = std::array::from_fn(|k| self.radius * points[k][3]);
        let b = roots::sum_of_squares(&[part(0), part(1), part(2), reach], &[1.0, 1.0, 1.0, -1.0]);
        roots::first(&b, |_| true)
    }

    /// The point of the surface next to a point, and the outward normal.
    #[inline]
    pub(super) fn settle(&self, x: &Vec3<f64>) -> [Vec3<f64>; 2] {
        let off: Vec3<f64> = std::array::from_fn(|i| x[i] - self.center[i]);
        let inverse = dot(&off, &off).sqrt().recip();
        let normal = off.map(|c| c * inverse);
        [std::array::from_fn(|i| self.center[i] + self.radius * normal[i]), normal]
    }

    /// Longitude from 0 to 1, once around to the east from longitude −180°, and latitude from 0 at the south pole to 1.
    pub(super) fn coordinates(&self, normal: &Vec3<f64>) -> [f64; 2] {
        let [ahead, east, north] = self.axes.map(|axis| dot(&axis, normal));
        [0.5 + east.atan2(ahead) / TAU, 1.0 - ahead.hypot(east).atan2(north) / PI]
    }

    /// The point with these coordinates.
    pub(super) fn point(&self, [u, v]: [f64; 2]) -> Vec3<f64> {
        let ((east, ahead), (across, north)) = ((TAU * (u - 0.5)).sin_cos(), (PI * (1.0 - v)).sin_cos());
        let along = [across * ahead, across * east, north];
        std::array::from_fn(|i| {
            self.center[i] + self.radius * (0..3).map(|k| along[k] * self.axes[k][i]).sum::<f64>()
        })
    }
}
