//! Products, parts and other types of words, and words of memories.

use super::constant::typed;
use super::expression::{Expressions, Rank, Text};
use crate::netlist::{Id, Kind, Module, Node, Port, Shape, unsigned};
use crate::printed::{Names, index_width};

impl Expressions<'_> {
    /// Returns a product of the width of its operands. VHDL's is as wide as both together, so
    /// extensions of the operands are left out as far as they fit.
    pub(super) fn product(&self, a: Id, b: Id, shape: Shape) -> Text {
        let factor = |id: Id| match (self.names.get(id), self.module.nodes[id].0) {
            (None, Node::Extend(inner)) if self.shape(inner).kind == shape.kind => inner,
            _ => id,
        };
        let (a, b) = (factor(a), factor(b));
        let width = self.shape(a).width + self.shape(b).width;
        let [left, right] = [a, b].map(|id| self.text(id).within(Rank::Unary));
        let product = format!("{left} * {right}");
        let narrow = shape.width;
        match (width > narrow, shape.kind) {
            _ if width == narrow => Text(product, Rank::Product),
            // A signed word keeps its sign when `resize` makes it narrower.
            (true, Kind::Signed) => {
                Text::atom(format!("signed(resize(unsigned({product}), {narrow}))"))
            }
            _ => Text::atom(format!("resize({product}, {narrow})")),
        }
    }

    /// Returns the bits of a word from `low` up.
    pub(super) fn slice(&self, of: Id, low: usize, shape: Shape) -> Text {
        let of = bits_of(self.names, self.module, of);
        let whole = self.shape(of);
        if let Node::Constant(bits) = self.module.nodes[of].0 {
            let bits = bits >> low & (u64::MAX >> (64 - shape.width.clamp(1, 64)));
            return typed(bits, shape);
        }
        if whole.kind == Kind::Bit {
            return self.cast(of, shape);
        }
        let named = self.names.get(of).is_some() || is_indexed(self.module, of);
        let text = match (shape.kind, named) {
            (Kind::Bit, _) => return Text::atom(format!("{}({low})", self.value(of))),
            (_, true) if low == 0 && shape.width == whole.width => self.value(of),
            (_, true) => {
                let high = low + shape.width - 1;
                format!("{}({high} downto {low})", self.value(of))
            }
            // Of an expression, only its low bits are taken without a name.
            (_, false) => {
                let word = convert(self.text(of), whole.kind, Kind::Unsigned).0;
                let word = format!("resize({word}, {})", shape.width);
                return convert(Text::atom(word), Kind::Unsigned, shape.kind);
            }
        };
        convert(Text::atom(text), whole.kind, shape.kind)
    }

    pub(super) fn extend(&self, a: Id, shape: Shape) -> Text {
        let word = match self.shape(a).kind {
            Kind::Bit => self.cast(a, unsigned(1)),
            _ => self.text(a),
        };
        Text::atom(format!("resize({}, {})", word.0, shape.width))
    }

    /// Returns the parts of words side by side. Bits alone could be of any type.
    pub(super) fn join(&self, id: Id, shape: Shape) -> Text {
        let (mut parts, mut words) = (Vec::new(), false);
        self.parts(id, true, &mut parts, &mut words);
        let joined = parts.join(" & ");
        let joined = match words {
            true => Text(joined, Rank::Sum),
            false => Text::atom(format!("unsigned'({joined})")),
        };
        convert(joined, Kind::Unsigned, shape.kind)
    }

    fn parts(&self, id: Id, whole: bool, parts: &mut Vec<String>, words: &mut bool) {
        let (node, shape) = self.module.nodes[id];
        match (self.names.get(id).filter(|_| !whole), node) {
            (None, Node::Join(a, b)) => {
                self.parts(a, false, parts, words);
                self.parts(b, false, parts, words);
            }
            (None, Node::Cast(bit)) if self.shape(bit).kind == Kind::Bit => {
                parts.push(self.text(bit).within(Rank::Atom));
            }
            _ if shape.kind == Kind::Bit => parts.push(self.text(id).within(Rank::Atom)),
            _ => {
                let word = convert(self.text(id), shape.kind, Kind::Unsigned);
                parts.push(word.within(Rank::Product));
                *words = true;
            }
        }
    }

    pub(super) fn cast(&self, a: Id, shape: Shape) -> Text {
        let from = self.shape(a).kind;
        match (from, shape.kind) {
            (Kind::Bit, Kind::Unsigned) => Text::atom(format!("unsigned'(0 => {})", self.value(a))),
            (Kind::Bit, Kind::Signed) => Text::atom(format!("signed'(0 => {})", self.value(a))),
            (Kind::Unsigned | Kind::Signed, Kind::Bit) => match self.module.nodes[a].0 {
                Node::Constant(bits) => typed(bits, shape),
                _ if self.names.get(a).is_some() => Text::atom(format!("{}(0)", self.value(a))),
                Node::Cast(inner) => self.cast(inner, shape),
                Node::Slice(of, low) => self.slice(of, low, shape),
                _ => Text::atom(format!("{}(0)", self.value(a))),
            },
            (from, to) => match (self.names.get(a), self.module.nodes[a].0) {
                (None, Node::Cast(inner)) => self.cast(inner, shape),
                _ => convert(self.text(a), from, to),
            },
        }
    }

    /// Returns a word of a memory.
    pub(super) fn word(&self, memory: usize, address: Id) -> String {
        let memory = &self.module.memories[memory];
        let name = self.scope.own(&memory.name);
        let width = index_width(memory.words);
        let (node, shape) = self.module.nodes[address];
        let index = match (node, width) {
            (_, 0) => "0".to_owned(),
            (Node::Constant(bits), _) => bits.to_string(),
            _ => {
                let index = match shape.width > width {
                    true => self.slice(address, 0, unsigned(width)).0,
                    false => self.value(address),
                };
                let number = format!("to_integer({index})");
                match memory.words >> shape.width.min(width) {
                    // A simulator stops at an index that there is not, even if nothing reads the word.
                    0 => format!("minimum({number}, {})", memory.words - 1),
                    _ => number,
                }
            }
        };
        format!("{name}({index})")
    }

    /// Returns the write of a RAM: its condition, if it has one, and the statement.
    pub(super) fn write(&self, memory: usize) -> Option<(Option<String>, String)> {
        let Port::Ram {
            enable,
            address,
            data,
        } = self.module.memories[memory].port
        else {
            return None;
        };
        let word = self.word(memory, address);
        let write = format!("{word} <= {}", self.assigned(data, self.shape(data), None));
        match self.module.nodes[enable].0 {
            Node::Constant(0) => None,
            Node::Constant(_) => Some((None, write)),
            _ => Some((Some(self.value(enable)), write)),
        }
    }
}

/// Returns the node whose bits a word shows: a cast of words has those of its operand.
pub(super) fn bits_of(names: &Names<'_>, module: &Module, id: Id) -> Id {
    match module.nodes[id].0 {
        Node::Cast(a) if names.get(id).is_none() && module.nodes[a].1.kind != Kind::Bit => {
            bits_of(names, module, a)
        }
        _ => id,
    }
}

/// Returns true if bits of a node can be taken although it has no name of its own: of a word of a
/// memory, a generic, a constant.
pub(super) fn is_indexed(module: &Module, id: Id) -> bool {
    let node = module.nodes[id].0;
    matches!(
        node,
        Node::Read(..) | Node::Parameter(_) | Node::Constant(_)
    )
}

/// Converts a word to signed or unsigned without changing its bits.
fn convert(text: Text, from: Kind, to: Kind) -> Text {
    match (from, to) {
        (Kind::Unsigned, Kind::Signed) => Text::atom(format!("signed({})", text.0)),
        (Kind::Signed, Kind::Unsigned) => Text::atom(format!("unsigned({})", text.0)),
        _ => text,
    }
}
