//! Inputs of a circuit, one line per tick.
//!
//! A CSV has the names of ports in its head:
//!
//! ```text
//! rst, target_x, speed          ports in any order, and a reset
//! 1,   0,        0
//! 0,   -1500,    0x20_0000      decimal, or bits as 0x… and 0b…
//! ```
//!
//! A `.stimulus` has a hexadecimal word per line, as
//! [`StimulusFile`](crate::trace::StimulusFile) writes: the ports side by side, the first lowest,
//! and the reset above them. Blank lines and lines that begin with `#` are skipped in both.

use super::{Fault, Faults, LARGEST_FILE, brief, counted, read_bytes};
use crate::nearest::{meant, nearest};
use crate::netlist::Shape;
use std::ops::Range;
use std::path::Path;

/// Least number of ticks.
const LEAST: usize = 2;

/// Column of the reset.
const RST: &str = "rst";

/// Input port of a circuit.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputPort {
    /// Path below the circuit.
    pub name: String,
    /// Name in Verilog, which a column may have too.
    pub verilog: String,
    /// Kind and width.
    pub shape: Shape,
}

/// Inputs of a circuit for a number of ticks.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PortInputs {
    ports: usize,
    /// Bits of all ports, tick by tick.
    words: Vec<u64>,
    resets: Vec<bool>,
    /// Paths of the ports that no input is given for: they stay low.
    pub low: Vec<String>,
}

impl PortInputs {
    /// Begins inputs of a number of ports; those in `low` are told to be low throughout.
    pub(crate) fn new(ports: usize, low: Vec<String>) -> Self {
        PortInputs {
            ports,
            low,
            ..PortInputs::default()
        }
    }

    /// Adds a tick: the bits of each port, and true for a reset.
    pub(crate) fn push(&mut self, words: &[u64], rst: bool) {
        self.words.extend_from_slice(words);
        self.resets.push(rst);
    }

    /// Returns the number of ticks.
    pub fn ticks(&self) -> usize {
        self.resets.len()
    }

    /// Returns the bits of each port in a tick, and true if the tick has a reset.
    pub fn tick(&self, tick: usize) -> Option<(&[u64], bool)> {
        let rst = *self.resets.get(tick)?;
        let first = tick * self.ports;
        Some((self.words.get(first..first + self.ports)?, rst))
    }
}

/// Reads a file with inputs for these ports: a `.csv` or a `.stimulus`.
///
/// # Errors
/// Returns an error for a file that cannot be read or has another extension, and the errors of
/// [`read_csv`] and [`read_words`].
pub fn read_path(path: &Path, ports: &[InputPort]) -> Result<PortInputs, Fault> {
    let name = path.display().to_string();
    let extension = path.extension().and_then(|text| text.to_str());
    let read = match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("csv") => read_csv,
        Some("stimulus") => read_words,
        _ => {
            let problem = "the extension names no format";
            let allowed = "a table as .csv, hexadecimal words as .stimulus";
            return Err(Fault::new(&name, 0, "file", problem, allowed));
        }
    };
    read(&name, &read_bytes(path, LARGEST_FILE)?, ports)
}

/// File being read.
struct Source<'s> {
    file: &'s str,
    bytes: &'s [u8],
    text: &'s str,
}

/// Part of a line: its text and its bytes in the file.
#[derive(Debug, Clone)]
struct Word<'s> {
    text: &'s str,
    place: Range<usize>,
}

impl<'s> Source<'s> {
    fn new(file: &'s str, bytes: &'s [u8]) -> Result<Self, Fault> {
        let text = str::from_utf8(bytes).map_err(|error| {
            let before = &bytes[..error.valid_up_to()];
            let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
            Fault::new(file, line, "file", "not UTF-8", "text")
        })?;
        Ok(Source { file, bytes, text })
    }

