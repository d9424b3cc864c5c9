//! Geodesics from initial values.

use super::motion::{Segment, Stop, drive, pack, unpack};
use super::{Geometry, Named, Nature, matrix};
use crate::dual::Dual;

/// How exactly geodesics are integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Bound on the error of a step, relative for momenta and for coordinates above 1, 4e-14 to 1e-3; what is smaller
    /// is taken as 4e-14, since rounding is as large.
    pub tolerance: f64,
    /// Steps after which a geodesic is given up, each some 500 bytes.
    pub max_steps: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { tolerance: 1e-12, max_steps: 100_000 }
    }
}

/// How a geodesic ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At the parameter asked for.
    Complete,
    /// Where the coordinates end, as at a horizon that they do not cross.
    Edge,
    /// Where steps cannot be made small enough: at a singularity of space or of the coordinates.
    Singular,
    /// Too many steps.
    StepLimit,
}

impl End {
    /// "complete", "edge", "singular" or "step-limit".
    pub fn name(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Edge => "edge",
            Self::Singular => "singular",
            Self::StepLimit => "step-limit",
        }
    }
}

impl From<Stop> for End {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Complete => Self::Complete,
            Stop::Margin => Self::Edge,
            Stop::Singular => Self::Singular,
            Stop::StepLimit => Self::StepLimit,
        }
    }
}

/// A point of a geodesic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<const N: usize> {
    /// The affine parameter λ: proper time or proper length if the velocity at the start had the norm −1 or 1.
    pub parameter: f64,
    /// x^μ.
    pub x: [f64; N],
    /// dx^μ/dλ.
    pub velocity: [f64; N],
    /// p_μ = g_{μν} dx^ν/dλ.
    pub momentum: [f64; N],
}

/// A geodesic, known at every parameter between its ends.
#[derive(Clone, Debug)]
pub struct Trajectory<const N: usize> {
    segments: Vec<Segment<f64>>,
    first: [f64; super::motion::WIDTH],
    last: [f64; super::motion::WIDTH],
    length: f64,
    /// How it ends.
    pub end: End,
    /// Steps tried.
    pub steps: usize,
}

impl<const N: usize> Trajectory<N> {
    /// The geodesic through x with velocity dx^μ/dλ = v, over an affine parameter of `length` (backwards if negative)
    /// or to the end of the coordinates.
    ///
    /// ```
    /// use kerrscope_spacetime::geometry::{Options, Sphere, Trajectory};
    /// let globe = Sphere { radius: 1.0 };
    /// // From 30° north to the north-east, once around.
    /// let way = Trajectory::follow(&globe, &[1.0, 0.0], &[-0.5, 1.0], 6.0, &Options::default());
    /// let half = way.at(3.0);
    /// assert!(half.x[0] > 1.0 && (way.parameter() - 6.0).abs() < 1e-15);
    /// ```
    pub fn follow<G: Geometry<N>>(
        geometry: &G,
        x: &[f64; N],
        v: &[f64; N],
        length: f64,
        options: &Options,
    ) -> Self {
        let p = matrix::apply(&geometry.metric(x), v);
        let first = pack(x, &p);
        let mut segments = Vec::new();
        let mut keep = |segment| segments.push(segment);
        let arrival =
            drive::<_, _, N>(geometry, first, length, options.tolerance, options.max_steps, Some(&mut keep));
        Self {
            segments,
            first,
            last: arrival.y,
            length: arrival.parameter,
            end: arrival.stop.into(),
            steps: arrival.steps,
        }
    }

    /// The parameter at which it ends.
    pub fn parameter(&self) -> f64 {
        self.length
    }

    /// Place and momentum at a parameter; at the nearest end beyond the ends.
    pub fn state(&self, parameter: f64) -> ([f64; N], [f64; N]) {
        let sense = if self.length < 0.0 { -1.0 } else { 1.0 };
        if parameter * sense <= 0.0 {
            return unpack(&self.first);
        }
        if parameter * sense >= self.length * sense {
            return unpack(&self.last);
        }
        let next = self.segments.partition_point(|s| s.start * sense <= parameter * sense);
        let s = &self.segments[next.max(1) - 1];
        unpack(&s.dense.at(((parameter - s.start) / s.h).clamp(0.0, s.until)))
    }

    /// x^μ at a parameter.
    pub fn at(&self, parameter: f64) -> Place<N> {
        let (x, momentum) = self.state(parameter);
        Place { x, momentum }
    }

    /// `count` points, at least 2, evenly spaced in the parameter.
    pub fn points<G: Geometry<N>>(&self, geometry: &G, count: usize) -> Vec<Point<N>> {
        let count = count.max(2);
        (0..count)
            .map(|i| {
                let parameter = self.length * (i as f64 / (count - 1) as f64);
                let (x, momentum) = self.state(parameter);
                let velocity = matrix::apply(&matrix::invert(&geometry.metric(&x)), &momentum);
                Point { parameter, x, velocity, momentum }
            })
            .collect()
    }
}

/// Where a geodesic is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<const N: usize> {
    /// x^μ.
    pub x: [f64; N],
    /// p_μ.
    pub momentum: [f64; N],
}

/// The constants of a geodesic through x with momentum p_μ: its norm g^{μν}p_μp_ν; the momenta of coordinates on which
/// the metric does not depend, of time E = −p_t; and the [`Geometry::invariants`].
pub fn conserved<G: Geometry<N>, const N: usize>(geometry: &G, x: &[f64; N], p: &[f64; N]) -> Vec<Named> {
    let inverse = matrix::invert(&geometry.metric(x));
    let mut all = vec![("norm".to_owned(), matrix::product(&inverse, p, p))];
    let coordinates = geometry.coordinates();
    for (i, kept) in cyclic(geometry, x).into_iter().enumerate() {
        if kept {
            let (name, value) = match coordinates[i].nature {
                Nature::Time => ("E".to_owned(), -p[i]),
                _ => (format!("p_{}", coordinates[i].name), p[i]),
            };
            all.push((name, value));
        }
    }
    all.extend(geometry.invariants(x, p));
    all
}

/// The coordinates on which the metric does not depend: those whose derivatives are exactly zero at three points, one of
/// which alone might lie on a plane of symmetry.
pub(super) fn cyclic<G: Geometry<N>, const N: usize>(geometry: &G, x: &[f64; N]) -> [bool; N] {
    let mut kept = [true; N];
    for shift in [0.0, 1.3e-3, -2.9e-3] {
        let near = std::array::from_fn(|i| x[i] + shift * (1.0 + 0.17 * i as f64) * (1.0 + x[i].abs()));
        for entry in geometry.metric(&Dual::variables(near)).as_flattened() {
            for i in 0..N {
                kept[i] &= entry.gradient[i] == 0.0;
            }
        }
    }
    kept
}
