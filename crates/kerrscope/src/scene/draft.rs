//! A scene as it was typed, to be changed and read again.

use std::path::{Path, PathBuf};

use super::fault::Faults;
use super::{Scene, UNNAMED, read};

/// The text of a scene and what is to be changed in it. Defaults are not written out, so that a change goes with those of the other keys.
///
/// ```
/// use kerrscope::scene::Draft;
/// let mut draft = Draft::new("spacetime.spin = 0.5", "");
/// draft.set("render.width", "400");
/// draft.set("render.width", "200");
/// assert_eq!(draft.overrides, ["render.width=200"]);
/// assert_eq!(draft.scene()?.render.width, 200);
/// draft.unset("spacetime.spin");
/// assert_eq!(draft.scene()?.spacetime.spin(), Some(0.99));
/// # Ok::<(), kerrscope::scene::Faults>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draft {
    /// What faults call the text.
    pub name: String,
    /// The text.
    pub text: String,
    /// Changes `PATH=VALUE`, later ones after earlier ones.
    pub overrides: Vec<String>,
    /// Where paths begin.
    pub folder: PathBuf,
}

impl Draft {
    /// A text that came from no file.
    pub fn new(text: impl Into<String>, folder: impl Into<PathBuf>) -> Self {
        Self { name: UNNAMED.to_owned(), text: text.into(), overrides: Vec::new(), folder: folder.into() }
    }

    /// A scene file.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn open(path: &Path) -> Result<Self, Faults> {
        let source = read::file(path)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Ok(Self { name: source.name.clone(), text: source.text.clone(), overrides: Vec::new(), folder })
    }

    /// Changes a key to a value in TOML. An earlier change of the same key, or of one within it, is forgotten.
    pub fn set(&mut self, path: &str, value: &str) {
        self.forget(path);
        self.overrides.push(format!("{path}={value}"));
    }

    /// Takes a key away, so that its default counts. If the text has it, the text is written anew, without comments.
    pub fn unset(&mut self, path: &str) {
        self.forget(path);
        let Ok(mut table) = self.text.parse::<toml::Table>() else { return };
        let (last, sections) = match path.rsplit_once('.') {
            Some((sections, last)) => (last, sections.split('.').collect()),
            None => (path, Vec::new()),
        };
        let within = sections.iter().try_fold(&mut table, |table, name| table.get_mut(*name)?.as_table_mut());
        if within.and_then(|table| table.remove(last)).is_some() {
            self.text = table.to_string();
        }
    }

    /// Forgets changes of a key, and of those within it.
    fn forget(&mut self, path: &str) {
        let within = |change: &String| {
            let key = change.split('=').next().unwrap_or_default().trim();
            key.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        self.overrides.retain(|change| !within(change));
    }

    /// The scene.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn scene(&self) -> Result<Scene, Faults> {
        Scene::from_record(&self.name, &self.text, &self.overrides, &self.folder)
    }
}
