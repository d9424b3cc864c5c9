//! Scenes whose keys are right one by one and wrong together.

use crate::common::{Expected, assert_faults, faults};
use std::path::Path;

use kerrscope::scene::Scene;

#[test]
fn impossible_observers() {
    let static_in_ergosphere = "move the observer beyond r = 1.986561, \
                                or set `observer.motion` to \"zamo\" or \"fall\"";
    let cases: [(&str, Expected); 11] = [
        (
            "distance = 1.5",
            (
                2,
                12,
                "no observer is static at r = 1.5 M: the static limit there is r = 1.986560 M",
                static_in_ergosphere,
            ),
        ),
        (
            "motion = \"zamo\"\ndistance = 1",
            (
                3,
                12,
                "r = 1 M is not outside the horizon at r = 1.141067 M, where only a falling observer can be",
                "move the observer beyond r = 1.141068, or set `observer.motion = \"fall\"`",
            ),
        ),
        (
            "motion = \"fall\"\ndistance = 0.5",
            (
                3,
                12,
                "r = 0.5 M is not outside the inner horizon at r = 0.858933 M",
                "move the observer beyond r = 0.858933",
            ),
        ),
        (
            "motion = \"fall\"\nposition = [0.1, 0, 0]",
            (
                3,
                12,
                "r = 0 M is not outside the inner horizon at r = 0.858933 M",
                "move the observer beyond r = 0.858933",
            ),
        ),
        (
            "motion = \"orbit\"",
            (
                2,
                10,
                "a circular orbit lies in the equatorial plane, not at inclination 80.5°",
                "set `observer.inclination = 90`, or choose another motion",
            ),
        ),
        (
            "motion = \"orbit\"\ninclination = 90\ndistance = 1.16",
            (
                2,
                10,
                "no circular orbit of matter about +z exists at r = 1.16 M: \
                 the photon orbit is at r = 1.167642 M",
                "move the observer beyond r = 1.167642, or choose another motion",
            ),
        ),
        (
            "motion = [0, 0, 1]",
            (
                2,
                10,
                "the speed 1 is not below that of light (1)",
                "give a velocity [r, θ, φ] in units of c whose length is below 1",
            ),
        ),
        (
            "motion = { velocity = [1, 0, 0], relative_to = \"fall\" }",
            (
                2,
                23,
                "the speed 1 is not below that of light (1)",
                "give a velocity [r, θ, φ] in units of c whose length is below 1",
            ),
        ),
        (
            "motion = { relative_to = \"fall\" }",
            (2, 1, "`observer.motion` lacks `velocity`", "give `velocity`: a list of 3 numbers from -1 to 1"),
        ),
        (
            "distance = inf",
            (
                2,
                12,
                "from an infinite distance everything has the angle 0, \
                 and `screen.kind = \"pinhole\"` shows nothing",
                "set `screen.kind = \"impact\"` and `screen.field_of_view` in M, or give a finite distance",
            ),
        ),
        (
            "position = [0, 0, 30]\ndistance = 30\nazimuth = 0",
            (
                2,
                12,
                "`observer.position` and `distance`, `azimuth` both say where the observer is",
                "keep either `position`, or `distance`, `inclination` and `azimuth`",
            ),
        ),
    ];
    for (observer, expected) in cases {
        assert_faults(&format!("[observer]\n{observer}\n"), &[expected]);
    }
}

#[test]
fn observer_at_infinity_moves() {
    assert_faults(
        "screen.kind = \"impact\"\nobserver = { distance = inf, motion = \"zamo\" }",
        &[(
            2,
            39,
            "an observer at infinity is static",
            "set `observer.motion = \"static\"`, or give a finite distance",
        )],
    );
}

