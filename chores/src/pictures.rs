//! The pictures that documents show, each from its scene.

use super::cargo;
use std::path::Path;

/// Scene files (none: the built-in scene), what is set otherwise, and the pictures made of them.
const PICTURES: &[(Option<&str>, &[&str], &str)] = &[
    (None, &[], "scenes/built-in.png"),
    (Some("scenes/thesis-3.2.toml"), &[], "scenes/thesis-3.2.png"),
    // Smaller, so that they are no large files.
    (Some("scenes/thesis-4.2.toml"), &["render.width=720", "render.height=405"], "scenes/thesis-4.2.png"),
    (Some("scenes/thesis-4.3.toml"), &[], "scenes/thesis-4.3.png"),
    (Some("scenes/thesis-4.5.toml"), &["render.width=960", "render.height=540"], "scenes/thesis-4.5.png"),
    (Some("scenes/thesis-4.6.toml"), &[], "scenes/thesis-4.6.png"),
    (Some("scenes/thesis-4.8.toml"), &[], "scenes/thesis-4.8.png"),
    (Some("scenes/balls.toml"), &[], "scenes/balls.png"),
    (Some("scenes/balls.toml"), &["spacetime.name=minkowski"], "scenes/balls-flat.png"),
    (Some("scenes/earth.toml"), &[], "scenes/earth.png"),
    (Some("scenes/room.toml"), &[], "scenes/room.png"),
    (Some("scenes/well.toml"), &[], "scenes/well.png"),
    (Some("scenes/wormhole.toml"), &[], "scenes/wormhole.png"),
    (Some("scenes/two-holes.toml"), &[], "scenes/two-holes.png"),
];

/// Draws them all again.
pub fn draw(_root: &Path) -> Result<(), String> {
    for (scene, set, picture) in PICTURES.iter().copied() {
        let mut arguments = vec!["run", "--release", "--locked", "--", "render", "-o", picture];
        arguments.extend(set.iter().flat_map(|set| ["--set", set]));
        arguments.extend(scene);
        cargo(&arguments)?;
    }
    Ok(())
}
