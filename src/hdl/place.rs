//! Places: handles to signals that are read.

use super::Circuit;
use super::memory::Contents;
use super::pack;
use super::record::{Cells, MemoryShape, Pass, Places, Source};
use super::view::Place;
use crate::netlist::{Field, Role, Shape};
use std::fmt;
use std::marker::PhantomData;

/// Handle to a signal whose value is read as a `bool`, `u64` or `i64`.
pub struct At<T> {
    leaf: u32,
    /// Number of bits of 64 above the signal.
    spare: u32,
    number: PhantomData<fn() -> T>,
}

impl<T> At<T> {
    pub(super) fn new(leaf: usize, width: usize) -> Self {
        At {
            leaf: leaf as u32,
            spare: 64 - width as u32,
            number: PhantomData,
        }
    }

    /// Returns the index of the leaf.
    pub fn leaf(self) -> usize {
        self.leaf as usize
    }

    /// Returns the width of the signal in bits.
    pub fn width(self) -> usize {
        64 - self.spare as usize
    }
}

impl<T: Number> At<T> {
    /// Converts the word of the leaf to a number.
    #[inline]
    pub(crate) fn number(self, word: u64) -> T {
        T::of(word, self.spare)
    }
}

// Written by hand: a derive would require `T: Copy`.
impl<T> Clone for At<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for At<T> {}

impl<T> PartialEq for At<T> {
    fn eq(&self, other: &Self) -> bool {
        self.leaf == other.leaf
    }
}

impl<T> fmt::Debug for At<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "At({})", self.leaf)
    }
}

/// Number type in which a signal is read.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no number that a signal has",
    note = "a `Bit` is seen as `bool`, a `U` as `u64`, an `I` as `i64`"
)]
pub trait Number: Copy {
    /// Converts a word, given the number of bits above it.
    fn of(word: u64, spare: u32) -> Self;
    /// Converts to a word.
    fn word(self) -> u64;
}

impl Number for bool {
    #[inline]
    fn of(word: u64, _: u32) -> bool {
        word != 0
    }
    #[inline]
    fn word(self) -> u64 {
        self.into()
    }
}

impl Number for u64 {
    #[inline]
    fn of(word: u64, _: u32) -> u64 {
        word
    }
    #[inline]
    fn word(self) -> u64 {
        self
    }
}

impl Number for i64 {
    #[inline]
    fn of(word: u64, spare: u32) -> i64 {
        (word << spare) as i64 >> spare
    }
    #[inline]
    fn word(self) -> u64 {
        self as u64
    }
}

/// Handle to the words of a memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryAt {
    first: usize,
    words: usize,
    width: usize,
}

impl MemoryAt {
    pub(super) fn new(first: usize, words: usize, width: usize) -> Self {
        MemoryAt {
            first,
            words,
            width,
        }
    }

    /// Returns the number of words.
    pub fn words(self) -> usize {
        self.words
    }

    /// Returns the place of a word; `None` if there is no such word.
    pub fn word(self, index: usize) -> Option<At<u64>> {
        (index < self.words).then(|| At::new(self.first + index, self.width))
    }
}

/// Places of all signals of a circuit, including those of the circuits inside it.
pub struct Signals<C: Circuit> {
    /// Input ports.
    pub i: C::In<Place>,
    /// Registers.
    pub q: C::Reg<Place>,
    /// Nets.
    pub w: C::Net<Place>,
    /// Circuits inside.
    pub p: C::Parts<Place>,
}

impl<C: Circuit> fmt::Debug for Signals<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct(C::NAME).finish_non_exhaustive()
    }
}

impl<C: Circuit> Signals<C> {
    /// Returns the places of a circuit with `beside` further input ports after its own.
    pub(crate) fn of(circuit: &C, beside: usize) -> Self {
        let ports = pack::input_widths(circuit).len() + beside;
        let nets = ports + pack::register_widths(circuit).len();
        let mut leaves = Leaves(Places {
            next: [0, ports, nets],
            role: Role::Input,
        });
        circuit.make_places(&mut leaves)
    }
}

/// Source that numbers the leaves.
struct Leaves(Places);

impl Source for Leaves {
    fn pass(&mut self, pass: Pass) {
        self.0.pass(pass);
    }
    fn passing(&self) -> Pass {
        self.0.passing()
    }
    fn word(&mut self, _: &'static Field, _: Shape, _: i128) -> u64 {
        self.0.take(1) as u64
    }
    fn memory(
        &mut self,
        _: &'static Field,
        _: &'static Field,
        shape: MemoryShape,
        _: &dyn Fn() -> Contents,
    ) -> Cells {
        Cells::at(self.0.take(shape.words), shape)
    }
}
