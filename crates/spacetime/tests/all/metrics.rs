//! The metrics' components, and the hand-derived equations of motion against those that dual
//! numbers derive from the components.

use crate::common;

use common::{Random, Worst, largest};
use kerrscope_spacetime::metric::{
    Inverted, Kerr, Metric, Minkowski, Rate, Schwarzschild, inverted_from_rate, rate_from_components,
};
use kerrscope_spacetime::tensor::{Tensor, Vec3, contract, cross, dot, inverse, pair, product};
use kerrscope_spacetime::{Dual, Scalar};

const SPINS: [f64; 9] = [0.0, 0.3, -0.5, 0.9, -0.9, 0.998, -0.998, 1.0, -1.0];
const ENERGIES: [f64; 6] = [1.0, -1.0, 0.0, 0.3, -2.5, 40.0];

/// A place at radius r and any angles.
fn place(random: &mut Random, spin: f64, r: f64) -> Vec3<f64> {
    let n = random.direction();
    let width = r.hypot(spin);
    [width * n[0], width * n[1], r * n[2]]
}

/// A place outside 0.6 r₊ (inside the horizon too), any momentum.
fn sample(random: &mut Random, spin: f64, furthest: f64) -> (f64, Vec3<f64>, Vec3<f64>) {
    let r = random.scale(0.6 * Kerr::new(spin).horizon(), furthest);
    let size = random.scale(0.1, 10.0);
    (random.pick(&ENERGIES), place(random, spin, r), random.direction().map(|c| c * size))
}

/// The same photon in the inverted chart.
fn inverted(x: &Vec3<f64>, p: &Vec3<f64>) -> Inverted<f64> {
    let w = 1.0 / norm(x);
    let n = x.map(|c| c * w);
    Inverted { w, n, q: dot(&n, p), j: cross(x, p) }
}

fn any_spin(random: &mut Random) -> f64 {
    if random.within(0.0, 1.0) < 0.3 { random.within(-1.0, 1.0) } else { random.pick(&SPINS) }
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    largest(a.iter().zip(b).map(|(x, y)| (x - y).abs()))
}

/// Largest difference relative to the natural size of each part: |E| + |p| for the velocity, its
/// square over the distance squared for the force.
fn difference(energy: f64, x: &Vec3<f64>, p: &Vec3<f64>, a: &Rate<f64>, b: &Rate<f64>) -> f64 {
    let size = norm(p) + energy.abs();
    largest([apart(&a.velocity, &b.velocity) / size, apart(&a.force, &b.force) / (size * size) * dot(x, x)])
}

/// The same in the inverted chart.
fn inverted_difference(energy: f64, at: &Inverted<f64>, a: &Inverted<f64>, b: &Inverted<f64>) -> f64 {
    let size = norm(&at.momentum()) + energy.abs();
    let turn = size + norm(&at.j);
    largest([
        (a.w - b.w).abs() / size,
        apart(&a.n, &b.n) / turn,
        (a.q - b.q).abs() / (size * turn),
        apart(&a.j, &b.j) / (size * turn),
    ])
}

/// Hand-derived right-hand sides are those of the components. Near the horizon the comparison is
/// limited by the rounding of the numerical inverse of the metric.
#[test]
fn rate_is_that_of_the_components() {
    let mut random = Random::new(1);
    let (mut near, mut far) = (Worst::default(), Worst::default());
    let mut check =
        |spin: f64, energy: f64, x: &Vec3<f64>, p: &Vec3<f64>, hand: Rate<f64>, dual: Rate<f64>| {
            let which = if norm(x) < 3.0 { &mut near } else { &mut far };
            which.see(difference(energy, x, p, &hand, &dual), || {
                format!("a = {spin}, x = {x:?}, E = {energy}")
            });
        };
    for _ in 0..20_000 {
        let spin = any_spin(&mut random);
        let kerr = Kerr::new(spin);
        let (energy, x, p) = sample(&mut random, spin, 1e3);
        check(spin, energy, &x, &p, kerr.rate(energy, &x, &p), rate_from_components(&kerr, energy, &x, &p));
        let (energy, x, p) = sample(&mut random, 0.0, 1e3);
        let dual = rate_from_components(&Schwarzschild, energy, &x, &p);
        check(0.0, energy, &x, &p, Schwarzschild.rate(energy, &x, &p), dual);
    }
    near.below(1e-13, "rate within 3 M");
    far.below(1e-14, "rate beyond 3 M");
}

