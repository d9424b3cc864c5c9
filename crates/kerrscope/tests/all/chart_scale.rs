//! How values are laid along a colour map: ranges, places, ticks.

use kerrscope::display::Colormap;
use kerrscope::display::chart::{Scale, Tick};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const ANGLE: Scale = Scale::Cyclic { period: TAU };

fn labels(scale: &Scale, range: [f64; 2], most: usize) -> String {
    scale.ticks(range, most).into_iter().map(|tick| tick.label).collect::<Vec<_>>().join(" ")
}

/// The number that a label means.
fn read(label: &str) -> f64 {
    let plain: String = label
        .chars()
        .filter_map(|c| match c {
            '−' | '⁻' => Some('-'),
            '×' => None,
            _ => "⁰¹²³⁴⁵⁶⁷⁸⁹"
                .chars()
                .zip('0'..='9')
                .find(|(raised, _)| *raised == c)
                .map_or(Some(c), |(_, d)| Some(d)),
        })
        .collect();
    match label.split_once('×') {
        None if label.chars().any(|c| "⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c)) => {
            format!("1e{}", &plain[2..]).parse().unwrap()
        }
        None => plain.parse().unwrap(),
        Some((mantissa, _)) => {
            let digits = mantissa.chars().count();
            format!("{}e{}", &plain[..digits], &plain[digits + 2..]).parse().unwrap()
        }
    }
}

#[test]
fn linear_ranges_leave_out_half_a_percent_at_each_end() {
    // 0 to 1000, and 10⁹ four times: 1005 values; round(0.005 · 1004) = 5 are left out at each end, so the
    // quantiles are 5 and 999, and the step is the largest round number up to 99.4.
    let mut values: Vec<f32> = (0..=1000).map(|k| k as f32).collect();
    values.extend([1e9; 4]);
    assert_eq!(Scale::Linear.value_range(&values), Some([0.0, 1000.0]));
    // Of a hundred values none is left out.
    let mut values = vec![0.5; 99];
    values.push(8.25);
    assert_eq!(Scale::Linear.value_range(&values), Some([0.5, 8.5]));
}

#[test]
fn ranges_end_at_round_numbers_that_32_bits_cannot_hold() {
    assert_eq!(Scale::Linear.value_range(&[0.3, 0.5, 0.7]), Some([0.3, 0.7]));
    assert_eq!(Scale::Linear.value_range(&[-0.7, -0.1]), Some([-0.7, -0.1]));
    assert_eq!(Scale::Logarithmic.value_range(&[1e-9, 1e-5]), Some([1e-9, 1e-5]));
    assert_eq!(Scale::Linear.value_range(&[f32::MAX, -f32::MAX]), Some([-3.5e38, 3.5e38]));
}

#[test]
fn one_value_alone_is_in_the_middle() {
    assert_eq!(Scale::Linear.value_range(&[3.0; 7]), Some([2.7, 3.3]));
    assert_eq!(Scale::Linear.value_range(&[-50.0]), Some([-55.0, -45.0]));
    assert_eq!(Scale::Linear.value_range(&[0.0; 7]), Some([-1.0, 1.0]));
    // 1 + 5e-6 is no other value, but 1 + 2e-5 is one.
    assert_eq!(Scale::Linear.value_range(&[1.0, 1.000005]), Some([0.88, 1.12]));
    assert_eq!(Scale::Linear.value_range(&[1.0, 1.00002]), Some([1.0, 1.00002]));
    assert_eq!(Scale::Logarithmic.value_range(&[2.0; 7]), Some([1.0, 5.0]));
    assert_eq!(Scale::Logarithmic.value_range(&[1e-9; 7]), Some([5e-10, 2e-9]));
}

#[test]
fn a_rare_second_value_is_not_left_out() {
    let mut values = vec![1.0; 9990];
    values.extend([2.0; 10]);
    assert_eq!(Scale::Linear.value_range(&values), Some([1.0, 2.0]));
    assert_eq!(Scale::Logarithmic.value_range(&values), Some([1.0, 2.0]));
}

