//! The coordinates in which a scene's light is followed.

use kerrscope::render::{Stage, Watch, draw};
use kerrscope::scene::{Coordinates, Engine, Scene};
use std::path::Path;

fn scene(text: &str) -> Scene {
    Scene::from_toml(text, Path::new("")).unwrap()
}

#[test]
fn they_are_chosen() {
    assert_eq!(Scene::built_in().render.coordinates, Coordinates::KerrSchild);
    let round = scene("spacetime.chart = \"boyer-lindquist\"");
    assert_eq!(round.render.coordinates, Coordinates::BoyerLindquist);
    assert_eq!(round.render.engine, Engine::Integrator, "the closed form has none to choose");
    for name in ["schwarzschild", "boyer-lindquist", "kerr-schild"] {
        let text = format!("spacetime = {{ name = \"schwarzschild\", chart = \"{name}\" }}");
        assert!(Scene::from_toml(&text, Path::new("")).is_ok(), "{name}");
    }
    assert!(round.to_toml().contains("chart = \"boyer-lindquist\""));
    assert!(!scene("spacetime.name = \"minkowski\"\ndisk.inner = 6").to_toml().contains("coordinates"));
}

#[test]
fn they_have_to_cover_the_observer() {
    for (text, what, mend) in [
        (
            "spacetime.chart = \"boyer-lindquist\"\nobserver.inclination = 0",
            "singular on the axis",
            "move the observer off the axis",
        ),
        (
            "spacetime.chart = \"boyer-lindquist\"\nobserver = { distance = 1.0, motion = \"fall\" }",
            "singular at the horizon",
            "move the observer beyond r = 1.25",
        ),
        ("spacetime.chart = \"schwarzschild\"", "a hole that does not turn", "choose \"boyer-lindquist\""),
        (
            "spacetime.chart = \"kerr-schild\"\nspacetime.name = \"minkowski\"\ndisk.inner = 6",
            "is used with `spacetime.name = \"kerr\"`",
            "remove `spacetime.chart`",
        ),
    ] {
        let faults = Scene::from_toml(text, Path::new("")).unwrap_err();
        assert_eq!(faults.len(), 1, "{text}: {faults}");
        assert!(faults[0].message.contains(what) && faults[0].help.contains(mend), "{faults}");
        assert_eq!(faults[0].line_column().map(|(line, _)| line), Some(1), "{faults}");
    }
    let text = "render.engine = \"closed-form\"\nspacetime.chart = \"boyer-lindquist\"";
    let faults = Scene::from_toml(text, Path::new("")).unwrap_err();
    assert!(faults[0].message.contains("no coordinates to choose"), "{faults}");
}

/// Off the axis the same picture comes out in all coordinates.
#[test]
fn they_draw_the_same() {
    let film = |spacetime: &str| {
        let text = format!(
            "{spacetime}\n[observer]\ninclination = 80.5\n[sky]\nkind = \"grid\"\n[render]\nengine = \"integrator\"\n\
             width = 40\nheight = 24\nsamples = 1\nadaptive = false"
        );
        let scene = Scene::from_toml(&text, Path::new("")).unwrap();
        draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap()
    };
    for (name, coordinates) in [("kerr", "boyer-lindquist"), ("schwarzschild", "schwarzschild")] {
        let with = |coordinates: &str| {
            film(&format!("spacetime = {{ name = \"{name}\", chart = \"{coordinates}\" }}"))
        };
        let (one, other) = (with("kerr-schild"), with(coordinates));
        assert_eq!(one.light.len(), other.light.len());
        let different = one
            .light
            .iter()
            .zip(&other.light)
            .filter(|(a, b)| a.iter().zip(*b).any(|(x, y)| (x - y).abs() > 1e-3));
        let different = different.count();
        assert!(different <= 2, "{different} pixels differ, at most a few next to the edge of the shadow");
    }
}
