//! Lines of a text, and removal of blanks and comments.

use super::problem::Problem;

const ALLOWED: &str = "ASCII letters, digits and signs, in lines that end in LF, CR or CR LF";

/// Strips a byte order mark, and Ctrl-Z and NUL at the end.
pub(super) fn trimmed(text: &[u8]) -> &[u8] {
    let mut text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    while let [rest @ .., 0 | 0x1a] = text {
        text = rest;
    }
    text
}

/// Returns the line at an offset, without its end, and the offset of the next one. A line ends in
/// LF, CR, CR LF or CR CR LF.
pub(super) fn line_at(text: &[u8], offset: usize) -> Option<(&[u8], usize)> {
    let rest = text.get(offset..).filter(|rest| !rest.is_empty())?;
    let Some(length) = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')) else {
        return Some((rest, text.len()));
    };
    let (line, end) = rest.split_at(length);
    let end = match end {
        [b'\r', b'\r', b'\n', ..] => 3,
        [b'\r', b'\n', ..] => 2,
        _ => 1,
    };
    Some((line, offset + length + end))
}

/// Copies a line in upper case without blanks, which may be anywhere in RS274. A comment leaves
/// one blank, which separates its neighbours; so do blanks between a digit and an E, which is then
/// no exponent. A NUL is a blank.
///
/// # Errors
///
/// Returns an error for a character that is not printable ASCII, or a comment that is not closed.
pub(super) fn clean(line: &[u8], into: &mut Vec<u8>) -> Result<(), Problem> {
    into.clear();
    each(line, |_, byte| into.push(byte))
}

/// Passes on the characters that [`clean`] keeps, with their positions in the line.
///
/// # Errors
///
/// Returns the errors of [`clean`].
pub(super) fn each(line: &[u8], mut keep: impl FnMut(usize, u8)) -> Result<(), Problem> {
    let mut depth = 0_usize;
    // Blanks precede; last character kept; inside the name of a parameter.
    let (mut blank, mut last, mut named) = (false, b' ', false);
    for (at, &byte) in line.iter().enumerate() {
        match (byte, depth) {
            (b';', 0) => break,
            (b'(', _) => depth += 1,
            (b')', 1) => {
                depth = 0;
                keep(at, b' ');
            }
            (b')', 2..) => depth -= 1,
            (b' ' | b'\t' | 0, 0) => blank = true,
            (_, 1..) => {}
            (b'!'..=b'~', 0) => {
                let byte = byte.to_ascii_uppercase();
                let digit = last.is_ascii_digit() || last == b'.';
                if byte == b'E' && blank && digit && !named {
                    keep(at, b' ');
                }
                keep(at, byte);
                named = byte == b'<' || (named && byte != b'>');
                (blank, last) = (false, byte);
            }
            _ => return Err(stranger(line)),
        }
    }
    match depth {
        0 => Ok(()),
        _ => Err(Problem::new(
            "comment",
            "no closing )",
            "comments closed in their line",
        )),
    }
}

fn stranger(line: &[u8]) -> Problem {
    let Ok(text) = std::str::from_utf8(line) else {
        return Problem::new("line", "characters that are not UTF-8", ALLOWED);
    };
    let strange = |c: &char| !matches!(c, ' '..='~' | '\t' | '\0');
    let found = text.chars().find(strange).unwrap_or_default();
    let problem = format!("the character '{}' inside it", found.escape_default());
    Problem::new("line", problem, ALLOWED)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_end_in_any_way() {
        let text = b"a\nb\rc\r\nd\r\r\ne\n\nf";
        let (mut lines, mut at) = (Vec::new(), 0);
        while let Some((line, next)) = line_at(text, at) {
            lines.push(line);
            at = next;
        }
        assert_eq!(lines, [&b"a"[..], b"b", b"c", b"d", b"e", b"", b"f"]);
        assert_eq!(trimmed(b"\xef\xbb\xbfG0\n\0\x1a\0"), b"G0\n");
    }

    #[test]
    fn blanks_go_and_comments_leave_one() {
        let clean = |line: &[u8]| {
            let mut into = Vec::new();
            clean(line, &mut into).map(|()| String::from_utf8(into).unwrap())
        };
        assert_eq!(
            clean(b"g1 x 1 . 5\0\t(\xe9 (n) ;)2;Z3 ("),
            Ok("G1X1.5 2".to_owned())
        );
        assert_eq!(clean(b"X1 (open").unwrap_err().problem, "no closing )");
        assert_eq!(clean(b"(a (b) X1").unwrap_err().problem, "no closing )");
        assert_eq!(
            clean(b"X1 \xe9").unwrap_err().problem,
            "characters that are not UTF-8"
        );
        assert_eq!(
            clean("X1 é".as_bytes()).unwrap_err().problem,
            "the character '\\u{e9}' inside it"
        );
    }
}
