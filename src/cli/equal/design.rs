//! The user's design, as the command line describes it.

use super::{Arguments, Failure, refused};
use motion_rtl::compare::{Map, is_identifier};
use motion_rtl::registry::{Base, Entry, Pair};
use std::path::{Path, PathBuf};

/// Value of `--reset` for a design without a reset.
const NONE: &str = "none";

/// A design.
#[derive(Debug)]
pub struct Design {
    /// Paths of its files.
    pub files: Vec<PathBuf>,
    /// True if they are VHDL, where case does not count.
    pub is_vhdl: bool,
    pub top: String,
    pub clock: String,
    /// Its reset, and true if it is active low.
    pub reset: Option<(String, bool)>,
    pub map: Map,
    parameters: Vec<Parameter>,
}

/// A parameter of the design's module.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Parameter {
    name: String,
    value: Value,
}

/// Value of a parameter.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Value {
    /// A number in Verilog.
    Number(String),
    /// The value of a key of the circuit, and a number added to it.
    Key(String, i64),
}

/// Checks a name of the design.
fn identifier<'a>(field: &'static str, name: &'a str) -> Result<&'a str, Failure> {
    match is_identifier(name) {
        true => Ok(name),
        false => Err(refused(
            field,
            format!("{name:?} is no name in Verilog"),
            "letters, digits, _ and $, with a letter or _ first",
        )),
    }
}

/// Returns the path of a file of the design, as a script names it.
fn file(path: &Path) -> Result<PathBuf, Failure> {
    let shown = path.display();
    let extension = path.extension().and_then(|extension| extension.to_str());
    if !matches!(extension, Some("v" | "sv" | "vhd" | "vhdl")) {
        let allowed = "Verilog (.v), SystemVerilog (.sv) or VHDL (.vhd)";
        return Err(refused(
            "DESIGN",
            format!("{shown} has another extension"),
            allowed,
        ));
    }
    let whole = path.canonicalize().map_err(|error| {
        refused(
            "DESIGN",
            format!("{shown}: {error}"),
            "a file that can be read",
        )
    })?;
    match whole
        .to_str()
        .filter(|text| !text.contains(['"', '\\', '\n']))
    {
        Some(_) if whole.is_file() => Ok(whole),
        Some(_) => Err(refused("DESIGN", format!("{shown} is no file"), "a file")),
        None => {
            let allowed = "a path in UTF-8 without quotes, backslashes and line breaks";
            Err(refused(
                "DESIGN",
                format!("{} is its path", whole.display()),
                allowed,
            ))
        }
    }
}

/// True for a file in VHDL.
fn is_vhdl(path: &Path) -> bool {
    let extension = path.extension().and_then(|extension| extension.to_str());
    matches!(extension, Some("vhd" | "vhdl"))
}

/// Splits a parameter of the design's module from its value.
fn parameter(text: &str) -> Option<Parameter> {
    let (name, value) = text.split_once('=')?;
    let allowed = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '\'' | '-' | '.');
    let is_number = |value: &str| {
        value.starts_with(|c: char| c.is_ascii_digit() || c == '-') && value.chars().all(allowed)
    };
    let value = match is_number(value) {
        true => Value::Number(value.to_owned()),
        false => {
            let sign = value.find(['+', '-']).unwrap_or(value.len());
            let (key, plus) = value.split_at(sign);
            let plus = match plus {
                "" => 0,
                plus => plus.parse().ok()?,
            };
            let first = key.starts_with(|c: char| c.is_ascii_lowercase());
            if !first || !key.chars().all(allowed) {
                return None;
            }
            Value::Key(key.to_owned(), plus)
        }
    };
    is_identifier(name).then(|| Parameter {
        name: name.to_owned(),
        value,
    })
}

/// Returns the value of a key, by its name or the last part of its name.
fn of_key(sizes: &[(String, u64)], key: &str) -> Option<u64> {
    let exact = sizes.iter().find(|(name, _)| name == key);
    let last = || {
        let mut ends = sizes
            .iter()
            .filter(|(name, _)| name.rsplit('.').next() == Some(key));
        ends.next().filter(|_| ends.next().is_none())
    };
    exact.or_else(last).map(|(_, value)| *value)
}

