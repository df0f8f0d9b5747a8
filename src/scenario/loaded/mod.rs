mod errors;

use super::{BARE, BARE_LOG, Runnable, Scenario};
use crate::input::{DRAWINGS, Fault, Kind, POSITION_LOGS, read_string_of};
use crate::settings::{self, Place, SettingError};
use errors::{key_of, of_lists, split};
use serde::Deserialize;
use serde_path_to_error::Segment;
use std::path::Path;
use toml::de::{DeTable, Deserializer};
use toml::{Spanned, Table, Value};

/// File name of an override in faults.
const SET: &str = "--set";

/// The key that chooses the circuit.
const CIRCUIT: &str = "circuit";

/// A scenario together with the text it was read from, so that faults can name its lines.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The scenario.
    pub scenario: Scenario,
    /// Its file; `None` if its keys are only defaults and overrides.
    file: Option<String>,
    text: String,
    /// Keys that were overridden.
    overridden: Vec<String>,
}

/// The largest scenario in bytes: its tables take several times the memory of their text.
const LARGEST: u64 = 16 << 20;

impl Loaded {
    /// Reads a scenario file, with `key=value` overrides. The input and the directories of
    /// subroutines are relative to the file; those that an override gives are not.
    ///
    /// # Errors
    /// The file cannot be read, is not TOML, has an unknown key, a value of the wrong type, or
    /// lacks a key; or an override is none of `key=value`.
    pub fn read(path: &Path, sets: &[String]) -> Result<Self, Fault> {
        let name = path.display().to_string();
        let text = read_string_of(path, LARGEST, "a scenario in TOML")?;
        let mut loaded = Self::parse(&name, &text, sets)?;
        let given = loaded.overrides("input");
        let run = loaded.scenario.run_mut();
        if let (Some(input), Some(directory)) = (&mut run.input, path.parent())
            && !given
        {
            *input = directory.join(&*input);
        }
        let given = loaded.overrides("program") || loaded.overrides("program.subroutine_path");
        let paths = &mut loaded.scenario.run_mut().program.subroutine_path;
        if let Some(directory) = path.parent().filter(|_| !given) {
            paths
                .iter_mut()
                .for_each(|path| *path = directory.join(&*path));
        }
        Ok(loaded.with_tables_beside(path))
    }

    /// The tables that it names, and no override, are in the directory of `path`.
    #[must_use]
    pub fn with_tables_beside(mut self, path: &Path) -> Self {
        let given = self.overrides("pattern");
        if let (Scenario::PulseInterpolator(keys), Some(directory)) =
            (&mut self.scenario, path.parent())
            && !given
        {
            for pattern in &mut keys.settings.pattern {
                pattern.table = directory.join(&pattern.table);
            }
        }
        self
    }

    /// Reads a scenario from text that is called `file` in faults.
    ///
    /// # Errors
    /// An error of [`Loaded::read`].
    pub fn parse(file: &str, text: &str, sets: &[String]) -> Result<Self, Fault> {
        let loaded = Self::build(file, text, sets)?;
        Ok(Loaded {
            file: Some(file.to_owned()),
            ..loaded
        })
    }

    /// A scenario of defaults and overrides for an input that is given by itself.
    ///
    /// # Errors
    /// The input has no known extension or is a scenario; an override is wrong, or chooses a circuit
    /// that does not take such an input.
    pub fn bare(input: &Path, sets: &[String]) -> Result<Self, Fault> {
        Self::bare_of(&input.display().to_string(), Kind::of(input)?, sets)
    }

