use super::counterexample::Violation;
use super::enumerate::scramble;
use super::search::{Limits, Report};
use super::searching::{Ended, Judge, Next, Searching};
use super::visited::Visited;
use super::{CheckError, Fault, TooWide};
use super::{Counterexample, Invariants, Specified};
use crate::engine::Engine;
use crate::hdl::{
    self, Circuit, Registers, Value,
    pack::{bits_of, input_widths, joined, register_widths, registers_of, words},
};
use crate::sim::{
    Elaborated, Sample,
    sample::{Known, all_registers},
};
use std::cell::RefCell;
use std::fmt;
use std::time::Instant;

/// Greatest width of the inputs in bits: all their values are tried in every state.
const INPUT_BITS: usize = 20;
/// Greatest width of the registers in bits: a state is one word.
const STATE_BITS: usize = 64;

/// Proof that every reachable state satisfies the invariants under every input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Proof {
    /// Number of reachable states.
    pub states: u64,
    /// Number of pairs of a reachable state and an input that the assumptions allow in it.
    pub transitions: u64,
    /// Distance of the farthest state from power-on, in edges.
    pub depth: u64,
    /// Number of states in which no input is allowed. If that is not intended, the assumptions
    /// contradict each other and the proof covers less than it seems to.
    pub dead_ends: u64,
}

/// Progress of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Number of states found.
    pub states: u64,
    /// Number of states found but not yet tried with every input.
    pub frontier: u64,
    /// Number of transitions checked.
    pub transitions: u64,
    /// Distance of the search from power-on, in edges.
    pub depth: u64,
}

/// Result of a search.
#[must_use = "a counterexample is seen by looking at it"]
pub enum Outcome<C: Circuit> {
    /// All invariants hold.
    Proof(Proof),
    /// An invariant is violated; no shorter input sequence violates any.
    Counterexample(Box<Counterexample<C>>),
    /// The limit was reached: nothing is proved, and no violation was found so far.
    Limit(Progress),
}

impl<C: Circuit> Outcome<C> {
    /// Returns the proof, if this is one.
    pub fn proof(&self) -> Option<Proof> {
        match self {
            Outcome::Proof(proof) => Some(*proof),
            _ => None,
        }
    }

    /// Returns the counterexample, if this is one.
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
                let states = counted(proof.states, "state");
                let transitions = counted(proof.transitions, "transition");
                write!(f, "proved: {states}, {transitions}, depth {}", proof.depth)?;
                if proof.dead_ends > 0 {
                    let states = counted(proof.dead_ends, "state");
                    write!(f, ", {states} without a possible input")?;
                }
                Ok(())
            }
            Outcome::Counterexample(found) => found.fmt(f),
            Outcome::Limit(progress) => write!(
                f,
                "not decided: the limit was reached with {}, at depth {}, after {}",
                counted(progress.states, "state"),
                progress.depth,
                counted(progress.transitions, "transition")
            ),
        }
    }
}

/// Returns a number with its noun.
fn counted(number: u64, noun: &str) -> String {
    match number {
        1 => format!("1 {noun}"),
        _ => format!("{number} {noun}s"),
    }
}

impl<C: Circuit> fmt::Debug for Outcome<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

type Only<'a, C> = dyn Fn(&<C as Circuit>::In<Value>) -> bool + 'a;
type Assume<'a, C> = dyn Fn(&Registers<C>, &<C as Circuit>::In<Value>) -> bool + 'a;

/// Prepared search; see [`reach`].
#[must_use = "nothing is searched before it runs"]
pub struct Reach<'a, C: Circuit> {
    circuit: &'a C,
    invariants: Stated<'a, C>,
    only: Option<Box<Only<'a, C>>>,
    assume: Vec<Box<Assume<'a, C>>>,
    progress: Option<Box<Report<'a>>>,
    limits: Limits,
    model: Option<Elaborated>,
    bitmap_bits: usize,
}

/// Invariants of a search.
enum Stated<'a, C: Circuit> {
    Given(&'a Invariants<'a, C>),
    Own(Invariants<'a, C>),
}

impl<'a, C: Circuit> Stated<'a, C> {
    fn all(&self) -> &Invariants<'a, C> {
        match self {
            Stated::Given(invariants) => invariants,
            Stated::Own(invariants) => invariants,
        }
    }
}

/// Prepares a breadth-first search through every state that `circuit` reaches from power-on under
/// every input. [`run`](Reach::run) returns a proof of the invariants or a shortest
/// counterexample.
///
/// The outcome is the same in every run. What the circuit
/// [`applies`](Specified::applies) does not count here; [`prove`] restricts the inputs to it.
#[must_use = "nothing is searched before it runs"]
pub fn reach<'a, C: Circuit>(circuit: &'a C, invariants: &'a Invariants<'a, C>) -> Reach<'a, C> {
    Reach::of(circuit, Stated::Given(invariants))
}

