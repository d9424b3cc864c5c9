//! A scene: from TOML text to what can be drawn.
//!
//! What was typed and what is valid are two types. A [`SceneFile`] holds the keys as they stand in
//! the text; a [`Scene`] is made from it by checks that find everything that is wrong at once, and
//! a scene that exists is valid.
//!
//! Text is read in five steps, each of which reports [`Fault`]s and goes on as far as it can:
//!
//! 1. `scan` cuts the text into statements and sets aside those that would harm the parser;
//! 2. `tree` parses the others into a tree that knows where everything was typed;
//! 3. `overrides` puts `--set PATH=VALUE` into the tree;
//! 4. `check` compares the tree with the schema of [`SceneFile`] and takes out what does not fit;
//! 5. `build` makes the scene, and checks what depends on several keys or on files. It says
//!    nothing of what depends on keys that were taken out.
//!
//! ```
//! use std::path::Path;
//! use kerrscope::scene::Scene;
//!
//! let scene = Scene::from_toml("spacetime.spin = 0.5\nrender.width = 400", Path::new(""))?;
//! assert_eq!(scene.spacetime.spin(), Some(0.5));
//! assert_eq!(scene.render.height, 540);
//!
//! let faults = Scene::from_toml("[spacetime]\nspin = 1.5", Path::new("")).unwrap_err();
//! assert_eq!(
//!     faults.to_string(),
//!     "scene:2:8: 1.5 is too large for `spacetime.spin`\n  \
//!      help: give a number from -1 to 1; the default is 0.99",
//! );
//! # Ok::<(), kerrscope::scene::Faults>(())
//! ```

mod build;
pub(crate) mod check;
mod draft;
pub(crate) mod fault;
pub mod file;
mod keys;
mod metric;
mod overrides;
pub(crate) mod read;
mod scan;
mod shape;
pub(crate) mod tree;
mod valid;

use std::path::Path;

use crate::units::Units;

pub use draft::Draft;
pub use fault::{Fault, Faults, Source};
pub use file::{Coordinates, SceneFile};
pub use keys::{KeyError, key};
pub use metric::{known_metric, known_metrics, metric_from_file};
pub use valid::{
    Disk, Display, Engine, Method, Object, ObjectPattern, Observer, Render, Screen, ScreenKind, Sky,
    SkyPicture, Spacetime, Surface, Target,
};

/// What to call a text that came from no file.
const UNNAMED: &str = "scene";

/// A scene that can be drawn. Angles are in radians, lengths in M.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The spacetime that light moves in.
    pub spacetime: Spacetime,
    /// Who looks.
    pub observer: Observer,
    /// What their screen shows.
    pub screen: Screen,
    /// The disk, if there is one.
    pub disk: Option<Disk>,
    /// Things that scatter light or shine.
    pub objects: Vec<Object>,
    /// What is seen where light comes from infinity.
    pub sky: Sky,
    /// The sky on the other side, where there is one.
    pub other_sky: Option<Sky>,
    /// How finely and how exactly the picture is computed.
    pub render: Render,
    /// How light becomes a picture.
    pub display: Display,
    /// What M is, and at which frequency the picture is taken.
    pub units: Units,
    /// What headers of files say of the thing that is seen.
    pub target: Target,
    /// What it was built from, complete.
    file: SceneFile,
}

impl Scene {
    /// The scene of an empty file.
    ///
    /// # Panics
    ///
    /// Never: that scene is valid.
    pub fn built_in() -> Self {
        SceneFile::default().build(Path::new("")).expect("the built-in scene is valid")
    }

    /// Reads a scene. Paths in it begin at `folder`.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with it.
    pub fn from_toml(text: &str, folder: &Path) -> Result<Self, Faults> {
        read::scene(Ok(Source::new(UNNAMED, text)), &[], folder)
    }

    /// Reads a scene from a file, or takes the built-in one, and applies overrides of the form
    /// `PATH=VALUE` in their order.
    ///
    /// Values are TOML; what is no TOML value is taken as text: `spacetime.name=minkowski`. Paths
    /// of pictures begin at the file's folder, or at the current one.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with the file and the overrides.
    pub fn load(path: Option<&Path>, overrides: &[String]) -> Result<Self, Faults> {
        match path {
            None => read::scene(Ok(Source::new("built-in scene", "")), overrides, Path::new("")),
            Some(path) => {
                let folder = path.parent().unwrap_or(Path::new(""));
                read::scene(read::file(path), overrides, folder)
            }
        }
    }

    /// Reads a scene from the record in another file, which faults call `name`, and applies
    /// overrides as [`load`](Self::load) does. Paths in it begin at `folder`.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with it.
    pub fn from_record(name: &str, text: &str, overrides: &[String], folder: &Path) -> Result<Self, Faults> {
        read::scene(Ok(Source::new(name, text)), overrides, folder)
    }

    /// The scene as it was built, with every default written out: the record of what a picture
    /// shows. Reading it gives this scene again.
    ///
    /// Changes made to the fields since are not in it: change the [`file`](Self::file) and build
    /// that.
    pub fn to_toml(&self) -> String {
        self.file.to_toml()
    }

    /// The picture files that it shows, those of things once each.
    pub fn pictures(&self) -> impl Iterator<Item = &Path> {
        let disk = self.disk.as_ref().and_then(|disk| match &disk.surface {
            Surface::Picture { path, .. } => Some(path.as_path()),
            Surface::Ring { .. } | Surface::Shining { .. } => None,
        });
        let skies = [Some(&self.sky), self.other_sky.as_ref()].into_iter().flatten();
        let skies = skies.filter_map(|sky| match &sky.picture {
            SkyPicture::Panorama { path, .. } => Some(path.as_path()),
            _ => None,
        });
        let things = self.objects.iter().filter_map(|object| match &object.pattern {
            ObjectPattern::Picture { path } => Some(path.as_path()),
            _ => None,
        });
        let things: std::collections::BTreeSet<_> = things.collect();
        disk.into_iter().chain(skies).chain(things)
    }

    /// The keys that the scene was built from, with every default.
    pub fn file(&self) -> &SceneFile {
        &self.file
    }
}

impl SceneFile {
    /// Reads the keys of a scene, each by itself: what they mean together is checked when the
    /// scene is [built](Self::build).
    ///
    /// # Errors
    ///
    /// Everything that is wrong with the text.
    pub fn from_toml(text: &str) -> Result<Self, Faults> {
        read::keys(Source::new(UNNAMED, text))
    }

    /// The scene that the keys describe. Paths in it begin at `folder`.
    ///
    /// # Errors
    ///
    /// Everything that is wrong with it; the faults are placed in [its text](Self::to_toml).
    pub fn build(&self, folder: &Path) -> Result<Scene, Faults> {
        // Values set by a program are checked as if they had been typed.
        Scene::from_toml(&self.to_toml(), folder)
    }
}
