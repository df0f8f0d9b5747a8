use super::counterexample::{Counterexample, Violation};
use super::{CheckError, Fault, TooWide};
use crate::engine::sliced::{LANES, Run, Sliced};
use crate::engine::{Engine, Watch, passes};
use crate::hdl::{
    self, Circuit, Declaration, Shapes, Value,
    pack::{bits_of, input_widths, joined, widths, words},
};
use crate::sim::Elaborated;
use crate::trace::value::show;
use rayon::prelude::*;
use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Number of cases that a thread takes at once; a multiple of the number of lanes.
const CHUNK: u64 = 1 << 14;

/// Function of a circuit over a fixed number of ticks from power-on, checked for every case of a
/// finite space by [`sweep()`].
///
/// A law is a circuit around the one under test. Its input ports are a case and stay constant; its
/// own nets in the last tick are the result. A register that counts the ticks, and others that
/// remember earlier values, cost nothing: the law is unrolled. The expected result is plain
/// arithmetic on numbers, by other means than the circuit's.
pub trait Law: Circuit {
    /// Returns the statement of the law.
    fn law(&self) -> &str;
    /// Returns the number of ticks of a case, at least 1.
    fn ticks(&self) -> u64;
    /// Returns the expected result; `None` excludes the case.
    fn expected(&self, case: &Self::In<Value>) -> Option<Self::Net<Value>>;
}

/// Result of a sweep.
#[must_use = "a counterexample is seen by looking at it"]
pub enum Swept<C: Circuit> {
    /// Number of cases checked, all as expected; excluded cases do not count.
    Held(u64),
    /// Case with the lowest index that is not as expected.
    Counterexample(Box<Counterexample<C>>),
}

impl<C: Circuit> Swept<C> {
    /// Returns the number of cases checked, if all are as expected.
    pub fn held(&self) -> Option<u64> {
        match self {
            Swept::Held(cases) => Some(*cases),
            Swept::Counterexample(_) => None,
        }
    }

    /// Returns the counterexample, if there is one.
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

/// Prepared sweep; see [`sweep()`].
#[must_use = "nothing is checked before it runs"]
pub struct Sweep<'a, W: Law> {
    law: &'a W,
    range: Option<Range<u64>>,
    model: Option<Elaborated>,
    progress: Option<&'a (dyn Fn(u64) + Sync)>,
}

/// Prepares a check of a law on every case, many at once, on all threads of rayon. The
/// counterexample is the case with the lowest index, whatever the number of threads.
#[must_use = "nothing is checked before it runs"]
pub fn sweep<W: Law>(law: &W) -> Sweep<'_, W> {
    Sweep {
        law,
        range: None,
        model: None,
        progress: None,
    }
}

/// Returns the number of cases of a law.
///
/// # Errors
/// Returns an error if a case has more than 63 bits, or its result more than 64.
pub fn cases<W: Law>(law: &W) -> Result<u64, CheckError> {
    let seen = widths::<W, W::Net<Shapes>>(law);
    TooWide::check_bits("the signals seen", seen.iter().sum(), 64)?;
    let bits = input_widths(law).iter().sum();
    TooWide::check_bits("the cases", bits, 63)?;
    Ok(1 << bits)
}

impl<'a, W: Law> Sweep<'a, W> {
    /// Checks only the cases with these indices, as far as they exist.
    pub fn range(mut self, range: Range<u64>) -> Self {
        self.range = Some(range);
        self
    }

    /// Checks this netlist of the law: one that was elaborated before, or that has a fault.
    pub fn model(mut self, model: Elaborated) -> Self {
        self.model = Some(model);
        self
    }

    fn netlist(&self) -> Result<Elaborated, CheckError> {
        match &self.model {
            Some(model) => Ok(model.clone()),
            None => Ok(Elaborated::new(self.law)?),
        }
    }

    /// Calls `report` from time to time with the number of cases checked since the last call.
    pub fn progress(mut self, report: &'a (dyn Fn(u64) + Sync)) -> Self {
        self.progress = Some(report);
        self
    }

    /// Runs the sweep by gates: the law is unrolled once into gates, which evaluate many cases at
    /// once. A circuit with written memories, or with too many gates, runs case by case as in
    /// [`run_simulated`](Self::run_simulated).
    ///
    /// # Errors
    /// Returns an error if a case has more than 63 bits, its result more than 64, or the circuit
    /// cannot be run.
    pub fn run(self) -> Result<Swept<W>, CheckError> {
        let model = self.netlist()?;
        cases(self.law)?;
        let cases = Cases::of(self.law);
        let unrolled = model
            .flat()
            .unrolled(self.law.ticks(), cases.seen.len())
            // Everything that does not depend on the case becomes a constant.
            .map(|flat| passes::all(&flat, &vec![true; flat.leaves.len()]));
        match unrolled.and_then(|flat| Sliced::of(&flat).ok()) {
            Some(sliced) => self.checked(&model, |chunk| cases.side_by_side(&sliced, chunk)),
            None => self.run_simulated(),
        }
    }

    /// Runs the sweep case by case in simulation.
    ///
    /// # Errors
    /// Returns an error if a case has more than 63 bits, its result more than 64, or the circuit
    /// cannot be run.
    pub fn run_simulated(self) -> Result<Swept<W>, CheckError> {
        let model = self.netlist()?;
        cases(self.law)?;
        let cases = Cases::of(self.law);
        let engine = std::sync::Mutex::new(Engine::straight(model.program(Watch::All)));
        self.checked(&model, |chunk| {
            let engine = engine.lock();
            let mut engine = engine
                .unwrap_or_else(std::sync::PoisonError::into_inner)
                .clone();
            cases.one_by_one(&mut engine, chunk)
        })
    }

