//! Wrong scenes: each fault is found, at its place, with its mend.

use crate::common::assert_faults;

use kerrscope::scene::Scene;

#[test]
fn unknown_keys() {
    assert_faults(
        "[spacetime]\nspn = 0.9\n[screen]\nwidth = 400\n[rendr]\n[sky]\nweight = 1\n[display]\nbits = 8\n",
        &[
            (2, 1, "[spacetime] has no key `spn`", "did you mean `spin`?"),
            (4, 1, "[screen] has no key `width`", "`width` belongs in [render]"),
            (5, 2, "there is no section [rendr]", "did you mean [render]?"),
            (
                7,
                1,
                "[sky] has no key `weight`",
                "[sky] has the keys brightness, color, frame, image, image_frame, kind, longitude, rotation, spacing, zenith",
            ),
            (8, 2, "there is no section [display]", "write [camera.display]"),
        ],
    );
}

#[test]
fn keys_outside_their_sections() {
    assert_faults(
        "spin = 0.9\nspacetime = 3\nfog = true\n[[sky]]\nkind = \"grid\"\n",
        &[
            (1, 1, "`spin` is not in a section", "`spin` belongs in [spacetime]"),
            (
                2,
                13,
                "`spacetime` cannot be the number 3",
                "write [spacetime] on a line of its own, and its keys below",
            ),
            (
                3,
                1,
                "`fog` is not in a section",
                "a scene has the sections [camera], [disk], [[object]], [observer], [other_sky], [render], [screen], [sky], [spacetime], [target], [units]",
            ),
            (4, 1, "`sky` cannot be a list", "write [sky] on a line of its own, and its keys below"),
        ],
    );
}

#[test]
fn wrong_types() {
    assert_faults(
        "[observer]\ndistance = \"30\"\n[render]\nwidth = 960.0\nheight = 9.5\njitter = 1\nseed = 2020-01-01\n\
         [screen]\nlook_at = [1, 2]\nroll = true\n[disk]\ncolor = [1, \"red\", 0]\nimage = 3\n",
        &[
            (2, 12, "`observer.distance` cannot be the text \"30\"", "remove the quotation marks: 30"),
            (4, 9, "`render.width` cannot be the real number 960.0", "write it as a whole number, 960"),
            (
                5,
                10,
                "`render.height` cannot be the number 9.5",
                "give a whole number from 1 to 16384; the default is 540",
            ),
            (6, 10, "`render.jitter` cannot be the number 1", "give true or false; the default is true"),
            (
                7,
                8,
                "`render.seed` cannot be the date or time 2020-01-01",
                "give a whole number from 0 to 9223372036854775807; the default is 1",
            ),
            (9, 11, "`screen.look_at` has 2 values", "give a list of 3 numbers from -1e15 to 1e15"),
            (10, 8, "`screen.roll` cannot be true", "give a number from -1e6 to 1e6; the default is 0"),
            (12, 13, "`disk.color[1]` cannot be the text \"red\"", "give a number from 0 to 1"),
            (13, 9, "`disk.image` cannot be the number 3", "give text in quotation marks"),
        ],
    );
}

#[test]
fn out_of_range() {
    assert_faults(
        "[spacetime]\nspin = -1.5\n[observer]\ndistance = 0\ninclination = 181\n\
         [render]\nsamples = 65537\nseed = 9223372036854775808\nmax_crossings = 0\ntolerance = 1e999\n\
         [camera.display]\nbits = 12\nexposure = -31\n",
        &[
            (
                2,
                8,
                "-1.5 is too small for `spacetime.spin`",
                "give a number from -1 to 1; the default is 0.99",
            ),
            (
                4,
                12,
                "0 is too small for `observer.distance`",
                "give a number above 0, at most 1e15, or inf; the default is 30.4",
            ),
            (
                5,
                15,
                "181 is too large for `observer.inclination`",
                "give a number from 0 to 180; the default is 80.5",
            ),
            (
                7,
                11,
                "65537 is too large for `render.samples`",
                "give a whole number from 1 to 65536; the default is 4",
            ),
            (
                8,
                8,
                "9223372036854775808 is too large a number for `render.seed`",
                "give a whole number from 0 to 9223372036854775807; the default is 1",
            ),
            (
                9,
                17,
                "0 is too small for `render.max_crossings`",
                "give a whole number from 1 to 64; the default is 8",
            ),
            (
                10,
                13,
                "1e999 is too large a number for `render.tolerance`",
                "give a number from 1e-14 to 0.01; the default is 1e-8",
            ),
            (12, 8, "`camera.display.bits` cannot be 12", "give 8 or 16; the default is 8"),
            (
                13,
                12,
                "-31 is too small for `camera.display.exposure`",
                "give a number from -30 to 30; the default is 0",
            ),
        ],
    );
}

