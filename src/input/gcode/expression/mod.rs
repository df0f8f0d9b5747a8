//! Values: numbers, parameters and expressions in brackets.
//!
//! `**` binds tightest, then `*`, `/` and `MOD`, then `+` and `-`, then `EQ`, `NE`, `GT`, `GE`,
//! `LT` and `LE`, then `AND`, `OR` and `XOR`; equal operators associate to the left. A sign is
//! part of its number: `-2**2` is 4. Angles are in degrees. Comparisons give 1 or 0; `EQ` has a
//! tolerance of 0.0001. `MOD` is never negative. `ROUND` rounds halves away from zero.

use super::problem::Problem;
use crate::input::brief;

/// Greatest nesting depth of brackets, signs and parameters.
const DEEPEST: usize = 64;

/// Tolerance of `EQ` and `NE`.
const EQUAL: f64 = 1.0e-4;

const VALUES: &str = "a number, a parameter or an expression in brackets";

/// Parameter in an expression.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Name {
    /// `#5`.
    Number(u32),
    /// `#<name>`, in upper case; global with a leading `_`.
    Text(String),
}

impl std::fmt::Display for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Name::Number(number) => write!(f, "#{number}"),
            Name::Text(name) => write!(f, "#<{}>", brief(&name.to_ascii_lowercase())),
        }
    }
}

/// Access to the parameters.
pub(super) trait Values {
    /// Returns the value of a parameter; `None` if it was never set.
    ///
    /// # Errors
    ///
    /// Returns an error for an impossible parameter.
    fn value(&self, name: &Name) -> Result<Option<f64>, Problem>;
}

