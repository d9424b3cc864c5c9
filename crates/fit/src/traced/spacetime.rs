//! A spacetime given as text, at given values of its parameters.

use std::sync::Arc;

use kerrscope::spacetime::emitter::{Circular, Sense};
use kerrscope::spacetime::metric::{LineElement, Metric, Text};

/// The largest spin of the Kerr hole that a spacetime is compared with.
const MOST_SPIN: f64 = 0.998;

/// Where a metric is looked at from afar, M.
const FAR: f64 = 1000.0;

/// A metric, the matter that orbits in it about +z, and what it is like from afar.
#[derive(Clone, Debug)]
pub struct Spacetime {
    /// The metric.
    pub element: Arc<LineElement>,
    /// The matter.
    pub matter: Circular,
    /// The radius of its last stable orbit, M.
    pub isco: f64,
    /// a of the Kerr hole that drags alike far away: −g_tφ/(1 + g_tt) in the equatorial plane, which is J/M.
    pub spin: f64,
}

impl Spacetime {
    /// Matter is known out to the radius `outer`.
    ///
    /// # Errors
    /// Why nothing orbits there down to a last stable orbit.
    pub fn new(element: LineElement, outer: f64) -> Result<Self, String> {
        let matter = Circular::of(&Text::new(&element), Sense::Prograde, outer).map_err(|e| e.to_string())?;
        let isco = matter.isco().ok_or("all circular orbits are stable: the disk has no inner edge")?;
        // ∂φ is r ∂y on the x axis.
        let far = Text::new(&element).components(&[FAR, 0.0, 0.0]);
        let spin = -far[0][2] * FAR / (1.0 + far[0][0]);
        if !(isco.is_finite() && spin.is_finite()) {
            return Err("the metric has no mass".to_owned());
        }
        let spin = spin.clamp(-MOST_SPIN, MOST_SPIN);
        Ok(Self { element: Arc::new(element), matter, isco, spin })
    }
}
