//! Pictures of traced disks against means of many rays, traced one by one by the renderer's closed form and shaded by the renderer's
//! matter; and derivatives against central differences of such pictures.

use kerrscope::spacetime::closed::ClosedForm;
use kerrscope::spacetime::emitter::{Circular, Departure, Sense};
use kerrscope::spacetime::geodesic::{Path, Query, Tracer};
use kerrscope::spacetime::metric::Kerr;
use kerrscope::spacetime::observer::{Motion, Observer, Place};
use kerrscope_fit::traced::{Fineness, Frame, Painter, Profile, Projection, Setting};

/// A disk of all parameters: spin, inclination, 1/r, inner and outer radius, index, scale, centre, position angle.
type Parameters = [f64; 10];

const SIZE: usize = 32;

fn setting(p: &Parameters, power: bool) -> Setting {
    let frame = Frame { size: [SIZE; 2], scale: p[6], center: [p[7], p[8]], position_angle: p[9] };
    let profile = if power { Profile::PowerLaw { index: p[5] } } else { Profile::PageThorne };
    Setting { spin: p[0], inclination: p[1], u: p[2], inner: p[3], outer: p[4], profile, frame }
}

/// The mean over a pixel of `fine`² rays through it.
fn mean(p: &Parameters, power: bool, opaque: bool, pixel: usize, fine: usize) -> f64 {
    let [spin, inclination, u, inner, outer, index, scale, x, y, angle] = *p;
    let place = Place { r: 1.0 / u, theta: inclination, phi: 0.0 };
    let observer = Observer::in_metric(&Kerr::new(spin), place, Motion::Static).unwrap();
    let matter = Circular::kerr(spin, Sense::Prograde);
    let tracer = ClosedForm::new(spin, 16, 1000);
    let inner = matter.isco().unwrap() * inner;
    // g for the energy at infinity: the observer's own well is a constant factor.
    let sigma = 1.0 + (spin * u * inclination.cos()).powi(2);
    let well = 1.0 - 2.0 * u / sigma;
    let (sin, cos) = (-angle).sin_cos();
    let half = 0.5 * SIZE as f64;
    let rays: Vec<_> = (0..fine * fine)
        .map(|k| {
            let [across, down] = [k % fine, k / fine].map(|k| (k as f64 + 0.5) / fine as f64);
            let x = ((pixel % SIZE) as f64 + across - half - x) * scale * u;
            let y = (half - y - (pixel / SIZE) as f64 - down) * scale * u;
            let view = [x.sin() * y.cos(), y.sin(), x.cos() * y.cos()];
            let (right, up) = (view[0] * cos - view[1] * sin, view[0] * sin + view[1] * cos);
            observer.ray([-view[2], -up, right])
        })
        .collect();
    let mut paths = vec![Path::default(); rays.len()];
    tracer.trace_all(&rays, &Query { max_crossings: 4, ..Query::default() }, &mut paths);
    let mut sum = 0.0;
    for (ray, path) in rays.iter().zip(&paths) {
        for crossing in path.crossings.iter().filter(|c| c.r >= inner && c.r <= outer) {
            let light = Departure::new(ray, crossing, &[0.0, 0.0, 1.0]);
            let shift = matter.shift(crossing.r, &light).unwrap();
            let flux = if power { crossing.r.powf(-index) } else { matter.flux(crossing.r) };
            sum += (shift.gravitational * shift.doppler).powi(4) * flux * well * well;
            if opaque {
                break;
            }
        }
    }
    sum / rays.len() as f64
}

const BOUNDED: f64 = 10.0;
const CASES: [(Parameters, bool, bool); 8] = [
    ([0.9, 1.05, 1e-3, 1.0, f64::INFINITY, 0.0, 0.94, 0.3, -0.2, 0.4], false, true),
    ([0.0, 0.35, 1e-3, 1.0, f64::INFINITY, 0.0, 0.94, 0.3, -0.2, 5.4], false, true),
    ([0.95, 1.48, 1e-3, 1.0, f64::INFINITY, 0.0, 0.8, 0.0, -0.2, 2.0], false, true),
    ([-0.7, 2.2, 1e-2, 1.1, BOUNDED, 2.5, 0.7, 0.3, -1.2, 0.4], true, true),
    ([0.6, 0.9, 1e-2, 1.1, BOUNDED, 2.5, 0.7, 0.3, -1.2, 0.4], true, false),
    ([0.998, 0.02, 1e-3, 1.5, 14.0, 0.0, 0.9, -0.3, 0.2, 0.4], false, true),
    // From nearby.
    ([0.8, 1.22, 1.0 / 30.4, 1.0, 16.0, 0.0, 1.2, 0.0, 0.0, 0.0], false, true),
    ([0.5, 1.4, 0.05, 1.0, 15.5, 0.0, 1.3, 0.4, 0.2, 1.0], false, true),
];

