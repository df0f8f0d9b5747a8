//! Search through the states of a circuit, independent of its type.

use super::Fault;
use super::batches::Batches;
use super::blamed::{self, UnknownSignal};
use super::reach::{Progress, Proof};
use super::search::{Limits, Report, Search};
use super::visited::Visited;
use crate::engine::sliced::Tick;
use crate::engine::{Engine, Watch};
use crate::netlist::Role;
use crate::sim::Elaborated;
use std::ops::Range;

/// Questions of a search that depend on the circuit's type.
pub(super) trait Judge {
    /// True if the assumptions allow an input, given by index, in a state.
    fn possible(&self, state: u64, input: usize) -> bool;
    /// Checks a settled tick of this state and input, with the registers after its edge.
    fn check(
        &self,
        depth: u64,
        engine: &Engine,
        of: (u64, usize),
        next: Next<'_>,
    ) -> Result<(), (String, Fault)>;
    /// Returns the signals that the invariants name in a settled tick, each with its invariant.
    fn blamed(&self, engine: &Engine, of: (u64, usize), after: &Engine) -> Vec<(String, String)>;
}

/// Registers after an edge, if an invariant reads them.
#[derive(Clone, Copy)]
pub(super) enum Next<'a> {
    Nobody,
    State(u64),
    Engine(&'a Engine),
}

/// Search, independent of the circuit's type.
pub(super) struct Searching<'j> {
    /// All inputs that are applied, as one word each, and port by port.
    pub(super) words: Vec<u64>,
    pub(super) ports: Vec<Vec<u64>>,
    pub(super) judge: &'j dyn Judge,
    /// True if some inputs are not allowed in some states.
    pub(super) assumes: bool,
    /// True if an invariant reads the registers after an edge.
    pub(super) looks_ahead: bool,
    /// Indices of the circuit's own properties.
    pub(super) own: Vec<usize>,
    /// Indices of the circuit's statements that restrict the inputs.
    pub(super) given: Vec<usize>,
    /// True if not all properties are the circuit's own.
    pub(super) others: bool,
}

impl Searching<'_> {
    pub(super) fn run(
        &self,
        model: &Elaborated,
        visited: Visited,
        (limits, progress): (Limits, Option<Box<Report<'_>>>),
        simulated: bool,
    ) -> Ended {
        let states = Packing::of(model);
        let power_on = states.pack(&model.engine(Watch::All));
        let search = Search::new((states.bits(model), power_on), visited, limits, progress);
        let tick = match simulated {
            true => None,
            false => Tick::of(model.flat(), &self.own, &self.given).ok(),
        };
        let mut one = One {
            name: model.name(),
            judge: self.judge,
            engine: Engine::straight(model.program(Watch::Stated)),
            states,
            state: None,
        };
        let unknown = blamed::unknown(model, self.blamed(&mut one));
        if !unknown.is_empty() {
            return Ended::Unknown(unknown);
        }
        let ended = match &tick {
            Some(tick) => Batches::new(self, tick).search(search, &mut one),
            None => self.one_by_one(search, &mut one),
        };
        match ended {
            Ended::Proof(proof) if proof.transitions == 0 => Ended::NoInput,
            ended => ended,
        }
    }

    /// Returns the signals that the invariants name in the first transition.
    fn blamed(&self, one: &mut One<'_>) -> Vec<(String, String)> {
        let state = one.states.pack(&one.engine);
        let mut inputs = 0..self.ports.len();
        let Some(index) = inputs.find(|&index| self.is_possible(state, index)) else {
            return Vec::new();
        };
        one.engine.drive_all(&self.ports[index]);
        one.engine.settle();
        let mut after = one.engine.clone();
        after.edge();
        self.judge.blamed(&one.engine, (state, index), &after)
    }

    /// True if the assumptions that are no statements of the circuit allow an input in a state.
    #[inline]
    pub(super) fn is_possible(&self, state: u64, input: usize) -> bool {
        !self.assumes || self.judge.possible(state, input)
    }

    /// Searches transition by transition.
    fn one_by_one(&self, mut search: Search<'_>, one: &mut One<'_>) -> Ended {
        let mut after = one.engine.clone();
        let mut at = 0;
        while let Some(state) = search.nth(at) {
            search.proceed(at);
            if search.is_late() {
                return Ended::Limit(search.progress());
            }
            one.states.unpack(state, &mut one.engine);
            for index in 0..self.ports.len() {
                if !self.tick(state, index, one, &mut after) {
                    continue;
                }
                search.transitions += 1;
                let next = match self.looks_ahead {
                    true => Next::Engine(&after),
                    false => Next::Nobody,
                };
                let checked = self
                    .judge
                    .check(search.depth(), &one.engine, (state, index), next);
                if let Err((name, fault)) = checked {
                    let way = search.way(index, |states, to| {
                        self.leading(&search, states, to, one, &mut after)
                    });
                    return Ended::Fault(way, name, fault);
                }
                if !search.found(one.states.pack(&after)) {
                    return Ended::Limit(search.progress());
                }
            }
            at += 1;
        }
        search.proceed(at);
        Ended::Proof(search.proof())
    }

    /// Settles a tick of the engine's state with an input, and makes its edge `after`. Returns false
    /// if the input is not allowed.
    fn tick(&self, state: u64, index: usize, one: &mut One<'_>, after: &mut Engine) -> bool {
        if !self.is_possible(state, index) {
            return false;
        }
        one.engine.drive_all(&self.ports[index]);
        one.engine.settle();
        if self.given.iter().any(|&given| !one.engine.property(given)) {
            return false;
        }
        // Another engine makes the edge, so that the registers stay for the next inputs.
        after.restore(one.engine.slab());
        after.edge();
        true
    }

    /// Returns the first of these states, and its first input, that lead to a state.
    fn leading(
        &self,
        search: &Search<'_>,
        mut states: Range<usize>,
        to: u64,
        one: &mut One<'_>,
        after: &mut Engine,
    ) -> Option<(usize, usize)> {
        states.find_map(|at| {
            let state = search.nth(at)?;
            one.states.unpack(state, &mut one.engine);
            let mut inputs = 0..self.ports.len();
            let found = inputs
                .find(|&index| self.tick(state, index, one, after) && one.states.pack(after) == to);
            found.map(|index| (at, index))
        })
    }
}

