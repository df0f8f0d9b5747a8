use super::node::{Id, Node};
use super::signal::{Field, Role, Shape};

/// Netlist of one circuit: its signals, their drivers, and the circuits inside it.
///
/// Two modules that differ only in memory contents and parameter values are one.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(test, derive(Default))]
pub struct Module {
    /// Name of the circuit.
    pub name: String,
    /// One-line description.
    pub about: &'static str,
    /// Nodes; each is computed from nodes before it.
    pub nodes: Vec<(Node, Shape)>,
    /// Number of nodes before those that only properties read.
    pub logic: usize,
    /// Inputs, registers and nets in declaration order, with the registers of the circuits inside.
    pub signals: Vec<Signal>,
    /// Parameters, without those of the circuits inside.
    pub parameters: Vec<Parameter>,
    /// Memories in declaration order, then ROMs.
    pub memories: Vec<Memory>,
    /// Properties.
    pub assertions: Vec<Assertion>,
    /// Circuits inside, in the order in which they settle.
    pub instances: Vec<Child>,
    pub(crate) registers: Vec<Register>,
    /// Signal of each leaf of the walk over the nets, unless it belongs to an instance.
    pub(crate) nets: Vec<Option<usize>>,
    /// Node of each leaf of the walk over the nets.
    pub(crate) net_nodes: Vec<Id>,
    /// Owner of each memory that belongs to an instance: the instance, and the memory inside it.
    pub(crate) owners: Vec<Option<(usize, usize)>>,
}

/// Signal of a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// Name in Verilog.
    pub name: String,
    /// Name in the waves: scopes below the circuit and name, joined by dots.
    pub path: String,
    /// Declaration in `signals!`.
    pub field: &'static Field,
    /// Input port, register or net.
    pub role: Role,
    /// Kind and width.
    pub shape: Shape,
    /// Power-on value of a register.
    pub power_on: u64,
    /// Driver of a net; for a register, its value after the edge.
    pub driver: Option<Id>,
    /// Owner of an instance's register: the instance, and the signal inside it.
    pub owner: Option<(usize, usize)>,
}

impl Module {
    /// True if the words of a memory are leaves of the walk; those of a ROM are not.
    pub(crate) fn has_leaves(&self, memory: usize) -> bool {
        self.registers.contains(&Register::Memory(memory))
    }

    /// Returns the output ports, in their order.
    pub fn outputs(&self) -> impl Iterator<Item = &Signal> {
        let outputs = self.signals.iter();
        outputs.filter(|signal| signal.role != Role::Input && signal.is_port())
    }

    /// Returns the input ports, in their order.
    pub fn inputs(&self) -> impl Iterator<Item = &Signal> {
        let inputs = self.signals.iter();
        inputs.filter(|signal| signal.role == Role::Input && signal.owner.is_none())
    }
}

impl Signal {
    /// Returns the Verilog name of the register behind an output port.
    pub(crate) fn behind(&self) -> Option<String> {
        let register = self.is_port() && self.role == Role::Register;
        register.then(|| format!("{}_reg", self.name))
    }

    /// True if the signal is a port.
    pub fn is_port(&self) -> bool {
        self.owner.is_none() && (self.role == Role::Input || self.field.public)
    }
}

/// Parameter of a module; its value belongs to the instance.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Name.
    pub name: &'static str,
    /// Width in bits.
    pub width: usize,
}

/// Memory of a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Memory {
    /// Name.
    pub name: String,
    /// Doc comment from `signals!`; empty for a ROM.
    pub doc: &'static str,
    /// Number of words.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// Write port.
    pub port: Port,
    /// True if a word is not zero at power-on, in any instance.
    pub filled: bool,
    /// True if the memory belongs to an instance.
    pub inner: bool,
}

