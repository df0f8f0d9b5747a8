//! One line of G-code to its words.
//!
//! The words are found by the `gcode` crate. It gets one line at a time, without comments, and
//! only after what it would misread was refused; every diagnostic it gives becomes a
//! fault, and values are read again from the text because it only keeps single precision.

use ::gcode::core::{
    BlockVisitor, CommandVisitor, ControlFlow, Diagnostics, Number, ProgramVisitor, Span,
    TokenType, Value,
};

use super::screen::{Problem, check_codes, printable, shown, without_comments};

/// The largest value of a word, either side of zero: beyond it no word makes sense.
const LARGEST: f64 = 1.0e9;

const WORDS: &str = "words of a letter and a number, such as X10.5";

/// The number of a G or M word: G91.1 is (91, 1).
pub(super) type Code = (u32, u32);

/// The words of one line, as written.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Block {
    /// G words.
    pub(super) g: Vec<Code>,
    /// M words.
    pub(super) m: Vec<Code>,
    /// X, Y and Z.
    pub(super) axes: [Option<f64>; 3],
    /// I and J.
    pub(super) centre: [Option<f64>; 2],
    /// R.
    pub(super) radius: Option<f64>,
    /// F.
    pub(super) feed: Option<f64>,
    /// P.
    pub(super) dwell: Option<f64>,
    /// S.
    pub(super) spindle: Option<f64>,
    /// T is there.
    pub(super) tool: bool,
    /// O is there.
    pub(super) program_number: bool,
    /// N is there.
    pub(super) line_number: bool,
    /// `%` is there.
    pub(super) delimiter: bool,
}

impl Block {
    /// A line with nothing but `%`.
    pub(super) fn delimiter() -> Self {
        Self {
            delimiter: true,
            ..Self::default()
        }
    }

    /// Reads a line, without its line feed.
    pub(super) fn read(line: &[u8]) -> Result<Self, Problem> {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let line = without_comments(line)?;
        let line = printable(&line)?;
        check_codes(line)?;
        let mut words = Words {
            line,
            block: Self::default(),
            problem: None,
        };
        ::gcode::core::parse(line, &mut Visitor(&mut words));
        match words.problem {
            Some(problem) => Err(problem),
            None => Ok(words.block),
        }
    }
}

/// What the crate reports about a line.
struct Words<'a> {
    line: &'a str,
    block: Block,
    /// The first one counts.
    problem: Option<Problem>,
}

impl Words<'_> {
    fn refuse(&mut self, field: impl Into<String>, problem: impl Into<String>, allowed: &str) {
        if self.problem.is_none() {
            self.problem = Some(Problem::new(field, problem, allowed));
        }
    }

    fn word(&mut self, letter: char, span: Span) {
        let letter = letter.to_ascii_uppercase();
        let text = self
            .line
            .get(span.start + 1..span.end())
            .unwrap_or_default();
        let Some(value) = number(text) else {
            let problem = format!("{} is not a number", shown(text));
            return self.refuse(letter, problem, "a decimal number");
        };
        if value.abs() > LARGEST {
            let problem = format!("{} is out of range", shown(text));
            return self.refuse(letter, problem, "-1000000000 to 1000000000");
        }
        let [x, y, z] = &mut self.block.axes;
        let [i, j] = &mut self.block.centre;
        let place = match letter {
            'X' => x,
            'Y' => y,
            'Z' => z,
            'I' => i,
            'J' => j,
            'R' => &mut self.block.radius,
            'F' => &mut self.block.feed,
            'P' => &mut self.block.dwell,
            'S' => &mut self.block.spindle,
            _ => {
                let allowed = "the letters F G I J M N O P R S T X Y Z";
                return self.refuse(letter, "not a word of these machines", allowed);
            }
        };
        if place.replace(value).is_some() {
            self.refuse(
                letter,
                "twice in one line",
                "each of these letters once in a line",
            );
        }
    }
}

/// The value of a word at full precision; blanks may stand around the sign.
fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text).trim_start();
    let value: f64 = digits.parse().ok()?;
    Some(if text.starts_with('-') { -value } else { value })
}

/// Drives [`Words`] from the crate's callbacks: the same for a program, a line and a code.
struct Visitor<'v, 'a>(&'v mut Words<'a>);

