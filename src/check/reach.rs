use super::enumerate::{all, from_word, to_word};
use super::visited::Visited;
use super::{Counterexample, Fault, Invariants, TooWide};
use crate::kernel::{Circuit, Sample};
use crate::logic::Sim;
use std::fmt;

/// The widest inputs: all their values are tried in every state.
const INPUT_BITS: usize = 20;
/// The widest registers: a state is one word.
const STATE_BITS: usize = 64;
/// A report of progress after this many states, and after every depth.
const REPORT_EVERY: usize = 1 << 16;

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
type Report<'a> = dyn FnMut(&Progress) + 'a;
type Assume<'a, C> = dyn Fn(&<C as Circuit>::Reg<Sim>, &<C as Circuit>::In<Sim>) -> bool + 'a;

/// A search to be run; see [`reach`].
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
    #[must_use]
    pub fn inputs(mut self, possible: impl Fn(&C::In<Sim>) -> bool + 'a) -> Self {
        self.only = Some(Box::new(possible));
        self
    }

    /// Leaves out the inputs that the surroundings never apply in a state; of several assumptions
    /// all hold.
    #[must_use]
    pub fn assume(mut self, possible: impl Fn(&C::Reg<Sim>, &C::In<Sim>) -> bool + 'a) -> Self {
        self.assume.push(Box::new(possible));
        self
    }

    /// Ends the search undecided where there are more states than this; unless set, 2^26. A state
    /// takes 16 bytes, and as many more where the visited set is no bitmap.
    #[must_use]
    pub fn limit(mut self, states: u32) -> Self {
        self.limit = states;
        self
    }

    /// Keeps the visited set as a bitmap where the registers have at most `bits` bits, unless set
    /// 32 (512 MiB, of which only the pages in use become resident), at most 36; above, as a hash
    /// set.
    #[must_use]
    pub fn bitmap_bits(mut self, bits: usize) -> Self {
        self.bitmap_bits = bits;
        self
    }

    /// Calls `report` now and then.
    #[must_use]
    pub fn progress(mut self, report: impl FnMut(&Progress) + 'a) -> Self {
        self.progress = Some(Box::new(report));
        self
    }

    /// Searches.
    ///
    /// # Errors
    /// The registers have more than 64 bits or the inputs more than 20.
    pub fn run(mut self) -> Result<Outcome<C>, TooWide> {
        TooWide::check::<C::In<Sim>>("the inputs", INPUT_BITS)?;
        let bits = TooWide::check::<C::Reg<Sim>>("the registers", STATE_BITS)?;
        let mut inputs: Vec<C::In<Sim>> = all()?.collect();
        if let Some(possible) = &self.only {
            inputs.retain(|i| possible(i));
        }

        let mut found = Found::new(
            to_word(&self.circuit.power_on()),
            Visited::new(bits, self.bitmap_bits),
        );
        let mut transitions = 0;
        let mut dead_ends = 0;
        let mut depth = 0;
        let mut deeper_from = 1;
        let mut at = 0;
        while let Some(&state) = found.states.get(at) {
            let deeper = at == deeper_from;
            if deeper {
                depth += 1;
                deeper_from = found.states.len();
            }
            let progress = |found: &Found, transitions| Progress {
                states: found.states.len() as u64,
                frontier: (found.states.len() - at) as u64,
                transitions,
                depth,
            };
            if (deeper || at.is_multiple_of(REPORT_EVERY))
                && let Some(report) = &mut self.progress
            {
                report(&progress(&found, transitions));
            }

            let q: C::Reg<Sim> = from_word(state);
            let before = transitions;
            for (index, i) in inputs.iter().enumerate() {
                if !self.assume.iter().all(|possible| possible(&q, i)) {
                    continue;
                }
                transitions += 1;
                let w = self.circuit.comb(&q, i);
                let next = self.circuit.next(q.clone(), &w, i);
                let now = Sample {
                    tick: depth,
                    i,
                    q: &q,
                    w: &w,
                };
                if let Err((name, fault)) = self.invariants.check(&now, Some(&next)) {
                    let way = found.way(at, index);
                    let way = way.into_iter().map(|index| inputs[index].clone());
                    return Ok(self.violated(name, fault, way.collect()));
                }
                let next = to_word(&next);
                if found.visited.insert(next) {
                    if found.states.len() >= self.limit as usize {
                        return Ok(Outcome::Limit(progress(&found, transitions)));
                    }
                    found.push(next, at, index);
                }
            }
            dead_ends += u64::from(transitions == before);
            at += 1;
        }
        Ok(Outcome::Proof(Proof {
            states: found.states.len() as u64,
            transitions,
            depth,
            dead_ends,
        }))
    }

    fn violated(&self, name: &str, fault: Fault, inputs: Vec<C::In<Sim>>) -> Outcome<C> {
        let found = Counterexample::new(self.circuit, inputs, name.to_owned(), fault);
        Outcome::Counterexample(Box::new(found))
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

/// The states found, in the order of their distance from power-on, and how each was reached.
struct Found {
    visited: Visited,
    states: Vec<u64>,
    /// For every state the one before it on a shortest way and the input that leads on; both fit,
    /// since the limit of states is a `u32` and inputs have 20 bits at most.
    links: Vec<(u32, u32)>,
}

impl Found {
    fn new(power_on: u64, mut visited: Visited) -> Self {
        visited.insert(power_on);
        Found {
            visited,
            states: vec![power_on],
            links: vec![(0, 0)],
        }
    }

    #[inline]
    fn push(&mut self, state: u64, from: usize, input: usize) {
        self.states.push(state);
        self.links.push((from as u32, input as u32));
    }

    /// The inputs from power-on to state `at` and one more.
    fn way(&self, mut at: usize, last: usize) -> Vec<usize> {
        let mut way = vec![last];
        while at != 0 {
            let (from, input) = self.links[at];
            way.push(input as usize);
            at = from as usize;
        }
        way.reverse();
        way
    }
}
