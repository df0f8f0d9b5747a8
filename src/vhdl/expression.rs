//! Expressions in VHDL.

use super::constant::{assigned, beside, typed};
use super::scope::Scope;
use crate::netlist::{Format, Id, Kind, Module, Node, Operator, Role, Shape, Signal};
use crate::printed::Names;
use std::cell::RefCell;
use std::collections::HashSet;

/// Widest parameter that is a `natural`.
pub(super) const NATURAL: usize = 31;

/// How tightly the outermost operator of a text binds. `and`, `or` and `xor` bind alike, and need
/// parentheses beside each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rank {
    Logical(Operator),
    Relation,
    Sign,
    Sum,
    Product,
    Unary,
    Atom,
}

impl Rank {
    fn level(self) -> usize {
        match self {
            Rank::Logical(_) => 0,
            Rank::Relation => 1,
            Rank::Sign => 2,
            Rank::Sum => 3,
            Rank::Product => 4,
            Rank::Unary => 5,
            Rank::Atom => 6,
        }
    }
}

/// Text and how tightly its outermost operator binds.
pub(super) struct Text(pub(super) String, pub(super) Rank);

impl Text {
    pub(super) fn atom(text: String) -> Self {
        Text(text, Rank::Atom)
    }

    /// Returns the text as an operand of an operator of this rank, in parentheses if needed.
    pub(super) fn within(self, rank: Rank) -> String {
        match self.1.level() >= rank.level() {
            true => self.0,
            false => format!("({})", self.0),
        }
    }

    /// Returns the text as an operand of a logical operator. Relations get parentheses too.
    fn term(self, operator: Operator) -> String {
        match self.1 {
            Rank::Logical(same) if same == operator => self.0,
            _ => self.within(Rank::Sum),
        }
    }
}

/// Writes the expressions of a module.
///
/// A bit is a `std_logic`, a word an `unsigned` or `signed` of its width. Relations are those that
/// return a `std_logic`, so a condition is a bit like any other.
pub(super) struct Expressions<'m> {
    pub(super) module: &'m Module,
    pub(super) names: &'m Names<'m>,
    pub(super) scope: &'m Scope,
    /// Signals whose states have been written by their names.
    states: RefCell<HashSet<usize>>,
}

impl<'m> Expressions<'m> {
    pub(super) fn new(module: &'m Module, names: &'m Names<'m>, scope: &'m Scope) -> Self {
        Expressions {
            module,
            names,
            scope,
            states: RefCell::default(),
        }
    }

    /// Returns true if a state of a signal has been written by its name.
    pub(super) fn uses_states(&self, signal: usize) -> bool {
        self.states.borrow().contains(&signal)
    }

    pub(super) fn shape(&self, id: Id) -> Shape {
        self.module.nodes[id].1
    }

    /// Returns the value of a node: its name, if it has one.
    pub(super) fn value(&self, id: Id) -> String {
        self.text(id).0
    }

    /// Returns the opposite of a bit.
    pub(super) fn negated(&self, id: Id) -> String {
        self.not(id).0
    }

    pub(super) fn text(&self, id: Id) -> Text {
        match self.names.get(id) {
            Some(name) => Text::atom(name.to_owned()),
            None => self.computed(id),
        }
    }

    /// Returns what a signal of a shape takes: a state by its name, a constant in its shortest form.
    pub(super) fn assigned(&self, id: Id, shape: Shape, signal: Option<usize>) -> String {
        match (self.names.get(id), self.module.nodes[id].0) {
            (None, Node::Constant(bits)) => self
                .state(signal, bits)
                .unwrap_or_else(|| assigned(bits, shape)),
            _ => self.cast(id, shape).0,
        }
    }

    /// Returns the node below casts without names.
    pub(super) fn uncast(&self, id: Id) -> Id {
        match self.module.nodes[id].0 {
            Node::Cast(a) if self.names.get(id).is_none() => self.uncast(a),
            _ => id,
        }
    }

