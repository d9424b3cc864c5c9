//! Explicit Runge–Kutta methods: one step with its error estimate, and dense output within it.
//!
//! A method is a type; its coefficients are constants that the compiler folds into the kernel.

use super::dense::Dense;
use super::flow::Flow;
use crate::scalar::Scalar;
use crate::tensor::each;

/// One attempted step.
#[derive(Clone, Copy, Debug)]
pub struct Step<S, const D: usize> {
    /// The state after the step.
    pub end: [S; D],
    /// Root mean square of the estimated error over the flow's scales; zero for a method without one.
    pub error: S,
    /// The slope at the end, if the error estimate needed it.
    pub end_slope: Option<[S; D]>,
}

/// An explicit Runge–Kutta method with `STAGES` stages.
pub trait Method<const STAGES: usize> {
    /// The name that scenes and reports use.
    const NAME: &'static str;
    /// The power of the step size with which the error estimate falls; zero where there is none.
    const ERROR_ORDER: f64;
    /// The first stages that dense output does without, the very first aside.
    const SPARED: usize;

    /// A step of size `h` from `y`, where the slope is `k[0]`; the slopes at the other stages are put beside it.
    fn step<S: Scalar, F: Flow<S, D>, const D: usize>(
        flow: &F,
        y: &[S; D],
        k: &mut [[S; D]; STAGES],
        h: S,
    ) -> Step<S, D>;

    /// The dense output of an accepted step from `y` to `end`, `k` being the slopes at the stages and `end_slope`
    /// that at its end.
    fn dense<S: Scalar, F: Flow<S, D>, const D: usize>(
        flow: &F,
        y: &[S; D],
        k: &[[S; D]; STAGES],
        end: &[S; D],
        end_slope: &[S; D],
        h: S,
    ) -> Dense<S, D>;
}

/// Σ cᵢ kᵢ.
#[inline(always)]
fn combine<S: Scalar, const D: usize, const N: usize>(terms: [(f64, &[S; D]); N]) -> [S; D] {
    each(
        #[inline(always)]
        |i| {
            let mut sum = terms[0].1[i] * terms[0].0;
            for (c, k) in &terms[1..] {
                sum = k[i].mul_add(sum.constant(*c), sum);
            }
            sum
        },
    )
}

/// y + h Σ cᵢ kᵢ.
#[inline(always)]
fn advance<S: Scalar, const D: usize, const N: usize>(
    y: &[S; D],
    h: S,
    terms: [(f64, &[S; D]); N],
) -> [S; D] {
    let sum = combine(terms);
    each(
        #[inline(always)]
        |i| sum[i].mul_add(h, y[i]),
    )
}

/// Mean of the squares of `error` over the flow's scales.
#[inline(always)]
fn mean_square<S: Scalar, const D: usize>(error: &[S; D], inverse_scale: &[S; D]) -> S {
    let mut sum = (error[0] * inverse_scale[0]).squared();
    for i in 1..D {
        let scaled = error[i] * inverse_scale[i];
        sum = scaled.mul_add(scaled, sum);
    }
    sum * (1.0 / D as f64)
}

/// The classical method of order 4 (Kutta 1901), without an error estimate.
#[derive(Clone, Copy, Debug)]
pub struct Rk4;

impl Method<4> for Rk4 {
    const NAME: &'static str = "rk4";
    const ERROR_ORDER: f64 = 0.0;
    const SPARED: usize = 3;

    #[inline(always)]
    fn step<S: Scalar, F: Flow<S, D>, const D: usize>(
        flow: &F,
        y: &[S; D],
        k: &mut [[S; D]; 4],
        h: S,
    ) -> Step<S, D> {
        k[1] = flow.derivative(&advance(y, h, [(0.5, &k[0])]));
        k[2] = flow.derivative(&advance(y, h, [(0.5, &k[1])]));
        k[3] = flow.derivative(&advance(y, h, [(1.0, &k[2])]));
        let sixth = 1.0 / 6.0;
        let end = advance(y, h, [(sixth, &k[0]), (2.0 * sixth, &k[1]), (2.0 * sixth, &k[2]), (sixth, &k[3])]);
        Step { end, error: h.constant(0.0), end_slope: None }
    }