#[test]
fn not_finite() {
    assert_faults(
        "[observer]\nazimuth = nan\nposition = [1, inf, -nan]\n[disk]\nouter = inf\ninner = -inf\n",
        &[
            (
                2,
                11,
                "`observer.azimuth` cannot be nan, which is not a number",
                "give a number from -1e6 to 1e6; the default is 0",
            ),
            (3, 16, "`observer.position[1]` cannot be infinite", "give a number from -1e15 to 1e15"),
            (
                3,
                21,
                "`observer.position[2]` cannot be nan, which is not a number",
                "give a number from -1e15 to 1e15",
            ),
            (
                5,
                9,
                "`disk.outer` cannot be infinite",
                "give a number above 0, at most 1e15; the default is 16",
            ),
            (
                6,
                9,
                "`disk.inner` cannot be infinite",
                "give \"isco\" or a number above 0, at most 1e15; the default is \"isco\"",
            ),
        ],
    );
}

#[test]
fn misspelt_words() {
    assert_faults(
        "[spacetime]\nname = \"Ker\"\n[observer]\nmotion = { velocity = [0, 0, 0.1], relative_to = \"fell\" }\n\
         [disk]\ninner = \"icso\"\n[sky]\nkind = \"comets\"\n[render]\nmethod = \"rk45\"\n",
        &[
            (
                2,
                8,
                "`spacetime.name` cannot be \"Ker\"",
                "did you mean \"kerr\"? Allowed are \"kerr\", \"schwarzschild\", \"minkowski\", \"text\", \"kerr-text\", \"schwarzschild-text\", \"reissner-nordstrom\", \"kerr-newman\", \"johannsen\", \"ellis\", \"morris-thorne\", \"majumdar-papapetrou\", \"two-kerr\" or \"schwarzschild-de-sitter\"",
            ),
            (
                4,
                50,
                "`observer.motion.relative_to` cannot be \"fell\"",
                "did you mean \"fall\"? Allowed are \"zamo\" or \"fall\"",
            ),
            (
                6,
                9,
                "`disk.inner` cannot be \"icso\"",
                "did you mean \"isco\"? Allowed are \"isco\" or a number above 0, at most 1e15",
            ),
            (
                8,
                8,
                "`sky.kind` cannot be \"comets\"",
                "give \"black\", \"uniform\", \"gradient\", \"grid\", \"stars\" or \"panorama\"; the default is \"stars\"",
            ),
            (
                10,
                10,
                "`render.method` cannot be \"rk45\"",
                "did you mean \"rk4\"? Allowed are \"dop853\", \"tsit5\" or \"rk4\"",
            ),
        ],
    );
}

#[test]
fn broken_grammar() {
    assert_faults(
        "[spacetime]\nname = kerr\nspin = 0,5\nspn = 3\n[disk\nouter = 3x\n[screen]\nroll 3\n\
         kind = \"angular\nlook_at = [1,2\nfield_of_view = 300\n[sky]\ncolor = [1 1 1]\nbrightness =\n\
         spacing = 45\nspacing = 30\n// comment\n",
        &[
            (2, 8, "`kerr` is no value", "text is quoted: \"kerr\""),
            (
                3,
                9,
                "a comma cannot follow this value",
                "decimals follow a point, 0.5; a list is in brackets, [1, 2, 3]",
            ),
            (4, 1, "[spacetime] has no key `spn`", "did you mean `spin`?"),
            (5, 6, "this header is never closed", "close it with `]`"),
            (6, 9, "`3x` is no value", "a number is written 0.5 or 1e-8, and text in quotation marks"),
            (8, 6, "this key has no value", "write `key = value`; a comment begins with `#`"),
            (9, 16, "this text is never closed", "end it with `\"`"),
            (10, 11, "this list is never closed", "close it with `]`"),
            (13, 10, "`1 1 1` is no value", "part the numbers by commas: 1, 1, 1"),
            (14, 13, "there is no value after `=`", "give a value, or remove the key for its default"),
            (16, 1, "`spacing` is given twice", "keep one of the two"),
            (17, 4, "this key has no value", "write `key = value`; a comment begins with `#`"),
        ],
    );
}

#[test]
fn unreadable_files() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str| {
        let path = folder.path().join(name);
        let faults = Scene::load(Some(&path), &[]).unwrap_err();
        faults.to_string().replace(&folder.path().display().to_string(), "…")
    };
    assert_eq!(load("none.toml"), "…/none.toml: there is no such file\n  help: check the path");
    assert_eq!(load(""), "…/: this is a folder\n  help: give the scene file within it");
    std::fs::write(folder.path().join("latin.toml"), b"[sky]\n# \xe9t\xe9\n").unwrap();
    assert_eq!(
        load("latin.toml"),
        "…/latin.toml:2:3: this is not text in UTF-8\n  \
         help: save the file in UTF-8, or check that it is a scene file"
    );
    std::fs::write(folder.path().join("large.toml"), vec![b'#'; (8 << 20) + 1]).unwrap();
    assert_eq!(
        load("large.toml"),
        "…/large.toml: it is larger than 8 MiB\n  \
         help: a scene is some kilobytes of text, with a hundred thousand things some megabytes: \
         check that this is the right file"
    );
}
