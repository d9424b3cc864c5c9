//! Right scenes: every key is read, and has the default that the schema says.

use std::f64::consts::{FRAC_PI_2, PI};
use std::path::{Path, PathBuf};

use kerrscope::disk::{Glow, Limb, Mapping, Profile, Shifts};
use kerrscope::display::{Colormap, Depth, Display, FalseColor, Tone};
use kerrscope::render::{Channel, Layer};
use kerrscope::scene::{self, Engine, Method, Scene, SceneFile};
use kerrscope::sky::{Frame, Orientation};
use kerrscope::spacetime::observer;
use kerrscope::units::Units;

fn scene(text: &str) -> Scene {
    Scene::from_toml(text, Path::new("")).unwrap_or_else(|faults| panic!("{text}\n{faults}"))
}

#[test]
fn nothing_is_the_built_in_scene() {
    assert_eq!(scene(""), Scene::built_in());
    assert_eq!(scene("# Nothing yet.\n[spacetime]\n[camera]\n"), Scene::built_in());
    assert_eq!(Scene::load(None, &[]).unwrap(), Scene::built_in());
    assert_eq!(scene(&Scene::built_in().to_toml()), Scene::built_in());
}

#[test]
fn the_built_in_scene() {
    let built_in = Scene::built_in();
    assert_eq!(built_in.spacetime, scene::Spacetime::Kerr { spin: 0.99 });
    let place = observer::Place { r: 30.4, theta: 80.5_f64.to_radians(), phi: 0.0 };
    assert_eq!(built_in.observer, scene::Observer { place, motion: observer::Motion::Static });
    let kind = scene::ScreenKind::Pinhole { height: 50_f64.to_radians() };
    assert_eq!(built_in.screen, scene::Screen { kind, roll: 0.0, look_at: None });
    let disk = built_in.disk.unwrap();
    assert!((disk.inner - 1.45449793806).abs() < 1e-10);
    assert_eq!((disk.outer, disk.brightness, disk.opacity), (16.0, 1.0, 1.0));
    assert_eq!(disk.surface, scene::Surface::Ring { seed: 1 });
    assert_eq!((built_in.render.width, built_in.render.height), (960, 540));
    assert_eq!((built_in.render.samples, built_in.render.max_steps), (4, 10_000));
    assert_eq!((built_in.display.depth, built_in.display.layer), (Depth::Eight, None));
}

