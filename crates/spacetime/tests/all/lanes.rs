//! Eight lanes give each lane the scalar answer, with every set of instructions this machine has.

use crate::common;

use common::{Random, Worst, largest};
use fearless_simd::{Level, Simd, dispatch};
use kerrscope_spacetime::geodesic::{Dop853, Flow, InvertedFlow, Method, Tsit5};
use kerrscope_spacetime::metric::{
    Inverted, Kerr, Metric, Schwarzschild, inverted_from_rate, rate_from_components,
};
use kerrscope_spacetime::tensor::{cross, dot};
use kerrscope_spacetime::{Dual, Lanes, Scalar};

/// Every level of instructions that this machine has, the best first.
fn levels() -> Vec<Level> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let levels = {
        let mut levels = vec![best];
        levels.extend(best.as_avx2().map(Level::Avx2));
        levels.extend(best.as_sse4_2().map(Level::Sse4_2));
        levels.extend(best.as_sse2().map(Level::Sse2));
        levels
    };
    #[cfg(not(target_arch = "x86_64"))]
    let levels = vec![best];
    levels
}

#[derive(Clone, Copy)]
struct Bench<L>(L);

impl<L: Simd> Bench<L> {
    fn lanes(self, f: impl Fn(usize) -> f64) -> Lanes<L> {
        Lanes::new(self.0, std::array::from_fn(f))
    }
}

fn numbers(random: &mut Random) -> [f64; 8] {
    std::array::from_fn(|_| random.within(-3.0, 3.0))
}

/// Elementary functions agree with those of f64 to two units in the last place.
#[inline(always)]
fn elementary<L: Simd>(simd: L) {
    let mut random = Random::new(22);
    for round in 0..4000 {
        // Sizes from 1e-12 to 1e5, and both signs.
        let a: [f64; 8] = std::array::from_fn(|_| {
            let size = 10f64.powf(random.within(-12.0, 5.0));
            if random.within(-1.0, 1.0) < 0.0 { -size } else { size }
        });
        let b: [f64; 8] = std::array::from_fn(|k| match round % 8 {
            0 => 0.0,
            1 => -0.0,
            2 => a[k],
            3 => -a[k],
            _ => random.within(-3.0, 3.0),
        });
        let (x, y) = (Lanes::new(simd, a), Lanes::new(simd, b));
        let near = |what: &str, lanes: Lanes<L>, exact: &dyn Fn(usize) -> f64, scale: f64| {
            for (k, got) in lanes.to_array().into_iter().enumerate() {
                let exact = exact(k);
                let error = (got - exact).abs() / exact.abs().max(scale);
                assert!(error <= 2.0 * f64::EPSILON, "{what} of {}, {}: {got} for {exact}", a[k], b[k]);
            }
        };
        near("sin", x.sin_cos().0, &|k| a[k].sin(), 1.0);
        near("cos", x.sin_cos().1, &|k| a[k].cos(), 1.0);
        let bounded = x.min(x.constant(690.0)).max(x.constant(-690.0));
        near("exp", bounded.exp(), &|k| a[k].clamp(-690.0, 690.0).exp(), f64::MIN_POSITIVE);
        near("ln", x.abs().ln(), &|k| a[k].abs().ln(), f64::MIN_POSITIVE);
        near("atan2(x, y)", x.atan2(y), &|k| a[k].atan2(b[k]), f64::MIN_POSITIVE);
        near("atan2(y, x)", y.atan2(x), &|k| b[k].atan2(a[k]), f64::MIN_POSITIVE);
        for (got, (a, b)) in y.atan2(x).to_array().into_iter().zip(a.into_iter().zip(b)) {
            assert_eq!(got.is_sign_negative(), b.atan2(a).is_sign_negative(), "the sign of zero");
        }
    }
    let specials = [0.0, -0.0, 1.0, -1.0, 0.5, 1e-300, -1e-300, 700.0];
    let x = Lanes::new(simd, specials);
    let zero = x.constant(0.0);
    for (got, x) in zero.atan2(x).to_array().into_iter().zip(specials) {
        assert_eq!(got, 0f64.atan2(x), "atan2(0, {x})");
    }
    for (got, x) in x.round().to_array().into_iter().zip(specials) {
        assert_eq!(got, x.round_ties_even());
    }
    assert!((x.constant(-1e4).exp().lane(0) / (-700f64).exp() - 1.0).abs() < 4e-16);
}

