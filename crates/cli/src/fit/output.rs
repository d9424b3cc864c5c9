//! What a fit prints and writes.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use kerrscope::output::file::write_atomically;
use kerrscope_fit::evidence::Test;
use kerrscope_fit::fit::{Fit, Image};
use kerrscope_fit::output::residual::Residual;
use kerrscope_fit::output::{Record, chain, corner};
use kerrscope_fit::task::Report;

use crate::report::Failure;

/// Writes the files of a fit.
pub fn files(name: &Path, image: &Image, found: &Fit, output: &Report<'_>) -> Result<(), Failure> {
    let file = |ending: &str| {
        let mut path = name.as_os_str().to_owned();
        path.push(ending);
        PathBuf::from(path)
    };
    let failed = |error: &dyn std::fmt::Display| Failure::Failed(error.to_string());
    let json = serde_json::to_string_pretty(output).map_err(|e| failed(&e))?;
    whole(&file(".json"), &json)?;
    let words = output.words();
    let record = Record { seed: output.seed, model: &words };
    chain::write(&file(".chain.h5"), found, &record).map_err(|e| failed(&e))?;
    let title = format!("{} fitted to {}", output.model, name.display());
    whole(&file(".corner.svg"), &corner::corner(found, &title))?;
    let residual = Residual::of(image, found);
    residual.write_png(&file(".residual.png"), &record).map_err(|e| failed(&e))?;
    residual.write_fits(&file(".residual.fits"), &record).map_err(|e| failed(&e))
}

/// Writes a text, whole or not at all.
fn whole(path: &Path, text: &str) -> Result<(), Failure> {
    write_atomically(path, |file| file.write_all(text.as_bytes())).map_err(|e| Failure::Failed(e.to_string()))
}

/// The table, for reading.
pub fn table(output: &Report<'_>) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{:<16} {:>13} {:>13} {:>11} {:>13} {:>13}  unit",
        "parameter", "mode", "mean", "sd", "2.5 %", "97.5 %"
    );
    for e in output.parameters.iter().filter(|e| e.free) {
        let number = |value: f64| significant(value, e.sd);
        let _ = writeln!(
            text,
            "{:<16} {:>13} {:>13} {:>11.2e} {:>13} {:>13}  {}",
            e.name,
            number(e.mode),
            number(e.mean),
            e.sd,
            number(e.q025),
            number(e.q975),
            e.unit
        );
    }
    let fixed: Vec<String> = output
        .parameters
        .iter()
        .filter(|e| !e.free)
        .map(|e| format!("{} = {} {}", e.name, e.mode, e.unit).trim_end().to_owned())
        .collect();
    let _ = writeln!(text, "\nfixed: {}", fixed.join(", "));
    let _ = writeln!(
        text,
        "model {}: {:.2} % of the variance explained, χ² {:.1} for {} degrees of freedom; {} evaluations in {:.0} s",
        output.model,
        100.0 * output.explained,
        output.chi2,
        output.degrees,
        output.evaluations,
        output.wall_s
    );
    text.push_str(&output.tests.map(lines).unwrap_or_default());
    for warning in output.warnings {
        let _ = writeln!(text, "warning: {warning}");
    }
    text.trim_end().to_owned()
}

/// A number with as many digits as its error leaves it, and two more.
fn significant(value: f64, error: f64) -> String {
    if !(error > 0.0) {
        return format!("{value}");
    }
    let digits = (2.0 - error.log10()).ceil();
    if (0.0..=9.0).contains(&digits) && value.abs() < 1e7 {
        format!("{value:.*}", digits as usize)
    } else {
        format!("{value:.5e}")
    }
}

/// Tests in words.
pub fn lines(tests: &[Test]) -> String {
    let mut text = String::new();
    for Test { name, null, deviations, tail, ln_bayes, error, gaussian } in tests {
        let side = if *deviations > 0.0 { "above" } else { "below" };
        let bayes = match error {
            Some(error) => format!("K = {:.3}, ln K = {ln_bayes:.2} ± {error:.2}", ln_bayes.exp()),
            None => format!(
                "ln K < {ln_bayes:.1}, as no draw lies near it; {gaussian:.1} if the tail is a Gaussian's"
            ),
        };
        let _ = writeln!(
            text,
            "{name} = {null}, as in Kerr's spacetime: the posterior is {:.1} deviations {side} it (two-sided tail {tail:.3}); evidence for \
             it against free, {bayes}",
            deviations.abs()
        );
    }
    text
}
