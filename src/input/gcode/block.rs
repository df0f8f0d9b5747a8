//! Parser of a line of G-code into words.

use super::expression::{Name, Scanner, Values};
use super::polar::Polar;
use super::problem::Problem;
use crate::input::brief;

/// Greatest absolute value of a word; no larger one makes sense.
const LARGEST: f64 = 1.0e9;

const WORDS: &str = "words of a letter and a number, such as X10.5";

/// Number of a G or M word: G91.1 is (91, 1).
pub(super) type Code = (u32, u32);

/// Words of one line.
#[derive(Debug, Default)]
pub(super) struct Block {
    /// G words.
    pub(super) g: Vec<Code>,
    /// M words.
    pub(super) m: Vec<Code>,
    letters: [Option<f64>; 26],
    /// Words `@` and `^`.
    polar: Polar,
    /// Parameters to set after the line was read.
    pub(super) sets: Vec<(Name, f64)>,
    /// True if the line begins with `/`.
    pub(super) optional: bool,
    /// True if the line has an E.
    pub(super) extruder: bool,
    /// True if the line has a word other than N.
    pub(super) any: bool,
    /// Letters without a number, one bit each.
    bare: u32,
    /// True for an I without a number beside S, or M3 to M5: inline power of lasers.
    pub(super) inline: bool,
    /// Problem of an E after a number that may be its exponent or a word.
    unclear: Option<Problem>,
    extruders: usize,
}

impl Block {
    /// Parses a cleaned line into this block.
    ///
    /// An E directly after the value of a word, before a whole number, is an exponent or an axis.
    /// If there is a second E, which no axis has, it is an exponent. Otherwise it is read as an
    /// axis, and [`Block::take_unclear`] reports it.
    ///
    /// # Errors
    ///
    /// Returns an error for invalid words, and values that cannot be computed.
    pub(super) fn read(&mut self, line: &[u8], values: &dyn Values) -> Result<(), Problem> {
        let read = self.read_words(line, values, false);
        if self.unclear.is_some() && self.extruders > 1 {
            return self.read_words(line, values, true);
        }
        read
    }

    fn read_words(
        &mut self,
        line: &[u8],
        values: &dyn Values,
        exponents: bool,
    ) -> Result<(), Problem> {
        self.g.clear();
        self.m.clear();
        self.sets.clear();
        (self.letters, self.polar) = ([None; 26], Polar::default());
        (self.extruder, self.any) = (false, false);
        (self.bare, self.unclear, self.extruders) = (0, None, 0);
        self.inline = false;
        let mut scanner = Scanner::new(line);
        self.optional = line_start(&mut scanner)?;
        while let Some(letter) = scanner.next_word() {
            // Checksum sent by hosts of printers.
            if letter == b'*' {
                break;
            }
            self.any = true;
            let begin = scanner.at();
            scanner.bump();
            let read = match letter {
                b'#' => self.set(&mut scanner, values),
                b'A'..=b'Z' => self.word(letter, &mut scanner, values, exponents),
                b'@' => self.polar_word(0, '@', &mut scanner, values),
                b'^' => self.polar_word(1, '^', &mut scanner, values),
                _ => {
                    let field = format!("{}{}", char::from(letter), scanner.rest_text());
                    Err(Problem::new(brief(&field), "not a word", WORDS))
                }
            };
            read.map_err(|problem| problem.at(begin..scanner.at()))?;
        }
        Ok(())
    }

    /// Parses the assignment of a parameter.
    fn set(&mut self, scanner: &mut Scanner<'_>, values: &dyn Values) -> Result<(), Problem> {
        let name = scanner.parameter(values)?;
        if !scanner.take("=") {
            let allowed = "#1=2";
            return Err(Problem::new(name.to_string(), "without =", allowed));
        }
        let value = scanner.value_with_exponent(values)?;
        self.sets.push((name, value));
        Ok(())
    }

    /// Parses a radius or an angle.
    fn polar_word(
        &mut self,
        index: usize,
        field: char,
        scanner: &mut Scanner<'_>,
        values: &dyn Values,
    ) -> Result<(), Problem> {
        let value = in_range(field, scanner.value(values)?)?;
        let place = self.polar.get_mut(index);
        match place.and_then(|place| place.replace(value)) {
            Some(_) => Err(twice(field)),
            None => Ok(()),
        }
    }