impl Memory {
    /// Returns the names that Verilog derives from the memory: loops over its words, and their
    /// wires.
    pub(crate) fn loops(&self) -> impl Iterator<Item = String> {
        let zeros = (!self.filled).then_some("word");
        let shift: &[&str] = match self.port {
            Port::Shift { .. } => &["to", "shift"],
            Port::Ram { .. } | Port::Rom => &[],
        };
        let loops = zeros.into_iter().chain(["at", "words"]);
        let loops = loops.chain(shift.iter().copied());
        loops.map(|of| format!("{}_{of}", self.name))
    }
}

/// Statement about a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Assertion {
    /// The statement in words.
    pub name: &'static str,
    /// Use of the statement in proofs.
    pub claim: Claim,
    /// Signals at fault if the property is violated.
    pub signals: &'static [&'static str],
    /// True if the property spans an edge: it reads the registers after the edge, and through
    /// [`Node::Past`] everything before it.
    pub step: bool,
    /// Node that is high if the property holds.
    pub holds: Id,
}

/// Use of a statement in proofs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Claim {
    /// Proved.
    Property,
    /// Proved too; it is there only to make the proofs of others possible.
    Helper,
    /// Assumed of the input ports; a circuit around this one has to keep it.
    Given,
    /// True for the cases that an exhaustive search looks at. The others would repeat them, so a
    /// proof at full width does without it.
    Narrowing,
}

impl Claim {
    /// True if the statement is proved.
    pub fn is_proved(self) -> bool {
        matches!(self, Claim::Property | Claim::Helper)
    }
}

/// Write port of a memory; `I` identifies a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Port<I = Id> {
    /// No writes.
    Rom,
    /// Writes one word at an address.
    Ram {
        /// Write enable.
        enable: I,
        /// Address.
        address: I,
        /// Word to write.
        data: I,
    },
    /// Moves all words up by one place.
    Shift {
        /// Shift enable.
        enable: I,
        /// New first word.
        data: I,
    },
}

impl<I> Port<I> {
    /// Returns the nodes that the port reads: enable, data, address.
    pub fn operands(self) -> impl Iterator<Item = I> {
        let operands = match self {
            Port::Rom => [None, None, None],
            Port::Ram {
                enable,
                address,
                data,
            } => [Some(enable), Some(data), Some(address)],
            Port::Shift { enable, data } => [Some(enable), Some(data), None],
        };
        operands.into_iter().flatten()
    }

    /// Returns the port with each node mapped by `to`.
    pub fn map<J>(self, mut to: impl FnMut(I) -> J) -> Port<J> {
        match self {
            Port::Rom => Port::Rom,
            Port::Ram {
                enable,
                address,
                data,
            } => Port::Ram {
                enable: to(enable),
                address: to(address),
                data: to(data),
            },
            Port::Shift { enable, data } => Port::Shift {
                enable: to(enable),
                data: to(data),
            },
        }
    }
}

/// Circuit inside a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Child {
    /// Instance name: the path of its field in the surrounding circuit.
    pub name: String,
    /// Index of its module in [`Design::modules`].
    pub module: usize,
    /// Drivers of its inputs, in port order.
    pub inputs: Vec<Id>,
}

/// Target of a leaf of the walk over the registers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Register {
    /// Flip-flop: index of its signal.
    Signal(usize),
    /// Memory: its index.
    Memory(usize),
}

/// Property in which instances of one module may differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// Instance path, outermost first, and name of the setting.
    pub path: Vec<String>,
    /// Width in bits of the value or of a word.
    pub width: usize,
    /// Value of the setting.
    pub value: Value,
}

/// Value of a setting.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Value {
    /// Value of a parameter.
    Number(u64),
    /// Power-on words of a memory that is not all zero.
    Words(Vec<u64>),
}

/// Circuit with the circuits inside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// Modules, each after those inside it; the circuit itself is last.
    pub modules: Vec<Module>,
    /// Parameters and memory contents of the circuit and of those inside it.
    pub settings: Vec<Setting>,
}
