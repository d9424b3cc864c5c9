//! Metrics as text by themselves, for what is no picture.

use std::path::Path;
use std::sync::Arc;

use kerrscope_spacetime::metric::LineElement;

use super::fault::{Collector, Fault, Faults, Source};
use super::file::{self, SpacetimeName};
use super::tree::Node;
use super::{build, read};

/// The names of the metrics that are known as text.
pub fn known_metrics() -> impl Iterator<Item = &'static str> {
    SpacetimeName::ALL.into_iter().filter_map(|name| Some(name.metric()?.0))
}

/// A metric that is known as text by its name, with some of its parameters set. `None` if none has that name.
///
/// # Errors
/// Everything that is wrong with the parameters.
///
/// ```
/// let found = kerrscope::scene::known_metric("kerr-newman", &[("charge".to_owned(), 0.3)]).unwrap()?;
/// assert!(found.is_stationary());
/// assert!(kerrscope::scene::known_metric("kerr", &[]).is_none());
/// # Ok::<(), kerrscope::scene::Faults>(())
/// ```
pub fn known_metric(name: &str, parameters: &[(String, f64)]) -> Option<Result<LineElement, Faults>> {
    let name =
        SpacetimeName::ALL.into_iter().find(|known| known.metric().is_some_and(|(word, _)| word == name))?;
    let keys =
        file::Spacetime { name, parameters: parameters.iter().cloned().collect(), ..Default::default() };
    Some(compile(&keys))
}

/// The metric of a file of its own, or of a scene, with some of its parameters set. It may depend on time.
///
/// # Errors
/// Everything that is wrong with it.
pub fn metric_from_file(path: &Path, parameters: &[(String, f64)]) -> Result<LineElement, Faults> {
    let source = read::file(path);
    let is_scene = |source: &Arc<Source>| {
        source.text.parse::<toml::Table>().is_ok_and(|all| all.contains_key("spacetime"))
    };
    if source.as_ref().is_ok_and(is_scene) {
        return of_scene(source, path.parent().unwrap_or(Path::new("")), parameters);
    }
    compile(&file::Spacetime {
        name: SpacetimeName::Text,
        file: Some(path.display().to_string()),
        parameters: parameters.iter().cloned().collect(),
        ..Default::default()
    })
}

fn of_scene(
    source: Result<Arc<Source>, Fault>,
    folder: &Path,
    parameters: &[(String, f64)],
) -> Result<LineElement, Faults> {
    let mut faults = Collector::default();
    let set: Vec<String> =
        parameters.iter().map(|(name, value)| format!("spacetime.parameters.{name}={value:?}")).collect();
    let (keys, root) = read::spacetime(source, &set, &mut faults);
    let built_in = [SpacetimeName::Kerr, SpacetimeName::Schwarzschild, SpacetimeName::Minkowski];
    if faults.is_empty() && built_in.contains(&keys.name) {
        let place = root.at("spacetime.name").unwrap_or(&root).place.clone();
        let mend = "give the name of a geometry that is built in instead of a file";
        faults.push(&place, || {
            ("the spacetime of this scene is no metric as text".to_owned(), mend.to_owned())
        });
    }
    let element =
        if faults.is_empty() { build::line_element(&keys, &root, folder, &mut faults) } else { None };
    faults.finish(()).map(|()| element.expect("a metric without a fault"))
}

fn compile(keys: &file::Spacetime) -> Result<LineElement, Faults> {
    let mut faults = Collector::default();
    let root = Node::empty(&Source::new("parameters", ""));
    let element = build::line_element(keys, &root, Path::new(""), &mut faults);
    faults.finish(()).map(|()| element.expect("a metric without a fault"))
}
