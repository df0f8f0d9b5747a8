//! What a search keeps, whatever the circuit.

use super::visited::Visited;
use super::{Progress, Proof};

/// A report of progress after this many states, and after every depth.
const REPORT_EVERY: usize = 1 << 16;

pub(crate) type Report<'a> = dyn FnMut(&Progress) + 'a;

/// The states found, in the order of their distance from power-on, and how each was reached.
pub(crate) struct Search<'a> {
    visited: Visited,
    states: Vec<u64>,
    /// For every state the one before it on a shortest way and the input that leads on; both fit,
    /// since the limit of states is a `u32` and inputs have 20 bits at most.
    links: Vec<(u32, u32)>,
    limit: usize,
    /// The most transitions.
    most: u64,
    report: Option<Box<Report<'a>>>,
    /// The state that is tried.
    at: usize,
    /// How many edges it is from power-on, and the first state that is farther.
    pub(crate) depth: u64,
    deeper_from: usize,
    pub(crate) transitions: u64,
    dead_ends: u64,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        power_on: u64,
        mut visited: Visited,
        (limit, most): (u32, u64),
        report: Option<Box<Report<'a>>>,
    ) -> Self {
        visited.insert(power_on);
        Search {
            visited,
            states: vec![power_on],
            links: vec![(0, 0)],
            limit: limit as usize,
            most,
            report,
            at: 0,
            depth: 0,
            deeper_from: 1,
            transitions: 0,
            dead_ends: 0,
        }
    }

    /// The state that was found as the nth.
    pub(crate) fn nth(&self, at: usize) -> Option<u64> {
        self.states.get(at).copied()
    }

    /// Which one is tried.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// The state to be tried with every input.
    pub(crate) fn state(&mut self) -> Option<u64> {
        let state = *self.states.get(self.at)?;
        let deeper = self.at == self.deeper_from;
        if deeper {
            self.depth += 1;
            self.deeper_from = self.states.len();
        }
        let progress = self.progress();
        if (deeper || self.at.is_multiple_of(REPORT_EVERY))
            && let Some(report) = &mut self.report
        {
            report(&progress);
        }
        Some(state)
    }

    /// It was tried; there were this many transitions before.
    pub(crate) fn tried(&mut self, before: u64) {
        self.dead_ends += u64::from(self.transitions == before);
        self.at += 1;
    }

    /// A state after the one that is tried; whether there is room for it.
    #[inline]
    pub(crate) fn found(&mut self, state: u64, input: usize) -> bool {
        if self.transitions > self.most {
            return false;
        }
        if self.visited.insert(state) {
            if self.states.len() >= self.limit {
                return false;
            }
            self.states.push(state);
            self.links.push((self.at as u32, input as u32));
        }
        true
    }

    /// The inputs from power-on to the state that is tried and one more.
    pub(crate) fn way(&self, last: usize) -> Vec<usize> {
        let mut way = vec![last];
        let mut at = self.at;
        while at != 0 {
            let (from, input) = self.links[at];
            way.push(input as usize);
            at = from as usize;
        }
        way.reverse();
        way
    }

    pub(crate) fn progress(&self) -> Progress {
        Progress {
            states: self.states.len() as u64,
            frontier: (self.states.len() - self.at) as u64,
            transitions: self.transitions,
            depth: self.depth,
        }
    }

    pub(crate) fn proof(&self) -> Proof {
        Proof {
            states: self.states.len() as u64,
            transitions: self.transitions,
            depth: self.depth,
            dead_ends: self.dead_ends,
        }
    }
}
