//! What is wrong with a scene: where, what, and how to mend it.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// A text in which a fault can lie: a scene file, or one `--set`.
#[derive(Debug, PartialEq, Eq)]
pub struct Source {
    /// What to call it: the file's path as given, or `--set #1`.
    pub name: String,
    /// The whole text.
    pub text: String,
}

impl Source {
    pub(crate) fn new(name: impl Into<String>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Self { name: name.into(), text: text.into() })
    }

    /// Line and column of a byte, both counted from 1; the column counts characters.
    ///
    /// A byte beyond the text, or within a character, stands for the nearest place before it.
    ///
    /// ```
    /// use kerrscope::scene::Source;
    /// let source = Source { name: "a".into(), text: "α = 1\nβ = 2".into() };
    /// assert_eq!(source.line_column(12), (2, 5));
    /// ```
    pub fn line_column(&self, byte: usize) -> (usize, usize) {
        let before = &self.text[..self.text.floor_char_boundary(byte)];
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let line = before.bytes().filter(|&b| b == b'\n').count() + 1;
        (line, before[line_start..].chars().count() + 1)
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The text it is in.
    pub source: Arc<Source>,
    /// The bytes of that text it is about; `None` if it is about no one place.
    pub span: Option<Range<usize>>,
    /// What is wrong, in a phrase without a full stop.
    pub message: String,
    /// How to mend it.
    pub help: String,
}

impl Fault {
    /// Line and column at which the fault begins, counted from 1.
    pub fn line_column(&self) -> Option<(usize, usize)> {
        Some(self.source.line_column(self.span.as_ref()?.start))
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.source.name)?;
        if let Some((line, column)) = self.line_column() {
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)?;
        for (i, line) in self.help.lines().enumerate() {
            write!(f, "\n  {}{line}", if i == 0 { "help: " } else { "      " })?;
        }
        Ok(())
    }
}

impl std::error::Error for Fault {}

/// Everything that is wrong with a scene, ordered by place. Never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults {
    faults: Vec<Fault>,
    omitted: usize,
}

impl Faults {
    /// The most faults that are told apart; of more, only the number is known.
    pub const MAX: usize = 100;

    /// How many faults there are beyond those listed.
    pub fn omitted(&self) -> usize {
        self.omitted
    }

    /// These and others that are not among them.
    pub(crate) fn and(mut self, others: Self) -> Self {
        self.omitted += others.omitted;
        for fault in others {
            if self.faults.iter().any(|known| known.to_string() == fault.to_string()) {
                continue;
            }
            if self.faults.len() < Self::MAX {
                self.faults.push(fault);
            } else {
                self.omitted += 1;
            }
        }
        self
    }

    /// The faults, one by one.
    pub fn iter(&self) -> std::slice::Iter<'_, Fault> {
        self.faults.iter()
    }
}

impl std::ops::Deref for Faults {
    type Target = [Fault];
    fn deref(&self) -> &[Fault] {
        &self.faults
    }
}

impl IntoIterator for Faults {
    type Item = Fault;
    type IntoIter = std::vec::IntoIter<Fault>;
    fn into_iter(self) -> Self::IntoIter {
        self.faults.into_iter()
    }
}

impl<'a> IntoIterator for &'a Faults {
    type Item = &'a Fault;
    type IntoIter = std::slice::Iter<'a, Fault>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl From<Fault> for Faults {
    fn from(fault: Fault) -> Self {
        Self { faults: vec![fault], omitted: 0 }
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, fault) in self.faults.iter().enumerate() {
            write!(f, "{}{fault}", if i == 0 { "" } else { "\n" })?;
        }
        if self.omitted > 0 {
            write!(f, "\nand {} more faults", self.omitted)?;
        }
        Ok(())
    }
}

impl std::error::Error for Faults {}

/// Where something stands: a source, and bytes of it if it stands there itself.
#[derive(Clone, Debug)]
pub(crate) struct Place {
    pub(crate) source: Arc<Source>,
    pub(crate) span: Option<Range<usize>>,
}

