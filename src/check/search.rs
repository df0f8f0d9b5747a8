//! State of a search that does not depend on the circuit's type.

use super::states::States;
use super::visited::Visited;
use super::{Progress, Proof};
use std::ops::Range;
use std::time::Instant;

/// Number of states between reports of progress; each depth is reported too.
const REPORT_EVERY: usize = 1 << 16;

pub(crate) type Report<'a> = dyn FnMut(&Progress) + 'a;

/// Limits of a search.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Limits {
    pub states: u32,
    pub transitions: u64,
    pub until: Option<Instant>,
}

/// States found, ordered by distance from power-on.
pub(crate) struct Search<'a> {
    visited: Visited,
    states: States,
    limits: Limits,
    report: Option<Box<Report<'a>>>,
    /// Index of the current state.
    at: usize,
    /// Index of the first state of each distance from power-on in edges, up to that of the current
    /// state, and of the first state farther away.
    depths: Vec<usize>,
    pub(crate) transitions: u64,
    /// Transitions before the current state.
    before: u64,
    dead_ends: u64,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        (bits, power_on): (usize, u64),
        mut visited: Visited,
        limits: Limits,
        report: Option<Box<Report<'a>>>,
    ) -> Self {
        visited.insert(power_on);
        let mut states = States::new(bits);
        states.push(power_on);
        let mut search = Search {
            visited,
            states,
            limits,
            report,
            at: 0,
            depths: vec![0, 1],
            transitions: 0,
            before: 0,
            dead_ends: 0,
        };
        search.tell(true);
        search
    }

    /// Returns the state with index `at`.
    #[inline]
    pub(crate) fn nth(&self, at: usize) -> Option<u64> {
        self.states.get(at)
    }

    /// Returns the number of states found.
    pub(crate) fn len(&self) -> usize {
        self.states.len()
    }

    /// Returns the distance of the current state from power-on in edges.
    pub(crate) fn depth(&self) -> u64 {
        self.depths.len() as u64 - 2
    }

    /// Finishes the current state and those before `at`, which becomes the current one.
    pub(crate) fn proceed(&mut self, at: usize) {
        while self.at < at {
            self.dead_ends += u64::from(self.transitions == self.before);
            self.before = self.transitions;
            self.at += 1;
            if self.at < self.len() {
                let deeper = self.depths.last() == Some(&self.at);
                if deeper {
                    self.depths.push(self.len());
                }
                self.tell(deeper);
            }
        }
    }

    /// True if the time is over.
    pub(crate) fn is_late(&self) -> bool {
        self.limits
            .until
            .is_some_and(|until| Instant::now() >= until)
    }

    fn tell(&mut self, deeper: bool) {
        let progress = self.progress();
        if (deeper || self.at.is_multiple_of(REPORT_EVERY))
            && let Some(report) = &mut self.report
        {
            report(&progress);
        }
    }

    /// True if so many more transitions and states are within the limits.
    pub(crate) fn has_room(&self, more: u32) -> bool {
        self.transitions + u64::from(more) <= self.limits.transitions
            && self.len() + more as usize <= self.limits.states as usize
    }

    /// Adds a successor of the current state; returns false if there is no room for it.
    #[inline]
    pub(crate) fn found(&mut self, state: u64) -> bool {
        if self.transitions > self.limits.transitions {
            return false;
        }
        if self.visited.insert(state) {
            if self.len() >= self.limits.states as usize {
                return false;
            }
            self.states.push(state);
        }
        true
    }

    /// Returns the inputs from power-on to the current state, followed by `last`. `leading` returns
    /// the first of some states, and its first input, that lead to a state; states are given by
    /// index. They are found again, since a place for each would take more memory than the states.
    pub(crate) fn way(
        &self,
        last: usize,
        mut leading: impl FnMut(Range<usize>, u64) -> Option<(usize, usize)>,
    ) -> Vec<usize> {
        let mut way = vec![last];
        let mut at = self.at;
        let depths = self.depths[..self.depths.len() - 1].windows(2).rev();
        for level in depths {
            let Some((from, input)) = self
                .nth(at)
                .and_then(|state| leading(level[0]..level[1], state))
            else {
                break;
            };
            way.push(input);
            at = from;
        }
        way.reverse();
        way
    }

    pub(crate) fn progress(&self) -> Progress {
        Progress {
            states: self.len() as u64,
            frontier: (self.len() - self.at) as u64,
            transitions: self.transitions,
            depth: self.depth(),
        }
    }

    pub(crate) fn proof(&self) -> Proof {
        Proof {
            states: self.len() as u64,
            transitions: self.transitions,
            depth: self.depth(),
            dead_ends: self.dead_ends,
        }
    }
}
