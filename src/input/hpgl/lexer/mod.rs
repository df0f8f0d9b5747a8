//! Lexer: converts HPGL text to instructions and numbers on demand.

use std::fmt;
use std::ops::Range;

use crate::input::{Fault, brief};

mod escape;

const ESC: u8 = 0x1b;
const ETX: u8 = 0x03;

/// Greatest absolute value of a number in the text: that of HPGL/2.
const LARGEST: f64 = 1_073_741_824.0;

/// Two letters of an instruction, in upper case.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Mnemonic(pub(super) [u8; 2]);

impl Mnemonic {
    pub(super) fn as_str(&self) -> &str {
        str::from_utf8(&self.0).unwrap_or_default()
    }
}

impl fmt::Display for Mnemonic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl fmt::Debug for Mnemonic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// Item of the text at the position of an instruction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Item {
    /// Instruction; its parameters come next.
    Instruction(Mnemonic),
    /// Maker's own instruction, after an exclamation mark; its parameters come next.
    Maker(Mnemonic),
    /// Escape sequence, already skipped; identified by the character after ESC.
    Escape(char),
    /// Line of printer job language, already skipped.
    Job,
    /// Text that is not an instruction, already skipped up to the next possible one; its first
    /// character.
    Noise(char),
}

/// Position in the text: number of bytes before it, and its line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place(usize, usize);

pub(super) struct Lexer<'a> {
    file: &'a str,
    text: &'a [u8],
    lenient: bool,
    at: usize,
    line: usize,
    /// Line of the current instruction.
    start: usize,
    /// Position of its name.
    name: Range<usize>,
    /// Position of the last number, and its line.
    last: (Range<usize>, usize),
    /// Name of the current instruction in faults.
    field: String,
    /// True while the text belongs to a printer, up to the next escape sequence.
    printer: bool,
    /// Terminator of a label.
    terminator: u8,
}