/// The general equations divide by w twice, so they round as 1/w.
#[test]
fn inverted_rate_is_that_of_the_rate() {
    let mut random = Random::new(2);
    let mut worst = Worst::default();
    for _ in 0..20_000 {
        let spin = any_spin(&mut random);
        let kerr = Kerr::new(spin);
        let (energy, x, p) = sample(&mut random, spin, 100.0);
        let state = inverted(&x, &p);
        let (hand, general) = (kerr.inverted_rate(energy, &state), inverted_from_rate(&kerr, energy, &state));
        worst.see(inverted_difference(energy, &state, &hand, &general) * state.w.min(1.0), || {
            format!("a = {spin}, E = {energy}, {state:?}")
        });
        let (energy, x, p) = sample(&mut random, 0.0, 100.0);
        let state = inverted(&x, &p);
        let hand = Schwarzschild.inverted_rate(energy, &state);
        let general = inverted_from_rate(&Schwarzschild, energy, &state);
        worst.see(inverted_difference(energy, &state, &hand, &general) * state.w.min(1.0), || {
            format!("E = {energy}, {state:?}")
        });
    }
    worst.below(3e-14, "inverted rate times w");
}

/// Schwarzschild's own equations are Kerr's at a = 0, at infinity and inside the horizon too.
#[test]
fn schwarzschild_is_kerr_without_spin() {
    let kerr = Kerr::new(0.0);
    let mut random = Random::new(3);
    let mut worst = Worst::default();
    for i in 0..5000 {
        let (energy, x, p) = sample(&mut random, 0.0, 1e3);
        let mut state = inverted(&x, &p);
        if i % 10 == 0 {
            state.w = 0.0;
        }
        let place = || format!("E = {energy}, {state:?}");
        worst.see(
            difference(energy, &x, &p, &Schwarzschild.rate(energy, &x, &p), &kerr.rate(energy, &x, &p)),
            place,
        );
        let rates = (Schwarzschild.inverted_rate(energy, &state), kerr.inverted_rate(energy, &state));
        worst.see(inverted_difference(energy, &state, &rates.0, &rates.1), place);
        let size = (norm(&state.momentum()) + energy.abs()).powi(2);
        worst.see((Schwarzschild.norm(energy, &state) - kerr.norm(energy, &state)).abs() / size, place);
        let squared = dot(&state.j, &state.j);
        let (carter, other) = (Schwarzschild.carter(energy, &state), kerr.carter(energy, &state));
        worst.see((carter.unwrap() - other.unwrap()).abs() / squared, place);
        worst.see((carter.unwrap() + state.j[2].powi(2) - squared).abs() / squared, place);
        worst.see((Schwarzschild.radius(&x) / kerr.radius(&x) - 1.0).abs(), place);
        worst.see(
            (Schwarzschild.inverse_radius(state.w, &state.n) - kerr.inverse_radius(state.w, &state.n)).abs(),
            place,
        );
        worst.see(
            largest((0..4).map(|i| apart(&Schwarzschild.components(&x)[i], &kerr.components(&x)[i]))),
            place,
        );
    }
    worst.below(5e-15, "Schwarzschild against Kerr");
    assert_eq!(Schwarzschild.horizon(), kerr.horizon());
    assert_eq!(Schwarzschild.reversed(), Schwarzschild);
    for r in [2.1, 6.0, 1e5] {
        assert_eq!(Schwarzschild.time_offset(r), kerr.time_offset(r));
        assert_eq!(Schwarzschild.azimuth_offset(r), 0.0);
        assert_eq!(kerr.azimuth_offset(r), 0.0);
        // K = 2 ln(r − 2).
        assert!(
            (kerr.time_offset(r) - 2.0 * (r - 2.0).ln()).abs() < 1e-14 * kerr.time_offset(r).abs().max(1.0)
        );
    }
}

