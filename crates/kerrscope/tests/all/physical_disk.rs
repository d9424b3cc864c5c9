//! Disks that shine by physics, against what is known of them.

use std::f64::consts::PI;
use std::path::Path;

use kerrscope::light::Radiance;
use kerrscope::render::{Channel, Film, Layer, Stage, Watch, continuum, draw};
use kerrscope::scene::Scene;
use kerrscope::spacetime::emitter::{Circular, Sense};

fn film(text: &str) -> Film {
    let scene = Scene::from_toml(text, Path::new("")).unwrap_or_else(|faults| panic!("{text}\n{faults}"));
    draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap()
}

fn faults(text: &str) -> String {
    Scene::from_toml(text, Path::new("")).unwrap_err().to_string()
}

/// An opaque disk in flat space, seen from all sides: the integral over all directions of the observer of D² times the
/// flux is its luminosity, 2 ∫ F 2πr dr. Seen from infinity D² F = ∫ I dα dβ. Over inclination by Gauss and Legendre's rule:
/// I is the same from everywhere, so that the integrand is a constant times cos i sin i.
#[test]
fn what_all_observers_see_is_the_luminosity() {
    // F by straight lines: ∫ F r dr is exact piece by piece.
    let knots = [[2.0, 0.0], [4.0, 1.5], [7.0, 0.4], [9.0, 0.0]];
    let luminosity: f64 = knots
        .windows(2)
        .map(|pair| {
            let ([a, f], [b, g]) = (pair[0], pair[1]);
            // ∫ (f + (g − f)(r − a)/(b − a)) r dr.
            (b - a) * (f * (2.0 * a + b) + g * (a + 2.0 * b)) / 6.0
        })
        .sum::<f64>()
        * 4.0
        * PI;
    let [low, high] = [0.5 - 0.5 / 3f64.sqrt(), 0.5 + 0.5 / 3f64.sqrt()];
    let size = 1400_u32;
    let mut seen = 0.0;
    // s = sin²i runs from 0 to 1 above the disk, and again below it: 2π ∫ … sin i di = π ∫ … ds/cos i.
    for square in [low, high] {
        let inclination = square.sqrt().asin().to_degrees();
        let text = format!(
            "spacetime.name = \"minkowski\"\nobserver = {{ distance = inf, inclination = {inclination} }}\n\
             screen = {{ kind = \"impact\", field_of_view = 19 }}\nsky.kind = \"black\"\n\
             disk = {{ model = \"profile\", inner = 2, outer = 9, profile = {knots:?} }}\n\
             render = {{ width = {size}, height = {size}, samples = 1, jitter = false }}"
        );
        let film = film(&text);
        assert_eq!(film.radiance, Some(Radiance::Bolometric));
        let pixel = (19.0 / f64::from(size)).powi(2);
        let flux = film.intensity.iter().sum::<f64>() * pixel;
        seen += 2.0 * PI * 0.5 * flux / (1.0 - square).sqrt();
    }
    assert!((seen / luminosity - 1.0).abs() < 1e-6, "{} {luminosity}", seen / luminosity);
}

/// Face-on from infinity g = √(1 − 3/r) without spin, and 1/u^t with it.
#[test]
fn face_on_shifts_are_analytic() {
    for (spin, model) in [(0.0, "page-thorne"), (0.7, "page-thorne"), (-0.5, "power-law")] {
        let text = format!(
            "spacetime.spin = {spin:?}\nobserver = {{ distance = inf, inclination = 0 }}\n\
             screen = {{ kind = \"impact\", field_of_view = 40 }}\nsky.kind = \"black\"\n\
             disk = {{ model = \"{model}\", outer = 100, orders = [0] }}\n\
             render = {{ width = 24, height = 24, samples = 1, jitter = false, layers = [\"r\", \"g\", \"intensity\"] }}"
        );
        let film = film(&text);
        let plane = |layer| &film.plane(Channel { layer, order: Some(0) }).unwrap().values;
        let matter = Circular::kerr(spin, Sense::Prograde);
        let mut compared = 0;
        for (pixel, (r, g)) in plane(Layer::R).iter().zip(plane(Layer::G)).enumerate() {
            let r = f64::from(*r);
            let Some(orbit) = matter.orbit(r) else { continue };
            let exact = orbit.time.recip();
            if spin == 0.0 {
                assert!((exact - (1.0 - 3.0 / r).sqrt()).abs() < 1e-14);
            }
            assert!((f64::from(*g) / exact - 1.0).abs() < 2e-7, "{r} {g} {exact}");
            let flux = if model == "page-thorne" { matter.flux(r) } else { r.powi(-3) };
            let exact = exact.powi(4) * flux / PI;
            // r was kept with 24 bits.
            let slack = 1e-5 * (1.0 + 1.0 / (r / matter.isco().unwrap() - 1.0));
            assert!(
                (film.intensity[pixel] / exact - 1.0).abs() < slack,
                "{r} {} {exact}",
                film.intensity[pixel]
            );
            compared += 1;
        }
        assert!(compared > 300, "{compared}");
    }
}