    #[inline(always)]
    fn dense<S: Scalar, F: Flow<S, D>, const D: usize>(
        _flow: &F,
        y: &[S; D],
        k: &[[S; D]; 4],
        end: &[S; D],
        end_slope: &[S; D],
        h: S,
    ) -> Dense<S, D> {
        Dense::hermite(*y, *end, &k[0], end_slope, h)
    }
}

/// Tsitouras's method 5(4) (2011, Comput. Math. Appl. 62, 770), with its interpolant of order 4.
#[derive(Clone, Copy, Debug)]
pub struct Tsit5;

impl Method<6> for Tsit5 {
    const NAME: &'static str = "tsit5";
    const ERROR_ORDER: f64 = 5.0;
    const SPARED: usize = 0;

    #[inline(always)]
    #[rustfmt::skip]
    fn step<S: Scalar, F: Flow<S, D>, const D: usize>(
        flow: &F,
        y: &[S; D],
        k: &mut [[S; D]; 6],
        h: S,
    ) -> Step<S, D> {
        k[1] = flow.derivative(&advance(y, h, [(0.161, &k[0])]));
        k[2] = flow.derivative(&advance(y, h, [(-0.008480655492356989, &k[0]), (0.335480655492357, &k[1])]));
        k[3] = flow.derivative(&advance(y, h, [(2.8971530571054935, &k[0]), (-6.359448489975075, &k[1]), (4.3622954328695815, &k[2])]));
        k[4] = flow.derivative(&advance(y, h, [(5.325864828439257, &k[0]), (-11.748883564062828, &k[1]), (7.4955393428898365, &k[2]), (-0.09249506636175525, &k[3])]));
        k[5] = flow.derivative(&advance(y, h, [(5.86145544294642, &k[0]), (-12.92096931784711, &k[1]), (8.159367898576159, &k[2]), (-0.071584973281401, &k[3]), (-0.028269050394068383, &k[4])]));
        let end = advance(y, h, [(0.09646076681806523, &k[0]), (0.01, &k[1]), (0.4798896504144996, &k[2]), (1.379008574103742, &k[3]), (-3.290069515436081, &k[4]), (2.324710524099774, &k[5])]);
        // The error estimate's seventh stage is the first of the next step.
        let k7 = flow.derivative(&end);
        let error = combine([(-0.001780011052225777, &k[0]), (-0.0008164344596567469, &k[1]), (0.007880878010261995, &k[2]), (-0.1447110071732629, &k[3]), (0.5823571654525552, &k[4]), (-0.45808210592918697, &k[5]), (0.015151515151515152, &k7)]);
        let error = mean_square(&error, &flow.inverse_scale(y)).sqrt() * h.abs();
        Step { end, error, end_slope: Some(k7) }
    }

    #[inline(always)]
    #[rustfmt::skip]
    fn dense<S: Scalar, F: Flow<S, D>, const D: usize>(
        _flow: &F,
        y: &[S; D],
        k: &[[S; D]; 6],
        end: &[S; D],
        end_slope: &[S; D],
        h: S,
    ) -> Dense<S, D> {
        let [k1, k2, k3, k4, k5, k6] = k;
        // The interpolant meets values and slopes at both ends, so only its θ⁴ terms are its own.
        let quartic = combine([(-1.0530884977290216, k1), (0.1017, k2), (2.490627285651253, k3), (-16.548102889244902, k4), (47.37952196281928, k5), (-34.87065786149661, k6), (2.5, end_slope)]);
        let mut dense = Dense::hermite(*y, *end, k1, end_slope, h);
        dense.add_bubbles([quartic], h);
        dense
    }
}

