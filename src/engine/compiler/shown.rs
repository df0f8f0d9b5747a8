//! Replay in machine code: reads input changes from a table, and writes rows of changed words to
//! another one.

use super::emit::{Changes, Word};
use super::flow::Flow;
use crate::engine::input::InputChange;
use cranelift_codegen::ir::condcodes::IntCC;
use cranelift_codegen::ir::{Block, InstBuilder, Value};
use std::mem::offset_of;

/// Tables of a replay and positions in them, which machine code reads and writes.
pub(super) struct Tables {
    /// Next change, and the end of the changes.
    pub next: *const InputChange,
    pub last: *const InputChange,
    /// Place of the next row, and the last place at which a row with all entries has room.
    pub row: *mut u64,
    pub last_row: *mut u64,
    /// Table of [`Shown`](crate::engine::replay::Shown).
    pub shown: *const u64,
    /// Next arrival: the next tick with changes, or `end`.
    pub arrival: u64,
    /// Tick at which the code returns.
    pub end: u64,
    /// Arrival before which the code returns, with the last tick settled; or [`NEVER`].
    pub stop: u64,
}

/// `stop` of a replay that runs to its end. No tick arrives at 0.
pub(super) const NEVER: u64 = 0;

/// Result of a replay that has reached its end.
pub(super) const ENDED: u64 = u64::MAX;