#[test]
fn elementary_functions_are_exact_to_two_units() {
    for level in levels() {
        dispatch!(level, simd => elementary(simd));
    }
}

/// One operation is one rounding: the same bits.
#[inline(always)]
fn operations<L: Simd>(simd: L) {
    let mut random = Random::new(21);
    for _ in 0..500 {
        let (a, b) = (numbers(&mut random), numbers(&mut random));
        let (x, y) = (Lanes::new(simd, a), Lanes::new(simd, b));
        let unary = |what: &str, lanes: Lanes<L>, f: fn(f64) -> f64| {
            for (k, got) in lanes.to_array().into_iter().enumerate() {
                assert_eq!(got.to_bits(), f(a[k]).to_bits(), "{what} of {}", a[k]);
                assert_eq!(got.to_bits(), lanes.lane(k).to_bits(), "lane {k}");
            }
        };
        let binary = |what: &str, lanes: Lanes<L>, f: fn(f64, f64) -> f64| {
            for (k, got) in lanes.to_array().into_iter().enumerate() {
                assert_eq!(got.to_bits(), f(a[k], b[k]).to_bits(), "{what} of {} and {}", a[k], b[k]);
            }
        };
        unary("−", -x, |a| -a);
        unary("√", x.abs().sqrt(), |a| a.abs().sqrt());
        unary("1/", x.recip(), |a| 1.0 / a);
        unary("||", x.abs(), f64::abs);
        unary("squared", x.squared(), |a| a * a);
        unary("+ 0.1", x + 0.1, |a| a + 0.1);
        unary("− 0.1", x - 0.1, |a| a - 0.1);
        unary("× 0.1", x * 0.1, |a| a * 0.1);
        unary("/ 0.3", x / 0.3, |a| a / 0.3);
        unary("constant", x.constant(0.1), |_| 0.1);
        binary("+", x + y, |a, b| a + b);
        binary("−", x - y, |a, b| a - b);
        binary("×", x * y, |a, b| a * b);
        binary("/", x / y, |a, b| a / b);
        binary("min", x.min(y), f64::min);
        binary("max", x.max(y), f64::max);
        binary("select", Lanes::select(x.less(y), x * 2.0, y), |a, b| if a < b { a * 2.0 } else { b });
        let (mut sum, mut rest, mut product) = (x, x, x);
        sum += y;
        rest -= y;
        product *= y;
        binary("+=", sum, |a, b| a + b);
        binary("−=", rest, |a, b| a - b);
        binary("×=", product, |a, b| a * b);
        // Fused or not, but nothing else.
        for (k, got) in x.mul_add(y, x).to_array().into_iter().enumerate() {
            let (fused, split) = (a[k].mul_add(b[k], a[k]), a[k] * b[k] + a[k]);
            assert!(got == fused || got == split, "{got} is neither {fused} nor {split}");
        }
    }
    assert_eq!(<Lanes<L> as Scalar>::LANES, 8);
}

#[test]
fn operations_are_those_of_each_number() {
    for level in levels() {
        dispatch!(level, simd => operations(simd));
    }
}

/// Comparisons with NaN are false, and √ of a negative number is NaN in its lane alone.
#[inline(always)]
fn not_a_number<L: Simd>(simd: L) {
    let bench = Bench(simd);
    let x = bench.lanes(|k| if k == 3 { -1.0 } else { k as f64 });
    let root = x.sqrt();
    for k in 0..8 {
        assert_eq!(root.lane(k).is_nan(), k == 3);
    }
    let chosen = Lanes::select(root.less(x.constant(100.0)), root, x.constant(-5.0));
    assert_eq!(chosen.lane(3), -5.0);
    assert_eq!(chosen.lane(4), 2.0);
}

#[test]
fn a_bad_lane_stays_alone() {
    for level in levels() {
        dispatch!(level, simd => not_a_number(simd));
    }
}

/// Energies and states, as eight and as one of lanes.
type Photons<L> = ([f64; 8], [Inverted<f64>; 8], Lanes<L>, Inverted<Lanes<L>>);

