/// Node of a module: an index into [`Module::nodes`](super::Module::nodes).
pub type Id = usize;

/// Operation of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Node {
    /// Constant, in the low bits.
    Constant(u64),
    /// Parameter: an index into [`Module::parameters`](super::Module::parameters).
    Parameter(usize),
    /// Input or register: an index into [`Module::signals`](super::Module::signals).
    Signal(usize),
    /// Net of an instance.
    Port {
        /// Index of the instance.
        instance: usize,
        /// Leaf in the walk over the instance's nets.
        leaf: usize,
    },
    /// Inversion of all bits.
    Not(Id),
    /// Two's complement negation.
    Negate(Id),
    /// Operation on two words of the same width.
    Binary(Operator, Id, Id),
    /// Second operand if the first is high, else the third.
    Mux(Id, Id, Id),
    /// Left shift by a fixed number of bits, filled with zeros.
    ShiftLeft(Id, usize),
    /// Right shift by a fixed number of bits, filled with the sign of a signed word, else with
    /// zeros.
    ShiftRight(Id, usize),
    /// Bits from this index up; the node's width is their number.
    Slice(Id, usize),
    /// Extension to the node's width; sign extension if the word is signed.
    Extend(Id),
    /// Concatenation, the first operand in the high bits.
    Join(Id, Id),
    /// Same bits as another kind of word.
    Cast(Id),
    /// Value of the node one tick ago; used in properties only.
    Past(Id),
    /// Word of a memory at an address; in a shift register, at a stage.
    Read(usize, Id),
}

/// Operation on two words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Operator {
    /// Sum modulo 2^N.
    Add,
    /// Difference modulo 2^N.
    Subtract,
    /// Product modulo 2^N.
    Multiply,
    /// Bitwise and.
    And,
    /// Bitwise or.
    Or,
    /// Bitwise exclusive or.
    Xor,
    /// One bit: high if both are equal.
    Equal,
    /// One bit: high if the first is less.
    Below,
}

impl Node {
    /// Returns the operands of the node.
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

    /// Returns the node with each operand mapped by `to`, in the order of
    /// [`operands`](Self::operands).
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
