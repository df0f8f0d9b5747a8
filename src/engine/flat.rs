use std::fmt;

/// A node of a [`Flat`] netlist: an index into [`Flat::nodes`].
pub type Id = u32;

/// A whole circuit as one netlist, its instances taken apart.
///
/// Every value is held in the low bits of a word of 64, with zeros above.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Flat {
    /// The nodes, each behind those that it is computed from.
    pub nodes: Vec<Node>,
    /// Ports in: their widths.
    pub inputs: Vec<u8>,
    /// Flip-flops.
    pub registers: Vec<Register>,
    /// Memories and ROMs.
    pub memories: Vec<Memory>,
    /// Where the leaves of a walk over the circuit stand, in its order.
    pub leaves: Vec<Place>,
    /// How many leaves are ports in, and how many are those or registers and memories.
    pub parts: [usize; 2],
    /// What holds of it, each a bit; step properties with the registers after the edge.
    pub properties: Vec<Id>,
    /// The circuits, the outermost first.
    pub instances: Vec<Instance>,
}

/// A node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Node {
    /// What it computes.
    pub op: Op,
    /// Width in bits, 1 to 64.
    pub width: u8,
    /// The instance it was written in.
    pub instance: u32,
}

/// What a node computes. Words are unsigned where nothing else is said.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Op {
    /// A number.
    Constant(u64),
    /// A port in.
    Input(u32),
    /// A flip-flop.
    Register(u32),
    /// All bits inverted.
    Not(Id),
    /// The two's complement.
    Negate(Id),
    /// Sum modulo 2^N.
    Add(Id, Id),
    /// Difference modulo 2^N.
    Subtract(Id, Id),
    /// Product modulo 2^N.
    Multiply(Id, Id),
    /// Bit by bit.
    And(Id, Id),
    /// Bit by bit.
    Or(Id, Id),
    /// Bit by bit.
    Xor(Id, Id),
    /// One bit: both are the same.
    Equal(Id, Id),
    /// One bit: the first is less.
    Below(Id, Id),
    /// One bit: the first is less, both in two's complement.
    BelowSigned(Id, Id),
    /// The second where the first is high, else the third.
    Mux(Id, Id, Id),
    /// Moved up by a number of bits.
    ShiftLeft(Id, u8),
    /// Moved down by a number of bits.
    ShiftRight(Id, u8),
    /// Moved down by a number of bits, the sign from above.
    ShiftRightSigned(Id, u8),
    /// As many bits as the node has, from this one up.
    Slice(Id, u8),
    /// More bits, zeros above.
    Extend(Id),
    /// More bits, the sign above.
    ExtendSigned(Id),
    /// The first above the second.
    Join(Id, Id),
    /// The word of a memory at an address, the stage of a shift register; zero past its end.
    Read(u32, Id),
}

impl Op {
    /// The nodes it is computed from.
    pub fn operands(self) -> impl Iterator<Item = Id> + Clone {
        let operands = match self {
            Op::Constant(_) | Op::Input(_) | Op::Register(_) => [None; 3],
            Op::Not(a)
            | Op::Negate(a)
            | Op::ShiftLeft(a, _)
            | Op::ShiftRight(a, _)
            | Op::ShiftRightSigned(a, _)
            | Op::Slice(a, _)
            | Op::Extend(a)
            | Op::ExtendSigned(a)
            | Op::Read(_, a) => [Some(a), None, None],
            Op::Add(a, b)
            | Op::Subtract(a, b)
            | Op::Multiply(a, b)
            | Op::And(a, b)
            | Op::Or(a, b)
            | Op::Xor(a, b)
            | Op::Equal(a, b)
            | Op::Below(a, b)
            | Op::BelowSigned(a, b)
            | Op::Join(a, b) => [Some(a), Some(b), None],
            Op::Mux(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        operands.into_iter().flatten()
    }

    /// The same of other nodes.
    pub fn map(self, mut to: impl FnMut(Id) -> Id) -> Op {
        match self {
            Op::Constant(_) | Op::Input(_) | Op::Register(_) => self,
            Op::Not(a) => Op::Not(to(a)),
            Op::Negate(a) => Op::Negate(to(a)),
            Op::Add(a, b) => Op::Add(to(a), to(b)),
            Op::Subtract(a, b) => Op::Subtract(to(a), to(b)),
            Op::Multiply(a, b) => Op::Multiply(to(a), to(b)),
            Op::And(a, b) => Op::And(to(a), to(b)),
            Op::Or(a, b) => Op::Or(to(a), to(b)),
            Op::Xor(a, b) => Op::Xor(to(a), to(b)),
            Op::Equal(a, b) => Op::Equal(to(a), to(b)),
            Op::Below(a, b) => Op::Below(to(a), to(b)),
            Op::BelowSigned(a, b) => Op::BelowSigned(to(a), to(b)),
            Op::Mux(a, b, c) => Op::Mux(to(a), to(b), to(c)),
            Op::ShiftLeft(a, bits) => Op::ShiftLeft(to(a), bits),
            Op::ShiftRight(a, bits) => Op::ShiftRight(to(a), bits),
            Op::ShiftRightSigned(a, bits) => Op::ShiftRightSigned(to(a), bits),
            Op::Slice(a, low) => Op::Slice(to(a), low),
            Op::Extend(a) => Op::Extend(to(a)),
            Op::ExtendSigned(a) => Op::ExtendSigned(to(a)),
            Op::Join(a, b) => Op::Join(to(a), to(b)),
            Op::Read(memory, a) => Op::Read(memory, to(a)),
        }
    }
}

/// A flip-flop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Register {
    /// Width in bits.
    pub width: u8,
    /// What it holds at power-on.
    pub power_on: u64,
    /// What it takes at an edge.
    pub next: Id,
    /// The instance it belongs to.
    pub instance: u32,
}

/// A memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Memory {
    /// Width of a word in bits.
    pub width: u8,
    /// What it holds at power-on, all words.
    pub contents: Vec<u64>,
    /// How it is written.
    pub port: Port,
    /// The instance it belongs to.
    pub instance: u32,
}

