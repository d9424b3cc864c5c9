//! The words of a formula.

use super::fault::Fault;
use std::ops::Range;

/// A word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token<'t> {
    Number(f64),
    Name(&'t str),
    /// One of + - * / ^ ( ) and the comma.
    Sign(char),
    End,
}

/// What people type for something else.
const MEANT: [(&str, &str); 14] = [
    ("**", "a power is written `^`: x^2"),
    ("²", "a power is written `^`: x^2"),
    ("³", "a power is written `^`: x^3"),
    ("·", "a product is written `*`"),
    ("×", "a product is written `*`"),
    ("÷", "a quotient is written `/`"),
    ("−", "the minus sign of a formula is `-`"),
    ("√", "a root is written sqrt( )"),
    ("[", "brackets of formulas are round: ( )"),
    ("]", "brackets of formulas are round: ( )"),
    ("{", "brackets of formulas are round: ( )"),
    ("}", "brackets of formulas are round: ( )"),
    ("=", "a formula is what stands for a value: leave out `=`, and give parts names with `let`"),
    ("'", "derivatives are worked out by the program: write the metric alone"),
];

/// Cuts a text into words; the last is the end. What is no word is a fault, and left out.
pub(super) fn tokens<'t>(text: &'t str, faults: &mut Vec<Fault>) -> Vec<(Token<'t>, Range<usize>)> {
    let mut all = Vec::new();
    let mut rest = text;
    loop {
        rest = rest.trim_start();
        let start = text.len() - rest.len();
        let Some(first) = rest.chars().next() else { break };
        let meant = MEANT.iter().find(|(typed, _)| rest.starts_with(typed));
        let length = if first.is_ascii_digit() || first == '.' {
            number_length(rest)
        } else if is_letter(first) {
            rest.find(|c: char| !is_letter(c) && !c.is_ascii_digit()).unwrap_or(rest.len())
        } else {
            meant.map_or(first.len_utf8(), |(typed, _)| typed.len())
        };
        let (word, after) = rest.split_at(length);
        let span = start..start + length;
        rest = after;
        if is_letter(first) {
            all.push((Token::Name(word), span));
        } else if first.is_ascii_digit() || first == '.' {
            let number = word.parse::<f64>().ok().filter(|x| x.is_finite());
            if number.is_none() {
                let what = format!("`{word}` is no number");
                faults.push(Fault::new(span.clone(), what, "a number is written 0.5 or 1e-8"));
            }
            all.push((Token::Number(number.unwrap_or(1.0)), span));
        } else if let Some((typed, mend)) = meant {
            faults.push(Fault::new(span, format!("`{typed}` has no meaning in a formula"), *mend));
        } else if "+-*/^(),".contains(first) {
            all.push((Token::Sign(first), span));
        } else {
            let shown = if first.is_control() { ' ' } else { first };
            faults.push(Fault::new(
                span,
                format!("`{shown}` has no meaning in a formula"),
                "formulas are of numbers, names, + - * / ^ and round brackets",
            ));
        }
    }
    all.push((Token::End, text.len()..text.len()));
    all
}

/// Letters of any alphabet and the low line.
pub(super) fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

/// The length of a number at the head of a text: digits and points, then an exponent if it has digits.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits =
        |from: usize| from + bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count();
    let end = digits(0);
    if !matches!(bytes.get(end), Some(b'e' | b'E')) {
        return end;
    }
    let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
    let begin = end + 1 + sign;
    if bytes.get(begin).is_some_and(u8::is_ascii_digit) { digits(begin) } else { end }
}
