//! Faults: errors in input files.

use std::borrow::Cow;
use std::fmt;
use std::iter;
use std::ops::Range;

/// Greatest number of characters that a message quotes from a file.
pub const SHOWN: usize = 1000;

/// Greatest number of characters in a message's list of allowed values.
pub const LISTED: usize = 10_000;

/// Greatest number of faults found in a file before its reader gives up.
pub const MOST_FAULTS: usize = 20;

/// Greatest number of bytes shown of a line before the fault; the same number follows.
const SHOWN_BEFORE: usize = 60;
const SHOWN_FROM: usize = 100;

/// Formats a count of things: "1 field", "2 fields".
pub fn counted(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}

/// Error in an input file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Name of the file as given by the user.
    pub file: String,
    /// Line from 1; 0 for the file as a whole.
    pub line: usize,
    /// Instruction, word or key at fault.
    pub field: String,
    /// Description of the error.
    pub problem: String,
    /// Allowed values.
    pub allowed: String,
    /// Line of the fault, if its position in the line is known.
    pub excerpt: Option<Box<Excerpt>>,
    /// Next fault found in the same file.
    pub next: Option<Box<Fault>>,
}

/// Line of a file, or the part of it around a fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Excerpt {
    /// Text, without control characters, which a terminal would obey.
    pub text: String,
    /// Bytes of the text that are at fault.
    pub marked: Range<usize>,
}

impl Excerpt {
    /// Returns the line in which a range of bytes begins. Lines end in LF or CR.
    fn of(text: &[u8], marked: &Range<usize>) -> Self {
        let ends = |byte: &u8| matches!(byte, b'\n' | b'\r');
        let at = marked.start.min(text.len());
        let (before, from) = text.split_at(at);
        let begin = before.iter().rposition(ends).map_or(0, |end| end + 1);
        let before = before.get(begin..).unwrap_or_default();
        let end = from.iter().position(ends).unwrap_or(from.len());
        let from = from.get(..end).unwrap_or_default();
        let length = marked.len().clamp(1, from.len().max(1)).min(SHOWN_FROM);

        let mut shown = String::new();
        let cut = before.len().saturating_sub(SHOWN_BEFORE);
        if cut > 0 {
            shown.push_str("...");
        }
        push_plain(&mut shown, before.get(cut..).unwrap_or_default());
        let start = shown.len();
        let (marked, after) = from.split_at(length.min(from.len()));
        push_plain(&mut shown, marked);
        let marked = start..shown.len();
        let left = SHOWN_FROM - length;
        push_plain(&mut shown, after.get(..left).unwrap_or(after));
        if after.len() > left {
            shown.push_str("...");
        }
        Excerpt {
            text: shown,
            marked,
        }
    }
}

/// Appends bytes as text, with a blank for each control character.
fn push_plain(to: &mut String, bytes: &[u8]) {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    to.extend(String::from_utf8_lossy(bytes).chars().map(plain));
}

impl std::error::Error for Fault {}

/// Shortens text from a file or an argument to `most` characters, without control characters,
/// which a terminal would obey.
#[must_use]
pub fn shown(text: &str, most: usize) -> Cow<'_, str> {
    let cut = text.char_indices().nth(most).map(|(end, _)| end);
    if cut.is_none() && !text.contains(char::is_control) {
        return Cow::Borrowed(text);
    }
    let mut plain = String::new();
    for character in text[..cut.unwrap_or(text.len())].chars() {
        match character.is_control() {
            true => plain.extend(character.escape_default()),
            false => plain.push(character),
        }
    }
    if let Some(end) = cut {
        plain.push_str(&format!("... ({} bytes more)", text.len() - end));
    }
    Cow::Owned(plain)
}

/// Shortens a word of the input for a message; control characters are shown by name.
pub(super) fn brief(text: &str) -> String {
    let mut chars = text.trim().chars();
    let mut short: String = chars
        .by_ref()
        .take(20)
        .flat_map(char::escape_debug)
        .collect();
    if chars.next().is_some() {
        short.push_str("...");
    }
    short
}

/// Formats this fault alone, on one line.
impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [file, field, problem] =
            [&self.file, &self.field, &self.problem].map(|text| shown(text, SHOWN));
        let allowed = shown(&self.allowed, LISTED);
        match self.line {
            0 => write!(f, "{file}: ")?,
            line => write!(f, "{file}:{line}: ")?,
        }
        write!(f, "{field}: {problem}; allowed: {allowed}")
    }
}

impl Fault {
    /// Creates a fault without an excerpt.
    pub fn new(
        file: &str,
        line: usize,
        field: impl Into<String>,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        Self {
            file: file.to_owned(),
            line,
            field: field.into(),
            problem: problem.into(),
            allowed: allowed.into(),
            excerpt: None,
            next: None,
        }
    }

