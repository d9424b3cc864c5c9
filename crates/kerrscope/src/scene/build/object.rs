//! Things in the scene.

use kerrscope_spacetime::geodesic::EXIT;
use kerrscope_spacetime::kerr::{Orbits, ergosphere, horizons};
use kerrscope_spacetime::metric::{Kerr, Metric};
use kerrscope_spacetime::observer::Drift;

use super::{Builder, readable};
use crate::material::Finish;
use crate::objects::{Flat, Shape, Sphere};
use crate::scene::file::{
    self, OBJECT_SHAPE_USES, OBJECT_TEXTURE_USES, ObjectMotion, ObjectMotionName, ShapeName, TextureKind,
};
use crate::scene::valid::{Object, ObjectPattern, Spacetime};

/// The most things in a scene.
const MOST: usize = 100_000;

/// Distance from the origin, in M, beyond which neither the static limit (r ≤ 2) nor 1.1 horizons (r ≤ 2.2) can be:
/// √(2.2² + 1) and more.
const FAR: f64 = 2.5;

impl Builder<'_> {
    pub(super) fn objects(&mut self, all: &[file::Object], spacetime: &Spacetime) -> Vec<Object> {
        if all.len() > MOST {
            let what = format!("there are {} things in the scene, and {MOST} are the most", all.len());
            self.fault(&["object"], what, "leave some out");
            return Vec::new();
        }
        all.iter()
            .enumerate()
            .filter_map(|(i, file)| self.object(&format!("object[{i}]"), file, spacetime))
            .collect()
    }

    fn object(&mut self, path: &str, file: &file::Object, spacetime: &Spacetime) -> Option<Object> {
        self.unused_of_object(path, file);
        let pattern = self.pattern(path, &file.texture);
        let shape = self.shape(path, file)?;
        let drift = self.drift(path, file, &shape, spacetime)?;
        Some(Object {
            shape,
            finish: file.material,
            color: file.color.unwrap_or_default(),
            brightness: file.brightness.unwrap_or(1.0),
            pattern,
            drift,
        })
    }

    /// What is typed and has no effect.
    fn unused_of_object(&mut self, path: &str, file: &file::Object) {
        for (key, shapes) in OBJECT_SHAPE_USES {
            let key = format!("{path}.{key}");
            if !shapes.contains(&file.shape) && self.root.at(&key).is_some() {
                self.unused(&key, &format!("{path}.shape"), shapes);
            }
        }
        for (key, kinds) in OBJECT_TEXTURE_USES {
            let key = format!("{path}.texture.{key}");
            if !kinds.contains(&file.texture.kind) && self.root.at(&key).is_some() {
                self.unused(&key, &format!("{path}.texture.kind"), kinds);
            }
        }
        let key = format!("{path}.brightness");
        if file.material != Finish::Light && self.root.at(&key).is_some() {
            self.unused(&key, &format!("{path}.material"), &[Finish::Light]);
        }
    }

    /// A value that a shape needs.
    fn needed<T: Copy>(&mut self, path: &str, key: &str, shape: ShapeName, value: Option<T>) -> Option<T> {
        if value.is_none() {
            let shape = serde_json::json!(shape);
            let key = format!("{path}.{key}");
            self.fault(
                &[&key, &format!("{path}.shape"), path],
                format!("`shape = {shape}` needs `{key}`, which is not given"),
                format!("give `{key}`"),
            );
        }
        value
    }

    fn shape(&mut self, path: &str, file: &file::Object) -> Option<Shape> {
        match file.shape {
            ShapeName::Sphere => {
                let center = self.needed(path, "center", file.shape, file.center);
                let radius = self.needed(path, "radius", file.shape, file.radius);
                let axes = Sphere::axes(file.rotation.unwrap_or_default().map(f64::to_radians));
                Some(Shape::Sphere(Sphere { center: center?, radius: radius?, axes }))
            }
            ShapeName::Parallelogram => {
                let corner = self.needed(path, "corner", file.shape, file.corner);
                let edges = self.needed(path, "edges", file.shape, file.edges);
                let (corner, edges) = (corner?, edges?);
                let flat = Flat::parallelogram(corner, edges);
                if flat.is_none() {
                    self.fault(
                        &[&format!("{path}.edges")],
                        "a parallelogram with these edges has no area",
                        "give two edges that point in different directions",
                    );
                }
                flat.map(Shape::Flat)
            }
            ShapeName::Annulus => {
                let center = self.needed(path, "center", file.shape, file.center);
                let outer = self.needed(path, "outer", file.shape, file.outer);
                let (center, outer) = (center?, outer?);
                let (normal, inner) = (file.normal.unwrap_or_default(), file.inner.unwrap_or_default());
                if normal == [0.0; 3] {
                    let key = format!("{path}.normal");
                    self.fault(
                        &[&key],
                        "a normal of length 0 has no direction",
                        "give it a direction, such as [0, 0, 1]",
                    );
                    return None;
                }
                if inner >= outer {
                    self.fault(
                        &[&format!("{path}.outer"), &format!("{path}.inner")],
                        format!("the outer radius {outer} is not more than the inner radius {inner}"),
                        format!("give `{path}.outer` more than {inner}, or a smaller `{path}.inner`"),
                    );
                    return None;
                }
                Flat::annulus(center, normal, [inner, outer]).map(Shape::Flat)
            }
        }
    }

    fn pattern(&mut self, path: &str, file: &file::Texture) -> ObjectPattern {
        let second = file.color.unwrap_or_default();
        match file.kind {
            TextureKind::Solid => ObjectPattern::Solid,
            TextureKind::Checker => {
                ObjectPattern::Checker { second, squares: file.squares.unwrap_or_default() }
            }
            TextureKind::Image => ObjectPattern::Picture {
                path: self.picture(
                    &format!("{path}.texture.path"),
                    &format!("{path}.texture.kind"),
                    "image",
                    file.path.as_deref(),
                ),
            },
            TextureKind::Earth => ObjectPattern::Earth,
            TextureKind::Noise => ObjectPattern::Noise {
                second,
                size: file.size.unwrap_or(1.0),
                seed: file.seed.unwrap_or_default(),
            },
        }
    }

    /// The motion, if it is possible for all of the thing.
    fn drift(
        &mut self,
        path: &str,
        file: &file::Object,
        shape: &Shape,
        spacetime: &Spacetime,
    ) -> Option<Drift> {
        let motion = format!("{path}.motion");
        let place = ["center", "corner"].map(|key| format!("{path}.{key}"));
        let keys = [&*motion, &*place[0], &*place[1], path, "spacetime.spin", "spacetime.name"];
        let drift = match file.motion {
            ObjectMotion::Named(ObjectMotionName::Static) => Drift::Static,
            ObjectMotion::Velocity(velocity) => {
                let speed = velocity.iter().map(|c| c * c).sum::<f64>().sqrt();
                if !(speed < 1.0) {
                    self.fault(
                        &[&motion],
                        format!("the speed {speed} is not below that of light (1)"),
                        "give a velocity [r, θ, φ] in units of c whose length is below 1",
                    );
                    return None;
                }
                Drift::Velocity(velocity)
            }
            ObjectMotion::Named(ObjectMotionName::Orbit) => {
                Drift::Turning(self.orbit(&keys, shape.bounds().middle(), spacetime)?)
            }
        };
        let at_any_speed = |x| spacetime.clearance(x, Drift::Velocity([0.0; 3]));
        let as_it_moves = |x| spacetime.clearance(x, drift);
        let turning = matches!(drift, Drift::Turning(_));
        let Some(spin) = spacetime.spin() else {
            if spacetime.is_flat() {
                return Some(drift);
            }
            let (a, outside) = shape.tightest(at_any_speed, false);
            let (b, slow) = shape.tightest(as_it_moves, turning);
            if outside > 0.0 && slow > 0.0 {
                return Some(drift);
            }
            let [x, y, z] = if outside > 0.0 { b } else { a };
            self.fault(
                &keys[1..],
                format!("no matter can be at [{x:.3}, {y:.3}, {z:.3}] and move so: the metric has no value there, light does not come from there, or it would be as fast as light"),
                "move the thing outwards, make it smaller, or give it another motion",
            );
            return None;
        };
        let bounds = shape.bounds();
        let near = bounds.nearest() < FAR;
        if !near && !turning {
            return Some(drift);
        }
        let keys = &keys[1..];
        let horizon = horizons(spin).0;
        // How far from the hole it is, by the clearance of what moves with any velocity: r − r₊.
        let (point, height) = shape.tightest(at_any_speed, false);
        let limit = EXIT * horizon;
        if near && height + horizon <= limit {
            let at = readable(height + horizon);
            let limit = readable(limit);
            self.fault(
                keys,
                format!("the thing reaches down to r = {at} M, and things have to be outside of r = {limit} M, 1.1 horizon radii"),
                "move it outwards, or make it smaller",
            );
            return None;
        }
        let (point, clearance) = match drift {
            Drift::Velocity(_) => (point, height),
            _ => shape.tightest(as_it_moves, turning),
        };
        if clearance > 0.0 {
            return Some(drift);
        }
        let [x, y, z] = point;
        let r = Kerr::new(spin).radius(&point);
        let at = format!("r = {} M, at [{x:.3}, {y:.3}, {z:.3}]", readable(r));
        if drift == Drift::Static {
            let limit = readable(ergosphere(spin, (z / r).clamp(-1.0, 1.0).acos()));
            self.fault(
                keys,
                format!("nothing is static at {at}: the static limit there is r = {limit} M"),
                format!("move the thing outwards, or set `{motion}` to \"orbit\" or a velocity"),
            );
        } else {
            self.fault(
                keys,
                format!("turning as one with its middle, the thing would be as fast as light at {at}"),
                "make it smaller, or move it outwards",
            );
        }
        None
    }

    /// Ω of the circular orbit through a point.
    fn orbit(&mut self, keys: &[&str], [x, y, z]: [f64; 3], spacetime: &Spacetime) -> Option<f64> {
        let Some(spin) = spacetime.spin() else {
            let what = if spacetime.is_flat() {
                "nothing orbits in flat space"
            } else {
                "orbits of things are known around Kerr holes only, and this spacetime is a metric of its own"
            };
            self.fault(keys, what, "choose another motion, such as \"static\"");
            return None;
        };
        let r = Kerr::new(spin).radius(&[x, y, z]);
        if z.abs() > 1e-6 * r {
            self.fault(
                keys,
                format!(
                    "a circular orbit lies in the equatorial plane, and the thing's middle is at z = {z} M"
                ),
                "move the thing so that its middle is at z = 0, or choose another motion",
            );
            return None;
        }
        let photon = Orbits::new(spin).photon_prograde;
        if r <= photon {
            self.fault(
                keys,
                format!("no circular orbit of matter about +z exists at the thing's middle, r = {r:.6} M: the photon orbit is at r = {photon:.6} M"),
                format!("move its middle beyond r = {}, or choose another motion", readable(photon)),
            );
            return None;
        }
        // Bardeen, Press & Teukolsky 1972, eq. 2.16.
        Some(1.0 / (r * r.sqrt() + spin))
    }
}
