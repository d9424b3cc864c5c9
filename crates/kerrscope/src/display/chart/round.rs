//! Round numbers.

/// A round number: 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(super) struct Round {
    /// 1, 2 or 5.
    pub digit: u8,
    /// The power of ten.
    pub exponent: i32,
}

impl Round {
    /// The largest one that is at most `x`, which is finite and above 0.
    pub fn at_most(x: f64) -> Self {
        let mut this = Self { digit: 1, exponent: x.log10().floor() as i32 + 1 };
        while this.times(1.0) > x {
            this = this.previous();
        }
        this
    }

    /// The smallest one that is at least `x`, which is finite and above 0.
    pub fn at_least(x: f64) -> Self {
        let below = Self::at_most(x);
        if below.times(1.0) < x { below.next() } else { below }
    }

    /// The largest power of ten that is at most this.
    pub fn decade(self) -> Self {
        Self { digit: 1, ..self }
    }

    pub fn next(self) -> Self {
        match self.digit {
            1 => Self { digit: 2, ..self },
            2 => Self { digit: 5, ..self },
            _ => Self { digit: 1, exponent: self.exponent + 1 },
        }
    }

    pub fn previous(self) -> Self {
        match self.digit {
            5 => Self { digit: 2, ..self },
            2 => Self { digit: 1, ..self },
            _ => Self { digit: 5, exponent: self.exponent - 1 },
        }
    }

    /// A whole multiple: the number that its decimal digits mean, 3 · 0.1 = 0.3.
    pub fn times(self, count: f64) -> f64 {
        let number = count * f64::from(self.digit);
        // A negative power of ten is inexact, but the quotient of exact numbers is rounded once.
        if self.exponent < 0 {
            number / 10_f64.powi(-self.exponent)
        } else {
            number * 10_f64.powi(self.exponent)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_numbers_on_either_side() {
        for (x, below, above) in
            [(1.0, 1.0, 1.0), (0.3, 0.2, 0.5), (7.0, 5.0, 10.0), (0.001, 0.001, 0.001), (2e-38, 2e-38, 2e-38)]
        {
            assert_eq!(Round::at_most(x).times(1.0), below);
            assert_eq!(Round::at_least(x).times(1.0), above);
        }
        assert_eq!(Round { digit: 1, exponent: -1 }.times(3.0), 0.3);
    }

    #[test]
    fn there_and_back() {
        let mut round = Round { digit: 1, exponent: -40 };
        while round.exponent < 40 {
            assert_eq!(round.next().previous(), round);
            assert!(round.next().times(1.0) > round.times(1.0));
            assert_eq!(Round::at_most(round.times(1.0)), round);
            assert_eq!(Round::at_most(round.times(1.0) * (1.0 + 1e-12)), round);
            assert_eq!(Round::at_least(round.times(1.0) * (1.0 - 1e-12)), round);
            round = round.next();
        }
    }
}
