//! Things in flat space, against closed forms.

use crate::common;

use std::f64::consts::PI;

use common::{converges, film, linear, stage, statistics};
use kerrscope::spacetime::tensor::{Vec3, cross, dot};

const FLAT: &str = "spacetime.name = \"minkowski\"\n";

fn minus(a: Vec3<f64>, b: Vec3<f64>) -> Vec3<f64> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn unit(a: Vec3<f64>) -> Vec3<f64> {
    a.map(|c| c / dot(&a, &a).sqrt())
}

/// Area of the light in a picture of a camera at [0, −10, 0] that looks along y with a field of 60°, in units of the
/// square of the distance to the screen.
fn lit_area(thing: &str) -> f64 {
    let film = film(&format!(
        "{FLAT}observer.position = [0, -10, 0]\nscreen = {{ field_of_view = 60, look_at = [0, 0, 0] }}\n\
         sky.kind = \"black\"\nrender = {{ width = 120, height = 80, samples = 64 }}\n\
         object = [{{ material = \"light\", color = [1, 1, 1], {thing} }}]"
    ));
    let height = 2.0 * 30_f64.to_radians().tan();
    statistics(&film)[0] * height * height * 1.5
}

/// A cone of half-angle α whose axis is at ψ from the line of sight cuts the screen in an ellipse with the half-axes
/// sin α cos α/(cos²ψ − sin²α) and sin α/√(cos²ψ − sin²α).
#[test]
fn a_sphere_covers_an_ellipse() {
    for (center, radius) in [([0.0, 0.0, 0.0], 2.0), ([3.0, 0.0, -1.0], 1.5), ([-4.0, 2.0, 3.0], 1.0)] {
        let off = minus(center, [0.0, -10.0, 0.0]);
        let far = dot(&off, &off).sqrt();
        let (cos, sin) = (off[1] / far, radius / far);
        let exact = PI * sin * sin * (1.0 - sin * sin).sqrt() / (cos * cos - sin * sin).powf(1.5);
        let found = lit_area(&format!("center = {center:?}, radius = {radius:?}"));
        assert!((found / exact - 1.0).abs() < 5e-3, "{found} {exact}");
    }
}

/// Straight edges are straight in a picture: the area is that of the polygon of the corners.
#[test]
fn a_square_covers_a_quadrangle() {
    let cases = [
        ([-2.0, 0.0, -2.0], [[4.0, 0.0, 0.0], [0.0, 0.0, 4.0]]),
        ([1.0, -1.0, -1.0], [[1.5, 2.0, 0.0], [0.0, 0.0, 2.5]]),
        ([-3.0, 0.0, -1.5], [[2.0, 1.0, 1.0], [0.0, 2.0, -2.0]]),
    ];
    for (corner, [a, b]) in cases {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[u, v]| -> [f64; 2] {
            let x: Vec3<f64> = std::array::from_fn(|i| corner[i] + u * a[i] + v * b[i]);
            [x[0] / (x[1] + 10.0), x[2] / (x[1] + 10.0)]
        });
        let twice: f64 = (0..4)
            .map(|k| {
                let (p, q) = (corners[k], corners[(k + 1) % 4]);
                p[0] * q[1] - p[1] * q[0]
            })
            .sum();
        let exact = 0.5 * twice.abs();
        let found =
            lit_area(&format!("shape = \"parallelogram\", corner = {corner:?}, edges = [{a:?}, {b:?}]"));
        assert!((found / exact - 1.0).abs() < 5e-3, "{found} {exact}");
    }
}

/// An annulus that faces the camera, and what is seen through its hole.
#[test]
fn an_annulus_covers_a_ring() {
    let found =
        lit_area("shape = \"annulus\", center = [0, 0, 0], normal = [0, 1, 0], inner = 1, outer = 2.5");
    let exact = PI * (2.5 * 2.5 - 1.0) / 100.0;
    assert!((found / exact - 1.0).abs() < 5e-3, "{found} {exact}");
}

/// Irradiance at a point with a normal from a polygon of radiance 1: E = ½ Σ θᵢ γᵢ·n, with θᵢ the angle that edge i spans
/// and γᵢ the normal of the plane through it and the point (Lambert 1760).
fn irradiance(point: Vec3<f64>, normal: Vec3<f64>, corners: [Vec3<f64>; 4]) -> f64 {
    let towards = corners.map(|corner| unit(minus(corner, point)));
    let sum: f64 = (0..4)
        .map(|k| {
            let (p, q) = (towards[k], towards[(k + 1) % 4]);
            dot(&p, &q).acos() * dot(&unit(cross(&p, &q)), &normal)
        })
        .sum();
    0.5 * sum.abs()
}