#[test]
fn logarithmic_ranges_are_decades_or_less() {
    for (values, range) in [
        ([3e-9, 8e-7], [1e-9, 1e-6]),
        ([2.5, 6.0], [2.0, 10.0]),
        ([2.5, 24.0], [2.0, 50.0]),
        ([2.5, 25.0], [1.0, 100.0]),
    ] {
        let with_others = [values[0], -4.0, 0.0, f32::NAN, values[1], f32::INFINITY];
        assert_eq!(Scale::Logarithmic.value_range(&with_others), Some(range), "{values:?}");
    }
}

#[test]
fn ranges_without_finite_values() {
    let (nan, inf) = (f32::NAN, f32::INFINITY);
    for scale in [Scale::Linear, Scale::Logarithmic, ANGLE] {
        assert_eq!(scale.value_range(&[nan, nan]), None);
        assert_eq!(scale.value_range(&[]), None);
    }
    assert_eq!(Scale::Linear.value_range(&[nan, -inf]), Some([0.0, 1.0]));
    assert_eq!(Scale::Logarithmic.value_range(&[nan, inf]), Some([1.0, 10.0]));
    assert_eq!(Scale::Logarithmic.value_range(&[0.0, -1.0]), Some([1.0, 10.0]));
    assert_eq!(Scale::Logarithmic.value_range(&[-inf, -1.0]), None);
    assert_eq!(ANGLE.value_range(&[inf]), None);
    assert_eq!(ANGLE.value_range(&[inf, -9.0]), Some([0.0, TAU]));
    assert_eq!(Scale::Categories(vec![(1.0, "one".into())]).value_range(&[1.0]), None);
}

#[test]
fn places_along_the_map() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let linear = |value| Scale::Linear.position([-1.0, 3.0], value);
    assert_eq!([-2.0, -1.0, 0.0, 3.0, inf, -inf].map(linear), [0.0, 0.0, 0.25, 1.0, 1.0, 0.0].map(Some));
    assert_eq!(linear(nan), None);
    let ratio = |value| Scale::Logarithmic.position([0.1, 1000.0], value);
    assert_eq!([0.0, 0.1, 10.0, 1e9, inf].map(ratio), [0.0, 0.0, 0.5, 1.0, 1.0].map(Some));
    assert_eq!([nan, -1.0, -inf].map(ratio), [None; 3]);
    let angle = |value| ANGLE.position([-PI, PI], value);
    assert_eq!([-PI, 0.0, 0.5 * PI, 1.5 * PI].map(angle), [0.0, 0.5, 0.75, 0.25].map(Some));
    assert_eq!([nan, inf, -inf].map(angle), [None; 3]);
    let named = Scale::Categories(vec![(7.0, "seven".into()), (-1.0, "minus one".into())]);
    let named = |value| named.position([0.0, 1.0], value);
    assert_eq!([7.0, -1.0, 0.0, nan].map(named), [Some(0.25), Some(0.75), None, None]);
}

#[test]
fn colours_that_suit() {
    assert_eq!(ANGLE.colormap(), Colormap::Hue);
    assert_eq!(Scale::Logarithmic.colormap(), Colormap::Viridis);
}

#[test]
fn linear_labels() {
    for (range, most, expected) in [
        ([0.0, 10.0], 11, "0 1 2 3 4 5 6 7 8 9 10"),
        ([0.0, 10.0], 10, "0 2 4 6 8 10"),
        ([0.3, 1.3], 6, "0.4 0.6 0.8 1.0 1.2"),
        ([-0.7, 0.7], 3, "−0.5 0.0 0.5"),
        ([0.123, 0.456], 4, "0.2 0.3 0.4"),
        ([9.8, 10.3], 3, "9.8 10.0 10.2"),
        ([0.0, 3e6], 4, "0 1×10⁶ 2×10⁶ 3×10⁶"),
        ([-4.4e-9, 0.0], 5, "−4×10⁻⁹ −3×10⁻⁹ −2×10⁻⁹ −1×10⁻⁹ 0"),
        ([2e7, 2.1e7], 3, "2.00×10⁷ 2.05×10⁷ 2.10×10⁷"),
        ([0.9, 1.1], 1, "1.0"),
        ([1.1, 1.9], 1, "1.5"),
        ([0.0, 10.0], 0, ""),
    ] {
        assert_eq!(labels(&Scale::Linear, range, most), expected, "{range:?}");
    }
}

