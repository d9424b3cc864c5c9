//! What of a fit is about the theory: the metric that the disk is in, and what speaks for Kerr's.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use kerrscope::scene::{known_metric, known_metrics, metric_from_file};
use kerrscope_fit::evidence::{Test, test};
use kerrscope_fit::fit::Fit;
use kerrscope_fit::model::{Freedom, Parameter};
use kerrscope_fit::models::{Name, Tested};
use kerrscope_fit::traced::{Projection, SPIN, Theory};

use crate::report::Failure;

/// A theory, and the values of its parameters with which it is Kerr's.
pub struct Question {
    /// What is fitted.
    pub tested: Tested,
    nulls: Vec<(String, f64)>,
}

impl Question {
    /// Of a metric by its name or its file, a disk of a model, and `NAME=VALUE` for each value that is not 0.
    pub fn new(word: &str, model: Name, projection: Projection, nulls: &[String]) -> Result<Self, Failure> {
        let theory = Arc::new(read(word)?);
        let kind = Tested::kind(model).map_err(Failure::Input)?;
        let mut faults = Vec::new();
        // The spin of a Kerr hole may have any value.
        let mut values: Vec<(String, f64)> = theory
            .parameters()
            .iter()
            .filter(|(name, _)| *name != SPIN)
            .map(|(name, _)| ((*name).to_owned(), 0.0))
            .collect();
        for text in nulls {
            let named = text
                .split_once('=')
                .and_then(|(name, value)| Some((name.trim(), value.trim().parse::<f64>().ok()?)));
            let Some((name, value)) = named.filter(|(_, value)| value.is_finite()) else {
                faults.push(format!("--null {text:?}: give NAME=VALUE, as charge=0"));
                continue;
            };
            if !theory.parameters().iter().any(|(known, _)| *known == name) {
                let known: Vec<&str> = theory.parameters().iter().map(|(known, _)| *known).collect();
                faults.push(format!("--null: {word} has no parameter {name:?}: it has {}", known.join(", ")));
            }
            values.retain(|(known, _)| known != name);
            values.push((name.to_owned(), value));
        }
        if faults.is_empty() {
            let tested = Tested { theory, kind, projection, free: Vec::new() };
            Ok(Self { tested, nulls: values })
        } else {
            Err(Failure::Input(faults.join("\nerror: ")))
        }
    }

    /// Derivatives are wanted of what is looked for.
    pub fn seek(&mut self, parameters: &[Parameter], freedoms: &[Freedom]) {
        let free = parameters.iter().zip(freedoms).filter(|(_, freedom)| matches!(freedom, Freedom::Free(_)));
        self.tested.free = free.map(|(parameter, _)| parameter.name.to_owned()).collect();
    }

    /// What a fit says of Kerr's values of those that were free.
    pub fn answers(&self, found: &Fit, parameters: &[Parameter], freedoms: &[Freedom]) -> Vec<Test> {
        self.nulls.iter().filter_map(|(name, null)| test(found, parameters, freedoms, name, *null)).collect()
    }
}

fn read(word: &str) -> Result<Theory, Failure> {
    let element = match known_metric(word, &[]) {
        Some(known) => known,
        None if Path::new(word).is_file() => metric_from_file(Path::new(word), &[]),
        None => {
            let names: Vec<&str> = known_metrics().collect();
            return Err(Failure::Input(format!(
                "--spacetime {word:?} is neither a file nor a metric that is known as text: these are {}. Around a Kerr hole of its \
                 own equations leave --spacetime away",
                names.join(", ")
            )));
        }
    };
    let element = element.map_err(|faults| Failure::Input(faults.to_string()))?;
    Theory::new(element).map_err(|reason| Failure::Input(format!("--spacetime {word}: the metric {reason}")))
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