/// Prepares the proof of a circuit: a search that checks its
/// [`invariants`](Specified::invariants), with the inputs that it
/// [`applies`](Specified::applies).
///
/// ```
/// use motion_rtl::circuits::blocks::EnableCounter;
/// use motion_rtl::check::{Outcome, prove};
///
/// let circuit = EnableCounter { width: 3 };
/// match prove(&circuit).limit(1000).run()? {
///     Outcome::Proof(proof) => assert_eq!(proof.states, 7),
///     Outcome::Counterexample(found) => panic!("{found}"),
///     Outcome::Limit(progress) => panic!("undecided after {} states", progress.states),
/// }
/// # Ok::<(), motion_rtl::check::CheckError>(())
/// ```
#[must_use = "nothing is searched before it runs"]
pub fn prove<C: Specified>(circuit: &C) -> Reach<'_, C> {
    Reach::of(circuit, Stated::Own(circuit.invariants())).inputs(|i| circuit.applies(i))
}

impl<'a, C: Circuit> Reach<'a, C> {
    fn of(circuit: &'a C, invariants: Stated<'a, C>) -> Self {
        Reach {
            circuit,
            invariants,
            only: None,
            assume: Vec::new(),
            progress: None,
            limits: Limits {
                states: 1 << 26,
                transitions: u64::MAX,
                until: None,
            },
            model: None,
            bitmap_bits: 32,
        }
    }

    /// Restricts the inputs, whatever the state. Excluded inputs are removed once and cost nothing
    /// in each state, unlike those that [`assume`](Self::assume) excludes.
    pub fn inputs(mut self, possible: impl Fn(&C::In<Value>) -> bool + 'a) -> Self {
        self.only = Some(Box::new(possible));
        self
    }

    /// Restricts the inputs that are possible in a state; all assumptions must hold.
    pub fn assume(mut self, possible: impl Fn(&Registers<C>, &C::In<Value>) -> bool + 'a) -> Self {
        self.assume.push(Box::new(possible));
        self
    }

    /// Ends the search undecided if there are more states than this; 2^26 by default. A state
    /// takes as many bytes as its bits fill, 1 to 8, and another 16 if the visited set is not a
    /// bitmap.
    pub fn limit(mut self, states: u32) -> Self {
        self.limits.states = states;
        self
    }

    /// Ends the search undecided after this number of transitions; unlimited by default.
    pub fn transitions(mut self, transitions: u64) -> Self {
        self.limits.transitions = transitions;
        self
    }

    /// Ends the search undecided at this time; by default it has all the time there is.
    pub fn until(mut self, time: Instant) -> Self {
        self.limits.until = Some(time);
        self
    }

    /// Searches this netlist of the circuit: one that was elaborated before, or that has a fault.
    pub fn model(mut self, model: Elaborated) -> Self {
        self.model = Some(model);
        self
    }

    /// Keeps the visited set as a bitmap if the registers have at most `bits` bits, else as a hash
    /// set. The default is 32 (512 MiB, of which only pages in use become resident), the greatest
    /// value 36.
    pub fn bitmap_bits(mut self, bits: usize) -> Self {
        self.bitmap_bits = bits;
        self
    }

    /// Calls `report` from time to time.
    pub fn progress(mut self, report: impl FnMut(&Progress) + 'a) -> Self {
        self.progress = Some(Box::new(report));
        self
    }

    /// Searches by gates: a tick of the circuit becomes gates that evaluate many transitions at
    /// once.
    ///
    /// # Errors
    /// Returns an error if the registers have more than 64 bits or the inputs more than 20, if the
    /// circuit cannot be elaborated, if the assumptions allow no input at power-on, or if an
    /// invariant names a signal that does not exist. Names are read in the first tick.
    pub fn run(self) -> Result<Outcome<C>, CheckError> {
        self.search(false)
    }

    /// Searches transition by transition in simulation; the outcome is the same.
    ///
    /// # Errors
    /// Returns an error if the registers have more than 64 bits or the inputs more than 20, if the
    /// circuit cannot be elaborated, if the assumptions allow no input at power-on, or if an
    /// invariant names a signal that does not exist. Names are read in the first tick.
    pub fn run_simulated(self) -> Result<Outcome<C>, CheckError> {
        self.search(true)
    }

