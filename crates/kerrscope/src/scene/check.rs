//! Compares a typed tree with the schema of a scene, and says all that does not fit.

use serde_json::Value as Json;

use super::fault::{Collector, shorten};
use super::shape::{self, Range, Shape, either};
use super::tree::{Node, Value};

/// Checks a tree against a schema.
///
/// What does not fit is reported and taken out of the tree, so that the rest can be read.
/// Returns the paths at which something was taken out.
pub(crate) fn check(root: &mut Node, schema: &Json, faults: &mut Collector) -> Vec<String> {
    let mut check = Check { schema, faults, removed: Vec::new() };
    if let Value::Table(_) = root.value {
        check.table(root, schema, "");
    }
    check.removed
}

struct Check<'a> {
    schema: &'a Json,
    faults: &'a mut Collector,
    removed: Vec<String>,
}

impl Check<'_> {
    /// Whether a value is as its schema asks, or could be made so by leaving keys out.
    fn value(&mut self, node: &mut Node, schema: &Json, path: &str) -> bool {
        let shape = Shape::new(schema);
        let Some(alternative) = shape.alternative(&node.value) else {
            let place = if let Value::Table(_) = node.value { &node.key } else { &node.place };
            self.faults.push(place, || wrong_kind(node, &shape, path));
            return false;
        };
        match node.value {
            Value::Whole(_) | Value::Real(_) => self.number(node, alternative, &shape, path),
            Value::Text(_) => self.word(node, &shape, path),
            Value::List(_) => self.list(node, alternative, path),
            Value::Table(_) => self.table(node, alternative, path),
            Value::Truth(_) | Value::Date => true,
        }
    }

    fn number(&mut self, node: &Node, schema: &Json, shape: &Shape<'_>, path: &str) -> bool {
        let x = match node.value {
            // Whole numbers end where TOML has them end; reals go on.
            Value::Whole(whole) => whole
                .filter(|whole| shape::kind(schema) == "number" || i64::try_from(*whole).is_ok())
                .map(|whole| whole as f64),
            Value::Real(real) => real,
            _ => None,
        };
        let range = Range::of(schema);
        let whole_is_listed =
            |x: f64| shape::listed(schema).is_none_or(|listed| listed.iter().any(|n| n.as_f64() == Some(x)));
        let typed = node.place.quoted();
        let what = match x {
            None => format!("{typed} is too large a number for `{path}`"),
            Some(x) if x.is_nan() => format!("`{path}` cannot be nan, which is not a number"),
            Some(x) if x == f64::INFINITY && shape::may_be_infinite(schema) => return true,
            Some(x) if x.is_infinite() => format!("`{path}` cannot be infinite"),
            Some(x) if range.contains(x) && whole_is_listed(x) => return true,
            Some(x) if range.is_exceeded_by(x) => format!("{typed} is too large for `{path}`"),
            Some(x) if range.contains(x) => format!("`{path}` cannot be {typed}"),
            Some(_) => format!("{typed} is too small for `{path}`"),
        };
        self.faults.push(&node.place, || (what, mend(shape)));
        false
    }

    fn word(&mut self, node: &Node, shape: &Shape<'_>, path: &str) -> bool {
        let (Value::Text(text), words) = (&node.value, shape.words()) else {
            return true;
        };
        if words.is_empty() || words.contains(&text.as_str()) {
            return true;
        }
        self.faults.push(&node.place, || {
            // `spin = "0.9"`, or a misspelt word?
            if let Some(mend) = quoted_in_vain(text, shape) {
                return (format!("`{path}` cannot be the text {}", node.place.quoted()), mend);
            }
            let guess = similar(text, words.iter().copied());
            let mend = match guess {
                Some(word) => format!("did you mean \"{word}\"? Allowed are {}", shape.wanted()),
                None => mend(shape),
            };
            (format!("`{path}` cannot be \"{}\"", shorten(text)), mend)
        });
        false
    }

    fn list(&mut self, node: &mut Node, schema: &Json, path: &str) -> bool {
        let Value::List(list) = &mut node.value else {
            return true;
        };
        let bound = |key: &str| schema.get(key).and_then(Json::as_u64).map(|n| n as usize);
        let count = list.len();
        let enough = bound("minItems").is_none_or(|min| count >= min);
        if !enough || bound("maxItems").is_some_and(|max| count > max) {
            self.faults.push(&node.place, || {
                let items = if count == 1 { "value" } else { "values" };
                let wanted = Shape::new(schema).wanted();
                (format!("`{path}` has {count} {items}"), format!("give {wanted}"))
            });
            return false;
        }
        let Some(items) = schema.get("items") else {
            return true;
        };
        let mut good = true;
        for (i, item) in list.iter_mut().enumerate() {
            good &= self.value(item, items, &format!("{path}[{i}]"));
        }
        good
    }

    fn table(&mut self, node: &mut Node, schema: &Json, path: &str) -> bool {
        let Value::Table(table) = &mut node.value else {
            return true;
        };
        let known = |key: &str| shape::property(schema, key);
        table.retain(|key, child| {
            let child_path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            let good = if let Some(schema) = known(key) {
                self.value(child, schema, &child_path)
            } else {
                self.faults.push(&child.key, || unknown(key, child, path, schema, self.schema));
                false
            };
            let removed = if known(key).is_some() { &child_path } else { path };
            if !good && self.removed.last().is_none_or(|last| last != removed) {
                self.removed.push(removed.to_owned());
            }
            good
        });
        let required = schema.get("required").and_then(Json::as_array).into_iter().flatten();
        let missing: Vec<&str> =
            required.filter_map(Json::as_str).filter(|key| !table.contains_key(*key)).collect();
        // Nothing more is said of a key that was wrong, or may have been misspelt.
        let reported =
            |key: &&str| self.removed.iter().any(|gone| gone == path || *gone == format!("{path}.{key}"));
        if let Some(key) = missing.iter().find(|key| !reported(key)) {
            self.faults.push(&node.key, || {
                let wanted = known(key).map(|schema| Shape::new(schema).wanted());
                let wanted = wanted.unwrap_or_default();
                (format!("`{path}` lacks `{key}`"), format!("give `{key}`: {wanted}"))
            });
        }
        missing.is_empty()
    }
}

