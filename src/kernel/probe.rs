use super::signals::{Field, Kind, Make, Role, Shape, Signals, Visit};
use crate::logic::{Bit, Image, Signed, Sim, sim::*};
use std::sync::Arc;

/// The words of a memory or shift register, for a [`Probe`].
pub trait Words {
    /// Width of a word in bits.
    fn width(&self) -> usize;
    /// The number of words.
    fn len(&self) -> usize;
    /// Whether there is no word.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// The word at `index`.
    fn word(&self, index: usize) -> u64;
    /// What a word is called.
    fn label(&self) -> &'static Field;
}

/// A word of a RAM.
pub(crate) static WORD: Field = Field::named("word");
/// A word of a shift register.
pub(crate) static STAGE: Field = Field::named("stage");

/// A visitor of simulated signals: every leaf comes as its bits.
pub trait Probe {
    /// A struct or a memory begins.
    fn enter(&mut self, _field: &'static Field) {}
    /// The struct or memory entered last ends.
    fn leave(&mut self) {}
    /// What comes next is element `index` of an array or a memory.
    fn element(&mut self, _index: usize) {}
    /// A leaf; `bits` holds its value in the low `shape.width` bits, zeros above.
    fn leaf(&mut self, field: &'static Field, shape: Shape, bits: u64);
    /// A memory: unless overridden, a scope with a leaf for every word.
    fn memory(&mut self, field: &'static Field, words: &dyn Words) {
        self.enter(field);
        let shape = Shape {
            kind: Kind::Unsigned,
            width: words.width(),
        };
        for index in 0..words.len() {
            self.element(index);
            self.leaf(words.label(), shape, words.word(index));
        }
        self.leave();
    }
}

impl<P: Probe> Visit<Sim> for P {
    #[inline]
    fn enter(&mut self, field: &'static Field) {
        Probe::enter(self, field);
    }
    #[inline]
    fn leave(&mut self) {
        Probe::leave(self);
    }
    #[inline]
    fn element(&mut self, index: usize) {
        Probe::element(self, index);
    }
    #[inline]
    fn bit(&mut self, field: &'static Field, value: Wire) {
        let kind = Kind::Bit;
        self.leaf(field, Shape { kind, width: 1 }, value.word().get());
    }
    #[inline]
    fn unsigned<const N: usize>(&mut self, field: &'static Field, value: UInt<N>) {
        let kind = Kind::Unsigned;
        self.leaf(field, Shape { kind, width: N }, value.get());
    }
    #[inline]
    fn signed<const N: usize>(&mut self, field: &'static Field, value: Int<N>) {
        let kind = Kind::Signed;
        self.leaf(field, Shape { kind, width: N }, value.unsigned().get());
    }
    fn ram<const A: usize, const D: usize>(&mut self, field: &'static Field, ram: &SimRam<A, D>) {
        self.memory(field, ram);
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        field: &'static Field,
        register: &SimShiftRegister<K, D>,
    ) {
        self.memory(field, register);
    }
}

/// Shows a part of a circuit: the same walk as any other, compiled once for all probes.
pub(crate) fn show<S: Signals<Sim>>(signals: &S, role: Role, probe: &mut dyn Probe) {
    signals.visit(part(role), &mut Shown(probe));
}

/// Makes a part of a circuit: compiled once for all sources.
pub(super) fn supply<S: Signals<Sim>>(role: Role, source: &mut dyn Source) -> S {
    S::make(part(role), &mut Supplied(source))
}

/// What holds of the struct of a part.
pub(crate) fn part(role: Role) -> &'static Field {
    match role {
        Role::Input => const { &Field::part(Role::Input) },
        Role::Register => const { &Field::part(Role::Register) },
        Role::Net => const { &Field::part(Role::Net) },
    }
}

/// Any probe by one type.
pub(super) struct Shown<'a>(pub(super) &'a mut dyn Probe);

