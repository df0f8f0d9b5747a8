//! Views: the types of a record's signals.

use super::Circuit;
use super::build;
use super::memory::{Ram, Shift, Words, Written};
use super::part::{Opened, Part};
use super::place::{At, MemoryAt, Signals};
use super::record::{Cells, Pass, Record, Source};
use super::values::{Registers, Values};
use super::words::{Bit, I, U};
use crate::netlist::{Field, Role, Shape};
use std::fmt::Debug;
use std::sync::Arc;

/// View of a record's signals: [`Wire`] while a circuit is elaborated, [`Value`] while it runs,
/// [`Place`] for watched signals.
///
/// Walks over records pass tokens on: the number of a node, a value, the number of a leaf. A view
/// converts between tokens and its types.
pub trait View: Copy + Debug + 'static {
    /// One wire.
    type Bit: Copy + Debug;
    /// An unsigned word.
    type U: Copy + Debug;
    /// A two's complement word.
    type I: Copy + Debug;
    /// A memory.
    type Ram: Debug;
    /// A shift register.
    type Shift: Debug;
    /// A circuit inside another.
    type Part<C: Circuit>;

    /// Converts a token to a wire.
    fn bit(token: u64) -> Self::Bit;
    /// Converts a token to an unsigned word of `width` bits.
    fn u(token: u64, width: usize) -> Self::U;
    /// Converts a token to a two's complement word.
    fn i(token: u64, width: usize) -> Self::I;
    /// Makes a memory of these cells.
    fn ram(cells: Cells) -> Self::Ram;
    /// Makes a shift register of these cells.
    fn shift(cells: Cells) -> Self::Shift;
    /// Makes a circuit inside another.
    fn part<C: Circuit>(
        circuit: &C,
        field: &'static Field,
        source: &mut dyn Source,
    ) -> Self::Part<C>;

    /// Returns the token of a wire.
    fn of_bit(bit: Self::Bit) -> u64;
    /// Returns the token of an unsigned word.
    fn of_u(word: Self::U) -> u64;
    /// Returns the token of a two's complement word.
    fn of_i(word: Self::I) -> u64;
    /// Returns the effect of an edge on a memory.
    fn of_ram(_: &Self::Ram) -> Written {
        Written::default()
    }
    /// Returns the effect of an edge on a shift register.
    fn of_shift(_: &Self::Shift) -> Written {
        Written::default()
    }
}

/// View in which input ports are driven: [`Wire`] inside a circuit, [`Value`] while it runs.
pub trait Driven: View {
    /// Returns the token of a word whose bits are low.
    fn low(shape: Shape) -> u64;
}

impl Driven for Wire {
    fn low(shape: Shape) -> u64 {
        build::constant(0, build::nearest(shape)) as u64
    }
}

impl Driven for Value {
    fn low(_: Shape) -> u64 {
        0
    }
}

/// Returns the field of one part of a circuit, whose signals are in the circuit's own scope.
pub(crate) fn role(role: Role) -> &'static Field {
    match role {
        Role::Input => const { &Field::part(Role::Input) },
        Role::Register => const { &Field::part(Role::Register) },
        Role::Net => const { &Field::part(Role::Net) },
    }
}

/// View during elaboration.
#[derive(Debug, Clone, Copy)]
pub struct Wire;

/// View of registers after the edge: as [`Wire`], but a written memory cannot be read.
#[derive(Debug, Clone, Copy)]
pub struct Edge;

/// View of a part's registers from the surrounding circuit: memories are hidden.
#[derive(Debug, Clone, Copy)]
pub struct Seen;

/// View in [properties](super::Moment): memories are words to read, parts show all their signals.
#[derive(Debug, Clone, Copy)]
pub struct Open;

/// View as numbers.
#[derive(Debug, Clone, Copy)]
pub struct Value;

/// View of registers as numbers, without nets, of a tick that is not settled.
#[derive(Debug, Clone, Copy)]
pub struct Kept;

/// View as places to read from.
#[derive(Debug, Clone, Copy)]
pub struct Place;

/// View without values: names and widths only.
#[derive(Debug, Clone, Copy)]
pub struct Shapes;

/// Defines the types of a netlist view.
macro_rules! words {
    () => {
        type Bit = Bit;
        type U = U;
        type I = I;

        fn bit(token: u64) -> Bit {
            Bit(token as usize)
        }
        fn u(token: u64, _: usize) -> U {
            U(token as usize)
        }
        fn i(token: u64, _: usize) -> I {
            I(token as usize)
        }
        fn of_bit(bit: Bit) -> u64 {
            bit.0 as u64
        }
        fn of_u(word: U) -> u64 {
            word.0 as u64
        }
        fn of_i(word: I) -> u64 {
            word.0 as u64
        }
    };
}

