//! Records of signals, for any view of a signal.

use super::memory::{Contents, Written};
use super::view::View;
use crate::hdl::{Field, Kind, Role, Shape};
use std::sync::Arc;

/// A struct of signals that belong to a `C`, as a [`View`] sees them: made by
/// [`signals!`](crate::hdl::signals).
///
/// A walk goes through the leaves in the order of declaration and never branches on a value, so the
/// place of a leaf in the walk is its identity. Widths are those that the `C` says.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no record of signals of `{C}`",
    note = "records are declared by `signals! {{ for {C} as c; pub struct In {{ … }} }}`; where there \
            are no signals stands `Nothing`"
)]
pub trait Record<C: ?Sized, V: View>: Walk<V> {
    /// Makes one with each leaf given by `source`.
    fn make(of: &C, field: &'static Field, source: &mut dyn Source) -> Self;
}

/// A record that can be walked over, whatever it belongs to.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no record of signals",
    note = "records are declared by `signals!`; where there are no signals stands `Nothing`"
)]
pub trait Walk<V: View>: Sized + 'static {
    /// Where it is declared.
    const SITE: Site;
    /// Shows each leaf to `sink`.
    fn visit(&self, field: &'static Field, sink: &mut dyn Sink);
    /// Adds what it would show of its words.
    fn words(&self, words: &mut Vec<u64>);
}

/// A place in a source file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Site {
    /// The file.
    pub file: &'static str,
    /// The line, from 1.
    pub line: u32,
    /// The column, from 1.
    pub column: u32,
}

/// Which leaves a walk over parts is for: registers come before nets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pass {
    /// Registers and memories.
    Registers,
    /// Nets, and ports in of parts.
    Nets,
}

/// The words of a memory, for a view.
#[derive(Debug, Clone)]
pub struct Cells {
    /// The memory, or the leaf that is its first word.
    pub first: usize,
    /// The number of words.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// What they are.
    pub contents: Arc<[u64]>,
}

impl Cells {
    /// Those of a memory of that shape from there on, without what they are.
    pub fn at(first: usize, shape: MemoryShape) -> Self {
        Cells {
            first,
            words: shape.words,
            width: shape.width,
            contents: Arc::new([]),
        }
    }
}

/// Numbers the leaves of a circuit as walks over its records come to them: ports in, registers and
/// nets each from their first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Places {
    /// The next of each.
    pub next: [usize; 3],
    /// Which of them leaves to come are of.
    pub role: Role,
}

impl Places {
    /// The first of so many leaves that come now.
    #[inline]
    pub fn take(&mut self, leaves: usize) -> usize {
        let next = &mut self.next[self.role as usize];
        *next += leaves;
        *next - leaves
    }

    /// Leaves to come are of this pass.
    #[inline]
    pub fn pass(&mut self, pass: Pass) {
        self.role = match pass {
            Pass::Registers => Role::Register,
            Pass::Nets => Role::Net,
        };
    }

    /// The pass.
    #[inline]
    pub fn passing(&self) -> Pass {
        match self.role {
            Role::Net => Pass::Nets,
            Role::Input | Role::Register => Pass::Registers,
        }
    }
}

/// Where the leaves of a record come from.
pub trait Source {
    /// A struct begins.
    fn enter(&mut self, _field: &'static Field) {}
    /// The struct entered last ends.
    fn leave(&mut self) {}
    /// What comes next is element `index` of an array.
    fn element(&mut self, _index: usize) {}
    /// Leaves to come are of this pass.
    fn pass(&mut self, _pass: Pass) {}
    /// The pass.
    fn passing(&self) -> Pass {
        Pass::Registers
    }
    /// A word; `power_on` is what a register holds then, before it is cut to the word.
    fn word(&mut self, field: &'static Field, shape: Shape, power_on: i128) -> u64;
    /// A memory of so many words, each of which is called `label`; unless overridden, nobody looks at
    /// its words.
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

/// Words and width of a memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MemoryShape {
    /// The number of words; for a RAM 2^address.
    pub words: usize,
    /// Width of a word in bits.
    pub width: usize,
    /// Width of the address of a RAM.
    pub address: Option<usize>,
}

/// What looks at the leaves of a record.
pub trait Sink {
    /// A struct begins.
    fn enter(&mut self, _field: &'static Field) {}
    /// The struct entered last ends.
    fn leave(&mut self) {}
    /// What comes next is element `index` of an array.
    fn element(&mut self, _index: usize) {}
    /// A word.
    fn word(&mut self, field: &'static Field, token: u64);
    /// A memory.
    fn memory(&mut self, _field: &'static Field, _written: Written) {}
}

/// No signals at all.
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

/// One wire.
pub const BIT: Shape = Shape {
    kind: Kind::Bit,
    width: 1,
};

/// An unsigned word.
pub const fn unsigned(width: usize) -> Shape {
    Shape {
        kind: Kind::Unsigned,
        width,
    }
}

/// A two's complement word.
pub const fn signed(width: usize) -> Shape {
    Shape {
        kind: Kind::Signed,
        width,
    }
}
