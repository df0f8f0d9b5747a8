use super::enumerate::{all, from_word, scramble, to_word};
use super::search::{Report, Search};
use super::visited::Visited;
use super::{CheckError, Counterexample, Fault, Invariants, TooWide};
use crate::engine::sliced::{LANES, Tick, Ticks};
use crate::engine::{Engine, Watch};
use crate::kernel::{Circuit, Model, Role, Sample, Signals, record, words};
use crate::logic::Sim;
use std::fmt;

/// The widest inputs: all their values are tried in every state.
const INPUT_BITS: usize = 20;
/// The widest registers: a state is one word.
const STATE_BITS: usize = 64;

/// Every reachable state satisfies the invariants under every input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Proof {
    /// The reachable states.
    pub states: u64,
    /// The pairs of a reachable state and an input that is assumed possible in it.
    pub transitions: u64,
    /// How many edges the farthest state is from power-on.
    pub depth: u64,
    /// The states in which no input is assumed possible. Where that is not meant, the assumption
    /// contradicts itself and proves less than it seems to.
    pub dead_ends: u64,
}

/// How far a search is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// The states found.
    pub states: u64,
    /// Those of them that are yet to be tried with every input.
    pub frontier: u64,
    /// The transitions checked.
    pub transitions: u64,
    /// How many edges from power-on the search is.
    pub depth: u64,
}

/// How a search ended.
#[must_use = "a counterexample is seen by looking at it"]
pub enum Outcome<C: Circuit> {
    /// The invariants hold.
    Proof(Proof),
    /// An invariant does not hold; no shorter input sequence violates any.
    Counterexample(Box<Counterexample<C>>),
    /// There are more states than the limit: nothing is proved, and no violation was found yet.
    Limit(Progress),
}

impl<C: Circuit> Outcome<C> {
    /// The proof, if it is one.
    pub fn proof(&self) -> Option<Proof> {
        match self {
            Outcome::Proof(proof) => Some(*proof),
            _ => None,
        }
    }

    /// The counterexample, if it is one.
    pub fn counterexample(self) -> Option<Counterexample<C>> {
        match self {
            Outcome::Counterexample(found) => Some(*found),
            _ => None,
        }
    }
}

impl<C: Circuit> fmt::Display for Outcome<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Outcome::Proof(proof) => {
                write!(
                    f,
                    "proved: {} states, {} transitions, depth {}",
                    proof.states, proof.transitions, proof.depth
                )?;
                if proof.dead_ends > 0 {
                    write!(f, ", {} states without a possible input", proof.dead_ends)?;
                }
                Ok(())
            }
            Outcome::Counterexample(found) => found.fmt(f),
            Outcome::Limit(progress) => write!(
                f,
                "not decided: the limit of {} states was reached at depth {}, after {} transitions",
                progress.states, progress.depth, progress.transitions
            ),
        }
    }
}

impl<C: Circuit> fmt::Debug for Outcome<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

type Only<'a, C> = dyn Fn(&<C as Circuit>::In<Sim>) -> bool + 'a;
type Assume<'a, C> = dyn Fn(&<C as Circuit>::Reg<Sim>, &<C as Circuit>::In<Sim>) -> bool + 'a;

/// A search to be run; see [`reach`].
#[must_use = "nothing is searched before it runs"]
pub struct Reach<'a, C: Circuit> {
    circuit: &'a C,
    invariants: &'a Invariants<'a, C>,
    only: Option<Box<Only<'a, C>>>,
    assume: Vec<Box<Assume<'a, C>>>,
    progress: Option<Box<Report<'a>>>,
    limit: u32,
    bitmap_bits: usize,
}

/// Prepares a search through every state that `circuit` reaches from power-on under every input,
/// breadth first; [`run`](Reach::run) ends in a proof of the invariants or in a shortest
/// counterexample.
///
/// The same circuit gives the same outcome on every run.
#[must_use = "nothing is searched before it runs"]
pub fn reach<'a, C: Circuit>(circuit: &'a C, invariants: &'a Invariants<'a, C>) -> Reach<'a, C> {
    Reach {
        circuit,
        invariants,
        only: None,
        assume: Vec::new(),
        progress: None,
        limit: 1 << 26,
        bitmap_bits: 32,
    }
}

impl<'a, C: Circuit> Reach<'a, C> {
    /// Leaves out the inputs that are never applied, whatever the state: sorted out once, they cost
    /// nothing in each state, as those that an assumption excludes do.
    pub fn inputs(mut self, possible: impl Fn(&C::In<Sim>) -> bool + 'a) -> Self {
        self.only = Some(Box::new(possible));
        self
    }

    /// Leaves out the inputs that the surroundings never apply in a state; of several assumptions
    /// all hold.
    pub fn assume(mut self, possible: impl Fn(&C::Reg<Sim>, &C::In<Sim>) -> bool + 'a) -> Self {
        self.assume.push(Box::new(possible));
        self
    }

    /// Ends the search undecided where there are more states than this; unless set, 2^26. A state
    /// takes 16 bytes, and as many more where the visited set is no bitmap.
    pub fn limit(mut self, states: u32) -> Self {
        self.limit = states;
        self
    }

