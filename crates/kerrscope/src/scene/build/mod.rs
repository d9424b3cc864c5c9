//! From a scene as typed to a valid one: what depends on several keys, or on files.

mod chart;
mod coordinates;
mod disk;
mod display;
mod object;
mod observer;
mod screen;
mod sky;
mod spacetime;
mod target;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use kerrscope_spacetime::metric::LineElement;
use kerrscope_spacetime::observer::Place;
use serde::Serialize;

use super::fault::{Collector, one_line};
use super::file::{self, Coordinates, DiskModel, SceneFile};
use super::tree::Node;
use super::valid::{Disk, Engine, Method, Render, Spacetime};
use super::{Scene, shape};
use crate::render::Layer;
use crate::units::Units;

/// The largest number of rays in a picture: width × height × samples.
const MAX_RAYS: u64 = 1 << 36;

/// Samples of a pixel from which on interpolation between rays pays.
const ADAPTIVE_SAMPLES: u32 = 4;

/// Builds a scene. What cannot be is reported, and something possible put in its place, so that
/// all of it is found; the scene is good only if nothing was reported.
///
/// `removed` are the keys whose values were already found wrong: nothing is said of what
/// depends on them.
pub(super) fn build(
    typed: &SceneFile,
    root: &Node,
    removed: &[String],
    folder: &Path,
    faults: &mut Collector,
) -> Scene {
    let mut file = typed.complete();
    let mut builder = Builder { root, removed: removed.to_vec(), folder, faults };
    let spacetime;
    (spacetime, file.spacetime) = builder.spacetime(&file.spacetime);
    let observer = builder.observer(&file, &spacetime);
    let disk = builder.disk(&file.disk, &spacetime, (&file.units).into());
    let render = builder.render(&file, &spacetime, observer.place, disk.as_ref());
    Scene {
        observer,
        screen: builder.screen(&file.screen, &spacetime, observer),
        disk,
        objects: builder.objects(&file.object, &spacetime),
        sky: builder.sky(&file.sky, "sky"),
        other_sky: builder.other_sky(&file, &spacetime),
        render,
        display: builder.display(&file.camera.display),
        units: builder.units(&file.units),
        target: builder.target(&file.target),
        spacetime,
        file,
    }
}

/// Compiles a metric as text; what is wrong with it is reported.
pub(super) fn line_element(
    keys: &file::Spacetime,
    root: &Node,
    folder: &Path,
    faults: &mut Collector,
) -> Option<LineElement> {
    Builder { root, removed: Vec::new(), folder, faults }.line_element(keys)
}

struct Builder<'a> {
    root: &'a Node,
    removed: Vec<String>,
    folder: &'a Path,
    faults: &'a mut Collector,
}

/// The keys that fix the spacetime.
const SPACETIME: [&str; 2] = ["spacetime.spin", "spacetime.name"];

/// The largest angle of M on the sky, in radians, at which a picture is a small piece of it.
const WIDEST: f64 = 1e-3;