impl View for Wire {
    words!();
    type Ram = Ram;
    type Shift = Shift;
    type Part<C: Circuit> = Part<C>;

    fn ram(cells: Cells) -> Ram {
        Ram(cells.first)
    }
    fn shift(cells: Cells) -> Shift {
        Shift {
            memory: cells.first,
            stages: cells.words,
        }
    }
    fn part<C: Circuit>(circuit: &C, field: &'static Field, source: &mut dyn Source) -> Part<C> {
        Part::declare(circuit, field, source)
    }
}

impl View for Edge {
    words!();
    type Ram = Written;
    type Shift = Written;
    type Part<C: Circuit> = ();

    fn ram(_: Cells) -> Written {
        Written::default()
    }
    fn shift(_: Cells) -> Written {
        Written::default()
    }
    fn part<C: Circuit>(_: &C, _: &'static Field, _: &mut dyn Source) {}
    fn of_ram(written: &Written) -> Written {
        *written
    }
    fn of_shift(written: &Written) -> Written {
        *written
    }
}

impl View for Seen {
    words!();
    type Ram = ();
    type Shift = ();
    type Part<C: Circuit> = ();

    fn ram(_: Cells) {}
    fn shift(_: Cells) {}
    fn part<C: Circuit>(_: &C, _: &'static Field, _: &mut dyn Source) {}
}

impl View for Open {
    words!();
    type Ram = Words;
    type Shift = Words;
    type Part<C: Circuit> = Opened<C>;

    fn ram(cells: Cells) -> Words {
        Words::of(&cells)
    }
    fn shift(cells: Cells) -> Words {
        Words::of(&cells)
    }
    fn part<C: Circuit>(circuit: &C, field: &'static Field, source: &mut dyn Source) -> Opened<C> {
        source.enter(field);
        source.pass(Pass::Nets);
        let i = C::In::make(circuit, role(Role::Input), source);
        let (q, p) = open(circuit, source);
        let w = C::Net::make(circuit, role(Role::Net), source);
        source.leave();
        Opened { i, q, w, p }
    }
}

/// Makes the registers and the parts of a circuit in its properties; the nets come next.
pub(super) fn open<C: Circuit>(
    circuit: &C,
    source: &mut dyn Source,
) -> (C::Reg<Open>, C::Parts<Open>) {
    source.pass(Pass::Registers);
    let q = C::Reg::make(circuit, role(Role::Register), source);
    let p = C::Parts::make(circuit, role(Role::Net), source);
    source.pass(Pass::Nets);
    (q, p)
}

/// Defines conversions between tokens and numbers.
macro_rules! numbers {
    () => {
        type Bit = bool;
        type U = u64;
        type I = i64;
        type Ram = Arc<[u64]>;
        type Shift = Arc<[u64]>;

        #[inline]
        fn bit(token: u64) -> bool {
            token != 0
        }
        #[inline]
        fn u(token: u64, _: usize) -> u64 {
            token
        }
        #[inline]
        fn i(token: u64, width: usize) -> i64 {
            let spare = 64 - width as u32;
            (token << spare) as i64 >> spare
        }
        #[inline]
        fn ram(cells: Cells) -> Arc<[u64]> {
            cells.contents
        }
        #[inline]
        fn shift(cells: Cells) -> Arc<[u64]> {
            cells.contents
        }
        #[inline]
        fn of_bit(bit: bool) -> u64 {
            bit.into()
        }
        #[inline]
        fn of_u(word: u64) -> u64 {
            word
        }
        #[inline]
        fn of_i(word: i64) -> u64 {
            word as u64
        }
    };
}

impl View for Value {
    numbers!();
    type Part<C: Circuit> = Values<C>;

    fn part<C: Circuit>(circuit: &C, field: &'static Field, source: &mut dyn Source) -> Values<C> {
        let (i, (q, p, w)) = whole(circuit, field, source);
        Values { i, q, w, p }
    }
}

impl View for Kept {
    numbers!();
    type Part<C: Circuit> = Registers<C>;

