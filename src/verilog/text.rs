use crate::hdl::netlist::Signal;
use crate::hdl::{Format, Kind, Shape};
use std::fmt::Write as _;

/// The length of a line, and the room that a comment has at least.
pub(super) const LINE: usize = 100;
const SHORTEST: usize = 32;

/// `signed` and the range of a word, with a space behind.
pub(super) fn range(shape: Shape) -> String {
    let signed = if shape.kind == Kind::Signed {
        "signed "
    } else {
        ""
    };
    match shape.width {
        1 => signed.to_owned(),
        width => format!("{signed}[{}:0] ", width - 1),
    }
}

/// The room that the ranges of such words take.
pub(super) fn column(shapes: impl Iterator<Item = Shape>) -> usize {
    shapes.map(|shape| range(shape).len()).max().unwrap_or(0)
}

/// Lines with comments behind them, in a column of their own.
pub(super) fn annotated(lines: &[(String, String)]) -> Vec<String> {
    let width = lines.iter().map(|(line, _)| line.len()).max().unwrap_or(0) + 1;
    let room = LINE.saturating_sub(width + 3).max(SHORTEST);
    let mut annotated = Vec::new();
    for (line, comment) in lines {
        let mut start = line.as_str();
        let mut text = String::new();
        for word in comment.split(' ').filter(|word| !word.is_empty()) {
            if !text.is_empty() && text.len() + 1 + word.len() > room {
                annotated.push(format!("{start:width$}//{text}"));
                (start, text) = ("", String::new());
            }
            text.push(' ');
            text.push_str(word);
        }
        annotated.push(match text.is_empty() {
            true => start.to_owned(),
            false => format!("{start:width$}//{text}"),
        });
    }
    annotated
}

/// What is said of a signal: its doc comment and the names of its states.
pub(super) fn comment(signal: &Signal) -> String {
    let mut comment = clean(signal.field.doc);
    if let Format::States(states) = signal.field.format {
        let states = states
            .iter()
            .enumerate()
            .map(|(value, state)| format!("{value} {state}"));
        let states: Vec<String> = states.collect();
        let _ = write!(comment, " {}.", states.join(", "));
    }
    comment
}

/// A doc comment in one line, without the marks of a link.
pub(super) fn clean(doc: &str) -> String {
    let words: Vec<&str> = doc.split_whitespace().collect();
    words
        .join(" ")
        .replace("[`", "")
        .replace("`]", "")
        .replace('`', "")
}

/// The lines between the ports and the end.
#[derive(Default)]
pub(super) struct Body(String);

impl Body {
    pub(super) fn line(&mut self, line: &str) {
        self.0.push_str("    ");
        self.raw(line);
    }

    pub(super) fn raw(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    pub(super) fn comment(&mut self, comment: &str) {
        if !comment.is_empty() {
            self.line(&format!("// {comment}"));
        }
    }

    pub(super) fn described(&mut self, signal: &Signal, line: &str) {
        self.comment(&comment(signal));
        self.line(line);
    }

    /// One empty line, if something stands before it.
    pub(super) fn space(&mut self) {
        if !self.0.is_empty() && !self.0.ends_with("\n\n") {
            self.0.push('\n');
        }
    }

    pub(super) fn finish(mut self) -> String {
        self.space();
        self.0
    }
}
