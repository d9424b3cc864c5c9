//! What went wrong, for people.

use kerrscope::scene::{Fault, Faults};
use miette::{Diagnostic, GraphicalReportHandler, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::process::ExitCode;

/// Why a command did not do what was asked.
#[derive(Debug)]
pub enum Failure {
    /// The scene is wrong.
    Scene(Faults),
    /// Something else in the input is wrong.
    Input(String),
    /// A check failed, or something could not be done.
    Failed(String),
    /// The user stopped it; what is left of the work.
    Interrupted(String),
}

impl From<Faults> for Failure {
    fn from(faults: Faults) -> Self {
        Self::Scene(faults)
    }
}

impl Failure {
    /// Prints it to standard error and gives the exit code.
    pub fn report(self) -> ExitCode {
        match self {
            Self::Scene(faults) => {
                for fault in &faults {
                    eprint!("{}", drawn(fault));
                }
                let count = faults.len() + faults.omitted();
                let omitted = match faults.omitted() {
                    0 => String::new(),
                    n => format!(" ({n} more than are shown)"),
                };
                eprintln!("{count} fault{}{omitted}; nothing was done.", if count == 1 { "" } else { "s" });
                ExitCode::from(2)
            }
            Self::Input(message) => {
                eprintln!("error: {message}");
                ExitCode::from(2)
            }
            Self::Failed(message) => {
                eprintln!("error: {message}");
                ExitCode::from(1)
            }
            Self::Interrupted(rest) => {
                eprintln!("interrupted; {rest}");
                ExitCode::from(130)
            }
        }
    }
}

/// A fault with the text around it.
fn drawn(fault: &Fault) -> String {
    let shown = Shown { fault, source: NamedSource::new(&fault.source.name, fault.source.text.clone()) };
    let mut text = String::new();
    // The width of the terminal, colours and NO_COLOR are miette's to find.
    if GraphicalReportHandler::new().render_report(&mut text, &shown).is_err() {
        return format!("{fault}\n");
    }
    text
}

#[derive(Debug)]
struct Shown<'a> {
    fault: &'a Fault,
    source: NamedSource<String>,
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // A fault without a place is of the file as a whole: no snippet names it.
        if self.fault.span.is_none() {
            write!(f, "{}: ", self.fault.source.name)?;
        }
        f.write_str(&self.fault.message)
    }
}

impl std::error::Error for Shown<'_> {}

impl Diagnostic for Shown<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.fault.help))
    }
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.fault.span.is_some().then_some(&self.source as &dyn SourceCode)
    }
    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.fault.span.clone()?;
        Some(Box::new(std::iter::once(LabeledSpan::underline(span))))
    }
}
