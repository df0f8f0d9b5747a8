//! Cases of a law: their evaluation, and the replay of one that is wrong.

use super::counterexample::{Counterexample, Violation};
use super::enumerate::scramble;
use super::{Fault, Law};
use crate::engine::sliced::{LANES, Run, Sliced, WORDS};
use crate::engine::{Engine, Watch};
use crate::hdl::{
    self, Declaration, Shapes, Value,
    pack::{bits_of, input_widths, joined, widths, words},
};
use crate::netlist::Assertion;
use crate::sim::Elaborated;
use crate::trace::value::show;
use std::ops::Range;

/// Cases of a law.
pub(super) struct Cases<'a, W: Law> {
    law: &'a W,
    model: &'a Elaborated,
    /// Widths of the result's words.
    seen: Vec<usize>,
    /// Indices of the assumptions and of the properties; empty without properties.
    claims: Vec<Vec<usize>>,
}

/// Simulated case.
struct Ran {
    /// Words of the result.
    seen: Vec<u64>,
    /// True if the assumptions hold in every tick.
    given: bool,
    /// Violated properties.
    broken: Vec<usize>,
}

impl<'a, W: Law> Cases<'a, W> {
    pub(super) fn of(law: &'a W, model: &'a Elaborated) -> Self {
        let stated = model.stated();
        let of = |proved: bool| {
            let all = stated.iter().enumerate();
            let all = all.filter(|(_, one)| one.claim.is_proved() == proved);
            all.map(|(index, _)| index).collect::<Vec<_>>()
        };
        let (given, proved) = (of(false), of(true));
        Cases {
            law,
            model,
            seen: widths::<W, W::Net<Shapes>>(law),
            claims: match proved.is_empty() {
                true => Vec::new(),
                false => vec![given, proved],
            },
        }
    }

    /// Returns the number of words of the result.
    pub(super) fn words(&self) -> usize {
        self.seen.len()
    }

    /// Returns the indices of the assumptions and of the properties; nothing without properties.
    pub(super) fn claims(&self) -> &[Vec<usize>] {
        &self.claims
    }

    /// Returns the number of bits of the result.
    fn bits(&self) -> usize {
        self.seen.iter().sum()
    }

    /// Returns the expected result of a case as one word.
    fn expected(&self, index: u64) -> Option<u64> {
        let case = hdl::inputs(self.law, bits_of(index));
        let expected = self.law.expected(&case)?;
        Some(joined(&words(&expected, &self.seen), &self.seen))
    }

    /// Evaluates the cases of a group, or a part of it; returns the number of cases included, and
    /// the first that is wrong.
    pub(super) fn side_by_side(&self, sliced: &Sliced, chunk: Range<u64>) -> (u64, Option<u64>) {
        let mut run = Run::new(sliced);
        let batch_bits = sliced.batch_bits();
        let group = (LANES as u64) << batch_bits;
        let first = chunk.start / group * group;
        let (mut meant, mut wrong): (u64, Option<u64>) = (0, None);
        for batch in 0..1 << batch_bits {
            run.run(first, batch);
            let confirmed = scramble(first + batch) as usize % LANES;
            for word in 0..WORDS {
                let from = first + batch + ((64 * word as u64) << batch_bits);
                let lanes = within(&chunk, from, batch_bits);
                let case = |lane: u32| from + (u64::from(lane) << batch_bits);
                let (included, mut failed) = match self.claims.is_empty() {
                    true => self.by_numbers(&run, word, lanes, case),
                    false => self.by_properties(&run, word, lanes),
                };
                let lane = (confirmed % 64) as u32;
                let confirms = confirmed / 64 == word && lanes >> lane & 1 == 1;
                if confirms && !self.claims.is_empty() {
                    let seen =
                        (included >> lane & 1 == 1).then(|| run.case(self.bits(), confirmed));
                    failed |= u64::from(self.expected(case(lane)) != seen) << lane;
                }
                meant += u64::from(included.count_ones());
                if failed != 0 {
                    let index = case(failed.trailing_zeros());
                    wrong = Some(wrong.map_or(index, |wrong| wrong.min(index)));
                }
            }
        }
        (meant, wrong)
    }

    /// Returns which of 64 cases are included and which are wrong, by the properties of the law.
    fn by_properties(&self, run: &Run<'_>, word: usize, lanes: u64) -> (u64, u64) {
        let mut claims = run.bits(self.bits(), word);
        let mut claim = || claims.next().unwrap_or_default();
        let (given, holds) = (claim(), claim());
        (lanes & given, lanes & given & !holds)
    }

