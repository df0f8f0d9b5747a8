use super::Fault;
use super::blamed::below;
use super::invariant::stated;
use crate::engine::Watch;
use crate::hdl::{Circuit, Declaration, Value};
use crate::netlist::Role;
use crate::sim::{Described, Elaborated, RunError};
use crate::trace::value::show;
use crate::trace::{self, Clock, Start};
use rustc_hash::FxHasher;
use std::fmt::{self, Write as _};
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};

/// Number of ticks in the table, counted back from the violation.
const TICKS: usize = 8;
/// Greatest number of signals in the table.
const ROWS: usize = 40;

/// Input sequence that violates an invariant; [`reach`](super::reach()) finds a shortest one.
///
/// Prints the violation with its tick, and a table of the last ticks.
pub struct Counterexample<C: Circuit> {
    /// Inputs from power-on; the last are those of the tick at fault.
    pub inputs: Vec<C::In<Value>>,
    /// Tick at fault.
    pub tick: u64,
    /// Violated invariant.
    pub invariant: String,
    /// Signals at fault.
    pub signals: Vec<String>,
    /// Description of the violation.
    pub message: String,
    violation: Violation,
}

/// Counterexample without the circuit's type.
#[derive(Clone)]
pub struct Violation {
    invariant: String,
    fault: Fault,
    /// Inputs, port by port.
    ports: Vec<Vec<u64>>,
    table: String,
}

impl Violation {
    pub(super) fn new(
        model: &Elaborated,
        ports: Vec<Vec<u64>>,
        invariant: String,
        fault: Fault,
    ) -> Self {
        Violation {
            table: table(model, &ports, &fault.signals),
            ports,
            invariant,
            fault,
        }
    }

    /// Returns the words of the input ports from power-on; the last are those of the tick at fault.
    pub fn inputs(&self) -> &[Vec<u64>] {
        &self.ports
    }

    /// Returns the violated invariant.
    pub fn invariant(&self) -> &str {
        &self.invariant
    }

    /// Returns the signals at fault.
    pub fn signals(&self) -> &[String] {
        &self.fault.signals
    }

    /// Returns the tick at fault.
    pub fn tick(&self) -> u64 {
        (self.ports.len() as u64).saturating_sub(1)
    }

    /// Replays the sequence on a circuit and writes the waves and their save file into `dir`, named
    /// after circuit and invariant. Returns their paths.
    ///
    /// # Errors
    /// Returns an error if the files cannot be written.
    pub fn save(
        &self,
        circuit: &impl Described,
        clock: Clock,
        dir: &Path,
    ) -> Result<Vec<PathBuf>, RunError> {
        let of = (&self.ports[..], Start::default());
        save(circuit, (&self.invariant, ""), of, clock, dir)
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Fault { signals, message } = &self.fault;
        f.write_str(&report(self.tick(), &self.invariant, message, signals))?;
        f.write_str(&self.table)
    }
}

impl fmt::Debug for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<C: Circuit> Counterexample<C> {
    pub(super) fn of(violation: Violation, inputs: Vec<C::In<Value>>) -> Self {
        Counterexample {
            inputs,
            tick: violation.tick(),
            invariant: violation.invariant.clone(),
            signals: violation.fault.signals.clone(),
            message: violation.fault.message.clone(),
            violation,
        }
    }

    /// Returns the counterexample without the circuit's type.
    pub fn into_violation(self) -> Violation {
        self.violation
    }

    /// Replays the sequence on `circuit` and writes the waves and their save file into `dir`,
    /// named after circuit and invariant. Returns their paths.
    ///
    /// # Errors
    /// Returns an error if the files cannot be written.
    pub fn save(&self, circuit: &C, clock: Clock, dir: &Path) -> Result<Vec<PathBuf>, RunError> {
        self.violation.save(circuit, clock, dir)
    }
}

impl<C: Circuit> fmt::Display for Counterexample<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.violation, f)
    }
}

