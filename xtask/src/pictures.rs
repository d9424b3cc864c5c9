//! The pictures that documents show, each from its scene.

use super::cargo;
use std::path::Path;

/// Scene files (none: the built-in scene), what is set otherwise, and the pictures made of them.
const PICTURES: [(Option<&str>, &[&str], &str); 6] = [
    (None, &[], "scenes/built-in.png"),
    // Half as large, so that it is no large file.
    (Some("scenes/thesis-4.5.toml"), &["render.width=960", "render.height=540"], "scenes/thesis-4.5.png"),
    (Some("scenes/thesis-4.6.toml"), &[], "scenes/thesis-4.6.png"),
    (Some("scenes/thesis-4.8.toml"), &[], "scenes/thesis-4.8.png"),
    (Some("scenes/wormhole.toml"), &[], "scenes/wormhole.png"),
    (Some("scenes/two-holes.toml"), &[], "scenes/two-holes.png"),
];

/// Draws them all again.
pub fn draw(_root: &Path) -> Result<(), String> {
    for (scene, set, picture) in PICTURES {
        let mut arguments = vec!["run", "--release", "--locked", "--", "render", "-o", picture];
        arguments.extend(set.iter().flat_map(|set| ["--set", set]));
        arguments.extend(scene);
        cargo(&arguments, &[])?;
    }
    Ok(())
}
