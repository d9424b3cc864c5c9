//! From linear light to display values.

use kerrscope::display::{Display, Tone, srgb};
use kerrscope::light::Light;
use proptest::prelude::*;

const NEUTRAL: Display = Display { exposure: 0.0, tone: Tone::Neutral };
const NONE: Display = Display { exposure: 0.0, tone: Tone::None };
const TONES: [Tone; 3] = [Tone::Neutral, Tone::Filmic, Tone::None];

#[test]
fn srgb_agrees_with_reference_values() {
    // Evaluated from the formulas of IEC 61966-2-1 with 50 digits.
    for (linear, encoded) in [
        (0.0, 0.0),
        (0.001, 0.01292),
        (0.003, 0.03876),
        (0.01, 0.0998528227341283),
        (0.18, 0.4613561295004416),
        (0.214041140482232, 0.5),
        (0.5, 0.7353569830524495),
        (1.0, 1.0),
    ] {
        assert!((srgb::encode(linear) - encoded).abs() < 1e-12, "{linear}");
        assert!((srgb::decode(encoded) - linear).abs() < 1e-12, "{encoded}");
    }
}

#[test]
fn every_16_bit_code_survives_decoding_and_encoding() {
    for code in 0..=65535_u32 {
        let encoded = f64::from(code) / 65535.0;
        // The branches of the standard differ by 3e-8 where they meet; steps are 1.5e-5.
        assert!((srgb::encode(srgb::decode(encoded)) - encoded).abs() < 1e-7, "{code}");
    }
}

#[test]
fn srgb_is_continuous_where_its_branches_meet() {
    let step = |f: fn(f64) -> f64, x: f64| (f(x + 1e-12) - f(x - 1e-12)).abs();
    assert!(step(srgb::encode, 0.0031308) < 1e-7);
    assert!(step(srgb::decode, 0.04045) < 1e-7);
}

#[test]
fn without_a_curve_components_are_cut_each_on_its_own() {
    let [r, g, b] = NONE.encode(Light::new([3.0, 0.5, -0.2]));
    assert_eq!((r, g, b), (1.0, srgb::encode(0.5), 0.0));
}

#[test]
fn neutral_agrees_with_its_formula() {
    // By hand: p = 2, p' = 1 − 0.24² / (2 + 1 − 1.52) = 0.961081…,
    // w = 1 − 1 / (0.15 (2 − p') + 1) = 0.134826…
    let out = Tone::Neutral.apply([2.0, 1.0, 0.0]);
    for (out, by_hand) in out.into_iter().zip([0.961081081081, 0.545330250982, 0.129579420884]) {
        assert!((out - by_hand).abs() < 1e-11, "{out} {by_hand}");
    }
}

#[test]
fn neutral_has_a_continuous_slope_at_its_knee() {
    let at = |x: f64| Tone::Neutral.apply([x, 0.5 * x, 0.0]);
    let h = 1e-5;
    for k in 0..3 {
        let below = (at(0.76)[k] - at(0.76 - h)[k]) / h;
        let above = (at(0.76 + h)[k] - at(0.76)[k]) / h;
        // The second derivative is a few units, so the slopes differ by a few h.
        assert!((below - above).abs() < 20.0 * h, "{k}: {below} {above}");
    }
}

#[test]
fn very_bright_colours_turn_white() {
    for tone in [Tone::Neutral, Tone::Filmic] {
        let [r, g, b] = Display { exposure: 0.0, tone }.encode(Light::new([1e4, 1e3, 10.0]));
        assert!(r > 0.999 && g > 0.999 && b > 0.999, "{r} {g} {b}");
    }
}

#[test]
fn filmic_agrees_with_its_formula_and_its_source() {
    // By hand: f(1/2) = 0.6425 / 1.0425, f(1) = 2.54 / 3.16, f(2) = 10.1 / 11.04. Narkowicz: "1 on
    // input maps to ~0.8 on output".
    let at = |x: f64| Tone::Filmic.apply([x, 0.0, 0.0])[0];
    for (x, by_hand) in [(0.5, 0.616306954436), (1.0, 0.803797468354), (2.0, 0.914855072464)] {
        assert!((at(x) - by_hand).abs() < 1e-11, "{x} {}", at(x));
    }
    // Each component is on its own.
    assert_eq!(Tone::Filmic.apply([2.0, 0.5, 0.0]), [at(2.0), at(0.5), 0.0]);
}

