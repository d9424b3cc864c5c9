//! Charts that cannot be drawn, and why.

/// A chart that cannot be drawn: what is wrong, and what to do about it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("cannot draw a chart: {fault}; {}", fault.mend())]
pub struct ChartError {
    /// What is wrong.
    pub fault: ChartFault,
}

/// What can be wrong with a chart.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChartFault {
    /// There are more or fewer values than pixels, or no pixels.
    #[error("{width} × {height} pixels were given {values} values")]
    Size {
        /// Pixels along the top edge.
        width: u32,
        /// Pixels along the left edge.
        height: u32,
        /// Values.
        values: usize,
    },
    /// The range is empty, backwards, infinite or too narrow for numbers of 32 bits.
    #[error("the range from {low} to {high} cannot be shown")]
    Range {
        /// The range's lower end.
        low: f64,
        /// The range's upper end.
        high: f64,
    },
    /// A logarithmic range that includes zero.
    #[error("the logarithmic range from {low} to {high} does not lie above 0")]
    NotPositive {
        /// The range's lower end.
        low: f64,
        /// The range's upper end.
        high: f64,
    },
    /// The range of a cyclic scale is not one period long.
    #[error("the range from {low} to {high} is not as long as the period, {period}")]
    NotPeriod {
        /// The range's lower end.
        low: f64,
        /// The range's upper end.
        high: f64,
        /// The period.
        period: f64,
    },
    /// The period is 0, negative or not a finite number.
    #[error("a period of {period} is none")]
    Period {
        /// The period.
        period: f64,
    },
    /// Categories with a range.
    #[error("categories have no range")]
    RangeOfCategories,
}

impl ChartFault {
    /// What to do about it.
    pub fn mend(&self) -> &'static str {
        match self {
            Self::Size { .. } => "give one value for each pixel, and at least one pixel",
            Self::Range { .. } => {
                "give two numbers below 1e40, the second larger by at least a millionth of their amount"
            }
            Self::NotPositive { .. } => "give a lower end above 0, or use a linear scale",
            Self::NotPeriod { .. } => "give a range one period long, or none",
            Self::Period { .. } => "give a number above 0, such as 2π",
            Self::RangeOfCategories => "leave the range out",
        }
    }
}
