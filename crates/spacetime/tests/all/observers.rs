//! Observers' tetrads and the photons measured in them, against formulas in Boyer–Lindquist
//! coordinates (Bardeen, Press & Teukolsky 1972).

use crate::common;

use common::{Random, Worst, distance, folded, follow, largest};
use kerrscope_spacetime::geodesic::{EXIT, Integrator, Query, Ray, Scheme, Side, Straight};
use kerrscope_spacetime::kerr::{Orbits, ergosphere, horizons};
use kerrscope_spacetime::metric::{Kerr, Metric, Minkowski};
use kerrscope_spacetime::observer::{Motion, Observer, ObserverError, Place, check, impact_ray};
use kerrscope_spacetime::tensor::{Tensor, Vec4, dot, pair, product};
use std::f64::consts::{FRAC_PI_2, PI};

const SPINS: [f64; 9] = [0.0, 0.3, -0.5, 0.9, -0.9, 0.998, -0.998, 1.0, -1.0];

/// The metric of the chart that the observer's rays are in.
fn chart(spin: f64, side: Side) -> Kerr {
    Kerr::new(if side == Side::Reversed { -spin } else { spin })
}

fn covector(ray: &Ray) -> Vec4<f64> {
    let p = ray.start.momentum();
    [-ray.energy, p[0], p[1], p[2]]
}

/// u, e_r, e_θ and e_φ with indices down: p = ±u + d for the direction d, so the rays of opposite
/// directions give both.
struct Frame {
    u: Vec4<f64>,
    axes: [Vec4<f64>; 3],
    raised: Tensor<f64>,
}

impl Frame {
    fn new(spin: f64, observer: &Observer) -> Self {
        let unit = |k: usize, length: f64| std::array::from_fn(|i| if i == k { length } else { 0.0 });
        let rays: [[Ray; 2]; 3] =
            std::array::from_fn(|k| [observer.ray(unit(k, 1.0)), observer.ray(unit(k, -1.0))]);
        let side = rays[0][0].side;
        let sense = if side == Side::Reversed { 0.5 } else { -0.5 };
        let pairs = rays.map(|pair| pair.map(|ray| covector(&ray)));
        Self {
            u: std::array::from_fn(|i| sense * (pairs[0][0][i] + pairs[0][1][i])),
            axes: pairs.map(|[plus, minus]| std::array::from_fn(|i| 0.5 * (plus[i] - minus[i]))),
            raised: chart(spin, side).inverse_components(&observer.position()),
        }
    }

    /// Largest departure from g(e_a, e_b) = diag(−1, 1, 1, 1).
    fn error(&self) -> f64 {
        let all = [self.u, self.axes[0], self.axes[1], self.axes[2]];
        largest((0..4).flat_map(|a| {
            (0..4).map(move |b| {
                let expected = [if a == 0 { -1.0 } else { 1.0 }, 0.0][usize::from(a != b)];
                (product(&self.raised, &all[a], &all[b]) - expected).abs()
            })
        }))
    }

    /// Size of the terms that cancel in a product.
    fn size(&self) -> f64 {
        let all = self.axes.iter().chain([&self.u]).flatten();
        largest(all.map(|c| c * c)).max(1.0)
    }
}

fn motions(spin: f64, place: &Place) -> Vec<Motion> {
    let all = [
        Motion::Static,
        Motion::ZeroAngularMomentum,
        Motion::Orbit,
        Motion::Fall,
        Motion::Velocity([0.3, -0.5, 0.6]),
        Motion::Velocity([-0.9, 0.1, 0.2]),
        Motion::VelocityFromFall([0.0; 3]),
        Motion::VelocityFromFall([0.5, 0.4, -0.7]),
    ];
    all.into_iter().filter(|motion| check(Some(spin), place, motion).is_ok()).collect()
}

fn places(random: &mut Random, spin: f64) -> Place {
    let (outer, inner) = horizons(spin);
    let inside = outer - inner > 0.1 && random.within(0.0, 1.0) < 0.3;
    let r = if inside {
        random.within((inner + 0.05).max(0.4), outer - 0.01)
    } else {
        outer * random.scale(1.02, 1e6)
    };
    let theta = random.within(0.0, PI);
    let theta = random.pick(&[theta, FRAC_PI_2, 0.0, PI]);
    Place { r, theta, phi: random.within(-4.0, 4.0) }
}

