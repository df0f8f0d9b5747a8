//! Names of a model's signals.

use super::{Handle, Model, ModelError};
use crate::engine::Engine;
use crate::hdl::{Declaration, Declarations, MemoryDeclaration};
use crate::nearest::{nearest, nearest_paths};
use crate::netlist::{Format, Kind, Role, Shape};
use crate::sim::Elaborated;
use rustc_hash::{FxHashMap, FxHashSet};

/// Greatest number of names that an error suggests.
const NEAR: usize = 3;

/// Direction of a port.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum PortDirection {
    /// Input port.
    In,
    /// Output port.
    Out,
}

/// Description of a signal of a [`Model`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct SignalInfo {
    /// Handle for reading and setting the signal.
    pub handle: Handle,
    /// Path below the circuit, with dots between scopes; a word of a memory is `memory[3]`.
    pub path: String,
    /// Hierarchical name below the circuit's Verilog module. It differs from the path where
    /// signals are in a bundle: `rates_scan_period`.
    pub verilog: String,
    /// Role of the signal in its own circuit, which may be a part of the model's.
    pub role: Role,
    /// Direction, if the signal is a port of the model's circuit.
    pub port: Option<PortDirection>,
    /// Kind and width.
    pub shape: Shape,
    /// Display format.
    pub format: Format,
    /// Documentation in one line, or of its memory; may be empty.
    pub doc: String,
    /// Bits at power-on, settled with all input ports low.
    pub power_on: u64,
}

impl SignalInfo {
    /// Returns the width in bits.
    pub fn width(&self) -> usize {
        self.shape.width
    }

    /// True if the signal is a two's complement number.
    pub fn is_signed(&self) -> bool {
        self.shape.kind == Kind::Signed
    }
}

/// Leaves by name.
#[derive(Debug)]
pub(super) struct Names {
    /// Leaves that are no words of a memory.
    signals: FxHashMap<String, usize>,
    /// First word and number of words of each memory.
    memories: FxHashMap<String, (usize, usize)>,
}

impl Names {
    pub fn of(declared: &Declarations) -> Self {
        let circuits = Circuits::of(declared);
        let (mut signals, mut memories) = (FxHashMap::default(), FxHashMap::default());
        for (index, leaf) in without_words(declared) {
            signals.insert(path(leaf), index);
        }
        for memory in &declared.memories {
            memories.insert(memory_path(memory), (memory.first, memory.words));
        }
        // A path counts more than the same name in Verilog.
        for (index, leaf) in without_words(declared) {
            signals.entry(circuits.verilog(leaf)).or_insert(index);
        }
        for memory in &declared.memories {
            let name = declared.leaves.get(memory.first);
            if let Some(name) = name.map(|word| circuits.verilog_scope(word)) {
                let words = (memory.first, memory.words);
                memories.entry(name).or_insert(words);
            }
        }
        Names { signals, memories }
    }

    /// Returns a leaf by its name below the circuit or with the circuit's name before it.
    pub fn find(&self, name: &str, circuit: &str) -> Option<usize> {
        let below = || name.strip_prefix(circuit)?.strip_prefix('.');
        self.below(name)
            .or_else(|| below().and_then(|name| self.below(name)))
    }

    fn below(&self, name: &str) -> Option<usize> {
        self.signals.get(name).copied().or_else(|| {
            let (memory, word) = element(name)?;
            let (first, words) = self.memories.get(memory)?;
            (word < *words).then_some(first + word)
        })
    }
}

/// Splits the name of a word of a memory, as `memory[3]`, `memory.word3` or `memory.stage3`.
fn element(name: &str) -> Option<(&str, usize)> {
    let (memory, number) = match name.strip_suffix(']') {
        Some(name) => name.rsplit_once('[')?,
        None => {
            let (memory, word) = name.rsplit_once('.')?;
            let number = word.strip_prefix("word");
            (memory, number.or_else(|| word.strip_prefix("stage"))?)
        }
    };
    let index: usize = number.parse().ok()?;
    (index.to_string() == number).then_some((memory, index))
}

/// Returns the leaves that are no words of a memory, with their indices.
fn without_words(declared: &Declarations) -> impl Iterator<Item = (usize, &Declaration)> {
    let mut memories = declared.memories.iter().peekable();
    let mut leaves = declared.leaves.iter().enumerate();
    std::iter::from_fn(move || {
        let (mut index, mut leaf) = leaves.next()?;
        while let Some(memory) = memories.next_if(|memory| memory.first == index) {
            if memory.words > 0 {
                (index, leaf) = leaves.nth(memory.words - 1)?;
            }
        }
        Some((index, leaf))
    })
}

/// Returns the path of a leaf below its circuit.
pub(super) fn path(leaf: &Declaration) -> String {
    let names: Vec<&str> = leaf.names().skip(1).collect();
    names.join(".")
}

/// Returns the path of a memory below its circuit.
fn memory_path(memory: &MemoryDeclaration) -> String {
    let scopes = memory.scopes.iter().skip(1).chain([&memory.name]);
    let names: Vec<&str> = scopes.map(String::as_str).collect();
    names.join(".")
}

/// Scopes that are circuits; the others are bundles and memories, which Verilog does not have.
struct Circuits<'d>(FxHashSet<&'d [String]>);

