use super::enumerate::{all, from_word};
use super::search::{Report, Search};
use super::visited::Visited;
use super::{CheckError, Counterexample, Invariants, TooWide};
use crate::engine::{Engine, Watch};
use crate::kernel::{Circuit, Model, Role, Sample, record, words};
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

    /// Searches.
    ///
    /// # Errors
    /// The registers have more than 64 bits or the inputs more than 20; the circuit is no netlist.
    pub fn run(mut self) -> Result<Outcome<C>, CheckError> {
        TooWide::check::<C::In<Sim>>("the inputs", INPUT_BITS)?;
        let bits = TooWide::check::<C::Reg<Sim>>("the registers", STATE_BITS)?;
        let model = Model::of(self.circuit)?;
        let inputs: Vec<C::In<Sim>> = all()?
            .filter(|i| self.only.as_ref().is_none_or(|possible| possible(i)))
            .collect();
        let words: Vec<Vec<u64>> = inputs.iter().map(words).collect();

        let mut engine = Engine::straight(model.program(Watch::All));
        let mut after = engine.clone();
        let states = Packing::of(&model);
        let visited = Visited::new(bits, self.bitmap_bits);
        let power_on = states.pack(&engine);
        let mut search = Search::new(power_on, visited, self.limit, self.progress.take());
        let looks_ahead = self.invariants.look_ahead();
        while let Some(state) = search.state() {
            let q: C::Reg<Sim> = from_word(state);
            states.unpack(state, &mut engine);
            let before = search.transitions;
            for (index, (i, words)) in inputs.iter().zip(&words).enumerate() {
                if !self.assume.iter().all(|possible| possible(&q, i)) {
                    continue;
                }
                search.transitions += 1;
                engine.inputs(words);
                engine.settle();
                // The edge is another engine's, so that the registers stay for the next inputs.
                after.restore(engine.slab());
                after.edge();
                let next = looks_ahead.then(|| record(Role::Register, &after));
                let checked = Sample::show_given(search.depth, &engine, (i, &q), |now| {
                    self.invariants.check(now, next.as_ref())
                });
                if let Err((name, fault)) = checked {
                    let way = search.way(index);
                    let way = way.into_iter().map(|index| inputs[index].clone());
                    let found = Counterexample::new(&model, way.collect(), name.to_owned(), fault);
                    return Ok(Outcome::Counterexample(Box::new(found)));
                }
                if !search.found(states.pack(&after), index) {
                    return Ok(Outcome::Limit(search.progress()));
                }
            }
            search.tried(before);
        }
        Ok(Outcome::Proof(search.proof()))
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
