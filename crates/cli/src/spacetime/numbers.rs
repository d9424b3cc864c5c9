//! Numbers as they are typed and as they are printed.

use std::f64::consts::PI;

/// A list of numbers, such as a point's coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbers(pub Vec<f64>);

impl Numbers {
    /// As it would be typed.
    pub fn typed(&self) -> String {
        self.0.iter().map(ToString::to_string).collect::<Vec<_>>().join(",")
    }
}

/// Longest list that is read.
const MOST: usize = 16;

/// Numbers with commas between them.
pub fn parse_numbers(text: &str) -> Result<Numbers, String> {
    if text.split(',').nth(MOST).is_some() {
        return Err(format!("{MOST} numbers are the most"));
    }
    text.split(',').map(parse_number).collect::<Result<_, _>>().map(Numbers)
}

/// A finite number: digits, or digits with deg for degrees, or a multiple and a part of pi.
pub fn parse_number(text: &str) -> Result<f64, String> {
    let wrong =
        || format!("{text:?} is no number: give digits, degrees as 90deg, or parts of pi as pi/2 or 2pi");
    let word = text.trim();
    let value = if let Some(degrees) = word.strip_suffix("deg") {
        degrees.trim().parse::<f64>().map(f64::to_radians).map_err(|_| wrong())?
    } else if let Some((factor, rest)) = word.split_once("pi") {
        let factor = match factor.trim().trim_end_matches('*') {
            "" | "+" => 1.0,
            "-" => -1.0,
            digits => digits.trim().parse::<f64>().map_err(|_| wrong())?,
        };
        let divisor = match rest.trim() {
            "" => 1.0,
            rest => {
                let digits = rest.strip_prefix('/').ok_or_else(wrong)?;
                digits.trim().parse::<f64>().map_err(|_| wrong())?
            }
        };
        factor * PI / divisor
    } else {
        word.parse().map_err(|_| wrong())?
    };
    if value.is_finite() { Ok(value) } else { Err(wrong()) }
}

/// Twelve digits, as short as they are.
pub fn show(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !x.is_finite() {
        return x.to_string();
    }
    let size = x.abs().log10().floor() as i32;
    if (-5..12).contains(&size) {
        let text = format!("{x:.*}", (11 - size).max(0) as usize);
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{x:.11e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read() {
        for (text, value) in [
            ("-1.5e-3", -1.5e-3),
            ("90deg", PI / 2.0),
            ("-30 deg", -PI / 6.0),
            ("pi", PI),
            ("-pi/4", -PI / 4.0),
            ("2pi", 2.0 * PI),
            ("1.5*pi/3", 0.5 * PI),
        ] {
            assert!((parse_number(text).unwrap() - value).abs() < 1e-15, "{text}");
        }
        for text in ["", "x", "1e999", "pi/0", "deg", "pipi", "1,", "inf", "nan"] {
            assert!(parse_number(text).is_err(), "{text}");
        }
        assert!(parse_numbers(&"1,".repeat(30)).is_err());
    }

    #[test]
    fn numbers_are_shown() {
        for (x, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-0.1, "-0.1"),
            (1.0 / 3.0, "0.333333333333"),
            (1e-7, "1.00000000000e-7"),
            (123456.0, "123456"),
        ] {
            assert_eq!(show(x), text);
        }
    }
}
