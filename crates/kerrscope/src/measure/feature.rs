//! What a picture shows, or why it is not known.

use serde::Serialize;

/// A number and its estimated error, one standard deviation, in the same unit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// Its error.
    pub error: f64,
}

impl Measured {
    /// A number with its error.
    pub const fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }

    /// In another unit.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor.abs() }
    }

    /// This over another, the errors independent.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        let value = self.value / other.value;
        let error = (self.error / other.value).hypot(value * other.error / other.value);
        Self { value, error }
    }

    /// This plus another, the errors independent.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { value: self.value + other.value, error: self.error.hypot(other.error) }
    }
}

/// A feature of a picture, or why there is none to be measured.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature<T> {
    /// It is there.
    Found(T),
    /// It is not, or not with any certainty: why.
    NotFound(String),
}

impl<T> Feature<T> {
    /// The feature, if it was found.
    pub fn found(&self) -> Option<&T> {
        match self {
            Self::Found(feature) => Some(feature),
            Self::NotFound(_) => None,
        }
    }
}

impl<T> From<Result<T, String>> for Feature<T> {
    fn from(result: Result<T, String>) -> Self {
        match result {
            Ok(feature) => Self::Found(feature),
            Err(reason) => Self::NotFound(reason),
        }
    }
}
