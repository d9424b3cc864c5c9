//! What is asked of a fit: a model, and what is known of its parameters.

use serde::Deserialize;
use std::collections::BTreeMap;

use crate::model::{Freedom, Parameter};
use crate::models::Name;

/// What somebody says of parameters, in words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Request {
    /// For each name a number, which fixes it; "free", for its usual prior; or a prior.
    pub parameters: Vec<(String, String)>,
}

/// A file of parameters.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    model: Option<String>,
    #[serde(default)]
    parameters: BTreeMap<String, toml::Value>,
}

/// The largest file of parameters, bytes.
pub const LARGEST_FILE: usize = 1 << 16;

impl Request {
    /// From the text of a file: `model = "…"`, and under `[parameters]` numbers, `"free"` or priors.
    ///
    /// # Errors
    /// If it is no such file.
    pub fn from_toml(text: &str) -> Result<(Option<Name>, Self), String> {
        if text.len() > LARGEST_FILE {
            return Err(format!("the file is larger than {LARGEST_FILE} bytes"));
        }
        let file: File = toml::from_str(text).map_err(|error| error.to_string())?;
        let model =
            file.model.map(|name| Name::named(&name).ok_or_else(|| unknown_model(&name))).transpose()?;
        let parameters = file
            .parameters
            .into_iter()
            .map(|(name, value)| {
                let words = match value {
                    toml::Value::String(text) => text,
                    other => other.to_string(),
                };
                (name, words)
            })
            .collect();
        Ok((model, Self { parameters }))
    }

    /// What is known of each parameter of a model; what is said later counts.
    ///
    /// # Errors
    /// All faults: names that are none, what is neither a number nor a prior, and what lies out of bounds.
    pub fn freedoms(&self, parameters: &[Parameter]) -> Result<Vec<Freedom>, Vec<String>> {
        let mut freedoms: Vec<Freedom> = parameters.iter().map(|parameter| parameter.usual).collect();
        let mut faults = Vec::new();
        for (name, words) in &self.parameters {
            match parameters.iter().position(|parameter| parameter.name == name) {
                None => faults.push(unknown(name, parameters)),
                Some(k) => match freedom(&parameters[k], words) {
                    Ok(freedom) => freedoms[k] = freedom,
                    Err(fault) => faults.push(fault),
                },
            }
        }
        if faults.is_empty() && freedoms.iter().all(|freedom| matches!(freedom, Freedom::Fixed(_))) {
            faults.push("every parameter is fixed: there is nothing to look for".to_owned());
        }
        if faults.is_empty() { Ok(freedoms) } else { Err(faults) }
    }
}

/// What is known of a parameter, in words.
fn freedom(parameter: &Parameter, words: &str) -> Result<Freedom, String> {
    let Parameter { name, bounds: [low, high], .. } = parameter;
    let words = words.trim();
    if words == "free" {
        return match parameter.usual {
            free @ Freedom::Free(_) => Ok(free),
            Freedom::Fixed(_) if low.is_finite() && high.is_finite() => {
                Ok(Freedom::Free(crate::Prior::Uniform(*low, *high)))
            }
            Freedom::Fixed(_) if *name == "background" => {
                Ok(Freedom::Free(crate::Prior::Uniform(f64::NEG_INFINITY, f64::INFINITY)))
            }
            Freedom::Fixed(_) if low.is_infinite() => Err(format!(
                "{name}: say with --prior between which values it is free, as '{name}=uniform(-1, 1)'"
            )),
            Freedom::Fixed(_) => Err(format!(
                "{name}: say between which values it is free, as {name}=log-uniform({low}, 1000)"
            )),
        };
    }
    if let Ok(value) = words.parse::<f64>() {
        return if value >= *low && value <= *high {
            Ok(Freedom::Fixed(value))
        } else {
            Err(format!("{name} is {value}, and has to be from {low} to {high}"))
        };
    }
    let prior = words.parse::<crate::Prior>().map_err(|fault| format!("{name}: {fault}"))?;
    let round = matches!(prior, crate::Prior::Normal(..)) || prior == crate::Prior::Uniform(0.0, 360.0);
    if *name == "position_angle" && !round {
        return Err(format!(
            "{name} goes around: give it a number, free, or a prior normal(MEAN, DEVIATION)"
        ));
    }
    let [from, to] = prior.range(parameter.bounds);
    if from < to {
        Ok(Freedom::Free(prior))
    } else {
        Err(format!("{name}: {prior} has nothing within {low} to {high}, where {name} may be"))
    }
}

fn unknown(name: &str, parameters: &[Parameter]) -> String {
    let names: Vec<&str> = parameters.iter().map(|parameter| parameter.name).collect();
    let near = names
        .iter()
        .map(|known| (strsim::jaro_winkler(known, name), *known))
        .filter(|(alike, _)| *alike > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let hint = near.map_or(String::new(), |(_, known)| format!(" Did you mean {known}?"));
    format!("no parameter of this model is called {name:?}.{hint} There are {}", names.join(", "))
}

/// What to say of a model that there is not.
pub fn unknown_model(name: &str) -> String {
    let names: Vec<&str> = Name::ALL.into_iter().map(Name::name).collect();
    format!("no model is called {name:?}: give {}", names.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Models;
    use crate::models::Choice;
    use crate::{Observed, Prior};

    #[test]
    fn words_become_freedoms_and_all_faults_are_told() {
        let model = Observed::new(Choice::default().source(2), [16, 16]);
        let at = |freedoms: &[Freedom], name: &str| {
            freedoms[model.parameters().iter().position(|p| p.name == name).unwrap()]
        };
        let text = "model = \"page-thorne\"\n[parameters]\nspin = 0.9\nblur = \"free\"\ninclination = \"isotropic(0, 90)\"";
        let (name, request) = Request::from_toml(text).unwrap();
        assert_eq!(name, Some(Name::PageThorne));
        let freedoms = request.freedoms(model.parameters()).unwrap();
        assert_eq!(at(&freedoms, "spin"), Freedom::Fixed(0.9));
        assert_eq!(at(&freedoms, "blur"), Freedom::Free(Prior::Uniform(0.0, 8.0)));
        assert_eq!(at(&freedoms, "inclination"), Freedom::Free(Prior::Isotropic(0.0, 90.0)));
        let wrong = [
            ("spun", "0.5"),
            ("spin", "2"),
            ("scale", "uniform(3, 1)"),
            ("inclination", "wide"),
            ("position_angle", "uniform(0, 90)"),
        ];
        let request =
            Request { parameters: wrong.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect() };
        let faults = request.freedoms(model.parameters()).unwrap_err();
        assert_eq!(faults.len(), 5, "{faults:?}");
        assert!(faults[0].contains("Did you mean spin?"), "{faults:?}");
        assert!(Request::from_toml("model = \"cat\"").unwrap_err().contains("page-thorne"));
    }
}