/// Each key in each of its forms, and what becomes of it.
#[test]
fn every_key() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |text: &str| Scene::from_toml(text, file).unwrap_or_else(|faults| panic!("{text}\n{faults}"));

    let s = read("spacetime = { name = \"schwarzschild\" }");
    assert_eq!(s.spacetime, scene::Spacetime::Schwarzschild);
    assert_eq!(s.file().spacetime.spin, Some(0.0));
    assert_eq!(s.disk.unwrap().inner, 6.0);
    let s = read("spacetime.name = \"minkowski\"\nspacetime.spin = 0.3\ndisk.inner = 1");
    assert_eq!(s.spacetime, scene::Spacetime::Minkowski);
    assert_eq!(s.spacetime.spin(), None);
    // A disk around +z is a retrograde one if the hole turns the other way.
    let s = read("spacetime.spin = -1");
    assert_eq!(s.disk.unwrap().inner, 9.0);
    let s = read("spacetime.spin = 1");
    assert_eq!(s.disk.unwrap().inner, 1.0);

    // A whole number does where a real one is wanted.
    let s = read("[observer]\ndistance = 100\ninclination = 90\nazimuth = -180\nmotion = \"orbit\"");
    let place = observer::Place { r: 100.0, theta: FRAC_PI_2, phi: -PI };
    assert_eq!(s.observer, scene::Observer { place, motion: observer::Motion::Orbit });
    for (typed, motion) in [
        ("\"static\"", observer::Motion::Static),
        ("\"zamo\"", observer::Motion::ZeroAngularMomentum),
        ("\"fall\"", observer::Motion::Fall),
        ("[0, -0.5, 0.5]", observer::Motion::Velocity([0.0, -0.5, 0.5])),
        ("{ velocity = [0, 0, 0.9] }", observer::Motion::Velocity([0.0, 0.0, 0.9])),
        ("{ velocity = [0, 0, 0.9], relative_to = \"zamo\" }", observer::Motion::Velocity([0.0, 0.0, 0.9])),
        (
            "{ velocity = [0.1, 0, 0], relative_to = \"fall\" }",
            observer::Motion::VelocityFromFall([0.1, 0.0, 0.0]),
        ),
    ] {
        let s = read(&format!("observer.motion = {typed}"));
        assert_eq!(s.observer.motion, motion);
    }
    let s = read("[observer]\nposition = [0, 0, -12]\nmotion = \"fall\"");
    assert_eq!((s.observer.place.r, s.observer.place.theta), (12.0, PI));
    assert_eq!(s.file().observer.distance, None);
    let s = read("observer.distance = inf\nscreen.kind = \"impact\"");
    assert!(s.observer.place.r.is_infinite());
    assert_eq!(s.screen.kind, scene::ScreenKind::Impact { height: 20.0 });
    // Inside the horizon, above the inner one.
    read("observer.distance = 1.1\nobserver.motion = \"fall\"");

    let s = read("[screen]\nkind = \"angular\"\nfield_of_view = 180\nroll = 90\nlook_at = [0, 0, 0]");
    assert_eq!(s.screen.kind, scene::ScreenKind::Angular { height: PI });
    assert_eq!((s.screen.roll, s.screen.look_at), (FRAC_PI_2, Some([0.0; 3])));

    let s = read("[disk]\nmodel = \"none\"\ninner = 20");
    assert_eq!(s.disk, None);
    let s = read(
        "[disk]\ninner = 3\nouter = 9\ntilt = 180\nnode = 90\ncolor = [0, 0.5, 1]\nbrightness = 2\n\
         opacity = 0.5\nseed = 9223372036854775807",
    );
    assert_eq!(
        s.disk.unwrap(),
        scene::Disk {
            inner: 3.0,
            outer: 9.0,
            tilt: PI,
            node: FRAC_PI_2,
            surface: scene::Surface::Ring { seed: i64::MAX as u64 },
            color: [0.0, 0.5, 1.0],
            brightness: 2.0,
            opacity: 0.5,
            thin: false,
            orbits: None,
            shifts: Shifts::NONE,
            orders: None,
            time: None,
        }
    );
    let s = read(
        "[disk]\nmodel = \"power-law\"\nindex = 2\nturns = \"retrograde\"\noptically_thin = true\norders = [0, 2]\n\
         beaming = false\nlimb = \"electron-scattering\"",
    );
    let disk = s.disk.unwrap();
    let profile = Profile::PowerLaw { index: 2.0 };
    let surface = scene::Surface::Shining { profile, limb: Limb::ElectronScattering, glow: Glow::Bolometric };
    assert_eq!(disk.surface, surface);
    assert!(disk.thin && disk.orders == Some(vec![0, 2]));
    assert_eq!(disk.shifts, Shifts { doppler: true, gravitational: true, beaming: false });
    // The last orbit against the spin.
    assert!((disk.inner - 8.97186134).abs() < 1e-8);
    let s = read(
        "units = { mass = 10, frequency = 5e17 }\n[disk]\nmodel = \"page-thorne\"\nlight = \"blackbody\"\n\
         accretion_rate = 1e-8\ncolor_correction = 1.7\nouter = 30",
    );
    let scene::Surface::Shining { glow: Glow::Blackbody { hottest, correction, frequency }, .. } =
        s.disk.unwrap().surface
    else {
        panic!("a black body")
    };
    assert!((1e6..1e7).contains(&hottest), "{hottest}");
    assert_eq!((correction, frequency), (1.7, Some(5e17)));
    let s = read(
        "[disk]\nmodel = \"profile\"\nprofile = [[6, 0], [9, 1]]\nlight = \"blackbody\"\ntemperature = 6000",
    );
    let disk = s.disk.unwrap();
    let glow = Glow::Blackbody { hottest: 6000.0, correction: 1.0, frequency: None };
    let profile = Profile::Knots(vec![[6.0, 0.0], [9.0, 1.0]]);
    assert_eq!(disk.surface, scene::Surface::Shining { profile, limb: Limb::Isotropic, glow });
    let s = read("disk = { doppler = true, time = 3 }");
    let disk = s.disk.unwrap();
    assert_eq!((disk.shifts.doppler, disk.shifts.gravitational, disk.time), (true, false, Some(3.0)));
    for (typed, mapping) in [
        ("", Mapping::Around),
        ("mapping = \"around\"", Mapping::Around),
        ("mapping = \"flat\"", Mapping::Flat),
    ] {
        let s = read(&format!("[disk]\nmodel = \"image\"\nimage = 'Cargo.toml'\n{typed}"));
        let path = file.join("Cargo.toml");
        let disk = s.disk.unwrap();
        assert_eq!(disk.surface, scene::Surface::Picture { path, mapping });
        // A picture keeps its colours.
        assert_eq!(disk.color, [1.0; 3]);
    }

    let s = read("sky = { kind = \"black\" }");
    assert_eq!(s.sky.picture, scene::SkyPicture::Black);
    let s = read("sky = { kind = \"uniform\", color = [1, 1, 1], brightness = 0 }");
    assert_eq!(
        s.sky,
        scene::Sky { picture: scene::SkyPicture::Uniform { color: [1.0; 3] }, brightness: 0.0 }
    );
    let s = read("sky = { kind = \"gradient\", zenith = [0, 0, 1] }");
    let picture = scene::SkyPicture::Gradient { horizon: [1.0; 3], zenith: [0.0, 0.0, 1.0] };
    assert_eq!(s.sky, scene::Sky { picture, brightness: 1.0 });
    for (kind, picture) in [
        ("uniform", scene::SkyPicture::Uniform { color: [0.2, 0.34, 0.55] }),
        ("grid", scene::SkyPicture::Grid { color: [0.2, 0.34, 0.55], spacing: PI / 12.0 }),
    ] {
        let s = read(&format!("sky.kind = \"{kind}\""));
        assert_eq!(s.sky, scene::Sky { picture, brightness: 1.0 });
    }
    for spacing in ["1", "1.2", "11.25", "22.5", "90"] {
        let s = read(&format!("[sky]\nkind = \"grid\"\nspacing = {spacing}"));
        assert!(matches!(s.sky.picture, scene::SkyPicture::Grid { .. }));
    }
    let s = read("sky = { kind = \"panorama\", image = \"src/lib.rs\", longitude = 0 }");
    let path: PathBuf = file.join("src/lib.rs");
    assert_eq!(s.sky.picture, scene::SkyPicture::Panorama { path, orientation: Orientation::upright(0.0) });

    // The built-in sky: the Milky Way level, its centre straight behind the hole.
    let level = Orientation::celestial(Frame::Equatorial, Frame::Galactic, PI);
    assert_eq!(read("").sky.picture, scene::SkyPicture::Stars { orientation: level });
    let s = read(
        "sky = { kind = \"panorama\", image = \"src/lib.rs\", image_frame = \"galactic\", \
         frame = \"equatorial\", longitude = -90, rotation = [0, 180, 90] }",
    );
    let path: PathBuf = file.join("src/lib.rs");
    let orientation =
        Orientation::celestial(Frame::Galactic, Frame::Equatorial, -0.5 * PI).turned([0.0, PI, 0.5 * PI]);
    assert_eq!(s.sky.picture, scene::SkyPicture::Panorama { path, orientation });

    let s = read(
        "[render]\nwidth = 1\nheight = 16384\nsamples = 65536\nseed = 0\njitter = false\n\
         engine = \"integrator\"\nmethod = \"rk4\"\ntolerance = 1e-14\nstep = 1\nmax_steps = 1000000\n\
         max_crossings = 64\nbounces = 0\nshifts = false\nadaptive = true\nadaptive_error = 1e-6\nlayers = [\"g\", \"fate\", \"g\"]\n[camera.display]\nexposure = -2\ntone = \"none\"\nbits = 16",
    );
    assert_eq!(
        s.render,
        scene::Render {
            width: 1,
            height: 16384,
            samples: 65536,
            seed: 0,
            jitter: false,
            engine: Engine::Integrator,
            coordinates: scene::Coordinates::KerrSchild,
            method: Method::Rk4,
            tolerance: 1e-14,
            step: 1.0,
            max_steps: 1_000_000,
            max_crossings: 64,
            bounces: 0,
            shifts: false,
            adaptive: Some(1e-6),
            layers: vec![Layer::Fate, Layer::G],
        }
    );
    let view = Display { exposure: -2.0, tone: Tone::None };
    assert_eq!(s.display, scene::Display { view, layer: None, depth: Depth::Sixteen });
    let s = read("render.method = \"rk4\"");
    assert_eq!((s.render.step, s.file().render.step), (0.1, Some(0.1)));
    assert_eq!(read("render.method = \"tsit5\"").render.method, Method::Tsit5);
    assert_eq!(read("camera.display.tone = \"filmic\"").display.view.tone, Tone::Filmic);

    // Interpolated where that pays, if the scene does not say.
    for (text, adaptive) in [
        ("", Some(1e-4)),
        ("render.adaptive = false", None),
        ("render.samples = 1", None),
        ("render = { samples = 1, adaptive = true }", Some(1e-4)),
        ("render.method = \"tsit5\"", None),
        ("spacetime.name = \"minkowski\"\ndisk.inner = 6", None),
    ] {
        assert_eq!(read(text).render.adaptive, adaptive, "{text}");
    }

    // The closed form where it can.
    for (text, engine) in [
        ("", Engine::ClosedForm),
        ("render.engine = \"closed-form\"", Engine::ClosedForm),
        ("render.engine = \"integrator\"", Engine::Integrator),
        ("spacetime.name = \"schwarzschild\"", Engine::ClosedForm),
        ("disk.tilt = 10", Engine::Integrator),
        ("disk = { model = \"none\" }", Engine::ClosedForm),
        ("render.method = \"tsit5\"", Engine::Integrator),
        ("spacetime.name = \"minkowski\"\ndisk.inner = 6", Engine::Integrator),
    ] {
        assert_eq!(read(text).render.engine, engine, "{text}");
    }

    // Units, one by one, and what headers say.
    assert_eq!(read("").units, Units::default());
    let s = read("[units]\nmass = 6.5e9\ndistance = 16.8e6\nfrequency = 230e9");
    let units = Units { mass: Some(6.5e9), distance: Some(16.8e6), frequency: Some(230e9) };
    assert_eq!(s.units, units);
    assert_eq!(read("units.mass = 10").units, Units { mass: Some(10.0), ..Units::default() });
    let s = read("target = { name = \"M87\", right_ascension = 180, declination = -90, mjd = 57850 }");
    assert_eq!((s.target.name.as_str(), s.target.right_ascension), ("M87", 180.0));
    assert_eq!((s.target.declination, s.target.mjd), (-90.0, 57850.0));
    for name in ["", " ", "M87★", &"M".repeat(61)] {
        let faults = Scene::from_toml(&format!("target.name = \"{name}\""), file).unwrap_err();
        assert!(faults.to_string().contains("give 1 to 60 printable characters of ASCII"), "{faults}");
    }

    // A layer that is shown is computed.
    let s = read(
        "camera.display = { layer = \"t\", order = 2, colormap = \"magma\", range = [1, 9], legend = false }",
    );
    let channel = Channel { layer: Layer::T, order: Some(2) };
    let shown =
        FalseColor { channel, colormap: Some(Colormap::Magma), range: Some([1.0, 9.0]), legend: false };
    assert_eq!((s.display.layer, s.render.layers), (Some(shown), vec![Layer::T]));
}

