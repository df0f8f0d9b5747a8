use super::enumerate::{from_word, to_word};
use super::{CheckError, Counterexample, Fault, TooWide};
use crate::kernel::{Circuit, Field, Model, Moment, Path, Probe, Role, Shape, Signals, part, zero};
use crate::logic::lanes::{Element, pack, spread, unpack};
use crate::logic::{Lanes, Logic, Sim};
use crate::trace::value::show;
use rayon::prelude::*;
use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// The cases that a thread takes at a time.
const CHUNK: u64 = 1 << 14;

/// What a circuit makes of a fixed number of ticks from power-on, for every case of a finite space:
/// checked case by case by [`sweep()`].
///
/// A case is a bundle of words; its index is what they are packed. What goes in and what is seen is
/// written in words of any meaning, as a circuit is. What is expected is plain arithmetic on
/// numbers, by other means than the circuit's: a compiler deletes a check that it can prove.
pub trait Law: Sync {
    /// The circuit.
    type Circuit: Circuit + Sync;
    /// The words of a case, at most 63 bits.
    type Case<L: Logic>: Signals<L>;
    /// What is seen of it, at most 64 bits.
    type Seen<L: Logic>: Signals<L>;

    /// What holds.
    fn name(&self) -> &str;
    /// The circuit.
    fn circuit(&self) -> &Self::Circuit;
    /// How many ticks a case takes.
    fn ticks(&self) -> u64;
    /// The inputs of a tick.
    fn input<L: Logic>(&self, case: &Self::Case<L>, tick: u64)
    -> <Self::Circuit as Circuit>::In<L>;
    /// What is seen with this tick; `seen` is that of the ticks before, all bits low in tick 0.
    fn see<L: Logic>(
        &self,
        seen: Self::Seen<L>,
        tick: u64,
        now: &Moment<'_, Self::Circuit, L>,
    ) -> Self::Seen<L>;
    /// What is to be seen in the end; nothing for a case that is not meant.
    fn expected(&self, case: &Self::Case<Sim>) -> Option<Self::Seen<Sim>>;
}

/// How a sweep ended.
#[must_use = "a counterexample is seen by looking at it"]
pub enum Swept<C: Circuit> {
    /// Every case is as expected: how many there are, without those that are not meant.
    Held(u64),
    /// The case with the lowest index that is not.
    Counterexample(Box<Counterexample<C>>),
}

impl<C: Circuit> Swept<C> {
    /// The cases that were checked, if all are as expected.
    pub fn held(&self) -> Option<u64> {
        match self {
            Swept::Held(cases) => Some(*cases),
            Swept::Counterexample(_) => None,
        }
    }

    /// The counterexample, if there is one.
    pub fn counterexample(self) -> Option<Counterexample<C>> {
        match self {
            Swept::Held(_) => None,
            Swept::Counterexample(found) => Some(*found),
        }
    }
}

impl<C: Circuit> fmt::Debug for Swept<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Swept::Held(cases) => write!(f, "{cases} cases hold"),
            Swept::Counterexample(found) => found.fmt(f),
        }
    }
}

/// A sweep to be run; see [`sweep()`].
#[must_use = "nothing is checked before it runs"]
pub struct Sweep<'a, W: Law> {
    law: &'a W,
    range: Option<Range<u64>>,
    progress: Option<&'a (dyn Fn(u64) + Sync)>,
}

/// Checks a law on every case: [`Lanes`] of them at a time, on as many threads as rayon has. The
/// counterexample is the case with the lowest index, however many threads and lanes there are.
#[must_use = "nothing is checked before it runs"]
pub fn sweep<W: Law>(law: &W) -> Sweep<'_, W> {
    Sweep {
        law,
        range: None,
        progress: None,
    }
}

/// The number of cases of a law.
///
/// # Errors
/// A case has more than 63 bits, or what is seen more than 64.
pub fn cases<W: Law>() -> Result<u64, CheckError> {
    TooWide::check::<W::Seen<Sim>>("the signals seen", 64)?;
    Ok(1 << TooWide::check::<W::Case<Sim>>("the cases", 63)?)
}