impl Design {
    pub fn new(arguments: &Arguments, entry: &Entry, pairs: &[Pair]) -> Result<Self, Failure> {
        let reset = match arguments.reset.as_str() {
            NONE => None,
            name => {
                let (name, low) = match name.strip_prefix('!') {
                    Some(name) => (name, true),
                    None => (name, false),
                };
                Some((identifier("--reset", name)?.to_owned(), low))
            }
        };
        if arguments.after_reset && reset.is_none() {
            let allowed = "a design with a reset, or a comparison from power-on";
            return Err(refused(
                "--after-reset",
                "there is no reset".to_owned(),
                allowed,
            ));
        }
        let top = arguments.top.as_deref().unwrap_or(entry.name);
        let files = arguments.designs.iter().map(|path| file(path));
        let parameters = arguments.param.iter().map(|text| {
            parameter(text).ok_or_else(|| {
                refused(
                    "--param",
                    format!("{text:?} gives no parameter a value"),
                    "NAME=VALUE with a number in Verilog or a key of the circuit, such as WIDTH=16, \
                     LIMIT=12'sd622 or WIDTH=value+1",
                )
            })
        });
        let files: Vec<PathBuf> = files.collect::<Result<_, _>>()?;
        let vhdl = files.iter().filter(|path| is_vhdl(path)).count();
        if vhdl != 0 && vhdl != files.len() {
            let problem = "some are VHDL, some are Verilog".to_owned();
            return Err(refused("DESIGN", problem, "files in one language"));
        }
        // Case does not count in VHDL.
        let name = |name: &str| match vhdl {
            0 => name.to_owned(),
            _ => name.to_ascii_lowercase(),
        };
        let design = Design {
            is_vhdl: vhdl != 0,
            clock: name(identifier("--clock", &arguments.clock)?),
            map: match &arguments.map {
                Some(path) => Map::read(path)?,
                None => Map::default(),
            },
            top: name(identifier("--top", top)?),
            reset: reset.map(|(reset, low)| (name(&reset), low)),
            files,
            parameters: parameters.collect::<Result<_, _>>()?,
        };
        design.parameters(entry, pairs)?;
        Ok(design)
    }

    /// Returns the paths of the files as arguments of a program.
    pub fn paths(&self) -> impl Iterator<Item = String> {
        self.files.iter().map(|file| file.display().to_string())
    }

    /// Returns the values of the parameters for the full circuit, some keys changed.
    pub fn parameters(
        &self,
        entry: &Entry,
        pairs: &[Pair],
    ) -> Result<Vec<(String, String)>, Failure> {
        let sizes = entry.sizes(Base::Full, pairs);
        let value = |Parameter { name, value }: &Parameter| {
            let value = match value {
                Value::Number(number) => number.clone(),
                Value::Key(key, plus) => {
                    let value =
                        of_key(&sizes, key).and_then(|value| value.checked_add_signed(*plus));
                    let keys = sizes.iter().map(|(key, _)| key.as_str());
                    let keys: Vec<&str> = keys.collect();
                    let value = value.ok_or_else(|| {
                        let problem = format!("{name}={key}: {} has no such number", entry.name);
                        let allowed = format!("a number in Verilog, or one of {}", keys.join(", "));
                        refused("--param", problem, &allowed)
                    })?;
                    value.to_string()
                }
            };
            Ok((name.clone(), value))
        };
        self.parameters.iter().map(value).collect()
    }

    /// True if a parameter has the value of a key, so that the design can be made narrower.
    pub fn follows(&self) -> bool {
        let mut values = self.parameters.iter().map(|parameter| &parameter.value);
        values.any(|value| matches!(value, Value::Key(..)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_is_a_number_or_follows_a_key() {
        let value = |text: &str| parameter(text).map(|parameter| parameter.value);
        let number = |text: &str| Some(Value::Number(text.to_owned()));
        let key = |text: &str, plus| Some(Value::Key(text.to_owned(), plus));
        assert_eq!(value("LIMIT=12'sd622"), number("12'sd622"));
        assert_eq!(value("LIMIT=-3"), number("-3"));
        assert_eq!(value("W=widths.period"), key("widths.period", 0));
        assert_eq!(value("W=period+1"), key("period", 1));
        assert_eq!(value("W=period-2"), key("period", -2));
        for wrong in [
            "W",
            "W=",
            "W=1; delete",
            "W=period+",
            "W=period+1+1",
            "W=Q",
            "1=2",
        ] {
            assert_eq!(value(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_key_is_named_whole_or_by_its_end() {
        let sizes = [
            ("widths.period", 24),
            ("widths.units", 16),
            ("axes.units", 2),
        ];
        let sizes = sizes.map(|(key, value)| (key.to_owned(), value));
        assert_eq!(of_key(&sizes, "widths.units"), Some(16));
        assert_eq!(of_key(&sizes, "period"), Some(24));
        // Two keys end so.
        assert_eq!(of_key(&sizes, "units"), None);
    }
}
