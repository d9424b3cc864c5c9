//! What a place in the schema allows, and how to say it to a person.

use serde_json::Value as Json;

use super::tree::Value;

/// The kinds of value that one place allows: one, or several to choose from.
pub(super) struct Shape<'s> {
    /// Each has a `type`, and is an alternative to the others.
    alternatives: Vec<&'s Json>,
    default: Option<&'s Json>,
}

impl<'s> Shape<'s> {
    pub(super) fn new(schema: &'s Json) -> Self {
        let mut alternatives = Vec::new();
        flatten(schema, &mut alternatives);
        Self { alternatives, default: schema.get("default") }
    }

    /// The schema for values of the same kind as this one.
    pub(super) fn alternative(&self, value: &Value) -> Option<&'s Json> {
        let fits = |kind: &str| match value {
            Value::Text(_) => kind == "string",
            Value::Whole(_) => kind == "integer" || kind == "number",
            Value::Real(_) => kind == "number",
            Value::Truth(_) => kind == "boolean",
            Value::List(_) => kind == "array",
            Value::Table(_) => kind == "object",
            Value::Date => false,
        };
        self.alternatives.iter().copied().find(|schema| fits(kind(schema)))
    }

    /// Whether a value of this `type` is allowed.
    pub(super) fn allows(&self, wanted: &str) -> bool {
        self.alternatives.iter().any(|schema| kind(schema) == wanted)
    }

    /// Whether it is a list of tables.
    pub(super) fn holds_tables(&self) -> bool {
        self.alternatives
            .iter()
            .any(|schema| schema.get("items").is_some_and(|items| kind(items) == "object"))
    }

    /// The tables that are allowed.
    pub(super) fn tables(&self) -> impl Iterator<Item = &'s Json> {
        self.alternatives.iter().copied().filter(|schema| kind(schema) == "object")
    }

    /// The words allowed; none if any text is, or no text.
    pub(super) fn words(&self) -> Vec<&'s str> {
        self.alternatives.iter().filter_map(|schema| schema.get("const")?.as_str()).collect()
    }

    /// "a number from -1 to 1", "\"isco\" or a number above 0".
    pub(super) fn wanted(&self) -> String {
        let mut phrases: Vec<String> = self.words().iter().map(|w| format!("\"{w}\"")).collect();
        let others = self.alternatives.iter().filter(|schema| schema.get("const").is_none());
        phrases.extend(others.map(|schema| phrase(schema)));
        either(&phrases)
    }

    /// The default as it would be typed, if there is one and it is short.
    pub(super) fn default(&self) -> Option<String> {
        self.default.filter(|default| !default.is_object()).map(typed)
    }
}

/// Lists the choices of a schema that have a type of their own.
fn flatten<'s>(schema: &'s Json, into: &mut Vec<&'s Json>) {
    let choices = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array());
    let before = into.len();
    for choice in choices.flatten() {
        flatten(choice, into);
    }
    if into.len() == before {
        into.push(schema);
    }
}

/// The `type` of a schema.
pub(super) fn kind(schema: &Json) -> &str {
    schema.get("type").and_then(Json::as_str).unwrap_or("")
}

/// The numbers that are allowed, if they are listed one by one.
pub(super) fn listed(schema: &Json) -> Option<&Vec<Json>> {
    schema.get("enum")?.as_array()
}

/// What one schema allows, in words.
fn phrase(schema: &Json) -> String {
    let number = |name: &str| {
        let infinity = if may_be_infinite(schema) { ", or inf" } else { "" };
        format!("{name}{}{infinity}", Range::of(schema))
    };
    match kind(schema) {
        "number" => number("a number"),
        "integer" => match listed(schema) {
            Some(allowed) => either(&allowed.iter().map(typed).collect::<Vec<_>>()),
            None => number("a whole number"),
        },
        "boolean" => "true or false".to_owned(),
        "string" => "text in quotation marks".to_owned(),
        "array" => {
            let items = schema.get("items").map(phrase).unwrap_or_default();
            let items =
                items.replacen("a number", "numbers", 1).replacen("a whole number", "whole numbers", 1);
            let items = items.replacen("a list", "lists", 1);
            let count = schema.get("minItems").and_then(Json::as_u64).unwrap_or(0);
            match count {
                0 => format!("a list of {items}"),
                _ => format!("a list of {count} {items}"),
            }
        }
        "object" => {
            let required = |key: &str| {
                let required = schema.get("required").and_then(Json::as_array);
                required.is_some_and(|keys| keys.iter().any(|k| k == key))
            };
            if schema.get("additionalProperties").is_some_and(Json::is_object) {
                return "{ name = …, … }".to_owned();
            }
            let mut keys: Vec<&str> = properties(schema).into_iter().map(|(key, _)| key).collect();
            keys.sort_by_key(|key| !required(key));
            let keys: Vec<String> = keys.iter().map(|key| format!("{key} = …")).collect();
            format!("{{ {} }}", keys.join(", "))
        }
        other => other.to_owned(),
    }
}