impl Flow<'_> {
    /// Emits an arrival: changes the input ports, and enters `settle` with the number of ticks up to
    /// the next arrival. Leaves for `exit` at the end.
    pub fn arrive(&mut self, settle: Block, exit: Block) {
        let layout = &self.plan.layout;
        let tables = self.tables;
        let e = &mut self.emitter;
        let tick = e.load_at(tables, offset_of!(Tables, arrival));
        let end = e.load_at(tables, offset_of!(Tables, end));
        let last = e.load_at(tables, offset_of!(Tables, last));
        let first = e.load_at(tables, offset_of!(Tables, next));
        let is_end = e.ins().icmp(IntCC::Equal, tick, end);
        let (ended, begin) = (e.block(), e.block());
        let (look, next) = e.block_with();
        let (go, until) = e.block_with();
        e.branch(is_end, ended, begin);
        e.begin(ended);
        let all = e.number(ENDED);
        e.jump_with(exit, all);
        e.begin(begin);
        e.jump_with(look, first);

        e.begin(look);
        let none = e.ins().icmp(IntCC::Equal, next, last);
        let (over, more) = (e.block(), e.block());
        e.branch(none, over, more);
        e.begin(over);
        e.jump_with(go, end);
        e.begin(more);
        let at = e.load_at(next, offset_of!(InputChange, tick));
        let later = e.ins().icmp(IntCC::UnsignedGreaterThan, at, tick);
        let (wait, make) = (e.block(), e.block());
        e.branch(later, wait, make);
        e.begin(wait);
        let until_change = e.ins().umin(at, end);
        e.jump_with(go, until_change);

        e.begin(make);
        let port = e.load_at(next, offset_of!(InputChange, port));
        let word = e.load_at(next, offset_of!(InputChange, word));
        let behind = e.ins().iadd_imm_s(next, size_of::<InputChange>() as i64);
        let mut targets: Vec<Block> = layout.inputs.iter().map(|_| e.block()).collect();
        targets.push(e.block());
        // A branch reads 32 bits of a number.
        let ports = e.number(layout.inputs.len() as u64);
        let port = e.ins().umin(port, ports);
        e.branch_to(port, &targets);
        for (&slot, &target) in layout.inputs.iter().zip(&targets) {
            e.begin(target);
            e.forget();
            let mut changes = Changes::new();
            let word = Word {
                value: word,
                bits: 64,
                width: 64,
            };
            e.store_tracked(slot, word, &mut changes);
            e.flush(changes);
            e.jump_with(look, behind);
        }
        if let Some(&unknown) = targets.last() {
            e.begin(unknown);
            e.jump_with(look, behind);
        }

        e.begin(go);
        e.store_at(tables, offset_of!(Tables, next), next);
        e.store_at(tables, offset_of!(Tables, arrival), until);
        let ticks = e.ins().isub(until, tick);
        e.jump_with(settle, ticks);
    }

    /// Emits the end of the last settled tick before an arrival: its `edge`, or `leave` if the
    /// replay stops here.
    pub fn stops(&mut self, edge: Block, leave: Block, left: Value) {
        let tables = self.tables;
        let e = &mut self.emitter;
        let arrival = e.load_at(tables, offset_of!(Tables, arrival));
        let stop = e.load_at(tables, offset_of!(Tables, stop));
        let stops = e.ins().icmp(IntCC::Equal, arrival, stop);
        let goes = e.block();
        e.branch(stops, leave, goes);
        e.begin(goes);
        e.jump_with(edge, left);
    }

    /// Emits the row of a settled tick, with `left` ticks between it and the next arrival, and
    /// clears the change marks. Leaves for `exit` if there is no room for another row, else for
    /// `on`.
    pub fn row(&mut self, left: Value, on: Block, exit: Block) {
        let tables = self.tables;
        let e = &mut self.emitter;
        let row = e.load_at(tables, offset_of!(Tables, row));
        let first = e.ins().iadd_imm_s(row, 16);
        let end = self.entries(first);

        let e = &mut self.emitter;
        let none = e.ins().icmp(IntCC::Equal, end, first);
        let [keep, go_on, full] = std::array::from_fn(|_| e.block());
        e.branch(none, go_on, keep);
        e.begin(keep);
        let arrival = e.load_at(tables, offset_of!(Tables, arrival));
        let after = e.ins().isub(arrival, left);
        let tick = e.ins().iadd_imm_s(after, -1);
        let bytes = e.ins().isub(end, first);
        let words = e.ins().ushr_imm_u(bytes, 3);
        e.store_at(row, 0, tick);
        e.store_at(row, 8, words);
        e.store_at(tables, offset_of!(Tables, row), end);
        let last = e.load_at(tables, offset_of!(Tables, last_row));
        let past = e.ins().icmp(IntCC::UnsignedGreaterThan, end, last);
        e.branch(past, full, go_on);
        e.begin(full);
        e.jump_with(exit, left);
        e.begin(go_on);
        e.jump_with(on, left);
    }

    /// Emits the entries of all words with a change mark from a place on, and clears the marks.
    /// Returns the place behind them.
    fn entries(&mut self, first: Value) -> Value {
        let layout = &self.plan.layout;
        let tables = self.tables;
        let e = &mut self.emitter;
        let shown = e.load_at(tables, offset_of!(Tables, shown));
        let none = e.number(0);
        e.store(layout.event, none);
        // Three loops: words of marks, marks of a word, entries of a mark.
        let (words, word, end) = e.block_with_two();
        let (marks, left, place) = e.block_with_two();
        let (list, entry, to) = e.block_with_two();
        let [next_word, take, next_mark, mark, write, done] = std::array::from_fn(|_| e.block());
        e.jump_with_two(words, none, first);

        e.begin(words);
        let count = e.number(layout.changed_words.into());
        let more = e.ins().icmp(IntCC::UnsignedLessThan, word, count);
        e.branch(more, take, done);
        e.begin(take);
        let all = e.load_of(layout.changed, layout.changed_words, word);
        e.store_of(layout.changed, layout.changed_words, word, none);
        e.jump_with_two(marks, all, end);

        e.begin(marks);
        e.branch(left, mark, next_word);
        e.begin(mark);
        let low = e.ins().ctz(left);
        let high = e.ins().ishl_imm_u(word, 6);
        let number = e.ins().iadd(high, low);
        let head = e.place_of(shown, number);
        let head = e.load_at(head, 0);
        e.jump_with_two(list, head, place);

        e.begin(list);
        e.branch(entry, write, next_mark);
        e.begin(write);
        let at = e.place_of(shown, entry);
        let slot = e.load_at(at, 0);
        let index = e.load_at(at, 8);
        let next = e.load_at(at, 16);
        let value = e.load_slot(slot);
        e.store_at(to, 0, index);
        e.store_at(to, 8, value);
        let behind = e.ins().iadd_imm_s(to, 16);
        e.jump_with_two(list, next, behind);

        e.begin(next_mark);
        let less = e.ins().iadd_imm_s(left, -1);
        let rest = e.ins().band(left, less);
        e.jump_with_two(marks, rest, to);
        e.begin(next_word);
        let next = e.ins().iadd_imm_s(word, 1);
        e.jump_with_two(words, next, place);
        e.begin(done);
        end
    }
}