    /// Keeps the visited set as a bitmap where the registers have at most `bits` bits, unless set
    /// 32 (512 MiB, of which only the pages in use become resident), at most 36; above, as a hash
    /// set.
    pub fn bitmap_bits(mut self, bits: usize) -> Self {
        self.bitmap_bits = bits;
        self
    }

    /// Calls `report` now and then.
    pub fn progress(mut self, report: impl FnMut(&Progress) + 'a) -> Self {
        self.progress = Some(Box::new(report));
        self
    }

    /// Searches: a tick of the circuit is made gates, which many transitions go through side by side.
    ///
    /// # Errors
    /// The registers have more than 64 bits or the inputs more than 20; the circuit is no netlist.
    pub fn run(self) -> Result<Outcome<C>, CheckError> {
        self.search(false)
    }

    /// Searches transition by transition, as a simulation runs; the outcome is the same.
    ///
    /// # Errors
    /// The registers have more than 64 bits or the inputs more than 20; the circuit is no netlist.
    pub fn run_simulated(self) -> Result<Outcome<C>, CheckError> {
        self.search(true)
    }

    fn search(mut self, simulated: bool) -> Result<Outcome<C>, CheckError> {
        TooWide::check::<C::In<Sim>>("the inputs", INPUT_BITS)?;
        let bits = TooWide::check::<C::Reg<Sim>>("the registers", STATE_BITS)?;
        let model = Model::of(self.circuit)?;
        let inputs: Vec<C::In<Sim>> = all()?
            .filter(|i| self.only.as_ref().is_none_or(|possible| possible(i)))
            .collect();
        let states = Packing::of(&model);
        let visited = Visited::new(bits, self.bitmap_bits);
        let power_on = states.pack(&model.engine(Watch::All));
        let search = Search::new(power_on, visited, self.limit, self.progress.take());
        let own = self.invariants.own();
        let tick = match simulated {
            true => None,
            false => Tick::of(model.flat(), own.as_deref().unwrap_or(&[])).ok(),
        };
        let mut one = One {
            invariants: self.invariants,
            engine: Engine::straight(model.program(Watch::All)),
            states,
            state: None,
        };
        let ended = match &tick {
            Some(tick) => self.side_by_side(search, &inputs, tick, own.is_some(), &mut one),
            None => self.one_by_one(search, &inputs, &mut one),
        };
        Ok(match ended {
            Ended::Proof(proof) => Outcome::Proof(proof),
            Ended::Limit(progress) => Outcome::Limit(progress),
            Ended::Fault(way, name, fault) => {
                let way = way.into_iter().map(|index| inputs[index].clone());
                let found = Counterexample::new(&model, way.collect(), name, fault);
                Outcome::Counterexample(Box::new(found))
            }
        })
    }

    fn is_possible(&self, q: &C::Reg<Sim>, i: &C::In<Sim>) -> bool {
        self.assume.iter().all(|possible| possible(q, i))
    }

