//! Ports of a design that somebody else runs, compared with a model at every clock edge.
//!
//! A simulator or a bench hands a [`Checker`] the ports of its design just before each rising edge.
//! The model gets the same inputs and the same resets, and its output ports are compared with those
//! of the design.

mod edge;
mod error;
mod logic;
mod ports;
mod printed;
mod recent;
mod report;
mod waves;
mod words;

pub use error::CheckerError;
pub(crate) use ports::Port;
pub use ports::PortList;
pub(crate) use printed::PrintedChecker;
pub use words::{Place, PortWords};

use crate::netlist::Shape;
use crate::sim::{Model, ModelError};
use crate::trace::WaveFormat;
use logic::LogicPorts;
use recent::Recent;
use std::ops::Range;
use std::path::PathBuf;
use waves::Waves;

/// Version of this crate.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Version of the functions that printed checkers in SystemVerilog call, and of the words that they pass.
pub const DPI_VERSION: u32 = 1;

/// Version of the functions that printed checkers in VHDL call.
pub const VHPI_VERSION: u32 = 1;

/// Settings of a [`Checker`].
#[derive(Debug, Clone, Default)]
pub struct Options {
    /// Ports to leave out, by name. An output port is not compared then, and an input port of the
    /// model stays low.
    pub leave: Vec<String>,
    /// Compares from the first edge on, with the model at power-on. Otherwise the comparison begins
    /// with the edge after the first one with a reset.
    pub from_power_on: bool,
    /// File for the model's waves around the first difference: a VCD or an FST.
    pub waves: Option<PathBuf>,
}

/// Result of a comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// All compared values are equal, and an output port has moved.
    Pass,
    /// A value differs, or an unknown input has stopped the comparison.
    Fail,
    /// Nothing was compared, or no output port has moved.
    Vacuous,
}

/// Model beside a design: compares their ports at every clock edge.
///
/// A design hands over the ports of a tick as [words](PortWords). Tick 0 is the one that ends with
/// the first reset, or with the first edge if the comparison begins at power-on.
///
/// ```
/// use motion_rtl::Model;
/// use motion_rtl::checker::{Checker, Options, Verdict};
///
/// let counter = Model::new("enable_counter", &["width=8".parse()?])?;
/// let options = Options { from_power_on: true, ..Options::default() };
/// let mut checker = Checker::new(counter, &options)?;
/// for tick in 0..20 {
///     // One word with the input port `period`, one with the output port `enable`.
///     let enable = u64::from(tick % 4 == 3 && tick < 15);
///     if checker.edge(false, &[4, enable])? {
///         let text = checker.take_text();
///         assert!(text.starts_with("first difference in tick 15:\n  enable: design 0, model 1\n"));
///     }
/// }
/// assert_eq!(checker.end(), Verdict::Fail);
/// assert!(checker.take_text().starts_with("FAIL: 2 of 20 values differ, in 2 of 20 ticks"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Checker {
    model: Model,
    layout: PortWords,
    /// Input ports, then output ports.
    ports: Vec<CheckedPort>,
    /// Ports of each word, as a range of `ports`.
    of_word: Vec<Range<usize>>,
    /// Port of each bit of each word.
    of_bit: Vec<u16>,
    /// Bits of each word that are of a port.
    used: Vec<u64>,
    left: Vec<String>,
    logic: LogicPorts,
    state: State,
    from_power_on: bool,
    /// Words of the last tick.
    last: Vec<u64>,
    recent: Option<Recent>,
    waves: Option<Waves>,
    /// Unknown ports of the tick to come.
    unknown: Vec<Unknown>,
    edges: u64,
    ticks: u64,
    differing_ticks: u64,
    text: String,
}

/// Port that is compared or driven.
#[derive(Debug)]
struct CheckedPort {
    name: String,
    /// Leaf of the model.
    leaf: usize,
    place: Place,
    shape: Shape,
    moves: u64,
    differences: u64,
    /// Tick of the first difference.
    first: u64,
}

