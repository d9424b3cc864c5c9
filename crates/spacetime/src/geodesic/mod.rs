//! Null geodesics: what a tracer is given and what it finds.

mod affine;
mod chart;
mod convoy;
mod dense;
mod flow;
mod integrator;
mod inverted;
mod log;
mod method;
mod ray;
mod segment;
mod spherical;
mod straight;
#[cfg(not(test))]
mod text;
mod throat;
mod walk;
mod winding;

pub use affine::AffineFlow;
pub use dense::Dense;
pub(crate) use dense::root;
pub use flow::Flow;
pub use integrator::{EXIT, Integrator, Scheme};
pub use inverted::InvertedFlow;
pub use method::{Dop853, Method, Rk4, Step, Tsit5};
pub use ray::{Ray, Side};
pub use segment::{Curve, Line, Segment};
pub use spherical::SphericalIntegrator;
pub use straight::Straight;
#[cfg(not(test))]
pub use text::TextTracer;
pub(crate) use walk::growth;

use crate::tensor::Vec3;

/// How a ray ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fate {
    /// It comes from infinity.
    Escaped,
    /// It comes out of the past horizon: no light of ours.
    Captured,
    /// It comes from something in the way; see [`Path::hit`].
    Hit,
    /// Given up: too many steps, or steps that cannot be made small enough, as where the metric has no value or not
    /// the signature of a spacetime.
    #[default]
    StepLimit,
}

impl Fate {
    /// What it is called: "escaped", "captured", "hit" or "step-limit".
    pub const fn name(self) -> &'static str {
        match self {
            Self::Escaped => "escaped",
            Self::Captured => "captured",
            Self::Hit => "hit",
            Self::StepLimit => "step-limit",
        }
    }
}

/// What to find along a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Query {
    /// Unit normal of the plane through the origin whose crossings are wanted; z for the equator.
    pub plane: Vec3<f64>,
    /// How many crossings to keep, the first met going back from the camera.
    pub max_crossings: usize,
    /// Whether to integrate the elapsed coordinate time too.
    pub elapsed: bool,
    /// Whether to count how often light went round.
    pub windings: bool,
    /// How many points along the ray to keep, evenly spaced in its parameter; 0 for none. A camera on
    /// [`Side::Ingoing`] gets none.
    pub points: usize,
}

impl Default for Query {
    /// The first eight equatorial crossings.
    fn default() -> Self {
        Self { plane: [0.0, 0.0, 1.0], max_crossings: 8, elapsed: false, windings: false, points: 0 }
    }
}

/// A ray's crossing of the plane asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Place in the coordinates of the chart in which the ray is traced, M.
    pub position: Vec3<f64>,
    /// Boyer–Lindquist radius, M.
    pub r: f64,
    /// Boyer–Lindquist azimuth, radians, unwrapped along the ray from the camera. NaN inside the
    /// horizon, where there is none.
    pub phi: f64,
    /// Coordinate time from the crossing to the camera, M; for a camera at infinity
    /// less r + 2 ln(r/2) of the camera, r → ∞. NaN unless asked for.
    pub elapsed: f64,
    /// Momentum of the light, as it comes, along the plane's normal per energy at infinity: p_z/E for the equator, ±√η/r
    /// around a Kerr hole.
    pub normal: f64,
    /// Whether the light, as it comes, leaves the plane outwards: its radius grows with time.
    pub outward: bool,
}

/// Where a ray meets something that is in its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The number that the [`Obstacles`] gave it.
    pub object: usize,
    /// Place in the coordinates of [`Side::Reversed`], M.
    pub position: Vec3<f64>,
    /// Momentum p_i there, of the photon reversed: it points from the camera on.
    pub momentum: Vec3<f64>,
    /// −p_t.
    pub energy: f64,
}

/// What a tracer finds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    /// How the ray ends.
    pub fate: Fate,
    /// Crossings in the order met going back from the camera, those before the hit if there is one.
    pub crossings: Vec<Crossing>,
    /// What was met, for [`Fate::Hit`].
    pub hit: Option<Hit>,
    /// Asymptotic direction (θ, φ) that the light comes from, φ unwrapped, if it escaped.
    pub direction: Option<[f64; 2]>,
    /// Whether it comes from the other side of a wormhole: the direction is one of the sky there.
    pub other_side: bool,
    /// How often light went round the hole, if asked for: periods of its motion in θ
    /// (Gralla & Lupsasca 2020, eq. 36: the fractional number of orbits), which without spin is the
    /// angle swept over 2π. NaN where that is not known.
    pub windings: f64,
    /// Integration steps tried.
    pub steps: usize,
    /// Estimated error: radians of direction where the ray escaped, relative radius elsewhere.
    pub error_estimate: f64,
    /// Points (t, x, y, z) in the chart of the ray, M, if asked for; t is minus the chart's time to
    /// the camera (from infinity, less its distance).
    pub points: Vec<[f64; 4]>,
}

impl Path {
    /// Forgets a ray but keeps the memory.
    pub fn clear(&mut self) {
        self.fate = Fate::StepLimit;
        self.crossings.clear();
        self.hit = None;
        self.direction = None;
        self.other_side = false;
        self.steps = 0;
        self.windings = f64::NAN;
        self.error_estimate = f64::NAN;
        self.points.clear();
    }
}

/// Things that stand in the way of rays, in the Cartesian coordinates of [`Side::Reversed`].
pub trait Obstacles: Sync {
    /// The first that a piece of a ray meets: where on the piece, and its number.
    fn first(&self, segment: &Segment) -> Option<(f64, usize)>;
}

/// A tracer that follows a ray's course piece by piece, and so finds what stands in the way.
pub trait ObstacleTracer: Tracer {
    /// As [`Tracer::trace`]; a ray that meets one of `obstacles` ends there. One of a camera inside the horizon, or less
    /// than [`EXIT`] horizons from the hole, meets them only once it is farther out.
    fn trace_among(&self, ray: &Ray, query: &Query, obstacles: &dyn Obstacles, path: &mut Path);
}

/// A way to follow rays. Two independent ones for Kerr test each other.
pub trait Tracer: Send + Sync {
    /// What it is called: "closed-form", "integrator", "straight".
    fn name(&self) -> &'static str;

    /// Follows `ray` into the past and replaces `path` with what it met.
    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path);

    /// Follows many rays and replaces as many paths: faster where vector instructions help. A ray's path
    /// does not depend on the rays beside it.
    ///
    /// # Panics
    /// If there are not as many paths as rays.
    fn trace_all(&self, rays: &[Ray], query: &Query, paths: &mut [Path]) {
        assert_eq!(rays.len(), paths.len(), "a path for each ray");
        for (ray, path) in rays.iter().zip(paths) {
            self.trace(ray, query, path);
        }
    }
}

impl<T: Tracer + ?Sized> Tracer for Box<T> {
    fn name(&self) -> &'static str {
        (**self).name()
    }

    fn trace(&self, ray: &Ray, query: &Query, path: &mut Path) {
        (**self).trace(ray, query, path);
    }

    fn trace_all(&self, rays: &[Ray], query: &Query, paths: &mut [Path]) {
        (**self).trace_all(rays, query, paths);
    }
}