fn unit_error(a: &Tensor<f64>, b: &Tensor<f64>) -> f64 {
    largest((0..4).flat_map(|i| {
        (0..4).map(move |k| {
            let sum: f64 = (0..4).map(|m| a[i][m] * b[m][k]).sum();
            (sum - if i == k { 1.0 } else { 0.0 }).abs()
        })
    }))
}

#[test]
fn inverse_components_invert() {
    let mut random = Random::new(4);
    let (mut closed, mut minors, mut determinants) = (Worst::default(), Worst::default(), Worst::default());
    for _ in 0..5000 {
        let spin = any_spin(&mut random);
        let kerr = Kerr::new(spin);
        let (_, x, _) = sample(&mut random, spin, 1e3);
        let place = || format!("a = {spin}, x = {x:?}");
        let g = kerr.components(&x);
        closed.see(unit_error(&kerr.inverse_components(&x), &g), place);
        closed.see(unit_error(&Schwarzschild.inverse_components(&x), &Schwarzschild.components(&x)), place);
        closed.see(unit_error(&Minkowski.inverse_components(&x), &Minkowski.components(&x)), place);
        minors.see(unit_error(&inverse(&g), &g), place);
        // l is null, so det(η + f l l) = −1.
        determinants.see((determinant(&g) + 1.0).abs(), place);
    }
    closed.below(5e-15, "closed form");
    minors.below(1e-14, "2×2 minors");
    determinants.below(1e-14, "determinant");
}

/// Any symmetric tensor, not only one of the form η + f l l, whose minors vanish by halves.
#[test]
fn inverses_of_symmetric_tensors() {
    let mut random = Random::new(12);
    let mut worst = Worst::default();
    for _ in 0..2000 {
        let any: Tensor<f64> = std::array::from_fn(|_| std::array::from_fn(|_| random.within(-1.0, 1.0)));
        let m: Tensor<f64> = std::array::from_fn(|i| std::array::from_fn(|k| any[i.min(k)][i.max(k)]));
        let condition = 1.0 / determinant(&m).abs();
        let other = inverse(&m);
        worst.see(unit_error(&other, &m) / condition, || format!("{m:?}"));
        assert!((0..4).all(|i| (0..4).all(|k| other[i][k] == other[k][i])));
    }
    worst.below(1e-14, "inverse");
}

/// Leibniz's sum over the 24 permutations.
fn determinant(m: &Tensor<f64>) -> f64 {
    let mut sum = 0.0;
    for a in 0..4 {
        for b in (0..4).filter(|b| *b != a) {
            for c in (0..4).filter(|c| *c != a && *c != b) {
                let d = 6 - a - b - c;
                let order = [a, b, c, d];
                let swaps = (0..4)
                    .flat_map(|i| (i + 1..4).map(move |k| (i, k)))
                    .filter(|(i, k)| order[*i] > order[*k])
                    .count();
                let term = m[0][a] * m[1][b] * m[2][c] * m[3][d];
                sum += if swaps % 2 == 0 { term } else { -term };
            }
        }
    }
    sum
}