#[test]
fn logarithmic_labels() {
    for (range, most, expected) in [
        ([1e-9, 1e-5], 9, "10⁻⁹ 10⁻⁸ 10⁻⁷ 10⁻⁶ 10⁻⁵"),
        ([1e-9, 1e-5], 4, "10⁻⁸ 10⁻⁶"),
        ([3e-12, 2e12], 6, "10⁻¹⁰ 10⁻⁵ 10⁰ 10⁵ 10¹⁰"),
        ([1e-3, 1e3], 9, "0.001 0.01 0.1 1 10 100 1000"),
        ([1.0, 100.0], 7, "1 2 5 10 20 50 100"),
        ([1.0, 100.0], 6, "1 10 100"),
        ([2e-7, 8e-6], 9, "2×10⁻⁷ 5×10⁻⁷ 10⁻⁶ 2×10⁻⁶ 5×10⁻⁶"),
        ([3.0, 4.9], 5, "3.0 3.5 4.0 4.5"),
        ([1e-9, 1e-5], 1, "10⁻⁵"),
        ([1e-9, 1e-5], 0, ""),
    ] {
        assert_eq!(labels(&Scale::Logarithmic, range, most), expected, "{range:?} {most}");
    }
}

#[test]
fn cyclic_labels() {
    let degrees = Scale::Cyclic { period: 360.0 };
    for (scale, range, most, expected) in [
        (&ANGLE, [0.0, TAU], 9, "0 π/2 π 3π/2 2π"),
        (&ANGLE, [-PI, PI], 5, "−π −π/2 0 π/2 π"),
        (&ANGLE, [-PI, PI], 4, "−π 0 π"),
        (&ANGLE, [0.0, TAU], 2, "0 2π"),
        (&ANGLE, [0.0, TAU], 1, ""),
        (&Scale::Cyclic { period: f64::from(std::f32::consts::TAU) }, [0.0, TAU], 9, "0 π/2 π 3π/2 2π"),
        (&Scale::Cyclic { period: PI }, [0.0, PI], 9, "0 π/4 π/2 3π/4 π"),
        (&Scale::Cyclic { period: 2.0 * PI / 3.0 }, [0.0, 2.0 * PI / 3.0], 9, "0 π/6 π/3 π/2 2π/3"),
        (&degrees, [-180.0, 180.0], 5, "−180 −90 0 90 180"),
        (&Scale::Cyclic { period: 1.0 }, [0.0, 1.0], 5, "0 0.25 0.5 0.75 1"),
    ] {
        assert_eq!(labels(scale, range, most), expected, "{scale:?} {range:?} {most}");
    }
}

#[test]
fn ranges_that_cannot_be_shown_have_no_ticks() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    for range in [[1.0, 1.0], [2.0, 1.0], [nan, 1.0], [0.5, nan], [0.5, inf], [-inf, 1.0], [1.0, 1.0 + 1e-9]]
    {
        for scale in [Scale::Linear, Scale::Logarithmic, ANGLE] {
            assert_eq!(scale.ticks(range, 5), [], "{scale:?} {range:?}");
        }
    }
    assert_eq!(Scale::Logarithmic.ticks([0.0, 1.0], 5), []);
    assert_eq!(Scale::Categories(vec![(0.0, "zero".into())]).ticks([0.0, 1.0], 5), []);
}

/// A number of any size.
fn number() -> impl Strategy<Value = f64> {
    (-1.0..1.0, -40..38).prop_map(|(mantissa, exponent): (f64, i32)| mantissa * 10_f64.powi(exponent))
}

