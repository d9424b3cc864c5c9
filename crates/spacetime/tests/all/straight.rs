//! Flat space: the tracer that knows rays to be straight, and the integrator that does not.

use crate::common;

use common::{Random, Worst, distance, folded, follow, largest, separation, unit};
use kerrscope_spacetime::geodesic::{
    Fate, Integrator, InvertedFlow, Method, Path, Query, Ray, Scheme, Straight, Tsit5,
};
use kerrscope_spacetime::metric::{Inverted, Metric, Minkowski};
use kerrscope_spacetime::observer::{Motion, Observer, Place, impact_ray};
use kerrscope_spacetime::tensor::{cross, dot};
use std::f64::consts::PI;

fn camera(random: &mut Random) -> Observer {
    let place =
        Place { r: random.scale(0.5, 1e3), theta: random.within(0.0, PI), phi: random.within(-9.0, 9.0) };
    Observer::new(None, place, Motion::Static).unwrap()
}

/// A camera's ray with what a line says of it: start, direction.
fn lines(random: &mut Random) -> (Ray, [f64; 3], [f64; 3]) {
    let observer = camera(random);
    let ray = observer.ray(random.direction());
    (ray, observer.position(), ray.start.momentum())
}

fn everything(random: &mut Random) -> Query {
    Query { plane: random.direction(), elapsed: true, points: 20, ..Query::default() }
}

/// A ray that nearly grazes the plane, or passes next to the axis, magnifies rounding.
fn awkward(start: [f64; 3], v: [f64; 3], query: &Query) -> bool {
    let j = cross(&start, &v);
    dot(&v, &query.plane).abs() < 0.02 || j[2].abs() < 0.02 * dot(&start, &start).sqrt()
}

/// The exact answers for a line from `start` along the unit vector `v`.
fn check(path: &Path, start: [f64; 3], v: [f64; 3], query: &Query, worst: &mut Worst) {
    let size = dot(&start, &start).sqrt();
    assert_eq!(path.fate, Fate::Escaped);
    let [theta, phi] = path.direction.unwrap();
    worst.see(distance(unit([theta, phi]), v), || format!("direction of {start:?}, {v:?}"));
    let (height, climb) = (dot(&start, &query.plane), dot(&v, &query.plane));
    assert_eq!(path.crossings.len(), usize::from(height * climb < 0.0));
    for c in &path.crossings {
        let d = -height / climb;
        let exact: [f64; 3] = std::array::from_fn(|i| start[i] + d * v[i]);
        let r = dot(&exact, &exact).sqrt();
        let scale = 1.0 / size.max(d);
        worst.see(distance(c.position, exact) * scale, || format!("crossing of {start:?}, {v:?}"));
        worst.see((c.r - r).abs() * scale, || format!("r of {start:?}, {v:?}"));
        worst.see((c.elapsed - d).abs() * scale, || format!("time of {start:?}, {v:?}"));
        let phi_error = folded(c.phi - exact[1].atan2(exact[0])).abs() * exact[0].hypot(exact[1]);
        worst.see(phi_error * scale, || format!("φ of {start:?}, {v:?}"));
    }
    assert_eq!(path.points.len(), query.points);
    for [t, x, y, z] in &path.points {
        let d = -t;
        let exact: [f64; 3] = std::array::from_fn(|i| start[i] + d * v[i]);
        worst.see(distance([*x, *y, *z], exact) / size.max(d), || format!("point of {start:?}, {v:?}"));
    }
    // They run from the camera on.
    let times: Vec<f64> = path.points.iter().map(|p| p[0]).collect();
    assert!(times[0].abs() < 1e-12 * size && times.windows(2).all(|t| t[1] < t[0]));
}

#[test]
fn straight_is_exact() {
    let mut random = Random::new(31);
    let mut worst = Worst::default();
    for _ in 0..2000 {
        let (ray, start, v) = lines(&mut random);
        let query = everything(&mut random);
        if !awkward(start, v, &query) {
            check(&follow(&Straight, &ray, &query), start, v, &query, &mut worst);
        }
    }
    worst.below(1e-14, "straight lines");
}

/// The integrator finds the same lines, with any method, and the same unwrapped azimuths.
#[test]
fn integrated_lines_are_straight() {
    let dop853 = Scheme::Dop853 { tolerance: 1e-13 };
    for (scheme, tolerance, count) in
        [(dop853, 5e-14, 1000), (Scheme::Tsit5 { tolerance: 2e-13 }, 1e-13, 200)]
    {
        let mut random = Random::new(32);
        let (mut worst, mut azimuths) = (Worst::default(), Worst::default());
        let tracer = Integrator::new(Minkowski, scheme, 10_000);
        for _ in 0..count {
            let (ray, start, v) = lines(&mut random);
            let query = everything(&mut random);
            if awkward(start, v, &query) {
                continue;
            }
            let path = follow(&tracer, &ray, &query);
            check(&path, start, v, &query, &mut worst);
            let straight = follow(&Straight, &ray, &query);
            let place = || format!("{scheme:?}, {start:?}, {v:?}");
            azimuths.see((path.direction.unwrap()[1] - straight.direction.unwrap()[1]).abs(), place);
            for (a, b) in path.crossings.iter().zip(&straight.crossings) {
                azimuths.see((a.phi - b.phi).abs(), place);
            }
            let actual = separation(path.direction.unwrap(), straight.direction.unwrap());
            assert!(actual < 3.0 * path.error_estimate.max(1e-15), "{actual:e}, {:e}", path.error_estimate);
        }
        worst.below(tolerance, "integrated lines");
        azimuths.below(tolerance, "unwrapped azimuths");
    }
}

