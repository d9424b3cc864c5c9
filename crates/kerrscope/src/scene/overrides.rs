//! `--set PATH=VALUE`: single keys given beside a scene file.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::de::DeValue;

use super::fault::{Collector, Place, Source, shorten};
use super::scan::MAX_DEPTH;
use super::tree::{self, Node, Value};

/// Puts one override into a tree, in place of what the tree said.
///
/// Returns whether it could be read. `name` is what faults call it.
pub(super) fn merge(root: &mut Node, text: &str, name: &str, faults: &mut Collector) -> bool {
    let source = Source::new(name, text);
    faults.add_source(&source);
    let Some((path, value)) = read(&source, faults) else {
        return false;
    };
    let mut node = root;
    for (i, (key, place)) in path.iter().enumerate() {
        if !matches!(node.value, Value::Table(_)) {
            // `observer.motion.velocity` after `motion = "static"`: the later one holds.
            node.place = place.clone();
            node.value = Value::Table(BTreeMap::new());
        }
        let Value::Table(table) = &mut node.value else {
            return false;
        };
        let empty =
            || Node { key: place.clone(), place: place.clone(), value: Value::Table(BTreeMap::new()) };
        if i + 1 == path.len() {
            table.insert(key.clone(), Node { key: place.clone(), ..value });
            return true;
        }
        node = table.entry(key.clone()).or_insert_with(empty);
    }
    false
}

type Path = Vec<(String, Place)>;

/// The path and the value of one override.
fn read(source: &Arc<Source>, faults: &mut Collector) -> Option<(Path, Node)> {
    let text = source.text.as_str();
    let mut wrong = |span, what: String, mend: &str| {
        faults.push(&Place::new(source, span), || (what, mend.to_owned()));
        None
    };
    let Some((path, value)) = text.split_once('=') else {
        let what = match text.trim() {
            "" => "this override is empty".to_owned(),
            text => format!("`{}` gives no value", shorten(text)),
        };
        return wrong(0..text.len(), what, "write PATH=VALUE, as in spacetime.spin=0.9");
    };
    let control = text.char_indices().find(|(_, c)| c.is_control() && *c != '\t');
    if let Some((i, c)) = control {
        let mend = "an override is one line, PATH=VALUE";
        return wrong(i..i + c.len_utf8(), "a control character in an override".to_owned(), mend);
    }
    let keys = keys(path, source);
    let bare = |key: &str| {
        !key.is_empty() && key.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-')
    };
    if keys.len() > MAX_DEPTH || !keys.iter().all(|(key, _)| bare(key)) {
        let what = if path.trim().is_empty() {
            "there is no path before `=`".to_owned()
        } else {
            format!("`{}` is no path to a key", shorten(path))
        };
        return wrong(0..path.len(), what, "write SECTION.KEY=VALUE, as in spacetime.spin=0.9");
    }
    let start = text.len() - value.trim_start().len();
    let value = value.trim();
    let span = start..start + value.len();
    if value.is_empty() {
        let what = format!("`{}` is given no value", path.trim());
        return wrong(span, what, "write the value after `=`, as in spacetime.spin=0.9");
    }
    let place = Place::new(source, span);
    // A shell takes quotation marks away, and nobody likes to write them twice.
    let is_word = !value.starts_with(['"', '\'', '[', '{', '#']) && DeValue::parse(value).is_err();
    if is_word {
        let value = Value::Text(value.to_owned());
        return Some((keys, Node { key: place.clone(), place, value }));
    }
    let (root, complete) = tree::parse(source, faults);
    if !complete {
        return None;
    }
    let node = keys.iter().try_fold(root, |node, (key, _)| match node.value {
        Value::Table(mut table) => table.remove(key),
        _ => None,
    });
    Some((keys, node?))
}

/// The keys of a dotted path and where they stand.
fn keys(path: &str, source: &Arc<Source>) -> Path {
    let mut start = 0;
    path.split('.')
        .take(MAX_DEPTH + 1)
        .map(|typed| {
            let key = typed.trim();
            let begin = start + typed.len() - typed.trim_start().len();
            start += typed.len() + 1;
            (key.to_owned(), Place::new(source, begin..begin + key.len()))
        })
        .collect()
}
