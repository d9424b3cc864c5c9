//! A first look at TOML text, before it is parsed: statements, brackets and depth.
//!
//! The parser gives up on a document at some faults, takes everything after an open bracket as
//! part of the value, and builds trees deep enough to overflow the stack. Cut into statements
//! first, a text can be parsed without the faulty ones, so that one slip hides no other.

use std::ops::Range;
use std::sync::Arc;

use toml_parser::lexer::{Token, TokenKind};

use super::fault::{Collector, Place, Source};

/// Brackets and dots within one another; the deepest key of a scene needs four.
pub(super) const MAX_DEPTH: usize = 32;

/// A header or a key with its value, from the start of its first line to the end of its last.
pub(super) struct Statement {
    pub(super) range: Range<usize>,
    /// Whether it is `[a.table]`, to which the statements after it belong.
    pub(super) is_header: bool,
    /// Why it cannot be given to the parser: where, what, and the mend.
    pub(super) refused: Option<(Range<usize>, &'static str, &'static str)>,
}

/// Cuts a text into statements; a blank line or a comment is one too.
pub(super) fn statements(text: &str) -> Vec<Statement> {
    let tokens = toml_parser::Source::new(text).lex().into_vec();
    let mut statements: Vec<Statement> = Vec::new();
    let mut rest = &tokens[..];
    while let Some(first) = rest.first() {
        let start = first.span().start();
        let (length, mut statement) = statement(rest, text);
        rest = &rest[length..];
        statement.range = start..rest.first().map_or(text.len(), |next| next.span().start());
        statements.push(statement);
    }
    statements
}

/// The statement at the head of `tokens`, and how many tokens it has.
fn statement(tokens: &[Token], text: &str) -> (usize, Statement) {
    let first = tokens.iter().map(Token::kind).find(|&kind| kind != TokenKind::Whitespace);
    let is_header = first == Some(TokenKind::LeftSquareBracket);
    let mut refused = None;
    // Open brackets: what, where, and the dots of the key being read within.
    let mut open: Vec<(TokenKind, Range<usize>, usize)> = Vec::new();
    let (mut dots, mut dots_outside) = (0, 0);
    let mut length = 0;
    for (i, token) in tokens.iter().enumerate() {
        let span = token.span().start()..token.span().end();
        length = i + 1;
        match token.kind() {
            TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket => {
                open.push((token.kind(), span.clone(), dots));
                dots_outside += dots;
                dots = 0;
            }
            TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket => {
                dots = open.pop().map_or(dots, |(_, _, dots)| dots);
                dots_outside = dots_outside.saturating_sub(dots);
            }
            TokenKind::Dot => dots += 1,
            TokenKind::Comma => dots = 0,
            TokenKind::MlBasicString | TokenKind::MlLiteralString => {
                let quotes = &text[span.start..span.start + 3];
                if span.len() < 6 || !text[span.clone()].ends_with(quotes) {
                    refused = refused.or(Some((
                        span.start..span.start + 3,
                        "this text is never closed",
                        "end it with the same three quotation marks",
                    )));
                }
            }
            TokenKind::Newline if is_header || open.is_empty() => break,
            TokenKind::Newline => {
                dots = 0;
                if starts_statement(&tokens[length..], text, open.last().map(|o| o.0)) {
                    break;
                }
            }
            _ => {}
        }
        if open.len() + dots + dots_outside > MAX_DEPTH {
            refused = refused.or(Some((
                span,
                "too many levels within one another",
                "a scene has sections, keys, and lists of numbers, and nothing deeper",
            )));
        }
    }
    // The parser tells best what is wrong with a header.
    if let Some((kind, span, _)) = open.pop().filter(|_| !is_header) {
        let (what, mend) = match kind {
            TokenKind::LeftCurlyBracket => ("this table is never closed", "close it with `}`"),
            _ => ("this list is never closed", "close it with `]`"),
        };
        refused = refused.or(Some((span, what, mend)));
    }
    (length, Statement { range: 0..0, is_header, refused })
}

/// Whether a line within an open bracket can only be a statement of its own: `key =` or, since
/// no list holds bare words, `[name]`.
fn starts_statement(line: &[Token], text: &str, within: Option<TokenKind>) -> bool {
    let word = |token: &Token| {
        token.kind() == TokenKind::Atom
            && text[token.span().start()..].starts_with(|c: char| c.is_ascii_alphabetic())
            && !matches!(&text[token.span().start()..token.span().end()], "true" | "false" | "inf" | "nan")
    };
    let mut line = line.iter().filter(|token| token.kind() != TokenKind::Whitespace);
    let (Some(first), Some(second)) = (line.next(), line.next()) else {
        return false;
    };
    match first.kind() {
        TokenKind::LeftSquareBracket => word(second),
        // In an inline table such a line may be one of its keys.
        _ if within == Some(TokenKind::LeftCurlyBracket) => false,
        _ => word(first) && matches!(second.kind(), TokenKind::Equals | TokenKind::Dot),
    }
}

/// Stands for a header that is faulty, so that the keys below it are parsed all the same. What
/// they are for is not known.
pub(super) const UNKNOWN_SECTION: &str = "_";

/// The text with some statements made blank, all others at their places.
pub(super) fn without(text: &str, statements: &[Statement], faulty: &[bool]) -> String {
    let stand_in = format!("[[{UNKNOWN_SECTION}]]");
    let mut bytes = text.as_bytes().to_vec();
    let mut orphaned = false;
    for (statement, &faulty) in statements.iter().zip(faulty) {
        if statement.is_header {
            orphaned = false;
        }
        if !faulty && !orphaned {
            continue;
        }
        let statement_bytes = &mut bytes[statement.range.clone()];
        for byte in statement_bytes.iter_mut().filter(|byte| **byte != b'\n') {
            *byte = b' ';
        }
        if statement.is_header {
            let line = statement_bytes.iter().position(|&byte| byte == b'\n');
            let room = line.unwrap_or(statement_bytes.len());
            orphaned = room < stand_in.len();
            if !orphaned {
                statement_bytes[..stand_in.len()].copy_from_slice(stand_in.as_bytes());
            }
        }
    }
    // Statements begin and end at token boundaries, so what is left is whole characters.
    String::from_utf8(bytes).unwrap_or_default()
}

/// Reports the statements that the parser must not see, and tells which they are.
pub(super) fn refuse(statements: &[Statement], source: &Arc<Source>, faults: &mut Collector) -> Vec<bool> {
    for statement in statements {
        if let Some((span, what, mend)) = &statement.refused {
            let place = Place::new(source, span.clone());
            faults.push(&place, || ((*what).to_owned(), (*mend).to_owned()));
        }
    }
    statements.iter().map(|statement| statement.refused.is_some()).collect()
}
