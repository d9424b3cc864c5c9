//! The spacetime.

use std::collections::BTreeMap;
use std::sync::Arc;

use kerrscope_spacetime::metric::{Definition, DefinitionFault, Kind, LineElement, Part, Reversal};

use super::{Builder, SPACETIME};
use crate::scene::fault::{Place, Source, one_line};
use crate::scene::file::{self, CoordinateKind, Formula, SpacetimeName};
use crate::scene::tree::{Node, Value};
use crate::scene::valid::Spacetime;
use crate::scene::{read, shape};

/// A metric as text: its keys, and where they were typed.
struct Typed {
    keys: file::Spacetime,
    node: Node,
}

impl Builder<'_> {
    /// The spacetime, and the keys that say all of it without another file.
    pub(super) fn spacetime(&mut self, file: &file::Spacetime) -> (Spacetime, file::Spacetime) {
        let spin = file.spin.unwrap_or_default();
        let spacetime = match file.name {
            SpacetimeName::Kerr => Spacetime::Kerr { spin },
            SpacetimeName::Schwarzschild => {
                if spin != 0.0 {
                    self.fault(
                        &SPACETIME,
                        format!("a Schwarzschild black hole does not turn: its spin cannot be {spin}"),
                        "remove `spacetime.spin`, or choose `spacetime.name = \"kerr\"`",
                    );
                }
                Spacetime::Schwarzschild
            }
            // A scene's hole is put away, and its spin with it, to see the rest without it.
            SpacetimeName::Minkowski => Spacetime::Minkowski,
            _ => return self.text(file),
        };
        self.unused_of_text(file);
        (spacetime, file.clone())
    }

    /// The metric of these keys, be it one in which light can be followed or not.
    pub(super) fn line_element(&mut self, keys: &file::Spacetime) -> Option<LineElement> {
        let typed = self.typed(keys)?;
        self.compiled(keys.name, &typed)
    }

    /// Keys of a text that a spacetime which is none takes no notice of.
    fn unused_of_text(&mut self, file: &file::Spacetime) {
        for key in text_keys(file) {
            self.unused(&format!("spacetime.{key}"), "spacetime.name", &[SpacetimeName::Text]);
        }
    }

    /// A metric as text. If it cannot be used, nothing more is said of what depends on it.
    fn text(&mut self, file: &file::Spacetime) -> (Spacetime, file::Spacetime) {
        let before = self.faults.len();
        if file.spin.is_some() {
            let what = "a metric as text has no `spin` of its own";
            self.fault(
                &["spacetime.spin", "spacetime.name"],
                what,
                "set `spacetime.parameters.spin` if it has that parameter",
            );
        }
        // A name that was taken out for its value is not one that the formulas made up.
        let named = ["spacetime.coordinates", "spacetime.parameters", "spacetime.let"];
        let doubtful = self.removed.iter().any(|key| named.iter().any(|name| key.starts_with(name)));
        if doubtful {
            self.removed.push("spacetime".to_owned());
            return (Spacetime::Minkowski, file.clone());
        }
        let element = self.typed(file).and_then(|typed| Some((self.element(file.name, &typed)?, typed.keys)));
        let shown = |keys: file::Spacetime| match file.name.metric() {
            // Its name and its numbers say all of it.
            Some(_) => {
                file::Spacetime { name: file.name, parameters: keys.parameters, ..file::Spacetime::default() }
            }
            None => file::Spacetime { name: SpacetimeName::Text, file: None, spin: None, ..keys },
        };
        match element {
            Some((element, keys)) if self.faults.len() == before => {
                (Spacetime::Text(Arc::new(element)), shown(keys))
            }
            _ => {
                self.removed.push("spacetime".to_owned());
                (Spacetime::Minkowski, file.clone())
            }
        }
    }

    /// The keys of a text: those here, those of a file, or those of its name.
    fn typed(&mut self, file: &file::Spacetime) -> Option<Typed> {
        let source = match (file.name.metric(), &file.file) {
            (Some((name, text)), _) => Source::new(format!("{name}.toml"), text),
            (None, Some(path)) => {
                let path = self.folder.join(path);
                match read::file(&path) {
                    Ok(source) => source,
                    Err(fault) => {
                        let shown = one_line(&path.display().to_string(), 300);
                        self.fault(
                            &["spacetime.file"],
                            format!("the metric {shown}: {}", fault.message),
                            format!("{}; the path begins at the folder of the scene", fault.help),
                        );
                        return None;
                    }
                }
            }
            (None, None) => {
                let node = self.root.at("spacetime").cloned().unwrap_or_else(|| self.root.clone());
                return Some(Typed { keys: file.clone(), node });
            }
        };
        for key in text_keys(file).into_iter().filter(|key| *key != "parameters") {
            let from = if file.name.metric().is_some() { "its name" } else { "`spacetime.file`" };
            // A name that is known has no file; a file is what has no keys beside it.
            if key != "file" || file.name.metric().is_some() {
                self.fault(
                    &[&format!("spacetime.{key}"), "spacetime.name"],
                    format!("this metric is known by {from}, and `spacetime.{key}` would change it"),
                    format!(
                        "remove `spacetime.{key}`, or write the whole metric with `spacetime.name = \"text\"`"
                    ),
                );
            }
        }
        let (mut keys, node) = read::metric(&source, self.faults)?;
        for (key, given) in [
            ("name", node.at("name").is_some()),
            ("file", keys.file.is_some()),
            ("spin", keys.spin.is_some()),
        ] {
            if let (true, Some(node)) = (given, node.at(key)) {
                self.faults.push(&node.key, || {
                    let mend = "a metric's file has `coordinates`, `metric` and what belongs to them";
                    (format!("`{key}` has no meaning in a metric's file"), mend.to_owned())
                });
            }
        }
        self.override_parameters(file, &mut keys.parameters);
        Some(Typed { keys, node })
    }

    fn override_parameters(&mut self, file: &file::Spacetime, parameters: &mut BTreeMap<String, f64>) {
        let known: Vec<String> = parameters.keys().map(|name| format!("`{name}`")).collect();
        for (name, value) in &file.parameters {
            if let Some(parameter) = parameters.get_mut(name) {
                *parameter = *value;
                continue;
            }
            let mend = match &known[..] {
                [] => "it has none".to_owned(),
                known => format!("it has {}", shape::all(known)),
            };
            let what = format!("the metric has no parameter `{}`", one_line(name, 40));
            self.fault(&[&format!("spacetime.parameters.{name}"), "spacetime.parameters"], what, mend);
        }
    }

    /// A text compiled.
    fn compiled(&mut self, name: SpacetimeName, typed: &Typed) -> Option<LineElement> {
        let keys = &typed.keys;
        if keys.coordinates.is_none() || keys.metric.is_empty() {
            self.fault(
                &["spacetime.name", "spacetime.coordinates", "spacetime.metric"],
                "`spacetime.name = \"text\"` needs `coordinates` and `metric`",
                "give them, or give `spacetime.file` the path of a file that does",
            );
            return None;
        }
        let definition = definition(keys);
        let shipped = name.metric().is_some();
        match LineElement::compile(&definition) {
            Ok(element) => Some(element),
            Err(wrong) => {
                for DefinitionFault { part, fault } in wrong {
                    if shipped {
                        // Its formulas are right: the numbers are not.
                        self.fault(&["spacetime.parameters", "spacetime.name"], fault.message, fault.help);
                    } else {
                        let place = place(&typed.node, keys, part, fault.span);
                        self.faults.push(&place, || (fault.message, fault.help));
                    }
                }
                None
            }
        }
    }

    /// A text in which light can be followed.
    fn element(&mut self, name: SpacetimeName, typed: &Typed) -> Option<LineElement> {
        let element = self.compiled(name, typed)?;
        let shipped = name.metric().is_some();
        let mut refuse = |what: String, mend: &str| {
            if shipped || typed.node.at("metric").is_none() {
                self.fault(&["spacetime.parameters", "spacetime.name"], what, mend);
            } else {
                let place = place(&typed.node, &typed.keys, Part::Whole, 0..0);
                self.faults.push(&place, || (what, mend.to_owned()));
            }
            None
        };
        if !element.is_stationary() {
            let what = "the metric depends on time, and rays are followed in stationary ones only";
            return refuse(
                what.to_owned(),
                "write a metric whose components do not depend on the first coordinate",
            );
        }
        if element.outer().is_infinite()
            && let Err(reason) = element.check_flat()
        {
            let mend = "correct it, or say with `outer` at what distance rays end";
            return refuse(format!("far away space does not become flat: {reason}"), mend);
        }
        Some(element)
    }
}

