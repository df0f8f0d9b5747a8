//! Proofs of the properties of a netlist, one after the other: induction over all of them, then a
//! search for each that is left.

mod any_words;

use super::certify;
use super::clauses::Answer;
use super::frames::{Cone, Start};
use super::not_inductive;
use super::search::{Never, Searched, search};
use super::thread_time::ThreadTime;
use super::unrolled::{At, Unrolled};
use crate::engine::Flat;
use crate::engine::sliced::NotSliced;
use std::time::Duration;

/// Greatest number of ticks that an induction assumes.
const INDUCTION: usize = 4;
/// Number of ticks from power-on in which a violation is looked for before the search.
const TICKS: usize = 12;

/// Share of the time for a property in which contradictions of the givens are looked for.
const DEAD: u32 = 10;

/// Basis of a proof.
#[derive(Debug, Clone)]
pub(super) enum Basis {
    /// No state violates the property.
    EveryState,
    /// The property holds after this number of ticks in which it and its lemmas hold.
    Induction(usize),
    /// The property holds outside of these sets of states, and no edge enters them.
    Search(Vec<Never>),
}

/// Grounds of a proof, which can be checked on their own.
#[derive(Debug, Clone)]
pub(super) struct Grounds {
    pub basis: Basis,
    /// Order of the proofs; properties of the same step are proved together.
    pub step: usize,
    /// Other properties on which the proof relies.
    pub with: Vec<usize>,
}

/// Result for a property.
#[derive(Debug)]
pub(super) enum Found {
    Proved(Grounds),
    /// Input ports of a run from power-on that violates it in its last tick.
    Violated(Vec<Vec<u64>>),
    /// Nothing was found in time. The sets of states are not reached within some ticks.
    Open(Vec<Never>, Option<not_inductive::Found>),
    /// A single question about it took too long, or the netlist has too many gates.
    TooLarge,
}

/// Task of a prover.
#[derive(Debug)]
pub(super) struct Task<'f> {
    pub flat: &'f Flat,
    /// Properties to prove, by their number in the netlist.
    pub properties: Vec<usize>,
    /// Properties of parts. Those that an induction proves soon are lemmas; the others do not count.
    pub lemmas: Vec<usize>,
    /// Properties that are assumed in every tick.
    pub givens: Vec<usize>,
    /// Greatest size of all expanded memories in bits; a read of another one may give any word.
    pub memory_bits: usize,
    /// Time for each property.
    pub limit: Duration,
}

impl Task<'_> {
    /// Returns the cone of all statements, with at most `memory_bits` bits of memories as state.
    fn cone(&self, memory_bits: usize) -> Cone {
        let asked = self.proved().chain(self.givens.iter().copied());
        let asked: Vec<_> = asked.map(|index| self.flat.properties[index]).collect();
        Cone::of(self.flat, &asked, memory_bits)
    }
}

/// Results of a prover.
#[derive(Debug)]
pub(super) struct Results {
    /// Result for each property of the task, and the time that it took.
    pub found: Vec<(Found, Duration)>,
    /// True if a read of a memory may give any word.
    pub is_abstract: bool,
    /// Properties whose proofs a second check refused.
    pub refused: Vec<usize>,
    /// First tick in which no input keeps the givens, if there is one among the first ticks.
    pub dead: Option<usize>,
}

struct Prover<'t, 'f> {
    task: &'t Task<'f>,
    cone: &'t Cone,
    base: Unrolled<'t>,
    step: Unrolled<'t>,
    /// Result of each property of the netlist.
    found: Vec<Option<Found>>,
    spent: Vec<Duration>,
    /// Ticks from power-on in which each property cannot be violated.
    safe: Vec<usize>,
    /// Properties about which the first questions took too long.
    hard: Vec<bool>,
    steps: usize,
}

/// Proves or refutes the properties of a task.
pub(super) fn prove(task: &Task<'_>) -> Results {
    let cone = task.cone(task.memory_bits);
    let mut prover = Prover::new(task, &cone);
    let dead = prover.dead();
    let large = dead.is_err() || prover.run().is_err();
    let refused = prover.certify();
    let mut found = Vec::new();
    for &property in &task.properties {
        let result = match prover.found[property].take() {
            Some(Found::Open(..)) | None if large || prover.hard[property] => Found::TooLarge,
            None => Found::Open(Vec::new(), None),
            Some(result) => result,
        };
        found.push((result, prover.spent[property]));
    }
    Results {
        found,
        is_abstract: cone.is_abstract(task.flat),
        refused,
        dead: dead.unwrap_or(None),
    }
}