/// Hamilton's equations: ẋ = ∂H/∂p, ṗ = −∂H/∂x, by differences of order six of H = ½ g^{μν} p_μ p_ν.
#[test]
fn rates_are_derivatives_of_the_hamiltonian() {
    fn slope(h: f64, f: impl Fn(f64) -> f64) -> f64 {
        let pair = |k: f64| f(k * h) - f(-k * h);
        (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * h)
    }
    fn check<M: Metric>(metric: &M, energy: f64, x: &Vec3<f64>, p: &Vec3<f64>) -> f64 {
        let hamiltonian = |x: &Vec3<f64>, p: &Vec3<f64>| {
            let p = [-energy, p[0], p[1], p[2]];
            0.5 * product(&metric.inverse_components(x), &p, &p)
        };
        let moved = |v: &Vec3<f64>, i: usize, by: f64| {
            let mut v = *v;
            v[i] += by;
            v
        };
        let differences = Rate {
            velocity: std::array::from_fn(|i| slope(0.02 * norm(p), |by| hamiltonian(x, &moved(p, i, by)))),
            force: std::array::from_fn(|i| -slope(2e-3 * norm(x), |by| hamiltonian(&moved(x, i, by), p))),
        };
        difference(energy, x, p, &metric.rate(energy, x, p), &differences)
    }
    let mut random = Random::new(5);
    let mut worst = Worst::default();
    for _ in 0..2000 {
        let spin = any_spin(&mut random);
        let (energy, x, p) = sample(&mut random, spin, 30.0);
        let x = if norm(&x) < 1.5 { x.map(|c| 2.0 * c) } else { x };
        let place = || format!("a = {spin}, x = {x:?}, E = {energy}");
        worst.see(check(&Kerr::new(spin), energy, &x, &p), place);
        worst.see(check(&Schwarzschild, energy, &x, &p), place);
        worst.see(check(&Minkowski, energy, &x, &p), place);
    }
    worst.below(5e-12, "derivatives of H");
}

/// r is that of the spheroid (x² + y²)/(r² + a²) + z²/r² = 1, in both charts.
#[test]
fn radius_is_that_of_the_spheroid() {
    let mut random = Random::new(6);
    let mut worst = Worst::default();
    for _ in 0..5000 {
        let spin = any_spin(&mut random);
        let r = random.scale(0.6, 1e6);
        let x = place(&mut random, spin, r);
        let w = 1.0 / norm(&x);
        let kerr = Kerr::new(spin);
        worst.see((kerr.radius(&x) / r - 1.0).abs(), || format!("a = {spin}, r = {r}"));
        worst.see((kerr.inverse_radius(w, &x.map(|c| c * w)) * r - 1.0).abs(), || {
            format!("a = {spin}, r = {r}")
        });
    }
    worst.below(2e-15, "r");
    assert_eq!(Kerr::new(0.9).inverse_radius(0.0, &[0.6, 0.0, 0.8]), 0.0);
    assert_eq!(Minkowski.inverse_radius(0.0, &[0.6, 0.0, 0.8]), 0.0);
}

/// Kerr's regular forms of g^{μν} p_μ p_ν and of Carter's constant against the textbook's.
#[test]
fn conserved_quantities_have_their_textbook_values() {
    let mut random = Random::new(7);
    let (mut norms, mut carters) = (Worst::default(), Worst::default());
    for _ in 0..5000 {
        let spin = any_spin(&mut random);
        let kerr = Kerr::new(spin);
        let (energy, x, p) = sample(&mut random, spin, 1e3);
        let state = inverted(&x, &p);
        let size = norm(&p) + energy.abs();
        let full = [-energy, p[0], p[1], p[2]];
        let direct = product(&kerr.inverse_components(&x), &full, &full);
        let place = || format!("a = {spin}, E = {energy}, {state:?}");
        norms.see((kerr.norm(energy, &state) - direct).abs() / (size * size), place);
        // Q = p_θ² + cos²θ (L²/sin²θ − a²E²), θ at fixed r and azimuth.
        let r = kerr.radius(&x);
        let cos = x[2] / r;
        let sin = (1.0 - cos * cos).sqrt();
        let p_theta = (x[0] * p[0] + x[1] * p[1]) * cos / sin - r * sin * p[2];
        let l = state.j[2];
        let direct = p_theta.powi(2) + cos * cos * ((l / sin).powi(2) - (spin * energy).powi(2));
        let scale = dot(&state.j, &state.j) + size * size;
        // Near the axis the textbook's terms cancel.
        if sin > 0.1 {
            carters.see((kerr.carter(energy, &state).unwrap() - direct).abs() / scale, place);
        }
    }
    norms.below(5e-15, "2H");
    carters.below(1e-13, "Carter's constant");
    assert_eq!(Minkowski.carter(1.0, &inverted(&[3.0, 0.0, 4.0], &[1.0, 0.0, 0.0])), None);
}

