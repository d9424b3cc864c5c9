//! A theory to be tested: spacetimes that differ in numbers, written as one text.

use std::collections::BTreeSet;
use std::sync::{Mutex, PoisonError};

use kerrscope::spacetime::metric::LineElement;

use super::spacetime::Spacetime;

/// Names of the parameters that every picture has.
const TAKEN: [&str; 13] = [
    "inclination",
    "position_angle",
    "scale",
    "center_x",
    "center_y",
    "distance",
    "inner",
    "outer",
    "index",
    "blur",
    "flux",
    "background",
    "noise",
];

/// The name of the parameter that is a unit, and no parameter of the fit: lengths are in M.
const MASS: &str = "mass";

/// The name of a parameter in which a Kerr hole has any value.
pub const SPIN: &str = "spin";

/// A metric whose own parameters may be free.
#[derive(Clone, Debug)]
pub struct Theory {
    element: LineElement,
    /// All parameters but the mass, and their values as written.
    parameters: Vec<(&'static str, f64)>,
}

impl Theory {
    /// Of a metric as it is written.
    ///
    /// # Errors
    /// Why its disks have no picture, in words that go behind its name.
    pub fn new(element: LineElement) -> Result<Self, String> {
        if !element.is_stationary() {
            return Err("depends on time, and a picture that is fitted does not".to_owned());
        }
        if !element.is_axisymmetric() {
            return Err("is not the same all around the z axis, so that no disk stays as it is".to_owned());
        }
        if element.has_throat() || element.outer().is_finite() {
            return Err("is not flat far away on this side alone: pictures are fitted as seen from far away"
                .to_owned());
        }
        element.check_flat().map_err(|reason| format!("is not flat far away: {reason}"))?;
        let mut parameters = Vec::new();
        for (name, value) in element.parameters() {
            if TAKEN.contains(&name.as_str()) {
                return Err(format!(
                    "has a parameter {name:?}, which every picture has: give it another name in the text"
                ));
            }
            if name != MASS {
                parameters.push((lasting(name), *value));
            }
        }
        let theory = Self { element, parameters };
        let written: Vec<f64> = theory.parameters.iter().map(|(_, value)| *value).collect();
        theory.at(&written, FAR)?;
        Ok(theory)
    }

    /// Names of its parameters, all but the mass, and their values as written.
    pub fn parameters(&self) -> &[(&'static str, f64)] {
        &self.parameters
    }

    /// The spacetime of values of its parameters, and its matter out to a radius.
    pub(super) fn at(&self, values: &[f64], outer: f64) -> Result<Spacetime, String> {
        let named: Vec<(&str, f64)> =
            self.parameters.iter().zip(values).map(|((name, _), value)| (*name, *value)).collect();
        let element = self.element.with(&named).map_err(|faults| {
            faults.into_iter().map(|fault| fault.fault.message).collect::<Vec<_>>().join("; ")
        })?;
        Spacetime::new(element, outer)
    }
}

/// The radius out to which a theory is tried when it is read.
const FAR: f64 = 100.0;

/// A name that stays as long as the program runs, kept once for all that have it.
fn lasting(name: &str) -> &'static str {
    static NAMES: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = names.get(name) {
        return known;
    }
    let kept: &'static str = name.to_owned().leak();
    names.insert(kept);
    kept
}