/// Every observer's axes are orthonormal; every ray is null, has local energy one, and makes
/// the angles with others that its direction does.
#[test]
fn tetrads_are_orthonormal() {
    let mut random = Random::new(71);
    let (mut frames, mut near, mut rays, mut inside) =
        (Worst::default(), Worst::default(), Worst::default(), 0);
    for _ in 0..3000 {
        let spin = random.pick(&SPINS);
        let place = places(&mut random, spin);
        for motion in motions(spin, &place) {
            let observer = Observer::new(Some(spin), place, motion).unwrap();
            let frame = Frame::new(spin, &observer);
            let label = || format!("a = {spin}, {place:?}, {motion:?}");
            let size = frame.size();
            let which = if size < 100.0 { &mut frames } else { &mut near };
            which.see(frame.error() / size, label);
            let [d1, d2] = [random.direction(), random.direction()];
            let [first, second] = [observer.ray(d1), observer.ray(d2)];
            inside += u32::from(first.side == Side::Ingoing);
            let metric = chart(spin, first.side);
            rays.see(metric.norm(first.energy, &first.start).abs() / size, label);
            let (p, q) = (covector(&first), covector(&second));
            let sense = if first.side == Side::Reversed { 1.0 } else { -1.0 };
            rays.see((product(&frame.raised, &p, &frame.u) + sense).abs() / size, label);
            rays.see((product(&frame.raised, &p, &q) + 1.0 - dot(&d1, &d2)).abs() / size, label);
            // Through the place of the observer.
            let x = first.start.n.map(|c| c / first.start.w);
            rays.see(distance(x, observer.position()) * first.start.w, label);
            rays.see((metric.radius(&x) / place.r - 1.0).abs(), label);
        }
    }
    assert!(inside > 500);
    frames.below(2e-14, "tetrads");
    near.below(1e-13, "tetrads boosted or next to the horizon");
    rays.below(3e-13, "rays");
}

/// Components of a covector of the chart with spin s at `place`, in Boyer–Lindquist coordinates:
/// (E, p_r, p_θ, p_φ).
fn boyer_lindquist(s: f64, place: &Place, x: &[f64; 3], p: &Vec4<f64>) -> Vec4<f64> {
    let (sin, cos) = place.theta.sin_cos();
    let (r, energy) = (place.r, -p[0]);
    // x + iy = (r + is) e^{iφ̃} sin θ.
    let (sin_ks, cos_ks) = (x[1].atan2(x[0]) - s.atan2(r)).sin_cos();
    let angular = x[0] * p[2] - x[1] * p[1];
    let along_r = sin * (cos_ks * p[1] + sin_ks * p[2]) + cos * p[3];
    let along_theta = (x[0] * p[1] + x[1] * p[2]) * cos / sin - r * sin * p[3];
    let delta = (r - 1.0).powi(2) - (1.0 - s) * (1.0 + s);
    [energy, along_r - (2.0 * r * energy - s * angular) / delta, along_theta, angular]
}

/// Largest difference relative to the largest component, r counting for the angles.
fn apart(got: &Vec4<f64>, want: &Vec4<f64>, r: f64) -> f64 {
    let weights = [1.0, 1.0, 1.0 / r, 1.0 / r];
    let size = largest((0..4).map(|i| want[i].abs() * weights[i])).max(1.0);
    largest((0..4).map(|i| (got[i] - want[i]).abs() * weights[i])) / size
}

/// Boyer–Lindquist quantities at a place.
struct Ground {
    r: f64,
    sin: f64,
    sigma: f64,
    delta: f64,
    /// (r² + s²)² − s²Δ sin²θ.
    area: f64,
}

impl Ground {
    fn new(s: f64, place: &Place) -> Self {
        let (sin, cos) = place.theta.sin_cos();
        let r = place.r;
        let delta = (r - 1.0).powi(2) - (1.0 - s) * (1.0 + s);
        let area = (r * r + s * s).powi(2) - s * s * delta * sin * sin;
        Self { r, sin, sigma: r * r + s * s * cos * cos, delta, area }
    }
}

