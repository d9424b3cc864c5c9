//! What is written is read again.

use std::path::Path;

use kerrscope::disk::{Limb, Mapping};
use kerrscope::display::{Colormap, Tone};
use kerrscope::material::Finish;
use kerrscope::render::Layer;
use kerrscope::scene::file::{
    Camera, Disk, DiskModel, Display, ImageFrame, Inner, Isco, Motion, MotionName, Object, ObjectMotion,
    ObjectMotionName, Observer, RelativeTo, Render, Screen, ScreenKind, ShapeName, Shown, Sky, SkyKind,
    Spacetime, SpacetimeName, Target, Texture, TextureKind, Turns, Units, Velocity,
};
use kerrscope::scene::{Coordinates, Engine, Method, Scene, SceneFile};
use kerrscope::sky::Frame;
use proptest::prelude::*;
use proptest::{option, sample};

/// A number of a range, or one of its ends, or a whole one.
fn number(min: f64, max: f64) -> impl Strategy<Value = f64> {
    let near = move |x: f64| {
        if x.round() < min { x } else { x.round().min(max) }
    };
    prop_oneof![6 => min..max, 1 => Just(max), 2 => (min..max).prop_map(near)]
}

fn vector(min: f64, max: f64) -> impl Strategy<Value = [f64; 3]> {
    [number(min, max), number(min, max), number(min, max)]
}

/// Those that every observer is covered by.
fn chart() -> impl Strategy<Value = Option<Coordinates>> {
    option::of(Just(Coordinates::KerrSchild))
}

fn spacetimes() -> impl Strategy<Value = Spacetime> {
    // Of texts `metric_faults` reads what is written: what goes with them is another choice.
    prop_oneof![
        (option::of(number(-1.0, 1.0)), chart()).prop_map(|(spin, chart)| Spacetime {
            name: SpacetimeName::Kerr,
            spin,
            chart,
            ..Spacetime::default()
        }),
        (option::of(Just(0.0)), chart()).prop_map(|(spin, chart)| Spacetime {
            name: SpacetimeName::Schwarzschild,
            spin,
            chart,
            ..Spacetime::default()
        }),
        option::of(number(-1.0, 1.0)).prop_map(|spin| Spacetime {
            name: SpacetimeName::Minkowski,
            spin,
            ..Spacetime::default()
        }),
    ]
}

fn motions() -> impl Strategy<Value = Motion> {
    prop_oneof![
        sample::select(vec![MotionName::Static, MotionName::Zamo, MotionName::Fall]).prop_map(Motion::Named),
        vector(-0.57, 0.57).prop_map(Motion::Velocity),
        (vector(-0.57, 0.57), sample::select(vec![RelativeTo::Zamo, RelativeTo::Fall]))
            .prop_map(|(velocity, relative_to)| Motion::Relative(Velocity { velocity, relative_to })),
    ]
}

/// Observers outside of everything, and the screens that suit them.
fn observers() -> impl Strategy<Value = (Observer, Screen)> {
    let screens = || {
        (
            sample::select(vec![ScreenKind::Pinhole, ScreenKind::Angular, ScreenKind::Impact]),
            option::of(number(1e-6, 179.0)),
            number(-1e6, 1e6),
            option::of(vector(-2.0, 2.0)),
        )
            .prop_map(|(kind, field_of_view, roll, look_at)| {
                let look_at = look_at.filter(|_| kind != ScreenKind::Impact);
                Screen { kind, field_of_view, roll, look_at }
            })
    };
    let polar = (
        option::of(number(5.0, 1e15)),
        option::of(number(0.0, 180.0)),
        option::of(number(-1e6, 1e6)),
        motions(),
    )
        .prop_map(|(distance, inclination, azimuth, motion)| Observer {
            distance,
            inclination,
            azimuth,
            position: None,
            motion,
        });
    let cartesian = (vector(-1e15, 1e15), motions()).prop_map(|(mut position, motion)| {
        position[2] = position[2].abs().max(9.0);
        Observer { position: Some(position), motion, ..Observer::default() }
    });
    let far = option::of(number(0.0, 180.0)).prop_map(|inclination| {
        let observer = Observer { distance: Some(f64::INFINITY), inclination, ..Observer::default() };
        (observer, Screen { kind: ScreenKind::Impact, ..Screen::default() })
    });
    prop_oneof![4 => (polar, screens()), 4 => (cartesian, screens()), 1 => far]
}

