//! A piece of a bent ray that is nearly straight.

use super::bounds::Bounds;
use super::tree::Chord;
use crate::spacetime::geodesic::Curve;
use crate::spacetime::tensor::{Vec3, dot};

/// A piece of a bent ray, and a straight line that it is near to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece<'a> {
    /// The curve.
    pub(super) curve: &'a Curve,
    /// From end to end. All of the curve is within the margin: it lies in the hull of its control points (their weights
    /// being positive), and so does what is near the line.
    pub(super) chord: Chord,
}

/// What a curve is to a box.
pub(super) enum Course<'a> {
    /// It passes it by.
    Past,
    /// It is too bent, or reaches too far, to say: look at its halves.
    Unclear,
    /// It is near enough to a straight line.
    Near(Piece<'a>),
}

/// A piece may bend by this share of its length.
const BEND: f64 = 1.0 / 16.0;

/// The weights of a piece may differ by this factor.
const SPREAD: f64 = 8.0;

impl<'a> Piece<'a> {
    /// How a curve passes a box, in which the finest things are about `grain` large.
    pub(super) fn of(curve: &'a Curve, bounds: &Bounds, grain: f64) -> Course<'a> {
        if is_beside(curve, bounds) {
            return Course::Past;
        }
        let (mut least, mut most) = (f64::INFINITY, 0.0);
        for [_, _, _, w] in &curve.points {
            least = if *w < least { *w } else { least };
            most = if *w > most { *w } else { most };
        }
        if !(least * SPREAD > most) {
            return Course::Unclear;
        }
        let places = curve.points.map(|[x, y, z, w]| {
            let inverse = w.recip();
            [x * inverse, y * inverse, z * inverse]
        });
        let direction: Vec3<f64> = std::array::from_fn(|i| places[7][i] - places[0][i]);
        let square = dot(&direction, &direction);
        let mut margin: f64 = 0.0;
        for place in &places[1..7] {
            let off: Vec3<f64> = std::array::from_fn(|i| place[i] - places[0][i]);
            let share = (dot(&off, &direction) / square).clamp(0.0, 1.0);
            let apart: Vec3<f64> = std::array::from_fn(|i| off[i] - share * direction[i]);
            margin = margin.max(dot(&apart, &apart));
        }
        let margin = margin.sqrt();
        // Also what is not a number, as of a piece without length.
        if margin > BEND * square.sqrt() && margin > 0.1 * grain {
            return Course::Unclear;
        }
        // The margin's own rounding is far below a billionth.
        let margin = margin * (1.0 + 1e-9) + 1e-12 * bounds.reach();
        Course::Near(Self { curve, chord: Chord { origin: places[0], direction, until: 1.0, margin } })
    }

    /// A curve of which nothing more is known.
    pub(super) fn anywhere(curve: &'a Curve) -> Self {
        let direction = [1.0, 0.0, 0.0];
        Self { curve, chord: Chord { origin: [0.0; 3], direction, until: 1.0, margin: f64::MAX } }
    }

    /// Whether the piece stays farther than `reach` from a point.
    pub(super) fn is_off(&self, point: &Vec3<f64>, reach: f64) -> bool {
        let Chord { origin, direction, margin, .. } = &self.chord;
        let off: Vec3<f64> = std::array::from_fn(|i| point[i] - origin[i]);
        let share = (dot(&off, direction) / dot(direction, direction)).clamp(0.0, 1.0);
        let apart: Vec3<f64> = std::array::from_fn(|i| off[i] - share * direction[i]);
        dot(&apart, &apart) > (reach + margin).powi(2)
    }
}

/// Whether a face of a box has all of a curve beyond it.
fn is_beside(curve: &Curve, bounds: &Bounds) -> bool {
    (0..3).any(|i| {
        curve.points.iter().all(|p| p[i] > bounds.high[i] * p[3])
            || curve.points.iter().all(|p| p[i] < bounds.low[i] * p[3])
    })
}