    /// Returns the alternatives of a node, even if it has a name: values with their conditions. The
    /// last one has none.
    pub(super) fn alternatives(&self, id: Id, signal: Option<usize>) -> Vec<String> {
        let shape = self.shape(id);
        let mut alternatives = Vec::new();
        match self.module.nodes[id].0 {
            Node::Mux(choose, then, other) => {
                self.choose(
                    [choose, then, other],
                    &[],
                    (shape, signal),
                    &mut alternatives,
                );
            }
            Node::Cast(a) => self.alternative(a, &[], (shape, signal), &mut alternatives),
            Node::Constant(bits) => alternatives.push(
                self.state(signal, bits)
                    .unwrap_or_else(|| assigned(bits, shape)),
            ),
            _ => alternatives.push(self.computed(id).0),
        }
        alternatives
    }

    fn choose(
        &self,
        [choose, then, other]: [Id; 3],
        conditions: &[Id],
        target: (Shape, Option<usize>),
        alternatives: &mut Vec<String>,
    ) {
        let inner = [conditions, &[choose]].concat();
        self.alternative(then, &inner, target, alternatives);
        self.alternative(other, conditions, target, alternatives);
    }

    /// Adds what a target takes under some conditions.
    fn alternative(
        &self,
        id: Id,
        conditions: &[Id],
        (shape, signal): (Shape, Option<usize>),
        alternatives: &mut Vec<String>,
    ) {
        let id = self.uncast(id);
        if let (None, Node::Mux(choose, then, other)) =
            (self.names.get(id), self.module.nodes[id].0)
        {
            let parts = [choose, then, other];
            return self.choose(parts, conditions, (shape, signal), alternatives);
        }
        let value = self.assigned(id, shape, signal);
        let condition = match conditions {
            [] => String::new(),
            [one] => format!(" when {}", self.value(*one)),
            all => {
                let terms = all.iter().map(|id| self.text(*id).term(Operator::And));
                format!(" when {}", terms.collect::<Vec<_>>().join(" and "))
            }
        };
        alternatives.push(value + &condition);
    }

    fn computed(&self, id: Id) -> Text {
        let (node, shape) = self.module.nodes[id];
        match node {
            Node::Constant(bits) => typed(bits, shape),
            Node::Parameter(parameter) => self.parameter(parameter, shape),
            Node::Signal(_) | Node::Port { .. } => {
                Text::atom(self.names.get(id).unwrap_or_default().to_owned())
            }
            Node::Not(a) => self.not(a),
            Node::Negate(a) => match shape.kind {
                Kind::Signed => Text(
                    format!("-{}", self.text(a).within(Rank::Product)),
                    Rank::Sign,
                ),
                // There is no minus of an unsigned word.
                _ => Text(
                    format!("0 - {}", self.text(a).within(Rank::Product)),
                    Rank::Sum,
                ),
            },
            Node::Binary(operator, a, b) => self.binary(operator, id, a, b),
            // Names are given to all that do not stand in a statement of their own.
            Node::Mux(..) => Text::atom(self.alternatives(id, None).join(" else ")),
            Node::ShiftLeft(a, by) => self.call("shift_left", a, by),
            Node::ShiftRight(a, by) => self.call("shift_right", a, by),
            Node::Slice(of, low) => self.slice(of, low, shape),
            Node::Extend(a) => self.extend(a, shape),
            Node::Join(..) => self.join(id, shape),
            Node::Cast(a) => self.cast(a, shape),
            // Only properties look back.
            Node::Past(a) => self.text(a),
            Node::Read(memory, address) => Text::atom(self.word(memory, address)),
        }
    }

    fn call(&self, function: &str, a: Id, number: usize) -> Text {
        Text::atom(format!("{function}({}, {number})", self.value(a)))
    }

    fn parameter(&self, parameter: usize, shape: Shape) -> Text {
        let parameter = &self.module.parameters[parameter];
        let name = self.scope.generic(&parameter.name.to_uppercase());
        Text::atom(match (parameter.width <= NATURAL, shape.kind) {
            (true, Kind::Bit) => format!("to_unsigned({name}, 1)(0)"),
            (true, _) => format!("to_unsigned({name}, {})", shape.width),
            (false, _) => name,
        })
    }