    /// Returns which of 64 cases are included and which are wrong, by the expected numbers.
    fn by_numbers(
        &self,
        run: &Run<'_>,
        word: usize,
        lanes: u64,
        case: impl Fn(u32) -> u64,
    ) -> (u64, u64) {
        let seen = run.seen(word);
        let (mut included, mut wrong) = (0, 0);
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros();
            left &= left - 1;
            if let Some(expected) = self.expected(case(lane)) {
                included |= 1 << lane;
                wrong |= u64::from(expected != seen[lane as usize]) << lane;
            }
        }
        (included, wrong)
    }

    /// Evaluates a chunk case by case in simulation.
    pub(super) fn one_by_one(&self, engine: &mut Engine, chunk: Range<u64>) -> (u64, Option<u64>) {
        let power_on = engine.slab().to_vec();
        let mut meant = 0;
        for index in chunk {
            let expected = self.expected(index);
            if expected.is_none() && self.claims.is_empty() {
                continue;
            }
            engine.restore(&power_on);
            let ran = self.simulated(engine, index);
            meant += u64::from(ran.given);
            let seen = ran.given.then(|| joined(&ran.seen, &self.seen));
            if expected != seen || (ran.given && !ran.broken.is_empty()) {
                return (meant, Some(index));
            }
        }
        (meant, None)
    }

    /// Runs a case from power-on.
    fn simulated(&self, engine: &mut Engine, index: u64) -> Ran {
        let ports = input_widths(self.law);
        let case: W::In<Value> = hdl::inputs(self.law, bits_of(index));
        engine.drive_all(&words(&case, &ports));
        let [mut given, mut broken] = [Vec::new(), Vec::new()];
        for tick in 0..self.law.ticks() {
            if tick > 0 {
                engine.edge();
            }
            engine.settle();
            for (violated, claims) in [&mut given, &mut broken].into_iter().zip(&self.claims) {
                let claims = claims.iter().copied();
                violated.extend(claims.filter(|&claim| !engine.property(claim)));
            }
        }
        broken.sort_unstable();
        broken.dedup();
        let leaves = engine.leaves();
        let seen = leaves - self.seen.len()..leaves;
        Ran {
            seen: seen.map(|leaf| engine.word(leaf)).collect(),
            given: given.is_empty(),
            broken,
        }
    }

    /// Replays a wrong case in simulation.
    pub(super) fn replayed(&self, index: u64) -> Counterexample<W> {
        let case: W::In<Value> = hdl::inputs(self.law, bits_of(index));
        let leaves = &self.model.declarations().leaves;
        let ran = self.simulated(&mut self.model.engine(Watch::Stated), index);
        let mut fault = self.fault(&ran, self.law.expected(&case));
        let ports = words(&case, &input_widths(self.law));
        let named = leaves.iter().zip(&ports).map(|(leaf, word)| {
            let value = show(leaf.shape, leaf.field.format, *word);
            format!("{} = {value}", name(leaf))
        });
        let named = named.collect::<Vec<_>>().join(", ");
        fault.message = format!("{} with {named} (case {index})", fault.message);
        let ticks = 0..self.law.ticks();
        let inputs = ticks.clone().map(|_| hdl::inputs(self.law, bits_of(index)));
        let ports = ticks.map(|_| ports.clone());
        let law = self.law.law().to_owned();
        let violation = Violation::new(self.model, ports.collect(), law, fault);
        Counterexample::of(violation, inputs.collect())
    }

    /// Returns what is wrong in a case.
    fn fault(&self, ran: &Ran, expected: Option<W::Net<Value>>) -> Fault {
        let leaves = &self.model.declarations().leaves;
        let own = &leaves[leaves.len() - self.seen.len()..];
        let (mut signals, mut found) = (Vec::new(), Vec::new());
        let is_expected = expected.is_some();
        let expected = expected.map(|expected| words(&expected, &self.seen));
        for ((leaf, seen), expected) in own.iter().zip(&ran.seen).zip(expected.iter().flatten()) {
            if seen != expected {
                let value = |word| show(leaf.shape, leaf.field.format, word);
                signals.push(leaf.name.clone());
                let (seen, expected) = (value(*seen), value(*expected));
                found.push(format!("{} is {seen}, not {expected}", leaf.name));
            }
        }
        let stated: &[Assertion] = self.model.stated();
        match (is_expected, ran.given) {
            (true, false) => {
                found = vec!["an assumption excludes the case, the numbers do not".to_owned()]
            }
            (false, true) => {
                found = vec!["the numbers exclude the case, no assumption does".to_owned()]
            }
            // A property that does not state what the numbers do.
            _ if found.is_empty() => {
                for &broken in &ran.broken {
                    let names = stated[broken].signals.iter();
                    signals.extend(names.map(|name| (*name).to_owned()));
                    let name = stated[broken].name;
                    found.push(format!(
                        "`{name}` does not hold, but all numbers are as expected"
                    ));
                }
            }
            _ if ran.broken.is_empty() && !self.claims.is_empty() => {
                found.push("but all properties hold".to_owned());
            }
            _ => {}
        }
        if found.is_empty() {
            // The gates and the simulation disagree: a fault of the gates, which must not be hidden.
            found.push("the unrolled circuit says so, simulation does not".to_owned());
        }
        let message = found.join(", ");
        Fault { signals, message }
    }
}

/// Returns a bit for each of 64 cases, high in the chunk: they begin with `from`, in steps of
/// 2^`batch_bits`.
fn within(chunk: &Range<u64>, from: u64, batch_bits: u32) -> u64 {
    // Number of cases before an index.
    let before = |index: u64| {
        let lanes = index.saturating_sub(from).div_ceil(1 << batch_bits);
        lanes.min(64) as u32
    };
    let low = |lanes: u32| u64::MAX.checked_shr(64 - lanes).unwrap_or(0);
    low(before(chunk.end)) & !low(before(chunk.start))
}

/// Returns the name of a port below the circuit's scope.
fn name(leaf: &Declaration) -> String {
    let scopes = leaf.scopes.iter().skip(1).cloned();
    let path: Vec<_> = scopes.chain([leaf.name.clone()]).collect();
    path.join(".")
}