/// The keys of a text that are given.
fn text_keys(file: &file::Spacetime) -> Vec<&'static str> {
    [
        ("file", file.file.is_some()),
        ("coordinates", file.coordinates.is_some()),
        ("kind", file.kind.is_some()),
        ("radius", file.radius.is_some()),
        ("horizon", file.horizon.is_some()),
        ("depth", file.depth.is_some()),
        ("outer", file.outer.is_some()),
        ("throat", file.throat.is_some()),
        ("reversal", file.reversal.is_some()),
        ("parameters", !file.parameters.is_empty()),
        ("let", !file.lets.is_empty()),
        ("metric", !file.metric.is_empty()),
    ]
    .into_iter()
    .filter_map(|(key, given)| given.then_some(key))
    .collect()
}

fn definition(keys: &file::Spacetime) -> Definition {
    let texts = |formulas: &BTreeMap<String, Formula>| {
        formulas.iter().map(|(name, formula)| (name.clone(), formula.text())).collect()
    };
    let text = |formula: &Option<Formula>| formula.as_ref().map(Formula::text);
    Definition {
        coordinates: keys.coordinates.clone().unwrap_or_default(),
        kind: match keys.kind.unwrap_or_default() {
            CoordinateKind::Cartesian => Kind::Cartesian,
            CoordinateKind::Spherical => Kind::Spherical,
        },
        parameters: keys.parameters.iter().map(|(name, value)| (name.clone(), *value)).collect(),
        lets: texts(&keys.lets),
        components: texts(&keys.metric),
        radius: text(&keys.radius),
        horizon: text(&keys.horizon),
        depth: text(&keys.depth),
        outer: text(&keys.outer),
        throat: text(&keys.throat),
        reversal: match keys.reversal.unwrap_or_default() {
            file::Reversal::Time => Reversal::Time,
            file::Reversal::Mirror => Reversal::Mirror,
        },
    }
}