    /// Adds the line in which a range of bytes of the text begins.
    #[must_use]
    pub(crate) fn marked(self, text: &[u8], marked: &Range<usize>) -> Self {
        Self {
            excerpt: Some(Box::new(Excerpt::of(text, marked))),
            ..self
        }
    }

    /// Returns this fault and those found after it.
    pub fn all(&self) -> impl Iterator<Item = &Fault> {
        iter::successors(Some(self), |fault| fault.next.as_deref())
    }
}

/// Faults found by a reader so far.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    found: Vec<Fault>,
}

impl Faults {
    /// Adds a fault, unless it was found in the same line before. Returns false if there are too
    /// many.
    pub(crate) fn add(&mut self, fault: Fault) -> bool {
        let same = |other: &Fault| {
            (other.line, &other.field, &other.problem) == (fault.line, &fault.field, &fault.problem)
        };
        if !self.found.iter().any(same) {
            self.found.push(fault);
        }
        self.found.len() < MOST_FAULTS
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Returns the value if no fault was found.
    ///
    /// # Errors
    ///
    /// Returns the first fault, which links to the others.
    pub(crate) fn or<T>(self, value: impl FnOnce() -> Result<T, Fault>) -> Result<T, Fault> {
        let mut next = None;
        for fault in self.found.into_iter().rev() {
            next = Some(Box::new(Fault { next, ..fault }));
        }
        match next {
            Some(first) => Err(*first),
            None => value(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_have_an_end_and_nothing_that_a_terminal_obeys() {
        assert_eq!(shown("a \u{e9} b", SHOWN), "a \u{e9} b");
        assert_eq!(
            shown("a\u{1b}[2J\r\n\u{9b}", SHOWN),
            "a\\u{1b}[2J\\r\\n\\u{9b}"
        );
        let long = "\u{e9}".repeat(SHOWN);
        assert_eq!(shown(&long, SHOWN), long);
        let text = shown(&format!("{long}\u{e9}ab"), SHOWN).into_owned();
        assert_eq!(text, format!("{long}... (4 bytes more)"));
        let fault = Fault::new("f\n", 3, "\t".repeat(SHOWN + 1), "p\0", "a\u{7f}");
        let field = "\\t".repeat(SHOWN);
        let text = format!("f\\n:3: {field}... (1 bytes more): p\\u{{0}}; allowed: a\\u{{7f}}");
        assert_eq!(fault.to_string(), text);
    }

    fn excerpt(text: &[u8], marked: Range<usize>) -> (String, String) {
        let Excerpt { text, marked } = Excerpt::of(text, &marked);
        let word = text[marked].to_owned();
        (text, word)
    }

    #[test]
    fn an_excerpt_is_the_line_and_marks_what_is_at_fault() {
        let of = |text: &str, word: &str| (text.to_owned(), word.to_owned());
        assert_eq!(excerpt(b"a\nb cd e\nf", 4..6), of("b cd e", "cd"));
        assert_eq!(excerpt(b"a\rb\tcd\r\nf", 4..6), of("b cd", "cd"));
        // Past the end of its line, and past the end of the text.
        assert_eq!(excerpt(b"ab\ncd", 1..9), of("ab", "b"));
        assert_eq!(excerpt(b"ab", 2..4), of("ab", ""));
        assert_eq!(excerpt(b"", 0..0), of("", ""));
        assert_eq!(
            excerpt(b"a\xff\xffb", 1..3),
            of("a\u{fffd}\u{fffd}b", "\u{fffd}\u{fffd}")
        );
    }

    #[test]
    fn an_excerpt_of_a_long_line_is_what_is_around_the_fault() {
        let line = format!("{}PD1;{}", "a".repeat(1 << 20), "b".repeat(1 << 20));
        let at = 1 << 20;
        let (text, word) = excerpt(line.as_bytes(), at..at + 3);
        assert_eq!(word, "PD1");
        let (before, after) = ("a".repeat(60), "b".repeat(96));
        assert_eq!(text, format!("...{before}PD1;{after}..."));
        assert_eq!(excerpt(line.as_bytes(), at..at + 999).1.len(), 100);
    }

    #[test]
    fn faults_are_told_once_in_their_order_and_have_an_end() {
        let mut faults = Faults::default();
        assert_eq!(Faults::default().or(|| Ok(7)), Ok(7));
        for line in 1..MOST_FAULTS {
            for _ in 0..2 {
                assert!(faults.add(Fault::new("f", line, "X", "bad", "good")));
            }
        }
        assert!(!faults.add(Fault::new("f", 9, "Y", "bad", "good")));
        let fault = faults.or(|| Ok(())).unwrap_err();
        let lines: Vec<usize> = fault.all().map(|fault| fault.line).collect();
        assert_eq!(lines, (1..MOST_FAULTS).chain([9]).collect::<Vec<_>>());
    }
}