/// Γ^μ_{στ} = ½ g^{μα}(∂_σ g_{τα} + ∂_τ g_{ασ} − ∂_α g_{στ}).
fn christoffel<M: Metric, S: Scalar>(metric: &M, x: &Vec3<S>) -> [Tensor<S>; 4] {
    let g = metric.components(&Dual::variables(*x));
    let raised = metric.inverse_components(x);
    let zero = x[0].constant(0.0);
    let slope = |a: usize, m: usize, n: usize| if a == 0 { zero } else { g[m][n].gradient[a - 1] };
    std::array::from_fn(|m| {
        std::array::from_fn(|s| {
            std::array::from_fn(|t| {
                (0..4).fold(zero, |sum, a| {
                    sum + raised[m][a] * (slope(s, t, a) + slope(t, a, s) - slope(a, s, t)) * 0.5
                })
            })
        })
    })
}

/// Both holes solve Einstein's equations in vacuum: R_{μν} = 0, by duals of duals.
#[test]
fn vacuum() {
    fn ricci<M: Metric>(metric: &M, x: &Vec3<f64>) -> (f64, f64) {
        let nested = christoffel(metric, &Dual::variables(*x));
        let gamma = |m: usize, s: usize, t: usize| nested[m][s][t].value;
        let slope = |a: usize, m: usize, s: usize, t: usize| {
            if a == 0 { 0.0 } else { nested[m][s][t].gradient[a - 1] }
        };
        let (mut worst, mut size): (f64, f64) = (0.0, 0.0);
        for s in 0..4 {
            for n in 0..4 {
                let mut sum = 0.0;
                for r in 0..4 {
                    let mut terms = vec![slope(r, r, n, s), -slope(n, r, r, s)];
                    for l in 0..4 {
                        terms.push(gamma(r, r, l) * gamma(l, n, s));
                        terms.push(-gamma(r, n, l) * gamma(l, r, s));
                    }
                    sum += terms.iter().sum::<f64>();
                    size = size.max(largest(terms.iter().map(|t| t.abs())));
                }
                worst = largest([worst, sum.abs()]);
            }
        }
        (worst, size)
    }
    let mut random = Random::new(8);
    let mut worst = Worst::default();
    for _ in 0..500 {
        let spin = any_spin(&mut random);
        let (_, x, _) = sample(&mut random, spin, 30.0);
        let (error, size) = ricci(&Kerr::new(spin), &x);
        worst.see(error / size, || format!("a = {spin}, x = {x:?}"));
        let (error, size) = ricci(&Schwarzschild, &x);
        worst.see(error / size, || format!("a = 0, x = {x:?}"));
        assert_eq!(ricci(&Minkowski, &x), (0.0, 0.0));
    }
    worst.below(1e-14, "Ricci tensor");
}