impl Probe for Shown<'_> {
    fn enter(&mut self, field: &'static Field) {
        self.0.enter(field);
    }
    fn leave(&mut self) {
        self.0.leave();
    }
    fn element(&mut self, index: usize) {
        self.0.element(index);
    }
    fn leaf(&mut self, field: &'static Field, shape: Shape, bits: u64) {
        self.0.leaf(field, shape, bits);
    }
    fn memory(&mut self, field: &'static Field, words: &dyn Words) {
        self.0.memory(field, words);
    }
}

/// A maker of simulated signals: it gives every leaf its bits.
pub trait Source {
    /// A struct or a memory begins.
    fn enter(&mut self, _field: &'static Field) {}
    /// The struct or memory entered last ends.
    fn leave(&mut self) {}
    /// What comes next is element `index` of an array or a memory.
    fn element(&mut self, _index: usize) {}
    /// The bits of a leaf; those above `shape.width` are ignored.
    fn leaf(&mut self, field: &'static Field, shape: Shape) -> u64;
    /// All of the so many words of the memory that comes next; none where they come one by one.
    fn memory(&mut self, words: usize) -> Option<Arc<[u64]>> {
        let _ = words;
        None
    }
}

/// The words of a memory that are taken at once, if there are as many.
fn whole<S: Source>(source: &mut S, len: usize) -> Option<Arc<[u64]>> {
    source.memory(len).filter(|words| words.len() == len)
}

/// The words of a memory, one leaf each.
fn words<S: Source>(
    source: &mut S,
    field: &'static Field,
    label: &'static Field,
    len: usize,
    width: usize,
) -> Vec<u64> {
    let kind = Kind::Unsigned;
    source.enter(field);
    let words = (0..len)
        .map(|index| {
            source.element(index);
            source.leaf(label, Shape { kind, width })
        })
        .collect();
    source.leave();
    words
}

impl<S: Source> Make<Sim> for S {
    fn enter(&mut self, field: &'static Field) {
        Source::enter(self, field);
    }
    fn leave(&mut self) {
        Source::leave(self);
    }
    fn element(&mut self, index: usize) {
        Source::element(self, index);
    }
    fn bit(&mut self, field: &'static Field) -> Wire {
        let kind = Kind::Bit;
        (self.leaf(field, Shape { kind, width: 1 }) & 1 == 1).into()
    }
    fn unsigned<const N: usize>(&mut self, field: &'static Field) -> UInt<N> {
        let kind = Kind::Unsigned;
        self.leaf(field, Shape { kind, width: N }).into()
    }
    fn signed<const N: usize>(&mut self, field: &'static Field) -> Int<N> {
        let kind = Kind::Signed;
        (self.leaf(field, Shape { kind, width: N }) as i64).into()
    }
    fn ram<const A: usize, const D: usize>(&mut self, field: &'static Field) -> SimRam<A, D> {
        match whole(self, Image::<A, D>::WORDS) {
            Some(words) => SimRam::of_words(words),
            None => Image::new(words(self, field, &WORD, Image::<A, D>::WORDS, D)).into(),
        }
    }
    fn shift_register<const K: usize, const D: usize>(
        &mut self,
        field: &'static Field,
    ) -> SimShiftRegister<K, D> {
        match whole(self, K) {
            Some(words) => SimShiftRegister::of_words(words),
            None => SimShiftRegister::new(words(self, field, &STAGE, K, D)),
        }
    }
}

/// Any source by one type.
struct Supplied<'a>(&'a mut dyn Source);

impl Source for Supplied<'_> {
    fn enter(&mut self, field: &'static Field) {
        self.0.enter(field);
    }
    fn leave(&mut self) {
        self.0.leave();
    }
    fn element(&mut self, index: usize) {
        self.0.element(index);
    }
    fn leaf(&mut self, field: &'static Field, shape: Shape) -> u64 {
        self.0.leaf(field, shape)
    }
    fn memory(&mut self, words: usize) -> Option<Arc<[u64]>> {
        self.0.memory(words)
    }
}
