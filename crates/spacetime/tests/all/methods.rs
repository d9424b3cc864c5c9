//! Runge–Kutta methods: their order, their error estimates and their dense output.

use crate::common;

use common::{Worst, largest};
use kerrscope_spacetime::Scalar;
use kerrscope_spacetime::geodesic::{Dense, Dop853, Flow, Method, Rk4, Step, Tsit5};

/// The plane Kepler problem with GM = a = 1 and eccentricity e: a nonlinear system with an exact
/// solution. The state is (x, y, ẋ, ẏ).
struct Kepler;

const ECCENTRICITY: f64 = 0.2;

impl<S: Scalar> Flow<S, 4> for Kepler {
    fn derivative(&self, y: &[S; 4]) -> [S; 4] {
        let square = y[0] * y[0] + y[1] * y[1];
        let pull = -(square * square.sqrt()).recip();
        [y[2], y[3], y[0] * pull, y[1] * pull]
    }

    fn inverse_scale(&self, y: &[S; 4]) -> [S; 4] {
        [y[0].constant(1.0); 4]
    }
}

/// From the periapsis at t = 0, by Kepler's equation.
fn kepler(t: f64) -> [f64; 4] {
    let e = ECCENTRICITY;
    let mut anomaly = t;
    for _ in 0..50 {
        anomaly -= (anomaly - e * anomaly.sin() - t) / (1.0 - e * anomaly.cos());
    }
    let (sin, cos) = anomaly.sin_cos();
    let (minor, rate) = ((1.0 - e * e).sqrt(), 1.0 / (1.0 - e * cos));
    [cos - e, minor * sin, -sin * rate, minor * cos * rate]
}

fn apart(a: [f64; 4], b: [f64; 4]) -> f64 {
    largest((0..4).map(|i| (a[i] - b[i]).abs()))
}

/// What a run of constant steps from t = 0 to t = 2 errs by: at its end, and anywhere in between
/// by the dense output.
fn run<M: Method<STAGES>, const STAGES: usize>(steps: u32) -> (f64, f64) {
    let h = 2.0 / f64::from(steps);
    let (mut y, mut between) = (kepler(0.0), 0.0_f64);
    for i in 0..steps {
        let slope = Kepler.derivative(&y);
        let mut stages = [slope; STAGES];
        let step = M::step(&Kepler, &y, &mut stages, h);
        let dense = M::dense(&Kepler, &y, &stages, &step.end, &Kepler.derivative(&step.end), h);
        for k in 1..16 {
            let share = f64::from(k) / 16.0;
            between = largest([between, apart(dense.at(share), kepler((f64::from(i) + share) * h))]);
        }
        y = step.end;
    }
    (apart(y, kepler(2.0)), between)
}

/// log₂ of the ratio of errors as the number of steps doubles, `most` steps in the finest run.
fn orders<M: Method<STAGES>, const STAGES: usize>(most: u32) -> (f64, f64) {
    let ((coarse, coarse_between), (fine, fine_between)) =
        (run::<M, STAGES>(most / 2), run::<M, STAGES>(most));
    println!("{}: {coarse:.2e} → {fine:.2e}; dense {coarse_between:.2e} → {fine_between:.2e}", M::NAME);
    ((coarse / fine).log2(), (coarse_between / fine_between).log2())
}

#[test]
fn order_of_rk4() {
    let (steps, dense) = orders::<Rk4, 4>(512);
    assert!((steps - 4.0).abs() < 0.05, "{steps}");
    assert!((dense - 4.0).abs() < 0.05, "{dense}");
}

#[test]
fn order_of_tsit5() {
    let (steps, dense) = orders::<Tsit5, 6>(256);
    assert!((steps - 5.0).abs() < 0.1, "{steps}");
    assert!((dense - 5.0).abs() < 0.1, "{dense}");
}

#[test]
fn order_of_dop853() {
    let (steps, dense) = orders::<Dop853, 12>(32);
    assert!((steps - 8.0).abs() < 0.1, "{steps}");
    assert!((dense - 8.0).abs() < 0.1, "{dense}");
}

/// y′ = tᵏ, t′ = 1.
struct Power(i32);

impl Flow<f64, 2> for Power {
    fn derivative(&self, y: &[f64; 2]) -> [f64; 2] {
        [y[1].powi(self.0), 1.0]
    }

    fn inverse_scale(&self, _y: &[f64; 2]) -> [f64; 2] {
        [1.0; 2]
    }
}

/// One step over [0, 1] for tᵏ: the error of the step, and the largest of the dense output.
fn quadrature<M: Method<STAGES>, const STAGES: usize>(k: i32) -> (f64, f64) {
    let (flow, y) = (Power(k), [0.0, 0.0]);
    let mut stages = [flow.derivative(&y); STAGES];
    let step = M::step(&flow, &y, &mut stages, 1.0);
    let dense = M::dense(&flow, &y, &stages, &step.end, &flow.derivative(&step.end), 1.0);
    let exact = |t: f64| t.powi(k + 1) / f64::from(k + 1);
    let between =
        largest((0..=20).map(|i| (dense.at(f64::from(i) / 20.0)[0] - exact(f64::from(i) / 20.0)).abs()));
    ((step.end[0] - exact(1.0)).abs(), between)
}