/// What a ZAMO and a static observer find for the photon that leaves, reversed, along n.
fn zamo(s: f64, place: &Place, n: [f64; 3]) -> Vec4<f64> {
    let Ground { r, sin, sigma, delta, area, .. } = Ground::new(s, place);
    let lapse = (sigma * delta / area).sqrt();
    let angular = n[2] * sin * (area / sigma).sqrt();
    [lapse + 2.0 * s * r / area * angular, n[0] * (sigma / delta).sqrt(), n[1] * sigma.sqrt(), angular]
}

fn at_rest(s: f64, place: &Place, n: [f64; 3]) -> Vec4<f64> {
    let Ground { r, sin, sigma, delta, area, .. } = Ground::new(s, place);
    let g_tt = -(1.0 - 2.0 * r / sigma);
    let g_tp = -2.0 * s * r * sin * sin / sigma;
    let g_pp = area * sin * sin / sigma;
    let energy = (-g_tt).sqrt();
    let across = (g_pp - g_tp * g_tp / g_tt).sqrt();
    [energy, n[0] * (sigma / delta).sqrt(), n[1] * sigma.sqrt(), g_tp / energy + n[2] * across]
}

/// What an observer with hole spin s at a place finds for a direction.
type Formula = fn(f64, &Place, [f64; 3]) -> Vec4<f64>;

#[test]
fn photons_of_zamos_and_static_observers() {
    let mut random = Random::new(72);
    let (mut worst, mut constants) = (Worst::default(), Worst::default());
    for _ in 0..3000 {
        let spin = random.pick(&SPINS);
        let s = -spin;
        let place = Place {
            r: horizons(spin).0 * random.scale(1.05, 1e4),
            theta: random.within(0.05, PI - 0.05),
            phi: random.within(-4.0, 4.0),
        };
        let n = random.direction();
        let cases: [(Motion, Formula); 2] = [(Motion::ZeroAngularMomentum, zamo), (Motion::Static, at_rest)];
        for (motion, formula) in cases {
            if check(Some(spin), &place, &motion).is_err() {
                continue;
            }
            let ray = Observer::new(Some(spin), place, motion).unwrap().ray(n);
            let x = ray.start.n.map(|c| c / ray.start.w);
            let label = || format!("a = {spin}, {place:?}, {motion:?}, {n:?}");
            let [energy, p_r, p_theta, angular] = formula(s, &place, n);
            let got = boyer_lindquist(s, &place, &x, &covector(&ray));
            // The chart's radial momentum is what 2rE/Δ is left of.
            let Ground { delta, r, .. } = Ground::new(s, &place);
            let cancel = 1.0 + 2.0 * r / delta;
            worst.see(apart(&got, &[energy, p_r, p_theta, angular], r) / cancel, label);
            // λ and η of the physical photon.
            let (cos, sin) = (place.theta.cos(), place.theta.sin());
            let (lambda, p_theta) = (angular / energy, p_theta / energy);
            let eta = p_theta * p_theta - cos * cos * (s * s - (lambda / sin).powi(2));
            let conserved = ray.conserved(spin);
            let size = (1.0 + lambda * lambda + eta.abs()).max(r * r / (energy * energy));
            constants.see((conserved.lambda + lambda).abs() / size.sqrt() / cancel, label);
            constants.see((conserved.eta - eta).abs() / size / cancel, label);
        }
    }
    worst.below(3e-14, "momenta");
    constants.below(5e-14, "λ and η");
}

