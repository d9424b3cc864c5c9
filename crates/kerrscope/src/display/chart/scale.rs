//! How values are laid along a colour map.

use super::error::ChartFault;
use super::round::Round;
use crate::display::Colormap;

/// What kind of numbers a plane holds, and so how they are laid along a colour map.
#[derive(Clone, Debug, PartialEq)]
pub enum Scale {
    /// Equal differences are equally far apart.
    Linear,
    /// Equal ratios are equally far apart. Zero lies below any range; a negative number is no value.
    Logarithmic,
    /// Values that differ by a multiple of the period are the same: angles. An infinity is no value.
    Cyclic {
        /// The period, in the unit of the values; above 0.
        period: f64,
    },
    /// Each of these values has a meaning, with a name; any other is no value.
    Categories(Vec<(f32, String)>),
}

/// The share of the values that an automatic range leaves out at each end.
const LEFT_OUT: f64 = 0.005;

/// Values closer together than this, relative to their amount, are one value to an automatic range.
const SAME: f64 = 1e-5;

/// What rounding to 32 bits may have added to a round number, relative to it.
const ROUNDING: f64 = f32::EPSILON as f64;

impl Scale {
    /// The colour map that suits the scale: [`Colormap::Hue`] for cyclic values, viridis for others.
    pub fn colormap(&self) -> Colormap {
        match self {
            Self::Cyclic { .. } => Colormap::Hue,
            _ => Colormap::Viridis,
        }
    }

    /// The place of a value along the colour map, from 0 to 1; none for what is no value.
    ///
    /// `range` are the values at 0 and at 1. What lies outside is brought to the nearer end, but for cyclic
    /// values, which come around. The k-th of n categories, counted from 0, is at (k + ½)/n, whatever the
    /// range.
    ///
    /// ```
    /// use kerrscope::display::chart::Scale;
    /// assert_eq!(Scale::Linear.position([2.0, 6.0], 3.0), Some(0.25));
    /// assert_eq!(Scale::Logarithmic.position([0.01, 100.0], 1.0), Some(0.5));
    /// assert_eq!(Scale::Cyclic { period: 4.0 }.position([0.0, 4.0], -1.0), Some(0.75));
    /// ```
    pub fn position(&self, range: [f64; 2], value: f64) -> Option<f64> {
        let [low, high] = range;
        match self {
            _ if value.is_nan() => None,
            Self::Linear => Some(((value - low) / (high - low)).clamp(0.0, 1.0)),
            Self::Logarithmic if value < 0.0 => None,
            Self::Logarithmic => Some(((value / low).log10() / (high / low).log10()).clamp(0.0, 1.0)),
            Self::Cyclic { .. } if value.is_infinite() => None,
            Self::Cyclic { period } => Some(((value - low) / period).rem_euclid(1.0)),
            Self::Categories(names) => {
                let k = names.iter().position(|(listed, _)| f64::from(*listed) == value)?;
                Some((k as f64 + 0.5) / names.len() as f64)
            }
        }
    }

    /// A range that shows nearly all of the values; none if there is no value in them to show, and for
    /// categories.
    ///
    /// - Linear: the 0.5 % and the 99.5 % quantile of the finite values (the nearest of the sorted values,
    ///   so that up to 100 of them give the smallest and the largest), moved outwards to multiples of the
    ///   largest of 1, 2 and 5 times a power of ten that is at most a tenth of their distance.
    /// - Logarithmic: the same quantiles of the finite values above 0, moved outwards to powers of ten; or,
    ///   if they are less than a factor of ten apart, to 1, 2 or 5 times one, and if these are then the
    ///   same, by one more such number each.
    /// - Cyclic: from 0 to the period.
    ///
    /// Where the quantiles differ by less than 1e-5 of the larger amount, the smallest and the largest of
    /// the values take their place; where these do so too, a linear range is first widened by a tenth of
    /// that amount, or by 1 if it is 0, to either side.
    ///
    /// Where all that can be shown are infinities (or, for a logarithmic scale, zeros), the range is from 0
    /// to 1, or from 1 to 10.
    ///
    /// ```
    /// use kerrscope::display::chart::Scale;
    /// let values = [0.31, 0.5, 1.13, f32::NAN];
    /// assert_eq!(Scale::Linear.value_range(&values), Some([0.3, 1.15]));
    /// assert_eq!(Scale::Logarithmic.value_range(&values), Some([0.2, 2.0]));
    /// assert_eq!(Scale::Linear.value_range(&[f32::NAN]), None);
    /// ```
    pub fn value_range(&self, values: &[f32]) -> Option<[f64; 2]> {
        let bulk = |shown: &dyn Fn(f32) -> bool| {
            bulk(values.iter().copied().filter(|v| v.is_finite() && shown(*v)).collect())
        };
        let any = |shown: &dyn Fn(f32) -> bool| values.iter().any(|v| shown(*v));
        match self {
            Self::Linear => match bulk(&|_| true) {
                Some(ends) => Some(linear(ends)),
                None => any(&|v| !v.is_nan()).then_some([0.0, 1.0]),
            },
            Self::Logarithmic => match bulk(&|v| v > 0.0) {
                Some(ends) => Some(logarithmic(ends)),
                None => any(&|v| v >= 0.0).then_some([1.0, 10.0]),
            },
            Self::Cyclic { period } => any(&f32::is_finite).then_some([0.0, *period]),
            Self::Categories(_) => None,
        }
    }

