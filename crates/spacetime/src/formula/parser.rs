//! From a text to a node of a graph.

use super::fault::Fault;
use super::function::{CALLED, Function};
use super::graph::{Graph, NodeId};
use super::token::{Token, tokens};
use super::{MAX_DEPTH, MAX_LENGTH, MAX_NODES};
use std::ops::Range;

/// What the names in a formula stand for.
pub trait Names {
    /// The node of a name; `Ok(None)` if there is none of this name.
    ///
    /// # Errors
    /// Why the name, which is known, cannot stand here, and the mend.
    fn resolve(&mut self, name: &str, graph: &mut Graph) -> Result<Option<NodeId>, (String, String)>;

    /// All names that are known, to guess which one was meant.
    fn known(&self) -> Vec<String>;
}

/// Reads a formula into a graph.
///
/// # Errors
/// What is wrong with it: one fault of its grammar, but every one of its words and names.
pub fn parse(text: &str, graph: &mut Graph, names: &mut dyn Names) -> Result<NodeId, Vec<Fault>> {
    if text.len() > MAX_LENGTH {
        let what = format!("a formula of {} bytes, and {MAX_LENGTH} are the most", text.len());
        return Err(vec![Fault::new(0..0, what, "give parts of it names with `let`")]);
    }
    let mut faults = Vec::new();
    let tokens = tokens(text, &mut faults);
    // Without a word that has no meaning the rest may have none either.
    let garbled = !faults.is_empty();
    let mut parser = Parser { tokens, next: 0, depth: 0, graph, names, faults };
    match parser.whole() {
        Ok(node) if parser.faults.is_empty() => {
            if parser.graph.is_full() {
                let what = format!("the formulas have more than {MAX_NODES} operations");
                return Err(vec![Fault::new(0..text.len(), what, "make them simpler")]);
            }
            Ok(node)
        }
        Ok(_) => Err(parser.faults),
        Err(fault) => {
            if !garbled {
                parser.faults.push(fault);
            }
            parser.faults.sort_by_key(|fault| fault.span.start);
            Err(parser.faults)
        }
    }
}

