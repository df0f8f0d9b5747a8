use crate::logic::Logic;
use std::borrow::Cow;
use std::fmt::Debug;
use std::marker::PhantomData;

/// How a signal is meant to be looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// A number.
    Decimal,
    /// A bit pattern or an address.
    Hex,
    /// A number whose course over time matters: drawn as an analog trace.
    Analog,
    /// A state: the value is an index into these names.
    States(&'static [&'static str]),
    /// On an array: the names of its elements, instead of the array's name and an index.
    Elements(&'static [&'static str]),
}

/// Which part of a circuit a signal stands in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Role {
    /// A port in.
    Input,
    /// A flip-flop.
    Register,
    /// A combinational net.
    Net,
}

/// What is known of a field of a `signals!` struct without looking at its value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field {
    /// Its name; empty where a struct stands for a part of a circuit and adds no scope.
    pub name: &'static str,
    /// Its doc comment.
    pub doc: &'static str,
    /// How it is meant to be looked at.
    pub format: Format,
    /// Whether it is visible outside its module: a port out, where it is a register or a net.
    pub public: bool,
    /// Power-on value of a register.
    pub power_on: i128,
    /// The part of a circuit that starts here, if one does.
    pub role: Option<Role>,
}

impl Field {
    /// A field with a name and nothing else said of it.
    pub const fn named(name: &'static str) -> Field {
        Field {
            name,
            doc: "",
            format: Format::Decimal,
            public: false,
            power_on: 0,
            role: None,
        }
    }

    /// The struct of one part of a circuit: its fields stand in the circuit's own scope.
    pub const fn part(role: Role) -> Field {
        Field {
            role: Some(role),
            ..Field::named("")
        }
    }

    /// The name of element `index` where this field is an array.
    pub fn element(&self, index: usize) -> Cow<'static, str> {
        match self.format {
            Format::Elements(names) if index < names.len() => Cow::Borrowed(names[index]),
            _ => Cow::Owned(format!("{}{index}", self.name)),
        }
    }
}

/// A bundle of signals that can be walked: a word, a memory, an array of bundles, or a struct
/// made by [`signals!`](crate::signals).
///
/// A walk goes through the leaves in the order of declaration and never branches on a value, so
/// the place of a leaf in the walk is its identity.
pub trait Signals<L: Logic>: Sized + Clone + Debug + 'static {
    /// Shows each leaf to `visitor`.
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V);
    /// Makes a bundle with each leaf given by `maker`.
    fn make<M: Make<L>>(field: &'static Field, maker: &mut M) -> Self;
}

/// The reading half of a walk.
pub trait Visit<L: Logic> {
    /// A struct begins.
    fn enter(&mut self, field: &'static Field);
    /// The struct entered last ends.
    fn leave(&mut self);
    /// What comes next is element `index` of an array.
    fn element(&mut self, index: usize);
    /// One wire.
    fn bit(&mut self, field: &'static Field, value: L::Bit);
    /// An unsigned word.
    fn unsigned<const N: usize>(&mut self, field: &'static Field, value: L::U<N>);
    /// A two's complement word.
    fn signed<const N: usize>(&mut self, field: &'static Field, value: L::I<N>);
    /// A memory.
    fn ram<const A: usize, const D: usize>(&mut self, field: &'static Field, ram: &L::Ram<A, D>);
    /// A shift register.
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        field: &'static Field,
        register: &L::ShiftRegister<K, D>,
    );
}

/// The writing half of a walk.
pub trait Make<L: Logic> {
    /// A struct begins.
    fn enter(&mut self, field: &'static Field);
    /// The struct entered last ends.
    fn leave(&mut self);
    /// What comes next is element `index` of an array.
    fn element(&mut self, index: usize);
    /// One wire.
    fn bit(&mut self, field: &'static Field) -> L::Bit;
    /// An unsigned word.
    fn unsigned<const N: usize>(&mut self, field: &'static Field) -> L::U<N>;
    /// A two's complement word.
    fn signed<const N: usize>(&mut self, field: &'static Field) -> L::I<N>;
    /// A memory.
    fn ram<const A: usize, const D: usize>(&mut self, field: &'static Field) -> L::Ram<A, D>;
    /// A shift register.
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        field: &'static Field,
    ) -> L::ShiftRegister<K, D>;
}

/// What kind of word a leaf is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// One wire.
    Bit,
    /// An unsigned word.
    Unsigned,
    /// A two's complement word.
    Signed,
}

/// Kind and width of a leaf.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Shape {
    /// What kind of word.
    pub kind: Kind,
    /// Width in bits.
    pub width: usize,
}

impl<L: Logic, T: Signals<L>, const N: usize> Signals<L> for [T; N] {
    fn visit<V: Visit<L>>(&self, field: &'static Field, visitor: &mut V) {
        for (index, element) in self.iter().enumerate() {
            visitor.element(index);
            element.visit(field, visitor);
        }
    }
    fn make<M: Make<L>>(field: &'static Field, maker: &mut M) -> Self {
        std::array::from_fn(|index| {
            maker.element(index);
            T::make(field, maker)
        })
    }
}

/// No signals at all: the inputs of a circuit that has none.
#[derive(Debug, Clone, Copy)]
pub struct Nothing<L>(PhantomData<L>);

impl<L> Nothing<L> {
    /// No signals.
    pub const fn new() -> Self {
        Nothing(PhantomData)
    }
}

impl<L> Default for Nothing<L> {
    fn default() -> Self {
        Nothing::new()
    }
}

impl<L: Logic> Signals<L> for Nothing<L> {
    fn visit<V: Visit<L>>(&self, _: &'static Field, _: &mut V) {}
    fn make<M: Make<L>>(_: &'static Field, _: &mut M) -> Self {
        Nothing::new()
    }
}