    /// A scenario of defaults and overrides for an input of this name and kind.
    ///
    /// # Errors
    /// The input is a scenario; an override is wrong, or chooses a circuit that does not take such
    /// an input.
    pub fn bare_of(name: &str, kind: Kind, sets: &[String]) -> Result<Self, Fault> {
        let (text, others) = match kind {
            Kind::PositionLog => (BARE_LOG, Runnable::LeadAngle.name().to_owned()),
            Kind::Drawing => (BARE, format!("another circuit, or {POSITION_LOGS}")),
            Kind::Scenario => {
                let allowed = format!("{DRAWINGS}; {POSITION_LOGS}");
                return Err(Fault::new(name, 0, "file", "is a scenario", allowed));
            }
        };
        if let Some(circuit) = chosen(&pairs(sets)?)?
            && !circuit.takes(kind)
        {
            let problem = format!("{} does not take {name}, {kind}", circuit.name());
            return Err(Fault::new(SET, 0, CIRCUIT, problem, others));
        }
        let loaded = Self::build(SET, text, sets)?;
        if loaded.overrides("input") {
            let (problem, allowed) = (format!("{name} is the input"), "input with a scenario only");
            return Err(Fault::new(SET, 0, "input", problem, allowed));
        }
        Ok(loaded)
    }

    fn build(file: &str, text: &str, sets: &[String]) -> Result<Self, Fault> {
        let mut pairs = pairs(sets)?;
        // The circuit decides which other keys there are.
        pairs.sort_by_key(|(key, _)| *key != CIRCUIT);
        let circuit = chosen(&pairs)?;
        let mut read = errors::read(file, text, circuit)?;
        let mut overridden = Vec::new();
        let parsed: Result<Table, _> = text.parse();
        let mut table = parsed.map_err(|error| errors::fault(file, text, &error))?;
        let mut pairs = pairs.into_iter().peekable();
        while let Some((key, value)) = pairs.next() {
            let job = circuit.or_else(|| circuit_of(&table));
            let defaults = job.map(|job| job.keys().1).unwrap_or_default();
            let unread = value.as_str().and_then(settings::unread);
            insert(&mut table, &defaults.0, key, value)
                .map_err(|(problem, allowed)| Fault::new(SET, 0, key, problem, allowed))?;
            overridden.push(key.to_owned());
            // Another circuit may need all of them.
            if circuit.is_some() && pairs.peek().is_some() {
                continue;
            }
            // The table is read from text again: reading it from a tree needs a second copy of all
            // readers.
            let text = table.to_string();
            let table = DeTable::parse(&text).map_err(|error| errors::fault(SET, &text, &error))?;
            let refuse = |error| {
                let fault = set_fault(job, key, &error);
                match unread {
                    Some(problem) if fault.problem.starts_with(NO_TEXT) => {
                        Fault { problem, ..fault }
                    }
                    _ => fault,
                }
            };
            read = Some(scenario(&table).map_err(refuse)?);
        }
        let no_scenario = || Fault::new(file, 0, "file", "is no scenario", "a scenario in TOML");
        Ok(Loaded {
            scenario: read.ok_or_else(no_scenario)?,
            file: None,
            text: text.to_owned(),
            overridden,
        })
    }

    /// True if the scenario was made for an input given by itself.
    pub fn is_bare(&self) -> bool {
        self.file.is_none()
    }

    /// Returns true if an override gave this key.
    pub fn overrides(&self, key: &str) -> bool {
        self.overridden.iter().any(|other| other == key)
    }

    /// A fault of a setting, with the line it stands in.
    pub fn refuse(&self, error: SettingError) -> Fault {
        let SettingError {
            field,
            place,
            problem,
            allowed,
        } = error;
        match place {
            None => self.fault(field, problem, allowed),
            Some(Place::Element(axis)) => {
                self.fault(field, format!("{problem} for {axis}"), allowed)
            }
            Some(Place::Table(name)) => self.part_fault(name, field, problem, allowed),
            Some(Place::Row(name, index)) => {
                self.table_fault((name, index), field, problem, allowed)
            }
        }
    }

    /// A fault of the value of `key`, with the line it stands in.
    pub fn fault(&self, key: &str, problem: String, allowed: String) -> Fault {
        if self.overrides(key) {
            return Fault::new(SET, 0, key, problem, allowed);
        }
        // An absent key has its default: the file as a whole is at fault.
        let line = self.text.lines().position(|line| key_of(line) == key);
        let line = line.map_or(0, |before| before + 1);
        self.given(line, key.to_owned(), problem, allowed)
    }