impl<'a> Visitor<'_, 'a> {
    fn again(&mut self) -> Visitor<'_, 'a> {
        Visitor(self.0)
    }
}

impl Diagnostics for Visitor<'_, '_> {
    fn emit_unknown_content(&mut self, text: &str, _: Span) {
        self.0.refuse(shown(text), "not a word", WORDS);
    }

    fn emit_unexpected(&mut self, actual: &str, _: &[TokenType], _: Span) {
        self.0.refuse(
            shown(actual),
            "a letter without its number, or out of place",
            WORDS,
        );
    }

    fn emit_parse_int_error(&mut self, value: &str, _: std::num::ParseIntError, _: Span) {
        self.0
            .refuse(shown(value), "not a line number", "0 to 4294967295");
    }
}

impl ProgramVisitor for Visitor<'_, '_> {
    fn start_block(&mut self) -> ControlFlow<impl BlockVisitor + '_> {
        ControlFlow::Continue(self.again())
    }
}

impl BlockVisitor for Visitor<'_, '_> {
    fn line_number(&mut self, _: u32, _: Span) {
        self.0.block.line_number = true;
    }

    fn program_number(&mut self, _: u32, _: Span) {
        self.0.block.program_number = true;
    }

    fn program_delimiter(&mut self, _: Span) {
        self.0.block.delimiter = true;
    }

    fn word_address(&mut self, letter: char, _: Value<'_>, span: Span) {
        self.0.word(letter, span);
    }

    fn start_general_code(&mut self, number: Number) -> ControlFlow<impl CommandVisitor + '_> {
        self.0.block.g.push(code(number));
        ControlFlow::Continue(self.again())
    }

    fn start_miscellaneous_code(
        &mut self,
        number: Number,
    ) -> ControlFlow<impl CommandVisitor + '_> {
        self.0.block.m.push(code(number));
        ControlFlow::Continue(self.again())
    }

    fn start_tool_change_code(&mut self, _: Number) -> ControlFlow<impl CommandVisitor + '_> {
        self.0.block.tool = true;
        ControlFlow::Continue(self.again())
    }
}

impl CommandVisitor for Visitor<'_, '_> {
    fn argument(&mut self, letter: char, _: Value<'_>, span: Span) {
        self.0.word(letter, span);
    }
}

fn code(number: Number) -> Code {
    (number.major(), number.minor().map_or(0, u32::from))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(line: &str) -> String {
        let Problem { field, problem, .. } = Block::read(line.as_bytes()).unwrap_err();
        format!("{field}: {problem}")
    }

    #[test]
    fn words_come_out_in_full_precision() {
        let block = Block::read(b"n10 g1 x- 1.23456789 Y+.5 (to) f 600\r").unwrap();
        let expected = Block {
            g: vec![(1, 0)],
            axes: [Some(-1.234_567_89), Some(0.5), None],
            feed: Some(600.0),
            line_number: true,
            ..Block::default()
        };
        assert_eq!(block, expected);
    }

    #[test]
    fn comments_are_blanks_whatever_their_bytes() {
        let block = Block::read(b"(\xe9 G99999999999)X1(a)Y2;Z3 (").unwrap();
        assert_eq!(block.axes, [Some(1.0), Some(2.0), None]);
        assert_eq!(refused("X1 (open"), "comment: no closing )");
        assert_eq!(refused("(a (b) X1"), "comment: another ( inside a comment");
        assert_eq!(
            refused("X1(a)2"),
            "2: a letter without its number, or out of place"
        );
    }

    #[test]
    fn what_is_no_word_is_refused() {
        for line in [
            "X", "X-", "5", "#1=2", "X#1", "X[1+2]", "/X1", "G1 N5", "N-1", "G", "GX1",
        ] {
            assert!(Block::read(line.as_bytes()).is_err(), "{line}");
        }
        assert_eq!(refused("X1 X1"), "X: twice in one line");
        assert_eq!(refused("A1"), "A: not a word of these machines");
        assert_eq!(refused("X1\rY1"), "line: a carriage return inside it");
        assert_eq!(
            refused("\u{2000}A1"),
            r"line: the character '\u{2000}' inside it"
        );
        assert_eq!(refused("X2000000000"), "X: 2000000000 is out of range");
    }
}
