//! HPGL text to instructions and numbers, read as they are asked for.

use std::fmt;

use crate::input::Fault;

const ESC: u8 = 0x1b;
const ETX: u8 = 0x03;

/// The largest number in the text, either side of zero: that of HPGL/2.
const LARGEST: f64 = 1_073_741_824.0;

/// The two letters of an instruction, in upper case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Mnemonic(pub(super) [u8; 2]);

impl fmt::Display for Mnemonic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second] = self.0.map(char::from);
        write!(f, "{first}{second}")
    }
}

/// What stands where an instruction may stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Item {
    /// An instruction; its parameters come next.
    Instruction(Mnemonic),
    /// An escape sequence, already skipped; told apart by the character after ESC.
    Escape(char),
    /// A line of printer job language, already skipped.
    Job,
}

pub(super) struct Lexer<'a> {
    file: &'a str,
    text: &'a [u8],
    at: usize,
    line: usize,
    /// The line of the instruction being read.
    start: usize,
    /// What a fault names.
    field: String,
    /// No parameter of the instruction has been read yet.
    first: bool,
    /// Ends a label.
    terminator: u8,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(file: &'a str, text: &'a [u8]) -> Self {
        Self {
            file,
            text,
            at: 0,
            line: 1,
            start: 1,
            field: String::new(),
            first: true,
            terminator: ETX,
        }
    }

    /// The line reached, from 1. CR, LF and CR LF each end a line.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// The next instruction; `None` at the end of the text.
    pub(super) fn item(&mut self) -> Result<Option<Item>, Fault> {
        while self
            .take_if(|byte| byte == b';' || is_space(byte))
            .is_some()
        {}
        self.start = self.line;
        let Some(byte) = self.bump() else {
            return Ok(None);
        };
        if byte == ESC {
            return Ok(Some(self.escape()));
        }
        if byte == b'@' {
            while self.take_if(|byte| byte != b'\n').is_some() {}
            return Ok(Some(Item::Job));
        }
        self.field = format!("'{}'", char::from(byte).escape_default());
        let letters = match self.peek() {
            Some(second) if byte.is_ascii_alphabetic() && second.is_ascii_alphabetic() => {
                self.bump();
                [byte.to_ascii_uppercase(), second.to_ascii_uppercase()]
            }
            _ => {
                let allowed = "instructions of two letters, such as PD";
                return Err(self.fault_here("no instruction starts with it", allowed));
            }
        };
        let mnemonic = Mnemonic(letters);
        self.field.clear();
        self.field.extend(letters.map(char::from));
        self.first = true;
        Ok(Some(Item::Instruction(mnemonic)))
    }

    /// The next parameter of the instruction; `None` at its end. Commas, white space and signs
    /// separate; the end is a semicolon, the next instruction or the end of the text.
    pub(super) fn number(&mut self) -> Result<Option<f64>, Fault> {
        self.skip_space();
        let comma = !self.first && self.take_if(|byte| byte == b',').is_some();
        if comma {
            self.skip_space();
        }
        self.first = false;
        match self.peek() {
            Some(b'0'..=b'9' | b'+' | b'-' | b'.') => self.literal().map(Some),
            None | Some(b';' | ESC | b'A'..=b'Z' | b'a'..=b'z') if !comma => {
                self.take_if(|byte| byte == b';');
                Ok(None)
            }
            Some(byte) => {
                let shown = char::from(byte).escape_default();
                Err(self.fault_here(format!("'{shown}' in place of a number"), NUMBER))
            }
            None => Err(self.fault_here("no number after the comma", NUMBER)),
        }
    }

    fn literal(&mut self) -> Result<f64, Fault> {
        let start = self.at;
        self.take_if(|byte| byte == b'+' || byte == b'-');
        while self
            .take_if(|byte| byte.is_ascii_digit() || byte == b'.')
            .is_some()
        {}
        let digits = self.text.get(start..self.at).unwrap_or_default();
        let text = String::from_utf8_lossy(digits);
        let Ok(value) = text.parse::<f64>() else {
            return Err(self.fault_here(format!("{} is not a number", shorten(&text)), NUMBER));
        };
        if value.abs() > LARGEST {
            let problem = format!("{} is out of range", shorten(&text));
            return Err(self.fault_here(problem, format!("-{LARGEST} to {LARGEST}")));
        }
        Ok(value)
    }

    /// Skips the parameters of an instruction, quoted text included.
    pub(super) fn skip_parameters(&mut self) -> Result<(), Fault> {
        loop {
            match self.peek() {
                None | Some(ESC | b'A'..=b'Z' | b'a'..=b'z') => return Ok(()),
                Some(b'"') => {
                    self.bump();
                    self.skip_past(b'"', "no closing quote")?;
                }
                Some(byte) => {
                    self.bump();
                    if byte == b';' {
                        return Ok(());
                    }
                }
            }
        }
    }

    /// Skips a label up to its terminator.
    pub(super) fn skip_label(&mut self) -> Result<(), Fault> {
        self.skip_past(self.terminator, "no label terminator after it")
    }

    /// Skips any bytes up to a semicolon.
    pub(super) fn skip_to_semicolon(&mut self) -> Result<(), Fault> {
        self.skip_past(b';', "no semicolon after it")
    }

    /// Skips a parameter that is one character, whatever it is, and then the others.
    pub(super) fn skip_character(&mut self) -> Result<(), Fault> {
        self.take_if(|byte| byte != b';');
        self.skip_parameters()
    }

    /// Reads what is to end labels from here on; without a character that is ETX.
    pub(super) fn label_terminator(&mut self) -> Result<(), Fault> {
        self.terminator = self.take_if(|byte| byte != b';').unwrap_or(ETX);
        self.skip_parameters()
    }

    /// Puts the label terminator back to ETX.
    pub(super) fn reset_terminator(&mut self) {
        self.terminator = ETX;
    }

    /// Skips an escape sequence, the ESC itself already read. `ESC .` is the plotter's own, with
    /// numbers up to a colon; one that starts with a mark has
    /// numbers and small letters up to a capital one.
    fn escape(&mut self) -> Item {
        let kind = self.bump().map_or(' ', char::from);
        match kind {
            '.' => {
                self.bump();
                let rest = self.text.get(self.at..).unwrap_or_default();
                let numbers = rest
                    .iter()
                    .take_while(|&&b| b.is_ascii_digit() || b == b';');
                let length = numbers.count();
                if rest.get(length) == Some(&b':') {
                    self.at += length + 1;
                }
            }
            '!'..='/' => {
                let inner = |byte| matches!(byte, b'0'..=b'9' | b'+' | b'-' | b'.' | b'a'..=b'z');
                while self.take_if(inner).is_some() {}
                self.take_if(|byte| byte == b'@' || byte.is_ascii_uppercase());
            }
            _ => {}
        }
        Item::Escape(kind)
    }

    fn skip_past(&mut self, end: u8, missing: &str) -> Result<(), Fault> {
        while let Some(byte) = self.bump() {
            if byte == end {
                return Ok(());
            }
        }
        let shown = char::from(end).escape_default();
        let problem = format!("{missing}, to the end of the file");
        Err(self.fault(problem, format!("'{shown}' at its end")))
    }

    fn skip_space(&mut self) {
        while self.take_if(is_space).is_some() {}
    }

    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn take_if(&mut self, wanted: impl Fn(u8) -> bool) -> Option<u8> {
        if wanted(self.peek()?) {
            self.bump()
        } else {
            None
        }
    }

    fn bump(&mut self) -> Option<u8> {
        let byte = self.peek()?;
        self.at += 1;
        if byte == b'\n' || (byte == b'\r' && self.peek() != Some(b'\n')) {
            self.line += 1;
        }
        Some(byte)
    }

    /// A fault of the instruction as a whole.
    pub(super) fn fault(&self, problem: impl Into<String>, allowed: impl Into<String>) -> Fault {
        Fault::new(self.file, self.start, self.field.as_str(), problem, allowed)
    }

    fn fault_here(&self, problem: impl Into<String>, allowed: impl Into<String>) -> Fault {
        Fault::new(self.file, self.line, self.field.as_str(), problem, allowed)
    }
}

const NUMBER: &str = "decimal numbers such as -12.5, separated by commas or spaces";

fn is_space(byte: u8) -> bool {
    byte.is_ascii_whitespace()
}

/// A number as a message shows it.
fn shorten(text: &str) -> String {
    match text.char_indices().nth(20) {
        Some((end, _)) => format!("{}...", text.get(..end).unwrap_or_default()),
        None => text.to_owned(),
    }
}
