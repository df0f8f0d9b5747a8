//! What must be seen to before the `gcode` crate gets a line.

use std::borrow::Cow;

/// The longest code number, in digits. The crate overflows from nine on.
const CODE_DIGITS: usize = 6;

/// What is wrong with a line.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Problem {
    pub(super) field: String,
    pub(super) problem: String,
    pub(super) allowed: String,
}

impl Problem {
    pub(super) fn new(
        field: impl Into<String>,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Self {
        Self {
            field: field.into(),
            problem: problem.into(),
            allowed: allowed.into(),
        }
    }
}

/// Blanks out comments. The crate would let an open `(` swallow the lines after it.
pub(super) fn without_comments(line: &[u8]) -> Result<Cow<'_, [u8]>, Problem> {
    if !line.iter().any(|byte| b"();".contains(byte)) {
        return Ok(Cow::Borrowed(line));
    }
    let mut kept = Vec::with_capacity(line.len());
    let mut inside = false;
    for &byte in line {
        match (byte, inside) {
            (b';', false) => break,
            (b'(', false) => inside = true,
            (b')', true) => {
                inside = false;
                // A blank keeps the words on either side apart.
                kept.push(b' ');
            }
            (b'(', true) => {
                let problem = "another ( inside a comment";
                return Err(Problem::new(
                    "comment",
                    problem,
                    "a comment ends at its first )",
                ));
            }
            (_, true) => {}
            (_, false) => kept.push(byte),
        }
    }
    match inside {
        true => Err(Problem::new(
            "comment",
            "no closing )",
            "comments closed in their line",
        )),
        false => Ok(Cow::Owned(kept)),
    }
}

/// Refuses what is neither printable ASCII nor a blank. The crate takes a carriage return for a
/// blank, which would join two lines into one, and blanks of other scripts for words.
pub(super) fn printable(line: &[u8]) -> Result<&str, Problem> {
    const ALLOWED: &str = "ASCII letters, digits and signs, in lines that end in LF or CR LF";
    let Ok(text) = std::str::from_utf8(line) else {
        return Err(Problem::new(
            "line",
            "characters that are not UTF-8",
            ALLOWED,
        ));
    };
    match text.chars().find(|c| !matches!(c, ' '..='~' | '\t')) {
        Some('\r') => Err(Problem::new("line", "a carriage return inside it", ALLOWED)),
        Some(other) => {
            let problem = format!("the character '{}' inside it", other.escape_default());
            Err(Problem::new("line", problem, ALLOWED))
        }
        None => Ok(text),
    }
}

/// Refuses the numbers after G, M and T that the crate would misread: long ones overflow, G91.01
/// would come out as G91.1, and G1. would go with its words, reported to nobody.
pub(super) fn check_codes(line: &str) -> Result<(), Problem> {
    for (start, letter) in line.match_indices(['G', 'g', 'M', 'm', 'T', 't']) {
        let number = line.get(start + 1..).unwrap_or_default();
        let number = number.trim_start_matches([' ', '\t']);
        let end = number.find(|c: char| !c.is_ascii_digit() && c != '.');
        let number = number
            .get(..end.unwrap_or(number.len()))
            .unwrap_or_default();
        let (whole, tenths) = number.split_once('.').unwrap_or((number, "0"));
        let headless = whole.is_empty() && !number.is_empty();
        if headless || whole.len() > CODE_DIGITS || tenths.len() != 1 {
            let problem = format!("{} is not the number of a code", shown(number));
            let allowed = "a whole number, or one with one decimal";
            return Err(Problem::new(letter.to_ascii_uppercase(), problem, allowed));
        }
    }
    Ok(())
}

/// A piece of the input as a message shows it.
pub(super) fn shown(text: &str) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_that_would_be_misread_are_refused() {
        // The crate would wrap the first around to G0.4.
        for (line, number) in [
            ("G429496730", "429496730"),
            ("G4294967295", "4294967295"),
            ("G91.01", "91.01"),
            ("X3 m 6.", "6."),
            ("T.5", ".5"),
        ] {
            let problem = check_codes(line).unwrap_err().problem;
            assert_eq!(problem, format!("{number} is not the number of a code"));
        }
        assert_eq!(check_codes("G 091.1 X1234567890 M3T010203"), Ok(()));
    }

    #[test]
    fn comments_become_blanks() {
        let kept = |line: &'static [u8]| without_comments(line).map(Cow::into_owned);
        assert_eq!(kept(b"X1(\xe9;)Y2;Z3 ("), Ok(b"X1 Y2".to_vec()));
        assert_eq!(kept(b"X1 Y2"), Ok(b"X1 Y2".to_vec()));
        assert_eq!(kept(b"X1 (open").unwrap_err().problem, "no closing )");
        assert_eq!(
            kept(b"(a (b) X1").unwrap_err().problem,
            "another ( inside a comment"
        );
    }
}