    /// A fault of what no override gave: of a line of the file, or of a default.
    fn given(&self, line: usize, field: String, problem: String, allowed: String) -> Fault {
        match &self.file {
            Some(file) => {
                let fault = Fault::new(file, line, field, problem, allowed);
                match errors::value_in(&self.text, line) {
                    Some(value) => fault.marked(self.text.as_bytes(), &value),
                    None => fault,
                }
            }
            None => Fault::new(SET, 0, format!("{field} (default)"), problem, allowed),
        }
    }

    /// A fault of the value of `key` in the table `[name]`, with the line it stands in; where it has
    /// its default, the line of the table.
    fn part_fault(&self, name: &str, key: &str, problem: String, allowed: String) -> Fault {
        let field = format!("{name}.{key}");
        if self.overrides(name) || self.overrides(&field) {
            return Fault::new(SET, 0, field, problem, allowed);
        }
        let mut lines = self.text.lines().enumerate();
        let header = lines.find(|(_, line)| {
            let inner = line.trim_start().strip_prefix('[');
            let inner = inner.and_then(|rest| rest.split_once(']'));
            inner.is_some_and(|(header, _)| header.trim() == name)
        });
        let Some((header, _)) = header else {
            // Not given, or on one line.
            let fault = self.fault(name, problem, allowed);
            return Fault { field, ..fault };
        };
        let mut keys = lines.take_while(|(_, line)| !line.trim_start().starts_with('['));
        let line = keys.find(|(_, line)| key_of(line) == key);
        let line = line.map_or(header, |(line, _)| line) + 1;
        self.given(line, field, problem, allowed)
    }

    /// A fault of the value of `key` in the table `[[name]]` number `index` from 0, with the line
    /// it stands in; where it has its default, the line of the table.
    pub fn table_fault(
        &self,
        (name, index): (&str, usize),
        key: &str,
        problem: String,
        allowed: String,
    ) -> Fault {
        let mut headers = self.text.lines().enumerate().filter(|(_, line)| {
            let inner = line.trim_start().strip_prefix("[[");
            let inner = inner.and_then(|rest| rest.split_once("]]"));
            inner.is_some_and(|(header, _)| header.trim().trim_matches(['"', '\'']) == name)
        });
        let field = format!("{name} {index}: {key}");
        let header = headers.nth(index).filter(|_| !self.overrides(name));
        let Some((header, _)) = header else {
            // Given in an override, or on one line: the fault is in the list.
            let fault = self.fault(name, problem, allowed);
            return Fault { field, ..fault };
        };
        let lines = self.text.lines().enumerate().skip(header + 1);
        let mut keys = lines.take_while(|(_, line)| !line.trim_start().starts_with('['));
        let line = keys.find(|(_, line)| key_of(line) == key);
        let line = line.map_or(header, |(line, _)| line) + 1;
        self.given(line, field, problem, allowed)
    }
}

/// Returns the keys and values of overrides.
fn pairs(sets: &[String]) -> Result<Vec<(&str, Value)>, Fault> {
    sets.iter().map(|set| key_value(set)).collect()
}

/// Returns the circuit that overrides choose, the last of several; `None` if they choose none.
///
/// # Errors
/// An override that names no circuit.
fn chosen(pairs: &[(&str, Value)]) -> Result<Option<Runnable>, Fault> {
    let circuits = pairs.iter().filter(|(key, _)| *key == CIRCUIT);
    let circuits = circuits.map(|(_, circuit)| {
        let text = Table::from_iter([(CIRCUIT.to_owned(), circuit.clone())]).to_string();
        let table = DeTable::parse(&text).map_err(|error| errors::fault(SET, &text, &error))?;
        head(&table).map_err(|error| set_fault(None, CIRCUIT, &error))
    });
    let circuits: Vec<_> = circuits.collect::<Result<_, _>>()?;
    Ok(circuits.last().copied())
}

/// Start of the problem of a value that is text, of a key that takes none.
const NO_TEXT: &str = "invalid type: string";

/// Problem of a key that is missing.
const MISSING: &str = "missing, and has no default";

