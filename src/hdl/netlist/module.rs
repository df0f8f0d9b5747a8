use super::node::{Id, Node};
use crate::hdl::{Field, Role, Shape};

/// One circuit as a netlist: its signals, what drives them, and the circuits inside it.
///
/// Two of the same circuit that differ in nothing but the contents of memories and the values of
/// parameters are one.
#[derive(Debug, Clone, PartialEq)]
pub struct Module {
    /// The circuit's name.
    pub name: String,
    /// What it does, in one line.
    pub about: &'static str,
    /// The nodes; each is computed from nodes before it.
    pub nodes: Vec<(Node, Shape)>,
    /// Inputs, registers and nets, in the order of their declaration, with the registers of the
    /// circuits inside.
    pub signals: Vec<Signal>,
    /// Its parameters; those of the circuits inside it are not among them.
    pub parameters: Vec<Parameter>,
    /// Its memories, in the same order, then its ROMs.
    pub memories: Vec<Memory>,
    /// What holds of it.
    pub assertions: Vec<Assertion>,
    /// The circuits inside it, in the order in which they settle.
    pub instances: Vec<Child>,
    pub(crate) registers: Vec<Register>,
    /// For every leaf of the walk over the nets the signal, if it is not one of an instance.
    pub(crate) nets: Vec<Option<usize>>,
    /// For every leaf of that walk the node that it shows.
    pub(crate) net_nodes: Vec<Id>,
    /// For every memory that belongs to an instance, the instance and the memory there.
    pub(crate) owners: Vec<Option<(usize, usize)>>,
}

/// A signal of a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// Its name.
    pub name: String,
    /// What `signals!` says of it.
    pub field: &'static Field,
    /// Port in, register or net.
    pub role: Role,
    /// Kind and width.
    pub shape: Shape,
    /// Power-on value of a register.
    pub power_on: u64,
    /// What drives a net or, at the edge, a register.
    pub driver: Option<Id>,
    /// For the register of an instance: the instance, and the signal there.
    pub owner: Option<(usize, usize)>,
}

impl Module {
    /// Its ports in, in their order.
    pub fn inputs(&self) -> impl Iterator<Item = &Signal> {
        let inputs = self.signals.iter();
        inputs.filter(|signal| signal.role == Role::Input && signal.owner.is_none())
    }
}

impl Signal {
    /// Whether it is a port.
    pub fn is_port(&self) -> bool {
        self.owner.is_none() && (self.role == Role::Input || self.field.public)
    }
}

/// A parameter of a module; its value belongs to the instance.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Width in bits.
    pub width: usize,
}

/// A memory of a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Memory {
    /// Its name.
    pub name: String,
    /// What `signals!` says of it; nothing of a ROM.
    pub doc: &'static str,
    /// The number of words.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// How it is written.
    pub port: Port,
    /// Whether a word is other than zero at power-on, in any instance.
    pub filled: bool,
    /// Whether it belongs to an instance.
    pub inner: bool,
}

impl Memory {
    /// What Verilog calls after it: loops over its words.
    pub(crate) fn loops(&self) -> impl Iterator<Item = String> {
        let zeros = (!self.filled).then_some("word");
        let shift: &[&str] = match self.port {
            Port::Shift { .. } => &["to", "shift"],
            Port::Ram { .. } | Port::Rom => &[],
        };
        let loops = zeros.into_iter().chain(shift.iter().copied());
        loops.map(|of| format!("{}_{of}", self.name))
    }
}

/// A property of a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Assertion {
    /// What holds.
    pub name: &'static str,
    /// The signals at fault where it does not.
    pub signals: &'static [&'static str],
    /// Whether it looks at the tick before: at the registers that an edge made, and by
    /// [`Node::Past`] at everything before that edge.
    pub step: bool,
    /// High where it holds.
    pub holds: Id,
}

/// How a memory is written, by nodes that are called so.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Port<I = Id> {
    /// Never.
    Rom,
    /// A word at an address.
    Ram {
        /// Where this is high.
        enable: I,
        /// The address.
        address: I,
        /// The word.
        data: I,
    },
    /// All words move up by one place.
    Shift {
        /// Where this is high.
        enable: I,
        /// The new first word.
        data: I,
    },
}

impl<I> Port<I> {
    /// The nodes that it takes: enable, data, address.
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

    /// The same of other nodes.
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

/// A circuit inside a module.
#[derive(Debug, Clone, PartialEq)]
pub struct Child {
    /// Its name: that of its fields in the surrounding circuit.
    pub name: String,
    /// Its module: an index into [`Design::modules`].
    pub module: usize,
    /// What drives its inputs, in their order.
    pub inputs: Vec<Id>,
}

/// What a leaf of the walk over the registers is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Register {
    /// A flip-flop: the signal.
    Signal(usize),
    /// A memory.
    Memory(usize),
}

/// What instances of one module may differ in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Setting {
    /// The instances around it, outermost first, and its name.
    pub path: Vec<String>,
    /// Width in bits of the value or of a word.
    pub width: usize,
    /// What it is set to.
    pub value: Value,
}

/// What a setting is set to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Value {
    /// The value of a parameter.
    Number(u64),
    /// The words of a memory at power-on, of one that is not zero.
    Words(Vec<u64>),
}

/// A circuit with the circuits inside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// The modules: each after those inside it, the circuit itself last.
    pub modules: Vec<Module>,
    /// Its parameters and the contents of its memories, and those of the circuits inside it.
    pub settings: Vec<Setting>,
}
