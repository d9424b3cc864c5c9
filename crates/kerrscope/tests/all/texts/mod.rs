//! Metrics that the program knows as text.

use std::path::Path;
use std::sync::Arc;

use kerrscope::scene::Scene;
use kerrscope::spacetime::metric::LineElement;

/// A metric by its name, with some of its parameters set.
pub fn element(name: &str, parameters: &[(&str, f64)]) -> Arc<LineElement> {
    let set: Vec<String> = parameters.iter().map(|(name, value)| format!("{name} = {value:e}")).collect();
    let set = set.join(", ");
    written(&format!("name = \"{name}\"\nparameters = {{ {set} }}"))
}

/// A metric by the keys of its section.
pub fn written(keys: &str) -> Arc<LineElement> {
    let text = format!("disk.model = \"none\"\n[spacetime]\n{keys}");
    let scene = Scene::from_toml(&text, Path::new("")).unwrap_or_else(|faults| panic!("{text}\n{faults}"));
    Arc::clone(scene.spacetime.text().unwrap())
}
