use crate::input::{Fault, read_string};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use toml::{Spanned, Value};

const PARTNER: &str = "a path in quotes, as \"tb.dut.count\", \"!tb.dut.step_n\" or \
                       \"tb.dut.bus[27:4]\", or { name = \"tb.dut.y\", delay = 2 }";

/// Contents of a map file: pairs of signals whose names differ.
///
/// ```
/// use motion_rtl::compare::Map;
///
/// let map = Map::parse("names.toml", r#"
/// ignore = ["top.debug", "top.memory.*"]         # left out on purpose
/// leave = ["top.alarm"]                          # ports out that are left out
///
/// [scopes]                                       # and everything below them, nothing beside
/// "top.counter" = "tb.dut.u_timer"
///
/// [signals]
/// "top.counter.count" = "tb.dut.u_timer.cnt_q"
/// "top.step" = "!tb.dut.step_n"                  # active low
/// "top.period" = "tb.dut.bus[27:4]"              # some of the bits
/// "top.x" = { name = "tb.dut.y", delay = 2 }     # shows 2 ticks later in the other file
/// "#).unwrap();
/// ```
///
/// With `[scopes]`, a signal outside all of them has a partner only by `[signals]` or by
/// [`Settings::scope`](super::Settings::scope).
///
/// A name of the other file may be the end of a path, if only one path ends so: `dut.y` may stand
/// for `TOP.tb.dut.y`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Map {
    pub(super) file: String,
    pub(super) ignore: Vec<Entry<()>>,
    pub(super) leave: Vec<Entry<()>>,
    pub(super) scopes: Vec<Entry<String>>,
    pub(super) signals: Vec<Entry<Partner>>,
}

/// Line of a map.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry<T> {
    /// Number of the line, from 1.
    pub line: usize,
    /// Name in the golden file.
    pub golden: String,
    /// Partner in the other file; `()` for a name that is left out.
    pub other: T,
}

/// Partner of a golden signal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Partner {
    /// Path or its end, with bits in brackets if it is a part of a signal.
    pub name: String,
    /// True if the signal is inverted.
    pub invert: bool,
    /// Ticks by which the partner is late.
    pub delay: u64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(default)]
    ignore: Vec<Spanned<String>>,
    #[serde(default)]
    leave: Vec<Spanned<String>>,
    #[serde(default)]
    scopes: BTreeMap<Spanned<String>, Spanned<String>>,
    #[serde(default)]
    signals: BTreeMap<Spanned<String>, Spanned<Value>>,
}

