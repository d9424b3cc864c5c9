//! Pieces of surfaces, whose matter is an observer of the light that falls on them.

use super::site::{Site, normed, without};
use crate::geodesic::{Ray, Side};
use crate::metric::{Kerr, Metric, Minkowski};
use crate::tensor::{Tensor, Vec3, Vec4, contract, dot, pair, product};

/// How the matter of a surface moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drift {
    /// At rest relative to infinity: along ∂t.
    Static,
    /// About +z at this angular velocity Ω = dφ/dt, in 1/M: along ∂t + Ω ∂φ.
    Turning(f64),
    /// Velocity (r, θ, φ) in units of c, measured by the observer of zero angular momentum there.
    Velocity([f64; 3]),
}

/// A piece of a surface: its place, and the orthonormal tetrad (u, e₁, e₂, e₃) of its matter there, with e₃ its normal.
///
/// With f(x) growing outwards across the surface and the matter's velocity vⁱ = uⁱ/uᵗ, the normal is along the covector
/// ∂ᵢf (dxⁱ − vⁱ dt). It vanishes on u and on the directions within the surface: it is the normal that the matter itself
/// sees. All is in the chart of [`Side::Reversed`], in which time runs backwards and so do velocities: a reversed photon
/// that leaves a surface along a direction is light that arrives from there.
#[derive(Clone, Copy, Debug)]
pub struct Patch {
    position: Vec3<f64>,
    /// u, e₁, e₂, e₃.
    axes: [Vec4<f64>; 4],
    /// The same with lower indices.
    lowered: [Vec4<f64>; 4],
    /// ∂ᵢf of each.
    slopes: Vec4<f64>,
}

impl Patch {
    /// That at `position` in the chart of [`Side::Reversed`], M, around a hole of spin a (`None`: in flat space), where
    /// the surface's level function has this gradient, of any length. `None` where no matter can move so.
    ///
    /// ```
    /// use kerrscope_spacetime::observer::{Drift, Patch};
    /// let patch = Patch::new(Some(0.9), [0.0, 6.0, 1.0], [0.0, 1.0, 0.0], Drift::Static).unwrap();
    /// // A ray straight up from the surface, and back again.
    /// let ray = patch.ray([0.0, 0.0, 1.0]);
    /// let (frequency, direction) = patch.measure(ray.energy, &ray.start.momentum());
    /// assert!((frequency - 1.0).abs() < 1e-14 && (direction[2] - 1.0).abs() < 1e-14);
    /// assert!(Patch::new(Some(0.9), [0.0, 1.9, 0.0], [0.0, 1.0, 0.0], Drift::Static).is_none());
    /// ```
    pub fn new(spin: Option<f64>, position: Vec3<f64>, gradient: Vec3<f64>, drift: Drift) -> Option<Self> {
        match spin {
            None => Self::build(&Minkowski, 0.0, position, gradient, drift),
            Some(a) => Self::build(&Kerr::new(-a), -a, position, gradient, drift),
        }
    }

    /// As [`new`](Self::new) in any metric, as it is (not reversed): places are those of its own chart reversed in time,
    /// [`Metric::reversed`]. The axes of a [`Drift::Velocity`] are those of spherical coordinates around the origin.
    pub fn in_metric<M: Metric>(
        metric: &M,
        position: Vec3<f64>,
        gradient: Vec3<f64>,
        drift: Drift,
    ) -> Option<Self> {
        Self::build(&metric.reversed(), 0.0, position, gradient, drift)
    }

    fn build<M: Metric>(
        metric: &M,
        s: f64,
        position: Vec3<f64>,
        gradient: Vec3<f64>,
        drift: Drift,
    ) -> Option<Self> {
        if clearance_in(metric, position, drift) <= 0.0 {
            return None;
        }
        let (g, u) = match drift {
            Drift::Static => {
                let g = metric.components(&position);
                (g, [(-g[0][0]).sqrt().recip(), 0.0, 0.0, 0.0])
            }
            Drift::Turning(rate) => {
                let site = Site::at(metric, s, position);
                (site.metric, site.turning(-rate))
            }
            Drift::Velocity(v) => {
                let site = Site::at(metric, s, position);
                (site.metric, site.boosted(metric, site.dragged(), &v.map(|c| -c)))
            }
        };
        let [x, y, z] = gradient;
        let recession = (x * u[1] + y * u[2] + z * u[3]) / u[0];
        let normal = contract(&metric.inverse_components(&position), &[-recession, x, y, z]);
        let e3 = normed(&g, normal);
        let [e1, e2] = within(&g, &u, &e3, &gradient);
        let axes = [u, e1, e2, e3];
        let good = axes.iter().flatten().all(|c| c.is_finite());
        good.then(|| Self {
            position,
            axes,
            lowered: axes.map(|v| contract(&g, &v)),
            slopes: axes.map(|v| x * v[1] + y * v[2] + z * v[3]),
        })
    }