/// Constant steps of affine parameter, as the thesis takes them.
#[test]
fn constant_steps_are_straight() {
    let mut random = Random::new(33);
    let mut worst = Worst::default();
    for _ in 0..100 {
        let place = Place { r: random.scale(5.0, 100.0), theta: random.within(0.0, PI), phi: 0.3 };
        let observer = Observer::new(None, place, Motion::Static).unwrap();
        let ray = observer.ray(random.direction());
        let (start, v) = (observer.position(), ray.start.momentum());
        let query = everything(&mut random);
        if !awkward(start, v, &query) {
            let path = follow(&Integrator::new(Minkowski, Scheme::Rk4 { step: 1.5 }, 10_000), &ray, &query);
            check(&path, start, v, &query, &mut worst);
        }
    }
    worst.below(5e-14, "Runge and Kutta's lines");
}

/// Step by step, a photon keeps its momentum and moves along one line.
#[test]
fn momentum_is_constant() {
    let mut random = Random::new(34);
    let mut worst = Worst::default();
    let pack = |s: &Inverted<f64>| [s.w, s.n[0], s.n[1], s.n[2], s.q, s.j[0], s.j[1], s.j[2]];
    let unpack = |y: &[f64; 8]| Inverted { w: y[0], n: [y[1], y[2], y[3]], q: y[4], j: [y[5], y[6], y[7]] };
    for _ in 0..200 {
        let (ray, start, v) = lines(&mut random);
        let flow = InvertedFlow { metric: Minkowski, energy: ray.energy };
        let mut y: [f64; 8] = pack(&ray.start);
        let turn = dot(&ray.start.j, &ray.start.j).sqrt() + 1.0;
        // Over half of the angle that the line turns through from −∞ to ∞.
        for _ in 0..200 {
            let rate = Minkowski.inverted_rate(ray.energy, &unpack(&y));
            y = Tsit5::step(&flow, &y, &mut [pack(&rate); 6], 0.005 / turn).end;
        }
        let state = unpack(&y);
        let x = state.n.map(|c| c / state.w);
        worst.see(distance(state.momentum(), v), || format!("momentum of {ray:?}"));
        let moved: [f64; 3] = std::array::from_fn(|i| x[i] - start[i]);
        let aside = cross(&moved, &v);
        worst.see(largest(aside.map(f64::abs)) * state.w, || format!("line of {ray:?}"));
        worst.see(Minkowski.norm(ray.energy, &state).abs(), || format!("norm of {ray:?}"));
    }
    worst.below(2e-14, "momentum and line");
}

/// From infinity: the ray of (α, β) passes the screen through the origin there.
#[test]
fn lines_from_infinity() {
    let mut random = Random::new(35);
    let mut worst = [Worst::default(), Worst::default()];
    for _ in 0..500 {
        let inclination = random.within(0.05, PI - 0.05);
        let [alpha, beta] = [random.within(-20.0, 20.0), random.within(-20.0, 20.0)];
        let ray = impact_ray(None, inclination, f64::INFINITY, [alpha, beta]).unwrap();
        let query = Query { plane: random.direction(), elapsed: true, ..Query::default() };
        let (sin, cos) = inclination.sin_cos();
        // Towards the observer, right and up on the sky.
        let (n, right, up) = ([sin, 0.0, cos], [0.0, 1.0, 0.0], [-cos, 0.0, sin]);
        let screen: [f64; 3] = std::array::from_fn(|i| alpha * right[i] + beta * up[i]);
        if dot(&n, &query.plane).abs() < 0.05 {
            continue;
        }
        let depth = dot(&screen, &query.plane) / dot(&n, &query.plane);
        let exact: [f64; 3] = std::array::from_fn(|i| screen[i] - depth * n[i]);
        let tracers: [Path; 2] = [
            follow(&Straight, &ray, &query),
            follow(&Integrator::new(Minkowski, Scheme::Dop853 { tolerance: 1e-13 }, 10_000), &ray, &query),
        ];
        for (path, worst) in tracers.iter().zip(&mut worst) {
            let place = || format!("i = {inclination}, ({alpha}, {beta}), {:?}", query.plane);
            assert_eq!(path.fate, Fate::Escaped, "{}", place());
            assert_eq!(path.crossings.len(), 1, "{}", place());
            let c = path.crossings[0];
            let size = dot(&exact, &exact).sqrt() + dot(&screen, &screen).sqrt();
            worst.see(distance(c.position, exact) / size, place);
            // The camera's distance is taken off.
            worst.see((c.elapsed - depth).abs() / size, place);
            worst
                .see(folded(c.phi - exact[1].atan2(exact[0])).abs() * exact[0].hypot(exact[1]) / size, place);
            // On the other side of the sky, half a turn on in the sense of J_z.
            let [theta, phi] = path.direction.unwrap();
            worst.see((theta - (PI - inclination)).abs(), place);
            worst.see((phi - PI.copysign(alpha)).abs() * 1e-2, place);
        }
    }
    worst[0].below(3e-15, "straight");
    worst[1].below(1e-13, "integrated");
}
