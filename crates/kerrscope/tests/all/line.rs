//! Line profiles: published edges, both engines, and what is known in closed form.

use std::f64::consts::{PI, TAU};

use kerrscope::line::{Emissivity, Isoradials, Line, LineError, Profile, Screen, tracer};
use kerrscope::spacetime::emitter::{Circular, Sense};

fn line(spin: f64, degrees: f64, outer: f64) -> Line {
    Line {
        spin,
        inclination: f64::to_radians(degrees),
        inner: Line::isco(spin),
        outer,
        emissivity: Emissivity::Power(3.0),
        orders: vec![0],
    }
}

fn profile(line: &Line, integrated: bool, bins: usize, range: Option<[f64; 2]>) -> Profile {
    line.profile(&*tracer(line.spin, integrated), bins, range).unwrap()
}

fn difference(one: &Profile, other: &Profile) -> f64 {
    assert_eq!(one.range, other.range);
    let off = one.flux.iter().zip(&other.flux).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    off / other.peak()
}

#[test]
fn edges_are_the_published_ones() {
    for (spin, degrees, outer, low, high) in
        [(0.5, 30.0, 15.0, 0.467346, 1.037756), (0.998, 40.0, 400.0, 0.052336, 1.086857)]
    {
        let edges = profile(&line(spin, degrees, outer), false, 100, None).edges;
        assert!((edges[0] - low).abs() < 2e-6 && (edges[1] - high).abs() < 2e-6, "{edges:?}");
    }
}

#[test]
fn the_engines_agree() {
    let mut lines = vec![line(0.5, 30.0, 15.0), line(0.998, 40.0, 400.0), line(-0.7, 75.0, 50.0)];
    lines.push(Line { inner: 2.1, ..line(0.3, 60.0, 20.0) });
    lines.push(Line { orders: vec![1, 2], ..line(0.9, 60.0, 20.0) });
    for line in lines {
        let range = Some([0.02, 1.5]);
        let (one, other) = (profile(&line, false, 400, range), profile(&line, true, 400, range));
        let off = difference(&one, &other);
        println!("a = {}, {:.0}°, {:?}: {off:e}", line.spin, line.inclination.to_degrees(), line.orders);
        assert!(off < 1e-6, "{line:?}: {off:e}");
    }
}

/// Face-on there is one g to a radius, and F = g³ε(r) π d(b²)/dg: bins hold what lies between two isoradials.
#[test]
fn face_on_bins_lie_between_isoradials() {
    let spin = 0.6;
    let line = Line { emissivity: Emissivity::Power(0.0), ..line(spin, 0.0, 30.0) };
    let tracer = tracer(spin, false);
    let matter = Circular::kerr(spin, Sense::Prograde);
    let screen = Screen { spin, inclination: 0.0 };
    let isoradials = Isoradials { tracer: &*tracer, screen, order: 0 };
    for k in 0..20 {
        let radii = [0.0, 0.5, 1.0].map(|t| line.inner * 1.2 + f64::from(k) + t);
        let g = radii.map(|r| 1.0 / matter.orbit(r).unwrap().time);
        let bin = line.profile(&*tracer, 1, Some([g[0], g[2]])).unwrap();
        let b = isoradials.along(&radii, &[0.7]).into_iter().map(|p| p.unwrap().distance).collect::<Vec<_>>();
        // ∫ g³ d(πb²) by Simpson's rule over b², g being nearly linear in it: compared as a mean.
        let area = PI * (b[2] * b[2] - b[0] * b[0]);
        let mean = bin.flux[0] * (g[2] - g[0]) / area;
        assert!(mean > g[0].powi(3) && mean < g[2].powi(3), "{mean} {g:?}");
        let middle = g[1].powi(3);
        assert!((mean / middle - 1.0).abs() < 0.1, "{mean} {middle}");
    }
}

