//! Parts, extensions and signs of words, and constants.

use super::expression::{Expressions, Rank, Text};
use crate::netlist::{Id, Kind, Node, Shape};

impl Expressions<'_> {
    /// The bits of a word from `low` up.
    pub(super) fn slice(&self, of: Id, low: usize, shape: Shape) -> Text {
        let text = match self.names.get(of) {
            Some(name) => {
                self.mark(name, mask(shape.width) << low);
                Text::atom(match (self.shape(of).width, shape.width) {
                    (1, _) => name.to_owned(),
                    (_, 1) => format!("{name}[{low}]"),
                    (_, width) => format!("{name}[{}:{low}]", low + width - 1),
                })
            }
            None => self.narrow(of, shape.width),
        };
        // A part of a word is unsigned; an expression computed in this width keeps its kind.
        match (shape.kind, self.names.get(of)) {
            (Kind::Signed, Some(_)) => Text::atom(format!("$signed({})", text.0)),
            (Kind::Signed, None) => text,
            (_, None) if self.shape(of).kind == Kind::Signed => {
                Text::atom(format!("$unsigned({})", text.0))
            }
            _ => text,
        }
    }

    /// Returns the low bits of a node without a name by computing it in fewer bits.
    fn narrow(&self, id: Id, width: usize) -> Text {
        let (node, shape) = self.module.nodes[id];
        let small = Shape { width, ..shape };
        let part = |id: Id| match self.names.get(id) {
            Some(_) => self.slice(
                id,
                0,
                Shape {
                    width,
                    ..self.shape(id)
                },
            ),
            None => self.narrow(id, width),
        };
        match node {
            Node::Constant(bits) => constant(bits & mask(width), small),
            Node::Binary(operator, a, b) => {
                let (sign, rank) = self.sign(operator, id);
                let [a, b] = [part(a), part(b)].map(|text| text.within(Rank::Unary));
                Text(format!("{a} {sign} {b}"), rank)
            }
            Node::Mux(choose, then, other) => {
                let choose = self.text(choose).within(Rank::Either);
                let [then, other] = [part(then), part(other)].map(|text| text.within(Rank::Either));
                Text(format!("{choose} ? {then} : {other}"), Rank::Choice)
            }
            Node::Not(a) => Text(format!("~{}", part(a).within(Rank::Atom)), Rank::Unary),
            Node::Negate(a) => Text(format!("-{}", part(a).within(Rank::Atom)), Rank::Unary),
            Node::Cast(a) => wrap(part(a), self.shape(a).kind, shape.kind),
            _ => self.text(id),
        }
    }

    pub(super) fn extend(&self, a: Id, shape: Shape) -> Text {
        let from = self.shape(a);
        let more = shape.width - from.width;
        let word = self.text(a).0;
        match from.kind {
            Kind::Signed => {
                let sign = match from.width {
                    1 => word.clone(),
                    width => format!("{word}[{}]", width - 1),
                };
                Text::atom(format!("$signed({{{{{more}{{{sign}}}}}, {word}}})"))
            }
            _ => Text::atom(format!("{{{more}'d0, {word}}}")),
        }
    }

    pub(super) fn cast(&self, a: Id, kind: Kind) -> Text {
        wrap(self.text(a), self.shape(a).kind, kind)
    }
}

/// Casts an expression to signed or unsigned without changing its bits.
pub(super) fn wrap(text: Text, from: Kind, to: Kind) -> Text {
    match (from == Kind::Signed, to == Kind::Signed) {
        (false, true) => Text::atom(format!("$signed({})", text.0)),
        (true, false) => Text::atom(format!("$unsigned({})", text.0)),
        _ => text,
    }
}

pub(super) fn mask(width: usize) -> u64 {
    u64::MAX >> (64 - width.clamp(1, 64))
}

/// A constant with its width.
pub(super) fn literal(bits: u64, shape: Shape) -> String {
    constant(bits, shape).0
}

pub(super) fn constant(bits: u64, shape: Shape) -> Text {
    let Shape { kind, width } = shape;
    match kind {
        Kind::Bit | Kind::Unsigned if width == 1 => Text::atom(format!("1'b{bits}")),
        Kind::Bit | Kind::Unsigned => Text::atom(format!("{width}'d{bits}")),
        Kind::Signed if bits >> (width - 1) & 1 == 0 => Text::atom(format!("{width}'sd{bits}")),
        Kind::Signed => {
            let value = bits.wrapping_neg() & mask(width);
            match value == bits {
                // The least value has no positive counterpart in this width.
                true => Text::atom(format!("{width}'sh{bits:x}")),
                false => Text(format!("-{width}'sd{value}"), Rank::Unary),
            }
        }
    }
}
