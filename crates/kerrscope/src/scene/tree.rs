//! TOML as a tree whose every key and value knows where it was typed.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue, Error};

use super::fault::{Collector, Place, Source};
use super::scan;

/// A value and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    /// The key, or the value if it has no key.
    pub(crate) key: Place,
    pub(crate) place: Place,
    pub(crate) value: Value,
}

/// What TOML can say.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Text(String),
    /// `None` if no machine integer holds it.
    Whole(Option<i128>),
    /// `None` if no machine number holds it.
    Real(Option<f64>),
    Truth(bool),
    Date,
    List(Vec<Node>),
    Table(BTreeMap<String, Node>),
}

impl Node {
    /// A table without keys, for a scene of which nothing is said.
    pub(super) fn empty(source: &Arc<Source>) -> Self {
        let place = Place::whole(source);
        Self { key: place.clone(), place, value: Value::Table(BTreeMap::new()) }
    }

    /// The value at a path such as `observer.distance` or `object[3].radius`, if it was typed.
    pub(crate) fn at(&self, path: &str) -> Option<&Self> {
        path.split('.').try_fold(self, |node, part| {
            let Value::Table(table) = &node.value else { return None };
            let Some((key, index)) = part.split_once('[') else { return table.get(part) };
            let Value::List(list) = &table.get(key)?.value else { return None };
            list.get(index.strip_suffix(']')?.parse::<usize>().ok()?)
        })
    }

    /// The tree without its places, to be read by serde.
    pub(crate) fn to_toml(&self) -> toml::Value {
        match &self.value {
            Value::Text(text) => toml::Value::String(text.clone()),
            Value::Whole(whole) => {
                let whole = whole.unwrap_or(i128::MAX);
                i64::try_from(whole).map_or(toml::Value::Float(whole as f64), toml::Value::Integer)
            }
            Value::Real(real) => toml::Value::Float(real.unwrap_or(f64::NAN)),
            Value::Truth(truth) => toml::Value::Boolean(*truth),
            Value::Date => toml::Value::String(self.place.quoted()),
            Value::List(list) => toml::Value::Array(list.iter().map(Self::to_toml).collect()),
            Value::Table(table) => {
                let entries = table.iter().map(|(key, node)| (key.clone(), node.to_toml()));
                toml::Value::Table(entries.collect())
            }
        }
    }
}

/// Reads a text. What is faulty is reported and left out; the rest is in the tree.
///
/// The second answer is whether nothing was left out.
pub(crate) fn parse(source: &Arc<Source>, faults: &mut Collector) -> (Node, bool) {
    let statements = scan::statements(&source.text);
    let mut faulty = scan::refuse(&statements, source, faults);
    let mut complete = !faulty.contains(&true);
    // The parser stops at some faults; without the statements that hold them it comes further.
    // Three passes are what it needs; a bound because that is not promised.
    for _ in 0..5 {
        let text = scan::without(&source.text, &statements, &faulty);
        let (table, errors) = DeTable::parse_recoverable(&text);
        let holder = |error: &Error| {
            let start = error.span().unwrap_or_default().start;
            let after = statements.partition_point(|statement| statement.range.start <= start);
            after.saturating_sub(1)
        };
        let mut report = |error: &Error| {
            let place = Place::new(source, error.span().unwrap_or_default());
            faults.push(&place, || syntax(error, &place));
            complete = false;
        };
        let mut again = false;
        for error in errors.iter().filter(|error| !is_parsed(error)) {
            // Later errors in a statement follow from the first.
            match faulty.get_mut(holder(error)) {
                Some(true) => continue,
                Some(faulty) => {
                    *faulty = true;
                    again = true;
                }
                None => {}
            }
            report(error);
        }
        if !again {
            // What is given twice is known when all that is given is well-formed.
            for error in errors.iter().filter(|error| is_parsed(error)) {
                if faulty.get(holder(error)) == Some(&false) {
                    report(error);
                }
            }
            let mut table = table.into_inner();
            if !complete {
                table.remove(scan::UNKNOWN_SECTION);
            }
            let mut root = Node::empty(source);
            root.value = read_table(table, source);
            return (root, complete);
        }
    }
    (Node::empty(source), false)
}

