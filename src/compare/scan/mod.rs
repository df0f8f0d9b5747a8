//! Check of a VCD before it is read: the reader silently accepts many mistakes, and panics on
//! others.

mod header;

use super::gap::Gap;
use crate::input::Fault;
use header::{Header, header};
use std::collections::HashMap;
use std::ops::Range;

const VALUES: &str =
    "0, 1, x or z and the code of a variable, b and the bits, r, s, or # and a time";

/// Greatest size of all values of a file in the reader's memory, in bytes, at a quarter byte per
/// bit: a value may be a million times as wide as its text.
const ROOM: u64 = 1 << 30;

/// Facts about a VCD that the reader does not report.
#[derive(Debug, Default)]
pub(super) struct Scanned {
    /// True if this crate wrote the file.
    pub ours: bool,
    /// Paths of the output ports, if a comment names them.
    pub ports_out: Option<Vec<String>>,
    /// Gaps in which the dump was switched off, in order.
    pub gaps: Vec<Gap>,
    /// Edits that make the file readable.
    pub edits: Edits,
    /// Number of variables without bits that the edits remove.
    pub without_bits: usize,
}

/// Edits of a file before it is read: signals that are not compared must not make it unreadable.
#[derive(Debug, Default)]
pub(super) struct Edits {
    /// Bytes to replace by spaces, such as a second `$version` and invalid values.
    blank: Vec<Range<usize>>,
    /// Digits that are separated from their code, and the position in front of the code.
    moved: Vec<(usize, usize)>,
    /// End of the header, in which any white space becomes a space.
    header: usize,
    /// End of the file, if the dump is switched off and never on again.
    end: Option<usize>,
}

impl Edits {
    /// Applies the edits.
    pub fn apply(&self, bytes: &mut Vec<u8>) {
        for blank in &self.blank {
            bytes[blank.clone()].fill(b' ');
        }
        for &(from, to) in &self.moved {
            bytes[to] = bytes[from];
            bytes[from] = b' ';
        }
        let header = &mut bytes[..self.header];
        for tab in header.iter_mut().filter(|byte| **byte == b'\t') {
            *tab = b' ';
        }
        bytes.truncate(self.end.unwrap_or(bytes.len()));
    }
}

/// Kind of values of a code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Bits(u32),
    Real,
    String,
    /// Nothing to compare, whatever the values: a variable without a width, or with one that is
    /// too large.
    Nothing,
}

/// Words of a file with their lines.
struct Words<'a> {
    file: &'a str,
    bytes: &'a [u8],
    place: usize,
    line: usize,
}

/// Returns an error with the line if the file is not a complete VCD.
pub(super) fn check(file: &str, bytes: &[u8]) -> Result<Scanned, Fault> {
    let mut words = Words {
        file,
        bytes,
        place: 0,
        line: 1,
    };
    let Header {
        codes,
        ours,
        ports_out,
        mut blank,
        without_bits,
    } = header(&mut words)?;
    let header = words.place;
    if codes.is_empty() {
        return Err(Fault::new(
            file,
            0,
            "file",
            "no signal in it",
            "a VCD with signals",
        ));
    }
    let body = body(&mut words, &codes)?;
    let whole_line = bytes.last() == Some(&b'\n');
    // Other programs may leave out the last line end.
    if ours && !whole_line {
        return Err(words.cut_off("the file ends within this line"));
    }
    if ours && !body.ends_with_time {
        words.line -= 1;
        return Err(words.cut_off("the last line is no time"));
    }
    blank.extend(body.blank);
    let edits = Edits {
        blank,
        moved: body.moved,
        header,
        end: body.off.map(|(place, ..)| place),
    };
    Ok(Scanned {
        ours,
        ports_out,
        gaps: body.gaps,
        edits,
        without_bits,
    })
}

impl<'a> Words<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        while let Some(byte) = self
            .bytes
            .get(self.place)
            .filter(|byte| byte.is_ascii_whitespace())
        {
            self.line += usize::from(*byte == b'\n');
            self.place += 1;
        }
        let rest = &self.bytes[self.place..];
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let word = &rest[..end.unwrap_or(rest.len())];
        self.place += word.len();
        (!word.is_empty()).then_some(word)
    }

    fn fault(&self, field: &[u8], problem: impl Into<String>, allowed: impl Into<String>) -> Fault {
        let field = String::from_utf8_lossy(field)
            .chars()
            .take(40)
            .collect::<String>();
        Fault::new(self.file, self.line, field, problem, allowed)
    }

    fn cut_off(&self, problem: &str) -> Fault {
        self.fault(b"file", problem, "a complete VCD: this one is cut off")
    }

    /// Returns the code after a real number or a string: the next word, or the last one in the
    /// line, since a text may contain spaces.
    fn code_of_text(&mut self, codes: &HashMap<&[u8], Kind>) -> Option<&'a [u8]> {
        let from = self.place;
        let line = self.bytes[from..].iter().position(|&byte| byte == b'\n');
        let line = line.map_or(self.bytes.len(), |length| from + length);
        let next = self.next()?;
        let is_text = |code: &[u8]| {
            codes
                .get(code)
                .is_some_and(|kind| !matches!(kind, Kind::Bits(_)))
        };
        if is_text(next) || self.place > line {
            return Some(next);
        }
        let text = self.bytes[from..line].trim_ascii_end();
        let start = text
            .iter()
            .rposition(u8::is_ascii_whitespace)
            .map_or(0, |space| space + 1);
        match is_text(&text[start..]) {
            true => {
                self.place = from + text.len();
                Some(&text[start..])
            }
            false => Some(next),
        }
    }

    /// Returns the words of a command up to its `$end`.
    fn command(&mut self, name: &[u8]) -> Result<Vec<&'a [u8]>, Fault> {
        let line = self.line;
        let mut words = Vec::new();
        while let Some(word) = self.next() {
            if word == b"$end" {
                return Ok(words);
            }
            if word.windows(4).any(|part| part == b"$end") {
                return Err(self.fault(word, "$end within a word", "$end by itself"));
            }
            words.push(word);
        }
        self.line = line;
        Err(self.fault(name, "has no $end", "a complete VCD: this one is cut off"))
    }
}

