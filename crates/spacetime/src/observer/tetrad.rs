//! Orthonormal tetrads of observers at a finite place, and photons measured in them.

use super::motion::{Motion, ObserverError, Place, check, check_speed};
use super::polar_sin_cos;
use crate::dual::Dual;
use crate::geodesic::{EXIT, Ray, Side};
use crate::metric::{Kerr, Metric, Minkowski};
use crate::tensor::{Tensor, Vec3, Vec4, contract, pair, product};

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
    /// u.
    velocity: Vec4<f64>,
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
        let vectors = observer.axes.iter().chain([&observer.velocity]).flatten();
        if !vectors.copied().all(f64::is_finite) {
            return Err(ObserverError::NoTetrad { r });
        }
        Ok(observer)
    }

    /// In the chart `metric` with spin s.
    fn build<M: Metric>(metric: &M, s: f64, place: &Place, motion: &Motion, side: Side) -> Self {
        let r = place.r;
        let (sin, cos) = polar_sin_cos(place.theta);
        let azimuth = place.phi
            + if r > metric.horizon() {
                metric.azimuth_offset(r)
            } else {
                // Inside the horizon azimuth means that of ingoing coordinates.
                s.atan2(r)
            };
        let (sin_azimuth, cos_azimuth) = azimuth.sin_cos();
        let width = r.hypot(s);
        let position = [width * sin * cos_azimuth, width * sin * sin_azimuth, r * cos];
        let g = metric.components(&position);
        let across = [0.0, -sin_azimuth, cos_azimuth, 0.0];
        let down = [0.0, width * cos * cos_azimuth, width * cos * sin_azimuth, -r * sin];
        let frame = |velocity: Vec4<f64>| {
            let axes = axes(metric, &position, &g, &velocity, &down, &across);
            let lowered = [velocity, axes[0], axes[1], axes[2]].map(|v| contract(&g, &v));
            Self { position, metric: g, velocity, axes, lowered, side, azimuth }
        };
        // Time runs backwards in the reversed spacetime, and so do velocities.
        let sense = if side == Side::Reversed { -1.0 } else { 1.0 };
        let spinning = |rate: f64| {
            let sweep = rate * width * sin;
            unit(&g, std::array::from_fn(|i| if i == 0 { 1.0 } else { sweep * across[i] }))
        };
        // Zero angular momentum: g(u, ∂φ) = 0 for u ∝ ∂t + ω ∂φ; on the axis ω does not matter.
        let dragged = || {
            let time = [1.0, 0.0, 0.0, 0.0];
            let reach = width * sin;
            let rate = if reach == 0.0 {
                0.0
            } else {
                -product(&g, &time, &across) / (product(&g, &across, &across) * reach)
            };
            spinning(rate)
        };
        let falling = || fall(metric, s, &position, r, sense);
        let boosted = |rest: Vec4<f64>, v: &[f64; 3]| {
            let base = frame(rest);
            unit(
                &g,
                std::array::from_fn(|i| {
                    base.velocity[i]
                        + sense * (v[0] * base.axes[0][i] + v[1] * base.axes[1][i] + v[2] * base.axes[2][i])
                }),
            )
        };
        frame(match motion {
            Motion::Static => spinning(0.0),
            Motion::ZeroAngularMomentum => dragged(),
            // Ω = 1/(r^{3/2} + a) about +z (Bardeen, Press & Teukolsky 1972, eq. 2.16); sense·s = a.
            Motion::Orbit => spinning(sense / (r * r.sqrt() + sense * s)),
            Motion::Fall => falling(),
            Motion::Velocity(v) => boosted(dragged(), v),
            Motion::VelocityFromFall(v) => boosted(falling(), v),
        })
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

/// The timelike unit vector along v.
fn unit(g: &Tensor<f64>, v: Vec4<f64>) -> Vec4<f64> {
    let length = (-product(g, &v, &v)).sqrt();
    v.map(|c| c / length)
}

/// Free fall from rest at infinity, E = 1, L = 0, p_θ = 0: u = −dt̃ + u_r dr with, in ingoing
/// coordinates, u_r = (2r − √X)/Δ = −2r/(2r + √X), X = 2r(r² + a²); reversed in time it rises,
/// u_r = (2r + √X)/Δ. In flat space it stays at rest.
fn fall<M: Metric>(metric: &M, s: f64, position: &Vec3<f64>, r: f64, sense: f64) -> Vec4<f64> {
    let mass = if metric.horizon() > 0.0 { 1.0 } else { 0.0 };
    let speed = (2.0 * mass * r * (r * r + s * s)).sqrt();
    let rate = if mass == 0.0 {
        0.0
    } else if sense > 0.0 {
        -2.0 * r / (2.0 * r + speed)
    } else {
        (2.0 * r + speed) / (r * r - 2.0 * r + s * s)
    };
    let slope = metric.radius(&Dual::variables(*position)).gradient;
    let covector = [-1.0, rate * slope[0], rate * slope[1], rate * slope[2]];
    contract(&metric.inverse_components(position), &covector)
}

/// e_r, e_θ, e_φ for the velocity u: Gram–Schmidt on ∂φ, then ∂θ, then what is left, with the
/// orientation of (r, θ, φ).
fn axes<M: Metric>(
    metric: &M,
    position: &Vec3<f64>,
    g: &Tensor<f64>,
    u: &Vec4<f64>,
    down: &Vec4<f64>,
    across: &Vec4<f64>,
) -> [Vec4<f64>; 3] {
    let without = |v: &Vec4<f64>, e: &Vec4<f64>, norm: f64| -> Vec4<f64> {
        let part = product(g, v, e) * norm;
        std::array::from_fn(|i| v[i] - part * e[i])
    };
    let normed = |v: Vec4<f64>| {
        let length = product(g, &v, &v).sqrt();
        v.map(|c| c / length)
    };
    let e_phi = normed(without(across, u, -1.0));
    let e_theta = normed(without(&without(down, u, -1.0), &e_phi, 1.0));
    // The covector that vanishes on u, e_θ and e_φ, by 3×3 determinants; its sign makes
    // (u, e_r, e_θ, e_φ) positively oriented.
    let rows = [u, &e_theta, &e_phi];
    let covector: Vec4<f64> = std::array::from_fn(|i| {
        let c: [usize; 3] = std::array::from_fn(|k| if k < i { k } else { k + 1 });
        let m = |r: usize, k: usize| rows[r][c[k]];
        let determinant = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1))
            - m(0, 1) * (m(1, 0) * m(2, 2) - m(1, 2) * m(2, 0))
            + m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
        if i % 2 == 0 { -determinant } else { determinant }
    });
    let e_r = normed(contract(&metric.inverse_components(position), &covector));
    [e_r, e_theta, e_phi]
}
