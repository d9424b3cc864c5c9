//! Things near holes: what scatters and shines there, against closed forms.

use crate::common;

use std::f64::consts::TAU;
use std::fmt::Write;

use common::{converges, film, linear, ray, scene, stage};
use kerrscope::camera::Camera;
use kerrscope::render::{Watch, draw, obstacle_tracer, world};
use kerrscope::spacetime::emitter::{Circular, Sense};
use kerrscope::spacetime::geodesic::{Fate, Hit, Integrator, Path, Query, Ray, Scheme};
use kerrscope::spacetime::metric::Kerr;
use kerrscope::spacetime::tensor::dot;

/// What a scene's ray at a point of the picture meets.
fn hit(text: &str, [x, y]: [f64; 2]) -> (Ray, Hit) {
    let scene = scene(text);
    let ray = Camera::new(&scene).unwrap().ray(x, y).unwrap();
    let mut path = Path::default();
    obstacle_tracer(&scene).trace_among(&ray, &Query::default(), &world(&scene), &mut path);
    (ray, path.hit.expect("the ray meets a thing"))
}

/// A small matt ball at r in a white sky, looked at from the hole's side: it has its albedo but for what comes from the
/// hole. That is seen by the ball as a disk of angular radius ψ, sin ψ = √27 √(1 − 2/r)/r (Synge 1966), and where all of it
/// is above the horizon, its middle at α from the normal, it is sin²ψ cos α of what a matt surface sees.
#[test]
fn a_matt_ball_next_to_a_hole_sees_its_shadow() {
    let color = 0.9;
    for (distance, side, shown) in [(6.0, 0.0, true), (12.0, 0.025, false)] {
        let text = format!(
            "spacetime.name = \"schwarzschild\"\nobserver.position = [0, {}, 0]\n\
             screen = {{ field_of_view = 0.001, look_at = [{side}, -{distance}, 0] }}\n\
             sky = {{ kind = \"uniform\", color = [1, 1, 1] }}\n\
             render = {{ width = 32, height = 32, samples = SAMPLES, tolerance = 1e-6, shifts = false }}\n\
             object = [{{ center = [0, -{distance}, 0], radius = 0.05, color = [{color}, {color}, {color}] }}]",
            -0.8 * distance
        );
        let (_, hit) = hit(&text.replace("SAMPLES", "1"), [16.0, 16.0]);
        let x = hit.position;
        let r = dot(&x, &x).sqrt();
        // The normal as the ball's matter has it: radial lengths are longer by 1/√(1 − 2/r).
        let normal = [x[0], x[1] + distance, x[2]].map(|c| c / 0.05);
        let radial = dot(&normal, &x) / r;
        let scale = (1.0 - 2.0 / r).sqrt();
        let cos = -radial * scale / (1.0 - radial * radial * (2.0 / r)).sqrt();
        let sin_shadow = 27_f64.sqrt() * scale / r;
        assert!(cos > sin_shadow, "all of the shadow is above the horizon");
        let exact = linear(color) * (1.0 - sin_shadow * sin_shadow * cos);
        let samples: &[u32] = if shown { &[4, 16, 64] } else { &[64] };
        if shown {
            converges(&text, exact, samples);
        } else {
            let film = film(&text.replace("SAMPLES", "64"));
            let [mean, deviation] = common::statistics(&film);
            assert!((mean - exact).abs() < 4.0 * deviation / 32.0, "{mean} {exact}");
        }
    }
}

/// Light of matter at rest: g² = g_tt(matter)/g_tt(camera), g_tt = −1 + 2r³/(r⁴ + a²z²).
#[test]
fn a_luminous_ball_deep_in_the_well_is_dimmed_by_g_to_the_fourth() {
    for (spin, center) in [(0.0, [0.0, -2.6, 0.0]), (0.9, [0.0, -2.2, 1.0]), (-0.7, [1.0, -2.0, -2.0])] {
        let text = format!(
            "spacetime.spin = {spin}\nobserver.position = [0, -1000, 0]\n\
             screen = {{ field_of_view = 0.02, look_at = {center:?} }}\nsky.kind = \"black\"\n\
             object = [{{ center = {center:?}, radius = 0.3, material = \"light\", color = [1, 1, 1] }}]"
        );
        let well = |x: [f64; 3]| {
            let b = dot(&x, &x) - spin * spin;
            let r2 = 0.5 * (b + b.hypot(2.0 * spin * x[2]));
            1.0 - 2.0 * r2 * r2.sqrt() / (r2 * r2 + (spin * x[2]).powi(2))
        };
        let stage = stage(&text);
        let mut lit = 0;
        for k in 0..40 {
            let point = [480.0, 540.0 * (f64::from(k) + 0.5) / 40.0];
            let found = ray(&stage, point)[1];
            if found > 0.0 {
                let (_, hit) = hit(&text, point);
                let exact = (well(hit.position) / well([0.0, -1000.0, 0.0])).powi(2);
                assert!((found / exact - 1.0).abs() < 1e-9, "{spin} {found} {exact}");
                lit += 1;
            }
        }
        assert!(lit > 5, "{lit}");
    }
}