    fn part<C: Circuit>(
        circuit: &C,
        field: &'static Field,
        source: &mut dyn Source,
    ) -> Registers<C> {
        source.enter(field);
        let q = C::Reg::make(circuit, role(Role::Register), source);
        let p = C::Parts::make(circuit, role(Role::Register), source);
        source.leave();
        Registers { q, p }
    }
}

impl View for Place {
    type Bit = At<bool>;
    type U = At<u64>;
    type I = At<i64>;
    type Ram = MemoryAt;
    type Shift = MemoryAt;
    type Part<C: Circuit> = Signals<C>;

    fn bit(token: u64) -> At<bool> {
        At::new(token as usize, 1)
    }
    fn u(token: u64, width: usize) -> At<u64> {
        At::new(token as usize, width)
    }
    fn i(token: u64, width: usize) -> At<i64> {
        At::new(token as usize, width)
    }
    fn ram(cells: Cells) -> MemoryAt {
        MemoryAt::new(cells.first, cells.words, cells.width)
    }
    fn shift(cells: Cells) -> MemoryAt {
        MemoryAt::new(cells.first, cells.words, cells.width)
    }
    fn part<C: Circuit>(circuit: &C, field: &'static Field, source: &mut dyn Source) -> Signals<C> {
        let (i, (q, p, w)) = whole(circuit, field, source);
        Signals { i, q, w, p }
    }
    fn of_bit(at: At<bool>) -> u64 {
        at.leaf() as u64
    }
    fn of_u(at: At<u64>) -> u64 {
        at.leaf() as u64
    }
    fn of_i(at: At<i64>) -> u64 {
        at.leaf() as u64
    }
}

impl View for Shapes {
    type Bit = ();
    type U = ();
    type I = ();
    type Ram = ();
    type Shift = ();
    type Part<C: Circuit> = ();

    fn bit(_: u64) {}
    fn u(_: u64, _: usize) {}
    fn i(_: u64, _: usize) {}
    fn ram(_: Cells) {}
    fn shift(_: Cells) {}
    /// Walks over the registers or the nets of a part, depending on the source's pass.
    fn part<C: Circuit>(circuit: &C, field: &'static Field, source: &mut dyn Source) {
        source.enter(field);
        match source.passing() {
            Pass::Registers => registers(circuit, source),
            Pass::Nets => {
                C::In::<Shapes>::make(circuit, role(Role::Input), source);
                nets(circuit, source);
            }
        }
        source.leave();
    }
    fn of_bit((): ()) -> u64 {
        0
    }
    fn of_u((): ()) -> u64 {
        0
    }
    fn of_i((): ()) -> u64 {
        0
    }
}

/// Registers, parts and nets of a circuit in a view.
type Inner<C, V> = (
    <C as Circuit>::Reg<V>,
    <C as Circuit>::Parts<V>,
    <C as Circuit>::Net<V>,
);

/// Makes all records of a circuit except its input ports.
pub(super) fn inner<C: Circuit, V: View>(circuit: &C, source: &mut dyn Source) -> Inner<C, V> {
    source.pass(Pass::Registers);
    let q = C::Reg::make(circuit, role(Role::Register), source);
    let p = C::Parts::make(circuit, role(Role::Net), source);
    source.pass(Pass::Nets);
    let w = C::Net::make(circuit, role(Role::Net), source);
    (q, p, w)
}

/// Makes all records of a part.
fn whole<C: Circuit, V: View>(
    circuit: &C,
    field: &'static Field,
    source: &mut dyn Source,
) -> (C::In<V>, Inner<C, V>) {
    source.enter(field);
    source.pass(Pass::Nets);
    let i = C::In::make(circuit, role(Role::Input), source);
    let inner = inner(circuit, source);
    source.leave();
    (i, inner)
}

/// Walks over the registers of a circuit: its own, then those of its parts.
pub(crate) fn registers<C: Circuit>(circuit: &C, source: &mut dyn Source) {
    // An impossible circuit has none; its elaboration reports why.
    if circuit.objection().is_some() {
        return;
    }
    source.pass(Pass::Registers);
    C::Reg::<Shapes>::make(circuit, role(Role::Register), source);
    C::Parts::<Shapes>::make(circuit, role(Role::Register), source);
}

/// Walks over the nets of a circuit: those of its parts with their input ports, then its own.
pub(crate) fn nets<C: Circuit>(circuit: &C, source: &mut dyn Source) {
    if circuit.objection().is_some() {
        return;
    }
    source.pass(Pass::Nets);
    C::Parts::<Shapes>::make(circuit, role(Role::Net), source);
    C::Net::<Shapes>::make(circuit, role(Role::Net), source);
}