    pub(super) fn check_period(&self) -> Result<(), ChartFault> {
        match *self {
            Self::Cyclic { period } if !(period > 0.0 && period.is_finite()) => {
                Err(ChartFault::Period { period })
            }
            _ => Ok(()),
        }
    }

    /// Whether values of 32 bits can be told apart in a range.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn check_range(&self, range: [f64; 2]) -> Result<(), ChartFault> {
        let [low, high] = range;
        // Numbers of 32 bits go from 1.4e-45 to 3.4e38; so do automatic ranges, and a little further.
        if !(amount(range) < 1e40 && high - low > 1e-47 && high - low >= 1e-6 * amount(range)) {
            return Err(ChartFault::Range { low, high });
        }
        match *self {
            Self::Logarithmic if !(low > 1e-47) => Err(ChartFault::NotPositive { low, high }),
            Self::Cyclic { period } if !((high - low - period).abs() <= 1e-6 * period) => {
                Err(ChartFault::NotPeriod { low, high, period })
            }
            Self::Categories(_) => Err(ChartFault::RangeOfCategories),
            _ => Ok(()),
        }
    }
}

/// The ends of nearly all of the values, which are finite; none if there are none.
fn bulk(mut values: Vec<f32>) -> Option<[f64; 2]> {
    let last = values.len().checked_sub(1)?;
    let out = (LEFT_OUT * last as f64).round() as usize;
    let mut ends = |out: usize| {
        [out, last - out].map(|k| f64::from(*values.select_nth_unstable_by(k, f32::total_cmp).1))
    };
    let inner = ends(out);
    Some(if same(inner) { ends(0) } else { inner })
}

fn amount([low, high]: [f64; 2]) -> f64 {
    low.abs().max(high.abs())
}

fn same(ends: [f64; 2]) -> bool {
    ends[1] - ends[0] <= SAME * amount(ends)
}

fn linear(ends: [f64; 2]) -> [f64; 2] {
    let [mut low, mut high] = ends;
    if same(ends) {
        let aside = if amount(ends) > 0.0 { 0.1 * amount(ends) } else { 1.0 };
        (low, high) = (low - aside, high + aside);
    }
    let step = Round::at_most(0.1 * (high - low));
    let inwards = ROUNDING * amount([low, high]);
    let count = [(low + inwards) / step.times(1.0), (high - inwards) / step.times(1.0)];
    [step.times(count[0].floor()), step.times(count[1].ceil())]
}

fn logarithmic([low, high]: [f64; 2]) -> [f64; 2] {
    let mut ends = [Round::at_most(low * (1.0 + ROUNDING)), Round::at_least(high * (1.0 - ROUNDING))];
    if high >= 10.0 * low {
        ends[0] = ends[0].decade();
        if ends[1].digit > 1 {
            ends[1] = Round { digit: 1, exponent: ends[1].exponent + 1 };
        }
    } else if ends[0] == ends[1] {
        ends = [ends[0].previous(), ends[1].next()];
    }
    ends.map(|end| end.times(1.0))
}