/// A small ball in orbit shines as matter in orbit does.
#[test]
fn a_ball_in_orbit_has_the_redshift_of_its_orbit() {
    for (spin, azimuth) in [(0.9, 1.0_f64), (0.9, -1.2), (-0.5, 0.4), (0.0, 2.0)] {
        let (sin, cos) = azimuth.sin_cos();
        let center = [9.0 * cos, 9.0 * sin, 0.0];
        let text = format!(
            "spacetime.spin = {spin}\nobserver.position = [200, 0, 40]\n\
             screen = {{ field_of_view = 8, look_at = [0, 0, 0] }}\nsky.kind = \"black\"\n\
             render = {{ width = 64, height = 64, tolerance = 1e-10 }}\n\
             object = [{{ center = {center:?}, radius = 0.2, material = \"light\", color = [1, 1, 1], motion = \"orbit\" }}]"
        );
        let stage = stage(&text);
        let mut compared = 0;
        for k in 0..320 * 320 {
            let point = [f64::from(k % 320) * 0.2, f64::from(k / 320) * 0.2];
            let found = ray(&stage, point)[1];
            if found == 0.0 {
                continue;
            }
            let (start, hit) = hit(&text, point);
            // Next to the middle's own height and radius.
            let r = Kerr::new(spin);
            let radius = kerrscope::spacetime::metric::Metric::radius(&r, &hit.position);
            let middle = kerrscope::spacetime::metric::Metric::radius(&r, &center);
            let lambda = start.conserved(spin).lambda;
            let orbit = Circular::kerr(spin, Sense::Prograde).orbit(middle).unwrap();
            let g = orbit.redshift_factor(lambda, start.energy).unwrap();
            // Off the middle the well is not as deep, by about δr/r² of g, and the speed is another by Ω δr.
            let off = (radius - middle).abs() + hit.position[2].abs();
            assert!((found.powf(0.25) / g - 1.0).abs() < 0.1 * off + 1e-3, "{} {g} {off}", found.powf(0.25));
            compared += 1;
            if compared > 50 {
                break;
            }
        }
        assert!(compared > 10, "{spin} {azimuth} {compared}");
    }
}

/// Balls around a hole, and rays at them from a camera.
fn balls() -> String {
    let mut text = String::from(
        "spacetime.spin = 0.95\nobserver.position = [0, -25, 6]\n\
         screen = { field_of_view = 45, look_at = [0, 0, 0] }\nsky.kind = \"black\"\n\
         render = { width = 96, height = 54, samples = 4, tolerance = 1e-6 }\nobject = [\n",
    );
    for k in 0..10 {
        let angle = TAU * f64::from(k) / 10.0;
        let height = [0.0, 3.0, -2.0][k as usize % 3];
        let (sin, cos) = angle.sin_cos();
        let size = [1.5, 2.0, 1.0, 0.5][k as usize % 4];
        let center = [8.0 * cos, 8.0 * sin, height];
        let _ = writeln!(text, "{{ center = {center:?}, radius = {size:?}, color = [0.8, 0.5, 0.2] }},");
    }
    text + "{ center = [0, 0, 9], radius = 2, material = \"light\", brightness = 5 }]"
}

/// The places where rays end do not depend on how they are integrated, but for its error.
#[test]
fn rays_meet_balls_at_the_same_places_at_two_tolerances() {
    let scene = scene(&balls());
    let (camera, world) = (Camera::new(&scene).unwrap(), world(&scene));
    let tracer = |tolerance| Integrator::new(Kerr::new(0.95), Scheme::Dop853 { tolerance }, 10_000).boxed();
    let [loose, tight] = [1e-9, 1e-10];
    let (coarse, fine) = (tracer(loose), tracer(tight));
    let (mut a, mut b) = (Path::default(), Path::default());
    let (mut off, mut compared, mut beyond) = (Vec::new(), 0, 0);
    for k in 0..10_000 {
        if compared == 1000 {
            break;
        }
        let at = |n: f64| (f64::from(k) * n).fract();
        let ray = camera.ray(96.0 * at(0.754_877_666_246_69), 54.0 * at(0.569_840_290_998_05)).unwrap();
        coarse.trace_among(&ray, &Query::default(), &world, &mut a);
        fine.trace_among(&ray, &Query::default(), &world, &mut b);
        let (Some(p), Some(q)) = (a.hit, b.hit) else {
            assert_eq!(a.fate, b.fate);
            continue;
        };
        assert_eq!((a.fate, p.object), (Fate::Hit, q.object));
        let apart: [f64; 3] = std::array::from_fn(|i| p.position[i] - q.position[i]);
        // Where a ray grazes a ball, an error across it is a larger one along it.
        let normal = world.shape(p.object).settle(&p.position)[1];
        let length = dot(&q.momentum, &q.momentum).sqrt();
        let cos = dot(&normal, &q.momentum).abs() / length;
        let r = dot(&q.position, &q.position).sqrt();
        off.push(dot(&apart, &apart).sqrt() * cos / r);
        beyond += i32::from(off[off.len() - 1] > a.error_estimate + b.error_estimate);
        compared += 1;
    }
    assert_eq!(compared, 1000);
    off.sort_unstable_by(f64::total_cmp);
    // A typical error is a tenth of the tolerance, so that of the looser one is the tighter one's bound.
    assert!(off[500] < tight && off[900] < 2.0 * tight, "{:e} {:e}", off[500], off[900]);
    // Next to the critical curve errors grow, as each ray's own estimate says.
    assert!(off[999] < 100.0 * tight && beyond < 50, "{:e} {beyond}", off[999]);
}

#[test]
fn any_number_of_threads_makes_the_same_picture() {
    let stage = stage(&balls());
    let pictures = [1, 2, 5].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| draw(&stage, &Watch::default()).unwrap())
    });
    assert!(pictures[0] == pictures[1] && pictures[0] == pictures[2]);
    assert_eq!(pictures[0].tally.given_up, 0);
    assert!(pictures[0].light.iter().any(|light| light[0] > 0.0));
}