    /// Returns the lines that count, with their numbers.
    fn lines(&self) -> impl Iterator<Item = (usize, Word<'s>)> + use<'s> {
        let mut at = 0;
        let lines = self.text.split_inclusive('\n').zip(1..);
        let lines = lines.map(move |(text, number)| {
            let place = at..at + text.len();
            at = place.end;
            (number, Word { text, place }.trimmed())
        });
        lines.filter(|(_, line)| !line.text.is_empty() && !line.text.starts_with('#'))
    }

    fn fault(
        &self,
        line: usize,
        field: &str,
        place: &Range<usize>,
        problem: impl Into<String>,
        allowed: impl Into<String>,
    ) -> Fault {
        let fault = Fault::new(self.file, line, field, problem, allowed);
        fault.marked(self.bytes, place)
    }

    /// Returns the inputs if there are enough ticks.
    fn enough(&self, inputs: PortInputs) -> Result<PortInputs, Fault> {
        match inputs.ticks() {
            LEAST.. => Ok(inputs),
            ticks => {
                let plural = if ticks == 1 { "" } else { "s" };
                let problem = format!("{ticks} tick{plural} in it");
                let allowed = format!("one line per tick, {LEAST} or more");
                Err(Fault::new(self.file, 0, "file", problem, allowed))
            }
        }
    }
}

impl<'s> Word<'s> {
    fn trimmed(&self) -> Self {
        let blank = |letter: char| letter.is_whitespace() || letter == '\u{feff}';
        let begin = self.text.len() - self.text.trim_start_matches(blank).len();
        let text = self.text.trim_matches(blank);
        let begin = self.place.start + begin;
        Word {
            text,
            place: begin..begin + text.len(),
        }
    }

    /// Returns the fields between commas.
    fn fields(&self) -> impl Iterator<Item = Word<'s>> + use<'s> {
        let mut at = self.place.start;
        self.text.split(',').map(move |text| {
            let place = at..at + text.len();
            at = place.end + 1;
            Word { text, place }.trimmed()
        })
    }
}

/// Column of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Column {
    Port(usize),
    Reset,
}

/// Reads a table with the names of ports in its head. `file` is the name of the file in errors.
///
/// # Errors
/// Returns an error for a head with an unknown name or the same port twice, a line with another
/// number of fields than the head, a field that is no number or does not fit its port, and fewer
/// than two ticks.
pub fn read_csv(file: &str, bytes: &[u8], ports: &[InputPort]) -> Result<PortInputs, Fault> {
    let source = Source::new(file, bytes)?;
    let mut lines = source.lines();
    let Some((number, head)) = lines.next() else {
        let allowed = format!("a head with names of ports: {}", names(ports));
        return Err(Fault::new(file, 0, "file", "nothing in it", allowed));
    };
    let columns = columns(&source, number, &head, ports)?;
    let low = ports.iter().enumerate();
    let low = low.filter(|(index, _)| !columns.contains(&Column::Port(*index)));
    let mut inputs = PortInputs {
        ports: ports.len(),
        low: low.map(|(_, port)| port.name.clone()).collect(),
        ..PortInputs::default()
    };
    let mut faults = Faults::default();
    for (number, line) in lines {
        let first = inputs.words.len();
        inputs.words.resize(first + ports.len(), 0);
        inputs.resets.push(false);
        let fields: Vec<Word<'_>> = line.fields().collect();
        let mut found = None;
        if fields.len() != columns.len() {
            let problem = counted(fields.len(), "field");
            let allowed = format!("{} as in the head", columns.len());
            found = Some(source.fault(number, "line", &line.place, problem, allowed));
        }
        for (column, (field, &of)) in fields.iter().zip(&columns).enumerate() {
            let (name, shape) = match of {
                Column::Port(port) => (ports[port].name.as_str(), ports[port].shape),
                Column::Reset => (RST, crate::netlist::BIT),
            };
            match bits(field.text, shape) {
                Ok(bits) => match of {
                    Column::Port(port) => inputs.words[first + port] = bits,
                    Column::Reset => inputs.resets[first / ports.len().max(1)] = bits == 1,
                },
                Err((problem, allowed)) => {
                    let field_name = format!("column {}, {name}", column + 1);
                    let fault = source.fault(number, &field_name, &field.place, problem, allowed);
                    found.get_or_insert(fault);
                }
            }
        }
        if found.is_some_and(|fault| !faults.add(fault)) {
            break;
        }
    }
    faults.or(|| source.enough(inputs))
}

fn names(ports: &[InputPort]) -> String {
    let names = ports.iter().map(|port| port.name.as_str()).chain([RST]);
    names.collect::<Vec<_>>().join(", ")
}

