//! Things in scenes: their keys, and what cannot be.

use crate::common::assert_faults;
use std::fmt::Write;
use std::path::Path;

use kerrscope::material::Finish;
use kerrscope::objects::Shape;
use kerrscope::scene::{Engine, ObjectPattern, Scene, SceneFile};
use kerrscope::spacetime::observer::Drift;

fn scene(text: &str) -> Scene {
    Scene::from_toml(text, Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn every_key() {
    let s = scene(
        "[[object]]\ncenter = [9, 0, 0]\nradius = 1\n\
         [[object]]\nshape = \"parallelogram\"\ncorner = [5, 5, 5]\nedges = [[1, 0, 0], [0, 2, 0]]\n\
         material = \"light\"\ncolor = [1, 0.5, 0]\nbrightness = 7\n\
         texture = { kind = \"checker\", color = [0, 0, 1], squares = [3, 5] }\n\
         [[object]]\nshape = \"annulus\"\ncenter = [0, 9, 0]\nouter = 2\ninner = 1\nnormal = [1, 1, 0]\n\
         material = \"mirror\"\nmotion = \"orbit\"\n[object.texture]\nkind = \"image\"\npath = 'Cargo.toml'\n\
         [[object]]\ncenter = [0, 0, -9]\nradius = 2\nrotation = [0, 0, 90]\nmotion = [0, 0.5, 0]\n\
         texture = { kind = \"noise\", size = 0.5, seed = 4 }\n",
    );
    assert_eq!(s.objects.len(), 4);
    let Shape::Sphere(ball) = s.objects[0].shape else {
        panic!("a sphere is what a thing is if nothing is said")
    };
    assert_eq!((ball.center, ball.radius), ([9.0, 0.0, 0.0], 1.0));
    assert_eq!((s.objects[0].finish, s.objects[0].drift), (Finish::Matt, Drift::Static));
    assert_eq!(s.objects[0].color, [0.8; 3]);
    let board = &s.objects[1];
    assert_eq!((board.finish, board.brightness), (Finish::Light, 7.0));
    assert_eq!(board.pattern, ObjectPattern::Checker { second: [0.0, 0.0, 1.0], squares: [3, 5] });
    assert_eq!(board.shape.point([1.0, 0.5]), [6.0, 6.0, 5.0]);
    let ring = &s.objects[2];
    assert_eq!(ring.color, [1.0; 3], "a picture keeps its colours");
    assert!(matches!(&ring.pattern, ObjectPattern::Picture { path } if path.ends_with("Cargo.toml")));
    let rate = match ring.drift {
        Drift::Turning(rate) => rate,
        other => panic!("{other:?}"),
    };
    let r = f64::sqrt(81.0 - 0.99 * 0.99);
    assert!((rate - 1.0 / (r.powf(1.5) + 0.99)).abs() < 1e-15);
    assert_eq!(s.objects[3].drift, Drift::Velocity([0.0, 0.5, 0.0]));
    let Shape::Sphere(turned) = s.objects[3].shape else { panic!("a sphere") };
    assert!((turned.axes[0][1] - 1.0).abs() < 1e-15, "longitude 0 is turned towards +y");
    assert_eq!(s.pictures().count(), 1);
    // Whoever is surrounded by things is traced step by step, and not interpolated.
    assert_eq!((s.render.engine, s.render.adaptive), (Engine::Integrator, None));
    let again = Scene::from_toml(&s.to_toml(), Path::new(env!("CARGO_MANIFEST_DIR"))).unwrap();
    assert_eq!(again, s);
}

#[test]
fn keys_that_do_not_go_together() {
    assert_faults(
        "disk.model = \"none\"\n[[object]]\nradius = 1\nouter = 3\nbrightness = 2\n[[object]]\ncenter = [9, 9, 9]\n\
         radius = 1\ntexture = { kind = \"noise\", squares = [3, 3] }\n[[object]]\nshape = \"parallelogram\"\n\
         corner = [9, 9, 9]\nedges = [[1, 1, 1], [2, 2, 2]]\n[[object]]\nshape = \"annulus\"\ncenter = [9, 9, 9]\n\
         outer = 1\ninner = 2\n",
        &[
            (
                2,
                1,
                "`shape = \"sphere\"` needs `object[0].center`, which is not given",
                "give `object[0].center`",
            ),
            (
                4,
                9,
                "`object[0].outer` is used with `object[0].shape = \"annulus\"` only",
                "set `object[0].shape = \"annulus\"`, or remove `object[0].outer`",
            ),
            (
                5,
                14,
                "`object[0].brightness` is used with `object[0].material = \"light\"` only",
                "set `object[0].material = \"light\"`, or remove `object[0].brightness`",
            ),
            (
                9,
                39,
                "`object[1].texture.squares` is used with `object[1].texture.kind = \"checker\"` only",
                "set `object[1].texture.kind = \"checker\"`, or remove `object[1].texture.squares`",
            ),
            (
                13,
                9,
                "a parallelogram with these edges has no area",
                "give two edges that point in different directions",
            ),
            (
                17,
                9,
                "the outer radius 1 is not more than the inner radius 2",
                "give `object[3].outer` more than 2, or a smaller `object[3].inner`",
            ),
        ],
    );
}

#[test]
fn misspelt_and_misplaced() {
    assert_faults(
        "[[objects]]\nradius = 1\n[[object]]\nradus = 1\ncenter = [1, 2]\n[object.textur]\nkind = \"noise\"\n",
        &[
            (1, 3, "there is no section [[objects]]", "did you mean [[object]]?"),
            (4, 1, "[[object]] has no key `radus`", "did you mean `radius`?"),
            (5, 10, "`object[0].center` has 2 values", "give a list of 3 numbers from -1e9 to 1e9"),
            (6, 9, "[[object]] has no key `textur`", "did you mean `texture`?"),
        ],
    );
    assert_faults(
        "radius = 1\n[object]\ncenter = [9, 0, 0]\n",
        &[
            (1, 1, "`radius` is not in a section", "`radius` belongs in [[object]] or [spacetime]"),
            (
                2,
                2,
                "`object` cannot be a table",
                "write [[object]] on a line of its own for each of them, and its keys below",
            ),
        ],
    );
}

/// A ball with its middle at a place, and how it moves.
fn ball(spacetime: &str, center: [f64; 3], radius: f64, motion: &str) -> String {
    format!("{spacetime}\n[[object]]\ncenter = {center:?}\nradius = {radius:?}\nmotion = {motion}\n")
}

#[track_caller]
fn refused(text: &str, what: &str, mend: &str) {
    let faults = Scene::from_toml(text, Path::new("/nowhere")).expect_err("the scene is wrong");
    let found: Vec<_> = faults.iter().map(|fault| (fault.message.as_str(), fault.help.as_str())).collect();
    assert_eq!(found.len(), 1, "{faults}");
    assert!(found[0].0.contains(what) && found[0].1.contains(mend), "{faults}");
}

#[test]
fn things_where_none_can_be() {
    let kerr = "spacetime.spin = 0.9";
    // On the equator the static limit is at r = 2, on the axis at the horizon.
    scene(&ball(kerr, [0.0, 3.2, 0.0], 0.9, "\"static\""));
    scene(&ball(kerr, [0.0, 0.0, 2.5], 0.5, "\"static\""));
    refused(
        &ball(kerr, [0.0, 3.2, 0.0], 1.2, "\"static\""),
        "nothing is static at r = 1.786058 M, at [0.000, 2.000, 0.000]: the static limit there is r = 2 M",
        "move the thing outwards, or set `object[0].motion` to \"orbit\" or a velocity",
    );
    // With a velocity it may be there, down to 1.1 horizon radii.
    scene(&ball(kerr, [0.0, 3.2, 0.0], 1.2, "[0, 0, 0]"));
    refused(
        &ball(kerr, [0.0, 3.2, 0.0], 1.7, "[0, 0, 0]"),
        "the thing reaches down to r = 1.200001 M, and things have to be outside of r = 1.579479 M, 1.1 horizon radii",
        "move it outwards",
    );
    refused(&ball(kerr, [0.0, 0.0, 0.5], 0.1, "[0, 0, 0]"), "reaches down to", "move it outwards");
    // A wall next to the hole, far wider than the hole.
    let wall = |x: f64| {
        format!(
            "{kerr}\n[[object]]\nshape = \"parallelogram\"\ncorner = [{x}, -900, -500]\n\
             edges = [[0, 3000, 0], [0, 0, 2000]]\n"
        )
    };
    scene(&wall(2.3));
    refused(&wall(1.9), "nothing is static at", "move the thing");
    // A shell around everything.
    scene(&ball(kerr, [0.0, 0.0, 0.0], 50.0, "\"static\""));
    refused(
        &ball(kerr, [0.0, 9.0, 1.0], 0.5, "\"orbit\""),
        "a circular orbit lies in the equatorial plane, and the thing's middle is at z = 1 M",
        "z = 0",
    );
    refused(
        &ball(kerr, [0.0, 1.7, 0.0], 0.01, "\"orbit\""),
        "no circular orbit of matter about +z exists at the thing's middle",
        "move its middle beyond r = 1.557",
    );
    refused(
        &ball(kerr, [0.0, 9.0, 0.0], 60.0, "\"orbit\""),
        "turning as one with its middle, the thing would be as fast as light at",
        "make it smaller",
    );
    refused(
        &ball("spacetime.name = \"minkowski\"\ndisk.inner = 6", [0.0, 9.0, 0.0], 1.0, "\"orbit\""),
        "nothing orbits in flat space",
        "static",
    );
    refused(&ball(kerr, [0.0, 9.0, 0.0], 1.0, "[0.8, 0.8, 0]"), "is not below that of light", "below 1");
}

#[test]
fn what_does_not_go_with_things() {
    let with = |render: &str| format!("[render]\n{render}\n{}", ball("", [9.0, 0.0, 0.0], 1.0, "\"static\""));
    refused(&with("engine = \"closed-form\""), "does not see things on the way", "render.engine");
    refused(&with("adaptive = true"), "is not interpolated between rays", "render.adaptive");
    scene(&with("adaptive = false"));
}

#[test]
fn a_hundred_thousand_things_and_no_more() {
    let text = |count: usize| {
        let mut lines = String::new();
        for k in 0..count {
            let (x, y) = (k / 1000, 9 + k % 1000);
            let _ = writeln!(lines, "{{ center = [{x}, {y}, 50], radius = 0.2 }},");
        }
        format!("object = [\n{lines}]\n")
    };
    assert_eq!(scene(&text(100_000)).objects.len(), 100_000);
    refused(
        &text(100_001),
        "there are 100001 things in the scene, and 100000 are the most",
        "leave some out",
    );
}

/// A scene's hole can be put away to see the same without it.
#[test]
fn flat_space_takes_no_notice_of_spin() {
    let text = ball("spacetime.spin = 0.9\ndisk.model = \"none\"", [0.0, 1.0, 0.0], 0.5, "\"static\"");
    let file = SceneFile::from_toml(&text).unwrap();
    assert!(file.build(Path::new("")).is_err(), "there is no room next to the hole");
    let scene = Scene::from_toml(&format!("spacetime.name = \"minkowski\"\n{text}"), Path::new("")).unwrap();
    assert_eq!((scene.spacetime.spin(), scene.objects.len()), (None, 1));
}
