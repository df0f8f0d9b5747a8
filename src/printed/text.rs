//! Comments of printed modules, and their lines.

use crate::netlist::{Format, Signal};
use std::fmt::Write as _;

/// The length of a line, and the room that a comment has at least.
pub(crate) const LINE: usize = 100;
const SHORTEST: usize = 32;

/// Returns lines with comments behind them, in a column of their own; a comment begins with `mark`.
pub(crate) fn annotated(lines: &[(String, String)], mark: &str) -> Vec<String> {
    let width = lines.iter().map(|(line, _)| line.len()).max().unwrap_or(0) + 1;
    let room = LINE.saturating_sub(width + 3).max(SHORTEST);
    let mut annotated = Vec::new();
    for (line, comment) in lines {
        let mut start = line.as_str();
        let mut text = String::new();
        for word in comment.split(' ').filter(|word| !word.is_empty()) {
            if !text.is_empty() && text.len() + 1 + word.len() > room {
                annotated.push(format!("{start:width$}{mark}{text}"));
                (start, text) = ("", String::new());
            }
            text.push(' ');
            text.push_str(word);
        }
        annotated.push(match text.is_empty() {
            true => start.to_owned(),
            false => format!("{start:width$}{mark}{text}"),
        });
    }
    annotated
}

/// Returns the comment of a signal: its doc line and the names of its states.
pub(crate) fn comment(signal: &Signal) -> String {
    let mut comment = clean(signal.field.doc);
    if let Format::States(states) = signal.field.format {
        let states = states
            .iter()
            .enumerate()
            .map(|(value, state)| format!("{value} {state}"));
        let states: Vec<String> = states.collect();
        let _ = write!(comment, " {}.", states.join(", "));
    }
    ascii(&comment)
}

/// Writes a text in ASCII: signs as in source code, Greek letters by their names, and any other
/// character by its number, as in U+00E9.
pub(crate) fn ascii(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let Some(name) = greek(letter) else {
            match letter.is_ascii() {
                true => plain.push(letter),
                false => match sign(letter) {
                    Some(sign) => plain.push_str(sign),
                    // Writing to a string does not fail.
                    None => drop(write!(plain, "U+{:04X}", u32::from(letter))),
                },
            }
            continue;
        };
        if plain.ends_with(|before: char| before.is_ascii_alphanumeric()) {
            plain.push(' ');
        }
        plain.push_str(name);
        if letters.peek().is_some_and(|next| next.is_alphanumeric()) {
            plain.push(' ');
        }
    }
    plain
}

fn greek(letter: char) -> Option<&'static str> {
    Some(match letter {
        'Δ' => "Delta",
        'Σ' => "Sigma",
        'α' => "alpha",
        'δ' => "delta",
        'θ' => "theta",
        'ν' => "nu",
        'π' => "pi",
        'σ' => "sigma",
        'φ' => "phi",
        'ω' => "omega",
        _ => return None,
    })
}

fn sign(sign: char) -> Option<&'static str> {
    Some(match sign {
        '−' | '–' | '—' | '‑' | '⁻' => "-",
        '⁺' => "+",
        '·' => "*",
        '×' => "x",
        '÷' => "/",
        '±' => "+-",
        '≤' => "<=",
        '≥' => ">=",
        '≠' => "!=",
        '…' => "...",
        '′' | '’' | '‘' => "'",
        '²' => "^2",
        '³' => "^3",
        '⁴' => "^4",
        '°' => " degrees",
        'µ' | 'μ' => "u",
        '½' => "1/2",
        '→' => "->",
        _ => return None,
    })
}

/// A doc comment in one line, without the marks of a link.
pub(crate) fn clean(doc: &str) -> String {
    let words: Vec<&str> = doc.split_whitespace().collect();
    ascii(&words.join(" "))
        .replace("[`", "")
        .replace("`]", "")
        .replace('`', "")
}

/// Lines of a module, indented by one step.
pub(crate) struct Body {
    text: String,
    mark: &'static str,
}

impl Body {
    /// Begins without lines; comments begin with `mark`.
    pub(crate) fn new(mark: &'static str) -> Self {
        Body {
            text: String::new(),
            mark,
        }
    }

    pub(crate) fn line(&mut self, line: &str) {
        self.text.push_str("    ");
        self.raw(line);
    }

    pub(crate) fn raw(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    pub(crate) fn comment(&mut self, comment: &str) {
        if !comment.is_empty() {
            self.line(&format!("{} {comment}", self.mark));
        }
    }

    pub(crate) fn described(&mut self, signal: &Signal, line: &str) {
        self.comment(&comment(signal));
        self.line(line);
    }

    /// One empty line, if something stands before it.
    pub(crate) fn space(&mut self) {
        if !self.text.is_empty() && !self.text.ends_with("\n\n") {
            self.text.push('\n');
        }
    }

    pub(crate) fn finish(mut self) -> String {
        self.space();
        self.text
    }
}

#[cfg(test)]
mod tests {
    use super::ascii;

    #[test]
    fn signs_letters_and_what_has_no_other_form() {
        for (text, plain) in [
            ("2^width, x[3:0]", "2^width, x[3:0]"),
            ("v²/2a ≤ −1·Δt", "v^2/2a <= -1*Delta t"),
            ("2π", "2 pi"),
            ("θ is 90°", "theta is 90 degrees"),
            ("0.5 µm … 1 μm", "0.5 um ... 1 um"),
            ("é€", "U+00E9U+20AC"),
        ] {
            assert_eq!(ascii(text), plain);
        }
    }
}