impl Place {
    /// Bytes of a source, widened to whole characters: a parser's word is not relied on for that.
    pub(crate) fn new(source: &Arc<Source>, span: Range<usize>) -> Self {
        let start = source.text.floor_char_boundary(span.start);
        let end = source.text.ceil_char_boundary(span.end.max(start));
        Self { source: Arc::clone(source), span: Some(start..end) }
    }

    /// The source as a whole.
    pub(crate) fn whole(source: &Arc<Source>) -> Self {
        Self { source: Arc::clone(source), span: None }
    }

    /// Bytes of a text that stands here in quotation marks; all of it if they are none, or if it is not written plainly.
    pub(crate) fn within(&self, text: &str, inner: Range<usize>) -> Self {
        let typed = self.span.clone().and_then(|span| self.source.text.get(span)).unwrap_or("");
        let quote = typed.find(text).filter(|quote| *quote > 0 && typed.len() == text.len() + 2 * quote);
        match (quote, &self.span) {
            (Some(quote), Some(span)) if !inner.is_empty() || inner.start > 0 => {
                let start = span.start + quote;
                Self::new(&self.source, start + inner.start..start + inner.end)
            }
            _ => self.clone(),
        }
    }

    /// Whether the text goes on with this character.
    pub(crate) fn follows(&self, c: char) -> bool {
        let span = self.span.clone().unwrap_or_default();
        self.source.text.get(span.start..).is_some_and(|rest| rest.starts_with(c))
    }

    /// The text as typed, shortened if long, for use in a message.
    pub(crate) fn quoted(&self) -> String {
        let typed = self.span.clone().and_then(|span| self.source.text.get(span)).unwrap_or("");
        shorten(typed)
    }
}

/// One line of at most 40 characters, without control characters.
pub(crate) fn shorten(text: &str) -> String {
    one_line(text, 40)
}

/// One line of at most so many characters, without control characters.
pub(crate) fn one_line(text: &str, most: usize) -> String {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    let mut line: String = text.chars().take(most).map(plain).collect();
    if text.chars().nth(most).is_some() {
        line.push('…');
    }
    line
}

/// Gathers faults while a scene is read.
#[derive(Default)]
pub(crate) struct Collector {
    sources: Vec<Arc<Source>>,
    faults: Vec<Fault>,
    omitted: usize,
}

impl Collector {
    /// Makes a source known; faults are ordered as their sources were added.
    pub(crate) fn add_source(&mut self, source: &Arc<Source>) {
        self.sources.push(Arc::clone(source));
    }

    /// Notes a fault: the message and the mend are worked out only if it will be listed, so that
    /// a million faults take no longer than reading the file.
    pub(crate) fn push(&mut self, place: &Place, text: impl FnOnce() -> (String, String)) {
        if self.faults.len() >= Faults::MAX {
            self.omitted += 1;
            return;
        }
        let (message, help) = text();
        let Place { source, span } = place.clone();
        self.faults.push(Fault { source, span, message, help });
    }

    /// How many faults there are so far.
    pub(crate) fn len(&self) -> usize {
        self.faults.len() + self.omitted
    }

    /// Whether nothing is wrong so far.
    pub(crate) fn is_empty(&self) -> bool {
        self.faults.is_empty()
    }

    /// The value, if nothing was wrong.
    pub(crate) fn finish<T>(mut self, value: T) -> Result<T, Faults> {
        if self.is_empty() {
            return Ok(value);
        }
        let order = |fault: &Fault| {
            let source = self.sources.iter().position(|s| Arc::ptr_eq(s, &fault.source));
            (source, fault.span.as_ref().map(|span| (span.start, span.end)))
        };
        self.faults.sort_by_key(order);
        self.faults.dedup();
        Err(Faults { faults: self.faults, omitted: self.omitted })
    }
}
