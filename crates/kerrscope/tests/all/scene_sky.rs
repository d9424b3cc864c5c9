//! The keys of a sky: which of them mean something depends on its kind.

use std::path::Path;

use kerrscope::scene::Scene;

/// What a kind of sky takes no notice of may be a slip. "black" puts a sky away, which keeps its keys.
#[test]
fn keys_without_effect_on_the_sky() {
    let keys = [
        ("color = [1, 1, 1]", "\"uniform\"`, \"gradient\" or \"grid\""),
        ("zenith = [1, 1, 1]", "\"gradient\"`"),
        ("spacing = 15", "\"grid\"`"),
        ("image = \"Cargo.toml\"", "\"panorama\"`"),
        ("frame = \"galactic\"", "\"stars\"` or \"panorama\""),
        ("image_frame = \"scene\"", "\"panorama\"`"),
        ("longitude = 180", "\"stars\"` or \"panorama\""),
        ("rotation = [0, 0, 0]", "\"stars\"` or \"panorama\""),
    ];
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    for kind in ["uniform", "gradient", "grid", "stars", "panorama"] {
        for (typed, kinds) in keys {
            let key = format!("sky.{}", typed.split_once(' ').unwrap().0);
            let needed = match kind {
                "panorama" if key == "sky.image" => "",
                // A frame matters to pictures in the sky's own coordinates.
                "panorama" if key == "sky.frame" => "image = \"Cargo.toml\"\nimage_frame = \"galactic\"",
                "panorama" => "image = \"Cargo.toml\"",
                _ => "",
            };
            let text = format!("[sky]\n{typed}\nkind = \"{kind}\"\nbrightness = 2\n{needed}");
            let scene = Scene::from_toml(&text, folder);
            if kinds.contains(&format!("\"{kind}\"")) {
                assert!(scene.is_ok(), "{text}\n{}", scene.unwrap_err());
                continue;
            }
            let faults = scene.expect_err(&text);
            let value = typed.split_once("= ").unwrap().0.len() + 3;
            let expected = format!(
                "scene:2:{value}: `{key}` is used with `sky.kind = {kinds} only\n  \
                 help: set `sky.kind = {kinds}, or remove `{key}`"
            );
            assert_eq!(faults.to_string(), expected);
        }
    }
    // Of a kind that is no kind it is not known what it would use.
    let unknown = "[sky]\nkind = \"comets\"\nimage_frame = \"scene\"\nspacing = 15";
    assert_eq!(Scene::from_toml(unknown, folder).unwrap_err().len(), 1);
    let all = keys.map(|(typed, _)| typed).join("\n");
    let put_away = format!("[sky]\nkind = \"black\"\nbrightness = 2\n{all}");
    let scene = Scene::from_toml(&put_away, Path::new("/nowhere")).unwrap();
    assert!(scene.to_toml().contains("[sky]\nkind = \"black\"\n\n"), "{}", scene.to_toml());
}

#[test]
fn a_panorama_in_the_coordinates_of_the_scene_has_no_frame() {
    let text = "sky = { kind = \"panorama\", image = \"Cargo.toml\", frame = \"equatorial\" }";
    let faults = Scene::from_toml(text, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_err();
    assert_eq!(
        faults.to_string(),
        "scene:1:58: `sky.frame` is used with `sky.image_frame = \"galactic\"` or \"equatorial\" only\n  \
         help: set `sky.image_frame = \"galactic\"` or \"equatorial\", or remove `sky.frame`"
    );
}

/// A scene is written out with the keys that mean something in it, and no others.
#[test]
fn what_is_written_out_has_a_meaning() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (kind, keys) in [
        ("black", "kind"),
        ("uniform", "brightness color kind"),
        ("grid", "brightness color kind spacing"),
        ("stars", "brightness frame kind longitude rotation"),
        ("panorama\"\nimage = \"Cargo.toml", "brightness image image_frame kind longitude rotation"),
        (
            "panorama\"\nimage = \"Cargo.toml\"\nimage_frame = \"equatorial",
            "brightness frame image image_frame kind longitude rotation",
        ),
    ] {
        let scene = Scene::from_toml(&format!("[sky]\nkind = \"{kind}\""), folder).unwrap();
        let text = scene.to_toml();
        let (_, sky) = text.split_once("[sky]\n").unwrap();
        let (sky, _) = sky.split_once("\n\n").unwrap();
        let mut found: Vec<&str> = sky.lines().map(|line| line.split_once(" = ").unwrap().0).collect();
        found.sort_unstable();
        assert_eq!(found.join(" "), keys, "{text}");
        assert_eq!(Scene::from_toml(&text, folder).unwrap(), scene);
    }
}
