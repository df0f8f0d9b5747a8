//! Search by gates: many transitions at once, in the order of the search in simulation and with
//! the same outcome.

use super::search::Search;
use super::searching::{Ended, Next, One, Searching};
use crate::engine::sliced::{Tick, Ticks, Turned, WORDS};
use std::ops::Range;

/// Number of batches between looks at the time.
const LOOK_EVERY: u64 = 256;

/// 64 transitions, or fewer: of one state with inputs of a block, or of several states with all
/// inputs.
struct Word {
    /// Index of the first state.
    first: usize,
    /// Number of states.
    states: usize,
    /// Index of the block of inputs.
    block: usize,
}

/// Inputs of 64 transitions.
struct Block {
    turned: Turned,
    /// Low where there is no input.
    valid: u64,
}

/// Inputs in blocks, and the gates.
pub(super) struct Batches<'s> {
    searching: &'s Searching<'s>,
    ticks: Ticks<'s>,
    /// Transitions of a state in a word: 64, or all.
    lanes: usize,
    blocks: Vec<Block>,
    /// Words of this batch.
    words: Vec<Word>,
}

impl<'s> Batches<'s> {
    pub(super) fn new(searching: &'s Searching<'s>, tick: &'s Tick) -> Self {
        let inputs = &searching.words;
        let lanes = inputs.len().next_power_of_two().clamp(1, 64);
        let valid = |count: usize| match count {
            0 => 0,
            count => u64::MAX >> (64 - count),
        };
        let blocks = match lanes {
            64 => inputs
                .chunks(64)
                .map(|inputs| Block {
                    turned: Turned::of(inputs.iter().copied()),
                    valid: valid(inputs.len()),
                })
                .collect(),
            _ => {
                let state = inputs
                    .iter()
                    .copied()
                    .chain(std::iter::repeat(0))
                    .take(lanes);
                let states = 0..64 / lanes;
                let all: Vec<u64> = states.clone().flat_map(|_| state.clone()).collect();
                let valid =
                    states.fold(0, |all, state| all | valid(inputs.len()) << (state * lanes));
                vec![Block {
                    turned: Turned::of(all.into_iter()),
                    valid,
                }]
            }
        };
        Batches {
            searching,
            ticks: Ticks::new(tick),
            lanes,
            blocks,
            words: Vec::with_capacity(WORDS),
        }
    }

    /// Searches all states.
    pub(super) fn search(&mut self, mut search: Search<'_>, one: &mut One<'_>) -> Ended {
        // Next state and block.
        let (mut at, mut block) = (0, 0);
        let mut batches = 0_u64;
        while self.run(&search, (&mut at, &mut block), usize::MAX) {
            batches += 1;
            if batches.is_multiple_of(LOOK_EVERY) && search.is_late() {
                return Ended::Limit(search.progress());
            }
            for word in 0..self.words.len() {
                for state in 0..self.words[word].states {
                    if let Some(ended) = self.look(&mut search, one, word, state) {
                        return ended;
                    }
                }
            }
        }
        search.proceed(at);
        Ended::Proof(search.proof())
    }

    /// Runs the next transitions of the states before `end`; returns false if there are none.
    fn run(
        &mut self,
        search: &Search<'_>,
        (at, block): (&mut usize, &mut usize),
        end: usize,
    ) -> bool {
        self.words.clear();
        let end = end.min(search.len());
        while *at < end && self.words.len() < WORDS {
            let (first, word) = (*at, self.words.len());
            let states = (64 / self.lanes).min(end - first);
            let state = |index: usize| search.nth(index).unwrap_or_default();
            match states {
                1 => self.ticks.state(word, state(first)),
                _ => {
                    let lanes = (0..64).map(|lane| state(first + lane / self.lanes));
                    self.ticks.states(word, &Turned::of(lanes));
                }
            }
            self.ticks.inputs(word, &self.blocks[*block].turned);
            self.words.push(Word {
                first,
                states,
                block: *block,
            });
            *block += 1;
            if *block == self.blocks.len() {
                (*at, *block) = (first + states, 0);
            }
        }
        let any = !self.words.is_empty();
        if any {
            self.ticks.run();
        }
        any
    }

    /// Returns the state of a part of a word, by index, and the allowed transitions.
    fn allowed(&self, search: &Search<'_>, word: usize, state: usize) -> (usize, u64) {
        let Word { first, block, .. } = self.words[word];
        let at = first + state;
        let part = u64::MAX >> (64 - self.lanes) << (state * self.lanes);
        let mut allowed = part & self.blocks[block].valid & self.ticks.given(word);
        if self.searching.assumes {
            let here = search.nth(at).unwrap_or_default();
            let mut left = allowed;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                if !self.searching.is_possible(here, self.input(block, lane)) {
                    allowed &= !(1 << lane);
                }
                left &= left - 1;
            }
        }
        (at, allowed)
    }

    /// Returns the index of the input of a transition.
    fn input(&self, block: usize, lane: usize) -> usize {
        block * 64 + lane % self.lanes
    }

    /// Checks the transitions of a part of a word.
    fn look(
        &mut self,
        search: &mut Search<'_>,
        one: &mut One<'_>,
        word: usize,
        state: usize,
    ) -> Option<Ended> {
        let (at, allowed) = self.allowed(search, word, state);
        search.proceed(at);
        let count = allowed.count_ones();
        let broken = allowed & !self.ticks.holds(word);
        if self.searching.others || broken != 0 || !search.has_room(count) {
            return self.look_at_each(search, one, (word, at), (allowed, broken));
        }
        search.transitions += u64::from(count);
        self.ticks.each_after(word, allowed, |state| {
            // There is room.
            search.found(state);
        });
        None
    }

    /// Checks the transitions of a part of a word one by one.
    fn look_at_each(
        &mut self,
        search: &mut Search<'_>,
        one: &mut One<'_>,
        (word, at): (usize, usize),
        (allowed, broken): (u64, u64),
    ) -> Option<Ended> {
        let block = self.words[word].block;
        let after = self.ticks.after(word);
        let state = search.nth(at)?;
        let mut left = allowed;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            search.transitions += 1;
            let index = self.input(block, lane);
            let ports = &self.searching.ports[index];
            let mut checked = Ok(());
            if self.searching.others {
                let next = match self.searching.looks_ahead {
                    true => Next::State(after[lane]),
                    false => Next::Nobody,
                };
                checked = one.at(search.depth(), (state, index), ports, next);
            }
            if checked.is_ok() && broken >> lane & 1 == 1 {
                checked = Err(one.fault(search.depth(), (state, index), ports));
            }
            if let Err((name, fault)) = checked {
                let way = search.way(index, |states, to| self.leading(search, states, to));
                return Some(Ended::Fault(way, name, fault));
            }
            if !search.found(after[lane]) {
                return Some(Ended::Limit(search.progress()));
            }
        }
        None
    }

    /// Returns the first of these states, and its first input, that lead to a state.
    fn leading(
        &mut self,
        search: &Search<'_>,
        states: Range<usize>,
        to: u64,
    ) -> Option<(usize, usize)> {
        let (mut at, mut block) = (states.start, 0);
        while self.run(search, (&mut at, &mut block), states.end) {
            for word in 0..self.words.len() {
                for state in 0..self.words[word].states {
                    let (at, allowed) = self.allowed(search, word, state);
                    if let Some(lane) = self.ticks.leading(word, allowed, to) {
                        return Some((at, self.input(self.words[word].block, lane)));
                    }
                }
            }
        }
        None
    }
}