/// Both engines, a text of the hole, and its components alone show the same disk.
#[test]
fn engines_and_texts_show_the_same_disk() {
    let scene = |spacetime: &str, engine: &str, inner: f64| {
        film(&format!(
            "{spacetime}\nobserver = {{ distance = inf, inclination = 70 }}\n\
             screen = {{ kind = \"impact\", field_of_view = 30 }}\nsky.kind = \"black\"\n\
             disk = {{ model = \"power-law\", inner = {inner:?}, outer = 12, limb = \"electron-scattering\" }}\n\
             render = {{ width = 48, height = 32, samples = 1, jitter = false, engine = \"{engine}\", tolerance = 1e-12 }}"
        ))
        .intensity
    };
    let kerr = "spacetime.spin = 0.6";
    // From within the ISCO (3.83 M), so that what falls is seen, too.
    let exact = scene(kerr, "closed-form", 2.5);
    let text = "spacetime.name = \"kerr-text\"\nspacetime.parameters.spin = 0.6";
    for found in [scene(kerr, "integrator", 2.5), scene(text, "integrator", 2.5)] {
        let peak = exact.iter().copied().fold(0.0, f64::max);
        let mut apart: Vec<f64> = exact.iter().zip(&found).map(|(a, b)| (a - b).abs() / peak).collect();
        apart.sort_unstable_by(f64::total_cmp);
        assert!(apart[apart.len() * 99 / 100] < 1e-9, "{:e}", apart[apart.len() * 99 / 100]);
        // Next to an edge a ray may meet the one or the other side of it.
        assert!(apart.iter().filter(|a| **a > 1e-7).count() <= 2);
    }
    assert!(exact.iter().filter(|i| **i > 0.0).count() > 150);
}

/// Each switch by itself: without all of them the disk is as bright as from next to it, and the factors multiply.
#[test]
fn shifts_are_switched_one_by_one() {
    let brightness = |switches: &str| {
        film(&format!(
            "spacetime.spin = 0.9\nobserver.inclination = 75\nsky.kind = \"black\"\n\
             disk = {{ model = \"power-law\", orders = [0], {switches} }}\n\
             render = {{ width = 40, height = 24, samples = 1, jitter = false }}"
        ))
        .intensity
    };
    let all = brightness("doppler = true");
    let [none, doppler, gravity] =
        ["doppler = false, gravitational = false", "gravitational = false", "doppler = false"]
            .map(brightness);
    let dim = brightness("beaming = false");
    let mut lit = 0;
    for i in 0..all.len() {
        if none[i] > 0.0 {
            lit += 1;
            assert!((doppler[i] * gravity[i] / (none[i] * all[i]) - 1.0).abs() < 1e-12);
            assert!(gravity[i] < none[i]);
            assert_eq!(dim[i], none[i]);
        }
    }
    // Light of the approaching side is brighter.
    let half =
        |from: usize| (0..all.len()).filter(|i| (i % 40 < 20) == (from == 0)).map(|i| all[i]).sum::<f64>();
    assert!(lit > 150 && half(0) > 3.0 * half(1), "{lit} {} {}", half(0), half(1));
}

/// Orders are parts of the whole: of a disk that holds nothing back their sum is it.
#[test]
fn orders_add_up() {
    let seen = |orders: &str| {
        film(&format!(
            "spacetime.spin = 0.5\nobserver.inclination = 60\nsky.kind = \"black\"\n\
             disk = {{ model = \"power-law\", optically_thin = true{orders} }}\n\
             render = {{ width = 64, height = 36, samples = 1, jitter = false, max_crossings = 3 }}"
        ))
        .intensity
    };
    let all = seen("");
    let parts = ["[0]", "[1]", "[2]"].map(|n| seen(&format!(", orders = {n}")));
    for (i, whole) in all.iter().enumerate() {
        let sum: f64 = parts.iter().map(|part| part[i]).sum();
        assert!((sum - whole).abs() < 1e-15, "{sum} {whole}");
    }
    let total = parts.map(|part| part.iter().sum::<f64>());
    assert!(total[0] > total[1] && total[1] > total[2], "{total:?}");
}

