//! Timing charts in Markdown that are executed.
//!
//! A chart is a fenced code block. Its first line names a circuit and, in brackets, the keys that it
//! changes of the small circuit. A `tick` line numbers the columns, from power-on at tick 0. Each
//! line below it is a signal:
//!
//! ````markdown
//! ```chart counter[width=3] the counter wraps at its period
//! tick      0  1  2  3  4
//! > period  3  .  .  2  .
//! = count   1  2  0  1  0
//! = last    _  #  _  #  _
//! ```
//! ````
//!
//! - `> port` gives an input port its values; a port that is not listed stays at zero.
//! - `= signal` gives the expected values of a register or net, by its path below the circuit
//!   (`axis.count` is `count` of the part `axis`).
//! - A cell is a number (`12`, `-3`, `0x1f`, `0b101`), the name of a state, `_` for a low or `#`
//!   for a high bit. `.` repeats the cell before it; `-` is not checked.
//! - Spaces separate cells; runs of `_`, `#`, `.` and `-` may be written together: `_##_` is four
//!   cells.
//! - Lines that are empty or begin with `//` are ignored.
//!
//! A register shows at tick n + 1 what was decided at tick n.

mod parse;
mod run;

pub use parse::parse;
pub use run::{ChartFailure, Mismatch};

use crate::settings::{Pair, PairError};

/// Timing chart that was read but not yet run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    /// Name of the circuit: its [`NAME`](crate::hdl::Circuit::NAME).
    pub circuit: String,
    /// Changed keys of the circuit, in brackets.
    pub pairs: Vec<Pair>,
    /// Title after the brackets.
    pub title: String,
    /// Line of the fence in the note, from 1.
    pub line: usize,
    /// Number of ticks.
    ticks: usize,
    inputs: Vec<Row>,
    expected: Vec<Row>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Row {
    line: usize,
    name: String,
    /// One cell per tick.
    cells: Vec<Cell>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Cell {
    Low,
    High,
    /// Repeats the cell before.
    Repeat,
    /// Not checked.
    Any,
    Word(String),
}

/// Chart that cannot be read, or that does not fit its circuit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct ChartError {
    /// Line in the note, from 1.
    pub line: usize,
    /// Problem with the chart.
    pub problem: Problem,
}

/// Problem with a chart.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The fence does not name a circuit.
    #[error("a chart begins with ```chart CIRCUIT or ```chart CIRCUIT[KEY=VALUE, ...]")]
    Fence,
    /// An element in brackets is no key with a value.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The title has a backtick, so that the line is no fence.
    #[error("a title has no backtick: Markdown takes the line for text")]
    Backtick,
    /// The note ends inside the chart.
    #[error("the chart is not closed")]
    Unclosed,
    /// The line is of no known kind.
    #[error("a line begins with `tick`, `> port`, `= signal` or `//`")]
    Line,
    /// There is no `tick` line before the signals, or a second one.
    #[error("a chart has one `tick` line, before its signals: tick 0 1 2 ...")]
    Ticks,
    /// No signal has expected values.
    #[error("the chart expects nothing: it has no `= signal` line")]
    Empty,
    /// A signal has fewer or more cells than there are ticks.
    #[error("{signal} has {cells} cells, the chart has {ticks} ticks")]
    Ragged {
        /// Signal.
        signal: String,
        /// Number of its cells.
        cells: usize,
        /// Number of columns of the chart.
        ticks: usize,
    },
    /// A signal has two lines.
    #[error("{0} has a line already")]
    Twice(String),
    /// A line begins with a repetition.
    #[error("{0} begins with `.`: there is no cell before it")]
    NothingToRepeat(String),
    /// An input port has a cell without a value.
    #[error("{0} is a port in: `-` gives it no value")]
    NoValue(String),
    /// The chart belongs to another circuit.
    #[error("the chart is of {chart}, the circuit is {circuit}")]
    Circuit {
        /// Circuit named in the chart.
        chart: String,
        /// Circuit that runs the chart.
        circuit: String,
    },
    /// A path names no signal, or no input port.
    #[error("the circuit has no {what} {name}; it has: {}", near.join(", "))]
    Unknown {
        /// Kind of path: "port in" or "signal".
        what: &'static str,
        /// Path in the chart.
        name: String,
        /// Names that are most similar.
        near: Vec<String>,
    },
    /// A cell is not a value of its signal.
    #[error("{signal}: {cell} is not a value of {allowed}")]
    Value {
        /// Signal.
        signal: String,
        /// Cell.
        cell: String,
        /// Allowed values.
        allowed: String,
    },
    /// The circuit cannot be run.
    #[error("{0}")]
    Run(String),
}

impl Problem {
    fn at(self, line: usize) -> ChartError {
        ChartError {
            line,
            problem: self,
        }
    }
}