/// A method of order p integrates polynomials of degree p − 1 exactly, an interpolant of order p
/// of degree p, and neither does one more: the coefficients have all their digits.
#[test]
fn polynomials() {
    fn check<M: Method<STAGES>, const STAGES: usize>(order: i32, dense_order: i32, rounding: f64) {
        for k in 0..order {
            assert!(
                quadrature::<M, STAGES>(k).0 < rounding,
                "{} for t^{k}: {:e}",
                M::NAME,
                quadrature::<M, STAGES>(k).0
            );
        }
        for k in 0..dense_order {
            assert!(
                quadrature::<M, STAGES>(k).1 < rounding,
                "{} between for t^{k}: {:e}",
                M::NAME,
                quadrature::<M, STAGES>(k).1
            );
        }
        assert!(quadrature::<M, STAGES>(order).0 > 1e-6, "{}", M::NAME);
        assert!(quadrature::<M, STAGES>(dense_order).1 > 1e-6, "{}", M::NAME);
    }
    check::<Rk4, 4>(4, 3, 1e-15);
    check::<Tsit5, 6>(5, 4, 2e-14);
    check::<Dop853, 12>(8, 7, 2e-14);
}

/// One step of `h` from t = ½.
fn one<M: Method<STAGES>, const STAGES: usize>(h: f64) -> (Step<f64, 4>, Dense<f64, 4>) {
    let y = kepler(0.5);
    let mut stages = [Kepler.derivative(&y); STAGES];
    let step = M::step(&Kepler, &y, &mut stages, h);
    let dense = M::dense(&Kepler, &y, &stages, &step.end, &Kepler.derivative(&step.end), h);
    (step, dense)
}

/// [`Kepler`] without scales.
struct Weightless;

impl Flow<f64, 4> for Weightless {
    fn derivative(&self, y: &[f64; 4]) -> [f64; 4] {
        Kepler.derivative(y)
    }
    fn inverse_scale(&self, _y: &[f64; 4]) -> [f64; 4] {
        [0.0; 4]
    }
}

/// The estimate falls with the power of h that the controller takes for granted, and is above
/// the error of the step that is taken.
#[test]
fn error_estimates() {
    fn check<M: Method<STAGES>, const STAGES: usize>(h: f64, spread: f64) {
        let (coarse, fine) = (one::<M, STAGES>(2.0 * h).0, one::<M, STAGES>(h).0);
        let order = (coarse.error / fine.error).log2();
        assert!((order - M::ERROR_ORDER).abs() < spread, "{}: {order}", M::NAME);
        let actual = apart(fine.end, kepler(0.5 + h));
        assert!(fine.error > actual, "{}: {:e} for an error of {actual:e}", M::NAME, fine.error);
        assert!(fine.error < 1e3 * actual, "{}: {:e} for an error of {actual:e}", M::NAME, fine.error);
    }
    check::<Tsit5, 6>(0.02, 0.2);
    check::<Dop853, 12>(0.1, 0.5);
    assert_eq!(one::<Rk4, 4>(0.1).0.error, 0.0);
    assert_eq!(Rk4::ERROR_ORDER, 0.0);
    // A component with no scale has no say.
    let y = kepler(0.5);
    assert_eq!(Tsit5::step(&Weightless, &y, &mut [Kepler.derivative(&y); 6], 0.1).error, 0.0);
    assert_eq!(Dop853::step(&Weightless, &y, &mut [Kepler.derivative(&y); 12], 0.1).error, 0.0);
}

/// Dense output meets the values and the slopes at both ends.
#[test]
fn dense_output_meets_both_ends() {
    fn check<M: Method<STAGES>, const STAGES: usize>() {
        let h = 0.3;
        let (step, dense) = one::<M, STAGES>(h);
        let mut worst = Worst::default();
        let (start, end) = (kepler(0.5), step.end);
        worst.see(apart(dense.at(0.0), start), || "start".into());
        worst.see(apart(dense.at(1.0), end), || "end".into());
        for (theta, inward, slope) in
            [(0.0, 1.0, Kepler.derivative(&start)), (1.0, -1.0, Kepler.derivative(&end))]
        {
            // One-sided differences of order four of a polynomial of degree seven at most.
            let d = 1e-3;
            let at = |k: f64| dense.at(theta + inward * k * d);
            for (i, slope) in slope.into_iter().enumerate() {
                let values = [at(0.0)[i], at(1.0)[i], at(2.0)[i], at(3.0)[i], at(4.0)[i]];
                let sum: f64 = values.iter().zip([-25.0, 48.0, -36.0, 16.0, -3.0]).map(|(v, c)| v * c).sum();
                let difference = inward * sum / (12.0 * d);
                worst.see((difference / h - slope).abs(), || format!("slope {i} at {theta}"));
                assert_eq!(dense.component(i, 0.37), dense.at(0.37)[i]);
            }
        }
        worst.below(2e-11, M::NAME);
    }
    check::<Rk4, 4>();
    check::<Tsit5, 6>();
    check::<Dop853, 12>();
}

/// Backwards, a step of −h from the end of one of h returns to its start.
#[test]
fn steps_run_backwards() {
    fn check<M: Method<STAGES>, const STAGES: usize>(tolerance: f64) {
        let step = one::<M, STAGES>(0.05).0;
        let back = M::step(&Kepler, &step.end, &mut [Kepler.derivative(&step.end); STAGES], -0.05);
        let error = apart(back.end, kepler(0.5));
        println!("{} back: {error:e}", M::NAME);
        assert!(error < tolerance, "{}: {error:e}", M::NAME);
        assert!(back.error >= 0.0);
    }
    check::<Rk4, 4>(5e-9);
    check::<Tsit5, 6>(1e-10);
    check::<Dop853, 12>(5e-16);
}