impl<'a, W: Law> Sweep<'a, W> {
    /// Checks only the cases with these indices, as far as there are such.
    pub fn range(mut self, range: Range<u64>) -> Self {
        self.range = Some(range);
        self
    }

    /// Calls `report` now and then with the number of cases that were looked at since.
    pub fn progress(mut self, report: &'a (dyn Fn(u64) + Sync)) -> Self {
        self.progress = Some(report);
        self
    }

    /// Runs it with `K` lanes of elements `E`, in which every word of the circuit has to fit.
    /// Without lanes it is not compiled.
    ///
    /// # Errors
    /// A case has more than 63 bits, or what is seen more than 64.
    pub fn run<const K: usize, E: Element>(self) -> Result<Swept<W::Circuit>, CheckError> {
        const { assert!(K > 0, "a sweep needs a lane") };
        let law = self.law;
        let held = AtomicU64::new(0);
        let first = self.first(|chunk| {
            let (meant, first) = by_lanes::<W, K, E>(law, chunk);
            held.fetch_add(meant, Ordering::Relaxed);
            first
        })?;
        self.outcome(first, held.into_inner())
    }

    /// Runs it case by case in the meaning [`Sim`], for words wider than any lane.
    ///
    /// # Errors
    /// A case has more than 63 bits, or what is seen more than 64.
    pub fn run_simulated(self) -> Result<Swept<W::Circuit>, CheckError> {
        let law = self.law;
        let held = AtomicU64::new(0);
        let first = self.first(|chunk| {
            let (meant, first) = one_by_one(law, chunk);
            held.fetch_add(meant, Ordering::Relaxed);
            first
        })?;
        self.outcome(first, held.into_inner())
    }

    /// The lowest index that `check` finds wrong, chunk by chunk on all threads.
    fn first(
        &self,
        check: impl Fn(Range<u64>) -> Option<u64> + Sync,
    ) -> Result<Option<u64>, CheckError> {
        let all = cases::<W>()?;
        let range = self.range.clone().unwrap_or(0..all);
        let (from, to) = (range.start, range.end.min(all));
        let chunks = to.saturating_sub(from).div_ceil(CHUNK);
        let chunks = (0..chunks).into_par_iter();
        Ok(chunks.find_map_first(|chunk| {
            let begin = from + chunk * CHUNK;
            let end = to.min(begin + CHUNK);
            let first = check(begin..end);
            if let Some(report) = self.progress {
                report(end - begin);
            }
            first
        }))
    }

    fn outcome(&self, first: Option<u64>, held: u64) -> Result<Swept<W::Circuit>, CheckError> {
        Ok(match first {
            None => Swept::Held(held),
            Some(index) => Swept::Counterexample(Box::new(replayed(self.law, index)?)),
        })
    }
}

impl<W: Law> fmt::Debug for Sweep<'_, W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Sweep")
            .field("circuit", &W::Circuit::NAME)
            .field("law", &self.law.name())
            .field("range", &self.range)
            .finish_non_exhaustive()
    }
}

/// What is seen of a case in the end.
#[inline(always)]
fn seen<W: Law, L: Logic>(
    law: &W,
    power_on: <W::Circuit as Circuit>::Reg<L>,
    case: &W::Case<L>,
    nothing: W::Seen<L>,
) -> W::Seen<L> {
    let circuit = law.circuit();
    let (mut q, mut seen) = (power_on, nothing);
    for tick in 0..law.ticks() {
        let i = law.input(case, tick);
        let w = circuit.comb(&q, &i);
        let now = Moment {
            i: &i,
            q: &q,
            w: &w,
        };
        seen = law.see(seen, tick, &now);
        q = L::clock(circuit, q, &w, &i);
    }
    seen
}

