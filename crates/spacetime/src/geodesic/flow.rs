//! A system of ordinary differential equations for a ray, in some chart.

/// y′ = f(y), with the sizes against which errors in y count.
pub trait Flow<S, const D: usize> {
    /// The slope y′ at y.
    fn derivative(&self, y: &[S; D]) -> [S; D];

    /// 1/size of each component: a step's error estimate is the root mean square of
    /// (error × this). Zero leaves a component out.
    fn inverse_scale(&self, y: &[S; D]) -> [S; D];
}