/// Four-velocities of orbits and of free fall, as covectors (E, u_r, u_θ, L), time reversed.
#[test]
fn four_velocities() {
    let mut random = Random::new(73);
    let mut worst = Worst::default();
    for _ in 0..2000 {
        let spin = random.pick(&SPINS);
        let s = -spin;
        let outer = horizons(spin).0;
        let r = Orbits::new(spin).photon_prograde * random.scale(1.01, 1e4);
        if r > outer * 1.02 {
            let place = Place { r, theta: FRAC_PI_2, phi: 0.3 };
            let observer = Observer::new(Some(spin), place, Motion::Orbit).unwrap();
            let frame = Frame::new(spin, &observer);
            let got = boyer_lindquist(s, &place, &observer.position(), &frame.u);
            let drag = spin / (r * r.sqrt());
            let norm = (1.0 - 3.0 / r + 2.0 * drag).sqrt();
            let energy = (1.0 - 2.0 / r + drag) / norm;
            let angular = r.sqrt() * (1.0 - 2.0 * drag + (spin / r).powi(2)) / norm;
            let cancel = 1.0 + 2.0 * r / Ground::new(s, &place).delta;
            let error = apart(&got, &[energy, 0.0, 0.0, -angular], r) * norm * norm / cancel;
            worst.see(error, || format!("orbit, a = {spin}, r = {r}"));
        }
        // Closer to the horizon a falling camera is in the other chart.
        let place = Place { r: outer * random.scale(EXIT, 1e4), theta: random.within(0.05, 3.0), phi: 0.3 };
        let observer = Observer::new(Some(spin), place, Motion::Fall).unwrap();
        let frame = Frame::new(spin, &observer);
        let got = boyer_lindquist(s, &place, &observer.position(), &frame.u);
        let Ground { r, delta, .. } = Ground::new(s, &place);
        // u^r = −√(2r(r² + a²))/Σ, inwards; reversed, outwards.
        let rise = (2.0 * r * (r * r + s * s)).sqrt() / delta;
        let cancel = 1.0 + 2.0 * r / delta;
        worst.see(apart(&got, &[1.0, rise, 0.0, 0.0], r) / cancel, || format!("fall, a = {spin}, {place:?}"));
        // Inside the horizon the chart is that of the hole itself.
        let (outer, inner) = horizons(spin);
        if outer - inner > 0.2 {
            let place = Place { r: random.within((inner + 0.05).max(0.4), outer - 0.02), ..place };
            let observer = Observer::new(Some(spin), place, Motion::Fall).unwrap();
            let frame = Frame::new(spin, &observer);
            let got = boyer_lindquist(spin, &place, &observer.position(), &frame.u);
            let Ground { r, delta, .. } = Ground::new(spin, &place);
            let fall = -(2.0 * r * (r * r + s * s)).sqrt() / delta;
            let cancel = 1.0 + 2.0 * r / delta.abs();
            worst.see(apart(&got, &[1.0, fall, 0.0, 0.0], r) / cancel, || {
                format!("inside, a = {spin}, {place:?}")
            });
        }
    }
    worst.below(5e-15, "four-velocities");
}

/// A velocity is what the observer that it refers to measures, and e_r, e_θ, e_φ point along
/// r, θ and φ.
#[test]
fn velocities() {
    let mut random = Random::new(74);
    let (mut worst, mut senses) = (Worst::default(), 0);
    for _ in 0..1500 {
        let spin = random.pick(&SPINS);
        let place = places(&mut random, spin);
        let speed = random.within(0.0, 0.95);
        let v = random.direction().map(|c| c * speed);
        for (rest, moving) in
            [(Motion::ZeroAngularMomentum, Motion::Velocity(v)), (Motion::Fall, Motion::VelocityFromFall(v))]
        {
            let Ok(rest) = Observer::new(Some(spin), place, rest) else { continue };
            let moving = Observer::new(Some(spin), place, moving).unwrap();
            let (base, frame) = (Frame::new(spin, &rest), Frame::new(spin, &moving));
            let gamma = 1.0 / (1.0 - speed * speed).sqrt();
            let sense = if moving.ray([1.0, 0.0, 0.0]).side == Side::Reversed { -1.0 } else { 1.0 };
            let label = || format!("a = {spin}, {place:?}, {v:?}");
            let size = base.size().max(frame.size());
            worst.see((product(&base.raised, &frame.u, &base.u) + gamma).abs() / size, label);
            for (axis, part) in base.axes.iter().zip(v) {
                let component = product(&base.raised, &frame.u, axis);
                worst.see((component - sense * gamma * part).abs() / size, label);
            }
        }
        // Along the coordinates, where they have a direction.
        let (sin, cos) = place.theta.sin_cos();
        if sin < 0.1 {
            continue;
        }
        for motion in motions(spin, &place) {
            let observer = Observer::new(Some(spin), place, motion).unwrap();
            let frame = Frame::new(spin, &observer);
            let [x, y, _] = observer.position();
            let ring = x.hypot(y);
            let around = [0.0, -y, x, 0.0];
            let down = [0.0, x * cos / sin, y * cos / sin, -place.r * sin];
            assert!(pair(&frame.axes[2], &around) > 0.0);
            assert!(pair(&frame.axes[1], &down) > 0.0);
            // e_θ is at right angles to ∂φ, as e_r is to both.
            let label = || format!("axes, a = {spin}, {place:?}, {motion:?}");
            let size = ring * frame.size();
            worst.see(pair(&frame.axes[1], &around).abs() / size, label);
            worst.see(pair(&frame.axes[0], &around).abs() / size, label);
            worst.see(pair(&frame.axes[0], &down).abs() / size, label);
            senses += 1;
        }
    }
    assert!(senses > 1000);
    worst.below(5e-14, "velocities");
}

