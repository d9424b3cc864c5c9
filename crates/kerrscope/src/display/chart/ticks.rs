//! Where a legend is marked with numbers, and how they are written.

use super::round::Round;
use super::scale::Scale;
use std::f64::consts::PI;

/// A mark of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// The value.
    pub value: f64,
    /// How it is written.
    pub label: String,
}

/// What a quotient may be off by rounding when whole multiples are counted.
const SLACK: f64 = 1e-6;

impl Scale {
    /// Round numbers in a range, as many as there can be up to `most`; possibly none.
    ///
    /// - Linear: multiples of 1, 2 or 5 times a power of ten.
    /// - Logarithmic: powers of ten, every one or every second, third, fifth…; over at most two of them,
    ///   1, 2 and 5 times a power of ten where there is room; within one where there are not two of these,
    ///   as for a linear scale.
    /// - Cyclic: quarters, halves or wholes of the period, as multiples of π where it is one.
    /// - Categories have none, nor has a range that no chart can show.
    ///
    /// ```
    /// use kerrscope::display::chart::Scale;
    /// let labels = |scale: Scale, range| {
    ///     scale.ticks(range, 5).into_iter().map(|t| t.label).collect::<Vec<_>>().join(" ")
    /// };
    /// assert_eq!(labels(Scale::Linear, [-0.3, 1.2]), "0.0 0.5 1.0");
    /// assert_eq!(labels(Scale::Logarithmic, [1e-9, 1e-5]), "10⁻⁹ 10⁻⁸ 10⁻⁷ 10⁻⁶ 10⁻⁵");
    /// let angle = Scale::Cyclic { period: std::f64::consts::TAU };
    /// assert_eq!(labels(angle, [0.0, std::f64::consts::TAU]), "0 π/2 π 3π/2 2π");
    /// ```
    pub fn ticks(&self, range: [f64; 2], most: usize) -> Vec<Tick> {
        match self {
            _ if most == 0 || self.check_range(range).is_err() => Vec::new(),
            Self::Linear => linear(range, most),
            Self::Logarithmic => logarithmic(range, most),
            Self::Cyclic { period } => cyclic(range, *period, most),
            Self::Categories(_) => Vec::new(),
        }
    }
}

/// The whole numbers whose multiples of `step` lie in the range.
fn multiples([low, high]: [f64; 2], step: f64) -> impl Iterator<Item = f64> + Clone {
    let (first, last) = ((low / step - SLACK).ceil(), (high / step + SLACK).floor());
    (0..).map(move |k| first + f64::from(k)).take_while(move |count| *count <= last)
}

fn linear(range: [f64; 2], most: usize) -> Vec<Tick> {
    let mut step = Round::at_most((range[1] - range[0]) / most as f64);
    while multiples(range, step.times(1.0)).nth(most).is_some() {
        step = step.next();
    }
    let values = multiples(range, step.times(1.0)).map(|count| step.times(count));
    let largest = values.clone().map(f64::abs).fold(0.0, f64::max);
    values.map(|value| Tick { value, label: decimal(value, step.exponent, largest) }).collect()
}

/// A number written down to the digit of the power of ten `last`, beside others up to `largest`.
fn decimal(value: f64, last: i32, largest: f64) -> String {
    let sign = if value < 0.0 { "−" } else { "" };
    let digits = |first: i32| (first - last).max(0) as usize;
    if largest == 0.0 || (1e-3..1e6).contains(&largest) {
        return format!("{sign}{:.*}", digits(0), value.abs());
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let first = Round::at_most(largest).exponent;
    let mantissa = value.abs() / Round { digit: 1, exponent: first }.times(1.0);
    format!("{sign}{mantissa:.*}×{}", digits(first), power_of_ten(first))
}

fn power_of_ten(exponent: i32) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    "10".chars().chain(exponent.to_string().chars().map(raised)).collect()
}

fn logarithmic(range: [f64; 2], most: usize) -> Vec<Tick> {
    let [low, high] = range;
    let inside = |round: &Round| round.times(1.0) <= high * (1.0 + SLACK);
    let rounds: Vec<Round> =
        std::iter::successors(Some(Round::at_least(low * (1.0 - SLACK))), |round| Some(round.next()))
            .take_while(inside)
            .collect();
    let plain = low >= 0.999e-3 && high <= 1.001e4;
    let tick = |round: &Round| {
        let value = round.times(1.0);
        let label = match round.digit {
            _ if plain => decimal(value, round.exponent, value),
            1 => power_of_ten(round.exponent),
            digit => format!("{digit}×{}", power_of_ten(round.exponent)),
        };
        Tick { value, label }
    };
    let decades = |every: i32| {
        let kept = |round: &&Round| round.digit == 1 && round.exponent % every == 0;
        rounds.iter().filter(kept).map(tick).collect::<Vec<_>>()
    };
    let mut choices = Vec::new();
    if high <= 100.0 * low * (1.0 + SLACK) {
        choices.push(rounds.iter().map(tick).collect());
    }
    choices.extend([1, 2, 3, 5, 10, 20, 50].map(decades));
    if high < 10.0 * low {
        choices.push(linear(range, most));
    }
    choices.retain(|ticks| ticks.len() <= most);
    let best = choices.iter().position(|ticks| ticks.len() > 1);
    let best = best.or_else(|| choices.iter().position(|ticks| !ticks.is_empty()));
    best.map_or_else(Vec::new, |k| choices.swap_remove(k))
}

/// The powers of ten in a range, or all numbers of one digit.
pub(super) fn between([low, high]: [f64; 2], digits: bool) -> impl Iterator<Item = f64> {
    let decades = Round::at_most(low).exponent..=Round::at_most(high).exponent;
    let numbers = decades.flat_map(move |exponent| {
        let decade = Round { digit: 1, exponent };
        (1..=if digits { 9 } else { 1 }).map(move |digit| decade.times(f64::from(digit)))
    });
    numbers.filter(move |number| (low..=high).contains(number))
}

fn cyclic(range: [f64; 2], period: f64, most: usize) -> Vec<Tick> {
    let steps = [0.25, 0.5, 1.0].map(|share| share * period);
    let Some(step) = steps.into_iter().find(|step| multiples(range, *step).nth(most).is_none()) else {
        return Vec::new();
    };
    multiples(range, step).map(|count| Tick { value: count * step, label: part_of_pi(count, step) }).collect()
}

/// A multiple of `step` as a multiple of π if `step` is one, in twelfths; else with six digits.
fn part_of_pi(count: f64, step: f64) -> String {
    let value = count * step;
    let sign = if value < 0.0 { "−" } else { "" };
    let twelfths = (12.0 * step / PI).round();
    if !(1.0..=1200.0).contains(&twelfths) || (12.0 * step / PI - twelfths).abs() > SLACK {
        let digits = 5 - value.abs().max(1e-5).log10().floor() as i32;
        let rounded = format!("{:.*}", digits.clamp(0, 10) as usize, value.abs());
        let short = if rounded.contains('.') {
            rounded.trim_end_matches('0').trim_end_matches('.')
        } else {
            &rounded
        };
        return format!("{sign}{short}");
    }
    let (mut above, mut below) = ((count * twelfths).abs() as u64, 12);
    for prime in [2, 2, 3] {
        if above % prime == 0 && below % prime == 0 {
            (above, below) = (above / prime, below / prime);
        }
    }
    match (above, below) {
        (0, _) => "0".to_owned(),
        (1, 1) => format!("{sign}π"),
        (1, _) => format!("{sign}π/{below}"),
        (_, 1) => format!("{sign}{above}π"),
        _ => format!("{sign}{above}π/{below}"),
    }
}