    /// The place in the chart, M.
    pub fn position(&self) -> Vec3<f64> {
        self.position
    }

    /// What the matter finds of a reversed photon of energy −p_t and momentum p_i: its frequency −p·u, and where it goes,
    /// along (e₁, e₂, e₃).
    pub fn measure(&self, energy: f64, [x, y, z]: &Vec3<f64>) -> (f64, Vec3<f64>) {
        let p = [-energy, *x, *y, *z];
        let frequency = -pair(&p, &self.axes[0]);
        let along = |k: usize| pair(&p, &self.axes[k]) / frequency;
        (frequency, [along(1), along(2), along(3)])
    }

    /// How fast a reversed photon that leaves along (e₁, e₂, e₃) gets out of the surface as the coordinates have it, where it
    /// stays: negative if it gets in. Of a surface at rest the sign is that of the third component.
    pub fn climb(&self, [a, b, c]: &Vec3<f64>) -> f64 {
        pair(&self.slopes, &[1.0, *a, *b, *c])
    }

    /// The reversed photon that leaves along (e₁, e₂, e₃) times the components of a unit vector, with frequency 1.
    pub fn ray(&self, direction: Vec3<f64>) -> Ray {
        self.ray_from(self.position, direction)
    }

    /// The same from a place so near that it is the same to the ray.
    pub fn ray_from(&self, position: Vec3<f64>, [a, b, c]: Vec3<f64>) -> Ray {
        let [u, e1, e2, e3] = &self.lowered;
        let [t, x, y, z] = std::array::from_fn(|i| u[i] + a * e1[i] + b * e2[i] + c * e3[i]);
        let azimuth = position[1].atan2(position[0]);
        let mut ray = Ray::from_cartesian(&position, &[x, y, z], -t, Side::Reversed, azimuth);
        ray.aim_azimuth();
        ray
    }
}

/// Positive where matter can move so at a place of the chart of [`Side::Reversed`], and the farther from where it cannot
/// the larger: −g(ξ, ξ) of ξ = ∂t + Ω ∂φ, or r − r₊ for a velocity, whose length is below 1.
pub fn clearance(spin: Option<f64>, position: Vec3<f64>, drift: Drift) -> f64 {
    match spin {
        None => clearance_in(&Minkowski, position, drift),
        Some(a) => clearance_in(&Kerr::new(-a), position, drift),
    }
}

/// As [`clearance`] in any metric, as it is; NaN where it has no value.
pub fn clearance_in_metric<M: Metric>(metric: &M, position: Vec3<f64>, drift: Drift) -> f64 {
    clearance_in(&metric.reversed(), position, drift)
}

fn clearance_in<M: Metric>(metric: &M, position: Vec3<f64>, drift: Drift) -> f64 {
    let distance = dot(&position, &position).sqrt();
    let depth = if distance > 0.0 {
        metric.inverse_depth(distance.recip(), &position.map(|c| c / distance))
    } else {
        f64::INFINITY
    };
    let outside = depth.recip() - metric.horizon();
    let rate = match drift {
        Drift::Static => 0.0,
        Drift::Turning(rate) => -rate,
        Drift::Velocity(_) => return if metric.horizon() > 0.0 { outside } else { 1.0 },
    };
    if outside <= 0.0 && metric.horizon() > 0.0 {
        return outside;
    }
    let along = [1.0, -rate * position[1], rate * position[0], 0.0];
    -product(&metric.components(&position), &along, &along)
}

/// Two unit vectors at right angles to u, e₃ and each other, so that (e₁, e₂, e₃) is right-handed where space is flat.
fn within(g: &Tensor<f64>, u: &Vec4<f64>, e3: &Vec4<f64>, gradient: &Vec3<f64>) -> [Vec4<f64>; 2] {
    // From the coordinate axis that is the farthest from the normal.
    let [x, y, z] = gradient.map(f64::abs);
    let k = if x <= y && x <= z {
        0
    } else if y <= z {
        1
    } else {
        2
    };
    let axis = |k: usize| -> Vec4<f64> { std::array::from_fn(|i| if i == k + 1 { 1.0 } else { 0.0 }) };
    let across = |v: &Vec4<f64>| without(g, &without(g, v, u, -1.0), e3, 1.0);
    let e1 = normed(g, across(&axis(k)));
    // Of the two other axes, that which is farther from the plane of e₁ and the normal.
    let (i, j) = ((k + 1) % 3, (k + 2) % 3);
    let rest = if gradient[i].abs() < gradient[j].abs() { i } else { j };
    let e2 = normed(g, without(g, &across(&axis(rest)), &e1, 1.0));
    let [a, b, c] = [&e1, &e2, e3].map(|e| [e[1], e[2], e[3]]);
    let handed = a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0]);
    [e1, if handed < 0.0 { e2.map(|c| -c) } else { e2 }]
}
