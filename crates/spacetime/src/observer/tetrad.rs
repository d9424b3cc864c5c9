//! Orthonormal tetrads of observers at a finite place, and photons measured in them.

use super::motion::{Motion, ObserverError, Place, check, check_speed};
use super::polar_sin_cos;
use super::site::Site;
use crate::geodesic::{EXIT, Ray, Side};
use crate::metric::{Kerr, Metric, Minkowski};
use crate::tensor::{Tensor, Vec3, Vec4, contract, pair};

/// An observer's orthonormal tetrad (u, e_r, e_θ, e_φ), in the chart in which the rays that
/// arrive there are followed.
///
/// e_φ and e_θ are the coordinate directions at right angles to u (and to each other), e_r
/// completes them: outwards for an observer at rest. On the axis, azimuth 0 stands in for φ.
///
/// ```
/// use kerrscope_spacetime::observer::{Motion, Observer, Place};
/// let place = Place { r: 30.0, theta: 1.4, phi: 0.0 };
/// let observer = Observer::new(Some(0.9), place, Motion::Static)?;
/// // Looking straight at the hole.
/// let ray = observer.ray([-1.0, 0.0, 0.0]);
/// assert!(ray.start.q < 0.0);
/// # Ok::<(), kerrscope_spacetime::observer::ObserverError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Observer {
    position: Vec3<f64>,
    /// g_{μν} at the place.
    metric: Tensor<f64>,
    /// e_r, e_θ, e_φ.
    axes: [Vec4<f64>; 3],
    /// u, e_r, e_θ, e_φ with lower indices.
    lowered: [Vec4<f64>; 4],
    side: Side,
    azimuth: f64,
}

impl Observer {
    /// The observer at `place` around a hole of spin a (`None`: in flat space).
    ///
    /// # Errors
    /// If no observer can move so there, or the place is at infinity.
    pub fn new(spin: Option<f64>, place: Place, motion: Motion) -> Result<Self, ObserverError> {
        check(spin, &place, &motion)?;
        if place.r.is_infinite() {
            return Err(ObserverError::AtInfinity);
        }
        Ok(match spin {
            None => Self::build(&Minkowski, 0.0, &place, &motion, Side::Reversed),
            Some(a) => {
                // In the reversed spacetime a falling observer rises, which is singular at the
                // horizon; in ingoing coordinates nothing is.
                let falls = matches!(motion, Motion::Fall | Motion::VelocityFromFall(_));
                if falls && place.r < EXIT * Kerr::new(a).horizon() {
                    Self::build(&Kerr::new(a), a, &place, &motion, Side::Ingoing)
                } else {
                    Self::build(&Kerr::new(-a), -a, &place, &motion, Side::Reversed)
                }
            }
        })
    }

    /// The observer at `place` in any metric that is regular there: r is the distance from the origin of its
    /// coordinates. Known are those at rest, those without angular momentum (about z, if the metric is the same all around
    /// it), and any velocity relative to the latter.
    ///
    /// # Errors
    /// If no observer can move so there, or the place is at infinity.
    pub fn in_metric<M: Metric>(metric: &M, place: Place, motion: Motion) -> Result<Self, ObserverError> {
        check_speed(&motion)?;
        let r = place.r;
        if r.is_infinite() {
            return Err(ObserverError::AtInfinity);
        }
        if matches!(motion, Motion::Orbit | Motion::Fall | Motion::VelocityFromFall(_)) {
            return Err(ObserverError::OnlyAroundKerr);
        }
        let reversed = metric.reversed();
        if r * metric.edge() >= 1.0 {
            return Err(ObserverError::OutOfReach { r, outer: metric.edge().recip() });
        }
        if metric.has_throat() && r <= metric.horizon() {
            return Err(ObserverError::InsideThroat { r, throat: metric.horizon() });
        }
        let observer = Self::build(&reversed, 0.0, &place, &motion, Side::Reversed);
        let depth = reversed.inverse_depth(1.0 / r, &observer.position.map(|c| c / r));
        if depth * reversed.horizon() > 1.0 {
            return Err(ObserverError::InsideHorizon { r, horizon: metric.horizon() });
        }
        let time = observer.metric[0][0];
        if motion == Motion::Static && time >= 0.0 {
            return Err(ObserverError::NotStatic { r, time });
        }
        let vectors = observer.axes.iter().chain(&observer.lowered).flatten();
        if !vectors.copied().all(f64::is_finite) {
            return Err(ObserverError::NoTetrad { r });
        }
        Ok(observer)
    }

