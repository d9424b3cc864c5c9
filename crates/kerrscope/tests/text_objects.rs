//! Things and disks in metrics as text, against the same in the spacetimes that are built in.

use std::path::Path;

use kerrscope::render::{Film, Stage, Watch, draw};
use kerrscope::scene::Scene;

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
    let scene = Scene::from_toml(&format!("{spacetime}\n{THINGS}"), Path::new("")).unwrap();
    draw(&Stage::new(&scene).unwrap(), &Watch::default()).unwrap()
}

/// The same light to what a film keeps, but where a path passes next to an edge or a critical curve.
#[test]
fn texts_of_holes_show_the_things_of_the_holes() {
    for (text, built_in) in [
        (
            "[spacetime]\nname = \"kerr-text\"\nparameters.spin = 0.9",
            "[spacetime]\nname = \"kerr\"\nspin = 0.9",
        ),
        ("[spacetime]\nname = \"schwarzschild-text\"", "[spacetime]\nname = \"schwarzschild\""),
    ] {
        let [a, b] = [text, built_in].map(film);
        let mut apart: Vec<f64> = a
            .light
            .iter()
            .zip(&b.light)
            .map(|(a, b)| (0..3).map(|i| f64::from((a[i] - b[i]).abs())).fold(0.0, f64::max))
            .collect();
        apart.sort_unstable_by(f64::total_cmp);
        let share = |q: f64| apart[((apart.len() - 1) as f64 * q) as usize];
        println!(
            "{built_in}: half {:.1e}, 90 % {:.1e}, 99 % {:.1e}, all {:.1e}",
            share(0.5),
            share(0.9),
            share(0.99),
            share(1.0)
        );
        assert!(share(0.5) < 1e-7 && share(0.95) < 1e-6, "{} {}", share(0.5), share(0.95));
    }
}
