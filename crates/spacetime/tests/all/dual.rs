//! Dual numbers against the independent crate `num-dual`, and against derivatives by hand.

use crate::common;

use common::{Random, Worst};
use kerrscope_spacetime::{Dual, Scalar};
use num_dual::{Dual64, DualNum, HyperDual64};

/// The same formula for both kinds of dual number: every operation of `Scalar` that has a
/// derivative, x > 0.
macro_rules! formula {
    ($x:expr, $y:expr) => {{
        let (x, y) = ($x, $y);
        let (sin, cos) = (x * y).sin_cos();
        let a = (sin * 0.3 - 0.1).exp() / (x + 2.0) + (x * x + y * y).sqrt() * 0.5;
        let b = y.atan2(x) - (x + 1.0).ln() * cos + (y * y + 0.7).recip();
        let c = -(a * b) - x.mul_add(y, a) / (b * b + 1.5);
        c * c * c + (a - b) / 3.0
    }};
}

fn ours<S: Scalar>(x: S, y: S) -> S {
    formula!(x, y)
}

fn theirs<D: DualNum<Primitive = f64> + Copy>(x: D, y: D) -> D {
    formula!(x, y)
}

/// The slope along any direction, by both crates.
#[test]
fn first_derivatives() {
    let mut random = Random::new(11);
    let (mut values, mut slopes) = (Worst::default(), Worst::default());
    for _ in 0..5000 {
        let (x, y) = (random.within(0.1, 3.0), random.within(-3.0, 3.0));
        let (dx, dy) = (random.within(-1.0, 1.0), random.within(-1.0, 1.0));
        let [vx, vy] = Dual::variables([x, y]);
        let our = ours(vx, vy);
        let our_slope = our.gradient[0] * dx + our.gradient[1] * dy;
        let their = theirs(Dual64::new(x, dx), Dual64::new(y, dy));
        let size = their.eps.abs().max(their.re.abs()).max(1.0);
        values.see((our.value - their.re).abs() / size, || format!("({x}, {y})"));
        slopes.see((our_slope - their.eps).abs() / size, || format!("({x}, {y})"));
        // With numbers in place of variables nothing has a slope.
        let still = ours(Dual::<f64, 2>::fixed(x), Dual::fixed(y));
        assert_eq!((still.value, still.gradient), (our.value, [0.0; 2]));
        values.see((our.value - ours(x, y)).abs() / size, || format!("({x}, {y})"));
    }
    values.below(1e-14, "values");
    slopes.below(2e-14, "slopes");
}

/// Duals of duals give the second derivatives, among them the mixed one, in either order.
#[test]
fn second_derivatives() {
    let mut random = Random::new(12);
    let mut worst = Worst::default();
    let mut symmetry = Worst::default();
    for _ in 0..5000 {
        let (x, y) = (random.within(0.1, 3.0), random.within(-3.0, 3.0));
        let [vx, vy] = Dual::variables(Dual::<f64, 2>::variables([x, y]));
        let our = ours(vx, vy);
        let along = |e1: [f64; 2], e2: [f64; 2]| {
            theirs(HyperDual64::new(x, e1[0], e2[0], 0.0), HyperDual64::new(y, e1[1], e2[1], 0.0))
        };
        let axes = [[1.0, 0.0], [0.0, 1.0]];
        let size = (0..4).map(|k| along(axes[k / 2], axes[k % 2]).eps1eps2.abs()).fold(1.0, f64::max);
        for (i, e1) in axes.iter().enumerate() {
            for (k, e2) in axes.iter().enumerate() {
                let their = along(*e1, *e2);
                worst.see((our.gradient[i].gradient[k] - their.eps1eps2).abs() / size, || {
                    format!("∂{i}∂{k} at ({x}, {y})")
                });
                worst
                    .see((our.gradient[i].value - their.eps1).abs() / size, || format!("∂{i} at ({x}, {y})"));
                worst
                    .see((our.value.gradient[k] - their.eps2).abs() / size, || format!("∂{k} at ({x}, {y})"));
            }
        }
        symmetry.see((our.gradient[0].gradient[1] - our.gradient[1].gradient[0]).abs() / size, || {
            format!("({x}, {y})")
        });
    }
    worst.below(2e-14, "second derivatives");
    symmetry.below(2e-14, "symmetry");
}

/// Third derivatives of √x at 4: ½x^{−½}, −¼x^{−3/2}, ⅜x^{−5/2}, all exact in binary.
#[test]
fn three_levels() {
    let x = Dual::variable([Dual::variable([Dual::variable([4.0], 0)], 0)], 0);
    let root = x.sqrt();
    assert_eq!(root.value.value.value, 2.0);
    assert_eq!(root.value.value.gradient[0], 0.25);
    assert_eq!(root.gradient[0].gradient[0].value, -1.0 / 32.0);
    assert_eq!(root.gradient[0].gradient[0].gradient[0], 3.0 / 256.0);
    let inverse = x.recip();
    assert_eq!(inverse.gradient[0].gradient[0].gradient[0], -6.0 / 256.0);
    // x² as a product and as a square.
    assert_eq!((x * x).gradient[0].gradient[0].value, 2.0);
    assert_eq!(x.squared().gradient[0].gradient[0].gradient[0], 0.0);
}

/// The choices take the slope of what they chose.
#[test]
fn choices() {
    let [x, y] = Dual::variables([-2.0, 5.0]);
    assert_eq!((x.abs().value, x.abs().gradient), (2.0, [-1.0, 0.0]));
    assert_eq!((y.abs().value, y.abs().gradient), (5.0, [0.0, 1.0]));
    assert_eq!(x.min(y), x);
    assert_eq!(y.min(x), x);
    assert_eq!(x.max(y), y);
    assert_eq!(y.max(x), y);
    assert!(x.less(y) && !y.less(x) && !x.less(x));
    assert_eq!(Dual::select(true, x, y), x);
    assert_eq!(Dual::select(false, x, y), y);
    // Comparisons look at values alone.
    assert!(!Dual { value: 1.0, gradient: [0.0] }.less(Dual { value: 1.0, gradient: [9.0] }));
    assert_eq!(x.constant(3.0), Dual { value: 3.0, gradient: [0.0; 2] });
    assert_eq!((x.lane(0), <Dual<f64, 2> as Scalar>::LANES), (-2.0, 1));
}

/// `+=`, `−=` and `*=` are their operators.
#[test]
fn assignments() {
    let [x, y] = Dual::variables([1.5, -0.7]);
    let mut z = x;
    z += y;
    assert_eq!(z, x + y);
    z -= x * 2.0;
    assert_eq!(z, x + y - x * 2.0);
    z *= y;
    assert_eq!(z, (x + y - x * 2.0) * y);
    let quotient = (x / 4.0 - 1.0) / y;
    assert_eq!(quotient.value, (1.5 / 4.0 - 1.0) / -0.7);
}