    /// Transition by transition.
    fn one_by_one(
        &self,
        mut search: Search<'_>,
        inputs: &[C::In<Sim>],
        one: &mut One<'_, C>,
    ) -> Ended {
        let words: Vec<Vec<u64>> = inputs.iter().map(words).collect();
        let mut after = one.engine.clone();
        let looks_ahead = self.invariants.look_ahead();
        while let Some(state) = search.state() {
            let q: C::Reg<Sim> = from_word(state);
            one.states.unpack(state, &mut one.engine);
            let before = search.transitions;
            for (index, (i, words)) in inputs.iter().zip(&words).enumerate() {
                if !self.is_possible(&q, i) {
                    continue;
                }
                search.transitions += 1;
                one.engine.inputs(words);
                one.engine.settle();
                // The edge is another engine's, so that the registers stay for the next inputs.
                after.restore(one.engine.slab());
                after.edge();
                let next = looks_ahead.then(|| record(Role::Register, &after));
                if let Err((name, fault)) = one.check(search.depth, (i, &q), next.as_ref()) {
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

    /// Many transitions at once, as gates: in the same order, with the same outcome.
    fn side_by_side(
        &self,
        mut search: Search<'_>,
        inputs: &[C::In<Sim>],
        tick: &Tick,
        own: bool,
        one: &mut One<'_, C>,
    ) -> Ended {
        let looks_ahead = self.invariants.look_ahead();
        let words: Vec<u64> = inputs.iter().map(to_word).collect();
        let ports: Vec<Vec<u64>> = inputs.iter().map(self::words).collect();
        let mut records = Records::new();
        let mut ticks = Ticks::new(tick);
        // The next case: a state by its number, and an input.
        let (mut at, mut index) = (0, 0);
        let mut cases: Vec<(usize, usize)> = Vec::with_capacity(LANES);
        let (mut before, mut given) = (Vec::with_capacity(LANES), Vec::with_capacity(LANES));
        let mut after = Vec::with_capacity(LANES);
        let mut transitions = 0;
        let mut state = search.state();
        loop {
            cases.clear();
            before.clear();
            given.clear();
            while let Some(from) = search.nth(at)
                && cases.len() < LANES
            {
                let q = (!self.assume.is_empty()).then(|| from_word::<C::Reg<Sim>>(from));
                while index < inputs.len() && cases.len() < LANES {
                    let possible = q
                        .as_ref()
                        .is_none_or(|q| self.is_possible(q, &inputs[index]));
                    if possible {
                        cases.push((at, index));
                        before.push(from);
                        given.push(words[index]);
                    }
                    index += 1;
                }
                if index == inputs.len() {
                    (at, index) = (at + 1, 0);
                }
            }
            after.clone_from(&before);
            let mut broken = None;
            ticks.run(&mut after, &given, |lane| broken = broken.or(Some(lane)));
            for (lane, &(from, index)) in cases.iter().enumerate() {
                while search.at() < from {
                    search.tried(transitions);
                    transitions = search.transitions;
                    state = search.state();
                }
                search.transitions += 1;
                if !own {
                    let next = looks_ahead.then(|| records.of(after[lane]));
                    let i = (&inputs[index], &ports[index][..]);
                    let checked = one.at(search.depth, before[lane], i, next);
                    if let Err((name, fault)) = checked {
                        return Ended::Fault(search.way(index), name, fault);
                    }
                }
                if broken == Some(lane) {
                    let (name, fault) =
                        one.fault(search.depth, before[lane], (&inputs[index], &ports[index]));
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

/// How a search ended, inputs by their numbers.
enum Ended {
    Proof(Proof),
    Limit(Progress),
    Fault(Vec<usize>, String, Fault),
}

/// What looks at one transition.
struct One<'i, C: Circuit> {
    invariants: &'i Invariants<'i, C>,
    engine: Engine,
    states: Packing,
    /// The state that was looked at last.
    state: Option<(u64, C::Reg<Sim>)>,
}

impl<C: Circuit> One<'_, C> {
    /// Whether a settled tick is as it has to be.
    fn check(
        &self,
        depth: u64,
        (i, q): (&C::In<Sim>, &C::Reg<Sim>),
        next: Option<&C::Reg<Sim>>,
    ) -> Result<(), (String, Fault)> {
        Sample::show_given(depth, &self.engine, (i, q), |now| {
            let checked = self.invariants.check(now, next);
            checked.map_err(|(name, fault)| (name.to_owned(), fault))
        })
    }

    /// Settles a tick and looks at it.
    fn at(
        &mut self,
        depth: u64,
        state: u64,
        (i, ports): (&C::In<Sim>, &[u64]),
        next: Option<&C::Reg<Sim>>,
    ) -> Result<(), (String, Fault)> {
        if self.state.as_ref().is_none_or(|(word, _)| *word != state) {
            self.states.unpack(state, &mut self.engine);
            self.state = Some((state, from_word(state)));
        }
        self.engine.inputs(ports);
        self.engine.settle();
        match &self.state {
            Some((_, q)) => self.check(depth, (i, q), next),
            None => Ok(()),
        }
    }

    /// What is wrong with a transition of which one of the circuit's own properties does not hold.
    fn fault(&mut self, depth: u64, state: u64, i: (&C::In<Sim>, &[u64])) -> (String, Fault) {
        // Where the engine disagrees with the gates: a fault of these, and no reason to be silent.
        let disagreed = || {
            let message = "the gates of a tick say so, the engine does not".to_owned();
            let signals = Vec::new();
            (C::NAME.to_owned(), Fault { signals, message })
        };
        let fault = self.at(depth, state, i, None);
        fault.err().unwrap_or_else(disagreed)
    }
}

/// Records of states that were asked for of late: many transitions lead to the same one.
struct Records<S>(Vec<Option<(u64, S)>>);

impl<S: Signals<Sim>> Records<S> {
    fn new() -> Self {
        Records((0..1 << 10).map(|_| None).collect())
    }

    fn of(&mut self, state: u64) -> &S {
        let place = scramble(state) as usize % self.0.len();
        let slot = &mut self.0[place];
        if slot.as_ref().is_some_and(|(known, _)| *known != state) {
            *slot = None;
        }
        &slot.get_or_insert_with(|| (state, from_word(state))).1
    }
}

/// How the registers of a circuit are packed into one word, the first in the lowest bits.
struct Packing(Vec<(usize, usize)>);

impl Packing {
    fn of(model: &Model) -> Self {
        let mut bit = 0;
        let leaves = model.leaves(Role::Register).map(|leaf| {
            bit += usize::from(model.flat().width(leaf));
            (leaf, bit - usize::from(model.flat().width(leaf)))
        });
        Packing(leaves.collect())
    }

    fn pack(&self, engine: &Engine) -> u64 {
        let words = self.0.iter().map(|&(leaf, bit)| engine.leaf(leaf) << bit);
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

impl<C: Circuit> fmt::Debug for Reach<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Reach")
            .field("circuit", &C::NAME)
            .field("invariants", &self.invariants)
            .field("limit", &self.limit)
            .field("bitmap_bits", &self.bitmap_bits)
            .finish_non_exhaustive()
    }
}
