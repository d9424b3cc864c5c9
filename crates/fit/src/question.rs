//! What of a fit is about the theory: the metric that the disk is in, and what speaks for Kerr's.

use std::path::Path;
use std::sync::Arc;

use kerrscope::scene::{known_metric, known_metrics, metric_from_file};

use crate::evidence::{Test, test};
use crate::fit::Fit;
use crate::model::{Freedom, Parameter};
use crate::models::{Name, Tested};
use crate::traced::{Projection, SPIN, Theory};

/// A theory, and the values of its parameters with which it is Kerr's.
#[derive(Clone, Debug)]
pub struct Question {
    /// What is fitted.
    pub tested: Tested,
    nulls: Vec<(String, f64)>,
}

impl Question {
    /// Of a metric by its name or its file, a disk of a model, and `NAME=VALUE` for each value that is not 0.
    ///
    /// # Errors
    /// All faults.
    pub fn new(
        word: &str,
        model: Name,
        projection: Projection,
        nulls: &[String],
    ) -> Result<Self, Vec<String>> {
        let theory = Arc::new(read(word).map_err(|fault| vec![fault])?);
        let kind = Tested::kind(model).map_err(|fault| vec![fault])?;
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
                faults.push(format!("null {text:?}: give NAME=VALUE, as charge=0"));
                continue;
            };
            if !theory.parameters().iter().any(|(known, _)| *known == name) {
                let known: Vec<&str> = theory.parameters().iter().map(|(known, _)| *known).collect();
                faults.push(format!("null: {word} has no parameter {name:?}: it has {}", known.join(", ")));
            }
            values.retain(|(known, _)| known != name);
            values.push((name.to_owned(), value));
        }
        if faults.is_empty() {
            let tested = Tested { theory, kind, projection, free: Vec::new() };
            Ok(Self { tested, nulls: values })
        } else {
            Err(faults)
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

fn read(word: &str) -> Result<Theory, String> {
    let element = match known_metric(word, &[]) {
        Some(known) => known,
        None if Path::new(word).is_file() => metric_from_file(Path::new(word), &[]),
        None => {
            let names: Vec<&str> = known_metrics().collect();
            return Err(format!(
                "spacetime {word:?} is neither a file nor a metric that is known as text: these are {}. Around a Kerr hole of its \
                 own equations leave it away",
                names.join(", ")
            ));
        }
    };
    let element = element.map_err(|faults| faults.to_string())?;
    Theory::new(element).map_err(|reason| format!("spacetime {word}: the metric {reason}"))
}