/// Position in a line that [`clean`](super::text::clean) made.
pub(super) struct Scanner<'a> {
    line: &'a [u8],
    at: usize,
    /// True if numbers may have exponents: in brackets, where no word E is possible, and on
    /// request.
    exponents: bool,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(line: &'a [u8]) -> Self {
        Self {
            line,
            at: 0,
            exponents: false,
        }
    }

    /// Returns the next character after a skipped comment.
    pub(super) fn next_word(&mut self) -> Option<u8> {
        while self.peek() == Some(b' ') {
            self.at += 1;
        }
        self.peek()
    }

    /// Returns the position in the line.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    pub(super) fn peek(&self) -> Option<u8> {
        self.line.get(self.at).copied()
    }

    pub(super) fn bump(&mut self) {
        self.at += 1;
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        self.line.get(self.at..).unwrap_or_default()
    }

    /// Returns the text from a position up to here.
    pub(super) fn since(&self, begin: usize) -> String {
        let text = self.line.get(begin..self.at).unwrap_or_default();
        String::from_utf8_lossy(text).into_owned()
    }

    pub(super) fn rest_text(&self) -> String {
        brief(&String::from_utf8_lossy(self.rest()))
    }

    /// Skips a text if it is next.
    pub(super) fn take(&mut self, text: &str) -> bool {
        let found = self.rest().starts_with(text.as_bytes());
        if found {
            self.at += text.len();
        }
        found
    }

    fn run(&mut self, of: impl Fn(u8) -> bool) -> &'a str {
        let rest = self.rest();
        let end = rest.iter().position(|&byte| !of(byte));
        let piece = rest.get(..end.unwrap_or(rest.len())).unwrap_or_default();
        self.at += piece.len();
        std::str::from_utf8(piece).unwrap_or_default()
    }

    /// Reads the letters that are next.
    pub(super) fn letters(&mut self) -> &'a str {
        self.run(|byte| byte.is_ascii_uppercase())
    }

    /// Reads the digits that are next.
    pub(super) fn digits(&mut self) -> &'a str {
        self.run(|byte| byte.is_ascii_digit())
    }

    /// Reads a name between `<` and `>`.
    ///
    /// # Errors
    ///
    /// Returns an error if no such name is next.
    pub(super) fn angled(&mut self) -> Result<String, Problem> {
        let wrong = || Problem::new("<", "a name that is not closed", "a name in <>");
        if !self.take("<") {
            return Err(wrong());
        }
        let name = self.run(|byte| byte != b'>');
        if name.is_empty() || !self.take(">") {
            return Err(wrong());
        }
        Ok(name.to_owned())
    }

    /// Reads a value: a number, a parameter, a function, or an expression in brackets.
    ///
    /// # Errors
    ///
    /// Returns an error if no value is next, or it cannot be computed.
    pub(super) fn value(&mut self, values: &dyn Values) -> Result<f64, Problem> {
        self.operand(values, 0)
    }

    /// Reads the parameter after a `#`.
    ///
    /// # Errors
    ///
    /// Returns an error if no parameter is next.
    pub(super) fn parameter(&mut self, values: &dyn Values) -> Result<Name, Problem> {
        self.parameter_at(values, 0)
    }

    fn parameter_at(&mut self, values: &dyn Values, depth: usize) -> Result<Name, Problem> {
        if self.peek() == Some(b'<') {
            return Ok(Name::Text(self.angled()?));
        }
        let number = self.with_exponents(false, |scanner| scanner.operand(values, depth + 1))?;
        let whole = number.round();
        if (number - whole).abs() > EQUAL || !(1.0..=99_999.0).contains(&whole) {
            let problem = format!("{number} is not the number of a parameter");
            return Err(Problem::new("#", problem, "1 to 5602"));
        }
        Ok(Name::Number(whole as u32))
    }

    /// Reads a value as [`Scanner::value`] does, whose number may have an exponent.
    ///
    /// # Errors
    ///
    /// Returns an error if no value is next, or it cannot be computed.
    pub(super) fn value_with_exponent(&mut self, values: &dyn Values) -> Result<f64, Problem> {
        self.with_exponents(true, |scanner| scanner.value(values))
    }

    fn with_exponents<T>(&mut self, exponents: bool, read: impl FnOnce(&mut Self) -> T) -> T {
        let before = std::mem::replace(&mut self.exponents, exponents);
        let read = read(self);
        self.exponents = before;
        read
    }

    /// Returns the length of an exponent if one is next: E and a whole number. A decimal number
    /// belongs to a word.
    pub(super) fn exponent(&self) -> Option<usize> {
        let digits = match self.rest() {
            [b'E', b'+' | b'-', digits @ ..] | [b'E', digits @ ..] => digits,
            _ => return None,
        };
        let end = digits.iter().position(|byte| !byte.is_ascii_digit());
        let count = end.unwrap_or(digits.len());
        let whole = count > 0 && digits.get(count) != Some(&b'.');
        whole.then(|| self.rest().len() - digits.len() + count)
    }

    fn operand(&mut self, values: &dyn Values, depth: usize) -> Result<f64, Problem> {
        if depth > DEEPEST {
            let problem = format!("nested deeper than {DEEPEST}");
            return Err(Problem::new("expression", problem, "fewer brackets"));
        }
        match self.next_word() {
            Some(b'[') => self.bracket(values, depth),
            Some(b'#') => {
                self.bump();
                let name = self.parameter_at(values, depth)?;
                values.value(&name)?.ok_or_else(|| {
                    let allowed = "a parameter that was set before";
                    Problem::new(name.to_string(), "has no value", allowed)
                })
            }
            Some(sign @ (b'+' | b'-')) => {
                self.bump();
                let value = self.operand(values, depth + 1)?;
                Ok(if sign == b'-' { -value } else { value })
            }
            Some(b'0'..=b'9' | b'.') => self.number(),
            Some(b'A'..=b'Z') => self.function(values, depth),
            _ => {
                let problem = format!("no value at '{}'", self.rest_text());
                Err(Problem::new("expression", problem, VALUES))
            }
        }
    }

    /// Reads an unsigned decimal number.
    pub(super) fn number(&mut self) -> Result<f64, Problem> {
        let begin = self.at;
        self.run(|byte| byte.is_ascii_digit() || byte == b'.');
        if self.exponents {
            self.at += self.exponent().unwrap_or(0);
        }
        let text = self.line.get(begin..self.at).unwrap_or_default();
        let text = std::str::from_utf8(text).unwrap_or_default();
        text.parse().map_err(|_| {
            let problem = format!("{} is not a number", brief(text));
            Problem::new("number", problem, "a decimal number")
        })
    }

    fn bracket(&mut self, values: &dyn Values, depth: usize) -> Result<f64, Problem> {
        let unclosed = || Problem::new("[", "no closing ]", "brackets closed in their line");
        if !self.take("[") {
            return Err(Problem::new("[", "no bracket", VALUES));
        }
        let value = self.with_exponents(true, |scanner| scanner.operation(values, depth + 1, 0))?;
        self.next_word();
        if self.take("]") {
            return Ok(value);
        }
        match self.peek() {
            None => Err(unclosed()),
            Some(_) => {
                let problem = format!("no operator at '{}'", self.rest_text());
                let allowed = "** * / MOD + - EQ NE GT GE LT LE AND OR XOR";
                Err(Problem::new("expression", problem, allowed))
            }
        }
    }

    /// Evaluates operators that bind more tightly than a level.
    fn operation(&mut self, values: &dyn Values, depth: usize, level: u8) -> Result<f64, Problem> {
        let mut left = self.operand(values, depth)?;
        loop {
            self.next_word();
            let next = OPERATORS
                .iter()
                .find(|(text, ..)| self.rest().starts_with(text.as_bytes()));
            let Some(&(text, binds, apply)) = next else {
                return Ok(left);
            };
            if binds <= level {
                return Ok(left);
            }
            self.at += text.len();
            let right = self.operation(values, depth, binds)?;
            left = finite(text, apply(left, right))?;
        }
    }

    fn function(&mut self, values: &dyn Values, depth: usize) -> Result<f64, Problem> {
        let name = self.letters();
        let unknown = || {
            let allowed = "ABS ACOS ASIN ATAN COS EXISTS EXP FIX FUP LN ROUND SIN SQRT TAN";
            Problem::new(brief(name), "not a function", allowed)
        };
        if name == "EXISTS" {
            if !self.take("[#") {
                return Err(Problem::new(name, "without a parameter", "EXISTS[#<name>]"));
            }
            let parameter = self.parameter_at(values, depth)?;
            if !self.take("]") {
                return Err(Problem::new(name, "no closing ]", "EXISTS[#<name>]"));
            }
            // An impossible parameter does not exist.
            return Ok(truth(matches!(values.value(&parameter), Ok(Some(_)))));
        }
        if self.peek() != Some(b'[') {
            return Err(unknown());
        }
        let x = self.bracket(values, depth)?;
        let result = match name {
            "ABS" => x.abs(),
            "ACOS" => x.acos().to_degrees(),
            "ASIN" => x.asin().to_degrees(),
            "ATAN" => {
                if !self.take("/") {
                    let allowed = "ATAN[y]/[x]";
                    return Err(Problem::new(name, "without its second part", allowed));
                }
                x.atan2(self.bracket(values, depth)?).to_degrees()
            }
            "COS" => x.to_radians().cos(),
            "EXP" => x.exp(),
            "FIX" => x.floor(),
            "FUP" => x.ceil(),
            "LN" => x.ln(),
            "ROUND" => x.round(),
            "SIN" => x.to_radians().sin(),
            "SQRT" => x.sqrt(),
            "TAN" => x.to_radians().tan(),
            _ => return Err(unknown()),
        };
        finite(name, result)
    }
}

