//! Timing charts that live in Markdown and are executed.
//!
//! A chart is a fenced code block whose first line names a circuit and, in brackets, what it is
//! built with. A `tick` line counts the columns, from power-on at tick 0. Below it stands a line
//! a signal:
//!
//! ````markdown
//! ```chart counter[3] the counter wraps at its period
//! tick      0  1  2  3  4
//! > period  3  .  .  2  .
//! = count   1  2  0  1  0
//! = last    _  #  _  #  _
//! ```
//! ````
//!
//! - `> port` gives a port in its values; a port that is not listed stays at zero.
//! - `= signal` says what is expected of a register or net, by its path below the circuit
//!   (`axis.count` is `count` of the part `axis`).
//! - A cell is a number (`12`, `-3`, `0x1f`, `0b101`), the name of a state, `_` for a low or `#`
//!   for a high bit. `.` repeats the cell before it; `-` is not checked.
//! - Cells stand apart; runs of `_`, `#`, `.` and `-` may be written together: `_##_` is four
//!   cells.
//! - Lines that are empty or begin with `//` say nothing.
//!
//! A register shows at tick n + 1 what was decided at tick n.

mod parse;
mod run;

pub use parse::parse;
pub use run::{ChartFailure, Mismatch};

/// A timing chart, read but not yet run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    /// The name of the circuit: its [`NAME`](crate::hdl::Circuit::NAME).
    pub circuit: String,
    /// What stands in brackets behind it: widths and whatever else the circuit is built with.
    pub args: Vec<u64>,
    /// What is written behind that.
    pub title: String,
    /// The line of its fence in the note, from 1.
    pub line: usize,
    /// The number of ticks.
    ticks: usize,
    inputs: Vec<Row>,
    expected: Vec<Row>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Row {
    line: usize,
    name: String,
    /// One a tick.
    cells: Vec<Cell>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Cell {
    Low,
    High,
    /// As the cell before.
    Repeat,
    /// Not checked.
    Any,
    Word(String),
}

/// A chart that cannot be read, or that does not fit its circuit.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {problem}")]
pub struct ChartError {
    /// The line in the note, from 1.
    pub line: usize,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with a chart.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Problem {
    /// The fence does not name a circuit.
    #[error("a chart begins with ```chart CIRCUIT or ```chart CIRCUIT[NUMBER, ...]")]
    Fence,
    /// A title that makes the line no fence.
    #[error("a title has no backtick: Markdown takes the line for text")]
    Backtick,
    /// The note ends within the chart.
    #[error("the chart is not closed")]
    Unclosed,
    /// A line of no known kind.
    #[error("a line begins with `tick`, `> port`, `= signal` or `//`")]
    Line,
    /// No `tick` line before the signals, or a second one.
    #[error("a chart has one `tick` line, before its signals: tick 0 1 2 ...")]
    Ticks,
    /// Nothing expected.
    #[error("the chart expects nothing: it has no `= signal` line")]
    Empty,
    /// Fewer or more cells than ticks.
    #[error("{signal} has {cells} cells, the chart has {ticks} ticks")]
    Ragged {
        /// The signal.
        signal: String,
        /// Its cells.
        cells: usize,
        /// The columns of the chart.
        ticks: usize,
    },
    /// A signal with two lines.
    #[error("{0} has a line already")]
    Twice(String),
    /// A line that begins with a repetition.
    #[error("{0} begins with `.`: there is no cell before it")]
    NothingToRepeat(String),
    /// A port in without a value.
    #[error("{0} is a port in: `-` gives it no value")]
    NoValue(String),
    /// The chart is of another circuit.
    #[error("the chart is of {chart}, the circuit is {circuit}")]
    Circuit {
        /// The circuit named in the chart.
        chart: String,
        /// The one it was run on.
        circuit: String,
    },
    /// A path that is no signal, or no port in.
    #[error("the circuit has no {what} {name}; it has: {}", near.join(", "))]
    Unknown {
        /// "port in" or "signal".
        what: &'static str,
        /// The name.
        name: String,
        /// The names that resemble it most.
        near: Vec<String>,
    },
    /// A cell that is no value of its signal.
    #[error("{signal}: {cell} is not a value of {allowed}")]
    Value {
        /// The signal.
        signal: String,
        /// The cell.
        cell: String,
        /// What would be.
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