/// How a memory is written at an edge; an address names no more words than there are.
pub type Port = crate::hdl::netlist::Port<Id>;

/// Where a leaf of a walk stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A port in.
    Input(u32),
    /// A flip-flop.
    Register(u32),
    /// A net.
    Node(Id),
    /// A word of a memory, or a stage.
    Word(u32, u32),
}

/// A circuit in the circuit.
#[derive(Clone, PartialEq, Eq)]
pub struct Instance {
    /// The scopes from the outermost circuit on, which has none.
    pub path: Vec<String>,
    /// Its circuit.
    pub circuit: String,
}

impl fmt::Debug for Instance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.join("."), self.circuit)
    }
}

/// What cannot be run.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
pub enum EngineError {
    /// Something is wrong with the circuit.
    #[error(transparent)]
    Circuit(#[from] crate::hdl::Wrong),
    /// A node is computed from itself.
    #[error("{module}: node {node} is computed from nodes that are not settled before it")]
    Circle {
        /// The module.
        module: String,
        /// The node.
        node: usize,
    },
    /// A word is too wide, or has no bits.
    #[error("{module}: {what} has {width} bits; 1 to 64 are allowed")]
    Width {
        /// The module.
        module: String,
        /// Node, signal or memory.
        what: String,
        /// Its width.
        width: usize,
    },
    /// Nothing drives it.
    #[error("{module}: {what} is driven by nothing")]
    Unsettled {
        /// The module.
        module: String,
        /// Register, net, parameter or part.
        what: String,
    },
    /// There is no module.
    #[error("a design without modules")]
    Empty,
}

crate::hdl::debug_as_display!(EngineError);

/// All bits of a word of so many.
#[inline]
pub(crate) const fn mask(width: u8) -> u64 {
    u64::MAX >> (64 - width as u32)
}

impl Flat {
    /// Kind and width of a node.
    pub fn node(&self, id: Id) -> Node {
        self.nodes[id as usize]
    }

    /// Width of a leaf in bits.
    pub fn width(&self, leaf: usize) -> u8 {
        match self.leaves[leaf] {
            Place::Input(input) => self.inputs[input as usize],
            Place::Register(register) => self.registers[register as usize].width,
            Place::Word(memory, _) => self.memories[memory as usize].width,
            Place::Node(id) => self.node(id).width,
        }
    }

    /// The leaves of a part of the circuit.
    #[inline]
    pub fn part(&self, role: crate::hdl::Role) -> std::ops::Range<usize> {
        let [inputs, registers] = self.parts;
        match role {
            crate::hdl::Role::Input => 0..inputs,
            crate::hdl::Role::Register => inputs..registers,
            crate::hdl::Role::Net => registers..self.leaves.len(),
        }
    }

    /// The nodes that registers, memories, leaves and properties take.
    pub fn roots(&self) -> impl Iterator<Item = Id> + '_ {
        let registers = self.registers.iter().map(|register| register.next);
        let memories = self
            .memories
            .iter()
            .flat_map(|memory| memory.port.operands());
        let leaves = self.leaves.iter().filter_map(|place| match place {
            Place::Node(id) => Some(*id),
            _ => None,
        });
        registers
            .chain(memories)
            .chain(leaves)
            .chain(self.properties.iter().copied())
    }

    /// Makes it anew, node by node: `make` gives the new node of each, of which operands are new
    /// already.
    pub(super) fn rebuild(&self, mut make: impl FnMut(&mut Vec<Node>, Node) -> Id) -> Flat {
        let mut nodes = Vec::with_capacity(self.nodes.len());
        let mut map: Vec<Id> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let op = node.op.map(|id| map[id as usize]);
            let id = make(&mut nodes, Node { op, ..*node });
            map.push(id);
        }
        let to = |id: Id| map[id as usize];
        let mut flat = Flat {
            nodes,
            inputs: self.inputs.clone(),
            registers: self.registers.clone(),
            memories: self.memories.clone(),
            leaves: self.leaves.clone(),
            parts: self.parts,
            properties: self.properties.iter().map(|&id| to(id)).collect(),
            instances: self.instances.clone(),
        };
        for register in &mut flat.registers {
            register.next = to(register.next);
        }
        for memory in &mut flat.memories {
            memory.port = memory.port.map(to);
        }
        for place in &mut flat.leaves {
            if let Place::Node(id) = place {
                *id = to(*id);
            }
        }
        flat
    }
}
