//! `kerrscope validate`: every reference number, computed now, beside its source.

use crate::report::Failure;
use crate::{Format, print, print_json};
use kerrscope::validate::{Check, all};
use serde::Serialize;

/// Exits with 1 if a number is off.
#[derive(clap::Args, Debug)]
pub struct Arguments {
    /// How to print
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

#[derive(Serialize)]
struct Row {
    name: String,
    source: &'static str,
    expected: f64,
    computed: f64,
    error: f64,
    tolerance: f64,
    passed: bool,
}

impl From<&Check> for Row {
    fn from(check: &Check) -> Self {
        Self {
            name: check.name.clone(),
            source: check.source,
            expected: check.expected,
            computed: check.computed,
            error: check.error(),
            tolerance: check.tolerance,
            passed: check.passed(),
        }
    }
}

pub fn run(arguments: &Arguments) -> Result<(), Failure> {
    let checks = all();
    if arguments.format == Format::Json {
        print_json(&checks.iter().map(Row::from).collect::<Vec<_>>())?;
    } else {
        print(&format!("{:<52} {:>20} {:>20} {:>9} {:>9}", "", "source", "computed", "error", "allowed"))?;
        let mut source = "";
        for check in &checks {
            if check.source != source {
                source = check.source;
                print(&format!("\n{source}"))?;
            }
            print(&format!(
                "  {:<50} {:>20} {:>20.12} {:>9.1e} {:>9.1e}{}",
                check.name,
                check.expected,
                check.computed,
                check.error(),
                check.tolerance,
                if check.passed() { "" } else { "  OFF" }
            ))?;
        }
    }
    let off = checks.iter().filter(|c| !c.passed()).count();
    if off > 0 {
        return Err(Failure::Failed(format!("{off} of {} numbers are off", checks.len())));
    }
    if arguments.format == Format::Text {
        print(&format!("\nAll {} numbers agree.", checks.len()))?;
    }
    Ok(())
}