/// "give a number from -1 to 1; the default is 0.99".
fn mend(shape: &Shape<'_>) -> String {
    let wanted = shape.wanted();
    match shape.default() {
        Some(default) => format!("give {wanted}; the default is {default}"),
        None => format!("give {wanted}"),
    }
}

fn wrong_kind(node: &Node, shape: &Shape<'_>, path: &str) -> (String, String) {
    let typed = node.place.quoted();
    let mut mend = mend(shape);
    let what = match &node.value {
        Value::Text(text) => {
            mend = quoted_in_vain(text, shape).unwrap_or(mend);
            format!("the text {typed}")
        }
        Value::Real(Some(real)) if shape.allows("integer") && real.fract() == 0.0 && real.abs() < 1e15 => {
            mend = format!("write it as a whole number, {real}");
            format!("the real number {typed}")
        }
        Value::Whole(_) | Value::Real(_) => format!("the number {typed}"),
        Value::Truth(_) => typed.clone(),
        Value::Date => format!("the date or time {typed}"),
        Value::List(_) => "a list".to_owned(),
        Value::Table(_) => "a table".to_owned(),
    };
    if shape.holds_tables() && !path.contains('.') {
        mend = format!("write [[{path}]] on a line of its own for each of them, and its keys below");
    } else if shape.allows("object") && !path.contains(['.', '[']) {
        mend = format!("write [{path}] on a line of its own, and its keys below");
    }
    (format!("`{path}` cannot be {what}"), mend)
}

/// The mend for a number or a truth that was put in quotation marks.
fn quoted_in_vain(text: &str, shape: &Shape<'_>) -> Option<String> {
    let is_number = text.parse::<f64>().is_ok();
    let number = is_number && (shape.allows("number") || shape.allows("integer"));
    if shape.allows("boolean") && ["true", "false"].contains(&text.to_lowercase().as_str()) {
        return Some(format!("write it plainly: {}", text.to_lowercase()));
    }
    number.then(|| format!("remove the quotation marks: {text}"))
}

/// The word that was probably meant.
fn similar<'w>(typed: &str, words: impl Iterator<Item = &'w str>) -> Option<&'w str> {
    if typed.len() > 64 {
        return None;
    }
    let typed = typed.to_lowercase();
    words
        .map(|word| {
            let likeness = strsim::normalized_damerau_levenshtein(&typed, word);
            // `dist` for `distance`.
            let begun = typed.len() >= 3 && word.starts_with(&typed);
            (if begun { 1.0 + likeness } else { likeness }, word)
        })
        .filter(|(likeness, _)| *likeness >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, word)| word)
}

/// A key that no table has there: misspelt, misplaced, or invented.
fn unknown(key: &str, node: &Node, path: &str, schema: &Json, root: &Json) -> (String, String) {
    let shown = shorten(key);
    let what = match (path, &node.value) {
        ("", Value::Table(_)) => format!("there is no section [{shown}]"),
        ("", Value::List(list)) if list.iter().any(|item| matches!(item.value, Value::Table(_))) => {
            format!("there is no section [[{shown}]]")
        }
        ("", _) => format!("`{shown}` is not in a section"),
        _ => format!("{} has no key `{shown}`", section(path)),
    };
    let siblings: Vec<&str> = shape::properties(schema).into_iter().map(|(key, _)| key).collect();
    // Of a section of which there may be many.
    let header = |key: &str| {
        let many = shape::property(schema, key).is_some_and(|schema| Shape::new(schema).holds_tables());
        if many { format!("[[{key}]]") } else { format!("[{key}]") }
    };
    if let Some(guess) = similar(key, siblings.iter().copied()) {
        let guess = if path.is_empty() { header(guess) } else { format!("`{guess}`") };
        return (what, format!("did you mean {guess}?"));
    }
    let mut homes = Vec::new();
    sections_with(key, root, "", &mut homes);
    if let (Value::Table(_), "", [home]) = (&node.value, path, &homes[..]) {
        let home = home.replace("[]", "");
        return (what, format!("write [{home}.{shown}]"));
    }
    if !homes.is_empty() {
        let homes: Vec<String> = homes.iter().map(|home| section(home)).collect();
        return (what, format!("`{shown}` belongs in {}", either(&homes)));
    }
    let mend = if path.is_empty() {
        let sections: Vec<String> = siblings.iter().map(|key| header(key)).collect();
        format!("a scene has the sections {}", sections.join(", "))
    } else {
        format!("{} has the keys {}", section(path), siblings.join(", "))
    };
    (what, mend)
}

/// The sections that have a key of this name.
fn sections_with(key: &str, schema: &Json, path: &str, into: &mut Vec<String>) {
    for (name, child) in shape::properties(schema) {
        if name == key && !path.is_empty() {
            into.push(path.to_owned());
        }
        let inner = if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        sections_with(key, child, &inner, into);
        if let Some(items) = child.get("items") {
            sections_with(key, items, &format!("{inner}[]"), into);
        }
    }
}

/// The header of a section, without the numbers of those of which there are many: [[object]] for object[3].
fn section(path: &str) -> String {
    let plain: String =
        path.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect();
    if path.ends_with(']') { format!("[[{plain}]]") } else { format!("[{plain}]") }
}