/// At a = 0 a falling camera is one that moves inwards at √(2/r), and sees the static one's sky
/// aberrated: cos χ′ = (cos χ + v)/(1 + v cos χ) from the direction of motion.
#[test]
fn aberration() {
    let mut worst = Worst::default();
    for r in [2.3, 3.0, 8.0, 100.0, 1e6_f64] {
        let v = (2.0 / r).sqrt();
        let place = Place { r, theta: 1.1, phi: 0.2 };
        let rest = Observer::new(Some(0.0), place, Motion::Static).unwrap();
        let fall = Observer::new(Some(0.0), place, Motion::Fall).unwrap();
        for k in 0..40 {
            let chi = PI * (f64::from(k) + 0.5) / 40.0;
            let (sin, cos) = chi.sin_cos();
            let (up, side) = (0.3 * f64::from(k)).sin_cos();
            let doppler = 1.0 + v * cos;
            let (cos_seen, sin_seen) = ((cos + v) / doppler, sin * (1.0 - v * v).sqrt() / doppler);
            let first = rest.ray([-cos, sin * up, sin * side]);
            let second = fall.ray([-cos_seen, sin_seen * up, sin_seen * side]);
            // The same photon, but for its energy: 1 there is (1 + v cos χ)γ of the static one's.
            let ratio = doppler / (1.0 - v * v).sqrt();
            let label = || format!("r = {r}, χ = {chi}");
            let (p, q) = (covector(&first), covector(&second));
            // Near the horizon the falling camera is boosted by 2/(r − 2) in the reversed chart.
            let size = largest(p.map(f64::abs)) * (1.0 + 4.0 / (r - 2.0)).powi(2);
            worst.see(largest((0..4).map(|i| (p[i] - q[i] * ratio).abs())) / size, label);
        }
        // And with the velocity given.
        let moving = Observer::new(Some(0.0), place, Motion::Velocity([-v, 0.0, 0.0])).unwrap();
        let (a, b) = (covector(&fall.ray([0.6, 0.0, 0.8])), covector(&moving.ray([0.6, 0.0, 0.8])));
        let size = largest(a.map(f64::abs)) * (1.0 + 4.0 / (r - 2.0)).powi(2);
        worst.see(largest((0..4).map(|i| (a[i] - b[i]).abs())) / size, || format!("given, r = {r}"));
    }
    worst.below(3e-13, "aberration");
}

