use super::cases::Cases;
use super::counterexample::Counterexample;
use super::{CheckError, TooWide};
use crate::engine::sliced::{LANES, Sliced};
use crate::engine::{Engine, Watch, passes};
use crate::hdl::{
    Circuit, Shapes, Value,
    pack::{input_widths, widths},
};
use crate::sim::Elaborated;
use rayon::prelude::*;
use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Number of cases that a thread takes at once in simulation.
const CHUNK: u64 = 1 << 14;

/// Greatest number of bits that number the batches of a group.
const BATCH_BITS: u32 = 8;

/// Function of a circuit over a fixed number of ticks from power-on, checked for every case of a
/// finite space by [`sweep()`].
///
/// A law is a circuit around the one under test. Its input ports are a case and stay constant; its
/// own nets in the last tick are the result. A register that counts the ticks, and others that
/// remember earlier values, cost nothing: the law is unrolled.
///
/// The expected result is plain arithmetic on numbers, by other means than the circuit's. A law
/// that states it as [properties](Circuit::properties) too is checked several times faster: each
/// case costs two bits then, instead of a comparison of numbers. Properties must hold in every tick
/// of a case. A case counts if it keeps everything that is [given](crate::hdl::Property::given).
/// The numbers then confirm one case in 512, every case in simulation, and describe the
/// counterexample.
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
        let bits = cases(self.law)?.trailing_zeros();
        let cases = Cases::of(self.law, &model);
        let batch_bits = bits.saturating_sub(LANES.trailing_zeros()).min(BATCH_BITS);
        let unrolled = model
            .flat()
            .unrolled(self.law.ticks(), cases.words(), cases.claims())
            // Everything that does not depend on the case becomes a constant.
            .map(|flat| passes::all(&flat, &vec![true; flat.leaves.len()]));
        match unrolled.and_then(|flat| Sliced::of(&flat, batch_bits).ok()) {
            Some(sliced) => self.checked(&cases, (LANES as u64) << batch_bits, |chunk| {
                cases.side_by_side(&sliced, chunk)
            }),
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
        let cases = Cases::of(self.law, &model);
        let engine = std::sync::Mutex::new(Engine::straight(model.program(Watch::Stated)));
        self.checked(&cases, CHUNK, |chunk| {
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
        cases: &Cases<'_, W>,
        chunk: u64,
        check: impl Fn(Range<u64>) -> (u64, Option<u64>) + Sync,
    ) -> Result<Swept<W>, CheckError> {
        let held = AtomicU64::new(0);
        let first = self.first(chunk, |chunk| {
            let (meant, first) = check(chunk);
            held.fetch_add(meant, Ordering::Relaxed);
            first
        })?;
        Ok(match first {
            None => Swept::Held(held.into_inner()),
            Some(index) => Swept::Counterexample(Box::new(cases.replayed(index))),
        })
    }

    /// Returns the lowest index that `check` finds wrong, chunk by chunk on all threads.
    fn first(
        &self,
        size: u64,
        check: impl Fn(Range<u64>) -> Option<u64> + Sync,
    ) -> Result<Option<u64>, CheckError> {
        let all = cases(self.law)?;
        let range = self.range.clone().unwrap_or(0..all);
        let (from, to) = (range.start, range.end.min(all));
        if from >= to {
            return Ok(None);
        }
        let chunks = (from / size..to.div_ceil(size)).into_par_iter();
        Ok(chunks.find_map_first(|chunk| {
            let begin = from.max(chunk * size);
            let end = to.min((chunk + 1) * size);
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