type Operator = (&'static str, u8, fn(f64, f64) -> f64);

/// `**` comes before `*`, which is its prefix.
const OPERATORS: [Operator; 15] = [
    ("**", 5, f64::powf),
    ("*", 4, |a, b| a * b),
    ("/", 4, |a, b| a / b),
    ("MOD", 4, f64::rem_euclid),
    ("+", 3, |a, b| a + b),
    ("-", 3, |a, b| a - b),
    ("EQ", 2, |a, b| truth((a - b).abs() < EQUAL)),
    ("NE", 2, |a, b| truth((a - b).abs() >= EQUAL)),
    ("GT", 2, |a, b| truth(a > b)),
    ("GE", 2, |a, b| truth(a >= b)),
    ("LT", 2, |a, b| truth(a < b)),
    ("LE", 2, |a, b| truth(a <= b)),
    ("AND", 1, |a, b| truth(a != 0.0 && b != 0.0)),
    ("OR", 1, |a, b| truth(a != 0.0 || b != 0.0)),
    ("XOR", 1, |a, b| truth((a != 0.0) != (b != 0.0))),
];

fn truth(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}

fn finite(of: &str, value: f64) -> Result<f64, Problem> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Problem::new(
        of,
        "has no value here",
        "operands for which it has a finite value",
    ))
}

#[cfg(test)]
mod tests;
