//! Expressions in Verilog.

use super::conversion::{constant, wrap};
use crate::netlist::{Id, Kind, Module, Node, Operator, Port, Shape};
use crate::printed::{Names, index_width};
use std::cell::RefCell;
use std::collections::HashMap;

/// Precedence of an operator in Verilog.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Rank {
    Choice,
    Either,
    Both,
    Or,
    Xor,
    And,
    Equality,
    Order,
    Shift,
    Sum,
    Product,
    Unary,
    Atom,
}

/// Text and how tightly its outermost operator binds.
pub(super) struct Text(pub(super) String, pub(super) Rank);

impl Text {
    pub(super) fn atom(text: String) -> Self {
        Text(text, Rank::Atom)
    }

    /// Returns the text as an operand of an operator of this rank, in parentheses if needed.
    pub(super) fn within(self, rank: Rank) -> String {
        match self.1 >= rank {
            true => self.0,
            false => format!("({})", self.0),
        }
    }
}

/// Writes the expressions of a module.
///
/// Every operand has the width of its operation, conversions are written out, and a signed word
/// is a signed expression: so neither the widths nor the signs of Verilog's contexts matter.
pub(super) struct Expressions<'m> {
    pub(super) module: &'m Module,
    pub(super) names: &'m Names<'m>,
    /// The bits of each name that have been read.
    read: RefCell<HashMap<String, u64>>,
}

impl<'m> Expressions<'m> {
    pub(super) fn new(module: &'m Module, names: &'m Names<'m>) -> Self {
        Expressions {
            module,
            names,
            read: RefCell::default(),
        }
    }

    /// The bits of `name` that are read by what has been written so far.
    pub(super) fn bits_read(&self, name: &str) -> u64 {
        self.read.borrow().get(name).copied().unwrap_or(0)
    }

    /// Notes that these bits of a name are read.
    pub(super) fn mark(&self, name: &str, bits: u64) {
        *self.read.borrow_mut().entry(name.to_owned()).or_insert(0) |= bits;
    }

    /// The value of a node: its name, if it has one.
    pub(super) fn value(&self, id: Id) -> String {
        self.text(id).0
    }

    /// The value of a node as the condition of an `if`.
    pub(super) fn negated(&self, id: Id) -> String {
        self.not(id).0
    }

    /// Returns the expression of a node, even if it has a name. Long choices and conditions take
    /// several lines, each indented by `indent`.
    pub(super) fn definition(&self, id: Id, room: usize, indent: &str) -> String {
        let text = self.computed(id).0;
        if text.len() <= room {
            return text;
        }
        let mut parts = Vec::new();
        match self.module.nodes[id].0 {
            Node::Mux(..) => {
                let mut last = id;
                while let Node::Mux(choose, then, other) = self.module.nodes[last].0 {
                    if last != id && self.names.get(last).is_some() {
                        break;
                    }
                    let choose = self.text(choose).within(Rank::Either);
                    let then = self.text(then).within(Rank::Either);
                    parts.push(format!("{choose} ? {then} :"));
                    last = other;
                }
                parts.push(self.text(last).within(Rank::Either));
            }
            Node::Binary(operator @ (Operator::And | Operator::Or), ..) => {
                let sign = self.sign(operator, id).0;
                let mut terms = Vec::new();
                self.terms(operator, id, true, (room, indent), &mut terms);
                let last = terms.len() - 1;
                for (index, term) in terms.into_iter().enumerate() {
                    parts.push(match index == last {
                        true => term,
                        false => format!("{term} {sign}"),
                    });
                }
            }
            _ => return text,
        }
        parts.join(&format!("\n{indent}"))
    }

    /// The terms of a chain of one operator; long chains among them in several lines.
    fn terms(
        &self,
        operator: Operator,
        id: Id,
        whole: bool,
        (room, indent): (usize, &str),
        terms: &mut Vec<String>,
    ) {
        match self.module.nodes[id].0 {
            Node::Binary(here, a, b)
                if here == operator && (whole || self.names.get(id).is_none()) =>
            {
                self.terms(operator, a, false, (room, indent), terms);
                self.terms(operator, b, false, (room, indent), terms);
            }
            node => {
                let text = self.text(id).within(Rank::Equality);
                let chain = matches!(node, Node::Binary(Operator::And | Operator::Or, ..));
                terms.push(match chain && text.len() > room {
                    true => format!("({})", self.definition(id, room, &format!("{indent} "))),
                    false => text,
                });
            }
        }
    }

    pub(super) fn text(&self, id: Id) -> Text {
        match self.names.get(id) {
            Some(name) => {
                self.mark(name, u64::MAX);
                Text::atom(name.to_owned())
            }
            None => self.computed(id),
        }
    }

    pub(super) fn shape(&self, id: Id) -> Shape {
        self.module.nodes[id].1
    }