/// Christoffel symbols of Schwarzschild in the textbook's coordinates and of flat polar
/// coordinates: the derivatives by duals, the tensor algebra, and a metric that somebody else adds.
#[test]
fn christoffel_symbols_of_a_metric_by_hand() {
    #[derive(Clone, Copy)]
    struct Textbook;
    impl Metric for Textbook {
        // (t, r, θ, φ) in place of (t, x, y, z).
        fn components<S: Scalar>(&self, x: &Vec3<S>) -> Tensor<S> {
            let zero = x[0].constant(0.0);
            let lapse = x[0].recip() * -2.0 + 1.0;
            let mut g = [[zero; 4]; 4];
            g[0][0] = -lapse;
            g[1][1] = lapse.recip();
            g[2][2] = x[0].squared();
            g[3][3] = (x[0] * x[1].sin_cos().0).squared();
            g
        }
        fn radius<S: Scalar>(&self, x: &Vec3<S>) -> S {
            x[0]
        }
        fn horizon(&self) -> f64 {
            2.0
        }
    }
    let mut random = Random::new(9);
    for _ in 0..100 {
        let (r, theta) = (random.within(2.1, 30.0), random.within(0.1, 3.0));
        let (sin, cos) = theta.sin_cos();
        let got = christoffel(&Textbook, &[r, theta, 0.7]);
        let mut want = [[[0.0; 4]; 4]; 4];
        let mut set = |m: usize, s: usize, t: usize, value: f64| {
            want[m][s][t] = value;
            want[m][t][s] = value;
        };
        set(0, 0, 1, 1.0 / (r * (r - 2.0)));
        set(1, 0, 0, (r - 2.0) / r.powi(3));
        set(1, 1, 1, -1.0 / (r * (r - 2.0)));
        set(1, 2, 2, -(r - 2.0));
        set(1, 3, 3, -(r - 2.0) * sin * sin);
        set(2, 1, 2, 1.0 / r);
        set(2, 3, 3, -sin * cos);
        set(3, 1, 3, 1.0 / r);
        set(3, 2, 3, cos / sin);
        for m in 0..4 {
            for s in 0..4 {
                let error = apart(&got[m][s], &want[m][s]);
                assert!(
                    error < 1e-14 * norm(&want[m][s]).max(1.0),
                    "Γ^{m}_{s}: {:?}, {:?}",
                    got[m][s],
                    want[m][s]
                );
            }
        }
        // The general equations of motion agree with the geodesic equation, ṗ_i = Γ^μ_{iν} p_μ ẋᵛ.
        let (energy, x, p) = (random.within(-2.0, 2.0), [r, theta, 0.7], random.direction());
        let rate = Textbook.rate(energy, &x, &p);
        let full = [-energy, p[0], p[1], p[2]];
        let velocity = contract(&Textbook.inverse_components(&x), &full);
        for i in 0..3 {
            let force: f64 = (0..4).map(|m| full[m] * pair(&want[m][i + 1], &velocity)).sum();
            assert!((rate.force[i] - force).abs() < 2e-14, "{} {force}", rate.force[i]);
            assert!((rate.velocity[i] - velocity[i + 1]).abs() < 1e-15 * norm(&velocity).max(1.0));
        }
    }
}

/// Time reversal, and the horizon's twist: dφ̃/dr and dt̃/dr of the offsets are those of the chart,
/// φ̃ − φ = ∫s dr/Δ, t̃ − t = ∫2r dr/Δ.
#[test]
fn offsets_have_their_slopes() {
    let mut random = Random::new(10);
    let (mut twist, mut delay) = (Worst::default(), Worst::default());
    for i in 0..2000 {
        let spin = match i % 4 {
            0 => random.pick(&[1.0, -1.0, 1.0 - 1e-15, 1.0 - 1e-14]),
            _ => any_spin(&mut random),
        };
        let kerr = Kerr::new(spin);
        assert_eq!(kerr.reversed(), Kerr::new(-spin));
        let r = kerr.horizon() * (1.0 + random.scale(1e-2, 1e4));
        let h = 2e-3 * (r - kerr.horizon());
        let slope = |f: &dyn Fn(f64) -> f64| {
            let pair = |k: f64| f(r + k * h) - f(r - k * h);
            (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * h)
        };
        let delta = (r - 1.0).powi(2) - (1.0 - spin) * (1.0 + spin);
        // atan2(s, r) belongs to x + iy = (r + is) e^{iφ̃} sinθ.
        let turned = slope(&|r| kerr.azimuth_offset(r) - spin.atan2(r));
        twist.see((turned - spin / delta).abs() * delta, || format!("a = {spin}, r = {r}"));
        let delayed = slope(&|r| kerr.time_offset(r));
        delay.see((delayed - 2.0 * r / delta).abs() * delta / r, || format!("a = {spin}, r = {r}"));
        // Both vanish in the sense that they should far away.
        let far = 1e9;
        assert!(kerr.azimuth_offset(far).abs() < 1e-15);
        assert!((kerr.time_offset(far) - 2.0 * far.ln()).abs() < 1e-7);
    }
    twist.below(1e-10, "azimuth offset");
    delay.below(1e-10, "time offset");
}