/// Result of a search, with inputs by index.
pub(super) enum Ended {
    Proof(Proof),
    Limit(Progress),
    Fault(Vec<usize>, String, Fault),
    Unknown(Vec<UnknownSignal>),
    /// The state at power-on has no possible input.
    NoInput,
}

/// Evaluation of single transitions.
pub(super) struct One<'j> {
    name: &'static str,
    judge: &'j dyn Judge,
    engine: Engine,
    states: Packing,
    /// State of the engine.
    state: Option<u64>,
}

impl One<'_> {
    /// Settles a tick and checks it.
    pub(super) fn at(
        &mut self,
        depth: u64,
        (state, input): (u64, usize),
        ports: &[u64],
        next: Next<'_>,
    ) -> Result<(), (String, Fault)> {
        if self.state != Some(state) {
            self.states.unpack(state, &mut self.engine);
            self.state = Some(state);
        }
        self.engine.drive_all(ports);
        self.engine.settle();
        self.judge.check(depth, &self.engine, (state, input), next)
    }

    /// Returns the fault of a transition that violates one of the circuit's own properties.
    pub(super) fn fault(&mut self, depth: u64, of: (u64, usize), ports: &[u64]) -> (String, Fault) {
        // The engine disagrees with the gates: a fault of the gates, which must not be hidden.
        let disagreed = |name: &str| {
            let message = "the gates of a tick say so, the engine does not".to_owned();
            let signals = Vec::new();
            (name.to_owned(), Fault { signals, message })
        };
        let fault = self.at(depth, of, ports, Next::Nobody);
        fault.err().unwrap_or_else(|| disagreed(self.name))
    }
}

/// Packing of a circuit's registers into one word, the first in the lowest bits.
struct Packing(Vec<(usize, usize)>);

impl Packing {
    fn of(model: &Elaborated) -> Self {
        let mut bit = 0;
        let leaves = model.leaves(Role::Register).map(|leaf| {
            bit += usize::from(model.flat().width(leaf));
            (leaf, bit - usize::from(model.flat().width(leaf)))
        });
        Packing(leaves.collect())
    }

    /// Returns the number of bits of a state.
    fn bits(&self, model: &Elaborated) -> usize {
        let last = self.0.last();
        last.map_or(0, |&(leaf, bit)| {
            bit + usize::from(model.flat().width(leaf))
        })
    }

    fn pack(&self, engine: &Engine) -> u64 {
        let words = self.0.iter().map(|&(leaf, bit)| engine.word(leaf) << bit);
        words.fold(0, |state, word| state | word)
    }

    fn unpack(&self, state: u64, engine: &mut Engine) {
        for &(leaf, bit) in &self.0 {
            let width = engine.flat().width(leaf);
            engine.set_leaf(leaf, state >> bit & (u64::MAX >> (64 - u32::from(width))));
        }
        engine.wake();
    }
}