    fn computed(&self, id: Id) -> Text {
        let (node, shape) = self.module.nodes[id];
        match node {
            Node::Constant(bits) => constant(bits, shape),
            Node::Parameter(parameter) => {
                Text::atom(self.module.parameters[parameter].name.to_uppercase())
            }
            Node::Signal(_) | Node::Port { .. } => {
                Text::atom(self.names.get(id).unwrap_or_default().to_owned())
            }
            Node::Not(a) => self.not(a),
            Node::Negate(a) => Text(format!("-{}", self.text(a).within(Rank::Atom)), Rank::Unary),
            Node::Binary(operator, a, b) => self.binary(operator, id, a, b),
            Node::Mux(choose, then, other) => {
                let choose = self.text(choose).within(Rank::Either);
                let then = self.text(then).within(Rank::Either);
                let other = self.text(other).within(Rank::Choice);
                Text(format!("{choose} ? {then} : {other}"), Rank::Choice)
            }
            Node::ShiftLeft(a, by) => Text(
                format!("{} << {by}", self.text(a).within(Rank::Shift)),
                Rank::Shift,
            ),
            Node::ShiftRight(a, by) => {
                let sign = match shape.kind {
                    Kind::Signed => ">>>",
                    _ => ">>",
                };
                Text(
                    format!("{} {sign} {by}", self.text(a).within(Rank::Shift)),
                    Rank::Shift,
                )
            }
            Node::Slice(of, low) => self.slice(of, low, shape),
            Node::Extend(a) => self.extend(a, shape),
            Node::Join(a, b) => {
                let parts = [a, b].map(|part| self.text(part).0);
                Text::atom(format!("{{{}}}", parts.join(", ")))
            }
            Node::Cast(a) => self.cast(a, shape.kind),
            Node::Past(a) => {
                let past = Text::atom(format!("$past({})", self.value(a)));
                // The functions of formal tools are unsigned.
                wrap(past, Kind::Unsigned, shape.kind)
            }
            Node::Read(memory, address) => {
                let memory = &self.module.memories[memory];
                let index = match self.module.nodes[address].0 {
                    Node::Constant(bits) => bits.to_string(),
                    _ => self.index(address, index_width(memory.words)),
                };
                let read = format!("{}[{index}]", memory.name);
                self.mark(&memory.name, u64::MAX);
                Text::atom(read)
            }
        }
    }

    /// The node whose text is that of `id`: a bit and a word of one bit are the same in Verilog.
    pub(super) fn same_bits(&self, id: Id) -> Id {
        match self.module.nodes[id].0 {
            Node::Cast(a)
                if self.names.get(id).is_none()
                    && self.shape(id).kind != Kind::Signed
                    && self.shape(a).kind != Kind::Signed =>
            {
                self.same_bits(a)
            }
            _ => id,
        }
    }

    /// An address as wide as the memory's index.
    fn index(&self, address: Id, width: usize) -> String {
        let shape = Shape {
            width,
            kind: Kind::Unsigned,
        };
        match self.shape(address).width {
            wide if wide > width && width > 0 => self.slice(address, 0, shape).0,
            narrow if narrow < width => self.extend(address, shape).0,
            _ => self.value(address),
        }
    }

    fn not(&self, a: Id) -> Text {
        if self.names.get(a).is_none() {
            match self.module.nodes[a].0 {
                Node::Not(a) => return self.text(a),
                Node::Binary(Operator::Equal, a, b) => {
                    return self.pair("!=", Rank::Equality, a, b);
                }
                Node::Binary(Operator::Below, a, b) => return self.pair(">=", Rank::Order, a, b),
                _ => {}
            }
        }
        let sign = match self.shape(a).kind {
            Kind::Bit => "!",
            _ => "~",
        };
        Text(
            format!("{sign}{}", self.text(a).within(Rank::Atom)),
            Rank::Unary,
        )
    }

    pub(super) fn sign(&self, operator: Operator, id: Id) -> (&'static str, Rank) {
        let bit = self.shape(id).kind == Kind::Bit;
        match operator {
            Operator::Add => ("+", Rank::Sum),
            Operator::Subtract => ("-", Rank::Sum),
            Operator::Multiply => ("*", Rank::Product),
            Operator::And if bit => ("&&", Rank::Both),
            Operator::And => ("&", Rank::And),
            Operator::Or if bit => ("||", Rank::Either),
            Operator::Or => ("|", Rank::Or),
            Operator::Xor => ("^", Rank::Xor),
            Operator::Equal => ("==", Rank::Equality),
            Operator::Below => ("<", Rank::Order),
        }
    }

    fn binary(&self, operator: Operator, id: Id, a: Id, b: Id) -> Text {
        let (sign, rank) = self.sign(operator, id);
        match operator {
            Operator::Xor if a == b => self.pair(sign, rank, a, b),
            // Chains need no brackets; everything looser than a comparison gets them.
            Operator::And | Operator::Or | Operator::Xor => {
                let term = |operand: Id| {
                    let same = self.names.get(operand).is_none()
                        && matches!(self.module.nodes[operand].0, Node::Binary(inner, ..) if inner == operator);
                    let loosest = match operator {
                        Operator::Xor => Rank::Unary,
                        _ => Rank::Equality,
                    };
                    self.text(operand).within(if same { rank } else { loosest })
                };
                Text(format!("{} {sign} {}", term(a), term(b)), rank)
            }
            _ => self.pair(sign, rank, a, b),
        }
    }

    fn pair(&self, sign: &str, rank: Rank, a: Id, b: Id) -> Text {
        let tighter = match rank {
            Rank::Equality | Rank::Order => Rank::Shift,
            Rank::Sum => Rank::Product,
            _ => Rank::Unary,
        };
        let left = self
            .text(a)
            .within(if rank == Rank::Sum { rank } else { tighter });
        let right = match a == b {
            // A property compares a net with its own driver.
            true => self.computed(b),
            false => self.text(b),
        };
        let right = right.within(tighter);
        Text(format!("{left} {sign} {right}"), rank)
    }

    /// Returns a memory's enable condition and write statement for the clocked block.
    pub(super) fn port(&self, memory: usize) -> Option<(Option<String>, String)> {
        let memory = &self.module.memories[memory];
        match memory.port {
            Port::Ram {
                enable,
                address,
                data,
            } => {
                let index = self.index(address, index_width(memory.words));
                let write = format!("{}[{index}] <= {};", memory.name, self.value(data));
                match self.module.nodes[enable].0 {
                    Node::Constant(0) => None,
                    Node::Constant(_) => Some((None, write)),
                    _ => Some((Some(self.value(enable)), write)),
                }
            }
            _ => None,
        }
    }
}
