//! Metrics that somebody wrote as formulas.
//!
//! A [`Definition`] is compiled to a [`LineElement`] once; a [`Text`] is its metric, for light that is followed into the
//! past. Where a formula has no value, or the metric not the signature of a spacetime, steps are refused, and the ray
//! ends as given up.

mod check;
mod definition;
mod element;
mod fault;
mod lexicon;
mod spherical;

pub use check::NotFlat;
pub use definition::{Definition, Kind, Part, Reversal};
pub use element::LineElement;
pub use fault::DefinitionFault;

use super::{Inverted, Metric};
use crate::scalar::Scalar;
use crate::tensor::{Tensor, Vec3, contract, cross, dot, each, inverse, product};

/// The metric of a stationary [`LineElement`], as it is or reversed in time.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    element: &'a LineElement,
    backwards: bool,
}

impl<'a> Text<'a> {
    /// The metric as it was written; nothing depends on time, or t = 0.
    pub fn new(element: &'a LineElement) -> Self {
        Self { element, backwards: false }
    }

    /// Whether y has the other sign.
    #[inline(always)]
    fn is_mirrored(&self) -> bool {
        self.backwards && self.element.reversal() == Reversal::Mirror
    }

    #[inline(always)]
    fn place<S: Scalar>(&self, x: &Vec3<S>) -> Vec3<S> {
        if self.is_mirrored() { [x[0], -x[1], x[2]] } else { *x }
    }
}

impl Metric for Text<'_> {
    #[inline(always)]
    fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
        let mut g = self.element.cartesian(&self.place(x));
        if self.backwards {
            // The coordinate that changed its sign.
            let turned = if self.is_mirrored() { 2 } else { 0 };
            for m in 0..4 {
                if m != turned {
                    g[turned][m] = -g[turned][m];
                    g[m][turned] = -g[m][turned];
                }
            }
        }
        g
    }

    #[inline(always)]
    fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S {
        let Some(program) = self.element.radius_program() else { return dot(x, x).sqrt() };
        let mut radius = [x[0]];
        let [a, b, c] = self.place(x);
        program.evaluate(&[x[0].constant(0.0), a, b, c], &mut radius);
        radius[0]
    }

    /// 1, where depth is known by its own formula.
    fn horizon(&self) -> f64 {
        if self.element.depth().is_some() { 1.0 } else { self.element.horizon() }
    }

    #[inline(always)]
    fn inverse_depth<S: Scalar>(&self, w: S, n: &Vec3<S>) -> S {
        if self.element.has_throat() {
            return w;
        }
        let Some(program) = self.element.depth() else { return self.inverse_radius(w, n) };
        let near = w.constant(1e-12).less(w);
        let inverse_w = S::select(near, w, w.constant(1.0)).recip();
        let [a, b, c] = self.place(&each(
            #[inline(always)]
            |i| n[i] * inverse_w,
        ));
        let mut depth = [w];
        program.evaluate(&[w.constant(0.0), a, b, c], &mut depth);
        S::select(near, depth[0], w)
    }

    fn reversed(&self) -> Self {
        Self { backwards: !self.backwards, ..*self }
    }

    fn edge(&self) -> f64 {
        self.element.edge()
    }

    fn has_throat(&self) -> bool {
        self.element.has_throat()
    }

    fn is_axisymmetric(&self) -> bool {
        self.element.is_axisymmetric()
    }

    /// Elapsed time would need the mass.
    fn time_offset(&self, _r: f64) -> f64 {
        f64::NAN
    }

    /// Where space becomes flat, n. At an edge, the direction of the momentum in the frame of the observer at rest
    /// there: u ∝ ∂t, and the triad that Gram and Schmidt make of n and two directions across it.
    fn way_out(&self, energy: f64, state: &Inverted<f64>) -> Vec3<f64> {
        if self.edge() == 0.0 {
            return state.n;
        }
        let x = state.n.map(|c| c / state.w);
        let g = self.components(&x);
        let p = state.momentum();
        let direction = contract(&inverse(&g), &[-energy, p[0], p[1], p[2]]);
        let across = cross(&state.n, &if state.n[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] });
        let length = dot(&across, &across).sqrt();
        let across = across.map(|c| c / length);
        let triad = [state.n, across, cross(&state.n, &across)];
        let mut frame = vec![([1.0, 0.0, 0.0, 0.0], -1.0)];
        frame.extend(triad.map(|[x, y, z]| ([0.0, x, y, z], 1.0)));
        let mut out = [0.0; 3];
        for k in 0..4 {
            let (mut e, sign) = frame[k];
            for (other, norm) in &frame[..k] {
                let part = product(&g, &e, other) * norm;
                e = std::array::from_fn(|i| e[i] - part * other[i]);
            }
            let size = (sign * product(&g, &e, &e)).sqrt();
            frame[k].0 = e.map(|c| c / size);
            if k > 0 {
                let part = product(&g, &direction, &frame[k].0);
                out = std::array::from_fn(|i| out[i] + part * triad[k - 1][i]);
            }
        }
        let size = dot(&out, &out).sqrt();
        out.map(|c| c / size)
    }
}