    /// Checks chunk by chunk on all threads; `check` returns the number of cases included and the
    /// first that is wrong.
    fn checked(
        self,
        model: &Elaborated,
        check: impl Fn(Range<u64>) -> (u64, Option<u64>) + Sync,
    ) -> Result<Swept<W>, CheckError> {
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

    /// Returns the lowest index that `check` finds wrong, chunk by chunk on all threads.
    fn first(
        &self,
        check: impl Fn(Range<u64>) -> Option<u64> + Sync,
    ) -> Result<Option<u64>, CheckError> {
        let all = cases(self.law)?;
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
            .field("circuit", &W::NAME)
            .field("law", &self.law.law())
            .field("range", &self.range)
            .finish_non_exhaustive()
    }
}

/// Cases of a law.
struct Cases<'a, W: Law> {
    law: &'a W,
    /// Widths of the result's words.
    seen: Vec<usize>,
}

impl<'a, W: Law> Cases<'a, W> {
    fn of(law: &'a W) -> Self {
        Cases {
            law,
            seen: widths::<W, W::Net<Shapes>>(law),
        }
    }

    /// Returns the expected result of a case as one word.
    fn expected(&self, index: u64) -> Option<u64> {
        let case = hdl::inputs(self.law, bits_of(index));
        let expected = self.law.expected(&case)?;
        Some(joined(&words(&expected, &self.seen), &self.seen))
    }

    /// Evaluates a chunk of cases at once; returns the number of cases included, and the first
    /// that is wrong.
    fn side_by_side(&self, sliced: &Sliced, chunk: Range<u64>) -> (u64, Option<u64>) {
        let mut run = Run::new(sliced);
        let mut meant = 0;
        let lanes = LANES as u64;
        let whole = chunk.start / lanes * lanes;
        for first in (whole..chunk.end).step_by(LANES) {
            run.run(first);
            for word in 0..LANES / 64 {
                let first = first + 64 * word as u64;
                if first + 64 <= chunk.start || first >= chunk.end {
                    continue;
                }
                for (index, seen) in (first..).zip(run.seen(word)) {
                    if !chunk.contains(&index) {
                        continue;
                    }
                    if let Some(expected) = self.expected(index) {
                        meant += 1;
                        if expected != seen {
                            return (meant, Some(index));
                        }
                    }
                }
            }
        }
        (meant, None)
    }

    /// Evaluates a chunk case by case in simulation.
    fn one_by_one(&self, engine: &mut Engine, chunk: Range<u64>) -> (u64, Option<u64>) {
        let power_on = engine.slab().to_vec();
        let mut meant = 0;
        for index in chunk {
            if let Some(expected) = self.expected(index) {
                meant += 1;
                engine.restore(&power_on);
                if expected != joined(&self.run(engine, index), &self.seen) {
                    return (meant, Some(index));
                }
            }
        }
        (meant, None)
    }

    /// Returns the result of a case, simulated from power-on.
    fn run(&self, engine: &mut Engine, index: u64) -> Vec<u64> {
        let ports = input_widths(self.law);
        let case: W::In<Value> = hdl::inputs(self.law, bits_of(index));
        engine.drive_all(&words(&case, &ports));
        for tick in 0..self.law.ticks() {
            if tick > 0 {
                engine.edge();
            }
            engine.settle();
        }
        let leaves = engine.leaves();
        let seen = leaves - self.seen.len()..leaves;
        seen.map(|leaf| engine.word(leaf)).collect()
    }
}

/// Replays a wrong case in simulation.
fn replayed<W: Law>(law: &W, model: &Elaborated, index: u64) -> Counterexample<W> {
    let cases = Cases::of(law);
    let case: W::In<Value> = hdl::inputs(law, bits_of(index));
    let leaves = &model.declarations().leaves;
    let own = &leaves[leaves.len() - cases.seen.len()..];
    let seen = cases.run(&mut model.engine(Watch::All), index);
    let expected = law.expected(&case);
    let expected = expected.map(|expected| words(&expected, &cases.seen));
    let (mut signals, mut found) = (Vec::new(), Vec::new());
    for ((leaf, seen), expected) in own.iter().zip(&seen).zip(expected.iter().flatten()) {
        if seen != expected {
            let value = |word| show(leaf.shape, leaf.field.format, word);
            signals.push(leaf.name.clone());
            let (seen, expected) = (value(*seen), value(*expected));
            found.push(format!("{} is {seen}, not {expected}", leaf.name));
        }
    }
    if found.is_empty() {
        // The gates and the simulation disagree: a fault of the gates, which must not be hidden.
        found.push("the unrolled circuit says so, simulation does not".to_owned());
    }
    let ports = words(&case, &input_widths(law));
    let named = leaves.iter().zip(&ports).map(|(leaf, word)| {
        let value = show(leaf.shape, leaf.field.format, *word);
        format!("{} = {value}", name(leaf))
    });
    let named = named.collect::<Vec<_>>().join(", ");
    let message = format!("{} with {named} (case {index})", found.join(", "));
    let fault = Fault { signals, message };
    let ticks = 0..law.ticks();
    let inputs = ticks.clone().map(|_| hdl::inputs(law, bits_of(index)));
    let ports = ticks.map(|_| ports.clone());
    let violation = Violation::new(model, ports.collect(), law.law().to_owned(), fault);
    Counterexample::of(violation, inputs.collect())
}

/// Returns the name of a port below the circuit's scope.
fn name(leaf: &Declaration) -> String {
    let scopes = leaf.scopes.iter().skip(1).cloned();
    let path: Vec<_> = scopes.chain([leaf.name.clone()]).collect();
    path.join(".")
}