/// How many cases are meant, and the first that is wrong.
#[inline(never)]
fn by_lanes<W: Law, const K: usize, E: Element>(law: &W, chunk: Range<u64>) -> (u64, Option<u64>) {
    let power_on: <W::Circuit as Circuit>::Reg<Lanes<K, E>> = spread(&law.circuit().power_on());
    let mut meant = 0;
    for index in chunk.clone().step_by(K) {
        let case = unpack(std::array::from_fn(|k| index + k as u64));
        let seen = seen::<W, Lanes<K, E>>(law, power_on.clone(), &case, unpack([0; K]));
        let seen = pack(&seen);
        for (index, seen) in (index..chunk.end).zip(seen) {
            if let Some(expected) = law.expected(&from_word(index)) {
                meant += 1;
                if to_word(&expected) != seen {
                    return (meant, Some(index));
                }
            }
        }
    }
    (meant, None)
}

/// The same case by case.
#[inline(never)]
fn one_by_one<W: Law>(law: &W, chunk: Range<u64>) -> (u64, Option<u64>) {
    let power_on = law.circuit().power_on();
    let mut meant = 0;
    for index in chunk {
        let case = from_word(index);
        let Some(expected) = law.expected(&case) else {
            continue;
        };
        meant += 1;
        let seen = seen::<W, Sim>(law, power_on.clone(), &case, zero());
        if to_word(&expected) != to_word(&seen) {
            return (meant, Some(index));
        }
    }
    (meant, None)
}

/// A case that is wrong, played in simulation.
fn replayed<W: Law>(law: &W, index: u64) -> Result<Counterexample<W::Circuit>, CheckError> {
    let case: W::Case<Sim> = from_word(index);
    let inputs = (0..law.ticks())
        .map(|tick| law.input(&case, tick))
        .collect();
    let seen = seen::<W, Sim>(law, law.circuit().power_on(), &case, zero());
    let seen = Named::of(&seen);
    let expected = law.expected(&case).map(|expected| Named::of(&expected));
    let differing: Vec<_> = expected.into_iter().flatten().zip(seen).collect();
    let differing = differing.iter().filter(|(expected, seen)| expected != seen);
    let (mut signals, mut found) = (Vec::new(), Vec::new());
    for ((name, expected), (_, seen)) in differing {
        signals.push(name.clone());
        found.push(format!("{name} is {seen}, not {expected}"));
    }
    if found.is_empty() {
        // The lanes and the simulation disagree: a fault of the former, and no reason to be silent.
        found.push("the lanes say so, simulation does not".to_owned());
    }
    let case = Named::of(&case).map(|(name, value)| format!("{name} = {value}"));
    let case = case.collect::<Vec<_>>().join(", ");
    let message = format!("{} with {case} (case {index})", found.join(", "));
    let fault = Fault { signals, message };
    let model = Model::of(law.circuit())?;
    Ok(Counterexample::new(
        &model,
        inputs,
        law.name().to_owned(),
        fault,
    ))
}

/// The leaves of a bundle by name, as numbers.
#[derive(Default)]
struct Named {
    path: Path,
    leaves: Vec<(String, String)>,
}

impl Named {
    fn of<S: Signals<Sim>>(signals: &S) -> impl Iterator<Item = (String, String)> + use<S> {
        let mut named = Named::default();
        signals.visit(part(Role::Net), &mut named);
        named.leaves.into_iter()
    }
}

impl Probe for Named {
    fn enter(&mut self, field: &'static Field) {
        self.path.enter(field);
    }
    fn leave(&mut self) {
        self.path.leave();
    }
    fn element(&mut self, index: usize) {
        self.path.element(index);
    }
    fn leaf(&mut self, field: &'static Field, shape: Shape, bits: u64) {
        let name = self.path.name(field);
        let scopes = self.path.scopes().iter().cloned();
        let path: Vec<_> = scopes.chain([name]).collect();
        let value = show(shape, field.format, bits);
        self.leaves.push((path.join("."), value));
    }
}