/// `impact_ray` has the λ and η asked for at any distance and inclination, is null, and is the ray
/// that a static observer's tetrad gives for the direction with these λ and η.
#[test]
fn impact_rays() {
    let mut random = Random::new(75);
    let (mut constants, mut rays) = (Worst::default(), Worst::default());
    for i in 0..4000 {
        let spin = random.pick(&SPINS);
        let s = -spin;
        let r = random.pick(&[3.0, 10.0, 1000.0, 1e6, f64::INFINITY]);
        let theta = match i % 5 {
            0 => 0.0,
            1 => FRAC_PI_2,
            2 => PI,
            _ => random.within(0.0, PI),
        };
        let b = if r < 20.0 { random.within(0.0, 0.9 * r) } else { random.scale(0.01, 50.0) };
        let turn = random.within(-PI, PI);
        let (alpha, beta) = (b * turn.cos(), b * turn.sin());
        let Ok(ray) = impact_ray(Some(spin), theta, r, [alpha, beta]) else { continue };
        // Exactly at the pole and at the equator.
        let sin = if theta == PI { 0.0 } else { theta.sin() };
        let cos = if theta == FRAC_PI_2 { 0.0 } else { theta.cos() };
        let label = || format!("a = {spin}, i = {theta}, r = {r}, ({alpha}, {beta})");
        let conserved = ray.conserved(spin);
        let eta = (alpha * alpha - spin * spin) * cos * cos + beta * beta;
        let size = 1.0 + alpha * alpha + beta * beta;
        constants.see((conserved.lambda + alpha * sin).abs() / size.sqrt(), label);
        constants.see((conserved.eta - eta).abs() / size, label);
        constants.see(Kerr::new(s).norm(ray.energy, &ray.start).abs(), label);
        constants.see((dot(&ray.start.n, &ray.start.n) - 1.0).abs(), label);
        constants.see(dot(&ray.start.n, &ray.start.j).abs() / size.sqrt(), label);
        if r.is_infinite() {
            constants.see((ray.start.q + 1.0).abs() + ray.start.w.abs() + (ray.energy - 1.0).abs(), label);
            continue;
        }
        // n of the static observer, as in `at_rest`, divided by sin θ where that may vanish.
        let sigma = r * r + s * s * cos * cos;
        let delta = (r - 1.0).powi(2) - (1.0 - s) * (1.0 + s);
        let area = (r * r + s * s).powi(2) - s * s * delta * sin * sin;
        let energy = (1.0 - 2.0 * r / sigma).sqrt();
        let g_tp = -2.0 * s * r * sin / sigma;
        let across = (area / sigma + (g_tp / energy).powi(2)).sqrt();
        let n_phi = (energy * alpha - g_tp / energy) / across;
        let n_theta = -beta * energy / sigma.sqrt();
        let n_r = -(1.0 - n_phi * n_phi - n_theta * n_theta).sqrt();
        let place = Place { r, theta, phi: 0.0 };
        let other = Observer::new(Some(spin), place, Motion::Static).unwrap().ray([n_r, n_theta, n_phi]);
        // n_r is the root of a difference.
        let cancel = 1.0 + 1.0 / n_r.abs();
        rays.see((ray.energy - other.energy).abs(), label);
        rays.see((ray.start.w / other.start.w - 1.0).abs(), label);
        rays.see(distance(ray.start.n, other.start.n), label);
        rays.see((ray.start.q - other.start.q).abs() / cancel, label);
        rays.see(distance(ray.start.j, other.start.j) / r / cancel, label);
        if sin > 0.0 || b > 0.1 {
            rays.see(folded(ray.azimuth - other.azimuth).abs() / (1.0 + r / b.max(0.1)), label);
        }
    }
    constants.below(5e-15, "λ, η and H");
    rays.below(2e-15, "against the tetrad");
}

/// Far away the screen is that at infinity.
#[test]
fn screens_tend_to_infinity() {
    for spin in SPINS {
        for theta in [0.0, 0.4, FRAC_PI_2, 3.0] {
            let far = impact_ray(Some(spin), theta, 1e12, [3.0, -7.0]).unwrap();
            let infinite = impact_ray(Some(spin), theta, f64::INFINITY, [3.0, -7.0]).unwrap();
            assert!(distance(far.start.n, infinite.start.n) < 2e-12);
            assert!(distance(far.start.j, infinite.start.j) < 2e-11);
            assert!((far.start.q - infinite.start.q).abs() < 3e-12);
            assert!((far.azimuth - infinite.azimuth).abs() < 2e-12);
        }
    }
}

