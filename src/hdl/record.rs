//! Records of signals, generic over the view of a signal.

use super::memory::{Contents, Written};
use super::view::{self, Driven, View};
use crate::netlist::{Field, Role, Shape, Site};
use std::marker::PhantomData;
use std::sync::Arc;

/// Struct of signals that belong to a `C`, as a [`View`] sees them; declared by
/// [`signals!`](super::signals).
///
/// A walk goes through the leaves in declaration order and never branches on a value, so the
/// position of a leaf in the walk identifies it. The `C` determines the widths.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no record of signals of `{C}`",
    note = "records are declared by `signals! {{ for {C} as c; pub struct In {{ … }} }}`; where there \
            are no signals stands `Nothing`"
)]
pub trait Record<C: ?Sized, V: View>: Walk<V> {
    /// Creates a record; `source` gives each leaf.
    fn make(of: &C, field: &'static Field, source: &mut dyn Source) -> Self;

    /// Creates a record with all words low, for the ports that a circuit leaves unused:
    /// `counter::In { enable, ..counter::In::low(&self.counter) }`.
    fn low(of: &C) -> Self
    where
        V: Driven,
    {
        Self::make(of, view::role(Role::Input), &mut Low::<V>(PhantomData))
    }
}

/// Source of low words in a view.
struct Low<V>(PhantomData<V>);

impl<V: Driven> Source for Low<V> {
    fn word(&mut self, _: &'static Field, shape: Shape, _: i128) -> u64 {
        V::low(shape)
    }
}

/// Record that can be walked over, whatever it belongs to.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no record of signals",
    note = "records are declared by `signals!`; where there are no signals stands `Nothing`"
)]
pub trait Walk<V: View>: Sized + 'static {
    /// Location of the declaration.
    const SITE: Site;
    /// Shows each leaf to `sink`.
    fn visit(&self, field: &'static Field, sink: &mut dyn Sink);
    /// Appends the tokens of its words, in the order of [`visit`](Self::visit).
    fn words(&self, words: &mut Vec<u64>);
}

/// Pass of a walk over parts: registers come before nets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pass {
    /// Registers and memories.
    Registers,
    /// Nets, and input ports of parts.
    Nets,
}

/// Words of a memory, for a view.
#[derive(Debug, Clone)]
pub struct Cells {
    /// Index of the memory, or of the leaf that is its first word.
    pub first: usize,
    /// Number of words.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// Values of the words.
    pub contents: Arc<[u64]>,
    /// True in a property over an edge, for the words before it.
    pub past: bool,
}

impl Cells {
    /// Returns the words of a memory of that shape from `first` on, without values.
    pub fn at(first: usize, shape: MemoryShape) -> Self {
        Cells {
            first,
            words: shape.words,
            width: shape.width,
            contents: Arc::new([]),
            past: false,
        }
    }
}

/// Numbers the leaves of a circuit in the order in which walks over its records reach them: input
/// ports, registers and nets each count from their own first leaf.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Places {
    /// Next leaf of each role.
    pub next: [usize; 3],
    /// Role of the leaves to come.
    pub role: Role,
}

impl Places {
    /// Returns the first of the next `leaves` leaves, and passes over them.
    #[inline]
    pub fn take(&mut self, leaves: usize) -> usize {
        let next = &mut self.next[self.role as usize];
        *next += leaves;
        *next - leaves
    }

    /// Sets the pass of the leaves to come.
    #[inline]
    pub fn pass(&mut self, pass: Pass) {
        self.role = match pass {
            Pass::Registers => Role::Register,
            Pass::Nets => Role::Net,
        };
    }

    /// Returns the current pass.
    #[inline]
    pub fn passing(&self) -> Pass {
        match self.role {
            Role::Net => Pass::Nets,
            Role::Input | Role::Register => Pass::Registers,
        }
    }
}

/// Source of the leaves of a record.
pub trait Source {
    /// Enters a struct.
    fn enter(&mut self, _field: &'static Field) {}
    /// Leaves the struct entered last.
    fn leave(&mut self) {}
    /// Marks the next leaf or struct as element `index` of an array.
    fn element(&mut self, _index: usize) {}
    /// Sets the number of fraction bits of the next word, which are 0 otherwise.
    fn fraction(&mut self, _bits: usize) {}
    /// Sets the pass of the leaves to come.
    fn pass(&mut self, _pass: Pass) {}
    /// Returns the current pass.
    fn passing(&self) -> Pass {
        Pass::Registers
    }
    /// Returns the token of a word; `power_on` is a register's power-on value, before it is cut to
    /// the word.
    fn word(&mut self, field: &'static Field, shape: Shape, power_on: i128) -> u64;
    /// Returns the cells of a memory of `shape.words` words, each named after `label`. By default
    /// the words are ignored.
    fn memory(
        &mut self,
        _field: &'static Field,
        _label: &'static Field,
        shape: MemoryShape,
        _contents: &dyn Fn() -> Contents,
    ) -> Cells {
        Cells::at(0, shape)
    }
}

/// Number of words and width of a memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryShape {
    /// Number of words; 2^address for a RAM.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// Width of the address of a RAM in bits.
    pub address: Option<usize>,
}

/// Receiver of the leaves of a record.
pub trait Sink {
    /// Enters a struct.
    fn enter(&mut self, _field: &'static Field) {}
    /// Leaves the struct entered last.
    fn leave(&mut self) {}
    /// Marks the next leaf or struct as element `index` of an array.
    fn element(&mut self, _index: usize) {}
    /// Receives a word.
    fn word(&mut self, field: &'static Field, token: u64);
    /// Receives a memory.
    fn memory(&mut self, _field: &'static Field, _written: Written) {}
}

/// Empty record.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Nothing;

impl<C: ?Sized, V: View> Record<C, V> for Nothing {
    fn make(_: &C, _: &'static Field, _: &mut dyn Source) -> Self {
        Nothing
    }
}

impl<V: View> Walk<V> for Nothing {
    const SITE: Site = Site {
        file: file!(),
        line: line!(),
        column: column!(),
    };
    fn visit(&self, _: &'static Field, _: &mut dyn Sink) {}
    fn words(&self, _: &mut Vec<u64>) {}
}
