use super::{Kind, Words};
use crate::input::Fault;
use crate::trace::PORTS_OUT;
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// Greatest width of a variable that the reader sees, in bits. A larger number is more likely a
/// mistake than a signal.
const WIDEST: u64 = 1 << 20;

/// Header of a VCD, before the values.
#[derive(Default)]
pub(super) struct Header<'a> {
    /// Declared codes.
    pub codes: HashMap<&'a [u8], Kind>,
    /// True if this crate wrote the file.
    pub ours: bool,
    /// Paths of the output ports, if a comment names them.
    pub ports_out: Option<Vec<String>>,
    /// Text on which the reader panics or that it misreads: a second `$date` or `$version`, scopes
    /// without a name, variables of no width.
    pub blank: Vec<Range<usize>>,
    /// Number of variables in that text.
    pub without_bits: usize,
}

pub(super) fn header<'a>(words: &mut Words<'a>) -> Result<Header<'a>, Fault> {
    let mut header = Header::default();
    let mut once = HashSet::new();
    // For each open scope: true if it has a name.
    let mut scopes = Vec::new();
    while let Some(name) = words.next() {
        if !name.starts_with(b"$") {
            return Err(words.fault(
                name,
                "is no command",
                "commands such as $var up to $enddefinitions",
            ));
        }
        let line = words.line;
        let begin = words.place - name.len();
        let body = words.command(name)?;
        let again = !once.insert(name);
        match name {
            b"$timescale" if again => {
                return Err(words.fault(name, "stands here again", "one in a file"));
            }
            // Each program that processed the file may have left its own.
            b"$date" | b"$version" => {
                header.ours |= name == b"$version" && body.first() == Some(&&b"motion-rtl"[..]);
                if again {
                    header.blank.push(begin..words.place);
                }
            }
            b"$comment" => {
                if let Some(ports) = ports_out(&body) {
                    header.ports_out.get_or_insert_default().extend(ports);
                }
            }
            b"$timescale" | b"$attrbegin" | b"$attrend" => {}
            b"$scope" if body.is_empty() => {
                return Err(words.fault(name, "a word is missing", "$scope KIND NAME $end"));
            }
            b"$scope" => {
                scopes.push(body.len() > 1);
                if body.len() == 1 {
                    header.blank.push(begin..words.place);
                }
            }
            b"$upscope" => match scopes.pop() {
                Some(true) => {}
                Some(false) => header.blank.push(begin..words.place),
                None => {
                    let allowed = "one $upscope for each $scope";
                    return Err(words.fault(name, "no scope is open", allowed));
                }
            },
            b"$var" => {
                if !variable(words, line, &body, &mut header.codes)? {
                    header.blank.push(begin..words.place);
                    header.without_bits += 1;
                }
            }
            b"$enddefinitions" => {
                // The reader continues with the next line.
                let rest = &words.bytes[words.place..];
                let end = rest
                    .iter()
                    .position(|&byte| byte == b'\n')
                    .unwrap_or(rest.len());
                if !rest[..end].trim_ascii().is_empty() {
                    return Err(words.fault(
                        name,
                        "values stand behind it",
                        "values in lines of their own",
                    ));
                }
                return Ok(header);
            }
            _ => {
                return Err(words.fault(
                    name,
                    "is no command of a VCD's header",
                    "commands such as $var up to $enddefinitions",
                ));
            }
        }
    }
    Err(words.cut_off("the file ends before $enddefinitions"))
}

/// Returns the names after the words that begin a comment of output ports.
fn ports_out(comment: &[&[u8]]) -> Option<Vec<String>> {
    let begin = PORTS_OUT.split(' ').map(str::as_bytes);
    let names = comment.iter().copied();
    let begins = begin.clone().eq(names.clone().take(begin.clone().count()));
    let name = |name| String::from_utf8_lossy(name).into_owned();
    begins.then(|| names.skip(begin.count()).map(name).collect())
}

/// Returns false for a variable that the reader must not see.
fn variable<'a>(
    words: &Words<'a>,
    line: usize,
    body: &[&'a [u8]],
    codes: &mut HashMap<&'a [u8], Kind>,
) -> Result<bool, Fault> {
    let fault = |field: &[u8], problem: &str, allowed: &str| {
        let mut fault = words.fault(field, problem, allowed);
        fault.line = line;
        fault
    };
    let &[kind, width, code, name, ..] = body else {
        return Err(fault(
            b"$var",
            "a word is missing",
            "$var KIND WIDTH CODE NAME $end",
        ));
    };
    let width = str::from_utf8(width)
        .ok()
        .and_then(|text| text.parse::<u64>().ok());
    let kind = match (kind, width) {
        (b"string", _) => Kind::String,
        (b"real" | b"realtime" | b"shortreal" | b"real_parameter", _) => Kind::Real,
        (b"event", _) => Kind::Bits(1),
        (_, Some(width @ 1..=WIDEST)) => Kind::Bits(width as u32),
        (_, Some(_)) => Kind::Nothing,
        _ => return Err(fault(name, "has no width", "a number of bits")),
    };
    if !code.iter().all(u8::is_ascii_graphic) {
        return Err(fault(
            name,
            "its code is not visible ASCII",
            "a code of the characters ! to ~",
        ));
    }
    if name.starts_with(b"[") {
        return Err(fault(
            name,
            "begins with a bracket",
            "a name, then its range",
        ));
    }
    let known = codes.entry(code).or_insert(kind);
    if *known == Kind::Nothing {
        *known = kind;
    }
    if kind != Kind::Nothing && *known != kind {
        return Err(fault(
            name,
            "another variable of its code has another width or kind",
            "one code for each signal",
        ));
    }
    Ok(kind != Kind::Nothing)
}