/// Means over pixels are within 1e-3 of the brightest, at all kinds of spins, inclinations and disks.
#[test]
fn means_over_pixels() {
    for (p, power, opaque) in CASES {
        let painter = Painter::new(Projection::Angular, opaque, Fineness::default());
        let canvas = painter.draw(&setting(&p, power), false).unwrap();
        let peak = canvas.pixels().iter().map(|pixel| pixel[0]).fold(0.0, f64::max);
        let mut worst = 0.0_f64;
        // The third image is some hundredths of a pixel wide: samples have to lie closer.
        // The same goes for edges at which the light ends at once.
        let (step, fine) = if p[2] > 0.01 {
            (83, 800)
        } else if power {
            (47, 800)
        } else {
            (29, 320)
        };
        for pixel in (3..SIZE * SIZE).step_by(step) {
            let expected = mean(&p, power, opaque, pixel, fine);
            worst = worst.max((canvas.pixels()[pixel][0] - expected).abs() / peak);
        }
        println!("{p:?}: {worst:.1e}");
        assert!(worst < 1e-3, "{p:?}: {worst}");
    }
}

/// The root mean square over pixels of what derivatives are off by, as a share of theirs.
fn off(pixels: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (error, size) = pixels.fold((0.0, 0.0), |(error, size), (found, difference)| {
        (error + (found - difference).powi(2), size + difference * difference)
    });
    f64::sqrt(error / size)
}

/// Derivatives of light without jumps against central differences of pixels sampled by 256² rays.
#[test]
fn derivatives_are_those_of_many_rays() {
    let steps = [4e-3, 4e-3, 0.0, 0.0, 0.0, 0.0, 4e-3, 1e-2, 1e-2, 4e-3];
    let (p, power, opaque) = CASES[0];
    let painter = Painter::new(Projection::Angular, opaque, Fineness::default());
    let canvas = painter.draw(&setting(&p, power), true).unwrap();
    for k in [0, 1, 6, 7, 8, 9] {
        let relative = off((3..SIZE * SIZE).step_by(31).map(|pixel| {
            let moved = |sign: f64| {
                let mut p = p;
                p[k] += sign * steps[k];
                mean(&p, power, opaque, pixel, 256)
            };
            (canvas.pixels()[pixel][1 + k], (moved(1.0) - moved(-1.0)) / (2.0 * steps[k]))
        }));
        println!("{k}: {relative:.1e}");
        assert!(relative < 1e-3, "{p:?} {k}: {relative}");
    }
}

/// All derivatives against central differences of pictures whose lines and rows lie four times closer: edges are too sharp for samples.
#[test]
fn derivatives_are_those_of_finer_pictures() {
    let steps = [1e-4, 1e-4, 1e-5, 1e-4, 1e-3, 1e-4, 1e-4, 4e-4, 4e-4, 1e-4];
    for (p, power, opaque) in [CASES[3], CASES[4], CASES[5], CASES[0], CASES[1], CASES[2]] {
        let painter = Painter::new(Projection::Angular, opaque, Fineness::default());
        let finer = Fineness { lines: 1280, step: 0.0075, bend: 0.015, ..Fineness::default() };
        let finer = Painter::new(Projection::Angular, opaque, finer);
        let canvas = painter.draw(&setting(&p, power), true).unwrap();
        for k in 0..10 {
            // Face-on there is next to nothing that turns, and far away no edge.
            if (k == 5 && !power) || (k == 9 && p[1] < 0.1) || (k == 4 && p[4] > 100.0) {
                continue;
            }
            // Nearly edge-on next to nothing changes with the distance, or behind the inner edge: differences are too coarse.
            let side = p[1] > 1.4 && p[1] < 1.6;
            if side && (k == 2 || k == 3) {
                continue;
            }
            // The last stable orbit moves fast near |a| = 1.
            let step = if k == 0 { steps[0] * (1.0 - p[0] * p[0]) } else { steps[k] };
            let moved = |sign: f64| {
                let mut p = p;
                p[k] += sign * step;
                finer.draw(&setting(&p, power), false).unwrap()
            };
            let (high, low) = (moved(1.0), moved(-1.0));
            let relative = off((0..SIZE * SIZE).map(|pixel| {
                let difference = (high.pixels()[pixel][0] - low.pixels()[pixel][0]) / (2.0 * step);
                (canvas.pixels()[pixel][1 + k], difference)
            }));
            // Of rings thinner than any step between lines, single pixels miss it: 1.1e-3 at 60°, 1.6e-3 at 85°; 2.3e-3 of what lies behind
            // the inner edge of a disk that is dark there.
            let thin = !power && opaque && p[0] > 0.8 && p[0] < 0.99;
            let least = if !thin {
                1e-3
            } else if k == 3 {
                2.5e-3
            } else if side {
                1.7e-3
            } else {
                1.2e-3
            };
            println!("{} {k}: {relative:.1e}", p[0]);
            assert!(relative < least, "{p:?} {k}: {relative}");
        }
    }
}