/// Facts about the values, collected while they are read.
#[derive(Default)]
struct Body {
    /// True if the last word is a time.
    ends_with_time: bool,
    /// Gaps in which the dump is switched off.
    gaps: Vec<Gap>,
    /// Line and time at which the dump was switched off, and true if there were values before.
    off: Option<(usize, u64, bool)>,
    blank: Vec<Range<usize>>,
    moved: Vec<(usize, usize)>,
}

fn body(words: &mut Words<'_>, codes: &HashMap<&[u8], Kind>) -> Result<Body, Fault> {
    let mut body = Body::default();
    let mut now = None;
    let mut room = ROOM;
    let mut values = false;
    while let Some(word) = words.next() {
        body.ends_with_time = false;
        let begin = words.place - word.len();
        let (first, rest) = word.split_first().unwrap_or((&0, &[]));
        match first {
            b'#' => {
                let time = str::from_utf8(rest)
                    .ok()
                    .and_then(|text| text.parse::<u64>().ok());
                let Some(time) = time else {
                    return Err(words.fault(word, "is no time", "# and a whole number below 2^64"));
                };
                if now.is_some_and(|before| before > time) {
                    return Err(words.fault(word, "the time goes back", "times that grow"));
                }
                now = Some(time);
                body.ends_with_time = true;
                continue;
            }
            b'$' => {
                match word {
                    b"$comment" => drop(words.command(word)?),
                    b"$dumpvars" | b"$dumpall" | b"$end" => {}
                    b"$dumpoff" => {
                        body.off.get_or_insert((begin, now.unwrap_or(0), values));
                    }
                    b"$dumpon" => {
                        if let Some((_, from, _)) = body.off.take() {
                            Gap::switch(&mut body.gaps, from, false);
                            Gap::switch(&mut body.gaps, now.unwrap_or(0), true);
                        }
                    }
                    _ => {
                        return Err(words.fault(
                            word,
                            "is no command between values",
                            "$dumpvars, $dumpon, $dumpoff, $dumpall, $comment",
                        ));
                    }
                }
                continue;
            }
            _ => {}
        }
        values = true;
        let (digits, code) = match first {
            b'b' | b'B' => (rest, words.next()),
            b'r' | b'R' | b's' | b'S' => (rest, words.code_of_text(codes)),
            _ if rest.is_empty() => {
                let code = words.next();
                let place = words.place - code.map_or(0, <[u8]>::len);
                body.moved.push((begin, place - 1));
                (word, code)
            }
            _ => (&word[..1], Some(rest)),
        };
        let Some(code) = code else {
            return Err(words.cut_off("a value without the code of its variable"));
        };
        let Some(kind) = codes.get(code) else {
            let problem = format!("{} is no code of a variable", String::from_utf8_lossy(code));
            return Err(words.fault(word, problem, VALUES));
        };
        let fits = match (first, kind) {
            (b'r' | b'R', Kind::Real) => {
                str::from_utf8(digits).is_ok_and(|text| text.parse::<f64>().is_ok())
            }
            (b's' | b'S', Kind::String) => str::from_utf8(digits).is_ok(),
            (b'r' | b'R' | b's' | b'S', _) => false,
            (_, Kind::Bits(width)) => {
                let known = |digit: &u8| b"01xXzZhHuUwWlL-".contains(digit);
                (1..=*width as usize).contains(&digits.len()) && digits.iter().all(known)
            }
            _ => false,
        };
        // Only white space is between the value and its code.
        let between = begin + word.len()..words.place - code.len();
        let between = words.bytes.get(between).unwrap_or_default();
        let whole = fits && between.iter().all(u8::is_ascii_whitespace);
        if !whole && !matches!(kind, Kind::Bits(_)) {
            // The value is never read.
            if body.moved.last().is_some_and(|last| last.0 == begin) {
                body.moved.pop();
            }
            body.blank.push(begin..words.place);
            continue;
        }
        if !fits {
            return Err(words.fault(word, format!("is no value of {kind}"), VALUES));
        }
        if let Kind::Bits(width) = kind {
            let left = room.checked_sub(u64::from(*width).div_ceil(4));
            room = left.ok_or_else(|| {
                let allowed = format!("values of {} MiB together, by 2 bits each", ROOM >> 20);
                words.fault(code, format!("more values of {kind} than fit"), allowed)
            })?;
        }
    }
    if !body.off.map_or(values, |(.., before)| before) {
        return Err(Fault::new(
            words.file,
            0,
            "file",
            "no value in it",
            "a VCD with values",
        ));
    }
    Ok(body)
}

impl std::fmt::Display for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Kind::Bits(1) => write!(f, "a signal of 1 bit"),
            Kind::Bits(width) => write!(f, "a signal of {width} bits"),
            Kind::Real => write!(f, "a real"),
            Kind::String => write!(f, "a string"),
            Kind::Nothing => write!(f, "a variable that is not compared"),
        }
    }
}
