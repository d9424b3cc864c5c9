//! A plane through the origin.

/// A plane through the origin, with a direction in it from which azimuth is measured.
///
/// With tilt ι and node Ω (the longitude of the ascending node):
///
/// ```text
/// normal          n  = (sin ι sin Ω, −sin ι cos Ω, cos ι)
/// ascending node  e₁ = (cos Ω, sin Ω, 0)
/// 90° ahead       e₂ = n × e₁ = (−cos ι sin Ω, cos ι cos Ω, sin ι)
/// ```
///
/// Tilt 0 is the equator. Going round in the sense of growing azimuth, one passes from
/// z < 0 to z > 0 at the ascending node.
///
/// ```
/// use kerrscope::disk::Plane;
/// use std::f64::consts::FRAC_PI_2;
/// // The x–z plane, seen from −y: azimuth grows from +x to +z.
/// let plane = Plane::new(FRAC_PI_2, 0.0);
/// assert_eq!(plane.normal(), [0.0, -1.0, FRAC_PI_2.cos()]);
/// assert!((plane.azimuth([0.0, 0.0, 3.0]) - FRAC_PI_2).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    normal: [f64; 3],
    node: [f64; 3],
    ahead: [f64; 3],
}

impl Plane {
    /// The equator, azimuth measured from +x.
    pub const EQUATOR: Self = Self { normal: [0.0, 0.0, 1.0], node: [1.0, 0.0, 0.0], ahead: [0.0, 1.0, 0.0] };

    /// The plane of a tilt and a longitude of the ascending node, in radians. An angle
    /// that is not finite counts as 0.
    pub fn new(tilt: f64, node: f64) -> Self {
        let sin_cos = |angle: f64| {
            if angle.is_finite() { angle.sin_cos() } else { (0.0, 1.0) }
        };
        let ((sin_i, cos_i), (sin_n, cos_n)) = (sin_cos(tilt), sin_cos(node));
        // Adding 0 turns −0 into 0, which prints better.
        Self {
            normal: [sin_i * sin_n + 0.0, -sin_i * cos_n + 0.0, cos_i],
            node: [cos_n, sin_n, 0.0],
            ahead: [-cos_i * sin_n + 0.0, cos_i * cos_n + 0.0, sin_i],
        }
    }

    /// The unit normal.
    pub const fn normal(&self) -> [f64; 3] {
        self.normal
    }

    /// Components of a point along the ascending node and along the direction 90° ahead of it.
    pub fn components(&self, position: [f64; 3]) -> [f64; 2] {
        let along = |e: [f64; 3]| e[0] * position[0] + e[1] * position[1] + e[2] * position[2];
        [along(self.node), along(self.ahead)]
    }

    /// The azimuth of a point, from the ascending node, −π to π: 0 on the axis and where
    /// the point is not finite.
    pub fn azimuth(&self, position: [f64; 3]) -> f64 {
        let [node, ahead] = self.components(position);
        let azimuth = ahead.atan2(node);
        if azimuth.is_nan() { 0.0 } else { azimuth }
    }
}

impl Default for Plane {
    fn default() -> Self {
        Self::EQUATOR
    }
}