/// Eight photons.
fn photons<L: Simd>(random: &mut Random, simd: L) -> Photons<L> {
    let energies: [f64; 8] = std::array::from_fn(|_| random.within(-2.0, 2.0));
    let states: [Inverted<f64>; 8] = std::array::from_fn(|k| {
        let n = random.direction();
        // One lane at infinity.
        let w = if k == 5 { 0.0 } else { random.scale(1e-3, 0.6) };
        let size = random.scale(0.5, 10.0);
        let j = cross(&n, &random.direction()).map(|c| c * size);
        Inverted { w, n, q: random.within(-2.0, 2.0), j }
    });
    let bench = Bench(simd);
    let lanes = Inverted {
        w: bench.lanes(|k| states[k].w),
        n: std::array::from_fn(|i| bench.lanes(|k| states[k].n[i])),
        q: bench.lanes(|k| states[k].q),
        j: std::array::from_fn(|i| bench.lanes(|k| states[k].j[i])),
    };
    (energies, states, Lanes::new(simd, energies), lanes)
}

fn size(energy: f64, state: &Inverted<f64>) -> f64 {
    let p = state.momentum();
    let whole = energy.abs() + dot(&p, &p).sqrt() + dot(&state.j, &state.j).sqrt();
    whole * whole
}

fn difference<L: Simd>(lanes: &Inverted<Lanes<L>>, k: usize, one: &Inverted<f64>) -> f64 {
    largest([(lanes.w.lane(k) - one.w).abs(), (lanes.q.lane(k) - one.q).abs()].into_iter().chain(
        (0..3).flat_map(|i| [(lanes.n[i].lane(k) - one.n[i]).abs(), (lanes.j[i].lane(k) - one.j[i]).abs()]),
    ))
}

/// The equations of motion, by hand and by duals of lanes, for eight photons at once.
#[inline(always)]
fn equations<L: Simd>(simd: L) {
    let mut random = Random::new(22);
    let (mut hand, mut dual, mut norms) = (Worst::default(), Worst::default(), Worst::default());
    for _ in 0..300 {
        let kerr = Kerr::new(random.within(-1.0, 1.0));
        let (energies, states, energy, state) = photons(&mut random, simd);
        let (all, all_static) =
            (kerr.inverted_rate(energy, &state), Schwarzschild.inverted_rate(energy, &state));
        for k in 0..8 {
            let scale = size(energies[k], &states[k]);
            let place = || format!("{kerr:?}, {:?}", states[k]);
            hand.see(difference(&all, k, &kerr.inverted_rate(energies[k], &states[k])) / scale, place);
            let one = Schwarzschild.inverted_rate(energies[k], &states[k]);
            hand.see(difference(&all_static, k, &one) / scale, place);
        }
        // The general equations, which divide by w.
        let x = state.n.map(|c| c / (state.w + 0.1));
        let p = state.momentum();
        let rate = rate_from_components(&kerr, energy, &x, &p);
        let finite = Inverted { w: state.w + 0.1, ..state };
        let general = inverted_from_rate(&kerr, energy, &finite);
        for k in 0..8 {
            let scale = size(energies[k], &states[k]);
            let place = || format!("{kerr:?}, {:?}", states[k]);
            let one_state = Inverted { w: states[k].w + 0.1, ..states[k] };
            let (one_x, one_p) = (one_state.n.map(|c| c / one_state.w), states[k].momentum());
            let one = rate_from_components(&kerr, energies[k], &one_x, &one_p);
            for i in 0..3 {
                dual.see((rate.velocity[i].lane(k) - one.velocity[i]).abs() / scale.sqrt(), place);
                dual.see((rate.force[i].lane(k) - one.force[i]).abs() / scale, place);
                norms.see((kerr.radius(&x).lane(k) / kerr.radius(&one_x) - 1.0).abs(), place);
            }
            hand.see(
                difference(&general, k, &inverted_from_rate(&kerr, energies[k], &one_state)) / scale * 0.1,
                place,
            );
        }
    }
    hand.below(4e-15, "equations by hand");
    dual.below(1e-15, "equations by duals");
    norms.below(1e-15, "radius");
}

#[test]
fn equations_are_those_of_each_photon() {
    for level in levels() {
        println!("{level:?}");
        dispatch!(level, simd => equations(simd));
    }
}