/// The circuit that a table names, if there is one of this name.
fn circuit_of(table: &Table) -> Option<Runnable> {
    table.get(CIRCUIT)?.clone().try_into().ok()
}

/// Part of a scenario that decides how the rest is read.
#[derive(Deserialize)]
struct Head {
    circuit: Runnable,
}

/// An error and its place in the scenario.
type Located = serde_path_to_error::Error<toml::de::Error>;

fn read<'de, T: Deserialize<'de>>(table: &Spanned<DeTable<'de>>) -> Result<T, Located> {
    serde_path_to_error::deserialize(Deserializer::from(table.clone()))
}

/// The circuit of a scenario.
fn head(table: &Spanned<DeTable<'_>>) -> Result<Runnable, Located> {
    let Head { circuit } = read(table)?;
    Ok(circuit)
}

/// A scenario with the keys of its circuit.
fn scenario(table: &Spanned<DeTable<'_>>) -> Result<Scenario, Located> {
    Ok(match head(table)? {
        Runnable::PulseInterpolator => Scenario::PulseInterpolator(read(table)?),
        Runnable::LinearInterpolator => Scenario::LinearInterpolator(read(table)?),
        Runnable::LeadAngle => Scenario::LeadAngle(read(table)?),
        Runnable::ArcGenerator => Scenario::ArcGenerator(read(table)?),
        Runnable::TrajectoryController => Scenario::TrajectoryController(read(table)?),
        Runnable::Machine => Scenario::Machine(read(table)?),
    })
}

/// Gives a key a value; `name.key` is one of the table `[name]`, which begins with its defaults if it
/// is not there. Where that cannot be, returns the problem and what is allowed.
fn insert(
    table: &mut Table,
    defaults: &Table,
    key: &str,
    value: Value,
) -> Result<(), (String, String)> {
    let Some((name, inner)) = key.split_once('.') else {
        table.insert(key.to_owned(), value);
        return Ok(());
    };
    let initial = defaults.get(name).and_then(Value::as_table);
    let initial = initial.cloned().unwrap_or_default();
    // The reader refuses a table that there is not, and names it.
    let place = table
        .entry(name)
        .or_insert_with(|| Value::Table(initial.clone()));
    match place {
        Value::Table(table) => insert(table, &initial, inner, value),
        Value::Array(_) => {
            let allowed = format!("the whole list: {name}=[{{key=value,…}},…]");
            Err((format!("{name} is a list"), allowed))
        }
        _ => Err((
            format!("{name} has no keys inside"),
            format!("a value of it: {name}=value"),
        )),
    }
}

/// Returns the fault of an override: of its key, or of a key within its value.
fn set_fault(job: Option<Runnable>, key: &str, error: &Located) -> Fault {
    let mut field = String::new();
    for segment in error.path() {
        match segment {
            Segment::Seq { index } => field += &format!(" {index}:"),
            Segment::Map { key } => {
                field += match field.as_str() {
                    "" => "",
                    list if list.ends_with(':') => " ",
                    _ => ".",
                };
                field += key;
            }
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    let message = error.inner().message();
    if let Some(missing) = errors::missing(message) {
        let field = match field.as_str() {
            "" => missing.to_owned(),
            within if within.ends_with(':') => format!("{within} {missing}"),
            within => format!("{within}.{missing}"),
        };
        let allowed = errors::allowed(job, error.path(), Some(missing));
        return Fault::new(SET, 0, field, MISSING, allowed);
    }
    let field = if field.is_empty() { key } else { &field };
    let (problem, allowed) = of_lists(field, message).unwrap_or_else(|| split(message));
    errors::refined(Fault::new(SET, 0, field, problem, allowed), job, error)
}

fn key_value(set: &str) -> Result<(&str, Value), Fault> {
    let allowed = "key=value with a key of the scenario";
    let pair = settings::key_value(set);
    let field = if set.is_empty() { "\"\"" } else { set };
    let (key, text) = pair.map_err(|problem| Fault::new(SET, 0, field, problem, allowed))?;
    Ok((key, settings::value(text)))
}

#[cfg(test)]
mod tests;