/// Dormand and Prince's method 8(5,3), with dense output of order 7 from three more stages:
/// Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (1993), II.5 and II.6.
#[derive(Clone, Copy, Debug)]
pub struct Dop853;

impl Method<12> for Dop853 {
    const NAME: &'static str = "dop853";
    const ERROR_ORDER: f64 = 8.0;
    const SPARED: usize = 4;

    #[inline(always)]
    #[rustfmt::skip]
    fn step<S: Scalar, F: Flow<S, D>, const D: usize>(
        flow: &F,
        y: &[S; D],
        k: &mut [[S; D]; 12],
        h: S,
    ) -> Step<S, D> {
        k[1] = flow.derivative(&advance(y, h, [(0.05260015195876773, &k[0])]));
        k[2] = flow.derivative(&advance(y, h, [(0.0197250569845379, &k[0]), (0.0591751709536137, &k[1])]));
        k[3] = flow.derivative(&advance(y, h, [(0.02958758547680685, &k[0]), (0.08876275643042054, &k[2])]));
        k[4] = flow.derivative(&advance(y, h, [(0.2413651341592667, &k[0]), (-0.8845494793282861, &k[2]), (0.924834003261792, &k[3])]));
        k[5] = flow.derivative(&advance(y, h, [(0.037037037037037035, &k[0]), (0.17082860872947386, &k[3]), (0.12546768756682242, &k[4])]));
        k[6] = flow.derivative(&advance(y, h, [(0.037109375, &k[0]), (0.17025221101954405, &k[3]), (0.06021653898045596, &k[4]), (-0.017578125, &k[5])]));
        k[7] = flow.derivative(&advance(y, h, [(0.03709200011850479, &k[0]), (0.17038392571223998, &k[3]), (0.10726203044637328, &k[4]), (-0.015319437748624402, &k[5]), (0.008273789163814023, &k[6])]));
        k[8] = flow.derivative(&advance(y, h, [(0.6241109587160757, &k[0]), (-3.3608926294469414, &k[3]), (-0.868219346841726, &k[4]), (27.59209969944671, &k[5]), (20.154067550477894, &k[6]), (-43.48988418106996, &k[7])]));
        k[9] = flow.derivative(&advance(y, h, [(0.47766253643826434, &k[0]), (-2.4881146199716677, &k[3]), (-0.590290826836843, &k[4]), (21.230051448181193, &k[5]), (15.279233632882423, &k[6]), (-33.28821096898486, &k[7]), (-0.020331201708508627, &k[8])]));
        k[10] = flow.derivative(&advance(y, h, [(-0.9371424300859873, &k[0]), (5.186372428844064, &k[3]), (1.0914373489967295, &k[4]), (-8.149787010746927, &k[5]), (-18.52006565999696, &k[6]), (22.739487099350505, &k[7]), (2.4936055526796523, &k[8]), (-3.0467644718982196, &k[9])]));
        k[11] = flow.derivative(&advance(y, h, [(2.273310147516538, &k[0]), (-10.53449546673725, &k[3]), (-2.0008720582248625, &k[4]), (-17.9589318631188, &k[5]), (27.94888452941996, &k[6]), (-2.8589982771350235, &k[7]), (-8.87285693353063, &k[8]), (12.360567175794303, &k[9]), (0.6433927460157636, &k[10])]));
        let end = advance(y, h, [(0.054293734116568765, &k[0]), (4.450312892752409, &k[5]), (1.8915178993145003, &k[6]), (-5.801203960010585, &k[7]), (0.3111643669578199, &k[8]), (-0.1521609496625161, &k[9]), (0.20136540080403034, &k[10]), (0.04471061572777259, &k[11])]);
        let inverse_scale = flow.inverse_scale(y);
        let fifth = combine([(0.01312004499419488, &k[0]), (-1.2251564463762044, &k[5]), (-0.4957589496572502, &k[6]), (1.6643771824549864, &k[7]), (-0.35032884874997366, &k[8]), (0.3341791187130175, &k[9]), (0.08192320648511571, &k[10]), (-0.022355307863886294, &k[11])]);
        let third = combine([(-0.18980075407240762, &k[0]), (4.450312892752409, &k[5]), (1.8915178993145003, &k[6]), (-5.801203960010585, &k[7]), (-0.4226823213237919, &k[8]), (-0.1521609496625161, &k[9]), (0.20136540080403034, &k[10]), (0.02265179219836082, &k[11])]);
        let (fifth, third) = (mean_square(&fifth, &inverse_scale), mean_square(&third, &inverse_scale));
        // The two estimates combined (II.10.17); the tiny term keeps 0/0 out.
        let error = fifth * (fifth + third * 0.01 + 1e-60).sqrt().recip() * h.abs();
        Step { end, error, end_slope: None }
    }

