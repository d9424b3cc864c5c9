//! Lengths of curves.

use super::{Geometry, matrix};
use crate::dual::Dual;
use crate::scalar::Scalar;

/// The length of a curve: ∫ √|g_{μν} ẋ^μ ẋ^ν| ds over its spacelike and over its timelike parts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Length {
    /// Proper length where the curve is spacelike.
    pub spacelike: f64,
    /// Proper time where it is timelike.
    pub timelike: f64,
    /// Estimated error of each.
    pub error: f64,
}

/// Nodes and weights of Kronrod's rule of 15 points on [−1, 1], of one half; every second belongs to Gauss's rule of 7.
const NODES: [f64; 8] = [
    0.991455371120812639206854697526329,
    0.949107912342758524526189684047851,
    0.864864423359769072789712788640926,
    0.741531185599394439863864773280788,
    0.586087235467691130294144691693014,
    0.405845151377397166906606412076961,
    0.207784955007898467600689403773245,
    0.0,
];
const KRONROD: [f64; 8] = [
    0.022935322010529224963732008058970,
    0.063092092629978553290700663189204,
    0.104790010322250183839876322541518,
    0.140653259715525918745189590510238,
    0.169004726639267902826583426598550,
    0.190350578064785409913256402421014,
    0.204432940075298892414161999234649,
    0.209482141084727828012999174891714,
];
const GAUSS: [f64; 4] = [
    0.129484966168869693270611432679082,
    0.279705391489276667901467771423780,
    0.381830050505118944950369775488975,
    0.417959183673469387755102040816327,
];

/// Intervals at most: what would need more has a singularity in it.
const MAX_INTERVALS: usize = 2_000;
const LEAST_INTERVAL: f64 = 1e-11;

/// The length of a curve x(s), s from 0 to 1, to a relative `tolerance`. The curve is written for dual numbers, which
/// know its slope.
///
/// ```
/// use kerrscope_spacetime::Scalar;
/// use kerrscope_spacetime::geometry::{PolarPlane, length};
/// // One turn of Archimedes's spiral r = φ, from φ = 0: ½[φ√(1 + φ²) + asinh φ].
/// let turn = std::f64::consts::TAU;
/// let spiral = length(&PolarPlane, |s| [s * turn, s * turn], 1e-12);
/// let exact = 0.5 * (turn * turn.hypot(1.0) + turn.asinh());
/// assert!((spiral.spacelike - exact).abs() < 1e-11);
/// ```
pub fn length<G: Geometry<N>, const N: usize>(
    geometry: &G,
    curve: impl Fn(Dual<f64, 1>) -> [Dual<f64, 1>; N],
    tolerance: f64,
) -> Length {
    let speed = |s: f64| {
        let along = curve(Dual::variable([s], 0));
        let (x, slope) = (along.map(|c| c.value), along.map(|c| c.gradient[0]));
        let square = matrix::product(&geometry.metric(&x), &slope, &slope);
        if square < 0.0 { [0.0, (-square).sqrt()] } else { [square.sqrt(), 0.0] }
    };
    // Globally adaptive: the worst interval is halved until the whole is good enough.
    let mut parts = vec![rule(&speed, 0.0, 1.0)];
    loop {
        let total = |f: fn(&Part) -> f64| parts.iter().map(f).sum::<f64>();
        let (spacelike, timelike) = (total(|p| p.value[0]), total(|p| p.value[1]));
        let error = total(|p| p.error);
        if !(error > tolerance * (spacelike + timelike)) || parts.len() >= MAX_INTERVALS {
            return Length { spacelike, timelike, error };
        }
        // What is left of a singularity next to an end is so short that it counts as it is.
        let long = (0..parts.len()).filter(|i| parts[*i].to - parts[*i].from > LEAST_INTERVAL);
        let worst = long.reduce(|a, b| if parts[b].error > parts[a].error { b } else { a });
        let Some(worst) = worst else { return Length { spacelike, timelike, error } };
        let Part { from, to, .. } = parts[worst];
        let middle = 0.5 * (from + to);
        parts[worst] = rule(&speed, from, middle);
        parts.push(rule(&speed, middle, to));
    }
}

struct Part {
    from: f64,
    to: f64,
    value: [f64; 2],
    error: f64,
}

fn rule(f: &impl Fn(f64) -> [f64; 2], from: f64, to: f64) -> Part {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut value, mut coarse) = ([0.0; 2], [0.0; 2]);
    for (i, node) in NODES.into_iter().enumerate() {
        let at = |sign: f64| f(middle + sign * half * node);
        let (left, right) = (at(-1.0), if node == 0.0 { [0.0; 2] } else { at(1.0) });
        for k in 0..2 {
            let sum = (left[k] + right[k]) * half;
            value[k] += KRONROD[i] * sum;
            if i % 2 == 1 {
                coarse[k] += GAUSS[i / 2] * sum;
            }
        }
    }
    let error = (value[0] - coarse[0]).abs() + (value[1] - coarse[1]).abs();
    // The difference is that of the rule of 7; the rule of 15 is better by far (Piessens et al. 1983, QUADPACK).
    let error = if error > 0.0 { error.min((200.0 * error).powf(1.5)) } else { error };
    Part { from, to, value, error }
}

/// The length of straight lines of the coordinates from each point to the next, to a relative 1e-12.
pub fn polyline<G: Geometry<N>, const N: usize>(geometry: &G, points: &[[f64; N]]) -> Length {
    let mut whole = Length::default();
    for ends in points.windows(2) {
        let line =
            |s: Dual<f64, 1>| std::array::from_fn(|i| s * (ends[1][i] - ends[0][i]) + s.constant(ends[0][i]));
        let part = length(geometry, line, 1e-12);
        whole.spacelike += part.spacelike;
        whole.timelike += part.timelike;
        whole.error += part.error;
    }
    whole
}
