//! Conversion of records of numbers into words, and back.

use super::memory::Contents;
use super::record::{Cells, MemoryShape, Pass, Record, Source, Walk};
use super::view::{self, Shapes, Value, View};
use super::{Circuit, Registers};
use crate::netlist::{Field, Role, Shape};
use std::sync::Arc;

/// Widths of the leaves of a walk, including words of memories.
#[derive(Default)]
struct Widths {
    widths: Vec<usize>,
    pass: Option<Pass>,
}

impl Source for Widths {
    fn pass(&mut self, pass: Pass) {
        self.pass = Some(pass);
    }
    fn passing(&self) -> Pass {
        self.pass.unwrap_or(Pass::Registers)
    }
    fn word(&mut self, _: &'static Field, shape: Shape, _: i128) -> u64 {
        self.widths.push(shape.width);
        0
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        _: &dyn Fn() -> Contents,
    ) -> Cells {
        self.widths
            .extend(std::iter::repeat_n(shape.width, shape.words));
        Cells::at(0, shape)
    }
}

/// Returns the widths of the words of a record.
pub(crate) fn widths<O: ?Sized, R: Record<O, Shapes>>(of: &O) -> Vec<usize> {
    let mut widths = Widths::default();
    R::make(of, view::role(Role::Input), &mut widths);
    widths.widths
}

/// Returns the widths of the input ports of a circuit.
pub(crate) fn input_widths<C: Circuit>(circuit: &C) -> Vec<usize> {
    widths_of(circuit, Role::Input)
}

/// Returns the widths of all registers of a circuit and of those inside it.
pub(crate) fn register_widths<C: Circuit>(circuit: &C) -> Vec<usize> {
    widths_of(circuit, Role::Register)
}

fn widths_of<C: Circuit>(circuit: &C, role: Role) -> Vec<usize> {
    let mut widths = Widths::default();
    circuit.make_shapes(role, &mut widths);
    widths.widths
}

/// Returns the words of a record, each cut to its width.
pub(crate) fn words<R: Walk<Value>>(record: &R, widths: &[usize]) -> Vec<u64> {
    let mut words = tokens(record);
    for (word, width) in words.iter_mut().zip(widths) {
        *word &= u64::MAX >> (64 - width);
    }
    words
}

/// Returns the tokens of a record's words.
pub(crate) fn tokens<V: View, R: Walk<V>>(record: &R) -> Vec<u64> {
    let mut tokens = Vec::new();
    record.words(&mut tokens);
    tokens
}

/// Returns input ports from words that `word` gives in order, each cut to its width.
pub fn inputs<C: Circuit>(circuit: &C, word: impl FnMut(Shape) -> u64) -> C::In<Value> {
    circuit.make_inputs(&mut Given(word))
}

/// Source whose leaves are given in order.
struct Given<F>(F);

impl<F: FnMut(Shape) -> u64> Source for Given<F> {
    fn word(&mut self, _: &'static Field, shape: Shape, _: i128) -> u64 {
        (self.0)(shape) & u64::MAX >> (64 - shape.width)
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        _: &dyn Fn() -> Contents,
    ) -> Cells {
        let word = Shape {
            kind: crate::netlist::Kind::Unsigned,
            width: shape.width,
        };
        let contents = (0..shape.words).map(|_| (self.0)(word) & u64::MAX >> (64 - word.width));
        Cells {
            contents: contents.collect::<Arc<[u64]>>(),
            ..Cells::at(0, shape)
        }
    }
}

/// Splits a word into leaves, from its lowest bits on.
pub(crate) fn bits_of(mut word: u64) -> impl FnMut(Shape) -> u64 {
    move |shape| {
        let leaf = word;
        // A leaf of 64 bits is the only one; nothing comes after it.
        word = leaf.checked_shr(shape.width as u32).unwrap_or(0);
        leaf
    }
}

/// Concatenates words, the first in the lowest bits.
pub(crate) fn joined(words: &[u64], widths: &[usize]) -> u64 {
    let mut filled = 0;
    let mut joined = 0;
    for (word, width) in words.iter().zip(widths) {
        joined |= word.checked_shl(filled).unwrap_or(0);
        filled += *width as u32;
    }
    joined
}

/// Returns all registers of a circuit from one word.
pub(crate) fn registers_of<C: Circuit>(circuit: &C, word: u64) -> Registers<C> {
    circuit.make_kept(&mut Given(bits_of(word)))
}