impl<'d> Circuits<'d> {
    fn of(declared: &'d Declarations) -> Self {
        let signals = without_words(declared).map(|(_, leaf)| leaf);
        let words = declared.memories.iter();
        let words = words.filter_map(|memory| declared.leaves.get(memory.first));
        let leaves = signals.chain(words);
        Circuits(leaves.map(|leaf| &leaf.scopes[..leaf.circuit]).collect())
    }

    /// Returns the name of a leaf in Verilog.
    fn verilog(&self, leaf: &Declaration) -> String {
        let mut name = self.verilog_scope(leaf);
        if !name.is_empty() {
            name.push(match leaf.circuit == leaf.scopes.len() {
                true => '.',
                false => '_',
            });
        }
        name + &leaf.name
    }

    /// Returns the scopes around a leaf below the outermost circuit as a name in Verilog.
    fn verilog_scope(&self, leaf: &Declaration) -> String {
        let mut name = String::new();
        for (depth, scope) in leaf.scopes.iter().enumerate().skip(1) {
            if depth > 1 {
                name.push(match self.0.contains(&leaf.scopes[..depth]) {
                    true => '.',
                    false => '_',
                });
            }
            name.push_str(scope);
        }
        name
    }
}

/// Returns a description of each signal of a model; `power_on` is its engine in that state.
pub(super) fn all(model: &Model, power_on: &Engine) -> Vec<SignalInfo> {
    let elaborated = model.elaborated();
    let declared = elaborated.outline();
    let circuits = Circuits::of(declared);
    let inputs = model.ports().count();
    let mut out = vec![false; declared.leaves.len()];
    for leaf in elaborated.ports_out() {
        out[leaf] = true;
    }
    let info = |index: usize, path: String, verilog: String, doc: String| {
        let leaf = &declared.leaves[index];
        SignalInfo {
            handle: model.handle(index),
            path,
            verilog,
            role: leaf.role,
            port: match out[index] {
                true => Some(PortDirection::Out),
                false => (index < inputs).then_some(PortDirection::In),
            },
            shape: leaf.shape,
            format: leaf.field.format,
            doc,
            power_on: power_on.word(index),
        }
    };
    let signals = without_words(declared).map(|(index, leaf)| {
        info(
            index,
            path(leaf),
            circuits.verilog(leaf),
            leaf.field.plain_doc(),
        )
    });
    let mut all: Vec<SignalInfo> = signals.collect();
    for memory in &declared.memories {
        let (path, doc) = (memory_path(memory), memory.field.plain_doc());
        for word in 0..memory.words {
            let index = memory.first + word;
            let verilog = circuits.verilog_scope(&declared.leaves[index]);
            let [path, verilog] = [&path, &verilog].map(|name| format!("{name}[{word}]"));
            all.push(info(index, path, verilog, doc.clone()));
        }
    }
    all.sort_unstable_by_key(|signal| signal.handle.leaf);
    all
}

/// Returns the paths most similar to `wanted`, if what is behind their last dots is near enough.
fn near(wanted: &str, paths: &[String]) -> Vec<String> {
    fn last(path: &str) -> &str {
        path.rsplit('.').next().unwrap_or(path)
    }
    let paths = paths.iter().map(String::as_str);
    let paths = paths.filter(|path| nearest(last(wanted), [last(path)]).is_some());
    nearest_paths(wanted, paths, NEAR)
}

/// Returns the error about a name that no signal has.
#[cold]
pub(super) fn unknown(name: &str, elaborated: &Elaborated) -> ModelError {
    let declared = elaborated.outline();
    let memory = |name: &str| {
        let mut memories = declared.memories.iter();
        memories.find(|memory| memory_path(memory) == name)
    };
    let base = element(name).map_or(name, |(memory, _)| memory);
    let near = match memory(base) {
        Some(memory) => [0, memory.words.saturating_sub(1)]
            .map(|word| format!("{base}[{word}]"))
            .to_vec(),
        None => {
            let signals = without_words(declared).map(|(_, leaf)| path(leaf));
            let memories = declared.memories.iter();
            let words = memories.map(|memory| format!("{}[0]", memory_path(memory)));
            let all: Vec<String> = signals.chain(words).collect();
            near(name, &all)
        }
    };
    ModelError::UnknownSignal {
        circuit: elaborated.name(),
        name: name.to_owned(),
        near,
    }
}

/// Returns the error about a leaf that is no input port.
#[cold]
pub(super) fn no_input(leaf: usize, elaborated: &Elaborated) -> ModelError {
    let declared = elaborated.outline();
    let word = declared.memories.iter().find_map(|memory| {
        let word = leaf.checked_sub(memory.first)?;
        (word < memory.words).then(|| format!("{}[{word}]", memory_path(memory)))
    });
    let own = declared.leaves.get(leaf);
    let kind = match own.map(|leaf| leaf.role) {
        _ if word.is_some() => "a word of a memory",
        Some(Role::Register) => "a register",
        Some(Role::Input) => "an input port of a part",
        Some(Role::Net) | None => "a net",
    };
    let signal = word.or_else(|| own.map(path)).unwrap_or_default();
    let inputs = elaborated.leaves(Role::Input);
    let inputs: Vec<String> = declared.leaves[inputs].iter().map(path).collect();
    ModelError::NoInput {
        near: near(&signal, &inputs),
        signal,
        kind,
    }
}
