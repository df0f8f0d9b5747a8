use crate::hdl::{Kind, Shape};

/// A node of a module: an index into [`Module::nodes`](super::Module::nodes).
pub type Id = usize;

/// What a node computes from others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Node {
    /// A constant, in the low bits.
    Constant(u64),
    /// A parameter: an index into [`Module::parameters`](super::Module::parameters).
    Parameter(usize),
    /// An input or register: an index into [`Module::signals`](super::Module::signals).
    Signal(usize),
    /// A net of an instance: its place in the walk over the instance's nets.
    Port {
        /// The instance.
        instance: usize,
        /// The leaf.
        leaf: usize,
    },
    /// All bits inverted.
    Not(Id),
    /// The two's complement.
    Negate(Id),
    /// An operation on two words of the same width.
    Binary(Operator, Id, Id),
    /// The second where the first is high, else the third.
    Mux(Id, Id, Id),
    /// Moved up by a fixed number of bits, zeros from below.
    ShiftLeft(Id, usize),
    /// Moved down by a fixed number of bits; from above the sign of a signed word, else zeros.
    ShiftRight(Id, usize),
    /// As many bits as the node has, from this one up.
    Slice(Id, usize),
    /// Extended to the node's width, by the sign where the word is signed.
    Extend(Id),
    /// The first above the second.
    Join(Id, Id),
    /// The same bits as another kind of word.
    Cast(Id),
    /// What the node was a tick ago; in properties only.
    Past(Id),
    /// The word of a memory at an address; for a shift register, the stage.
    Read(usize, Id),
}

/// What is done with two words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operator {
    /// Sum modulo 2^N.
    Add,
    /// Difference modulo 2^N.
    Subtract,
    /// Product modulo 2^N.
    Multiply,
    /// Bit by bit.
    And,
    /// Bit by bit.
    Or,
    /// Bit by bit.
    Xor,
    /// One bit: both are the same.
    Equal,
    /// One bit: the first is less.
    Below,
}

impl Node {
    /// The nodes it is computed from.
    pub fn operands(self) -> impl Iterator<Item = Id> {
        let operands = match self {
            Node::Constant(_) | Node::Parameter(_) | Node::Signal(_) | Node::Port { .. } => {
                [None, None, None]
            }
            Node::Not(a)
            | Node::Negate(a)
            | Node::ShiftLeft(a, _)
            | Node::ShiftRight(a, _)
            | Node::Slice(a, _)
            | Node::Extend(a)
            | Node::Cast(a)
            | Node::Past(a)
            | Node::Read(_, a) => [Some(a), None, None],
            Node::Binary(_, a, b) | Node::Join(a, b) => [Some(a), Some(b), None],
            Node::Mux(a, b, c) => [Some(a), Some(b), Some(c)],
        };
        operands.into_iter().flatten()
    }

    /// The same of other nodes, which are asked for in the order of [`operands`](Self::operands).
    pub fn map(self, mut to: impl FnMut(Id) -> Id) -> Node {
        match self {
            Node::Constant(_) | Node::Parameter(_) | Node::Signal(_) | Node::Port { .. } => self,
            Node::Not(a) => Node::Not(to(a)),
            Node::Negate(a) => Node::Negate(to(a)),
            Node::Binary(operator, a, b) => Node::Binary(operator, to(a), to(b)),
            Node::Mux(a, b, c) => Node::Mux(to(a), to(b), to(c)),
            Node::ShiftLeft(a, bits) => Node::ShiftLeft(to(a), bits),
            Node::ShiftRight(a, bits) => Node::ShiftRight(to(a), bits),
            Node::Slice(a, low) => Node::Slice(to(a), low),
            Node::Extend(a) => Node::Extend(to(a)),
            Node::Join(a, b) => Node::Join(to(a), to(b)),
            Node::Cast(a) => Node::Cast(to(a)),
            Node::Past(a) => Node::Past(to(a)),
            Node::Read(memory, a) => Node::Read(memory, to(a)),
        }
    }
}

/// One wire.
pub(super) const BIT: Shape = Shape {
    kind: Kind::Bit,
    width: 1,
};
