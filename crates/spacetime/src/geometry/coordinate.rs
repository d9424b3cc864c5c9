//! What is known of a coordinate besides its place in the metric.

use std::borrow::Cow;
use std::f64::consts::{PI, TAU};

/// What a coordinate measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Time.
    Time,
    /// A length, or a number without a unit that is none of the others.
    Length,
    /// An angle in radians.
    Angle,
}

/// A coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Coordinate {
    /// Its name: a letter, or a Greek letter in full ("theta").
    pub name: Cow<'static, str>,
    /// What it measures.
    pub nature: Nature,
    /// The values that it takes, ends not included where the metric is singular there; may be infinite.
    pub range: [f64; 2],
    /// After how much the same point comes again, if it does.
    pub period: Option<f64>,
}

impl Coordinate {
    fn new(name: &'static str, nature: Nature, range: [f64; 2]) -> Self {
        Self { name: Cow::Borrowed(name), nature, range, period: None }
    }

    /// Time, of all values.
    pub fn time(name: &'static str) -> Self {
        Self::new(name, Nature::Time, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// A Cartesian-like coordinate of all values.
    pub fn length(name: &'static str) -> Self {
        Self::new(name, Nature::Length, [f64::NEG_INFINITY, f64::INFINITY])
    }

    /// A radius above `least`.
    pub fn radius(name: &'static str, least: f64) -> Self {
        Self::new(name, Nature::Length, [least, f64::INFINITY])
    }

    /// An angle from an axis, 0 to π.
    pub fn polar(name: &'static str) -> Self {
        Self::new(name, Nature::Angle, [0.0, PI])
    }

    /// An angle around an axis, with period 2π.
    pub fn azimuth(name: &'static str) -> Self {
        Self { period: Some(TAU), ..Self::new(name, Nature::Angle, [0.0, TAU]) }
    }
}