fn disks() -> impl Strategy<Value = Disk> {
    let numbers =
        (number(10.0, 1e15), number(0.0, 180.0), number(-1e6, 1e6), number(0.0, 1e12), number(0.0, 1.0));
    let inner = prop_oneof![Just(Inner::Isco(Isco::Isco)), number(2.1, 9.5).prop_map(Inner::Radius),];
    let mapping = option::of(sample::select(vec![Mapping::Around, Mapping::Flat]));
    let models = sample::select(vec![DiskModel::Ring, DiskModel::Image, DiskModel::None]);
    (numbers, inner, models, vector(0.0, 1.0), 0..=i64::MAX as u64, mapping).prop_map(
        |((outer, tilt, node, brightness, opacity), inner, model, color, seed, mapping)| {
            let image = (model == DiskModel::Image).then(|| "Cargo.toml".to_owned());
            let mapping = mapping.filter(|_| model == DiskModel::Image);
            let drawn = Disk::default();
            Disk {
                model,
                inner,
                outer,
                tilt,
                node,
                color,
                brightness,
                opacity,
                seed,
                image,
                mapping,
                ..drawn
            }
        },
    )
}

/// Disks that shine lie in the equator.
fn shining() -> impl Strategy<Value = Disk> {
    let light = prop_oneof![
        Just((None, None, None)),
        Just((Some(Shown::Bolometric), None, None)),
        (option::of(number(1.0, 1e12)), option::of(number(1.0, 10.0)))
            .prop_map(|(temperature, correction)| (Some(Shown::Blackbody), temperature, correction)),
    ];
    let switches = [option::of(any::<bool>()), option::of(any::<bool>()), option::of(any::<bool>())];
    let orders = option::of(prop::collection::vec(0_u32..=1000, 1..9));
    let choices =
        (option::of(number(-20.0, 20.0)), option::of(Just(Limb::ElectronScattering)), any::<bool>());
    (disks(), light, switches, orders, choices).prop_map(
        |(disk, (light, temperature, color_correction), switches, orders, (index, limb, retrograde))| Disk {
            model: DiskModel::PowerLaw,
            inner: Inner::Radius(9.5),
            tilt: 0.0,
            image: None,
            mapping: None,
            turns: if retrograde { Turns::Retrograde } else { Turns::Prograde },
            optically_thin: retrograde,
            orders,
            doppler: switches[0],
            gravitational: switches[1],
            beaming: switches[2],
            index,
            light,
            limb,
            temperature,
            color_correction,
            ..disk
        },
    )
}

fn skies() -> impl Strategy<Value = Sky> {
    let frames = sample::select(vec![Frame::Galactic, Frame::Equatorial]);
    let drawn = sample::select(vec![ImageFrame::Scene, ImageFrame::Galactic, ImageFrame::Equatorial]);
    let kinds = vec![
        SkyKind::Black,
        SkyKind::Uniform,
        SkyKind::Gradient,
        SkyKind::Grid,
        SkyKind::Stars,
        SkyKind::Panorama,
    ];
    let all = (
        sample::select(kinds),
        option::of(vector(0.0, 1.0)),
        option::of(number(0.0, 1e12)),
        option::of((1..=90_u32).prop_map(|lines| 90.0 / f64::from(lines))),
        (option::of(frames), option::of(drawn), option::of(number(-1e6, 1e6)), option::of(vector(-1e6, 1e6))),
    );
    all.prop_map(|(kind, color, brightness, spacing, (frame, image_frame, longitude, rotation))| {
        let plain = Sky { kind, brightness, ..Sky::default() };
        let turned = Sky { longitude, rotation, ..plain.clone() };
        match kind {
            SkyKind::Black => plain,
            SkyKind::Uniform => Sky { color, ..plain },
            SkyKind::Gradient => Sky { color, zenith: rotation.map(|r| r.map(|c| c.abs() / 1e6)), ..plain },
            SkyKind::Grid => Sky { color, spacing, ..plain },
            SkyKind::Stars => Sky { frame, ..turned },
            SkyKind::Panorama => {
                let scene = image_frame.is_none_or(|drawn| drawn == ImageFrame::Scene);
                let frame = frame.filter(|_| !scene);
                Sky { image: Some("src/../Cargo.toml".to_owned()), frame, image_frame, ..turned }
            }
        }
    })
}