impl Map {
    /// Reads a map file.
    ///
    /// # Errors
    /// Returns the errors of [`read_string`] and [`parse`](Map::parse).
    pub fn read(path: &Path) -> Result<Self, Fault> {
        let text = read_string(path, "a map in TOML")?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Parses a map from text; errors name the file `file`.
    ///
    /// # Errors
    /// Returns an error for invalid TOML, an unknown key, a duplicate name, or an invalid partner.
    pub fn parse(file: &str, text: &str) -> Result<Self, Fault> {
        let line = |place: usize| text[..place.min(text.len())].matches('\n').count() + 1;
        let written: Written = toml::from_str(text).map_err(|error| {
            let line = line(error.span().map_or(0, |span| span.start));
            let field = text.lines().nth(line - 1).unwrap_or("").split('=').next();
            let field = field.map(str::trim).filter(|field| !field.is_empty());
            let allowed = "ignore = [\"golden name\"] and leave = [\"port out\"] first, then [scopes] \
                           and [signals] with lines of \"golden name\" = \"other name\"";
            Fault::new(file, line, field.unwrap_or("file"), error.message().trim(), allowed)
        })?;
        let golden = |name: &Spanned<String>| (line(name.span().start), name.get_ref().clone());
        let mut map = Map {
            file: file.to_owned(),
            ..Map::default()
        };
        let plain = |names: &[Spanned<String>]| {
            let entry = |name| {
                let (line, golden) = golden(name);
                let other = ();
                Entry {
                    line,
                    golden,
                    other,
                }
            };
            names.iter().map(entry).collect()
        };
        (map.ignore, map.leave) = (plain(&written.ignore), plain(&written.leave));
        for (name, scope) in written.scopes {
            let (line, golden) = golden(&name);
            let other = scope.into_inner();
            map.scopes.push(Entry {
                line,
                golden,
                other,
            });
        }
        for (name, value) in written.signals {
            let (line, golden) = golden(&name);
            let other = match (golden.as_str(), value.get_ref()) {
                ("ignore" | "leave", Value::Array(_)) => Err((
                    "stands below [signals]".into(),
                    "ignore and leave above [scopes] and [signals]",
                )),
                (_, value) => partner(value),
            };
            let other = other.map_err(|(problem, allowed): (String, _)| {
                Fault::new(file, line, &golden, problem, allowed)
            })?;
            map.signals.push(Entry {
                line,
                golden,
                other,
            });
        }
        // Messages follow the order of the file.
        map.scopes.sort_by_key(|entry| entry.line);
        map.signals.sort_by_key(|entry| entry.line);
        Ok(map)
    }

    /// Returns the lines of `[signals]`, in the order of the file.
    pub fn signals(&self) -> &[Entry<Partner>] {
        &self.signals
    }

    /// Returns the lines of `[scopes]`, in the order of the file.
    pub fn scopes(&self) -> &[Entry<String>] {
        &self.scopes
    }

    /// Returns the names in `ignore` and `leave`.
    pub fn left_out(&self) -> impl Iterator<Item = &Entry<()>> {
        self.ignore.iter().chain(&self.leave)
    }

    /// Returns a fault of a line; `field` is the golden name.
    pub fn fault(
        &self,
        line: usize,
        field: &str,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Fault {
        Fault::new(&self.file, line, field, problem, allowed)
    }
}

fn partner(value: &Value) -> Result<Partner, (String, &'static str)> {
    let (text, delay) = match value {
        Value::String(text) => (text, 0),
        Value::Table(table) => {
            if let Some(key) = table
                .keys()
                .find(|key| !matches!(key.as_str(), "name" | "delay"))
            {
                // An unquoted path is a nested table.
                return Err((
                    format!("unknown key {key}"),
                    "name and delay; a golden name with dots stands in quotes",
                ));
            }
            let Some(Value::String(text)) = table.get("name") else {
                return Err(("no name in it".into(), PARTNER));
            };
            let delay = match table.get("delay") {
                None => 0,
                Some(Value::Integer(delay)) if *delay >= 0 => delay.unsigned_abs(),
                Some(delay) => {
                    return Err((
                        format!("a delay of {delay}"),
                        "a whole number of ticks from 0",
                    ));
                }
            };
            (text, delay)
        }
        other => return Err((format!("is {other}"), PARTNER)),
    };
    let (name, invert) = match text.strip_prefix('!') {
        Some(name) => (name, true),
        None => (text.as_str(), false),
    };
    Ok(Partner {
        name: name.trim().to_owned(),
        invert,
        delay,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn refuse(text: &str, refusal: &str) {
        let fault = Map::parse("m.toml", text).unwrap_err().to_string();
        assert_eq!(fault, refusal);
    }

    #[test]
    fn entries_know_their_lines() {
        let text = "ignore = [\n  \"t.a\",\n  \"t.b\"]\n[scopes]\n\"t.z\" = \"u\"\n\"t.c\" = \"v\"\n[signals]\n\"t.s\" = { name = \"!u.s\", delay = 3 }\n";
        let map = Map::parse("m.toml", text).unwrap();
        let lines = |lines: &mut dyn Iterator<Item = usize>| lines.collect::<Vec<_>>();
        assert_eq!(
            lines(&mut map.ignore.iter().map(|entry| entry.line)),
            [2, 3]
        );
        assert_eq!(
            lines(&mut map.scopes.iter().map(|entry| entry.line)),
            [5, 6]
        );
        let partner = Partner {
            name: "u.s".into(),
            invert: true,
            delay: 3,
        };
        let signal = Entry {
            line: 8,
            golden: "t.s".into(),
            other: partner,
        };
        assert_eq!(map.signals, [signal]);
    }

    #[test]
    fn what_is_no_map_is_refused_with_its_line() {
        const KEYS: &str = "ignore = [\"golden name\"] and leave = [\"port out\"] first, then [scopes] and [signals] with lines of \"golden name\" = \"other name\"";
        let partner = format!("; allowed: {PARTNER}");
        refuse(
            "\n[signal]\n",
            &format!(
                "m.toml:2: [signal]: unknown field `signal`, expected one of `ignore`, `leave`, `scopes`, `signals`; allowed: {KEYS}"
            ),
        );
        refuse(
            "[signals]\n\"t.a\" = \"u\"\n\"t.a\" = \"v\"\n",
            &format!("m.toml:3: \"t.a\": duplicate key; allowed: {KEYS}"),
        );
        refuse(
            "[scopes]\n\"t.a\" = 3\n",
            &format!(
                "m.toml:2: \"t.a\": invalid type: integer `3`, expected a string; allowed: {KEYS}"
            ),
        );
        refuse(
            "[signals]\n\"t.a\" = 3\n",
            &format!("m.toml:2: t.a: is 3{partner}"),
        );
        refuse(
            "[signals]\n\"t.a\" = { delay = 1 }\n",
            &format!("m.toml:2: t.a: no name in it{partner}"),
        );
        refuse(
            "[signals]\n\"t.a\" = { name = \"u\", delay = -1 }\n",
            "m.toml:2: t.a: a delay of -1; allowed: a whole number of ticks from 0",
        );
        refuse(
            "[signals]\nt.a = \"u\"\n",
            "m.toml:2: t: unknown key a; allowed: name and delay; a golden name with dots stands in quotes",
        );
        refuse(
            "[signals]\nignore = [\"t.a\"]\n",
            "m.toml:2: ignore: stands below [signals]; allowed: ignore and leave above [scopes] and [signals]",
        );
    }
}