    /// Returns an operand beside a word of its shape.
    fn operand(&self, id: Id) -> Text {
        match (self.names.get(id), self.module.nodes[id]) {
            (None, (Node::Constant(bits), shape)) => beside(bits, shape),
            (None, (Node::Parameter(parameter), shape))
                if shape.width <= NATURAL && shape.kind == Kind::Unsigned =>
            {
                let parameter = self.module.parameters[parameter].name;
                Text::atom(self.scope.generic(&parameter.to_uppercase()))
            }
            _ => self.text(id),
        }
    }

    /// Returns two operands, at least one of them with its type.
    fn operands(&self, a: Id, b: Id) -> (Text, Text) {
        let plain = |id: Id| {
            let node = self.module.nodes[id].0;
            self.names.get(id).is_none() && matches!(node, Node::Constant(_) | Node::Parameter(_))
        };
        match (plain(a), plain(b)) {
            (true, true) => (self.text(a), self.operand(b)),
            _ => (self.operand(a), self.operand(b)),
        }
    }

    fn not(&self, a: Id) -> Text {
        if self.names.get(a).is_none() {
            match self.module.nodes[a].0 {
                Node::Not(a) => return self.text(a),
                Node::Binary(Operator::Equal, a, b) => return self.relation("?/=", a, b),
                Node::Binary(Operator::Below, a, b) => return self.relation("?>=", a, b),
                _ => {}
            }
        }
        let text = self.text(a).within(Rank::Atom);
        Text(format!("not {text}"), Rank::Unary)
    }

    fn relation(&self, sign: &str, a: Id, b: Id) -> Text {
        let (left, mut right) = self.operands(a, b);
        if let (None, Node::Constant(bits)) = (self.names.get(b), self.module.nodes[b].0)
            && let Some(state) = self.state(self.shown_by(a), bits)
        {
            right = Text::atom(state);
        }
        let [left, right] = [left, right].map(|text| text.within(Rank::Sign));
        Text(format!("{left} {sign} {right}"), Rank::Relation)
    }

    /// Returns the own signal whose value a node is.
    fn shown_by(&self, id: Id) -> Option<usize> {
        match self.module.nodes[id].0 {
            Node::Signal(signal) => Some(signal),
            _ => {
                let signals = self.module.signals.iter();
                signals.clone().position(|signal| {
                    let net = signal.role == Role::Net && signal.driver == Some(id);
                    net && self.names.is_net(id, signal)
                })
            }
        }
    }

    /// Returns the name of a state.
    pub(super) fn state(&self, signal: Option<usize>, bits: u64) -> Option<String> {
        let index = signal?;
        let signal: &Signal = &self.module.signals[index];
        let own = signal.owner.is_none() && matches!(signal.field.format, Format::States(_));
        let state = own.then(|| self.scope.state(signal, bits)).flatten()?;
        self.states.borrow_mut().insert(index);
        Some(state)
    }

    fn binary(&self, operator: Operator, id: Id, a: Id, b: Id) -> Text {
        let sum = |sign: &str| {
            let (left, right) = self.operands(a, b);
            let (left, right) = (left.within(Rank::Sum), right.within(Rank::Product));
            Text(format!("{left} {sign} {right}"), Rank::Sum)
        };
        match operator {
            Operator::Add => sum("+"),
            Operator::Subtract => sum("-"),
            Operator::Multiply => self.product(a, b, self.shape(id)),
            Operator::And => self.logical("and", operator, a, b),
            Operator::Or => self.logical("or", operator, a, b),
            Operator::Xor => self.logical("xor", operator, a, b),
            Operator::Equal => self.relation("?=", a, b),
            Operator::Below => self.relation("?<", a, b),
        }
    }

    fn logical(&self, word: &str, operator: Operator, a: Id, b: Id) -> Text {
        let [a, b] = [a, b].map(|id| self.text(id).term(operator));
        Text(format!("{a} {word} {b}"), Rank::Logical(operator))
    }
}
