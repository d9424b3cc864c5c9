//! Things and disks in metrics as text, against the same in the spacetimes that are built in.

use crate::texts;

use std::path::Path as FilePath;
use std::sync::Arc;

use kerrscope::objects::{Shape, Sphere, World};
use kerrscope::render::{Film, Stage, Watch, draw};
use kerrscope::scene::{Scene, Spacetime};
use kerrscope::spacetime::geodesic::{Integrator, ObstacleTracer, Path, Query, Scheme, TextTracer};
use kerrscope::spacetime::metric::{Components, Kerr, Metric};
use kerrscope::spacetime::observer::{Drift, Motion, Observer, Place};
use texts::element;

/// A disk, a lamp, a matt ball, a mirror and a matt floor, of which one moves.
const THINGS: &str = r#"
[observer]
distance = 18
inclination = 75
[disk]
inner = 6
outer = 9
[sky]
kind = "gradient"
[[object]]
center = [3, 8, 2]
radius = 2
material = "light"
motion = [0, 0.2, 0.4]
[[object]]
center = [-6, -7, 0]
radius = 2.5
color = [0.9, 0.4, 0.2]
[[object]]
center = [5, -6, 3]
radius = 2
material = "mirror"
[[object]]
shape = "parallelogram"
corner = [-20, -20, -6]
edges = [[40, 0, 0], [0, 40, 0]]
[render]
width = 32
height = 20
samples = 2
bounces = 2
engine = "integrator"
tolerance = 1e-11
"#;

fn film(spacetime: &str) -> Film {
    let scene =
        Scene::from_toml(&format!("spacetime.name = \"{spacetime}\"\n{THINGS}"), FilePath::new("")).unwrap();
    draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap()
}

/// The same light, but where a path passes next to an edge or a critical curve. With spin a text's observer would stand
/// elsewhere: its r is that of the coordinates.
#[test]
fn a_text_shows_the_things_of_its_hole() {
    agree(&film("schwarzschild-text"), &film("schwarzschild"));
}

fn agree(a: &Film, b: &Film) {
    let mut apart: Vec<f64> = a
        .light
        .iter()
        .zip(&b.light)
        .map(|(a, b)| (0..3).map(|i| f64::from((a[i] - b[i]).abs())).fold(0.0, f64::max))
        .collect();
    apart.sort_unstable_by(f64::total_cmp);
    let share = |q: f64| apart[((apart.len() - 1) as f64 * q) as usize];
    assert!(share(0.5) < 1e-7 && share(0.95) < 1e-6, "{} {}", share(0.5), share(0.95));
}

/// The same by components alone.
#[test]
fn components_show_the_things_of_their_hole() {
    let text = format!("spacetime.name = \"schwarzschild\"\n{THINGS}");
    let scene = Scene::from_toml(&text, FilePath::new("")).unwrap();
    let scheme = Scheme::Dop853 { tolerance: 1e-11 };
    let stage = Stage::new(&scene).unwrap().in_metric(Components(Kerr::new(0.0)), scheme, 10_000);
    agree(&draw(&stage, &Watch::default()).unwrap(), &film("schwarzschild"));
}

/// Rays of one observer meet the same balls at the same places with the same momenta, and their matter, at rest, turning
/// and flying along the axis of the coordinates, finds the same of them.
#[test]
fn things_around_a_hole_that_turns_are_met_as_they_are_around_its_text() {
    let spin = 0.9;
    let text = element("kerr-text", &[("spin", spin)]);
    let scheme = Scheme::Dop853 { tolerance: 1e-12 };
    let observer =
        Observer::new(Some(spin), Place { r: 15.0, theta: 1.3, phi: 0.4 }, Motion::ZeroAngularMomentum)
            .unwrap();
    let ball = |x: [f64; 3]| Shape::Sphere(Sphere { center: x, radius: 1.5, axes: Sphere::axes([0.0; 3]) });
    let world = World::new(vec![ball([-9.0, 1.0, 0.5]), ball([0.0, 5.0, 1.0]), ball([2.0, -4.0, -3.0])]);
    let (mut hits, mut worst) = (0, 0.0_f64);
    for k in 0..2000 {
        let (up, across) = (f64::from(k / 50) / 40.0 - 0.5, f64::from(k % 50) / 50.0 - 0.5);
        let norm = (1.0 + up * up + 2.0 * across * across).sqrt();
        let ray = observer.ray([-1.0 / norm, up / norm, 2_f64.sqrt() * across / norm]);
        let growth = Kerr::new(-spin).sensitivity(ray.energy, &ray.start).max(1.0);
        if growth > 100.0 {
            continue;
        }
        let (mut a, mut b) = (Path::default(), Path::default());
        let query = Query::default();
        Integrator::new(Kerr::new(spin), scheme, 20_000).boxed().trace_among(&ray, &query, &world, &mut a);
        TextTracer::new(Arc::clone(&text), scheme, 20_000).trace_among(&ray, &query, &world, &mut b);
        assert_eq!((a.fate, a.crossings.len()), (b.fate, b.crossings.len()));
        let (Some(a), Some(b)) = (a.hit, b.hit) else { continue };
        assert_eq!(a.object, b.object);
        hits += 1;
        let [place, normal] = world.shape(a.object).settle(&a.position);
        for drift in [Drift::Static, Drift::Turning(0.02)] {
            let (at, text) = (Spacetime::Kerr { spin }, Spacetime::Text(Arc::clone(&text)));
            let exact = at.patch(place, normal, drift).unwrap().measure(a.energy, &a.momentum);
            let [place, normal] = world.shape(b.object).settle(&b.position);
            let found = text.patch(place, normal, drift).unwrap().measure(b.energy, &b.momentum);
            worst = worst.max((found.0 - exact.0).abs());
            // A grazing hit moves along the ball as the root of what the ray moves by.
            let grazing = exact.1[2].abs().max(1e-3);
            for i in 0..3 {
                worst = worst.max((found.1[i] - exact.1[i]).abs() * grazing);
            }
        }
    }
    assert!(hits > 150, "{hits}");
    assert!(worst < 1e-9, "{worst:e}");
}

/// Behind a throat, and where a metric has no value or light would not come from, nothing stands.
#[test]
fn things_that_cannot_be_are_refused() {
    for (spacetime, ball, what) in [
        ("ellis", "center = [0.4, 0, 0]\nradius = 0.3", "no matter can be"),
        ("kerr-text", "center = [0, 1.2, 0]\nradius = 0.3", "no matter can be"),
        ("majumdar-papapetrou", "center = [2, 0, 0]\nradius = 0.001", "no matter can be"),
        ("ellis", "center = [0, 5, 0]\nradius = 0.3\nmotion = \"orbit\"", "metric of its own"),
    ] {
        let text = format!("spacetime.name = \"{spacetime}\"\ndisk.model = \"none\"\n[[object]]\n{ball}\n");
        let faults = Scene::from_toml(&text, FilePath::new("")).unwrap_err().to_string();
        assert!(faults.contains(what) && faults.starts_with("scene:"), "{text}{faults}");
    }
}
