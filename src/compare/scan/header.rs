use super::{Kind, Words};
use crate::input::Fault;
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// The widest variable, in bits. Beyond it a wrong number is likelier than a signal.
const WIDEST: u32 = 1 << 20;

/// What stands before the values.
#[derive(Default)]
pub(super) struct Header<'a> {
    /// The codes that are declared.
    pub codes: HashMap<&'a [u8], Kind>,
    /// This crate wrote the file.
    pub ours: bool,
    /// Where there is a second `$date` or `$version`.
    pub again: Vec<Range<usize>>,
}

pub(super) fn header<'a>(words: &mut Words<'a>) -> Result<Header<'a>, Fault> {
    let mut header = Header::default();
    let mut once = HashSet::new();
    let mut depth = 0;
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
            // Each program that the file went through may have left its own.
            b"$date" | b"$version" => {
                header.ours |= name == b"$version" && body.first() == Some(&&b"motion-rtl"[..]);
                if again {
                    header.again.push(begin..words.place);
                }
            }
            b"$timescale" | b"$comment" | b"$attrbegin" | b"$attrend" => {}
            b"$scope" if body.len() < 2 => {
                return Err(words.fault(name, "a word is missing", "$scope KIND NAME $end"));
            }
            b"$scope" => depth += 1,
            b"$upscope" if depth == 0 => {
                return Err(words.fault(name, "no scope is open", "one $upscope for each $scope"));
            }
            b"$upscope" => depth -= 1,
            b"$var" => variable(words, line, &body, &mut header.codes)?,
            b"$enddefinitions" => {
                // The reader begins with the next line.
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

fn variable<'a>(
    words: &Words<'a>,
    line: usize,
    body: &[&'a [u8]],
    codes: &mut HashMap<&'a [u8], Kind>,
) -> Result<(), Fault> {
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
        .and_then(|text| text.parse().ok());
    let kind = match (kind, width) {
        (b"string", _) => Kind::String,
        (b"real" | b"realtime" | b"shortreal" | b"real_parameter", _) => Kind::Real,
        (b"event", _) => Kind::Bits(1),
        (_, Some(width @ 1..=WIDEST)) => Kind::Bits(width),
        _ => return Err(fault(name, "has no width", "1 to 1048576 bits")),
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
    if codes
        .insert(code, kind)
        .is_some_and(|earlier| earlier != kind)
    {
        return Err(fault(
            name,
            "another variable of its code has another width or kind",
            "one code for each signal",
        ));
    }
    Ok(())
}
