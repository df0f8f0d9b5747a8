use super::{Cell, Chart, ChartError, Problem, Row};
use crate::engine::{EngineError, Watch};
use crate::hdl::Declaration;
use crate::nearest::nearest_paths;
use crate::netlist::Format;
use crate::settings::Pair;
use crate::sim::{Described, Elaborated, LeafView as View, RunError};
use crate::trace::Options;
use crate::trace::record::{NEAR, Record};
use crate::trace::value::{read, show};
use std::fmt::{self, Write};

/// Reason why a chart fails.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ChartFailure {
    /// The chart does not fit the circuit.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The circuit behaves differently.
    #[error(transparent)]
    Mismatch(#[from] Box<Mismatch>),
    /// The circuit cannot be run.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

crate::netlist::debug_as_display!(ChartFailure);

/// First cell, by tick, in which a circuit differs from its chart.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub struct Mismatch {
    /// Line in the note, from 1.
    pub line: usize,
    /// Tick of the cell.
    pub tick: u64,
    /// Path of the signal below the circuit.
    pub signal: String,
    /// Value in the chart.
    pub expected: String,
    /// Value of the circuit.
    pub actual: String,
    /// Chart of the actual behaviour, ready for the note.
    pub chart: String,
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Mismatch {
            line,
            tick,
            signal,
            expected,
            actual,
            chart,
        } = self;
        writeln!(
            f,
            "line {line}: tick {tick}: {signal} is {actual}, the chart says {expected}"
        )?;
        writeln!(f, "what the circuit does:")?;
        write!(f, "{chart}")
    }
}

impl Chart {
    /// Runs the circuit from power-on with the chart's inputs and compares every expected cell.
    ///
    /// # Errors
    /// Returns an error if the chart does not fit the circuit, or the circuit behaves differently.
    pub fn run(&self, circuit: &impl Described) -> Result<(), ChartFailure> {
        self.run_on(&circuit.described()?)
    }

    /// Runs an elaborated circuit as [`run`](Self::run) does.
    ///
    /// # Errors
    /// Returns the errors of [`run`](Self::run).
    pub fn run_on(&self, circuit: &Elaborated) -> Result<(), ChartFailure> {
        if self.circuit != circuit.name() {
            let problem = Problem::Circuit {
                chart: self.circuit.clone(),
                circuit: circuit.name().to_owned(),
            };
            return Err(problem.at(self.line).into());
        }
        let declarations = circuit.outline();
        let leaves = &declarations.leaves;
        let ports = &leaves[..declarations.inputs()];
        let inputs = resolve(&self.inputs, ports, "port in")?;
        let expected = resolve(&self.expected, leaves, "signal")?;

        let record = self.record(circuit, ports, &inputs)?;
        let actual: Vec<&[u64]> = expected
            .iter()
            .map(|row| record.column(&row.leaf.path()).unwrap_or(&[]))
            .collect();
        for tick in 0..self.ticks {
            for (row, values) in expected.iter().zip(&actual) {
                if let (Some(wanted), Some(&bits)) = (row.values[tick], values.get(tick))
                    && wanted != bits
                {
                    let mismatch = Mismatch {
                        line: row.row.line,
                        tick: tick as u64,
                        signal: row.row.name.clone(),
                        expected: cell(row.leaf, wanted),
                        actual: cell(row.leaf, bits),
                        chart: self.draw(&inputs, &expected, &actual),
                    };
                    return Err(Box::new(mismatch).into());
                }
            }
        }
        Ok(())
    }

    /// Returns the words of the input ports, tick by tick.
    pub(crate) fn inputs(&self, circuit: &Elaborated) -> Result<Vec<Vec<u64>>, ChartError> {
        let declarations = circuit.outline();
        let ports = &declarations.leaves[..declarations.inputs()];
        let lines = resolve(&self.inputs, ports, "port in")?;
        let word = |port: &Declaration, tick: usize| {
            let line = lines.iter().find(|line| std::ptr::eq(line.leaf, port));
            line.and_then(|line| line.values[tick]).unwrap_or(0)
        };
        let ticks = 0..self.ticks;
        Ok(ticks
            .map(|tick| ports.iter().map(|port| word(port, tick)).collect())
            .collect())
    }