#[test]
fn a_luminous_square_lights_a_matt_floor() {
    let cases = [
        // Above; upright beside; leaning over.
        ([-3.0, -3.0, 3.0], [[6.0, 0.0, 0.0], [0.0, 6.0, 0.0]]),
        ([1.5, -4.0, 0.0], [[0.0, 8.0, 0.0], [0.0, 0.0, 8.0]]),
        ([-5.0, -3.0, 2.0], [[5.0, 1.0, 2.0], [0.0, 6.0, 0.0]]),
    ];
    let color = 0.7;
    for (corner, [a, b]) in cases {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]
            .map(|[u, v]| -> Vec3<f64> { std::array::from_fn(|i| corner[i] + u * a[i] + v * b[i]) });
        let exact = linear(color) * irradiance([0.0; 3], [0.0, 0.0, 1.0], corners) / PI;
        let film = film(&format!(
            "{FLAT}observer.position = [0, -6, 1.5]\nscreen = {{ field_of_view = 0.01, look_at = [0, 0, 0] }}\n\
             sky.kind = \"black\"\nrender = {{ width = 16, height = 16, samples = 16384 }}\n\
             object = [\n\
             {{ shape = \"annulus\", center = [0, 0, 0], outer = 50, color = [{color}, {color}, {color}] }},\n\
             {{ shape = \"parallelogram\", corner = {corner:?}, edges = [{a:?}, {b:?}], material = \"light\", \
             color = [1, 1, 1] }},\n]"
        ));
        let [mean, _] = statistics(&film);
        assert!((mean / exact - 1.0).abs() < 5e-3, "{mean} {exact}");
    }
}

/// A matt ball in a white sky: whatever is scattered comes from the sky, so that every path has the exact value.
#[test]
fn a_matt_ball_in_a_white_sky_has_its_albedo() {
    for color in [0.3, 0.8, 1.0] {
        let film = film(&format!(
            "{FLAT}observer.position = [0, -10, 0]\nscreen.field_of_view = 5\n\
             sky = {{ kind = \"uniform\", color = [1, 1, 1] }}\n\
             render = {{ width = 8, height = 8, samples = 4 }}\n\
             object = [{{ center = [0, 0, 0], radius = 2, color = [{color}, {color}, {color}] }}]"
        ));
        for light in &film.light {
            assert!((f64::from(light[1]) - linear(color)).abs() < 1e-6, "{light:?} {color}");
        }
    }
}

/// The integrating sphere: a matt sphere of albedo ρ and radius 1 around a luminous ball of radius b and radiance 1. The
/// ball gives the wall the irradiance πb², and takes the share b² of what the wall sends, so that the wall's radiance is
/// ρ b²/(1 − ρ(1 − b²)).
#[test]
fn an_integrating_sphere_is_as_bright_as_it_should_be() {
    let (color, b) = (0.9, 0.4);
    let rho = linear(color);
    let exact = rho * b * b / (1.0 - rho * (1.0 - b * b));
    let text = format!(
        "{FLAT}observer.position = [0, -6, 1]\nscreen = {{ field_of_view = 60, look_at = [0, -9, 3] }}\n\
         sky.kind = \"black\"\nrender = {{ width = 32, height = 32, samples = SAMPLES, bounces = 1000 }}\n\
         object = [\n{{ center = [0, 0, 0], radius = 10, color = [{color}, {color}, {color}] }},\n\
         {{ center = [0, 0, 0], radius = 4, material = \"light\", color = [1, 1, 1] }},\n]"
    );
    converges(&text, exact, &[4, 16, 64, 256]);
}