/// Port with bits that are x or z.
#[derive(Debug)]
struct Unknown {
    /// Index of the port; `None` for the reset.
    port: Option<usize>,
    /// Bits, the highest first.
    bits: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum State {
    /// No edge had a reset yet.
    Waiting,
    /// The first reset lasts.
    Beginning,
    Running,
    /// An input was unknown.
    Stopped,
}

impl Checker {
    /// Puts a model at power-on beside a design.
    ///
    /// # Errors
    /// Returns an error if a port to leave out does not exist, or the file for the waves is neither
    /// .vcd nor .fst.
    pub fn new(model: Model, options: &Options) -> Result<Self, CheckerError> {
        if let Some(path) = &options.waves {
            WaveFormat::of(path).map_err(ModelError::from)?;
        }
        let list = PortList::of(&model);
        let mut left = Vec::new();
        for name in &options.leave {
            let handle = model.find(name)?;
            left.push(handle);
            if !list.ports.iter().any(|port| port.handle == handle) {
                return Err(CheckerError::NoPort {
                    circuit: model.name(),
                    name: name.clone(),
                    ports: list.names(),
                });
            }
        }
        let all: Vec<_> = list.inputs_first().map(Port::clone).collect();
        let (left, kept): (Vec<_>, Vec<_>) =
            (all.iter().cloned()).partition(|port| left.contains(&port.handle));
        let layout = PortWords::of_ports(kept.iter().map(|port| (port.direction, port.shape)));
        let places = layout.inputs.iter().chain(&layout.outputs);
        let mut kept_places = places.clone().copied();
        let logic = all.iter().map(|port| {
            let is_left = left.iter().any(|other| other.handle == port.handle);
            let place = if is_left { None } else { kept_places.next() };
            (port.shape.width, place)
        });
        let logic = LogicPorts::of(logic, layout.words);
        let ports: Vec<CheckedPort> = kept
            .into_iter()
            .zip(places)
            .map(|(port, &place)| CheckedPort {
                name: port.path,
                leaf: port.handle.index(),
                place,
                shape: port.shape,
                moves: 0,
                differences: 0,
                first: 0,
            })
            .collect();
        let of_word = |word| {
            let start = ports.partition_point(|port| port.place.word < word);
            start..ports.partition_point(|port| port.place.word <= word)
        };
        let of_word = (0..layout.words).map(of_word).collect();
        let (mut of_bit, mut used) = (vec![0; 64 * layout.words], vec![0; layout.words]);
        for (index, port) in ports.iter().enumerate() {
            let first = 64 * port.place.word + port.place.low;
            of_bit[first..first + port.place.width].fill(index as u16);
            used[port.place.word] |= port.place.mask();
        }
        // Without registers there is nothing to reset.
        let from_power_on = options.from_power_on || !list.clocked;
        Ok(Checker {
            recent: Some(Recent::new(layout.words)),
            last: vec![0; layout.words],
            model,
            ports,
            of_word,
            of_bit,
            used,
            layout,
            left: left.into_iter().map(|port| port.path).collect(),
            logic,
            state: State::Waiting,
            from_power_on,
            waves: options.waves.clone().map(Waves::new),
            unknown: Vec::new(),
            edges: 0,
            ticks: 0,
            differing_ticks: 0,
            text: String::new(),
        })
    }

    /// Returns the places of the ports in the words of a tick.
    pub fn words(&self) -> &PortWords {
        &self.layout
    }

    /// Marks a port of the tick to come as unknown: bits of it are neither 0 nor 1. `port` counts input
    /// ports, then output ports, without those that are left out; `None` is the reset. `bits` are
    /// its binary digits for the report, the highest first.
    pub fn unknown(&mut self, port: Option<usize>, bits: &str) {
        self.unknown.push(Unknown {
            port,
            bits: bits.to_owned(),
        });
    }

    /// Passes a rising edge: a tick ends with these ports, and with a reset if `rst` is 1.
    /// Returns true if there is a text to [take](Self::take_text).
    ///
    /// # Errors
    /// Returns an error if the number of words is not that of [`words`](Self::words).
    #[inline]
    pub fn edge(&mut self, rst: bool, words: &[u64]) -> Result<bool, CheckerError> {
        if words.len() != self.layout.words {
            return Err(CheckerError::Words {
                given: words.len(),
                words: self.layout.words,
            });
        }
        self.edges += 1;
        if self.state != State::Running || !self.unknown.is_empty() {
            return Ok(self.rare_edge(rst, words));
        }
        self.drive(words);
        if self.differs(words) {
            self.difference(rst, words);
        }
        self.pass(rst, words);
        Ok(!self.text.is_empty())
    }

    /// Returns what there is to say since the last call.
    pub fn take_text(&mut self) -> String {
        std::mem::take(&mut self.text)
    }

    /// Ends the comparison: writes the waves and returns the verdict, whose report is the text to
    /// [take](Self::take_text). Edges after it are not compared.
    pub fn end(&mut self) -> Verdict {
        if self.recent.is_none() {
            self.end_waves(true);
        }
        let verdict = self.verdict();
        self.text += &self.report(verdict);
        self.state = State::Stopped;
        verdict
    }
}

#[cfg(test)]
mod tests;