    fn word(
        &mut self,
        letter: u8,
        scanner: &mut Scanner<'_>,
        values: &dyn Values,
        exponents: bool,
    ) -> Result<(), Problem> {
        let field = char::from(letter);
        let begin = scanner.at();
        match scanner.next_word() {
            Some(b'0'..=b'9' | b'.' | b'+' | b'-' | b'#' | b'[') => {}
            Some(b'A'..=b'Z') if function(scanner.rest()) => {}
            // Printers take a letter alone as a flag, as in G28 X.
            _ if self.flags(letter) => {
                self.bare |= bit(letter);
                return self.put(letter, 0.0);
            }
            next if letter == b'I' && self.is_power(next) => {
                self.inline = true;
                return Ok(());
            }
            _ => {
                let problem = "a letter without its number, or out of place";
                return Err(Problem::new(field, problem, WORDS));
            }
        }
        // There cannot be a second axis E.
        let exponents = letter == b'E' || (exponents && has_exponent(letter));
        let value = match exponents {
            true => scanner.value_with_exponent(values),
            false => scanner.value(values),
        };
        let value = value.map_err(|problem| Problem {
            field: if problem.field == "number" {
                field.into()
            } else {
                problem.field
            },
            ..problem
        })?;
        let value = in_range(field, value)?;
        self.look_for_exponent(letter, begin, value, scanner);
        match letter {
            b'G' => self.g.push(code(field, value)?),
            b'M' => self.m.push(code(field, value)?),
            b'N' => {}
            b'E' => {
                self.extruder = true;
                self.extruders += 1;
                return self.put(letter, value);
            }
            _ => return self.put(letter, value),
        }
        Ok(())
    }

    /// Remembers an E after a number whose value would differ if it is an exponent.
    fn look_for_exponent(&mut self, letter: u8, begin: usize, value: f64, scanner: &Scanner<'_>) {
        let written = scanner.since(begin);
        let Some(length) = scanner.exponent() else {
            return;
        };
        let exponent = scanner.rest().get(..length).unwrap_or_default();
        let exponent = String::from_utf8_lossy(exponent);
        let zero = exponent.bytes().all(|byte| !matches!(byte, b'1'..=b'9'));
        if has_exponent(letter) && value != 0.0 && !zero && self.unclear.is_none() {
            let field = char::from(letter);
            let problem = format!("{written}{exponent}: an exponent, or an axis E");
            let allowed = format!("{field}{written} {exponent}, or a number without an exponent");
            let at = begin..begin + written.len() + length;
            self.unclear = Some(Problem::new(field, problem, allowed).at(at));
        }
    }

    /// Takes the problem of an E that may be an exponent.
    pub(super) fn take_unclear(&mut self) -> Option<Problem> {
        self.unclear.take()
    }

    fn put(&mut self, letter: u8, value: f64) -> Result<(), Problem> {
        let index = usize::from(letter.wrapping_sub(b'A'));
        let Some(place) = self.letters.get_mut(index) else {
            return Ok(());
        };
        match place.replace(value) {
            Some(_) => Err(twice(char::from(letter))),
            None => Ok(()),
        }
    }

    /// Sets a letter unconditionally.
    pub(super) fn place(&mut self, letter: u8, value: f64) {
        let index = usize::from(letter.wrapping_sub(b'A'));
        if let Some(place) = self.letters.get_mut(index) {
            *place = Some(value);
        }
    }

    /// True if a letter may be without a number: in G28 and with M words of printers.
    fn flags(&self, letter: u8) -> bool {
        let homes = self.g.iter().any(|code| matches!(code.0, 28 | 29));
        let printer = self.m.iter().any(|code| code.0 >= 17);
        !matches!(letter, b'G' | b'M' | b'N') && (homes || printer)
    }

    /// True if an I without a number is inline power; `next` is the next letter.
    fn is_power(&self, next: Option<u8>) -> bool {
        let spindle = self.m.iter().any(|code| matches!(code, (3..=5, 0)));
        spindle || next == Some(b'S') || self.letter(b'S').is_some()
    }

    /// Returns the value of a letter.
    pub(super) fn letter(&self, letter: u8) -> Option<f64> {
        let index = usize::from(letter.wrapping_sub(b'A'));
        self.letters.get(index).copied().flatten()
    }

    /// Removes a letter and returns its value.
    pub(super) fn take(&mut self, letter: u8) -> Option<f64> {
        let index = usize::from(letter.wrapping_sub(b'A'));
        self.letters.get_mut(index).and_then(Option::take)
    }