fn read_table(table: DeTable<'_>, source: &Arc<Source>) -> Value {
    let entries = table.into_iter().map(|(key, value)| {
        let place = Place::new(source, key.span());
        (key.into_inner().into_owned(), read(value, Some(place), source))
    });
    Value::Table(entries.collect())
}

fn read(value: Spanned<DeValue<'_>>, key: Option<Place>, source: &Arc<Source>) -> Node {
    let place = Place::new(source, value.span());
    let value = match value.into_inner() {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(whole) => Value::Whole(i128::from_str_radix(whole.as_str(), whole.radix()).ok()),
        DeValue::Float(real) => {
            let typed = real.as_str();
            let parsed = typed.parse().ok();
            Value::Real(parsed.filter(|x: &f64| !x.is_infinite() || typed.contains("inf")))
        }
        DeValue::Boolean(truth) => Value::Truth(truth),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(list) => {
            Value::List(list.into_iter().map(|value| read(value, None, source)).collect())
        }
        DeValue::Table(table) => read_table(table, source),
    };
    Node { key: key.unwrap_or_else(|| place.clone()), place, value }
}

/// Whether the parser keeps what such an error is about: the first of two equal keys, and the
/// keys of both of two equal tables.
fn is_parsed(error: &Error) -> bool {
    error.message().starts_with("duplicate key") || error.message().starts_with("cannot extend")
}

/// What a syntax error means and how to mend it, for people who never read TOML's grammar.
fn syntax(error: &Error, place: &Place) -> (String, String) {
    let typed = place.quoted();
    let (what, expected) = error.message().split_once(", expected ").unwrap_or((error.message(), ""));
    let said = |what: &str, mend: &str| (what.to_owned(), mend.to_owned());
    match what {
        "string values must be quoted" => no_value(&typed),
        "unquoted keys cannot be empty" => said("a key is missing here", "write `key = value`, or [section]"),
        "invalid unquoted key" => said(
            "this is no key",
            "a key is a word of letters, numbers, `-` and `_`; a comment begins with `#`",
        ),
        "key with no value" => {
            said("this key has no value", "write `key = value`; a comment begins with `#`")
        }
        "duplicate key" => (format!("`{typed}` is given twice"), "keep one of the two".to_owned()),
        "unclosed table" | "unclosed array table" => said("this header is never closed", "close it with `]`"),
        "invalid basic string" if expected == "`\"`" => said("this text is never closed", "end it with `\"`"),
        "invalid literal string" if expected == "`'`" => said("this text is never closed", "end it with `'`"),
        "unexpected key or value" if place.follows(',') => said(
            "a comma cannot follow this value",
            "decimals follow a point, 0.5; a list is in brackets, [1, 2, 3]",
        ),
        "unexpected key or value" => said(
            "this does not belong to what is before it",
            "put each `key = value` and each [section] on a line of its own; \
             a comment begins with `#`",
        ),
        _ if what.starts_with("cannot extend") => (
            format!("`{typed}` is already a value and cannot have keys of its own"),
            "keep one of the two".to_owned(),
        ),
        _ if expected.is_empty() || expected == "nothing" => {
            (what.to_owned(), format!("correct or remove `{typed}`"))
        }
        _ => (what.to_owned(), format!("expected {expected}")),
    }
}

/// What stands in the place of a value and is none.
fn no_value(typed: &str) -> (String, String) {
    if typed.is_empty() {
        let mend = "give a value, or remove the key for its default";
        return ("there is no value after `=`".to_owned(), mend.to_owned());
    }
    let words: Vec<&str> = typed.split_whitespace().collect();
    let mend = if words.len() > 1 && words.iter().all(|word| word.parse::<f64>().is_ok()) {
        format!("part the numbers by commas: {}", words.join(", "))
    } else if let Some((value, _)) = typed.split_once("//").or(typed.split_once(';')) {
        format!("a comment begins with `#`: {} # …", value.trim_end())
    } else if typed.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '+') {
        "a number is written 0.5 or 1e-8, and text in quotation marks".to_owned()
    } else {
        format!("text is quoted: \"{}\"", typed.trim_matches(['"', '\'']))
    };
    (format!("`{typed}` is no value"), mend)
}