impl<C: Circuit> fmt::Debug for Counterexample<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Plays inputs and writes the waves and their save file into `dir`, named after circuit and
/// invariant, with `end` behind them. Returns their paths.
pub(super) fn save(
    circuit: &impl Described,
    (invariant, end): (&str, &str),
    (ports, start): (&[Vec<u64>], Start<'_>),
    clock: Clock,
    dir: &Path,
) -> Result<Vec<PathBuf>, RunError> {
    let model = circuit.described()?;
    let name = stem(model.name(), invariant) + end;
    let inputs = &mut ports.iter().cloned();
    trace::play(&model, start, inputs, clock, dir, &name)
}

/// Greatest length of a stem but for its mark: a file name may have 255 bytes.
const STEM: usize = 200;

/// Returns the stem of the file names. Names that would be lost or cut get a mark of their own.
pub(crate) fn stem(circuit: &str, invariant: &str) -> String {
    let name = format!("{circuit} {invariant}");
    let plain = |c: char| c.is_ascii_alphanumeric() || " _,.'-".contains(c);
    let written = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' });
    let mut stem: String = written.take(STEM).collect();
    if !name.chars().all(plain) || name.chars().count() > STEM {
        let mut hasher = FxHasher::default();
        name.hash(&mut hasher);
        // Writing to a string does not fail.
        let _ = write!(stem, "_{:08x}", hasher.finish() as u32);
    }
    stem
}

/// Returns the text above the table.
fn report(tick: u64, invariant: &str, message: &str, signals: &[String]) -> String {
    let signals = crate::sim::at_fault(signals);
    format!("tick {tick}: {}{signals}\n", stated(invariant, message))
}

/// Returns the table of the last ticks, one signal per row. Signals at fault come first and are
/// marked; words of memories come last. The last column shows the registers after the edge.
fn table(model: &Elaborated, inputs: &[Vec<u64>], at_fault: &[String]) -> String {
    let declarations = model.declarations();
    let leaves = &declarations.leaves;
    let is_word = |leaf: usize| {
        let mut memories = declarations.memories.iter();
        memories.any(|memory| (memory.first..memory.first + memory.words).contains(&leaf))
    };
    let mut engine = model.engine(Watch::All);
    let first = inputs.len().saturating_sub(TICKS);
    let mut columns = Vec::new();
    for (tick, i) in inputs.iter().enumerate() {
        engine.drive_all(i);
        engine.settle();
        if tick >= first {
            let values = (0..leaves.len()).map(|leaf| engine.word(leaf));
            columns.push(values.collect::<Vec<_>>());
        }
        engine.edge();
    }

    let text = |leaf: &Declaration, bits| show(leaf.shape, leaf.field.format, bits);
    let mut head = vec!["tick".to_owned()];
    head.extend((first..=inputs.len()).map(|tick| tick.to_string()));
    let mut rows = Vec::new();
    for (index, leaf) in leaves.iter().enumerate() {
        let path = leaf.path();
        let marked = at_fault.iter().any(|name| is_named(name, &path));
        let path = below(model.name(), &path);
        let mut row = vec![format!("{} {path}", if marked { '*' } else { ' ' })];
        row.extend(columns.iter().map(|values| text(leaf, values[index])));
        row.push(match leaf.role {
            Role::Register => text(leaf, engine.word(index)),
            Role::Input | Role::Net => String::new(),
        });
        rows.push(((!marked, is_word(index)), row));
    }
    rows.sort_by_key(|(order, _)| *order);
    let left_out = rows.len().saturating_sub(ROWS);
    rows.truncate(ROWS);
    let rows = rows.into_iter().map(|(_, row)| row);
    let mut table = aligned(&std::iter::once(head).chain(rows).collect::<Vec<_>>());
    if left_out > 0 {
        let _ = writeln!(table, "  and {left_out} more signals");
    }
    table
}

/// True if `name` is `path`, its end after a dot, or a memory whose word the path is.
pub(super) fn is_named(name: &str, path: &str) -> bool {
    let ends = |path: &str| {
        let rest = path.strip_suffix(name);
        rest.is_some_and(|rest| rest.is_empty() || rest.ends_with('.'))
    };
    let memory = path.rsplit_once('.').map(|(memory, _)| memory);
    ends(path) || memory.is_some_and(ends)
}

/// Aligns rows: the first column to the left, the others to the right.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<_> = (0..columns).map(width).collect();
    let mut lines = String::new();
    for row in rows {
        let mut line = String::new();
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let _ = match column {
                0 => write!(line, "{cell:<width$}"),
                _ => write!(line, "  {cell:>width$}"),
            };
        }
        lines.push_str(line.trim_end());
        lines.push('\n');
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::stem;

    #[test]
    fn each_property_has_files_of_its_own() {
        assert_eq!(
            stem("axis", "a rise, then a fall"),
            "axis_a_rise__then_a_fall"
        );
        assert_ne!(stem("axis", "n < 3"), stem("axis", "n > 3"));
        assert_ne!(stem("axis", "数"), stem("axis", "計"));
        let long = "word ".repeat(60);
        assert_ne!(
            stem("axis", &format!("{long}a")),
            stem("axis", &format!("{long}b"))
        );
        assert!(stem("axis", &long).len() < 220);
    }
}
