//! State of a search that does not depend on the circuit's type.

use super::visited::Visited;
use super::{Progress, Proof};

/// Number of states between reports of progress; each depth is reported too.
const REPORT_EVERY: usize = 1 << 16;

pub(crate) type Report<'a> = dyn FnMut(&Progress) + 'a;

/// States found, ordered by distance from power-on, with the way each was reached.
pub(crate) struct Search<'a> {
    visited: Visited,
    states: Vec<u64>,
    /// For every state its predecessor on a shortest path, and the input that leads to it. Both
    /// fit: the limit of states is a `u32`, and inputs have at most 20 bits.
    links: Vec<(u32, u32)>,
    limit: usize,
    /// Greatest number of transitions.
    most: u64,
    report: Option<Box<Report<'a>>>,
    /// Index of the current state.
    at: usize,
    /// Distance of the current state from power-on in edges, and index of the first state farther
    /// away.
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

    /// Returns the state with index `at`.
    pub(crate) fn nth(&self, at: usize) -> Option<u64> {
        self.states.get(at).copied()
    }

    /// Returns the index of the current state.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// Returns the current state, which is to be tried with every input.
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

    /// Finishes the current state; `before` is the number of transitions before it.
    pub(crate) fn tried(&mut self, before: u64) {
        self.dead_ends += u64::from(self.transitions == before);
        self.at += 1;
    }

    /// Adds a successor of the current state; returns false if there is no room for it.
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

    /// Returns the inputs from power-on to the current state, followed by `last`.
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
