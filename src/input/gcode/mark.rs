//! Position in a line of the word that a message names.

use std::ops::Range;

use super::problem::Problem;
use super::text::each;

/// Returns the bytes of a line that a problem is about: the word it names, else all words.
pub(super) fn find(line: &[u8], problem: &Problem) -> Range<usize> {
    let (mut kept, mut places) = (Vec::new(), Vec::new());
    let cleaned = each(line, |at, byte| {
        kept.push(byte);
        places.push(at);
    });
    if cleaned.is_err() {
        return unreadable(line, &problem.field);
    }
    let named = problem.field.split(", ").find_map(|name| word(&kept, name));
    let within = problem.at.clone().or(named).unwrap_or(0..kept.len());
    // A blank represents a comment.
    let is_blank = |at: &usize| kept.get(*at) == Some(&b' ');
    let mut at = within.skip_while(is_blank);
    let first = at.next();
    let last = at.filter(|at| !is_blank(at)).last().or(first);
    let place = |at: Option<usize>| at.and_then(|at| places.get(at)).copied();
    match (place(first), place(last)) {
        (Some(first), Some(last)) => first..last + 1,
        _ => 0..line.len(),
    }
}

/// Returns the comment that is not closed, or the invalid character.
fn unreadable(line: &[u8], field: &str) -> Range<usize> {
    let begin = match field {
        "comment" => line.iter().position(|&byte| byte == b'('),
        _ => line
            .iter()
            .position(|byte| !matches!(byte, b' '..=b'~' | b'\t' | 0)),
    };
    let begin = begin.unwrap_or(0);
    match field {
        "comment" => begin..line.len(),
        _ => begin..begin + 1,
    }
}

/// Returns a word by its letter, or by letter and number, or a text as written.
fn word(line: &[u8], name: &str) -> Option<Range<usize>> {
    let (letter, number) = name.split_at_checked(1)?;
    let letter = letter.as_bytes().first()?;
    let number: Option<f64> = number.parse().ok();
    let begins = |at: usize| {
        let before = at.checked_sub(1).and_then(|before| line.get(before));
        let after = line.get(at + 1..).unwrap_or_default();
        let digits = after
            .iter()
            .take_while(|byte| byte.is_ascii_digit() || **byte == b'.');
        let written = String::from_utf8_lossy(after.get(..digits.count()).unwrap_or_default());
        line.get(at) == Some(letter)
            && !before.is_some_and(u8::is_ascii_alphabetic)
            && !after.first().is_some_and(u8::is_ascii_alphabetic)
            && (name.len() == 1 || (number.is_some() && written.parse().ok() == number))
    };
    if letter.is_ascii_alphabetic() && (name.len() == 1 || number.is_some()) {
        let begin = (0..line.len()).find(|&at| begins(at))?;
        return Some(begin..value_end(line, begin + 1));
    }
    let text = name
        .strip_suffix("...")
        .unwrap_or(name)
        .to_ascii_uppercase();
    let found = line
        .windows(text.len().max(1))
        .position(|here| here == text.as_bytes())?;
    Some(found..found + text.len())
}

/// Returns the end of the value that begins at `begin`: before the next word.
fn value_end(line: &[u8], begin: usize) -> usize {
    let mut depth = 0_usize;
    for (at, byte) in line.iter().enumerate().skip(begin) {
        match byte {
            b'[' | b'<' => depth += 1,
            b']' | b'>' => depth = depth.saturating_sub(1),
            b'A'..=b'Z' | b' ' | b'*' if depth == 0 => return at,
            _ => {}
        }
    }
    line.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found<'a>(line: &'a str, field: &str) -> &'a str {
        let range = find(line.as_bytes(), &Problem::new(field, "p", "a"));
        &line[range]
    }

    #[test]
    fn words_are_found_by_what_names_them() {
        let line = "N10 g01 (X) X 1 0 Y[#<x> + sin[9]] i-2 (end) ; x";
        assert_eq!(found(line, "X"), "X 1 0");
        assert_eq!(found(line, "Y"), "Y[#<x> + sin[9]]");
        assert_eq!(found(line, "J, I"), "i-2");
        assert_eq!(found(line, "G1"), "g01");
        assert_eq!(found(line, "#<x>"), "#<x>");
        assert_eq!(found(line, "SIN[9..."), "sin[9");
        // Missing: all words.
        assert_eq!(found(line, "G2"), "N10 g01 (X) X 1 0 Y[#<x> + sin[9]] i-2");
        assert_eq!(found(line, "S"), found(line, "G2"));
        assert_eq!(found("", "X"), "");
        assert_eq!(found("G1 G1.1", "G1.1"), "G1.1");
    }

    #[test]
    fn what_cannot_be_read_is_found() {
        assert_eq!(found("X1 (open", "comment"), "(open");
        let range = find(b"X1 \xe9 Y", &Problem::new("line", "p", "a"));
        assert_eq!(range, 3..4);
    }

    #[test]
    fn a_part_that_is_known_goes_before_the_name() {
        let problem = Problem::new("X", "p", "a").at(4..6);
        let line = "X1 (c) Y2 X3";
        assert_eq!(&line[find(line.as_bytes(), &problem)], "2 X");
    }
}