fn renders() -> impl Strategy<Value = Render> {
    (
        (1..=16384_u32, 1..=2048_u32, 1..=2048_u32),
        0..=i64::MAX as u64,
        any::<bool>(),
        (
            sample::select(vec![Engine::Auto, Engine::ClosedForm, Engine::Integrator]),
            option::of(any::<bool>()),
        ),
        sample::select(vec![Method::Dop853, Method::Tsit5, Method::Rk4]),
        number(1e-14, 1e-2),
        option::of(number(1e-9, 1e3)),
        (1..=1_000_000_u32, 1..=64_u32, 0..=1000_u32, any::<bool>()),
        sample::subsequence(Layer::ALL.to_vec(), 0..=Layer::ALL.len()),
    )
        .prop_map(|(size, seed, jitter, (engine, adaptive), method, tolerance, step, most, layers)| {
            Render {
                width: size.0,
                height: size.1,
                samples: size.2,
                seed,
                jitter,
                engine,
                method,
                tolerance: tolerance.clamp(1e-14, 1e-2),
                step: step.filter(|_| method == Method::Rk4),
                max_steps: most.0,
                max_crossings: most.1,
                bounces: most.2,
                shifts: most.3,
                adaptive,
                adaptive_error: tolerance.clamp(1e-10, 1e-2),
                layers,
            }
        })
}

fn cameras() -> impl Strategy<Value = Camera> {
    let tones = sample::select(vec![Tone::Neutral, Tone::Filmic, Tone::None]);
    let maps = sample::select(vec![Colormap::Viridis, Colormap::Hue]);
    let shown = (sample::select(Layer::ALL.to_vec()), option::of(0..=2_u8), option::of(maps), any::<bool>());
    (number(-30.0, 30.0), tones, sample::select(vec![8, 16]), option::of(shown)).prop_map(
        |(exposure, tone, bits, shown)| {
            let plain = Display { exposure, tone, bits, ..Display::default() };
            let display = shown.map_or(plain.clone(), |(layer, order, colormap, legend)| {
                let order = order.filter(|_| layer.has_orders());
                Display { layer: Some(layer), order, colormap, legend: Some(legend), ..plain }
            });
            Camera { display }
        },
    )
}

fn textures() -> impl Strategy<Value = Texture> {
    let kinds = vec![
        TextureKind::Solid,
        TextureKind::Checker,
        TextureKind::Image,
        TextureKind::Noise,
        TextureKind::Earth,
    ];
    let numbers =
        (option::of(number(1e-9, 1e9)), option::of(0..=i64::MAX as u64), option::of([1..=9_u32, 1..=9_u32]));
    (sample::select(kinds), option::of(vector(0.0, 1.0)), numbers).prop_map(
        |(kind, color, (size, seed, squares))| match kind {
            TextureKind::Solid | TextureKind::Earth => Texture { kind, ..Texture::default() },
            TextureKind::Checker => Texture { kind, color, squares, ..Texture::default() },
            TextureKind::Image => Texture { kind, path: Some("Cargo.toml".to_owned()), ..Texture::default() },
            TextureKind::Noise => Texture { kind, color, size, seed, ..Texture::default() },
        },
    )
}