impl Builder<'_> {
    /// A hole that is far away, as units on the sky are for.
    fn units(&mut self, file: &file::Units) -> Units {
        let units = Units::from(file);
        if let Some(angle) = units.radians().filter(|angle| *angle > WIDEST) {
            self.fault(
                &["units.distance", "units.mass"],
                format!(
                    "at that distance M has an angle of {angle:.1e} radians on the sky, and {WIDEST} are the most"
                ),
                "give `units.mass` in solar masses and `units.distance` in pc, such as 6.5e9 and 16.8e6",
            );
        }
        units
    }

    /// Reports what is wrong with several keys together, at the first of them that was typed.
    fn fault(&mut self, keys: &[&str], what: impl Into<String>, mend: impl Into<String>) {
        let within = |inner: &str, outer: &str| {
            inner
                .strip_prefix(outer)
                .is_some_and(|rest| outer.is_empty() || rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let doubtful =
            |key: &str| self.removed.iter().any(|removed| within(key, removed) || within(removed, key));
        if keys.iter().any(|key| doubtful(key)) {
            return;
        }
        let node = keys.iter().find_map(|key| self.root.at(key)).unwrap_or(self.root);
        let place = node.place.clone();
        self.faults.push(&place, || (what.into(), mend.into()));
    }

    fn render(
        &mut self,
        scene: &SceneFile,
        spacetime: &Spacetime,
        place: Place,
        disk: Option<&Disk>,
    ) -> Render {
        let (file, shown) = (&scene.render, scene.camera.display.layer);
        let layers: BTreeSet<Layer> = file.layers.iter().copied().chain(shown).collect();
        let rays = u64::from(file.width) * u64::from(file.height) * u64::from(file.samples);
        if rays > MAX_RAYS {
            let pixels = u64::from(file.width) * u64::from(file.height);
            let (width, height) = (file.width, file.height);
            self.fault(
                &["render.samples", "render.width", "render.height"],
                format!(
                    "{width} × {height} pixels of {} samples are {rays} rays, \
                     and {MAX_RAYS} are the most",
                    file.samples
                ),
                format!("at this size `render.samples` can be {}", MAX_RAYS / pixels),
            );
        }
        if file.step.is_some() && file.method != Method::Rk4 {
            self.fault(
                &["render.step", "render.method"],
                "`render.step` is for `method = \"rk4\"` only; the others choose their steps",
                "remove it and use `render.tolerance`, or choose `render.method = \"rk4\"`",
            );
        }
        if file.method == Method::Rk4 && place.r.is_infinite() {
            self.fault(
                &["render.method", "observer.distance"],
                "`method = \"rk4\"` takes steps of a fixed length and cannot come in from infinity",
                "choose `render.method = \"dop853\"` or \"tsit5\", or give `observer.distance` a finite number",
            );
        }
        self.render_text(scene, spacetime, disk, &layers);
        let coordinates = self.light_coordinates(scene, spacetime, place);
        let engine = self.engine(scene, spacetime, coordinates);
        // Straight rays are faster than interpolation; whoever asks for a method's steps wants to see its errors.
        let pays = *spacetime != Spacetime::Minkowski
            && file.method == Method::Dop853
            && file.samples >= ADAPTIVE_SAMPLES;
        let things = !scene.object.is_empty();
        if things && file.adaptive == Some(true) {
            self.fault(
                &["render.adaptive", "object"],
                "a scene with things is not interpolated between rays: light is scattered on many ways",
                "remove `render.adaptive`, or the things",
            );
        }
        let needs_rays = disk.is_some_and(Disk::needs_rays);
        if needs_rays && file.adaptive == Some(true) {
            self.fault(
                &["render.adaptive", "disk.model"],
                "a disk whose light is shifted, or seen by orders or at a time, is not interpolated between rays",
                "remove `render.adaptive`",
            );
        }
        let adaptive = !things && !needs_rays && file.adaptive.unwrap_or(pays);
        Render {
            width: file.width,
            height: file.height,
            samples: file.samples,
            seed: file.seed,
            jitter: file.jitter,
            engine,
            coordinates,
            method: file.method,
            tolerance: file.tolerance,
            step: file.step.unwrap_or(file::RK4_STEP),
            max_steps: file.max_steps,
            max_crossings: file.max_crossings,
            bounces: file.bounces,
            shifts: file.shifts,
            adaptive: adaptive.then_some(file.adaptive_error),
            layers: layers.into_iter().collect(),
        }
    }

    /// What cannot be done with a metric of which nothing but its components is known.
    fn render_text(
        &mut self,
        scene: &SceneFile,
        spacetime: &Spacetime,
        disk: Option<&Disk>,
        layers: &BTreeSet<Layer>,
    ) {
        let Some(element) = spacetime.text() else { return };
        if scene.render.method == Method::Rk4 && (element.has_throat() || element.outer().is_finite()) {
            self.fault(
                &["render.method", "spacetime.name"],
                "`method = \"rk4\"` does not go through a throat, and not to the end of space at `outer`",
                "choose `render.method = \"dop853\"` or \"tsit5\"",
            );
        }
        if layers.contains(&Layer::G) && disk.is_some_and(|disk| disk.orbits.is_none()) {
            self.fault(
                &["render.layers", "camera.display.layer", "disk.inner"],
                "the layer \"g\" is that of matter in orbit, and orbits in this metric are looked for only if the disk needs them",
                "set `disk.inner = \"isco\"`, or choose a model that shines, such as `disk.model = \"power-law\"`",
            );
        }
        if disk.is_some_and(|disk| disk.time.is_some()) {
            self.fault(
                &["disk.time", "spacetime.name"],
                "how long light takes is known around Kerr holes only, and this spacetime is a text",
                "leave out `disk.time`",
            );
        }
        let unknown = if disk.is_some() {
            vec![Layer::T, Layer::Windings]
        } else {
            vec![Layer::T, Layer::G, Layer::Windings]
        };
        for layer in unknown.into_iter().filter(|layer| layers.contains(layer)) {
            self.fault(
                &["render.layers", "camera.display.layer", "spacetime.name"],
                format!(
                    "the layer \"{}\" is computed around Kerr holes only, and this spacetime is a text",
                    layer.word()
                ),
                "leave it out",
            );
        }
    }

    /// The engine, chosen if the scene leaves it open.
    fn engine(&mut self, scene: &SceneFile, spacetime: &Spacetime, coordinates: Coordinates) -> Engine {
        let tilted = scene.disk.model != DiskModel::None && scene.disk.tilt != 0.0;
        let method = scene.render.method;
        let reason = if spacetime.text().is_some() {
            Some((
                &["render.engine", "spacetime.name"][..],
                "the closed form is for Kerr holes, and this spacetime is a text",
                "remove `render.engine`",
            ))
        } else if *spacetime == Spacetime::Minkowski {
            Some((
                &["render.engine", "spacetime.name"][..],
                "flat space has straight rays, not those of the closed form",
                "remove `render.engine`",
            ))
        } else if coordinates != Coordinates::KerrSchild {
            Some((
                &["render.engine", "spacetime.chart"][..],
                "the closed form has no coordinates to choose: `spacetime.chart` is for the integrator",
                "choose `render.engine = \"integrator\"`, or remove `spacetime.chart`",
            ))
        } else if tilted {
            Some((
                &["render.engine", "disk.tilt"][..],
                "the closed form finds crossings of the equatorial plane only, and the disk is tilted",
                "choose `render.engine = \"integrator\"`, or set `disk.tilt = 0`",
            ))
        } else if !scene.object.is_empty() {
            Some((
                &["render.engine", "object"][..],
                "the closed form goes from one crossing of the plane to the next, and does not see things on the way",
                "choose `render.engine = \"integrator\"`, or remove the things",
            ))
        } else if method != Method::Dop853 {
            Some((
                &["render.engine", "render.method"][..],
                "the closed form does not integrate: `render.method` is for the integrator",
                "choose `render.engine = \"integrator\"`, or remove `render.method`",
            ))
        } else {
            None
        };
        match (scene.render.engine, reason) {
            (Engine::ClosedForm, Some((keys, what, mend))) => {
                self.fault(keys, what, mend);
                Engine::Integrator
            }
            (Engine::Auto, None) => Engine::ClosedForm,
            (Engine::Auto, Some(_)) => Engine::Integrator,
            (engine, _) => engine,
        }
    }

    /// A key that the chosen kind takes no notice of, but those wanted would.
    fn unused(&mut self, key: &str, chooser: &str, wanted: &[impl Serialize]) {
        // JSON quotes words as TOML does.
        let words = wanted.iter().map(|word| serde_json::json!(word));
        let choices: Vec<String> = words
            .enumerate()
            .map(|(i, word)| if i == 0 { format!("`{chooser} = {word}`") } else { word.to_string() })
            .collect();
        let choices = shape::either(&choices);
        self.fault(
            &[key, chooser],
            format!("`{key}` is used with {choices} only"),
            format!("set {choices}, or remove `{key}`"),
        );
    }

    /// The path of a picture that the chosen kind needs.
    fn picture(&mut self, key: &str, chooser: &str, kind: &str, image: Option<&str>) -> PathBuf {
        let Some(image) = image else {
            self.fault(
                &[chooser, key],
                format!("`{chooser} = \"{kind}\"` needs a picture, and `{key}` is not given"),
                format!("give `{key}` the path of a PNG, JPEG, TIFF, WebP, HDR or EXR file"),
            );
            return PathBuf::new();
        };
        let path = self.folder.join(image);
        let what = match std::fs::metadata(&path) {
            Ok(about) if about.is_file() => return path,
            Ok(about) if about.is_dir() => "is a folder, not a picture".to_owned(),
            Ok(_) => "is not a regular file".to_owned(),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => "does not exist".to_owned(),
            Err(error) => format!("cannot be read: {error}"),
        };
        let folder = match self.folder.to_string_lossy() {
            folder if folder.is_empty() => "the current folder".to_owned(),
            folder => folder.into_owned(),
        };
        let shown = one_line(&path.display().to_string(), 300);
        self.fault(
            &[key],
            format!("the picture {shown} {what}"),
            format!("`{key}` is a file's path from the folder of the scene, {folder}"),
        );
        path
    }
}

/// A bound in a message with six decimals, rounded up so that what is above it is allowed.
fn readable(bound: f64) -> String {
    shape::readable((bound * 1e6).ceil() / 1e6)
}