/// The whole line is ∫ g³ε dα dβ, by another rule: of Simpson in b along many directions.
#[test]
fn the_whole_line_is_the_integral_over_the_screen() {
    let line = Line { outer: 12.0, ..line(0.7, 50.0, 12.0) };
    let tracer = tracer(0.7, false);
    let found = line.profile(&*tracer, 300, None).unwrap();
    let total: f64 = found.flux.iter().sum::<f64>() * (found.range[1] - found.range[0]) / 300.0;
    let screen = Screen { spin: 0.7, inclination: line.inclination };
    let isoradials = Isoradials { tracer: &*tracer, screen, order: 0 };
    let matter = Circular::kerr(0.7, Sense::Prograde);
    // Over r by Gauss and Legendre in two panels would need db/dr: over r by differences of b² instead.
    let (rings, around) = (600, 64);
    let radius = |k: f64| line.inner * (line.outer / line.inner).powf(k / f64::from(rings));
    let radii: Vec<f64> = (0..=2 * rings).map(|k| radius(0.5 * f64::from(k))).collect();
    let points = isoradials.points(&radii, around);
    let mut sum = 0.0;
    for direction in 0..around {
        let at = |k: usize| points[direction * radii.len() + k].unwrap().distance;
        for ring in 0..rings as usize {
            let r = radii[2 * ring + 1];
            let [alpha, _] = screen.place(at(2 * ring + 1), TAU * direction as f64 / around as f64);
            let g = matter.orbit(r).unwrap().redshift_factor(-alpha * line.inclination.sin(), 1.0).unwrap();
            let area = 0.5 * (at(2 * ring + 2).powi(2) - at(2 * ring).powi(2)) * TAU / around as f64;
            sum += g.powi(3) * line.emissivity.at(r) * area;
        }
    }
    assert!((total / sum - 1.0).abs() < 1e-5, "{total} {sum}");
}

#[test]
fn a_table_of_a_power_is_that_power() {
    let power = line(0.5, 30.0, 15.0);
    let rows = (0..40).map(|k| f64::from(k) * 0.5 + 4.0).map(|r| [r, r.powi(-3)]).collect();
    let table = Line { emissivity: Emissivity::Table(rows), ..power.clone() };
    let range = Some([0.4, 1.1]);
    assert!(difference(&profile(&table, false, 100, range), &profile(&power, false, 100, range)) < 1e-12);
    let short = Line { emissivity: Emissivity::Table(vec![[5.0, 1.0], [9.0, 1.0]]), ..power };
    let refused = short.profile(&*tracer(0.5, false), 10, None).unwrap_err();
    assert!(matches!(refused, LineError::Table { .. }), "{refused}");
}

#[test]
fn seen_from_below_it_is_the_same() {
    let above = line(0.8, 55.0, 20.0);
    let below = Line { inclination: PI - above.inclination, ..above.clone() };
    let range = Some([0.1, 1.5]);
    let off = difference(&profile(&below, false, 200, range), &profile(&above, false, 200, range));
    assert!(off < 1e-8, "{off:e}");
}

#[test]
fn what_cannot_be_is_refused() {
    let good = line(0.5, 30.0, 15.0);
    let tracer = tracer(0.5, false);
    let refused = |line: &Line| line.profile(&*tracer, 10, None).unwrap_err();
    assert_eq!(refused(&Line { inclination: 0.5 * PI, ..good.clone() }), LineError::EdgeOn);
    assert_eq!(refused(&Line { orders: vec![], ..good.clone() }), LineError::Orders);
    assert_eq!(refused(&Line { orders: vec![7], ..good.clone() }), LineError::Orders);
    for line in [
        Line { inner: 1.0, ..good.clone() },
        Line { outer: 3.0, ..good.clone() },
        Line { spin: f64::NAN, ..good.clone() },
        Line { inclination: 4.0, ..good.clone() },
        Line { outer: f64::INFINITY, ..good.clone() },
    ] {
        let error = refused(&line);
        assert!(matches!(error, LineError::OutOfBounds { .. }), "{line:?}: {error}");
    }
    assert_eq!(good.profile(&*tracer, 0, None), Err(LineError::Bins));
    assert_eq!(good.profile(&*tracer, 10, Some([1.0, 0.5])), Err(LineError::Bins));
}