struct Parser<'t, 'g> {
    tokens: Vec<(Token<'t>, Range<usize>)>,
    next: usize,
    depth: usize,
    graph: &'g mut Graph,
    names: &'g mut dyn Names,
    faults: Vec<Fault>,
}

impl<'t> Parser<'t, '_> {
    fn peek(&self) -> Token<'t> {
        self.tokens[self.next].0
    }

    fn span(&self) -> Range<usize> {
        self.tokens[self.next].1.clone()
    }

    /// The next word, which stays the end once it is that.
    fn take(&mut self) -> (Token<'t>, Range<usize>) {
        let token = self.tokens[self.next].clone();
        self.next = (self.next + 1).min(self.tokens.len() - 1);
        token
    }

    fn accept(&mut self, sign: char) -> bool {
        let found = self.peek() == Token::Sign(sign);
        if found {
            self.take();
        }
        found
    }

    fn whole(&mut self) -> Result<NodeId, Fault> {
        let node = self.sum()?;
        let (span, token) = (self.span(), self.peek());
        match token {
            Token::End => Ok(node),
            Token::Sign(')') => {
                Err(Fault::new(span, "this `)` closes nothing", "remove it, or open it before with `(`"))
            }
            Token::Sign(',') => Err(Fault::new(
                span,
                "a comma stands between the arguments of a function only",
                "decimals follow a point: 0.5",
            )),
            _ => Err(missing_operator(span)),
        }
    }

    fn sum(&mut self) -> Result<NodeId, Fault> {
        let mut left = self.product()?;
        loop {
            if self.accept('+') {
                let right = self.product()?;
                left = self.graph.add(left, right);
            } else if self.accept('-') {
                let right = self.product()?;
                left = self.graph.sub(left, right);
            } else {
                return Ok(left);
            }
        }
    }

    fn product(&mut self) -> Result<NodeId, Fault> {
        let mut left = self.signed()?;
        loop {
            if self.accept('*') {
                let right = self.signed()?;
                left = self.graph.mul(left, right);
            } else if self.peek() == Token::Sign('/') {
                self.take();
                let span = self.span();
                let right = self.signed()?;
                if self.graph.value(right) == Some(0.0) {
                    let what = "this divides by zero, whatever the coordinates are";
                    self.faults.push(Fault::new(span, what, "correct the divisor or its parameters"));
                }
                left = self.graph.div(left, right);
            } else if matches!(self.peek(), Token::Name(_) | Token::Number(_) | Token::Sign('(')) {
                return Err(missing_operator(self.span()));
            } else {
                return Ok(left);
            }
        }
    }

    fn signed(&mut self) -> Result<NodeId, Fault> {
        self.deeper()?;
        let node = if self.accept('-') {
            let node = self.signed()?;
            self.graph.neg(node)
        } else if self.accept('+') {
            self.signed()?
        } else {
            self.power()?
        };
        self.depth -= 1;
        Ok(node)
    }

    fn power(&mut self) -> Result<NodeId, Fault> {
        let base = self.atom()?;
        if !self.accept('^') {
            return Ok(base);
        }
        let exponent = self.signed()?;
        Ok(self.graph.power_of(base, exponent))
    }

    fn atom(&mut self) -> Result<NodeId, Fault> {
        let (token, span) = self.take();
        match token {
            Token::Number(value) => Ok(self.graph.constant(value)),
            Token::Name(name) if self.peek() == Token::Sign('(') => self.call(name, span),
            Token::Name(name) => Ok(self.name(name, span)),
            Token::Sign('(') => {
                if self.peek() == Token::Sign(')') {
                    return Err(Fault::new(
                        span,
                        "there is nothing between these brackets",
                        "write a value in them",
                    ));
                }
                let node = self.sum()?;
                self.close(span)?;
                Ok(node)
            }
            Token::End => {
                let what = if self.tokens.len() == 1 {
                    "the formula is empty"
                } else {
                    "the formula ends here, and a value is missing"
                };
                Err(Fault::new(span, what, "write a number, a name, or brackets"))
            }
            Token::Sign(sign) => Err(Fault::new(
                span,
                format!("a value is missing before `{sign}`"),
                "write a number, a name, or brackets there",
            )),
        }
    }

    fn close(&mut self, opened: Range<usize>) -> Result<(), Fault> {
        if self.accept(')') {
            return Ok(());
        }
        match self.peek() {
            Token::End => Err(Fault::new(opened, "this `(` is never closed", "close it with `)`")),
            Token::Sign(',') => Err(Fault::new(
                self.span(),
                "there is no argument to come after this comma",
                "decimals follow a point: 0.5; a comma stands between the arguments of a function",
            )),
            _ => Err(missing_operator(self.span())),
        }
    }

    fn call(&mut self, name: &str, span: Range<usize>) -> Result<NodeId, Fault> {
        let (_, opened) = self.take();
        let mut arguments = Vec::new();
        if self.peek() != Token::Sign(')') {
            arguments.push(self.sum()?);
            while self.accept(',') {
                arguments.push(self.sum()?);
            }
        }
        self.close(opened)?;
        let Some((_, wanted)) = CALLED.iter().find(|(known, _)| *known == name) else {
            return Ok(self.no_function(name, span));
        };
        if arguments.len() != *wanted {
            let count = arguments.len();
            let are = if count == 1 { "is 1" } else { &format!("are {count}") };
            let mend = match name {
                "atan2" => "atan2(y, x) is the angle of the point (x, y)".to_owned(),
                _ if *wanted == 2 => format!("write {name}(a, b)"),
                _ => format!("write {name}(x)"),
            };
            let plural = if *wanted == 1 { "" } else { "s" };
            let what = format!("{name} has {wanted} argument{plural}, and here {are}");
            self.faults.push(Fault::new(span, what, mend));
            return Ok(self.graph.constant(1.0));
        }
        Ok(match (name, arguments[..].first(), arguments.get(1)) {
            ("atan2", Some(&y), Some(&x)) => self.graph.atan2(y, x),
            ("min", Some(&a), Some(&b)) => self.graph.min(a, b),
            ("max", Some(&a), Some(&b)) => self.graph.max(a, b),
            (_, Some(&x), _) => {
                if let Some(function) = Function::named(name) {
                    self.graph.call(function, x)
                } else {
                    // tan x.
                    let sin = self.graph.call(Function::Sin, x);
                    let cos = self.graph.call(Function::Cos, x);
                    self.graph.div(sin, cos)
                }
            }
            _ => self.graph.constant(1.0),
        })
    }

    fn no_function(&mut self, name: &str, span: Range<usize>) -> NodeId {
        let known = CALLED.map(|(name, _)| name);
        let meant = match name {
            "log" => Some("ln".to_owned()),
            "pow" => Some("a^b".to_owned()),
            "asin" | "acos" | "atan" | "arctan" => Some("atan2(y, x)".to_owned()),
            _ => similar(name, known.iter().copied()).map(str::to_owned),
        };
        let names_value = matches!(self.names.resolve(name, self.graph), Ok(Some(_)));
        let (what, mend) = if names_value {
            (format!("`{name}` is a value, not a function"), format!("a product is written {name}*( )"))
        } else if let Some(meant) = meant {
            (format!("there is no function `{name}`"), format!("did you mean {meant}?"))
        } else {
            (format!("there is no function `{name}`"), format!("there are {}", known.join(", ")))
        };
        self.faults.push(Fault::new(span, what, mend));
        self.graph.constant(1.0)
    }

    fn name(&mut self, name: &str, span: Range<usize>) -> NodeId {
        let (what, mend) = match self.names.resolve(name, self.graph) {
            Ok(Some(node)) => return node,
            Err(reason) => reason,
            Ok(None) if name == "pi" => return self.graph.constant(std::f64::consts::PI),
            Ok(None) if name == "e" => return self.graph.constant(std::f64::consts::E),
            Ok(None) if CALLED.iter().any(|(known, _)| *known == name) => {
                (format!("`{name}` is a function"), format!("give it an argument: {name}( )"))
            }
            Ok(None) => {
                let known = self.names.known();
                let mend = match similar(name, known.iter().map(String::as_str)) {
                    Some(guess) => format!("did you mean `{guess}`?"),
                    None => format!("known are {}", known.join(", ")),
                };
                (format!("`{name}` is not known"), mend)
            }
        };
        self.faults.push(Fault::new(span, what, mend));
        // No number that makes another fault of its own.
        self.graph.constant(1.0)
    }

    fn deeper(&mut self) -> Result<(), Fault> {
        self.depth += 1;
        if self.depth <= MAX_DEPTH {
            return Ok(());
        }
        let what = format!("more than {MAX_DEPTH} brackets, signs or exponents within one another");
        Err(Fault::new(self.span(), what, "give parts of the formula names with `let`"))
    }
}

fn missing_operator(span: Range<usize>) -> Fault {
    Fault::new(span, "an operator is missing before this", "a product is written `*`: 2*x")
}

/// The name that was probably meant.
pub(crate) fn similar<'w>(typed: &str, words: impl Iterator<Item = &'w str>) -> Option<&'w str> {
    if typed.len() > 64 {
        return None;
    }
    let typed = typed.to_lowercase();
    words
        .map(|word| {
            let known = word.to_lowercase();
            let begun = known.len() >= 3 && typed.len() >= 3;
            let begun = begun && (typed.starts_with(&known) || known.starts_with(&typed));
            let likeness = strsim::normalized_damerau_levenshtein(&typed, &known);
            (if begun { 1.0 } else { likeness }, word)
        })
        .filter(|(likeness, _)| *likeness >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, word)| word)
}