#[test]
fn filmic_begins_at_black_and_reaches_white() {
    let at = |x: f64| Tone::Filmic.apply([x; 3])[0];
    assert_eq!(at(0.0), 0.0);
    // The slope at black is 0.03 / 0.14.
    assert!((at(1e-9) / 1e-9 - 3.0 / 14.0).abs() < 1e-7);
    // The root of 0.08 x² − 0.56 x − 0.14.
    let white = (0.56 + 0.3584_f64.sqrt()) / 0.16;
    assert!(at(white - 1e-3) < 1.0 && at(white) > 1.0 - 1e-12, "{}", at(white));
    for beyond in [white + 1e-9, 8.0, 1e30, f64::MAX] {
        assert_eq!(at(beyond), 1.0, "{beyond}");
    }
}

#[test]
fn anything_gives_display_values() {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 0.0, 1e-320, 1.0, f64::MAX];
    for tone in TONES {
        for exposure in [0.0, 1e9, -1e9, f64::NAN, f64::INFINITY] {
            for r in odd {
                for g in odd {
                    let rgb = Display { exposure, tone }.encode(Light::new([r, g, 0.3]));
                    assert!(rgb.iter().all(|c| (0.0..=1.0).contains(c)), "{r} {g} {rgb:?}");
                }
            }
        }
    }
    assert_eq!(NEUTRAL.encode(Light::new([f64::INFINITY; 3])), [1.0; 3]);
}

/// Hue of HSV as position on the segment from the smallest component to the largest.
fn hue([r, g, b]: [f64; 3]) -> f64 {
    let (low, high) = (r.min(g).min(b), r.max(g).max(b));
    (r + g + b - low - high - low) / (high - low)
}

proptest! {
    #[test]
    fn nothing_changes_below_the_knee(r in 0.0..0.76, g in 0.0..0.76, b in 0.0..0.76) {
        prop_assert_eq!(NEUTRAL.encode(Light::new([r, g, b])), [r, g, b].map(srgb::encode));
    }

    #[test]
    fn more_light_is_never_darker(
        r in 0.0..1.0, g in 0.0..1.0, b in 0.0..1.0, x in 0.0..50.0, more in 0.0..1.0
    ) {
        for tone in TONES {
            let display = Display { exposure: 0.0, tone };
            let light = Light::new([r, g, b]);
            let (dim, bright) = (display.encode(light * x), display.encode(light * (x + more)));
            for k in 0..3 {
                prop_assert!(dim[k] <= bright[k] + 1e-12, "{:?} {:?}", dim, bright);
            }
        }
    }

    #[test]
    fn hue_is_kept(r in 1.0..30.0, g in 0.3..0.6, b in 0.0..0.1) {
        let (before, after) = ([r, g * r, b * r], Tone::Neutral.apply([r, g * r, b * r]));
        prop_assert!((hue(before) - hue(after)).abs() < 1e-9);
    }

    #[test]
    fn tone_curves_are_continuous(r in 0.0..10.0, g in 0.0..10.0, b in 0.0..10.0) {
        for tone in TONES {
            let (near, far) = (tone.apply([r, g, b]), tone.apply([r + 1e-9, g, b]));
            for k in 0..3 {
                // No slope is above 2; that of the filmic curve is largest, 1.80, at 0.12.
                prop_assert!((near[k] - far[k]).abs() < 2e-9, "{tone:?}");
            }
        }
    }

    #[test]
    fn grey_stays_grey(x in 0.0..20.0) {
        for tone in TONES {
            let [r, g, b] = tone.apply([x; 3]);
            prop_assert!(r == g && g == b, "{tone:?} {r} {g} {b}");
        }
    }

    #[test]
    fn exposure_is_a_power_of_two(x in 0.0..1.0, stops in -4.0..4.0) {
        let exposed = Display { exposure: stops, ..NEUTRAL }.encode(Light::new([x; 3]));
        let scaled = NEUTRAL.encode(Light::new([x * 2_f64.powf(stops); 3]));
        prop_assert!((exposed[0] - scaled[0]).abs() < 1e-12);
    }
}
