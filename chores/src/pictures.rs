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
    (Some("scenes/thesis-5.1a.toml"), &[], "scenes/thesis-5.1a.png"),
    (Some("scenes/thesis-5.1b.toml"), &[], "scenes/thesis-5.1b.png"),
    (Some("scenes/balls.toml"), &[], "scenes/balls.png"),
    (Some("scenes/balls.toml"), &["spacetime.name=minkowski"], "scenes/balls-flat.png"),
    (Some("scenes/earth.toml"), &[], "scenes/earth.png"),
    (Some("scenes/room.toml"), &[], "scenes/room.png"),
    (Some("scenes/well.toml"), &[], "scenes/well.png"),
    (Some("scenes/wormhole.toml"), &[], "scenes/wormhole.png"),
    (Some("scenes/thesis-4.8-physics.toml"), &[], "scenes/thesis-4.8-physics.png"),
    (Some("scenes/gallery/disk.toml"), &[], "scenes/gallery/disk.png"),
    (Some("scenes/gallery/disk.toml"), &["disk.doppler=false"], "scenes/gallery/no-doppler.png"),
    (Some("scenes/gallery/disk.toml"), &["disk.gravitational=false"], "scenes/gallery/no-gravity.png"),
    (Some("scenes/gallery/disk.toml"), &["disk.beaming=false"], "scenes/gallery/no-beaming.png"),
    (
        Some("scenes/gallery/disk.toml"),
        &["disk.doppler=false", "disk.gravitational=false"],
        "scenes/gallery/no-shift.png",
    ),
    (
        Some("scenes/gallery/disk.toml"),
        &["disk.orders=[0]", "disk.optically_thin=true", "disk.beaming=false"],
        "scenes/gallery/order-0.png",
    ),
    (
        Some("scenes/gallery/disk.toml"),
        &["disk.orders=[1]", "disk.optically_thin=true", "disk.beaming=false"],
        "scenes/gallery/order-1.png",
    ),
    (
        Some("scenes/gallery/disk.toml"),
        &["disk.orders=[2]", "disk.optically_thin=true", "disk.beaming=false"],
        "scenes/gallery/order-2.png",
    ),
    (Some("scenes/gallery/disk.toml"), &["disk.optically_thin=true"], "scenes/gallery/thin.png"),
    (
        Some("scenes/gallery/disk.toml"),
        &["disk.turns=retrograde", "camera.display.exposure=-1"],
        "scenes/gallery/retrograde.png",
    ),
    (Some("scenes/gallery/disk.toml"), &["disk.light=bolometric"], "scenes/gallery/bolometric.png"),
    (Some("scenes/gallery/disk.toml"), &["disk.limb=isotropic"], "scenes/gallery/isotropic.png"),
    (
        Some("scenes/gallery/disk.toml"),
        &["disk.model=power-law", "disk.inner=1.5", "camera.display.exposure=4"],
        "scenes/gallery/power-law.png",
    ),
    (
        Some("scenes/gallery/disk.toml"),
        &[
            "disk.model=profile",
            "disk.profile=[[4,0],[5,1],[6,0],[9,0],[10,0.6],[11,0],[15,0],[16,0.3],[17,0]]",
        ],
        "scenes/gallery/profile.png",
    ),
    (Some("scenes/two-holes.toml"), &[], "scenes/two-holes.png"),
];

/// Draws them again: all, or those whose file is called one of `names`, with or without folder and ending.
pub fn draw(_root: &Path, names: &[&str]) -> Result<(), String> {
    let is_called = |picture: &str, name: &str| {
        let path = Path::new(picture);
        path == Path::new(name)
            || path.file_name() == Some(name.as_ref())
            || path.file_stem() == Some(name.as_ref())
    };
    if let Some(name) =
        names.iter().find(|name| !PICTURES.iter().any(|(.., picture)| is_called(picture, name)))
    {
        let known: Vec<&str> = PICTURES.iter().map(|(.., picture)| *picture).collect();
        return Err(format!("no picture is called {name}; there are {}", known.join(", ")));
    }
    for (scene, set, picture) in PICTURES.iter().copied() {
        if !names.is_empty() && !names.iter().any(|name| is_called(picture, name)) {
            continue;
        }
        let mut arguments = vec!["run", "--release", "--locked", "--", "render", "-o", picture];
        arguments.extend(set.iter().flat_map(|set| ["--set", set]));
        arguments.extend(scene);
        cargo(&arguments)?;
    }
    Ok(())
}
