use std::fmt;

/// Node of a [`Flat`] netlist: an index into [`Flat::nodes`].
pub type Id = u32;

/// Whole circuit as one netlist without hierarchy.
///
/// Every value is in the low bits of a 64-bit word, with zeros above.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Flat {
    /// Nodes; each comes after its operands.
    pub nodes: Vec<Node>,
    /// Widths of the input ports in bits.
    pub inputs: Vec<u8>,
    /// Flip-flops.
    pub registers: Vec<Register>,
    /// Memories and ROMs.
    pub memories: Vec<Memory>,
    /// Places of the leaves of a walk over the circuit, in its order.
    pub leaves: Vec<Place>,
    /// End of the input ports, and end of the registers and memories, among the leaves.
    pub parts: [usize; 2],
    /// Properties, one bit each; step properties are stated with the registers after the edge.
    pub properties: Vec<Id>,
    /// Circuits; the outermost is first.
    pub instances: Vec<Instance>,
}

/// Node of a netlist.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Node {
    /// Operation.
    pub op: Op,
    /// Width in bits, 1 to 64.
    pub width: u8,
    /// Instance that contains the node.
    pub instance: u32,
}

/// Operation of a node. Words are unsigned unless stated otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Op {
    /// Constant.
    Constant(u64),
    /// Input port.
    Input(u32),
    /// Flip-flop.
    Register(u32),
    /// Inversion of all bits.
    Not(Id),
    /// Two's complement negation.
    Negate(Id),
    /// Sum modulo 2^N.
    Add(Id, Id),
    /// Difference modulo 2^N.
    Subtract(Id, Id),
    /// Product modulo 2^N.
    Multiply(Id, Id),
    /// Bitwise and.
    And(Id, Id),
    /// Bitwise or.
    Or(Id, Id),
    /// Bitwise exclusive or.
    Xor(Id, Id),
    /// One bit: high if both are equal.
    Equal(Id, Id),
    /// One bit: high if the first is less.
    Below(Id, Id),
    /// One bit: high if the first is less in two's complement.
    BelowSigned(Id, Id),
    /// Second operand if the first is high, else the third.
    Mux(Id, Id, Id),
    /// Left shift by a fixed number of bits.
    ShiftLeft(Id, u8),
    /// Right shift by a fixed number of bits.
    ShiftRight(Id, u8),
    /// Arithmetic right shift by a fixed number of bits.
    ShiftRightSigned(Id, u8),
    /// Bits from this index up; the node's width is their number.
    Slice(Id, u8),
    /// Zero extension.
    Extend(Id),
    /// Sign extension.
    ExtendSigned(Id),
    /// Concatenation, the first operand in the high bits.
    Join(Id, Id),
    /// Word of a memory at an address, or stage of a shift register; zero past its end.
    Read(u32, Id),
}

impl Op {
    /// Returns the operands of the node.
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

    /// Returns the operation with each operand mapped by `to`.
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

/// Flip-flop.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Register {
    /// Width in bits.
    pub width: u8,
    /// Power-on value.
    pub power_on: u64,
    /// Node whose value it takes at an edge.
    pub next: Id,
    /// Instance that contains the register.
    pub instance: u32,
}

/// Memory.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Memory {
    /// Width of a word in bits.
    pub width: u8,
    /// Words at power-on.
    pub contents: Vec<u64>,
    /// Write port.
    pub port: Port,
    /// Instance that contains the memory.
    pub instance: u32,
}

/// Write port of a memory; an address has no effect past the last word.
pub type Port = crate::netlist::Port<Id>;

/// Place of a leaf of a walk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Input port.
    Input(u32),
    /// Flip-flop.
    Register(u32),
    /// Net.
    Node(Id),
    /// Word of a memory, or stage of a shift register.
    Word(u32, u32),
}

/// Circuit inside the outermost circuit.
#[derive(Clone, PartialEq, Eq)]
pub struct Instance {
    /// Scopes below the outermost circuit, which has none.
    pub path: Vec<String>,
    /// Name of its circuit.
    pub circuit: String,
}

impl fmt::Debug for Instance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.join("."), self.circuit)
    }
}

/// Reason why a circuit cannot be run.
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// The circuit has mistakes.
    #[error(transparent)]
    Circuit(#[from] crate::netlist::Wrong),
    /// A node depends on itself.
    #[error("{module}: node {node} is computed from nodes that are not settled before it")]
    Circle {
        /// Module.
        module: String,
        /// Node.
        node: usize,
    },
    /// A word has no bits, or more than 64.
    #[error("{module}: {what} has {width} bits; 1 to 64 are allowed")]
    Width {
        /// Module.
        module: String,
        /// Node, signal or memory.
        what: String,
        /// Width in bits.
        width: usize,
    },
    /// A signal has no driver.
    #[error("{module}: {what} is driven by nothing")]
    Unsettled {
        /// Module.
        module: String,
        /// Register, net, parameter or part.
        what: String,
    },
    /// The design has no module.
    #[error("a design without modules")]
    Empty,
}

crate::netlist::debug_as_display!(EngineError);

/// Returns a mask of the low `width` bits.
#[inline]
pub(crate) const fn mask(width: u8) -> u64 {
    u64::MAX >> (64 - width as u32)
}

impl Flat {
    /// Returns a node.
    pub fn node(&self, id: Id) -> Node {
        self.nodes[id as usize]
    }

    /// Returns the width of a leaf in bits.
    pub fn width(&self, leaf: usize) -> u8 {
        match self.leaves[leaf] {
            Place::Input(input) => self.inputs[input as usize],
            Place::Register(register) => self.registers[register as usize].width,
            Place::Word(memory, _) => self.memories[memory as usize].width,
            Place::Node(id) => self.node(id).width,
        }
    }

    /// Returns the leaves of a part of the circuit.
    #[inline]
    pub fn part(&self, role: crate::netlist::Role) -> std::ops::Range<usize> {
        let [inputs, registers] = self.parts;
        match role {
            crate::netlist::Role::Input => 0..inputs,
            crate::netlist::Role::Register => inputs..registers,
            crate::netlist::Role::Net => registers..self.leaves.len(),
        }
    }

    /// Returns the nodes that registers, memories, leaves and properties take.
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

    /// Rebuilds the netlist node by node: `make` returns the new node for each, whose operands are
    /// new already.
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
