//! The functions that formulas know.

use crate::scalar::Scalar;

/// A function of one or two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// √x.
    Sqrt,
    /// 1/x; written as a quotient.
    Recip,
    /// Sine of an angle in radians.
    Sin,
    /// Cosine of an angle in radians.
    Cos,
    /// eˣ.
    Exp,
    /// Natural logarithm; not a number for x < 0.
    Ln,
    /// |x|.
    Abs,
    /// Hyperbolic sine.
    Sinh,
    /// Hyperbolic cosine.
    Cosh,
    /// Hyperbolic tangent.
    Tanh,
}

/// Every name that a formula can call, with the number of its arguments.
pub(super) const CALLED: [(&str, usize); 13] = [
    ("sqrt", 1),
    ("sin", 1),
    ("cos", 1),
    ("tan", 1),
    ("exp", 1),
    ("ln", 1),
    ("abs", 1),
    ("sinh", 1),
    ("cosh", 1),
    ("tanh", 1),
    ("atan2", 2),
    ("min", 2),
    ("max", 2),
];

impl Function {
    /// That of a name, of those with one argument.
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "sqrt" => Self::Sqrt,
            "sin" => Self::Sin,
            "cos" => Self::Cos,
            "exp" => Self::Exp,
            "ln" => Self::Ln,
            "abs" => Self::Abs,
            "sinh" => Self::Sinh,
            "cosh" => Self::Cosh,
            "tanh" => Self::Tanh,
            _ => return None,
        })
    }

    /// Its value. On lanes sines and cosines are those of |x| up to 10⁵.
    #[inline(always)]
    pub fn of<S: Scalar>(self, x: S) -> S {
        match self {
            Self::Sqrt => x.sqrt(),
            Self::Recip => x.recip(),
            Self::Sin => x.sin_cos().0,
            Self::Cos => x.sin_cos().1,
            Self::Exp => x.exp(),
            Self::Ln => logarithm(x),
            Self::Abs => x.abs(),
            Self::Sinh => hyperbolic(x).0,
            Self::Cosh => hyperbolic(x).1,
            Self::Tanh => {
                // Beyond 20 it is ±1 to the last bit, and neither part overflows.
                let bound = x.constant(20.0);
                let (sinh, cosh) = hyperbolic(x.min(bound).max(-bound));
                sinh / cosh
            }
        }
    }
}

/// ln x, not a number for x < 0 on lanes too, where the series would say something.
#[inline(always)]
fn logarithm<S: Scalar>(x: S) -> S {
    let zero = x.constant(0.0);
    let positive = zero.less(x);
    let log = S::select(positive, x, x.constant(1.0)).ln();
    let at_zero = S::select(x.less(zero), x.constant(f64::NAN), x.constant(f64::NEG_INFINITY));
    S::select(positive, log, at_zero)
}

/// 1/(2k(2k + 1)) from k = 9 down to 1: the ratios of sinh's series x + x³/3! + …
const RATIOS: [f64; 9] = [
    1.0 / 342.0,
    1.0 / 272.0,
    1.0 / 210.0,
    1.0 / 156.0,
    1.0 / 110.0,
    1.0 / 72.0,
    1.0 / 42.0,
    1.0 / 20.0,
    1.0 / 6.0,
];

/// sinh and cosh. Below 1 the difference of exponentials would lose digits; the series ends at x¹⁹/19! there.
#[inline(always)]
fn hyperbolic<S: Scalar>(x: S) -> (S, S) {
    let grown = x.exp();
    let shrunk = grown.recip();
    let one = x.constant(1.0);
    let square = x * x;
    let mut series = one;
    for ratio in RATIOS {
        series = (square * series).mul_add(x.constant(ratio), one);
    }
    let sinh = S::select(x.abs().less(one), x * series, (grown - shrunk) * 0.5);
    (sinh, (grown + shrunk) * 0.5)
}