#[test]
fn windows_writes_scenes_too() {
    assert_eq!(scene("\u{feff}[spacetime]\r\nspin = 0.5\r\n").spacetime.spin(), Some(0.5));
}

/// The defaults of the schema, typed out, are the built-in scene.
#[test]
fn schema_tells_the_defaults() {
    fn defaults(schema: &serde_json::Value, path: &str, into: &mut String) {
        // A table of names that the user chooses has none.
        for (key, schema) in schema["properties"].as_object().into_iter().flatten() {
            let path = format!("{path}{key}");
            if path == "other_sky" {
                // Given, even if with its defaults alone, it is a second sky.
                continue;
            }
            if schema["type"] == "object" {
                defaults(schema, &format!("{path}."), into);
            } else if let Some(default) = schema.get("default") {
                assert!(!default.is_null(), "{path}");
                into.extend([&path, " = ", &default.to_string(), "\n"]);
            }
        }
    }
    let mut text = String::new();
    defaults(&SceneFile::schema(), "", &mut text);
    assert!(text.contains("observer.distance = 30.4\n"), "{text}");
    // `field_of_view` and the like say there what they are in the built-in scene.
    let typed = SceneFile::from_toml(&text).unwrap();
    assert_eq!(typed, SceneFile::default().complete());
    assert_eq!(SceneFile::from_toml("").unwrap(), SceneFile::default());
}

/// Every key says what it means, and every number has its bounds.
#[test]
fn schema_describes_every_key() {
    fn walk(schema: &serde_json::Value, path: &str) {
        assert_eq!(schema["additionalProperties"], false, "{path}");
        for (key, schema) in schema["properties"].as_object().unwrap() {
            let path = format!("{path}.{key}");
            assert!(schema["description"].is_string(), "{path}");
            if schema["type"] == "number" || schema["type"] == "integer" {
                let lower = schema.get("minimum").or(schema.get("exclusiveMinimum"));
                assert!(lower.is_some() && schema.get("maximum").is_some(), "{path}");
            }
            // Tables of names that the user chooses have values of one kind.
            if schema["type"] == "object" && !schema["additionalProperties"].is_object() {
                walk(schema, &path);
            }
        }
    }
    walk(&SceneFile::schema(), "");
}