impl<'t, 'f> Prover<'t, 'f> {
    fn new(task: &'t Task<'f>, cone: &'t Cone) -> Self {
        let count = task.flat.properties.len();
        Prover {
            task,
            cone,
            base: Unrolled::new(task.flat, cone, Start::PowerOn),
            step: Unrolled::new(task.flat, cone, Start::Any),
            found: (0..count).map(|_| None).collect(),
            spent: vec![Duration::ZERO; count],
            safe: vec![0; count],
            hard: vec![false; count],
            steps: 0,
        }
    }

    /// Returns the first tick of an induction's start in which no input keeps the givens.
    fn dead(&mut self) -> Result<Option<usize>, NotSliced> {
        // Where inputs are hard to find, they rarely contradict each other.
        let until = ThreadTime::now() + self.task.limit / DEAD;
        let mut held = Vec::new();
        if self.task.givens.is_empty() {
            return Ok(None);
        }
        for tick in 0..TICKS {
            for at in each(&self.task.givens, tick..=tick) {
                held.push(self.base.holds(at)?);
            }
            if self.base.clauses.solve(&held, until) == Answer::Impossible {
                return Ok(Some(tick));
            }
        }
        Ok(None)
    }

    fn run(&mut self) -> Result<(), NotSliced> {
        self.any_words()?;
        self.every_state()?;
        for ticks in 1..=INDUCTION {
            self.start(self.open(self.task.proved()), ticks)?;
            self.induct(ticks)?;
        }
        self.start(self.asked(), TICKS)?;
        // A property that takes long may be easy with one that comes after it.
        for share in [4, 1] {
            for property in self.asked() {
                self.search(property, share)?;
            }
            self.induct(1)?;
        }
        for property in self.asked() {
            let from = self.not_inductive(property)?;
            // A state would be found, but for the time.
            self.hard[property] |= from.is_none();
            if let Some(Found::Open(_, slot)) = &mut self.found[property] {
                *slot = from;
            }
        }
        Ok(())
    }

    /// Returns a state in which an open property holds, and from which it is violated.
    fn not_inductive(
        &mut self,
        property: usize,
    ) -> Result<Option<not_inductive::Found>, NotSliced> {
        let lemmas = [&self.lemmas()[..], &self.task.givens].concat();
        let mut held = each(&lemmas, 0..=1);
        held.push(At { property, tick: 0 });
        let until = ThreadTime::now() + self.task.limit / 4;
        not_inductive::find(&mut self.step, At { property, tick: 1 }, &held, until)
    }

    /// Returns those of the properties that have no result.
    fn open(&self, properties: impl Iterator<Item = usize>) -> Vec<usize> {
        let is_open = |&index: &usize| matches!(self.found[index], None | Some(Found::Open(..)));
        properties.filter(is_open).collect()
    }

    /// Returns the properties to prove that have no result.
    fn asked(&self) -> Vec<usize> {
        self.open(self.task.properties.iter().copied())
    }

    fn prove(&mut self, property: usize, basis: Basis, with: Vec<usize>) {
        let step = self.steps;
        self.found[property] = Some(Found::Proved(Grounds { basis, step, with }));
    }

    /// Returns the proved properties that say something of the state.
    fn lemmas(&self) -> Vec<usize> {
        let all = self.task.proved();
        let is_lemma = |&index: &usize| match &self.found[index] {
            Some(Found::Proved(grounds)) => !matches!(grounds.basis, Basis::EveryState),
            _ => false,
        };
        all.filter(is_lemma).collect()
    }

    /// Returns the time at which the work on a property has to end.
    fn until(&self, property: usize) -> ThreadTime {
        ThreadTime::now()
            + self
                .task
                .limit(property)
                .saturating_sub(self.spent[property])
    }

    /// Searches for a violation of a property in a tick, with `held` and the givens.
    fn ask(
        &mut self,
        from: Start,
        property: usize,
        tick: usize,
        held: &[At],
    ) -> Result<Answer, NotSliced> {
        let until = self.until(property);
        let start = ThreadTime::now();
        let mut held = held.to_vec();
        held.extend(each(&self.task.givens, 0..=tick));
        let unrolled = match from {
            Start::PowerOn => &mut self.base,
            Start::Any => &mut self.step,
        };
        let answer = unrolled.violate(At { property, tick }, &held, until);
        self.spent[property] += start.elapsed();
        answer
    }

    /// Looks for violations of properties in the first ticks from power-on.
    fn start(&mut self, properties: Vec<usize>, ticks: usize) -> Result<(), NotSliced> {
        for property in properties {
            for tick in self.safe[property]..ticks {
                match self.ask(Start::PowerOn, property, tick, &[])? {
                    Answer::Impossible => self.safe[property] = tick + 1,
                    Answer::Possible => {
                        let inputs = self.base.inputs(tick + 1)?;
                        self.found[property] = Some(Found::Violated(inputs));
                        break;
                    }
                    Answer::Unknown => break,
                }
            }
        }
        Ok(())
    }