    #[inline(always)]
    #[rustfmt::skip]
    fn dense<S: Scalar, F: Flow<S, D>, const D: usize>(
        flow: &F,
        y: &[S; D],
        k: &[[S; D]; 12],
        end: &[S; D],
        end_slope: &[S; D],
        h: S,
    ) -> Dense<S, D> {
        let [k1, _, _, _, _, k6, k7, k8, k9, k10, k11, k12] = k;
        let k13 = end_slope;
        let k14 = flow.derivative(&advance(y, h, [(0.056167502283047954, k1), (0.25350021021662483, k7), (-0.2462390374708025, k8), (-0.12419142326381637, k9), (0.15329179827876568, k10), (0.00820105229563469, k11), (0.007567897660545699, k12), (-0.008298, k13)]));
        let k15 = flow.derivative(&advance(y, h, [(0.03183464816350214, k1), (0.028300909672366776, k6), (0.053541988307438566, k7), (-0.05492374857139099, k8), (-0.00010834732869724932, k11), (0.0003825710908356584, k12), (-0.00034046500868740456, k13), (0.1413124436746325, &k14)]));
        let k16 = flow.derivative(&advance(y, h, [(-0.42889630158379194, k1), (-4.697621415361164, k6), (7.683421196062599, k7), (4.06898981839711, k8), (0.3567271874552811, k9), (-0.0013990241651590145, k13), (2.9475147891527724, &k14), (-9.15095847217987, &k15)]));
        let mut dense = Dense::hermite(*y, *end, k1, k13, h);
        dense.add_bubbles([
            combine([(-8.428938276109013, k1), (0.5667149535193777, k6), (-3.0689499459498917, k7), (2.38466765651207, k8), (2.117034582445028, k9), (-0.871391583777973, k10), (2.2404374302607883, k11), (0.6315787787694688, k12), (-0.08899033645133331, k13), (18.148505520854727, &k14), (-9.194632392478356, &k15), (-4.436036387594894, &k16)]),
            combine([(10.427508642579134, k1), (242.28349177525817, k6), (165.20045171727028, k7), (-374.5467547226902, k8), (-22.113666853125306, k9), (7.733432668472264, k10), (-30.674084731089398, k11), (-9.332130526430229, k12), (15.697238121770845, k13), (-31.139403219565178, &k14), (-9.35292435884448, &k15), (35.81684148639408, &k16)]),
            combine([(19.985053242002433, k1), (-387.0373087493518, k6), (-189.17813819516758, k7), (527.8081592054236, k8), (-11.57390253995963, k9), (6.8812326946963, k10), (-1.0006050966910838, k11), (0.7777137798053443, k12), (-2.778205752353508, k13), (-60.19669523126412, &k14), (84.32040550667716, &k15), (11.99229113618279, &k16)]),
            combine([(-25.69393346270375, k1), (-154.18974869023643, k6), (-231.5293791760455, k7), (357.6391179106141, k8), (93.40532418362432, k9), (-37.45832313645163, k10), (104.0996495089623, k11), (29.8402934266605, k12), (-43.53345659001114, k13), (96.32455395918828, &k14), (-39.17726167561544, &k15), (-149.72683625798564, &k16)]),
        ], h);
        dense
    }
}