impl<'a> Lexer<'a> {
    /// Creates a lexer; with `lenient`, invalid text becomes an [`Item::Noise`] instead of a
    /// fault.
    pub(super) fn new(file: &'a str, text: &'a [u8], lenient: bool) -> Self {
        Self {
            file,
            text: text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text),
            lenient,
            at: 0,
            line: 1,
            start: 1,
            name: 0..0,
            last: (0..0, 0),
            field: String::new(),
            printer: false,
            terminator: ETX,
        }
    }

    /// Returns the current line, from 1. CR, LF, CR LF and CR CR LF each end a line.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// Returns the line in which the current instruction begins.
    pub(super) fn start(&self) -> usize {
        self.start
    }

    /// Returns the next instruction; `None` at the end of the text. Skips separators between
    /// instructions.
    pub(super) fn item(&mut self) -> Result<Option<Item>, Fault> {
        if self.printer {
            while self.take_if(|byte| byte != ESC).is_some() {}
        }
        let separator = |byte| byte == b';' || byte == b',' || is_space(byte);
        while self.take_if(separator).is_some() {}
        self.start = self.line;
        let begin = self.at;
        let Some(byte) = self.bump() else {
            return Ok(None);
        };
        (self.name, self.last) = (begin..self.at, (0..0, 0));
        match byte {
            ESC => return Ok(Some(Item::Escape(self.escape()))),
            b'@' => {
                while self.take_if(|byte| byte != b'\n').is_some() {}
                return Ok(Some(Item::Job));
            }
            _ => {}
        }
        self.field.clear();
        let maker = byte == b'!';
        let first = if maker { self.peek() } else { Some(byte) };
        let second = self.text.get(self.at + usize::from(maker)).copied();
        let (Some(first), Some(second)) = (first, second) else {
            return self.noise(byte).map(Some);
        };
        if !(first.is_ascii_alphabetic() && second.is_ascii_alphabetic()) {
            return self.noise(byte).map(Some);
        }
        self.at += 1 + usize::from(maker);
        self.name.end = self.at;
        let mnemonic = Mnemonic([first, second].map(|byte| byte.to_ascii_uppercase()));
        if maker {
            self.field.push('!');
        }
        self.field.push_str(mnemonic.as_str());
        Ok(Some(match maker {
            true => Item::Maker(mnemonic),
            false => Item::Instruction(mnemonic),
        }))
    }

    /// Handles text that is not an instruction.
    fn noise(&mut self, byte: u8) -> Result<Item, Fault> {
        let shown = char::from(byte);
        if self.lenient {
            let inner = |byte: u8| !byte.is_ascii_alphabetic() && byte != b';' && byte != ESC;
            while self.take_if(inner).is_some() {}
            return Ok(Item::Noise(shown));
        }
        self.field = format!("'{}'", shown.escape_default());
        let allowed = "instructions of two letters, such as PD";
        Err(self.fault_here("no instruction starts with it", allowed))
    }

    /// Returns the next parameter of the instruction; `None` at its end. Commas, white space and
    /// signs separate parameters; a comma may come before the first and after the last. The
    /// instruction ends at a semicolon, the next instruction or the end of the text.
    pub(super) fn number(&mut self) -> Result<Option<f64>, Fault> {
        self.skip_space();
        if self.take_if(|byte| byte == b',').is_some() {
            self.skip_space();
            if self.lenient {
                while self
                    .take_if(|byte| byte == b',' || is_space(byte))
                    .is_some()
                {}
            }
        }
        match self.peek() {
            Some(b'0'..=b'9' | b'+' | b'-' | b'.') => self.literal().map(Some),
            None | Some(b';' | ESC | b'!' | b'@' | b'A'..=b'Z' | b'a'..=b'z') => {
                self.take_if(|byte| byte == b';');
                Ok(None)
            }
            Some(byte) => {
                self.last = (self.at..self.at + 1, self.line);
                let shown = char::from(byte).escape_default();
                Err(self.fault_here(format!("'{shown}' in place of a number"), NUMBER))
            }
        }
    }

    fn literal(&mut self) -> Result<f64, Fault> {
        let start = self.at;
        self.take_if(|byte| byte == b'+' || byte == b'-');
        let digit = |byte: u8| byte.is_ascii_digit() || byte == b'.';
        while self.take_if(digit).is_some() {}
        self.last = (start..self.at, self.line);
        let digits = self.text.get(start..self.at).unwrap_or_default();
        let text = String::from_utf8_lossy(digits);
        let Ok(value) = text.parse::<f64>() else {
            return Err(self.fault_here(format!("{} is not a number", brief(&text)), NUMBER));
        };
        if let Some([b'e' | b'E', b'0'..=b'9' | b'+' | b'-']) = self.text.get(self.at..self.at + 2)
        {
            let problem = format!("{} has an exponent", brief(&text));
            return Err(self.fault_here(problem, NUMBER));
        }
        if value.abs() > LARGEST {
            let problem = format!("{} is out of range", brief(&text));
            return Err(self.fault_here(problem, format!("-{LARGEST} to {LARGEST}")));
        }
        Ok(value)
    }

    /// Skips the parameters of an instruction, including quoted text.
    pub(super) fn skip_parameters(&mut self) -> Result<(), Fault> {
        loop {
            match self.peek() {
                None | Some(ESC | b'A'..=b'Z' | b'a'..=b'z' | b'!' | b'@') => return Ok(()),
                Some(b'"') => {
                    self.bump();
                    self.through(b'"', "no closing quote")?;
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

    /// Returns the text of a label, without its terminator.
    pub(super) fn label(&mut self) -> Result<&'a [u8], Fault> {
        self.through(self.terminator, "no label terminator after it")
    }

    /// Skips a quoted text and its end, or else all bytes up to a semicolon.
    pub(super) fn skip_text(&mut self) -> Result<(), Fault> {
        self.skip_space();
        match self.peek() {
            Some(b'"') => self.skip_parameters(),
            _ => self.through(b';', "no semicolon after it").map(|_| ()),
        }
    }

    /// Returns the next byte of an encoded polyline with its position; `None` at the semicolon
    /// that ends it, which is consumed. Skips white space and control characters.
    ///
    /// # Errors
    ///
    /// Returns an error if the text ends before a semicolon.
    pub(super) fn encoded(&mut self) -> Result<Option<(u8, Place)>, Fault> {
        // Characters 128 to 160 and 255 are skipped like those below 128.
        let skipped = |byte: u8| byte & 0x7f <= b' ' || byte & 0x7f == 0x7f;
        while self.take_if(skipped).is_some() {}
        let missing = "no semicolon after it, to the end of the file";
        let place = Place(self.at, self.line);
        let Some(byte) = self.bump() else {
            return Err(self.fault(missing, "';' at its end"));
        };
        Ok((byte & 0x7f != b';').then_some((byte, place)))
    }

    /// Goes back to a position if the text there begins like an instruction; returns true if it
    /// does.
    pub(super) fn back_to_instruction(&mut self, Place(at, line): Place) -> bool {
        let begins = |bytes: &[u8]| bytes.iter().all(u8::is_ascii_alphabetic);
        let found = self.text.get(at..at + 2).is_some_and(begins);
        if found {
            (self.at, self.line) = (at, line);
        }
        found
    }

    /// Returns a parameter of one character, if there is one before the semicolon, which is
    /// consumed.
    pub(super) fn character(&mut self) -> Result<Option<u8>, Fault> {
        let character = self.take_if(|byte| byte != b';');
        self.skip_parameters()?;
        Ok(character)
    }

    /// Reads the terminator of labels; ETX by default.
    pub(super) fn label_terminator(&mut self) -> Result<(), Fault> {
        self.terminator = self.character()?.unwrap_or(ETX);
        Ok(())
    }

    /// Resets the label terminator to ETX.
    pub(super) fn reset_terminator(&mut self) {
        self.terminator = ETX;
    }

    /// Returns the text before the byte `end`, which is consumed too.
    fn through(&mut self, end: u8, missing: &str) -> Result<&'a [u8], Fault> {
        let start = self.at;
        while let Some(byte) = self.bump() {
            if byte == end {
                return Ok(self.text.get(start..self.at - 1).unwrap_or_default());
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
        let ends_a_line = match byte {
            b'\n' => true,
            b'\r' => {
                let rest = self.text.get(self.at..).unwrap_or_default();
                !(rest.starts_with(b"\n") || rest.starts_with(b"\r\n"))
            }
            _ => false,
        };
        self.line += usize::from(ends_a_line);
        Some(byte)
    }

    /// Adds the position in the line to a fault: the last number, or the instruction.
    pub(super) fn marked(&self, fault: Fault) -> Fault {
        let (number, line) = &self.last;
        match fault.line {
            at if at == *line => fault.marked(self.text, number),
            at if at == self.start => fault.marked(self.text, &self.name),
            _ => fault,
        }
    }

    /// Continues after the instruction of a fault.
    pub(super) fn recover(&mut self) {
        let encoded = self.field == "PE";
        let letters = |pair: &[u8]| pair.iter().all(u8::is_ascii_alphabetic);
        while let Some(byte) = self.peek() {
            let next = self.text.get(self.at..self.at + 2);
            if byte == ESC || (!encoded && next.is_some_and(letters)) {
                return;
            }
            self.bump();
            if byte == b';' {
                return;
            }
        }
    }

    /// Returns a fault of the instruction as a whole.
    pub(super) fn fault(&self, problem: impl Into<String>, allowed: impl Into<String>) -> Fault {
        Fault::new(self.file, self.start, self.field.as_str(), problem, allowed)
    }

    /// Returns a fault at the current line.
    pub(super) fn fault_here(
        &self,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Fault {
        Fault::new(self.file, self.line, self.field.as_str(), problem, allowed)
    }
}

const NUMBER: &str = "decimal numbers such as -12.5, separated by commas or spaces";

/// True for white space, and control characters that serial lines and old systems leave in files.
fn is_space(byte: u8) -> bool {
    (byte <= b' ' && byte != ESC) || byte == 0x7f
}