    /// Proves those properties that hold in a tick after `ticks` ticks in which all of them hold.
    fn induct(&mut self, ticks: usize) -> Result<(), NotSliced> {
        let mut group = self.open(self.task.proved());
        group.retain(|&index| self.safe[index] >= ticks);
        let lemmas = each(&self.lemmas(), 0..=ticks);
        loop {
            let mut held = each(&group, 0..=ticks - 1);
            held.extend(&lemmas);
            let (mut proved, mut dropped) = (Vec::new(), Vec::new());
            for &property in &group {
                let in_time = self.spent[property] < self.task.limit(property);
                match self.ask(Start::Any, property, ticks, &held)? {
                    Answer::Impossible => {
                        let needed = self.step.needed(&held)?;
                        proved.push((property, others(property, &needed)));
                    }
                    answer => {
                        let late = answer == Answer::Unknown;
                        self.hard[property] |= ticks == 1 && late && in_time;
                        dropped.push(property);
                    }
                }
            }
            if dropped.is_empty() {
                self.steps += 1;
                for (property, with) in proved {
                    self.prove(property, Basis::Induction(ticks), with);
                }
                return Ok(());
            }
            group.retain(|index| !dropped.contains(index));
        }
    }

    /// Searches for an invariant of a property, in a share of the time that is left for it.
    fn search(&mut self, property: usize, share: u32) -> Result<(), NotSliced> {
        let lemmas = self.lemmas();
        let known = [&lemmas[..], &self.task.givens].concat();
        let start = ThreadTime::now();
        let until = start + self.until(property).left() / share;
        let searched = search(self.task.flat, self.cone, property, &known, until)?;
        self.spent[property] += start.elapsed();
        match searched {
            Searched::Trace(inputs) => self.found[property] = Some(Found::Violated(inputs)),
            Searched::Open(never) => self.found[property] = Some(Found::Open(never, None)),
            Searched::Invariant(never) => {
                self.steps += 1;
                self.hard[property] = false;
                let basis = Basis::Search(never);
                let with = match self.is_enough(property, &basis) {
                    true => Vec::new(),
                    false => lemmas,
                };
                self.prove(property, basis, with);
            }
        }
        Ok(())
    }

    /// True if a basis proves a property without any other.
    fn is_enough(&self, property: usize, basis: &Basis) -> bool {
        let mut all = vec![None; self.found.len()];
        all[property] = Some(Grounds {
            basis: basis.clone(),
            step: self.steps,
            with: Vec::new(),
        });
        certify::check(self.task, &all, property) == Ok(Answer::Impossible)
    }

    /// Checks all proofs again, and returns the properties whose proofs are refused. A proof whose
    /// check takes too long does not count, nor does one that relies on it.
    fn certify(&mut self) -> Vec<usize> {
        let (mut refused, mut late) = (Vec::new(), Vec::new());
        let found = self.found.iter();
        let all: Vec<_> = found
            .map(|found| match found {
                Some(Found::Proved(grounds)) => Some(grounds.clone()),
                _ => None,
            })
            .collect();
        for property in 0..all.len() {
            if all[property].is_none() {
                continue;
            }
            let start = ThreadTime::now();
            let checked = certify::check(self.task, &all, property);
            self.spent[property] += start.elapsed();
            match checked {
                Ok(Answer::Impossible) => {}
                Ok(Answer::Possible) => refused.push(property),
                Ok(Answer::Unknown) | Err(NotSliced) => late.push(property),
            }
        }
        while let Some(property) = late.pop() {
            self.found[property] = None;
            for (other, found) in self.found.iter().enumerate() {
                if let Some(Found::Proved(grounds)) = found
                    && grounds.with.contains(&property)
                {
                    late.push(other);
                }
            }
        }
        refused
    }
}

/// Returns each property in each of these ticks.
pub(super) fn each(properties: &[usize], ticks: std::ops::RangeInclusive<usize>) -> Vec<At> {
    let ticks = ticks.flat_map(|tick| {
        let properties = properties.iter();
        properties.map(move |&property| At { property, tick })
    });
    ticks.collect()
}

/// Returns the other properties among those in ticks, each once.
fn others(property: usize, held: &[At]) -> Vec<usize> {
    let mut others: Vec<usize> = held.iter().map(|at| at.property).collect();
    others.sort_unstable();
    others.dedup();
    others.retain(|other| *other != property);
    others
}