/// Derivatives of lanes: each lane has its own.
#[inline(always)]
fn derivatives<L: Simd>(simd: L) {
    fn f<S: Scalar>(x: S, y: S) -> S {
        let (sin, cos) = (x * y).sin_cos();
        (sin.exp() / (x.squared() + 1.0) - y.atan2(x) * cos).max(x.min(y).abs() * 0.01)
            + (x.abs() + 1.0).ln().sqrt()
    }
    let mut random = Random::new(23);
    let mut worst = Worst::default();
    for _ in 0..300 {
        let (a, b) = (numbers(&mut random), numbers(&mut random));
        let [x, y] = Dual::variables([Lanes::new(simd, a), Lanes::new(simd, b)]);
        let all = f(x, y);
        assert_eq!(<Dual<Lanes<L>, 2> as Scalar>::LANES, 8);
        for k in 0..8 {
            let [x, y] = Dual::variables([a[k], b[k]]);
            let one = f(x, y);
            worst.see((all.lane(k) - one.value).abs(), || format!("({}, {})", a[k], b[k]));
            for i in 0..2 {
                let scale = one.gradient[i].abs().max(1.0);
                worst.see((all.gradient[i].lane(k) - one.gradient[i]).abs() / scale, || {
                    format!("({}, {})", a[k], b[k])
                });
            }
        }
    }
    // Elementary functions differ by two units in the last place, and there are five of them.
    worst.below(1e-14, "derivatives");
}

#[test]
fn derivatives_are_those_of_each_number() {
    for level in levels() {
        dispatch!(level, simd => derivatives(simd));
    }
}

/// A whole step with its error estimate and dense output, lanes with steps of their own.
#[inline(always)]
fn steps<L: Simd, M: Method<STAGES>, const STAGES: usize>(simd: L) {
    let mut random = Random::new(24);
    let (mut ends, mut errors, mut dense_worst) = (Worst::default(), Worst::default(), Worst::default());
    for _ in 0..100 {
        let metric = Kerr::new(random.within(-1.0, 1.0));
        let (energies, states, energy, state) = photons(&mut random, simd);
        let sizes: [f64; 8] =
            std::array::from_fn(|k| random.within(0.01, 0.1) / size(energies[k], &states[k]).sqrt());
        let (h, flow) = (Lanes::new(simd, sizes), InvertedFlow { metric, energy });
        let pack = |s: &Inverted<Lanes<L>>| [s.w, s.n[0], s.n[1], s.n[2], s.q, s.j[0], s.j[1], s.j[2]];
        let y = pack(&state);
        let slope = pack(&metric.inverted_rate(energy, &state));
        let mut k = [slope; STAGES];
        let step = M::step(&flow, &y, &mut k, h);
        let end_slope = Flow::derivative(&flow, &step.end);
        let dense = M::dense(&flow, &y, &k, &step.end, &end_slope, h).at(h.constant(0.4));
        for k in 0..8 {
            let flow = InvertedFlow { metric, energy: energies[k] };
            let s = states[k];
            let y = [s.w, s.n[0], s.n[1], s.n[2], s.q, s.j[0], s.j[1], s.j[2]];
            let slope = Flow::derivative(&flow, &y);
            let mut stages = [slope; STAGES];
            let one = M::step(&flow, &y, &mut stages, sizes[k]);
            let end_slope = Flow::derivative(&flow, &one.end);
            let one_dense = M::dense(&flow, &y, &stages, &one.end, &end_slope, sizes[k]).at(0.4);
            let scale = size(energies[k], &s).sqrt();
            let place = || format!("{metric:?}, {s:?}, h = {}", sizes[k]);
            for i in 0..8 {
                ends.see((step.end[i].lane(k) - one.end[i]).abs() / scale, place);
                dense_worst.see((dense[i].lane(k) - one_dense[i]).abs() / scale, place);
            }
            errors.see((step.error.lane(k) - one.error).abs(), place);
        }
    }
    ends.below(2e-15, "ends of steps");
    dense_worst.below(1e-15, "dense output");
    errors.below(3e-16, "error estimates");
}

#[test]
fn steps_are_those_of_each_photon() {
    for level in levels() {
        println!("{level:?}");
        dispatch!(level, simd => steps::<_, Tsit5, 6>(simd));
        dispatch!(level, simd => steps::<_, Dop853, 12>(simd));
    }
}
