//! The pictures that documents show, each from its scene.

use super::cargo;
use std::path::Path;

/// Scene files (none: the built-in scene) and the pictures made of them.
const PICTURES: [(Option<&str>, &str); 3] = [
    (None, "scenes/built-in.png"),
    (Some("scenes/thesis-4.6.toml"), "scenes/thesis-4.6.png"),
    (Some("scenes/thesis-4.8.toml"), "scenes/thesis-4.8.png"),
];

/// Draws them all again.
pub fn draw(_root: &Path) -> Result<(), String> {
    for (scene, picture) in PICTURES {
        let mut arguments = vec!["run", "--release", "--locked", "--", "render", "-o", picture];
        arguments.extend(scene);
        cargo(&arguments, &[])?;
    }
    Ok(())
}
