//! Search through the states of a circuit, independent of its type.

use super::Fault;
use super::blamed::{self, UnknownSignal};
use super::reach::{Progress, Proof};
use super::search::{Report, Search};
use super::visited::Visited;
use crate::engine::sliced::{LANES, Tick, Ticks};
use crate::engine::{Engine, Watch};
use crate::netlist::Role;
use crate::sim::Elaborated;

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
        (limits, progress): ((u32, u64), Option<Box<Report<'_>>>),
        simulated: bool,
    ) -> Ended {
        let states = Packing::of(model);
        let power_on = states.pack(&model.engine(Watch::Stated));
        let search = Search::new(power_on, visited, limits, progress);
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
        match &tick {
            Some(tick) => self.side_by_side(search, tick, &mut one),
            None => self.one_by_one(search, &mut one),
        }
    }

    /// Returns the signals that the invariants name in the first transition.
    fn blamed(&self, one: &mut One<'_>) -> Vec<(String, String)> {
        let state = one.states.pack(&one.engine);
        let mut inputs = 0..self.ports.len();
        let possible = |index: &usize| !self.assumes || self.judge.possible(state, *index);
        let Some(index) = inputs.find(possible) else {
            return Vec::new();
        };
        one.engine.drive_all(&self.ports[index]);
        one.engine.settle();
        let mut after = one.engine.clone();
        after.edge();
        self.judge.blamed(&one.engine, (state, index), &after)
    }

    /// Searches transition by transition.
    fn one_by_one(&self, mut search: Search<'_>, one: &mut One<'_>) -> Ended {
        let mut after = one.engine.clone();
        while let Some(state) = search.state() {
            one.states.unpack(state, &mut one.engine);
            let before = search.transitions;
            for (index, words) in self.ports.iter().enumerate() {
                if self.assumes && !self.judge.possible(state, index) {
                    continue;
                }
                one.engine.drive_all(words);
                one.engine.settle();
                if self.given.iter().any(|&given| !one.engine.property(given)) {
                    continue;
                }
                search.transitions += 1;
                // Another engine makes the edge, so that the registers stay for the next inputs.
                after.restore(one.engine.slab());
                after.edge();
                let next = match self.looks_ahead {
                    true => Next::Engine(&after),
                    false => Next::Nobody,
                };
                let of = (state, index);
                if let Err((name, fault)) = self.judge.check(search.depth, &one.engine, of, next) {
                    return Ended::Fault(search.way(index), name, fault);
                }
                if !search.found(one.states.pack(&after), index) {
                    return Ended::Limit(search.progress());
                }
            }
            search.tried(before);
        }
        Ended::Proof(search.proof())
    }

    /// Evaluates many transitions at once as gates, in the same order and with the same outcome.
    fn side_by_side(&self, mut search: Search<'_>, tick: &Tick, one: &mut One<'_>) -> Ended {
        let mut ticks = Ticks::new(tick);
        // Next case: index of a state, and of an input.
        let (mut at, mut index) = (0, 0);
        let mut cases: Vec<(usize, usize)> = Vec::with_capacity(LANES);
        let (mut before, mut given) = (Vec::with_capacity(LANES), Vec::with_capacity(LANES));
        let mut after = Vec::with_capacity(LANES);
        let mut excluded = Vec::with_capacity(LANES);
        let mut transitions = 0;
        let mut state = search.state();
        loop {
            cases.clear();
            before.clear();
            given.clear();
            while let Some(from) = search.nth(at)
                && cases.len() < LANES
            {
                while index < self.words.len() && cases.len() < LANES {
                    if !self.assumes || self.judge.possible(from, index) {
                        cases.push((at, index));
                        before.push(from);
                        given.push(self.words[index]);
                    }
                    index += 1;
                }
                if index == self.words.len() {
                    (at, index) = (at + 1, 0);
                }
            }
            after.clone_from(&before);
            let mut broken = None;
            excluded.clear();
            ticks.run(
                &mut after,
                &given,
                |lane| broken = broken.or(Some(lane)),
                |lane| excluded.push(lane),
            );
            let mut excluded = excluded.iter().copied().peekable();
            for (lane, &(from, index)) in cases.iter().enumerate() {
                while search.at() < from {
                    search.tried(transitions);
                    transitions = search.transitions;
                    state = search.state();
                }
                if excluded.next_if_eq(&lane).is_some() {
                    continue;
                }
                search.transitions += 1;
                let ports = &self.ports[index];
                if self.others {
                    let next = match self.looks_ahead {
                        true => Next::State(after[lane]),
                        false => Next::Nobody,
                    };
                    let checked = one.at(search.depth, (before[lane], index), ports, next);
                    if let Err((name, fault)) = checked {
                        return Ended::Fault(search.way(index), name, fault);
                    }
                }
                if broken == Some(lane) {
                    let (name, fault) = one.fault(search.depth, (before[lane], index), ports);
                    return Ended::Fault(search.way(index), name, fault);
                }
                if !search.found(after[lane], index) {
                    return Ended::Limit(search.progress());
                }
            }
            if cases.is_empty() {
                break;
            }
        }
        while state.is_some() {
            search.tried(transitions);
            transitions = search.transitions;
            state = search.state();
        }
        Ended::Proof(search.proof())
    }
}

/// Result of a search, with inputs by index.
pub(super) enum Ended {
    Proof(Proof),
    Limit(Progress),
    Fault(Vec<usize>, String, Fault),
    Unknown(Vec<UnknownSignal>),
}

/// Evaluation of single transitions.
struct One<'j> {
    name: &'static str,
    judge: &'j dyn Judge,
    engine: Engine,
    states: Packing,
    /// State of the engine.
    state: Option<u64>,
}

impl One<'_> {
    /// Settles a tick and checks it.
    fn at(
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
    fn fault(&mut self, depth: u64, of: (u64, usize), ports: &[u64]) -> (String, Fault) {
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