/// Where a part of a definition was typed, and within its formula what a span is about.
fn place(node: &Node, keys: &file::Spacetime, part: Part, span: std::ops::Range<usize>) -> Place {
    let child = |node: &Node, key: &str| match &node.value {
        Value::Table(table) => table.get(key).cloned(),
        _ => None,
    };
    let entry = |table: &str, names: Vec<&String>, i: usize| {
        child(node, table).and_then(|table| child(&table, names.get(i)?))
    };
    let (found, name) = match part {
        Part::Whole => (child(node, "metric"), true),
        Part::Coordinate(i) => {
            let list = child(node, "coordinates").map(|list| list.value);
            (if let Some(Value::List(list)) = list { list.get(i).cloned() } else { None }, false)
        }
        Part::Parameter(i) => (entry("parameters", keys.parameters.keys().collect(), i), true),
        Part::LetName(i) => (entry("let", keys.lets.keys().collect(), i), true),
        Part::Let(i) => (entry("let", keys.lets.keys().collect(), i), false),
        Part::ComponentName(i) => (entry("metric", keys.metric.keys().collect(), i), true),
        Part::Component(i) => (entry("metric", keys.metric.keys().collect(), i), false),
        Part::Radius => (child(node, "radius"), false),
        Part::Horizon => (child(node, "horizon"), false),
        Part::Depth => (child(node, "depth"), false),
        Part::Outer => (child(node, "outer"), false),
        Part::Throat => (child(node, "throat"), false),
        Part::Reversal => (child(node, "reversal"), false),
    };
    let Some(found) = found else { return node.key.clone() };
    if name {
        return found.key;
    }
    let Value::Text(text) = &found.value else { return found.place };
    found.place.within(text, span)
}