    /// Returns X, Y and Z.
    pub(super) fn axes(&self) -> [Option<f64>; 3] {
        [b'X', b'Y', b'Z'].map(|letter| self.letter(letter))
    }

    /// True if there is an axis word; W is removed before if it is not an axis.
    pub(super) fn moves(&self) -> bool {
        self.axes().iter().any(Option::is_some) || self.letter(b'W').is_some() || self.is_polar()
    }

    /// True if there is a radius or an angle.
    pub(super) fn is_polar(&self) -> bool {
        self.polar.iter().any(Option::is_some)
    }

    /// Removes radius and angle and returns them.
    pub(super) fn take_polar(&mut self) -> Polar {
        std::mem::take(&mut self.polar)
    }

    /// Returns the letters of the line.
    pub(super) fn given(&self) -> impl Iterator<Item = u8> + '_ {
        (b'A'..=b'Z').filter(|&letter| self.letter(letter).is_some())
    }

    /// Removes all letters.
    pub(super) fn clear_letters(&mut self) {
        (self.letters, self.polar) = ([None; 26], Polar::default());
        self.unclear = None;
    }

    /// True if a letter has no number.
    pub(super) fn is_bare(&self, letter: u8) -> bool {
        self.bare & bit(letter) != 0
    }

    /// Removes the letters without a number.
    pub(super) fn clear_bare(&mut self) {
        for letter in b'A'..=b'Z' {
            if self.is_bare(letter) {
                self.take(letter);
            }
        }
    }
}

fn in_range(field: char, value: f64) -> Result<f64, Problem> {
    if value.abs() <= LARGEST {
        return Ok(value);
    }
    let problem = format!("{} is out of range", brief(&value.to_string()));
    Err(Problem::new(field, problem, "-1000000000 to 1000000000"))
}

fn twice(field: char) -> Problem {
    let allowed = "each of these letters once in a line";
    Problem::new(field, "twice in one line", allowed)
}

fn bit(letter: u8) -> u32 {
    1 << (letter.wrapping_sub(b'A') % 32)
}

/// True if the number of a word may have an exponent; the number of a code has none.
fn has_exponent(letter: u8) -> bool {
    !matches!(letter, b'G' | b'M' | b'N' | b'O' | b'T')
}

/// Skips `/` and the line number; returns true if there was a `/`.
///
/// # Errors
///
/// Returns an error for an N without a number.
pub(super) fn line_start(scanner: &mut Scanner<'_>) -> Result<bool, Problem> {
    let mut optional = false;
    loop {
        match scanner.next_word() {
            Some(b'/') => {
                optional = true;
                scanner.bump();
                // Some controls number the switches of optional lines.
                scanner.digits();
            }
            Some(b'N') => {
                scanner.bump();
                if !matches!(scanner.next_word(), Some(b'0'..=b'9' | b'.')) {
                    let problem = "a letter without its number, or out of place";
                    return Err(Problem::new("N", problem, "N and a number without a sign"));
                }
                scanner.number()?;
            }
            _ => return Ok(optional),
        }
    }
}

fn function(rest: &[u8]) -> bool {
    const NAMES: [&str; 14] = [
        "ABS[", "ACOS[", "ASIN[", "ATAN[", "COS[", "EXISTS[", "EXP[", "FIX[", "FUP[", "LN[",
        "ROUND[", "SIN[", "SQRT[", "TAN[",
    ];
    NAMES.iter().any(|name| rest.starts_with(name.as_bytes()))
}

/// Converts the number of a G or M word, from 0 to 99999 with one decimal.
fn code(letter: char, value: f64) -> Result<Code, Problem> {
    let tenths = (value * 10.0).round();
    if !(0.0..=999_999.0).contains(&tenths) || (value * 10.0 - tenths).abs() > 1.0e-3 {
        let problem = format!("{value} is not the number of a code");
        let allowed = "a whole number, or one with one decimal";
        return Err(Problem::new(letter, problem, allowed));
    }
    let tenths = tenths as u32;
    Ok((tenths / 10, tenths % 10))
}

/// Returns a code as written.
pub(super) fn name(letter: char, (whole, tenths): Code) -> String {
    match tenths {
        0 => format!("{letter}{whole}"),
        _ => format!("{letter}{whole}.{tenths}"),
    }
}