/// Refused, with the reason.
#[test]
fn impossible_observers() {
    let place = |r: f64, theta: f64| Place { r, theta, phi: 0.0 };
    let refuse = |spin: Option<f64>, place: Place, motion: Motion| {
        let error = check(spin, &place, &motion).unwrap_err();
        assert_eq!(Observer::new(spin, place, motion).unwrap_err(), error);
        assert!(!error.to_string().is_empty());
        error
    };
    let limit = ergosphere(0.9, 1.0);
    assert_eq!(
        refuse(Some(0.9), place(1.6, 1.0), Motion::Static),
        ObserverError::StaticInErgosphere { r: 1.6, limit }
    );
    let horizon = horizons(0.9).0;
    for motion in [Motion::ZeroAngularMomentum, Motion::Static, Motion::Velocity([0.0; 3]), Motion::Orbit] {
        assert_eq!(
            refuse(Some(0.9), place(1.2, FRAC_PI_2), motion),
            ObserverError::InsideHorizon { r: 1.2, horizon }
        );
    }
    let inner_horizon = horizons(0.9).1;
    assert_eq!(
        refuse(Some(0.9), place(0.5, 1.0), Motion::Fall),
        ObserverError::InsideInnerHorizon { r: 0.5, inner_horizon }
    );
    // At a = 0 the inner horizon is the singularity.
    assert!(check(Some(0.0), &place(1e-3, 1.0), &Motion::Fall).is_ok());
    assert!(matches!(refuse(Some(0.9), place(6.0, 1.0), Motion::Orbit), ObserverError::OrbitOffPlane { .. }));
    let photon = Orbits::new(0.9).photon_prograde;
    assert_eq!(
        refuse(Some(0.9), place(1.5, FRAC_PI_2), Motion::Orbit),
        ObserverError::NoOrbit { r: 1.5, photon }
    );
    for v in [[0.6, 0.8, 0.0], [f64::NAN, 0.0, 0.0], [0.0, 0.0, 2.0]] {
        assert!(matches!(refuse_speed(Motion::Velocity(v)), ObserverError::FasterThanLight { .. }));
        assert!(matches!(refuse_speed(Motion::VelocityFromFall(v)), ObserverError::FasterThanLight { .. }));
    }
    assert_eq!(refuse(None, place(6.0, FRAC_PI_2), Motion::Orbit), ObserverError::NothingToOrbit);
    assert_eq!(refuse(Some(0.9), place(f64::INFINITY, 1.0), Motion::Fall), ObserverError::MovingAtInfinity);
    assert_eq!(
        Observer::new(Some(0.9), place(f64::INFINITY, 1.0), Motion::Static).unwrap_err(),
        ObserverError::AtInfinity
    );
    // Too oblique to get there.
    let error = impact_ray(Some(0.5), 1.0, 10.0, [13.0, 0.0]).unwrap_err();
    assert_eq!(error, ObserverError::NoSuchPhoton { alpha: 13.0, beta: 0.0, r: 10.0 });
    assert!(impact_ray(Some(0.9), 1.0, 1.6, [0.0, 0.0]).is_err());
}

fn refuse_speed(motion: Motion) -> ObserverError {
    Observer::new(Some(0.5), Place { r: 6.0, theta: 1.0, phi: 0.0 }, motion).unwrap_err()
}

/// `direction_to`: in flat space the ray passes through the point; around a hole the centre is
/// along −e_r of a static camera at a = 0, and everything is a unit vector.
#[test]
fn directions_to_points() {
    let mut random = Random::new(76);
    for _ in 0..200 {
        let place = Place {
            r: random.within(5.0, 50.0),
            theta: random.within(0.0, PI),
            phi: random.within(-3.0, 3.0),
        };
        let target = random.direction().map(|c| 4.0 * c);
        let flat = Observer::new(None, place, Motion::Static).unwrap();
        let ray = flat.ray(flat.direction_to(target));
        // A plane through the origin and the point, across the ray.
        let along = ray.start.momentum();
        let across = kerrscope_spacetime::tensor::cross(&target, &along);
        let normal = kerrscope_spacetime::tensor::cross(&target, &across);
        let length = dot(&normal, &normal).sqrt();
        let query = Query { plane: normal.map(|c| c / length), ..Query::default() };
        if length > 1.0 {
            let crossing = follow(&Straight, &ray, &query).crossings[0];
            assert!(distance(crossing.position, target) < 1e-12 * place.r);
            let numeric = Integrator::new(Minkowski, Scheme::Dop853 { tolerance: 1e-12 }, 1000);
            assert!(distance(follow(&numeric, &ray, &query).crossings[0].position, target) < 1e-11 * place.r);
        }
        let observer = Observer::new(Some(0.0), place, Motion::Static).unwrap();
        assert!(distance(observer.direction_to([0.0; 3]), [-1.0, 0.0, 0.0]) < 1e-14);
        let observer = Observer::new(Some(0.9), place, Motion::Fall).unwrap();
        let n = observer.direction_to(target);
        assert!((dot(&n, &n) - 1.0).abs() < 1e-15);
    }
}
