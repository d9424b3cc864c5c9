//! The steps from text to a scene, and their order.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::sync::{Arc, LazyLock};

use super::fault::{Collector, Fault, Faults, Place, Source};
use super::file::Spacetime;
use super::tree::{self, Node};
use super::{Scene, SceneFile, build, check, overrides, shape};

/// The most bytes that a scene may have.
const MAX_BYTES: usize = 8 << 20;

static SCHEMA: LazyLock<serde_json::Value> = LazyLock::new(SceneFile::schema);

/// Reads the keys of a scene, each by itself.
pub(super) fn keys(source: Arc<Source>) -> Result<SceneFile, Faults> {
    let mut faults = Collector::default();
    let typed = type_in(Ok(source), (GIVEN, &[]), &mut faults);
    faults.finish(typed.file)
}

/// Reads a metric's file: the keys of `[spacetime]`, at its top, and where they stand. None if it could not be read whole.
pub(super) fn metric(source: &Arc<Source>, faults: &mut Collector) -> Option<(Spacetime, Node)> {
    faults.add_source(source);
    let before = faults.len();
    let (mut root, complete) = tree::parse(source, faults);
    let schema = shape::property(&SCHEMA, "spacetime")?;
    check::check(&mut root, schema, faults);
    let keys = root.to_toml().try_into().ok()?;
    (complete && faults.len() == before).then_some((keys, root))
}

/// Reads the spacetime of a scene, and where its keys stand.
pub(super) fn spacetime(
    source: Result<Arc<Source>, Fault>,
    overrides: &[String],
    faults: &mut Collector,
) -> (Spacetime, Node) {
    let Typed { file, root, .. } = type_in(source, (GIVEN, overrides), faults);
    (file.spacetime, root)
}

/// What overrides are called that stand on a command line.
const GIVEN: &str = "--set";

/// Reads a scene.
pub(super) fn scene(
    source: Result<Arc<Source>, Fault>,
    overrides: &[String],
    folder: &Path,
) -> Result<Scene, Faults> {
    varied(source, (GIVEN, overrides), folder)
}

/// Reads a scene; faults call the overrides by a name and their number, from 1.
pub(crate) fn varied(
    source: Result<Arc<Source>, Fault>,
    overrides: (&str, &[String]),
    folder: &Path,
) -> Result<Scene, Faults> {
    let mut faults = Collector::default();
    let Typed { file, root, mut removed, complete } = type_in(source, overrides, &mut faults);
    if !complete {
        // Any key may be among what could not be read.
        removed.push(String::new());
    }
    let scene = build::build(&file, &root, &removed, folder, &mut faults);
    faults.finish(scene)
}

struct Typed {
    file: SceneFile,
    /// What was typed and was good.
    root: Node,
    /// The keys of what was not good.
    removed: Vec<String>,
    /// Whether all of the text could be read, so that it is known which keys it gives.
    complete: bool,
}

fn type_in(
    source: Result<Arc<Source>, Fault>,
    (name, overrides): (&str, &[String]),
    faults: &mut Collector,
) -> Typed {
    let source = source.and_then(|source| match source.text.len() {
        0..=MAX_BYTES => Ok(source),
        _ => Err(too_large(&source.name)),
    });
    let (mut root, mut complete) = match source {
        Ok(source) => {
            faults.add_source(&source);
            tree::parse(&source, faults)
        }
        Err(fault) => {
            let Fault { source, span, message, help } = fault;
            faults.add_source(&source);
            let root = Node::empty(&source);
            faults.push(&Place { source, span }, || (message, help));
            (root, false)
        }
    };
    for (i, text) in overrides.iter().enumerate() {
        complete &= overrides::merge(&mut root, text, &format!("{name} #{}", i + 1), faults);
    }
    let removed = check::check(&mut root, &SCHEMA, faults);
    let file = root.to_toml().try_into().unwrap_or_else(|error: toml::de::Error| {
        // The schema and the types are one definition, so that the check has found this too.
        let text = || (error.message().to_owned(), "compare with `kerrscope schema`".to_owned());
        faults.push(&root.place, text);
        SceneFile::default()
    });
    Typed { file, root, removed, complete }
}

/// Reads a scene file.
pub(crate) fn file(path: &Path) -> Result<Arc<Source>, Fault> {
    let name = path.display().to_string();
    let fault = |message: String, help: &str| Fault {
        source: Source::new(name.as_str(), ""),
        span: None,
        message,
        help: help.to_owned(),
    };
    let unreadable = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => fault("there is no such file".to_owned(), "check the path"),
        ErrorKind::IsADirectory => fault("this is a folder".to_owned(), "give the scene file within it"),
        _ => fault(format!("it cannot be read: {error}"), "check the path and its permissions"),
    };
    let mut bytes = Vec::new();
    // One byte more than allowed tells that there is more; a device has no size to ask for.
    let mut file = File::open(path).map_err(unreadable)?.take(MAX_BYTES as u64 + 1);
    file.read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() > MAX_BYTES {
        return Err(too_large(&name));
    }
    String::from_utf8(bytes).map(|text| Source::new(name.as_str(), text)).map_err(|error| {
        let good = error.utf8_error().valid_up_to();
        // What is good keeps its place when the rest is replaced.
        let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
        Fault {
            source: Source::new(name.as_str(), text),
            span: Some(good..good + char::REPLACEMENT_CHARACTER.len_utf8()),
            message: "this is not text in UTF-8".to_owned(),
            help: "save the file in UTF-8, or check that it is a scene file".to_owned(),
        }
    })
}

fn too_large(name: &str) -> Fault {
    Fault {
        source: Source::new(name, ""),
        span: None,
        message: format!("it is larger than {} MiB", MAX_BYTES >> 20),
        help: "a scene is some kilobytes of text, with a hundred thousand things some megabytes: check that this is the right file".to_owned(),
    }
}