/// The keys of a table and their schemas, in the order of the alphabet: a map of JSON may have
/// another, as the features of its crate are set elsewhere.
pub(super) fn properties(schema: &Json) -> Vec<(&str, &Json)> {
    let properties = schema.get("properties").and_then(Json::as_object);
    let properties = properties.into_iter().flatten();
    let mut properties: Vec<_> = properties.map(|(key, schema)| (key.as_str(), schema)).collect();
    properties.sort_unstable_by_key(|(key, _)| *key);
    properties
}

/// The schema of one key of a table, which may allow any key.
pub(super) fn property<'s>(schema: &'s Json, key: &str) -> Option<&'s Json> {
    let known = schema.get("properties").and_then(|properties| properties.get(key));
    known.or_else(|| schema.get("additionalProperties").filter(|any| any.is_object()))
}

/// Whether `inf` is allowed.
pub(super) fn may_be_infinite(schema: &Json) -> bool {
    schema.get("x-infinity").and_then(Json::as_bool).unwrap_or(false)
}

/// "a", "a and b", "a, b and c".
pub(super) fn all(phrases: &[impl AsRef<str>]) -> String {
    let phrases: Vec<&str> = phrases.iter().map(AsRef::as_ref).collect();
    match &phrases[..] {
        [] => String::new(),
        [one] => (*one).to_owned(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// "a", "a or b", "a, b or c".
pub(super) fn either(phrases: &[impl AsRef<str>]) -> String {
    let mut text = String::new();
    for (i, phrase) in phrases.iter().enumerate() {
        text.push_str(match phrases.len() - i {
            _ if i == 0 => "",
            1 => " or ",
            _ => ", ",
        });
        text.push_str(phrase.as_ref());
    }
    text
}

/// A default or a bound as it would be typed in a scene.
fn typed(json: &Json) -> String {
    match json.as_f64() {
        Some(number) if json.is_f64() => readable(number),
        _ => json.to_string().replace(',', ", "),
    }
}

/// A number in the shorter of its notations.
pub(super) fn readable(number: f64) -> String {
    let (plain, scientific) = (number.to_string(), format!("{number:e}"));
    if plain.len() > 6 && scientific.len() < plain.len() { scientific } else { plain }
}

/// The bounds of a number.
pub(super) struct Range<'s> {
    min: Option<&'s Json>,
    max: Option<&'s Json>,
    above: Option<&'s Json>,
}

impl<'s> Range<'s> {
    pub(super) fn of(schema: &'s Json) -> Self {
        let bound = |key: &str| schema.get(key).filter(|bound| bound.is_number());
        Self { min: bound("minimum"), max: bound("maximum"), above: bound("exclusiveMinimum") }
    }

    pub(super) fn contains(&self, x: f64) -> bool {
        let all = |bound: Option<&Json>, holds: fn(f64, f64) -> bool| {
            bound.and_then(Json::as_f64).is_none_or(|bound| holds(x, bound))
        };
        all(self.min, |x, min| x >= min) && all(self.above, |x, above| x > above) && !self.is_exceeded_by(x)
    }

    /// Whether a number is too large, not too small.
    pub(super) fn is_exceeded_by(&self, x: f64) -> bool {
        self.max.and_then(Json::as_f64).is_some_and(|max| x > max)
    }
}

impl std::fmt::Display for Range<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [min, max, above] = [self.min, self.max, self.above].map(|bound| bound.map(typed));
        match (min, max, above) {
            (Some(min), Some(max), _) => write!(f, " from {min} to {max}"),
            (None, Some(max), Some(above)) => write!(f, " above {above}, at most {max}"),
            (None, None, Some(above)) => write!(f, " above {above}"),
            (Some(min), None, _) => write!(f, " of at least {min}"),
            (None, Some(max), None) => write!(f, " of at most {max}"),
            (None, None, None) => Ok(()),
        }
    }
}