    /// In the chart `metric` with spin s.
    fn build<M: Metric>(metric: &M, s: f64, place: &Place, motion: &Motion, side: Side) -> Self {
        let r = place.r;
        let azimuth = place.phi
            + if r > metric.horizon() {
                metric.azimuth_offset(r)
            } else {
                // Inside the horizon azimuth means that of ingoing coordinates.
                s.atan2(r)
            };
        let site = Site::new(metric, s, r, polar_sin_cos(place.theta), azimuth);
        // Time runs backwards in the reversed spacetime, and so do velocities.
        let sense = if side == Side::Reversed { -1.0 } else { 1.0 };
        let velocity = match motion {
            Motion::Static => site.turning(0.0),
            Motion::ZeroAngularMomentum => site.dragged(),
            // Ω = 1/(r^{3/2} + a) about +z (Bardeen, Press & Teukolsky 1972, eq. 2.16); sense·s = a.
            Motion::Orbit => site.turning(sense / (r * r.sqrt() + sense * s)),
            Motion::Fall => site.falling(metric, sense),
            Motion::Velocity(v) => site.boosted(metric, site.dragged(), &v.map(|c| sense * c)),
            Motion::VelocityFromFall(v) => {
                site.boosted(metric, site.falling(metric, sense), &v.map(|c| sense * c))
            }
        };
        let axes = site.axes(metric, &velocity);
        let lowered = [velocity, axes[0], axes[1], axes[2]].map(|v| contract(&site.metric, &v));
        Self { position: site.position, metric: site.metric, axes, lowered, side, azimuth }
    }

    /// Place in the chart, M.
    pub fn position(&self) -> Vec3<f64> {
        self.position
    }

    /// The ray of the photon that arrives from `direction`: components along (e_r, e_θ, e_φ) of
    /// a unit vector, pointing away from the observer.
    pub fn ray(&self, direction: Vec3<f64>) -> Ray {
        // Reversed: it leaves along the direction. Ingoing: minus a photon that comes in
        // against it, p = −(u − d).
        let sign = match self.side {
            Side::Reversed => 1.0,
            Side::Ingoing => -1.0,
        };
        let [u, e_r, e_theta, e_phi] = &self.lowered;
        let [out, down, across] = direction;
        let [t, x, y, z] =
            std::array::from_fn(|i| sign * u[i] + out * e_r[i] + down * e_theta[i] + across * e_phi[i]);
        let mut ray = Ray::from_cartesian(&self.position, &[x, y, z], -t, self.side, self.azimuth);
        ray.aim_azimuth();
        ray
    }

    /// Components along (e_r, e_θ, e_φ) of the unit vector towards a point of the chart: the
    /// straight line of its coordinates at an instant of its time.
    pub fn direction_to(&self, point: Vec3<f64>) -> Vec3<f64> {
        let step =
            [0.0, point[0] - self.position[0], point[1] - self.position[1], point[2] - self.position[2]];
        let lowered = contract(&self.metric, &step);
        let parts: Vec3<f64> = std::array::from_fn(|k| pair(&lowered, &self.axes[k]));
        let length = parts.iter().map(|c| c * c).sum::<f64>().sqrt();
        parts.map(|c| c / length)
    }
}
