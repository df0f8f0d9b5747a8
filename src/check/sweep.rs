mod simulated;
mod unrolled;

use super::enumerate::{from_word, to_word};
use super::{CheckError, Counterexample, Fault, TooWide};
use crate::kernel::{Circuit, Field, Model, Moment, Path, Probe, Role, Shape, Signals, part};
use crate::logic::{Logic, Sim};
use crate::trace::value::show;
use rayon::prelude::*;
use simulated::Simulated;
use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// The cases that a thread takes at a time; a multiple of those that run side by side.
const CHUNK: u64 = 1 << 14;

/// What a circuit makes of a fixed number of ticks from power-on, for every case of a finite space:
/// checked case by case by [`sweep()`].
///
/// A case is a bundle of words; its index is what they are packed. What goes in and what is seen is
/// written in words of any meaning, as a circuit is. What is expected is plain arithmetic on
/// numbers, by other means than the circuit's.
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

/// Checks a law on every case, many of them side by side, on as many threads as rayon has. The
/// counterexample is the case with the lowest index, however many threads there are.
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

    /// Runs it: the law is unrolled once into gates from the bits of a case to those of what is seen,
    /// which many cases run through side by side. A circuit with memories, and one of which there
    /// would be too many gates, is run case by case as by [`run_simulated`](Self::run_simulated).
    ///
    /// # Errors
    /// A case has more than 63 bits, or what is seen more than 64, or the circuit cannot be run.
    pub fn run(self) -> Result<Swept<W::Circuit>, CheckError> {
        cases::<W>()?;
        let law = self.law;
        let model = Model::of(law.circuit())?;
        match unrolled::unrolled(law) {
            Some(sliced) => self.checked(&model, |chunk| unrolled::check(law, &sliced, chunk)),
            None => self.run_simulated(),
        }
    }

    /// Runs it case by case, as a simulation runs.
    ///
    /// # Errors
    /// A case has more than 63 bits, or what is seen more than 64, or the circuit cannot be run.
    pub fn run_simulated(self) -> Result<Swept<W::Circuit>, CheckError> {
        cases::<W>()?;
        let law = self.law;
        let model = Model::of(law.circuit())?;
        let simulated = Simulated::new(&model);
        self.checked(&model, |chunk| simulated.check(law, chunk))
    }

    /// Checks chunk by chunk on all threads; `check` says how many cases of one are meant, and which
    /// is the first that is wrong.
    fn checked(
        self,
        model: &Model,
        check: impl Fn(Range<u64>) -> (u64, Option<u64>) + Sync,
    ) -> Result<Swept<W::Circuit>, CheckError> {
        let held = AtomicU64::new(0);
        let first = self.first(|chunk| {
            let (meant, first) = check(chunk);
            held.fetch_add(meant, Ordering::Relaxed);
            first
        })?;
        Ok(match first {
            None => Swept::Held(held.into_inner()),
            Some(index) => Swept::Counterexample(Box::new(replayed(self.law, model, index))),
        })
    }

    /// The lowest index that `check` finds wrong, chunk by chunk on all threads.
    fn first(
        &self,
        check: impl Fn(Range<u64>) -> Option<u64> + Sync,
    ) -> Result<Option<u64>, CheckError> {
        let all = cases::<W>()?;
        let range = self.range.clone().unwrap_or(0..all);
        let (from, to) = (range.start, range.end.min(all));
        if from >= to {
            return Ok(None);
        }
        let chunks = (from / CHUNK..to.div_ceil(CHUNK)).into_par_iter();
        Ok(chunks.find_map_first(|chunk| {
            let begin = from.max(chunk * CHUNK);
            let end = to.min((chunk + 1) * CHUNK);
            let first = check(begin..end);
            if let Some(report) = self.progress {
                report(end - begin);
            }
            first
        }))
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

/// A case that is wrong, played in simulation.
fn replayed<W: Law>(law: &W, model: &Model, index: u64) -> Counterexample<W::Circuit> {
    let case: W::Case<Sim> = from_word(index);
    let inputs = (0..law.ticks())
        .map(|tick| law.input(&case, tick))
        .collect();
    let seen = Simulated::new(model).seen(law, &case);
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
        // The gates and the simulation disagree: a fault of the former, and no reason to be silent.
        found.push("the unrolled circuit says so, simulation does not".to_owned());
    }
    let case = Named::of(&case).map(|(name, value)| format!("{name} = {value}"));
    let case = case.collect::<Vec<_>>().join(", ");
    let message = format!("{} with {case} (case {index})", found.join(", "));
    let fault = Fault { signals, message };
    Counterexample::new(model, inputs, law.name().to_owned(), fault)
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