/// A pattern turns with its matter: after a whole turn of the middle of a narrow ring it is as it was.
#[test]
fn a_pattern_turns_with_its_matter() {
    let r: f64 = 10.0;
    let turn = 2.0 * PI * (r * r.sqrt() + 0.9);
    let at = |time: &str| {
        film(&format!(
            "spacetime.spin = 0.9\nsky.kind = \"black\"\n\
             disk = {{ inner = 9.999, outer = 10.001{time} }}\nobserver.inclination = 10\n\
             render = {{ width = 600, height = 600, samples = 1, jitter = false, adaptive = false }}"
        ))
        .light
    };
    let [first, same, other] = [0.0, turn, 0.5 * turn].map(|time| at(&format!(", time = {time:?}")));
    let apart =
        |a: &[[f32; 3]], b: &[[f32; 3]]| -> f32 { a.iter().zip(b).map(|(a, b)| (a[0] - b[0]).abs()).sum() };
    assert!(
        apart(&first, &same) < 0.02 * apart(&first, &other),
        "{} {}",
        apart(&first, &same),
        apart(&first, &other)
    );
}

#[test]
fn disks_that_cannot_shine_are_refused() {
    for (text, said) in [
        (
            "spacetime.name = \"minkowski\"\ndisk = { model = \"page-thorne\", inner = 3 }",
            "nothing orbits in flat space",
        ),
        ("disk = { model = \"page-thorne\", tilt = 20 }", "equatorial plane only"),
        ("disk = { model = \"profile\" }", "needs `disk.profile`"),
        ("disk = { model = \"profile\", profile = [[6, 1], [5, 0]] }", "do not grow"),
        ("disk = { model = \"page-thorne\", index = 2 }", "power-law"),
        ("disk = { model = \"page-thorne\", light = \"blackbody\", accretion_rate = 1e-8 }", "`units.mass`"),
        ("disk = { model = \"page-thorne\" }\nrender.adaptive = true", "not interpolated"),
        ("spacetime.name = \"ellis\"\ndisk = { model = \"page-thorne\", inner = 2 }", "orbit"),
        (
            "spacetime.name = \"two-kerr\"\nobserver.distance = 60\ndisk = { model = \"power-law\", inner = 2 }",
            "same all around",
        ),
    ] {
        let found = faults(text);
        assert!(found.contains(said), "{text}\n{found}");
    }
}

/// The continuum at a frequency is what the picture shows at it; face-on in flat space that of a disk of one temperature is
/// `B_ν` times its area.
#[test]
fn the_continuum_is_that_of_the_picture() {
    let text = |frequency: f64| {
        format!(
            "units.frequency = {frequency:e}\nspacetime.spin = 0.9\nobserver.inclination = 70\nsky.kind = \"black\"\n\
             disk = {{ model = \"page-thorne\", light = \"blackbody\", color_correction = 1.5, opacity = 0.7, limb = \"electron-scattering\" }}\n\
             render = {{ width = 48, height = 27, samples = 4 }}"
        )
    };
    let frequencies = [1e13, 2e14, 3e15];
    let scene = Scene::from_toml(&text(1.0), Path::new("")).unwrap();
    let (found, _) = continuum(&Stage::new(&scene).unwrap(), &frequencies).unwrap();
    for (frequency, found) in frequencies.into_iter().zip(found) {
        let film = film(&text(frequency));
        assert_eq!(film.radiance, Some(Radiance::Specific));
        let mean = film.intensity.iter().sum::<f64>() / film.intensity.len() as f64;
        assert!((found / mean - 1.0).abs() < 1e-12, "{found} {mean}");
    }
    let size = 400;
    let text = format!(
        "spacetime.name = \"minkowski\"\nobserver = {{ distance = inf, inclination = 0 }}\nsky.kind = \"black\"\n\
         screen = {{ kind = \"impact\", field_of_view = 22 }}\n\
         disk = {{ model = \"power-law\", index = 0, light = \"blackbody\", temperature = 5000, inner = 4, outer = 10 }}\n\
         render = {{ width = {size}, height = {size}, samples = 4 }}"
    );
    let scene = Scene::from_toml(&text, Path::new("")).unwrap();
    let (found, _) = continuum(&Stage::new(&scene).unwrap(), &[3e14]).unwrap();
    let area = found[0] * 22.0 * 22.0 / kerrscope::spectrum::planck::per_frequency(3e14, 5000.0);
    assert!((area / (PI * 84.0) - 1.0).abs() < 1e-4, "{area}");
}