/// Surfaces with nothing in them: where two pass through one another the nearer one is seen, and from within a sphere its
/// inside, up to a thing that comes first.
#[test]
fn things_may_overlap_and_hold_the_camera() {
    let text = format!(
        "{FLAT}observer.position = [0, -10, 0]\nscreen = {{ field_of_view = 40, look_at = [0, 0, 0] }}\n\
         render = {{ width = 90, height = 60, layers = [\"fate\", \"depth\", \"sky_theta\"] }}\nobject = [\n\
         {{ center = [-0.5, 0, 0], radius = 1.5, material = \"light\", color = [1, 0, 0] }},\n\
         {{ center = [0.5, 0, 0], radius = 1.5, material = \"light\", color = [0, 1, 0] }},\n\
         {{ center = [0, 0, 0], radius = 20, material = \"light\", color = [0, 0, 1] }},\n]"
    );
    let film = film(&text);
    let [fate, theta, depth] =
        [0, 1, 2].map(|k| film.planes[k].values.iter().map(|v| f64::from(*v)).collect::<Vec<_>>());
    let mut seen = [0; 3];
    for (k, light) in film.light.iter().enumerate() {
        let (x, y) = (k % 90, k / 90);
        let right = (x as f64 + 0.5 - 45.0) / 30.0 * 20_f64.to_radians().tan();
        let up = (30.0 - y as f64 - 0.5) / 30.0 * 20_f64.to_radians().tan();
        let v = unit([right, 1.0, up]);
        // The first of the balls, or the shell from within.
        let first = |center: f64, radius: f64| {
            let o = [-center, -10.0, 0.0];
            let (along, square) = (dot(&o, &v), dot(&o, &o) - radius * radius);
            let root = (along * along - square).sqrt();
            if square > 0.0 { -along - root } else { -along + root }
        };
        let distances = [first(-0.5, 1.5), first(0.5, 1.5), first(0.0, 20.0)];
        let nearest = distances.iter().copied().filter(|d| !d.is_nan()).fold(f64::INFINITY, f64::min);
        assert!((depth[k] / nearest - 1.0).abs() < 1e-6, "{x} {y} {} {nearest}", depth[k]);
        assert!(fate[k] == 3.0 && theta[k].is_nan());
        let color = (0..3).find(|c| distances[*c] == nearest).unwrap();
        // All samples of the pixel see the same but at edges.
        seen[color] += usize::from(light[color] == 1.0);
    }
    assert!(seen[0] > 200 && seen[1] > 200 && seen[2] > 3000, "{seen:?}");
}

/// Too few bounces make it darker, by what is missing: the geometric series is cut.
#[test]
fn a_bounce_limit_cuts_the_series() {
    let (color, b) = (0.9, 0.4);
    let rho = linear(color);
    // Light that was scattered once, and twice.
    let exact = rho * b * b * (1.0 + rho * (1.0 - b * b));
    let text = format!(
        "{FLAT}observer.position = [0, -6, 1]\nscreen = {{ field_of_view = 60, look_at = [0, -9, 3] }}\n\
         sky.kind = \"black\"\nrender = {{ width = 32, height = 32, samples = SAMPLES, bounces = 2 }}\n\
         object = [\n{{ center = [0, 0, 0], radius = 10, color = [{color}, {color}, {color}] }},\n\
         {{ center = [0, 0, 0], radius = 4, material = \"light\", color = [1, 1, 1] }},\n]"
    );
    converges(&text, exact, &[4, 16, 64, 256]);
}

/// Light of moving matter: g = 1/γ(1 − v·n), n from the matter to the camera; and of the white sky in a moving mirror, which
/// is Einstein's (1905): what arrives along the normal goes back with the frequency (1 + v)/(1 − v).
#[test]
fn moving_matter_shifts_its_light() {
    let seen = |motion: &str, material: &str, shifts: bool| {
        let stage = stage(&format!(
            "{FLAT}observer.position = [20, 0, 0]\nsky = {{ kind = \"uniform\", color = [1, 1, 1] }}\n\
             render.shifts = {shifts}\n\
             object = [{{ shape = \"annulus\", center = [10, 0, 0], normal = [1, 0, 0], outer = 1, \
             material = \"{material}\", color = [1, 1, 1], motion = {motion} }}]"
        ));
        common::ray(&stage, [480.0, 270.0])[1]
    };
    for v in [0.4, -0.7] {
        let gamma = 1.0 / f64::sqrt(1.0 - v * v);
        let towards = (gamma * (1.0 - v)).recip().powi(4);
        assert!((seen(&format!("[{v}, 0, 0]"), "light", true) / towards - 1.0).abs() < 1e-9);
        let aside = gamma.recip().powi(4);
        assert!((seen(&format!("[0, 0, {v}]"), "light", true) / aside - 1.0).abs() < 1e-9);
        let mirrored = ((1.0 + v) / (1.0 - v)).powi(4);
        let found = seen(&format!("[{v}, 0, 0]"), "mirror", true);
        assert!((found / mirrored - 1.0).abs() < 1e-9, "{found} {mirrored}");
        assert_eq!(seen(&format!("[{v}, 0, 0]"), "light", false), 1.0);
    }
    assert!((seen("\"static\"", "mirror", true) - 1.0).abs() < 1e-12);
}