/// Returns the columns that a head names.
fn columns(
    source: &Source<'_>,
    line: usize,
    head: &Word<'_>,
    ports: &[InputPort],
) -> Result<Vec<Column>, Fault> {
    let mut columns = Vec::new();
    let mut faults = Faults::default();
    for (field, number) in head.fields().zip(1..) {
        let is = |port: &InputPort| port.name == field.text || port.verilog == field.text;
        let column = match ports.iter().position(is) {
            Some(port) => Some(Column::Port(port)),
            None => (field.text == RST).then_some(Column::Reset),
        };
        let problem = match column {
            Some(column) if columns.contains(&column) => "a second column of this port".to_owned(),
            Some(column) => {
                columns.push(column);
                continue;
            }
            None => {
                let near = nearest(field.text, ports.iter().map(|port| port.name.as_str()));
                format!("no input port is called so{}", meant(near))
            }
        };
        let name = format!("column {number}, {}", brief(field.text));
        let allowed = format!("each at most once: {}", names(ports));
        if !faults.add(source.fault(line, &name, &field.place, problem, allowed)) {
            break;
        }
    }
    faults.or(|| Ok(columns))
}

/// Returns the bits of a number, or what is wrong with it and what is allowed.
fn bits(text: &str, shape: Shape) -> Result<u64, (String, String)> {
    let (least, greatest) = shape.range();
    let mask = u64::MAX >> (64 - shape.width);
    let plain = text.replace('_', "");
    let digits = |radix: u32, digits: &str| match digits.starts_with(['+', '-']) {
        true => None,
        false => u128::from_str_radix(digits, radix).ok(),
    };
    let of_bits = match plain.get(..2).map(str::to_ascii_lowercase).as_deref() {
        Some("0x") => Some(digits(16, &plain[2..])),
        Some("0b") => Some(digits(2, &plain[2..])),
        _ => None,
    };
    let problem = match of_bits {
        Some(Some(bits)) if bits <= u128::from(mask) => return Ok(bits as u64),
        Some(Some(_)) => format!("{} has more than {} bits", brief(text), shape.width),
        Some(None) => format!("is '{}'", brief(text)),
        None => match plain.parse::<i128>() {
            Ok(number) if (least..=greatest).contains(&number) => {
                return Ok(number as u64 & mask);
            }
            Ok(_) => format!("{} does not fit", brief(text)),
            Err(_) => format!("is '{}'", brief(text)),
        },
    };
    let allowed = format!("{least} to {greatest}, or bits as 0x1f and 0b101");
    Err((problem, allowed))
}

/// Reads a hexadecimal word per line: the ports side by side, the first lowest, and the reset above
/// them. `file` is the name of the file in errors.
///
/// # Errors
/// Returns an error for a line that is no hexadecimal word or has more bits, and for fewer than two
/// ticks.
pub fn read_words(file: &str, bytes: &[u8], ports: &[InputPort]) -> Result<PortInputs, Fault> {
    let source = Source::new(file, bytes)?;
    let wide: usize = ports.iter().map(|port| port.shape.width).sum();
    let mut inputs = PortInputs {
        ports: ports.len(),
        ..PortInputs::default()
    };
    let mut faults = Faults::default();
    for (number, line) in source.lines() {
        let wrong = line
            .text
            .bytes()
            .position(|letter| !letter.is_ascii_hexdigit());
        let digits = line.text.trim_start_matches('0');
        let top = digits.chars().next().and_then(|digit| digit.to_digit(16));
        let length = top.map_or(0, |top| {
            4 * digits.len() - (top.leading_zeros() as usize - 28)
        });
        let problem = match wrong {
            Some(at) => {
                let begin = line.place.start + at;
                let place = begin..begin + 1;
                Some((place, format!("column {}: no hexadecimal digit", at + 1)))
            }
            None if length > wide + 1 => Some((line.place.clone(), format!("{length} bits"))),
            None => None,
        };
        if let Some((place, problem)) = problem {
            let allowed = format!("a hexadecimal word of {} bits", wide + 1);
            if !faults.add(source.fault(number, "word", &place, problem, allowed)) {
                break;
            }
            continue;
        }
        let mut low = 0;
        for port in ports {
            inputs.words.push(part(line.text, low, port.shape.width));
            low += port.shape.width;
        }
        inputs.resets.push(part(line.text, wide, 1) == 1);
    }
    faults.or(|| source.enough(inputs))
}

/// Returns bits of a hexadecimal word from `low` up.
fn part(word: &str, low: usize, width: usize) -> u64 {
    let digit = |place: usize| {
        let from_left = word.len().checked_sub(place + 1)?;
        char::from(word.as_bytes()[from_left]).to_digit(16)
    };
    let mut bits = 0_u128;
    for place in (low / 4..=(low + width - 1) / 4).rev() {
        bits = bits << 4 | u128::from(digit(place).unwrap_or(0));
    }
    (bits >> (low % 4)) as u64 & (u64::MAX >> (64 - width))
}

#[cfg(test)]
mod tests;