    fn search(mut self, simulated: bool) -> Result<Outcome<C>, CheckError> {
        let model = match self.model.take() {
            Some(model) => model,
            None => Elaborated::new(self.circuit)?,
        };
        let widths = input_widths(self.circuit);
        let wide = widths.iter().sum();
        TooWide::check_bits("the inputs", wide, INPUT_BITS)?;
        let bits = register_widths(self.circuit).iter().sum();
        TooWide::check_bits("the registers", bits, STATE_BITS)?;
        // Loops instead of iterators: this code is compiled for every circuit.
        let (mut inputs, mut ports) = (Vec::new(), Vec::new());
        for word in 0..1u64 << wide {
            let i = hdl::inputs(self.circuit, bits_of(word));
            if self.only.as_ref().is_none_or(|possible| possible(&i)) {
                ports.push(words(&i, &widths));
                inputs.push(i);
            }
        }
        let progress = self.progress.take();
        let mut records = Vec::new();
        records.resize_with(1 << 10, || None);
        let judge = Of {
            reach: &self,
            known: Known::of(self.circuit, &model, 0),
            inputs,
            last: RefCell::new(None),
            records: RefCell::new(records),
        };
        let searching = Searching {
            words: all_joined(&ports, &widths),
            ports,
            judge: &judge,
            assumes: !self.assume.is_empty(),
            looks_ahead: self.invariants.all().look_ahead(),
            own: self.invariants.all().own(),
            given: self.invariants.all().given(),
            others: self.invariants.all().has_others(),
        };
        let visited = Visited::new(bits, self.bitmap_bits);
        let limits = self.limits;
        Ok(
            match searching.run(&model, visited, (limits, progress), simulated) {
                Ended::Unknown(signals) => return Err(CheckError::Signals(signals)),
                Ended::NoInput => {
                    let circuit = model.name().to_owned();
                    return Err(CheckError::NoInput { circuit });
                }
                Ended::Proof(proof) => Outcome::Proof(proof),
                Ended::Limit(progress) => Outcome::Limit(progress),
                Ended::Fault(way, name, fault) => {
                    let (mut inputs, mut ports) = (Vec::new(), Vec::new());
                    for index in way {
                        inputs.push(hdl::inputs(self.circuit, bits_of(searching.words[index])));
                        ports.push(searching.ports[index].clone());
                    }
                    let violation = Violation::new(&model, ports, name, fault);
                    Outcome::Counterexample(Box::new(Counterexample::of(violation, inputs)))
                }
            },
        )
    }
}

/// Returns every input as one word.
fn all_joined(ports: &[Vec<u64>], widths: &[usize]) -> Vec<u64> {
    ports.iter().map(|words| joined(words, widths)).collect()
}

/// State with its registers, if they were computed.
type Kept<C> = Option<(u64, Registers<C>)>;

/// Conversion of the search's numbers into the circuit's own records.
struct Of<'r, 'a, C: Circuit> {
    reach: &'r Reach<'a, C>,
    known: Known<C>,
    inputs: Vec<C::In<Value>>,
    /// State asked about last, with its registers.
    last: RefCell<Kept<C>>,
    /// Records of recent states: many transitions lead to the same one.
    records: RefCell<Vec<Kept<C>>>,
}

impl<C: Circuit> Of<'_, '_, C> {
    fn registers<'l>(&self, last: &'l mut Kept<C>, state: u64) -> &'l Registers<C> {
        if last.as_ref().is_some_and(|(known, _)| *known != state) {
            *last = None;
        }
        &last
            .get_or_insert_with(|| (state, registers_of(self.reach.circuit, state)))
            .1
    }
}

impl<C: Circuit> Judge for Of<'_, '_, C> {
    fn possible(&self, state: u64, input: usize) -> bool {
        let mut last = self.last.borrow_mut();
        let q = self.registers(&mut last, state);
        for possible in &self.reach.assume {
            if !possible(q, &self.inputs[input]) {
                return false;
            }
        }
        true
    }

    fn check(
        &self,
        depth: u64,
        engine: &Engine,
        (state, input): (u64, usize),
        next: Next<'_>,
    ) -> Result<(), (String, Fault)> {
        let mut last = self.last.borrow_mut();
        let here = self.registers(&mut last, state);
        let given = (Some(&self.inputs[input]), Some(here));
        let checked = |next: Option<&Registers<C>>| {
            Sample::show_given(depth, &self.known, engine, given, |now| {
                let checked = self.reach.invariants.all().check(now, next);
                checked.map_err(|(name, fault)| (name.to_owned(), fault))
            })
        };
        match next {
            Next::Nobody => checked(None),
            Next::Engine(after) => checked(Some(&all_registers(self.reach.circuit, after))),
            Next::State(state) => {
                let mut records = self.records.borrow_mut();
                let place = scramble(state) as usize % records.len();
                let slot = &mut records[place];
                if slot.as_ref().is_some_and(|(known, _)| *known != state) {
                    *slot = None;
                }
                let made = || (state, registers_of(self.reach.circuit, state));
                checked(Some(&slot.get_or_insert_with(made).1))
            }
        }
    }

    fn blamed(&self, engine: &Engine, of: (u64, usize), after: &Engine) -> Vec<(String, String)> {
        let here = registers_of(self.reach.circuit, of.0);
        let given = (Some(&self.inputs[of.1]), Some(&here));
        let next = all_registers(self.reach.circuit, after);
        Sample::show_given(0, &self.known, engine, given, |now| {
            self.reach.invariants.all().blamed(now, &next)
        })
    }
}

impl<C: Circuit> fmt::Debug for Reach<'_, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Reach")
            .field("circuit", &C::NAME)
            .field("invariants", self.invariants.all())
            .field("limits", &self.limits)
            .field("bitmap_bits", &self.bitmap_bits)
            .finish_non_exhaustive()
    }
}