#[test]
fn what_flat_space_lacks() {
    assert_faults(
        "[spacetime]\nname = \"minkowski\"\nspin = 0.3\n[observer]\nmotion = \"orbit\"\n",
        &[
            (
                2,
                8,
                "in flat space there is no innermost stable orbit for `disk.inner = \"isco\"`",
                "give `disk.inner` a radius in M, or set `disk.model = \"none\"`",
            ),
            (5, 10, "nothing orbits in flat space", "choose another motion, such as \"static\""),
        ],
    );
    assert_faults(
        "spacetime.name = \"schwarzschild\"\nspacetime.spin = -1\n",
        &[(
            2,
            18,
            "a Schwarzschild black hole does not turn: its spin cannot be -1",
            "remove `spacetime.spin`, or choose `spacetime.name = \"kerr\"`",
        )],
    );
    assert_faults(
        "spacetime.name = \"minkowski\"\nobserver.position = [0, 0, 0]\ndisk.inner = 1",
        &[(
            2,
            21,
            "the observer is at the origin of the coordinates",
            "move it: the origin has no inward direction to look in",
        )],
    );
}

#[test]
fn screens_that_show_nothing() {
    assert_faults(
        "[screen]\nfield_of_view = 180\n",
        &[(
            2,
            17,
            "the flat picture of a pinhole cannot be 180° high",
            "give less than 180, or choose `screen.kind = \"angular\"`",
        )],
    );
    assert_faults(
        "[screen]\nkind = \"angular\"\nfield_of_view = 180.5\n",
        &[(3, 17, "an angular picture cannot be 180.5° high", "give 180 or less")],
    );
    assert_faults(
        "[screen]\nkind = \"impact\"\nlook_at = [0, 0, 0]\n",
        &[(
            3,
            11,
            "`screen.look_at` has no meaning with `kind = \"impact\"`, which looks at the hole",
            "remove it, or choose `screen.kind` \"pinhole\" or \"angular\"",
        )],
    );
    assert_faults(
        "[observer]\nposition = [3, -20, 1.5]\n[screen]\nlook_at = [3, -20, 1.5]\n",
        &[(
            4,
            11,
            "`screen.look_at` is the observer's own place",
            "give another point, or remove it to look at the hole",
        )],
    );
}

#[test]
fn impossible_disks_and_skies() {
    assert_faults(
        "[disk]\ninner = 1.1\nimage = \"a.png\"\nmapping = \"flat\"\n[sky]\nkind = \"grid\"\nspacing = 7\nimage = \"b.png\"\n",
        &[
            (
                2,
                9,
                "the disk's inner edge 1.1 is not outside the horizon at r = 1.141068",
                "give `disk.inner` more than 1.141068, or \"isco\"",
            ),
            (
                3,
                9,
                "`disk.image` is used with `disk.model = \"image\"` only",
                "set `disk.model = \"image\"`, or remove `disk.image`",
            ),
            (
                4,
                11,
                "`disk.mapping` is used with `disk.model = \"image\"` only",
                "set `disk.model = \"image\"`, or remove `disk.mapping`",
            ),
            (
                7,
                11,
                "lines 7° apart do not divide 90° into equal parts",
                "give a divisor of 90 such as 6 or 7.5",
            ),
            (
                8,
                9,
                "`sky.image` is used with `sky.kind = \"panorama\"` only",
                "set `sky.kind = \"panorama\"`, or remove `sky.image`",
            ),
        ],
    );
    assert_faults(
        "disk.outer = 1.2\nsky.kind = \"panorama\"\n",
        &[
            (
                1,
                14,
                "the disk's outer edge 1.2 is not outside its inner edge 1.454498, the isco",
                "give `disk.outer` more than 1.454498, or a smaller `disk.inner`",
            ),
            (
                2,
                12,
                "`sky.kind = \"panorama\"` needs a picture, and `sky.image` is not given",
                "give `sky.image` the path of a PNG, JPEG, TIFF, WebP, HDR or EXR file",
            ),
        ],
    );
}

#[test]
fn pictures_that_are_not_there() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("pictures")).unwrap();
    let path = folder.path().join("scene.toml");
    let text = "[disk]\nmodel = \"image\"\nimage = \"ring.png\"\n\
                [sky]\nkind = \"panorama\"\nimage = \"pictures\"\n";
    std::fs::write(&path, text).unwrap();
    let faults = Scene::load(Some(&path), &[]).unwrap_err();
    let (scene, base) = (path.display(), folder.path().display());
    let expected = format!(
        "{scene}:3:9: the picture {base}/ring.png does not exist\n  \
         help: `disk.image` is a file's path from the folder of the scene, {base}\n\
         {scene}:6:9: the picture {base}/pictures is a folder, not a picture\n  \
         help: `sky.image` is a file's path from the folder of the scene, {base}"
    );
    assert_eq!(faults.to_string(), expected);
    std::fs::write(folder.path().join("ring.png"), "").unwrap();
    std::fs::write(folder.path().join("pictures/sky.png"), "").unwrap();
    let sky = "sky.image=pictures/sky.png".to_owned();
    assert!(Scene::load(Some(&path), &[sky]).is_ok());
}