    fn record(
        &self,
        circuit: &Elaborated,
        ports: &[Declaration],
        inputs: &[Resolved<'_>],
    ) -> Result<Record, ChartError> {
        // Line of each port, found once.
        let lines: Vec<Option<&Resolved<'_>>> = ports
            .iter()
            .map(|port| inputs.iter().find(|row| std::ptr::eq(row.leaf, port)))
            .collect();
        let only = self
            .expected
            .iter()
            .map(|row| format!("{}.{}", circuit.name(), row.name));
        let options = Options {
            only: Some(only.collect()),
            ..Options::default()
        };
        let failed = |problem: String| Problem::Run(problem).at(self.line);
        let leaves = circuit.outline().leaves.clone();
        let mut record = Record::new(leaves, &options).map_err(|e| failed(e.to_string()))?;
        let mut engine = circuit.engine(Watch::Leaves(record.places()));
        for tick in 0..self.ticks {
            for (port, line) in lines.iter().enumerate() {
                let value = line.and_then(|line| line.values.get(tick).copied());
                engine.drive(port, value.flatten().unwrap_or(0));
            }
            engine.settle();
            let kept = record.tick(tick as u64, View::of(&engine));
            kept.map_err(|error| failed(RunError::from(error).to_string()))?;
            engine.edge();
        }
        Ok(record)
    }

    /// Returns the chart with the actual values in place of the expected ones.
    fn draw(
        &self,
        inputs: &[Resolved<'_>],
        expected: &[Resolved<'_>],
        actual: &[&[u64]],
    ) -> String {
        let ticks = (0..self.ticks).map(|tick| tick.to_string());
        let mut lines = vec![("tick".to_owned(), ticks.collect::<Vec<_>>())];
        for row in inputs {
            lines.push((
                format!("> {}", row.row.name),
                texts(row.leaf, row.values.iter().copied()),
            ));
        }
        for (row, values) in expected.iter().zip(actual) {
            let seen = row.values.iter().zip(values.iter());
            let shown = seen.map(|(wanted, &bits)| wanted.map(|_| bits));
            lines.push((format!("= {}", row.row.name), texts(row.leaf, shown)));
        }
        let names = lines.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        let width = lines
            .iter()
            .flat_map(|(_, cells)| cells)
            .map(String::len)
            .max()
            .unwrap_or(1);

        let mut text = format!("```chart {}", self.circuit);
        if !self.pairs.is_empty() {
            let pairs: Vec<_> = self.pairs.iter().map(Pair::to_string).collect();
            text += &format!("[{}]", pairs.join(", "));
        }
        if !self.title.is_empty() {
            text += &format!(" {}", self.title);
        }
        text.push('\n');
        for (name, cells) in lines {
            let mut line = format!("{name:names$}");
            for cell in cells {
                // Writing to a string cannot fail.
                let _ = write!(line, "  {cell:width$}");
            }
            text += line.trim_end();
            text.push('\n');
        }
        text + "```"
    }
}

/// Line of a chart with its signal.
struct Resolved<'a> {
    row: &'a Row,
    leaf: &'a Declaration,
    /// One value per tick; `None` is not checked.
    values: Vec<Option<u64>>,
}

fn resolve<'a>(
    rows: &'a [Row],
    leaves: &'a [Declaration],
    what: &'static str,
) -> Result<Vec<Resolved<'a>>, ChartError> {
    // Skips the circuit's own scope.
    fn below(leaf: &Declaration) -> impl Iterator<Item = &str> {
        leaf.names().skip(leaf.scopes.len().min(1))
    }
    let mut resolved = Vec::new();
    for row in rows {
        let Some(leaf) = leaves
            .iter()
            .find(|leaf| below(leaf).eq(row.name.split('.')))
        else {
            let names = leaves.iter().map(below);
            let names: Vec<_> = names
                .map(|names| names.collect::<Vec<_>>().join("."))
                .collect();
            let problem = Problem::Unknown {
                what,
                name: row.name.clone(),
                near: nearest_paths(&row.name, names.iter().map(String::as_str), NEAR),
            };
            return Err(problem.at(row.line));
        };
        resolved.push(Resolved {
            row,
            leaf,
            values: values(row, leaf)?,
        });
    }
    Ok(resolved)
}

fn values(row: &Row, leaf: &Declaration) -> Result<Vec<Option<u64>>, ChartError> {
    let one_bit = leaf.shape.width == 1;
    let mut before = None;
    let mut values = Vec::new();
    for cell in &row.cells {
        before = match cell {
            Cell::Repeat => before,
            Cell::Any => None,
            Cell::Low if one_bit => Some(0),
            Cell::High if one_bit => Some(1),
            Cell::Low => return Err(no_value(row, leaf, "_")),
            Cell::High => return Err(no_value(row, leaf, "#")),
            Cell::Word(text) => match read(leaf.shape, leaf.field.format, text) {
                Some(bits) => Some(bits),
                None => return Err(no_value(row, leaf, text)),
            },
        };
        values.push(before);
    }
    Ok(values)
}

fn no_value(row: &Row, leaf: &Declaration, cell: &str) -> ChartError {
    let width = leaf.shape.width;
    let bits = if width == 1 { "bit" } else { "bits" };
    let allowed = match leaf.field.format {
        Format::States(names) => format!("{width} {bits}: {}", names.join(", ")),
        _ => {
            let (least, greatest) = leaf.shape.range();
            format!("{width} {bits}: {least} to {greatest}")
        }
    };
    let problem = Problem::Value {
        signal: row.name.clone(),
        cell: cell.to_owned(),
        allowed,
    };
    problem.at(row.line)
}

/// Returns a value as a cell: levels for bits.
fn cell(leaf: &Declaration, bits: u64) -> String {
    match (leaf.shape.width, bits) {
        (1, 0) => "_".to_owned(),
        (1, _) => "#".to_owned(),
        _ => show(leaf.shape, leaf.field.format, bits),
    }
}

/// Returns the cells of a line: `-` if nothing is checked, `.` if a word repeats.
fn texts(leaf: &Declaration, values: impl Iterator<Item = Option<u64>>) -> Vec<String> {
    let mut before = None;
    values
        .map(|value| match value {
            None => {
                before = None;
                "-".to_owned()
            }
            Some(bits) if leaf.shape.width > 1 && before == Some(bits) => ".".to_owned(),
            Some(bits) => {
                before = Some(bits);
                cell(leaf, bits)
            }
        })
        .collect()
}