/// Things far from any hole, and those that orbit it.
fn objects() -> impl Strategy<Value = Object> {
    let shapes = sample::select(vec![ShapeName::Sphere, ShapeName::Parallelogram, ShapeName::Annulus]);
    let finishes = sample::select(vec![Finish::Matt, Finish::Light, Finish::Mirror]);
    let motions = prop_oneof![
        Just(ObjectMotion::Named(ObjectMotionName::Static)),
        vector(-0.57, 0.57).prop_map(ObjectMotion::Velocity),
    ];
    let looks = (finishes, option::of(vector(0.0, 1.0)), option::of(number(0.0, 1e12)), textures(), motions);
    let places =
        (vector(20.0, 1e9), number(0.5, 9.0), option::of(number(0.0, 0.4)), option::of(vector(0.1, 1.0)));
    (shapes, looks, places).prop_map(|(shape, looks, (at, size, inner, normal))| {
        let (material, color, brightness, texture, motion) = looks;
        let brightness = brightness.filter(|_| material == Finish::Light);
        let plain = Object { shape, material, color, brightness, texture, motion, ..Object::default() };
        match shape {
            ShapeName::Sphere => Object { center: Some(at), radius: Some(size), rotation: normal, ..plain },
            ShapeName::Parallelogram => {
                Object { corner: Some(at), edges: Some([[size, 0.0, 1.0], [0.0, size, -1.0]]), ..plain }
            }
            ShapeName::Annulus => Object { center: Some(at), outer: Some(size), inner, normal, ..plain },
        }
    })
}

fn headers() -> impl Strategy<Value = (Units, Target)> {
    let units =
        (option::of(number(1e-20, 1e9)), option::of(number(1.0, 1e12)), option::of(number(1.0, 1e30)))
            .prop_map(|(mass, distance, frequency)| Units { mass, distance, frequency });
    let target =
        ("[!-~][ -~]{0,58}[!-~]", number(0.0, 360.0), number(-90.0, 90.0), number(0.0, 1e6)).prop_map(
            |(name, right_ascension, declination, mjd)| Target { name, right_ascension, declination, mjd },
        );
    (units, prop_oneof![Just(Target::default()), target])
}

fn scene_files() -> impl Strategy<Value = SceneFile> {
    let things = prop_oneof![3 => Just(Vec::new()), 1 => proptest::collection::vec(objects(), 0..4)];
    let disks = prop_oneof![2 => disks(), 1 => shining()];
    (spacetimes(), observers(), disks, things, skies(), renders(), cameras(), headers()).prop_map(
        |(spacetime, (mut observer, screen), mut disk, object, sky, render, camera, (units, target))| {
            if spacetime.name == SpacetimeName::Minkowski && disk.inner == Inner::Isco(Isco::Isco) {
                disk.inner = Inner::Radius(3.0);
            }
            let mut render = render;
            if screen.kind == ScreenKind::Impact {
                observer.motion = Motion::Named(MotionName::Static);
            }
            if observer.distance == Some(f64::INFINITY) && render.method == Method::Rk4 {
                (render.method, render.step) = (Method::Dop853, None);
            }
            let tilted = disk.model != DiskModel::None && disk.tilt != 0.0;
            let things = !object.is_empty();
            if things || disk.model.shines() {
                render.adaptive = None;
            }
            if spacetime.name == SpacetimeName::Minkowski
                || tilted
                || things
                || render.method != Method::Dop853
            {
                // Not for the closed form.
                render.engine = Engine::Integrator;
            }
            SceneFile {
                spacetime,
                observer,
                screen,
                disk,
                object,
                sky,
                other_sky: None,
                render,
                camera,
                units,
                target,
            }
        },
    )
}

proptest! {
    #[test]
    fn what_is_written_is_read(file in scene_files()) {
        let text = file.to_toml();
        prop_assert_eq!(&SceneFile::from_toml(&text).unwrap(), &file, "{}", text);

        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        let built = file.build(folder);
        prop_assert!(built.is_ok(), "{}\n{}", text, built.unwrap_err());
        let built = built.unwrap();
        prop_assert_eq!(built.file(), &file.complete());
        prop_assert_eq!(&built.file().complete(), built.file());
        // The record of a scene is that scene.
        let again = Scene::from_toml(&built.to_toml(), folder).unwrap();
        prop_assert_eq!(again.to_toml(), built.to_toml());
        prop_assert_eq!(again, built);
    }
}