#[test]
fn too_much_work_and_unused_steps() {
    assert_faults(
        "[render]\nwidth = 16384\nheight = 16384\nsamples = 65536\nstep = 0.1\n",
        &[
            (
                4,
                11,
                "16384 × 16384 pixels of 65536 samples are 17592186044416 rays, and 68719476736 are the most",
                "at this size `render.samples` can be 256",
            ),
            (
                5,
                8,
                "`render.step` is for `method = \"rk4\"` only; the others choose their steps",
                "remove it and use `render.tolerance`, or choose `render.method = \"rk4\"`",
            ),
        ],
    );
}

/// What depends on a value that is wrong, or on a key that may have been meant, is not judged.
#[test]
fn no_fault_follows_from_another() {
    assert_faults(
        "[disk]\notuer = 40\ninner = 20\n[spacetime]\nname = \"minkovski\"\n[observer]\ndistance = -5\n",
        &[
            (2, 1, "[disk] has no key `otuer`", "did you mean `outer`?"),
            (
                5,
                8,
                "`spacetime.name` cannot be \"minkovski\"",
                "did you mean \"minkowski\"? Allowed are \"kerr\", \"schwarzschild\", \"minkowski\", \"text\", \"kerr-text\", \"schwarzschild-text\", \"reissner-nordstrom\", \"kerr-newman\", \"johannsen\", \"ellis\", \"morris-thorne\", \"majumdar-papapetrou\", \"two-kerr\" or \"schwarzschild-de-sitter\"",
            ),
            (
                7,
                12,
                "-5 is too small for `observer.distance`",
                "give a number above 0, at most 1e15, or inf; the default is 30.4",
            ),
        ],
    );
}

#[test]
fn fixed_steps_do_not_come_from_infinity() {
    let text = "[observer]\ndistance = inf\n[screen]\nkind = \"impact\"\n[render]\nmethod = \"rk4\"";
    let faults = Scene::from_toml(text, Path::new("")).unwrap_err();
    assert_eq!(faults.len(), 1, "{faults}");
    assert!(faults[0].message.contains("cannot come in from infinity"));
    assert_eq!(faults[0].line_column(), Some((6, 10)));
}

#[test]
fn impact_parameters_are_a_static_observers() {
    let text = "[observer]\nmotion = \"zamo\"\n[screen]\nkind = \"impact\"";
    let faults = faults(text);
    assert_eq!(faults.len(), 1, "{faults}");
    assert!(faults[0].message.contains("static observer"));
    assert_eq!(faults[0].line_column(), Some((2, 10)));
}

#[test]
fn the_closed_form_is_for_equatorial_disks_around_holes() {
    let engine = "render.engine = \"closed-form\"\n";
    for (rest, what, mend) in [
        (
            "spacetime.name = \"minkowski\"\ndisk.inner = 6",
            "flat space has straight rays",
            "remove `render.engine`",
        ),
        ("disk.tilt = 5", "the disk is tilted", "set `disk.tilt = 0`"),
        ("render.method = \"tsit5\"", "does not integrate", "or remove `render.method`"),
    ] {
        let faults = faults(&format!("{engine}{rest}"));
        assert_eq!(faults.len(), 1, "{faults}");
        assert!(faults[0].message.contains(what), "{faults}");
        assert!(faults[0].help.contains(mend), "{}", faults[0].help);
        assert_eq!(faults[0].line_column(), Some((1, 17)));
    }
}

#[test]
fn a_hole_next_door() {
    assert_faults(
        "units = { mass = 1e20, distance = 1e-10 }",
        &[(
            1,
            35,
            "at that distance M has an angle of 4.8e16 radians on the sky, and 0.001 are the most",
            "give `units.mass` in solar masses and `units.distance` in pc, such as 6.5e9 and 16.8e6",
        )],
    );
}
