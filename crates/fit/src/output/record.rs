//! How a fit was made.

use std::fmt;

/// What files of a fit say of how it was made. As text, a line for each thing:
///
/// ```
/// use kerrscope_fit::output::Record;
/// let model = [("model".to_owned(), "ring".to_owned()), ("blur".to_owned(), "2.5".to_owned())];
/// let text = Record { seed: 7, model: &model }.to_string();
/// let lines: Vec<&str> = text.lines().collect();
/// assert_eq!(lines[0], "program = kerrscope");
/// assert!(lines[1].starts_with("version = "));
/// assert_eq!(lines[2..], ["seed = 7", "model = ring", "blur = 2.5"]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record<'a> {
    /// Seed of all random numbers.
    pub seed: u64,
    /// What was fitted, and how: names and values.
    pub model: &'a [(String, String)],
}

impl Record<'_> {
    /// The program's name in files.
    pub const PROGRAM: &'static str = "kerrscope";
    /// The program's version.
    pub const VERSION: &'static str = env!("CARGO_PKG_VERSION");

    /// The model, a line for each of its names.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        self.model.iter().map(|(name, value)| format!("{name} = {value}"))
    }
}

impl fmt::Display for Record<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "program = {}\nversion = {}\nseed = {}", Self::PROGRAM, Self::VERSION, self.seed)?;
        self.lines().try_for_each(|line| writeln!(f, "{line}"))
    }
}
