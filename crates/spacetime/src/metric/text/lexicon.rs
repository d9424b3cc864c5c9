//! The names of a definition, and what they stand for.

use super::definition::{Definition, Part};
use super::fault::DefinitionFault;
use crate::formula::{Fault, Graph, Names, NodeId, is_name, parse, reserved, words};
use std::collections::HashMap;

/// The most parameters, and the most formulas with names.
const MOST: usize = 256;

/// Names and their nodes.
pub(super) struct Lexicon {
    nodes: HashMap<String, NodeId>,
    /// The names in their order.
    all: Vec<String>,
}

impl Names for Lexicon {
    fn resolve(&mut self, name: &str, _graph: &mut Graph) -> Result<Option<NodeId>, (String, String)> {
        Ok(self.nodes.get(name).copied())
    }

    fn known(&self) -> Vec<String> {
        self.all.clone()
    }
}

impl Lexicon {
    /// Reads the coordinates, the parameters and the formulas with names; what cannot be read stands for 1.
    pub(super) fn read(
        definition: &Definition,
        graph: &mut Graph,
        faults: &mut Vec<DefinitionFault>,
    ) -> Self {
        let parameters = definition.parameters.iter().map(|(name, _)| name);
        let lets = definition.lets.iter().map(|(name, _)| name);
        let all = definition.coordinates.iter().chain(parameters).chain(lets).cloned().collect();
        let mut lexicon = Self { nodes: HashMap::new(), all };
        let mut fault = |part, what: String, mend: &str| {
            faults.push(DefinitionFault::whole(part, what, mend));
        };
        for (kind, count) in
            [("parameters", definition.parameters.len()), ("formulas", definition.lets.len())]
        {
            if count > MOST {
                fault(Part::Whole, format!("{count} {kind}, and {MOST} are the most"), "leave some out");
                return lexicon;
            }
        }
        for (i, name) in definition.coordinates.iter().enumerate() {
            let node = graph.input(i as u8);
            lexicon.add(name, node, Part::Coordinate(i), &mut fault);
        }
        for (i, (name, value)) in definition.parameters.iter().enumerate() {
            let node = graph.constant(*value);
            lexicon.add(name, node, Part::Parameter(i), &mut fault);
            if !value.is_finite() {
                fault(
                    Part::Parameter(i),
                    format!("the parameter `{name}` is {value}"),
                    "give it a finite number",
                );
            }
        }
        let (order, circular) = arrange(definition);
        for i in circular {
            let (name, _) = &definition.lets[i];
            let what = format!("`{name}` is defined by itself");
            fault(Part::Let(i), what, "each formula can use those that do not use it in turn");
            let one = graph.constant(1.0);
            lexicon.add(name, one, Part::LetName(i), &mut fault);
        }
        for i in order {
            let (name, text) = &definition.lets[i];
            let node = parse(text, graph, &mut lexicon).unwrap_or_else(|wrong| {
                faults.extend(wrong.into_iter().map(|fault| DefinitionFault { part: Part::Let(i), fault }));
                graph.constant(1.0)
            });
            let mut fault =
                |part, what: String, mend: &str| faults.push(DefinitionFault::whole(part, what, mend));
            lexicon.add(name, node, Part::LetName(i), &mut fault);
        }
        lexicon
    }

    fn add(&mut self, name: &str, node: NodeId, part: Part, fault: &mut impl FnMut(Part, String, &str)) {
        if !is_name(name) {
            let what = format!("`{}` is no name", Fault::shorten(name));
            fault(part, what, "a name is of letters, digits and `_`, and begins with a letter");
        } else if reserved(name) {
            fault(part, format!("`{name}` is the name of a function or of a number"), "choose another name");
        } else if self.nodes.insert(name.to_owned(), node).is_some() {
            fault(part, format!("`{name}` is the name of two things"), "give one of them another name");
        }
    }
}

/// The formulas with names in an order in which each comes after those that it uses; and those that use themselves.
fn arrange(definition: &Definition) -> (Vec<usize>, Vec<usize>) {
    let lets = &definition.lets;
    let number: HashMap<&str, usize> =
        lets.iter().enumerate().map(|(i, (name, _))| (name.as_str(), i)).collect();
    let mut users = vec![Vec::new(); lets.len()];
    let mut missing = vec![0_usize; lets.len()];
    for (i, (_, text)) in lets.iter().enumerate() {
        for word in words(text) {
            if let Some(&used) = number.get(word) {
                users[used].push(i);
                missing[i] += 1;
            }
        }
    }
    let mut order: Vec<usize> = (0..lets.len()).filter(|i| missing[*i] == 0).collect();
    let mut next = 0;
    while let Some(&done) = order.get(next) {
        next += 1;
        for &user in &users[done] {
            missing[user] -= 1;
            if missing[user] == 0 {
                order.push(user);
            }
        }
    }
    let circular = (0..lets.len()).filter(|i| missing[*i] > 0).collect();
    (order, circular)
}
