//! The camera: from a point of the picture to a ray.
//!
//! Points of the picture are counted in pixels from its top left corner, x to the right and
//! y down; the centre of the first pixel is (½, ½). The vertical field goes from outer edge to
//! outer edge, and pixels are square.
//!
//! The camera's axes: without `look_at` it looks along −e_r, its right is e_φ (α > 0) and its up
//! is −e_θ (β > 0). Roll turns right to (cos roll, sin roll) in the (α, β) plane.

use crate::scene::{Scene, ScreenKind};
use crate::spacetime::geodesic::Ray;
use crate::spacetime::observer::{Observer, ObserverError, impact_ray};
use crate::spacetime::tensor::{Vec3, cross, dot};

/// A camera that makes rays.
///
/// ```
/// use kerrscope::camera::Camera;
/// use kerrscope::scene::Scene;
/// let camera = Camera::new(&Scene::built_in())?;
/// let ray = camera.ray(480.0, 270.0)?;
/// assert!(ray.start.q < 0.0, "the middle of the picture looks at the hole");
/// # Ok::<(), kerrscope::spacetime::observer::ObserverError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Camera {
    lens: Lens,
    /// Screen units in a pixel: tangents, radians or M.
    pixel: f64,
    /// Half the picture's width and height in pixels.
    middle: [f64; 2],
    /// M in a screen unit at the distance of the hole.
    scale: f64,
}

#[derive(Clone, Debug)]
enum Lens {
    /// Directions in an observer's tetrad.
    Local { observer: Box<Observer>, axes: Axes, project: fn(f64, f64) -> Vec3<f64> },
    /// Impact parameters.
    Impact { spin: Option<f64>, inclination: f64, r: f64, azimuth: f64, roll: [f64; 2] },
}

/// Right, up and forward, as components along (e_r, e_θ, e_φ).
#[derive(Clone, Debug)]
struct Axes([Vec3<f64>; 3]);

impl Camera {
    /// The camera of a scene.
    ///
    /// # Errors
    /// If no observer can be as the scene has it; a valid scene's can.
    pub fn new(scene: &Scene) -> Result<Self, ObserverError> {
        let (place, motion) = (scene.observer.place, scene.observer.motion);
        let spin = scene.spacetime.spin();
        let roll = scene.screen.roll.sin_cos();
        let (width, height) = (f64::from(scene.render.width), f64::from(scene.render.height));
        let local = |project| -> Result<Lens, ObserverError> {
            let observer = Box::new(scene.spacetime.observer(place, motion)?);
            let axes = Axes::new(&observer, scene.screen.look_at, roll);
            Ok(Lens::Local { observer, axes, project })
        };
        let (lens, field, scale) = match scene.screen.kind {
            ScreenKind::Pinhole { height } => (local(pinhole)?, 2.0 * (0.5 * height).tan(), place.r),
            ScreenKind::Angular { height } => (local(equal_angles)?, height, place.r),
            ScreenKind::Impact { height } => {
                let (sin, cos) = roll;
                let lens = Lens::Impact {
                    spin,
                    inclination: place.theta,
                    r: place.r,
                    azimuth: place.phi,
                    roll: [cos, sin],
                };
                (lens, height, 1.0)
            }
        };
        Ok(Self { lens, pixel: field / height, middle: [0.5 * width, 0.5 * height], scale })
    }

    /// The ray that arrives at a point of the picture.
    ///
    /// # Errors
    /// On the screen of impact parameters: if no photon with these arrives at the observer.
    pub fn ray(&self, x: f64, y: f64) -> Result<Ray, ObserverError> {
        let [right, up] = [(x - self.middle[0]) * self.pixel, (self.middle[1] - y) * self.pixel];
        match &self.lens {
            Lens::Local { observer, axes, project } => Ok(observer.ray(axes.direction(project(right, up)))),
            Lens::Impact { spin, inclination, r, azimuth, roll: [cos, sin] } => {
                let impact = [cos * right - sin * up, sin * right + cos * up];
                Ok(impact_ray(*spin, *inclination, *r, impact)?.turned(*azimuth))
            }
        }
    }

    /// Length in M, at the distance of the hole, of a pixel at the middle of the picture.
    pub fn pixel_size(&self) -> f64 {
        self.pixel * self.scale
    }
}

/// A flat picture: screen units are tangents.
fn pinhole(right: f64, up: f64) -> Vec3<f64> {
    let length = (1.0 + right * right + up * up).sqrt();
    [right / length, up / length, 1.0 / length]
}

/// Equal angles take equal lengths along the picture's axes: first to the right, then up.
fn equal_angles(right: f64, up: f64) -> Vec3<f64> {
    let ((sin_x, cos_x), (sin_y, cos_y)) = (right.sin_cos(), up.sin_cos());
    [sin_x * cos_y, sin_y, cos_x * cos_y]
}

impl Axes {
    fn new(observer: &Observer, look_at: Option<Vec3<f64>>, (sin, cos): (f64, f64)) -> Self {
        let forward = look_at.map_or([-1.0, 0.0, 0.0], |point| observer.direction_to(point));
        // Up is −e_θ as far as the view allows; looking along it, outwards.
        let candidates = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0]];
        let right = candidates
            .iter()
            .map(|up| cross(&forward, up))
            .find(|right| dot(right, right) > 1e-18)
            .unwrap_or([0.0, 0.0, 1.0]);
        let length = dot(&right, &right).sqrt();
        let right = right.map(|c| c / length);
        let up = cross(&right, &forward);
        Self([
            std::array::from_fn(|i| cos * right[i] + sin * up[i]),
            std::array::from_fn(|i| cos * up[i] - sin * right[i]),
            forward,
        ])
    }

    fn direction(&self, screen: Vec3<f64>) -> Vec3<f64> {
        let Self([right, up, forward]) = self;
        std::array::from_fn(|i| screen[0] * right[i] + screen[1] * up[i] + screen[2] * forward[i])
    }
}
