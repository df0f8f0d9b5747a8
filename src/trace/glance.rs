//! The look at what alone can change while a circuit coasts.

use super::rest::Rest;
use super::walk::{Change, note, note_memory};
use crate::kernel::{
    Circuit, Extent, Field, Inside, Probe, Role, Sample, Shape, Signals, Words, part};
use crate::logic::Sim;
use std::hint::cold_path;
use std::mem;

/// A look at what [runs free](Circuit::FREE_RUNNING): at the registers of the circuits that do, and
/// at their nets.
pub(super) struct Glance<'a> {
    pub before: &'a mut [u64],
    pub marks: &'a mut [u64],
    pub awake: &'a mut [bool],
    pub rest: &'a Rest,
    pub free: &'a [u32],
    pub changes: &'a mut [Change],
    /// How many of these there are.
    pub changed: usize,
    /// The leaf that comes next.
    pub cursor: usize,
    /// The circuit within that comes next.
    pub instance: usize,
    /// Among the registers.
    pub registers: bool,
    /// For each struct under way, the innermost in the lowest bit, whether its leaves are looked at.
    pub looks: u64,
}

impl Glance<'_> {
    /// Returns how many leaves have changed.
    #[inline(always)]
    pub fn look<C: Circuit>(mut self, now: &Sample<'_, C>) -> usize {
        if C::FREE_RUNNING == FreeRunning::Nothing {
            return 0;
        }
        self.cursor = const { C::In::<Sim>::EXTENT.leaves };
        now.q.visit(part(Role::Register), &mut self);
        self.rest.wake(&self.changes[..self.changed], self.awake);
        self.registers = false;
        self.looks = u64::from(C::FREE_RUNNING == FreeRunning::All);
        now.w.visit(part(Role::Net), &mut self);
        self.changed
    }
}

impl Probe for Glance<'_> {
    #[inline(always)]
    fn enter(&mut self, _: &'static Field) {
        self.looks = self.looks << 1 | self.looks & 1;
    }

    #[inline(always)]
    fn leave(&mut self) {
        self.looks >>= 1;
    }

    #[inline(always)]
    fn passes(&mut self, extent: Extent) -> bool {
        let end = self.cursor + extent.leaves;
        let passes = self.registers && self.free[self.cursor] == self.free[end];
        if passes {
            self.cursor = end;
        }
        passes
    }

    #[inline(always)]
    fn passes_over(&mut self, inside: Inside) -> bool {
        // What is known of it is known of its ports in, too, unless something goes on around it.
        let known = self.looks & 1 == 0;
        let nothing = inside.free_running == FreeRunning::Nothing;
        let rests = known && (nothing || !mem::take(&mut self.awake[self.instance]));
        if rests {
            self.cursor += inside.ports.leaves + inside.nets.leaves;
            self.instance += 1 + inside.nets.instances;
        } else if known {
            self.looks |= u64::from(inside.free_running == FreeRunning::All);
        }
        rests
    }

    #[inline(always)]
    fn rests(&mut self, _: Inside) -> bool {
        self.awake[self.instance] = false;
        self.instance += 1;
        false
    }

    #[inline(always)]
    fn leaf(&mut self, _: &'static Field, _: Shape, bits: u64) {
        let leaf = self.cursor;
        self.cursor += 1;
        if self.looks & 1 == 1 && bits != self.before[leaf] {
            cold_path();
            self.before[leaf] = bits;
            self.changed = note(self.changes, self.changed, leaf, bits);
        }
    }

    #[inline(always)]
    fn memory_rests(&mut self, words: usize, mark: u64) -> bool {
        let rests = words == 0 || self.marks[self.cursor] == mark;
        if rests {
            self.cursor += words;
        }
        rests
    }

    #[inline(always)]
    fn memory(&mut self, _: &'static Field, words: &dyn Words) {
        let start = self.cursor;
        self.cursor += words.len();
        let (before, marks) = (&mut *self.before, &mut *self.marks);
        self.changed = note_memory(words, start, before, marks, self.changes, self.changed);
    }
}