proptest! {
    #[test]
    fn linear_ticks_are_round_and_inside(a in number(), b in number(), most in 5_usize..20) {
        let (low, high) = (a.min(b), a.max(b));
        prop_assume!(high - low > 1e-5 * low.abs().max(high.abs()));
        let ticks = Scale::Linear.ticks([low, high], most);
        prop_assert!((2..=most).contains(&ticks.len()), "{:?}", ticks);
        let step = (ticks.last().unwrap().value - ticks[0].value) / (ticks.len() - 1) as f64;
        let digit = step / 10_f64.powf(step.log10().floor());
        let round = [1.0, 2.0, 5.0, 10.0].iter().any(|round| (digit / round - 1.0).abs() < 1e-8);
        prop_assert!(round, "{}", step);
        for (k, Tick { value, label }) in ticks.iter().enumerate() {
            prop_assert!((low - 1e-6 * step..=high + 1e-6 * step).contains(value));
            prop_assert!((value - ticks[0].value - k as f64 * step).abs() < 1e-8 * step);
            prop_assert!((read(label) - value).abs() < 1e-8 * step, "{} {}", label, value);
        }
    }

    #[test]
    fn logarithmic_ticks_are_round_and_inside(
        low in -40.0_f64..30.0, decades in 0.05_f64..60.0, most in 3_usize..15
    ) {
        let range = [10_f64.powf(low), 10_f64.powf((low + decades).min(38.0))];
        let ticks = Scale::Logarithmic.ticks(range, most);
        prop_assert!((1..=most).contains(&ticks.len()));
        for Tick { value, label } in &ticks {
            prop_assert!((range[0] * (1.0 - 1e-5)..=range[1] * (1.0 + 1e-5)).contains(value));
            prop_assert!((read(label) / value - 1.0).abs() < 1e-8, "{} {}", label, value);
            let power = value.log10();
            prop_assert!(decades < 2.01 || (power - power.round()).abs() < 1e-8, "{}", value);
        }
        prop_assert!(ticks.windows(2).all(|pair| pair[0].value < pair[1].value));
    }

    #[test]
    fn linear_ranges_are_close_and_round(values in prop::collection::vec(-1e3_f32..1e3, 2..100)) {
        let low = f64::from(values.iter().copied().fold(f32::INFINITY, f32::min));
        let high = f64::from(values.iter().copied().fold(f32::NEG_INFINITY, f32::max));
        prop_assume!(high - low > 1e-4 * low.abs().max(high.abs()));
        let [first, last] = Scale::Linear.value_range(&values).unwrap();
        // Up to a hundred values are all inside, but for the rounding of 32 bits.
        let rounding = f64::from(f32::EPSILON) * low.abs().max(high.abs());
        prop_assert!(first <= low + rounding && last >= high - rounding);
        // The range grows by less than one step at each end, which is at most a tenth.
        prop_assert!(last - first < 1.2 * (high - low) + 2.0 * rounding);
        let rounds = (-9..4).flat_map(|e| [1.0, 2.0, 5.0].map(|digit| digit * 10_f64.powi(e)));
        let step = rounds.filter(|round| *round <= 0.1 * (high - low)).fold(0.0, f64::max);
        for end in [first, last] {
            prop_assert!((end / step - (end / step).round()).abs() < 1e-6, "{} {}", end, step);
        }
    }

    #[test]
    fn automatic_ranges_can_always_be_shown(bits in prop::collection::vec(any::<u32>(), 1..300)) {
        // All numbers of 32 bits, whatever they mean.
        let values: Vec<f32> = bits.into_iter().map(f32::from_bits).collect();
        for scale in [Scale::Linear, Scale::Logarithmic] {
            if let Some(range) = scale.value_range(&values) {
                prop_assert!(!scale.ticks(range, 20).is_empty(), "{:?} {:?}", scale, range);
                for value in &values {
                    if let Some(place) = scale.position(range, f64::from(*value)) {
                        prop_assert!((0.0..=1.0).contains(&place));
                    }
                }
            }
        }
    }
}
